// A canvas that figures draw on: 960 units wide whatever its size in pixels, redrawn when something changes, still when nobody looks.

const calm = matchMedia("(prefers-reduced-motion: reduce)");
const dark = matchMedia("(prefers-color-scheme: dark)");

/** How wide the world is. */
export const WIDTH = 960;

/** Colors by name, as the style sheet has them. */
export function colors() {
  const style = getComputedStyle(document.documentElement);
  const of = (name) => style.getPropertyValue(`--${name}`).trim();
  return Object.fromEntries(["delaunay", "voronoi", "hull", "chosen", "ink", "paper", "fill"].map((name) => [name, of(name)]));
}

export const prefersCalm = () => calm.matches;

export class Stage {
  #frame = 0;
  #visible = false;
  #tick;

  /** `draw(context, colors)` is called with the world's units. */
  constructor(canvas, draw) {
    this.canvas = canvas;
    this.draw = draw;
    this.context = canvas.getContext("2d");
    this.height = WIDTH * 0.5625;
    new ResizeObserver(() => this.#resize()).observe(canvas);
    new IntersectionObserver(([entry]) => {
      this.#visible = entry.isIntersecting;
      if (this.#visible) this.invalidate();
    }).observe(canvas);
    dark.addEventListener("change", () => this.invalidate());
    this.#resize();
  }

  #resize() {
    const {clientWidth, clientHeight} = this.canvas;
    if (!clientWidth) return;
    const ratio = Math.min(devicePixelRatio || 1, 2);
    this.scale = clientWidth / WIDTH;
    this.height = clientHeight / this.scale;
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    this.pixels = this.canvas.width / WIDTH;
    this.invalidate();
  }

  /** Draws in the next frame. */
  invalidate() {
    if (this.#frame || !this.#visible) return;
    this.#frame = requestAnimationFrame((time) => {
      this.#frame = 0;
      const start = performance.now();
      this.#tick?.(time);
      const {context, pixels = 1} = this;
      context.setTransform(pixels, 0, 0, pixels, 0, 0);
      context.clearRect(0, 0, WIDTH, this.height);
      // Lines are as wide on a telephone as on a desk.
      context.lineWidth = 1 / this.scale;
      context.lineJoin = "round";
      this.draw(context, colors());
      /** Milliseconds of the last frame that the page itself took, without what the browser does with it. */
      this.cost = performance.now() - start;
      if (this.#tick) this.invalidate();
    });
  }

  /** Calls before every frame, until called without. */
  animate(tick) {
    this.#tick = tick;
    this.invalidate();
  }

  get isMoving() {
    return Boolean(this.#tick);
  }

  /** Where an event is in the world. */
  at(event) {
    const box = this.canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / this.scale, (event.clientY - box.top) / this.scale];
  }

  /** So many pixels of the screen, in units of the world. */
  px(pixels) {
    return pixels / this.scale;
  }
}

/** A path of segments. */
export function strokePath(context, path, color, {width = 1, dash = [], scale = 1} = {}) {
  context.strokeStyle = color;
  context.lineWidth = width / scale;
  context.setLineDash(dash.map((x) => x / scale));
  context.stroke(path);
  context.setLineDash([]);
}

/** All edges of triangles, each once. */
export function edges({triangles, halfedges}, coords) {
  const path = new Path2D();
  for (let e = 0; e < triangles.length; e++) {
    if (halfedges[e] > e) continue;
    const a = triangles[e] * 2;
    const b = triangles[e % 3 === 2 ? e - 2 : e + 1] * 2;
    path.moveTo(coords[a], coords[a + 1]);
    path.lineTo(coords[b], coords[b + 1]);
  }
  return path;
}

export function dots(context, coords, color, radius, skip = () => false) {
  context.fillStyle = color;
  context.beginPath();
  for (let i = 0; i < coords.length / 2; i++) {
    if (skip(i)) continue;
    context.moveTo(coords[2 * i] + radius, coords[2 * i + 1]);
    context.arc(coords[2 * i], coords[2 * i + 1], radius, 0, 2 * Math.PI);
  }
  context.fill();
}

export function ring(context, points, color, width, scale) {
  if (!points.length) return;
  const path = new Path2D();
  points.forEach(([x, y], i) => (i ? path.lineTo(x, y) : path.moveTo(x, y)));
  path.closePath();
  strokePath(context, path, color, {width, scale});
}
