// Decompresses the module that is inside of the package: RFC 1951, "DEFLATE". Browsers can do it too, but not while a script waits.

/** Lengths and distances: the least of each code, and how many more bits tell it exactly (RFC 1951, 3.2.5). */
function steps(first, groups, count) {
  const table = [];
  let value = first;
  for (let code = 0; code < count; ++code) {
    const extra = Math.max(0, Math.floor(code / groups) - 1);
    table.push([value, extra]);
    value += 1 << extra;
  }
  return table;
}
const lengths = [...steps(3, 4, 28), [258, 0]];
const distances = steps(1, 2, 30);
/** The order in which lengths of the code of codes are written. */
const order = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];

/** Canonical Huffman codes: how many there are of each length, and their symbols in order. */
function codes(sizes) {
  const counts = new Uint16Array(16);
  for (const size of sizes) ++counts[size];
  counts[0] = 0;
  const starts = new Uint16Array(16);
  for (let size = 1; size < 15; ++size) starts[size + 1] = starts[size] + counts[size];
  const symbols = new Uint16Array(sizes.length);
  sizes.forEach((size, symbol) => size && (symbols[starts[size]++] = symbol));
  return {counts, symbols};
}

const fixed = [
  codes(Array.from({length: 288}, (_, k) => (k < 144 ? 8 : k < 256 ? 9 : k < 280 ? 7 : 8))),
  codes(Array(30).fill(5)),
];

const damaged = () => new Error("the module inside of the package is damaged");

/** The bytes of a raw deflate stream that become so many. */
export function inflate(bytes, size) {
  const out = new Uint8Array(size);
  let [at, byte, bit] = [0, 0, 0];

  const bits = (count) => {
    let value = 0;
    for (let k = 0; k < count; ++k) {
      value |= ((bytes[byte] >> bit) & 1) << k;
      if (++bit === 8) [bit, byte] = [0, byte + 1];
    }
    return value;
  };

  const symbol = ({counts, symbols}) => {
    let [code, first, index] = [0, 0, 0];
    for (let size = 1; size < 16; ++size) {
      code |= (bytes[byte] >> bit) & 1;
      if (++bit === 8) {
        bit = 0;
        ++byte;
      }
      if (code - first < counts[size]) return symbols[index + code - first];
      index += counts[size];
      first = (first + counts[size]) << 1;
      code <<= 1;
    }
    throw damaged();
  };

  const written = () => {
    const [literals, far, few] = [bits(5) + 257, bits(5) + 1, bits(4) + 4];
    const sizes = Array(19).fill(0);
    for (let k = 0; k < few; ++k) sizes[order[k]] = bits(3);
    const code = codes(sizes);
    const all = [];
    while (all.length < literals + far) {
      const s = symbol(code);
      if (s < 16) all.push(s);
      else if (s === 16) for (let k = 3 + bits(2), last = all[all.length - 1]; k; --k) all.push(last);
      else for (let k = s === 17 ? 3 + bits(3) : 11 + bits(7); k; --k) all.push(0);
    }
    return [codes(all.slice(0, literals)), codes(all.slice(literals))];
  };

  for (let isLast = 0; !isLast; ) {
    if (byte > bytes.length) throw damaged();
    isLast = bits(1);
    const kind = bits(2);
    if (kind === 0) {
      if (bit) [bit, byte] = [0, byte + 1];
      const count = bits(16);
      byte += 2;
      out.set(bytes.subarray(byte, byte + count), at);
      at += count;
      byte += count;
      continue;
    }
    const [literal, far] = kind === 1 ? fixed : written();
    for (let s; (s = symbol(literal)) !== 256; ) {
      if (byte > bytes.length || at > size) throw damaged();
      if (s < 256) {
        out[at++] = s;
        continue;
      }
      const [length, more] = lengths[s - 257];
      const count = length + bits(more);
      const [distance, further] = distances[symbol(far)];
      let from = at - distance - bits(further);
      for (let k = 0; k < count; ++k) out[at++] = out[from++];
    }
  }
  if (at !== size) throw damaged();
  return out;
}
