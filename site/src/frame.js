// Coordinates as shares of the larger extent of a set: numbers that can be multiplied, whatever the coordinates are.

/** The least and the largest of every second number, from one on. */
function range(numbers, from) {
  let low = Infinity;
  let high = -Infinity;
  for (let i = from; i < numbers.length; i += 2) {
    if (numbers[i] < low) low = numbers[i];
    if (numbers[i] > high) high = numbers[i];
  }
  return low <= high ? [low, high] : [0, 0];
}

/** Degrees of longitude are drawn as wide as they are in the middle of what is shown. */
const aspectOf = (isGeographic, south, north) => (isGeographic ? Math.max(Math.cos(((south + north) * Math.PI) / 360), 0.1) : 1);

/** What takes coordinates in a row to shares: x to the right, y up, the larger extent is 1. `size` is that of all; `box` has coordinates. */
export function frameOf(coords, isGeographic = false) {
  const [[x0, x1], [y0, y1]] = [range(coords, 0), range(coords, 1)];
  // Half of an extent is finite where the whole is not; elsewhere halves would lose the last bit of the least floats.
  const part = Math.max(x1 - x0, y1 - y0) < Infinity ? 1 : 0.5;
  const aspect = aspectOf(isGeographic, y0, y1);
  const [wide, high] = [(x1 * part - x0 * part) * aspect, y1 * part - y0 * part];
  // One place has no extent.
  const extent = Math.max(wide, high) || 1;
  return {x0, y0, part, aspect, extent, size: [wide / extent, high / extent], box: [x0, y0, x1, y1], isGeographic};
}

/** Shares of coordinates in a row, in an array of their own or in another one's place. */
export function sharesOf(coords, {x0, y0, part, aspect, extent}, shares = new Float64Array(coords.length)) {
  for (let i = 0; i < coords.length; i += 2) {
    shares[i] = ((coords[i] * part - x0 * part) * aspect) / extent;
    shares[i + 1] = (coords[i + 1] * part - y0 * part) / extent;
  }
  return shares;
}
