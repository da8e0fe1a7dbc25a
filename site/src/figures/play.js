// Points that come, go and move: up to a few thousand one by one, more of them all anew in every frame, a million off the page's thread.

import {Delaunator, Delaunay} from "delone/full";
import source from "worker:worker.js";
import {background} from "../background.js";
import {edgePainter} from "../coverage.js";
import {random, scatter} from "../random.js";
import {Stage, WIDTH, dots, edges, prefersCalm, ring, strokePath} from "../stage.js";

/** Up to here points are changed one by one, at rest. */
const SINGLE_CHANGES = 100_000;
/** Up to here also in motion; more are triangulated anew for each picture. */
const MOVING_CHANGES = 3000;
/** Up to here cells are drawn. */
const CELLS = 20_000;
/** From here on edges are painted into the pixels, and points not at all. */
const PAINTED_EDGES = 8000;
/** From here on triangles are made off the page's thread. */
const HUGE = 200_000;

export function play(section, tell) {
  const canvas = section.querySelector("canvas");
  const of = (name) => section.querySelector(`#play-${name}`);
  const worker = background(source);
  const paint = edgePainter();
  let coords = new Float64Array(0);
  let gone = new Set();
  let d; // few points: a triangulation that changes
  let made; // arrays of triangles
  let chosen = -1;
  let speeds;
  let ms = 0;
  let serial = 0;
  let frames = [];
  const fingers = new Map(); // by pointer: the point that is dragged, and the timer of a long press

  const stage = new Stage(canvas, (context, color) => {
    if (!made) return;
    const scale = stage.scale;
    const isMany = made.triangles.length / 3 > 2 * PAINTED_EDGES;
    if (of("delaunay").checked) {
      const alpha = made.triangles.length > 600_000 ? 0.35 : 0.8;
      if (isMany) paint(context, made, coords, {scale: stage.pixels, color: color.delaunay, alpha});
      else strokePath(context, edges(made, coords), color.delaunay, {scale});
    }
    const isSmall = coords.length / 2 <= PAINTED_EDGES;
    if (of("voronoi").checked && d && coords.length / 2 <= CELLS) {
      const path = new Path2D(d.voronoi([0, 0, WIDTH, stage.height]).render() ?? "");
      strokePath(context, path, color.voronoi, {dash: [6, 4], width: 1.5, scale});
    }
    if (of("circles").checked && isSmall) circles(context, color, scale);
    if (of("hull").checked) {
      ring(context, Array.from(made.hull, (i) => [coords[2 * i], coords[2 * i + 1]]), color.hull, 3, scale);
    }
    if (isSmall) {
      dots(context, coords, color.ink, (coords.length / 2 > 500 ? 1.5 : 4) / scale, (i) => gone.has(i));
      if (chosen >= 0) dots(context, coords.subarray(2 * chosen, 2 * chosen + 2), color.chosen, 8 / scale);
    }
  });

  function circles(context, color, scale) {
    const path = new Path2D();
    const {circumcenters} = (d ?? new Delaunay(coords)).voronoi([0, 0, WIDTH, stage.height]);
    for (let t = 0; t < Math.min(made.triangles.length / 3, 400); t++) {
      const [x, y] = [circumcenters[2 * t], circumcenters[2 * t + 1]];
      const i = made.triangles[3 * t];
      const radius = Math.hypot(coords[2 * i] - x, coords[2 * i + 1] - y);
      if (!(radius < 1e5)) continue;
      path.moveTo(x + radius, y);
      path.arc(x, y, radius, 0, 2 * Math.PI);
    }
    strokePath(context, path, color.chosen, {width: 0.7, scale});
  }

  function say() {
    const count = coords.length / 2 - gone.size;
    // Two points have one in the arrays, as d3-delaunay has it, and none in truth.
    const triangles = made.hull.length > 2 ? made.triangles.length / 3 : 0;
    const number = (x) => x.toLocaleString("en");
    const rate = frames.length > 5 ? `, ${Math.round((frames.length - 1) * 1000 / (frames.at(-1) - frames[0]))} frames a second, of which a frame takes ${stage.cost.toFixed(0)} ms here` : "";
    const what =
      count === 0 ? "No points. Tap to insert one."
      : count === 1 ? "1 point. One alone has no triangles."
      : triangles === 0 ? `${number(count)} points on a line, which have no triangles.`
      : `${number(count)} points, ${number(triangles)} triangles, ${ms.toFixed(ms < 10 ? 1 : 0)} ms${rate}.`;
    const cells = of("voronoi").checked && !(d && coords.length / 2 <= CELLS) ? ` Voronoi cells are drawn at rest, of at most ${number(CELLS)} points.` : "";
    tell(what + cells + (coords.length / 2 > PAINTED_EDGES && triangles ? " So many points are not drawn, their edges are." : ""));
  }

  /** Triangulates all points anew. */
  function make() {
    const start = performance.now();
    d?.dispose();
    d = undefined;
    if (coords.length / 2 <= (stage.isMoving ? MOVING_CHANGES : SINGLE_CHANGES)) {
      d = new Delaunay(coords);
      made = d;
    } else {
      made = new Delaunator(coords);
    }
    ms = performance.now() - start;
  }

  function sets() {
    const count = Number(of("count").value);
    const height = stage.height;
    const kind = of("kind").value;
    if (kind === "random") return scatter(count, height, ++serial, 20);
    const made = new Float64Array(2 * count);
    const across = Math.ceil(Math.sqrt(count * WIDTH / height));
    const step = Math.max((WIDTH - 40) / across, 1e-3);
    const next = random(7);
    for (let i = 0; i < count; i++) {
      const turn = 2 * Math.PI * i / count;
      const [x, y] =
        kind === "grid" ? [20 + step / 2 + (i % across) * step, 20 + step / 2 + Math.floor(i / across) * step]
        : kind === "circle" ? [WIDTH / 2 + Math.cos(turn) * height * 0.45, height / 2 + Math.sin(turn) * height * 0.45]
        : [40 + next() * (WIDTH - 80), height / 2];
      [made[2 * i], made[2 * i + 1]] = [x, y];
    }
    return made;
  }

  /** Other points, or others by the same numbers: what was known of single ones holds no longer. */
  function take(points) {
    coords = points;
    gone = new Set();
    chosen = -1;
    speeds = undefined;
    letGo(() => true);
  }

  /** Ends dragging and long presses of some fingers. */
  function letGo(which) {
    for (const [pointer, finger] of fingers) {
      if (!which(finger, pointer)) continue;
      clearTimeout(finger.held);
      fingers.delete(pointer);
    }
  }

  async function begin() {
    worker.giveUp();
    frames = [];
    const points = sets();
    const isHuge = points.length / 2 > HUGE;
    of("motion").disabled = isHuge;
    if (isHuge) {
      stage.animate(undefined);
      of("motion").setAttribute("aria-pressed", "false");
      tell(`${(points.length / 2).toLocaleString("en")} points: triangulating …`);
      try {
        const result = await worker.run({task: "triangulate", coords: points}, [points.buffer]);
        take(result.coords);
        d?.dispose();
        [d, made, ms] = [undefined, result, result.ms];
      } catch (error) {
        if (error.message === "cancelled") return;
        tell(`That did not work: ${error.message}`, true);
        of("motion").disabled = coords.length / 2 > HUGE; // the points are still those before
        return;
      }
    } else {
      take(points);
      make();
    }
    say();
    stage.invalidate();
  }

  function tick(time) {
    const count = coords.length / 2;
    if (speeds?.length !== coords.length) {
      const next = random(3);
      speeds = Float64Array.from(coords, () => (next() - 0.5) * 1.6);
    }
    for (let i = 0; i < coords.length; i++) {
      if (gone.has(i >> 1)) continue;
      const most = i % 2 ? stage.height : WIDTH;
      coords[i] += speeds[i];
      if (coords[i] < 0 || coords[i] > most) {
        speeds[i] = -speeds[i];
        coords[i] = Math.min(Math.max(coords[i], 0), most);
      }
    }
    if (gone.size) compact();
    make();
    frames.push(time);
    if (frames.length > 40) frames.shift();
    if (count < MOVING_CHANGES || frames.length % 10 === 0) say();
  }

  /** Forgets points that are gone. */
  function compact() {
    const kept = Array.from({length: coords.length / 2}, (_, i) => i).filter((i) => !gone.has(i));
    take(Float64Array.from(kept.flatMap((i) => [coords[2 * i], coords[2 * i + 1]])));
  }

  /** Runs a change of single points. */
  function change(act) {
    if (!d) return;
    const start = performance.now();
    try {
      act();
      ms = performance.now() - start;
      made = d;
      say();
    } catch (error) {
      tell(error.message, true);
    }
    stage.invalidate();
  }

  const insert = ([x, y]) =>
    change(() => {
      chosen = d.insert(x, y);
      coords = Float64Array.from(d.points);
      gone.delete(chosen);
    });
  const remove = (i) =>
    change(() => {
      d.remove(i);
      gone.add(i);
      chosen = -1;
      letGo(({dragged}) => dragged === i);
    });
  const move = (i, x, y) =>
    change(() => {
      d.move(i, x, y);
      [coords[2 * i], coords[2 * i + 1]] = [x, y];
    });

  /** The point that is near a place, unless the way to the next one is short. */
  const near = ([x, y]) => {
    const spacing = Math.sqrt((WIDTH * stage.height) / (coords.length / 2 - gone.size + 1));
    const reach = Math.min(stage.px(22), 0.3 * spacing);
    const i = d?.find(x, y) ?? -1;
    return i >= 0 && Math.hypot(coords[2 * i] - x, coords[2 * i + 1] - y) <= reach ? i : -1;
  };

  canvas.addEventListener("pointerdown", (event) => {
    if (stage.isMoving) of("motion").click();
    if (!d) return tell("So many points are only looked at: choose fewer to change them.");
    const place = stage.at(event);
    const i = near(place);
    if (event.shiftKey) {
      if (i >= 0) remove(i);
      return;
    }
    canvas.setPointerCapture(event.pointerId);
    if (i < 0) insert(place);
    else chosen = i;
    if (chosen >= 0) fingers.set(event.pointerId, {dragged: chosen, held: i < 0 ? undefined : setTimeout(() => remove(i), 600)});
    stage.invalidate();
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!fingers.has(event.pointerId)) return;
    const {dragged, held} = fingers.get(event.pointerId);
    const [x, y] = stage.at(event);
    if (Math.hypot(x - coords[2 * dragged], y - coords[2 * dragged + 1]) > stage.px(3)) {
      clearTimeout(held);
      move(dragged, Math.min(Math.max(x, 0), WIDTH), Math.min(Math.max(y, 0), stage.height));
    }
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, (event) => letGo((_, pointer) => pointer === event.pointerId));
  }
  canvas.addEventListener("keydown", (event) => {
    if (!d) return;
    if (stage.isMoving && event.key !== "Tab") of("motion").click();
    const steps = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
    const alive = Array.from({length: coords.length / 2}, (_, i) => i).filter((i) => !gone.has(i));
    if (steps[event.key] && chosen >= 0) {
      const [dx, dy] = steps[event.key].map((x) => x * (event.shiftKey ? 1 : 8));
      move(chosen, coords[2 * chosen] + dx, coords[2 * chosen + 1] + dy);
    } else if (event.key === "n" || event.key === "p") {
      const at = alive.indexOf(chosen) + (event.key === "n" ? 1 : -1);
      chosen = alive.at(at % alive.length) ?? -1;
    } else if (event.key === "Enter") {
      const next = random(++serial + 99);
      insert([20 + next() * (WIDTH - 40), 20 + next() * (stage.height - 40)]);
    } else if ((event.key === "Delete" || event.key === "Backspace") && chosen >= 0) {
      remove(chosen);
    } else {
      return;
    }
    event.preventDefault();
    stage.invalidate();
  });

  of("motion").addEventListener("click", () => {
    const isMoving = !stage.isMoving;
    of("motion").setAttribute("aria-pressed", String(isMoving));
    frames = [];
    stage.animate(isMoving ? tick : undefined);
    if (!isMoving && !d) {
      make();
      say();
    }
  });
  for (const name of ["count", "kind"]) of(name).addEventListener("change", begin);
  for (const name of ["delaunay", "voronoi", "hull", "circles"]) {
    of(name).addEventListener("change", () => {
      say();
      stage.invalidate();
    });
  }
  begin();
  if (!prefersCalm() && Number(of("count").value) <= 100) of("motion").click();
}
