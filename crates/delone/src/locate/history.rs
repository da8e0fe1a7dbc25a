//! History: all versions of the triangulation on top of one another.
//!
//! Source: Guibas, Knuth & Sharir, "Randomized incremental construction of Delaunay and Voronoi diagrams",
//! Algorithmica 1992, §3. A triangle that is split or flipped stays, and points to the two or three triangles
//! that took its place. A point is located by tracing, from the first triangle, the triangles that contain it in
//! the order in which they came to be.
//!
//! Cost: O(n) memory and O(log n) triangles a location, both expected over random orders of insertion and
//! amortized; linear in n for an unlucky query. Nothing is ever forgotten, so nothing can be removed. Choose it to
//! study the randomized incremental construction.

use crate::ids::TriangleId;
use crate::tally::Tally;

/// Hears of every split and flip. `shape` tells the geometry after the change.
pub(crate) trait Observer<S> {
    /// Whether triangles that are gone keep their numbers.
    const KEEPS: bool;

    /// A triangle was replaced by three.
    fn split(&mut self, shape: &S, old: TriangleId, new: [TriangleId; 3]);

    /// Two triangles were replaced by two.
    fn flip(&mut self, shape: &S, old: [TriangleId; 2], new: [TriangleId; 2]);
}

/// For each triangle that ever was those that took its place.
#[derive(Clone, Debug, Default)]
pub(crate) struct History {
    successors: Vec<[Option<TriangleId>; 3]>,
}

impl History {
    /// What it takes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.successors)
    }

    fn follow(&mut self, old: TriangleId, new: [Option<TriangleId>; 3]) {
        let last = new.iter().flatten().map(|t| t.index()).max().unwrap_or(0).max(old.index());
        if self.successors.len() <= last {
            self.successors.resize(last + 1, [None; 3]);
        }
        self.successors[old.index()] = new;
    }

    /// Traces the triangles for which `contains` holds from the first one to a present one. The first contains
    /// everything, and each contains what its successors contain.
    pub(crate) fn trace<T: Tally>(
        &self,
        mut contains: impl FnMut(TriangleId) -> bool,
        tally: &mut T,
    ) -> TriangleId {
        let mut at = TriangleId::new(0);
        loop {
            tally.visited();
            let [Some(first), Some(second), third] =
                self.successors.get(at.index()).copied().unwrap_or_default()
            else {
                return at;
            };
            // One of them contains it: the last need not be asked.
            at = match third {
                _ if contains(first) => first,
                None => second,
                Some(_) if contains(second) => second,
                Some(third) => third,
            };
        }
    }
}

impl<S> Observer<S> for History {
    const KEEPS: bool = true;

    fn split(&mut self, _: &S, old: TriangleId, new: [TriangleId; 3]) {
        self.follow(old, new.map(Some));
    }

    fn flip(&mut self, _: &S, old: [TriangleId; 2], new: [TriangleId; 2]) {
        for t in old {
            self.follow(t, [Some(new[0]), Some(new[1]), None]);
        }
    }
}
