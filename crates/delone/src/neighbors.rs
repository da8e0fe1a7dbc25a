//! Nearest points without a triangulation: a k-d tree that holds its points, for those who ask many times by distance alone.
//!
//! Source: Bentley, "Multidimensional binary search trees used for associative searching", CACM 1975; Arya & Mount, "Algorithms
//! for fast vector quantization", 1993, for the distance of a cell, which is updated on the way down.
//!
//! The points of a leaf are next to each other in memory, which is what a query waits for: a triangulation's own are elsewhere,
//! and so are their neighbors. Floating point passes by cells that are surely too far away, by a proven bound; whichever of two
//! points is nearer is decided exactly, so that answers are those of the triangulations.
//!
//! Cost: O(n log n) to build, 21 bytes a point in the plane and 29 in space; O(log n) expected for the nearest, O(k log n) for k, on evenly
//! spread points. O(n) where all are as near, or much further from the query than from each other: there the triangulations answer
//! faster.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::ops::Range;
use std::sync::atomic::AtomicU64;
use std::sync::atomic::Ordering::Relaxed;

use delone_predicates::{
    compare_distances, compare_distances3, compare_with_radius, compare_with_radius3, is_surely_further,
    lexicographic, lexicographic3,
};

use crate::error::Error;
use crate::ids::MAX_POINTS;
use crate::order::quantize::power_to_one;
use crate::parallel;
use crate::points::{Position2, Position3, check_count, check_finite, finite};

/// Points a leaf, at most.
const LEAF: usize = 8;
/// Points, above which a subtree is built by another thread; below, starting the thread costs more.
const PARALLEL_POINTS: usize = 1 << 14;
/// Levels of the largest tree.
const LEVELS: usize = 32;

/// A set of points of the plane that is asked for those near others. Answers are indices of points.
///
/// ```
/// use delone::Neighbors2;
///
/// let tree = Neighbors2::from_points(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]])?;
/// assert_eq!(tree.nearest([3.0, 1.0])?, Some(1));
/// assert_eq!(tree.nearest([2.0, 2.0])?, Some(0)); // all three are as near
/// assert_eq!(tree.k_nearest([3.0, 1.0], 2)?, [1, 0]);
/// assert_eq!(tree.within([0.0, 0.0], 4.0)?, [0, 1, 2]);
/// # Ok::<(), delone::Error>(())
/// ```
pub type Neighbors2 = Neighbors<2>;

/// A tree of points in space.
pub type Neighbors3 = Neighbors<3>;

/// See [`Neighbors2`] and [`Neighbors3`].
#[derive(Clone, Debug)]
pub struct Neighbors<const D: usize> {
    /// For each inner node, from the root at 1, the coordinate that splits its points. Axes alternate from level to level.
    splits: Vec<f64>,
    /// Leaf by leaf.
    points: Vec<[f64; D]>,
    /// Their indices.
    indices: Vec<u32>,
    /// A power of two that differences are multiplied with, so that squares stay in range.
    scale: f64,
}

/// The exact decisions, by dimension.
trait Exact: Copy {
    fn compare(self, a: Self, b: Self) -> Ordering;
    fn has_within(self, a: Self, radius: f64) -> bool;
    fn lexicographic(self, b: Self) -> Ordering;
}

impl<const D: usize> Exact for [f64; D] {
    #[inline]
    fn compare(self, a: Self, b: Self) -> Ordering {
        match (self.first_chunk::<3>(), a.first_chunk::<3>(), b.first_chunk::<3>()) {
            (Some(q), Some(a), Some(b)) => compare_distances3(*q, *a, *b),
            _ => compare_distances([self[0], self[1]], [a[0], a[1]], [b[0], b[1]]),
        }
    }

    #[inline]
    fn has_within(self, a: Self, radius: f64) -> bool {
        match (self.first_chunk::<3>(), a.first_chunk::<3>()) {
            (Some(q), Some(a)) => compare_with_radius3(*q, *a, radius).is_le(),
            _ => compare_with_radius([self[0], self[1]], [a[0], a[1]], radius).is_le(),
        }
    }

    #[inline]
    fn lexicographic(self, b: Self) -> Ordering {
        match (self.first_chunk::<3>(), b.first_chunk::<3>()) {
            (Some(a), Some(b)) => lexicographic3(*a, *b),
            _ => lexicographic([self[0], self[1]], [b[0], b[1]]),
        }
    }
}

