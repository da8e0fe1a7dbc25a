// Makes a module smaller by binaryen, if it is installed.
//
// A third of what the compiler links for a panic is text: of numbers, of places in the source. Nothing shows it in a module without imports,
// which ends in a trap either way. So the functions that format are emptied, found by their names before these are stripped, and what
// only they used goes with them.

/** Functions that only a panic calls: the formatting of text, and the panic itself. */
const forPanics = /core.{0,40}3fmt|9panicking|rust_panic|begin_panic|flt2dec|unwrap_failed|expect_failed|panic_fmt|panic_bounds_check/;

export async function shrink(bytes) {
  let binaryen;
  try {
    ({default: binaryen} = await import("binaryen"));
  } catch {
    console.warn("binaryen is not installed: the module stays as the compiler made it");
    return bytes;
  }
  const {Features} = binaryen;
  const module = binaryen.readBinary(bytes);
  module.setFeatures(
    Features.BulkMemory | Features.BulkMemoryOpt | Features.SignExt | Features.NontrappingFPToInt |
      Features.MutableGlobals | Features.Multivalue | Features.ReferenceTypes,
  );
  for (let k = 0; k < module.getNumFunctions(); ++k) {
    const f = module.getFunctionByIndex(k);
    if (forPanics.test(binaryen.getFunctionInfo(f).name)) binaryen.Function(f).body = module.unreachable();
  }
  binaryen.setOptimizeLevel(3);
  binaryen.setShrinkLevel(0);
  // What the first pass makes unreachable the second one takes away.
  for (let pass = 0; pass < 2; ++pass) module.optimize();
  module.runPasses(["strip-debug", "strip-producers", "strip-target-features"]);
  return module.emitBinary();
}
