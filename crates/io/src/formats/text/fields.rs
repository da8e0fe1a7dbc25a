//! Lines of a table and the fields in them.

use std::borrow::Cow;

use super::wkt;

/// What stands between fields.
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
        let plain: String = line.trim().split('"').step_by(2).collect();
        let sign = ['\t', ';', '|', ','].into_iter().find(|&sign| plain.contains(sign));
        match sign {
            Some(sign) => Self::Sign(sign),
            // One column of well-known text.
            None if wkt::is_geometry(line.trim().trim_start_matches('"')) => Self::Sign(','),
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

    /// Whether a quoted field goes on in the next line: one that begins in this line, or is open before it.
    pub(super) fn stays_open(self, line: &str, open: bool) -> bool {
        let Self::Sign(sign) = self else { return false };
        if !open && memchr::memchr(b'"', line.as_bytes()).is_none() {
            return false;
        }
        let (mut quoted, mut is_quoted, mut starts) = (open, open, !open);
        for c in line.chars() {
            if is_quoted {
                // Two marks in a row stand for one: what is outside of marks changes at every one.
                quoted ^= c == '"';
                (is_quoted, starts) = if c == sign && !quoted { (false, true) } else { (true, false) };
            } else if c == '"' && starts {
                (quoted, is_quoted, starts) = (true, true, false);
            } else {
                starts = c == sign || (starts && c.is_whitespace());
            }
        }
        quoted
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
            let quoted = words.strip_prefix('"').and_then(|inner| inner.split_once('"'));
            let (word, rest) = quoted
                .unwrap_or_else(|| words.split_at(words.find(char::is_whitespace).unwrap_or(words.len())));
            self.rest = Some(rest);
            // A remark may follow.
            return (!words.is_empty() && !words.starts_with('#')).then_some(Cow::Borrowed(word));
        };
        let end = if rest.trim_start().starts_with('"') {
            let mut quoted = false;
            rest.char_indices().find_map(|(at, c)| {
                quoted ^= c == '"';
                (c == sign && !quoted).then_some(at)
            })
        } else {
            rest.find(sign)
        };
        self.rest = end.map(|end| &rest[end + sign.len_utf8()..]);
        let field = rest[..end.unwrap_or(rest.len())].trim();
        Some(match field.strip_prefix('"') {
            None => Cow::Borrowed(field),
            Some(inner) => {
                let inner = inner.strip_suffix('"').unwrap_or(inner).trim();
                if inner.contains('"') {
                    Cow::Owned(inner.replace("\"\"", "\""))
                } else {
                    Cow::Borrowed(inner)
                }
            }
        })
    }
}

/// What a remark says, where a line is one as a whole.
pub(super) fn remark(line: &str) -> Option<&str> {
    let line = line.trim_start();
    ["#", "%", "//"].iter().find_map(|sign| line.strip_prefix(sign)).map(|rest| rest.trim_end())
}

/// A number with a decimal point or a decimal comma; a remark may follow after a blank.
pub(super) fn number(field: &str) -> Option<f64> {
    let field = match field.find('#') {
        Some(at) if field[..at].ends_with(char::is_whitespace) => field[..at].trim(),
        _ => field.trim(),
    };
    field.parse().ok().or_else(|| match field.split_once(',') {
        Some((whole, part)) if !part.contains(',') && !field.contains('.') => {
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
            ("1, \"a\"\"b\",2", false, false),
            ("b\",3", true, false),
            ("b\",\"c", true, true),
            ("", true, true),
        ] {
            assert_eq!(sign.stays_open(line, before), after, "{line:?}");
        }
        let fields = |separator: Separator, line: &'static str| separator.split(line).collect::<Vec<_>>();
        assert_eq!(fields(sign, "1, \"a, \"\"b\"\"\" ,,\"\""), ["1", "a, \"b\"", "", ""]);
        assert_eq!(fields(Separator::Blank, " \"a b\"  1.5 2 # three"), ["a b", "1.5", "2"]);
        assert_eq!(fields(Separator::Sign('\t'), "\t1\t"), ["", "1", ""]);
    }

    #[test]
    fn numbers_are_whole_fields() {
        assert_eq!(
            (number("1,5"), number(" 2e3 # more "), number("-7")),
            (Some(1.5), Some(2000.0), Some(-7.0))
        );
        for field in ["1.#INF", "1#foo", "1,234.5", "1,2,3", "", "5m", "0x10", "0.1D+01"] {
            assert_eq!(number(field), None, "{field}");
        }
    }
}
