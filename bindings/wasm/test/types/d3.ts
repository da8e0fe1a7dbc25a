// A program for @types/d3-delaunay, with each of its signatures. It is compiled twice: with these types, and with ours under their name.

import {Delaunay, Voronoi} from "d3-delaunay";

interface City {
  name: string;
  longitude: number;
  latitude: number;
}
declare const cities: City[];
declare const set: Set<City>;
declare const path: Delaunay.MoveContext & Delaunay.LineContext;
declare const closable: Delaunay.MoveContext & Delaunay.LineContext & Delaunay.ClosableContext;
declare const arcs: Delaunay.MoveContext & Delaunay.ArcContext;
declare const rects: Delaunay.RectContext;
declare const canvas: CanvasRenderingContext2D;

const getX: Delaunay.GetCoordinate<City, ArrayLike<City> | Iterable<City>> = (d) => d.longitude;
const getY: Delaunay.GetCoordinate<City, ArrayLike<City> | Iterable<City>> = (d, i, all) => d.latitude + i * ("length" in all ? 1 : 0);

const flat: Delaunay<number> = new Delaunay<number>([0, 0, 1, 0]);
const typed: Delaunay<unknown> = new Delaunay(Float64Array.of(0, 0));
const points: Delaunay<Delaunay.Point> = Delaunay.from([[0, 0], [1, 2]]);
const iterated: Delaunay<Delaunay.Point> = Delaunay.from(new Map([[0, 1]]));
const some: Delaunay<City> = Delaunay.from(cities, getX, getY);
const own: Delaunay<City> = Delaunay.from(set, (d) => d.longitude, (d) => d.latitude, {anything: 1});
const inferred = Delaunay.from(cities, (d) => d.longitude, (d, i, all) => d.latitude + i);
const city: Delaunay<City> = inferred;

export const numbers: ArrayLike<number> = points.points;
export const arrays: [Int32Array, Uint32Array, Uint32Array, Int32Array] = [points.halfedges, points.hull, points.triangles, points.inedges];
export const found: number = points.find(1, 2) + points.find(1, 2, 3);
export const around: IterableIterator<number> = points.neighbors(0);
export const texts: string[] = [
  points.render(), points.renderHull(), points.renderTriangle(0), points.renderPoints(), points.renderPoints(undefined, 3),
];
points.render(path);
points.render(canvas);
points.renderHull(path);
points.renderHull(canvas);
points.renderTriangle(0, closable);
points.renderTriangle(0, canvas);
points.renderPoints(arcs);
points.renderPoints(canvas, 3);
export const hull: Delaunay.Polygon = points.hullPolygon();
export const triangle: Delaunay.Triangle = points.trianglePolygon(0);
for (const polygon of points.trianglePolygons()) polygon[0][0].toFixed();
export const again: Delaunay<Delaunay.Point> = points.update();

const bounds: Delaunay.Bounds = [0, 0, 960, 500];
const voronoi: Voronoi<City> = some.voronoi(bounds);
export const others: [Voronoi<City>, Voronoi<number>] = [own.voronoi().update(), flat.voronoi()];
export const cityOf: Delaunay<City> = voronoi.delaunay;
export const centers: [Float64Array, Float64Array] = [voronoi.circumcenters, voronoi.vectors];
voronoi.xmin = Math.min(voronoi.xmax, voronoi.ymin, voronoi.ymax);
export const contained: boolean = voronoi.contains(0, 1, 2);
export const next: Iterable<number> = voronoi.neighbors(0);
export const drawn: string[] = [voronoi.render(), voronoi.renderBounds(), voronoi.renderCell(0)];
voronoi.render(path);
voronoi.render(canvas);
voronoi.renderBounds(rects);
voronoi.renderCell(0, closable);
voronoi.renderCell(0, canvas);
for (const cell of voronoi.cellPolygons()) cell.index.toFixed() + cell[0][1].toFixed();
export const corner: Delaunay.Point = voronoi.cellPolygon(0)[0];
export const all = [typed, iterated, city];
