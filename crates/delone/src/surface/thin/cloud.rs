//! Points anywhere, measured against planes over triangles: a tree of boxes over points along a curve, of which those that are
//! surely not worse than the worst so far are not entered.
//!
//! Which points are in a triangle is exact. Cost: O(n log n) once; O(log n) for a triangle and as much again as it has points, for a
//! large one a part of them.

use crate::sorting;
use std::cell::Cell;
use std::cmp::Ordering;

use delone_predicates::{Filter, lexicographic};

use super::plane::{self, Plane, Worst};
use super::{Found, Samples, Triple, Verdict};

/// Boxes below a box, up to which it is entered without a test, unless the triangle is long and thin: the test would take as long.
const ENTERED_BOXES: usize = 16;

/// Points of a box that has no boxes.
const LEAF: usize = 16;

/// Thinner triangles have no plane that roundings leave where it is.
const THIN: f64 = 1.0 / 1024.0;

/// See the module. Points are along a curve, no two of them equal.
#[derive(Debug)]
pub(super) struct Cloud {
    pub(super) points: Vec<[f64; 2]>,
    heights: Vec<f64>,
    filter: Filter,
    /// A complete binary tree: the boxes in box i are 2 i and 2 i + 1.
    boxes: Vec<Bound>,
}

/// The least and the largest x, y and height.
#[derive(Clone, Copy, Debug)]
struct Bound([[f64; 2]; 3]);

const EMPTY: Bound = Bound([[f64::INFINITY, f64::NEG_INFINITY]; 3]);

impl Bound {
    fn with(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|k| [self.0[k][0].min(other.0[k][0]), self.0[k][1].max(other.0[k][1])]))
    }
}

impl Cloud {
    pub(super) fn new(points: Vec<[f64; 2]>, heights: Vec<f64>, filter: Filter) -> Self {
        let leaves = points.len().div_ceil(LEAF).next_power_of_two();
        let mut boxes = vec![EMPTY; 2 * leaves];
        for (bound, (points, heights)) in
            boxes[leaves..].iter_mut().zip(points.chunks(LEAF).zip(heights.chunks(LEAF)))
        {
            for (p, &z) in points.iter().zip(heights) {
                *bound = bound.with(&Bound([[p[0]; 2], [p[1]; 2], [z; 2]]));
            }
        }
        for i in (1..leaves).rev() {
            boxes[i] = boxes[2 * i].with(&boxes[2 * i + 1]);
        }
        Self { points, heights, filter, boxes }
    }

