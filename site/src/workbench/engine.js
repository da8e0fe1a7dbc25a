// The program behind the workbench: loaded when it is first needed, in a thread of its own, begun anew when a task is given up.

import source from "worker:workbench/worker.js";
import {background} from "../background.js";
import {load} from "../load.js";

/** What the program told of a failure: its sentence, and what to do. */
class Failure extends Error {
  constructor(errors) {
    const line = (start) => errors.find((line) => line.startsWith(start))?.slice(start.length);
    super(line("error: ") ?? errors.at(-1) ?? "the program gave no result");
    this.help = line("help: ");
  }
}

export class Engine {
  #worker = background(source, () => (this.#ready = undefined));
  #module;
  #ready;
  #blobs;

  /** Loads the program; once. */
  prepare() {
    this.#ready ??= this.#prepare().catch((error) => {
      this.#ready = undefined;
      throw error;
    });
    return this.#ready;
  }

  async #prepare() {
    if (!this.#module) await load("program.js");
    const {module} = await this.#worker.run({task: "prepare", module: this.#module, base64: this.#module ? "" : globalThis.deloneProgram});
    // The compiled module is what counts from now on.
    if (module) [this.#module, globalThis.deloneProgram] = [module, undefined];
    if (this.#blobs) await this.#worker.run({task: "open", blobs: this.#blobs});
  }

  /** Takes files in place of those before: blobs by name. */
  async open(blobs) {
    await this.prepare();
    this.#blobs = blobs;
    await this.#worker.run({task: "open", blobs});
  }

  /** The columns of a point of a file, as pairs of names and words. */
  async row(name, i, count) {
    return (await this.#worker.run({task: "row", name, i, count})).cells;
  }

  /** Runs a command. Gives what it wrote and told, or throws a `Failure`. */
  async run(args) {
    await this.prepare();
    const start = performance.now();
    const result = await this.#worker.run({task: "run", args});
    if (result.status) throw new Failure(result.errors);
    const notes = result.errors.filter((line) => line.startsWith("note: ") || line.startsWith("warning: "));
    return {...result, notes, ms: performance.now() - start};
  }

  /** Ends whatever runs; the next command begins anew. */
  giveUp(reason) {
    this.#worker.giveUp(reason);
  }
}
