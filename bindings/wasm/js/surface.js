// Values between points: the surface over a triangulation with a value at each point. In the full module.

import {DeloneError} from "./errors.js";
import {flatCoordinates} from "./input.js";
import {planeOf} from "./plane.js";

const methods = ["linear", "sibson", "laplace"];

/**
 * Values at points, given as a flat array of coordinates. `method` is "linear", or natural neighbours by areas ("sibson") or by edges
 * ("laplace"); `outside` of the hull is NaN, or with "nearest" the value of the nearest point.
 */
export function interpolate(delaunay, values, points, {method = "linear", outside = undefined} = {}) {
  const number = methods.indexOf(method);
  if (number < 0) throw new DeloneError("range", `there is no method ${String(method)}: ${methods.join(", ")}`);
  return delaunay[planeOf].interpolate(values, flatCoordinates(points), number, outside === "nearest" ? 1 : 0);
}

/** Contour lines at levels, each with its `level`, whether it `isClosed`, and `points`. Higher values are on the left with y up. */
export function contours(delaunay, values, levels) {
  return delaunay[planeOf].contours(values, Array.from(levels, Number));
}
