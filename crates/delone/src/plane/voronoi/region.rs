//! Regions that cells are clipped to: a rectangle, the convex hull of the sites, a polygon with holes.
//!
//! A polygon of many sides is cut into a tree of boxes, each with its part of the polygon, so that a cell looks at
//! what is near it.
//!
//! Cost: a rectangle O(1); a polygon of m sides O(m log m) typical, and its validation O(m^2) at worst (sides that
//! all overlap in x).

use delone_predicates::{orient2d, strictly_between};

use super::clip::{Corner, HalfPlane, Line, Ring, clip};
use crate::error::{Error, RegionProblem};
use crate::plane::{Delaunay2, Position2};

/// Up to this number of sides a box is not cut further.
const FEW: usize = 8;
/// The deepest box.
const DEEPEST: u32 = 48;

/// A region of the plane with a border of straight sides.
#[derive(Clone, Debug)]
pub struct Region {
    low: [f64; 2],
    high: [f64; 2],
    rings: Vec<Vec<[f64; 2]>>,
    tree: Node,
}

/// A box with its part of the polygon.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) rings: Vec<Ring>,
    /// Whether the part is all of the box.
    pub(super) full: bool,
    /// The axis and the coordinate of the cut, and what is below and above.
    halves: Option<(usize, f64, Box<[Node; 2]>)>,
}

impl Region {
    /// An axis-parallel rectangle.
    ///
    /// # Errors
    /// [`Error::Region`] if it is empty or not finite.
    ///
    /// ```
    /// use delone::Region;
    /// assert_eq!(Region::rectangle([0.0, 0.0], [4.0, 2.0])?.area(), 8.0);
    /// assert!(Region::rectangle([0.0, 0.0], [0.0, 2.0]).is_err());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn rectangle<P: Position2>(low: P, high: P) -> Result<Self, Error> {
        let ([x0, y0], [x1, y1]) = (low.xy(), high.xy());
        let corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
        let finite = corners.iter().flatten().all(|x| x.is_finite());
        let problem = |problem| Error::Region { ring: 0, corner: 0, problem };
        if !finite {
            return Err(problem(RegionProblem::NotFinite));
        }
        if x0 >= x1 || y0 >= y1 {
            return Err(problem(RegionProblem::Empty));
        }
        let tree = Node { rings: vec![sides(&corners)], full: true, halves: None };
        Ok(Self { low: [x0, y0], high: [x1, y1], rings: vec![corners.to_vec()], tree })
    }

    /// A polygon: rings of corners, each closed by its first corner, in any direction. A ring inside of another one
    /// is a hole, one inside of a hole an island, and so on. Rings may touch at corners and no other way.
    ///
    /// # Errors
    /// [`Error::Region`] names ring, corner and problem: a side that crosses or overlaps another one, a corner
    /// visited twice, fewer than three corners, no area, a coordinate that is not finite.
    ///
    /// ```
    /// use delone::Region;
    /// let outer = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    /// let hole = vec![[1.0, 1.0], [2.0, 1.0], [1.0, 2.0]];
    /// assert_eq!(Region::polygon(&[outer, hole])?.area(), 15.5);
    /// let bow_tie = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    /// assert!(Region::polygon(&[bow_tie]).is_err());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn polygon<P: Position2>(rings: &[Vec<P>]) -> Result<Self, Error> {
        let mut rings: Vec<Vec<[f64; 2]>> =
            rings.iter().map(|ring| ring.iter().map(Position2::xy).collect()).collect();
        for (i, ring) in rings.iter_mut().enumerate() {
            if ring.len() > 1 && ring.first() == ring.last() {
                ring.pop();
            }
            validate_corners(i, ring)?;
        }
        validate_sides(&rings)?;
        let depths: Vec<usize> = (0..rings.len()).map(|i| depth(&rings, i)).collect();
        for (ring, depth) in rings.iter_mut().zip(depths) {
            if (twice_area(ring.iter().copied()) > 0.0) != (depth % 2 == 0) {
                ring.reverse();
            }
        }
        Self::of_rings(rings)
    }

    /// The convex hull of the vertices of a triangulation.
    ///
    /// # Errors
    /// [`Error::Region`] if they do not span the plane.
    pub fn hull(triangulation: &Delaunay2) -> Result<Self, Error> {
        let corners: Vec<[f64; 2]> = triangulation.hull().map(|v| triangulation.point(v)).collect();
        if !triangulation.base.spanned {
            return Err(Error::Region { ring: 0, corner: 0, problem: RegionProblem::Empty });
        }
        Self::of_rings(vec![corners])
    }

    fn of_rings(rings: Vec<Vec<[f64; 2]>>) -> Result<Self, Error> {
        let Some(&first) = rings.first().and_then(|ring| ring.first()) else {
            return Err(Error::Region { ring: 0, corner: 0, problem: RegionProblem::Empty });
        };
        let (mut low, mut high) = (first, first);
        for corner in rings.iter().flatten() {
            for axis in 0..2 {
                low[axis] = low[axis].min(corner[axis]);
                high[axis] = high[axis].max(corner[axis]);
            }
        }
        let tree = Node::new(rings.iter().map(|ring| sides(ring)).collect(), 0);
        Ok(Self { low, high, rings, tree })
    }

    /// The area, in coordinate units squared.
    pub fn area(&self) -> f64 {
        self.rings.iter().map(|ring| twice_area(ring.iter().copied()) / 2.0).sum()
    }

    /// The rings: outer ones counter-clockwise, holes clockwise.
    pub fn rings(&self) -> impl Iterator<Item = &[[f64; 2]]> {
        self.rings.iter().map(Vec::as_slice)
    }

    /// The corners of the smallest rectangle around it, low and high.
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        [self.low, self.high]
    }

    /// The smallest box of the tree that contains one. `None` if that is not inside of the region's own box.
    #[inline]
    pub(super) fn around(&self, low: [f64; 2], high: [f64; 2]) -> Option<&Node> {
        let within = |axis: usize| self.low[axis] <= low[axis] && high[axis] <= self.high[axis];
        if !(within(0) && within(1)) {
            return None;
        }
        let mut node = &self.tree;
        while let Some((axis, at, halves)) = &node.halves {
            if high[*axis] <= *at {
                node = &halves[0];
            } else if low[*axis] >= *at {
                node = &halves[1];
            } else {
                break;
            }
        }
        Some(node)
    }

    /// The region's own box as a ring; its sides count as sides if the region is no more than that.
    pub(super) fn frame(&self) -> Ring {
        if self.tree.full {
            return self.tree.rings[0].clone();
        }
        let ([x0, y0], [x1, y1]) = (self.low, self.high);
        [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|at| Corner { at, line: Line::Cut }).to_vec()
    }
}

