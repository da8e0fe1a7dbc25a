// The code of the page runs as it stands there, with the package that it names.

import assert from "node:assert/strict";
import {spawnSync} from "node:child_process";
import {mkdtempSync, readFileSync, symlinkSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {test} from "node:test";
import {fileURLToPath} from "node:url";

const page = readFileSync(new URL("../index.html", import.meta.url), "utf8");
const plain = (text) => text.replaceAll("&lt;", "<").replaceAll("&gt;", ">").replaceAll("&amp;", "&");
const codes = [...page.matchAll(/<section id="(\w+)">(?:(?!<\/section>)[^])*?<details class="code">[^]*?<code>([^]*?)<\/code>/g)];

test("each figure has code, and it runs", () => {
  const folder = mkdtempSync(`${tmpdir()}/code-`);
  symlinkSync(fileURLToPath(new URL("../node_modules", import.meta.url)), `${folder}/node_modules`);
  assert.equal(codes.length, 9);
  for (const [, section, code] of codes) {
    writeFileSync(`${folder}/${section}.mjs`, plain(code));
    const {status, stderr} = spawnSync(process.execPath, [`${section}.mjs`], {cwd: folder, encoding: "utf8"});
    assert.equal(status, 0, `${section}: ${stderr}`);
  }
});
