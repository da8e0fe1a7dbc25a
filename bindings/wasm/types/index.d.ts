/** What a flat array of coordinates is: `[x0, y0, x1, y1, ...]`. */
export type Coordinates = ArrayLike<number>;

export interface Options {
  /** Points with a coordinate that is not finite are left out, and the others keep their indices; else they are an error. */
  skipInvalid?: boolean;
}

export type ErrorCode =
  | "bounds" | "constraints-end" | "disposed" | "flaw" | "input" | "internal" | "length" | "lost" | "memory"
  | "no-length" | "no-such-point" | "no-such-segment" | "not-a-number" | "not-finite" | "not-ready" | "occupied"
  | "range" | "region" | "segments-cross" | "too-many-points" | "unavailable" | "values" | "worker";

/** Everything that this package throws. */
export class DeloneError extends Error {
  constructor(code: ErrorCode, message: string, index?: number);
  /** What is wrong, for programs. */
  code: ErrorCode;
  /** The point, segment or ring that is to blame. */
  index?: number;
}

/** A triangulation as arrays, with the names of delaunator. */
export class Delaunator<T extends Coordinates = Float64Array> {
  static from(points: ArrayLike<Delaunay.Point> | Iterable<Delaunay.Point>, options?: Options): Delaunator<Float64Array>;
  static from<P>(
    points: ArrayLike<P> | Iterable<P>,
    getX: (p: P) => number,
    getY: (p: P) => number,
    options?: Options,
  ): Delaunator<Float64Array>;
  constructor(coords: T, options?: Options);
  coords: T;
  /** Corners of triangles, three each, counter-clockwise with y down. */
  triangles: Uint32Array;
  /** For each half-edge its twin, or -1. */
  halfedges: Int32Array;
  /** The hull, counter-clockwise with y down; of points on a line those along it. */
  hull: Uint32Array;
  trianglesLen: number;
  update(): void;
}

export interface Located {
  /** What the point is on or in; "none" where there is no triangle. */
  kind: "triangle" | "edge" | "vertex" | "outside" | "none";
  /** A triangle that holds the point, or -1. */
  triangle: number;
  /** The corners of what the point is on; outside the ends of the nearest hull edge that it is beyond. */
  vertices: number[];
  /** What was looked at on the way, if a strategy was given: triangles, ends of hull edges, vertices. */
  path?: Delaunay.Polygon[];
}

export type Strategy = "tree" | "walk" | "jump-and-walk" | "hierarchy" | "history";

/** A triangulation, with the names of d3-delaunay. */
export class Delaunay<P = Delaunay.Point> {
  static from(points: ArrayLike<Delaunay.Point> | Iterable<Delaunay.Point>, options?: Options): Delaunay<Delaunay.Point>;
  static from<P>(
    points: ArrayLike<P> | Iterable<P>,
    getX: Delaunay.GetCoordinate<P, ArrayLike<P> | Iterable<P>>,
    getY: Delaunay.GetCoordinate<P, ArrayLike<P> | Iterable<P>>,
    that?: any,
    options?: Options,
  ): Delaunay<P>;
  static from<P>(
    points: ArrayLike<P> | Iterable<P>,
    getX: Delaunay.GetCoordinate<P, ArrayLike<P> | Iterable<P>>,
    getY: Delaunay.GetCoordinate<P, ArrayLike<P> | Iterable<P>>,
    options: Options,
  ): Delaunay<P>;
  /** Triangulates the points of a copy: of what JSON, `structuredClone`, a message or a spread made of a triangulation. Points removed stay so. */
  static fromJSON<P = Delaunay.Point>(copy: Delaunay.Copy | Delaunay.Json, options?: Options): Delaunay<P>;
  constructor(points: Coordinates, options?: Options);

  points: Coordinates;
  readonly halfedges: Int32Array;
  readonly hull: Uint32Array;
  readonly triangles: Uint32Array;
  readonly inedges: Int32Array;
  /** All points in their order along a line, if three or more distinct ones are on one. */
  readonly collinear?: Int32Array;
  /** Pairs in a row: a point that is no vertex, and the earlier one that it equals. */
  readonly duplicates: Uint32Array;
  /** The points that were removed, and those that equalled them. */
  readonly removed: Uint32Array;
  /** Counts changes. */
  readonly version: number;

