// What a page loads, and the limits that it is to stay below (brotli, in bytes): a module that has grown is looked at before it is shipped.

import {existsSync, readFileSync} from "node:fs";
import {brotliCompressSync, gzipSync} from "node:zlib";

const limits = {"delone.wasm": 102_000, "delone-full.wasm": 279_000, "inline.js": 126_000, "delone.js": 134_000, "delone-laz.js": 37_500};
let isOver = false;
for (const [name, limit] of Object.entries(limits)) {
  const path = new URL(`../dist/${name}`, import.meta.url);
  if (!existsSync(path)) {
    console.error(`dist/ has no ${name}: npm run build`);
    process.exit(1);
  }
  const bytes = readFileSync(path);
  const brotli = brotliCompressSync(bytes).length;
  console.log(`${name}: ${bytes.length} bytes, gzip ${gzipSync(bytes, {level: 9}).length}, brotli ${brotli} of ${limit}`);
  isOver ||= brotli > limit;
}
if (isOver) {
  console.error("a limit is exceeded");
  process.exit(1);
}
