// Runs the README's programs in a folder where the package is installed: each block of JavaScript is one.

import {execFileSync} from "node:child_process";
import {readFileSync} from "node:fs";

const [folder] = process.argv.slice(2);
const readme = readFileSync(new URL("../README.md", import.meta.url), "utf8");
const programs = [...readme.matchAll(/^```js\n([\s\S]*?)^```$/gm)].map((match) => match[1]);
if (programs.length < 3) throw new Error("the README's programs were not found");
for (const program of programs) {
  execFileSync(process.execPath, ["--input-type=module", "-e", program], {cwd: folder, stdio: ["ignore", "inherit", "inherit"]});
}
console.log(`${programs.length} programs of the README ran`);
