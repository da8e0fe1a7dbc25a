// LAS and LAZ files: the sample of the repository, the same uncompressed, and what broken ones give.

import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import {test} from "node:test";
import {DeloneError} from "delone";
import {readLas} from "delone/laz";

const sample = readFileSync(new URL("../../../data/autzen_trim.laz", import.meta.url));

/** What a file's header says of one axis: the largest and the smallest coordinate. */
const bounds = (axis) => [sample.readDoubleLE(179 + 16 * axis), sample.readDoubleLE(187 + 16 * axis)];

const extremes = (numbers) => [numbers.reduce((a, b) => Math.max(a, b)), numbers.reduce((a, b) => Math.min(a, b))];

/** An uncompressed file of points [x, y, z, class], with scale 1/2 and offsets 10, 20, 30. */
function las(points, {format = 0, claim = points.length} = {}) {
  const size = format >= 6 ? 30 : 20;
  const file = Buffer.alloc(227 + size * points.length);
  file.write("LASF", 0, "latin1");
  file.set([1, 2], 24);
  file.writeUInt16LE(227, 94);
  file.writeUInt32LE(227, 96);
  file[104] = format;
  file.writeUInt16LE(size, 105);
  file.writeUInt32LE(claim, 107);
  [0.5, 0.5, 0.5, 10, 20, 30].forEach((x, k) => file.writeDoubleLE(x, 131 + 8 * k));
  points.forEach(([x, y, z, type], k) => {
    const at = 227 + size * k;
    [x, y, z].forEach((value, axis) => file.writeInt32LE(value, at + 4 * axis));
    file[at + (format >= 6 ? 16 : 15)] = type;
  });
  return file;
}

/** The code of what reading throws. */
function codeOf(file) {
  try {
    readLas(file);
  } catch (error) {
    assert.ok(error instanceof DeloneError, String(error));
    return error.code;
  }
  return undefined;
}

test("the sample has the points that its header tells of", () => {
  const {coords, heights, classes} = readLas(sample);
  assert.equal(classes.length, 110_000);
  assert.equal(classes.length, sample.readUInt32LE(107));
  // Coordinates are integers with a scale of a hundredth; the header's bounds are rounded in another way.
  [coords.filter((_, k) => k % 2 === 0), coords.filter((_, k) => k % 2 === 1), heights].forEach((numbers, axis) => {
    const [found, told] = [extremes(numbers), bounds(axis)];
    found.forEach((x, k) => assert.ok(Math.abs(x - told[k]) < 1e-8, `${axis}: ${found}, ${told}`));
  });
  assert.equal(classes.filter((type) => type === 2).length, 26_107);
});

test("points that are withheld are left out", () => {
  const file = las([[1, 2, 3, 2], [3, 4, 5, 2 | 0x80], [5, 6, 7, 5 | 0x20]]);
  assert.deepEqual([...readLas(file).classes], [2, 5]);
  assert.deepEqual([...readLas(file, {withheld: true}).classes], [2, 2, 5]);
  const wide = las([[1, 2, 3, 2], [3, 4, 5, 2]], {format: 6});
  wide[227 + 30 + 15] = 4;
  assert.deepEqual([...readLas(wide).coords], [10.5, 21]);
  assert.equal(readLas(wide, {withheld: true, classes: [2]}).classes.length, 2);
});

test("classes are chosen", () => {
  const [all, ground] = [readLas(sample), readLas(sample, {classes: [2]})];
  assert.deepEqual([ground.heights.length, ground.coords.length, ground.classes.length], [26_107, 2 * 26_107, 26_107]);
  assert.deepEqual(ground.heights, all.heights.filter((_, k) => all.classes[k] === 2));
});

test("uncompressed files of both ways to have a class", () => {
  for (const format of [0, 6]) {
    const {coords, heights, classes} = readLas(las([[1, 2, 3, 2], [-4, 5, -6, 9]], {format}));
    assert.deepEqual([[...coords], [...heights], [...classes]], [[10.5, 21, 8, 22.5], [31.5, 27], [2, 9]]);
  }
  assert.equal(readLas(las([[0, 0, 0, 0xe2]]), {withheld: true}).classes[0], 2, "flags are beside the class");
  assert.equal(readLas(las([])).classes.length, 0);
});

test("what is wrong is told", () => {
  assert.equal(codeOf(Buffer.from("x,y\n1,2\n".repeat(50))), "no-las");
  assert.equal(codeOf(new ArrayBuffer(0)), "no-las");
  assert.equal(codeOf("text"), "not-numbers");
  assert.equal(codeOf(las([], {claim: 2 ** 32 - 1})), "truncated", "no memory is taken for what is not there");
  const unknown = las([[0, 0, 0, 0]]);
  unknown[104] = 11;
  assert.equal(codeOf(unknown), "unsupported");
  const short = las([[0, 0, 0, 0]]);
  short.writeUInt16LE(3, 105);
  assert.equal(codeOf(short), "damaged");
});

test("a file that ends early is an error, wherever it ends", () => {
  for (let k = 0; k < 60; ++k) {
    const code = codeOf(sample.subarray(0, Math.floor((k / 60) * sample.length)));
    assert.ok(["no-las", "truncated", "damaged"].includes(code), `${k}: ${code}`);
  }
});

test("changed bytes give an error or points, and the next file is read", () => {
  let state = 1;
  const random = (most) => (state = (state * 48271) % 2147483647) % most;
  const head = sample.readUInt32LE(96);
  for (let k = 0; k < 150; ++k) {
    const file = Buffer.from(sample);
    // In the header, at the first chunk, in the table at the end.
    const [from, room] = [[0, head], [head, 400], [file.length - 64, 64]][k % 3];
    for (let n = 0; n < 4; ++n) file[from + random(room)] = random(256);
    const code = codeOf(file);
    assert.ok([undefined, "no-las", "truncated", "damaged", "unsupported", "memory"].includes(code), String(code));
  }
  assert.equal(readLas(sample).classes.length, 110_000);
});
