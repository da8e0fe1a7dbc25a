// The workbench: files in, views on the stage, results out. What is shown is a function of the state; all work is done by the program.

import formats from "formats:table";
import {Engine} from "./engine.js";
import {keep, kept} from "./keep.js";
import {fileName} from "./names.js";
import {Panels} from "./panels.js";
import {STAGE, open, split, toldBy} from "./reader.js";
import {nameOfText, regionOf, samples} from "./sources.js";
import {WorkStage} from "./stage.js";
import {LONGEST_TEXT, Past, empty, fromHash} from "./state.js";
import {tellOf} from "./tell.js";
import {helpOf, notesOf, statusOf} from "./told.js";
import {carried, outputOf, reading, stepOf, views, wordsOf} from "./views.js";
import {wire} from "./wires.js";

/** Milliseconds after which work is given up for other work instead of awaited. */
const PATIENCE = 400;
/** So many points are given to the figures below. */
const SHARED = 5000;

export function workbench(section) {
  const of = (name) => section.querySelector(`#bench-${name}`);
  const engine = new Engine();
  const stage = new WorkStage(of("picture"), (...what) => tellOf(section, loaded, ...what));
  let state = empty();
  /** The visitor's files of this visit: blobs by name, by the turn in which they came. */
  const visits = new Map();
  /** What is on the stage. */
  let loaded;
  let busySince = 0;
  let isSaving = false;
  let isAgain = false;
  let clock;

  const panels = new Panels(section, {formats, change, save});
  const past = new Past((other) => {
    state = other;
    update();
  });

  function say(text, kind = "") {
    of("status").textContent = text;
    of("status").className = kind;
  }

  function help(text, kind = "") {
    of("help").textContent = text;
    of("help").className = kind;
  }

  /** Changes the state by a function, remembers it, and shows it. */
  function change(act, isKept = true) {
    act(state);
    if (isKept) past.add(state);
    else past.replace(state);
    return update();
  }

  const begin = (source, more = {}) => change((state) => Object.assign(state, {...empty(), dots: state.dots}, {source}, structuredClone(more)));

  const show = () => panels.show(state, {loaded, canUndo: past.canUndo, canRedo: past.canRedo});

  /** Makes what is on the stage that of the state; calls meanwhile are for one more round. */
  async function update() {
    show();
    if (busySince) {
      isAgain = true;
      // A file that is being made for the visitor is not thrown away.
      if (!isSaving && performance.now() - busySince > PATIENCE) engine.giveUp("superseded");
      return;
    }
    do {
      isAgain = false;
      busy(true);
      try {
        await round();
      } catch (error) {
        if (error.message === "superseded") isAgain = true;
        else if (error.message === "cancelled") cancelled();
        else fail(error);
      }
      busy(false);
    } while (isAgain);
    show();
    section.dataset.state = loaded ? "ready" : "empty";
  }

  function busy(is) {
    busySince = is ? performance.now() : 0;
    clearInterval(clock);
    of("cancel").hidden = true;
    of("clock").textContent = "";
    section.dataset.state = "busy";
    if (!is) return;
    clock = setInterval(() => {
      const seconds = (performance.now() - busySince) / 1000;
      if (seconds < 1) return;
      of("cancel").hidden = false;
      of("clock").textContent = `${seconds.toFixed(0)} s`;
    }, 200);
  }

  /** Views that were not made are no longer asked for, or they would begin again with the next one. */
  function cancelled() {
    for (const name of Object.keys(state.views)) if (name !== "triangles" && !loaded?.made.has(name)) delete state.views[name];
    past.replace(state);
    if (loaded) paint().catch(() => undefined);
    say(loaded ? "Cancelled." : "Cancelled: nothing was read.");
  }

  function fail(error) {
    say(`${error.message}.`.replace(/\.\.$/, "."), "error");
    help(helpOf(error));
    panels.offer(error);
  }

  async function round() {
    help("");
    if (state.source.kind === "none") return forget();
    const key = JSON.stringify([state.source, state.read]);
    if (loaded?.key !== key) await load();
    await make();
  }

  function forget() {
    section.points = undefined;
    loaded = undefined;
    stage.clear();
    say("");
  }

  async function load() {
    const {source, read} = state;
    forget();
    say("Reading …");
    const look = (names, readable, head) => panels.look(JSON.stringify(source), names, readable, head, state);
    const files = visits.get(source.turn) ?? (source.names && (await kept(source.names)));
    const opened = await open({source, read}, {engine, files, formats, tell: say, look});
    const about = await stage.begin(opened.bytes, opened.isGeographic);
    loaded = {...opened, bytes: undefined, about, key: JSON.stringify([source, read]), step: about.heights && stepOf(about.heights)};
    // While the program works, points have no more to tell.
    loaded.row = (i) => (busySince || opened.names.length > 1 ? [] : engine.row(opened.names[0], i, about.points).catch(() => []));
    if (state.read === read) past.replace(state);
    if (!about.heights) state.fill = "none";
  }

  /** The options of a view, with those that are found for it. */
  const given = (name) => (name === "contours" ? {...state.views[name], interval: state.views[name]?.interval || loaded.step} : (state.views[name] ?? {}));

  /** Makes the views that are shown and not there yet, and the picture. */
  async function make() {
    const {names, made} = loaded;
    const faults = [];
    for (const name of Object.keys(views)) {
      if (name === "triangles") continue;
      if (!state.views[name]) {
        if (made.delete(name)) await stage.drop(name);
        continue;
      }
      try {
        if (views[name].heights && !loaded.about.heights) throw new Error("these points have no heights");
        const words = () => wordsOf(name, given(name), names, state.read);
        const key = words().join("\n");
        if (made.get(name)?.key === key) continue;
        say(`${views[name].title} …`);
        const {format, isFilled} = views[name];
        const result = await split(state.read, () => engine.run([...words(), "-o", `${STAGE}.${format}`]));
        const {count} = await stage.layer({name, format, isFilled, bytes: result.written[`${STAGE}.${format}`]});
        made.set(name, {key, count, told: toldBy(result), notes: result.notes});
      } catch (error) {
        if (["superseded", "cancelled"].includes(error.message)) throw error;
        if (made.delete(name)) await stage.drop(name);
        faults.push([name, error]);
      }
    }
    await paint();
    say(statusOf(loaded));
    const {warning, note} = notesOf(loaded);
    if (faults.length) help(faults.map(([name, error]) => `${views[name].title}: ${error.message}. ${helpOf(error)}`).join(" "), "error");
    else help([warning, note].filter(Boolean).join(". "), warning ? "error" : "");
    if (!loaded.isShared) {
      loaded.isShared = true;
      section.points = loaded.about.points <= SHARED ? await stage.points() : undefined;
      section.dispatchEvent(new Event("points"));
    }
    await stage.complete();
    loaded.facts ??= await facts();
  }

  async function paint() {
    const {about, made} = loaded;
    const order = ["alpha", "triangles", "mesh", "cells", "graph", "contours", "hull"];
    const shown = order.filter((name) => state.views[name] && (name === "triangles" || made.has(name)));
    const isFilled = state.fill !== "none" && about.heights;
    const styles = Object.fromEntries(Object.entries(views).map(([name, {style}]) => [name, style]));
    // Lines over a fill leave it to be seen.
    if (isFilled) styles.triangles = {...styles.triangles, alpha: 0.25};
    const isPlain = !isFilled && !shown.includes("contours");
    await stage.show({shown, styles, fill: isFilled ? state.fill : "none", dots: state.dots, isPlain});
    if (loaded.begun) [section.dataset.shown, section.dataset.engine] = [(performance.now() - loaded.begun).toFixed(0), loaded.engine.toFixed(0)];
    loaded.begun = 0;
  }

  /** What `delone info` tells of the files. */
  async function facts() {
    try {
      return (await engine.run(["info", ...loaded.names, ...reading(state.read)])).prints.join("\n");
    } catch (error) {
      if (["superseded", "cancelled"].includes(error.message)) throw error;
      return error.message;
    }
  }

  /** Makes a file of a view, and gives it to the visitor. */
  async function save(name, format) {
    if (busySince || !loaded || !views[name]) return;
    isSaving = true;
    busy(true);
    say(`${views[name].title} as ${format} …`);
    try {
      const output = outputOf(name, format, Object.keys(loaded.blobs));
      const {written, notes} = await engine.run([...wordsOf(name, given(name), loaded.names, state.read), "-o", output]);
      for (const [file, bytes] of Object.entries(written)) download(file, new Blob([bytes]));
      say(`Saved ${Object.keys(written).join(", ")}`);
      help(notes.map((note) => note.replace(/^(note|warning): /, "")).join(". "), notes.some((note) => note.startsWith("warning")) ? "error" : "");
    } catch (error) {
      if (error.message === "cancelled") say("Cancelled: nothing was saved.");
      else fail(error);
    } finally {
      isSaving = false;
      busy(false);
      section.dataset.state = "ready";
    }
    if (isAgain) update();
  }

  function download(name, blob) {
    const link = Object.assign(document.createElement("a"), {href: URL.createObjectURL(blob), download: name});
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  }

  /** Takes files of the visitor. */
  function take(list) {
    const files = Object.fromEntries([...list].map((file) => [fileName(file.name), file]));
    const names = Object.keys(files);
    if (!names.length) return say("That was no file.", "error");
    const turn = Date.now() + Math.random();
    visits.set(turn, files);
    keep(files);
    const views = Object.keys(state.views).length ? carried(state.views) : {triangles: {}};
    return begin({kind: "files", names, turn}, {read: {...empty().read, region: regionOf(names)}, views});
  }

  function paste(text) {
    if (!text.trim()) return;
    const name = nameOfText(text);
    if (text.length > LONGEST_TEXT) take([new File([text], name)]);
    else begin({kind: "text", name, text});
  }

  wire(section, {
    take,
    paste,
    undo: () => past.undo(),
    redo: () => past.redo(),
    cancel: () => busySince && engine.giveUp(),
    unmark: () => stage.mark(undefined, undefined, true),
    view: stage.view,
    sample: (name) => {
      const {views, fill = "none"} = samples[name];
      begin({kind: "sample", name}, {views, fill});
    },
    set: (name, count, seed) => begin({kind: "set", name, count: count || "1000", seed: seed || "0"}, {views: carried(state.views)}),
    picture: async () => loaded && download("delone.png", await stage.png()),
    refuse: (text) => say(text, "error"),
  });

  state = fromHash(location.hash) ?? state;
  if (state.source.kind === "none") show();
  else update();
}
