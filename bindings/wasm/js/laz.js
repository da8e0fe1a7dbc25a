// LAS and LAZ point clouds as arrays. A module of its own, which is compiled when the first file is read; each file has an instance of it, so
// that what a damaged one does to it is over with the call, and so is its memory.

import packed from "../dist/inline-laz.js";
import {DeloneError, shown} from "./errors.js";
import {listed} from "./input.js";
import {unpack} from "./unpack.js";

let module;

/** By the numbers of laz/src/lib.rs. */
const faults = [
  undefined,
  ["no-las", "this is no LAS or LAZ file"],
  ["truncated", "the file ends before its points do"],
  ["damaged", "the file contradicts itself"],
  ["unsupported", "the file has points of a kind that is not known"],
];

const error = (code, message) => new DeloneError(code, message);

/**
 * Points of a file: `coords` x and y by turns, `heights`, `classes`. Of `classes` only, if these are given: 2 is the ground.
 * Points that are withheld are left out, unless `withheld` is true.
 *
 * @param {ArrayBuffer | ArrayBufferView} file
 */
export function readLas(file, options) {
  if (!(file instanceof ArrayBuffer) && !ArrayBuffer.isView(file)) throw error("not-numbers", "expected the bytes of a file");
  const bytes = file instanceof ArrayBuffer ? new Uint8Array(file) : new Uint8Array(file.buffer, file.byteOffset, file.byteLength);
  module ??= unpack(packed);
  const {memory, room, want, want_withheld, read, count, ...at} = new WebAssembly.Instance(module, {}).exports;
  const start = room(bytes.length) >>> 0;
  if (!start) throw error("memory", `there is no memory for a file of ${bytes.length} bytes`);
  new Uint8Array(memory.buffer, start, bytes.length).set(bytes);
  for (const wanted of listed(options?.classes ?? [], "classes are an array of numbers")) {
    if (!Number.isInteger(wanted) || wanted < 0 || wanted > 255) throw error("range", `${shown(wanted)} is no class: they are 0 to 255`);
    want(wanted);
  }
  if (options?.withheld) want_withheld();
  let found;
  try {
    found = read();
  } catch (cause) {
    throw Object.assign(error("damaged", "the file is damaged, or its points are more than there is memory for"), {cause});
  }
  if (found) throw error(...faults[found]);
  const array = (Type, name, size) => new Type(memory.buffer, at[name]() >>> 0, size * count()).slice();
  return {coords: array(Float64Array, "coords", 2), heights: array(Float64Array, "heights", 1), classes: array(Uint8Array, "classes", 1)};
}
