import {Coordinates, Delaunay} from "./index.js";

export * from "./index.js";
export {default} from "./index.js";

export interface ConstrainedOptions {
  /** Which triangles are inside: all in the hull, those that an odd number of segments is around, those that segments wind around. */
  fill?: "all" | "even-odd" | "nonzero";
  /** What happens where segments cross. */
  crossings?: "refuse" | "split";
}

/** The constrained Delaunay triangulation of points and segments. */
export class Constrained {
  constructor(points: Coordinates, segments: Iterable<ArrayLike<number>> | Iterable<number>, options?: ConstrainedOptions);
  /** Triangles inside of rings. */
  static polygon(rings: Iterable<Iterable<ArrayLike<number>>>, options?: ConstrainedOptions): Constrained;
  /** Those given, then those where segments were split. */
  points: Float64Array;
  /** Corners of the triangles inside, three each, counter-clockwise with y down. */
  triangles: Uint32Array;
  /** Constraint edges, two indices each. */
  constraints: Uint32Array;
}

/** The power diagram of points with weights, and the regular triangulation dual to it. */
export class Power {
  /** A weight is a squared radius. Bounds are those of a diagram of Voronoi. */
  constructor(points: Coordinates, weights: ArrayLike<number>, bounds?: Delaunay.Bounds);
  points: Coordinates;
  weights: ArrayLike<number>;
  /** Corners of the triangles, three each, counter-clockwise with y down. */
  triangles: Uint32Array;
  /** The points that have no cell anywhere: others are heavier there, or equal them. */
  hidden: Uint32Array;
  areas: Float64Array;
  cellPolygon(i: number): Delaunay.Polygon | null;
  cellPolygons(): IterableIterator<Delaunay.Polygon & {index: number}>;
}

export interface InterpolationOptions {
  method?: "linear" | "sibson" | "laplace";
  /** Without it NaN outside of the hull; the value of the nearest point, or that at the nearest place of the hull. */
  outside?: "nearest" | "hull";
}

/** Values at points, from a value for each point of a triangulation. */
export function interpolate<P>(
  delaunay: Delaunay<P>,
  values: ArrayLike<number>,
  points: Coordinates,
  options?: InterpolationOptions,
): Float64Array;

export interface ContourLine {
  level: number;
  isClosed: boolean;
  points: Delaunay.Point[];
}

/** Contour lines at levels. */
export function contours<P>(delaunay: Delaunay<P>, values: ArrayLike<number>, levels: Iterable<number>): ContourLine[];
