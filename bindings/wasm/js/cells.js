// Clipped cells as the module gives them, and as arrays of points, which are made one by one when they are asked for.

export class Cells {
  #sites;
  #spans;
  #corners;

  /**
   * For each ring where it starts and ends among the corners, whose coordinates are in a row; for each point of the module its first ring and
   * the end of its rings. Without these it has the one of its number.
   */
  constructor(spans, corners, sites) {
    this.#spans = spans;
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
    const [start, end] = [2 * this.#spans[2 * k], 2 * this.#spans[2 * k + 1]];
    // Of no number nothing is true.
    if (!(start < end)) return null;
    const points = [];
    for (let at = start; at < end; at += 2) points.push([corners[at], corners[at + 1]]);
    points.push([corners[start], corners[start + 1]]);
    return points;
  }
}
