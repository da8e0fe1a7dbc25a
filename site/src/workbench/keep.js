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

/** Files of other tabs are kept for a day. In milliseconds. */
const DAY = 86_400_000;

/** A tab has a name of its own, which a reload keeps. */
function tab() {
  sessionStorage.delone ??= `${Date.now()}-${Math.random()}`;
  return sessionStorage.delone;
}

/** Keeps blobs by name in place of those of this tab before. Without a store, or without room in it, nothing is kept. */
export async function keep(blobs) {
  try {
    const old = (await within("readonly", (store) => store.getAllKeys())).filter((key) => !(Date.now() - Number.parseInt(key, 10) < DAY));
    await within("readwrite", (store) => old.map((key) => store.delete(key)) && store.put(blobs, tab()));
  } catch {
    // What is shown is shown all the same.
  }
}

/** The blobs that were kept for this tab, if they are these. */
export async function kept(names) {
  const blobs = await within("readonly", (store) => store.get(tab())).catch(() => undefined);
  return blobs && names.every((name) => Object.hasOwn(blobs, name)) ? blobs : undefined;
}
