// The lines of Python and JavaScript that make what is seen.

import {isText} from "./rows.js";
import {outputOf, quoted, views, wordsOf} from "./views.js";

const text = (word) => JSON.stringify(word);
const extension = (name) => name.toLowerCase().replace(/\.gz$/, "").split(".").at(-1);
const FEATURES = ["geojson", "json", "shp", "fgb", "gpx"];

/** Rows of text by Python's own reader, which takes numbers as they are written. */
function pythonTable(name, [x, y, z], {hasHeading, sign, encoding, rows}) {
  const open = /\.gz$/i.test(name) ? ["import gzip", `with gzip.open(${text(name)}, "rt", encoding="${encoding}") as file:`] : [`with open(${text(name)}, encoding="${encoding}") as file:`];
  const isLoose = sign === " ";
  const separator = sign === "," ? "" : `, delimiter=${text(sign)}`;
  const lines = isLoose ? "[line.split() for line in file if line.strip() and not line.startswith(\"#\")]" : `list(csv.${hasHeading ? "DictReader" : "reader"}(file${separator}))`;
  const isDecimalComma = sign === ";" && rows.some((row) => row.some((cell) => /^-?\d+,\d+$/.test(cell)));
  const byName = hasHeading && !isLoose;
  const cell = (column, k) => {
    const at = byName && !/^\d+$/.test(column ?? "") ? text(column ?? "") : column && /^\d+$/.test(column) ? Number(column) - 1 : k;
    return `row[${at}]${isDecimalComma ? '.replace(",", ".")' : ""}`;
  };
  return [
    ...(isLoose ? [] : ["import csv"]),
    ...open,
    `    rows = ${lines}${isLoose && hasHeading ? "[1:]" : ""}`,
    `points = np.array([[${cell(x, 0)}, ${cell(y, 1)}] for row in rows], dtype=float)`,
    ...(z ? [`z = np.array([${cell(z, 2)} for row in rows], dtype=float)`] : []),
  ];
}

/** How Python reads a file: `points`, perhaps `z`, or `frame` of features. `columns` are those of x, y and perhaps z, as the program told. */
function pythonReading(name, {columns, isLines, head, about}, state) {
  const kind = extension(name);
  const {classes} = state.read;
  if (kind === "las" || kind === "laz") {
    const ground = classes ? [`cloud = cloud[np.isin(cloud.classification, [${classes}])]`] : [];
    return ["import laspy", `cloud = laspy.read(${text(name)})`, ...ground, "points, z = np.column_stack([cloud.x, cloud.y]), np.array(cloud.z)"];
  }
  const heights = about.heights ? ["z = table[:, 2]"] : [];
  if (kind === "npy") return [`table = np.load(${text(name)})`, "points = table[:, :2]", ...heights];
  if (FEATURES.includes(kind)) {
    const path = /\.gz$/i.test(name) ? text(`/vsigzip/${name}`) : text(name);
    const layer = kind === "gpx" ? ', layer="waypoints"' : "";
    const frame = ["import geopandas", `frame = geopandas.read_file(${path}${layer})`];
    const needsPoints = Object.keys(state.views).some((view) => !isLines || !["triangles", "mesh"].includes(view));
    return needsPoints ? [...frame, "points = frame.get_coordinates().to_numpy()"] : frame;
  }
  if (isText(name.replace(/\.gz$/i, ""))) return pythonTable(name, about.heights && !columns[2] ? [columns[0], columns[1], "3"] : columns, head);
  return ["import meshio", `table = meshio.read(${text(name)}).points`, "points = table[:, :2]", ...heights];
}

const python = {
  triangles: (_, isLines) => (isLines ? ["meshes = delone.triangulate_polygons(frame.geometry)"] : ["triangles = delone.Delaunay(points).simplices"]),
  cells: ({clip}, _, {read, box}) =>
    clip === "region"
      ? ["import geopandas", `area = geopandas.read_file(${text(read.region)}).union_all()`, "cells = delone.Voronoi(points).cells([np.array(ring.coords) for ring in [area.exterior, *area.interiors]])"]
      : [`cells = delone.Voronoi(points).cells(${clip === "hull" ? "points[delone.ConvexHull(points).vertices]" : `[${box.join(", ")}]`})`],
  hull: () => ["corners = delone.ConvexHull(points).vertices"],
  alpha: ({radius}) => ["shape = delone.AlphaComplex(points)", `outline = shape.outline(${radius ? `${radius} ** 2` : "shape.optimal_alpha()"})`],
  contours: ({interval}) => [`lines = delone.contours(points, z, interval=${interval})`],
  mesh: ({angle, area}, isLines) => [
    `made = delone.mesh(${isLines ? "frame.geometry" : "points"}${angle ? `, min_angle=${angle}` : ""}${area ? `, max_area=${area}` : ""})`,
    "made.points, made.triangles",
  ],
  graph: ({kind}) => [`graph = delone.${{"relative-neighbors": "relative_neighborhood_graph", "spanning-tree": "euclidean_minimum_spanning_tree"}[kind] ?? "gabriel_graph"}(points)`],
};

