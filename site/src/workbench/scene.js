// Layers in shares of the extent of the points, and their picture for a view. Shares can be multiplied whatever the coordinates are.

import {Coverage, parts} from "../coverage.js";
import {Areas, fillTriangle, grays, ramp} from "./fill.js";

/** Degrees of longitude are drawn as wide as they are in the middle of what is shown. */
const aspectOf = (isGeographic, south, north) => (isGeographic ? Math.max(Math.cos(((south + north) * Math.PI) / 360), 0.1) : 1);
/** Meters of a degree of latitude, for shades of heights over degrees. */
const METERS_OF_DEGREE = 111_195;
/** Between so many pixels and a single one, lines fade into a tone. */
const TONE = 6;
/** From this many points in a picture on they are single pixels. */
const CROWD = 20_000;

/** The least and the largest number. */
function range(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low <= high ? [low, high] : [0, 0];
}

/** What takes coordinates to shares: x to the right, y up, the larger extent is 1. */
export function frameOf(xs, ys, isGeographic) {
  const [[x0, x1], [y0, y1]] = [range(xs), range(ys)];
  // Half of an extent is finite where the whole is not; elsewhere halves would lose the last bit of the least floats.
  const part = Math.max(x1 - x0, y1 - y0) < Infinity ? 1 : 0.5;
  const aspect = aspectOf(isGeographic, y0, y1);
  const [wide, high] = [(x1 * part - x0 * part) * aspect, y1 * part - y0 * part];
  const extent = Math.max(wide, high) || 1;
  return {x0, y0, part, aspect, extent, size: [wide / extent, high / extent], isGeographic};
}

/** Shares of coordinates in a row. */
function shared(coords, {x0, y0, part, aspect, extent}) {
  const shares = new Float64Array(coords.length);
  for (let i = 0; i < coords.length; i += 2) {
    shares[i] = ((coords[i] * part - x0 * part) * aspect) / extent;
    shares[i + 1] = (coords[i + 1] * part - y0 * part) / extent;
  }
  return shares;
}

/** Edges of triangles that only one has and that go from the larger index to the lesser one: the others are found as they are drawn. */
function borderEdges(triangles, count) {
  const starts = new Uint32Array(count + 1);
  const each = (act) => {
    for (let e = 0; e < triangles.length; e++) act(triangles[e], triangles[e % 3 === 2 ? e - 2 : e + 1]);
  };
  each((u, v) => u < v && starts[u + 1]++);
  for (let i = 0; i < count; i++) starts[i + 1] += starts[i];
  const ends = new Uint32Array(starts[count]);
  const next = starts.slice();
  each((u, v) => u < v && (ends[next[u]++] = v));
  const found = [];
  each((u, v) => {
    if (u < v) return;
    for (let k = starts[v]; k < starts[v + 1]; k++) if (ends[k] === u) return;
    found.push(v, u);
  });
  return Uint32Array.from(found);
}

/** The methods that draw kinds of layers. */
const drawers = {mesh: "drawMesh", edges: "drawEdges", paths: "drawPaths"};

export class Scene {
  #layers = new Map();
  frame = frameOf([], [], false);

  /** Takes the points that all is about: a mesh of them. */
  begin({x = new Float64Array(0), y = x, z, triangles}, isGeographic) {
    this.#layers.clear();
    this.frame = frameOf(x, y, isGeographic);
    const heights = range(z ?? []);
    // Points of the plane come with heights of zero.
    this.heights = heights[0] < heights[1] ? heights : undefined;
    [this.x, this.y, this.z] = [x, y, this.heights && z];
    this.points = this.#shares(x, y);
    this.add("triangles", {kind: "mesh", points: this.points, z: this.z, triangles});
  }

