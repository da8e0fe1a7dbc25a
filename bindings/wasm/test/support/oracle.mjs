// The judge: integers of any size, and none of the package's code. Doubles are integers times a power of two, so whole sets become
// integers without rounding.

import assert from "node:assert/strict";

const bits = new DataView(new ArrayBuffer(8));

/** A finite double as an integer times 2 to the power -1074. */
function integer(x) {
  bits.setFloat64(0, x);
  const word = bits.getBigUint64(0);
  const exponent = Number((word >> 52n) & 0x7ffn);
  const fraction = word & 0xfffffffffffffn;
  const value = exponent ? (fraction | 0x10000000000000n) << BigInt(exponent - 1) : fraction;
  return word >> 63n ? -value : value;
}

/** Points as pairs of integers on one scale, as small as may be. */
export function exact(flat) {
  const all = Array.from(flat.slice(0, flat.length & -2), integer);
  let common = 0n;
  for (const value of all) common |= value;
  let shift = 0n;
  if (common) while (!((common >> shift) & 1n)) ++shift;
  return Array.from({length: all.length / 2}, (_, i) => [all[2 * i] >> shift, all[2 * i + 1] >> shift]);
}

/** Positive if three points turn counter-clockwise with y up. */
export const turn = ([ax, ay], [bx, by], [cx, cy]) => (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);

/** Positive if the fourth point is inside of the circle through three that turn counter-clockwise with y up. */
export function inCircle(a, b, c, d) {
  const rows = [a, b, c].map(([x, y]) => [x - d[0], y - d[1]]);
  const lift = rows.map(([x, y]) => x * x + y * y);
  const minor = (i, j) => rows[i][0] * rows[j][1] - rows[i][1] * rows[j][0];
  return lift[0] * minor(1, 2) - lift[1] * minor(0, 2) + lift[2] * minor(0, 1);
}

export const squared = ([ax, ay], [bx, by]) => (ax - bx) ** 2n + (ay - by) ** 2n;

/** Proves arrays in the conventions of delaunator to be a Delaunay triangulation of points, of which some may be left out. */
export function prove(arrays, flat, isThere = () => true) {
  const {hull} = arrays;
  // Of one or two points d3 has three numbers that are no triangle.
  const [triangles, halfedges] = hull.length > 2 ? [arrays.triangles, arrays.halfedges] : [[], []];
  const points = exact(Array.from(flat, (x) => (Number.isFinite(x) ? x : 0)));
  const distinct = new Map();
  points.forEach((p, i) => isThere(i) && !distinct.has(String(p)) && distinct.set(String(p), i));
  const used = new Set([...triangles, ...hull]);
  assert.equal(used.size, distinct.size, "every point that is no duplicate is a vertex");
  const at = (e) => points[triangles[e]];
  const next = (e) => (e % 3 === 2 ? e - 2 : e + 1);
  assert.equal(halfedges.length, triangles.length);
  const isFlat = triangles.length === 0;
  if (isFlat) {
    for (let k = 2; k < hull.length; ++k) assert.equal(turn(points[hull[0]], points[hull[1]], points[hull[k]]), 0n, "a line");
    assert.equal(hull.length, distinct.size);
    return;
  }
  assert.equal(triangles.length / 3, 2 * distinct.size - 2 - hull.length, "Euler's relation");
  let area = 0n;
  let border = 0;
  for (let e = 0; e < triangles.length; ++e) {
    if (e % 3 === 0) {
      const twice = turn(at(e), at(e + 1), at(e + 2));
      assert.ok(twice < 0n, `triangle ${e / 3} is counter-clockwise with y down`);
      area -= twice;
    }
    const twin = halfedges[e];
    if (twin === -1) {
      ++border;
      continue;
    }
    assert.equal(halfedges[twin], e, "twins are mutual");
    assert.equal(triangles[e], triangles[next(twin)], "twins run along each other");
    assert.ok(inCircle(at(next(e)), at(e), at(next(next(e))), at(next(next(twin)))) <= 0n, "an empty circle");
  }
  assert.equal(border, hull.length);
  let around = 0n;
  hull.forEach((i, k) => {
    const [p, q, r] = [i, hull[(k + 1) % hull.length], hull[(k + 2) % hull.length]].map((i) => points[i]);
    assert.ok(turn(p, q, r) <= 0n, "the hull is convex");
    around -= p[0] * q[1] - p[1] * q[0];
  });
  assert.equal(area, around, "triangles fill the hull");
}

/** Triangles as a set: each from its least corner on, all sorted. */
export function triangleSet(triangles) {
  const set = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [...triangles.subarray(t, t + 3)];
    const least = corners.indexOf(Math.min(...corners));
    set.push([...corners.slice(least), ...corners.slice(0, least)].join());
  }
  return set.sort();
}

/** A ring up to where it starts; `null` stays. */
export function ring(polygon) {
  if (!polygon) return polygon;
  assert.deepEqual(polygon[0], polygon[polygon.length - 1], "a ring is closed");
  const points = polygon.slice(0, -1).map((p) => p.join());
  const turned = points.map((_, k) => [...points.slice(k), ...points.slice(0, k)].join(" "));
  return turned.sort()[0];
}

/** The text of a path of one polygon as a ring. */
export function ringOf(path) {
  assert.match(path, /^M[^MZ]*Z$/);
  const points = path.slice(1, -1).split("L").map((p) => p.split(",").map(Number));
  return ring([...points, points[0]]);
}
