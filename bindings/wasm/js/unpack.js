// The module inside of the package, compiled while the script waits.

import {inflate} from "./inflate.js";

/** From base64 of a deflate stream. */
export function unpack({size, base64}) {
  const text = atob(base64);
  const bytes = Uint8Array.from({length: text.length}, (_, k) => text.charCodeAt(k));
  return new WebAssembly.Module(inflate(bytes, size));
}
