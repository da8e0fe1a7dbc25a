// Memory of the module: arrays handed out outlive its growth, it is used again after dispose and after garbage collection, and where
// there is none that is a typed error.

import assert from "node:assert/strict";
import test from "node:test";
import {Delaunator, Delaunay, DeloneError} from "delone";
import {currentEngine} from "../js/module.js";
import {prove} from "./support/oracle.mjs";
import {sets, uniform} from "./support/sets.mjs";

const size = () => currentEngine().exports.memory.buffer.byteLength;

test("arrays stay as they are while memory grows", () => {
  const d = new Delaunay(sets.uniform);
  const {triangles, halfedges, hull} = d;
  const cell = d.voronoi([0, 0, 1, 1]).circumcenters;
  const copies = [triangles, halfedges, hull, cell].map((array) => array.slice());
  const before = size();
  const large = new Delaunay(uniform(300_000));
  assert.ok(size() > before, "it has grown");
  assert.deepEqual([triangles, halfedges, hull, cell], copies);
  prove(d, sets.uniform);
  assert.equal(large.hull.length > 3, true);
  large.dispose();
});

test("memory is used again", () => {
  const points = uniform(50_000);
  const once = () => new Delaunay(points).dispose();
  once();
  const before = size();
  for (let k = 0; k < 20; ++k) {
    once();
    new Delaunator(points);
  }
  assert.equal(size(), before);
});

test("and without dispose, after garbage collection", {skip: !globalThis.gc && "needs --expose-gc"}, async () => {
  const points = uniform(50_000);
  const before = size();
  for (let k = 0; k < 30; ++k) {
    new Delaunay(points);
    globalThis.gc();
    await new Promise((resolve) => setTimeout(resolve));
  }
  // Some wait for the collector; thirty would take ten times as much.
  assert.ok(size() - before < 30e6, `${size() - before}`);
});

test("what a triangulation takes is no more than what is asked for before", () => {
  const count = 400_000;
  const before = size();
  const d = new Delaunay(uniform(count));
  void d.triangles;
  const each = (size() - before) / count;
  assert.ok(each < 200 + 16, `${each} bytes a point`);
  // Some cells that are cut have more corners than their points have triangles.
  const between = size();
  void d.voronoi([0, 0, 1, 1]).cellPolygon(0);
  const cell = (size() - between) / count;
  assert.ok(cell < 200 + 16, `${cell} bytes a cell`);
  d.dispose();
});

test("memory that there is not", () => {
  const isMemory = (error) => error instanceof DeloneError && error.code === "memory";
  // So many points would fit into the address space, and their triangulation would not.
  const engine = currentEngine();
  assert.throws(() => engine.call(undefined, "room_for_points", 2 ** 28), isMemory);
  engine.call(undefined, "room_for_points", 25_000_000);
  assert.throws(() => engine.call(undefined, "triangulate"), isMemory);
  prove(new Delaunator(sets.uniform), sets.uniform);
});

test("after a trap other triangulations can be made, and those that there were are lost", () => {
  const old = new Delaunay(sets.uniform);
  const engine = currentEngine();
  assert.throws(() => engine.call(undefined, "trap"), (error) => error.code === "unavailable");
  engine.exports = {...engine.exports, nearest: () => { throw new WebAssembly.RuntimeError("unreachable"); }};
  assert.throws(() => old.find(0, 0), (error) => error.code === "internal" && error.cause instanceof WebAssembly.RuntimeError);
  assert.throws(() => old.find(0, 0), (error) => error.code === "lost");
  prove(new Delaunator(sets.uniform), sets.uniform);
  old.dispose();
});
