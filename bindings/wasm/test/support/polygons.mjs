// Polygons in doubles, for the definitions of cells.

/** What is left of a polygon where `f` is not negative; `f` is linear. */
export function half(polygon, f) {
  const kept = [];
  polygon.forEach((p, k) => {
    const q = polygon[(k + 1) % polygon.length];
    const [a, b] = [f(p), f(q)];
    if (a >= 0) kept.push(p);
    if (a * b < 0) kept.push([0, 1].map((axis) => p[axis] + ((q[axis] - p[axis]) * a) / (a - b)));
  });
  return kept;
}

/** The area inside, positive if the ring is counter-clockwise with y up. */
export const area = (ring) => ring.reduce((sum, [x, y], k) => {
  const [u, v] = ring[(k + 1) % ring.length];
  return sum + ((x - ring[0][0]) * (v - ring[0][1]) - (u - ring[0][0]) * (y - ring[0][1])) / 2;
}, 0);
