// A lattice, or the points of the workbench, by us and by delaunator, in any order. What is wrong is found with integers of any length.

import {Delaunator} from "delone/full";
import {fit} from "../fit.js";
import {load} from "../load.js";
import {random, shuffle} from "../random.js";
import {Stage, WIDTH, dots, strokePath} from "../stage.js";

const SIDE = 10;

/** Sets of more points take too long to judge. */
const JUDGED = 5000;

/** Floats as integers times one power of two: exact. */
function whole(coords) {
  const bits = new BigUint64Array(Float64Array.from(coords).buffer);
  const exponents = Array.from(bits, (word) => Number((word >> 52n) & 2047n));
  const least = exponents.reduce((low, exponent, i) => (coords[i] ? Math.min(low, exponent) : low), 2047);
  return Array.from(bits, (word, i) => {
    if (!coords[i]) return 0n;
    const fraction = word & ((1n << 52n) - 1n);
    // The least floats have no leading bit, and the exponent of those above them.
    const mantissa = exponents[i] ? (fraction | (1n << 52n)) << BigInt(exponents[i] - Math.max(least, 1)) : fraction;
    return coords[i] < 0 ? -mantissa : mantissa;
  });
}

/** The sign of the in-circle determinant of exact points, positive for d inside of the circle of a counter-clockwise triangle. */
function inCircle(a, b, c, d) {
  const rows = [a, b, c].map(([x, y]) => [x - d[0], y - d[1]]).map(([x, y]) => [x, y, x * x + y * y]);
  const [p, q, r] = rows;
  const value =
    p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
  const area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  return value === 0n ? 0 : value > 0n === area > 0n ? 1 : -1;
}

/** Edges whose other point is inside of the circle: half-edge numbers. */
function wrong({triangles, halfedges}, coords) {
  const all = whole(coords);
  const exact = Array.from({length: coords.length / 2}, (_, i) => [all[2 * i], all[2 * i + 1]]);
  const found = [];
  for (let e = 0; e < triangles.length; e++) {
    const twin = halfedges[e];
    if (twin < e) continue;
    const t = e - (e % 3);
    const corners = [t, t + 1, t + 2].map((k) => exact[triangles[k]]);
    const apex = triangles[twin - (twin % 3) + ((twin % 3) + 2) % 3];
    if (inCircle(...corners, exact[apex]) > 0) found.push(e);
  }
  return found;
}

export function one(section, tell) {
  const [mine, other] = section.querySelectorAll("canvas");
  const turn = section.querySelector("#one-turn");
  const yours = section.querySelector("#one-yours");
  const bench = document.getElementById("bench");
  let order = Array.from({length: SIDE * SIDE}, (_, i) => i);
  let serial = 1;
  let results = [];
  const stages = [mine, other].map(
    (canvas, k) =>
      new Stage(canvas, (context, color) => {
        const result = results[k];
        if (!result) return;
        const {scale} = stages[k];
        const good = new Path2D();
        const bad = new Path2D();
        const {triangles, halfedges} = result.made;
        const isBad = new Set(result.wrong);
        for (let e = 0; e < triangles.length; e++) {
          if (halfedges[e] > e && !isBad.has(e)) {
            if (!isBad.has(halfedges[e])) line(good, e);
          } else if (isBad.has(e)) line(bad, e);
          else if (halfedges[e] < 0) line(good, e);
        }
        function line(path, e) {
          const [a, b] = [triangles[e] * 2, triangles[e % 3 === 2 ? e - 2 : e + 1] * 2];
          path.moveTo(result.places[a], result.places[a + 1]);
          path.lineTo(result.places[b], result.places[b + 1]);
        }
        strokePath(context, good, color.delaunay, {width: 1.5, scale});
        strokePath(context, bad, color.voronoi, {width: 3, dash: [6, 4], scale});
        if (result.places.length < 2000) dots(context, result.places, color.ink, 2.5 / scale);
      }),
  );

  function lattice() {
    const angle = (Number(turn.value) * Math.PI) / 180;
    const {height} = stages[0];
    const step = height / (SIDE * 1.5);
    const [cos, sin] = [Math.cos(angle) * step, Math.sin(angle) * step];
    const half = (SIDE - 1) / 2;
    return Float64Array.from(
      order.flatMap((i) => {
        const [x, y] = [(i % SIDE) - half, Math.floor(i / SIDE) - half];
        return [WIDTH / 2 + x * cos - y * sin, height / 2 + x * sin + y * cos];
      }),
    );
  }

  /** The points of the workbench in an order. */
  const taken = () => Float64Array.from(order.flatMap((i) => [bench.points[2 * i], bench.points[2 * i + 1]]));
  const isYours = () => yours.getAttribute("aria-pressed") === "true";

  function make() {
    const coords = isYours() ? taken() : lattice();
    const places = isYours() ? fit(coords, WIDTH, stages[0].height, 25) : coords;
    const Rival = globalThis.Rival?.Delaunator;
    results = [Delaunator, Rival].map((Way) => {
      if (!Way) return undefined;
      const made = new Way(coords);
      return {made, places, wrong: wrong(made, coords)};
    });
    section.querySelector("#one-angle").textContent = `${turn.value}°`;
    const count = (result) => (result ? `${result.wrong.length} wrong edges` : "not loaded");
    tell(`Delone: ${count(results[0])}. delaunator: ${count(results[1])}.`);
    stages.forEach((stage) => stage.invalidate());
  }
  section.querySelector("#one-shuffle").addEventListener("click", () => {
    order = shuffle(order, ++serial * 31 + Math.floor(random(serial)() * 1000));
    make();
  });
  turn.addEventListener("input", make);
  function choose(is) {
    yours.setAttribute("aria-pressed", String(is));
    turn.disabled = is;
    order = Array.from({length: is ? bench.points.length / 2 : SIDE * SIDE}, (_, i) => i);
    make();
  }
  yours.addEventListener("click", () => choose(!isYours()));
  const offer = () => {
    yours.disabled = !(bench.points?.length <= 2 * JUDGED);
    if (isYours()) choose(!yours.disabled);
  };
  bench.addEventListener("points", offer);
  offer();
  make();
  // The other library when somebody comes near.
  new IntersectionObserver(([entry], observer) => {
    if (!entry.isIntersecting) return;
    observer.disconnect();
    load("rival.js").then(make, () => tell("The other library could not be loaded; Delone's lattice is here.", true));
  }).observe(section);
}
