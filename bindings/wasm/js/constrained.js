// Segments that are edges, and polygons to triangles. In the full module. Nothing stays in the module: there is nothing to dispose of.

import {DeloneError} from "./errors.js";
import {flatCoordinates} from "./input.js";
import {currentEngine} from "./module.js";

const fills = ["all", "even-odd", "nonzero"];

/** Indices as the module takes them. */
function indices(segments) {
  const flat = Array.from(segments ?? []).flat();
  const wrong = flat.findIndex((i) => !Number.isInteger(i) || i < 0 || i >= 2 ** 32);
  if (wrong >= 0 || flat.length % 2) {
    const k = wrong < 0 ? flat.length - 1 : wrong;
    throw new DeloneError("no-such-point", `segment ${k >> 1} does not have two indices of points for its ends`, k >> 1);
  }
  return flat;
}

export class Constrained {
  /**
   * The constrained Delaunay triangulation of points (a flat array) and segments, pairs of indices. `fill` says which triangles are
   * inside: "all", "even-odd", "nonzero". Segments that cross are an error, or are split with `crossings: "split"`.
   */
  constructor(points, segments, {fill = "all", crossings = "refuse"} = {}) {
    const number = fills.indexOf(fill);
    if (number < 0) throw new DeloneError("range", `there is no fill ${String(fill)}: ${fills.join(", ")}`);
    const engine = currentEngine();
    engine.givePoints(flatCoordinates(points));
    engine.giveIndices(indices(segments));
    engine.call(undefined, "constrain", crossings === "split" ? 1 : 0, number);
    /** Those given, then those where segments were split. */
    this.points = engine.floats(0);
    /** Corners of the triangles inside, three each, counter-clockwise with y down. */
    this.triangles = engine.ints(0);
    /** Constraint edges, two indices each. */
    this.constraints = engine.ints(1);
    engine.clear();
  }

  /** Triangles inside of rings, each an array of points: an odd number of rings is around them. */
  static polygon(rings, {fill = "even-odd", crossings = "refuse"} = {}) {
    const points = [];
    const segments = [];
    for (const ring of rings) {
      const first = points.length;
      points.push(...ring);
      ring.forEach((_, k) => segments.push([first + k, first + ((k + 1) % ring.length)]));
    }
    return new Constrained(points.flat(), segments, {fill, crossings});
  }
}
