// Triangulates off the main thread. Arrays are transferred, not copied, but for the points, which are yours.

import {DeloneError} from "./errors.js";
import {builtin, isNode} from "./node.js";

/** A thread that triangulates. Tasks wait for each other. */
export class DelaunayWorker {
  #thread;
  #tasks = new Map();
  #next = 0;
  /** Why nothing more can be asked, once that is so. */
  #end;

  constructor() {
    this.#thread = isNode
      ? builtin("worker_threads").then(({Worker}) => new Worker(new URL("./worker-thread.js", import.meta.url), {execArgv: []}))
      : Promise.resolve(new Worker(new URL("./worker-thread.js", import.meta.url), {type: "module"}));
    this.#thread.then((thread) => {
      const hear = (event, handle) => (isNode ? thread.on(event, handle) : thread.addEventListener(event, handle));
      hear("message", (message) => this.#finish(isNode ? message : message.data));
      hear("error", (error) => this.#finishAll(new DeloneError("internal", `the worker failed: ${error.message}`)));
      this.#hold(thread);
    });
  }

  /** A program of Node may end while the thread has nothing to do. */
  #hold(thread) {
    if (isNode) this.#tasks.size ? thread.ref() : thread.unref();
  }

  /**
   * Triangulates a flat array of coordinates. With `transfer` its buffer is given away, and comes back in `coords`; else it is copied.
   * Resolves to what a `Delaunator` has: coords, triangles, halfedges, hull.
   */
  async triangulate(coords, {transfer = false, skipInvalid = false} = {}) {
    if (this.#end) throw this.#end;
    const given = transfer && coords instanceof Float64Array ? coords : Float64Array.from(coords);
    const thread = await this.#thread;
    if (this.#end) throw this.#end;
    const id = this.#next++;
    return new Promise((resolve, reject) => {
      this.#tasks.set(id, {resolve, reject});
      this.#hold(thread);
      thread.postMessage({id, coords: given, skipInvalid}, [given.buffer]);
    });
  }

  #finish({id, error, ...result}) {
    const task = this.#tasks.get(id);
    if (!task) return; // An answer that was under way when the thread was ended.
    this.#tasks.delete(id);
    this.#thread.then((thread) => this.#hold(thread));
    if (error) task.reject(new DeloneError(error.code, error.message, error.index));
    else task.resolve(result);
  }

  #finishAll(error) {
    this.#end ??= error;
    for (const {reject} of this.#tasks.values()) reject(error);
    this.#tasks.clear();
  }

  /** Ends the thread; tasks that wait are rejected. */
  async terminate() {
    this.#finishAll(new DeloneError("disposed", "the worker was terminated"));
    await (await this.#thread).terminate();
  }
}
