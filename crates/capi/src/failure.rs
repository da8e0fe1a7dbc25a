//! Statuses, and the error in the struct of a caller.

use std::ffi::c_char;
use std::panic::{AssertUnwindSafe, catch_unwind};

use delone::Error;

/// Statuses, as `delone.h` numbers them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub(crate) enum Status {
    Good = 0,
    Argument = 1,
    NotFinite = 2,
    Crossing = 3,
    Index = 4,
    TooMany = 5,
    Memory = 6,
    Stopped = 7,
    Dimension = 8,
    Bug = 9,
}

impl Status {
    pub(crate) const ALL: [Self; 10] = [
        Self::Good,
        Self::Argument,
        Self::NotFinite,
        Self::Crossing,
        Self::Index,
        Self::TooMany,
        Self::Memory,
        Self::Stopped,
        Self::Dimension,
        Self::Bug,
    ];
}

/// Room for the words of an error, in bytes, the last one 0.
const MESSAGE_BYTES: usize = 240;

/// `delone_error`.
#[repr(C)]
pub(crate) struct CError {
    size: u32,
    status: i32,
    index: i64,
    message: [c_char; MESSAGE_BYTES],
}

/// A status, the item that is wrong, and words.
#[derive(Debug)]
pub(crate) struct Failure {
    status: Status,
    index: Option<usize>,
    words: String,
}

impl Failure {
    pub(crate) fn new(status: Status, words: impl Into<String>) -> Self {
        Self { status, index: None, words: words.into() }
    }

    pub(crate) fn at(self, index: usize) -> Self {
        Self { index: Some(index), ..self }
    }

    pub(crate) fn argument(words: impl Into<String>) -> Self {
        Self::new(Status::Argument, words)
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let (status, index) = match &error {
            Error::NotFinite { index, .. } | Error::Weight { index, .. } | Error::Height { index, .. } => {
                (Status::NotFinite, Some(*index))
            }
            Error::SegmentsCross { first, .. } => (Status::Crossing, Some(*first)),
            Error::NoSuchPoint { segment, .. } => (Status::Index, Some(*segment)),
            Error::NoSuchVertex { .. } => (Status::Index, None),
            Error::TooManyPoints { .. } | Error::TooManyTetrahedra { .. } | Error::TooManyCircles { .. } => {
                (Status::TooMany, None)
            }
            Error::Stopped => (Status::Stopped, None),
            _ => (Status::Argument, None),
        };
        Self { status, index, words: error.to_string() }
    }
}

/// Does work, and tells the caller how it went: what fails is in the error, if there is room for one, and a panic is status 9.
pub(crate) fn guard(error: *mut CError, work: impl FnOnce() -> Result<(), Failure>) -> i32 {
    let failure = match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => return Status::Good as i32,
        Ok(Err(failure)) => failure,
        Err(_) => Failure::new(Status::Bug, "this is a bug of the library: please report it"),
    };
    tell(error, &failure);
    failure.status as i32
}

fn tell(error: *mut CError, failure: &Failure) {
    // SAFETY: `delone.h` asks for NULL or a struct that may be written to.
    let Some(error) = (unsafe { error.as_mut() }) else { return };
    // A struct of an older program is shorter, and one without a size is none.
    let before = std::mem::offset_of!(CError, message);
    let Some(room) = (error.size as usize).checked_sub(before) else { return };
    error.status = failure.status as i32;
    error.index = failure.index.map_or(-1, |index| index as i64);
    let Some(last) = room.min(MESSAGE_BYTES).checked_sub(1) else { return };
    let end = (0..=last.min(failure.words.len())).rev().find(|&end| failure.words.is_char_boundary(end));
    let words = &failure.words[..end.unwrap_or_default()];
    for (to, byte) in error.message.iter_mut().zip(words.bytes()) {
        *to = byte as c_char;
    }
    error.message[words.len()] = 0;
}
