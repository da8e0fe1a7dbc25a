// The module at work: one instance for all triangulations, calls that throw what went wrong, and arrays in and out.
//
// Arrays are copied, once in and once out. A view of the module's memory would save the copy out, some 2 % of a triangulation, and be
// empty as soon as that memory grows, which any later call may do; so none is ever handed out.

import {DeloneError, fault} from "./errors.js";

let compiled;
let rank = -1;
let engine;

/** Makes a compiled module the one to use, unless there is one that can do more. */
export function useModule(module, itsRank = 0) {
  if (itsRank <= rank) return;
  [compiled, rank, engine] = [module, itsRank, undefined];
}

/** The instance that new triangulations live in. */
export function currentEngine() {
  if (!compiled) throw new DeloneError("not-ready", "the module is not there yet: await init() first");
  if (!engine || engine.isLost) engine = new Engine(compiled);
  return engine;
}

/** An instance of the module. */
class Engine {
  constructor(module) {
    this.exports = new WebAssembly.Instance(module, {}).exports;
    /** After a trap nothing in its memory can be relied on. */
    this.isLost = false;
  }

  /** Calls a function of the module. `name` says what the user calls the module's points. */
  call(name, call, ...args) {
    const {exports} = this;
    if (this.isLost) throw new DeloneError("lost", "the module stopped earlier, and this triangulation with it");
    const f = exports[call];
    if (!f) throw new DeloneError("unavailable", `the small module has no ${call}: import "delone/full"`);
    let result;
    try {
      result = f(...args);
    } catch (error) {
      this.isLost = true;
      const message = "the module ran out of memory or has a bug; other triangulations can be made, those that there were are lost";
      throw Object.assign(new DeloneError("internal", message), {cause: error});
    }
    if (result === -1) throw fault(exports, name);
    return result;
  }

  /** Puts points onto the tray: a flat array of numbers. */
  givePoints(coords, count = coords.length >> 1) {
    this.call(undefined, "room_for_points", count);
    const at = this.exports.points_at() >>> 0;
    const room = new Float64Array(this.exports.memory.buffer, at, 2 * count);
    room.set(coords.length === 2 * count ? coords : coords.subarray(0, 2 * count));
  }

  /** Puts an array of numbers onto the tray; what is none would be zero there. */
  giveNumbers(numbers) {
    this.call(undefined, "room_for_numbers", numbers.length);
    new Float64Array(this.exports.memory.buffer, this.exports.numbers_at() >>> 0, numbers.length).set(numbers);
  }

  /** Puts indices onto the tray. */
  giveIndices(indices) {
    this.call(undefined, "room_for_indices", indices.length);
    new Uint32Array(this.exports.memory.buffer, this.exports.indices_at() >>> 0, indices.length).set(indices);
  }

  /** Takes an array of integers from the tray, as unsigned ones or of another type of 32 bits. */
  ints(k, Type = Uint32Array) {
    return this.intsThere(k, Type).slice();
  }

  /** Takes an array of numbers from the tray. */
  floats(k) {
    return this.floatsThere(k).slice();
  }

  /** The same where it lies: to be read before anything else is called. */
  intsThere(k, Type) {
    const {exports} = this;
    return new Type(exports.memory.buffer, exports.ints_at(k) >>> 0, exports.ints_count(k));
  }

  floatsThere(k) {
    const {exports} = this;
    return new Float64Array(exports.memory.buffer, exports.floats_at(k) >>> 0, exports.floats_count(k));
  }

  /** Gives the tray's memory back. */
  clear() {
    if (!this.isLost) this.exports.clear_tray();
  }
}
