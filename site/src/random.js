// Random numbers that are the same for everybody, and sets of points made of them.

import {WIDTH} from "./stage.js";

/** Marsaglia's xorshift, from 0 to 1. */
export function random(seed) {
  let x = seed * 2654435769 + 1 >>> 0;
  return () => {
    x ^= x << 13;
    x ^= x >>> 17;
    x ^= x << 5;
    return (x >>> 0) / 2 ** 32;
  };
}

export function scatter(count, height, seed, margin = 0) {
  const next = random(seed);
  const coords = new Float64Array(2 * count);
  for (let i = 0; i < count; i++) {
    coords[2 * i] = margin + next() * (WIDTH - 2 * margin);
    coords[2 * i + 1] = margin + next() * (height - 2 * margin);
  }
  return coords;
}

export function shuffle(list, seed) {
  const next = random(seed);
  for (let i = list.length - 1; i > 0; i--) {
    const j = Math.floor(next() * (i + 1));
    [list[i], list[j]] = [list[j], list[i]];
  }
  return list;
}
