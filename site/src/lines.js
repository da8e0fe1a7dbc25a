// Many lines, straight into the pixels: a canvas strokes sixty thousand edges slower than they are triangulated, and a graphics processor
// is not everywhere. Each line covers the two pixels nearest to it in every column, or row where it is steep (Wu, "An efficient antialiasing
// technique", SIGGRAPH 1991). Cost: the pixels of the canvas, and O(1) for each pixel of a line.

/** Something that draws all edges of a triangulation on a canvas, in place of all that is there. */
export function edgePainter() {
  let image;
  let pixels;
  let covered;

  /**
   * Notes by how much a line of one pixel's width covers each pixel, of 255. It is given by numbers of pixels: along the axis that it is
   * less steep to, from the lesser one, and across. So many pixels there are that way, and so many steps of memory they are apart.
   */
  function cover(x0, y0, x1, y1, length, breadth, along, across) {
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

  /** Draws with so many pixels a unit of the coordinates, in a color "#rrggbb". */
  return (context, {triangles, halfedges}, coords, {scale, color, alpha = 1}) => {
    const {width, height} = context.canvas;
    if (image?.width !== width || image.height !== height) {
      image = context.createImageData(width, height);
      pixels = new Uint32Array(image.data.buffer);
      covered = new Uint8Array(width * height);
    }
    covered.fill(0);
    for (let e = 0; e < triangles.length; e++) {
      if (halfedges[e] > e) continue;
      const a = 2 * triangles[e];
      const b = 2 * triangles[e % 3 === 2 ? e - 2 : e + 1];
      const x0 = coords[a] * scale - 0.5;
      const y0 = coords[a + 1] * scale - 0.5;
      const x1 = coords[b] * scale - 0.5;
      const y1 = coords[b + 1] * scale - 0.5;
      if (Math.abs(y1 - y0) <= Math.abs(x1 - x0)) {
        if (x0 < x1) cover(x0, y0, x1, y1, width, height, 1, width);
        else cover(x1, y1, x0, y0, width, height, 1, width);
      } else if (y0 < y1) cover(y0, x0, y1, x1, height, width, width, 1);
      else cover(y1, x1, y0, x0, height, width, width, 1);
    }
    // The bytes of each shade, whichever their order in a word.
    const part = (k) => parseInt(color.slice(1 + 2 * k, 3 + 2 * k), 16);
    const bytes = Uint8Array.from({length: 1024}, (_, i) => (i < 4 ? 0 : i % 4 === 3 ? (i >> 2) * alpha : part(i % 4)));
    const shades = new Uint32Array(bytes.buffer);
    for (let i = 0; i < covered.length; i++) pixels[i] = shades[covered[i]];
    context.putImageData(image, 0, 0);
  };
}
