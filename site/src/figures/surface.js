// Heights between points, by triangles or by natural neighbors, and their contours.

import {Delaunay, contours, interpolate} from "delone/full";
import {draggable} from "../numbers.js";
import {scatter} from "../random.js";
import {Stage, WIDTH, dots, strokePath} from "../stage.js";

/** Cells of the picture. */
const [COLUMNS, ROWS] = [240, 135];

export function surface(section, tell) {
  const canvas = section.querySelector("canvas");
  const of = (name) => section.querySelector(`#surface-${name}`);
  const height = WIDTH * 0.5625;
  let [coords, values, d] = [];
  const picture = document.createElement("canvas");
  [picture.width, picture.height] = [COLUMNS, ROWS];
  const places = new Float64Array(2 * COLUMNS * ROWS);
  for (let k = 0; k < COLUMNS * ROWS; k++) {
    places[2 * k] = ((k % COLUMNS) + 0.5) * (WIDTH / COLUMNS);
    places[2 * k + 1] = (Math.floor(k / COLUMNS) + 0.5) * (height / ROWS);
  }
  let chosen = -1;
  let lines = [];
  const stage = new Stage(canvas, (context, color) => {
    const {scale} = stage;
    context.drawImage(picture, 0, 0, WIDTH, height);
    if (of("contours").checked) {
      const path = new Path2D();
      for (const {points, isClosed} of lines) {
        points.forEach(([x, y], k) => (k ? path.lineTo(x, y) : path.moveTo(x, y)));
        if (isClosed) path.closePath();
      }
      strokePath(context, path, color.ink, {scale});
    }
    dots(context, coords, color.ink, 3 / scale);
    if (chosen >= 0) dots(context, coords.subarray(2 * chosen, 2 * chosen + 2), color.chosen, 7 / scale);
  });

  function take(count) {
    d?.dispose();
    coords = scatter(count, height, 33, 15);
    values = Float64Array.from({length: count}, (_, i) => Math.cos(coords[2 * i] / 110) * Math.cos(coords[2 * i + 1] / 130));
    d = new Delaunay(coords);
    choose(-1);
    make();
  }
  function choose(i) {
    chosen = i;
    for (const name of ["raise", "lower"]) of(name).disabled = i < 0;
    stage.invalidate();
  }
  function make() {
    const start = performance.now();
    const found = interpolate(d, values, places, {method: of("method").value});
    const ms = performance.now() - start;
    const image = new ImageData(COLUMNS, ROWS);
    for (let k = 0; k < found.length; k++) {
      if (Number.isNaN(found[k])) continue;
      // From blue to yellow by way of green, even in lightness.
      const z = Math.min(Math.max((found[k] + 1.2) / 2.4, 0), 1);
      image.data.set([40 + 200 * z * z, 70 + 150 * z, 150 - 90 * z, 255], 4 * k);
    }
    picture.getContext("2d").putImageData(image, 0, 0);
    const levels = Array.from({length: 13}, (_, k) => (k - 6) / 6);
    lines = contours(d, values, levels);
    tell(`${found.length.toLocaleString("en")} cells in ${ms.toFixed(0)} ms; ${lines.length} contours, of the triangles.`);
    stage.invalidate();
  }
  function raise(i, by) {
    values[i] += by;
    make();
  }
  const near = (event) => d.find(...stage.at(event));
  canvas.addEventListener("pointerdown", (event) => {
    choose(near(event));
  });
  canvas.addEventListener(
    "wheel",
    (event) => {
      // The page scrolls unless a point was chosen.
      if (chosen < 0 || chosen !== near(event)) return;
      event.preventDefault();
      raise(chosen, event.deltaY < 0 ? 0.1 : -0.1);
    },
    {passive: false},
  );
  canvas.addEventListener("keydown", (event) => {
    const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
    if (step) choose((chosen + step + values.length) % values.length);
    else if (event.key === "+" && chosen >= 0) raise(chosen, 0.1);
    else if (event.key === "-" && chosen >= 0) raise(chosen, -0.1);
    else return;
    event.preventDefault();
    stage.invalidate();
  });
  of("method").addEventListener("change", make);
  of("contours").addEventListener("change", () => stage.invalidate());
  of("raise").addEventListener("click", () => raise(chosen, 0.1));
  of("lower").addEventListener("click", () => raise(chosen, -0.1));
  draggable(section.querySelector(".number"), "points", take);
  take(60);
}
