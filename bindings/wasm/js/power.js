// Points with weights: the power diagram, where a heavy point has more of the plane than it would have by distance, and the regular
// triangulation that is dual to it. In the full module. Nothing stays in the module: there is nothing to dispose of.

import {Cells} from "./cells.js";
import {DeloneError} from "./errors.js";
import {checkBounds, flatCoordinates, numbers} from "./input.js";
import {currentEngine} from "./module.js";

export class Power {
  #cells;

  /**
   * Of points, a flat array, and a weight for each, a squared radius: a place belongs to the point with the least squared distance less
   * the weight. Cells are clipped to bounds with an area.
   */
  constructor(points, weights, bounds = [0, 0, 960, 500]) {
    const [xmin, ymin, xmax, ymax] = checkBounds(bounds);
    if (xmax === xmin || ymax === ymin) throw new DeloneError("bounds", "invalid bounds");
    const flat = flatCoordinates(points);
    const count = flat.length >> 1;
    const all = numbers(weights, "weights");
    if (all.length !== count) throw new DeloneError("values", `${all.length} weights where there should be ${count}`);
    const engine = currentEngine();
    engine.givePoints(flat, count);
    engine.giveNumbers(all);
    engine.call(undefined, "power", xmin, ymin, xmax, ymax);
    this.points = points;
    this.weights = weights;
    /** Corners of the triangles, three each, counter-clockwise with y down. */
    this.triangles = engine.ints(0);
    /** The points that have no cell anywhere, because another one is nearer by its weight, or equals them. */
    this.hidden = engine.ints(1);
    /** The areas of all cells; zero where there is none. */
    this.areas = engine.floats(1);
    this.#cells = new Cells(engine.ints(2, Int32Array), engine.floats(0));
    engine.clear();
  }

  /** A cell as a closed ring; null if it is empty or there is none. */
  cellPolygon(i) {
    return this.#cells.ring(i);
  }

  /** The cells that are not empty, each with its `index`. */
  *cellPolygons() {
    for (let i = 0; i < this.areas.length; ++i) {
      const polygon = this.cellPolygon(i);
      if (polygon) yield Object.assign(polygon, {index: i});
    }
  }
}
