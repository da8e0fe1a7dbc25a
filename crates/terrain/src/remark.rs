//! Remarks: what a user should know of a model that was made.

use std::fmt;

/// A remark on a terrain model.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Remark {
    /// A cell is larger than the area.
    LargeCell {
        /// The side of a cell.
        size: f64,
        /// The size of the area along x and y.
        area: [f64; 2],
    },
    /// A level polygon has several heights, of which the lowest is taken.
    SeveralLevels {
        /// The polygon, from 0 in its file.
        polygon: usize,
        /// The lowest height.
        low: f64,
        /// The highest height.
        high: f64,
    },
    /// Lines cross at different heights, whose means are taken.
    CrossingHeights {
        /// The largest difference.
        widest: f64,
    },
    /// Lines cross, and vertices were added there.
    Crossings {
        /// The number of places.
        count: usize,
    },
    /// Some lines are so near to each other that natural neighbors see across them.
    NearLines,
    /// Vertices were added on lines, so that natural neighbors respect them.
    Added {
        /// Their number.
        count: usize,
    },
}

impl Remark {
    /// Whether the model may not be what was meant.
    pub fn is_warning(&self) -> bool {
        !matches!(self, Self::Crossings { .. } | Self::Added { .. })
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LargeCell { size, area } => {
                write!(f, "a cell of {size} is larger than the area, {} x {}", area[0], area[1])
            }
            Self::SeveralLevels { polygon, low, high } => {
                write!(
                    f,
                    "polygon {polygon} is to be level and has heights from {low} to {high}: the lowest is taken"
                )
            }
            Self::CrossingHeights { widest } => {
                write!(f, "lines cross at heights that differ by up to {widest}: their means are taken")
            }
            Self::Crossings { count } => {
                write!(f, "lines cross at {count} places, where vertices were added")
            }
            Self::NearLines => {
                write!(f, "some lines are so near to each other that natural neighbors see across them")
            }
            Self::Added { count } => {
                write!(f, "{count} vertices were added on lines, so that natural neighbors respect them")
            }
        }
    }
}
