// The full module and what users give it: missing values, shapes that are other than meant, points that equal others and go, bounds that
// change.

import assert from "node:assert/strict";
import test from "node:test";
import {Constrained, contours, Delaunay, DeloneError, interpolate, Power} from "delone/full";
import {prove} from "./support/oracle.mjs";
import {sets, uniform} from "./support/sets.mjs";

const fails = (work, code, index) =>
  assert.throws(work, (error) => {
    assert.ok(error instanceof DeloneError, String(error?.stack));
    if (code) assert.deepEqual([error.code, error.index], [code, index]);
    return true;
  });
const square = [0, 0, 4, 0, 4, 4, 0, 4];
const bounds = [0, 0, 4, 4];

test("points on a line up to rounding, and points that are not", () => {
  const t = 1.7e12;
  const dates = [t, 0, t + 1000, 0.001, t + 2000, 0, t + 1000, -0.001, t + 900, 0.0001];
  const grid = (count, origin, step) => Array.from({length: 2 * count * count}, (_, k) => origin + step * (k % 2 ? (k >> 1) % count : Math.floor((k >> 1) / count)));
  for (const points of [dates, grid(5, 1e6, 2 ** -29), grid(60, 1e6, 2 ** -28), grid(9, 1e15, 0.125)]) {
    const d = new Delaunay(points);
    assert.equal(d.collinear, undefined);
    const joined = Array.from({length: points.length / 2}, () => new Set());
    d.triangles.forEach((i, e) => joined[i].add(d.triangles[e % 3 === 2 ? e - 2 : e + 1]).add(d.triangles[e % 3 ? e - 1 : e + 2]));
    joined.forEach((found, i) => assert.deepEqual(new Set(d.neighbors(i)), found));
  }
  for (const scale of [1e-200, 1, 1e200, 1e300]) {
    assert.equal(new Delaunay(uniform(50).map((x) => scale * x)).collinear, undefined);
    for (const [a, b] of [[0.1, 0.7], [3, -1 / 3], [1e-9, 1e6]]) {
      const line = Array.from({length: 40}, (_, k) => scale * (k % 2 ? 5 + b * ((k >> 1) / 7) : a * ((k >> 1) / 7)));
      assert.deepEqual([...new Delaunay(line).collinear], Array.from({length: 20}, (_, k) => k));
    }
  }
  for (const tiny of [[0, 0, 5e-324, 0, 0, 5e-324], [1e308, -1e308, -1e308, 1e308, 1e308, 1e308]]) assert.equal(new Delaunay(tiny).collinear, undefined);
});

test("what equals a point that goes is gone with it", () => {
  const points = [...square, 1, 1, 1, 1, 1, 1];
  const d = new Delaunay(points);
  d.remove(4);
  const at = d.find(1, 1);
  assert.equal(at, 0);
  assert.equal(d.update().find(1, 1), at);
  prove(d, square);

  const moved = new Delaunay(points);
  moved.move(4, 1, 1);
  assert.deepEqual([...moved.duplicates], [5, 4, 6, 4]);
  moved.move(4, 2, 3);
  assert.deepEqual([moved.find(1, 1), moved.update().find(1, 1), moved.find(2, 3)], [0, 0, 4]);
  assert.equal(moved.duplicates.length, 0);
  moved.remove(4);
  assert.equal(moved.update().find(2, 3), 3);

  const line = new Delaunay([0, 0, 1, 0, 1, 0, 2, 0, 3, 0]);
  assert.deepEqual([...line.voronoi([-1, -1, 4, 1]).neighbors(3)], [1, 4]);
  line.remove(1);
  assert.deepEqual([[...line.collinear], [...line.neighbors(0)]], [[0, 3, 4], [3]]);

  const good = d.points;
  d.points = [0, 0, 1, NaN];
  fails(() => d.update(), "not-finite", 1);
  d.points = good;
  assert.equal(d.update().find(1, 1), at);
  d.points = uniform(20);
  assert.equal(d.update().find(d.points[8], d.points[9]), 4);
  prove(d, d.points);
});

test("rings of points with heights, in typed arrays, and of very many points", () => {
  const ring = [[0, 0, 9], [4, 0, 9], [0, 4, 9]];
  const flat = ring.map(([x, y]) => [x, y]);
  assert.deepEqual(Constrained.polygon([ring]), Constrained.polygon([flat.map((p) => Float64Array.from(p))]));
  const v = new Delaunay(uniform(30).map((x) => 4 * x)).voronoi(bounds);
  assert.deepEqual(v.clip([ring]), v.clip([flat]));
  assert.throws(() => v.clip(flat), {code: "input", message: "a polygon is an array of rings, a ring one of points, a point one of two numbers"});
  assert.deepEqual(v.clip(new Set([new Set(flat)])), v.clip([flat]));
  const inner = [[1, 1], [2, 1], [1, 2]];
  assert.deepEqual(Constrained.polygon([flat, inner], {fill: undefined}), Constrained.polygon([flat, inner]));
  const circle = Array.from({length: 130_000}, (_, k) => [Math.cos(k / 130_000 * 2 * Math.PI), Math.sin(k / 130_000 * 2 * Math.PI)]);
  assert.equal(Constrained.polygon([circle]).triangles.length, 3 * 129_998);
  assert.deepEqual(new Constrained(square, [Uint32Array.of(0, 2)]).constraints, new Constrained(square, [0, 2]).constraints);
});

