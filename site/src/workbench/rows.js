// What files tell of each point: the columns of text, the properties of GeoJSON. Found when the pointer first asks.

/** Larger files are not read a second time for the sake of a few words below the pointer. In bytes. */
const LARGEST = 64 << 20;
/** Rows of a preview. */
const PREVIEW = 5;

export const isText = (name) => /\.(csv|tsv|txt|xyz|dat|pts)$/i.test(name);

/** Text in UTF-8, or else in Windows' Western letters, and which of both. */
function decoded(bytes) {
  try {
    return {text: new TextDecoder("utf-8", {fatal: true}).decode(bytes), encoding: "utf-8-sig"};
  } catch {
    return {text: new TextDecoder("windows-1252").decode(bytes), encoding: "cp1252"};
  }
}

const isNumber = (cell) => cell !== "" && Number.isFinite(Number(cell.replace(",", ".")));

/** What separates cells, by the first line that is no comment: the surest of those that are in it. */
function signOf(text) {
  const line = text.split(/\r\n|\r|\n/).find((line) => line.trim() && !/^\s*(#|\/\/)/.test(line)) ?? "";
  return [";", "\t", ","].find((sign) => line.replace(/"[^"]*"/g, "").includes(sign)) ?? " ";
}

/** Rows of cells. Quotes hold separators and ends of lines together; comments are passed over. At most so many rows. */
export function table(text, most = Infinity) {
  const sign = signOf(text);
  const rows = [];
  let row = [];
  let cell = "";
  let isQuoted = false;
  const endCell = () => {
    row.push(cell.trim());
    cell = "";
  };
  function endRow() {
    endCell();
    if (sign === " ") row = row.filter(Boolean);
    if (row.some(Boolean) && !/^(#|\/\/)/.test(row[0])) rows.push(row);
    row = [];
  }
  for (let at = 0; at < text.length && rows.length < most; at++) {
    const letter = text[at];
    if (isQuoted) {
      if (letter !== '"') cell += letter;
      else if (text[at + 1] === '"') cell += text[++at];
      else isQuoted = false;
    } else if (letter === '"' && !cell.trim()) isQuoted = true;
    else if (letter === "\n" || letter === "\r") {
      if (letter === "\r" && text[at + 1] === "\n") at++;
      endRow();
    } else if (letter === sign || (sign === " " && letter === "\t")) endCell();
    else cell += letter;
  }
  if (rows.length < most && (cell || row.length)) endRow();
  return rows;
}

/** Names of columns, or numbers from 1 where there are none, the first rows, and how they are written. */
export function preview(bytes) {
  const {text, encoding} = decoded(bytes);
  const rows = table(text, PREVIEW + 1);
  const [first = []] = rows;
  const hasHeading = first.length > 0 && !first.some(isNumber);
  return {
    names: hasHeading ? first : first.map((_, k) => String(k + 1)),
    rows: hasHeading ? rows.slice(1) : rows.slice(0, PREVIEW),
    hasHeading,
    encoding,
    sign: signOf(text),
  };
}

/** Something that tells the columns of a point of so many by its number: pairs of names and words. Nothing where that is not known. */
export function teller(name, bytes, count) {
  const nothing = () => [];
  if (!bytes || bytes.length > LARGEST) return nothing;
  const {text} = decoded(bytes);
  if (isText(name)) {
    const rows = table(text);
    // The heading is one row more, also where it consists of numbers.
    const skipped = rows.length - count;
    if (skipped !== 0 && skipped !== 1) return nothing;
    return (i) => (rows[i + skipped] ?? []).map((cell, k) => [skipped ? (rows[0][k] ?? String(k + 1)) : String(k + 1), cell]);
  }
  if (!/\.(geo)?json$/i.test(name)) return nothing;
  try {
    const {features = []} = JSON.parse(text);
    if (!features.every(({geometry}) => geometry?.type === "Point")) return nothing;
    return (i) => Object.entries(features[i]?.properties ?? {}).map(([key, value]) => [key, String(value)]);
  } catch {
    return nothing;
  }
}
