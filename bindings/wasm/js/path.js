// What can be drawn onto besides a canvas: the text of an SVG path, and a polygon as an array of points.

/** Text for the attribute `d` of an SVG path. */
export class Path {
  #text = "";
  #start = "";
  #at = "";

  moveTo(x, y) {
    this.#start = this.#at = `${+x},${+y}`;
    this.#text += `M${this.#at}`;
  }

  lineTo(x, y) {
    this.#at = `${+x},${+y}`;
    this.#text += `L${this.#at}`;
  }

  closePath() {
    if (!this.#at) return;
    this.#at = this.#start;
    this.#text += "Z";
  }

  /** A full circle, by two halves. */
  arc(x, y, r) {
    const [left, right] = [`${x - r},${+y}`, `${+x + +r},${+y}`];
    if (this.#at !== right) this[this.#at ? "lineTo" : "moveTo"](+x + +r, y);
    if (r) this.#text += `A${r},${r},0,1,1,${left}A${r},${r},0,1,1,${right}`;
  }

  rect(x, y, width, height) {
    this.#start = this.#at = `${+x},${+y}`;
    this.#text += `M${this.#at}h${+width}v${+height}h${-width}Z`;
  }

  /** The text; null if nothing was drawn. */
  value() {
    return this.#text || null;
  }
}

/** Draws, or without a context returns the text of a path. */
export function drawn(context, draw) {
  if (context != null) {
    draw(context);
    return undefined;
  }
  const path = new Path();
  draw(path);
  return path.value();
}

/** Draws a closed polygon of points, given without the first one repeated. */
export function drawPolygon(context, points) {
  points.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
  if (!points.length) return;
  // Of contexts that d3's types ask for, some only draw lines.
  if (context.closePath) context.closePath();
  else context.lineTo(...points[0]);
}

/** The same points as a ring, whose last point is the first one again. */
export function closed(points) {
  if (!points.length) return null;
  points.push([points[0][0], points[0][1]]);
  return points;
}