impl Node {
    fn new(rings: Vec<Ring>, depth: u32) -> Self {
        let is_side = |corner: &&Corner| matches!(corner.line, Line::Side(_));
        let count = |rings: &[Ring]| rings.iter().flatten().filter(is_side).count();
        let side_count = count(&rings);
        if side_count <= FEW || depth == DEEPEST {
            return Self { full: side_count == 0 && !rings.is_empty(), rings, halves: None };
        }
        // At the median corner of the sides, across the longer extent.
        let corners: Vec<[f64; 2]> = rings.iter().flatten().filter(is_side).map(|corner| corner.at).collect();
        let extent = |axis: usize| {
            let coordinates = corners.iter().map(|c| c[axis]);
            coordinates.clone().fold(f64::MIN, f64::max) / 2.0 - coordinates.fold(f64::MAX, f64::min) / 2.0
        };
        let axis = usize::from(extent(1) > extent(0));
        let mut coordinates: Vec<f64> = corners.iter().map(|corner| corner[axis]).collect();
        let middle = coordinates.len() / 2;
        let at = *coordinates.select_nth_unstable_by(middle, f64::total_cmp).1;
        let halves = [HalfPlane::Below(axis, at), HalfPlane::Above(axis, at)].map(|half| clip(&rings, half));
        if halves.iter().any(|half| count(half) >= side_count) {
            return Self { rings, full: false, halves: None };
        }
        let halves = halves.map(|half| Self::new(half, depth + 1));
        Self { rings, full: false, halves: Some((axis, at, Box::new(halves))) }
    }
}

/// A ring with its own edges as sides.
fn sides(corners: &[[f64; 2]]) -> Ring {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(&at, &to)| Corner { at, line: Line::Side([at, to]) }).collect()
}

