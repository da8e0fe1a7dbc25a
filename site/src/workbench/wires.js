// What the visitor does, by any of its ways: files, drops, pastes, buttons, keys.

/** Files of a drop, without folders, whose names are told apart. */
function dropped({items, files}) {
  const entries = [...items].filter(({kind}) => kind === "file").map((item) => item.webkitGetAsEntry?.());
  const isFolder = (k) => entries[k]?.isDirectory;
  return {taken: [...files].filter((_, k) => !isFolder(k)), folders: [...files].filter((_, k) => isFolder(k)).map(({name}) => name)};
}

/** Connects the controls of the workbench with what they do. */
export function wire(section, act) {
  const of = (name) => section.querySelector(`#bench-${name}`);
  const on = (name, kind, handle) => of(name).addEventListener(kind, handle);
  /** On a narrow page the stage is brought to where it is seen. */
  const reveal = () => of("picture").getBoundingClientRect().top > innerHeight / 2 && of("picture").scrollIntoView({block: "center"});

  on("file", "change", () => {
    act.take(of("file").files);
    // The same file can be chosen again.
    of("file").value = "";
    reveal();
  });
  addEventListener("dragover", (event) => {
    event.preventDefault();
    section.classList.add("dropping");
  });
  addEventListener("dragleave", (event) => event.relatedTarget || section.classList.remove("dropping"));
  addEventListener("drop", (event) => {
    event.preventDefault();
    section.classList.remove("dropping");
    const {taken, folders} = dropped(event.dataTransfer);
    const text = event.dataTransfer.getData("text");
    if (taken.length) act.take(taken);
    else if (folders.length) act.refuse(`${folders.join(", ")} is a folder: drop the files in it.`);
    else if (text) act.paste(text);
    else act.refuse("That was no file.");
    section.scrollIntoView({block: "nearest"});
  });
  on("paste-take", "click", () => {
    of("paste").hidden = true;
    act.paste(of("paste-text").value);
    reveal();
  });
  on("paste-open", "click", () => {
    of("paste").hidden = !of("paste").hidden;
    if (!of("paste").hidden) of("paste-text").focus();
  });
  addEventListener("paste", (event) => {
    if (event.target.closest?.("input, textarea")) return;
    if (event.clipboardData.files.length) act.take(event.clipboardData.files);
    else act.paste(event.clipboardData.getData("text"));
  });
  for (const button of section.querySelectorAll("[data-sample]")) {
    button.addEventListener("click", () => {
      act.sample(button.dataset.sample);
      reveal();
    });
  }
  on("set-take", "click", () => {
    act.set(...["set", "count", "seed"].map((key) => of(key).value.trim()));
    reveal();
  });
  for (const [name, does] of Object.entries({undo: act.undo, redo: act.redo, cancel: act.cancel, png: act.picture})) on(name, "click", does);
  on("in", "click", () => act.view.by(1.5));
  on("out", "click", () => act.view.by(1 / 1.5));
  on("all", "click", () => act.view.all());
  section.addEventListener("keydown", (event) => {
    if (event.target.closest("input, textarea, select")) return;
    const isCommand = event.ctrlKey || event.metaKey;
    if (event.key === "Escape") {
      of("keys").close?.();
      act.unmark();
      act.cancel();
    } else if (event.key === "?") of("keys").showModal();
    else if (isCommand && event.key === "z" && !event.shiftKey) act.undo();
    else if (isCommand && (event.key === "y" || event.key === "Z")) act.redo();
    else return;
    event.preventDefault();
  });
  on("help-keys", "click", () => of("keys").showModal());
  // The address is that of the state: links to sections of the page only go there.
  document.addEventListener("click", (event) => {
    const link = event.target.closest?.('a[href^="#"]');
    if (!link) return;
    event.preventDefault();
    const target = document.querySelector(link.hash);
    target?.scrollIntoView();
    target?.querySelector("canvas, button, input")?.focus({preventScroll: true});
  });
}
