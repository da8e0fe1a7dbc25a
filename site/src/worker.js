// Triangulates large sets off the main thread, ours and, for the race, delaunator's.

import {Delaunator} from "delone";
import Rival from "delaunator";
import {answer} from "./answer.js";

answer({
  triangulate({coords}) {
    const start = performance.now();
    const {triangles, halfedges, hull} = new Delaunator(coords);
    const ms = performance.now() - start;
    return {coords, triangles, halfedges, hull, ms, transfer: [coords.buffer, triangles.buffer, halfedges.buffer, hull.buffer]};
  },

  /** Both, one after the other, as often as is said; medians. */
  race({coords, runs}) {
    const times = {ours: [], theirs: []};
    const counts = {};
    for (let run = 0; run < runs; run++) {
      for (const [name, Way] of [["ours", Delaunator], ["theirs", Rival]]) {
        const start = performance.now();
        const {triangles} = new Way(coords);
        times[name].push(performance.now() - start);
        counts[name] = triangles.length / 3;
      }
    }
    const median = (list) => list.sort((a, b) => a - b)[list.length >> 1];
    return {ours: median(times.ours), theirs: median(times.theirs), counts};
  },
});
