// A triangulation that lives in the module, known here by the user's indices.
//
// The module numbers the points that it was given. Where some were left out (not finite, removed) its numbers differ from the
// user's, and two tables translate; else there are none.
//
// Memory: what the module holds for a triangulation, some 100 bytes a point, goes when it is disposed of or when nobody refers to it any
// more and the garbage collector has found that out, which it does between tasks, not in a loop.

import {Cells, inOrder} from "./cells.js";
import {DeloneError, shown} from "./errors.js";
import {flatRings, numbers} from "./input.js";
import {currentEngine} from "./module.js";

const forgotten = new FinalizationRegistry(({engine, number}) => {
  if (!engine.isLost) engine.exports.forget(number);
});

/** The strategies of location, as src/locate.rs numbers them. */
const strategies = ["tree", "walk", "jump-and-walk", "hierarchy", "history"];
const kinds = ["triangle", "edge", "vertex", "outside", "none"];

/** The points that are there, and what the module's indices mean. */
function compress(flat, absent) {
  const count = absent.length;
  const given = [];
  const places = new Int32Array(count).fill(-1);
  const coords = new Float64Array(2 * count);
  for (let i = 0; i < count; ++i) {
    if (absent[i]) continue;
    places[i] = given.length;
    coords[2 * given.length] = flat[2 * i];
    coords[2 * given.length + 1] = flat[2 * i + 1];
    given.push(i);
  }
  return {coords: coords.subarray(0, 2 * given.length), given, places: Array.from(places)};
}

/** Arrays of points from coordinates in a row and where each polygon ends among them. */
function polygons(ends, coordinates) {
  return Array.from(ends, (end, k) => {
    const polygon = [];
    for (let at = k ? ends[k - 1] : 0; at < end; at += 2) polygon.push([coordinates[at], coordinates[at + 1]]);
    return polygon;
  });
}

/** Under this name a triangulation shows what it stands on, to the files here. */
export const planeOf = Symbol("plane");

/** Under this name it tells what a vertex is joined to. */
export const joinedTo = Symbol("joined");

export class Plane {
  #held;
  #given;
  #places;
  #count;

