// The entry with everything: points that come, go and move, paths of location, constraints, values between points.

import packed from "../dist/inline-full.js";
import {useModule} from "./module.js";
import {unpack} from "./unpack.js";

useModule(unpack(packed), 1);

export * from "./api.js";
export {Constrained} from "./constrained.js";
export {Power} from "./power.js";
export {contours, interpolate} from "./surface.js";
export {Delaunay as default} from "./delaunay.js";
