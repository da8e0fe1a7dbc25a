// Every way to get the package: the async entry, a worker, a bundle, a classic script; and what the module asks of its host.

import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {createRequire} from "node:module";
import {tmpdir} from "node:os";
import {join} from "node:path";
import test from "node:test";
import {fileURLToPath} from "node:url";
import vm from "node:vm";
import {inflateRawSync} from "node:zlib";
import {DelaunayWorker} from "delone/worker";
import {inflate} from "../js/inflate.js";
import {prove} from "./support/oracle.mjs";
import {sets} from "./support/sets.mjs";

const root = fileURLToPath(new URL("..", import.meta.url));
const file = (name) => readFileSync(root + name);
const node = (script, ...options) =>
  execFileSync(process.execPath, ["--input-type=module", ...options, "-e", script], {cwd: root, encoding: "utf8"}).trim();

test("the module imports nothing, and both entries have what they promise", () => {
  for (const name of ["delone", "delone-full"]) {
    const module = new WebAssembly.Module(file(`dist/${name}.wasm`));
    assert.deepEqual(WebAssembly.Module.imports(module), []);
    const names = WebAssembly.Module.exports(module).map((e) => e.name);
    assert.equal(names.includes("insert"), name === "delone-full");
  }
});

test("the package's own decompression", async () => {
  for (const name of ["inline", "inline-full"]) {
    const {default: {size, base64}} = await import(`../dist/${name}.js`);
    const packed = Buffer.from(base64, "base64");
    assert.deepEqual(Buffer.from(inflate(packed, size)), inflateRawSync(packed));
    assert.throws(() => inflate(packed.subarray(0, packed.length / 2), size));
  }
});

test("the async entry: not ready, ready by default, by bytes, by a module, once; and a failure can be repeated", () => {
  const head = 'import {init, Delaunay} from "delone/async"; import {readFileSync} from "node:fs";';
  const use = "console.log(Delaunay.from([[0, 0], [1, 0], [0, 1]]).triangles.length);";
  assert.equal(node(`${head} try { new Delaunay([]) } catch (e) { console.log(e.code) }`), "not-ready");
  assert.equal(node(`${head} await init(); ${use}`), "3");
  assert.equal(node(`${head} await Promise.all([init(), init()]); ${use}`), "3");
  assert.equal(node(`${head} await init(readFileSync("dist/delone.wasm")); ${use}`), "3");
  assert.equal(node(`${head} await init(new WebAssembly.Module(readFileSync("dist/delone-full.wasm"))); ${use}`), "3");
  assert.equal(node(`${head} await init(new Response(readFileSync("dist/delone.wasm"))); ${use}`), "3");
  const empty = "Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0)";
  assert.equal(node(`${head} await init(${empty}).catch((e) => console.log(e.code)); await init(); ${use}`), "not-ready\n3");
  assert.equal(node(`${head} await init(Promise.reject(null)).catch((e) => console.log(e.code)); await init(); ${use}`), "not-ready\n3");
  assert.equal(node(`${head} await init("none.wasm").catch((e) => console.log(e.code)); await init(); ${use}`), "not-ready\n3");
});

test("the small module names what it does not have", () => {
  assert.equal(node('import {Delaunay} from "delone"; try { Delaunay.from([[0, 0]]).insert(1, 1) } catch (e) { console.log(e.code) }'), "unavailable");
});

test("a worker takes what can be taken, and says what cannot", async () => {
  const worker = new DelaunayWorker();
  const fails = async (coords, code, index) =>
    assert.rejects(worker.triangulate(coords, {transfer: true}), (error) => {
      assert.deepEqual([error.name, error.code, error.index], ["DeloneError", code, index]);
      return true;
    });
  const given = Float64Array.of(0, 0, 1, 0, 0, 1);
  const both = [worker.triangulate(given, {transfer: true}), fails(given, "input")];
  assert.equal((await both[0]).triangles.length, 3);
  await both[1];
  await fails(given, "input");
  const shared = new Float64Array(new SharedArrayBuffer(48));
  shared.set([0, 0, 1, 0, 0, 1]);
  assert.equal((await worker.triangulate(shared, {transfer: true, skipInvalid: null})).triangles.length, 3);
  assert.equal((await worker.triangulate([0, 0, 1, 0, 0, 1], null)).triangles.length, 3);
  assert.equal((await worker.triangulate(new Float64Array(0), {transfer: true})).triangles.length, 0);
  await fails([0, null, 1, 0, 0, 1], "not-finite", 0);
  await fails("0", "input");
  await fails({length: -3}, "length");
  await fails(null, "input");
  await fails([1n, 0], "not-a-number", 0);
  await worker.terminate();
});

test("a worker", async () => {
  const worker = new DelaunayWorker();
  const {coords, ...arrays} = await worker.triangulate(sets.uniform);
  assert.deepEqual(coords, sets.uniform);
  prove(arrays, coords);
  const given = sets["a grid"].slice();
  const [first, second] = await Promise.all([worker.triangulate(given, {transfer: true}), worker.triangulate([0, 0, 1, 0, 0, 1])]);
  assert.equal(given.length, 0, "it was given away");
  prove(first, first.coords);
  assert.equal(second.triangles.length, 3);
  await assert.rejects(worker.triangulate([0, NaN]), (error) => error.code === "not-finite" && error.index === 0);
  assert.equal((await worker.triangulate([0, NaN], {skipInvalid: true})).hull.length, 0);
  const waiting = worker.triangulate(sets.uniform);
  const rejected = assert.rejects(waiting, {code: "disposed"});
  await worker.terminate();
  await rejected;
  await assert.rejects(worker.triangulate([]), {code: "disposed"});
});

