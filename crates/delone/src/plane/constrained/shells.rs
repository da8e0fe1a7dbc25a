//! Polygons as formats have them: shells, and holes in each.
//!
//! A hole takes away from its own shell alone, wherever it is, and an area in several holes is taken away once. So the area is that which
//! the author of the file meant, also where holes overlap, or stick out of their shell, or another shell covers them.
//!
//! Cost: that of the walk over the parts (`members`).

use std::collections::BTreeSet;

use super::domains::Domains2;
use super::members::{Windings, odd};
use super::{Constrained2, SegmentId};

impl Constrained2 {
    /// The parts of the hull. Inside are those in a shell and in none of its holes.
    ///
    /// `ring` tells which ring a segment is of, `shells` the shell of each ring: of a shell, itself. A ring is around what an odd number of
    /// its segments is around.
    ///
    /// # Panics
    /// If a ring has no entry in `shells`.
    ///
    /// ```
    /// use delone::Constrained2;
    ///
    /// // A square, and two holes beside each other, which overlap.
    /// let points = [[0, 0], [9, 0], [9, 9], [0, 9], [1, 1], [5, 1], [5, 5], [1, 5], [3, 1], [7, 1], [7, 5], [3, 5]];
    /// let segments: Vec<[usize; 2]> = (0..12).map(|i| [i, i / 4 * 4 + (i + 1) % 4]).collect();
    /// let c = Constrained2::from_parts(&points, &segments)?;
    /// let domains = c.shells_minus_holes(|segment| Some(segment.index() / 4), &[0, 0, 0]);
    /// let inside = c.triangle_ids().filter(|&t| domains.is_inside(t));
    /// assert_eq!(inside.map(|t| c.area(t)).sum::<f64>(), 81.0 - 24.0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn shells_minus_holes(
        &self,
        ring: impl Fn(SegmentId) -> Option<usize>,
        shells: &[usize],
    ) -> Domains2 {
        let mut domains = self.parts();
        let mut is_inside = vec![false; domains.parts.len()];
        self.each_part_within(&domains, ring, |part, windings| is_inside[part] = is_filled(windings, shells));
        domains.parts.iter_mut().zip(is_inside).for_each(|(part, is_inside)| part.is_inside = is_inside);
        domains
    }

    /// The holes that another rule fills in part: these have parts inside that [`Self::shells_minus_holes`] leaves out. By increasing index.
    ///
    /// # Panics
    /// As [`Self::shells_minus_holes`], and for domains of another triangulation.
    ///
    /// ```
    /// use delone::{Constrained2, Fill};
    ///
    /// // Both rings are counter-clockwise.
    /// let points = [[0, 0], [9, 0], [9, 9], [0, 9], [1, 1], [5, 1], [5, 5], [1, 5]];
    /// let segments: Vec<[usize; 2]> = (0..8).map(|i| [i, i / 4 * 4 + (i + 1) % 4]).collect();
    /// let c = Constrained2::from_parts(&points, &segments)?;
    /// let filled = |fill| Ok::<_, delone::Error>(c.filled_holes(&c.domains(&fill)?, |s| Some(s.index() / 4), &[0, 0]));
    /// assert_eq!(filled(Fill::NonZero)?, [1]);
    /// assert!(filled(Fill::EvenOdd)?.is_empty());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn filled_holes(
        &self,
        domains: &Domains2,
        ring: impl Fn(SegmentId) -> Option<usize>,
        shells: &[usize],
    ) -> Vec<usize> {
        let mut filled = BTreeSet::new();
        self.each_part_within(domains, ring, |part, windings| {
            if domains.parts[part].is_inside && !is_filled(windings, shells) {
                filled.extend(odd(windings).filter(|&ring| shells[ring] != ring));
            }
        });
        filled.into_iter().collect()
    }
}

/// Whether an area is in a shell and in none of its holes.
fn is_filled(windings: &Windings, shells: &[usize]) -> bool {
    !filled_shells(&odd(windings).collect(), shells).is_empty()
}

/// The shells among these rings none of whose holes is among them.
pub(super) fn filled_shells(around: &BTreeSet<usize>, shells: &[usize]) -> Vec<usize> {
    let mut all: Vec<usize> =
        around.iter().map(|&ring| shells[ring]).filter(|shell| around.contains(shell)).collect();
    all.sort_unstable();
    all.dedup();
    let is_whole = |shell: &usize| !around.iter().any(|ring| ring != shell && shells[*ring] == *shell);
    all.retain(is_whole);
    all
}