  /** The nearest point; -1 if there is none. `i` is accepted for d3's sake: no start is needed. */
  find(x: number, y: number, i?: number): number;
  neighbors(i: number): IterableIterator<number>;
  // Without a context the text of a path. As in d3 there is none, at run time `null`, where there is nothing to draw: no point for `render`, `renderHull`
  // and `hullPolygon`, no such triangle for `renderTriangle` and `trianglePolygon`. Types are those of @types/d3-delaunay, which leave it out.
  render(): string;
  render(context: null | undefined): string;
  render(context: Delaunay.MoveContext & Delaunay.LineContext): void;
  renderHull(): string;
  renderHull(context: null | undefined): string;
  renderHull(context: Delaunay.MoveContext & Delaunay.LineContext): void;
  renderTriangle(i: number): string;
  renderTriangle(i: number, context: null | undefined): string;
  renderTriangle(i: number, context: Delaunay.MoveContext & Delaunay.LineContext & Delaunay.ClosableContext): void;
  renderPoints(): string;
  renderPoints(radius: number): string;
  renderPoints(context: null | undefined, radius?: number): string;
  renderPoints(context: Delaunay.MoveContext & Delaunay.ArcContext, radius?: number): void;
  hullPolygon(): Delaunay.Polygon;
  trianglePolygon(i: number): Delaunay.Triangle;
  trianglePolygons(): IterableIterator<Delaunay.Triangle>;
  update(): this;
  voronoi(bounds?: Delaunay.Bounds): Voronoi<P>;

  /** The nearest point; what is not finite is an error. */
  nearest(x: number, y: number): number;
  kNearest(x: number, y: number, k: number): Uint32Array;
  within(x: number, y: number, radius: number): Uint32Array;
  /** Where a point falls. A strategy needs the full module, and tells the path. */
  locate(x: number, y: number, options?: {strategy?: Strategy}): Located;
  /** Full module: inserts a point, and returns its index, or that of the point that is there. */
  insert(x: number, y: number): number;
  /** Full module: removes a point, and what equals it; the others keep their indices. */
  remove(i: number): void;
  /** Full module: moves a point, which keeps its index. What equalled it is removed. */
  move(i: number, x: number, y: number): void;
  /** Full module: proves that the triangulation is the canonical one, or throws. */
  check(): void;
  /** Gives memory back: arrays are undefined then, and what needs the module throws. */
  dispose(): void;
  /** What `JSON.stringify` writes: the points, and plain arrays of all that a copy has. */
  toJSON(): Delaunay.Json;
}

export namespace Delaunay {
  type Point = [number, number];
  type Triangle = Point[];
  type Polygon = Point[];
  type Bounds = [number, number, number, number];
  /** What `structuredClone`, `postMessage` and a spread make of a triangulation. */
  interface Copy {
    points: Coordinates;
    triangles: Uint32Array;
    halfedges: Int32Array;
    hull: Uint32Array;
    inedges: Int32Array;
    collinear?: Int32Array;
    removed: Uint32Array;
  }
  /** The same as JSON has it; a coordinate that is not finite becomes null in its text. */
  interface Json {
    points: (number | null)[];
    triangles: number[];
    halfedges: number[];
    hull: number[];
    inedges: number[];
    collinear?: number[];
    removed: number[];
  }
  type GetCoordinate<P, PS> = (point: P, i: number, points: PS) => number;

  interface RectContext {
    rect(x: number, y: number, width: number, height: number): void;
  }
  interface MoveContext {
    moveTo(x: number, y: number): void;
  }
  interface LineContext {
    lineTo(x: number, y: number): void;
  }
  interface ArcContext {
    arc(x: number, y: number, radius: number, startAngle: number, endAngle: number, counterclockwise?: boolean): void;
  }
  interface ClosableContext {
    closePath(): void;
  }
}

/** The Voronoi diagram in a rectangle, with the names of d3-delaunay. */
export class Voronoi<P = Delaunay.Point> {
  constructor(delaunay: Delaunay<P>, bounds?: Delaunay.Bounds);
  delaunay: Delaunay<P>;
  readonly circumcenters: Float64Array;
  readonly vectors: Float64Array;
  xmin: number;
  ymin: number;
  xmax: number;
  ymax: number;

  contains(i: number, x: number, y: number): boolean;
  neighbors(i: number): IterableIterator<number>;
  // At run time `null`, as in d3, where there is nothing: of one point for `render`, of no cell for `cellPolygon`; `undefined` for `renderCell`.
  render(): string;
  render(context: null | undefined): string;
  render(context: Delaunay.MoveContext & Delaunay.LineContext): void;
  renderBounds(): string;
  renderBounds(context: null | undefined): string;
  renderBounds(context: Delaunay.RectContext): void;
  renderCell(i: number): string;
  renderCell(i: number, context: null | undefined): string;
  renderCell(i: number, context: Delaunay.MoveContext & Delaunay.LineContext & Delaunay.ClosableContext): void;
  cellPolygons(): IterableIterator<Delaunay.Polygon & {index: number}>;
  cellPolygon(i: number): Delaunay.Polygon;
  update(): this;

  /** The areas of all cells. */
  areas(): Float64Array;
  /** Where all points would move in a step of Lloyd's relaxation, as a flat array. */
  relax(): Float64Array;
  /** Full module: cells clipped to a polygon of rings; for each point an array of closed rings. */
  clip(polygon: Iterable<Iterable<ArrayLike<number>>>): Delaunay.Polygon[][];
  /** What `JSON.stringify` writes. */
  toJSON(): {delaunay: Delaunay<P>; xmin: number; ymin: number; xmax: number; ymax: number; circumcenters: number[]; vectors: number[]};
}

export default Delaunay;
