// The views of the workbench: each is a command of the program with options, for the stage and for files to take away.

/** The choice of cells that are cut by the polygons of a file. */
const REGION = "region";

/** Options by kind: a choice, a number, or a slider over powers of ten. */
const number = (key, label, flag, more = {}) => ({key, label, flag, kind: "number", value: "", ...more});
const choice = (key, label, flag, choices, value = choices[0]) => ({key, label, flag, kind: "choice", choices, value});

/**
 * `format` is what the stage reads; `command` the command of the program. `heights`: whether points without heights have nothing to show.
 * Styles are names of colors, widths in pixels, and how much of what is below is hidden.
 */
export const views = {
  triangles: {
    title: "Triangles",
    command: "triangulate",
    format: "ply",
    style: {color: "delaunay", wide: 1, alpha: 0.8},
    options: [],
    crossings: true,
  },
  cells: {
    title: "Voronoi cells",
    command: "voronoi",
    format: "wkb",
    style: {color: "voronoi", wide: 1, alpha: 1},
    options: [choice("clip", "up to", "--clip", ["box", "hull", REGION])],
  },
  hull: {
    title: "Hull",
    command: "hull",
    format: "npy",
    style: {color: "hull", wide: 3, alpha: 1},
    options: [],
  },
  alpha: {
    title: "Alpha shape",
    command: "alpha",
    // Its borders; well-known binary has triangles.
    format: "geojson",
    isFilled: true,
    style: {color: "chosen", wide: 1.5, alpha: 1},
    options: [number("radius", "radius", "--radius", {slider: true})],
    otherwise: ["--optimal"],
  },
  contours: {
    title: "Contours",
    command: "contours",
    format: "geojson",
    heights: true,
    style: {color: "ink", wide: 1, alpha: 0.9},
    options: [number("interval", "every", "--interval")],
  },
  mesh: {
    title: "Mesh",
    command: "mesh",
    format: "ply",
    style: {color: "hull", wide: 1, alpha: 0.9},
    options: [number("angle", "least angle", "--min-angle", {min: 0, max: 34, step: 1, placeholder: "20", unit: "degrees"}), number("area", "largest area", "--max-area", {min: 0, placeholder: "any"})],
    crossings: true,
  },
  graph: {
    title: "Graph",
    command: "graph",
    format: "npy",
    style: {color: "chosen", wide: 2, alpha: 1},
    options: [choice("kind", "", "--kind", ["gabriel", "relative-neighbors", "spanning-tree"])],
  },
};

/** A step of contours that gives some twelve of them: 1, 2 or 5 of a power of ten. */
export function stepOf([low, high]) {
  const step = (high - low) / 12 || 1;
  const power = 10 ** Math.floor(Math.log10(step));
  return String(Number(([1, 2, 5, 10].find((part) => part * power >= step) * power).toPrecision(3)));
}

/** Views that go on with other points: with choices and angles, but without lengths and areas. */
export function carried(shown) {
  const isFree = ({kind, unit}) => kind === "choice" || unit === "degrees";
  const kept = ([name, given]) => [name, Object.fromEntries(views[name].options.filter(isFree).flatMap(({key}) => (given[key] ? [[key, given[key]]] : [])))];
  return Object.fromEntries(Object.entries(shown).filter(([name]) => !views[name].heights).map(kept));
}

/** Words of options that say how files are read. */
export function reading({columns, classes, epsg, missing}) {
  return [
    ...(columns ? ["--columns", columns] : []),
    ...(classes ? ["--class", classes] : []),
    ...(epsg ? ["--epsg", epsg] : []),
    ...(missing ? ["--skip-missing"] : []),
  ];
}

/** The words of a view's command, without what it writes. `given` are its options, `read` those of the files. */
export function wordsOf(name, given, names, read) {
  const {command, options, otherwise = [], crossings} = views[name];
  const set = options.flatMap(({key, flag, value}) => {
    const now = given[key] ?? (key === "clip" && read.region ? REGION : value);
    if (now === REGION) return [flag, read.region || options[0].value];
    return now === "" ? [] : [flag, String(now)];
  });
  const split = crossings && read.crossings ? ["--crossings", read.crossings] : [];
  return [command, ...names, ...reading(read), ...(set.length ? set : otherwise), ...split];
}

/** What a saved view is called: a name that no file of the visitor has. */
export function outputOf(name, format, names) {
  let base = name;
  while (names.includes(`${base}.${format}`)) base += "-new";
  return `${base}.${format}`;
}

/** A word as shells take it. */
export const quoted = (word) => (/^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

