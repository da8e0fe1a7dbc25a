// The npm package beside delaunator and d3-delaunay, on uniform points: shortest of runs that take turns, because what else the machine
// does then meets all alike. Arrays are read out, and all cells are made polygons.
//
//     npm install && node bench.mjs [runs] [counts...]      after `npm run build` in bindings/wasm
//
// Sizes are of what a page loads: the module alone, and the classic script with the module inside.

import {readFileSync} from "node:fs";
import {cpus} from "node:os";
import {createRequire} from "node:module";
import {brotliCompressSync, gzipSync} from "node:zlib";
import {Delaunay as D3} from "d3-delaunay";
import Theirs from "delaunator";
import {Delaunator, Delaunay} from "delone";
import {uniformNumbers} from "./uniform.mjs";

const [runs = 5, ...counts] = process.argv.slice(2).map(Number);
if (!counts.length) counts.push(100_000, 1_000_000);

const uniform = (count) => Float64Array.from({length: 2 * count}, uniformNumbers());

const polygons = (Class, points) => {
  const delaunay = new Class(points);
  let corners = 0;
  for (const cell of delaunay.voronoi([0, 0, 1, 1]).cellPolygons()) corners += cell.length;
  delaunay.dispose?.();
  return corners;
};

const rows = [
  ["triangles", "delone", (p) => new Delaunator(p).triangles.length],
  ["triangles", "delaunator", (p) => new Theirs(p).triangles.length],
  ["polygons of all cells", "delone", (p) => polygons(Delaunay, p)],
  ["polygons of all cells", "d3-delaunay", (p) => polygons(D3, p)],
];

console.log(`Node ${process.version}, ${cpus()[0].model.trim()}, shortest of ${runs}`);
for (const count of counts) {
  const points = uniform(count);
  const best = rows.map(() => Infinity);
  const found = [];
  for (let run = 0; run < runs; ++run) {
    rows.forEach(([, , work], k) => {
      globalThis.gc?.();
      const start = performance.now();
      found[k] = work(points);
      best[k] = Math.min(best[k], performance.now() - start);
    });
  }
  if (found[0] !== found[1]) throw new Error(`${found[0]} and ${found[1]} corners of triangles`);
  rows.forEach(([what, who], k) => {
    const ratio = k % 2 ? `, ${(best[k] / best[k - 1]).toFixed(1)} times delone` : "";
    console.log(`${count} points, ${what}: ${who} ${best[k].toFixed(1)} ms${ratio}`);
  });
}

const require = createRequire(import.meta.url);
const package_ = require.resolve("delone/package.json").replace("package.json", "");
for (const name of ["dist/delone.wasm", "dist/delone-full.wasm", "dist/delone.js"]) {
  const bytes = readFileSync(package_ + name);
  console.log(`${name}: ${bytes.length} bytes, gzip ${gzipSync(bytes, {level: 9}).length}, brotli ${brotliCompressSync(bytes).length}`);
}
