//! Conflict lists: each triangle keeps the points in it that are still to be inserted.
//!
//! Source: Clarkson & Shor, "Applications of random sampling in computational geometry, II", DCG 1989, in the
//! form of point-in-triangle lists that are updated flip by flip. To insert a point costs no search; a split deals
//! the points of one triangle to three, a flip those of two to two.
//!
//! Cost: O(n log n) expected over random orders: at the r-th of n insertions, about 12 (n - r) / r points move
//! at most. Needs all points beforehand. Choose it to study it.

use super::history::Observer;
use crate::ids::TriangleId;

/// What the lists must know of the geometry.
pub(crate) trait Contains {
    /// Whether a triangle contains the point with this number, in its inside or on its border.
    fn contains(&self, t: TriangleId, point: u32) -> bool;
}

/// The end of a list.
const END: u32 = u32::MAX;

/// The lists, linked through the points.
#[derive(Clone, Debug)]
pub(crate) struct ConflictLists {
    /// For each triangle its first point.
    first: Vec<u32>,
    /// For each point the next one in its list.
    next: Vec<u32>,
    /// For each point its triangle.
    home: Vec<TriangleId>,
    /// How often a point was put into a list.
    pub(crate) moved: u64,
}

impl ConflictLists {
    /// All points in one triangle.
    pub(crate) fn new(points: usize, all: TriangleId) -> Self {
        let next = (1..=points as u32).map(|i| if i == points as u32 { END } else { i }).collect();
        let first = vec![if points == 0 { END } else { 0 }];
        Self { first, next, home: vec![all; points], moved: 0 }
    }

    /// The triangle that contains a point. Valid until the point is inserted.
    pub(crate) fn home(&self, point: u32) -> TriangleId {
        self.home[point as usize]
    }

    /// Puts the points of a list, except for one that has been inserted, into the first triangle that contains
    /// them.
    fn deal<S: Contains>(&mut self, shape: &S, list: u32, new: &[TriangleId]) {
        let mut point = list;
        while point != END {
            let following = self.next[point as usize];
            let inside = |t: &&TriangleId| shape.contains(**t, point);
            let (last, others) = new.split_last().expect("triangles are replaced by triangles");
            let t = *others.iter().find(inside).unwrap_or(last);
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
    pub(crate) fn remove(&mut self, point: u32) {
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

impl<S: Contains> Observer<S> for ConflictLists {
    const KEEPS: bool = false;

    fn split(&mut self, shape: &S, old: TriangleId, new: [TriangleId; 3]) {
        self.reserve(&new);
        let list = self.take(old);
        self.deal(shape, list, &new);
    }

    fn flip(&mut self, shape: &S, old: [TriangleId; 2], new: [TriangleId; 2]) {
        let lists = old.map(|t| self.take(t));
        for list in lists {
            self.deal(shape, list, &new);
        }
    }
}
