// A triangle and its circle, which holds no other point.

import {Delaunay} from "delone/full";
import {draggable} from "../numbers.js";
import {scatter} from "../random.js";
import {Stage, dots, edges, strokePath} from "../stage.js";

export function circle(section, tell) {
  const canvas = section.querySelector("canvas");
  let chosen = 0;
  const stage = new Stage(canvas, (context, color) => {
    const {scale} = stage;
    const [x, y] = [centers[2 * chosen], centers[2 * chosen + 1]];
    const i = d.triangles[3 * chosen];
    const radius = Math.hypot(coords[2 * i] - x, coords[2 * i + 1] - y);
    const disk = new Path2D();
    disk.arc(x, y, radius, 0, 2 * Math.PI);
    context.fillStyle = color.fill;
    context.fill(disk);
    strokePath(context, edges(d, coords), color.delaunay, {scale});
    strokePath(context, disk, color.chosen, {width: 2.5, scale});
    strokePath(context, new Path2D(d.renderTriangle(chosen)), color.chosen, {width: 3, scale});
    dots(context, coords, color.ink, 4 / scale);
  });
  let [coords, d, centers, count] = [];

  function take(points) {
    d?.dispose();
    coords = scatter(points, stage.height, 5, 60);
    d = new Delaunay(coords);
    centers = d.voronoi().circumcenters;
    count = d.triangles.length / 3;
    choose(count >> 1);
  }

  function choose(t) {
    chosen = (t + count) % count;
    const [x, y] = [centers[2 * chosen], centers[2 * chosen + 1]];
    const radius = Math.hypot(coords[2 * d.triangles[3 * chosen]] - x, coords[2 * d.triangles[3 * chosen] + 1] - y);
    const corners = new Set(d.triangles.subarray(3 * chosen, 3 * chosen + 3));
    const inside = [...d.within(x, y, radius)].filter((i) => !corners.has(i)).length;
    tell(`Triangle ${chosen + 1} of ${count}: inside of its circle there are ${inside || "no"} other points.`);
    stage.invalidate();
  }
  const point = (event) => {
    const found = d.locate(...stage.at(event));
    if (found.triangle >= 0 && found.triangle !== chosen) choose(found.triangle);
  };
  for (const kind of ["pointermove", "pointerdown"]) canvas.addEventListener(kind, point);
  canvas.addEventListener("keydown", (event) => {
    const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
    if (!step) return;
    choose(chosen + step);
    event.preventDefault();
  });
  draggable(section.querySelector(".number"), "points", take);
  take(40);
}
