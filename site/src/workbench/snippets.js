// The lines of Python and JavaScript that make what is seen.

import {outputOf, quoted, views, wordsOf} from "./views.js";

const text = (word) => JSON.stringify(word);
const extension = (name) => name.toLowerCase().replace(/\.gz$/, "").split(".").at(-1);
const TABLES = {csv: ",", tsv: "\\t", txt: " ", xyz: " "};
const FEATURES = ["geojson", "json", "shp", "gpkg", "fgb"];

/** How Python reads a file: `points`, perhaps `z`, or `frame` of features. `columns` are those of x, y and perhaps z, as the program told. */
function pythonReading(name, columns, isLines, classes) {
  const kind = extension(name);
  if (kind === "las" || kind === "laz") {
    const ground = classes ? [`cloud = cloud[np.isin(cloud.classification, [${classes}])]`] : [];
    return ["import laspy", `cloud = laspy.read(${text(name)})`, ...ground, "points, z = np.column_stack([cloud.x, cloud.y]), np.array(cloud.z)"];
  }
  if (kind === "npy") return [`points = np.load(${text(name)})[:, :2]`];
  if (FEATURES.includes(kind)) {
    const open = ["import geopandas", `frame = geopandas.read_file(${text(name)})`];
    return isLines ? open : [...open, "points = np.column_stack([frame.geometry.x, frame.geometry.y])"];
  }
  if (kind in TABLES) {
    const [x, y, z] = columns;
    if (!x || /^\d+$/.test(x)) {
      const use = [x, y, z].filter(Boolean).map((column) => column - 1);
      const sign = TABLES[kind] === " " ? "" : `, delimiter="${TABLES[kind]}"`;
      return [`table = np.loadtxt(${text(name)}${sign})`, `points = table[:, ${use.length ? `[${use.slice(0, 2)}]` : ":2"}]`, ...(z ? [`z = table[:, ${use[2]}]`] : [])];
    }
    const read = ["import pandas", `table = pandas.read_csv(${text(name)}${kind === "csv" ? "" : `, sep="${TABLES[kind]}"`}, float_precision="round_trip")`];
    return [...read, `points = table[[${text(x)}, ${text(y)}]].to_numpy()`, ...(z ? [`z = table[${text(z)}].to_numpy()`] : [])];
  }
  return [`points = ...  # an array of shape (n, 2) from ${name}`];
}

const python = {
  triangles: (_, isLines) => (isLines ? ["meshes = delone.triangulate_polygons(frame.geometry)"] : ["triangles = delone.Delaunay(points).simplices"]),
  cells: ({clip}, _, {region}) =>
    clip === "region"
      ? ["import geopandas", `area = geopandas.read_file(${text(region)}).union_all()`, "cells = delone.Voronoi(points).cells([np.array(ring.coords) for ring in [area.exterior, *area.interiors]])"]
      : [`cells = delone.Voronoi(points).cells(${clip === "hull" ? "points[delone.ConvexHull(points).vertices]" : ""})`],
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
 * Commands, Python and JavaScript for the views that are shown: lines of text. `about` has the names of the files, what reading them needs, the
 * columns that were taken, and whether they hold lines.
 */
export function snippets(state, {names, columns, isLines, generated, about}) {
  const shown = Object.keys(state.views);
  const outputs = {ply: "ply", wkb: "geojson", npy: "csv", geojson: "geojson"};
  const commands = shown.map((name) => {
    const words = wordsOf(name, state.views[name], names, state.read);
    return ["delone", ...words, "-o", outputOf(name, outputs[views[name].format], names)].map(quoted).join(" ");
  });
  const make = generated ? [`delone ${generated.map(quoted).join(" ")}`] : [];
  const usual = state.read.region ? {clip: "region"} : {};
  const optionsOf = (name) => ({...Object.fromEntries(views[name].options.map(({key, value}) => [key, value])), ...usual, ...state.views[name]});
  const read = names.length === 1 ? pythonReading(names[0], columns, isLines, state.read.classes) : ["points = ...  # an array of shape (n, 2)"];
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
    Python: ["import numpy as np", "import delone", ...read, ...shown.flatMap((name) => python[name](optionsOf(name), isLines, state.read))],
    JavaScript: [
      `import {${known.includes("contours") ? "Delaunay, contours" : "Delaunay"}} from "delone${isFull ? "/full" : ""}";`,
      ...given,
      "const d = Delaunay.from(points);",
      ...known.flatMap((name) => javascript[name](optionsOf(name))),
      ...others,
    ],
  };
}
