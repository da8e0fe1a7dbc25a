// Whatever takes a triangulation or a diagram by @types/d3-delaunay takes ours: each member is compared.

import type * as D3 from "d3-delaunay";
import * as delone from "delone";
import * as full from "delone/full";

interface City {
  name: string;
}
declare const delaunay: delone.Delaunay<City>;
declare const voronoi: delone.Voronoi<City>;

export const theirs: [D3.Delaunay<City>, D3.Voronoi<City>] = [delaunay, voronoi];
export const makers: {Delaunay: typeof D3.Delaunay}[] = [delone, full];
