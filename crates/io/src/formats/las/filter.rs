//! Which points of LAS files are taken: by class, return, flags, height and place.
//!
//! Source: ASPRS LAS 1.4 R15, tables 7, 8, 9, 14 to 17.

use std::str::FromStr;

use las::PointData;

/// The class that stands for the flag overlap where records have no such bit (formats 0 to 5).
const OVERLAP_CLASS: u8 = 12;

/// Which returns of a pulse are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Returns {
    /// All of them.
    #[default]
    All,
    /// The first.
    First,
    /// The last.
    Last,
    /// The only one.
    Only,
    /// The one of this number, from 1.
    Number(u8),
}

impl FromStr for Returns {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Ok(match text.to_ascii_lowercase().as_str() {
            "all" => Self::All,
            "first" => Self::First,
            "last" => Self::Last,
            "only" => Self::Only,
            number => match number.parse() {
                Ok(number @ 1..=15) => Self::Number(number),
                _ => return Err("returns are all, first, last, only, or a number from 1 to 15".to_owned()),
            },
        })
    }
}

/// A flag of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LasFlag {
    /// Made by something else than a scanner.
    Synthetic,
    /// A key point of a model.
    KeyPoint,
    /// Deleted.
    Withheld,
    /// In the overlap of two strips.
    Overlap,
}

impl LasFlag {
    /// All of them, in the order of [`crate::Cloud::flags`].
    pub const ALL: [Self; 4] = [Self::Synthetic, Self::KeyPoint, Self::Withheld, Self::Overlap];

    /// How it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Synthetic => "synthetic",
            Self::KeyPoint => "key-point",
            Self::Withheld => "withheld",
            Self::Overlap => "overlap",
        }
    }
}

impl FromStr for LasFlag {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let named = Self::ALL.into_iter().find(|flag| text.eq_ignore_ascii_case(flag.name()));
        named.ok_or_else(|| {
            let names = Self::ALL.map(Self::name);
            format!("a flag is one of {}", names.join(", "))
        })
    }
}

/// Which points of LAS, LAZ and EPT are taken: by default all but those withheld.
///
/// ```
/// use delone_io::{LasFilter, Returns};
///
/// let ground = LasFilter::default().classes([2]).returns(Returns::Last).within(Some([0.0, 0.0, 100.0, 100.0]));
/// assert!(!ground.withheld);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct LasFilter {
    /// The classes; all when empty.
    pub classes: Vec<u8>,
    /// The returns.
    pub returns: Returns,
    /// Flags whose points are left out.
    pub skip: Vec<LasFlag>,
    /// Whether points that are withheld are taken too.
    pub withheld: bool,
    /// The least and the largest height.
    pub heights: Option<[f64; 2]>,
    /// A box in the plane with its border: the least x and y, and the largest. Of COPC and EPT, nodes that do not meet it are not read.
    pub within: Option<[f64; 4]>,
}

impl LasFilter {
    /// Sets the classes; all when empty.
    #[must_use]
    pub fn classes(mut self, classes: impl Into<Vec<u8>>) -> Self {
        self.classes = classes.into();
        self
    }

    /// Sets the returns.
    #[must_use]
    pub fn returns(mut self, returns: Returns) -> Self {
        self.returns = returns;
        self
    }

    /// Sets the flags whose points are left out.
    #[must_use]
    pub fn skip(mut self, skip: impl Into<Vec<LasFlag>>) -> Self {
        self.skip = skip.into();
        self
    }

    /// Sets whether points that are withheld are taken too.
    #[must_use]
    pub fn withheld(mut self, withheld: bool) -> Self {
        self.withheld = withheld;
        self
    }

    /// Sets the least and the largest height.
    #[must_use]
    pub fn heights(mut self, heights: Option<[f64; 2]>) -> Self {
        self.heights = heights;
        self
    }

    /// Sets a box in the plane: the least x and y, and the largest.
    #[must_use]
    pub fn within(mut self, within: Option<[f64; 4]>) -> Self {
        self.within = within;
        self
    }
}

/// The attributes of a point.
#[derive(Clone, Copy)]
pub(crate) struct Attributes {
    pub(crate) class: u8,
    /// The number of its return, and of all of its pulse.
    pub(crate) returns: [u8; 2],
    /// As [`LasFlag::ALL`].
    pub(crate) flags: [bool; 4],
}

impl Attributes {
    /// Of each record.
    pub(super) fn of(data: &PointData) -> impl Iterator<Item = Self> + '_ {
        /// The place of the byte of returns, with those of flags and class after it.
        const RETURNS: usize = 14;
        let is_extended = data.format().is_extended;
        data.raw_bytes().chunks_exact(data.record_len()).map(move |record| {
            let byte = |place: usize| record.get(RETURNS + place).copied().unwrap_or_default();
            let bit = |byte: u8, k: u8| byte >> k & 1 == 1;
            if is_extended {
                let (returns, flags) = (byte(0), byte(1));
                Self {
                    class: byte(2),
                    returns: [returns & 15, returns >> 4],
                    flags: [0, 1, 2, 3].map(|k| bit(flags, k)),
                }
            } else {
                let (returns, class) = (byte(0), byte(1));
                Self {
                    class: class & 31,
                    returns: [returns & 7, returns >> 3 & 7],
                    flags: [bit(class, 5), bit(class, 6), bit(class, 7), class & 31 == OVERLAP_CLASS],
                }
            }
        })
    }
}

impl LasFilter {
    /// Whether a point is in the box, if there is one.
    pub(super) fn has(&self, [x, y]: [f64; 2]) -> bool {
        self.within.is_none_or(|[x0, y0, x1, y1]| (x0..=x1).contains(&x) && (y0..=y1).contains(&y))
    }

    /// Whether it takes all points that are not withheld.
    pub(super) fn is_plain(&self) -> bool {
        *self == Self { withheld: self.withheld, ..Self::default() }
    }

    /// Whether a point at this height is taken, but for being withheld.
    pub(super) fn takes(&self, point: Attributes, z: f64) -> bool {
        let [number, count] = point.returns;
        let is_of_returns = match self.returns {
            Returns::All => true,
            Returns::First => number == 1,
            Returns::Last => number == count,
            Returns::Only => count == 1,
            Returns::Number(wanted) => number == wanted,
        };
        let is_skipped =
            LasFlag::ALL.iter().zip(point.flags).any(|(flag, is_set)| is_set && self.skip.contains(flag));
        is_of_returns
            && !is_skipped
            && (self.classes.is_empty() || self.classes.contains(&point.class))
            && self.heights.is_none_or(|[low, high]| (low..=high).contains(&z))
    }
}
