// What a page loads, and the limits that it is to stay below (brotli, in bytes): a module that has grown is looked at before it is shipped.
// What the README says of it is to be right within a twentieth.

import {existsSync, readFileSync} from "node:fs";
import {brotliCompressSync, gzipSync} from "node:zlib";

const limits = {
  "delone.wasm": 102_000,
  "delone-full.wasm": 279_000,
  "inline.js": 126_000,
  "delone.js": 134_000,
  "delone-laz.js": 37_500,
  "delone-worker.js": 5_800,
};
const readme = readFileSync(new URL("../README.md", import.meta.url), "utf8");
/** The size in brotli by the README: the last number in the row of a file. */
const told = (name) => {
  const row = readme.split("\n").find((line) => line.startsWith(`| \`${name}\``) && /\d \|$/.test(line));
  return row && Number(row.split("|").at(-2).replaceAll(",", ""));
};
const faults = [];
for (const [name, limit] of Object.entries(limits)) {
  const path = new URL(`../dist/${name}`, import.meta.url);
  if (!existsSync(path)) {
    console.error(`dist/ has no ${name}: npm run build`);
    process.exit(1);
  }
  const bytes = readFileSync(path);
  const brotli = brotliCompressSync(bytes).length;
  console.log(`${name}: ${bytes.length} bytes, gzip ${gzipSync(bytes, {level: 9}).length}, brotli ${brotli} of ${limit}`);
  if (brotli > limit) faults.push(`${name} is over its limit`);
  const said = told(name);
  // inline.js is inside of delone.js, whose figure the README has.
  if (name !== "inline.js" && !(Math.abs(said - brotli) <= brotli / 20)) faults.push(`README.md says ${said} of ${name}: write ${brotli}`);
}
if (faults.length) {
  console.error(faults.join("\n"));
  process.exit(1);
}
