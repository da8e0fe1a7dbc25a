// Layers in shares of the extent of the points, and their picture for a view. Shares can be multiplied whatever the coordinates are.

import {Coverage, parts} from "../coverage.js";
import {frameOf, sharesOf} from "../frame.js";
import {Areas, fillTriangle, grays, ramp} from "./fill.js";

/** Meters of a degree of latitude, for shades of heights over degrees. */
const METERS_OF_DEGREE = 111_195;
/** From so many pixels of the extent on, the places of pixels are double floats. */
const DEEP = 1e5;
/** Between so many pixels and a single one, lines fade into a tone. */
const TONE = 6;
/** Where points are closer than so many pixels, edges up to that length are a tone. */
const CARPET = 2;
/** Meshes of so many points are sorted for pictures. */
const CROWD = 20_000;

/** The least and the largest number. */
function range(values) {
  let [low, high] = [Infinity, -Infinity];
  for (let i = 0; i < values.length; i++) {
    if (values[i] < low) low = values[i];
    if (values[i] > high) high = values[i];
  }
  return [low, high];
}

/** Columns of coordinates in a row. */
function inRow(x, y) {
  const row = new Float64Array(2 * x.length);
  for (let i = 0; i < x.length; i++) {
    row[2 * i] = x[i];
    row[2 * i + 1] = y[i];
  }
  return row;
}

/**
 * Edges of triangles that only one has and that go from the larger index to the lesser one: the others are found as they are drawn. Around a
 * point inside, the heads of edges away from it are the tails of those towards it: only where their sums differ, edges are compared.
 */
function borderEdges(triangles, count) {
  const sums = new Int32Array(count);
  const after = (e) => triangles[e % 3 === 2 ? e - 2 : e + 1];
  for (let e = 0; e < triangles.length; e++) {
    const [u, v] = [triangles[e], after(e)];
    sums[u] += v;
    sums[v] -= u;
  }
  const alone = new Map();
  for (let e = 0; e < triangles.length; e++) {
    const [u, v] = [triangles[e], after(e)];
    if (!sums[u] || !sums[v]) continue;
    const key = Math.min(u, v) * count + Math.max(u, v);
    if (alone.has(key)) alone.delete(key);
    else alone.set(key, [u, v]);
  }
  return Uint32Array.from([...alone.values()].filter(([u, v]) => u > v).flat());
}

/** The methods that draw kinds of layers. */
const drawers = {mesh: "drawMesh", edges: "drawEdges", paths: "drawPaths"};

export class Scene {
  #layers = new Map();
  frame = frameOf([]);

  /** Takes the points that all is about: a mesh of them. */
  begin({x = new Float64Array(0), y = x, z, triangles}, isGeographic) {
    this.#layers.clear();
    [this.names, this.places] = [undefined, undefined];
    const row = inRow(x, y);
    this.frame = frameOf(row, isGeographic);
    const heights = range(z ?? []);
    // Points of the plane come with heights of zero.
    this.heights = heights[0] < heights[1] ? heights : undefined;
    [this.x, this.y, this.z] = [x, y, this.heights && z];
    this.points = sharesOf(row, this.frame, row);
    this.add("triangles", {kind: "mesh", points: this.points, z: this.z, triangles});
  }

  add(name, layer) {
    this.#layers.set(name, layer);
  }

  addMesh(name, {x = new Float64Array(0), y = x, z, triangles}) {
    this.add(name, {kind: "mesh", points: sharesOf(inRow(x, y), this.frame), z: this.heights && z, triangles});
  }

  /** Paths, as outputs.js gives them; `isFilled` if they are borders of areas. */
  addPaths(name, {coords, ...paths}, isFilled) {
    this.add(name, {kind: "paths", points: sharesOf(coords, this.frame), isFilled, ...paths});
  }

  /** Edges, or corners of a ring, by the indices of points. */
  addIndices(name, indices, isRing) {
    const {length} = indices;
    const pairs = isRing ? Uint32Array.from({length: 2 * length}, (_, k) => indices[((k + 1) >> 1) % length]) : indices;
    this.add(name, {kind: "edges", points: this.points, pairs: this.places ? pairs.map((i) => this.places[i]) : pairs});
  }

  drop(name) {
    this.#layers.delete(name);
  }

  get(name) {
    return this.#layers.get(name);
  }

