// Many lines, straight into the pixels: a canvas strokes sixty thousand edges slower than they are triangulated, and a graphics processor
// is not everywhere. Each line covers the two pixels nearest to it in every column, or row where it is steep (Wu, "An efficient antialiasing
// technique", SIGGRAPH 1991). Cost: the pixels of the picture, and O(1) for each pixel of a line.

/** Red, green and blue of a color "#rrggbb". */
export const parts = (color) => [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16));

/** By how much something covers each pixel of a picture, of 255. */
export class Coverage {
  constructor(width, height) {
    [this.width, this.height] = [width, height];
    this.covered = new Uint8Array(width * height);
    /** Shorter lines, in pixels along both axes, are no lines but a part of a tone. */
    this.shortest = 1;
  }

  /** A line of one pixel's width between places in pixels, whose centers are at halves. The shortest add up to a tone. */
  line(ax, ay, bx, by) {
    const {width, height} = this;
    const dx = Math.abs(bx - ax);
    const dy = Math.abs(by - ay);
    if (dx + dy < this.shortest) {
      const x = (ax + bx) / 2;
      const y = (ay + by) / 2;
      if (!(x >= 0 && y >= 0 && x < width && y < height)) return;
      const at = Math.floor(y) * width + Math.floor(x);
      this.covered[at] = Math.min(this.covered[at] + 255 * (dx + dy), 255);
    } else if (dy <= dx) {
      if (ax < bx) this.#cover(ax - 0.5, ay - 0.5, bx - 0.5, by - 0.5, width, height, 1, width);
      else this.#cover(bx - 0.5, by - 0.5, ax - 0.5, ay - 0.5, width, height, 1, width);
    } else if (ay < by) this.#cover(ay - 0.5, ax - 0.5, by - 0.5, bx - 0.5, height, width, width, 1);
    else this.#cover(by - 0.5, bx - 0.5, ay - 0.5, ax - 0.5, height, width, width, 1);
  }

  /**
   * A line given by numbers of pixels: along the axis that it is less steep to, from the lesser one, and across. So many pixels there are that
   * way, and so many steps of memory they are apart.
   */
  #cover(x0, y0, x1, y1, length, breadth, along, across) {
    const {covered} = this;
    const slope = x1 > x0 ? (y1 - y0) / (x1 - x0) : 0;
    const first = Math.max(Math.round(x0), 0);
    const last = Math.min(Math.round(x1), length - 1);
    let y = y0 + (first - x0) * slope;
    for (let x = first; x <= last; x++, y += slope) {
      const row = Math.floor(y);
      if (row < 0 || row >= breadth - 1) continue;
      const share = (255 * (y - row)) | 0;
      const at = x * along + row * across;
      if (covered[at] < 255 - share) covered[at] = 255 - share;
      if (covered[at + across] < share) covered[at + across] = share;
    }
  }

  /** A line of some pixels' width, by lines beside each other. */
  band(x0, y0, x1, y1, wide) {
    const length = Math.hypot(x1 - x0, y1 - y0) || 1;
    const [dx, dy] = [-(y1 - y0) / length, (x1 - x0) / length];
    for (let k = -(wide - 1) / 2; k <= (wide - 1) / 2; k += 0.5) this.line(x0 + k * dx, y0 + k * dy, x1 + k * dx, y1 + k * dy);
  }

  /** A disk; of less than a pixel the pixel that it is in. */
  dot(x, y, radius) {
    const {width, height, covered} = this;
    if (radius < 1) {
      if (x >= 0 && y >= 0 && x < width && y < height) covered[Math.floor(y) * width + Math.floor(x)] = 255;
      return;
    }
    for (let row = Math.max(Math.floor(y - radius), 0); row <= Math.min(y + radius, height - 1); row++) {
      for (let column = Math.max(Math.floor(x - radius), 0); column <= Math.min(x + radius, width - 1); column++) {
        const share = Math.min(Math.max(radius + 0.5 - Math.hypot(column + 0.5 - x, row + 0.5 - y), 0), 1);
        const at = row * width + column;
        covered[at] = Math.max(covered[at], 255 * share);
      }
    }
  }

  /** Mixes a color into pixels where something covers them, and forgets what did. */
  mix(pixels, [red, green, blue], alpha) {
    const {covered} = this;
    for (let i = 0; i < covered.length; i++) {
      if (!covered[i]) continue;
      const share = (covered[i] * alpha) / 255;
      const at = 4 * i;
      pixels[at] += (red - pixels[at]) * share;
      pixels[at + 1] += (green - pixels[at + 1]) * share;
      pixels[at + 2] += (blue - pixels[at + 2]) * share;
      covered[i] = 0;
    }
  }
}

/** Something that draws all edges of a triangulation on a canvas, in place of all that is there. */
export function edgePainter() {
  let coverage;
  let image;

  /** Draws with so many pixels a unit of the coordinates, in a color "#rrggbb". */
  return (context, {triangles, halfedges}, coords, {scale, color, alpha = 1}) => {
    const {width, height} = context.canvas;
    if (image?.width !== width || image.height !== height) {
      image = context.createImageData(width, height);
      coverage = new Coverage(width, height);
    }
    const {covered} = coverage;
    covered.fill(0);
    for (let e = 0; e < triangles.length; e++) {
      if (halfedges[e] > e) continue;
      const a = 2 * triangles[e];
      const b = 2 * triangles[e % 3 === 2 ? e - 2 : e + 1];
      coverage.line(coords[a] * scale, coords[a + 1] * scale, coords[b] * scale, coords[b + 1] * scale);
    }
    // The bytes of each shade, whichever their order in a word.
    const part = parts(color);
    const bytes = Uint8Array.from({length: 1024}, (_, i) => (i < 4 ? 0 : i % 4 === 3 ? (i >> 2) * alpha : part[i % 4]));
    const shades = new Uint32Array(bytes.buffer);
    const pixels = new Uint32Array(image.data.buffer);
    for (let i = 0; i < covered.length; i++) pixels[i] = shades[covered[i]];
    context.putImageData(image, 0, 0);
  };
}
