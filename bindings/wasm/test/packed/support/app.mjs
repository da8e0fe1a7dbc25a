// The package as users get it: packed, and installed in a folder elsewhere.

import {execFileSync} from "node:child_process";
import {mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {dirname, join} from "node:path";
import {fileURLToPath} from "node:url";

const root = fileURLToPath(new URL("../../..", import.meta.url));

/** A folder with the package installed in it, and what removes it. */
export function installed() {
  const folder = mkdtempSync(join(tmpdir(), "delone-packed-"));
  const npm = (cwd, ...args) => execFileSync("npm", [...args, "--no-audit", "--no-fund", "--silent"], {cwd, stdio: ["ignore", "pipe", "inherit"]});
  npm(root, "pack", "--pack-destination", folder);
  const [archive] = readdirSync(folder);
  writeFileSync(join(folder, "package.json"), '{"type": "module", "private": true}');
  npm(folder, "install", "--offline", `./${archive}`);
  return {folder, remove: () => rmSync(folder, {recursive: true})};
}

/** Writes files, by their paths below a folder. */
export function write(folder, files) {
  for (const [name, text] of Object.entries(files)) {
    mkdirSync(dirname(join(folder, name)), {recursive: true});
    writeFileSync(join(folder, name), text);
  }
}
