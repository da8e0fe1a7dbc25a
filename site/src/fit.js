// Points on a sheet, whatever their coordinates: the least and the largest floats are drawn as well.

import {frameOf, sharesOf} from "./frame.js";

/** Coordinates that fill a sheet but for a margin, in its middle, y up. */
export function fit(coords, width, height, margin) {
  const frame = frameOf(coords);
  const [wide, high] = frame.size;
  // Pixels a unit may be too many for a float; pixels a share are not.
  const zoom = Math.min((width - 2 * margin) / wide, (height - 2 * margin) / high, width + height);
  const [dx, dy] = [(width - wide * zoom) / 2, (height - high * zoom) / 2];
  return sharesOf(coords, frame).map((share, i) => (i % 2 ? height - dy - share * zoom : dx + share * zoom));
}
