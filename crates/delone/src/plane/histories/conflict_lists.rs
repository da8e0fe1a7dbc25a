//! Conflict lists: each triangle keeps the points in it that are still to be inserted.
//!
//! Source: Clarkson & Shor, "Applications of random sampling in computational geometry, II", DCG 1989, in the
//! form of point-in-triangle lists that are updated flip by flip. To insert a point costs no search; a split deals
//! the points of one triangle to three, a flip those of two to two.
//!
//! Cost: O(n log n) expected over random orders: at the r-th of n insertions, about 12 (n - r) / r points move
//! at most. Needs all points beforehand. Choose it to study it.

use super::history::{Fork, Observer};
use crate::ids::TriangleId;
use crate::tally::Tally;

/// The geometry as lists and histories see it.
pub(super) trait Branch {
    /// The point with this number.
    fn numbered(&self, point: u32) -> [f64; 2];

    /// Which of the triangles that took the place of one that contained a point contains it now, in its inside or on its
    /// border.
    fn branch<T: Tally>(&self, fork: Fork, q: [f64; 2], tally: &mut T) -> TriangleId;
}

/// The end of a list.
const END: u32 = u32::MAX;

/// The lists, linked through the points.
#[derive(Clone, Debug)]
pub(super) struct ConflictLists {
    /// For each triangle its first point.
    first: Vec<u32>,
    /// For each point the next one in its list.
    next: Vec<u32>,
    /// For each point its triangle.
    home: Vec<TriangleId>,
    /// How often a point was put into a list.
    pub(super) moved: u64,
}

impl ConflictLists {
    /// All points in one triangle.
    pub(super) fn new(points: usize, all: TriangleId) -> Self {
        let next = (1..=points as u32).map(|i| if i == points as u32 { END } else { i }).collect();
        let first = vec![if points == 0 { END } else { 0 }];
        Self { first, next, home: vec![all; points], moved: 0 }
    }

    /// The triangle that contains a point. Valid until the point is inserted.
    pub(super) fn home(&self, point: u32) -> TriangleId {
        self.home[point as usize]
    }

    /// Puts the points of a list, except for one that has been inserted, into a triangle that contains them.
    fn deal<S: Branch, T: Tally>(&mut self, shape: &S, list: u32, fork: Fork, tally: &mut T) {
        let mut point = list;
        while point != END {
            let following = self.next[point as usize];
            let t = shape.branch(fork, shape.numbered(point), tally);
            self.next[point as usize] = std::mem::replace(&mut self.first[t.index()], point);
            self.home[point as usize] = t;
            self.moved += 1;
            point = following;
        }
    }

    /// Takes the list of a triangle away.
    fn take(&mut self, t: TriangleId) -> u32 {
        std::mem::replace(&mut self.first[t.index()], END)
    }

    fn reserve(&mut self, new: &[TriangleId]) {
        let last = new.iter().map(|t| t.index()).max().unwrap_or(0);
        if self.first.len() <= last {
            self.first.resize(last + 1, END);
        }
    }

    /// Forgets a point that has been inserted or set aside.
    pub(super) fn remove(&mut self, point: u32) {
        let t = self.home(point);
        let mut link = self.first[t.index()];
        if link == point {
            self.first[t.index()] = self.next[point as usize];
            return;
        }
        while self.next[link as usize] != point {
            link = self.next[link as usize];
        }
        self.next[link as usize] = self.next[point as usize];
    }
}

impl<S: Branch> Observer<S> for ConflictLists {
    const KEEPS: bool = false;

    fn split<T: Tally>(&mut self, shape: &S, old: TriangleId, new: [TriangleId; 3], tally: &mut T) {
        self.reserve(&new);
        let list = self.take(old);
        self.deal(shape, list, Fork::Split(new), tally);
    }

    fn flip<T: Tally>(&mut self, shape: &S, old: [TriangleId; 2], new: [TriangleId; 2], tally: &mut T) {
        let lists = old.map(|t| self.take(t));
        for list in lists {
            self.deal(shape, list, Fork::Flip(new), tally);
        }
    }
}
