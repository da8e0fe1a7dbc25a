// Power cells, beside their definition: the bounds cut by the radical line with every other point, in doubles.

import assert from "node:assert/strict";
import test from "node:test";
import {Delaunay, DeloneError, Power} from "delone/full";
import {triangleSet} from "./support/oracle.mjs";
import {area, half} from "./support/polygons.mjs";
import {random, sets, uniform} from "./support/sets.mjs";

function definition(points, weights, i, [xmin, ymin, xmax, ymax]) {
  let cell = [[xmin, ymin], [xmax, ymin], [xmax, ymax], [xmin, ymax]];
  const power = ([x, y], k) => (x - points[2 * k]) ** 2 + (y - points[2 * k + 1]) ** 2 - weights[k];
  for (let j = 0; j < points.length / 2; ++j) if (j !== i) cell = half(cell, (p) => power(p, j) - power(p, i));
  return cell;
}

const weighted = (points, most, seed = 3) => {
  const r = random(seed);
  return Float64Array.from({length: points.length / 2}, () => most * r());
};

for (const [name, points, most, bounds] of [
  ["uniform points", uniform(200), 0.004, [0, 0, 1, 1]],
  ["uniform points, most of them hidden", uniform(200), 0.2, [0.1, 0.2, 0.9, 0.7]],
  ["a grid", sets["a grid"], 0.7, [-1, -1, 16, 16]],
  ["a line", sets["a slanted line"], 2, [-3, -3, 50, 60]],
  ["two points", sets["two points"], 1, [-10, -10, 20, 20]],
  ["one point", sets["one point"], 1, [-10, -10, 20, 20]],
]) {
  test(`power cells of ${name}`, () => {
    const weights = weighted(points, most);
    const power = new Power(points, weights, bounds);
    const whole = (bounds[2] - bounds[0]) * (bounds[3] - bounds[1]);
    let sum = 0;
    let seen = 0;
    const polygons = new Map([...power.cellPolygons()].map((polygon) => [polygon.index, polygon]));
    for (let i = 0; i < weights.length; ++i) {
      const expected = definition(points, weights, i, bounds);
      const size = expected.length ? Math.abs(area(expected)) : 0;
      assert.ok(Math.abs(power.areas[i] - size) < 1e-9 * whole, `${i}: ${power.areas[i]} for ${size}`);
      const polygon = power.cellPolygon(i);
      assert.deepEqual(polygons.get(i) && [...polygons.get(i)], polygon ?? undefined);
      assert.ok(Math.abs((polygon ? Math.abs(area(polygon.slice(0, -1))) : 0) - size) < 1e-9 * whole);
      if (polygon) assert.deepEqual(polygon[0], polygon.at(-1));
      if (power.hidden.includes(i)) assert.equal(polygon, null);
      seen += polygon ? 1 : 0;
      sum += power.areas[i];
    }
    assert.ok(Math.abs(sum - whole) < 1e-9 * whole, "cells tile the bounds");
    assert.ok(seen > 0);
  });
}

test("equal weights change nothing", () => {
  const points = uniform(300);
  const d = new Delaunay(points);
  for (const weight of [0, 5, -2]) {
    const power = new Power(points, new Float64Array(300).fill(weight), [0, 0, 1, 1]);
    assert.deepEqual(triangleSet(power.triangles), triangleSet(d.triangles));
    assert.equal(power.hidden.length, 0);
  }
});

test("a light point beside a heavy one is hidden", () => {
  const power = new Power([0, 0, 4, 0, 0, 4, 1, 1], [0, 0, 0, -100], [0, 0, 4, 4]);
  assert.deepEqual([...power.hidden], [3]);
  assert.deepEqual([...power.triangles].sort(), [0, 1, 2]);
  assert.equal(power.cellPolygon(3), null);
  assert.equal(power.cellPolygon(99), null);
});

test("what is wrong is told", () => {
  const fails = (code, index, ...given) => assert.throws(() => new Power(...given), (error) => error instanceof DeloneError && error.code === code && error.index === index);
  fails("values", undefined, [0, 0, 1, 1], [1]);
  fails("not-finite", 1, [0, 0, 1, 1], [1, NaN]);
  fails("not-finite", 1, [0, 0, Infinity, 1], [1, 1]);
  fails("bounds", undefined, [0, 0, 1, 1], [1, 1], [0, 0, 0, 1]);
});
