// What d3-delaunay's own tests ask of a Voronoi diagram (ISC, Observable), in our words; rings up to where they start.

import assert from "node:assert/strict";
import test from "node:test";
import {Delaunay} from "delone";
import {Path} from "../js/path.js";
import {ring, ringOf} from "./support/oracle.mjs";

const sorted = (indices) => [...indices].sort((a, b) => a - b);
const neighbors = (v, count) => Array.from({length: count}, (_, i) => sorted(v.neighbors(i)));
const lengths = (v) => Array.from(v.cellPolygons(), (cell) => cell.length);

test("the cell of a point that coincides is not drawn", () => {
  const v = Delaunay.from([[0, 0], [1, 0], [0, 1], [1, 0]]).voronoi([-1, -1, 2, 2]);
  assert.equal(v.renderCell(3, {}), undefined);
  assert.equal(v.cellPolygon(3), null);
  assert.equal(v.contains(3, 1, 0), false);
  assert.equal(v.contains(1, 1, 0), true);
  assert.equal(v.contains(1, NaN, 0), false);
});

test("a circumcenter in the middle of a side", () => {
  const v = Delaunay.from([[0, 0], [1, 0], [0, 1]]).voronoi([-1, -1, 2, 2]);
  const expected = ["M-1,-1L0.5,-1L0.5,0.5L-1,0.5Z", "M2,-1L2,2L0.5,0.5L0.5,-1Z", "M-1,2L-1,0.5L0.5,0.5L2,2Z"];
  expected.forEach((path, i) => {
    const context = new Path();
    assert.equal(v.renderCell(i, context), undefined);
    assert.equal(ringOf(context.value()), ringOf(path));
  });
});

const cell = ring([[-500, 500], [-500, -140], [-240, -140], [-140, 60], [-140, 500], [-500, 500]]);

test("update after points were changed in place", () => {
  const d = Delaunay.from([[0, 0], [300, 0], [0, 300], [300, 300], [100, 100]]);
  const v = d.voronoi([-500, -500, 500, 500]);
  v.cellPolygon(1);
  for (let i = 0; i < d.points.length; ++i) d.points[i] = 10 - d.points[i];
  assert.equal(ring(v.update().cellPolygon(1)), cell);
});

test("update from nothing but equal points", () => {
  const points = [10, 10, -290, 10, 10, -290, -290, -290, -90, -90];
  const d = new Delaunay(Array.from({length: points.length}).fill(0));
  const v = d.voronoi([-500, -500, 500, 500]);
  assert.equal(ring(v.cellPolygon(0)), ring([[500, -500], [500, 500], [-500, 500], [-500, -500], [500, -500]]));
  assert.equal(v.cellPolygon(1), null);
  points.forEach((x, i) => (d.points[i] = x));
  assert.equal(ring(v.update().cellPolygon(1)), cell);
});

test("no edges of length zero", () => {
  const v = Delaunay.from([[50, 10], [10, 50], [10, 10], [200, 100]]).voronoi([40, 40, 440, 180]);
  assert.equal(v.cellPolygon(0).length, 4);
  const w = Delaunay.from([[10, 10], [20, 10]]).voronoi([0, 0, 30, 20]);
  assert.equal(ring(w.cellPolygon(0)), ring([[0, 20], [0, 0], [15, 0], [15, 20], [0, 20]]));
});

test("neighbors are those inside of the bounds", () => {
  const v = Delaunay.from([[300, 10], [200, 100], [300, 100], [10, 10], [350, 200], [350, 400]]).voronoi([0, 0, 500, 150]);
  assert.deepEqual(neighbors(v, 6), [[1, 2], [0, 2, 3], [0, 1, 4], [1], [2], []]);
});

test("no unnecessary corners", () => {
  for (const [points, expected] of [
    [[[289, 25], [3, 22], [93, 165], [282, 184], [65, 89]], [6, 4, 6, 5, 6]],
    [[[189, 13], [197, 26], [47, 133], [125, 77], [288, 15]], [4, 6, 5, 6, 5]],
    [[[44, 42], [210, 193], [113, 103], [185, 43], [184, 37]], [5, 5, 7, 5, 6]],
  ]) {
    assert.deepEqual(lengths(Delaunay.from(points).voronoi([0, 0, 290, 190])), expected);
  }
});

test("a triangle so thin that its center is far away", () => {
  // Two rings of eight points, and one of them twice, the second a unit in the last place away.
  const around = (x) => [[x + 60, 253.75], [x + 42.42640687119285, 296.17640687119285], [x, 313.75], [x - 42.42640687119285, 296.17640687119285],
    [x - 60, 253.75], [x - 42.42640687119285, 211.32359312880715], [x, 193.75], [x + 42.42640687119285, 211.32359312880715]];
  const [first, ...rest] = around(364.75);
  const others = around(564.75).filter((_, k) => k !== 5 && k !== 7);
  const v = Delaunay.from([first, [424.75, 253.74999999999997], ...rest, ...others]).voronoi([10, 10, 960, 500]);
  assert.equal(v.cellPolygon(0).length, 4);
});

test("empty cells are left out, and cells have an index", () => {
  const v = Delaunay.from([[0, 0], [3, 3], [1, 1], [-3, -2]]).voronoi([0, 0, 2, 2]);
  const cells = [...v.cellPolygons()];
  assert.deepEqual(cells.map((c) => c.index), [0, 2]);
  assert.equal(ring(cells[0]), ring([[0, 0], [1, 0], [0, 1], [0, 0]]));
  assert.equal(ring(cells[1]), ring([[2, 2], [0, 2], [0, 1], [1, 0], [2, 0], [2, 2]]));
});

for (const [name, sx, sy, bounds] of [
  ["as they are", 1, 1, [0, 0, 100, 90]],
  ["upside down", 1, -1, [0, -90, 100, 0]],
  ["mirrored", -1, 1, [-100, 0, 0, 90]],
  ["turned", -1, -1, [-100, -90, 0, 0]],
]) {
  test(`neighbors of points ${name}`, () => {
    const v = Delaunay.from([[10, 10], [36, 27], [90, 19], [50, 75]].map(([x, y]) => [sx * x, sy * y])).voronoi(bounds);
    assert.deepEqual(neighbors(v, 4), [[1], [0, 2, 3], [1, 3], [1, 2]]);
  });
}

test("issue 136", () => {
  const points = [
    [447.27981036477433, 698.9400262172304], [485.27830313288746, 668.9946483670656], [611.9525697080425, 397.71056371206487],
    [491.44637766366105, 692.071157339428], [697.553622336339, 692.071157339428], [497.00778156318086, 667.1990851383492],
    [691.9922184368191, 667.1990851383492], [544.9897579870977, 407.0828550310619], [543.1738215956482, 437.35879519252677],
  ];
  // They have six corners, because two that round to the same are one to them. Ours are two, 4e-13 apart, as they are exactly.
  const cell = Delaunay.from(points).voronoi([0, 0, 1000, 1000]).cellPolygon(3);
  const isNear = ([x, y], [u, v]) => Math.hypot(x - u, y - v) < 1e-9;
  assert.equal(cell.filter((p, k) => k === 0 || !isNear(p, cell[k - 1])).length, 6);
});

test("issue 141", () => {
  const points = [[10, 190], ...Array.from({length: 7}, (_, i) => [i * 80, (i * 50) / 7])];
  assert.deepEqual(lengths(Delaunay.from(points).voronoi([1, 1, 499, 199])), [7, 5, 5, 5, 6, 5, 5, 5]);
});
