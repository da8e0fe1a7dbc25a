// Zoom and pan: wheel, drag, two fingers, double click and keys move the view of a canvas.

/** Pixels of the share 1 at most, of those that show all: beyond it the coordinates of a picture are no longer apart. */
const DEEPEST = 1e12;
/** Of a pixel of the wheel; a notch is some 100 of them. */
const WHEEL = 0.0015;
const STEP = 1.5;
/** Pixels that a finger may move while it taps. */
const TAP = 6;

/**
 * A view: the share in the middle and the pixels (of the page) of the share 1. `change` is called when it moves, `hover` with a
 * place or nothing, `choose` with a place that was clicked.
 */
export class View {
  constructor(canvas, {change, hover, choose}) {
    Object.assign(this, {canvas, change, isEmpty: true, x: 0.5, y: 0.5, zoom: 1, size: [1, 1]});
    const fingers = new Map();
    let moved = 0;
    const middle = () => {
      const all = [...fingers.values()];
      const [x, y] = [0, 1].map((k) => all.reduce((sum, at) => sum + at[k], 0) / all.length);
      return {x, y, spread: all.length > 1 ? Math.hypot(all[0][0] - all[1][0], all[0][1] - all[1][1]) : 0};
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, this.#pixel(event));
      if (fingers.size === 1) moved = 0;
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!fingers.has(event.pointerId)) return event.pointerType === "mouse" ? hover(this.at(this.#pixel(event))) : undefined;
      const before = middle();
      fingers.set(event.pointerId, this.#pixel(event));
      const after = middle();
      moved += Math.hypot(after.x - before.x, after.y - before.y);
      if (moved <= TAP && fingers.size === 1) return undefined;
      // One finger scrolls the page while all is seen; the style sheet of the canvas says so to the browser.
      if (event.pointerType === "touch" && fingers.size === 1 && this.isWhole) return undefined;
      const [x, y] = this.at([before.x, before.y]);
      this.#scale(before.spread ? after.spread / before.spread : 1);
      return this.#hold(x, y, [after.x, after.y]);
    });
    for (const end of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(end, (event) => {
        const isTap = fingers.size === 1 && moved <= TAP && end === "pointerup";
        if (fingers.delete(event.pointerId) && isTap) choose(this.at(this.#pixel(event)));
      });
    }
    // A finger leaves whenever it is lifted.
    canvas.addEventListener("pointerleave", ({pointerType}) => pointerType === "mouse" && hover(undefined));
    canvas.addEventListener(
      "wheel",
      (event) => {
        // The page scrolls on an empty stage, and where no more can be seen.
        if (this.isEmpty || (event.deltaY > 0 && !event.ctrlKey && this.isWhole)) return;
        event.preventDefault();
        const lines = event.deltaMode === 1 ? 30 : 1;
        this.#about(this.#pixel(event), Math.exp(-event.deltaY * lines * WHEEL));
      },
      {passive: false},
    );
    canvas.addEventListener("dblclick", (event) => this.#about(this.#pixel(event), event.shiftKey ? 1 / STEP ** 2 : STEP ** 2));
    canvas.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const step = 60 / this.zoom;
      const keys = {
        "+": () => this.by(STEP), "=": () => this.by(STEP), "-": () => this.by(1 / STEP), 0: () => this.all(),
        ArrowLeft: () => this.#move(-step, 0), ArrowRight: () => this.#move(step, 0),
        ArrowUp: () => this.#move(0, step), ArrowDown: () => this.#move(0, -step),
        Enter: () => choose([this.x, this.y]),
      };
      if (!keys[event.key]) return;
      event.preventDefault();
      keys[event.key]();
    });
  }

  #pixel(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  get #middle() {
    return [this.canvas.clientWidth / 2, this.canvas.clientHeight / 2];
  }

  /** The share at a pixel. */
  at([px, py]) {
    const [mx, my] = this.#middle;
    return [this.x + (px - mx) / this.zoom, this.y - (py - my) / this.zoom];
  }

  /** The pixel of a share. */
  pixel([x, y]) {
    const [mx, my] = this.#middle;
    return [mx + (x - this.x) * this.zoom, my - (y - this.y) * this.zoom];
  }

  #scale(factor) {
    this.zoom = Math.min(Math.max(this.zoom * factor, this.least / 4), this.least * DEEPEST);
  }

  /** Moves so that a share is at a pixel. */
  #hold(x, y, [px, py]) {
    const [mx, my] = this.#middle;
    [this.x, this.y] = [x - (px - mx) / this.zoom, y + (py - my) / this.zoom];
    this.change();
  }

  #about(pixel, factor) {
    const [x, y] = this.at(pixel);
    this.#scale(factor);
    this.#hold(x, y, pixel);
  }

  #move(dx, dy) {
    [this.x, this.y] = [this.x + dx, this.y + dy];
    this.change();
  }

  by(factor) {
    this.#about(this.#middle, factor);
  }

  /** Pixels of the share 1 when everything is shown. */
  get least() {
    const margin = 0.94;
    return margin * Math.min(this.canvas.clientWidth / (this.size[0] || 1e-9), this.canvas.clientHeight / (this.size[1] || 1e-9), 1e6);
  }

  /** Whether everything is shown. */
  get isWhole() {
    return this.zoom <= this.least * 1.01;
  }

  /** Shows all of what is so large, in shares. */
  all(size = this.size) {
    this.size = size;
    [this.x, this.y, this.zoom] = [size[0] / 2, size[1] / 2, this.least];
    this.change();
  }
}
