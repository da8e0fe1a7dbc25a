// Makes a module smaller by binaryen, if it is installed.
//
// What the compiler links for a panic is text: of numbers, of places in the source. Nothing shows it in a module without imports, which
// ends in a trap either way. So the functions that panic and those that format are emptied, found by their names before these are stripped,
// and what only they used goes with them: functions, and then data. (The module itself formats nothing: its faults are numbers.)

import {clearUnread, withoutRelocations} from "./unread.mjs";

/** Functions that do not come back. */
const panics = /9panicking|rust_panic|begin_panic|unwrap_failed|expect_failed|panic_fmt|panic_bounds_check/;
/** Functions that format. */
const formats = /core.{0,40}3fmt|flt2dec/;
/** The compiler gives equal functions one body, and shorter ones may equal something that does not format. In characters of text. */
const SHORT = 400;

/** Makes a module smaller that was linked with relocations. */
export async function shrink(linked) {
  const bytes = withoutRelocations(linked);
  let binaryen;
  try {
    ({default: binaryen} = await import("binaryen"));
  } catch {
    console.warn("binaryen is not installed: the module stays as the compiler made it");
    return bytes;
  }
  const {Features} = binaryen;
  const features =
    Features.BulkMemory | Features.BulkMemoryOpt | Features.SignExt | Features.NontrappingFPToInt |
    Features.MutableGlobals | Features.Multivalue | Features.ReferenceTypes;
  const module = binaryen.readBinary(bytes);
  module.setFeatures(features);
  for (let k = 0; k < module.getNumFunctions(); ++k) {
    const f = module.getFunctionByIndex(k);
    const {name, body} = binaryen.getFunctionInfo(f);
    if (panics.test(name) || (formats.test(name) && binaryen.emitText(body).length > SHORT)) {
      binaryen.Function(f).body = module.unreachable();
    }
  }
  binaryen.setOptimizeLevel(3);
  binaryen.setShrinkLevel(0);
  // What the first pass makes unreachable the second one takes away.
  for (let pass = 0; pass < 2; ++pass) module.optimize();
  module.runPasses(["strip-debug", "strip-producers", "strip-target-features"]);
  const optimized = module.emitBinary();
  clearUnread(linked, optimized, module.emitText());
  const cleared = binaryen.readBinary(optimized);
  cleared.setFeatures(features);
  cleared.runPasses(["memory-packing"]);
  return cleared.emitBinary();
}