    /// Tells the points in a triangle with their errors, but for those in boxes whose errors are surely below the floor, which may rise.
    fn enter(&self, corners: Triple, floor: &Cell<f64>, mut each: impl FnMut(u32, f64)) {
        let c = corners.map(|s| self.points[s as usize]);
        let plane = self.plane(corners);
        let around = [0, 1].map(|k| [c[0][k].min(c[1][k]).min(c[2][k]), c[0][k].max(c[1][k]).max(c[2][k])]);
        // The box around a long thin triangle at a slant may hold any number of boxes that are beyond one of its sides. In parts of its
        // box, so that nothing leaves the range.
        let size = around.map(|[low, high]| high - low);
        let [u, v] = [1, 2].map(|i| [0, 1].map(|k| (c[i][k] - c[0][k]) / size[k]));
        let is_slanted = 16.0 * (u[0] * v[1] - u[1] * v[0]) < 1.0;
        let leaves = self.boxes.len() / 2;
        let heights = corners.map(|s| self.heights[s as usize]);
        let (lowest, highest) =
            (heights.into_iter().fold(f64::MAX, f64::min), heights.into_iter().fold(f64::MIN, f64::max));
        // A bound of the errors in a box, if it has some of the triangle.
        let most = |i: usize| {
            let Bound(bound) = &self.boxes[i];
            let both = [0, 1].map(|k| [bound[k][0].max(around[k][0]), bound[k][1].min(around[k][1])]);
            let is_beyond = |k: usize| self.is_beyond(both, [c[k], c[(k + 1) % 3]]);
            if both.iter().any(|side| side[0] > side[1]) {
                return None;
            }
            // Any triangle may have no more than a corner on a line of points that is all along its box.
            let is_asked = is_slanted || i < leaves / ENTERED_BOXES && both != around;
            if is_asked && (0..3).any(is_beyond) {
                return None;
            }
            // Heights in a triangle are between those of its corners.
            let Ok((plane, _)) = &plane else {
                return Some((bound[2][1] - lowest).max(highest - bound[2][0]));
            };
            let middle = both.map(|side| side[0] / 2.0 + side[1] / 2.0);
            let half = both.map(|side| side[1] / 2.0 - side[0] / 2.0);
            Some(plane.most(middle, half, bound[2]))
        };
        // The box that may have the worst is entered first, so that most others need not be.
        let mut stack: Vec<(usize, f64)> = Vec::new();
        stack.extend(most(1).map(|most| (1, most)));
        while let Some((i, bound)) = stack.pop() {
            if bound < floor.get() {
                continue;
            }
            if i < leaves {
                let [low, high] = [2 * i, 2 * i + 1].map(|i| most(i).map(|most| (i, most)));
                let is_low_first = low.zip(high).is_some_and(|(low, high)| low.1 >= high.1);
                stack.extend(if is_low_first { [high, low] } else { [low, high] }.into_iter().flatten());
                continue;
            }
            let first = (i - leaves) * LEAF;
            for s in first..(first + LEAF).min(self.points.len()) {
                let q = self.points[s];
                let is_beyond = |k: usize| self.filter.orient2d(c[k], c[(k + 1) % 3], q).is_negative();
                if !corners.contains(&(s as u32)) && !(0..3).any(is_beyond) {
                    each(s as u32, self.distance(&plane, s));
                }
            }
        }
    }

    /// Whether a box between coordinates of points is on the right of an edge: its corner that is furthest to the left is.
    #[inline]
    fn is_beyond(&self, [x, y]: [[f64; 2]; 2], [from, to]: [[f64; 2]; 2]) -> bool {
        let corner = [x[usize::from(to[1] < from[1])], y[usize::from(to[0] > from[0])]];
        self.filter.orient2d(from, to, corner).is_negative()
    }

    /// The plane over a triangle, and the least and the largest height of its corners; the corners themselves, lexicographically, if it
    /// is too thin for a plane.
    fn plane(&self, mut corners: Triple) -> Result<(Plane, [f64; 2]), Triple> {
        let z = corners.map(|s| self.heights[s as usize]);
        let range = [z[0].min(z[1]).min(z[2]), z[0].max(z[1]).max(z[2])];
        let plane = Plane::new(corners.map(|s| self.points[s as usize]), z, THIN);
        plane.map(|plane| (plane, range)).ok_or_else(|| {
            sorting::by(&mut corners, |&a, &b| lexicographic(self.point(a), self.point(b)));
            corners
        })
    }

    /// The error of a point: what is between heights stays so, however thin the triangle.
    fn distance(&self, plane: &Result<(Plane, [f64; 2]), Triple>, sample: usize) -> f64 {
        let q = self.points[sample];
        let height = match plane {
            Ok((plane, [low, high])) => plane.at(q).clamp(*low, *high),
            Err(corners) => self.by_weights(corners, q),
        };
        (self.heights[sample] - height).abs()
    }

    /// The height over a point as a mean of the corners'.
    #[cold]
    fn by_weights(&self, corners: &Triple, q: [f64; 2]) -> f64 {
        plane::mean(corners.map(|s| self.point(s)), corners.map(|s| self.heights[s as usize]), q)
    }
}

