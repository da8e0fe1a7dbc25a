//! Edges that imprecise points certainly or possibly have: the strong and the weak problem for disks of one radius.
//!
//! Each point is somewhere in a closed disk of radius r around its center; an *instance* takes one from each. Which pairs are
//! an edge in every instance (strong), which in some instance (weak)? Source: Devillers, "Delaunay triangulation of imprecise
//! points", JoCG 2011, §1, which names both; the strong one is that of Evans and Sember, "Guaranteed Voronoi diagrams of
//! uncertain sites", CCCG 2008. With d_i the distance of a place c from center i, for pairs of different centers:
//!
//! - *possible*: there is a c with max(d_i, d_j) <= d_k + 2 r for all other k. A circle about c meets disks i and j, and every
//!   other point can stay out of it. Towards the further of both centers the condition stays true, so c may be on their bisector.
//! - *certain*: disks i and j are apart, and there is a c with max(d_i, d_j) + 2 r < d_k for all other k. The circle about c
//!   around disks i and j leaves all others outside, and a smaller one goes through both points. Again c may be on the
//!   bisector.
//!
//! One circle for all instances is *necessary* too. On the bisector every k leaves an open interval, so that, if none is left
//! by all, one k leaves none or two leave disjoint ones. In the first case disk k meets i or j, or the segment between points
//! of theirs. In the second there is a circle that disks i and j touch from inside and that two other points can be in or
//! on, one on each side of its chord. So these are the strong and the weak problem themselves, not an approximation.
//!
//! The search is local: the vertices in any closed disk induce a connected part of the triangulation of the centers, because each
//! vertex has a neighbor nearer to c unless it is nearest. So, if any k spoils c for a certain edge, a neighbor of i or j does;
//! possible partners of i are connected with i through possible partners; and whatever comes in the way of a pair about c is
//! connected with i inside of the circle about c through i and j.
//!
//! Cost, after the triangulation: certain edges the sum of squared degrees, O(n) where degrees are bounded. Possible ones a
//! search a tested pair, of the vertices in the circles that nothing is in the way of yet: a few where disks overlap little and
//! centers are evenly spread, more along the hull, whose circles are large; O(n^4) at worst, and where disks overlap much there
//! are O(n^2) to report.

use std::collections::VecDeque;

use delone_predicates::{DiskPair, End, Stretch, compare_with_radius};

use super::Delaunay2;
use crate::error::Error;
use crate::ids::VertexId;

/// The certain and the possible edges of points in disks of one radius around the vertices of a triangulation.
///
/// An edge is *certain* if in every instance a circle through its points, which differ, has all others strictly outside: so
/// it is in every Delaunay triangulation of every instance. It is *possible* if in some instance a circle through its points
/// has no other inside: so it is in some Delaunay triangulation of some instance. For radius 0 both are the edges of
/// the vertices, but where four are cocircular both diagonals are possible and none is certain.
///
/// ```
/// use delone::Delaunay2;
///
/// let d = Delaunay2::from_points(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])?;
/// let edges = d.disk_edges(0.25)?;
/// assert_eq!(edges.certain().len(), 4); // the sides
/// assert_eq!(edges.possible().len(), 6); // and both diagonals
/// assert!(d.disk_edges(2.0)?.certain().is_empty()); // disks that touch may be one point
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DiskEdges2 {
    certain: Vec<[VertexId; 2]>,
    possible: Vec<[VertexId; 2]>,
}

impl DiskEdges2 {
    /// The edges of every instance, each from the smaller id to the larger, sorted.
    pub fn certain(&self) -> &[[VertexId; 2]] {
        &self.certain
    }

    /// The edges of some instance, in the same order; the certain ones are among them.
    pub fn possible(&self) -> &[[VertexId; 2]] {
        &self.possible
    }
}

impl Delaunay2 {
    /// The edges that points in closed disks of this radius around the vertices certainly and possibly have.
    ///
    /// A vertex stands for all points equal to it: its possible partners are theirs, any two of them are a possible pair that
    /// is not listed, and if the radius is not 0, none of them has a certain edge.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a radius that is negative or whose double is not finite.
    pub fn disk_edges(&self, radius: f64) -> Result<DiskEdges2, Error> {
        let diameter = 2.0 * radius;
        if !(radius >= 0.0 && diameter.is_finite()) {
            let range = "from 0 to half of the largest number";
            return Err(Error::Parameter { name: "radius", value: radius, range });
        }
        let mut search = Search { d: self, diameter, seen: vec![0; self.points().len()], stamp: 0 };
        Ok(DiskEdges2 { certain: search.certain(), possible: search.possible() })
    }
}

/// The disks around the vertices.
struct Search<'a> {
    d: &'a Delaunay2,
    diameter: f64,
    /// For each id the last search of obstacles that came to it.
    seen: Vec<u32>,
    stamp: u32,
}

