// What the full module has beyond the small one: changes, proofs, paths, constraints, values between points.

import assert from "node:assert/strict";
import test from "node:test";
import {Constrained, Delaunay, DeloneError, contours, interpolate} from "delone/full";
import {exact, prove, triangleSet, turn} from "./support/oracle.mjs";
import {random, sets, uniform} from "./support/sets.mjs";

const fails = (code, index, work) =>
  assert.throws(work, (error) => error instanceof DeloneError && error.code === code && error.index === index || assert.fail(`${error.code} ${error.index} ${error}`));

/** Triangles as a set; none of one or two points, where there are three numbers that are none. */
const trianglesOf = (d, name = (i) => i) => (d.hull.length > 2 ? triangleSet(Uint32Array.from(d.triangles, name)) : []);

for (const [name, start] of Object.entries({uniform: uniform(60), grid: sets["a grid"], line: sets["a level line"], nothing: new Float64Array(0)})) {
  test(`changes of ${name} are as if built anew`, () => {
    const d = new Delaunay(start);
    const r = random(7);
    const there = new Map(Array.from({length: start.length / 2}, (_, i) => [i, [start[2 * i], start[2 * i + 1]]]));
    const somewhere = () => (r() < 0.5 ? [Math.floor(8 * r()), Math.floor(8 * r())] : [8 * r(), 8 * r()]);
    for (let step = 0; step < 300; ++step) {
      const keys = [...there.keys()];
      const any = keys[Math.floor(r() * keys.length)];
      const [x, y] = somewhere();
      const twin = keys.find((i) => there.get(i)[0] === x && there.get(i)[1] === y);
      const dice = r();
      if (dice < 0.5 || !keys.length) {
        const i = d.insert(x, y);
        if (twin === undefined) there.set(i, [x, y]);
        else assert.equal(i, twin, "the one that is there");
      } else if (dice < 0.75) {
        d.remove(any);
        there.delete(any);
        fails("no-such-point", any, () => d.remove(any));
      } else if (twin !== undefined && twin !== any) {
        fails("occupied", twin, () => d.move(any, x, y));
      } else {
        d.move(any, x, y);
        there.set(any, [x, y]);
      }
      if (step % 10) continue;
      d.check();
      prove(d, d.points, (i) => there.has(i));
      const kept = [...there.keys()];
      const fresh = new Delaunay(kept.flatMap((i) => there.get(i)));
      assert.deepEqual(trianglesOf(d, (i) => kept.indexOf(i)), trianglesOf(fresh));
      for (let i = 0; i < d.points.length / 2; ++i) assert.equal(d.inedges[i] === -1 && there.has(i) && kept.length > 2 && d.triangles.length > 3, false);
      fresh.dispose();
    }
    const before = trianglesOf(d);
    d.update();
    assert.deepEqual(trianglesOf(d), before, "an update brings nothing back");
    assert.deepEqual([...start], [...start.slice()], "the given array is not changed");
  });
}

test("a change costs what it changes, whatever strategy is at work", () => {
  const d = new Delaunay(uniform(50_000));
  const r = random(3);
  const median = (change) => {
    const times = Array.from({length: 15}, () => {
      const start = performance.now();
      for (let k = 0; k < 20; ++k) change();
      return performance.now() - start;
    });
    return times.sort((a, b) => a - b)[7];
  };
  d.remove(40_000);
  for (const strategy of ["tree", "walk", "jump-and-walk", "hierarchy", "history"]) {
    d.locate(r(), r(), {strategy});
    d.move(7, r(), r());
    // Anew for each, a tree of hints would take some hundred times as long as an insertion.
    const [insert, move] = [() => d.insert(r(), r()), () => d.move(7, r(), r())].map(median);
    assert.ok(move < 20 * insert, `${strategy}: ${move} and ${insert} ms`);
  }
  d.check();
  d.dispose();
});

test("a diagram follows changes", () => {
  const d = new Delaunay([0, 0, 4, 0]);
  const v = d.voronoi([-2, -2, 6, 2]);
  assert.deepEqual([...v.areas()], [16, 16]);
  d.insert(8, 0);
  assert.deepEqual([...v.areas()], [16, 16, 0]);
  d.move(2, 2, 0);
  assert.deepEqual([...v.areas()], [12, 12, 8]);
  d.remove(0);
  assert.equal(v.cellPolygon(0), null);
  assert.deepEqual([...v.areas()].slice(1), [12, 20]);
});

test("every strategy finds the same, and tells the way", () => {
  const d = new Delaunay(uniform(2000));
  const paths = {};
  for (const strategy of ["tree", "walk", "jump-and-walk", "hierarchy", "history"]) {
    const {path, ...found} = d.locate(0.31, 0.77, {strategy});
    assert.deepEqual(found, d.locate(0.31, 0.77));
    assert.ok(path.length > 0 && path.every((polygon) => polygon.length >= 1 && polygon.length <= 3));
    paths[strategy] = path.length;
  }
  assert.ok(paths.walk > paths.tree, "a hint is nearer");
  const triangle = d.trianglePolygon(d.locate(0.31, 0.77).triangle).slice(0, 3).map(String).sort();
  assert.ok(d.locate(0.31, 0.77, {strategy: "walk"}).path.some((p) => String(p.map(String).sort()) === String(triangle)));
});

