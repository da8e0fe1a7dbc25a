// What users give by mistake, and what they may do to a triangulation: each a typed error, and nothing is broken afterwards.

import assert from "node:assert/strict";
import test from "node:test";
import {Delaunator, Delaunay, DeloneError} from "delone";
import {prove} from "./support/oracle.mjs";
import {sets, uniform} from "./support/sets.mjs";

const fails = (code, index, work) =>
  assert.throws(work, (error) => {
    assert.ok(error instanceof DeloneError, String(error));
    assert.deepEqual([error.code, error.index], [code, index]);
    assert.ok(error.message.length > 10);
    return true;
  });

const bad = [
  ["NaN", "not-finite", 1, [0, 0, 1, NaN, 2, 3]],
  ["infinity", "not-finite", 2, [0, 0, 1, 1, -Infinity, 3]],
  ["NaN in a typed array", "not-finite", 1, Float64Array.of(0, 0, NaN, 1, 2, 3)],
  ["infinity in 32 bits", "not-finite", 0, Float32Array.of(1e39, 0, 1, 1)],
  ["a hole", "not-finite", 1, [0, 0, , 1, 2, 3]],
  ["undefined", "not-finite", 1, [0, 0, 1, undefined, 2, 3]],
  ["null", "not-finite", 0, [0, null, 1, 2, 2, 3]],
  ["text", "not-a-number", 1, [0, 0, "1", 1]],
  ["a big integer", "not-a-number", 0, [0n, 0]],
  ["big integers", "not-a-number", 0, BigInt64Array.of(1n, 2n)],
  ["a symbol", "not-a-number", 0, [Symbol("x"), 0]],
  ["an object", "not-a-number", 0, [{}, 0]],
  ["points", "not-a-number", 0, [[0, 0], [1, 1]]],
  ["a length below zero", "length", undefined, {length: -2}],
  ["a broken length", "length", undefined, {length: 2.5}],
  ["no length", "length", undefined, {}],
  ["too long", "too-many-points", undefined, {length: 2 ** 40}],
  ["a length alone", "input", undefined, {length: 1e9}],
  ["holes alone", "input", undefined, new Array(1e9)],
  ["nothing", "input", undefined, undefined],
  ["null itself", "input", undefined, null],
  ["a number", "input", undefined, 7],
];

for (const [name, code, index, input] of bad) {
  test(`refused: ${name}`, () => {
    for (const Class of [Delaunator, Delaunay]) fails(code, index, () => new Class(input));
    prove(new Delaunator(sets.uniform), sets.uniform);
  });
}

test("refused: points that are none", () => {
  for (const Class of [Delaunator, Delaunay]) {
    fails("not-finite", 1, () => Class.from([[0, 0], undefined, [1, 1]]));
    fails("not-finite", 0, () => Class.from([[null, 0]]));
    fails("not-finite", 2, () => Class.from([{x: 0, y: 0}, {x: 1, y: 1}, {x: 2}], (p) => p.x, (p) => p.y));
    fails("input", undefined, () => Class.from(null));
    fails("too-many-points", undefined, () => Class.from({length: 2 ** 33}));
    fails("input", undefined, () => Class.from({length: 5e8}));
  }
  fails("input", undefined, () => Delaunay.from({}));
  // What other libraries take is named.
  assert.throws(() => Delaunay.from([0, 0, 1, 0, 0, 1]), /new Delaunay takes a flat array/);
  assert.throws(() => Delaunay.from([{x: 0, y: 0}, {x: 1, y: 0}]), /from\(points, \(p\) => p\.x, \(p\) => p\.y\)/);
  assert.throws(() => new Delaunay([[0, 0], [1, 0]]), /Delaunay\.from takes points/);
  assert.throws(() => Delaunay.from([[0, 0]]).voronoi(800, 600), /\[xmin, ymin, xmax, ymax\]/);
});

test("text that says a number is one, as in d3; what is empty is not", () => {
  assert.deepEqual(Delaunay.from([["1", "2"]]).points, Float64Array.of(1, 2));
  assert.deepEqual(Delaunay.from([[new Date(5), true]]).points, Float64Array.of(5, 1));
  fails("not-finite", 0, () => Delaunay.from([["", 2]]));
  fails("not-finite", 0, () => Delaunay.from([["one", 2]]));
});

