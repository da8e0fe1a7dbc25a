// What must compile, and what must not: programs written for d3-delaunay's types, and ours.

import {readLas} from "delone/laz";
import Default, {Delaunator, Delaunay, DeloneError, Voronoi} from "delone";
import {init} from "delone/async";
import {Constrained, contours, interpolate} from "delone/full";
import {DelaunayWorker} from "delone/worker";

interface City {
  name: string;
  longitude: number;
  latitude: number;
}
declare const cities: City[];
declare const canvas: CanvasRenderingContext2D;

const delaunay: Delaunay<City> = Delaunay.from(cities, (d) => d.longitude, (d, i, all) => d.latitude + i, {skipInvalid: true});
const points: Delaunay<Delaunay.Point> = Delaunay.from([[0, 0], [1, 2]]);
const flat = new Default(Float32Array.of(0, 0), {skipInvalid: true});
const voronoi: Voronoi<City> = delaunay.voronoi([0, 0, 960, 500]);
delaunay.render(canvas);
voronoi.renderCell(0, canvas);
voronoi.renderBounds(canvas);
const path: string = voronoi.renderCell(0) + voronoi.render(undefined) + delaunay.render() + delaunay.renderPoints(null) + delaunay.renderPoints(3);
for (const cell of voronoi.cellPolygons()) cell.index.toFixed();
const [x, y]: [number, number] = voronoi.cellPolygon(0)[0];
const line: Int32Array | undefined = points.collinear;
const moved: Float64Array = voronoi.relax();
const kind: "triangle" | "edge" | "vertex" | "outside" | "none" = flat.locate(x, y, {strategy: "walk"}).kind;
const near: Uint32Array = flat.kNearest(0, 0, 3);
const coords: Float64Array = Delaunator.from(cities, (p) => p.longitude, (p) => p.latitude).coords;
const given: number[] = new Delaunator([0, 0, 1, 1]).coords;
const ready: Promise<void> = init(fetch("delone.wasm"));
const c: Constrained = Constrained.polygon([[[0, 0], [1, 0], [0, 1]]], {fill: "nonzero"});
const values: Float64Array = interpolate(delaunay, [1, 2], c.points, {method: "sibson", outside: "hull"});
contours(points, values, [1, 2])[0].level.toFixed();
const ground: Float64Array = readLas(new ArrayBuffer(0), {classes: [2]}).heights;
const copy: Delaunay.Copy = structuredClone(delaunay);
const copies: Delaunay<City>[] = [copy, {...delaunay}, delaunay.toJSON()].map((c) => Delaunay.fromJSON<City>(c, {skipInvalid: true}));
const gone: Uint32Array = copies[0].removed;
new DelaunayWorker({script: new URL("delone-worker.js", "https://example.org")}).terminate();
new DelaunayWorker().triangulate([0, 0], {transfer: true}).then(({triangles}) => triangles.length);
if (new DeloneError("memory", "").code === "memory") console.log(path, line, moved, kind, near, coords, given, ready, ground, gone);

// @ts-expect-error an array of points is no flat array
new Delaunay([[0, 0]]);
// @ts-expect-error there is no such strategy
flat.locate(0, 0, {strategy: "luck"});
// @ts-expect-error there is no such code
new DeloneError("luck", "");
// @ts-expect-error arrays are made anew, not set
flat.triangles = new Uint32Array();
