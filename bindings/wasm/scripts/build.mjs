// Builds the package: cargo makes the modules, binaryen makes them smaller where it is installed, and they go into dist/: as files, packed
// into a script, and with everything else in one classic script. Says which step it is at, and how long each took.
//
//     node scripts/build.mjs            all modules
//     node scripts/build.mjs --debug    with all assertions, not made smaller: for tests
//     node scripts/build.mjs --check    says whether dist/ is there, and builds nothing

import {spawn, spawnSync} from "node:child_process";
import {once} from "node:events";
import {copyFileSync, existsSync, mkdirSync, readFileSync, writeFileSync} from "node:fs";
import {fileURLToPath} from "node:url";
import {Worker} from "node:worker_threads";
import {deflateRawSync} from "node:zlib";
import {Steps} from "./steps.mjs";

const root = fileURLToPath(new URL("..", import.meta.url));
const dist = `${root}dist/`;
const isDebug = process.argv.includes("--debug");
const modules = ["delone.wasm", "inline.js", "delone-full.wasm", "inline-full.js", "inline-laz.js"];
const products = [...modules, "worker-text.js", "delone-worker.js", "delone.js", "delone-laz.js"];

if (process.argv.includes("--check")) {
  const missing = products.filter((name) => !existsSync(dist + name));
  if (missing.length) {
    console.error(`dist/ has no ${missing.join(", ")}: npm run build`);
    process.exit(1);
  }
  process.exit(0);
}

const target = "wasm32-unknown-unknown";
const libraries = spawnSync("rustc", ["--print", "target-libdir", "--target", target], {cwd: root, encoding: "utf8"});
if (libraries.error) {
  console.error("error: there is no rustc to build the modules with\nhelp: install Rust, https://rustup.rs");
  process.exit(1);
}
if (!existsSync(libraries.stdout.trim())) {
  console.error(`error: Rust has no standard library for ${target}\nhelp: rustup target add ${target}`);
  process.exit(1);
}

/** Builds a module with cargo in a folder, and gives its bytes. */
async function cargo(folder, profile, features) {
  const args = ["rustc", "--lib", "--quiet", "--target", target, "--message-format", "json-render-diagnostics"];
  args.push("--profile", isDebug ? "checked" : profile);
  if (features) args.push("--features", features);
  const child = spawn("cargo", args, {cwd: folder, env: {CARGO_TARGET_DIR: `${root}target`, ...process.env}, stdio: ["ignore", "pipe", "inherit"]});
  let told = "";
  child.stdout.setEncoding("utf8").on("data", (text) => (told += text));
  const [status] = await once(child, "close");
  if (status) process.exit(status);
  const artifacts = told.trim().split("\n").map((line) => JSON.parse(line));
  const [path] = artifacts.flatMap((artifact) => artifact.filenames ?? []).filter((name) => name.endsWith(".wasm"));
  return readFileSync(path);
}

/** Makes a module smaller, in a thread: cargo is at work on another one. */
async function shrunk(bytes) {
  const thread = new Worker(new URL("./shrink.mjs", import.meta.url), {workerData: bytes});
  const [smaller] = await once(thread, "message");
  return smaller;
}

/** A module as a script: deflated, in base64. */
function inline(bytes) {
  const base64 = deflateRawSync(bytes, {level: 9, memLevel: 9}).toString("base64");
  return `// Made by scripts/build.mjs.\nexport default {size: ${bytes.length}, base64: "${base64}"};\n`;
}

mkdirSync(dist, {recursive: true});
// A package has no links.
for (const name of ["LICENSE-MIT", "LICENSE-APACHE"]) copyFileSync(`${root}../../${name}`, root + name);

const steps = new Steps(isDebug ? 4 : 7);

/** Makes a module of what cargo makes, and a script of that. */
async function make(name, ...how) {
  const raw = await steps.run(`delone${name}.wasm by cargo`, () => cargo(...how));
  const bytes = isDebug ? raw : await steps.run(`delone${name}.wasm made smaller`, () => shrunk(raw));
  // That of files is loaded by its script alone.
  if (name !== "-laz") writeFileSync(`${dist}delone${name}.wasm`, bytes);
  writeFileSync(`${dist}inline${name}.js`, inline(bytes));
  console.log(`delone${name}.wasm: ${bytes.length} bytes`);
}

const small = () => make("", root, "small");
const others = () => make("-full", root, "release", "full").then(() => make("-laz", `${root}laz`, "release"));
// At once what has another profile and so a folder of its own. With checks all have the same one.
if (isDebug) await small().then(others);
else await Promise.all([small(), others()]);

await steps.run("scripts by esbuild", async () => {
  const {build} = await import("esbuild");
  /** A file of ours and all that it imports, as a classic script with a global name. */
  const classic = (entry, globalName, options) =>
    build({entryPoints: [`${root}js/${entry}.js`], bundle: true, minify: true, format: "iife", globalName, target: "es2022", ...options});
  const banner = (what) => ({js: `// delone: ${what}. MIT OR Apache-2.0`});
  const {outputFiles} = await classic("worker-thread", "deloneWorker", {write: false});
  const text = outputFiles[0].text;
  writeFileSync(`${dist}worker-text.js`, `// Made by scripts/build.mjs.\nexport default ${JSON.stringify(text)};\n`);
  writeFileSync(`${dist}delone-worker.js`, `${banner("the thread of delone/worker").js}\n${text}deloneWorker.serve(self);\n`);
  await classic("index", "delone", {outfile: `${dist}delone.js`, banner: banner("exact Delaunay triangulations")});
  await classic("laz", "deloneLaz", {outfile: `${dist}delone-laz.js`, banner: banner("LAS and LAZ files")});
});
steps.end();
