// What is read of columns, and that nothing is lost or guessed: each text with its points, or with the line that is refused.

import assert from "node:assert/strict";
import {test} from "node:test";
import {columns} from "../src/columns.js";

const read = (text) => Array.from(columns(text).coords);

function refuses(text, pattern) {
  assert.throws(() => columns(text), pattern, JSON.stringify(text));
}

test("a first row of words is a heading, one with a number is none", () => {
  for (const head of ["x,y,name", "x;y", "x\ty", "lon lat", "Ort, x in m", "E,N", "points", "name; x; y", "\tx\ty"]) {
    assert.deepEqual(read(`${head}\n0,0\n1,2\n`), [0, 0, 1, 2], head);
  }
  assert.deepEqual(read("# of 2024\n\nx,y\n0,0\n"), [0, 0]);
  assert.deepEqual(read("0,0,n/a\n1,2,3\n"), [0, 0, 1, 2]);
  assert.deepEqual(read("x,y,name\n0,0,Berlin\n1,2,\n"), [0, 0, 1, 2]);
  for (const head of ["0,y", "x;0", "x 0", "Berlin\t0", "1e400,1e400", "100"]) refuses(`${head}\n0,0\n`, /^Error: line 1: x and y/);
  refuses("x,y\nm,m\n0,0\n", /^Error: line 2: x and y/);
  refuses("0,0\nx,y\n", /^Error: line 2: x and y/);
  refuses("x,y\n", /no points/);
});

test("all ends of lines end lines, and are counted once", () => {
  for (const end of ["\n", "\r", "\r\n"]) {
    assert.deepEqual(read(["0,0", "1,0", "", "0,1", ""].join(end)), [0, 0, 1, 0, 0, 1]);
    refuses(["0,0", "1,0", "", "0,eins"].join(end), /line 4/);
  }
});

test("beside semicolons a comma is a decimal comma, and not beside decimal points", () => {
  assert.deepEqual(read("1,5;2,5\n-0,25 ; 1e3\n3;4;a,b;c\n"), [1.5, 2.5, -0.25, 1000, 3, 4]);
  assert.deepEqual(read("1.5;2.5\n3;4\n"), [1.5, 2.5, 3, 4]);
  refuses("1.234;2,5\n", /line 1: decimal commas and points/);
  refuses("1;2\n1,5;2\n1;2.5\n", /line 3: decimal commas and points/);
});

test("further columns may hold any text", () => {
  assert.deepEqual(read("13.4,52.5,tennis;football\n"), [13.4, 52.5]);
  assert.deepEqual(read("0 1 Berlin, Mitte\n0\t1\tBerlin, Mitte; 3\n"), [0, 1, 0, 1]);
  assert.deepEqual(read("  0   1  a\n2, 3, b c\n4 , 5\n"), [0, 1, 2, 3, 4, 5]);
});

test("what can be read in two ways, or not at all, is refused", () => {
  for (const line of [
    "1,5 2,5", "1,5\t2,5", "1 2,5", "1,2 3", // a comma of decimals, or of columns
    "1,234,567;2", "1.234,5;2", "1 234 567;2", "1 234 567, 2", "1 234\t5", // thousands
    "5\t\t6", "\t5\t6", ",5,6", "1;;2", "1", "1,", "NaN,1", "1,Infinity", "Berlin,1,2",
  ]) {
    refuses(`0;0\n${line}\n`, /^Error: line 2: x and y are expected/);
    refuses(`${line}\n0;0\n`, /^Error: line 1: x and y are expected/);
  }
});
