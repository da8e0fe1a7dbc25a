//! Tables of dBASE: the attributes of a shapefile, a row for each record, of fields that are as wide in all rows.
//!
//! Source: <https://www.dbase.com/Knowledgebase/INT/db7_file_fmt.htm> and "Xbase File Format Description" of E. Bachmann.

use std::io::Read;

use super::wrong;
use crate::error::{excerpt, listed};
use crate::formats::shapes::Shapes;
use crate::{Error, Source, Value};

/// The rows of a table, one at a time.
pub(super) struct Rows {
    source: Box<dyn Source>,
    fields: Vec<Field>,
    page: Page,
    /// How many rows are left, and the bytes of one.
    left: u32,
    width: usize,
    row: Vec<u8>,
    losses: Vec<String>,
}

struct Field {
    name: String,
    kind: u8,
    /// Where it begins in a row, and where it ends.
    begin: usize,
    end: usize,
}

/// The state of the next row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    There,
    Deleted,
    Gone,
}

/// How bytes stand for letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Page {
    Utf8,
    /// Western Europe on Windows, of which Latin-1 is a part.
    Western,
    /// Nothing says: UTF-8 where it is that.
    Unknown,
}

/// The letters of code page 1252 where Latin-1 has none.
const WESTERN: [char; 32] = [
    '\u{20ac}', '\u{81}', '\u{201a}', '\u{192}', '\u{201e}', '\u{2026}', '\u{2020}', '\u{2021}', '\u{2c6}',
    '\u{2030}', '\u{160}', '\u{2039}', '\u{152}', '\u{8d}', '\u{17d}', '\u{8f}', '\u{90}', '\u{2018}',
    '\u{2019}', '\u{201c}', '\u{201d}', '\u{2022}', '\u{2013}', '\u{2014}', '\u{2dc}', '\u{2122}', '\u{161}',
    '\u{203a}', '\u{153}', '\u{9d}', '\u{17e}', '\u{178}',
];

impl Page {
    /// By what a `.cpg` file says, or else by the mark in the table; and a name that is not known.
    fn of(said: Option<&str>, mark: u8) -> (Self, Option<String>) {
        let said = said.map(|said| said.trim().to_ascii_uppercase()).filter(|said| !said.is_empty());
        let Some(said) = said else {
            // Two numbers of Windows' page, and none.
            return (if [0x03, 0x57].contains(&mark) { Self::Western } else { Self::Unknown }, None);
        };
        let ends = |endings: &[&str]| endings.iter().any(|ending| said.ends_with(ending));
        match said.as_str() {
            _ if ends(&["UTF-8", "UTF8", "65001"]) => (Self::Utf8, None),
            _ if ends(&["1252", "8859-1", "8859_1", "88591", "LATIN1", "LATIN-1", "ASCII"]) => {
                (Self::Western, None)
            }
            _ => (Self::Unknown, Some(said)),
        }
    }

    fn text(self, bytes: &[u8]) -> String {
        let western = |&byte: &u8| match byte {
            0x80..0xa0 => WESTERN[usize::from(byte - 0x80)],
            _ => char::from(byte),
        };
        match (self, str::from_utf8(bytes)) {
            (Self::Utf8 | Self::Unknown, Ok(text)) => text.to_owned(),
            (Self::Utf8, Err(_)) => String::from_utf8_lossy(bytes).into_owned(),
            _ => bytes.iter().map(western).collect(),
        }
    }
}

/// A field of so many bytes: letters, numbers in digits, dates, truth; or numbers in binary.
const LETTERS: u8 = b'C';
const DIGITS: [u8; 2] = [b'N', b'F'];
const DATE: u8 = b'D';
const TRUTH: u8 = b'L';
const WHOLE: [u8; 2] = [b'I', b'+'];
const DOUBLE: u8 = b'O';

impl Rows {
    /// Reads the head of a table.
    pub(super) fn open(mut source: Box<dyn Source>, page: Option<&str>) -> Result<Self, Error> {
        const HEAD: usize = 32;
        const FIELD: usize = 32;
        const END: u8 = 0x0d;
        let mut head = Vec::new();
        (&mut source).take(HEAD as u64).read_to_end(&mut head)?;
        let cut = || Error::Truncated("inside of the head of its .dbf file".to_owned());
        let short =
            |at: usize| head.get(at..at + 2).map(|two| usize::from(two[0]) | usize::from(two[1]) << 8);
        let (length, width) = short(8).zip(short(10)).ok_or_else(cut)?;
        let left = head.get(4..8).and_then(|four| four.try_into().ok()).map_or(0, u32::from_le_bytes);
        let (page, unknown) = Page::of(page, head.get(29).copied().unwrap_or_default());
        let mut rest = Vec::new();
        (&mut source).take(length.saturating_sub(HEAD) as u64).read_to_end(&mut rest)?;
        if rest.len() + HEAD < length {
            return Err(cut());
        }
        let mut fields = Vec::new();
        let mut left_out = Vec::new();
        // The first byte tells whether a row is deleted.
        let mut begin = 1;
        for about in rest.chunks_exact(FIELD).take_while(|about| about[0] != END) {
            let letters = about[..11].split(|&byte| byte == 0).next().unwrap_or_default();
            let kind = about[11];
            // Long texts have the rest of their length where numbers have the digits after the point.
            let more = if kind == LETTERS { usize::from(about[17]) << 8 } else { 0 };
            let end = begin + usize::from(about[16]) + more;
            let name = page.text(letters).trim().to_owned();
            if end > width {
                return Err(wrong(format!("field {name:?} of its .dbf file does not fit into a row")));
            }
            let known = [LETTERS, DATE, TRUTH, DOUBLE].contains(&kind) || DIGITS.contains(&kind);
            if known || WHOLE.contains(&kind) {
                fields.push(Field { name, kind, begin, end });
            } else {
                left_out.push(name);
            }
            begin = end;
        }
        let mut losses = Vec::new();
        if !left_out.is_empty() {
            let names = listed(left_out.iter().map(String::as_str));
            losses.push(format!("attributes are left out that are no text, number, date or truth: {names}"));
        }
        if let Some(page) = unknown {
            let page = excerpt(&page);
            losses.push(format!("letters may be wrong: code page {page} is read as UTF-8 or Latin-1"));
        }
        if width == 0 {
            return Err(wrong("the rows of its .dbf file have no bytes"));
        }
        Ok(Self { source, fields, page, left, width, row: Vec::new(), losses })
    }

