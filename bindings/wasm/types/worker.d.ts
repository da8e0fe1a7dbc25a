export interface Triangulated {
  coords: Float64Array;
  triangles: Uint32Array;
  halfedges: Int32Array;
  hull: Uint32Array;
}

/** A thread that triangulates. */
export class DelaunayWorker {
  /**
   * Without options of a script that is inside of the package, which a content security policy has to allow by `worker-src blob:`; or of the address
   * of the file `delone/delone-worker.js`. A worker that does not start rejects what it is asked with the code "worker".
   */
  constructor(options?: {script?: string | URL});
  triangulate(coords: ArrayLike<number>, options?: {transfer?: boolean; skipInvalid?: boolean}): Promise<Triangulated>;
  terminate(): Promise<void>;
}
