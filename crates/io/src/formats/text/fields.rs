//! Lines of a table and the fields in them.

use std::borrow::Cow;

use crate::formats::wkt;

/// A sign that is in no text, between the fields of lines that are one field.
const WHOLE: char = '\u{1f}';

/// The separator of fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Separator {
    /// One sign; what is between two of them is a field, quoted or not.
    Sign(char),
    /// Blanks, as many as there are.
    Blank,
}

impl Separator {
    /// By the first line, outside of quotes; a comma may be a decimal one, so others go first.
    pub(super) fn of(line: &str) -> Self {
        let word = line.trim().trim_matches('"');
        if wkt::is_geometry(word) && !line.trim().starts_with('"') || super::columns::names_geometry(word) {
            // One column of well-known text, which has commas of its own.
            return Self::Sign(WHOLE);
        }
        let plain: String = line.trim().split('"').step_by(2).collect();
        let sign = ['\t', ';', '|', ','].into_iter().find(|&sign| plain.contains(sign));
        match sign {
            Some(sign) => Self::Sign(sign),
            // One quoted column of well-known text.
            None if wkt::is_geometry(word) => Self::Sign(','),
            None => Self::Blank,
        }
    }

    /// The separator that a first line says there is, as spreadsheets write it: `sep=;`.
    pub(super) fn said(line: &str) -> Option<Self> {
        let mut rest = line.strip_prefix("sep=").or_else(|| line.strip_prefix("SEP="))?.chars();
        let sign = rest.next()?;
        rest.as_str().trim().is_empty().then_some(Self::Sign(sign))
    }

    /// Whether there is nothing but separators.
    pub(super) fn is_nothing(self, record: &str) -> bool {
        record.chars().all(|c| self == Self::Sign(c) || c == '"' || c.is_whitespace())
    }

    /// Whether a quoted field goes on in the next line: one that begins in this line, or is open before it. An error if
    /// a mark inside of a quoted field is neither doubled nor its end, because nobody knows then where fields end.
    pub(super) fn stays_open(self, line: &str, open: bool) -> Result<bool, String> {
        let Self::Sign(sign) = self else { return Ok(false) };
        if !open && memchr::memchr(b'"', line.as_bytes()).is_none() {
            return Ok(false);
        }
        let mut rest = line;
        let mut quoted = open;
        loop {
            if !quoted {
                match rest.trim_start_matches(|c: char| c != sign && c.is_whitespace()).strip_prefix('"') {
                    Some(inner) => rest = inner,
                    // Marks in the middle of a field mean nothing.
                    None => match rest.find(sign) {
                        Some(at) => {
                            rest = &rest[at + sign.len_utf8()..];
                            continue;
                        }
                        None => return Ok(false),
                    },
                }
            }
            let Some(end) = end_of_quotes(rest) else { return Ok(true) };
            let after = rest[end + 1..].trim_start_matches(|c: char| c != sign && c.is_whitespace());
            match after.strip_prefix(sign) {
                Some(next) => (rest, quoted) = (next, false),
                None if after.is_empty() => return Ok(false),
                None => return Err("a quotation mark inside of quotes is not doubled".to_owned()),
            }
        }
    }

    /// The fields, without quotation marks around them.
    pub(super) fn split(self, record: &str) -> Fields<'_> {
        Fields { separator: self, rest: Some(record) }
    }
}

/// The fields of a record.
pub(super) struct Fields<'a> {
    separator: Separator,
    rest: Option<&'a str>,
}

impl<'a> Iterator for Fields<'a> {
    type Item = Cow<'a, str>;

