// Sets of points that break what is not exact.

/** Numbers between 0 and 1 that are the same everywhere (Marsaglia's xorshift). */
export function random(seed = 1) {
  let state = seed * 2654435769 || 1;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) / 2 ** 32;
  };
}

const flat = (count, point) => Float64Array.from(Array.from({length: count}, (_, i) => point(i)).flat());

export function uniform(count, seed = 1, [width, height] = [1, 1]) {
  const r = random(seed);
  return flat(count, () => [width * r(), height * r()]);
}

const grid = (side, place = (x, y) => [x, y]) => flat(side * side, (i) => place(i % side, Math.floor(i / side)));
const scaled = (factor) => (points) => points.map((x) => x * factor);

export const sets = {
  nothing: new Float64Array(0),
  "one point": Float64Array.of(3, 4),
  "two points": Float64Array.of(3, 4, 5, 6),
  "equal points": flat(50, () => [7, 7]),
  triangle: Float64Array.of(0, 0, 1, 0, 0, 1),
  uniform: uniform(400),
  "a grid": grid(16),
  "a grid with duplicates": flat(600, (i) => [(i * 7) % 11, (i * 5) % 13]),
  "a turned grid": grid(16, (x, y) => [x * Math.cos(0.3) - y * Math.sin(0.3), x * Math.sin(0.3) + y * Math.cos(0.3)]),
  "a grid of tenths": grid(14, (x, y) => [x / 10, y / 10]),
  "a circle": flat(200, (i) => [Math.cos(i), Math.sin(i)]),
  "a circle of integers": Float64Array.from([[7, 24], [15, 20], [20, 15], [24, 7], [25, 0]].flatMap(([x, y]) => [x, y, -x, y, x, -y, -x, -y])),
  "a tiny square": scaled(1e-300)(Float64Array.of(0, 0, 1, 0, 0, 1, 1, 1)),
  "a huge square": scaled(1e300)(Float64Array.of(0, 0, 1, 0, 0, 1, 1, 1)),
  "tiny and huge": Float64Array.of(1e-300, 0, 1e300, 1, -1e300, 2, 0, 1e300, 1e-300, -1e300, 0, 0, 5e-324, 5e-324),
  subnormal: flat(60, (i) => [((i * 7) % 13) * 5e-324, ((i * 3) % 11) * 5e-324]),
  "the largest numbers": Float64Array.of(Number.MAX_VALUE, 0, -Number.MAX_VALUE, 1, 0, Number.MAX_VALUE, 1, -Number.MAX_VALUE, 0, 0),
  "a level line": flat(40, (i) => [(i * 17) % 40, 2]),
  "an upright line": flat(40, (i) => [2, (i * 17) % 40]),
  "a slanted line": flat(40, (i) => [(i * 17) % 40, 2 * ((i * 17) % 40)]),
  "nearly a line": flat(40, (i) => [i, i / 3]),
  "a line and a point": Float64Array.from([...flat(40, (i) => [i, i]), 5, 5.000000000000001]),
  "two clusters": flat(300, (i) => [(i % 2) * 1e9 + ((i * 37) % 101) * 1e-7, ((i * 53) % 103) * 1e-7]),
};
