// Areas, straight into the pixels: triangles in a color each, and rings by how much of each pixel is inside.

/** 256 colors from blue by way of green to yellow, even in lightness, as words of pixels. */
export const ramp = new Uint32Array(
  Uint8Array.from({length: 1024}, (_, i) => {
    const z = (i >> 2) / 255;
    return [40 + 200 * z * z, 70 + 150 * z, 150 - 90 * z, 255][i % 4];
  }).buffer,
);

/** 256 grays, from dark to light. */
export const grays = new Uint32Array(Uint8Array.from({length: 1024}, (_, i) => (i % 4 === 3 ? 255 : 40 + 0.8 * (i >> 2))).buffer);

/** Gives the pixels whose centers are in a triangle a word; without any that in which its first corner is. */
export function fillTriangle(words, width, height, ax, ay, bx, by, cx, cy, word) {
  const low = Math.min(ay, by, cy);
  const high = Math.max(ay, by, cy);
  const [left, right] = [Math.min(ax, bx, cx), Math.max(ax, bx, cx)];
  if (high < 0 || low >= height || right < 0 || left >= width) return;
  if (high - low < 1 && right - left < 1) {
    const [x, y] = [Math.floor(ax), Math.floor(ay)];
    if (x >= 0 && y >= 0 && x < width && y < height) words[y * width + x] = word;
    return;
  }
  const last = Math.min(Math.ceil(high - 0.5), height);
  for (let row = Math.max(Math.ceil(low - 0.5), 0); row < last; row++) {
    const y = row + 0.5;
    let [from, to] = [Infinity, -Infinity];
    const cross = (px, py, qx, qy) => {
      if (py <= y === qy <= y) return;
      const x = px + ((y - py) / (qy - py)) * (qx - px);
      if (x < from) from = x;
      if (x > to) to = x;
    };
    cross(ax, ay, bx, by);
    cross(bx, by, cx, cy);
    cross(cx, cy, ax, ay);
    const first = Math.max(Math.ceil(from - 0.5), 0);
    const end = Math.min(Math.ceil(to - 0.5), width);
    if (first < end) words.fill(word, row * width + first, row * width + end);
  }
}

/**
 * The areas inside of rings, by signed areas right of each side, which are summed along rows: holes run the other way. Cost: the pixels, and
 * those that sides pass.
 */
export class Areas {
  constructor(width, height) {
    [this.width, this.height] = [width, height];
    this.turns = new Float32Array((width + 2) * height);
  }

  /** A side of a ring. */
  side(x0, y0, x1, y1) {
    const sign = y0 < y1 ? 1 : -1;
    if (sign < 0) [x0, y0, x1, y1] = [x1, y1, x0, y0];
    const {width, height, turns} = this;
    if (y1 <= 0 || y0 >= height || y0 === y1) return;
    const slope = (x1 - x0) / (y1 - y0);
    for (let row = Math.max(Math.floor(y0), 0); row < Math.min(y1, height); row++) {
      const [low, high] = [Math.max(y0, row), Math.min(y1, row + 1)];
      const x = Math.min(Math.max(x0 + ((low + high) / 2 - y0) * slope, 0), width);
      const column = Math.floor(x);
      const part = sign * (high - low);
      turns[row * (width + 2) + column] += part * (1 - (x - column));
      turns[row * (width + 2) + column + 1] += part * (x - column);
    }
  }

  /** Notes how much of each pixel is inside. */
  cover(coverage) {
    const {width, height, turns} = this;
    for (let row = 0; row < height; row++) {
      let sum = 0;
      for (let x = 0; x < width; x++) {
        sum += turns[row * (width + 2) + x];
        coverage.covered[row * width + x] = Math.min(Math.abs(sum), 1) * 255;
      }
    }
  }
}
