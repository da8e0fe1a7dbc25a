// Every entry of the package through the bundlers that most pages are made with, as they are without settings; what they make is run.

import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {copyFileSync} from "node:fs";
import {join} from "node:path";
import test, {after} from "node:test";
import {installed, write} from "./support/app.mjs";
import {browse, noChromium} from "./support/chromium.mjs";

const {folder, remove} = installed();
after(remove);

const start = "const answers = (globalThis.answers ??= {});";
/** A program for each entry, which leaves an answer. */
const programs = {
  index: `import {Delaunay} from "delone"; ${start} answers.index = Delaunay.from([[0, 0], [1, 0], [0, 1]]).triangles.length;`,
  full: `import {Delaunay} from "delone/full"; ${start} answers.full = new Delaunay([0, 0, 1, 0, 0, 1]).insert(1, 1);`,
  async: `import {init, Delaunator} from "delone/async"; ${start}
    answers.async = init().then(() => new Delaunator([0, 0, 1, 0, 0, 1]).hull.length);`,
  worker: `import {DelaunayWorker} from "delone/worker"; ${start}
    globalThis.ask = (options) => {
      const worker = new DelaunayWorker(options);
      const answer = worker.triangulate([0, 0, 1, 0, 0, 1]).then(({triangles}) => triangles.length, ({code, message}) => code + ": " + message);
      return answer.finally(() => worker.terminate());
    };
    answers.worker = ask();`,
  laz: `import {readLas} from "delone/laz"; ${start} try { readLas(new ArrayBuffer(0)) } catch (error) { answers.laz = error.code }`,
};
const expected = {index: 3, full: 3, async: 3, worker: 3, laz: "no-las"};
const scripts = (names, type = "") => `<!DOCTYPE html><meta charset="utf-8">${names.map((name) => `<script ${type} src="./${name}.js"></script>`).join("")}`;
const files = (programs, below) => Object.fromEntries(Object.entries(programs).map(([name, text]) => [`${below}/${name}.js`, text]));

/** Runs bundles in Node, and gives their answers. */
function runInNode(below, names) {
  const run = `for (const name of ${JSON.stringify(names)}) await import("./" + name + ".js");
    for (const name of Object.keys(answers)) answers[name] = await answers[name];
    console.log(JSON.stringify(answers));`;
  write(folder, {[`${below}/run.mjs`]: run});
  return JSON.parse(execFileSync(process.execPath, [join(folder, below, "run.mjs")], {encoding: "utf8"}));
}

const answersOf = (page, count) =>
  page
    .waitForFunction((count) => Object.keys(globalThis.answers ?? {}).length === count, count, {timeout: 20_000})
    .then(() => page.evaluate(async () => Object.fromEntries(await Promise.all(Object.entries(answers).map(async ([name, answer]) => [name, await answer])))));

/** Runs what a bundler made in Chromium; also where a policy refuses the worker's script, and what takes it from a file then. */
async function runInBrowser(below) {
  copyFileSync(join(folder, "node_modules/delone/dist/delone-worker.js"), join(folder, below, "delone-worker.js"));
  await browse(join(folder, below), async (open, errors) => {
    assert.deepEqual(await answersOf(await open("index.html"), 5), expected);
    const strict = await open("strict.html");
    const {worker, ...others} = await answersOf(strict, 5);
    assert.deepEqual({worker: 3, ...others}, expected);
    assert.match(worker, /^worker: the worker did not start.*worker-src blob:.*delone-worker\.js/);
    assert.equal(await strict.evaluate(() => ask({script: globalThis.script ?? "/delone-worker.js"})), 3);
    assert.match(await strict.evaluate(() => ask({script: "/none.js"})), /^worker: .*none\.js/);
    assert.deepEqual(errors, []);
  });
}

test("esbuild", async (t) => {
  const {build} = await import("esbuild");
  // It does not follow addresses of files, but imports them.
  const async = programs.async.replace("init()", "init(new URL(file, import.meta.url))");
  write(folder, files({...programs, async: `import file from "delone/delone.wasm"; ${async}`}, "esbuild"));
  const names = Object.keys(programs);
  const entryPoints = names.map((name) => join(folder, "esbuild", `${name}.js`));
  await build({entryPoints, bundle: true, format: "esm", loader: {".wasm": "file"}, outdir: join(folder, "esbuild/out"), logLevel: "silent"});
  write(folder, {"esbuild/out/index.html": scripts(names, "type=module"), "esbuild/out/strict.html": scripts(names, "type=module")});
  assert.deepEqual(runInNode("esbuild/out", names), expected);
  await t.test("in Chromium", {skip: noChromium}, () => runInBrowser("esbuild/out"));
});

test("webpack", async (t) => {
  const {default: webpack} = await import("webpack");
  const worker = `${programs.worker} globalThis.script = new URL("delone/delone-worker.js", import.meta.url);`;
  write(folder, files({...programs, worker}, "webpack"));
  const names = Object.keys(programs);
  const entry = Object.fromEntries(names.map((name) => [name, `./webpack/${name}.js`]));
  const options = {mode: "production", context: folder, entry, output: {path: join(folder, "webpack/out")}, performance: {hints: false}};
  const stats = await new Promise((resolve, reject) => webpack(options, (error, stats) => (error ? reject(error) : resolve(stats))));
  const {errors, warnings} = stats.toJson({all: false, errors: true, warnings: true});
  assert.deepEqual([...errors, ...warnings], []);
  write(folder, {"webpack/out/index.html": scripts(names), "webpack/out/strict.html": scripts(names)});
  // For pages, files have addresses relative to the script that runs, which Node has not.
  const {async, worker: _, ...elsewhere} = expected;
  assert.deepEqual(runInNode("webpack/out", Object.keys(elsewhere)), elsewhere);
  await t.test("in Chromium", {skip: noChromium}, () => runInBrowser("webpack/out"));
});

test("Vite", async (t) => {
  const {build, createLogger} = await import("vite");
  const worker = `import script from "delone/delone-worker.js?url"; ${programs.worker} globalThis.script = script;`;
  const page = scripts(Object.keys(programs), "type=module");
  write(folder, {...files({...programs, worker}, "vite"), "vite/index.html": page});
  const warnings = [];
  const customLogger = {...createLogger("silent"), warn: (text) => warnings.push(text)};
  await build({root: join(folder, "vite"), configFile: false, customLogger});
  // That scripts are large is so.
  assert.deepEqual(warnings.filter((text) => !text.includes("chunks are larger")), []);
  const dist = join(folder, "vite/dist");
  copyFileSync(join(dist, "index.html"), join(dist, "strict.html"));
  await t.test("in Chromium", {skip: noChromium}, () => runInBrowser("vite/dist"));
});
