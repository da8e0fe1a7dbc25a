//! Changes of the bytes of a file.

use delone_generators::Random;

/// A change. Places are fractions of the file, so that they mean something whatever was changed before.
#[derive(Clone, Debug)]
pub(crate) enum Mutation {
    /// One bit is another.
    Flip { place: f64, bit: u8 },
    /// One byte is this.
    Byte { place: f64, value: u8 },
    /// A number of so many bytes, little or big endian, is this.
    Number { place: f64, value: u64, bytes: usize, big: bool },
    /// A piece of text is put in, or put over what was there.
    Text { place: f64, text: &'static str, over: bool },
    /// The file ends here.
    Cut { place: f64 },
    /// Bytes are missing.
    Remove { place: f64, bytes: usize },
    /// Bytes are repeated.
    Repeat { place: f64, bytes: usize, times: usize },
    /// Bytes are overwritten by those of another place.
    Copy { from: f64, to: f64, bytes: usize },
    /// The rest is that of another file.
    Splice { place: f64, other: usize, from: f64 },
    /// Bytes without meaning follow.
    Tail { bytes: usize },
}

/// Numbers that lengths and counts must not be.
const NUMBERS: [u64; 16] = [
    0,
    1,
    2,
    0x7f,
    0xff,
    0x7fff,
    0xffff,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_fffe,
    0xffff_ffff,
    1 << 40,
    i64::MAX as u64,
    1 << 63,
    u64::MAX - 1,
    u64::MAX,
];

/// Text that fields and headers must not be.
const TEXTS: [&str; 34] = [
    "nan",
    "inf",
    "-inf",
    "1e999",
    "-",
    "+",
    ".",
    "1e",
    "0x10",
    "1_000",
    "1,5",
    ";",
    ",",
    "\"",
    "\"\"",
    "\n",
    "\r",
    "\r\n",
    "\0",
    "#",
    "\u{feff}",
    " ",
    "\t",
    "99999999999999999999",
    "-1",
    "1099511627776",
    "{",
    "[",
    "null",
    "POINT (",
    "property list uchar",
    "element vertex 4000000000\n",
    "\u{1e}",
    "(((((((((((((((((((((((",
];

/// A few changes.
pub(crate) fn some(random: &mut Random) -> Vec<Mutation> {
    let most = one_of(random, &[1, 2, 4, 12]);
    let count = 1 + random.below(most);
    (0..count).map(|_| one(random)).collect()
}

fn one_of<T: Copy>(random: &mut Random, all: &[T]) -> T {
    all[random.below(all.len())]
}

fn one(random: &mut Random) -> Mutation {
    // What a file says of itself is at its beginning, often.
    let mut place = || match random.below(3) {
        0 => random.unit().powi(4),
        1 => random.unit() * 0.02,
        _ => random.unit(),
    };
    let (place, to) = (place(), place());
    let most = one_of(random, &[4, 30, 400]);
    let bytes = 1 + random.below(most);
    let times = one_of(random, &[3, 300]);
    match random.below(14) {
        0 | 1 => Mutation::Flip { place, bit: random.below(8) as u8 },
        2 | 3 => Mutation::Byte { place, value: random.bits() as u8 },
        4..=6 => {
            let value = if random.below(4) == 0 { random.bits() } else { one_of(random, &NUMBERS) };
            Mutation::Number {
                place,
                value,
                bytes: one_of(random, &[1, 2, 4, 4, 8]),
                big: random.below(6) == 0,
            }
        }
        7 | 8 => Mutation::Text { place, text: one_of(random, &TEXTS), over: random.below(2) == 0 },
        9 => Mutation::Cut { place: to },
        10 => Mutation::Remove { place, bytes },
        11 => Mutation::Repeat { place, bytes, times: 1 + random.below(times) },
        12 => Mutation::Copy { from: to, to: place, bytes },
        _ => match random.below(2) {
            0 => Mutation::Splice { place, other: random.bits() as usize, from: to },
            _ => Mutation::Tail { bytes },
        },
    }
}

impl Mutation {
    /// Changes a file; `others` are those that it may take parts of.
    pub(super) fn apply(&self, file: &mut Vec<u8>, others: &[&[u8]]) {
        let at = |place: f64, length: usize| ((place * length as f64) as usize).min(length.saturating_sub(1));
        let length = file.len();
        if length == 0 {
            return;
        }
        match *self {
            Self::Flip { place, bit } => file[at(place, length)] ^= 1 << bit,
            Self::Byte { place, value } => file[at(place, length)] = value,
            Self::Number { place, value, bytes, big } => {
                let mut number = value.to_le_bytes()[..bytes].to_vec();
                if big {
                    number.reverse();
                }
                let at = at(place, length);
                number.iter().zip(&mut file[at..]).for_each(|(from, to)| *to = *from);
            }
            Self::Text { place, text, over } => {
                let at = at(place, length);
                let end = if over { (at + text.len()).min(length) } else { at };
                file.splice(at..end, text.bytes());
            }
            Self::Cut { place } => file.truncate(at(place, length)),
            Self::Remove { place, bytes } => {
                let at = at(place, length);
                file.drain(at..(at + bytes).min(length));
            }
            Self::Repeat { place, bytes, times } => {
                let at = at(place, length);
                let piece = file[at..(at + bytes).min(length)].to_vec();
                file.splice(at..at, piece.repeat(times));
            }
            Self::Copy { from, to, bytes } => {
                let from = at(from, length);
                let piece = file[from..(from + bytes).min(length)].to_vec();
                let at = at(to, length);
                piece.iter().zip(&mut file[at..]).for_each(|(from, to)| *to = *from);
            }
            Self::Splice { place, other, from } => {
                let other = others[other % others.len()];
                file.truncate(at(place, length));
                file.extend_from_slice(&other[at(from, other.len())..]);
            }
            Self::Tail { bytes } => {
                let mut random = Random::new(bytes as u64);
                file.extend((0..bytes).map(|_| random.bits() as u8));
            }
        }
    }
}
