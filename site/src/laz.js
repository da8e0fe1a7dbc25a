// The reader of point clouds, as a global: loaded with the first of them.
export {readLas} from "delone/laz";
