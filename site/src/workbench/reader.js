// Opens a source: its files, the program's triangulation of all points, and what is known of them.

import {preview} from "./rows.js";
import {blobsOf, inputsOf} from "./sources.js";
import {wordsOf} from "./views.js";

/** Files that the stage reads. Names of visitors' files do not begin with a dot. */
export const STAGE = ".stage";
const STATS = ".stats.json";
/** Bytes of a file that a preview looks at. */
const HEAD = 1 << 14;

/** Runs a command again with lines split where they cross, if that is what it failed for. `read` then says so. */
export async function split(read, act) {
  try {
    return await act();
  } catch (error) {
    if (read.crossings || !/cross/.test(error.message)) throw error;
    read.crossings = "split";
    return act();
  }
}

/** Coordinates that are degrees: of formats that say so, and of columns that are called so. */
const isDegrees = (name, columns) =>
  /\.(geojson|json|gpx)(\.gz)?$/i.test(name) || columns.some((column) => /^(lon|lng|lat|länge|laenge|breite|geogr|lengte|breedte|długość|szerokość|долгота|широта|[经経纬緯]度)/i.test(column));

/** The head of a file, up to the end of a line. */
async function headOf(blob) {
  const bytes = new Uint8Array(await blob.slice(0, HEAD).arrayBuffer());
  const end = blob.size > HEAD ? bytes.lastIndexOf(10) + 1 : bytes.length;
  return preview(bytes.subarray(0, end));
}

/** What the program says in a line of counts. */
export const toldBy = ({errors}) => errors.find((line) => /^\d/.test(line)) ?? "";

/**
 * Opens a source as `read` says. `files` are the visitor's; `tell` hears what is done; `look` hears of the files before they are read, so that
 * how they are read can be chosen even if that fails.
 */
export async function open({source, read}, {engine, files, formats, tell, look}) {
  const start = performance.now();
  let generated;
  if (source.kind === "set" && !formats.sets.includes(source.name)) throw new Error(`there is no set ${source.name}`);
  const blobs = await blobsOf(source, files, async (words) => {
    generated = words;
    await engine.open({});
    return (await engine.run(words)).written[words.at(-1)];
  });
  const readable = inputsOf(Object.keys(blobs), formats.inputs);
  if (!readable.includes(read.region)) read.region = "";
  const names = readable.filter((name) => name !== read.region);
  if (!names.length) throw new Error("the region is the only file: there are no points");
  const head = await headOf(blobs[names[0]]);
  look(names, readable, head);
  await engine.open(blobs);
  tell(`${listed(names)}: triangulating …`);
  const made = await split(read, () => engine.run([...wordsOf("triangles", {}, names, read), "-o", `${STAGE}.ply`, "--stats", STATS]));
  const stats = JSON.parse(new TextDecoder().decode(made.written[STATS]));
  if (!stats.points) throw new Error(`${listed(names)}: there are no points in it`);
  const columns = made.notes.map((note) => /columns (.*) were taken as x, y/.exec(note)?.[1]).find(Boolean)?.split(", ") ?? [];
  const byName = ["x", "y", "z"].filter((role) => head.names.includes(role));
  return {
    names,
    readable,
    blobs,
    head,
    generated,
    bytes: made.written[`${STAGE}.ply`],
    columns: read.columns ? read.columns.split(",") : columns.length ? columns : byName,
    isGeographic: isDegrees(names[0], columns),
    isLines: Boolean(stats.segments),
    notes: made.notes,
    told: toldBy(made),
    engine: made.ms,
    begun: start,
    made: new Map(),
  };
}

/** Names of files, or how many they are. */
export const listed = (names) => (names.length > 3 ? `${names.length} files` : names.join(", "));
