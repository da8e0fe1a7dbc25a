// What the workbench shows, as an address: set, options and views after the "#". Back, forward and reload keep it.

import {fileName} from "./names.js";
import {views} from "./views.js";

export const empty = () => ({
  source: {kind: "none"},
  read: {columns: "", classes: "", epsg: "", crossings: "", region: "", missing: ""},
  views: {triangles: {}},
  fill: "none",
  dots: true,
});

/** Texts up to here go into the address: browsers and mails take links of some thousand letters. In letters. */
export const LONGEST_TEXT = 6000;

/** The part of an address after the "#". */
function toHash({source, read, views, fill, dots}) {
  if (source.kind === "none") return location.href.split("#")[0];
  const words = new URLSearchParams();
  const put = (key, value) => value !== "" && value !== undefined && words.set(key, value);
  if (source.kind === "set") [["set", source.name], ["n", source.count], ["seed", source.seed]].forEach((pair) => put(...pair));
  if (source.kind === "sample") put("sample", source.name);
  if (source.kind === "files") source.names.forEach((name) => words.append("file", name));
  if (source.kind === "text") {
    put("name", source.name);
    if (source.text.length <= LONGEST_TEXT) put("text", source.text);
  }
  Object.entries(read).forEach((pair) => put(...pair));
  put("views", Object.keys(views).join(","));
  for (const [name, options] of Object.entries(views)) for (const [key, value] of Object.entries(options)) put(`${name}.${key}`, value);
  if (fill !== "none") put("fill", fill);
  if (!dots) put("dots", "off");
  return `#${words}`;
}

/** A whole number, or another one in its place. */
const whole = (text, otherwise) => (/^\d+$/.test(text) ? text : otherwise);

/** A value of an option, or nothing if it can be none. */
function valid({kind, choices}, value) {
  if (kind === "choice") return choices.includes(value) ? value : "";
  return value !== "" && Number(value) >= 0 && Number.isFinite(Number(value)) ? value : "";
}

/** The state that an address tells, or nothing if it tells none. What it has that there is not is left out. */
export function fromHash(hash) {
  const words = new URLSearchParams(hash.replace(/^#/, ""));
  const state = empty();
  const get = (key) => words.get(key) ?? "";
  if (words.has("set")) state.source = {kind: "set", name: get("set").replace(/[^\w-]|^-/g, "_"), count: whole(get("n"), "1000"), seed: whole(get("seed"), "0")};
  else if (words.has("sample")) state.source = {kind: "sample", name: get("sample")};
  else if (words.has("text")) state.source = {kind: "text", name: fileName(get("name") || "points.csv"), text: get("text")};
  else if (words.has("file")) state.source = {kind: "files", names: words.getAll("file").map(fileName)};
  // A text that is too long for an address is kept as a file.
  else if (words.has("name")) state.source = {kind: "files", names: [fileName(get("name"))]};
  else return undefined;
  for (const key of Object.keys(state.read)) state.read[key] = get(key).replace(/^-+/, "");
  state.views = {};
  for (const name of get("views").split(",")) {
    if (!Object.hasOwn(views, name)) continue;
    const given = views[name].options.map((option) => [option.key, valid(option, get(`${name}.${option.key}`))]);
    state.views[name] = Object.fromEntries(given.filter(([, value]) => value !== ""));
  }
  if (["heights", "shade"].includes(get("fill"))) state.fill = get("fill");
  state.dots = get("dots") !== "off";
  return state;
}

/** Keeps states in the history of the browser. `show` is called with a state that becomes the present one. */
export class Past {
  #most = 0;
  #now = 0;
  #show;
  /** Whether the browser is on its way back or forward: it tells later that it is there. */
  #isMoving = false;

  constructor(show) {
    this.#show = show;
    this.#now = this.#most = history.state?.turn ?? 0;
    addEventListener("popstate", ({state}) => {
      // Links to the sections of the page are no states.
      this.#isMoving = false;
      const found = state?.state ?? fromHash(location.hash) ?? empty();
      this.#now = state?.turn ?? 0;
      this.#show(found);
    });
  }

  /** Remembers a state as the present one. */
  add(state) {
    this.#most = ++this.#now;
    history.pushState({turn: this.#now, state: structuredClone(state)}, "", toHash(state));
  }

  /** The present state is another one, which no step leads back from. */
  replace(state) {
    history.replaceState({turn: this.#now, state: structuredClone(state)}, "", toHash(state));
  }

  undo() {
    if (!this.canUndo || this.#isMoving) return;
    this.#isMoving = true;
    history.back();
  }

  redo() {
    if (!this.canRedo || this.#isMoving) return;
    this.#isMoving = true;
    history.forward();
  }

  get canUndo() {
    return this.#now > 0;
  }

  get canRedo() {
    return this.#now < this.#most;
  }
}
