// Triangles and cells, one fading into the other; relaxation; cells cut by a polygon; power cells of points with weights.

import {Delaunay, Power} from "delone/full";
import {draggable} from "../numbers.js";
import {random, scatter} from "../random.js";
import {Stage, WIDTH, dots, edges, ring, strokePath} from "../stage.js";

export function voronoi(section, tell) {
  const canvas = section.querySelector("canvas");
  const of = (name) => section.querySelector(`#voronoi-${name}`);
  let d;
  let coords;
  let polygon; // as it is drawn
  let weights; // squared radii
  let isDrawing = false;
  /** Where the next corner comes by the keyboard. */
  let cursor = Float64Array.of(WIDTH / 2, WIDTH / 4);

  const stage = new Stage(canvas, (context, color) => {
    const {scale} = stage;
    const share = Number(of("fade").value) / 100;
    context.globalAlpha = 1 - share;
    strokePath(context, edges(d, coords), color.delaunay, {scale});
    context.globalAlpha = share;
    const cells = d.voronoi([0, 0, WIDTH, stage.height]);
    if (weights) {
      power(context, color);
    } else if (polygon?.length > 2 && !isDrawing) {
      try {
        for (const rings of cells.clip([polygon])) for (const part of rings) ring(context, part, color.voronoi, 1.5, scale);
      } catch (error) {
        tell(`That polygon cannot be used: ${error.message}`, true);
      }
    } else {
      strokePath(context, new Path2D(cells.render() ?? ""), color.voronoi, {dash: [6, 4], width: 1.5, scale});
    }
    context.globalAlpha = 1;
    if (polygon) {
      ring(context, polygon, color.chosen, 2.5, scale);
      dots(context, Float64Array.from(polygon.flat()), color.chosen, 4 / scale);
    }
    if (isDrawing) dots(context, cursor, color.chosen, 6 / scale);
    dots(context, coords, color.ink, 3 / scale);
  });

  /** Cells of disks: where their borders meet, cells do. */
  function power(context, color) {
    const {scale} = stage;
    const diagram = new Power(coords, weights, [0, 0, WIDTH, stage.height]);
    const disks = new Path2D();
    weights.forEach((weight, i) => {
      const radius = Math.sqrt(weight);
      disks.moveTo(coords[2 * i] + radius, coords[2 * i + 1]);
      disks.arc(coords[2 * i], coords[2 * i + 1], radius, 0, 2 * Math.PI);
    });
    strokePath(context, disks, color.hull, {scale});
    for (const cell of diagram.cellPolygons()) ring(context, cell, color.voronoi, 1.5, scale);
    tell(`Power cells of disks; ${diagram.hidden.length || "no"} points have none.`);
  }

  function take(points) {
    d?.dispose();
    coords = points;
    d = new Delaunay(coords);
    const areas = d.voronoi([0, 0, WIDTH, stage.height]).areas();
    const mean = areas.reduce((a, b) => a + b, 0) / areas.length;
    const spread = Math.sqrt(areas.reduce((sum, x) => sum + (x - mean) ** 2, 0) / areas.length) / mean;
    tell(`${areas.length} cells; their areas differ by ${(100 * spread).toFixed(0)} % (standard deviation).`);
    stage.invalidate();
  }
  function setDrawing(is) {
    isDrawing = is;
    of("clip").setAttribute("aria-pressed", String(is));
  }
  let points = 120;
  const begin = (count = points) => {
    points = count;
    [polygon, weights] = [undefined, undefined];
    setDrawing(false);
    of("weights").value = 0;
    take(scatter(points, stage.height, 11, 10));
  };
  of("fade").addEventListener("input", () => stage.invalidate());
  of("weights").addEventListener("input", () => {
    const most = Number(of("weights").value);
    const next = random(5);
    weights = most ? Float64Array.from({length: coords.length / 2}, () => (most * next() ** 2) ** 2) : undefined;
    if (weights) stage.invalidate();
    else take(coords);
  });
  of("relax").addEventListener("click", () => take(d.voronoi([0, 0, WIDTH, stage.height]).relax()));
  of("reset").addEventListener("click", () => begin());
  of("clip").addEventListener("click", () => {
    setDrawing(!isDrawing);
    if (isDrawing) {
      polygon = [];
      tell("Tap the corners of a polygon, or move by arrows and press Enter for each; then press the button again.");
    } else if (polygon.length < 3) {
      polygon = undefined;
      tell("A polygon needs three corners.", true);
    } else tell(`Cells are cut by your polygon of ${polygon.length} corners.`);
    stage.invalidate();
  });
  canvas.addEventListener("pointerdown", (event) => {
    if (!isDrawing) return;
    polygon.push(stage.at(event));
    stage.invalidate();
  });
  canvas.addEventListener("keydown", (event) => {
    if (!isDrawing) return;
    const step = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
    if (step) cursor = Float64Array.of(cursor[0] + 20 * step[0], cursor[1] + 20 * step[1]);
    else if (event.key === "Enter") polygon.push([...cursor]);
    else if (event.key === "Escape") {
      polygon = undefined;
      setDrawing(false);
      tell("No polygon was drawn.");
    } else return;
    event.preventDefault();
    stage.invalidate();
  });
  draggable(section.querySelector(".number"), "points", (count) => begin(count));
  begin();
}
