// For everyone: axe-core finds nothing in both schemes, nothing is wider than a telephone, all is done by keys alone.

import assert from "node:assert/strict";
import {createRequire} from "node:module";
import {readFileSync} from "node:fs";
import {test} from "node:test";
import {open, useBrowser} from "./browser.mjs";

useBrowser();
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const hash = "#sample=terrain&views=triangles,cells,hull,alpha,mesh,graph,contours&fill=shade";

async function ready(page) {
  await page.waitForSelector("#bench[data-state=ready]", {timeout: 60_000});
  for (const section of await page.locator("main > section").all()) await section.scrollIntoViewIfNeeded();
  await page.evaluate(() => document.querySelectorAll("details").forEach((details) => (details.open = true)));
}

for (const colorScheme of ["light", "dark"]) {
  test(`axe-core finds nothing: ${colorScheme}`, async (t) => {
    const page = await open(t, {colorScheme, hash, bypassCSP: true});
    const faults = async () => {
      const {violations} = await page.evaluate(() => globalThis.axe.run({preload: false}));
      return violations.map(({id, nodes}) => `${id}: ${nodes.map(({target}) => target).join(" ")}`);
    };
    await page.addScriptTag({content: axe});
    await ready(page);
    assert.deepEqual(await faults(), []);
    await page.click("#bench-paste-open");
    await page.click("#bench-help-keys");
    assert.deepEqual(await faults(), []);
  });
}

test("nothing is wider than the narrowest telephone", async (t) => {
  for (const width of [320, 390, 820, 1440]) {
    const page = await open(t, {viewport: {width, height: 740}, hash});
    await ready(page);
    const wide = await page.evaluate(() => {
      const all = [...document.querySelectorAll("main *")];
      const inner = (item) => item.closest("pre, .scroll, canvas, .aside, dialog, option");
      const out = all.filter((item) => item.checkVisibility() && !inner(item) && item.getBoundingClientRect().right > innerWidth + 1);
      return [document.documentElement.scrollWidth > innerWidth, ...out.map((item) => item.outerHTML.slice(0, 90))];
    });
    assert.deepEqual(wide, [false], `at ${width}`);
  }
});

test("a file's districts by the keyboard alone", async (t) => {
  const page = await open(t);
  const focused = () => page.evaluate(() => document.activeElement?.id || document.activeElement?.dataset.sample || "");
  const tabTo = async (name) => {
    for (let k = 0; k < 80; k++) {
      if ((await focused()) === name) return;
      await page.keyboard.press("Tab");
    }
    assert.fail(`Tab does not come to ${name}`);
  };
  await tabTo("capitals");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#bench[data-state=ready]", {timeout: 60_000});
  await tabTo("bench-picture");
  for (const key of ["+", "ArrowLeft", "Enter"]) await page.keyboard.press(key);
  await page.waitForFunction(() => document.querySelector("#bench-chosen").textContent);
  await tabTo("bench-view-graph");
  await page.keyboard.press("Space");
  await page.waitForFunction(() => /Graph: \d+ edges/.test(document.querySelector("#bench-status").textContent));
  await tabTo("bench-save");
  const saved = page.waitForEvent("download");
  await page.keyboard.press("Enter");
  assert.match((await saved).suggestedFilename(), /^graph\.geojson$/);
});
