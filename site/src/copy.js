// Text to the clipboard.

/** Copies the text of an element, and says so in another for a while. */
export async function copy(element, told) {
  try {
    await navigator.clipboard.writeText(element.textContent);
  } catch {
    // Without leave, or on a page from a disk: the old way.
    getSelection().selectAllChildren(element);
    document.execCommand("copy");
    getSelection().removeAllRanges();
  }
  told.textContent = "Copied.";
  setTimeout(() => (told.textContent = ""), 2000);
}
