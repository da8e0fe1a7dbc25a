// Copies of triangulations: what d3's have, and the way back.

import assert from "node:assert/strict";
import test from "node:test";
import {MessageChannel} from "node:worker_threads";
import {Delaunay as D3} from "d3-delaunay";
import {Delaunay, DeloneError} from "delone/full";
import {triangleSet} from "./support/oracle.mjs";
import {sets, uniform} from "./support/sets.mjs";

const posted = async (value) => {
  const {port1, port2} = new MessageChannel();
  const heard = new Promise((resolve) => port2.once("message", resolve));
  port1.postMessage(value);
  const copy = await heard;
  port1.close();
  return copy;
};
const ways = {structuredClone, postMessage: posted, spread: (d) => ({...d}), assign: (d) => Object.assign({}, d)};
const names = ["points", "halfedges", "hull", "triangles", "inedges"];

for (const [way, copy] of Object.entries(ways)) {
  test(`a copy by ${way} has the arrays, as one of d3 has`, async () => {
    for (const points of [sets.uniform, sets["a grid"], sets["a level line"], Float64Array.of(1, 2), Float64Array.of(1, 2, 3, 4)]) {
      const d = new Delaunay(points);
      const [ours, theirs] = [await copy(d), await copy(new D3(points.slice()))];
      for (const name of names) assert.equal(Object.hasOwn(theirs, name) && ArrayBuffer.isView(ours[name]), true, name);
      for (const name of names) assert.deepEqual(ours[name], d[name], name);
      assert.deepEqual(ours.collinear, d.collinear);
      const v = d.voronoi([0, 0, 1, 1]);
      const cells = await copy(v);
      for (const name of ["xmin", "ymin", "xmax", "ymax", "circumcenters", "vectors"]) assert.deepEqual(cells[name], v[name], name);
      assert.deepEqual(cells.delaunay.triangles, d.triangles);
    }
  });
}

test("triangulations of copies", async () => {
  const points = uniform(100);
  points.set(points.subarray(0, 2), 20);
  points[30] = NaN;
  const d = new Delaunay(points, {skipInvalid: true});
  d.move(d.insert(0.5, 0.25), 0.75, 0.25);
  d.remove(3);
  d.remove(0);
  assert.deepEqual([...d.removed], [0, 3, 10], "also the one that equalled it");
  for (const copy of [...Object.values(ways), (d) => JSON.parse(JSON.stringify(d))]) {
    const again = Delaunay.fromJSON(await copy(d), {skipInvalid: true});
    assert.ok(again instanceof Delaunay);
    assert.deepEqual(triangleSet(again.triangles), triangleSet(d.triangles));
    assert.deepEqual([...again.points], [...d.points]);
    assert.deepEqual(again.removed, d.removed);
    // It has its own points.
    again.move(5, 0.5, 0.125);
    assert.notEqual(d.points[10], 0.5);
    again.dispose();
  }
  const {triangles, hull} = JSON.parse(JSON.stringify(d));
  assert.deepEqual([triangles, hull], [[...d.triangles], [...d.hull]]);
  assert.deepEqual(JSON.parse(JSON.stringify({v: d.voronoi([0, 0, 1, 1])})).v.delaunay.triangles, triangles);
  const isWrong = (code) => (error) => error instanceof DeloneError && error.code === code;
  for (const copy of [null, 3, {}, {points: 3}, {points: [0, 0], removed: 1}]) assert.throws(() => Delaunay.fromJSON(copy), isWrong("input"));
  for (const removed of [[1], [-1], [0.5], ["0"]]) assert.throws(() => Delaunay.fromJSON({points: [0, 0], removed}), isWrong("no-such-point"));
  assert.throws(() => Delaunay.fromJSON(structuredClone(d)), isWrong("not-finite"));
  d.dispose();
  const last = structuredClone(d);
  assert.deepEqual([last.triangles, [...last.removed]], [undefined, [0, 3, 10]], "arrays cannot be had any more");
  assert.deepEqual(Object.keys(JSON.parse(JSON.stringify(d))), ["points", "removed"]);
  assert.deepEqual(Delaunay.fromJSON(last, {skipInvalid: true}).hull, Uint32Array.from(hull));
  assert.deepEqual(d.update().hull, Uint32Array.from(hull), "an update makes them again");
});
