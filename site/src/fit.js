// Points on a sheet, whatever their coordinates: the least and the largest floats are drawn as well.

/** Coordinates that fill a sheet but for a margin, in its middle, y up. */
export function fit(coords, width, height, margin) {
  let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
  for (let i = 0; i < coords.length; i += 2) {
    [x0, x1] = [Math.min(x0, coords[i]), Math.max(x1, coords[i])];
    [y0, y1] = [Math.min(y0, coords[i + 1]), Math.max(y1, coords[i + 1])];
  }
  // Half of an extent is finite where the whole is not; elsewhere halves would lose the last bit of the least floats.
  const part = Math.max(x1 - x0, y1 - y0) < Infinity ? 1 : 0.5;
  const [wide, high] = [x1 * part - x0 * part, y1 * part - y0 * part];
  // Shares of the larger extent are numbers that can be multiplied; pixels a unit may be too many for a float. One place has no extent.
  const extent = Math.max(wide, high) || 1;
  const size = Math.min((width - 2 * margin) / (wide / extent), (height - 2 * margin) / (high / extent), width + height);
  const [dx, dy] = [(width - (wide / extent) * size) / 2, (height - (high / extent) * size) / 2];
  return coords.map((x, i) =>
    i % 2 ? height - dy - ((x * part - y0 * part) / extent) * size : dx + ((x * part - x0 * part) / extent) * size,
  );
}
