// Builds the program for the page: cargo compiles it to WebAssembly, and what it says of its formats and sets becomes a table. Some minutes
// the first time. Needs Rust with the target wasm32-wasip1.

import {spawn, spawnSync} from "node:child_process";
import {once} from "node:events";
import {existsSync, readFileSync} from "node:fs";
import {fileURLToPath} from "node:url";
import {run} from "./src/workbench/program.js";

const root = fileURLToPath(new URL("..", import.meta.url));
const target = "wasm32-wasip1";
/** Commands whose outputs the page offers. */
const commands = ["triangulate", "voronoi", "hull", "alpha", "contours", "mesh", "graph"];
/** Of a format's second files there is no choice, and a page has no SQLite. */
const others = ["v.node", "v.edge", "gpkg"];

/** The program, as bytes. */
export async function program() {
  const libraries = spawnSync("rustc", ["--print", "target-libdir", "--target", target], {cwd: root, encoding: "utf8"});
  if (libraries.error || !existsSync(libraries.stdout.trim())) {
    console.error(`error: there is no Rust for ${target}\nhelp: rustup target add ${target}`);
    process.exit(1);
  }
  const args = ["build", "--profile", "web", "-p", "delone-cli", "--no-default-features", "--target", target, "--message-format", "json-render-diagnostics"];
  const child = spawn("cargo", args, {cwd: root, stdio: ["ignore", "pipe", "inherit"]});
  let told = "";
  child.stdout.setEncoding("utf8").on("data", (text) => (told += text));
  const [status] = await once(child, "close");
  if (status) process.exit(status);
  const artifacts = told.trim().split("\n").map((line) => JSON.parse(line));
  return readFileSync(artifacts.flatMap(({filenames = []}) => filenames).find((name) => name.endsWith("/delone.wasm")));
}

/** Formats that are read, formats that each command writes in the plane, names of sets in the plane: as the program's help tells them. */
export async function table(bytes) {
  const module = await WebAssembly.compile(bytes);
  const told = async (...words) => (await run(module, words, {})).prints.join(" ").replace(/\s+/g, " ");
  const help = await told("triangulate", "--help");
  const [, inputs] = /standard input: ([\w ]+),/.exec(help);
  const outputs = {};
  for (const command of commands) {
    const [, list] = /Output file \((.*?)\)/.exec(await told(command, "--help"));
    const inPlane = list.replace(/^in the plane /, "").replace(/; in space.*/, "").replace(/; in the plane also/, "");
    outputs[command] = inPlane.split(" ").filter((format) => !others.includes(format));
  }
  const {prints} = await run(module, ["generate", "list"], {});
  const [plane] = prints.join("\n").split("\n\n");
  return {inputs: inputs.split(" ").filter((format) => !others.includes(format)), outputs, sets: plane.split("\n").map((line) => line.split(" ")[0])};
}
