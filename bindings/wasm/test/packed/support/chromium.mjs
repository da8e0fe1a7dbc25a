// A browser for tests, where there is one: Chromium by its usual path, or the one that CHROMIUM names.

import {existsSync, readFileSync} from "node:fs";
import {createServer} from "node:http";
import {once} from "node:events";
import {extname, join, normalize} from "node:path";
import {chromium} from "playwright-core";

const executablePath = process.env.CHROMIUM || "/usr/bin/chromium";

/** For the option `skip` of a test. */
export const noChromium = existsSync(executablePath) ? false : `there is no Chromium at ${executablePath}`;

const types = {".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm"};

/** Serves files of a folder. Pages whose path has `strict` come with a policy that allows workers of this site alone. */
async function serve(folder) {
  const server = createServer(({url}, response) => {
    const path = normalize(new URL(url, "http://localhost").pathname);
    const file = join(folder, path);
    if (!existsSync(file)) return response.writeHead(404).end();
    const headers = {"Content-Type": types[extname(file)] ?? "text/plain"};
    if (path.includes("strict")) headers["Content-Security-Policy"] = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'";
    response.writeHead(200, headers).end(readFileSync(file));
  }).listen(0, "127.0.0.1");
  await once(server, "listening");
  return {address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close()};
}

/** Opens pages of a folder: `work` gets a function from a path to a page, and the list of errors that pages had. */
export async function browse(folder, work, flags = []) {
  const {address, close} = await serve(folder);
  const browser = await chromium.launch({executablePath, args: ["--no-sandbox", ...flags]});
  try {
    const errors = [];
    const open = async (path) => {
      const page = await browser.newPage();
      page.on("pageerror", (error) => errors.push(`${path}: ${error.stack}`));
      await page.goto(address + path);
      return page;
    };
    await work(open, errors);
  } finally {
    await browser.close();
    close();
  }
}
