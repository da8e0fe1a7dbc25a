// Triangulates large sets off the main thread, ours and, for the race, delaunator's.

import {Delaunator} from "delone";
import Rival from "delaunator";

self.addEventListener("message", ({data: {id, task, coords, runs}}) => {
  try {
    if (task === "triangulate") {
      const start = performance.now();
      const {triangles, halfedges, hull} = new Delaunator(coords);
      const ms = performance.now() - start;
      self.postMessage({id, coords, triangles, halfedges, hull, ms}, [coords.buffer, triangles.buffer, halfedges.buffer, hull.buffer]);
    } else {
      self.postMessage({id, ...race(coords, runs)});
    }
  } catch (error) {
    self.postMessage({id, error: error.message});
  }
});

/** Both, one after the other, as often as is said; medians. */
function race(coords, runs) {
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
}
