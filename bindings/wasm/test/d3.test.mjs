// What d3-delaunay's own tests ask of a triangulation (ISC, Observable), in our words. Compared up to what we do not promise: triangles
// as sets, neighbors as sets, rings up to where they start.

import assert from "node:assert/strict";
import test from "node:test";
import {Delaunay} from "delone";
import {Path} from "../js/path.js";
import {prove, ringOf, triangleSet} from "./support/oracle.mjs";

const square = [[0, 0], [1, 0], [0, 1], [1, 1]];
const sorted = (indices) => [...indices].sort((a, b) => a - b);
const neighbors = (d, count) => Array.from({length: count}, (_, i) => sorted(d.neighbors(i)));

function isSquare(d) {
  assert.deepEqual(d.points, Float64Array.of(0, 0, 1, 0, 0, 1, 1, 1));
  prove(d, d.points);
  assert.deepEqual(neighbors(d, 4).map((n) => n.length).sort(), [2, 2, 3, 3]);
  for (let i = 0; i < 4; ++i) assert.equal(d.triangles[d.halfedges.length && (d.inedges[i] % 3 === 2 ? d.inedges[i] - 2 : d.inedges[i] + 1)], i);
}

test("from an array, an iterable, an iterable with functions, a length with functions", () => {
  isSquare(Delaunay.from(square));
  isSquare(Delaunay.from(new Set(square)));
  isSquare(Delaunay.from((function* () { for (const [x, y] of square) yield {x, y}; })(), (d) => d.x, (d) => d.y));
  isSquare(Delaunay.from({length: 4}, (d, i) => i & 1, (d, i) => i >> 1));
});

test("functions get point, index and points, and their this", () => {
  const points = [[1, 2]];
  const calls = [];
  const that = {};
  Delaunay.from(points, function (...args) { calls.push([this, ...args]); return 0; }, () => 0, that);
  assert.deepEqual(calls, [[that, points[0], 0, points]]);
});

test("points that coincide", () => {
  const d = Delaunay.from([[0, 0], [1, 0], [0, 1], [1, 0]]);
  assert.deepEqual(neighbors(d, 4), [[1, 2], [0, 2], [0, 1], []]);
  assert.equal(d.inedges[3], -1);
  assert.deepEqual(sorted(d.inedges.slice(0, 3)), [0, 1, 2]);
  assert.deepEqual(d.duplicates, Uint32Array.of(3, 1));
});

test("bounds, by default and given", () => {
  const bounds = ({xmin, ymin, xmax, ymax}) => [xmin, ymin, xmax, ymax];
  assert.deepEqual(bounds(Delaunay.from(square).voronoi()), [0, 0, 960, 500]);
  assert.deepEqual(bounds(Delaunay.from(square).voronoi([-1, -1, 2, 2])), [-1, -1, 2, 2]);
  assert.throws(() => Delaunay.from(square).voronoi([0, 0, -1, 1]), /invalid bounds/);
  assert.throws(() => Delaunay.from(square).voronoi([0, 0, 1, NaN]), /invalid bounds/);
});

test("circumcenters and vectors", () => {
  const v = Delaunay.from(square).voronoi();
  assert.deepEqual(v.circumcenters, Float64Array.of(0.5, 0.5, 0.5, 0.5));
  assert.deepEqual(v.vectors, Float64Array.of(0, -1, -1, 0, 1, 0, 0, -1, -1, 0, 0, 1, 0, 1, 1, 0));
  const w = Delaunay.from([[0, 0], [1, 0], [0, 1], [1, 0]]).voronoi([-1, -1, 2, 2]);
  assert.deepEqual(w.circumcenters, Float64Array.of(0.5, 0.5));
  assert.deepEqual(w.vectors, Float64Array.of(0, -1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, 0, 0, 0));
});

test("no point, and one", () => {
  assert.equal(Delaunay.from([]).voronoi([-1, -1, 2, 2]).render(), null);
  const v = Delaunay.from([[0, 0]]).voronoi([-1, -1, 2, 2]);
  assert.equal(v.render(), null);
  assert.equal(ringOf(v.renderCell(0)), ringOf("M2,-1L2,2L-1,2L-1,-1Z"));
});

test("points are drawn as circles of a radius that may come first", () => {
  const d = Delaunay.from([[0, 0]]);
  const circle = (r) => `M${r},0A${r},${r},0,1,1,-${r},0A${r},${r},0,1,1,${r},0`;
  assert.equal(d.renderPoints(), circle(2));
  assert.equal(d.renderPoints(5), circle(5));
  assert.equal(d.renderPoints("5"), circle(5));
  assert.equal(d.renderPoints(null, 5), circle(5));
  assert.equal(d.renderPoints(undefined), circle(2));
  assert.equal(d.renderPoints(null), circle(2));
  assert.equal(d.renderPoints(null, null), circle(2));
  const path = new Path();
  assert.equal(d.renderPoints(path, "3"), undefined);
  assert.equal(path.value(), circle(3));
});

test("two points", () => {
  const v = Delaunay.from([[0, 0], [1, 0], [1, 0], [1, 0]]).voronoi([-1, -1, 2, 2]);
  assert.equal(ringOf(v.renderCell(0)), ringOf("M-1,2L-1,-1L0.5,-1L0.5,2Z"));
  assert.equal(v.delaunay.find(-1, 0), 0);
  assert.equal(v.delaunay.find(2, 0), 1);
  assert.deepEqual(neighbors(v.delaunay, 4), [[1], [0], [], []]);
  assert.ok(v.delaunay.triangles instanceof Int32Array && v.delaunay.triangles.length === 3);
});