impl Search<'_> {
    fn pair(&self, v: VertexId, w: VertexId) -> DiskPair {
        DiskPair::new(self.d.point(v), self.d.point(w), self.diameter)
    }

    fn are_apart(&self, v: VertexId, w: VertexId) -> bool {
        compare_with_radius(self.d.point(v), self.d.point(w), self.diameter).is_gt()
    }

    fn certain(&self) -> Vec<[VertexId; 2]> {
        let mut is_alone = vec![true; self.seen.len()];
        if self.diameter > 0.0 {
            self.d.duplicates().for_each(|duplicate| is_alone[duplicate.vertex.index()] = false);
        }
        let is_certain = |&[v, w]: &[VertexId; 2]| {
            is_alone[v.index()] && is_alone[w.index()] && self.are_apart(v, w) && self.is_clear(v, w)
        };
        let edges = self.d.edges().map(|[v, w]| [v.min(w), v.max(w)]);
        let mut certain: Vec<_> = edges.filter(is_certain).collect();
        certain.sort_unstable();
        certain
    }

    /// Whether a disk around both keeps clear of all others.
    fn is_clear(&self, v: VertexId, w: VertexId) -> bool {
        let pair = self.pair(v, w);
        let mut left = Stretch { low: None, high: None };
        for k in self.d.neighbors(v).chain(self.d.neighbors(w)).filter(|&k| k != v && k != w) {
            let Some(Stretch { low, high }) = pair.clear_of(self.d.point(k)) else { return false };
            left.low = last(&pair, left.low, low);
            left.high = first(&pair, left.high, high);
            if let (Some(low), Some(high)) = (&left.low, &left.high)
                && pair.compare(low, high).is_ge()
            {
                return false;
            }
        }
        true
    }

    fn possible(&mut self) -> Vec<[VertexId; 2]> {
        let d = self.d;
        let mut possible: Vec<[VertexId; 2]> = Vec::new();
        // For each vertex the search that came to it last, and for those with smaller ids what was found from them.
        let mut came = vec![None; self.seen.len()];
        let mut partners: Vec<Vec<VertexId>> = vec![Vec::new(); self.seen.len()];
        let mut vertices: Vec<VertexId> = d.vertices().collect();
        vertices.sort_unstable();
        for v in vertices {
            came[v.index()] = Some(v);
            let mut queue = vec![v];
            while let Some(u) = queue.pop() {
                for w in d.neighbors(u) {
                    if came[w.index()].replace(v) == Some(v) {
                        continue;
                    }
                    // Partners are found in the order of their ids.
                    let is_possible = if w < v {
                        partners[v.index()].binary_search(&w).is_ok()
                    } else {
                        self.can_meet(v, w)
                    };
                    if is_possible {
                        queue.push(w);
                        if w > v {
                            partners[w.index()].push(v);
                            possible.push([v, w]);
                        }
                    }
                }
            }
        }
        possible.sort_unstable();
        possible
    }

    /// Whether a disk that meets both has no other inside.
    fn can_meet(&mut self, v: VertexId, w: VertexId) -> bool {
        if !self.are_apart(v, w) {
            return true;
        }
        let pair = self.pair(v, w);
        let mut cover = Cover { left: Stretch { low: None, high: None }, inner: Vec::new() };
        if self.stamp == u32::MAX {
            self.seen.fill(0);
            self.stamp = 0;
        }
        self.stamp += 1;
        self.seen[v.index()] = self.stamp;
        self.seen[w.index()] = self.stamp;
        let mut queue = VecDeque::from([v, w]);
        while let Some(u) = queue.pop_front() {
            for k in self.d.neighbors(u) {
                if std::mem::replace(&mut self.seen[k.index()], self.stamp) == self.stamp {
                    continue;
                }
                let p = self.d.point(k);
                if !pair.may_hold(p, cover.left.low.as_ref(), cover.left.high.as_ref()) {
                    continue;
                }
                queue.push_back(k);
                if let Some(stretch) = pair.blocked_by(p)
                    && !cover.add(&pair, stretch)
                {
                    return false;
                }
            }
        }
        true
    }
}

/// Open intervals, and what they leave of the line.
struct Cover {
    /// All before its beginning and all after its end is covered; the ends are not.
    left: Stretch,
    /// Disks that cover neither end.
    inner: Vec<[End; 2]>,
}

impl Cover {
    /// Whether something is left.
    fn add(&mut self, pair: &DiskPair, stretch: Stretch) -> bool {
        match (stretch.low, stretch.high) {
            (None, None) => return false,
            (None, high) => self.left.low = last(pair, self.left.low, high),
            (low, None) => self.left.high = first(pair, self.left.high, low),
            (Some(low), Some(high)) => self.inner.push([low, high]),
        }
        loop {
            let Stretch { low, high } = self.left;
            if let (Some(low), Some(high)) = (&low, &high)
                && pair.compare(low, high).is_gt()
            {
                return false;
            }
            let is_inside = |end: &Option<End>, [from, to]: &[End; 2]| {
                end.as_ref().is_some_and(|x| pair.compare(from, x).is_lt() && pair.compare(x, to).is_lt())
            };
            let Some(i) = self.inner.iter().position(|t| is_inside(&low, t) || is_inside(&high, t)) else {
                return true;
            };
            let [from, to] = self.inner.swap_remove(i);
            let (over_low, over_high) = (is_inside(&low, &[from, to]), is_inside(&high, &[from, to]));
            if over_low {
                self.left.low = Some(to);
            }
            if over_high {
                self.left.high = Some(from);
            }
        }
    }
}

/// The later of two beginnings, where none is at minus infinity.
fn last(pair: &DiskPair, one: Option<End>, two: Option<End>) -> Option<End> {
    match (one, two) {
        (Some(a), Some(b)) => Some(if pair.compare(&a, &b).is_ge() { a } else { b }),
        _ => one.or(two),
    }
}

/// The earlier of two ends, where none is at infinity.
fn first(pair: &DiskPair, one: Option<End>, two: Option<End>) -> Option<End> {
    match (one, two) {
        (Some(a), Some(b)) => Some(if pair.compare(&a, &b).is_le() { a } else { b }),
        _ => one.or(two),
    }
}
