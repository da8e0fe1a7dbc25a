// The default entry: the module is inside, and ready when the import is.

import packed from "../dist/inline.js";
import {useModule} from "./module.js";
import {unpack} from "./unpack.js";

useModule(unpack(packed));

export * from "./api.js";
export {Delaunay as default} from "./delaunay.js";
