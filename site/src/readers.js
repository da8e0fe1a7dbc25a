// Points of files: columns of text, GeoJSON, LAS and LAZ. Each gives {coords}, or throws what is wrong and where.

import {columns} from "./columns.js";
import {load} from "./load.js";

/** Reads a file by its name and its first bytes. */
export async function read(file) {
  const buffer = await file.arrayBuffer();
  const bytes = new Uint8Array(buffer);
  if (!bytes.length) throw new Error(`${file.name} is empty`);
  const begins = (text) => [...text].every((c, i) => bytes[i] === c.charCodeAt(0));
  if (begins("LASF")) return las(buffer);
  if (begins("\x89PNG") || begins("PK") || begins("\xff\xd8") || bytes.subarray(0, 2000).includes(0)) {
    throw new Error(`${file.name} is neither text nor LAS`);
  }
  const text = new TextDecoder().decode(bytes);
  return /^\s*[{[]/.test(text) ? geojson(text) : columns(text);
}

/** All positions of a GeoJSON object. */
export function geojson(text) {
  let object;
  try {
    object = JSON.parse(text);
  } catch (error) {
    throw new Error(`this is no JSON: ${error.message}`);
  }
  const coords = [];
  const visit = (item) => {
    if (Array.isArray(item)) {
      if (typeof item[0] === "number") {
        if (!Number.isFinite(item[0]) || !Number.isFinite(item[1])) throw new Error(`position ${coords.length / 2} is not two numbers`);
        coords.push(item[0], item[1]);
      } else item.forEach(visit);
    } else if (item && typeof item === "object") {
      for (const key of ["features", "geometry", "geometries", "coordinates"]) if (item[key]) visit(item[key]);
    }
  };
  visit(object);
  if (!coords.length) throw new Error("there are no positions in this GeoJSON");
  return {coords: Float64Array.from(coords)};
}

/** A point cloud: ground points, if there are any. */
async function las(buffer) {
  await load("laz.js");
  const {readLas} = globalThis.Laz;
  const ground = readLas(buffer, {classes: [2]});
  return ground.coords.length ? ground : readLas(buffer);
}
