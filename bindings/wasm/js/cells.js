// Clipped cells as the module gives them, and as arrays of points, which are made one by one when they are asked for.

/** So many points in a row have rings that are near each other; src/voronoi.rs lays them down so. */
const group = 4096;

/**
 * Rings in the order of their points. In the module those of a group of points lie together, in any order; the few that had no room there are
 * counted on beyond the others. Gives where each ring ends, and the corners.
 *
 * To be read ring by ring while arrays are made of them, corners have to lie in a row: else each ring is a miss of the cache, which takes
 * as long as its arrays.
 */
export function inOrder(spans, corners, others) {
  const [count, beyond] = [spans.length >> 1, corners.length >> 1];
  let total = 0;
  for (let k = 0; k < 2 * count; k += 2) total += spans[k + 1] - spans[k];
  const ends = new Int32Array(count);
  const ordered = new Float64Array(2 * total);
  let near = new Float64Array(0);
  let to = 0;
  for (let first = 0; first < count; first += group) {
    const last = Math.min(first + group, count);
    let [low, high] = [beyond, 0];
    for (let k = 2 * first; k < 2 * last; k += 2) {
      const [start, end] = [spans[k], spans[k + 1]];
      if (start === end || end > beyond) continue;
      low = Math.min(low, start);
      high = Math.max(high, end);
    }
    // A copy of what is together, as fast as memory, is near to all that is read from it.
    const together = corners.subarray(2 * low, 2 * Math.max(low, high));
    if (near.length < together.length) near = new Float64Array(together.length);
    near.set(together);
    for (let k = first; k < last; ++k) {
      const [start, end] = [2 * spans[2 * k], 2 * spans[2 * k + 1]];
      if (end > 2 * beyond) {
        for (let at = start; at < end; ++at) ordered[to++] = others[at - 2 * beyond];
      } else {
        for (let at = start; at < end; ++at) ordered[to++] = near[at - 2 * low];
      }
      ends[k] = to >> 1;
    }
  }
  return [ends, ordered];
}

export class Cells {
  #sites;
  #ends;
  #corners;

  /**
   * Rings one after the other: where each ends among the corners, whose coordinates are in a row; for each point of the module its first
   * ring and the end of its rings. Without these it has the one of its number.
   */
  constructor(ends, corners, sites) {
    this.#ends = ends;
    this.#corners = corners;
    this.#sites = sites;
  }

  /** All rings of a point. */
  rings(place) {
    const rings = [];
    for (let k = this.#sites[2 * place]; k < this.#sites[2 * place + 1]; ++k) rings.push(this.ring(k));
    return rings;
  }

  /** A ring, its last corner the first one again; null if it is empty or there is none. */
  ring(k) {
    const corners = this.#corners;
    const ends = this.#ends;
    const [start, end] = [k > 0 ? 2 * ends[k - 1] : 0, 2 * ends[k]];
    // Of no number nothing is true.
    if (!(start < end)) return null;
    const points = [];
    for (let at = start; at < end; at += 2) points.push([corners[at], corners[at + 1]]);
    points.push([corners[start], corners[start + 1]]);
    return points;
  }
}
