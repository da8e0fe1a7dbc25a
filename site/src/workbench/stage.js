// The stage of the workbench: the last picture, moved at once with the view, until the painter has the next one.

import source from "worker:workbench/painter.js";
import {background} from "../background.js";
import {colors} from "../stage.js";
import {View} from "./navigate.js";

/** Milliseconds between two questions of what is below the pointer. */
const ASKING = 40;
/** A pointer takes points that are so near, in pixels. */
const REACH = 12;

export class WorkStage {
  #worker = background(source);
  #picture = document.createElement("canvas");
  #shownView;
  /** The picture that is being made, as it was asked for. */
  #painting;
  #isDirty = false;
  #frame = 0;
  #look;
  #asked = 0;
  #marks;

  /** `tell` hears what is below the pointer or was chosen: `(found, pixel, isChosen)`. */
  constructor(canvas, tell) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.tell = tell;
    this.view = new View(canvas, {
      change: () => this.invalidate(),
      hover: (at) => this.#ask(at, false),
      choose: (at) => this.#ask(at, true),
    });
    new ResizeObserver(() => this.#resize()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#look && this.show(this.#look));
    this.#resize();
  }

  #resize() {
    const {clientWidth, clientHeight} = this.canvas;
    if (!clientWidth) return;
    this.ratio = Math.min(devicePixelRatio || 1, 2);
    this.canvas.width = Math.round(clientWidth * this.ratio);
    this.canvas.height = Math.round(clientHeight * this.ratio);
    this.invalidate();
  }

  /** Empties the stage. */
  clear() {
    this.#worker.giveUp();
    [this.#painting, this.#shownView, this.#marks, this.#look] = [];
    this.#picture.width = 0;
    this.view.isEmpty = true;
    this.tell(undefined, undefined, true);
    this.invalidate();
    // The next painter begins while the program works.
    this.drop("").catch(() => undefined);
  }

  /** Takes the mesh of all points. Gives what the painter tells of it. */
  async begin(bytes, isGeographic) {
    const about = await this.#worker.run({task: "begin", bytes, isGeographic}, [bytes.buffer]);
    this.view.isEmpty = false;
    this.view.all(about.frame.size);
    this.frame = about.frame;
    return about;
  }

  layer(message) {
    return this.#worker.run({task: "layer", ...message}, [message.bytes.buffer]);
  }

  async points() {
    return (await this.#worker.run({task: "points"})).coords;
  }

  drop(name) {
    return this.#worker.run({task: "drop", name});
  }

  /** Shows layers: their names, styles, fill and dots. The promise is of the picture. */
  show(look) {
    const {paper, ...ink} = colors();
    this.#look = {...look, paper, colors: ink, ratio: this.ratio};
    return this.#paint();
  }

  /** What borders of meshes lacked is added, if there is time. */
  async complete() {
    const {isOther} = await this.#worker.run({task: "complete"});
    if (isOther) await this.#paint();
  }

  /** Asks for a picture; the promise is of the first one. While one is made, others are not. */
  async #paint() {
    if (!this.#look) return;
    const {x, y, zoom} = this.view;
    const {width, height} = this.canvas;
    const asked = {task: "paint", width, height, view: {x, y, zoom: zoom * this.ratio}, look: this.#look};
    if (this.#painting) {
      this.#isDirty = JSON.stringify(asked) !== JSON.stringify(this.#painting);
      return;
    }
    [this.#painting, this.#isDirty] = [asked, false];
    try {
      this.#take(await this.#worker.run(asked));
    } catch (error) {
      if (error.message !== "cancelled") throw error;
      return;
    } finally {
      this.#painting = undefined;
    }
    if (this.#isDirty) this.#paint().catch(() => undefined);
  }

  #take({bytes, width, height, view, ms}) {
    [this.#picture.width, this.#picture.height] = [width, height];
    this.#picture.getContext("2d").putImageData(new ImageData(bytes, width, height), 0, 0);
    this.#shownView = view;
    // For whoever measures: pictures so far, and how long the painter took for the last one.
    const {dataset} = this.canvas.closest("section");
    [dataset.pictures, dataset.painted] = [Number(dataset.pictures ?? 0) + 1, ms.toFixed(1)];
    this.#draw();
  }

  /** Draws in the next frame, and asks for a new picture. */
  invalidate() {
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      this.canvas.style.touchAction = this.view.isWhole ? "pan-y" : "none";
      this.#draw();
      this.#paint().catch(() => undefined);
    });
  }

  #draw() {
    const {context, canvas, view, ratio} = this;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    const shown = this.#shownView;
    if (shown && this.#picture.width) {
      const factor = (view.zoom * ratio) / shown.zoom;
      const dx = canvas.width / 2 + (shown.x - view.x) * view.zoom * ratio - (this.#picture.width / 2) * factor;
      const dy = canvas.height / 2 - (shown.y - view.y) * view.zoom * ratio - (this.#picture.height / 2) * factor;
      context.drawImage(this.#picture, dx, dy, this.#picture.width * factor, this.#picture.height * factor);
    }
    if (this.#marks) this.#mark();
  }

  #mark() {
    const {context, view, ratio} = this;
    const {chosen} = colors();
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.strokeStyle = chosen;
    context.lineWidth = 2;
    const {point, triangle, area} = this.#marks;
    for (const ring of [...(triangle ? [triangle.corners] : []), ...(area?.rings ?? [])]) {
      context.beginPath();
      ring.forEach((at, k) => (k ? context.lineTo(...view.pixel(at)) : context.moveTo(...view.pixel(at))));
      context.closePath();
      context.stroke();
    }
    if (point && this.#marks.isNear) {
      context.beginPath();
      context.arc(...view.pixel(point.at), 7, 0, 2 * Math.PI);
      context.lineWidth = 3;
      context.stroke();
    }
  }

  async #ask(at, isChosen) {
    const turn = ++this.#asked;
    if (!isChosen) await new Promise((resolve) => setTimeout(resolve, ASKING));
    if (turn !== this.#asked) return;
    if (!at || !this.#look) return this.mark(undefined, undefined, isChosen);
    const [x, y] = at;
    try {
      const found = await this.#worker.run({task: "pick", x, y, reach: REACH / this.view.zoom, shown: this.#look.shown});
      if (turn === this.#asked) this.mark(found, this.view.pixel(at), isChosen);
    } catch {
      // The stage was emptied meanwhile.
    }
  }

  /** Marks what was found. */
  mark(found, pixel, isChosen) {
    this.#marks = found;
    this.tell(found, pixel, isChosen);
    this.invalidateMarks();
  }

  invalidateMarks() {
    requestAnimationFrame(() => this.#draw());
  }

  /** The picture as a file: the view twice as fine as on the page, without marks. */
  async png() {
    const {x, y, zoom} = this.view;
    const [width, height] = [2 * this.canvas.clientWidth, 2 * this.canvas.clientHeight];
    const {bytes} = await this.#worker.run({task: "paint", width, height, view: {x, y, zoom: 2 * zoom}, look: {...this.#look, ratio: 2}});
    const sheet = Object.assign(document.createElement("canvas"), {width, height});
    sheet.getContext("2d").putImageData(new ImageData(bytes, width, height), 0, 0);
    return new Promise((resolve) => sheet.toBlob(resolve));
  }
}
