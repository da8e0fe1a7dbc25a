// The controls of the workbench beside the stage: views and their options, how files are read, results to save, code to copy.

import {copy} from "../copy.js";
import {isText, preview} from "./rows.js";
import {snippets} from "./snippets.js";
import {views} from "./views.js";

/** Of a slider, whose ends are these parts of the extent of the points. */
const SLIDER = {min: -4, max: 0, step: 0.01};
/** Bytes of a file that a preview looks at. */
const HEAD = 1 << 14;
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
    box.addEventListener("change", () =>
      change((state) => {
        if (box.checked) state.views[name] = {};
        else delete state.views[name];
      }),
    );
    const fields = make("span", {className: "options", hidden: true, id: `bench-options-${name}`}, ...options.map((option) => this.#option(name, option)));
    return make("div", {className: "view"}, make("label", {}, box, ` ${title}`), fields);
  }

  #option(name, {key, label, kind, choices, value, slider, ...limits}) {
    const {change} = this.#actions;
    const id = `bench-${name}-${key}`;
    const set = (now, isKept) => change((state) => (state.views[name][key] = now), isKept);
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
    range.addEventListener("input", () => set(length(), false));
    range.addEventListener("change", () => set(length()));
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
    for (const name of Object.keys(views)) {
      of(`view-${name}`).checked = Boolean(state.views[name]);
      of(`options-${name}`).hidden = !state.views[name];
      for (const {key, value, slider} of views[name].options) {
        const field = of(`${name}-${key}`);
        if (field !== document.activeElement) field.value = state.views[name]?.[key] ?? (key === "clip" && state.read.region ? "region" : value);
        if (slider && field.value) of(`${name}-${key}-slider`).value = Math.log10(Number(field.value) / this.#extent);
      }
    }
    of("fill").value = state.fill;
    of("fill").disabled = !loaded?.about.heights;
    of("dots").checked = state.dots;
    const files = loaded?.readable ?? [];
    of("region-all").hidden = files.length < 2;
    of("region").replaceChildren(make("option", {value: "", textContent: "none"}), ...files.map((name) => make("option", {value: name, textContent: name})));
    for (const key of ["classes", "epsg", "crossings", "region"]) if (of(key) !== document.activeElement) of(key).value = state.read[key];
    for (const key of ["png", "save", "save-view", "save-format", "copy"]) of(key).disabled = !loaded;
    of("empty").hidden = state.source.kind !== "none";
    const shown = Object.keys(state.views);
    if ([...of("save-view").options].map(({value}) => value).join() !== shown.join()) {
      of("save-view").replaceChildren(...shown.map((name) => make("option", {value: name, textContent: views[name].title})));
      this.#formats();
    }
    of("facts").textContent = loaded?.facts ?? "";
    of("facts-all").hidden = !loaded?.facts;
    this.#classes(loaded?.facts);
    this.#code();
  }

  #formats() {
    const of = this.#of;
    const name = of("save-view").value;
    const before = of("save-format").value;
    const outputs = name ? this.#actions.formats.outputs[views[name].command] : [];
    of("save-format").replaceChildren(...outputs.map((format) => make("option", {textContent: format})));
    of("save-format").value = outputs.includes(before) ? before : outputs.includes("geojson") ? "geojson" : outputs[0] ?? "";
  }

  /** Classes of laser scans, of the facts that the program tells. */
  #classes(facts = "") {
    const of = this.#of;
    const found = [...facts.matchAll(/^class (\d+) (.*?)\s+\d+$/gm)];
    of("classes-all").hidden = !found.length && !this.#state.read.classes;
    if (!found.length || of("classes").options.length > 1) return;
    of("classes").replaceChildren(make("option", {value: "", textContent: "all"}), ...found.map(([, value, name]) => make("option", {value, textContent: `${value} ${name}`})));
    of("classes").value = this.#state.read.classes;
  }

  /** Columns to choose from, and the first rows. Gives the names of columns. */
  async preview(name, blob) {
    const of = this.#of;
    of("classes").replaceChildren();
    of("columns").replaceChildren();
    of("rows").replaceChildren();
    of("columns-all").hidden = !isText(name ?? "");
    if (!blob || !isText(name)) return [];
    const {names, rows} = preview((await blob.slice(0, HEAD).text()).replace(/[^\n]*$/, (rest) => (blob.size > HEAD ? "" : rest)));
    const taken = this.#state.read.columns.split(",");
    const choices = () => [make("option", {value: "", textContent: "by name"}), ...names.map((name, k) => make("option", {value: name, textContent: name === String(k + 1) ? `column ${name}` : name}))];
    of("columns").append(
      ...roles.map((role, k) => {
        const list = make("select", {id: `bench-column-${role}`}, ...choices());
        list.value = taken[k] ?? "";
        return make("label", {}, `${role} `, list);
      }),
    );
    const row = (cells, kind) => make("tr", {}, ...cells.map((cell) => make(kind, {textContent: cell})));
    of("rows").append(make("thead", {}, row(names, "th")), make("tbody", {}, ...rows.map((cells) => row(cells, "td"))));
    return names;
  }

  /** What was chosen about reading. Columns count when there are two. */
  #read() {
    const of = this.#of;
    const columns = roles.map((role) => of(`column-${role}`)?.value ?? "");
    const isWhole = columns[0] && columns[1];
    this.#actions.change((state) => {
      if (isWhole || !columns.some(Boolean)) state.read.columns = columns.filter(Boolean).join(",");
      for (const key of ["classes", "epsg", "crossings", "region"]) state.read[key] = of(key).value.trim();
    });
  }

  /** Opens what mends a failure. */
  offer({message, help = ""}) {
    if (/column/.test(message + help)) this.#of("reading").open = true;
  }

  #code() {
    const of = this.#of;
    for (const tab of of("tabs").querySelectorAll("[data-tab]")) tab.setAttribute("aria-pressed", String(tab.dataset.tab === this.#tab));
    const {loaded} = this.#context;
    of("code").textContent = loaded ? snippets(this.#state, loaded)[this.#tab].join("\n") : "";
  }
}
