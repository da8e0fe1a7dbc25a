// Files of one's own: read, triangulated and drawn here; saved as GeoJSON or as a picture.

import {background} from "../background.js";
import {fit} from "../fit.js";
import {edgePainter} from "../lines.js";
import {read} from "../readers.js";
import {random} from "../random.js";
import {Stage, WIDTH, colors, dots, edges, strokePath} from "../stage.js";

export function data(section, tell) {
  const canvas = section.querySelector("canvas");
  const of = (name) => section.querySelector(`#data-${name}`);
  const worker = background();
  const paint = edgePainter();
  let made; // arrays of triangles, and the coordinates that they are of
  let shown; // those on the stage
  let latest = 0; // how often points were asked for
  const stage = new Stage(canvas, (context, color) => {
    if (!made) return;
    const {scale} = stage;
    const isMany = made.triangles.length > 30_000;
    if (isMany) paint(context, made, shown, {scale: stage.pixels, color: color.delaunay});
    else strokePath(context, edges(made, shown), color.delaunay, {scale});
    if (shown.length < 6000) dots(context, shown, color.ink, 2 / scale);
  });

  /** Shows points that `read` promises, unless others are asked for in the meantime. */
  async function open(name, read) {
    const turn = ++latest;
    worker.giveUp();
    try {
      tell(`Reading ${name} …`);
      const {coords} = await read();
      if (turn === latest) await take(name, coords);
    } catch (error) {
      if (turn === latest) tell(`${name} cannot be read: ${error.message}.`, true);
    }
  }

  async function take(name, coords) {
    const points = `${name}: ${(coords.length / 2).toLocaleString("en")} points`;
    tell(`${points}, triangulating …`);
    const result = await worker.run({task: "triangulate", coords}, [coords.buffer]);
    [made, shown] = [result, fit(result.coords, WIDTH, stage.height, 15)];
    const triangles = made.triangles.length / 3;
    tell(
      `${points}, ${triangles.toLocaleString("en")} triangles in ${made.ms.toFixed(0)} ms` +
        (triangles ? "." : ": they are on a line, or too few."),
    );
    for (const button of ["geojson", "picture"]) of(button).disabled = !triangles;
    stage.invalidate();
  }

  const openFile = (file) => open(file.name, () => read(file));
  of("file").addEventListener("change", () => of("file").files[0] && openFile(of("file").files[0]));
  for (const kind of ["dragenter", "dragover"]) {
    section.addEventListener(kind, (event) => {
      event.preventDefault();
      section.classList.add("dropping");
    });
  }
  for (const kind of ["dragleave", "drop"]) section.addEventListener(kind, () => section.classList.remove("dropping"));
  section.addEventListener("drop", (event) => {
    event.preventDefault();
    const [file] = event.dataTransfer.files;
    if (file) openFile(file);
    else tell("That was no file.", true);
  });
  // A file that misses the figure must not replace the page.
  for (const kind of ["dragover", "drop"]) addEventListener(kind, (event) => event.preventDefault());

  /** Towns along rivers: three random walks. */
  async function sample() {
    const next = random(77);
    const coords = [];
    for (let river = 0; river < 3; river++) {
      let [x, y, turn] = [next() * 10, next() * 6, next() * 6];
      for (let i = 0; i < 800; i++) {
        turn += (next() - 0.5) * 0.8;
        [x, y] = [x + Math.cos(turn) * 0.03, y + Math.sin(turn) * 0.03];
        coords.push(x + (next() - 0.5) * 0.2, y + (next() - 0.5) * 0.2);
      }
    }
    return {coords: Float64Array.from(coords)};
  }
  of("sample").addEventListener("click", () => open("The sample", sample));

  function save(name, blob) {
    const link = Object.assign(document.createElement("a"), {href: URL.createObjectURL(blob), download: name});
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }
  of("picture").addEventListener("click", () => {
    const sheet = document.createElement("canvas");
    [sheet.width, sheet.height] = [2 * WIDTH, Math.round(2 * stage.height)];
    const context = sheet.getContext("2d");
    const {paper, delaunay} = colors();
    context.fillStyle = paper;
    context.fillRect(0, 0, sheet.width, sheet.height);
    context.scale(2, 2);
    strokePath(context, edges(made, shown), delaunay, {scale: 2});
    sheet.toBlob((blob) => save("triangles.png", blob));
  });
  of("geojson").addEventListener("click", () => {
    const at = (i) => [made.coords[2 * i], made.coords[2 * i + 1]];
    const polygons = [];
    for (let t = 0; t < made.triangles.length; t += 3) {
      const [a, b, c] = made.triangles.subarray(t, t + 3);
      // The arrays have y down; GeoJSON goes counter-clockwise with y up.
      polygons.push([[at(a), at(c), at(b), at(a)]]);
    }
    const object = {type: "Feature", properties: {}, geometry: {type: "MultiPolygon", coordinates: polygons}};
    save("triangles.geojson", new Blob([JSON.stringify(object)], {type: "application/geo+json"}));
  });
}
