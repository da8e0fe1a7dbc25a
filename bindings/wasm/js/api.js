// What every entry gives, whatever brings the module.

export {DeloneError} from "./errors.js";
export {Delaunator} from "./delaunator.js";
export {Delaunay} from "./delaunay.js";
export {Voronoi} from "./voronoi.js";
