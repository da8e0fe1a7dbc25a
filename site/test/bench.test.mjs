// The workbench in a real browser: files of all kinds are shown, or said to be wrong; results are those of the program; links, undo and reload
// keep what is shown; the page goes on whatever happens.

import assert from "node:assert/strict";
import {spawnSync} from "node:child_process";
import {mkdtempSync, readFileSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {test} from "node:test";
import {data, drawn, give, open, save, says, settled, state, useBrowser} from "./browser.mjs";

useBrowser();
test("a table with names, latitude before longitude, becomes districts with its columns", async (t) => {
  const page = await open(t);
  const text = "id,name,lat,lon\n1,A,48.1,11.5\n2,B,48.3,11.7\n3,C,48.2,11.9\n4,D,48.0,11.6\n5,E,48.15,11.7\n";
  assert.match(await give(page, {"addresses.csv": text}), /^addresses\.csv: 5 points, 4 triangles/);
  assert.match(await page.textContent("#bench-help"), /columns lon, lat were taken as x, y/);
  await page.check("#bench-view-cells");
  assert.match(await settled(page), /Voronoi cells: 5 cells/);
  const {name, bytes} = await save(page, "cells", "geojson");
  assert.equal(name, "cells.geojson");
  const {features} = JSON.parse(bytes);
  assert.deepEqual(features.map(({properties}) => properties.name), ["A", "B", "C", "D", "E"]);
  assert.ok(features.every(({geometry}) => geometry.coordinates[0].every(([x, y]) => x < 12 && y > 47)));
  // Names in another language.
  assert.match(await give(page, {"orte.csv": "Nr;Geogr. Breite;Geogr. Länge\n1;48,1;11,5\n2;48,3;11,7\n3;48,2;11,9\n"}), /^orte\.csv: 3 points, 1 triangle/);
  assert.match(await page.textContent("#bench-help"), /Länge, Geogr\. Breite were taken as x, y/);
  assert.match(await give(page, {"addresses.csv": text}), /^addresses\.csv: 5 points/);
  // Another choice of columns.
  await page.click("#bench-reading summary");
  assert.match(await page.textContent("#bench-rows"), /latlon1A48\.1/);
  await page.selectOption("#bench-column-x", "id");
  await page.selectOption("#bench-column-y", "lat");
  await settled(page);
  assert.match(await page.textContent("#bench-code"), /^delone triangulate addresses\.csv --columns id,lat -o/);
});

test("cells are cut by the polygon of a second file", async (t) => {
  const page = await open(t);
  const region = '{"type":"Polygon","coordinates":[[[0,0],[10,0],[5,9],[0,0]]]}';
  assert.match(await give(page, {"points.csv": "x,y\n2,1\n8,1\n5,6\n5,3\n", "region.geojson": region}), /^points\.csv: 4 points/);
  await page.check("#bench-view-cells");
  assert.match(await settled(page), /Voronoi cells: 4 cells/);
  assert.match(await page.textContent("#bench-code"), /voronoi points\.csv --clip region\.geojson/);
  const {bytes} = await save(page, "cells", "geojson");
  const areas = JSON.parse(bytes).features.map(({properties}) => properties.area);
  assert.ok(Math.abs(areas.reduce((sum, area) => sum + area, 0) - 45) < 1e-9);
  await page.click("#bench-reading summary");
  await page.selectOption("#bench-region", "");
  assert.match(await settled(page), /^points\.csv, region\.geojson: [78] points/);
});

test("contours of a laser scan, of its ground alone", async (t) => {
  const page = await open(t);
  await page.setInputFiles("#bench-file", data("autzen_trim.laz"));
  assert.match(await settled(page), /110,000 points, 219,955 triangles/);
  await page.check("#bench-view-contours");
  assert.match(await settled(page), /Contours: [\d,]+ lines/);
  await page.click("#bench-facts-all summary");
  assert.match(await page.textContent("#bench-facts"), /NAD_1983_HARN_Lambert_Conformal_Conic/);
  await page.click("#bench-reading summary");
  await page.selectOption("#bench-classes", "2");
  assert.match(await settled(page), /26,107 points, 52,187 triangles/);
  const {bytes} = await save(page, "contours", "geojson");
  const {crs, features} = JSON.parse(bytes);
  assert.match(crs.properties.name, /NAD_1983_HARN/);
  assert.ok(features.length > 10 && features.every(({properties}) => properties.elevation % 5 === 0));
  for (const fill of ["heights", "shade"]) {
    await page.selectOption("#bench-fill", fill);
    await settled(page);
    assert.ok((await drawn(page)) > 50_000, fill);
  }
});

test("a mesh of polygons, for a solver", async (t) => {
  const page = await open(t);
  await page.setInputFiles("#bench-file", data("great_lakes.geojson"));
  assert.match(await settled(page), /1,710 points, 1,704 triangles/);
  await page.check("#bench-view-mesh");
  await page.fill("#bench-mesh-angle", "25");
  await page.press("#bench-mesh-angle", "Enter");
  assert.match(await settled(page), /Mesh: .* angles from 2[5-9]\./);
  const {name, bytes} = await save(page, "mesh", "msh");
  assert.equal(name, "mesh.msh");
  assert.match(String(bytes.subarray(0, 20)), /^\$MeshFormat/);
});

test("results are those of the program, byte for byte", async (t) => {
  const program = process.env.DELONE;
  if (!program) return t.skip("DELONE names no program");
  const page = await open(t, {hash: "#set=clusters&n=2000&seed=5&views=triangles,cells,hull,alpha,mesh,graph"});
  await settled(page);
  const folder = mkdtempSync(`${tmpdir()}/bench-`);
  const commands = (await page.textContent("#bench-code")).split("\n");
  for (const command of commands) {
    const words = command.split(" ");
    const file = words.at(-1);
    assert.equal(words.shift(), "delone");
    const {status, stderr} = spawnSync(program, words, {cwd: folder, encoding: "utf8"});
    assert.equal(status, 0, stderr);
    if (words[0] === "generate") continue;
    const [view, format] = file.split(".");
    const {bytes} = await save(page, view, format);
    assert.ok(bytes.equals(readFileSync(`${folder}/${file}`)), command);
  }
});

test("files that are wrong are said to be so, and nothing of the last one stays", async (t) => {
  const page = await open(t);
  const good = "0,0\n1,0\n0,1\n1,1\n";
  for (const [name, bytes, pattern] of [
    ["empty.csv", "", /no points/],
    ["words.csv", "0,0\n1,zwei\n", /line 2|zwei/],
    ["nan.csv", "0,0\n1,0\n0,1\nNaN,3\n", /line 4|NaN|finite/],
    ["far.csv", "0,0\n1,0\n0,1e400\n", /point 2 .*inf/],
    ["cut.geojson", '{"type":"FeatureCollection","features":[{"type":', /JSON|line|EOF/i],
    ["cut.laz", readFileSync(data("autzen_trim.laz")).subarray(0, 30_000), /./],
    ["picture.png", "\u0089PNG\r\n", /png/],
    ["las.las", "LASF", /./],
    ["layer.gpkg", "SQLite format 3\0", /gpkg/],
  ]) {
    assert.match(await give(page, {"good.csv": good}), /^good\.csv: 4 points, 2 triangles/);
    assert.equal(await state(page), "ready");
    const said = await give(page, {[name]: bytes});
    assert.match(said, pattern, name);
    assert.equal(await page.getAttribute("#bench-status", "class"), "error", `${name}: ${said}`);
    assert.ok(await page.isDisabled("#bench-save"), name);
    assert.equal(await drawn(page), 0, `${name}: something is on the stage`);
    assert.equal(await page.textContent("#bench-code"), "");
  }
  assert.match(await give(page, {"a.csv": good, "b.csv": "5,5\n"}), /a\.csv, b\.csv: 5 points/);
  assert.match(await give(page, {"a b's.csv": "0,0\n1,1\n2,2\n"}), /3 points, no triangle: they are on a line/);
  assert.equal(await page.textContent("#bench-code"), "delone triangulate 'a b'\\''s.csv' -o triangles.geojson");
  // A file that is called as what is saved.
  assert.match(await give(page, {"triangles.geojson": '{"type":"MultiPoint","coordinates":[[0,0],[2,0],[1,1]]}'}), /3 points, 1 triangle,/);
  assert.equal((await save(page, "triangles", "geojson")).name, "triangles-new.geojson");
  assert.match(await give(page, {"one.csv": "3,4\n"}), /1 point, too few for a triangle/);
});

test("the least and the largest coordinates are drawn", async (t) => {
  const page = await open(t);
  for (const [name, text] of [
    ["least.csv", "0,0\n1e-320,0\n0,1e-320\n-4e-324,5e-324\n"],
    ["largest.csv", "-1.7e308,-1.7e308\n1.7e308,-1.7e308\n0,1.7e308\n0,0\n"],
    ["both.csv", "-1.7e308,1e-323\n1.7e308,0\n0,1e-323\n"],
    ["flat.csv", "0,1\n1e-310,1\n5e-311,1.0000000000000002\n"],
  ]) {
    assert.match(await give(page, {[name]: text}), /points, [1-9]/);
    const count = await drawn(page);
    assert.ok(count > 300, `${name}: ${count} pixels`);
  }
});

test("the last of two files is shown, and one of the same name anew", async (t) => {
  const page = await open(t);
  const files = (name, text) => [{name, mimeType: "", buffer: Buffer.from(text)}];
  const many = Array.from({length: 300_000}, (_, i) => `${(i * 7919) % 100_003},${(i * i) % 99_991}`).join("\n");
  await page.setInputFiles("#bench-file", files("slow.csv", many));
  await page.setInputFiles("#bench-file", files("fast.csv", "0,0\n1,0\n0,1\n"));
  assert.match(await settled(page), /^fast\.csv: 3 points/);
  assert.match(await give(page, {"fast.csv": "0,0\n1,0\n0,1\n1,1\n"}), /^fast\.csv: 4 points/);
});

test("a file is dropped anywhere, and text is pasted", async (t) => {
  const page = await open(t);
  await page.locator("#start").scrollIntoViewIfNeeded();
  const transfer = await page.evaluateHandle(() => {
    const data = new DataTransfer();
    data.items.add(new File(["0 0\n4 0\n0 3\n"], "dropped.xyz"));
    return data;
  });
  for (const kind of ["dragover", "drop"]) await page.dispatchEvent("#start", kind, {dataTransfer: transfer});
  assert.match(await settled(page), /^dropped\.xyz: 3 points, 1 triangle,/);
  for (const [text, pattern] of [
    ["0,0\n5,0\n0,5\n9,9\n", /^pasted\.csv: 4 points/],
    ["POLYGON((0 0,4 0,4 4,0 4,0 0))", /^pasted\.wkt: [45] points, 2 triangles/],
    ['{"type":"MultiPoint","coordinates":[[0,0],[2,0],[1,1],[0,0]]}', /^pasted\.geojson: 4 points, 1 triangle,/],
  ]) {
    await page.click("#bench-paste-open");
    await page.fill("#bench-paste-text", text);
    await page.click("#bench-paste-take");
    assert.match(await settled(page), pattern);
  }
});

test("links, undo, redo and reload keep what is shown", async (t) => {
  const page = await open(t, {hash: "#set=uniform&n=300&seed=4&views=cells,hull&cells.clip=hull"});
  assert.match(await settled(page), /^uniform\.csv: 300 points.*Voronoi cells: 300 cells/);
  assert.ok(await page.isChecked("#bench-view-hull"));
  assert.equal(await page.inputValue("#bench-cells-clip"), "hull");
  assert.ok(await page.isDisabled("#bench-undo"));
  await page.check("#bench-view-graph");
  assert.match(await settled(page), /Graph: \d+ edges/);
  await page.click("#bench-undo");
  assert.doesNotMatch(await settled(page), /Graph/);
  await page.click("#bench-redo");
  assert.match(await settled(page), /Graph/);
  await page.locator("#bench-picture").press("Control+z");
  assert.doesNotMatch(await settled(page), /Graph/);
  // Files are kept by the browser.
  await give(page, {"mine.csv": "0,0\n7,0\n0,7\n"});
  await page.reload();
  assert.match(await settled(page), /^mine\.csv: 3 points, 1 triangle,/);
  await page.goBack();
  assert.match(await settled(page), /^uniform\.csv: 300 points/);
  const elsewhere = await open(t, {hash: "#file=gone.csv&views=triangles"});
  assert.match(await settled(elsewhere), /no longer has gone\.csv: drop it again/);
  const pasted = await open(t, {hash: "#name=p.csv&text=0%2C0%0A1%2C0%0A0%2C1&views=nothing,cells"});
  assert.match(await settled(pasted), /^p\.csv: 3 points/);
});

test("zoom, pan, hover and choice, by mouse, by keys and by touch", async (t) => {
  const page = await open(t, {hash: "#sample=capitals&views=triangles", hasTouch: true});
  await settled(page);
  const canvas = page.locator("#bench-picture");
  await canvas.focus();
  const picture = () => canvas.evaluate((canvas) => canvas.toDataURL());
  const seen = new Set([await picture()]);
  const changes = async (act) => {
    await act();
    await page.waitForTimeout(200);
    const now = await picture();
    assert.ok(!seen.has(now), "the picture stays");
    seen.add(now);
  };
  const box = await canvas.boundingBox();
  await changes(() => page.keyboard.press("+"));
  await changes(() => page.keyboard.press("ArrowLeft"));
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await changes(() => page.mouse.wheel(0, -300));
  await changes(() => page.mouse.dblclick(box.x + box.width / 2, box.y + box.height / 2));
  await changes(async () => {
    await page.mouse.down();
    await page.mouse.move(box.x + 100, box.y + 100, {steps: 4});
    await page.mouse.up();
  });
  await page.click("#bench-all");
  await page.waitForTimeout(200);
  // A triangle in the middle, then the nearest of all points.
  await canvas.focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => /triangle \d+: .*least angle|point \d+/.test(document.querySelector("#bench-chosen").textContent));
  const client = await page.context().newCDPSession(page);
  const touch = (type, ...points) => client.send("Input.dispatchTouchEvent", {type, touchPoints: points.map(([x, y], id) => ({x, y, id}))});
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await changes(async () => {
    await touch("touchStart", [x - 30, y], [x + 30, y]);
    for (let k = 1; k < 6; k++) await touch("touchMove", [x - 30 - 20 * k, y], [x + 30 + 20 * k, y]);
    await touch("touchEnd");
  });
  await page.click("#bench-all");
  await page.waitForTimeout(200);
  let found = "";
  for (let k = 0; k < 400 && !/name: /.test(found); k++) {
    await page.mouse.move(box.x + 20 + ((k * 37) % (box.width - 40)), box.y + 20 + ((k * 53) % (box.height - 40)));
    await page.waitForTimeout(70);
    found = await page.textContent("#bench-tip");
  }
  assert.match(found, /point \d+: .*name: \w+/s);
});