  /** The number by which the visitor knows a point of a layer. */
  nameOf(layer, k) {
    return layer.names ? layer.names[k] : k;
  }

  /**
   * Numbers the points of a mesh as its triangles come to them, which are near each other in turn: a picture then reads memory in a row. As good
   * as half of the time of a picture, and takes as long as one.
   */
  #sort(layer) {
    const {points, triangles, z} = layer;
    const count = points.length / 2;
    const places = new Uint32Array(count).fill(count);
    const names = new Uint32Array(count);
    let next = 0;
    const sorted = new Uint32Array(triangles.length);
    for (let e = 0; e < triangles.length; e++) {
      const i = triangles[e];
      if (places[i] === count) names[(places[i] = next++)] = i;
      sorted[e] = places[i];
    }
    for (let i = 0; i < count; i++) if (places[i] === count) names[(places[i] = next++)] = i;
    const near = new Float64Array(points.length);
    for (let k = 0; k < count; k++) {
      near[2 * k] = points[2 * names[k]];
      near[2 * k + 1] = points[2 * names[k] + 1];
    }
    Object.assign(layer, {points: near, triangles: sorted, names, z: z && Float64Array.from(names, (i) => z[i])});
    if (points !== this.points) return;
    this.points = near;
    [this.names, this.places] = [names, places];
    for (const other of this.#layers.values()) {
      if (other.points === points) Object.assign(other, {points: near, pairs: other.pairs.map((i) => places[i])});
    }
  }

  /** Prepares what is drawn right or fast only then, and takes long. Gives whether there was something. */
  complete() {
    for (const layer of this.#layers.values()) if (layer.kind === "mesh" && !layer.names && layer.points.length > 2 * CROWD) this.#sort(layer);
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
    // Half the memory is faster, and as exact as pixels need while they are not many.
    const Pixels = zoom > DEEP ? Float64Array : Float32Array;
    /** Pixels of shares, once for all layers that have them. */
    const place = (points) => {
      if (!placed.has(points)) {
        const pixels = new Pixels(points.length);
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
    if (look.dots && (look.isPlain || zoom / Math.sqrt(this.x.length + 1) > TONE)) this.#dots(draw);
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

  drawMesh({bytes, coverage, place, isBeside, width, height, look, zoom}, {points, triangles, border = []}, {color, alpha}) {
    const pixels = place(points);
    const spacing = zoom / Math.sqrt(points.length / 2 + 1);
    coverage.shortest = spacing < CARPET ? CARPET : 1;
    for (let t = 0; t < triangles.length; t += 3) {
      const a = triangles[t];
      const b = triangles[t + 1];
      const c = triangles[t + 2];
      const ax = pixels[2 * a];
      const ay = pixels[2 * a + 1];
      const bx = pixels[2 * b];
      const by = pixels[2 * b + 1];
      const cx = pixels[2 * c];
      const cy = pixels[2 * c + 1];
      if ((ax < 0 && bx < 0 && cx < 0) || (ay < 0 && by < 0 && cy < 0)) continue;
      if ((ax > width && bx > width && cx > width) || (ay > height && by > height && cy > height)) continue;
      if (a < b) coverage.line(ax, ay, bx, by);
      if (b < c) coverage.line(bx, by, cx, cy);
      if (c < a) coverage.line(cx, cy, ax, ay);
    }
    for (let k = 0; k < border.length; k += 2) {
      const [a, b] = [2 * border[k], 2 * border[k + 1]];
      if (!isBeside(pixels[a], pixels[a + 1], pixels[b], pixels[b + 1])) coverage.line(pixels[a], pixels[a + 1], pixels[b], pixels[b + 1]);
    }
    coverage.shortest = 1;
    // Lines closer than pixels become a tone; over a fill they leave it to be seen.
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

  #dots({bytes, coverage, width, height, place, look, zoom}) {
    const pixels = place(this.points);
    const spacing = zoom / Math.sqrt(pixels.length / 2 + 1);
    const radius = spacing < TONE ? 0 : (spacing < 6 * TONE ? 1.2 : 2.5) * look.ratio;
    for (let i = 0; i < pixels.length; i += 2) {
      const x = pixels[i];
      const y = pixels[i + 1];
      if (x > -radius && y > -radius && x < width + radius && y < height + radius) coverage.dot(x, y, radius);
    }
    coverage.mix(bytes, parts(look.colors.ink), 1);
  }
}
