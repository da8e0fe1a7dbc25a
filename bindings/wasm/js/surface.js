// Values between points: the surface over a triangulation with a value at each point. In the full module.

import {DeloneError, shown} from "./errors.js";
import {flatCoordinates, listed, number} from "./input.js";
import {planeOf} from "./plane.js";

const methods = ["linear", "sibson", "laplace"];
const outsides = [undefined, "nearest", "hull"];

/**
 * Values at points, given as a flat array of coordinates. `method` is "linear", or natural neighbors by areas ("sibson") or by edges
 * ("laplace"); `outside` of the hull is NaN, or with "nearest" the value of the nearest point, with "hull" that at the nearest place of the
 * hull, which goes on without steps.
 */
export function interpolate(delaunay, values, points, options) {
  const {method = "linear", outside} = options ?? {};
  const way = methods.indexOf(method);
  if (way < 0) throw new DeloneError("range", `there is no method ${shown(method)}: ${methods.join(", ")}`);
  const beyond = outsides.indexOf(outside);
  if (beyond < 0) throw new DeloneError("range", `outside of the hull there is no ${shown(outside)}: nearest, hull`);
  const flat = flatCoordinates(points);
  const wrong = flat.findIndex((x) => !Number.isFinite(x));
  if (wrong >= 0 && wrong < (flat.length & -2)) {
    throw new DeloneError("not-finite", `query ${wrong >> 1} has a coordinate that is not finite`, wrong >> 1);
  }
  return planeOfTriangulation(delaunay).interpolate(values, flat, way, beyond);
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