/// See [`Samples::Entry`].
#[derive(Clone, Copy)]
pub(super) struct Entry {
    error: f64,
    point: [f64; 2],
    sample: u32,
    triangle: u32,
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_point = || lexicographic(other.point, self.point);
        self.error.total_cmp(&other.error).then_with(by_point).then(self.triangle.cmp(&other.triangle))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Entry {}

impl Samples for Cloud {
    type Entry = Entry;

    fn entry(&self, error: f64, sample: u32, triangle: u32) -> Entry {
        Entry { error, point: self.point(sample), sample, triangle }
    }

    fn found(&self, &Entry { error, sample, triangle, .. }: &Entry) -> Found {
        Found { error, sample, triangle }
    }

    fn count(&self) -> usize {
        self.points.len()
    }

    fn is_there(&self, _: u32) -> bool {
        true
    }

    fn point(&self, sample: u32) -> [f64; 2] {
        self.points[sample as usize]
    }

    fn height(&self, sample: u32) -> f64 {
        self.heights[sample as usize]
    }

    fn worst(&self, corners: Triple, floor: f64) -> Option<(f64, u32)> {
        let mut worst = Worst::above(floor);
        let least = Cell::new(floor);
        let order = |a: u32, b: u32| lexicographic(self.point(a), self.point(b));
        self.enter(corners, &least, |sample, error| {
            if error >= worst.error {
                worst.offer(error, sample, order);
                least.set(worst.error);
            }
        });
        worst.sample.map(|sample| (worst.error, sample))
    }

    fn judge(&self, corners: Triple, triangle: u32, verdict: &mut Verdict<'_>) {
        let every = Cell::new(f64::NEG_INFINITY);
        self.enter(corners, &every, |sample, error| verdict.take(triangle, sample, error));
        corners.into_iter().for_each(|corner| verdict.take(triangle, corner, 0.0));
    }

    fn error(&self, corners: Triple, sample: u32) -> f64 {
        self.distance(&self.plane(corners), sample as usize)
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::{Kind, Random};
    use delone_oracle::exact;
    use delone_oracle::share;

    use super::*;

    /// Also in thin triangles at a slant, whose boxes have many others in them.
    #[test]
    fn boxes_hide_nothing() {
        let mut random = Random::new(3);
        let even = Kind::Uniform.points(400, 1);
        let cross = even.iter().flat_map(|&[x, y]| [[x - 0.5, 0.0], [0.0, y - 0.5]]).collect();
        let slope = even.iter().map(|&[x, y]| [x, x + y / 64.0]).collect();
        for mut points in [even, cross, slope, Kind::Grid.points(400, 1)] {
            points.sort_unstable_by(|&p, &q| lexicographic(p, q));
            points.dedup();
            let filter = super::super::filter(1e9, 1e9, points.as_flattened());
            let (count, heights) = (points.len(), vec![0.0; points.len()]);
            let cloud = Cloud::new(points, heights, filter);
            let mut met = 0;
            for _ in 0..share(3000) {
                let mut corners = [0; 3].map(|_: u32| random.below(count) as u32);
                let of = |corners: Triple| corners.map(|s| cloud.points[s as usize]);
                let side = |[a, b, c]: [[f64; 2]; 3]| exact::orient2d(a, b, c);
                if side(of(corners)) < 0 {
                    corners.swap(0, 1);
                }
                let [a, b, c] = of(corners);
                if side([a, b, c]) == 0 {
                    continue;
                }
                let mut found = Vec::new();
                cloud.enter(corners, &Cell::new(0.0), |s, _| found.push(s));
                found.sort_unstable();
                let is_in = |&s: &u32| {
                    let q = cloud.points[s as usize];
                    !corners.contains(&s)
                        && [[a, b, q], [b, c, q], [c, a, q]].into_iter().all(|t| side(t) >= 0)
                };
                let inside: Vec<u32> = (0..count as u32).filter(is_in).collect();
                assert_eq!(found, inside, "{corners:?}");
                met += inside.len();
            }
            assert!(met > share(1000), "{met}");
        }
    }
}