impl Neighbors<2> {
    /// Takes points. Equal ones may be among them: the first of these is found first.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate; [`Error::TooManyPoints`].
    pub fn from_points<P: Position2>(points: &[P]) -> Result<Self, Error> {
        Self::build(points.iter().map(Position2::xy).collect())
    }
}

impl Neighbors<3> {
    /// Takes points. Equal ones may be among them: the first of these is found first.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate; [`Error::TooManyPoints`].
    pub fn from_points<P: Position3>(points: &[P]) -> Result<Self, Error> {
        Self::build(points.iter().map(Position3::xyz).collect())
    }
}

/// A point and its index.
type Named<const D: usize> = ([f64; D], u32);

/// A part of the tree to be looked at.
#[derive(Clone, Copy)]
struct Waiting<const D: usize> {
    node: usize,
    /// How far its cell is along each axis, and the square of its distance.
    gaps: [f64; D],
    squared: f64,
}

impl<const D: usize> Neighbors<D> {
    fn build(points: Vec<[f64; D]>) -> Result<Self, Error> {
        check_count(points.len(), MAX_POINTS)?;
        check_finite(points.iter().copied())?;
        let size = points.as_flattened().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let levels = points.len().div_ceil(LEAF).next_power_of_two().ilog2();
        let splits: Vec<AtomicU64> = (0..1 << levels).map(|_| AtomicU64::new(0)).collect();
        let mut named: Vec<Named<D>> = points.into_iter().zip(0..).collect();
        let whole = Subtree { node: 1, axis: 0, start: 0, count: named.len() };
        split(&mut named, whole, &splits);
        Ok(Self {
            splits: splits.into_iter().map(|bits| f64::from_bits(bits.into_inner())).collect(),
            points: parallel::collect(named.len(), |k| named[k].0),
            indices: parallel::collect(named.len(), |k| named[k].1),
            scale: power_to_one(size, &(1e-30..1e30)).unwrap_or(1.0),
        })
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// The point nearest to another one; of several at the same distance the lexicographically smallest, and of equal points
    /// the first. `None` if there are none.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    pub fn nearest(&self, q: [f64; D]) -> Result<Option<usize>, Error> {
        let q = finite(q)?;
        let mut best = None;
        self.search(q, f64::INFINITY, |leaf, mut limit| {
            for at in leaf {
                let squared = self.squared(q, at);
                if !is_surely_further(squared, limit)
                    && best.is_none_or(|best| self.nearer(q, at, best).is_lt())
                {
                    (best, limit) = (Some(at), squared);
                }
            }
            limit
        });
        Ok(best.map(|at| self.indices[at] as usize))
    }

