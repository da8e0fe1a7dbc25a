// Builds the page into dist/: open dist/index.html, from a disk or from any server. Nothing is asked of any other machine.
//
//     npm install && npm run build

import {build} from "esbuild";
import {copyFileSync, mkdirSync, rmSync} from "node:fs";
import {fileURLToPath} from "node:url";

const root = fileURLToPath(new URL(".", import.meta.url));
const dist = `${root}dist/`;
rmSync(dist, {recursive: true, force: true});
mkdirSync(`${dist}pictures`, {recursive: true});

const common = {bundle: true, minify: true, target: "es2022", format: "iife", logLevel: "warning"};

// The worker is a part of the page as text: a page from a disk may not load scripts for workers, but may make them.
const worker = await build({...common, entryPoints: [`${root}src/worker.js`], write: false});
await build({
  ...common,
  entryPoints: [`${root}src/main.js`],
  outfile: `${dist}page.js`,
  plugins: [
    {
      name: "worker",
      setup(built) {
        built.onResolve({filter: /^worker:text$/}, () => ({path: "worker", namespace: "worker"}));
        built.onLoad({filter: /.*/, namespace: "worker"}, () => ({contents: worker.outputFiles[0].text, loader: "text"}));
      },
    },
  ],
});
// Loaded when they are needed, and not before.
for (const [name, globalName] of [["rival", "Rival"], ["laz", "Laz"]]) {
  await build({...common, entryPoints: [`${root}src/${name}.js`], outfile: `${dist}${name}.js`, globalName});
}

for (const name of ["index.html", "style.css", "icon.svg"]) copyFileSync(root + name, dist + name);
for (const name of ["lists", "flips", "hints", "levels"]) {
  copyFileSync(`${root}../docs/gallery/${name === "hints" ? "walks" : name}.png`, `${dist}pictures/${name}.png`);
}
console.log(`${dist}index.html`);
