// Points on one line, where a triangulation has no triangles: d3 answers by the order along the line, and so do we.

/** Points that miss a line by less than so many units in the last place of their coordinates are on it, as far as numbers can tell. */
const UNITS = 2 * 2 ** -52;

/**
 * Whether all points are as near to the line through two of them as the rounding of their coordinates: points that were meant to be on a
 * line. The triangulation itself is exact, and knows better.
 */
function isThin(points, isThere) {
  const [x, y] = [(i) => points[2 * i], (i) => points[2 * i + 1]];
  let [first, last, mostX, mostY] = [-1, -1, 0, 0];
  const isBefore = (i, j) => x(i) < x(j) || (x(i) === x(j) && y(i) < y(j));
  for (let i = 0; i < points.length >> 1; ++i) {
    if (!isThere(i)) continue;
    if (first < 0 || isBefore(i, first)) first = i;
    if (last < 0 || isBefore(last, i)) last = i;
    mostX = Math.max(mostX, Math.abs(x(i)));
    mostY = Math.max(mostY, Math.abs(y(i)));
  }
  // In parts of the longer one, so that products are in the range of coordinates, whatever these are.
  const length = Math.max(Math.abs(x(last) - x(first)), Math.abs(y(last) - y(first)));
  const [dx, dy] = [(x(last) - x(first)) / length, (y(last) - y(first)) / length];
  const most = UNITS * (Math.abs(dx) * mostY + Math.abs(dy) * mostX);
  for (let i = 0; i < points.length >> 1; ++i) {
    // Where this leaves the range of numbers it is not less.
    if (isThere(i) && !(Math.abs(dx * (y(i) - y(first)) - dy * (x(i) - x(first))) <= most)) return false;
  }
  return true;
}

/** All points in their order along a line, by x and then y; nothing unless three or more are on one. */
export function alongLine(arrays, points, isThere) {
  if (arrays.hull.length < 3 || (arrays.dimension === 2 && !isThin(points, isThere))) return undefined;
  const order = [];
  for (let i = 0; i < points.length >> 1; ++i) if (isThere(i)) order.push(i);
  order.sort((i, j) => points[2 * i] - points[2 * j] || points[2 * i + 1] - points[2 * j + 1]);
  return Int32Array.from(order);
}
