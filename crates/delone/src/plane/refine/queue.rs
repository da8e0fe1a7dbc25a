//! The queue of faults. Its order is a function of the geometry, so the mesh depends on the input alone, whatever the order of
//! the points, and whatever memory looks like.
//!
//! Constraints come first, then triangles with a small angle, then those that are too large. Among equals short edges come
//! first, in classes a quarter of an octave wide (Shewchuk, CGTA 2002, has such classes). Inside of a class what is near in the
//! plane is near in time, along a Morton curve, because each step costs cache misses otherwise; but a few come first, chosen by a
//! hash of the place, because of what happens with n corners on a circle: every new vertex there would take the other O(n)
//! triangles over from the one before (the rounds are those of Amenta, Choi & Rote, "Incremental constructions con BRIO", SoCG
//! 2003). What is left of ties is decided by the corners.
//!
//! For steep angles the queue works *in batches*: small angles and large triangles are one kind, and what comes up while a batch of a class is
//! mended waits for the next batch. Near the steepest angle that refinement reaches, a vertex often makes the next fault beside it. Depth first,
//! along the curve, one place is refined without end while others wait. Breadth first, as in Shewchuk's Triangle, makes half as many triangles
//! at 34 degrees. It costs locality: below [`STEEP_ANGLE`] it would take twice as long for the same meshes.
//!
//! Cost: O(log n); 24 bytes an entry.

use std::cmp::{Ordering, Reverse};

use delone_predicates::lexicographic;

use crate::ids::{EdgeId, Place};
use crate::points::Bounds;

/// A kind of fault. Kinds are mended in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Fault {
    /// A constraint with a vertex too near to it.
    Constraint,
    /// A constraint that is too long, or in the way of what is too large.
    LargeConstraint,
    /// A triangle with a small angle.
    Angle,
    /// A triangle that is too large.
    Size,
}

/// Something to be mended: a constraint, the third corner the ghost, or a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Task {
    key: u64,
    /// The constraint, or the shortest edge of the triangle.
    pub(super) edge: EdgeId,
    /// Its corners, from the origin of the edge on.
    pub(super) corners: [Place; 3],
}

impl Task {
    /// The kind of fault.
    pub(super) fn fault(&self) -> Fault {
        match self.key >> CLASS {
            0 => Fault::Constraint,
            1 => Fault::LargeConstraint,
            2 => Fault::Angle,
            _ => Fault::Size,
        }
    }

    /// Whether two are the same, at the same time.
    pub(super) fn is(&self, other: &Self) -> bool {
        self.key == other.key && self.corners == other.corners
    }
}

/// Bits of a key, from the top: two for the fault, 11 of exponent and one of mantissa for a squared length, four for the round,
/// and the rest for a place.
const CLASS: u32 = 62;
const LENGTH: u32 = 50;
const ROUND: u32 = 46;
const AXIS: u32 = 23;
/// Each round but the last has one sixteenth of the tasks of the next one: so many leading zeros of the hash.
const SHARE: u32 = 4;
const ROUNDS: u32 = 5;
/// Fibonacci hashing: the highest bits depend on all.
const HASH: u64 = 0x9e37_79b9_7f4a_7c15;

/// Degrees, above which the queue works in batches. On a unit square, a box and a plate of 100 holes the numbers of triangles at 31 degrees
/// are the same either way.
pub(super) const STEEP_ANGLE: f64 = 31.0;

/// See the module.
#[derive(Clone, Debug)]
pub(super) struct Queue {
    /// By the kind of fault and the length.
    classes: Vec<(u64, Class)>,
    in_batches: bool,
    /// All before this one are empty.
    first: usize,
    low: [f64; 2],
    scale: [f64; 2],
}

/// Tasks of a class: most of them are sorted when the first one is taken, what comes later is in a heap. In batches it is no heap, and waits.
#[derive(Clone, Debug, Default)]
struct Class {
    /// The last one first.
    sorted: Vec<Task>,
    heap: Vec<Task>,
}

impl Queue {
    /// For tasks inside of a box.
    pub(super) fn new(bounds: &Bounds<2>, in_batches: bool) -> Self {
        let cells = f64::from(1 << AXIS) - 1.0;
        let scale = [0, 1].map(|k| {
            let scale = cells / (bounds.high[k] - bounds.low[k]);
            if scale.is_finite() { scale } else { 0.0 }
        });
        Self { classes: Vec::new(), in_batches, first: 0, low: bounds.low, scale }
    }

    /// Where a place is along the Morton curve.
    #[inline]
    pub(super) fn along_curve(&self, at: [f64; 2]) -> u64 {
        let [x, y] = [0, 1].map(|k| spread(((at[k] - self.low[k]) * self.scale[k]) as u32));
        x << 1 | y
    }

    /// Forgets all tasks.
    pub(super) fn clear(&mut self) {
        self.classes.clear();
        self.first = 0;
    }

    /// A task at a place, with the square of a length.
    #[inline]
    pub(super) fn task(
        &self,
        fault: Fault,
        squared: f64,
        at: [f64; 2],
        edge: EdgeId,
        corners: [Place; 3],
    ) -> Task {
        let length = squared.to_bits() >> 51;
        let place = self.along_curve(at);
        let round = ROUNDS - (place.wrapping_mul(HASH) | 1 << (63 - ROUNDS * SHARE)).leading_zeros() / SHARE;
        let key = (fault as u64) << CLASS | length << LENGTH | u64::from(round) << ROUND | place;
        Task { key, edge, corners }
    }