test("points on a line: neighbors before and after", () => {
  const {delaunay} = Delaunay.from([[0, 0], [1, 0], [-1, 0]]).voronoi([-1, -1, 2, 2]);
  assert.deepEqual(neighbors(delaunay, 3), [[1, 2], [0], [0]]);
  assert.deepEqual([...delaunay.collinear], [2, 0, 1]);
});

for (const count of [120, 121]) {
  test(`points on a line up to rounding: ${count}`, () => {
    const d = Delaunay.from(Array.from({length: count}, (_, i) => [i * 4, i / 3 + 100]));
    assert.deepEqual([...d.neighbors(2)], [1, 3]);
  });
}

test("the nearest point", () => {
  const d = Delaunay.from([[0, 0], [300, 0], [0, 300], [300, 300], [100, 100]]);
  assert.equal(d.find(49, 49), 0);
  assert.equal(d.find(51, 51), 4);
  assert.equal(d.find(NaN, 0), -1);
  assert.equal(Delaunay.from([]).find(0, 0), -1);
});

test("the nearest of one or two points", () => {
  const points = [[0, 1], [0, 2]];
  const d = Delaunay.from(points);
  assert.equal(points[d.find(0, -1)][1], 1);
  assert.equal(points[d.find(0, 2.2)][1], 2);
  d.points.fill(0);
  d.update();
  assert.equal(d.find(0, -1), 0);
  assert.equal(d.find(0, 1.2), 0);
});

test("the nearest of points on a line", () => {
  const points = [[0, 1], [0, 2], [0, 4], [0, 0], [0, 3], [0, 4], [0, 4]];
  const d = Delaunay.from(points);
  for (const [x, y, expected] of [[0, -1, 0], [0, 1.2, 1], [1, 1.9, 2], [-1, 3.3, 3], [10, 10, 4]]) {
    assert.equal(points[d.find(x, y)][1], expected);
    assert.equal(points[d.find(x, y, 0)][1], expected);
  }
});

test("the nearest of many points on a line", () => {
  const points = Array.from({length: 2000}, (_, i) => [i ** 2, i ** 2]);
  const d = Delaunay.from(points);
  for (const [x, y, expected] of [[0, -1, 0], [0, 1.2, 1], [3.9, 3.9, 4], [10, 9.5, 9], [1e6, 1e6, 1e6]]) {
    assert.equal(points[d.find(x, y)][1], expected);
  }
});

test("update after points were changed in place", () => {
  const d = Delaunay.from([[0, 0], [300, 0], [0, 300], [300, 300], [100, 100]]);
  const centers = () => {
    const c = d.voronoi([-500, -500, 500, 500]).circumcenters;
    return Array.from({length: c.length / 2}, (_, k) => `${c[2 * k]},${c[2 * k + 1]}`).sort();
  };
  assert.deepEqual(centers(), ["150,-50", "-50,150", "250,150", "150,250"].sort());
  for (let i = 0; i < d.points.length; ++i) d.points[i] = -d.points[i];
  assert.equal(d.update(), d);
  assert.deepEqual(centers(), ["-150,50", "-250,-150", "50,-150", "-150,-250"].sort());
});

test("update to a line and back", () => {
  const d = new Delaunay(Array.from({length: 250}).fill(0));
  assert.equal(d.collinear, undefined);
  const change = (f) => {
    for (let i = 0; i < d.points.length; ++i) d.points[i] = f(i);
    d.update();
  };
  for (let round = 0; round < 2; ++round) {
    change((i) => (i % 2 ? i : 0));
    assert.equal(d.collinear.length, 125);
    change(Math.sin);
    assert.equal(d.collinear, undefined);
  }
  change(() => 0);
  assert.equal(d.collinear, undefined);
});

test("the nearest where points coincide", () => {
  const d = Delaunay.from([[0, 0], [0, 0], [10, 10], [10, -10]]);
  assert.equal(d.find(100, 100), 2);
  assert.ok(d.find(0, 0, 1) > -1);
  const many = Delaunay.from(Array.from({length: 1000}, () => [0, 0]).concat([[10, 10], [10, -10]]));
  assert.ok(many.find(0, 0, 1) > -1);
});

test("the nearest, wherever a search would start", () => {
  const points = Array.from({length: 60}, (_, i) => [(i * 7919) % 800, (i * 104729) % 450]);
  const d = Delaunay.from(points);
  const away = ([x, y]) => (x - 49) ** 2 + (y - 311) ** 2;
  const least = Math.min(...points.map(away));
  for (let i = 0; i < 60; ++i) assert.equal(away(points[d.find(49, 311, i)]), least);
});

test("the hull is drawn closed", () => {
  const d = Delaunay.from(square);
  const path = new Path();
  assert.equal(d.renderHull(path), undefined);
  assert.equal(ringOf(path.value()), ringOf("M0,1L1,1L1,0L0,0Z"));
  assert.equal(ringOf(d.renderHull()), ringOf(path.value()));
});

test("triangles are drawn, and come as rings", () => {
  const d = Delaunay.from([[0, 0], [2, 0], [0, 2]]);
  assert.equal(ringOf(d.renderTriangle(0)), ringOf("M0,0L0,2L2,0Z"));
  assert.deepEqual([...d.trianglePolygons()], [d.trianglePolygon(0)]);
  assert.equal(d.hullPolygon().length, 4);
  assert.equal(d.render(), d.renderHull());
  assert.deepEqual(triangleSet(d.triangles), ["0,2,1"]);
});
