// Builds the page into dist/: open dist/index.html, from a disk or from any server. Nothing is asked of any other machine.
//
//     npm install && npm run build

import {build} from "esbuild";
import {copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {fileURLToPath} from "node:url";
import {deflateRawSync} from "node:zlib";
import {program, table} from "./program.mjs";

const root = fileURLToPath(new URL(".", import.meta.url));
const dist = `${root}dist/`;
rmSync(dist, {recursive: true, force: true});
mkdirSync(`${dist}pictures`, {recursive: true});

const common = {bundle: true, minify: true, target: "es2022", format: "iife", logLevel: "warning"};
const bytes = await program();
const formats = await table(bytes);

/** Workers are a part of their page as text: a page from a disk may not load scripts for workers, but may make them. */
const plugins = [
  {
    name: "parts",
    setup(built) {
      built.onResolve({filter: /^worker:/}, ({path}) => ({path: path.slice("worker:".length), namespace: "worker"}));
      built.onLoad({filter: /.*/, namespace: "worker"}, async ({path}) => {
        const {outputFiles} = await build({...common, entryPoints: [`${root}src/${path}`], write: false});
        return {contents: outputFiles[0].text, loader: "text"};
      });
      built.onResolve({filter: /^formats:table$/}, () => ({path: "table", namespace: "formats"}));
      built.onLoad({filter: /.*/, namespace: "formats"}, () => ({contents: JSON.stringify(formats), loader: "json"}));
    },
  },
];
await build({...common, plugins, entryPoints: [`${root}src/main.js`], outfile: `${dist}page.js`});
// Loaded when they are needed, and not before.
await build({...common, plugins, entryPoints: [`${root}src/figures.js`], outfile: `${dist}figures.js`});
await build({...common, entryPoints: [`${root}src/rival.js`], outfile: `${dist}rival.js`, globalName: "Rival"});
// A page from a disk may not fetch, but may have scripts.
const script = (name, global, value) => writeFileSync(dist + name, `globalThis.${global}=${JSON.stringify(value)};\n`);
script("program.js", "deloneProgram", deflateRawSync(bytes, {level: 9}).toString("base64"));
const samples = ["great_lakes.geojson", "autzen_trim.laz"];
script("samples.js", "deloneSamples", Object.fromEntries(samples.map((name) => [name, readFileSync(`${root}../data/${name}`).toString("base64")])));

for (const name of ["index.html", "style.css", "icon.svg"]) copyFileSync(root + name, dist + name);
for (const name of ["lists", "flips", "hints", "levels"]) {
  copyFileSync(`${root}../docs/gallery/${name === "hints" ? "walks" : name}.png`, `${dist}pictures/${name}.png`);
}
console.log(`${dist}index.html`);
