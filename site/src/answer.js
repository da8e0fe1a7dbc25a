// The other side of background.js: a worker's tasks by name.

/** Answers messages by the task that they name. What a task gives as `transfer` is given away. */
export function answer(tasks) {
  self.addEventListener("message", async ({data: {id, task, ...given}}) => {
    try {
      const {transfer = [], ...result} = await tasks[task](given);
      self.postMessage({id, ...result}, transfer);
    } catch (error) {
      self.postMessage({id, error: error.message});
    }
  });
}
