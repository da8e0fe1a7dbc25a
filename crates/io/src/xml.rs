//! XML whose parsing takes time in proportion to its length.
//!
//! The parser compares each attribute of an element with those before it, so 40,000 attributes in 429 kB take five seconds. No format
//! that is read here has more than 30.

use roxmltree::Document;

use crate::Error;

/// Attributes that an element may have: 1,000 take a millisecond, and 30 are used.
const MOST_ATTRIBUTES: usize = 1000;

/// Parses a document.
pub(crate) fn parse(text: &str) -> Result<Document<'_>, Error> {
    check(text.as_bytes())?;
    Document::parse(text).map_err(|error| Error::content(format!("XML: {error}")))
}

/// Refuses an element with very many attributes: an equals sign and a quote for each, and no `<` between them, even in values.
pub(crate) fn check(text: &[u8]) -> Result<(), Error> {
    let (mut is_after_equals, mut count) = (false, 0);
    for &byte in text {
        match byte {
            b'<' => count = 0,
            b'"' | b'\'' if is_after_equals => count += 1,
            _ => {}
        }
        is_after_equals = byte == b'=' || is_after_equals && byte.is_ascii_whitespace();
        if count > MOST_ATTRIBUTES {
            return Err(Error::content(format!(
                "XML: an element has more than {MOST_ATTRIBUTES} attributes"
            )));
        }
    }
    Ok(())
}

/// A text as XML has it, without what XML cannot hold.
pub(crate) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c if c.is_control() && !c.is_whitespace() => {}
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::{MOST_ATTRIBUTES, parse};

    #[test]
    fn attributes_are_counted() {
        let element = |count: usize| {
            let attributes: String = (0..count).map(|k| format!(" a{k} =\n'>'")).collect();
            format!("<!-- don't --><a><b{attributes}/>a = b = c</a>")
        };
        assert!(parse(&element(MOST_ATTRIBUTES)).is_ok());
        let error = parse(&element(40_000)).expect_err("too many");
        assert_eq!(error.to_string(), "XML: an element has more than 1000 attributes");
    }
}
