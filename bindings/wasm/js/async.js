// The entry for those who count bytes: the module is a file of its own, and `init` fetches it.

import {DeloneError} from "./errors.js";
import {useModule} from "./module.js";
import {builtin, isNode} from "./node.js";

export * from "./api.js";
export {Delaunay as default} from "./delaunay.js";

let waiting;

/**
 * Makes the module ready: from an address as `fetch` takes it, a response, bytes or a compiled module; by default from the file of this
 * package. Until then nothing can be triangulated. A second call waits for the first.
 */
export function init(source = new URL("../dist/delone.wasm", import.meta.url)) {
  waiting ??= compile(source).then(
    (module) => useModule(module),
    (error) => {
      waiting = undefined;
      throw Object.assign(new DeloneError("not-ready", `the module could not be had: ${error?.message ?? error}`), {cause: error});
    },
  );
  return waiting;
}

/** A module, and this one. */
async function compile(source) {
  const module = await compiled(await source);
  if (!WebAssembly.Module.exports(module).some(({name}) => name === "triangulate")) throw new Error("it is another module");
  return module;
}

async function compiled(source) {
  if (source instanceof WebAssembly.Module) return source;
  if (ArrayBuffer.isView(source) || source instanceof ArrayBuffer) return WebAssembly.compile(source);
  if (typeof Response !== "undefined" && source instanceof Response) return WebAssembly.compile(await checked(source).arrayBuffer());
  if (isNode && new URL(source).protocol === "file:") {
    const {readFile} = await builtin("fs/promises");
    return WebAssembly.compile(await readFile(new URL(source)));
  }
  const response = checked(await fetch(source));
  // Servers that do not know the type cannot be streamed from.
  return response.headers.get("Content-Type") === "application/wasm"
    ? WebAssembly.compileStreaming(response)
    : WebAssembly.compile(await response.arrayBuffer());
}

function checked(response) {
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  return response;
}
