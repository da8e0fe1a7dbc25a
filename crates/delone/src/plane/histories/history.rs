//! History: all versions of the triangulation on top of one another.
//!
//! Source: Guibas, Knuth & Sharir, "Randomized incremental construction of Delaunay and Voronoi diagrams",
//! Algorithmica 1992, §3. A triangle that is split or flipped stays, and points to the two or three triangles
//! that took its place. A point is located by tracing, from the first triangle, the triangles that contain it in
//! the order in which they came to be: two orientations decide among three, one between two.
//!
//! Cost: O(n) memory and O(log n) triangles a location, both expected over random orders of insertion and
//! amortized; linear in n for an unlucky query. Nothing is ever forgotten, so nothing can be removed. Choose it to
//! study the randomized incremental construction.

use super::conflict_lists::Branch;
use crate::ids::TriangleId;
use crate::tally::Tally;

/// The triangles that replaced a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fork {
    /// The three triangles around a new point.
    Split([TriangleId; 3]),
    /// The two triangles that a flip made.
    Flip([TriangleId; 2]),
}

/// Hears of every split and flip. `shape` tells the geometry after the change.
pub(super) trait Observer<S> {
    /// Whether triangles that are gone keep their numbers. Those that a change makes are numbered in a row then.
    const KEEPS: bool;

    /// A triangle was replaced by three.
    fn split<T: Tally>(&mut self, shape: &S, old: TriangleId, new: [TriangleId; 3], tally: &mut T);

    /// Two triangles were replaced by two.
    fn flip<T: Tally>(&mut self, shape: &S, old: [TriangleId; 2], new: [TriangleId; 2], tally: &mut T);
}

/// For each triangle that ever was those that took its place.
#[derive(Clone, Debug, Default)]
pub(super) struct History {
    /// Twice the first of them, and one more where they are three. Zero as long as it is present.
    forks: Vec<u32>,
}

impl History {
    /// Memory in bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.forks)
    }

    fn follow(&mut self, old: TriangleId, new: &[TriangleId]) {
        debug_assert!(new.windows(2).all(|pair| pair[0].index() + 1 == pair[1].index()), "in a row");
        let last = new[0].index().max(old.index()) + new.len();
        if self.forks.len() < last {
            self.forks.resize(last, 0);
        }
        self.forks[old.index()] = 2 * new[0].index() as u32 + u32::from(new.len() == 3);
    }

    /// The triangles that replaced a triangle, unless it is present.
    pub(super) fn fork(&self, t: TriangleId) -> Option<Fork> {
        let fork = self.forks.get(t.index()).copied().filter(|fork| *fork != 0)?;
        let new = |k: u32| TriangleId::new((fork / 2 + k) as usize);
        Some(if fork % 2 == 1 { Fork::Split([0, 1, 2].map(new)) } else { Fork::Flip([0, 1].map(new)) })
    }

    /// Traces the triangles that contain a point from the first one, which contains everything, to a present one.
    pub(super) fn trace<S: Branch, T: Tally>(&self, shape: &S, q: [f64; 2], tally: &mut T) -> TriangleId {
        let mut at = TriangleId::new(0);
        tally.visited();
        while let Some(fork) = self.fork(at) {
            at = shape.branch(fork, q, tally);
            tally.visited();
        }
        at
    }
}

impl<S> Observer<S> for History {
    const KEEPS: bool = true;

    fn split<T: Tally>(&mut self, _: &S, old: TriangleId, new: [TriangleId; 3], _: &mut T) {
        self.follow(old, &new);
    }

    fn flip<T: Tally>(&mut self, _: &S, old: [TriangleId; 2], new: [TriangleId; 2], _: &mut T) {
        for t in old {
            self.follow(t, &new);
        }
    }
}