test("keys are told, Escape closes, and a long work can be cancelled", async (t) => {
  const page = await open(t, {hash: "#sample=capitals&views=triangles"});
  await settled(page);
  await page.locator("#bench-picture").press("?");
  assert.ok(await page.isVisible("#bench-keys"));
  await page.keyboard.press("Escape");
  assert.ok(await page.isHidden("#bench-keys"));
  await page.click("summary:has-text('A set of points')");
  await page.fill("#bench-count", "2000000");
  await page.click("#bench-set-take");
  await page.waitForSelector("#bench-cancel:visible");
  await page.click("#bench-cancel");
  assert.match(await settled(page), /^Cancelled/);
  await page.click("[data-sample=lakes]");
  assert.match(await settled(page), /^great_lakes\.geojson/);
});

test("without room for the program, or with a worker that dies, a sentence says so and the page goes on", async (t) => {
  const page = await open(t, {prepare: () => (globalThis.Worker = class { constructor() { throw new Error("no workers here"); } })});
  await page.click("[data-sample=capitals]");
  assert.match(await settled(page), /no workers here/);
  const other = await open(t, {
    prepare: () => {
      const {Worker} = globalThis;
      let count = 0;
      globalThis.Worker = class extends Worker {
        postMessage(message, ...rest) {
          if (message.task === "run" && ++count === 1) return this.dispatchEvent(new ErrorEvent("error", {message: "the worker died"}));
          return super.postMessage(message, ...rest);
        }
      };
    },
  });
  await other.click("[data-sample=capitals]");
  assert.match(await settled(other), /the worker died/);
  await other.click("[data-sample=lakes]");
  assert.match(await settled(other), /^great_lakes\.geojson: 1,710 points/);
});