    fn next(&mut self) -> Option<Cow<'a, str>> {
        let rest = self.rest?;
        let Separator::Sign(sign) = self.separator else {
            let words = rest.trim_start();
            // A remark may follow.
            if words.is_empty() || words.starts_with('#') {
                return None;
            }
            let quoted = words.strip_prefix('"').and_then(|inner| Some((inner, end_of_quotes(inner)?)));
            let (word, rest) = if let Some((inner, end)) = quoted {
                (unquoted(&inner[..end]), &inner[end + 1..])
            } else {
                let (word, rest) = words.split_at(words.find(char::is_whitespace).unwrap_or(words.len()));
                (Cow::Borrowed(word), rest)
            };
            self.rest = Some(rest);
            return Some(word);
        };
        let blanks = rest.len() - rest.trim_start_matches(|c: char| c != sign && c.is_whitespace()).len();
        let quoted = rest[blanks..].strip_prefix('"').and_then(end_of_quotes).map(|end| blanks + 1 + end);
        let end = rest[quoted.unwrap_or(0)..].find(sign).map(|at| at + quoted.unwrap_or(0));
        self.rest = end.map(|end| &rest[end + sign.len_utf8()..]);
        Some(match quoted {
            None => Cow::Borrowed(rest[..end.unwrap_or(rest.len())].trim()),
            Some(end) => unquoted(&rest[blanks + 1..end]),
        })
    }
}

/// Where the mark is that ends a quoted field; two in a row stand for one.
fn end_of_quotes(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let mut at = 0;
    loop {
        at += memchr::memchr(b'"', &bytes[at..])?;
        if bytes.get(at + 1) != Some(&b'"') {
            return Some(at);
        }
        at += 2;
    }
}

/// The text between quotes, whose blanks are its own.
fn unquoted(inner: &str) -> Cow<'_, str> {
    if inner.contains('"') { Cow::Owned(inner.replace("\"\"", "\"")) } else { Cow::Borrowed(inner) }
}

/// The text of a remark, where a line is one as a whole.
pub(super) fn remark(line: &str) -> Option<&str> {
    let line = line.trim_start();
    ["#", "%", "//"].iter().find_map(|sign| line.strip_prefix(sign)).map(|rest| rest.trim_end())
}

/// A number with a decimal point, or a decimal comma where commas are not between fields: there they would be between
/// thousands. A remark may follow after a blank.
pub(super) fn number(field: &str, separator: Separator) -> Option<f64> {
    let field = match field.find('#') {
        Some(at) if field[..at].ends_with(char::is_whitespace) => field[..at].trim(),
        _ => field.trim(),
    };
    field.parse().ok().or_else(|| match field.split_once(',') {
        Some((whole, part))
            if separator != Separator::Sign(',') && !part.contains(',') && !field.contains('.') =>
        {
            format!("{whole}.{part}").parse().ok()
        }
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::{Separator, number};

    #[test]
    fn quotes_open_and_close_at_the_borders_of_fields() {
        let sign = Separator::Sign(',');
        for (line, before, after) in [
            ("1,2", false, false),
            ("1,\"a", false, true),
            ("1,5\" pipe,2", false, false),
            ("1,\"say \"\"so\"\",", false, true),
            ("1, \"a\"\"b\" ,2", false, false),
            ("b\",3", true, false),
            ("b\",\"c", true, true),
            ("", true, true),
        ] {
            assert_eq!(sign.stays_open(line, before), Ok(after), "{line:?}");
        }
        for line in ["1,\"5\" pipe\"", "1,\"5\\\" pipe\",2", "\"a\"b,1"] {
            assert!(sign.stays_open(line, false).is_err(), "{line}");
        }
        let fields = |separator: Separator, line: &'static str| separator.split(line).collect::<Vec<_>>();
        assert_eq!(fields(sign, "1, \"a, \"\"b\"\"\" ,,\"\""), ["1", "a, \"b\"", "", ""]);
        assert_eq!(fields(Separator::Blank, " \"a b\"  1.5 2 # three"), ["a b", "1.5", "2"]);
        assert_eq!(fields(Separator::Blank, "\"b\"\"q\" 1"), ["b\"q", "1"]);
        assert_eq!(fields(Separator::Sign('\t'), "\t1\t"), ["", "1", ""]);
    }

    #[test]
    fn numbers_are_whole_fields() {
        let plain = |field: &str| number(field, Separator::Sign(';'));
        assert_eq!((plain("1,5"), plain(" 2e3 # more "), plain("-7")), (Some(1.5), Some(2000.0), Some(-7.0)));
        for field in ["1.#INF", "1#foo", "1,234.5", "1,2,3", "", "5m", "0x10", "0.1D+01"] {
            assert_eq!(plain(field), None, "{field}");
        }
        assert_eq!(number("1,234", Separator::Sign(',')), None);
    }
}
