// Values between points: the surface over a triangulation with a value at each point. In the full module.

import {DeloneError, shown} from "./errors.js";
import {flatCoordinates, listed, number} from "./input.js";
import {planeOf} from "./plane.js";

const methods = ["linear", "sibson", "laplace"];

/**
 * Values at points, given as a flat array of coordinates. `method` is "linear", or natural neighbours by areas ("sibson") or by edges
 * ("laplace"); `outside` of the hull is NaN, or with "nearest" the value of the nearest point.
 */
export function interpolate(delaunay, values, points, options) {
  const {method = "linear", outside} = options ?? {};
  const way = methods.indexOf(method);
  if (way < 0) throw new DeloneError("range", `there is no method ${shown(method)}: ${methods.join(", ")}`);
  const flat = flatCoordinates(points);
  const wrong = flat.findIndex((x) => !Number.isFinite(x));
  if (wrong >= 0 && wrong < (flat.length & -2)) {
    throw new DeloneError("not-finite", `query ${wrong >> 1} has a coordinate that is not finite`, wrong >> 1);
  }
  return planeOfTriangulation(delaunay).interpolate(values, flat, way, outside === "nearest" ? 1 : 0);
}

/** Contour lines at levels, each with its `level`, whether it `isClosed`, and `points`. Higher values are on the left with y up. */
export function contours(delaunay, values, levels) {
  const heights = Array.from(listed(levels, "levels are an array of numbers"), number);
  return planeOfTriangulation(delaunay).contours(values, heights);
}

function planeOfTriangulation(delaunay) {
  const plane = delaunay?.[planeOf];
  if (!plane) throw new DeloneError("input", "there is no triangulation: the first argument is a Delaunay");
  return plane;
}
