// What delaunator's own tests ask (ISC, Mapbox), in our words. Its answers are compared as sets: triangles in any order, and a hull of
// points on a line from either end. Where its test data are large we take sets of our own, or those in data/torture.

import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import test from "node:test";
import {Delaunator} from "delone";
import {prove, triangleSet} from "./support/oracle.mjs";
import {uniform} from "./support/sets.mjs";

/** Integers on a map, many on lines and circles. */
const places = Array.from(uniform(1700, 3, [600, 400]), Math.round);
const pairs = (flat) => Array.from({length: flat.length / 2}, (_, i) => [flat[2 * i], flat[2 * i + 1]]);
const torture = (name) =>
  readFileSync(new URL(`../../../data/torture/${name}.txt`, import.meta.url), "utf8")
    .split("\n").filter((line) => line && !line.startsWith("#")).map((line) => line.trim().split(/[\s,]+/).map(Number));

function valid(points) {
  const d = Delaunator.from(points);
  prove(d, points.flat());
  return d;
}

test("a plain array, a typed array and an array of points are the same", () => {
  const {triangles} = Delaunator.from(pairs(places));
  assert.deepEqual(new Delaunator(places).triangles, triangles);
  assert.deepEqual(new Delaunator(Float64Array.from(places)).triangles, triangles);
  assert.ok(triangles instanceof Uint32Array);
});

test("the coordinates are kept as they are", () => {
  const coords = new Float32Array(places);
  assert.equal(new Delaunator(coords).coords, coords);
});

test("what is no array of numbers is refused", () => {
  assert.throws(() => new Delaunator({length: -1}), /Invalid typed array length/);
  assert.throws(() => new Delaunator(pairs(places)), /Expected coords to contain numbers/);
});

test("a map", () => void valid(pairs(places)));

test("again, after coordinates were changed in place", () => {
  const d = new Delaunator(Float64Array.from(places));
  prove(d, places);
  d.coords.set([80, 220]);
  d.update();
  prove(d, d.coords);
  assert.equal(d.trianglesLen, d.triangles.length);
  assert.deepEqual(triangleSet(d.triangles), triangleSet(new Delaunator([80, 220, ...places.slice(2)]).triangles));
});

test("issues 11 and 24", () => {
  valid([[516, 661], [369, 793], [426, 539], [273, 525], [204, 694], [747, 750], [454, 390]]);
  valid([[382, 302], [382, 328], [382, 205], [623, 175], [382, 188], [382, 284], [623, 87], [623, 341], [141, 227]]);
});

for (const name of ["delaunator-13", "delaunator-61", "delaunator-61-robust4", "delaunator-robust2", "delaunator-robust5"]) {
  test(`${name}, at several scales`, () => {
    const points = torture(name);
    assert.ok(points.length > 5);
    for (const factor of [1, 1e-9, 0.01, 100, 1e9]) valid(points.map(([x, y]) => [x * factor, y * factor]));
    valid(points.slice(0, 100));
  });
}

test("few points have no triangles", () => {
  for (const count of [0, 1, 2]) {
    const d = Delaunator.from(pairs(places).slice(0, count));
    assert.equal(d.triangles.length, 0);
    assert.deepEqual([...d.hull].sort(), [0, 1].slice(0, count));
  }
});

test("points on a line have none either, and a hull along it", () => {
  const d = Delaunator.from([[0, 0], [1, 0], [3, 0], [2, 0]]);
  assert.equal(d.triangles.length, 0);
  const along = [...d.hull];
  assert.deepEqual(along[0] === 0 ? along : along.reverse(), [0, 1, 3, 2]);
});

test("points of another form", () => {
  const points = [{x: 5, y: 5}, {x: 7, y: 5}, {x: 7, y: 6}];
  const d = Delaunator.from(points, (p) => p.x, (p) => p.y);
  assert.deepEqual(triangleSet(d.triangles), ["0,2,1"]);
});