test("of an odd number of coordinates the last is ignored", () => {
  assert.equal(new Delaunay([1]).hull.length, 0);
  assert.equal(new Delaunay([1]).find(0, 0), -1);
  assert.equal(new Delaunay([0, 0, 1, 0, 0, 1, 5]).triangles.length, 3);
  assert.equal(new Delaunator(Float64Array.of(0, 0, 1, 0, 0, 1, NaN)).triangles.length, 3);
});

test("skipInvalid leaves points out, and the others keep their indices", () => {
  const flat = Float64Array.from(uniform(100));
  const gone = new Set([0, 7, 50, 99]);
  const expected = new Delaunay(flat.slice());
  for (const i of gone) flat[2 * i + (i % 2)] = [NaN, Infinity][i % 2];
  const isThere = (i) => !gone.has(i);
  const options = {skipInvalid: true};
  const pairs = Array.from({length: 100}, (_, i) => (i === 7 ? undefined : [flat[2 * i], flat[2 * i + 1]]));
  for (const d of [new Delaunator(flat, options), new Delaunay(flat, options), Delaunay.from(pairs, options), Delaunator.from(pairs, options)]) {
    prove(d, flat, isThere);
  }
  const d = new Delaunay(flat, options);
  const v = d.voronoi([0, 0, 1, 1]);
  for (let i = 0; i < 100; ++i) {
    assert.equal(d.inedges[i] === -1, !isThere(i));
    assert.equal(v.cellPolygon(i) === null, !isThere(i));
    assert.equal(v.contains(i, flat[2 * i], flat[2 * i + 1]), isThere(i));
    if (isThere(i)) assert.equal(d.find(expected.points[2 * i], expected.points[2 * i + 1]), i);
    else assert.deepEqual([...d.neighbors(i)], []);
  }
  assert.ok(Math.abs(v.areas().reduce((a, b) => a + b) - 1) < 1e-12);
  assert.equal([...v.cellPolygons()].length, 96);
  flat[0] = 0.5;
  d.update();
  prove(d, flat, (i) => i === 0 || isThere(i));
  assert.equal(Delaunay.from([[NaN, 0]], options).find(0, 0), -1);
});

test("queries that are none", () => {
  const d = new Delaunay(sets.uniform);
  assert.equal(d.find(Infinity, 0), -1);
  assert.equal(d.find(undefined, 0), -1);
  for (const work of [() => d.nearest(NaN, 0), () => d.kNearest(0, 0, NaN), () => d.within(0, 0, Infinity), () => d.locate("x", 0), () => d.insert(0, null)]) {
    fails("not-finite", undefined, work);
  }
  fails("range", undefined, () => d.locate(0, 0, {strategy: "luck"}));
  assert.deepEqual([...d.neighbors(-1)], []);
  assert.deepEqual([...d.neighbors(1e9)], []);
  const v = d.voronoi([0, 0, 1, 1]);
  for (const i of [-1, 1e9, NaN, 0.5, undefined, "0"]) {
    assert.equal(v.cellPolygon(i), null);
    assert.equal(v.contains(i, 0, 0), false);
    assert.deepEqual([...v.neighbors(i)], []);
  }
});

test("a million equal points", () => {
  const d = new Delaunay(new Float64Array(2e6).fill(7));
  assert.deepEqual([...d.hull], [0]);
  assert.equal(d.duplicates.length, 2 * (1e6 - 1));
  assert.equal(d.voronoi([0, 0, 10, 10]).cellPolygon(0).length, 5);
  d.dispose();
});

test("after dispose arrays are gone, all else that needs the module is an error, and a second dispose is none", () => {
  const d = new Delaunay(sets.uniform);
  const v = d.voronoi();
  d.dispose();
  d.dispose();
  const uses = [() => d.find(0, 0), () => d.hullPolygon(), () => d.trianglePolygon(0), () => d.render(), () => d.duplicates, () => [...d.neighbors(0)], () => d.nearest(0, 0), () => v.cellPolygon(0), () => v.contains(0, 0, 0), () => v.areas(), () => v.render()];
  for (const use of uses) fails("disposed", undefined, use);
  // Tools read all properties, whatever they are.
  for (const name of ["triangles", "halfedges", "hull", "inedges", "collinear"]) assert.equal(d[name], undefined, name);
  for (const name of ["circumcenters", "vectors"]) assert.equal(v[name], undefined, name);
  d.update();
  prove(d, sets.uniform);
  assert.equal(v.circumcenters.length, (2 * d.triangles.length) / 3);
  if (Symbol.dispose) assert.equal(d[Symbol.dispose], d.dispose);
});
