// Makes a module smaller by binaryen, if it is installed. The thread of build.mjs that does it: binaryen takes half a minute, and nothing else
// could be said meanwhile.
//
// What the compiler links for a panic is text: of numbers, of places in the source. Nothing shows it in a module without imports, which
// ends in a trap either way. So the functions that panic and those that format are emptied, as `wasm-snip` does, found by their names before
// these are stripped, and functions that only they used go with them. (The module itself formats nothing: its faults are numbers.)
//
// Sizes of delone.wasm in brotli (2026-11-28): optimized alone 150 kB, with this 100 kB. A name that changes makes the module larger, which
// scripts/size.mjs sees, and breaks nothing.

import {parentPort, workerData} from "node:worker_threads";

/** Functions that do not come back. */
const panics = /9panicking|rust_panic|begin_panic|unwrap_failed|expect_failed|panic_fmt|panic_bounds_check/;
/** Functions that format. */
const formats = /core.{0,40}3fmt|flt2dec/;
/** The compiler gives equal functions one body, and shorter ones may equal something that does not format. In characters of text. */
const SHORT = 400;

/** Makes a module smaller. */
async function shrink(bytes) {
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
  // Once: again it takes a quarter as long, for 0.02 % of the bytes (2026-11-29).
  module.optimize();
  module.runPasses(["strip-debug", "strip-producers", "strip-target-features"]);
  return module.emitBinary();
}

parentPort.postMessage(await shrink(workerData));
