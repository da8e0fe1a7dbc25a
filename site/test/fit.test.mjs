// Points on a sheet: as large as it allows, in its middle, and none lost at the ends of what floats can say.

import assert from "node:assert/strict";
import {test} from "node:test";
import {fit} from "../src/fit.js";

const on = (...coords) => Array.from(fit(Float64Array.from(coords), 200, 100, 10), (x) => Math.round(x * 1e6) / 1e6);

test("a square has its corners at the margin, y up", () => {
  assert.deepEqual(on(0, 0, 1, 0, 1, 1, 0, 1), [60, 90, 140, 90, 140, 10, 60, 10]);
});

test("what is wide fills the width, what is high the height, and one place is in the middle", () => {
  assert.deepEqual(on(-0.1, 3, 0.1, 3), [10, 50, 190, 50]);
  assert.deepEqual(on(7, -4, 7, 4), [100, 90, 100, 10]);
  assert.deepEqual(on(5, 5, 5, 5), [100, 50, 100, 50]);
});

test("the same picture at every scale", () => {
  for (const unit of [5e-324, 1e-320, 1e-160, 1e160, 0.85 * Number.MAX_VALUE, Number.MAX_VALUE]) {
    assert.deepEqual(on(-unit, -unit, unit, -unit, 0, unit, 0, 0), [60, 90, 140, 90, 100, 10, 100, 50], String(unit));
  }
});
