// The controls of the workbench beside the stage: views and their options, how files are read, results to save, code to copy.

import {copy} from "../copy.js";
import {titleOf} from "./formats.js";
import {isText} from "./rows.js";
import {snippets} from "./snippets.js";
import {views} from "./views.js";

/** Of a slider, whose ends are these powers of ten as parts of the extent of the points. */
const SLIDER = {min: -4, max: 0, step: 0.01};
/** Where a slider stands while the program chooses. */
const MIDDLE = -2;
const roles = ["x", "y", "z"];

const make = (name, attributes = {}, ...children) => {
  const element = Object.assign(document.createElement(name), attributes);
  element.append(...children);
  return element;
};

export class Panels {
  #of;
  #actions;
  #state;
  #context = {};
  #tab = "Command";
  /** The files whose columns are offered. */
  #looked;
  /** Options of views that were switched off, for when they come back. */
  #old = {};

  /** `actions`: `change(act, isKept)`, `save(view, format)`; `formats` by command. */
  constructor(section, actions) {
    this.#of = (name) => section.querySelector(`#bench-${name}`);
    this.#actions = actions;
    const of = this.#of;
    of("views").append(...Object.entries(views).map(([name, view]) => this.#row(name, view)));
    of("set").append(...actions.formats.sets.map((name) => make("option", {textContent: name})));
    of("fill").addEventListener("change", () => actions.change((state) => (state.fill = of("fill").value)));
    of("dots").addEventListener("change", () => actions.change((state) => (state.dots = of("dots").checked)));
    of("save-view").addEventListener("change", () => this.#formats());
    of("save-format").addEventListener("change", () => this.#code());
    of("save").addEventListener("click", () => actions.save(of("save-view").value, of("save-format").value));
    of("read").addEventListener("change", () => this.#read());
    of("copy").addEventListener("click", () => copy(of("code"), of("copied")));
    for (const tab of of("tabs").querySelectorAll("[data-tab]")) {
      tab.addEventListener("click", () => {
        this.#tab = tab.dataset.tab;
        this.#code();
      });
    }
  }

  /** The row of a view: on or off, and its options. */
  #row(name, {title, options}) {
    const {change} = this.#actions;
    const box = make("input", {type: "checkbox", id: `bench-view-${name}`});
    box.addEventListener("change", () => {
      change((state) => {
        if (box.checked) state.views[name] = this.#old[name] ?? {};
        else {
          this.#old[name] = state.views[name];
          delete state.views[name];
        }
      });
      // Who asks for a view wants to take that one away.
      if (!box.checked) return;
      this.#of("save-view").value = name;
      this.#formats();
    });
    const fields = make("span", {className: "options", hidden: true, id: `bench-options-${name}`}, ...options.map((option) => this.#option(name, option)));
    return make("div", {className: "view"}, make("label", {}, box, ` ${title}`), fields);
  }

  #option(name, {key, label, kind, choices, value, slider, ...limits}) {
    const {change} = this.#actions;
    const id = `bench-${name}-${key}`;
    const set = (now, isKept) => change((state) => state.views[name] && (state.views[name][key] = now), isKept);
    if (kind === "choice") {
      const list = make("select", {id, value, ariaLabel: label || key}, ...choices.map((choice) => make("option", {textContent: choice})));
      list.addEventListener("change", () => set(list.value));
      return make("label", {}, label ? `${label} ` : "", list);
    }
    const field = make("input", {id, type: "number", step: "any", placeholder: "fitting", ...limits});
    field.addEventListener("change", () => set(field.value));
    if (!slider) return make("label", {}, `${label} `, field);
    const range = make("input", {type: "range", id: `${id}-slider`, ariaLabel: label, ...SLIDER});
    const length = () => String(Number((10 ** Number(range.value) * this.#extent).toPrecision(3)));
    // One step back from wherever it is drawn to.
    let isFirst = true;
    range.addEventListener("focus", () => (isFirst = true));
    range.addEventListener("input", () => {
      set(length(), isFirst);
      isFirst = false;
    });
    return make("span", {}, make("label", {}, `${label} `, field), range);
  }

  get #extent() {
    const frame = this.#context.loaded?.about.frame;
    return frame ? frame.extent / frame.part : 1;
  }

  /** Shows a state. */
  show(state, context) {
    [this.#state, this.#context] = [state, context];
    const of = this.#of;
    const {loaded, canUndo, canRedo} = context;
    of("undo").disabled = !canUndo;
    of("redo").disabled = !canRedo;
    for (const [name, view] of Object.entries(views)) this.#showView(name, view, state.views[name], loaded);
    of("fill").value = state.fill;
    of("fill").disabled = !loaded?.about.heights;
    of("dots").checked = state.dots;
    for (const key of ["classes", "epsg", "crossings", "region"]) if (of(key) !== document.activeElement) of(key).value = state.read[key];
    of("missing").checked = Boolean(state.read.missing);
    of("empty").hidden = state.source.kind !== "none";
    const shown = Object.keys(state.views);
    if ([...of("save-view").options].map(({value}) => value).join() !== shown.join()) {
      const before = of("save-view").value;
      of("save-view").replaceChildren(...shown.map((name) => make("option", {value: name, textContent: views[name].title})));
      of("save-view").value = shown.includes(before) ? before : (shown.at(-1) ?? "");
      this.#formats();
    }
    for (const key of ["png", "copy"]) of(key).disabled = !loaded;
    for (const key of ["save", "save-view", "save-format"]) of(key).disabled = !loaded || !shown.length;
    of("facts").textContent = loaded?.facts ?? "";
    of("facts-all").hidden = !loaded?.facts;
    this.#classes(loaded?.facts);
    this.#code();
  }

  #showView(name, {options, heights}, given, loaded) {
    const of = this.#of;
    const isBarren = heights && loaded && !loaded.about.heights;
    of(`view-${name}`).checked = Boolean(given);
    of(`view-${name}`).disabled = isBarren && !given;
    of(`view-${name}`).parentElement.title = isBarren ? "These points have no heights: choose a column z below" : "";
    of(`options-${name}`).hidden = !given;
    for (const {key, value, slider} of options) {
      const field = of(`${name}-${key}`);
      const now = given?.[key] ?? (key === "clip" && this.#state.read.region ? "region" : value);
      if (field !== document.activeElement) field.value = now;
      if (name === "contours") field.placeholder = loaded?.step ?? "fitting";
      if (slider && of(`${name}-${key}-slider`) !== document.activeElement) of(`${name}-${key}-slider`).value = now ? Math.log10(Number(now) / this.#extent) : MIDDLE;
    }
  }

  #formats() {
    const of = this.#of;
    const name = of("save-view").value;
    const before = of("save-format").value;
    const outputs = name ? this.#actions.formats.outputs[views[name].command] : [];
    of("save-format").replaceChildren(...outputs.map((format) => make("option", {value: format, textContent: titleOf(format)})));
    of("save-format").value = outputs.includes(before) ? before : outputs.includes("geojson") ? "geojson" : (outputs[0] ?? "");
    this.#code();
  }

  /** Classes of laser scans, of the facts that the program tells. */
  #classes(facts = "") {
    const of = this.#of;
    const found = [...facts.matchAll(/^class (\d+) (.*?)\s+\d+$/gm)];
    of("classes-all").hidden = !found.length && of("classes").options.length < 2;
    if (!found.length || of("classes").options.length > 1) return;
    of("classes").replaceChildren(make("option", {value: "", textContent: "all"}), ...found.map(([, value, name]) => make("option", {value, textContent: `${value} ${name}`})));
    of("classes").value = this.#state.read.classes;
  }

  /** Offers columns of files, and their first rows; for other files than before. `head` is their beginning. */
  look(key, names, readable, head, state) {
    const of = this.#of;
    of("region-all").hidden = readable.length < 2;
    of("region").replaceChildren(make("option", {value: "", textContent: "none"}), ...readable.map((name) => make("option", {value: name, textContent: name})));
    of("region").value = state.read.region;
    if (this.#looked === key) return;
    this.#looked = key;
    this.#old = {};
    of("classes").replaceChildren();
    of("columns-all").hidden = !isText(names[0]);
    of("columns").replaceChildren();
    of("rows").replaceChildren();
    if (!isText(names[0])) return;
    const taken = state.read.columns.split(",");
    // Names that a command cannot hold are told by their numbers.
    const word = (name, k) => (head.hasHeading && /^[\w .°-]+$/.test(name) && !/^\d+$/.test(name) ? name : String(k + 1));
    const title = (name, k) => (head.hasHeading ? name : `column ${k + 1}`);
    const choices = () => [make("option", {value: "", textContent: "by name"}), ...head.names.map((name, k) => make("option", {value: word(name, k), textContent: title(name, k)}))];
    of("columns").append(
      ...roles.map((role, k) => {
        const list = make("select", {id: `bench-column-${role}`}, ...choices());
        list.value = taken[k] ?? "";
        return make("label", {}, `${role} `, list);
      }),
    );
    const row = (cells, kind) => make("tr", {}, ...cells.map((cell) => make(kind, {textContent: cell})));
    of("rows").append(make("thead", {}, row(head.names.map(title), "th")), make("tbody", {}, ...head.rows.map((cells) => row(cells, "td"))));
  }

  /** What was chosen about reading. Columns count when x and y are chosen, or none. */
  #read() {
    const of = this.#of;
    const columns = roles.map((role) => of(`column-${role}`)?.value ?? "");
    const isPart = columns.some(Boolean) && !(columns[0] && columns[1]);
    const chosen = columns.filter(Boolean).join(",");
    const before = this.#state.read;
    const next = {...before, columns: isPart ? before.columns : chosen};
    for (const key of ["classes", "epsg", "crossings", "region"]) next[key] = of(key).value.trim();
    next.missing = of("missing").checked ? "left-out" : "";
    if (JSON.stringify(next) !== JSON.stringify(before)) this.#actions.change((state) => (state.read = next));
  }

  /** Opens what mends a failure. */
  offer({message, help = ""}) {
    if (!/column|not a number/.test(message + help) || this.#of("columns-all").hidden) return;
    this.#of("reading").open = true;
    this.#of("reading").scrollIntoView({block: "nearest"});
  }

  #code() {
    const of = this.#of;
    for (const tab of of("tabs").querySelectorAll("[data-tab]")) tab.setAttribute("aria-pressed", String(tab.dataset.tab === this.#tab));
    const {loaded} = this.#context;
    const chosen = {[of("save-view").value]: of("save-format").value};
    of("code").textContent = loaded ? snippets(this.#state, loaded, chosen)[this.#tab].join("\n") : "";
  }
}
