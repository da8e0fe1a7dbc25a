// The triangulation as arrays, with the names of delaunator. Nothing stays in the module: there is nothing to dispose of.

import {absentees, flatCoordinates, flattened, pointX, pointY, takeOptions} from "./input.js";
import {Plane} from "./plane.js";

export class Delaunator {
  #options;

  /** Of an array of points; `getX` and `getY` get the point alone. */
  static from(points, ...rest) {
    const options = takeOptions(rest);
    const [getX = pointX, getY = pointY] = rest;
    return new Delaunator(flattened(points, (p) => getX(p), (p) => getY(p), undefined, false), options);
  }

  /** Of a flat array of coordinates, which is kept and not copied. */
  constructor(coords, options = {}) {
    flatCoordinates(coords);
    this.coords = coords;
    this.#options = options;
    this.update();
  }

  /** Again, after `coords` were changed in place. */
  update() {
    const flat = flatCoordinates(this.coords);
    const plane = new Plane(flat, absentees(flat, this.#options));
    const {triangles, halfedges, hull} = plane.arrays();
    plane.dispose();
    this.triangles = triangles;
    this.halfedges = halfedges;
    this.hull = hull;
    this.trianglesLen = triangles.length;
  }
}
