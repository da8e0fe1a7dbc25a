// The other library of the race and of the lattice, as a global: loaded on demand.
export {default as Delaunator} from "delaunator";