test("pictures are saved, and code is copied", async (t) => {
  const page = await open(t, {hash: "#sample=capitals&views=cells"});
  await settled(page);
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#bench-png")]);
  assert.match(String(readFileSync(await download.path()).subarray(0, 8)), /PNG/);
  const svg = await save(page, "cells", "svg");
  assert.match(String(svg.bytes.subarray(0, 200)), /<svg/);
  await page.click("[data-tab=Python]");
  assert.match(await page.textContent("#bench-code"), /points = np\.array\(\[\[row\["lon"\], row\["lat"\]\] for row in rows\], dtype=float\)/);
  await page.click("#bench-copy");
  await page.waitForFunction(() => document.querySelector("#bench-copied").textContent === "Copied.");
});

test("three million points", async (t) => {
  const page = await open(t);
  const folder = mkdtempSync(`${tmpdir()}/bench-`);
  let [text, seed] = ["", 1];
  const next = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  for (let i = 0; i < 3e6; i++) text += `${next().toFixed(7)},${next().toFixed(7)}\n`;
  writeFileSync(`${folder}/huge.csv`, text);
  await page.setInputFiles("#bench-file", `${folder}/huge.csv`);
  assert.match(await settled(page), /^huge\.csv: 3,000,000 points, 5,99\d,\d+ triangles/);
  assert.ok((await drawn(page)) > 50_000);
  const {bytes} = await save(page, "triangles", "npy");
  assert.ok(bytes.length > 5_900_000 * 24);
});