    /// Columns and values that were not understood.
    pub(super) fn losses(&self) -> impl Iterator<Item = String> {
        self.losses.iter().cloned()
    }

    /// Tells the names of all attributes.
    pub(super) fn declare(&self, shapes: &mut Shapes) {
        self.fields.iter().for_each(|field| shapes.attribute(&field.name, Value::Null));
    }

    /// Reads the next row.
    pub(super) fn next(&mut self) -> Result<State, Error> {
        const DELETED: u8 = b'*';
        self.row.clear();
        if self.left == 0 {
            return Ok(State::Gone);
        }
        self.left -= 1;
        (&mut self.source).take(self.width as u64).read_to_end(&mut self.row)?;
        if self.row.len() < self.width {
            self.left = 0;
            return Ok(State::Gone);
        }
        Ok(if self.row[0] == DELETED { State::Deleted } else { State::There })
    }

    /// Takes the attributes of the row.
    pub(super) fn take(&self, shapes: &mut Shapes) {
        for field in &self.fields {
            if let Some(bytes) = self.row.get(field.begin..field.end) {
                self.value(field, bytes, shapes);
            }
        }
    }

    fn value(&self, field: &Field, bytes: &[u8], shapes: &mut Shapes) {
        let bare = bytes.trim_ascii();
        let digits = str::from_utf8(bare).unwrap_or_default();
        let value = match field.kind {
            LETTERS => {
                let end = bytes.iter().rposition(|byte| !b" \0".contains(byte)).map_or(0, |last| last + 1);
                Value::Owned(self.page.text(&bytes[..end]))
            }
            DATE if bare.len() == 8 && bare.iter().all(u8::is_ascii_digit) => {
                Value::Owned(format!("{}-{}-{}", &digits[..4], &digits[4..6], &digits[6..]))
            }
            TRUTH => match bare {
                [b'T' | b't' | b'Y' | b'y'] => Value::Bool(true),
                [b'F' | b'f' | b'N' | b'n'] => Value::Bool(false),
                _ => Value::Null,
            },
            kind if DIGITS.contains(&kind) => match (digits.parse(), digits.parse::<f64>()) {
                (Ok(whole), _) => Value::Integer(whole),
                (_, Ok(number)) => Value::Number(number),
                _ => Value::Null,
            },
            kind if WHOLE.contains(&kind) => {
                bytes.try_into().map_or(Value::Null, |four| Value::Integer(i32::from_le_bytes(four).into()))
            }
            DOUBLE => bytes.try_into().map_or(Value::Null, |eight| Value::Number(f64::from_le_bytes(eight))),
            _ => Value::Null,
        };
        // An empty text is what there is where nothing was written.
        let is_empty = matches!(&value, Value::Owned(text) if text.is_empty());
        shapes.attribute(&field.name, if is_empty { Value::Null } else { value });
    }
}

#[cfg(test)]
mod tests {
    use super::Page;

    #[test]
    fn letters_by_their_page() {
        let of = |said: &str| Page::of(Some(said), 0).0;
        assert_eq!(of("UTF-8\r\n"), Page::Utf8);
        assert_eq!([of("ISO-8859-1"), of("ANSI 1252"), of("1252")], [Page::Western; 3]);
        assert_eq!(Page::of(Some("1251"), 0), (Page::Unknown, Some("1251".to_owned())));
        assert_eq!([Page::of(None, 0x57).0, Page::of(Some(""), 0).0], [Page::Western, Page::Unknown]);
        assert_eq!(Page::Western.text(b"\xc5re \x80"), "\u{c5}re \u{20ac}");
        assert_eq!(Page::Unknown.text("\u{c5}re".as_bytes()), "\u{c5}re");
        assert_eq!(Page::Unknown.text(b"\xc5re"), "\u{c5}re");
        assert_eq!(Page::Utf8.text(b"\xc5re"), "\u{fffd}re");
    }
}
