// Triangulates off the main thread. Arrays are transferred, not copied, but for the points, which are yours.

import packed from "../dist/inline.js";
import text from "../dist/worker-text.js";
import {DeloneError} from "./errors.js";
import {flatCoordinates} from "./input.js";
import {builtin, isNode} from "./node.js";

/** Whether a buffer can be given away: one that is not shared. */
const isMovable = (buffer) => buffer instanceof ArrayBuffer;

/** The address of the thread's script, made from its text when the first thread starts. */
let address;

/** Starts a thread: of its text, which no bundler has to know of, or in browsers of a file. */
async function start(script) {
  if (isNode) {
    const {Worker} = await builtin("worker_threads");
    return new Worker(`${text}deloneWorker.serve(require("node:worker_threads").parentPort);`, {eval: true, execArgv: []});
  }
  if (typeof Worker === "undefined") throw new Error("there are no workers here");
  if (script !== undefined) return new Worker(script);
  address ??= URL.createObjectURL(new Blob([`${text}deloneWorker.serve(self);`], {type: "text/javascript"}));
  return new Worker(address);
}

/** Why there is no thread. Browsers do not say it themselves. */
function refused(script, cause) {
  const reason = cause?.message ? ` (${cause.message})` : "";
  const help =
    script === undefined
      ? "a content security policy has to allow it by `worker-src blob:`; or give the address of the file delone/delone-worker.js, new DelaunayWorker({script})"
      : `its script was to come from ${script}`;
  return Object.assign(new DeloneError("worker", `the worker did not start${reason}: ${help}`), {cause});
}

/** A thread that triangulates. Tasks wait for each other. */
export class DelaunayWorker {
  #thread;
  #tasks = new Map();
  #next = 0;
  /** Why nothing more can be asked, once that is so. */
  #end;

  /** `script` is the address of delone/delone-worker.js, for pages whose policy refuses other scripts. Node has no need of it. */
  constructor(options) {
    const script = options?.script;
    const hearAll = (thread) => {
      const hear = (event, handle) => (isNode ? thread.on(event, handle) : thread.addEventListener(event, handle));
      hear("message", (message) => this.#finish(isNode ? message : message.data));
      hear("messageerror", () => this.#finishAll(new DeloneError("internal", "an answer of the worker cannot be read")));
      hear("error", (error) => this.#finishAll(error.message ? new DeloneError("internal", `the worker failed: ${error.message}`) : refused(script)));
      thread.postMessage({packed});
      this.#hold(thread);
      return thread;
    };
    this.#thread = start(script).then(hearAll).catch((cause) => this.#finishAll(refused(script, cause)));
  }

  /** A program of Node may end while the thread has nothing to do. */
  #hold(thread) {
    if (isNode) this.#tasks.size ? thread.ref() : thread.unref();
  }

  /**
   * Triangulates a flat array of coordinates. With `transfer` its buffer is given away, if it is one that can be, and comes back in `coords`;
   * else it is copied.
   * Resolves to what a `Delaunator` has: coords, triangles, halfedges, hull.
   */
  async triangulate(coords, options) {
    if (this.#end) throw this.#end;
    const {transfer = false, skipInvalid = false} = options ?? {};
    const flat = flatCoordinates(coords);
    // What another type was, or an array, is a copy already.
    const given = flat === coords && !(transfer && isMovable(flat.buffer)) ? flat.slice() : flat;
    const thread = await this.#thread;
    if (this.#end) throw this.#end;
    const id = this.#next++;
    return new Promise((resolve, reject) => {
      // Another call may have given it away in between, which not every thread notices.
      flatCoordinates(given);
      try {
        thread.postMessage({id, coords: given, skipInvalid: Boolean(skipInvalid)}, [given.buffer]);
      } catch (cause) {
        throw Object.assign(new DeloneError("input", `the coordinates cannot be sent: ${cause.message}`), {cause});
      }
      this.#tasks.set(id, {resolve, reject});
      this.#hold(thread);
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
    await (await this.#thread)?.terminate();
  }
}