/// Twice the area inside of a ring, positive if it is counter-clockwise. Taken from the first corner, so that far
/// from the origin nothing is lost.
pub(super) fn twice_area(mut ring: impl Iterator<Item = [f64; 2]>) -> f64 {
    let Some([x, y]) = ring.next() else { return 0.0 };
    let mut last = [0.0, 0.0];
    let mut sum = 0.0;
    for p in ring {
        let p = [p[0] - x, p[1] - y];
        sum += last[0] * p[1] - last[1] * p[0];
        last = p;
    }
    sum
}

fn validate_corners(ring: usize, corners: &[[f64; 2]]) -> Result<(), Error> {
    let problem = |corner, problem| Err(Error::Region { ring, corner, problem });
    if let Some(corner) = corners.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
        return problem(corner, RegionProblem::NotFinite);
    }
    if corners.len() < 3 {
        return problem(0, RegionProblem::Empty);
    }
    let mut order: Vec<usize> = (0..corners.len()).collect();
    order.sort_by(|&i, &j| delone_predicates::lexicographic(corners[i], corners[j]).then(i.cmp(&j)));
    match order.windows(2).find(|pair| corners[pair[0]] == corners[pair[1]]) {
        Some(pair) => problem(pair[1], RegionProblem::VisitedTwice),
        None => Ok(()),
    }
}

/// No two sides share more than a corner.
fn validate_sides(rings: &[Vec<[f64; 2]>]) -> Result<(), Error> {
    let mut all = Vec::new();
    for (r, ring) in rings.iter().enumerate() {
        for (i, &p) in ring.iter().enumerate() {
            all.push((p, ring[(i + 1) % ring.len()], r, i));
        }
    }
    let low = |p: [f64; 2], q: [f64; 2], axis: usize| p[axis].min(q[axis]);
    let high = |p: [f64; 2], q: [f64; 2], axis: usize| p[axis].max(q[axis]);
    all.sort_by(|a, b| low(a.0, a.1, 0).total_cmp(&low(b.0, b.1, 0)));
    for (k, &(p, q, ..)) in all.iter().enumerate() {
        for &(s, t, ring, corner) in &all[k + 1..] {
            if low(s, t, 0) > high(p, q, 0) {
                break;
            }
            let apart = low(s, t, 1) > high(p, q, 1) || low(p, q, 1) > high(s, t, 1);
            if !apart && are_in_conflict(p, q, s, t) {
                return Err(Error::Region { ring, corner, problem: RegionProblem::Crossing });
            }
        }
    }
    Ok(())
}

/// Whether two segments share a point that is not a corner of both. Exact.
fn are_in_conflict(p: [f64; 2], q: [f64; 2], s: [f64; 2], t: [f64; 2]) -> bool {
    let (at_s, at_t) = (orient2d(p, q, s), orient2d(p, q, t));
    let (at_p, at_q) = (orient2d(s, t, p), orient2d(s, t, q));
    let touches = (at_s.is_zero() && strictly_between(p, q, s))
        || (at_t.is_zero() && strictly_between(p, q, t))
        || (at_p.is_zero() && strictly_between(s, t, p))
        || (at_q.is_zero() && strictly_between(s, t, q));
    let opposite = |a: delone_predicates::Sign, b: delone_predicates::Sign| {
        (a.is_positive() && b.is_negative()) || (a.is_negative() && b.is_positive())
    };
    let same = (p == s && q == t) || (p == t && q == s);
    touches || same || (opposite(at_s, at_t) && opposite(at_p, at_q))
}

/// How many other rings are around a ring.
fn depth(rings: &[Vec<[f64; 2]>], of: usize) -> usize {
    let around = |other: &Vec<[f64; 2]>| {
        let ring = &rings[of];
        let middle = || [0, 1].map(|axis| ring[0][axis] / 2.0 + ring[1][axis] / 2.0);
        let point = ring.iter().find(|p| !other.contains(p)).copied().unwrap_or_else(middle);
        contains(other, point)
    };
    (0..rings.len()).filter(|&i| i != of && around(&rings[i])).count()
}

/// Whether a ring goes around a point that is not on it. Exact.
fn contains(ring: &[[f64; 2]], p: [f64; 2]) -> bool {
    let mut inside = false;
    for (i, &a) in ring.iter().enumerate() {
        let b = ring[(i + 1) % ring.len()];
        if (a[1] > p[1]) != (b[1] > p[1]) {
            let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) };
            inside ^= orient2d(low, high, p).is_positive();
        }
    }
    inside
}
