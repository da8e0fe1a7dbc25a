//! Dimensions of records besides coordinates: those of the format, and those that extra bytes describe.
//!
//! Source: ASPRS LAS 1.4 R15, tables 7 to 17 (records) and 24 to 25 (extra bytes).

use las::Vlr;
use las::point::Format;

use crate::{Error, Value};

/// Whose record describes extra bytes, and its number.
pub(super) const OWNER: &str = "LASF_Spec";
pub(super) const EXTRA_BYTES: u16 = 4;

/// Bytes of the description of a dimension.
const DESCRIPTION: usize = 192;

/// Degrees of a step of the angles of newer records.
const ANGLE: f64 = 0.006;

/// How a number is stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    Unsigned(usize),
    Signed(usize),
    Float(usize),
    /// Some bits of a byte: how many there are below, and how many are taken.
    Bits(u8, u8),
}

/// A dimension of records.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Dimension {
    pub(crate) name: String,
    /// Where it is in a record.
    pub(crate) place: usize,
    pub(crate) kind: Kind,
    /// A step, and what is added.
    pub(crate) scale: Option<[f64; 2]>,
    /// The stored number that stands for no value.
    no_data: Option<Raw>,
    /// Extra bytes have it.
    pub(crate) is_extra: bool,
}

/// A number as it is stored.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Raw {
    Unsigned(u64),
    Signed(i64),
    Float(f64),
}

impl Kind {
    pub(crate) fn size(self) -> usize {
        match self {
            Self::Unsigned(size) | Self::Signed(size) | Self::Float(size) => size,
            Self::Bits(..) => 1,
        }
    }

    /// The number whose bytes begin there, lowest first.
    fn read(self, bytes: &[u8]) -> Option<Raw> {
        let bytes = bytes.get(..self.size())?;
        let mut word = [0; 8];
        word[..bytes.len()].copy_from_slice(bytes);
        let whole = u64::from_le_bytes(word);
        Some(match self {
            Self::Unsigned(_) => Raw::Unsigned(whole),
            Self::Signed(size) => {
                let above = 64 - 8 * size as u32;
                Raw::Signed((whole << above) as i64 >> above)
            }
            Self::Float(4) => Raw::Float(f32::from_bits(whole as u32).into()),
            Self::Float(_) => Raw::Float(f64::from_bits(whole)),
            Self::Bits(below, count) => Raw::Unsigned(whole >> below & ((1 << count) - 1)),
        })
    }
}

impl Raw {
    fn is(self, other: Self) -> bool {
        matches!((self, other), (Self::Float(one), Self::Float(two)) if one.is_nan() && two.is_nan())
            || self == other
    }

    fn number(self) -> f64 {
        match self {
            Self::Unsigned(number) => number as f64,
            Self::Signed(number) => number as f64,
            Self::Float(number) => number,
        }
    }
}

impl Dimension {
    pub(crate) fn new(name: &str, place: usize, kind: Kind) -> Self {
        Self { name: name.to_owned(), place, kind, scale: None, no_data: None, is_extra: false }
    }

    /// The stored number, if it stands for a value.
    fn raw(&self, record: &[u8]) -> Option<Raw> {
        let raw = self.kind.read(record.get(self.place..)?)?;
        self.no_data.is_none_or(|none| !raw.is(none)).then_some(raw)
    }

    /// The value of a record as a number, where there is one.
    pub(crate) fn number(&self, record: &[u8]) -> Option<f64> {
        let number = self.raw(record)?.number();
        Some(self.scale.map_or(number, |[step, shift]| number * step + shift))
    }

    /// The value of a record.
    pub(crate) fn value(&self, record: &[u8]) -> Value<'static> {
        match (self.scale, self.raw(record)) {
            (_, None) => Value::Null,
            (None, Some(Raw::Unsigned(number))) => Value::of_whole(number),
            (None, Some(Raw::Signed(number))) => Value::Integer(number),
            _ => self.number(record).map_or(Value::Null, Value::Number),
        }
    }

    /// Its type in words.
    pub(crate) fn describe(&self) -> String {
        let mut text = match self.kind {
            Kind::Unsigned(size) => format!("uint{}", 8 * size),
            Kind::Signed(size) => format!("int{}", 8 * size),
            Kind::Float(size) => format!("float{}", 8 * size),
            Kind::Bits(_, count) => format!("{count} bits"),
        };
        if let Some([step, shift]) = self.scale {
            text += &format!(" times {step:?} plus {shift:?}");
        }
        if let Some(none) = self.no_data {
            text += &match none {
                Raw::Unsigned(number) => format!(", no data {number}"),
                Raw::Signed(number) => format!(", no data {number}"),
                Raw::Float(number) => format!(", no data {number:?}"),
            };
        }
        text
    }
}

