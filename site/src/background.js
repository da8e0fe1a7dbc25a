// Workers, as promises. Each figure has one of its own, so that none waits for the work of another or ends it.

/**
 * A worker of a script's text, made when it is first needed, and made anew when a task is given up. `lost` is called when what the worker knew
 * is gone.
 */
export function background(source, lost = () => undefined) {
  let worker;
  let next = 0;
  const tasks = new Map();

  function start() {
    const url = URL.createObjectURL(new Blob([source], {type: "text/javascript"}));
    worker = new Worker(url);
    URL.revokeObjectURL(url);
    worker.addEventListener("message", ({data}) => {
      const task = tasks.get(data.id);
      // An answer may have been under way when its task was given up.
      if (!task) return;
      tasks.delete(data.id);
      if (data.error) task.reject(new Error(data.error));
      else task.resolve(data);
    });
    worker.addEventListener("error", (event) => giveUp(event.message || "the worker failed"));
  }

  /** Runs a task; buffers in `transfer` are given away. */
  function run(message, transfer = []) {
    if (!worker) start();
    const id = next++;
    return new Promise((resolve, reject) => {
      tasks.set(id, {resolve, reject});
      worker.postMessage({id, ...message}, transfer);
    });
  }

  /** Ends whatever runs. */
  function giveUp(reason = "cancelled") {
    worker?.terminate();
    worker = undefined;
    lost();
    for (const {reject} of tasks.values()) reject(new Error(reason));
    tasks.clear();
  }

  return {run, giveUp};
}
