// Four strategies look for the same point, step by step.

import {Delaunay} from "delone/full";
import {draggable} from "../numbers.js";
import {random, scatter} from "../random.js";
import {Stage, WIDTH, edges, prefersCalm, ring, strokePath} from "../stage.js";

export function location(section, tell) {
  const canvases = [...section.querySelectorAll("canvas")];
  const height = WIDTH * 0.5625;
  let [coords, d, all] = [];
  let serial = 1;
  let target;
  let paths = [];
  let shown = 0;
  let begun = 0;
  const stages = canvases.map(
    (canvas, k) =>
      new Stage(canvas, (context, color) => {
        const {scale} = stages[k];
        context.globalAlpha = 0.45;
        strokePath(context, all, color.delaunay, {scale});
        context.globalAlpha = 1;
        const steps = paths[k]?.slice(0, shown) ?? [];
        for (const step of steps) {
          if (step.length > 2) {
            context.fillStyle = color.fill;
            const path = new Path2D();
            step.forEach(([x, y], i) => (i ? path.lineTo(x, y) : path.moveTo(x, y)));
            context.fill(path);
          }
          if (step.length === 1) {
            const dot = new Path2D();
            dot.arc(...step[0], 5 / scale, 0, 2 * Math.PI);
            strokePath(context, dot, color.voronoi, {width: 2, scale});
          } else ring(context, step, color.chosen, 1.5, scale);
        }
        const cross = new Path2D();
        const arm = 9 / scale;
        cross.moveTo(target[0] - arm, target[1] - arm);
        cross.lineTo(target[0] + arm, target[1] + arm);
        cross.moveTo(target[0] + arm, target[1] - arm);
        cross.lineTo(target[0] - arm, target[1] + arm);
        strokePath(context, cross, color.ink, {width: 3, scale});
      }),
  );
  function take(count) {
    d?.dispose();
    coords = scatter(count, height, 21, 10);
    d = new Delaunay(coords);
    all = edges(d, coords);
    another();
  }

  function tick() {
    shown = Math.floor((performance.now() - begun) / 120) + 1;
    if (shown > Math.max(...paths.map((path) => path.length))) stages.forEach((stage) => stage.animate(undefined));
  }

  function ask(place) {
    target = place;
    const results = canvases.map((canvas) => d.locate(...target, {strategy: canvas.dataset.strategy}));
    paths = results.map((result) => result.path);
    canvases.forEach((canvas, k) => {
      canvas.parentElement.querySelector("output").textContent = `${paths[k].length} looks`;
    });
    tell(`All four found the same ${results[0].kind}${results[0].kind === "outside" ? " of the hull" : ""}. Circles are vertices that were only measured.`);
    shown = Infinity;
    if (!prefersCalm()) {
      begun = performance.now();
      stages.forEach((stage) => stage.animate(tick));
    } else stages.forEach((stage) => stage.invalidate());
  }
  const another = () => {
    const next = random(++serial);
    ask([40 + next() * (WIDTH - 80), 40 + next() * (height - 80)]);
  };
  canvases.forEach((canvas, k) => {
    canvas.addEventListener("pointerdown", (event) => ask(stages[k].at(event)));
    canvas.addEventListener("keydown", ({key}) => key === "Enter" && another());
  });
  section.querySelector("#location-again").addEventListener("click", another);
  draggable(section.querySelector(".number"), "points", take);
  take(400);
}
