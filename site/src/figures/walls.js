// Lines drawn from point to point become edges.

import {Constrained} from "delone/full";
import {scatter} from "../random.js";
import {Stage, dots, strokePath} from "../stage.js";

export function walls(section, tell) {
  const canvas = section.querySelector("canvas");
  const of = (name) => section.querySelector(`#walls-${name}`);
  let walls = [];
  let from = -1;
  let cursor = 0;
  let to;
  let made;
  const stage = new Stage(canvas, (context, color) => {
    const {scale} = stage;
    const {triangles, constraints, points} = made;
    const all = new Path2D();
    for (let t = 0; t < triangles.length; t += 3) {
      for (let k = 0; k < 3; k++) {
        const i = triangles[t + k] * 2;
        if (k) all.lineTo(points[i], points[i + 1]);
        else all.moveTo(points[i], points[i + 1]);
      }
      all.closePath();
    }
    strokePath(context, all, color.delaunay, {scale});
    const fixed = new Path2D();
    for (let k = 0; k < constraints.length; k += 2) {
      const [a, b] = [constraints[k] * 2, constraints[k + 1] * 2];
      fixed.moveTo(points[a], points[a + 1]);
      fixed.lineTo(points[b], points[b + 1]);
    }
    strokePath(context, fixed, color.hull, {width: 4, scale});
    if (from >= 0 && to) {
      const line = new Path2D();
      line.moveTo(coords[2 * from], coords[2 * from + 1]);
      line.lineTo(...to);
      strokePath(context, line, color.chosen, {width: 3, dash: [8, 5], scale});
    }
    dots(context, points, color.ink, 4 / scale);
    if (document.activeElement === canvas) dots(context, coords.subarray(2 * cursor, 2 * cursor + 2), color.chosen, 8 / scale);
  });
  const coords = scatter(60, stage.height, 14, 30);

  /** Takes these lines in place of those before. Gives what is wrong if that cannot be; then lines and picture stay as they are. */
  function take(lines) {
    try {
      made = new Constrained(coords, lines, {crossings: of("split").checked ? "split" : "refuse"});
    } catch (error) {
      return error.message;
    }
    walls = lines;
    const more = made.points.length / 2 - coords.length / 2;
    tell(`Lines: ${walls.length}; edges of them: ${made.constraints.length / 2}${more ? `, ${more} new vertices where they cross` : ""}.`);
    stage.invalidate();
    return undefined;
  }
  /** Ends the line that was begun. */
  function end(at) {
    if (from < 0) return;
    const wrong = take(at === from ? walls : [...walls, [from, at]]);
    if (wrong) tell(`Refused: ${wrong}.`, true);
    [from, to] = [-1, undefined];
    stage.invalidate();
  }
  const nearest = ([x, y]) => {
    let best = 0;
    for (let i = 1; i < coords.length / 2; i++) {
      const away = (k) => Math.hypot(coords[2 * k] - x, coords[2 * k + 1] - y);
      if (away(i) < away(best)) best = i;
    }
    return best;
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    from = nearest(stage.at(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    if (from < 0) return;
    to = stage.at(event);
    stage.invalidate();
  });
  canvas.addEventListener("pointerup", (event) => end(nearest(stage.at(event))));
  for (const kind of ["focus", "blur"]) canvas.addEventListener(kind, () => stage.invalidate());
  // With the keyboard the ends are chosen one after the other.
  canvas.addEventListener("keydown", (event) => {
    const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
    if (step) {
      cursor = (cursor + step + coords.length / 2) % (coords.length / 2);
      to = [coords[2 * cursor], coords[2 * cursor + 1]];
      tell(`Point ${cursor}. Enter ${from < 0 ? "begins" : "ends"} a line here.`);
    } else if (event.key === "Enter") {
      if (from < 0) {
        from = cursor;
        tell(`A line begins at point ${cursor}. Arrows choose its end, Enter draws it, Escape leaves it.`);
      } else end(cursor);
    } else if (event.key === "Escape" && from >= 0) {
      [from, to] = [-1, undefined];
      tell("No line was drawn.");
    } else return;
    stage.invalidate();
    event.preventDefault();
  });
  of("split").addEventListener("change", () => {
    const wrong = take(walls);
    if (!wrong) return;
    // Lines that cross are there already: which of them should go is not for us to say.
    of("split").checked = true;
    tell(`They stay split, for ${wrong}. Undo lines that cross first.`, true);
  });
  of("undo").addEventListener("click", () => take(walls.slice(0, -1)));
  of("clear").addEventListener("click", () => take([]));
  take([[3, 17]]);
}