test("a worker that is ended while its answer is under way", async () => {
  for (let delay = 0; delay < 20; delay++) {
    const worker = new DelaunayWorker();
    await worker.triangulate([0, 0, 1, 0, 0, 1]);
    const answer = worker.triangulate([0, 0, 1, 0, 0, 1]).then(() => "answered", (error) => error.code);
    await new Promise((resolve) => setTimeout(resolve, delay / 10));
    // The thread answers while this one does not listen.
    for (const until = performance.now() + delay; performance.now() < until; );
    await worker.terminate();
    assert.match(await answer, /answered|disposed/);
  }
  const worker = new DelaunayWorker();
  const asked = assert.rejects(worker.triangulate([0, 0, 1, 0, 0, 1]), {code: "disposed"});
  await worker.terminate();
  await asked;
});

test("a worker that cannot start says what would help", async () => {
  // As in a browser whose policy refuses it: there it is an event without a message, or an error at once.
  const program = (worker) => `
    delete globalThis.process; globalThis.Worker = ${worker};
    const {DelaunayWorker} = await import("delone/worker");
    const worker = new DelaunayWorker();
    await worker.triangulate([0, 0]).catch(({code, message}) => console.log(code, message));
    await worker.triangulate([0, 0]).catch(({code}) => console.log(code));
    await worker.terminate();`;
  const silent = "class extends EventTarget { postMessage() { setTimeout(() => this.dispatchEvent(new Event('error'))) } terminate() {} }";
  for (const worker of ["undefined", silent, "class { constructor() { throw new Error('refused') } }"]) {
    assert.match(node(program(worker)), /^worker the worker did not start.*worker-src blob:.*script.*\nworker$/, worker);
  }
});

test("a program with an idle worker ends", () => {
  assert.equal(node('import {DelaunayWorker} from "delone/worker"; console.log((await new DelaunayWorker().triangulate([0, 0, 1, 0, 0, 1])).hull.length)'), "3");
});

test("bundles for browsers, of every entry; the default one runs", async () => {
  const {build} = await import("esbuild");
  const folder = mkdtempSync(join(tmpdir(), "delone-"));
  const bundle = (contents, name) =>
    build({stdin: {contents, resolveDir: root}, bundle: true, minify: true, format: "esm", platform: "browser", outfile: join(folder, name), logLevel: "silent"});
  try {
    for (const entry of ["delone/async", "delone/full", "delone/worker"]) await bundle(`export * from "${entry}";`, `${entry}.mjs`);
    await bundle('import {Delaunay} from "delone"; console.log(Delaunay.from([[0, 0], [1, 0], [0, 1]]).voronoi().cellPolygon(0).length);', "bundle.mjs");
    assert.match(execFileSync(process.execPath, [join(folder, "bundle.mjs")], {encoding: "utf8"}), /^[4-6]\n$/);
    // For Node: the worker's script is inside of the program.
    const options = {bundle: true, format: "esm", platform: "node", outdir: folder, entryNames: "[name]", logLevel: "silent"};
    writeFileSync(join(folder, "package.json"), '{"type": "module"}');
    const program = 'import {DelaunayWorker} from "delone/worker"; console.log((await new DelaunayWorker().triangulate([0, 0, 1, 0, 0, 1])).hull.length);';
    await build({...options, stdin: {contents: program, resolveDir: root}});
    assert.equal(execFileSync(process.execPath, [join(folder, "stdin.js")], {encoding: "utf8"}), "3\n");
  } finally {
    rmSync(folder, {recursive: true});
  }
});

test("CommonJS, where Node loads modules by require", {skip: !process.features.require_module}, () => {
  const script = 'const {Delaunay} = require("delone/full"); console.log(Delaunay.from([[0, 0], [1, 0], [0, 1]]).insert(1, 1));';
  assert.equal(execFileSync(process.execPath, ["--no-warnings", "-e", script], {cwd: root, encoding: "utf8"}), "3\n");
});

test("a classic script", () => {
  const text = file("dist/delone.js").toString();
  assert.ok(!/[^\x00-\x7f]/.test(text), "whatever the page's encoding is");
  const {atob, performance} = globalThis;
  const context = vm.createContext({atob, performance, WebAssembly});
  vm.runInContext(text, context);
  assert.equal(vm.runInContext("delone.Delaunay.from([[0, 0], [1, 0], [0, 1]]).triangles.length", context), 3);
  assert.equal(vm.runInContext("new delone.Delaunator([0, 0, 1, 0, 0, 1]).hull.length", context), 3);
});

test("d3's program with one line changed", () => {
  const program = (name) => `
    import {Delaunay} from "${name}";
    const points = Array.from({length: 300}, (_, i) => [(i * 7919) % 800, (i * 104729) % 450]);
    const delaunay = Delaunay.from(points), voronoi = delaunay.voronoi([0, 0, 800, 450]);
    const round = (x) => Math.round(x * 1e6) / 1e6;
    const cells = Array.from(voronoi.cellPolygons(), (cell) => cell.map((p) => p.map(round).join()).slice(1).sort().join(" "));
    const neighbors = points.map((_, i) => [...delaunay.neighbors(i)].sort().join() + "|" + [...voronoi.neighbors(i)].sort().join());
    console.log(JSON.stringify([cells, neighbors, delaunay.find(400, 200), voronoi.contains(5, 1, 1), [...delaunay.hull].sort()]));`;
  assert.equal(node(program("delone")), node(program("d3-delaunay")));
});

test("the package refers to itself by what it exports", () => {
  const require = createRequire(import.meta.url);
  for (const path of Object.values(require("../package.json").exports).flatMap((entry) => (typeof entry === "string" ? entry : Object.values(entry)))) {
    assert.ok(file(path.slice(2)).length > 0, path);
  }
});