  #shares(x, y) {
    const flat = new Float64Array(2 * x.length);
    for (let i = 0; i < x.length; i++) [flat[2 * i], flat[2 * i + 1]] = [x[i], y[i]];
    return shared(flat, this.frame);
  }

  add(name, layer) {
    this.#layers.set(name, layer);
  }

  addMesh(name, {x = new Float64Array(0), y = x, z, triangles}) {
    this.add(name, {kind: "mesh", points: this.#shares(x, y), z: this.heights && z, triangles});
  }

  /** Paths, as outputs.js gives them; `isFilled` if they are borders of areas. */
  addPaths(name, {coords, ...paths}, isFilled) {
    this.add(name, {kind: "paths", points: shared(coords, this.frame), isFilled, ...paths});
  }

  /** Edges, or corners of a ring, by the indices of points. */
  addIndices(name, indices, isRing) {
    const {length} = indices;
    const pairs = isRing ? Uint32Array.from({length: 2 * length}, (_, k) => indices[((k + 1) >> 1) % length]) : indices;
    this.add(name, {kind: "edges", points: this.points, pairs});
  }

  drop(name) {
    this.#layers.delete(name);
  }

  get(name) {
    return this.#layers.get(name);
  }

  /** Prepares what is drawn right only then, and may take long. Gives whether there was something. */
  complete() {
    const open = [...this.#layers.values()].filter((layer) => layer.kind === "mesh" && !layer.border);
    for (const layer of open) layer.border = borderEdges(layer.triangles, layer.points.length / 2);
    return open.length > 0;
  }

  /**
   * The picture for a view: `x`, `y` the share in the middle, `zoom` the pixels of the share 1. `look` has colors "#rrggbb" by name, the names
   * of layers in `shown`, `fill` ("none", "heights", "shade") and whether there are `dots`. Pixels of lines are `wide`.
   */
  paint(width, height, {x, y, zoom}, look) {
    const bytes = new Uint8ClampedArray(4 * width * height);
    const words = new Uint32Array(bytes.buffer);
    const paper = parts(look.paper);
    words.fill(new Uint32Array(Uint8Array.of(...paper, 255).buffer)[0]);
    const coverage = new Coverage(width, height);
    const placed = new Map();
    /** Pixels of shares, once for all layers that have them. */
    const place = (points) => {
      if (!placed.has(points)) {
        const pixels = new Float64Array(points.length);
        for (let i = 0; i < points.length; i += 2) {
          pixels[i] = (points[i] - x) * zoom + width / 2;
          pixels[i + 1] = height / 2 - (points[i + 1] - y) * zoom;
        }
        placed.set(points, pixels);
      }
      return placed.get(points);
    };
    const isBeside = (ax, ay, bx, by) =>
      (ax < 0 && bx < 0) || (ay < 0 && by < 0) || (ax > width && bx > width) || (ay > height && by > height);
    const draw = {words, bytes, coverage, width, height, place, isBeside, look, zoom};
    for (const name of look.shown) {
      const layer = this.#layers.get(name);
      if (layer?.kind === "mesh" && look.fill !== "none" && layer.z) this.#fill(draw, layer);
    }
    for (const name of look.shown) {
      const layer = this.#layers.get(name);
      if (layer) this[drawers[layer.kind]](draw, layer, look.styles[name]);
    }
    if (look.dots && (look.fill === "none" || zoom / Math.sqrt(this.x.length + 1) > TONE)) this.#dots(draw);
    return bytes;
  }

  /** Triangles by their heights. */
  #fill({words, width, height, place, look}, {points, z, triangles}) {
    const pixels = place(points);
    const [low, high] = this.heights;
    const unit = this.frame.extent / this.frame.part;
    const factor = 1 / (unit * (this.frame.isGeographic ? METERS_OF_DEGREE : 1));
    for (let t = 0; t < triangles.length; t += 3) {
      const [a, b, c] = [triangles[t], triangles[t + 1], triangles[t + 2]];
      let word;
      if (look.fill === "heights") word = ramp[Math.round((255 * ((z[a] - low) / 3 + (z[b] - low) / 3 + (z[c] - low) / 3)) / (high - low))];
      else {
        const [ux, uy, uz] = [points[2 * b] - points[2 * a], points[2 * b + 1] - points[2 * a + 1], (z[b] - z[a]) * factor];
        const [vx, vy, vz] = [points[2 * c] - points[2 * a], points[2 * c + 1] - points[2 * a + 1], (z[c] - z[a]) * factor];
        const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
        // Light from the north-west, 45 degrees above the horizon.
        const light = (-nx / 2 + ny / 2 + nz * Math.SQRT1_2) / (Math.hypot(nx, ny, nz) || 1);
        word = grays[Math.round(255 * Math.min(Math.max(light, 0), 1))];
      }
      fillTriangle(words, width, height, pixels[2 * a], pixels[2 * a + 1], pixels[2 * b], pixels[2 * b + 1], pixels[2 * c], pixels[2 * c + 1], word);
    }
  }

  drawMesh({bytes, coverage, place, isBeside, look, zoom}, {points, triangles, border = []}, {color, wide, alpha}) {
    const pixels = place(points);
    const stroke = (a, b) => {
      const [ax, ay, bx, by] = [pixels[2 * a], pixels[2 * a + 1], pixels[2 * b], pixels[2 * b + 1]];
      if (isBeside(ax, ay, bx, by)) return;
      if (wide > 1) coverage.band(ax, ay, bx, by, wide);
      else coverage.line(ax, ay, bx, by);
    };
    for (let e = 0; e < triangles.length; e += 3) {
      const [a, b, c] = [triangles[e], triangles[e + 1], triangles[e + 2]];
      if (a < b) stroke(a, b);
      if (b < c) stroke(b, c);
      if (c < a) stroke(c, a);
    }
    for (let k = 0; k < border.length; k += 2) stroke(border[k], border[k + 1]);
    // Lines closer than pixels become a tone; over a fill they leave it to be seen.
    const spacing = zoom / Math.sqrt(points.length / 2 + 1);
    const dense = look.fill === "none" ? Math.max(spacing / TONE, 0.4) : spacing / (3 * TONE);
    coverage.mix(bytes, parts(look.colors[color]), Math.min(dense, alpha));
  }

  drawEdges({bytes, coverage, place, isBeside, look}, {points, pairs}, {color, wide, alpha}) {
    const pixels = place(points);
    for (let k = 0; k < pairs.length; k += 2) {
      const [a, b] = [2 * pairs[k], 2 * pairs[k + 1]];
      const ends = [pixels[a], pixels[a + 1], pixels[b], pixels[b + 1]];
      if (!isBeside(...ends)) coverage.band(...ends, wide);
    }
    coverage.mix(bytes, parts(look.colors[color]), alpha);
  }

  drawPaths({bytes, coverage, place, isBeside, width, height, look}, {points, ends, isFilled}, {color, wide, alpha}) {
    const pixels = place(points);
    const each = (act) => {
      let start = 0;
      for (const end of ends) {
        for (let i = start; i + 1 < end; i++) act(pixels[2 * i], pixels[2 * i + 1], pixels[2 * i + 2], pixels[2 * i + 3]);
        start = end;
      }
    };
    if (isFilled) {
      const areas = new Areas(width, height);
      each((...side) => areas.side(...side));
      areas.cover(coverage);
      coverage.mix(bytes, parts(look.colors[color]), 0.25);
    }
    each((ax, ay, bx, by) => {
      if (isBeside(ax, ay, bx, by)) return;
      if (wide > 1) coverage.band(ax, ay, bx, by, wide);
      else coverage.line(ax, ay, bx, by);
    });
    coverage.mix(bytes, parts(look.colors[color]), alpha);
  }

  #dots({bytes, coverage, width, height, place, look}) {
    const pixels = place(this.points);
    let seen = 0;
    for (let i = 0; i < pixels.length; i += 2) {
      if (pixels[i] >= 0 && pixels[i + 1] >= 0 && pixels[i] < width && pixels[i + 1] < height) seen++;
    }
    const radius = seen > CROWD ? 0 : (seen > 2000 ? 1.2 : 2.5) * look.ratio;
    for (let i = 0; i < pixels.length; i += 2) {
      const [x, y] = [pixels[i], pixels[i + 1]];
      if (x > -radius && y > -radius && x < width + radius && y < height + radius) coverage.dot(x, y, radius);
    }
    coverage.mix(bytes, parts(look.colors.ink), 1);
  }
}