    /// Adds a task.
    #[inline]
    pub(super) fn push(&mut self, task: Task, points: &[[f64; 2]]) {
        let kind = if self.in_batches { task.fault().min(Fault::Angle) } else { task.fault() };
        let class = (kind as u64) << (CLASS - LENGTH) | (task.key & ((1 << CLASS) - 1)) >> LENGTH;
        let at = self.classes.partition_point(|entry| entry.0 < class);
        if self.classes.get(at).is_none_or(|entry| entry.0 != class) {
            self.classes.insert(at, (class, Class::default()));
        }
        let (_, class) = &mut self.classes[at];
        if self.in_batches {
            class.heap.push(task);
        } else {
            class.push(task, points);
        }
        self.first = self.first.min(at);
    }

    /// Takes the first task. `ahead` hears of those that are likely to come soon.
    #[inline]
    pub(super) fn pop(&mut self, points: &[[f64; 2]], ahead: impl Fn(EdgeId)) -> Option<Task> {
        loop {
            let (_, class) = self.classes.get_mut(self.first)?;
            let popped = if self.in_batches { class.pop_of_batch(points) } else { class.pop(points) };
            if let Some(task) = popped {
                let soon =
                    class.sorted.len().checked_sub(PREFETCH_DISTANCE).and_then(|at| class.sorted.get(at));
                soon.into_iter().for_each(|task| ahead(task.edge));
                return Some(task);
            }
            self.first += 1;
        }
    }
}

impl Class {
    #[inline]
    fn push(&mut self, task: Task, points: &[[f64; 2]]) {
        let mut at = self.heap.len();
        self.heap.push(task);
        while at > 0 {
            let parent = (at - 1) / ARITY;
            if !is_before(&task, &self.heap[parent], points) {
                break;
            }
            self.heap[at] = self.heap[parent];
            at = parent;
        }
        self.heap[at] = task;
    }

    #[inline]
    fn pop(&mut self, points: &[[f64; 2]]) -> Option<Task> {
        if self.sorted.is_empty() && self.heap.len() > SORTED_TASKS {
            std::mem::swap(&mut self.sorted, &mut self.heap);
            self.sort(points, !0);
        }
        match (self.sorted.last(), self.heap.first()) {
            (Some(last), Some(top)) if is_before(top, last, points) => self.pop_heap(points),
            (Some(_), _) => self.sorted.pop(),
            (None, _) => self.pop_heap(points),
        }
    }

    #[inline]
    fn pop_of_batch(&mut self, points: &[[f64; 2]]) -> Option<Task> {
        if self.sorted.is_empty() {
            std::mem::swap(&mut self.sorted, &mut self.heap);
            let bits = if self.sorted.len() < BATCH_IN_ROUNDS { ROUND } else { LENGTH };
            self.sort(points, (1 << bits) - 1);
        }
        self.sorted.pop()
    }

    /// Sorts a batch by some of the bits of keys, then by corners.
    fn sort(&mut self, points: &[[f64; 2]], bits: u64) {
        // Ties are few: by themselves they leave the sort without a call.
        self.sorted.sort_unstable_by_key(|task| Reverse(task.key & bits));
        let ties = self.sorted.chunk_by_mut(|p, q| p.key & bits == q.key & bits);
        ties.filter(|ties| ties.len() > 1).for_each(|ties| {
            ties.sort_unstable_by(|p, q| by_corners(q, p, points));
        });
    }

    fn pop_heap(&mut self, points: &[[f64; 2]]) -> Option<Task> {
        let last = self.heap.pop()?;
        let Some(&first) = self.heap.first() else { return Some(last) };
        let count = self.heap.len();
        let mut at = 0;
        loop {
            let child = ARITY * at + 1;
            if child >= count {
                break;
            }
            let mut least = child;
            for other in child + 1..count.min(child + ARITY) {
                if is_before(&self.heap[other], &self.heap[least], points) {
                    least = other;
                }
            }
            if !is_before(&self.heap[least], &last, points) {
                break;
            }
            self.heap[at] = self.heap[least];
            at = least;
        }
        self.heap[at] = last;
        Some(first)
    }
}

/// Tasks between the one in work and the one whose triangle is prefetched.
const PREFETCH_DISTANCE: usize = 4;
/// Tasks of a class, above which they are sorted at once; fewer are taken from a heap.
const SORTED_TASKS: usize = 32;
/// Tasks of a batch, from which on rounds are made. 200,000 corners on a circle take two seconds with them and minutes without; fewer than
/// this are mended sooner than rounds pay.
const BATCH_IN_ROUNDS: usize = 4096;
/// Children of a node of the heap: four are on one or two lines of the cache.
const ARITY: usize = 4;

#[inline]
fn is_before(one: &Task, other: &Task, points: &[[f64; 2]]) -> bool {
    one.key < other.key || (one.key == other.key && by_corners(one, other, points).is_lt())
}

#[cold]
fn by_corners(one: &Task, other: &Task, points: &[[f64; 2]]) -> Ordering {
    let pairs = one.corners.iter().zip(&other.corners).filter(|(v, w)| !v.is_ghost() && !w.is_ghost());
    let orders = pairs.map(|(v, w)| lexicographic(points[v.index()], points[w.index()]));
    orders.fold(Ordering::Equal, Ordering::then)
}

/// The bits of a number with a zero before each.
#[inline]
fn spread(x: u32) -> u64 {
    let steps = [
        (16, 0x0000_ffff_0000_ffff),
        (8, 0x00ff_00ff_00ff_00ff),
        (4, 0x0f0f_0f0f_0f0f_0f0f),
        (2, 0x3333_3333_3333_3333),
        (1, 0x5555_5555_5555_5555_u64),
    ];
    steps.into_iter().fold(u64::from(x), |x, (shift, mask)| (x | x << shift) & mask)
}
