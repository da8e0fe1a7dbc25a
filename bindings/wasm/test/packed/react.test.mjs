// The README's hook in React's strict mode, where components are made twice and effects taken back once: nothing is used after it was disposed
// of, and nothing stays.

import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import {join} from "node:path";
import test from "node:test";
import {fileURLToPath} from "node:url";
import {build} from "esbuild";
import {installed, write} from "./support/app.mjs";
import {browse, noChromium} from "./support/chromium.mjs";

const root = fileURLToPath(new URL("../..", import.meta.url));
const [, hook] = readFileSync(`${root}README.md`, "utf8").match(/^```jsx\n([\s\S]*?)^```$/m);

/** The hook that comes to mind first: in strict mode the triangulation on show is disposed of. */
const naive = `import {useEffect, useMemo} from "react"; import {Delaunay} from "delone";
  export function useDelaunay(points) {
    const delaunay = useMemo(() => Delaunay.from(points), [points]);
    useEffect(() => () => delaunay.dispose(), [delaunay]);
    return delaunay;
  }`;

const program = (hook) => `
  import {Activity, Component, createElement as h, StrictMode, useEffect} from "react";
  import {createRoot} from "react-dom/client";
  import {Delaunay} from "delone";
  import {useDelaunay} from "./${hook}.js";

  const made = [];
  const {update, dispose} = Delaunay.prototype;
  Delaunay.prototype.update = function () { made.push(new WeakRef(this)); return update.call(this); };
  Delaunay.prototype.dispose = function () { this.isDisposed = true; dispose.call(this); };
  const counts = {made: 0, found: 0};
  globalThis.alive = () => made.filter((ref) => ref.deref() && !ref.deref().isDisposed).length;
  globalThis.counts = () => ({...counts, made: made.length, alive: alive(), disposed: made.filter((ref) => ref.deref()?.isDisposed).length});

  class Boundary extends Component {
    state = {};
    static getDerivedStateFromError = (error) => ({error: error.code ?? String(error)});
    render() { return this.state.error ? h("output", null, this.state.error) : this.props.children; }
  }

  /** Reads the triangulation of its parent in an effect, and when that is taken back. */
  function Nearest({delaunay}) {
    useEffect(() => {
      if (delaunay.find(5, 5) >= 0) ++counts.found;
      return () => void delaunay.find(1, 1);
    }, [delaunay]);
    return null;
  }

  function Cells({points}) {
    const delaunay = useDelaunay(points);
    const cells = delaunay.voronoi([0, 0, 10, 10]);
    return h("svg", null, h("path", {d: cells.render(), fill: "none"}), h(Nearest, {delaunay}));
  }

  const points = (seed) => Array.from({length: 20}, (_, k) => [(k * 7.13 + seed) % 10, (k * 3.77 + seed * seed) % 10]);
  const root = createRoot(document.querySelector("main"));
  const known = {};
  const cells = (seed) => h(Cells, {points: (known[seed] ??= points(seed))});
  globalThis.show = (seed, mode = "visible") => root.render(h(StrictMode, null, h(Boundary, null, h(Activity, {mode}, cells(seed)))));
  globalThis.end = () => root.unmount();
`;

/** Lets React do what it has to, and timers after it. */
const settled = (page) => page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 60)));

test("the README's hook", {skip: noChromium}, async () => {
  const {folder, remove} = installed();
  try {
    write(folder, {"right.js": hook, "naive.js": naive, "right-app.js": program("right"), "naive-app.js": program("naive")});
    await build({
      entryPoints: ["right-app", "naive-app"].map((name) => join(folder, `${name}.js`)),
      bundle: true,
      outdir: join(folder, "out"),
      nodePaths: [`${root}node_modules`],
      define: {"process.env.NODE_ENV": '"development"'},
    });
    const page = (app) => `<!DOCTYPE html><meta charset="utf-8"><main></main><script src="${app}.js"></script>`;
    write(folder, {"out/right.html": page("right-app"), "out/naive.html": page("naive-app")});
    await browse(join(folder, "out"), async (open, errors) => {
      const right = await open("right.html");
      const paths = new Set();
      for (let seed = 0; seed < 10; ++seed) {
        await right.evaluate((seed) => show(seed), seed);
        await settled(right);
        paths.add(await right.locator("path").getAttribute("d"));
        await right.evaluate(() => gc());
        await settled(right);
        assert.ok((await right.evaluate(() => alive())) >= 1);
      }
      assert.equal(paths.size, 10, "each shown");
      // Hidden, and shown again as it was.
      for (const mode of ["hidden", "visible", "hidden", "visible"]) {
        await right.evaluate((mode) => show(9, mode), mode);
        await settled(right);
      }
      assert.ok(paths.has(await right.locator("path").getAttribute("d")));
      assert.equal(await right.locator("output").count(), 0);
      const {made, found} = await right.evaluate(() => counts());
      assert.ok(made >= 10 && found >= 10, "each made, and asked by effects of a child");
      await right.evaluate(() => end());
      await settled(right);
      for (let k = 0; k < 20 && (await right.evaluate(() => alive())); ++k) {
        await right.evaluate(() => gc());
        await settled(right);
      }
      assert.equal(await right.evaluate(() => alive()), 0, "nothing stays");
      assert.deepEqual(errors, []);

      const wrong = await open("naive.html");
      await wrong.evaluate(() => show(0));
      await settled(wrong);
      assert.equal(await wrong.locator("output").textContent(), "disposed", "this test sees what is wrong");
    }, ["--js-flags=--expose-gc"]);
  } finally {
    remove();
  }
});
