// What users give, made into flat arrays of numbers or refused with the index of what is wrong.

import {DeloneError, shown} from "./errors.js";

/** More points than this no triangulation holds. */
const MAX_POINTS = 2 ** 29;

function checkLength(length, what) {
  if (!Number.isInteger(length) || length < 0) throw new DeloneError("length", `Invalid typed array length: ${length}`);
  if (length > MAX_POINTS * what) {
    throw new DeloneError("too-many-points", `${length / what} points are more than the ${MAX_POINTS} that one triangulation holds`);
  }
  return length;
}

/** The length of what has elements, checked: what only says that it is long would block for a minute, with nothing in it. */
function lengthOf(values, what) {
  const length = checkLength(values.length, what);
  if (length && !(0 in Object(values)) && !(length - 1 in Object(values))) {
    throw new DeloneError("input", `there are no elements, though the length is ${length}`);
  }
  return length;
}

/** As a number. What is missing is not zero, which `Number` says of `null`, of empty text and of empty arrays. */
export function number(value) {
  if (typeof value === "number") return value;
  if (value == null || Array.isArray(value) || (typeof value === "string" && value.trim() === "")) return NaN;
  try {
    return Number(value);
  } catch {
    return NaN;
  }
}

/** Whether something is an array, or like one. */
const isArray = (value) => value != null && typeof value === "object" && "length" in value;

/** Numbers in a row, from an array or what is like one; what is missing is NaN. */
export function numbers(values, what) {
  if (!isArray(values)) throw new DeloneError("input", `${what} are an array of numbers`);
  return Float64Array.from({length: lengthOf(values, 1)}, (_, i) => number(values[i]));
}

/** Four numbers: least and largest x and y by turns, the larger ones not below. */
export function checkBounds(bounds) {
  const four = isArray(bounds) ? [0, 1, 2, 3].map((k) => number(bounds[k])) : [];
  const [xmin, ymin, xmax, ymax] = four;
  if (!four.length || !four.every(Number.isFinite) || xmax < xmin || ymax < ymin) throw new DeloneError("bounds", "invalid bounds: they are [xmin, ymin, xmax, ymax]");
  return four;
}

/** Rings of points `[x, y]` with the coordinates of all in a row, and where each ring ends. Of points of more coordinates two count. */
export function flatRings(rings) {
  const [flat, ends] = [[], []];
  for (const ring of listed(rings, "polygons are arrays of rings")) {
    for (const point of listed(ring, "rings are arrays of points")) {
      if (!isArray(point)) throw new DeloneError("input", "a polygon is an array of rings, a ring one of points, a point one of two numbers", flat.length >> 1);
      flat.push(number(point[0]), number(point[1]));
    }
    ends.push(flat.length >> 1);
  }
  return {flat: Float64Array.from(flat), ends};
}

/** What can be iterated. */
export function listed(items, otherwise) {
  if (items == null || typeof items !== "object" || typeof items[Symbol.iterator] !== "function") throw new DeloneError("input", otherwise);
  return items;
}

/** An array without numbers, or an error if its numbers were given away. */
function checkAttached(array) {
  try {
    new Uint8Array(array.buffer);
    return array;
  } catch (cause) {
    throw Object.assign(new DeloneError("input", "the coordinates were given away: their buffer is detached"), {cause});
  }
}

/** A flat array of coordinates, checked. What is a typed array already stays itself. */
export function flatCoordinates(coords) {
  if (coords == null || typeof coords !== "object") throw new DeloneError("input", "Expected coords to contain numbers: there is no array.");
  const length = lengthOf(coords, 2);
  if (coords instanceof Float64Array) return length ? coords : checkAttached(coords);
  const flat = new Float64Array(length);
  for (let i = 0; i < length; ++i) {
    const value = coords[i];
    if (typeof value === "number") flat[i] = value;
    else if (value == null) flat[i] = NaN;
    else {
      const help = typeof value === "object" ? " Delaunay.from takes points." : "";
      throw new DeloneError("not-a-number", `Expected coords to contain numbers: number ${i} is of the type ${typeof value}.${help}`, i >> 1);
    }
  }
  return flat;
}

/** Refuses a first point that `[x, y]` surely is not. */
function checkKind(point) {
  if (typeof point === "number") throw new DeloneError("input", "points are arrays of two numbers; new Delaunay takes a flat array", 0);
  if (point !== null && typeof point === "object" && !(0 in point) && "x" in point) {
    throw new DeloneError("input", "coordinates of objects are told by functions: from(points, (p) => p.x, (p) => p.y)", 0);
  }
}

/**
 * Points of any kind as a flat array, by functions that give their coordinates. `x` and `y` are called as d3 does; those of the caller
 * may make a point of its index alone (`isByIndex`).
 */
export function flattened(points, x, y, that, isByIndex = x !== pointX) {
  if (points == null) throw new DeloneError("input", "there are no points");
  for (const f of [x, y]) if (typeof f !== "function") throw new DeloneError("input", "coordinates are told by functions");
  if (x === pointX) checkKind(points[0]);
  if ("length" in Object(points)) {
    const length = isByIndex ? checkLength(points.length, 1) : lengthOf(points, 1);
    const flat = new Float64Array(2 * length);
    for (let i = 0; i < length; ++i) {
      const p = points[i];
      flat[2 * i] = number(x.call(that, p, i, points));
      flat[2 * i + 1] = number(y.call(that, p, i, points));
    }
    return flat;
  }
  if (typeof points[Symbol.iterator] !== "function") throw new DeloneError("input", "points are an array or an iterable");
  const flat = [];
  let i = 0;
  for (const p of points) {
    flat.push(number(x.call(that, p, i, points)), number(y.call(that, p, i, points)));
    ++i;
  }
  return Float64Array.from(flat);
}

/** The coordinates of `[x, y]`; what is no point has none. */
export const pointX = (p) => (p == null ? NaN : p[0]);
export const pointY = (p) => (p == null ? NaN : p[1]);

/** Options come last, after functions that may be left out. */
export function takeOptions(args) {
  const last = args[args.length - 1];
  return args.length && last !== null && typeof last === "object" && "skipInvalid" in last ? args.pop() : {};
}

/** Which points are left out: those not finite, if that is wanted, and those removed. Nothing if none is. */
export function absentees(flat, options, removed = undefined) {
  const count = flat.length >> 1;
  let absent;
  const leave = (i) => ((absent ??= new Uint8Array(count))[i] = 1);
  if (options?.skipInvalid) {
    for (let i = 0; i < count; ++i) {
      if (!Number.isFinite(flat[2 * i]) || !Number.isFinite(flat[2 * i + 1])) leave(i);
    }
  }
  if (removed) for (const i of removed) leave(i);
  return absent;
}

/** An index of a point, or an error. */
export function checkIndex(i, count) {
  if (!Number.isInteger(i) || i < 0 || i >= count) {
    throw new DeloneError("no-such-point", `${shown(i)} is not the index of a point: there are ${count}`);
  }
  return i;
}

/** A finite number, or an error. */
export function checkNumber(value, what) {
  const x = number(value);
  if (!Number.isFinite(x)) throw new DeloneError("not-finite", `${what} is ${shown(value)}, which is not finite`);
  return x;
}
