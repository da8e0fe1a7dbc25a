// The thread that runs the program. It keeps the module and the files, so that each view needs only the words of its command.

import {answer} from "../answer.js";
import {run} from "./program.js";
import {teller} from "./rows.js";

let module;
let files = {};

async function inflated(base64) {
  const deflated = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  const stream = new Blob([deflated]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Response(stream).arrayBuffer();
}

/** Tells the columns of a point of a file; made when it is first asked. */
let telling = {};

answer({
  /** Takes the program: a module, or deflated, in base64. Gives the module, if it can be given. */
  async prepare({module: made, base64}) {
    module = made ?? (await WebAssembly.compile(await inflated(base64)));
    return made ? {} : {module};
  },

  /** Takes files in place of those before: blobs by name. */
  async open({blobs}) {
    [files, telling] = [{}, {}];
    for (const [name, blob] of Object.entries(blobs)) files[name] = new Uint8Array(await blob.arrayBuffer());
    return {};
  },

  /** The columns of a point, as pairs. */
  row({name, i, count}) {
    telling[name] ??= teller(name, files[name], count);
    return {cells: telling[name](i)};
  },

  async run({args}) {
    const result = await run(module, args, files);
    return {...result, transfer: Object.values(result.written).map(({buffer}) => buffer)};
  },
});
