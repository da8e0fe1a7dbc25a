//! Which edges of triangles from elsewhere segments run along.
//!
//! Most segments are edges. Any other one is followed from vertex to vertex, each time along the edge of its direction, which is
//! found among the edges of that vertex, sorted by angle. Cost: O(n log n) to sort, O(log n) for each edge that a segment runs
//! along.

use crate::sorting;
use std::cmp::Ordering;

use delone_predicates::{lexicographic, orient2d, strictly_between};

use super::{Objection2, Side};

/// The edges that segments run along, by their corners, the lesser index first; sorted, each once. `corner` is the corner that is
/// where a point is.
pub(super) fn fixed_edges(
    points: &[[f64; 2]],
    segments: &[[usize; 2]],
    corner: &[usize],
    sides: &[Side],
) -> Result<Vec<[usize; 2]>, Objection2> {
    let mut fixed = Vec::with_capacity(segments.len());
    let mut stars = None;
    for (segment, ends) in segments.iter().enumerate() {
        let [mut at, end] = ends.map(|i| corner[i]);
        let whole = sorted([at, end]);
        if at == end {
            continue;
        }
        if sides.binary_search_by(|side| [side.0, side.1].cmp(&whole)).is_ok() {
            fixed.push(whole);
            continue;
        }
        let stars = stars.get_or_insert_with(|| Stars::new(points, sides));
        while at != end {
            let next = stars.along(points, at, end).ok_or(Objection2::Segment { segment, point: at })?;
            fixed.push(sorted([at, next]));
            at = next;
        }
    }
    fixed.sort_unstable();
    fixed.dedup();
    Ok(fixed)
}

pub(super) fn sorted([i, j]: [usize; 2]) -> [usize; 2] {
    [i.min(j), i.max(j)]
}

/// The edges from each corner to others, counter-clockwise from straight down.
struct Stars(Vec<[usize; 2]>);

impl Stars {
    fn new(points: &[[f64; 2]], sides: &[Side]) -> Self {
        let mut edges: Vec<[usize; 2]> = sides.iter().flat_map(|s| [[s.0, s.1], [s.1, s.0]]).collect();
        edges.sort_unstable();
        edges.dedup();
        sorting::by(&mut edges, |&[v, p], &[w, q]| v.cmp(&w).then_with(|| by_angle(points, v, p, q)));
        Self(edges)
    }

    /// The corner that the edge from `at` straight to `end` leads to, if there is that edge and it goes no further.
    fn along(&self, points: &[[f64; 2]], at: usize, end: usize) -> Option<usize> {
        let order = |&[v, w]: &[usize; 2]| v.cmp(&at).then_with(|| by_angle(points, at, w, end));
        let next = self.0[self.0.binary_search_by(order).ok()?][1];
        (next == end || strictly_between(points[at], points[end], points[next])).then_some(next)
    }
}

/// Compares the directions from a point to two others.
fn by_angle(points: &[[f64; 2]], from: usize, p: usize, q: usize) -> Ordering {
    let [from, p, q] = [from, p, q].map(|i| points[i]);
    let is_left = |to| lexicographic(to, from).is_lt();
    is_left(p).cmp(&is_left(q)).then_with(|| {
        let turn = orient2d(from, p, q);
        if turn.is_positive() {
            Ordering::Less
        } else if turn.is_negative() {
            Ordering::Greater
        } else {
            Ordering::Equal
        }
    })
}
