//! Lines of text formats: numbered, without comments, one buffer for all. Lines end with LF, CR LF or CR alone.

use std::borrow::Cow;
use std::io;

use crate::error::excerpt;
use crate::{Error, Source};

/// No line of a text format is longer; what is longer is no text.
const LONGEST: usize = 1 << 26;

/// Reads lines; what follows `#` is left out, and so are lines that are empty then.
pub(super) struct Lines {
    source: Box<dyn Source>,
    bytes: Vec<u8>,
    text: String,
    number: usize,
    /// Whether commas are as good as blanks.
    has_commas: bool,
    /// The comments that were met, without the sign before them, if they are wanted.
    comments: Option<Vec<String>>,
}

impl Lines {
    pub(super) fn new(source: Box<dyn Source>) -> Self {
        Self { source, bytes: Vec::new(), text: String::new(), number: 0, has_commas: false, comments: None }
    }

    /// Lines as Triangle reads them, to which commas are as good as blanks.
    pub(super) fn of_triangle(source: Box<dyn Source>) -> Self {
        Self { has_commas: true, ..Self::new(source) }
    }

    /// Keeps the comments from here on.
    pub(super) fn keep_comments(&mut self) {
        self.comments = Some(Vec::new());
    }

    /// The comments that were met.
    pub(super) fn comments(&mut self) -> Vec<String> {
        self.comments.take().unwrap_or_default()
    }

    /// The next line with something on it besides a comment.
    pub(super) fn next(&mut self) -> Result<Option<Line<'_>>, Error> {
        while self.advance()? {
            if !content(&self.text).is_empty() {
                return Ok(Some(Line { text: content(&self.text), number: self.number }));
            }
        }
        Ok(None)
    }

    /// The next line with something on it, as it is.
    pub(super) fn next_whole(&mut self) -> Result<Option<Line<'_>>, Error> {
        // Old systems end files by a sign of their own.
        const END: &str = "\u{1a}";
        while self.advance()? {
            let text = self.text.trim();
            if !text.is_empty() && text != END {
                return Ok(Some(Line { text: &self.text, number: self.number }));
            }
        }
        Ok(None)
    }

    /// The next line, whatever is on it.
    pub(super) fn next_any(&mut self) -> Result<Option<Line<'_>>, Error> {
        let is_there = self.advance()?;
        Ok(is_there.then_some(Line { text: &self.text, number: self.number }))
    }

    /// Reads the next line; false at the end of the file.
    fn advance(&mut self) -> Result<bool, Error> {
        if !self.read_line()? {
            return Ok(false);
        }
        self.number += 1;
        let bytes = match self.number {
            1 => self.bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&self.bytes),
            _ => &self.bytes,
        };
        if self.number == 1 && (bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff")) {
            return Err(self.error("it is UTF-16: save it as UTF-8"));
        }
        if memchr::memchr(0, bytes).is_some() {
            return Err(self.error("it is not text"));
        }
        self.text.clear();
        self.text.push_str(&decoded(bytes));
        if let Some(comments) = &mut self.comments
            && let Some((_, comment)) = self.text.split_once('#')
        {
            comments.push(comment.trim().to_owned());
        }
        if self.has_commas && self.text.contains(',') {
            self.text = self.text.replace(',', " ");
        }
        Ok(true)
    }

    fn error(&self, what: &str) -> Error {
        Error::Line { line: self.number, what: what.to_owned() }
    }

    /// Reads the bytes up to the end of a line.
    fn read_line(&mut self) -> Result<bool, Error> {
        self.bytes.clear();
        let mut any = false;
        loop {
            let ahead = match self.source.fill_buf() {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                ahead => ahead?,
            };
            if ahead.is_empty() {
                return Ok(any);
            }
            any = true;
            let end = memchr::memchr2(b'\n', b'\r', ahead);
            let taken = end.unwrap_or(ahead.len());
            self.bytes.extend_from_slice(&ahead[..taken]);
            let Some(end) = end else {
                self.source.consume(taken);
                if self.bytes.len() > LONGEST {
                    return Err(Error::Line {
                        line: self.number + 1,
                        what: "it is too long for text".to_owned(),
                    });
                }
                continue;
            };
            let returned = ahead[end] == b'\r';
            self.source.consume(taken + 1);
            if returned && self.source.fill_buf()?.first() == Some(&b'\n') {
                self.source.consume(1);
            }
            return Ok(true);
        }
    }
}

/// Text as UTF-8, or else as Latin-1, where every byte is a letter.
fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().copied().map(char::from).collect()),
    }
}

/// A line without comment and surrounding white space.
fn content(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
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

    /// The next word as a number. Programs in Fortran write `1.5D0` for 1.5, and some write `3.0` for a number that counts.
    pub(super) fn number<T: std::str::FromStr>(&self, word: Option<&str>, meaning: &str) -> Result<T, Error> {
        let word = word.ok_or_else(|| self.error(format!("{meaning} is missing")))?;
        let plain = || word.replace(['D', 'd'], "e").parse().ok();
        let whole =
            || word.split_once('.').filter(|parts| parts.1.bytes().all(|c| c == b'0'))?.0.parse().ok();
        word.parse().ok().or_else(plain).or_else(whole).ok_or_else(|| {
            self.error(format!("{meaning} is {:?}, not a number of the kind expected", excerpt(word)))
        })
    }

    /// The next so many words as numbers.
    pub(super) fn more<'a>(
        &self,
        words: &mut impl Iterator<Item = &'a str>,
        count: usize,
        values: &mut Vec<f64>,
    ) -> Result<(), Error> {
        for _ in 0..count {
            values.push(self.number(words.next(), "an attribute")?);
        }
        Ok(())
    }
}
