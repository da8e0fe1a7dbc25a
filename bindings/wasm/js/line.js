// Points on one line, where a triangulation has no triangles: d3 answers by the order along the line, and so do we.

/** Points that miss a line by less than so many units in the last place of their coordinates are on it, as far as numbers can tell. */
const UNITS = 8 * 2 ** -52;

/**
 * Whether no triangle is wider than the rounding of its coordinates: points that were meant to be on a line. The triangulation itself is
 * exact, and knows better. O(1) for points that are not, as the first triangle tells.
 */
function isThin({triangles}, points) {
  let largest = 0;
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  let measured = false;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [2 * triangles[t], 2 * triangles[t + 1], 2 * triangles[t + 2]];
    const cross = (points[c] - points[a]) * (points[b + 1] - points[a + 1]) - (points[b] - points[a]) * (points[c + 1] - points[a + 1]);
    if (!measured) {
      measured = true;
      for (let i = 0; i + 1 < points.length; i += 2) {
        const [x, y] = [points[i], points[i + 1]];
        if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
        largest = Math.max(largest, Math.abs(x), Math.abs(y));
        [x0, y0, x1, y1] = [Math.min(x0, x), Math.min(y0, y), Math.max(x1, x), Math.max(y1, y)];
      }
    }
    // Where this leaves the range of numbers it is not less.
    if (!(Math.abs(cross) < UNITS * largest * (x1 - x0 + (y1 - y0)))) return false;
  }
  return true;
}

/** All points in their order along a line, by x and then y; nothing unless three or more are on one. */
export function alongLine(arrays, points, isThere) {
  if (arrays.hull.length < 3 || (arrays.dimension === 2 && !isThin(arrays, points))) return undefined;
  const order = [];
  for (let i = 0; i < points.length >> 1; ++i) if (isThere(i)) order.push(i);
  order.sort((i, j) => points[2 * i] - points[2 * j] || points[2 * i + 1] - points[2 * j + 1]);
  return Int32Array.from(order);
}
