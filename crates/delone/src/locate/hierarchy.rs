//! The Delaunay hierarchy: triangulations of ever larger random samples, the last of them of all points.
//!
//! Source: Devillers, "Improved incremental randomized Delaunay triangulation", SoCG 1998 (INRIA report 3298).
//! Each vertex of a level belongs to the level above with probability 1 / ratio. A query is located from the
//! top: at each level in three phases from the vertex found above,
//!
//! 1. turn around the vertex to the triangle on the line to the query,
//! 2. walk along the line to the triangle that contains the query,
//! 3. find the nearest vertex ([`Nearest`]).
//!
//! At the top a few vertices are drawn at random and the nearest of them is the start (the mixed method of
//! §4.5).
//!
//! Cost: O(ratio log n / log ratio) expected for any data (Theorem 6), the randomness being the sample's, if the query is a
//! random one of the points and phase 3 is by circles. With the modified phase 3, the default here as in the paper's code, and
//! with the one by angles, that is what is seen on all data but those made against them: on the set `hub` both are linear, the
//! first as the appendix of the paper says. A sample on one line, in the plane, is searched as a sorted line, in O(log n).
//! O(n ratio / (ratio - 1)) memory. Insertion and removal work on all levels of a vertex, O(1) of them expected. Choose it where
//! points come in adversarial order or many are removed.

use super::{JumpAndWalk, Walk};
use crate::error::Error;

/// Levels that shrink less would be without number.
const SMALLEST_RATIO: f64 = 1.25;

/// Phase 3 of the search in a level: which vertex the search in the level below starts from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Nearest {
    /// The nearest corner of the triangle that contains the query: three comparisons, the modified phase of §4.3.
    #[default]
    Corner,
    /// The nearest vertex, by searching outwards from that triangle and crossing an edge only if the angle at its nearer end,
    /// towards the query, is acute (§2.2). In space by following edges downhill.
    Exact,
    /// The nearest vertex, among the corners of all triangles whose circles contain the query (§5.2): its neighbors, if it were
    /// a vertex, which are fewer than six on average over queries that are random ones of the points. In the plane.
    InCircle,
}

/// Parameters of the hierarchy: those of §5.4 of the paper, with its defaults, and the choices that it discusses.
///
/// ```
/// use delone::{Delaunay2, Hierarchy, Locate};
///
/// let steep = Hierarchy::default().ratio(3.0).levels(4).seed(1);
/// assert_eq!((steep.ratio, steep.levels, steep.rho), (3.0, Some(4), 1.0));
/// let mut d = Delaunay2::with_strategy(Locate::Hierarchy(steep))?;
/// d.insert([0.0, 0.0])?;
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Hierarchy {
    /// How many times smaller each level is than the one below; at least 1.25, so that all levels together have at most
    /// five times the vertices.
    pub ratio: f64,
    /// The largest number of levels, the triangulation itself included; unlimited if `None`.
    pub levels: Option<usize>,
    /// A level with fewer vertices is not used to locate points; one, at least.
    pub smallest_level: usize,
    /// From this number of vertices on, the search in the highest level starts from a random sample; `None`
    /// never samples.
    pub smallest_sampled: Option<usize>,
    /// The factor of the sample's size, as in [`JumpAndWalk::rho`].
    pub rho: f64,
    /// Whether a vertex may be drawn twice, as in [`JumpAndWalk::with_replacement`].
    pub with_replacement: bool,
    /// Phase 3.
    pub nearest: Nearest,
    /// Phases 1 and 2. If `None`, along the straight line in the plane, as in the paper, and by visibility in space.
    pub walk: Option<Walk>,
    /// Decides the levels of vertices.
    pub seed: u64,
}

impl Default for Hierarchy {
    fn default() -> Self {
        Self {
            ratio: 30.0,
            levels: None,
            smallest_level: 20,
            smallest_sampled: Some(20),
            rho: 1.0,
            with_replacement: false,
            nearest: Nearest::default(),
            walk: None,
            seed: 0,
        }
    }
}

impl Hierarchy {
    /// The paper's mode "walk": one level, no sample.
    pub fn only_walk() -> Self {
        Self { levels: Some(1), smallest_sampled: None, ..Self::default() }
    }

    /// The paper's mode "MSZ": one level, with a sample.
    pub fn only_sample() -> Self {
        Self { levels: Some(1), ..Self::default() }
    }

    /// The paper's mode "hierarchy": levels, no sample.
    pub fn only_levels() -> Self {
        Self { smallest_sampled: None, ..Self::default() }
    }

    /// Sets [`Self::ratio`].
    #[must_use]
    pub fn ratio(self, ratio: f64) -> Self {
        Self { ratio, ..self }
    }

    /// Sets [`Self::levels`]: a number, or `None`.
    #[must_use]
    pub fn levels(self, levels: impl Into<Option<usize>>) -> Self {
        Self { levels: levels.into(), ..self }
    }

    /// Sets [`Self::smallest_level`].
    #[must_use]
    pub fn smallest_level(self, smallest_level: usize) -> Self {
        Self { smallest_level, ..self }
    }

    /// Sets [`Self::smallest_sampled`]: a number, or `None`.
    #[must_use]
    pub fn smallest_sampled(self, count: impl Into<Option<usize>>) -> Self {
        Self { smallest_sampled: count.into(), ..self }
    }

    /// Sets [`Self::rho`].
    #[must_use]
    pub fn rho(self, rho: f64) -> Self {
        Self { rho, ..self }
    }

    /// Sets [`Self::with_replacement`].
    #[must_use]
    pub fn with_replacement(self, with_replacement: bool) -> Self {
        Self { with_replacement, ..self }
    }

    /// Sets [`Self::nearest`].
    #[must_use]
    pub fn nearest(self, nearest: Nearest) -> Self {
        Self { nearest, ..self }
    }

    /// Sets [`Self::walk`]: a walk, or `None`.
    #[must_use]
    pub fn walk(self, walk: impl Into<Option<Walk>>) -> Self {
        Self { walk: walk.into(), ..self }
    }

    /// Sets [`Self::seed`].
    #[must_use]
    pub fn seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        if !(self.ratio >= SMALLEST_RATIO && self.ratio.is_finite()) {
            return Err(Error::Parameter {
                name: "ratio",
                value: self.ratio,
                range: "at least 1.25 and finite",
            });
        }
        if self.levels == Some(0) {
            return Err(Error::Parameter { name: "levels", value: 0.0, range: "at least 1" });
        }
        self.sampling().validate()
    }

    /// How the search in the highest level starts.
    pub(super) fn sampling(&self) -> JumpAndWalk {
        JumpAndWalk { rho: self.rho, sample: None, with_replacement: self.with_replacement, seed: self.seed }
    }
}
