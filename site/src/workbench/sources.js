// Where points come from besides files: sets of the program, text that is pasted, and samples.

import {load} from "../load.js";

/** Capitals of Europe, as people keep places: a number, a name, latitude before longitude. */
const CAPITALS = `id,name,lat,lon
1,Amsterdam,52.37,4.90
2,Athens,37.98,23.73
3,Belgrade,44.79,20.45
4,Berlin,52.52,13.40
5,Bern,46.95,7.45
6,Bratislava,48.15,17.11
7,Brussels,50.85,4.35
8,Bucharest,44.43,26.10
9,Budapest,47.50,19.04
10,Chisinau,47.01,28.86
11,Copenhagen,55.68,12.57
12,Dublin,53.35,-6.26
13,Helsinki,60.17,24.94
14,Kyiv,50.45,30.52
15,Lisbon,38.72,-9.14
16,Ljubljana,46.05,14.51
17,London,51.51,-0.13
18,Luxembourg,49.61,6.13
19,Madrid,40.42,-3.70
20,Minsk,53.90,27.56
21,Oslo,59.91,10.75
22,Paris,48.86,2.35
23,Prague,50.08,14.44
24,Riga,56.95,24.11
25,Rome,41.90,12.50
26,Sarajevo,43.86,18.41
27,Skopje,42.00,21.43
28,Sofia,42.70,23.32
29,Stockholm,59.33,18.07
30,Tallinn,59.44,24.75
31,Tirana,41.33,19.82
32,Vienna,48.21,16.37
33,Vilnius,54.69,25.28
34,Warsaw,52.23,21.01
35,Zagreb,45.81,15.98
`;

/** Samples by name: a title, views that suit them, and what gives the file. */
export const samples = {
  capitals: {title: "Addresses: capitals.csv", views: {cells: {}}, file: "capitals.csv", text: CAPITALS},
  lakes: {title: "Polygons: great_lakes.geojson", views: {mesh: {}}, file: "great_lakes.geojson"},
  terrain: {title: "Terrain: autzen_trim.laz", views: {triangles: {}}, fill: "shade", file: "autzen_trim.laz"},
};

async function sampled(name) {
  const sample = Object.hasOwn(samples, name) ? samples[name] : undefined;
  if (!sample) throw new Error(`there is no sample ${name}`);
  if (sample.text) return new Blob([sample.text]);
  await load("samples.js");
  return new Blob([Uint8Array.from(atob(globalThis.deloneSamples[sample.file]), (letter) => letter.charCodeAt(0))]);
}

/** What text seems to be, by how it begins. */
export function nameOfText(text) {
  if (/^\s*[[{]/.test(text)) return "pasted.geojson";
  if (/^\s*(SRID=\d+;)?\s*(MULTI)?(POINT|LINESTRING|POLYGON|GEOMETRYCOLLECTION)/i.test(text)) return "pasted.wkt";
  return "pasted.csv";
}

/**
 * The blobs of a source by name; `files` has those of the visitor. `generate` makes a set by the program. Without `files` of that name it is an
 * error that tells to drop them again.
 */
export async function blobsOf(source, files, generate) {
  if (source.kind === "text") return {[source.name]: new Blob([source.text])};
  if (source.kind === "sample") return {[samples[source.name]?.file ?? source.name]: await sampled(source.name)};
  if (source.kind === "set") {
    const name = `${source.name}.csv`;
    return {[name]: new Blob([await generate(["generate", source.name, "-n", source.count, "--seed", source.seed, "-o", name])])};
  }
  if (!files || !source.names.every((name) => Object.hasOwn(files, name))) {
    throw new Error(`the browser no longer has ${source.names.join(", ")}: drop it again`);
  }
  return Object.fromEntries(source.names.map((name) => [name, files[name]]));
}

/** A file with polygons that is beside files of points: the region of their cells. Nothing if there is none, or if it may be another one. */
export function regionOf(names) {
  const polygons = names.filter((name) => /\.(geo)?json(\.gz)?$|\.shp$|\.fgb$/i.test(name));
  const points = names.filter((name) => /\.(csv|tsv|txt|xyz|las|laz|npy|gpx)(\.gz)?$/i.test(name));
  return polygons.length === 1 && points.length ? polygons[0] : "";
}

/** Names that the program is given: files that it reads, without those that only go along (`.dbf`, `.prj`). */
export function inputsOf(names, readable) {
  const isReadable = (name) => readable.includes(name.toLowerCase().replace(/\.gz$/, "").split(".").at(-1));
  const found = names.filter(isReadable);
  return found.length ? found : names;
}