/// The dimensions of records of a format, without coordinates.
pub(super) fn of_records(format: Format, length: usize, records: &[Vlr]) -> Vec<Dimension> {
    use Kind::{Bits, Float, Signed, Unsigned};
    let mut all = vec![("intensity", 12, Unsigned(2))];
    let mut end = if format.is_extended {
        all.extend([
            ("return_number", 14, Bits(0, 4)),
            ("number_of_returns", 14, Bits(4, 4)),
            ("synthetic", 15, Bits(0, 1)),
            ("key_point", 15, Bits(1, 1)),
            ("withheld", 15, Bits(2, 1)),
            ("overlap", 15, Bits(3, 1)),
            ("scanner_channel", 15, Bits(4, 2)),
            ("scan_direction_flag", 15, Bits(6, 1)),
            ("edge_of_flight_line", 15, Bits(7, 1)),
            ("classification", 16, Unsigned(1)),
            ("user_data", 17, Unsigned(1)),
            ("scan_angle", 18, Signed(2)),
            ("point_source_id", 20, Unsigned(2)),
        ]);
        22
    } else {
        all.extend([
            ("return_number", 14, Bits(0, 3)),
            ("number_of_returns", 14, Bits(3, 3)),
            ("scan_direction_flag", 14, Bits(6, 1)),
            ("edge_of_flight_line", 14, Bits(7, 1)),
            ("classification", 15, Bits(0, 5)),
            ("synthetic", 15, Bits(5, 1)),
            ("key_point", 15, Bits(6, 1)),
            ("withheld", 15, Bits(7, 1)),
            ("scan_angle", 16, Signed(1)),
            ("user_data", 17, Unsigned(1)),
            ("point_source_id", 18, Unsigned(2)),
        ]);
        20
    };
    let further = [
        (format.has_gps_time, "gps_time", Float(8)),
        (format.has_color, "red", Unsigned(2)),
        (format.has_color, "green", Unsigned(2)),
        (format.has_color, "blue", Unsigned(2)),
        (format.has_nir, "nir", Unsigned(2)),
    ];
    for (_, name, kind) in further.into_iter().filter(|entry| entry.0) {
        all.push((name, end, kind));
        end += kind.size();
    }
    let mut all: Vec<Dimension> =
        all.into_iter().map(|(name, place, kind)| Dimension::new(name, place, kind)).collect();
    if format.is_extended {
        all.iter_mut().filter(|own| own.name == "scan_angle").for_each(|own| own.scale = Some([ANGLE, 0.0]));
    }
    let extra = length.saturating_sub(usize::from(format.extra_bytes));
    all.extend(described(records, extra, length));
    all
}

/// The dimensions in the extra bytes of records.
fn described(records: &[Vlr], begin: usize, end: usize) -> Vec<Dimension> {
    let mut own = records.iter().filter(|own| own.user_id == OWNER && own.record_id == EXTRA_BYTES);
    let (mut all, mut place) = (Vec::new(), begin);
    for text in own.next().map_or(&[][..], |own| &own.data).chunks_exact(DESCRIPTION) {
        let (number, options) = (usize::from(text[2]), text[3]);
        let kind = match number {
            0 => {
                // So many bytes that mean nothing to others.
                place += usize::from(options);
                continue;
            }
            1..=30 => match number % 10 {
                k @ (1 | 3 | 5 | 7) => Kind::Unsigned(1 << (k / 2)),
                k @ (2 | 4 | 6 | 8) => Kind::Signed(1 << (k / 2 - 1)),
                9 => Kind::Float(4),
                _ => Kind::Float(8),
            },
            // What follows cannot be found.
            _ => break,
        };
        let count = (number - 1) / 10 + 1;
        let name: Vec<u8> = text[4..36].iter().copied().take_while(|&byte| byte != 0).collect();
        let name = String::from_utf8_lossy(&name).trim().to_owned();
        for part in 0..count {
            let word = |from: usize| {
                let mut word = [0; 8];
                word.copy_from_slice(&text[from + 8 * part..from + 8 * part + 8]);
                word
            };
            let is_given = |bit: u8| options >> bit & 1 == 1;
            let scale = if is_given(3) { f64::from_le_bytes(word(112)) } else { 1.0 };
            let shift = if is_given(4) { f64::from_le_bytes(word(136)) } else { 0.0 };
            let widest = match kind {
                Kind::Unsigned(_) | Kind::Bits(..) => Kind::Unsigned(8),
                Kind::Signed(_) => Kind::Signed(8),
                Kind::Float(_) => Kind::Float(8),
            };
            let name = if count > 1 { format!("{name}[{part}]") } else { name.clone() };
            let own = Dimension {
                scale: (is_given(3) || is_given(4)).then_some([scale, shift]),
                no_data: widest.read(&word(40)).filter(|_| is_given(0)),
                is_extra: true,
                ..Dimension::new(&name, place, kind)
            };
            place += kind.size();
            if place <= end {
                all.push(own);
            }
        }
    }
    all
}

/// The dimension of a name: as it is written, or as other programs write it (`GpsTime`).
pub(crate) fn find(all: &[Dimension], name: &str) -> Result<Dimension, Error> {
    let found = all.iter().find(|own| own.name == name);
    let alike = || all.iter().find(|own| plain(&own.name) == plain(name));
    found.or_else(alike).cloned().ok_or_else(|| {
        let names: Vec<&str> = all.iter().map(|own| own.name.as_str()).collect();
        let named = crate::error::excerpt(name).to_owned();
        Error::NoDimension { name: named, names: names.join(", ") }
    })
}

/// A name without what programs write in different ways.
fn plain(name: &str) -> String {
    let plain = name.replace('_', "").to_ascii_lowercase();
    match plain.as_str() {
        "scananglerank" => "scanangle".to_owned(),
        "infrared" => "nir".to_owned(),
        "scanchannel" => "scannerchannel".to_owned(),
        _ => plain,
    }
}
