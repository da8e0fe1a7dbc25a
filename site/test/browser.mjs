// The page in a real browser, from the disk, as `dist/index.html` is opened by a double click. CHROMIUM says where the browser is.

import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import {after, before} from "node:test";
import {fileURLToPath} from "node:url";
import {chromium} from "playwright-core";

export const address = new URL("../dist/index.html", import.meta.url).href;
let browser;

/** Starts a browser for the tests of a file. */
export function useBrowser() {
  before(async () => {
    browser = await chromium.launch({
      executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
      args: ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
    });
  });
  after(() => browser?.close());
}

/** A page that fails the test by whatever the console says or that is asked of the network. `prepare` runs before its scripts. */
export async function open(t, {hash = "", prepare, ...options} = {}) {
  const context = await browser.newContext({viewport: {width: 1100, height: 900}, acceptDownloads: true, ...options});
  const page = await context.newPage();
  const said = [];
  // But for what is said of the tests that look at pixels.
  page.on("console", (message) => /willReadFrequently/.test(message.text()) || said.push(message.text()));
  page.on("pageerror", (error) => said.push(String(error)));
  page.on("request", (request) => {
    if (!/^(file|blob|data):/.test(request.url())) said.push(`asked for ${request.url()}`);
  });
  t.after(async () => {
    await context.close();
    assert.deepEqual(said, []);
  });
  if (prepare) await page.addInitScript(prepare);
  await page.goto(address + hash);
  await page.waitForSelector("html[data-bench]");
  return page;
}

// The workbench.

export const data = (name) => fileURLToPath(new URL(`../../data/${name}`, import.meta.url));

export const says = (page) => page.textContent("#bench-status");
export const state = (page) => page.getAttribute("#bench", "data-state");

/** Waits until nothing is being made, and gives what is said. */
export async function settled(page) {
  await page.waitForFunction(
    () => {
      const {state} = document.querySelector("#bench").dataset;
      const still = state === "ready" || state === "empty";
      globalThis.calm = still ? (globalThis.calm ?? 0) + 1 : 0;
      return globalThis.calm > 3;
    },
    undefined,
    {timeout: 90_000, polling: 60},
  );
  await page.evaluate(() => (globalThis.calm = 0));
  return says(page);
}

/** Gives files to the page, by name, and waits for what is said of them. */
export async function give(page, files) {
  await page.setInputFiles("#bench-file", Object.entries(files).map(([name, text]) => ({name, mimeType: "", buffer: Buffer.from(text)})));
  return settled(page);
}

/** How many pixels of the stage are not paper. */
export const drawn = (page) =>
  page.locator("#bench-picture").evaluate((canvas) => {
    const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) count += data[i + 3] > 0 && data[i] + data[i + 1] + data[i + 2] < 740;
    return count;
  });

export async function save(page, view, format) {
  await page.selectOption("#bench-save-view", view);
  await page.selectOption("#bench-save-format", format);
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#bench-save")]);
  await settled(page);
  return {name: download.suggestedFilename(), bytes: readFileSync(await download.path())};
}
