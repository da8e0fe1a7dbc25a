// Files that the program wrote, as flat arrays: meshes (PLY), places (WKB), indices (NPY), lines with heights (GeoJSON).

const SIZES = {char: 1, uchar: 1, short: 2, ushort: 2, int: 4, uint: 4, float: 4, double: 8};
const readers = {float: "getFloat32", double: "getFloat64", int: "getInt32", uint: "getUint32", uchar: "getUint8"};

/** The elements that the head of a PLY file tells, its format, and where the head ends. */
function headOf(bytes) {
  const head = new TextDecoder().decode(bytes.subarray(0, Math.min(bytes.length, 1 << 14)));
  const end = head.indexOf("end_header\n") + "end_header\n".length;
  const elements = [];
  let isText = false;
  for (const line of head.slice(0, end).split("\n")) {
    const words = line.split(" ");
    if (words[0] === "format") isText = words[1] === "ascii";
    if (words[0] === "element") elements.push({name: words[1], count: Number(words[2]), properties: []});
    if (words[0] === "property") elements.at(-1).properties.push({name: words.at(-1), type: words[1]});
  }
  return {elements, isText, end};
}

/** A mesh: coordinates by name, and the corners of its triangles. As the program writes it: in text, or binary and little-endian. */
export function ply(bytes) {
  const {elements, isText, end} = headOf(bytes);
  return isText ? textPly(bytes, elements, end) : binaryPly(bytes, elements, end);
}

function textPly(bytes, elements, end) {
  const lines = new TextDecoder().decode(bytes.subarray(end)).split("\n");
  const columns = {};
  let triangles = new Uint32Array(0);
  let first = 0;
  for (const {name, count, properties} of elements) {
    const rows = lines.slice(first, first + count).map((line) => line.split(" ").map(Number));
    first += count;
    if (name === "vertex") properties.forEach(({name}, k) => (columns[name] = Float64Array.from(rows, (row) => row[k])));
    else if (name === "face") triangles = Uint32Array.from(rows.flatMap((row) => row.slice(1, 4)));
  }
  return {...columns, triangles};
}

function binaryPly(bytes, elements, end) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const columns = {};
  let triangles = new Uint32Array(0);
  let at = end;
  for (const {name, count, properties} of elements) {
    if (name === "vertex") {
      const size = properties.reduce((sum, {type}) => sum + SIZES[type], 0);
      let offset = 0;
      for (const {name, type} of properties) {
        const column = (columns[name] = new Float64Array(count));
        const read = readers[type];
        if (type === "double") for (let i = 0; i < count; i++) column[i] = view.getFloat64(at + i * size + offset, true);
        else if (read) for (let i = 0; i < count; i++) column[i] = view[read](at + i * size + offset, true);
        offset += SIZES[type];
      }
      at += size * count;
    } else if (name === "face") {
      // The list of corners comes first, and may have numbers behind it.
      const more = properties.slice(1).reduce((sum, {type}) => sum + SIZES[type], 0);
      triangles = new Uint32Array(3 * count);
      for (let t = 0; t < 3 * count; t += 3) {
        triangles[t] = view.getUint32(at + 1, true);
        triangles[t + 1] = view.getUint32(at + 5, true);
        triangles[t + 2] = view.getUint32(at + 9, true);
        at += 1 + 4 * view.getUint8(at) + more;
      }
    }
  }
  return {...columns, triangles};
}

/** Indices, whatever the shape. */
export function npy(bytes) {
  const start = 10 + bytes[8] + 256 * bytes[9];
  const words = new Uint32Array(bytes.slice(start).buffer);
  return Uint32Array.from({length: words.length / 2}, (_, i) => words[2 * i]);
}

/** Numbers in a row that grows. */
class Row {
  #numbers = new Float64Array(1 << 12);
  length = 0;

  push(a, b) {
    if (this.length + 2 > this.#numbers.length) {
      const more = new Float64Array(2 * this.#numbers.length);
      more.set(this.#numbers);
      this.#numbers = more;
    }
    this.#numbers[this.length++] = a;
    this.#numbers[this.length++] = b;
  }

  all() {
    return this.#numbers.subarray(0, this.length);
  }
}

const POLYGON = 3;
const COLLECTIONS = [4, 5, 6, 7];

/**
 * Geometries one after the other: coordinates in a row, where each path ends among them, and the number of its feature. Paths of polygons are
 * rings, their last corner the first one again.
 */
export function wkb(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const [coords, ends, features] = [new Row(), [], []];
  let at = 0;
  const count = () => view.getUint32((at += 4) - 4, true);
  function path(feature, size) {
    for (let n = count(); n > 0; n--, at += size) coords.push(view.getFloat64(at, true), view.getFloat64(at + 8, true));
    ends.push(coords.length / 2);
    features.push(feature);
  }
  function geometry(feature) {
    at += 1;
    const type = count();
    // Heights and the system of coordinates, by the two conventions that there are.
    const kind = (type & 0xffff) % 1000;
    const size = type & 0x80000000 || (type & 0xffff) >= 1000 ? 24 : 16;
    if (type & 0x20000000) at += 4;
    if (COLLECTIONS.includes(kind)) for (let n = count(); n > 0; n--) geometry(feature);
    else if (kind === POLYGON) for (let n = count(); n > 0; n--) path(feature, size);
    else if (kind === 2) path(feature, size);
    else at += size;
  }
  for (let feature = 0; at < bytes.length; feature++) geometry(feature);
  return {coords: coords.all(), ends: Uint32Array.from(ends), features: Uint32Array.from(features)};
}

/** Lines and rings of features, as of `wkb`, with a height for each path if the features tell one. */
export function geojson(bytes) {
  const [coords, ends, features, heights] = [new Row(), [], [], []];
  const depth = {LineString: 1, MultiLineString: 2, Polygon: 2, MultiPolygon: 3};
  JSON.parse(new TextDecoder().decode(bytes)).features.forEach(({geometry, properties}, feature) => {
    const walk = (part, level) => {
      if (level > 1) return part.forEach((inner) => walk(inner, level - 1));
      for (const [x, y] of part) coords.push(x, y);
      ends.push(coords.length / 2);
      features.push(feature);
      heights.push(properties?.level ?? properties?.elevation ?? NaN);
    };
    if (depth[geometry?.type]) walk(geometry.coordinates, depth[geometry.type]);
  });
  return {coords: coords.all(), ends: Uint32Array.from(ends), features: Uint32Array.from(features), heights: Float64Array.from(heights)};
}
