// What files tell of each point: the columns of text, the properties of GeoJSON. Found when the pointer first asks.

/** Larger files are not read a second time for the sake of a few words below the pointer. In bytes. */
const LARGEST = 64 << 20;
/** Rows of a preview. */
const PREVIEW = 5;

const split = (line) => {
  const sign = [";", "\t", ","].find((sign) => line.includes(sign)) ?? /\s+/;
  const cells = [];
  // Quotes hold separators together.
  for (const part of line.trim().split(sign)) {
    if (cells.length && (cells.at(-1).match(/"/g) ?? []).length % 2) cells[cells.length - 1] += `${sign}${part}`;
    else cells.push(part);
  }
  return cells.map((cell) => cell.trim().replace(/^"(.*)"$/, "$1").replaceAll('""', '"'));
};

export const isText = (name) => /\.(csv|tsv|txt|xyz|dat|pts)$/i.test(name);

/** Lines that are no comments. */
const lines = (text) => text.split(/\r\n|\r|\n/).filter((line) => line.trim() && !/^\s*(#|\/\/)/.test(line));

const isNumber = (cell) => cell !== "" && Number.isFinite(Number(cell.replace(",", ".")));

/** Names of columns, or numbers from 1 where there are none, and the first rows. */
export function preview(text) {
  const rows = lines(text).slice(0, PREVIEW + 1).map(split);
  const [first = []] = rows;
  const hasHeading = first.length > 0 && !first.some(isNumber);
  return {names: hasHeading ? first : first.map((_, k) => String(k + 1)), rows: hasHeading ? rows.slice(1) : rows.slice(0, PREVIEW)};
}

/** Something that tells the columns of a point by its number: pairs of names and words. Nothing where that is not known. */
export function teller(name, bytes) {
  const nothing = () => [];
  if (!bytes || bytes.length > LARGEST) return nothing;
  const text = () => new TextDecoder().decode(bytes);
  if (isText(name)) {
    const all = lines(text());
    const {names, rows} = preview(all.slice(0, 2).join("\n"));
    const skipped = all.length > 1 && rows.length < 2 ? 1 : 0;
    return (i) => (all[i + skipped] ? split(all[i + skipped]).map((cell, k) => [names[k] ?? String(k + 1), cell]) : []);
  }
  if (!/\.(geo)?json$/i.test(name)) return nothing;
  try {
    const {features = []} = JSON.parse(text());
    if (!features.every(({geometry}) => geometry?.type === "Point")) return nothing;
    return (i) => Object.entries(features[i]?.properties ?? {}).map(([key, value]) => [key, String(value)]);
  } catch {
    return nothing;
  }
}
