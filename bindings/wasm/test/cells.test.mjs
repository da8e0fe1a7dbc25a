// Cells, beside their definition: the bounds cut by the bisector with every other point, in doubles.

import assert from "node:assert/strict";
import test from "node:test";
import {Delaunay} from "delone";
import {area, half} from "./support/polygons.mjs";
import {sets, uniform} from "./support/sets.mjs";

function definition(points, i, [xmin, ymin, xmax, ymax]) {
  let cell = [[xmin, ymin], [xmax, ymin], [xmax, ymax], [xmin, ymax]];
  const [px, py] = [points[2 * i], points[2 * i + 1]];
  for (let j = 0; j < points.length / 2; ++j) {
    const [qx, qy] = [points[2 * j], points[2 * j + 1]];
    if (qx === px && qy === py) continue;
    cell = half(cell, ([x, y]) => (px - qx) * (x - (px + qx) / 2) + (py - qy) * (y - (py + qy) / 2));
  }
  return cell;
}

const centroid = (ring) => {
  const [cx, cy] = ring[0];
  const sums = [0, 0];
  ring.forEach(([x, y], k) => {
    const [u, v] = ring[(k + 1) % ring.length];
    const cross = (x - cx) * (v - cy) - (u - cx) * (y - cy);
    sums[0] += cross * (x + u - 2 * cx);
    sums[1] += cross * (y + v - 2 * cy);
  });
  return [cx + sums[0] / (6 * area(ring)), cy + sums[1] / (6 * area(ring))];
};

const cases = {
  uniform: [uniform(200), [0.1, 0.2, 0.8, 0.9]],
  "bounds away from all points": [uniform(100), [3, 4, 5, 6]],
  "bounds around all points": [uniform(100), [-10, -10, 10, 10]],
  "a grid": [sets["a grid"], [-1, -1, 16, 16]],
  "a turned grid": [sets["a turned grid"], [-5, -1, 16, 20]],
  "a grid with duplicates": [sets["a grid with duplicates"], [-3, -3, 9.5, 9.5]],
  "a line": [sets["a slanted line"], [-3, -3, 50, 60]],
  "a circle": [sets["a circle"], [-2, -2, 2, 2]],
  "two points": [sets["two points"], [0, 0, 10, 10]],
  "one point": [sets["one point"], [0, 0, 10, 10]],
};

for (const [name, [points, bounds]] of Object.entries(cases)) {
  test(`cells of ${name}`, () => {
    const d = new Delaunay(points);
    const v = d.voronoi(bounds);
    const [width, height] = [bounds[2] - bounds[0], bounds[3] - bounds[1]];
    const small = 1e-9 * width * height;
    const duplicates = new Set([...d.duplicates].filter((_, k) => k % 2 === 0));
    const areas = v.areas();
    const relaxed = v.relax();
    let sum = 0;
    for (let i = 0; i < points.length / 2; ++i) {
      const cell = v.cellPolygon(i)?.slice(0, -1) ?? [];
      const expected = duplicates.has(i) ? [] : definition(points, i, bounds);
      const [found, wanted] = [cell, expected].map((ring) => (ring.length ? area(ring) : 0));
      assert.ok(Math.abs(found - wanted) < small, `${i}: ${found} for ${wanted}`);
      assert.ok(Math.abs(areas[i] - found) < small);
      sum += found;
      // Every corner found is near one of the definition, and the other way round.
      if (found > 1e3 * small) {
        for (const [from, to] of [[cell, expected], [expected, cell]]) {
          for (const [x, y] of from) assert.ok(to.some(([u, w]) => Math.hypot(x - u, y - w) < 1e-6 * (width + height)), `a corner of ${i}`);
        }
        const [x, y] = centroid(cell);
        assert.ok(Math.hypot(relaxed[2 * i] - x, relaxed[2 * i + 1] - y) < 1e-6 * (width + height));
      }
      for (const [x, y] of cell) assert.ok(x >= bounds[0] && x <= bounds[2] && y >= bounds[1] && y <= bounds[3], "in the bounds");
    }
    assert.ok(Math.abs(sum - width * height) < small, "cells tile the bounds");
    d.duplicates.forEach((j, k) => {
      if (k % 2) assert.deepEqual(relaxed.subarray(2 * d.duplicates[k - 1], 2 * d.duplicates[k - 1] + 2), relaxed.subarray(2 * j, 2 * j + 2));
    });
  });

  test(`neighbors of cells and edges drawn of ${name}`, () => {
    const d = new Delaunay(points);
    const v = d.voronoi(bounds);
    const count = points.length / 2;
    const sides = [];
    for (let i = 0; i < count; ++i) {
      const neighbors = [...v.neighbors(i)];
      for (const j of neighbors) assert.ok([...v.neighbors(j)].includes(i), "neighbors of each other");
      const cell = v.cellPolygon(i) ?? [];
      const inner = cell.slice(1).filter(([x, y], k) => {
        const [u, w] = cell[k];
        return !((x === u && (x === bounds[0] || x === bounds[2])) || (y === w && (y === bounds[1] || y === bounds[3])));
      });
      assert.equal(inner.length, neighbors.length, "a side for each neighbor");
      sides.push(inner.length);
    }
    const drawn = (v.render() ?? "").split("M").length - 1;
    assert.equal(2 * drawn, sides.reduce((a, b) => a + b, 0), "each edge once");
  });
}

test("each of many cells is that of its point", () => {
  // Several groups of points, cells with more corners than their points have triangles, cells of which nothing is left, and duplicates.
  const points = uniform(20000);
  points.copyWithin(9000, 100, 140);
  for (const bounds of [[0, 0, 1, 1], [0.2, 0.3, 0.7, 0.6], [-5, -5, 5, 5]]) {
    const v = new Delaunay(points).voronoi(bounds);
    const areas = v.areas();
    const polygons = [...v.cellPolygons()];
    const isThere = new Set(polygons.map(({index}) => index));
    assert.ok(areas.every((a, i) => a > 0 === isThere.has(i)));
    for (const polygon of polygons) {
      const [ring, i] = [polygon.slice(0, -1), polygon.index];
      assert.ok(Math.abs(area(ring) - areas[i]) < 1e-12, `${i}: ${area(ring)} for ${areas[i]}`);
      assert.deepEqual(v.cellPolygon(i), [...polygon]);
      const [x, y] = ring.reduce(([a, b], [x, y]) => [a + x / ring.length, b + y / ring.length], [0, 0]);
      assert.ok(v.contains(i, x, y));
    }
  }
});

test("bounds without area have no cells", () => {
  const v = new Delaunay(uniform(20)).voronoi([0, 0, 0, 1]);
  assert.deepEqual([...v.cellPolygons()], []);
  assert.equal(v.cellPolygon(0), null);
});

test("centers beyond the range of numbers are infinite", () => {
  const d = Delaunay.from([[0, 0], [1e300, 0], [5e299, 1e-300]]);
  assert.deepEqual([...d.voronoi([0, 0, 1, 1]).circumcenters].map(Math.abs), [Infinity, Infinity]);
  assert.equal(d.voronoi([0, -1, 1, 1]).cellPolygon(0).length, 5);
});
