// What a single change costs in the npm package: a vertex that is dragged, one that jumps, points that come and go. Medians of rounds of
// changes in a row, because a clock cannot tell one; of two builds of the package, which take turns, if a second one is named.
//
//     node changes.mjs [points] [folder of a package ...]     after `npm run build` in bindings/wasm

import {cpus} from "node:os";
import {fileURLToPath, pathToFileURL} from "node:url";
import {uniformNumbers} from "./uniform.mjs";

const ROUNDS = 41;
const CHANGES_A_ROUND = 50;

const [count = "100000", ...folders] = process.argv.slice(2);
if (!folders.length) folders.push(fileURLToPath(new URL("../../bindings/wasm", import.meta.url)));
const packages = await Promise.all(folders.map((folder) => import(`${pathToFileURL(folder)}/js/full.js`)));

const next = uniformNumbers();
const points = Float64Array.from({length: 2 * Number(count)}, next);
const triangulations = packages.map(({Delaunay}) => new Delaunay(points));

/** A function of two random numbers and of the number of the change, each of its own vertex or of one. */
const changes = {
  "drag a vertex": (d, k, x, y) => d.move(7, 0.5 + 0.01 * x, 0.5 + 0.01 * y),
  "move another one far": (d, k, x, y) => d.move((10_000 + k) % Number(count), x, y),
  insert: (d, k, x, y) => d.insert(x, y),
  remove: (d, k) => d.remove(20_000 + k),
  "move, and read triangles": (d, k, x, y) => (d.move(7, x, y), d.triangles),
};

const median = (times) => times.sort((a, b) => a - b)[times.length >> 1];
console.log(`Node ${process.version}, ${cpus()[0].model.trim()}, ${count} points, median of ${ROUNDS} rounds, microseconds a change`);
for (const [name, change] of Object.entries(changes)) {
  const times = folders.map(() => []);
  const inRow = name.includes("read") ? 1 : CHANGES_A_ROUND;
  for (let round = 0; round < ROUNDS; ++round) {
    const places = Array.from({length: inRow}, () => [next(), next()]);
    for (let turn = 0; turn < folders.length; ++turn) {
      const which = (turn + round) % folders.length;
      const start = performance.now();
      places.forEach(([x, y], k) => change(triangulations[which], round * inRow + k, x, y));
      times[which].push((1000 * (performance.now() - start)) / inRow);
    }
  }
  console.log(`${name}: ${times.map((each) => median(each).toFixed(1)).join(", ")}`);
}
triangulations.forEach((d) => d.check());
