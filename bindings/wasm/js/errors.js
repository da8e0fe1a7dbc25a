// What can go wrong, in words. The module gives a code and numbers (src/fault.rs), and so formats no text.

const axis = (k) => (k === 0 ? "x" : "y");
const problems = [
  "a coordinate is not finite",
  "there is no area inside",
  "the ring comes here a second time",
  "the side from here crosses or touches another one",
];

/** For each number of the module: a code, the words, and the index that is to blame if there is one. */
const faults = [
  ["internal", () => "this should not have happened"],
  ["disposed", () => "the triangulation was disposed of"],
  ["flaw", () => "the triangulation is not the canonical one"],
  ["memory", (bytes) => `there is no memory for about ${Math.ceil(bytes / 2 ** 20)} megabytes; dispose of triangulations that are not needed`],
  ["not-finite", (i, k, value) => `point ${i} has the ${axis(k)} coordinate ${value}, which is not finite`, (i) => i],
  ["not-finite", (k, value) => `the ${axis(k)} coordinate ${value} is not finite`],
  ["too-many-points", (count, most) => `${count} points are more than the ${most} that one triangulation holds`],
  ["no-such-point", (i) => `point ${i} is no vertex of this triangulation`, (i) => i],
  ["occupied", (i) => `point ${i} is there already`, (i) => i],
  ["no-such-point", (s, i, count) => `segment ${s} ends at point ${i}, and there are ${count} points, counted from 0`, (s) => s],
  ["segments-cross", (s, t, x, y, count) => `segments ${s} and ${t} cross near (${x}, ${y})${count > 1 ? `, and so do ${count - 1} other pairs` : ""}`, (s) => s],
  ["no-length", (i) => `a segment from point ${i} to itself has no length`, (i) => i],
  ["no-such-segment", (s) => `there is no segment ${s} in this triangulation`, (s) => s],
  ["constraints-end", (i, count) => `${count} segments end or meet at point ${i}`, (i) => i],
  ["range", (value) => `${value} is out of range`],
  ["region", (ring, corner, problem) => `ring ${ring} of the region, at corner ${corner}: ${problems[problem]}`, (ring) => ring],
  ["not-finite", (i, value) => `point ${i} has the value ${value}, which is not finite`, (i) => i],
  ["values", (expected, found) => `${found} values where there should be ${expected}`],
  ["not-finite", (i, value) => `point ${i} has the weight ${value}, which is not finite`, (i) => i],
];

/** Anything as text; some things cannot be. */
export function shown(value) {
  try {
    return String(value);
  } catch {
    return typeof value;
  }
}

/** Everything that this package throws. */
export class DeloneError extends Error {
  /**
   * @param {string} code what is wrong, for programs
   * @param {string} message the same, for people
   * @param {number} [index] the point (or segment, or ring) that is to blame
   */
  constructor(code, message, index) {
    super(message);
    this.name = "DeloneError";
    this.code = code;
    if (index !== undefined) this.index = index;
  }
}

/** The fault that the module has just told, its points named as the user names them. */
export function fault(exports, name = (i) => i) {
  const [code, words, index] = faults[exports.fault_code()] ?? faults[0];
  const facts = [0, 1, 2, 3, 4].map((k) => exports.fault_fact(k));
  // In these the first number is a point.
  if (index && !code.includes("segment") && code !== "region" && words.length !== 3 || code === "not-finite" && index) {
    facts[0] = name(facts[0]);
  }
  return new DeloneError(code, words(...facts), index?.(...facts));
}
