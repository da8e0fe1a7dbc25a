// The triangulation with the names and conventions of d3-delaunay, and what the engine can do beyond.
//
// The arrays are made when first read, and again after a change. Points are never moved, and never copied unless they change by
// `insert` or `move`.

import {absentees, checkIndex, checkNumber, flatCoordinates, flattened, listed, number, pointX, pointY, takeOptions} from "./input.js";
import {alongLine} from "./line.js";
import {getters, own, shared} from "./own.js";
import {closed, drawn, drawPolygon} from "./path.js";
import {joinedTo, Plane, planeOf} from "./plane.js";
import {Voronoi} from "./voronoi.js";

const next = (e) => (e % 3 === 2 ? e - 2 : e + 1);

export class Delaunay {
  #plane;
  #options;
  #arrays;
  /** Points that were removed, and those that equalled them; an update does not bring them back. */
  #removed = new Set();
  /** For each point with points that equal it these, since the last update. */
  #equals;
  /** The points that we know, to see when they are others. */
  #known;
  /** Our own copy of the points once they changed here, with room for more. */
  #own;
  #version = 0;

  /** Of an array, an iterable or `{length}`; `fx` and `fy` give coordinates: `fx(point, index, points)`. */
  static from(points, ...rest) {
    const options = takeOptions(rest);
    const [fx = pointX, fy = pointY, that] = rest;
    return new Delaunay(flattened(points, fx, fy, that), options);
  }

  /**
   * Of a copy of a triangulation by `JSON.parse`, `structuredClone`, a message or a spread. Its points are triangulated again, without those
   * that were removed; its other arrays are not read.
   */
  static fromJSON(copy, options = {}) {
    const flat = flatCoordinates(copy?.points);
    const delaunay = new Delaunay([], options);
    delaunay.points = delaunay.#known = flat === copy.points ? flat.slice() : flat;
    const removed = listed(copy.removed ?? [], "the removed points are an array of indices");
    delaunay.#removed = new Set(Array.from(removed, (i) => checkIndex(i, flat.length >> 1)));
    return delaunay.update();
  }

  /** Of a flat array of coordinates, which is kept and not copied. Of an odd number the last one is ignored. */
  constructor(points, options = {}) {
    this.points = points;
    this.#options = options;
    own(this, copied);
    this.update();
  }