const javascript = {
  triangles: () => ["const {triangles} = d;"],
  cells: ({clip}) =>
    clip === "region" ? ["const cells = d.voronoi(bounds).clip(rings); // of your region"]
    : clip === "hull" ? ["const cells = d.voronoi(bounds).clip([d.hullPolygon()]);"] : ["const cells = [...d.voronoi(bounds).cellPolygons()];"],
  hull: () => ["const {hull} = d;"],
  contours: () => ["const lines = contours(d, heights, levels);"],
};

/** Levels of contours between heights, as the program takes them. */
function levelsOf(interval, [low, high]) {
  const first = Math.ceil(low / interval);
  const last = Math.floor(high / interval);
  return last - first < 40 ? `[${Array.from({length: Math.max(last - first + 1, 0)}, (_, k) => Number(((first + k) * interval).toPrecision(12))).join(", ")}]` : `... // multiples of ${interval}`;
}

/**
 * Commands, Python and JavaScript for the views that are shown: lines of text. `loaded` is what is on the stage; `chosen` has the formats that
 * views are to be saved as.
 */
export function snippets(state, loaded, chosen) {
  const {names, isLines, generated, about, step} = loaded;
  const shown = Object.keys(state.views).filter((name) => !views[name].heights || about.heights);
  const outputs = {ply: "ply", wkb: "geojson", npy: "csv", geojson: "geojson"};
  const commands = shown.map((name) => {
    const words = wordsOf(name, name === "contours" ? {...state.views[name], interval: state.views[name].interval || step} : state.views[name], names, state.read);
    return ["delone", ...words, "-o", outputOf(name, chosen[name] || outputs[views[name].format], names)].map(quoted).join(" ");
  });
  const make = generated ? [`delone ${generated.map(quoted).join(" ")}`] : [];
  const found = {...(state.read.region ? {clip: "region"} : {}), ...(step ? {interval: step} : {})};
  const isGiven = ([, value]) => value !== "";
  const optionsOf = (name) => ({...Object.fromEntries(views[name].options.map(({key, value}) => [key, value])), ...found, ...Object.fromEntries(Object.entries(state.views[name]).filter(isGiven))});
  const read = names.length === 1 ? pythonReading(names[0], loaded, state) : ["points = ...  # an array of shape (n, 2)"];
  const known = shown.filter((name) => javascript[name]);
  const others = shown.filter((name) => !javascript[name]).map((name) => `// ${views[name].title}: by the program or Python.`);
  const isFull = known.includes("contours") || (known.includes("cells") && optionsOf("cells").clip !== "box");
  const given = ["const points = [[0, 0], [1, 0], [0, 1]]; // yours"];
  if (known.includes("cells")) given.push(`const bounds = [${about.box.join(", ")}];`);
  if (known.includes("cells") && optionsOf("cells").clip === "region") given.push("const rings = [[[0, 0], [1, 0], [1, 1]]]; // yours");
  if (known.includes("contours") && about.heights) {
    given.push("const heights = [0, 1, 2]; // yours, one a point", `const levels = ${levelsOf(Number(optionsOf("contours").interval), about.heights)};`);
  }
  return {
    Command: [...make, ...commands],
    Python: ["import numpy as np", "import delone", ...read, ...shown.flatMap((name) => python[name](optionsOf(name), isLines, {read: state.read, box: about.box}))],
    JavaScript: [
      `import {${known.includes("contours") ? "Delaunay, contours" : "Delaunay"}} from "delone${isFull ? "/full" : ""}";`,
      ...given,
      "const d = Delaunay.from(points);",
      ...known.flatMap((name) => javascript[name](optionsOf(name))),
      ...others,
    ],
  };
}
