// The workbench: files in, views on the stage, results out. What is shown is a function of the state; all work is done by the program.

import formats from "formats:table";
import {Engine} from "./engine.js";
import {keep, kept} from "./keep.js";
import {Panels} from "./panels.js";
import {blobsOf, fileName, inputsOf, nameOfText, regionOf, samples} from "./sources.js";
import {WorkStage} from "./stage.js";
import {Past, empty, fromHash} from "./state.js";
import {tellOf} from "./tell.js";
import {outputOf, reading, views, wordsOf} from "./views.js";

/** Files that the stage reads, which no file of the visitor is called. */
const STAGE = ".stage";
const STATS = ".stats.json";
/** Milliseconds after which work is given up for other work instead of awaited. */
const PATIENCE = 400;
/** So many points are given to the figures below. */
const SHARED = 5000;
const count = (number) => number.toLocaleString("en");

export function workbench(section) {
  const of = (name) => section.querySelector(`#bench-${name}`);
  const engine = new Engine();
  const stage = new WorkStage(of("picture"), (...what) => tellOf(section, loaded, ...what));
  let state = empty();
  /** The visitor's files of this visit, by name. */
  let files = {};
  /** What is on the stage: the points, and the words of each view that was made. */
  let loaded;
  let busySince = 0;
  let isAgain = false;
  let clock;
  /** Files of equal names may be others. */
  let turn = 0;

  const panels = new Panels(section, {formats, change, save, example: () => loaded});
  const past = new Past((other) => {
    state = other;
    update();
  });

  function say(text, kind = "") {
    of("status").textContent = text;
    of("status").className = kind;
  }

  /** Changes the state by a function, remembers it, and shows it. */
  function change(act, isKept = true) {
    act(state);
    if (isKept) past.add(state);
    else past.replace(state);
    update();
  }

  const begin = (source, more = {}) => change((state) => Object.assign(state, empty(), {source}, structuredClone(more)));

  /** Makes what is on the stage that of the state; calls meanwhile are for one more round. */
  async function update() {
    panels.show(state, {loaded, canUndo: past.canUndo, canRedo: past.canRedo});
    if (busySince) {
      isAgain = true;
      if (performance.now() - busySince > PATIENCE) engine.giveUp("superseded");
      return;
    }
    do {
      isAgain = false;
      busy(true);
      try {
        await round();
      } catch (error) {
        if (error.message === "superseded") isAgain = true;
        else if (error.message === "cancelled") say("Cancelled. What you see is from before.");
        else fail(error);
      }
      busy(false);
    } while (isAgain);
    panels.show(state, {loaded, canUndo: past.canUndo, canRedo: past.canRedo});
    section.dataset.state = loaded ? "ready" : "empty";
  }

  function busy(is) {
    busySince = is ? performance.now() : 0;
    clearInterval(clock);
    of("cancel").hidden = true;
    section.dataset.state = "busy";
    if (!is) return;
    clock = setInterval(() => {
      const seconds = (performance.now() - busySince) / 1000;
      if (seconds < 1) return;
      of("cancel").hidden = false;
      of("clock").textContent = `${seconds.toFixed(0)} s`;
    }, 200);
    of("clock").textContent = "";
  }

  function fail(error) {
    say(`${error.message}.`.replace(/\.\.$/, "."), "error");
    const isLacking = /built without/.test(error.message);
    of("help").textContent = isLacking ? "The page has no SQLite: save the layer as GeoJSON or FlatGeobuf, or use the program on your machine." : (error.help ?? "");
    panels.offer(error);
  }

  async function round() {
    of("help").textContent = "";
    if (state.source.kind === "none") return forget();
    if (loaded?.key !== JSON.stringify([state.source, state.read])) await open(state);
    await show();
  }

  function forget() {
    section.points = undefined;
    loaded = undefined;
    stage.clear();
    say("");
  }

  /** Reads the source, and triangulates it. */
  async function open({source, read}) {
    const start = performance.now();
    forget();
    say("Reading …");
    if (source.kind === "files" && !source.names.every((name) => Object.hasOwn(files, name))) {
      files = (await kept(source.names)) ?? files;
    }
    let generated;
    const blobs = await blobsOf(source, files, async (words) => {
      generated = words;
      await engine.open({});
      return (await engine.run(words)).written[words.at(-1)];
    });
    const readable = inputsOf(Object.keys(blobs), formats.inputs);
    if (!readable.includes(read.region)) read.region = "";
    const names = readable.filter((name) => name !== read.region);
    if (!names.length) throw new Error("the region is the only file: there are no points");
    await engine.open(blobs);
    const headings = await panels.preview(names[0], blobs[names[0]]);
    say(`${names.join(", ")}: triangulating …`);
    const made = await split(read, () => engine.run([...wordsOf("triangles", {}, names, read), "-o", `${STAGE}.ply`, "--stats", STATS]));
    const stats = JSON.parse(new TextDecoder().decode(made.written[STATS]));
    const columns = made.notes.map((note) => /columns (.*) were taken as x, y/.exec(note)?.[1]).find(Boolean)?.split(", ") ?? [];
    const isGeographic = isDegrees(names[0], columns);
    if (!stats.points) throw new Error(`${names.join(", ")}: there are no points in it`);
    const about = await stage.begin(made.written[`${STAGE}.ply`], isGeographic);
    loaded = {key: JSON.stringify([source, read]), names, readable, blobs, stats, about, made: new Map(), notes: made.notes, told: made.errors.find((line) => /^\d/.test(line)) ?? "", generated, isGeographic};
    // While the program works, points have no more to tell.
    loaded.row = (i) => (busySince ? [] : engine.row(names[0], i).catch(() => []));
    const byName = ["x", "y", "z"].filter((role) => headings.includes(role));
    loaded.columns = read.columns ? read.columns.split(",") : columns.length ? columns : byName;
    loaded.isLines = Boolean(stats.segments);
    loaded.engine = made.ms;
    loaded.begun = start;
    if (!about.heights) state.fill = "none";
  }

  /** Runs a command again with lines split where they cross, if that is what it failed for. */
  async function split(read, act) {
    try {
      return await act();
    } catch (error) {
      if (read.crossings || !/cross/.test(error.message)) throw error;
      read.crossings = "split";
      if (read === state.read) past.replace(state);
      return act();
    }
  }

  /** Coordinates that are degrees: of formats that say so, and of columns that are called so. */
  const isDegrees = (name, columns) => /\.(geojson|json|gpx)(\.gz)?$/i.test(name) || columns.some((column) => /^(lon|lng|lat|longitude|latitude)/i.test(column));

  /** Makes the views that are shown and not there yet, and the picture. */
  async function show() {
    const {about, names, made} = loaded;
    const faults = [];
    for (const name of Object.keys(views)) {
      if (name === "triangles") continue;
      if (!state.views[name]) {
        if (made.delete(name)) await stage.drop(name);
        continue;
      }
      try {
        prepare(name, about);
        const words = wordsOf(name, state.views[name], names, state.read);
        const key = words.join("\n");
        if (made.get(name)?.key === key) continue;
        say(`${views[name].title} …`);
        const {format, isFilled} = views[name];
        const result = await split(state.read, () => engine.run([...wordsOf(name, state.views[name], names, state.read), "-o", `${STAGE}.${format}`, "--stats", STATS]));
        const {count} = await stage.layer({name, format, isFilled, bytes: result.written[`${STAGE}.${format}`]});
        made.set(name, {key, count, told: result.errors.find((line) => /^\d/.test(line)) ?? ""});
      } catch (error) {
        if (["superseded", "cancelled"].includes(error.message)) throw error;
        made.delete(name);
        await stage.drop(name);
        faults.push([name, error]);
      }
    }
    const order = ["alpha", "mesh", "triangles", "cells", "graph", "contours", "hull"];
    const shown = order.filter((name) => state.views[name] && (name === "triangles" || made.has(name)));
    // Fill is of triangles, which may have no lines then.
    const isFilled = state.fill !== "none" && about.heights;
    const styles = Object.fromEntries(Object.entries(views).map(([name, {style}]) => [name, style]));
    if (isFilled) styles.triangles = {...styles.triangles, alpha: 0.25};
    await stage.show({shown, styles, fill: isFilled ? state.fill : "none", dots: state.dots});
    if (loaded.begun) {
      section.dataset.shown = (performance.now() - loaded.begun).toFixed(0);
      section.dataset.engine = loaded.engine.toFixed(0);
      loaded.begun = 0;
    }
    tellAll(faults);
    if (!loaded.isShared) {
      loaded.isShared = true;
      section.points = about.points <= SHARED ? await stage.points() : undefined;
      section.dispatchEvent(new Event("points"));
    }
    await stage.complete();
    loaded.facts ??= await facts();
  }

  /** Options that want a number to begin with: a tenth or so of the heights. */
  function prepare(name, {heights}) {
    if (name !== "contours") return;
    if (!heights) throw Object.assign(new Error("contours need heights, and these points have none"), {help: "choose a third column, z, under “How the file is read”"});
    if (state.views.contours.interval) return;
    const step = (heights[1] - heights[0]) / 12 || 1;
    const power = 10 ** Math.floor(Math.log10(step));
    state.views.contours.interval = String(Number(([1, 2, 5, 10].find((part) => part * power >= step) * power).toPrecision(3)));
    past.replace(state);
  }

  /** The parts of a line that the program told, without the time. */
  const parts = (told) => told.replace(/ \([\d.]+ s\)/, "").split(", ").filter(Boolean);

  function tellAll(faults) {
    const {about, names, notes, made} = loaded;
    const points = `${names.join(", ")}: ${count(about.points)} ${about.points === 1 ? "point" : "points"}`;
    const triangles = about.triangles ? `${count(about.triangles)} triangles` : about.points < 3 ? "which are too few for a triangle" : "no triangle: they are on a line, or nothing is inside";
    const known = new Set(parts(loaded.told));
    const others = [...made].map(([name, {told, count: lines}]) => {
      const more = parts(told).filter((part) => !known.has(part));
      if (name === "contours") more.push(`${count(lines)} lines`);
      if (name === "alpha") more.push(`${count(lines)} borders`);
      return more.length ? `${views[name].title}: ${more.join(", ")}` : "";
    });
    say([`${points}, ${triangles}, ${(loaded.engine / 1000).toFixed(2)} s`, ...others].filter(Boolean).join(". "));
    if (faults.length) {
      say(faults.map(([name, {message}]) => `${views[name].title}: ${message}.`).join(" "), "error");
      of("help").textContent = faults.map(([, {help}]) => help).filter(Boolean).join(" ");
    } else of("help").textContent = notes.map((note) => note.replace(/^(note|warning): /, "")).filter((note) => !note.includes(STAGE)).join(". ");
  }

  /** What `delone info` tells of the files. */
  async function facts() {
    try {
      const {prints} = await engine.run(["info", ...loaded.names, ...reading(state.read)]);
      return prints.join("\n");
    } catch (error) {
      return error.message;
    }
  }

  /** Makes a file of a view, and gives it to the visitor. */
  async function save(name, format) {
    if (busySince) return;
    busy(true);
    say(`${views[name].title} as ${format} …`);
    try {
      const base = outputOf(name, format, Object.keys(loaded.blobs));
      const {written, errors} = await engine.run([...wordsOf(name, state.views[name] ?? {}, loaded.names, state.read), "-o", base]);
      for (const [file, bytes] of Object.entries(written)) download(file, new Blob([bytes]));
      say([`Saved ${Object.keys(written).join(", ")}`, ...errors.filter((line) => line.startsWith("note: ")).map((line) => line.slice(6))].join(". "));
    } catch (error) {
      if (error.message === "cancelled") say("Cancelled.");
      else fail(error);
    }
    busy(false);
    section.dataset.state = "ready";
    if (isAgain) update();
  }

  function download(name, blob) {
    const link = Object.assign(document.createElement("a"), {href: URL.createObjectURL(blob), download: name});
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  }

  function take(list) {
    const given = [...list];
    if (!given.length) return say("That was no file.", "error");
    files = Object.fromEntries(given.map((file) => [fileName(file.name), file]));
    keep(files);
    const names = Object.keys(files);
    return begin({kind: "files", names, turn: ++turn}, {read: {...empty().read, region: regionOf(names)}});
  }

  of("file").addEventListener("change", () => {
    take(of("file").files);
    // The same file can be chosen again.
    of("file").value = "";
  });
  addEventListener("dragover", (event) => {
    event.preventDefault();
    section.classList.add("dropping");
  });
  addEventListener("dragleave", (event) => event.relatedTarget || section.classList.remove("dropping"));
  addEventListener("drop", (event) => {
    event.preventDefault();
    section.classList.remove("dropping");
    take(event.dataTransfer.files);
    section.scrollIntoView({block: "nearest"});
  });
  const paste = (text) => text.trim() && begin({kind: "text", name: nameOfText(text), text});
  of("paste-take").addEventListener("click", () => {
    of("paste").hidden = true;
    paste(of("paste-text").value);
  });
  of("paste-open").addEventListener("click", () => {
    of("paste").hidden = !of("paste").hidden;
    if (!of("paste").hidden) of("paste-text").focus();
  });
  addEventListener("paste", (event) => {
    if (event.target.closest?.("input, textarea")) return;
    if (event.clipboardData.files.length) take(event.clipboardData.files);
    else paste(event.clipboardData.getData("text"));
  });
  for (const button of section.querySelectorAll("[data-sample]")) {
    const {views, fill = "none"} = samples[button.dataset.sample];
    button.addEventListener("click", () => begin({kind: "sample", name: button.dataset.sample}, {views, fill}));
  }
  of("set-take").addEventListener("click", () => {
    const [name, number, seed] = ["set", "count", "seed"].map((key) => of(key).value.trim());
    begin({kind: "set", name, count: number || "1000", seed: seed || "0"}, {views: Object.fromEntries(Object.keys(state.views).filter((name) => !views[name].heights).map((name) => [name, {}]))});
  });
  of("undo").addEventListener("click", () => history.back());
  of("redo").addEventListener("click", () => history.forward());
  of("cancel").addEventListener("click", () => engine.giveUp());
  of("in").addEventListener("click", () => stage.view.by(1.5));
  of("out").addEventListener("click", () => stage.view.by(1 / 1.5));
  of("all").addEventListener("click", () => stage.view.all());
  of("png").addEventListener("click", async () => download("delone.png", await stage.png()));
  section.addEventListener("keydown", (event) => {
    if (event.target.closest("input, textarea, select")) return;
    const isCommand = event.ctrlKey || event.metaKey;
    if (event.key === "Escape") {
      of("keys").close?.();
      stage.mark(undefined, undefined, true);
      if (busySince) engine.giveUp();
    } else if (event.key === "?") of("keys").showModal();
    else if (isCommand && event.key === "z" && !event.shiftKey && past.canUndo) history.back();
    else if (isCommand && (event.key === "y" || event.key === "Z") && past.canRedo) history.forward();
    else return;
    event.preventDefault();
  });
  of("help-keys").addEventListener("click", () => of("keys").showModal());

  state = fromHash(location.hash) ?? state;
  if (state.source.kind === "none") panels.show(state, {canUndo: false, canRedo: false});
  else update();
}
