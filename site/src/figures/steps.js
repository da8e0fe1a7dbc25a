// Points inserted one by one: what is in conflict, what fills the hole, and who waits where.

import {Delaunay} from "delone/full";
import {scatter} from "../random.js";
import {Stage, dots, prefersCalm, strokePath} from "../stage.js";

const COUNT = 40;

/** The triangles of a triangulation by their corners. */
function faces(d) {
  const all = new Map();
  for (let t = 0; t < d.triangles.length; t += 3) {
    const corners = [...d.triangles.subarray(t, t + 3)];
    all.set([...corners].sort((a, b) => a - b).join(), corners);
  }
  return all;
}

export function steps(section, tell) {
  const canvas = section.querySelector("canvas");
  const of = (name) => section.querySelector(`#steps-${name}`);
  const stage = new Stage(canvas, draw);
  const coords = scatter(COUNT, stage.height, 8, 40);
  let now = 7; // half steps: conflicts first, then the star
  let timer;

  const at = new Map();
  /** The triangulation of the first points. */
  function of_first(count) {
    if (!at.has(count)) {
      const d = new Delaunay(coords.slice(0, 2 * count));
      at.set(count, {d, all: faces(d)});
    }
    return at.get(count);
  }

  function draw(context, color) {
    const {scale} = stage;
    const count = 3 + (now >> 1);
    const isDone = now % 2 === 1;
    const before = of_first(count);
    const after = of_first(Math.min(count + 1, COUNT));
    const shown = isDone ? after : before;
    const changed = [...shown.all.entries()].filter(([key]) => !(isDone ? before : after).all.has(key));
    const path = (corners) => {
      const way = new Path2D();
      corners.forEach((i, k) => (k ? way.lineTo(coords[2 * i], coords[2 * i + 1]) : way.moveTo(coords[2 * i], coords[2 * i + 1])));
      way.closePath();
      return way;
    };
    for (const [, corners] of changed) {
      context.fillStyle = color.fill;
      context.fill(path(corners));
    }
    for (const [, corners] of shown.all) strokePath(context, path(corners), color.delaunay, {scale});
    for (const [, corners] of changed) {
      strokePath(context, path(corners), isDone ? color.hull : color.voronoi, {width: 2.5, dash: isDone ? [] : [6, 4], scale});
    }
    // Who waits is colored by the triangle that it waits in.
    for (let i = shown.d.points.length / 2; i < COUNT; i++) {
      const t = shown.d.locate(coords[2 * i], coords[2 * i + 1]).triangle;
      dots(context, coords.subarray(2 * i, 2 * i + 2), t < 0 ? "#888888" : `hsl(${(t * 137) % 360} 60% 50%)`, 4 / scale);
    }
    dots(context, coords.subarray(0, shown.d.points.length), color.ink, 4 / scale);
    const next = Math.min(count, COUNT - 1);
    dots(context, coords.subarray(2 * next, 2 * next + 2), color.chosen, 8 / scale);
    const waiting = COUNT - shown.d.points.length / 2;
    tell(
      isDone
        ? `Point ${next + 1} is in: ${changed.length} new triangles around it. ${waiting} points wait.`
        : `Point ${next + 1} comes: ${changed.length} triangles are in conflict. ${waiting} points wait.`,
    );
  }

  function go(step) {
    now = Math.min(Math.max(now + step, 0), 2 * (COUNT - 3) - 1);
    if (now === 2 * (COUNT - 3) - 1) stop();
    stage.invalidate();
  }
  function stop() {
    clearInterval(timer);
    timer = undefined;
    of("play").setAttribute("aria-pressed", "false");
  }
  of("back").addEventListener("click", () => go(-1));
  of("next").addEventListener("click", () => go(1));
  of("play").addEventListener("click", () => {
    if (timer) return stop();
    of("play").setAttribute("aria-pressed", "true");
    timer = setInterval(() => go(1), prefersCalm() ? 1500 : 500);
  });
  canvas.addEventListener("keydown", (event) => {
    const step = {ArrowRight: 1, ArrowLeft: -1}[event.key];
    if (!step) return;
    go(step);
    event.preventDefault();
  });
  stage.invalidate();
}