test("bounds that change, and cells of a hub", () => {
  const v = new Delaunay(square).voronoi(bounds);
  assert.deepEqual(v.cellPolygon(1).map(([x]) => x).sort(), [2, 2, 2, 4, 4]);
  v.xmax = 8;
  assert.deepEqual(v.cellPolygon(1).map(([x]) => x).sort(), [2, 2, 2, 8, 8]);
  v.xmax = NaN;
  fails(() => v.cellPolygon(1), "bounds", undefined);
  const count = 3000;
  const hub = [0, 0];
  for (let k = 1; k < count; ++k) hub.push(Math.cos(2 * Math.PI * k / (count - 1)), Math.sin(2 * Math.PI * k / (count - 1)));
  const wheel = new Delaunay(hub).voronoi([-2, -2, 2, 2]);
  for (let i = 1; i < count; ++i) assert.equal([...wheel.neighbors(i)].length, 3);
  assert.equal([...wheel.neighbors(0)].length, count - 1);
});

test("missing values are not zero", () => {
  for (const missing of [null, undefined, "", [], NaN, {}, Symbol("x")]) {
    fails(() => new Power(square, [missing, 0, 0, 0], bounds), "not-finite", 0);
    fails(() => contours(new Delaunay(square), [0, missing, 1, 2], [1]), "not-finite", 1);
    fails(() => contours(new Delaunay(square), [0, 1, 1, 2], [missing]));
    assert.ok(Number.isNaN(interpolate(new Delaunay(square), [missing, 1, 1, 1], [1, 1])[0]));
    fails(() => new Delaunay(square).voronoi(bounds).clip([[[0, missing], [4, 0], [0, 4]]]));
    fails(() => Constrained.polygon([[[0, missing], [4, 0], [0, 4]]]), "not-finite", 0);
  }
  const like = {length: 4, 0: 0, 1: 1, 2: 2, 3: 1};
  assert.deepEqual(contours(new Delaunay(square), like, [0.5]), contours(new Delaunay(square), [0, 1, 2, 1], [0.5]));
  assert.deepEqual([...new Power([0, 0, 4, 0, 0, 4, 4, 0], [0, 0, 0, 0], bounds).hidden], [3]);
  fails(() => interpolate(new Delaunay([NaN, 0, 0, 0, 4, 0, 0, 4], {skipInvalid: true}), [0, 1, 2, 3], [1, 1, NaN, 1]), "not-finite", 1);
});

test("whatever is given, the error is one of this package", () => {
  const d = new Delaunay(square);
  const v = d.voronoi(bounds);
  const odd = [null, 5, "text", Symbol("x"), 1n, Object.create(null), [1n, 0, 2, 2], [Symbol("x"), 0, 2, 2], [null], [[null]], [[[1n, Symbol("x")]]]];
  for (const x of odd) {
    const tried = [
      () => d.voronoi(x), () => new Power(square, [0, 0, 0, 0], x), () => new Power(square, x, bounds), () => new Power(x, [], bounds),
      () => d.find(x, 0), () => v.contains(0, x, 0), () => d.nearest(x, 0), () => d.kNearest(0, 0, x), () => d.within(0, 0, x),
      () => d.locate(x, 0), () => d.locate(0, 0, x), () => d.insert(x, 1), () => d.remove(x), () => d.move(x, 0, 0), () => d.renderPoints(null, x),
      () => v.clip(x), () => Constrained.polygon(x), () => new Constrained(square, x), () => new Constrained(x, []), () => new Constrained(square, [], x),
      () => contours(d, x, [1]), () => contours(d, [0, 1, 2, 3], x), () => contours(x, [], []), () => interpolate(x, [], []),
      () => interpolate(d, x, [1, 1]), () => interpolate(d, [0, 1, 2, 3], x), () => interpolate(d, [0, 1, 2, 3], [1, 1], x),
      () => Delaunay.from([[0, 0]], x), () => Delaunay.from(x), () => new Delaunay(square, x), () => v.cellPolygon(x), () => d.trianglePolygon(x),
      () => new Constrained(square, [], {crossings: x}), () => new Constrained(square, [], {fill: x}), () => interpolate(d, [0, 1, 2, 3], [1, 1], {method: x}),
    ];
    for (const work of tried) {
      try {
        work();
      } catch (error) {
        assert.ok(error instanceof DeloneError, `${String(work)} of ${typeof x}: ${error?.stack}`);
      }
    }
  }
  assert.equal(d.trianglePolygon(-2), null);
  assert.equal(d.trianglePolygon(0.5), null);
  fails(() => new Constrained(square, [[0, 2, 1], [3]]), "no-such-point", 0);
  fails(() => new Constrained(square, [], {crossings: "foo"}), "range", undefined);
});
