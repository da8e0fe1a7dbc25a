// The page in a real browser, from the disk, as `dist/index.html` is opened by a double click. CHROMIUM says where the browser is.

import assert from "node:assert/strict";
import {after, before} from "node:test";
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
