// Columns of text: x, y, and whatever else. What separates them is found line by line; a line that can be read in two ways is refused.

/** What may separate cells, the surest first. Beside semicolons a comma is a decimal comma. */
const ways = [{sign: /;/, hasDecimalCommas: true}, {sign: /,/}, {sign: /\t/}, {sign: /\s+|$/}];

/** What may be a number, several of them, or one with its thousands set apart. */
const LIKE_NUMBERS = /^[-+\d.,e\s]*$/i;

function value(cell, hasDecimalCommas) {
  const text = cell.trim();
  if (!text) return NaN;
  return Number(hasDecimalCommas ? text.replace(",", ".") : text);
}

/**
 * The first two cells of a line as a `place`, with the `marks` of their decimals if these could be either. Without a place: whether the
 * cells are words, neither of them a number in any way.
 */
function cellsOf(line) {
  let areWords = true;
  for (const {sign, hasDecimalCommas} of ways) {
    const at = line.search(sign);
    if (at < 0) continue;
    const cells = line.split(sign, 2);
    const [x, y = NaN] = cells.map((cell) => value(cell, hasDecimalCommas));
    if (Number.isFinite(x) && Number.isFinite(y)) {
      return {place: [x, y], marks: (hasDecimalCommas && cells.join("").match(/[.,]/g)) || []};
    }
    areWords &&= Number.isNaN(x) && Number.isNaN(y);
    // This sign may be a part of a text further right, but not of what looks like numbers: "1,234,567;8" is not at (1, 234).
    if (LIKE_NUMBERS.test(line.slice(0, at))) break;
  }
  return {areWords};
}

/** The points of a text, which may begin with a heading: a first row of words. */
export function columns(text) {
  const coords = [];
  const marks = new Set();
  let isFirst = true;
  for (const [index, whole] of text.split(/\r\n|\r|\n/).entries()) {
    // A tab at the beginning is an empty cell.
    const line = whole.replace(/^ +/, "");
    if (!line.trim() || line.startsWith("#")) continue;
    const found = cellsOf(line);
    const isHeading = isFirst && found.areWords;
    isFirst = false;
    if (isHeading) continue;
    if (!found.place) throw new Error(`line ${index + 1}: x and y are expected, not "${line.slice(0, 40)}"`);
    for (const mark of found.marks) marks.add(mark);
    if (marks.size > 1) throw new Error(`line ${index + 1}: decimal commas and points are mixed in this file`);
    coords.push(...found.place);
  }
  if (!coords.length) throw new Error("there are no points in this file");
  return {coords: Float64Array.from(coords)};
}
