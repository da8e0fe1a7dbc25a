//! Lines of text formats: numbered, without comments, one buffer for all.

use crate::{Error, Source};

/// Reads lines; what follows `#` is left out, and so are lines that are empty then.
pub(super) struct Lines {
    source: Box<dyn Source>,
    buffer: String,
    number: usize,
}

impl Lines {
    pub(super) fn new(source: Box<dyn Source>) -> Self {
        Self { source, buffer: String::new(), number: 0 }
    }

    /// The next line with something on it.
    pub(super) fn next(&mut self) -> Result<Option<Line<'_>>, Error> {
        loop {
            self.buffer.clear();
            let length = self.source.read_line(&mut self.buffer).map_err(|error| {
                if error.kind() == std::io::ErrorKind::InvalidData {
                    Error::Line { line: self.number + 1, what: "it is not text".to_owned() }
                } else {
                    error.into()
                }
            })?;
            if length == 0 {
                return Ok(None);
            }
            self.number += 1;
            if !content(&self.buffer).is_empty() {
                break;
            }
        }
        let text = content(&self.buffer);
        Ok(Some(Line { text, number: self.number }))
    }
}

/// A line without comment and surrounding white space (and byte order mark).
fn content(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim_start_matches('\u{feff}').trim()
}

/// A line of text and its number from 1.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    pub(super) text: &'a str,
    pub(super) number: usize,
}

impl Line<'_> {
    pub(super) fn error(&self, what: impl Into<String>) -> Error {
        Error::Line { line: self.number, what: what.into() }
    }

    /// The next word as a number.
    pub(super) fn number<T: std::str::FromStr>(&self, word: Option<&str>, meaning: &str) -> Result<T, Error> {
        let word = word.ok_or_else(|| self.error(format!("{meaning} is missing")))?;
        word.parse()
            .map_err(|_| self.error(format!("{meaning} is {word:?}, not a number of the kind expected")))
    }
}