    /// The k points nearest to another one, nearest first, ties as in [`Self::nearest`]; all of them if there are fewer.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    pub fn k_nearest(&self, q: [f64; D], k: usize) -> Result<Vec<usize>, Error> {
        if k == 1 {
            return Ok(self.nearest(q)?.into_iter().collect());
        }
        let q = finite(q)?;
        let mut found = BinaryHeap::with_capacity(k.min(self.len()));
        // If there are fewer than k, all are found.
        let furthest = if k == 0 { -1.0 } else { f64::INFINITY };
        self.search(q, furthest, |leaf, mut limit| {
            for at in leaf {
                let squared = self.squared(q, at);
                if is_surely_further(squared, limit) {
                    continue;
                }
                let candidate = Candidate { tree: self, q, at, squared };
                if found.len() < k {
                    found.push(candidate);
                } else if let Some(mut last) = found.peek_mut()
                    && candidate < *last
                {
                    *last = candidate;
                }
                if let Some(last) = found.peek().filter(|_| found.len() == k) {
                    limit = last.squared;
                }
            }
            limit
        });
        Ok(found.into_sorted_vec().into_iter().map(|candidate| self.indices[candidate.at] as usize).collect())
    }

    /// The points at most `radius` away from another one, by increasing index. None for a negative radius.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities, [`Error::Parameter`] for a radius that is not finite.
    pub fn within(&self, q: [f64; D], radius: f64) -> Result<Vec<usize>, Error> {
        let q = finite(q)?;
        if !radius.is_finite() {
            return Err(Error::Parameter { name: "radius", value: radius, range: "finite" });
        }
        let mut found = Vec::new();
        let limit = (radius * self.scale) * (radius * self.scale);
        self.search(q, limit, |leaf, limit| {
            found.extend(leaf.filter(|&at| q.has_within(self.points[at], radius)));
            limit
        });
        let mut found: Vec<usize> = found.into_iter().map(|at| self.indices[at] as usize).collect();
        found.sort_unstable();
        Ok(found)
    }

    /// Looks at leaves, near ones first, but for those whose cells are surely further away than the square root of a limit,
    /// which each visit may lower.
    #[inline]
    fn search(&self, q: [f64; D], mut limit: f64, mut visit: impl FnMut(Range<usize>, f64) -> f64) {
        let leaves = self.splits.len();
        let mut stack = [Waiting { node: 1, gaps: [0.0; D], squared: 0.0 }; LEVELS];
        let mut waiting = 1;
        while waiting > 0 {
            waiting -= 1;
            let Waiting { mut node, gaps, squared } = stack[waiting];
            if is_surely_further(squared, limit) {
                continue;
            }
            let mut axis = node.ilog2() as usize % D;
            while node < leaves {
                let gap = (q[axis] - self.splits[node]) * self.scale;
                let is_high = gap >= 0.0;
                let mut gaps = gaps;
                gaps[axis] = gap;
                let squared = gaps.iter().map(|gap| gap * gap).sum();
                stack[waiting] = Waiting { node: 2 * node + usize::from(!is_high), gaps, squared };
                waiting += 1;
                node = 2 * node + usize::from(is_high);
                axis = if axis + 1 == D { 0 } else { axis + 1 };
            }
            let leaf = node - leaves;
            let end = |leaf: usize| share(self.points.len(), leaf, leaves);
            limit = visit(end(leaf)..end(leaf + 1), limit);
        }
    }

    /// The square of the distance of a point, scaled and rounded.
    #[inline]
    fn squared(&self, q: [f64; D], at: usize) -> f64 {
        let p = self.points[at];
        (0..D).map(|k| (p[k] - q[k]) * self.scale).map(|gap| gap * gap).sum()
    }

    /// By distance, then lexicographically, then by index.
    #[inline]
    fn nearer(&self, q: [f64; D], a: usize, b: usize) -> Ordering {
        let (p, r) = (self.points[a], self.points[b]);
        q.compare(p, r).then_with(|| p.lexicographic(r)).then_with(|| self.indices[a].cmp(&self.indices[b]))
    }
}

/// Where so many of equal parts of a number end, about; `of` is a power of two.
#[inline]
fn share(count: usize, parts: usize, of: usize) -> usize {
    ((count as u64 * parts as u64) >> of.trailing_zeros()) as usize
}

/// A node, and its points.
struct Subtree {
    node: usize,
    axis: usize,
    /// The position of the first.
    start: usize,
    /// The number of all points of the tree.
    count: usize,
}

/// Puts the median of points in their middle, smaller ones before it, and so on for both sides, down to leaves.
fn split<const D: usize>(points: &mut [Named<D>], subtree: Subtree, splits: &[AtomicU64]) {
    let Subtree { node, axis, start, count } = subtree;
    if node >= splits.len() {
        return;
    }
    let width = 1 << node.ilog2();
    let middle = share(count, 2 * (node - width) + 1, 2 * width) - start;
    if middle < points.len() {
        points.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]));
        splits[node].store(points[middle].0[axis].to_bits(), Relaxed);
    }
    let axis = (axis + 1) % D;
    let is_large = points.len() > PARALLEL_POINTS;
    let (low, high) = points.split_at_mut(middle);
    let mut low = || split(low, Subtree { node: 2 * node, axis, start, count }, splits);
    let mut high = || split(high, Subtree { node: 2 * node + 1, axis, start: start + middle, count }, splits);
    if is_large {
        parallel::join(low, high);
    } else {
        low();
        high();
    }
}

/// One of the k nearest so far. The greatest is the furthest.
struct Candidate<'a, const D: usize> {
    tree: &'a Neighbors<D>,
    q: [f64; D],
    at: usize,
    /// The square of its distance, scaled and rounded.
    squared: f64,
}

impl<const D: usize> PartialEq for Candidate<'_, D> {
    fn eq(&self, other: &Self) -> bool {
        self.at == other.at
    }
}

impl<const D: usize> Eq for Candidate<'_, D> {}

impl<const D: usize> Ord for Candidate<'_, D> {
    #[inline]
    fn cmp(&self, other: &Self) -> Ordering {
        if is_surely_further(self.squared, other.squared) {
            Ordering::Greater
        } else if is_surely_further(other.squared, self.squared) {
            Ordering::Less
        } else {
            self.tree.nearer(self.q, self.at, other.at)
        }
    }
}

impl<const D: usize> PartialOrd for Candidate<'_, D> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
