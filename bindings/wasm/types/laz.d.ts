export interface PointCloud {
  /** x and y by turns. */
  coords: Float64Array;
  heights: Float64Array;
  /** As the file classifies them: 2 is the ground, 6 a building. */
  classes: Uint8Array;
}

/** The points of a LAS or LAZ file; those of `classes` only, if these are given, and without those withheld unless `withheld` is true. */
export function readLas(file: ArrayBuffer | ArrayBufferView, options?: {classes?: Iterable<number>; withheld?: boolean}): PointCloud;
