// The Voronoi diagram with the names of d3-delaunay. Cells are the engine's own: dual to the exact triangulation, cut out of the bounds
// exactly, and only then rounded, to the same numbers from both sides of each edge. It is always that of the triangulation as it is.

import {Cells} from "./cells.js";
import {checkBounds, number} from "./input.js";
import {getters, own, shared} from "./own.js";
import {joinedTo, planeOf} from "./plane.js";
import {drawn, drawPolygon} from "./path.js";

/** Cells with so many corners are not made again for each neighbor. */
const INDEXED_RING = 32;

export class Voronoi {
  #made = {version: -1};

  /** Or by `delaunay.voronoi(bounds)`. */
  constructor(delaunay, bounds = [0, 0, 960, 500]) {
    this.delaunay = delaunay;
    own(this, copied);
    [this.xmin, this.ymin, this.xmax, this.ymax] = checkBounds(bounds);
  }

  /** Triangulates again, after points were changed in place. */
  update() {
    this.delaunay.update();
    return this;
  }

  get #bounds() {
    return checkBounds([this.xmin, this.ymin, this.xmax, this.ymax]);
  }

  /** What was made of the triangulation and the bounds as they are. */
  get #now() {
    const {version} = this.delaunay;
    const {xmin, ymin, xmax, ymax} = this;
    const made = this.#made;
    if (made.version === version && made.xmin === xmin && made.ymin === ymin && made.xmax === xmax && made.ymax === ymax) return made;
    return (this.#made = {version, xmin, ymin, xmax, ymax});
  }

  get #plane() {
    return this.delaunay[planeOf];
  }

  /** The cells; none in bounds without area. */
  get #cells() {
    const now = this.#now;
    if (now.cells) return now.cells;
    const isFlat = this.xmin === this.xmax || this.ymin === this.ymax;
    return (now.cells = isFlat ? new Cells([], []) : this.#plane.cells(this.#bounds));
  }

  /** The centers of the triangles' circles, two numbers each; infinite beyond the range of numbers. Undefined as arrays of a triangulation. */
  get circumcenters() {
    return this.#plane.isThere ? this.#centers : undefined;
  }

  get #centers() {
    return (this.#now.circumcenters ??= this.#plane.circumcenters());
  }

  /** For each point four numbers: the directions in which the first and the last edge of its cell leave, if it is on the hull. */
  get vectors() {
    const now = this.#now;
    const {hull, points} = this.delaunay;
    if (!hull || now.vectors) return now.vectors;
    const vectors = (now.vectors = new Float64Array(2 * (points.length & -2)));
    for (let k = 0; k < hull.length && hull.length > 1; ++k) {
      const [p, q] = [hull[(k || hull.length) - 1], hull[k]];
      const ray = [points[2 * p + 1] - points[2 * q + 1], points[2 * q] - points[2 * p]];
      vectors.set(ray, 4 * p + 2);
      vectors.set(ray, 4 * q);
    }
    return vectors;
  }

  /** Whether a point is in the cell of another one, its border included. Exact. */
  contains(i, x, y) {
    [x, y] = [number(x), number(y)];
    return Number.isFinite(x) && Number.isFinite(y) && this.#plane.isNearest(i, x, y);
  }

  /** The corners of a cell, without the first one repeated. */
  #ring(i) {
    return this.cellPolygon(i)?.slice(0, -1) ?? [];
  }

  /** The points whose cells have an edge with that of a point inside the bounds. */
  *neighbors(i) {
    const cell = this.#cell(i);
    if (!cell.ring.length) return;
    for (const j of this.delaunay[joinedTo](i)) if (touch(cell, this.#cell(j))) yield j;
  }

  /** A cell; one with many corners, which many ask about, is kept with the names of its sides. */
  #cell(i) {
    const large = (this.#now.large ??= new Map());
    const known = large.get(i);
    if (known) return known;
    const ring = this.#ring(i);
    if (ring.length < INDEXED_RING) return {ring};
    const cell = {ring, names: new Set(ring.map((p, k) => `${p},${after(ring, k)}`))};
    large.set(i, cell);
    return cell;
  }

  /** A cell as a closed ring; null if it is empty or there is none. */
  cellPolygon(i) {
    return this.#cells.ring(this.#plane.place(i));
  }

  /** The cells that are not empty, each with its `index`: of the triangulation as it is when the first one is asked for. */
  *cellPolygons() {
    const count = this.delaunay.points.length >> 1;
    const [cells, plane] = [this.#cells, this.#plane];
    for (let i = 0; i < count; ++i) {
      const polygon = cells.ring(plane.place(i));
      if (!polygon) continue;
      polygon.index = i;
      yield polygon;
    }
  }

  renderCell(i, context) {
    const ring = this.#ring(i);
    return ring.length ? drawn(context, (context) => drawPolygon(context, ring)) : undefined;
  }

  /** Draws the edges between cells, each once. */
  render(context) {
    if (this.#plane.engine && this.delaunay.hull.length <= 1) return null;
    return drawn(context, (context) => {
      const count = this.delaunay.points.length >> 1;
      const isOnBounds = ([x, y], [u, v]) =>
        (x === u && (x === this.xmin || x === this.xmax)) || (y === v && (y === this.ymin || y === this.ymax));
      for (let i = 0; i < count; ++i) {
        const ring = this.#ring(i);
        ring.forEach((p, k) => {
          const q = ring[(k + 1) % ring.length];
          // The cell beyond has the same side the other way round: one of the two directions is drawn.
          if ((p[0] - q[0] || p[1] - q[1]) > 0 || isOnBounds(p, q)) return;
          context.moveTo(p[0], p[1]);
          context.lineTo(q[0], q[1]);
        });
      }
    });
  }

  renderBounds(context) {
    return drawn(context, (context) => context.rect(this.xmin, this.ymin, this.xmax - this.xmin, this.ymax - this.ymin));
  }

  // What d3 has not.

  /** As JSON has it; an infinite circumcenter is null there. */
  toJSON() {
    const {delaunay, xmin, ymin, xmax, ymax} = this;
    return {delaunay, xmin, ymin, xmax, ymax, ...shared(this, copied)};
  }

  get #measures() {
    return (this.#now.measures ??= this.#plane.measures(this.#bounds, this.delaunay.points));
  }

  /** The areas of all cells; zero where there is none. */
  areas() {
    // Zero, not minus zero.
    return this.#measures.areas.map((area) => area + 0);
  }

  /** A step of Lloyd's relaxation: where all points would move, each to the centroid of its cell. Those without a cell stay. */
  relax() {
    const moved = this.#measures.centroids.slice();
    const {duplicates} = this.delaunay;
    for (let k = 0; k < duplicates.length; k += 2) {
      moved.copyWithin(2 * duplicates[k], 2 * duplicates[k + 1], 2 * duplicates[k + 1] + 2);
    }
    return moved;
  }

  /** Cells clipped to a polygon of rings: for each point an array of closed rings, holes clockwise with y up. In the full module. */
  clip(polygon) {
    const plane = this.#plane;
    const cells = plane.cellsInPolygon(polygon);
    return Array.from({length: this.delaunay.points.length >> 1}, (_, i) => cells.rings(plane.place(i)));
  }
}

/** Properties that copies have. */
const copied = getters(Voronoi, ["circumcenters", "vectors"]);

const after = (ring, k) => ring[(k + 1) % ring.length];

/** Whether two cells have a side in common: each has it the other way round, by the same numbers. */
function touch(a, b) {
  if (a.ring.length > b.ring.length) [a, b] = [b, a];
  const same = (p, q) => p[0] === q[0] && p[1] === q[1];
  return a.ring.some((p, k) => {
    const q = after(a.ring, k);
    return b.names ? b.names.has(`${q},${p}`) : b.ring.some((r, m) => same(r, q) && same(after(b.ring, m), p));
  });
}
