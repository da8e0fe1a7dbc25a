// What visitors did that nobody had thought of: views that are all off, columns that have to be chosen, warnings, fingers, steps back, names and
// rows of all kinds.

import assert from "node:assert/strict";
import {spawnSync} from "node:child_process";
import {mkdtempSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {test} from "node:test";
import {drawn, give, open, save, settled, useBrowser} from "./browser.mjs";

useBrowser();
const SQUARE = "x,y\n0,0\n1,0\n0,1\n1,1\n";

test("nothing can be saved while no view is shown, and the page goes on", async (t) => {
  const page = await open(t);
  await give(page, {"a.csv": SQUARE});
  await page.uncheck("#bench-view-triangles");
  await settled(page);
  assert.ok(await page.isDisabled("#bench-save"));
  await page.check("#bench-view-hull");
  await settled(page);
  // The view that was asked for last is the one to take.
  assert.equal(await page.inputValue("#bench-save-view"), "hull");
  assert.match((await save(page, "hull", "csv")).name, /^hull\.csv$/);
});

test("columns that no name tells are chosen one after the other", async (t) => {
  const page = await open(t);
  const said = await give(page, {"odd.csv": "station,population,foo,bar\nA,5,1,2\nB,6,4,2\nC,7,1,6\n"});
  assert.match(said, /column/);
  assert.match(await page.textContent("#bench-help"), /Choose the columns/);
  await page.selectOption("#bench-column-x", "foo");
  await page.selectOption("#bench-column-y", "bar");
  assert.match(await settled(page), /^odd\.csv: 3 points, 1 triangle,/);
  assert.match(await page.textContent("#bench-code"), /--columns foo,bar/);
});

test("rows without coordinates are left out, and told", async (t) => {
  const page = await open(t);
  const said = await give(page, {"geocoded.csv": "name,lat,lon\nA,48,11\nB,,\nC,49,12\nD,NA,n/a\nE,48,13\n"});
  assert.match(said, /line 3: field 3 is "", not a number|line 3/);
  assert.match(await page.textContent("#bench-help"), /Rows without coordinates can be left out/);
  assert.ok(await page.isVisible("#bench-missing"));
  await page.check("#bench-missing");
  assert.match(await settled(page), /^geocoded\.csv: 3 points, 1 triangle/);
  assert.match(await page.textContent("#bench-help"), /2 rows without coordinates left out: lines 3, 5/);
  await page.check("#bench-view-cells");
  await settled(page);
  const {features} = JSON.parse((await save(page, "cells", "geojson")).bytes);
  assert.deepEqual(features.map(({properties}) => properties.name), ["A", "C", "E"]);
});

test("warnings of a mesh are shown, and saved meshes have them too", async (t) => {
  const page = await open(t);
  const points = Array.from({length: 60}, (_, i) => `${(i * 37) % 61},${(i * 53) % 59}`).join("\n");
  await give(page, {"a.csv": points});
  await page.check("#bench-view-mesh");
  await page.fill("#bench-mesh-angle", "42");
  await page.press("#bench-mesh-angle", "Enter");
  await settled(page);
  assert.match(await page.textContent("#bench-help"), /not as wanted/);
  assert.equal(await page.getAttribute("#bench-help", "class"), "error");
  await save(page, "mesh", "msh");
  assert.match(await page.textContent("#bench-help"), /not as wanted/);
});

test("degrees are said to be degrees", async (t) => {
  const page = await open(t, {hash: "#sample=capitals&views=cells"});
  await settled(page);
  assert.match(await page.textContent("#bench-help"), /taken as coordinates of a plane, in degrees/);
});

test("a finger chooses, scrolls the page while all is seen, and moves what is zoomed", async (t) => {
  const page = await open(t, {hash: "#sample=capitals&views=triangles", hasTouch: true, viewport: {width: 390, height: 844}});
  await settled(page);
  const canvas = page.locator("#bench-picture");
  await canvas.tap({position: {x: 180, y: 250}});
  await page.waitForFunction(() => /triangle|point/.test(document.querySelector("#bench-chosen").textContent));
  const action = () => canvas.evaluate((canvas) => canvas.style.touchAction);
  assert.equal(await action(), "pan-y");
  await page.click("#bench-in");
  await page.waitForTimeout(200);
  assert.equal(await action(), "none");
});

test("the wheel scrolls past an empty stage, and past one that shows all", async (t) => {
  const page = await open(t);
  await page.hover("#bench-picture");
  await page.mouse.wheel(0, 300);
  await page.waitForFunction(() => scrollY > 100);
  await page.evaluate(() => scrollTo(0, 0));
  await give(page, {"a.csv": SQUARE});
  await page.hover("#bench-picture");
  await page.mouse.wheel(0, 300);
  await page.waitForFunction(() => scrollY > 100);
});

test("steps back end where the page began, and lead to the files of their time", async (t) => {
  const page = await open(t);
  await give(page, {"a.csv": SQUARE});
  await give(page, {"a.csv": "0,0\n1,0\n0,1\n1,1\n5,5\n"});
  await give(page, {"b.csv": "0,0\n1,0\n0,1\n"});
  await page.dblclick("#bench-undo");
  assert.match(await settled(page), /^a\.csv: 5 points/);
  await page.click("#bench-undo");
  assert.match(await settled(page), /^a\.csv: 4 points/);
  for (let k = 0; k < 4; k++) await page.locator("#bench-picture").press("Control+z");
  await page.waitForTimeout(300);
  assert.match(page.url(), /index\.html/);
});

test("reloads keep long texts, odd names, and what is shown beside links to sections", async (t) => {
  const page = await open(t);
  await page.click("#bench-paste-open");
  await page.fill("#bench-paste-text", Array.from({length: 900}, (_, i) => `${i},${(i * 7919) % 1009}`).join("\n"));
  await page.click("#bench-paste-take");
  assert.match(await settled(page), /^pasted\.csv: 900 points/);
  await page.reload();
  assert.match(await settled(page), /^pasted\.csv: 900 points/);
  await give(page, {"a|b.csv": SQUARE});
  await page.click('nav a[href="#walls"]');
  await page.reload();
  assert.match(await settled(page), /^a\|b\.csv: 4 points/);
  assert.match(await give(page, {".stats.json": "{}", "-o.csv": SQUARE}), /4 points/);
});

test("a file that is being made is not lost to another wish", async (t) => {
  const page = await open(t, {hash: "#set=uniform&n=200000&seed=1&views=triangles"});
  await settled(page);
  await page.selectOption("#bench-save-format", "geojson");
  const saved = page.waitForEvent("download");
  await page.click("#bench-save");
  await page.waitForTimeout(600);
  await page.check("#bench-view-hull");
  assert.equal((await saved).suggestedFilename(), "triangles.geojson");
  await settled(page);
});

/** What is told of the point at a place of a square that fills the stage. */
async function tipAt(page, x, y) {
  const box = await page.locator("#bench-picture").boundingBox();
  const side = 0.94 * Math.min(box.width, box.height);
  await page.mouse.move(box.x + box.width / 2 + (x - 0.5) * side + 2, box.y + box.height / 2 - (y - 0.5) * side + 2);
  await page.waitForFunction(() => !document.querySelector("#bench-tip").hidden && /:/.test(document.querySelector("#bench-tip").textContent));
  await page.waitForTimeout(250);
  return page.textContent("#bench-tip");
}

test("rows are told as the program reads them", async (t) => {
  const page = await open(t);
  await give(page, {"q.csv": 'id,name,x,y\n1,"line\nbreak",0,0\n2,"B; semi, colon",1,0\n3,C,0,1\n4,D,1,1\n'});
  assert.match(await tipAt(page, 1, 0), /id: 2\nname: B; semi, colon/);
  assert.match(await tipAt(page, 0, 1), /id: 3\nname: C/);
  await give(page, {"n.csv": "id,2019,x,y\n1,5,0,0\n2,6,1,0\n3,7,0,1\n4,8,1,1\n"});
  assert.match(await tipAt(page, 0, 1), /id: 3\n2019: 7/);
  await give(page, {"latin.csv": Buffer.from("id;Straße;x;y\n1;Öl;0;0\n2;Ä;1;0\n3;Ü;0;1\n4;ß;1;1\n", "latin1")});
  assert.match(await tipAt(page, 1, 0), /Straße: Ä/);
});

test("nothing is said of the file before", async (t) => {
  const page = await open(t);
  await give(page, {"a.csv": SQUARE});
  await page.locator("#bench-picture").press("Enter");
  await page.waitForFunction(() => document.querySelector("#bench-chosen").textContent);
  await give(page, {"wrong.csv": "a,b\n"});
  assert.equal(await page.textContent("#bench-chosen"), "");
  assert.ok(await page.isHidden("#bench-tip"));
  assert.equal(await drawn(page), 0);
});

test("what was cancelled does not begin again", async (t) => {
  const page = await open(t, {hash: "#set=uniform&n=100&views=triangles,mesh&mesh.angle=30&mesh.area=1e-8"});
  await page.waitForSelector("#bench-cancel:visible", {timeout: 20_000});
  await page.click("#bench-cancel");
  assert.match(await settled(page), /^Cancelled/);
  assert.ok(!(await page.isChecked("#bench-view-mesh")));
  await page.check("#bench-view-hull");
  assert.match(await settled(page), /^uniform\.csv: 100 points/);
});

test("contours are not offered to points without heights, and a view that fails leaves the others", async (t) => {
  const page = await open(t, {hash: "#set=uniform&n=50&seed=2&views=cells,contours"});
  assert.match(await settled(page), /^uniform\.csv: 50 points.*Voronoi cells: 50 cells/);
  assert.match(await page.textContent("#bench-help"), /Contours: these points have no heights/);
  assert.doesNotMatch(await page.textContent("#bench-code"), /contours/);
  await page.uncheck("#bench-view-contours");
  await settled(page);
  assert.ok(await page.isDisabled("#bench-view-contours"));
});

test("links that are wrong or hostile are a sentence at most", async (t) => {
  for (const [hash, pattern] of [
    ["#sample=constructor", /no sample constructor/],
    ["#sample=__proto__&views=toString,__proto__", /no sample __proto__/],
    ["#set=-o&n=5", /no set/],
    ["#set=uniform&n=-5&seed=x&views=x", /^uniform\.csv: 1,000 points/],
    ["#name=--help&text=0%2C0%0A1%2C0%0A0%2C1", /^_-help: |extension|format/],
    ["#name=..%2F..%2Fx.csv&text=0%2C0%0A1%2C0%0A0%2C1&views=mesh&mesh.angle=-o&mesh.area=%3Cb%3E", /3 points/],
    ["#set=uniform&n=9&columns=--help&views=alpha&alpha.radius=1e400", /./],
  ]) {
    const page = await open(t, {hash});
    assert.match(await settled(page), pattern, hash);
    assert.doesNotMatch(await page.textContent("#bench-code"), /-o -o|--help/);
    assert.equal(await page.locator("#bench b").count(), 0);
  }
});

test("more points than the memory of a page holds are refused by a sentence, and the page goes on", async (t) => {
  const page = await open(t, {hash: "#set=uniform&n=400000000&views=triangles"});
  assert.match(await settled(page), /more than fits into the memory of a page/);
  await page.click("[data-sample=capitals]");
  assert.match(await settled(page), /^capitals\.csv: 35 points/);
});

test("the lines of Python run, and have the numbers of the program", async (t) => {
  const {PYTHON: python, DELONE: program} = process.env;
  if (!python || !program) return t.skip("PYTHON and DELONE name no programs");
  const page = await open(t);
  const folder = mkdtempSync(`${tmpdir()}/python-`);
  const rows = Array.from({length: 40}, (_, i) => [((i * 37) % 41) / 10, ((i * 29) % 43) / 10, (i * 7) % 11]);
  const table = (sign, mark) => rows.map((row, i) => [i, ...row].map((cell) => String(cell).replace(".", mark)).join(sign)).join("\n");
  const files = {
    "a.csv": `id,x,y,z\n${table(",", ".")}\n`,
    "b.csv": `id;x;y;z\n${table(";", ",")}\n`,
    "c.xyz": `# a comment\n${rows.map((row) => row.join(" ")).join("\n")}\n`,
    "d.csv": Buffer.from(`id;Straße;x;y\n${rows.map(([x, y], i) => `${i};Öl;${x};${y}`).join("\n")}\n`, "latin1"),
    "e.geojson": JSON.stringify({type: "FeatureCollection", features: rows.map(([x, y]) => ({type: "Feature", properties: {}, geometry: {type: "Point", coordinates: [x, y]}}))}),
    "f.geojson": '{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,4],[0,4],[0,0]],[[1,1],[1,2],[2,2],[1,1]]]}',
  };
  for (const [name, bytes] of Object.entries(files)) {
    writeFileSync(`${folder}/${name}`, bytes);
    await give(page, {[name]: bytes});
    for (const view of ["cells", "hull", "alpha", "graph", "mesh"]) await page.check(`#bench-view-${view}`);
    if (/^[abc]/.test(name)) await page.check("#bench-view-contours");
    await settled(page);
    await page.click("[data-tab=Python]");
    const code = await page.textContent("#bench-code");
    const judge = "\nprint(len(points), sum(len(ring) for cell in cells for ring in cell))\n";
    const {status, stdout, stderr} = spawnSync(python, ["-W", "error", "-c", code + judge], {cwd: folder, encoding: "utf8", maxBuffer: 1 << 26});
    assert.equal(status, 0, `${name}:\n${code}\n${stderr}`);
    const {bytes: cells} = await save(page, "cells", "geojson");
    const {features} = JSON.parse(cells);
    const corners = features.flatMap(({geometry}) => (geometry.type === "Polygon" ? [geometry.coordinates] : geometry.coordinates)).flat().reduce((sum, ring) => sum + ring.length - 1, 0);
    assert.equal(Number(stdout.trim().split("\n").at(-1).split(" ")[1]), corners, name);
  }
});

test("in a cell of degrees its own address is told", async (t) => {
  const page = await open(t, {hash: "#sample=capitals&views=cells"});
  await settled(page);
  const {features} = JSON.parse((await save(page, "cells", "geojson")).bytes);
  const box = await page.locator("#bench-picture").boundingBox();
  const lons = features.flatMap(({geometry}) => geometry.coordinates[0].map(([x]) => x));
  const lats = features.flatMap(({geometry}) => geometry.coordinates[0].map(([, y]) => y));
  const [west, east, south, north] = [Math.min(...lons), Math.max(...lons), Math.min(...lats), Math.max(...lats)];
  const aspect = Math.cos(((south + north) * Math.PI) / 360);
  const scale = 0.94 * Math.min(box.width / ((east - west) * aspect), box.height / (north - south));
  for (const {geometry, properties} of features.filter((_, k) => k % 5 === 0)) {
    const ring = geometry.coordinates[0].slice(1);
    const [x, y] = [0, 1].map((k) => ring.reduce((sum, corner) => sum + corner[k], 0) / ring.length);
    await page.mouse.move(box.x + box.width / 2 + (x - (west + east) / 2) * aspect * scale, box.y + box.height / 2 - (y - (south + north) / 2) * scale);
    await page.waitForFunction((name) => document.querySelector("#bench-tip").textContent.includes(`name: ${name}`), properties.name, {timeout: 5000});
  }
});
