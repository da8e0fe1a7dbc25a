// Segments that are edges, and polygons to triangles. In the full module. Nothing stays in the module: there is nothing to dispose of.

import {DeloneError, shown} from "./errors.js";
import {flatCoordinates, flatRings, listed} from "./input.js";
import {currentEngine} from "./module.js";

const fills = ["all", "even-odd", "nonzero"];
const crossingNames = ["refuse", "split"];

/** The number of a choice. */
function chosen(names, name, what) {
  const number = names.indexOf(name);
  if (number < 0) throw new DeloneError("range", `there is no ${what} ${shown(name)}: ${names.join(", ")}`);
  return number;
}

/** Indices as the module takes them, of pairs or in a row. */
function indices(segments) {
  const all = Array.from(listed(segments ?? [], "segments are pairs of indices"));
  const isRow = all.every((i) => typeof i === "number");
  const pairs = isRow ? Array.from({length: Math.ceil(all.length / 2)}, (_, k) => all.slice(2 * k, 2 * k + 2)) : all;
  const isIndex = (i) => Number.isInteger(i) && i >= 0 && i < 2 ** 32;
  const flat = new Uint32Array(2 * pairs.length);
  pairs.forEach((pair, k) => {
    if (pair?.length !== 2 || !isIndex(pair[0]) || !isIndex(pair[1])) {
      throw new DeloneError("no-such-point", `segment ${k} does not have two indices of points for its ends`, k);
    }
    flat.set([pair[0], pair[1]], 2 * k);
  });
  return flat;
}

export class Constrained {
  /**
   * The constrained Delaunay triangulation of points (a flat array) and segments, pairs of indices. `fill` says which triangles are
   * inside: "all", "even-odd", "nonzero". Segments that cross are an error, or are split with `crossings: "split"`.
   */
  constructor(points, segments, options) {
    const {fill = "all", crossings = "refuse"} = options ?? {};
    const [number, isSplit] = [chosen(fills, fill, "fill"), chosen(crossingNames, crossings, "way with crossings")];
    const engine = currentEngine();
    engine.givePoints(flatCoordinates(points));
    engine.giveIndices(indices(segments));
    engine.call(undefined, "constrain", isSplit, number);
    /** Those given, then those where segments were split. */
    this.points = engine.floats(0);
    /** Corners of the triangles inside, three each, counter-clockwise with y down. */
    this.triangles = engine.ints(0);
    /** Constraint edges, two indices each. */
    this.constraints = engine.ints(1);
    engine.clear();
  }

  /** Triangles inside of rings, each an array of points: an odd number of rings is around them. */
  static polygon(rings, options) {
    const {flat, ends} = flatRings(rings);
    const segments = [];
    let first = 0;
    for (const end of ends) {
      for (let i = first; i < end; ++i) segments.push([i, i + 1 < end ? i + 1 : first]);
      first = end;
    }
    const {fill = "even-odd", crossings} = options ?? {};
    return new Constrained(flat, segments, {fill, crossings});
  }
}