  /** Triangulates again, after points were changed in place, or are another array: of that all are there. */
  update() {
    const flat = flatCoordinates(this.points);
    const removed = this.points === this.#known ? this.#removed : new Set();
    const plane = new Plane(flat, absentees(flat, this.#options, removed.size ? removed : undefined));
    this.#plane?.dispose();
    [this.#plane, this.#removed, this.#known, this.#equals] = [plane, removed, this.points, undefined];
    this.#changed();
    return this;
  }

  /**
   * Gives the module's memory back. Arrays are undefined then: tools that look at all properties, as React does, are not to meet errors. All else
   * that needs the module throws. It also happens when nobody refers to this object any more.
   */
  dispose() {
    this.#plane.dispose();
    this.#changed();
  }

  /** What counts changes, for those that keep something of a triangulation. */
  get version() {
    return this.#version;
  }

  #changed() {
    ++this.#version;
    this.#arrays = undefined;
  }

  get #now() {
    return (this.#arrays ??= this.#plane.arrays());
  }

  /** The same, and nothing after the triangulation was disposed of. */
  get #left() {
    return this.#arrays ?? (this.#plane.isThere ? this.#now : undefined);
  }

  /** Corners of triangles, three each. Of one or two distinct points three numbers, as in d3. */
  get triangles() {
    const now = this.#left;
    if (!now) return undefined;
    const {hull, triangles} = now;
    if (hull.length === 0 || hull.length > 2) return triangles;
    return (now.few ??= Int32Array.of(hull[0], hull[1] ?? -1, hull[1] ?? -1));
  }

  /** For each half-edge its twin, or -1. */
  get halfedges() {
    const now = this.#left;
    if (!now) return undefined;
    const {hull, halfedges} = now;
    if (hull.length === 0 || hull.length > 2) return halfedges;
    return (now.none ??= Int32Array.of(-1, -1, -1));
  }

  /** The hull, counter-clockwise with y down; of points on a line those from end to end. */
  get hull() {
    return this.#left?.hull;
  }

  /** For each point a half-edge that comes in, on the hull that from outside; -1 for what is no vertex. */
  get inedges() {
    const now = this.#left;
    if (!now || now.inedges) return now?.inedges;
    const inedges = (now.inedges = new Int32Array(this.points.length >> 1).fill(-1));
    const {triangles, halfedges, hull} = now;
    for (let e = 0; e < halfedges.length; ++e) {
      const p = triangles[next(e)];
      if (halfedges[e] === -1 || inedges[p] === -1) inedges[p] = e;
    }
    if (hull.length && hull.length <= 2) {
      inedges[hull[0]] = 1;
      if (hull.length === 2) inedges[hull[1]] = 0;
    }
    return inedges;
  }

  /** If three or more distinct points are all on a line: all points along it. Else undefined. */
  get collinear() {
    const now = this.#left;
    if (now && !("collinear" in now)) now.collinear = alongLine(now, this.points, (i) => this.#plane.place(i) >= 0 && !this.#removed.has(i));
    return now?.collinear;
  }

  /** Pairs in a row: a point that is no vertex, and the earlier one that it equals. */
  get duplicates() {
    return (this.#now.duplicates ??= this.#plane.duplicates());
  }

  /** The points that were removed, and those that equalled them. */
  get removed() {
    return Uint32Array.from(this.#removed).sort();
  }

  /** The arrays as JSON has them; a coordinate that is not finite is null there. */
  toJSON() {
    const {points} = this;
    return {points: Array.from({length: points.length}, (_, k) => points[k]), ...shared(this, copied)};
  }

  /** The neighbors of a point, around it; on a line the one before and the one after. */
  *neighbors(i) {
    const {collinear} = this;
    if (collinear) {
      const ranks = (this.#now.ranks ??= ranked(collinear, this.points.length >> 1));
      const rank = ranks[i];
      if (rank > 0) yield collinear[rank - 1];
      if (rank >= 0 && rank < collinear.length - 1) yield collinear[rank + 1];
      return;
    }
    yield* this[joinedTo](i);
  }

  /** The vertices that a vertex is joined to: also where rounding made points of a line no line, and none for points that equal others. */
  *[joinedTo](i) {
    const now = this.#now;
    const {hull, halfedges, triangles} = now;
    if (now.dimension < 2) {
      const rank = (now.alongHull ??= ranked(hull, this.points.length >> 1))[i];
      if (rank > 0) yield hull[rank - 1];
      if (rank >= 0 && rank < hull.length - 1) yield hull[rank + 1];
      return;
    }
    const first = this.inedges[i] ?? -1;
    let e = first;
    if (e === -1 || triangles.length === 0) return;
    do {
      yield triangles[e];
      const out = next(e);
      e = halfedges[out];
      // The last triangle of a point on the hull: its far corner is beyond.
      if (e === -1) return yield triangles[next(out)];
    } while (e !== first);
  }

  /** The nearest point, exactly: of equally near ones the least by x, then y. -1 for no point, and for what is not finite. */
  find(x, y) {
    [x, y] = [number(x), number(y)];
    return Number.isFinite(x) && Number.isFinite(y) ? this.#plane.nearest(x, y) : -1;
  }

  /** The Voronoi diagram in a rectangle. */
  voronoi(bounds) {
    return new Voronoi(this, bounds);
  }

  /** For what is made of a triangulation: the one behind. */
  get [planeOf]() {
    return this.#plane;
  }

  // Drawing.

  render(context) {
    return drawn(context, (context) => {
      const {triangles, halfedges, hull} = this.#now;
      for (let e = 0; e < halfedges.length; ++e) if (halfedges[e] > e) this.#segment(context, triangles[e], triangles[next(e)]);
      if (hull.length) this.renderHull(context);
    });
  }

  #segment(context, i, j) {
    const {points} = this;
    context.moveTo(points[2 * i], points[2 * i + 1]);
    context.lineTo(points[2 * j], points[2 * j + 1]);
  }

  #polygon(indices) {
    return Array.from(indices, (i) => [this.points[2 * i], this.points[2 * i + 1]]);
  }

  renderHull(context) {
    return drawn(context, (context) => drawPolygon(context, this.#polygon(this.#now.hull)));
  }

  renderTriangle(i, context) {
    return drawn(context, (context) => drawPolygon(context, this.#polygon(this.#corners(i))));
  }

  /** The radius may come first, as in d3. */
  renderPoints(context, r) {
    if (r === undefined && typeof context?.moveTo !== "function") [context, r] = [null, context];
    r = r == null ? 2 : number(r);
    return drawn(context, (context) => {
      const {points} = this;
      for (let i = 0; i < points.length >> 1; ++i) {
        const [x, y] = [points[2 * i], points[2 * i + 1]];
        if (this.#plane.place(i) < 0 || this.#removed.has(i)) continue;
        context.moveTo(x + r, y);
        context.arc(x, y, r, 0, 2 * Math.PI);
      }
    });
  }

  #corners(i) {
    return this.#now && Number.isInteger(i) && i >= 0 ? this.triangles.subarray(3 * i, 3 * i + 3) : [];
  }

  hullPolygon() {
    return closed(this.#polygon(this.#now.hull));
  }

  trianglePolygon(i) {
    return closed(this.#polygon(this.#corners(i)));
  }

  *trianglePolygons() {
    for (let i = 0; 3 * i < this.#now.triangles.length; ++i) yield this.trianglePolygon(i);
  }

  // What d3 has not.

  /** Inserts a point, and returns its index: a new one, or that of the point that is there. */
  insert(x, y) {
    const at = [checkNumber(x, "x"), checkNumber(y, "y")];
    const count = this.points.length >> 1;
    const i = this.#plane.insert(...at);
    if (i === count) this.#store(i, at);
    this.#changed();
    return i;
  }

  /** Removes a point; the others keep their indices. Points that equal it go with it. */
  remove(i) {
    const gone = [i, ...this.#equalTo(i)];
    this.#plane.remove(i);
    gone.forEach((j) => this.#removed.add(j));
    this.#changed();
  }

  /** Moves a point, which keeps its index. Points that equalled it are removed. */
  move(i, x, y) {
    const at = [checkNumber(x, "x"), checkNumber(y, "y")];
    const gone = this.#equalTo(i);
    this.#plane.move(i, ...at);
    // Where it is already it stays, and they do.
    if (at[0] !== this.points[2 * i] || at[1] !== this.points[2 * i + 1]) {
      gone.forEach((j) => this.#removed.add(j));
      this.#equals.delete(i);
    }
    this.#store(i, at);
    this.#changed();
  }

  /** The points that equal one and are no vertices for that. */
  #equalTo(i) {
    if (!this.#equals) {
      this.#equals = new Map();
      // Not ours, which are kept with all arrays: a change makes none.
      const duplicates = this.#plane.duplicates();
      for (let k = 0; k < duplicates.length; k += 2) {
        const [point, vertex] = [duplicates[k], duplicates[k + 1]];
        this.#equals.get(vertex)?.push(point) ?? this.#equals.set(vertex, [point]);
      }
    }
    return this.#equals.get(i) ?? [];
  }

  /** Writes a point into our own copy of all. */
  #store(i, at) {
    const {points} = this;
    const count = Math.max(points.length >> 1, i + 1);
    if (!this.#own || this.#own.buffer !== points.buffer || this.#own.length < 2 * count) {
      const own = new Float64Array(Math.max(2 * count, 16) * (i + 1 === count ? 2 : 1));
      own.set(points.length % 2 ? Array.prototype.slice.call(points, 0, -1) : points);
      this.#own = own;
    }
    this.#own.set(at, 2 * i);
    this.#known = this.points = this.#own.subarray(0, 2 * count);
  }

  /** The same as `find`, and an error for what is not finite. */
  nearest(x, y) {
    return this.#plane.nearest(checkNumber(x, "x"), checkNumber(y, "y"));
  }

  /** The k nearest points, nearest first. */
  kNearest(x, y, k) {
    return this.#plane.kNearest(checkNumber(x, "x"), checkNumber(y, "y"), Math.max(0, Math.min(checkNumber(k, "k"), 2 ** 31 - 1)));
  }

  /** The points at most so far away, by increasing index. */
  within(x, y, radius) {
    return this.#plane.within(checkNumber(x, "x"), checkNumber(y, "y"), checkNumber(radius, "radius"));
  }

  /** Where a point falls: in a triangle, on an edge, on a vertex, outside. A `strategy` gives also the path that it took. */
  locate(x, y, options) {
    return this.#plane.locate(checkNumber(x, "x"), checkNumber(y, "y"), options?.strategy);
  }

  /** Proves that the triangulation is the canonical one, or throws. */
  check() {
    this.#plane.check();
  }
}

/** Properties that copies have. */
const copied = getters(Delaunay, ["halfedges", "hull", "triangles", "inedges", "collinear", "removed"]);

/** For each point its rank along a line; -1 for those not there. */
function ranked(order, count) {
  const ranks = new Int32Array(count).fill(-1);
  order.forEach((i, rank) => (ranks[i] = rank));
  return ranks;
}

if (Symbol.dispose) Delaunay.prototype[Symbol.dispose] = Delaunay.prototype.dispose;
