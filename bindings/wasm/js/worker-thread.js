// What runs in the thread of worker.js.

import {Delaunator, DeloneError} from "./index.js";
import {builtin} from "./node.js";

const port = typeof self !== "undefined" && self.postMessage ? self : (await builtin("worker_threads")).parentPort;

function work({id, coords, skipInvalid}) {
  try {
    const {triangles, halfedges, hull} = new Delaunator(coords, {skipInvalid});
    port.postMessage({id, coords, triangles, halfedges, hull}, [coords, triangles, halfedges, hull].map((a) => a.buffer));
  } catch (error) {
    const {code, message, index} = error instanceof DeloneError ? error : new DeloneError("internal", String(error));
    port.postMessage({id, error: {code, message, index}});
  }
}

if (port.on) port.on("message", work);
else port.addEventListener("message", ({data}) => work(data));
