// The thread that holds what is seen: it paints pictures and tells what is below the pointer, while the program works in another one.

import {Delaunay} from "delone";
import {answer} from "../answer.js";
import {geojson, npy, ply, wkb} from "./outputs.js";
import {Scene} from "./scene.js";

const scene = new Scene();
/** Finds the nearest point; made when it is first asked for. */
let finder;

function forget() {
  finder?.dispose();
  finder = undefined;
}

const tasks = {
  /** Begins with a mesh of all points. */
  begin({bytes, isGeographic}) {
    forget();
    scene.begin(bytes ? ply(bytes) : {triangles: new Uint32Array(0)}, isGeographic);
    const {heights} = scene;
    return {points: scene.x.length, triangles: scene.get("triangles").triangles.length / 3, frame: scene.frame, box: scene.frame.box, heights};
  },

  /** Takes the output of a view. */
  layer({name, format, bytes, isFilled}) {
    if (format === "ply") scene.addMesh(name, ply(bytes));
    else if (format === "npy") scene.addIndices(name, npy(bytes), name === "hull");
    else scene.addPaths(name, (format === "wkb" ? wkb : geojson)(bytes), isFilled);
    const {ends, pairs, triangles} = scene.get(name);
    return {count: ends?.length ?? triangles?.length / 3 ?? pairs.length / 2};
  },

  /** The coordinates of few points, as they came. */
  points: () => ({coords: Float64Array.from(scene.points, (_, k) => (k % 2 ? scene.y : scene.x)[k >> 1])}),

  drop({name}) {
    scene.drop(name);
    return {};
  },

  complete() {
    const isOther = scene.complete();
    // The points may have other numbers now.
    if (isOther) forget();
    return {isOther};
  },

  paint({width, height, view, look}) {
    const start = performance.now();
    const bytes = scene.paint(width, height, view, look);
    return {bytes, width, height, view, ms: performance.now() - start, transfer: [bytes.buffer]};
  },

  /** The nearest point, and the triangle and the area at a place, as shares and as they came. */
  pick({x, y, reach, shown}) {
    if (!scene.points?.length) return {};
    // Nearness is that of the program, for which degrees are as wide as high.
    const {aspect} = scene.frame;
    finder ??= new Delaunay(aspect === 1 ? scene.points : scene.points.map((share, k) => (k % 2 ? share : share / aspect)));
    const i = finder.find(x / aspect, y);
    const {points} = scene;
    const isNear = i >= 0 && Math.hypot(points[2 * i] - x, points[2 * i + 1] - y) <= reach;
    const found = {isNear};
    if (i >= 0) {
      const name = scene.nameOf(scene, i);
      found.point = {i: name, at: [points[2 * i], points[2 * i + 1]], place: [scene.x[name], scene.y[name]], height: scene.z?.[name]};
    }
    const mesh = ["mesh", "triangles"].map((name) => shown.includes(name) && scene.get(name)).find(Boolean);
    if (mesh) found.triangle = triangleAt(mesh, x, y);
    const name = ["cells", "alpha"].find((name) => shown.includes(name) && scene.get(name));
    const area = name && areaAt(scene.get(name), x, y);
    if (area) found.area = {name, ...area};
    return found;
  },
};

function triangleAt(mesh, x, y) {
  const {points, triangles} = mesh;
  const at = (i) => [points[2 * i], points[2 * i + 1]];
  const turn = ([ax, ay], [bx, by]) => (bx - ax) * (y - ay) - (by - ay) * (x - ax);
  for (let t = 0; t < triangles.length; t += 3) {
    const [ax, bx, cx] = [points[2 * triangles[t]], points[2 * triangles[t + 1]], points[2 * triangles[t + 2]]];
    if ((ax < x && bx < x && cx < x) || (ax > x && bx > x && cx > x)) continue;
    const corners = [at(triangles[t]), at(triangles[t + 1]), at(triangles[t + 2])];
    if (turn(corners[0], corners[1]) < 0 || turn(corners[1], corners[2]) < 0 || turn(corners[2], corners[0]) < 0) continue;
    return {number: t / 3, indices: Array.from(triangles.subarray(t, t + 3), (k) => scene.nameOf(mesh, k)), corners};
  }
  return undefined;
}

/** The rings of the feature that a place is in, by the number of times that a ray to the right crosses them. */
function areaAt({points, ends, features}, x, y) {
  let start = 0;
  let inside = -1;
  for (let k = 0; k < ends.length && inside < 0; k++) {
    let isIn = false;
    for (let i = start; i + 1 < ends[k]; i++) {
      const [ay, by] = [points[2 * i + 1], points[2 * i + 3]];
      if (ay > y === by > y) continue;
      if (points[2 * i] + ((y - ay) / (by - ay)) * (points[2 * i + 2] - points[2 * i]) > x) isIn = !isIn;
    }
    if (isIn) inside = features[k];
    start = ends[k];
  }
  if (inside < 0) return undefined;
  const rings = [];
  ends.forEach((end, k) => {
    if (features[k] !== inside) return;
    rings.push(Array.from({length: end - (k ? ends[k - 1] : 0)}, (_, i) => [points[2 * ((k ? ends[k - 1] : 0) + i)], points[2 * ((k ? ends[k - 1] : 0) + i) + 1]]));
  });
  return {number: inside, rings};
}

answer(tasks);
