// Exactness, judged by integers: every set is proved to be triangulated, and is the same for any order of its points.

import assert from "node:assert/strict";
import test from "node:test";
import {Delaunator, Delaunay} from "delone";
import {exact, prove, squared} from "./support/oracle.mjs";
import {random, sets} from "./support/sets.mjs";

/** Triangles as sorted texts of coordinates, which do not depend on indices. */
const byPlace = (d, flat) => {
  const corners = Array.from(d.triangles, (i) => `${flat[2 * i]},${flat[2 * i + 1]}`);
  return Array.from({length: corners.length / 3}, (_, t) => corners.slice(3 * t, 3 * t + 3).sort().join(" ")).sort();
};

function shuffled(flat, seed) {
  const r = random(seed);
  const order = Array.from({length: flat.length / 2}, (_, i) => i);
  for (let i = order.length - 1; i > 0; --i) {
    const j = Math.floor(r() * (i + 1));
    [order[i], order[j]] = [order[j], order[i]];
  }
  return Float64Array.from(order.flatMap((i) => [flat[2 * i], flat[2 * i + 1]]));
}

for (const [name, points] of Object.entries(sets)) {
  test(`${name}: proved, in any order`, () => {
    const given = points.slice();
    const d = new Delaunator(points);
    assert.deepEqual(points, given, "points are not moved");
    prove(d, points);
    const expected = byPlace(d, points);
    for (const seed of [1, 2]) {
      const other = shuffled(points, seed);
      assert.deepEqual(byPlace(new Delaunator(other), other), expected);
    }
    const backwards = points.slice().reverse().map((_, k) => points[points.length - 2 - 2 * (k >> 1) + (k % 2)]);
    assert.deepEqual(byPlace(new Delaunator(backwards), backwards), expected);
  });

  test(`${name}: the nearest, by comparing all`, () => {
    if (!points.length) return;
    const d = new Delaunay(points);
    const r = random(5);
    const [x0, y0] = [points[0], points[1]];
    const queries = Array.from({length: 40}, (_, k) => {
      const i = Math.floor((r() * points.length) / 2);
      // On points, between two of them, and beside.
      return [points[2 * i], points[2 * i + 1], points[2 * i] / 2 + x0 / 2, points[2 * i + 1] / 2 + y0 / 2].slice(k % 2 ? 0 : 2).slice(0, 2);
    });
    const all = exact([...queries.flat(), ...points]);
    const sites = all.slice(queries.length);
    queries.forEach(([x, y], k) => {
      const distances = sites.map((p) => squared(p, all[k]));
      const least = distances.reduce((a, b) => (b < a ? b : a));
      const found = d.find(x, y);
      assert.equal(distances[found], least);
      assert.ok(d.inedges[found] !== -1 || !d.halfedges.length, "a vertex");
      sites.forEach((_, i) => {
        const isVertex = i === sites.findIndex((p) => String(p) === String(sites[i]));
        assert.equal(d.voronoi().contains(i, x, y), isVertex && distances[i] === least);
      });
    });
    d.dispose();
  });
}

test("k nearest and within a circle, by comparing all", () => {
  for (const points of [sets.uniform, sets["a grid with duplicates"], sets["a slanted line"]]) {
    const d = new Delaunay(points);
    const vertices = Array.from({length: points.length / 2}, (_, i) => i).filter((i) => !d.duplicates.some((j, k) => k % 2 === 0 && j === i));
    const [x, y] = [0.3, 0.4];
    const all = exact([x, y, ...points]);
    const away = (i) => squared(all[0], all[i + 1]);
    const expected = vertices.toSorted((i, j) => Number((a => (a > 0n) - (a < 0n))(away(i) - away(j))) || points[2 * i] - points[2 * j] || points[2 * i + 1] - points[2 * j + 1]);
    for (const k of [0, 1, 7, 10_000]) assert.deepEqual([...d.kNearest(x, y, k)], expected.slice(0, k));
    const circle = exact([0, 0, 2.5, 0, x, y, ...points]);
    const within = vertices.filter((i) => squared(circle[2], circle[i + 3]) <= squared(circle[0], circle[1]));
    assert.deepEqual([...d.within(x, y, 2.5)], within);
    assert.equal(d.within(x, y, -1).length, 0);
  }
});

test("location", () => {
  const d = Delaunay.from([[0, 0], [4, 0], [0, 4]]);
  assert.deepEqual(d.locate(1, 1), {kind: "triangle", triangle: 0, vertices: d.locate(1, 1).vertices});
  const about = (x, y) => [d.locate(x, y).kind, d.locate(x, y).vertices.sort()];
  assert.deepEqual(about(1, 1), ["triangle", [0, 1, 2]]);
  assert.deepEqual(about(2, 2), ["edge", [1, 2]]);
  assert.deepEqual(about(4, 0), ["vertex", [1]]);
  assert.deepEqual(about(3, 2), ["outside", [1, 2]]);
  assert.equal(d.locate(3, 2).triangle, -1);
  assert.deepEqual(Delaunay.from([]).locate(0, 0), {kind: "none", triangle: -1, vertices: []});
  const many = new Delaunay(sets.uniform);
  for (let t = 0; t < many.triangles.length / 3; ++t) {
    const ring = many.trianglePolygon(t).slice(0, 3);
    const [x, y] = [0, 1].map((k) => (ring[0][k] + ring[1][k] + ring[2][k]) / 3);
    assert.equal(many.locate(x, y).triangle, t);
  }
});
