// Sentences about what is on the stage.

import {listed} from "./reader.js";
import {views} from "./views.js";

/** A number and its noun. */
const counted = (number, noun) => `${number.toLocaleString("en")} ${noun}${number === 1 ? "" : "s"}`;

/** The parts of a line that the program told, without the time. */
const parts = (told) => told.replace(/ \([\d.]+ s\)/, "").split(", ").filter(Boolean);

/** Of the points, and of each view that was made. */
export function statusOf({about, names, told, engine, made}) {
  const triangles =
    about.triangles ? counted(about.triangles, "triangle")
    : about.points < 3 ? "too few for a triangle"
    : "no triangle: they are on a line, or nothing is inside";
  const known = new Set(parts(told));
  const others = [...made].map(([name, {told, count}]) => {
    const more = parts(told).filter((part) => !known.has(part));
    if (name === "contours") more.push(counted(count, "line"));
    if (name === "alpha") more.push(counted(count, "border"));
    return more.length ? `${views[name].title}: ${more.join(", ")}` : "";
  });
  return [`${listed(names)}: ${counted(about.points, "point")}, ${triangles}, ${(engine / 1000).toFixed(2)} s`, ...others].filter(Boolean).join(". ");
}

/** Notes and warnings of all that was made, each once, warnings first; and that degrees are no lengths. */
export function notesOf({notes, made, isGeographic}) {
  const all = [...notes, ...[...made.values()].flatMap(({notes}) => notes)].filter((note) => !/\.stage/.test(note));
  const warnings = all.filter((note) => note.startsWith("warning: "));
  const others = all.filter((note) => !note.startsWith("warning: "));
  if (isGeographic && (made.has("cells") || made.has("alpha") || made.has("graph"))) {
    others.push("Longitudes and latitudes are taken as coordinates of a plane, in degrees: project them first, if distances on the ground count");
  }
  const plain = (list) => [...new Set(list.map((note) => note.replace(/^(note|warning): /, "")))].join(". ");
  return {warning: plain(warnings), note: plain(others)};
}

/** Help of the program, where it names what a page has; other words of the command line say nothing here. */
export function helpOf({message = "", help = ""}) {
  if (/built without/.test(message)) return "The page has no SQLite: save the layer as GeoJSON or FlatGeobuf, or use the program on your machine.";
  if (/not a number|coordinate (NaN|inf)/i.test(message)) return "Rows without coordinates can be left out, and columns chosen, under “How the file is read”.";
  if (/--columns|column/.test(help)) return "Choose the columns under “How the file is read”.";
  if (/--from|points are read from/.test(help)) return "The extension of a file tells its format: rename it, or save it as CSV or GeoJSON first.";
  return /--|delone /.test(help) ? "" : help;
}
