// Finds the data of a module that no instruction reads.
//
// What panics and formats was emptied (shrink.mjs), and what it said is left: places in the source and tables of digits, a third of it
// incompressible. A linker that writes relocations (`--emit-relocs`) says where each piece of data is, which addresses of it are in the code,
// and which piece holds the address of which other. A piece is read if one of its addresses is still in the code that was optimized, or if a
// piece that is read holds one. Addresses that are in the code and that nobody knows keep the piece that they are in.

/** Kinds of relocations: addresses in memory in one of three spellings; places in functions and sections; indices of several kinds. */
const [ADDRESS, ADDRESS_SIGNED, ADDRESS_FIXED] = [3, 4, 5];
const PLACES = [8, 9];
const INDICES = [0, 1, 2, 6, 7, 10, 13, 20, 26];
/** Sections, and the table of symbols in that of the linker. */
const [CUSTOM, DATA, SYMBOLS] = [0, 11, 8];
/** Kinds of symbols, and two of their flags: not defined here, and named though they are not. */
const [IS_DATA, IS_SECTION, UNDEFINED, NAMED] = [1, 3, 0x10, 0x40];

/** Reads numbers as modules have them. */
function reader(bytes, at = 0) {
  const unsigned = () => {
    let [value, factor, byte] = [0, 1, 0];
    do {
      byte = bytes[at++];
      value += (byte & 127) * factor;
      factor *= 128;
    } while (byte & 128);
    return value;
  };
  const signed = () => {
    const from = at;
    const value = unsigned();
    const size = 128 ** (at - from);
    return value * 2 >= size ? value - size : value;
  };
  const fixed = () => new DataView(bytes.buffer, bytes.byteOffset).getUint32(at, true);
  const text = () => {
    const length = unsigned();
    return new TextDecoder().decode(bytes.subarray(at, (at += length)));
  };
  return {unsigned, signed, fixed, text, at: () => at, to: (place) => (at = place)};
}

/** The sections of a module in their order: kind, name, where their head, their content and what follows the name begin, and the end. */
function sections(bytes) {
  const found = [];
  const read = reader(bytes, 8);
  while (read.at() < bytes.length) {
    const before = read.at();
    const kind = read.unsigned();
    const size = read.unsigned();
    const [start, end] = [read.at(), read.at() + size];
    const name = kind === CUSTOM ? read.text() : "";
    found.push({kind, name, before, start, from: read.at(), end});
    read.to(end);
  }
  return found;
}

/** The segments of data of a module: address in memory, place in the file, size. */
function segments(bytes) {
  const section = sections(bytes).find(({kind}) => kind === DATA);
  if (!section) return [];
  const read = reader(bytes, section.from);
  return Array.from({length: read.unsigned()}, () => {
    read.unsigned(); // active, in the first memory
    read.unsigned(); // i32.const
    const address = read.signed();
    read.unsigned(); // end
    const size = read.unsigned();
    const place = read.at();
    read.to(place + size);
    return {address, place, size, inSection: place - section.start};
  });
}

/** The pieces of data of a module as it was linked, each with those that it holds addresses of, and the addresses in its code. */
function pieces(bytes) {
  const all = sections(bytes);
  const parts = segments(bytes);
  const linking = all.find(({name}) => name === "linking");
  if (!linking) throw new Error("the module has no relocations");
  const symbols = [];
  const read = reader(bytes, linking.from);
  read.unsigned(); // version
  while (read.at() < linking.end) {
    const kind = read.unsigned();
    const size = read.unsigned();
    const end = read.at() + size;
    if (kind === SYMBOLS) {
      for (let count = read.unsigned(); count > 0; --count) {
        const [what, flags] = [read.unsigned(), read.unsigned()];
        let piece = null;
        if (what === IS_DATA) {
          read.text();
          if (!(flags & UNDEFINED)) {
            const [segment, offset, length] = [read.unsigned(), read.unsigned(), read.unsigned()];
            // What begins as zeros has no segment.
            if (parts[segment]) piece = {address: parts[segment].address + offset, size: length, isRead: false, holds: []};
          }
        } else {
          read.unsigned();
          if (what !== IS_SECTION && (!(flags & UNDEFINED) || flags & NAMED)) read.text();
        }
        symbols.push(piece);
      }
    }
    read.to(end);
  }
  const found = symbols.filter((piece) => piece);
  const inCode = [];
  for (const section of all.filter(({name}) => name.startsWith("reloc."))) {
    read.to(section.from);
    const target = all[read.unsigned()];
    for (let count = read.unsigned(); count > 0; --count) {
      const [kind, place, symbol] = [read.unsigned(), read.unsigned(), read.unsigned()];
      if (INDICES.includes(kind)) continue;
      const addend = read.signed();
      if (PLACES.includes(kind)) continue;
      const written = reader(bytes, target.start + place);
      const spellings = {[ADDRESS]: written.unsigned, [ADDRESS_SIGNED]: written.signed, [ADDRESS_FIXED]: written.fixed};
      const piece = symbols[symbol];
      if (!spellings[kind]) throw new Error(`a relocation of an unknown kind, ${kind}`);
      if (!piece) continue;
      const address = piece.address + addend;
      if (spellings[kind]() !== address) throw new Error("a relocation is not what is written");
      if (target.kind === DATA) {
        const part = parts.find(({inSection, size}) => place >= inSection && place < inSection + size);
        const at = part.address + place - part.inSection;
        for (const holder of found.filter(holds(at))) holder.holds.push(piece);
      } else {
        inCode.push({piece, address});
      }
    }
  }
  return {found, inCode};
}

const holds = (address) => (piece) => address >= piece.address && address < piece.address + piece.size;

/** A module without what the linker wrote for this file alone. */
export function withoutRelocations(bytes) {
  const extra = sections(bytes).filter(({name}) => name === "linking" || name.startsWith("reloc."));
  const kept = [];
  let from = 0;
  for (const {before, end} of extra) {
    kept.push(bytes.subarray(from, before));
    from = end;
  }
  return Buffer.concat([...kept, bytes.subarray(from)]);
}

/** Fills with zeros what is not read, in the bytes of an optimized module: `linked` is what was linked, `text` the optimized one as text. */
export function clearUnread(linked, optimized, text) {
  const {found, inCode} = pieces(linked);
  const pending = [];
  // Where a segment begins is no use of it.
  const code = text.replace(/^ \(data .*$/gm, "");
  for (const [, number] of code.matchAll(/(?:i32\.const |offset=)(\d+)/g)) {
    const address = Number(number);
    pending.push(...inCode.filter((known) => known.address === address).map(({piece}) => piece), ...found.filter(holds(address)));
  }
  while (pending.length) {
    const piece = pending.pop();
    if (piece.isRead) continue;
    piece.isRead = true;
    pending.push(...piece.holds);
  }
  // Strings may share their ends.
  const [read, unread] = [found.filter(({isRead}) => isRead), found.filter(({isRead}) => !isRead)];
  const isNeeded = (address) => !unread.some((piece) => holds(address)(piece)) || read.some((piece) => holds(address)(piece));
  for (const {address, place, size} of segments(optimized)) {
    for (let k = 0; k < size; ++k) if (!isNeeded(address + k)) optimized[place + k] = 0;
  }
}
