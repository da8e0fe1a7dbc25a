// The last files, kept by the browser so that a reload has them again. They stay on this machine.

const STORE = "files";

function open() {
  return new Promise((resolve, reject) => {
    const asked = indexedDB.open("delone-workbench", 1);
    asked.addEventListener("upgradeneeded", () => asked.result.createObjectStore(STORE));
    asked.addEventListener("success", () => resolve(asked.result));
    asked.addEventListener("error", () => reject(asked.error));
  });
}

async function within(mode, act) {
  const database = await open();
  try {
    return await new Promise((resolve, reject) => {
      const transaction = database.transaction(STORE, mode);
      const asked = act(transaction.objectStore(STORE));
      transaction.addEventListener("complete", () => resolve(asked.result));
      transaction.addEventListener("error", () => reject(transaction.error));
      transaction.addEventListener("abort", () => reject(transaction.error));
    });
  } finally {
    database.close();
  }
}

/** Keeps blobs by name in place of those before. Without a store, or without room in it, nothing is kept. */
export const keep = (blobs) => within("readwrite", (store) => store.put(blobs, "last")).catch(() => undefined);

/** The blobs that were kept, if they are these. */
export async function kept(names) {
  const blobs = await within("readonly", (store) => store.get("last")).catch(() => undefined);
  return blobs && names.every((name) => Object.hasOwn(blobs, name)) ? blobs : undefined;
}
