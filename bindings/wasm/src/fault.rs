//! Faults, as a code and numbers; `js/errors.js` has the words, by the same codes.

use std::cell::Cell;

use delone_library::{Error, RegionProblem};

/// A code, and what is known: indices, coordinates, counts.
#[derive(Clone, Copy, Debug)]
pub struct Fault {
    code: u32,
    facts: [f64; 5],
}

impl Fault {
    /// A triangulation that is gone.
    pub const DISPOSED: Self = Self { code: 1, facts: [0.0; 5] };
    /// A check that failed.
    #[cfg(feature = "changes")]
    pub const FLAW: Self = Self { code: 2, facts: [0.0; 5] };

    /// Memory that there is not.
    pub fn memory(bytes: usize) -> Self {
        Self::new(3, [bytes as f64])
    }

    /// A number that is not in its range.
    pub fn range(value: f64) -> Self {
        Self::new(14, [value])
    }

    fn new<const N: usize>(code: u32, known: [f64; N]) -> Self {
        let mut facts = [0.0; 5];
        facts[..N].copy_from_slice(&known);
        Self { code, facts }
    }
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        let n = |index: usize| index as f64;
        match error {
            Error::NotFinite { index, axis, value } => Self::new(4, [n(index), n(axis), value]),
            Error::Coordinate { axis, value } => Self::new(5, [n(axis), value]),
            Error::TooManyPoints { count, most } => Self::new(6, [n(count), n(most)]),
            Error::NoSuchVertex { vertex } => Self::new(7, [n(vertex.index())]),
            Error::Occupied { vertex } => Self::new(8, [n(vertex.index())]),
            Error::NoSuchPoint { segment, index, count } => Self::new(9, [n(segment), n(index), n(count)]),
            Error::SegmentsCross { first, second, near, count } => {
                Self::new(10, [n(first), n(second), near[0], near[1], n(count)])
            }
            Error::NoLength { vertex } => Self::new(11, [n(vertex.index())]),
            Error::NoSuchSegment { segment } => Self::new(12, [n(segment)]),
            Error::ConstraintsEnd { vertex, count } => Self::new(13, [n(vertex.index()), n(count)]),
            Error::Parameter { value, .. } => Self::range(value),
            Error::Region { ring, corner, problem } => {
                let problem = match problem {
                    RegionProblem::NotFinite => 0.0,
                    RegionProblem::Empty => 1.0,
                    RegionProblem::VisitedTwice => 2.0,
                    _ => 3.0,
                };
                Self::new(15, [n(ring), n(corner), problem])
            }
            Error::Height { index, value } => Self::new(16, [n(index), value]),
            Error::Weight { index, value } => Self::new(18, [n(index), value]),
            Error::Values { expected, found } => Self::new(17, [n(expected), n(found)]),
            // Nothing that this module asks for gives others.
            _ => Self::new(0, []),
        }
    }
}

thread_local! {
    static LAST: Cell<Fault> = const { Cell::new(Fault { code: 0, facts: [0.0; 5] }) };
}

/// The answer, or -1 and a fault to be asked for.
pub fn answer(result: Result<i32, Fault>) -> i32 {
    result.unwrap_or_else(|fault| {
        LAST.set(fault);
        -1
    })
}

export! {
    /// The code of the last fault.
    fn fault_code() -> u32 {
        LAST.get().code
    }

    /// A number of the last fault.
    fn fault_fact(k: usize) -> f64 {
        LAST.get().facts.get(k).copied().unwrap_or_default()
    }
}
