//! Errors: a status, the first row of the input that is wrong, and words.

use std::cell::RefCell;
use std::collections::TryReserveError;
use std::ffi::{CString, c_char, c_int};

use delone::Error;

use crate::layout::{TriError, WORD_BYTES};

/// The kind of an error, as the header numbers them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Status {
    Argument = 1,
    NotFinite = 2,
    Index = 4,
    TooMany = 5,
    Memory = 6,
    Bug = 9,
}

/// An error.
#[derive(Debug)]
pub(crate) struct Fault {
    pub(crate) status: Status,
    index: Option<usize>,
    words: String,
}

impl Fault {
    pub(crate) fn new(status: Status, words: impl Into<String>) -> Self {
        Self { status, index: None, words: words.into() }
    }

    /// Of a row of the input.
    pub(crate) fn at(status: Status, index: usize, words: impl Into<String>) -> Self {
        Self { index: Some(index), ..Self::new(status, words) }
    }

    pub(crate) fn memory(bytes: usize, what: &str) -> Self {
        let megabytes = bytes.div_ceil(1 << 20);
        Self::new(Status::Memory, format!("no memory for {what}: {megabytes} megabytes"))
    }

    pub(crate) fn bug() -> Self {
        Self::new(Status::Bug, "the work ended in a panic: memory is short, or it is a bug of Delone")
    }

    /// Tells the caller and the thread.
    pub(crate) fn tell(&self, error: Option<&mut TriError>) {
        // Older callers have shorter structures.
        if let Some(error) = error.filter(|error| error.size as usize >= size_of::<TriError>()) {
            error.status = self.status as c_int;
            error.index = self.index.and_then(|index| c_int::try_from(index).ok()).unwrap_or(-1);
            write_words(&self.words, &mut error.words);
        }
        remember(&self.words);
    }

    /// Writes the line on stderr, wherever that is; nobody hears if it is closed.
    pub(crate) fn print(&self) {
        use std::io::Write;
        let line = format!("delone: triangulate: {}\n", self.words);
        drop(std::io::stderr().write_all(line.as_bytes()));
    }
}

/// Tells a caller that all is good.
pub(crate) fn tell_good(error: Option<&mut TriError>) {
    if let Some(error) = error.filter(|error| error.size as usize >= size_of::<TriError>()) {
        (error.status, error.index, error.words[0]) = (0, -1, 0);
    }
    remember("");
}

/// Writes as many whole characters as there is room for, and a zero.
fn write_words(words: &str, room: &mut [c_char; WORD_BYTES]) {
    let end = (0..WORD_BYTES.min(words.len() + 1)).rev().find(|&k| words.is_char_boundary(k)).unwrap_or(0);
    room.fill(0);
    room.iter_mut().zip(words[..end].bytes()).for_each(|(to, byte)| *to = byte as c_char);
}

thread_local! {
    static LAST: RefCell<CString> = RefCell::new(CString::default());
}

fn remember(words: &str) {
    let words = CString::new(words.replace('\0', " ")).unwrap_or_default();
    // A thread that is about to end remembers nothing.
    drop(LAST.try_with(|last| last.replace(words)));
}

/// The words of the last error on this thread.
pub(crate) fn last() -> *const c_char {
    LAST.try_with(|last| last.borrow().as_ptr()).unwrap_or(c"".as_ptr())
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        let (status, index) = match error {
            Error::NotFinite { index, .. } => (Status::NotFinite, Some(index)),
            Error::Coordinate { .. } => (Status::NotFinite, None),
            Error::NoSuchPoint { segment, .. } => (Status::Index, Some(segment)),
            Error::TooManyPoints { .. } => (Status::TooMany, None),
            Error::KeptTriangle { triangle, .. } => (Status::Argument, Some(triangle)),
            Error::Seed { index, .. } => (Status::Argument, Some(index)),
            _ => (Status::Argument, None),
        };
        Self { status, index, words: error.to_string() }
    }
}

impl From<TryReserveError> for Fault {
    fn from(error: TryReserveError) -> Self {
        Self::new(Status::Memory, error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_cut_between_characters() {
        for (words, kept) in
            [(String::new(), 0), ("a".repeat(243), 243), ("a".repeat(244), 243), ("ü".repeat(200), 242)]
        {
            let mut room = [1; WORD_BYTES];
            write_words(&words, &mut room);
            let bytes: Vec<u8> = room.iter().map(|&c| c as u8).take_while(|&c| c != 0).collect();
            assert_eq!((bytes.len(), std::str::from_utf8(&bytes).is_ok()), (kept, true));
        }
    }
}
