// The thread of worker.js. The build makes one script of this file and what it imports, which worker.js carries as text; the module comes as
// the first message, so that a page has it once.

import {Delaunator} from "./delaunator.js";
import {DeloneError} from "./errors.js";
import {useModule} from "./module.js";
import {unpack} from "./unpack.js";

/** Answers what comes by a port: the scope of a worker, or the port to the parent of a thread of Node. */
export function serve(port) {
  const work = ({id, packed, coords, skipInvalid}) => {
    if (packed) return useModule(unpack(packed));
    try {
      const {triangles, halfedges, hull} = new Delaunator(coords, {skipInvalid});
      port.postMessage({id, coords, triangles, halfedges, hull}, [coords, triangles, halfedges, hull].map((a) => a.buffer));
    } catch (error) {
      const {code, message, index} = error instanceof DeloneError ? error : new DeloneError("internal", String(error));
      port.postMessage({id, error: {code, message, index}});
    }
  };
  if (port.on) port.on("message", work);
  else port.addEventListener("message", ({data}) => work(data));
}