  /** Triangulates points; `absent` says which are left out. */
  constructor(flat, absent) {
    const engine = currentEngine();
    this.#count = flat.length >> 1;
    let coords = flat;
    if (absent) ({coords, given: this.#given, places: this.#places} = compress(flat, absent));
    engine.givePoints(coords, coords.length >> 1);
    this.#held = {engine, number: engine.call((i) => this.name(i), "triangulate")};
    forgotten.register(this, this.#held, this);
  }

  /** Gives the module's memory back. */
  dispose() {
    if (!this.#held) return;
    const {engine, number} = this.#held;
    forgotten.unregister(this);
    this.#held = undefined;
    if (!engine.isLost) engine.exports.forget(number);
  }

  /** Whether it was not disposed of. */
  get isThere() {
    return this.#held !== undefined;
  }

  get engine() {
    if (!this.#held) throw new DeloneError("disposed", "the triangulation was disposed of");
    return this.#held.engine;
  }

  /** Calls a function of the module about this triangulation. */
  call(f, ...args) {
    const {engine} = this;
    return engine.call((i) => this.name(i), f, this.#held.number, ...args);
  }

  /** The user's index of a point of the module. */
  name(i) {
    return this.#given ? this.#given[i] ?? i : i;
  }

  /** The module's index of a point of the user; -1 if it was left out or is none. */
  place(i) {
    if (!Number.isInteger(i) || i < 0 || i >= this.#count) return -1;
    return this.#places ? this.#places[i] : i;
  }

  /** The same, where it must be one. */
  vertex(i) {
    const place = this.place(i);
    if (place < 0) throw new DeloneError("no-such-point", `point ${shown(i)} is no vertex of this triangulation`, i);
    return place;
  }

  /** Indices by the user's names. */
  #named(indices) {
    if (this.#given) for (let k = 0; k < indices.length; ++k) indices[k] = this.#given[indices[k]];
    return indices;
  }

  /** Triangles, half-edges, hull, and what the points span: -1 nothing, 0 a point, 1 a line, 2 the plane. */
  arrays() {
    const dimension = this.call("arrays");
    const {engine} = this;
    const arrays = {
      dimension: dimension === 3 ? -1 : dimension,
      triangles: this.#named(engine.ints(0)),
      halfedges: engine.ints(1, Int32Array),
      hull: this.#named(engine.ints(2)),
    };
    engine.clear();
    return arrays;
  }

  /** Pairs: a point, and the earlier one that it equals. */
  duplicates() {
    this.call("duplicates");
    const pairs = this.#named(this.engine.ints(0));
    this.engine.clear();
    return pairs;
  }

  /** Inserts a point: the user's next one, unless there is a vertex. */
  insert(x, y) {
    const next = this.#given ? this.#given.length : this.#count;
    const place = this.call("insert", x, y);
    if (place !== next) return this.name(place);
    this.#given?.push(this.#count);
    this.#places?.push(place);
    return this.#count++;
  }

  remove(i) {
    this.call("remove", this.vertex(i));
  }

  move(i, x, y) {
    this.call("move_to", this.vertex(i), x, y);
  }

  check() {
    this.call("check");
  }

  /** The nearest vertex; -1 if there is none. */
  nearest(x, y) {
    const place = this.call("nearest", x, y);
    return place < 0 ? -1 : this.name(place);
  }

  isNearest(i, x, y) {
    const place = this.place(i);
    return place >= 0 && this.call("is_nearest", place, x, y) === 1;
  }

  kNearest(x, y, k) {
    this.call("k_nearest", x, y, k);
    return this.#named(this.engine.ints(0));
  }

  within(x, y, radius) {
    this.call("within", x, y, radius);
    return this.#named(this.engine.ints(0));
  }

  /** Where a point falls; by a strategy of choice with what it looked at on the way, which only the full module tells. */
  locate(x, y, strategy) {
    const by = strategy === undefined ? 0 : strategies.indexOf(strategy);
    if (by < 0) throw new DeloneError("range", `there is no strategy ${shown(strategy)}: ${strategies.join(", ")}`);
    const isTold = strategy !== undefined;
    const kind = kinds[isTold ? this.call("locate_by", x, y, by) : this.call("locate", x, y)];
    const {engine} = this;
    const [triangle, ...vertices] = engine.ints(0);
    const found = {kind, triangle: triangle === 0xffffffff ? -1 : triangle, vertices: vertices.map((i) => this.name(i))};
    if (isTold) found.path = polygons(engine.ints(1), engine.floats(0));
    return found;
  }

  /** Values by the user's index as the module has its points. */
  #placed(values) {
    const all = numbers(values, "values");
    if (all.length !== this.#count) throw new DeloneError("values", `${all.length} values where there should be ${this.#count}`);
    return this.#given ? this.#given.map((i) => all[i]) : all;
  }

  interpolate(values, queries, method, outside) {
    this.engine.giveNumbers(this.#placed(values));
    this.engine.givePoints(queries);
    this.call("interpolate", method, outside);
    return this.engine.floats(0);
  }

  contours(values, levels) {
    this.engine.giveNumbers([...this.#placed(values), ...levels]);
    this.call("contours", levels.length);
    const {engine} = this;
    const [closes, heights] = [engine.ints(1), engine.floats(1)];
    return polygons(engine.ints(0), engine.floats(0)).map((points, k) => ({level: heights[k], isClosed: closes[k] === 1, points}));
  }

  /** The centers of the circles of all triangles. */
  circumcenters() {
    this.call("circumcenters");
    const centers = this.engine.floats(0);
    this.engine.clear();
    return centers;
  }

  /** Cells clipped to a rectangle. */
  cells(bounds) {
    this.call("cells", ...bounds, 0);
    const {engine} = this;
    const cells = new Cells(...inOrder(engine.intsThere(0, Int32Array), engine.floatsThere(0), engine.floatsThere(1)));
    engine.clear();
    return cells;
  }

  /** Areas and centroids of cells clipped to a rectangle, by the user's index; of points without a cell zero, and the point itself. */
  measures(bounds, points) {
    this.call("cells", ...bounds, 1);
    return this.#takeMeasures(points);
  }

  /** Cells clipped to a polygon, given as rings of points. */
  cellsInPolygon(rings) {
    this.#giveRings(rings);
    this.call("cells_in_polygon", 0);
    const {engine} = this;
    const cells = new Cells(engine.ints(1, Int32Array), engine.floats(0), engine.ints(0));
    engine.clear();
    return cells;
  }

  #giveRings(rings) {
    const {flat, ends} = flatRings(rings);
    this.engine.givePoints(flat);
    this.engine.giveIndices(ends);
  }

  #takeMeasures(points) {
    const {engine} = this;
    const found = {areas: engine.floats(0), centroids: engine.floats(1)};
    engine.clear();
    if (!this.#given) return found;
    const areas = new Float64Array(this.#count);
    const centroids = Float64Array.from(points).subarray(0, 2 * this.#count);
    this.#given.forEach((i, k) => {
      areas[i] = found.areas[k];
      centroids.set(found.centroids.subarray(2 * k, 2 * k + 2), 2 * i);
    });
    return {areas, centroids};
  }
}
