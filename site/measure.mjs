// Measures the page in a real browser: from file to picture, tasks of the main thread, redraws and motion.
//
//     npm run measure [POINTS]
//
// Figures of one machine and one moment: compare them with each other.

import {mkdtempSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {gzipSync} from "node:zlib";
import {chromium} from "playwright-core";

const count = Number(process.argv[2] ?? 1_000_000);
const RUNS = 5;
const dist = new URL("dist/", import.meta.url);
const folder = mkdtempSync(`${tmpdir()}/measure-`);
const file = `${folder}/points.csv`;
let [text, seed] = ["", 1];
const next = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
for (let i = 0; i < count; i++) text += `${next()},${next()}\n`;
writeFileSync(file, text);

const browser = await chromium.launch({executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"]});
const page = await browser.newPage({viewport: {width: 1440, height: 900}});
await page.addInitScript(() => {
  globalThis.tasks = [];
  new PerformanceObserver((list) => list.getEntries().forEach(({duration}) => globalThis.tasks.push(duration))).observe({type: "longtask", buffered: true});
});
const longest = () => page.evaluate(() => Math.max(0, ...globalThis.tasks.splice(0)));
await page.goto(new URL("index.html", dist).href);
await page.click("[data-sample=capitals]");
await page.waitForSelector("#bench[data-state=ready]");
console.log(`first use: longest task of the main thread ${(await longest()).toFixed(0)} ms`);
const ratios = [];
for (let run = 0; run < RUNS; run++) {
  await page.setInputFiles("#bench-file", file);
  await page.waitForFunction(() => document.querySelector("#bench").dataset.state === "busy");
  await page.waitForSelector("#bench[data-state=ready]", {timeout: 120_000});
  const {shown, engine} = await page.locator("#bench").evaluate(({dataset}) => dataset);
  ratios.push(shown / engine);
  console.log(`${count} points: engine ${engine} ms, shown after ${shown} ms, ${(shown / engine).toFixed(2)} times; longest task ${(await longest()).toFixed(0)} ms`);
}
console.log(`median ${ratios.sort((a, b) => a - b)[RUNS >> 1].toFixed(2)} times`);
/** Milliseconds of redraws after a turn of the wheel, and of frames while dragging. */
const {redraws, frames} = await page.evaluate(async () => {
  const canvas = document.querySelector("#bench-picture");
  const frame = () => new Promise(requestAnimationFrame);
  const box = canvas.getBoundingClientRect();
  const at = (kind, x, y, more = {}) => canvas.dispatchEvent(new (more.deltaY ? WheelEvent : PointerEvent)(kind, {clientX: box.left + x, clientY: box.top + y, pointerId: 1, cancelable: true, bubbles: true, ...more}));
  canvas.setPointerCapture = () => undefined;
  const redraws = [];
  const painted = () => Number(document.querySelector("#bench").dataset.painted);
  for (let k = 0; k < 8; k++) {
    const before = document.querySelector("#bench").dataset.pictures;
    const start = performance.now();
    at("wheel", 300, 200, {deltaY: k % 2 ? -40 : 40});
    while (document.querySelector("#bench").dataset.pictures === before) await frame();
    redraws.push({whole: performance.now() - start, painted: painted()});
  }
  const frames = [];
  at("pointerdown", 300, 200);
  let last = performance.now();
  for (let k = 0; k < 90; k++) {
    at("pointermove", 300 + 2 * k, 200 + k);
    await frame();
    frames.push(performance.now() - last);
    last = performance.now();
  }
  at("pointerup", 480, 290);
  return {redraws, frames};
});
const median = (list) => [...list].sort((a, b) => a - b)[list.length >> 1];
console.log(`redraw: painted in ${median(redraws.map(({painted}) => painted)).toFixed(0)} ms, seen after ${median(redraws.map(({whole}) => whole)).toFixed(0)} ms; in motion ${(1000 / median(frames)).toFixed(0)} frames a second; longest task ${(await longest()).toFixed(0)} ms`);
const size = (name) => gzipSync(readFileSync(new URL(name, dist))).length;
console.log(`gzip: page.js ${size("page.js")}, index.html ${size("index.html")}, figures.js ${size("figures.js")}, program.js ${size("program.js")} bytes`);
await browser.close();
rmSync(folder, {recursive: true});
