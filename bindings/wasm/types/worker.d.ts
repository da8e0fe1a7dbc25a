export interface Triangulated {
  coords: Float64Array;
  triangles: Uint32Array;
  halfedges: Int32Array;
  hull: Uint32Array;
}

/** A thread that triangulates. */
export class DelaunayWorker {
  triangulate(coords: ArrayLike<number>, options?: {transfer?: boolean; skipInvalid?: boolean}): Promise<Triangulated>;
  terminate(): Promise<void>;
}