test("cells clipped to a polygon with a hole", () => {
  const d = new Delaunay(uniform(50));
  const rings = [[[0, 0], [1, 0], [1, 1], [0, 1]], [[0.25, 0.25], [0.5, 0.25], [0.5, 0.5], [0.25, 0.5]]];
  const area = (ring) => ring.slice(1).reduce((sum, [x, y], k) => sum + (ring[k][0] * y - x * ring[k][1]) / 2, 0);
  const sum = d.voronoi().clip(rings).flat().map(area).reduce((a, b) => a + b);
  assert.ok(Math.abs(sum - 15 / 16) < 1e-12);
  fails("region", 0, () => d.voronoi().clip([[[0, 0], [1, 1], [1, 0], [0, 1]]]));
});

test("segments are edges, and what is inside", () => {
  const square = [0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 3, 1, 2, 3];
  const rings = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]];
  const c = new Constrained(square, rings, {fill: "even-odd"});
  const points = exact(square);
  const unit = turn(...exact([0, 0, 1, 0, 0, 1, ...square]).slice(0, 3));
  let twice = 0n;
  for (let t = 0; t < c.triangles.length; t += 3) twice -= turn(...[0, 1, 2].map((k) => points[c.triangles[t + k]]));
  assert.equal(twice, 28n * unit);
  assert.equal(c.constraints.length, 14);
  assert.equal(new Constrained(square, rings).triangles.length > c.triangles.length, true);
  const outline = [[0, 1, 2, 3], [4, 5, 6]].map((ring) => ring.map((i) => [square[2 * i], square[2 * i + 1]]));
  assert.deepEqual(triangleSet(Constrained.polygon(outline).triangles), triangleSet(c.triangles));
  fails("segments-cross", 0, () => new Constrained([0, 0, 2, 2, 0, 2, 2, 0], [[0, 1], [2, 3]]));
  assert.deepEqual([...new Constrained([0, 0, 2, 2, 0, 2, 2, 0], [[0, 1], [2, 3]], {crossings: "split"}).points.slice(8)], [1, 1]);
  fails("no-such-point", 1, () => new Constrained(square, [[0, 1], [1, 99]]));
  for (const segments of [[[0, 1], [-1, 2]], [[0, 1], [2]], [[0, 1], [2, 2.5]]]) fails("no-such-point", 1, () => new Constrained(square, segments));
});

test("values between points", () => {
  const points = uniform(200);
  points[6] = NaN;
  const d = new Delaunay(points, {skipInvalid: true});
  const plane = (x, y) => 3 * x - 2 * y + 1;
  const values = Array.from({length: 200}, (_, i) => plane(points[2 * i], points[2 * i + 1]));
  values[3] = 1e9;
  for (const method of ["linear", "sibson", "laplace"]) {
    const [inside, outside] = interpolate(d, values, [0.5, 0.5, 9, 9], {method});
    assert.ok(Math.abs(inside - plane(0.5, 0.5)) < 1e-12);
    assert.ok(Number.isNaN(outside));
    const [at] = interpolate(d, values, [9, 9], {method, outside: "nearest"});
    assert.equal(at, values[d.find(9, 9)]);
    // Beyond the middle of a side of the hull: what the side has there.
    const [a, b] = [d.hull[0], d.hull[1]];
    const [[ax, ay], [bx, by]] = [a, b].map((i) => [points[2 * i], points[2 * i + 1]]);
    const beyond = (sign) => [(ax + bx) / 2 + sign * (by - ay), (ay + by) / 2 - sign * (bx - ax)];
    const [own, other] = interpolate(d, values, [...beyond(9), ...beyond(-9)], {method, outside: "hull"});
    const middle = plane((ax + bx) / 2, (ay + by) / 2);
    assert.ok(Math.min(Math.abs(own - middle), Math.abs(other - middle)) < 1e-9);
    const [inner] = interpolate(d, values, [0.5, 0.5], {method, outside: "hull"});
    assert.equal(inner, inside);
  }
  fails("range", undefined, () => interpolate(d, values, [0, 0], {outside: "far"}));
  fails("values", undefined, () => interpolate(d, [1, 2], [0, 0]));
  fails("range", undefined, () => interpolate(d, values, [0, 0], {method: "guess"}));
  fails("not-finite", 1, () => interpolate(d, values, [0, 0, NaN, 0]));
  const lines = contours(d, values, [1, 1.5]);
  assert.deepEqual(lines.map((line) => line.level), [1, 1.5]);
  for (const {level, points} of lines) for (const [x, y] of points) assert.ok(Math.abs(plane(x, y) - level) < 1e-12);
  fails("not-finite", 0, () => contours(d, [NaN, ...values.slice(1)], [1]));
});
