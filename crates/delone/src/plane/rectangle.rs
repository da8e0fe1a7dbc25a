//! The vertices in a rectangle along the axes.
//!
//! They need not be connected by edges, so the triangles that meet the rectangle are visited, across the edges that do. The
//! first of them contains a point of the rectangle, or stands on a hull edge that meets it. Where there is none, something
//! near says so: a hull edge with the rectangle beyond it, or a vertex of the hull that is the last along an axis, with the
//! rectangle further on (the separating axes of two convex polygons).
//!
//! Where to look for a point of the rectangle: in the middle of it; if that is beyond a hull edge, in the middle of what is
//! not beyond the edge, and so on; if nothing is left, between the two points whose edges leave nothing. That is rounded, and
//! decides nothing: it leads to where the rectangle and the hull are next to each other.
//!
//! Cost: O(t log t) for t triangles that meet the rectangle, and a logarithmic number of locations, 64 at most; and some hull
//! edges near by.

use std::collections::BTreeSet;

use delone_predicates::orient2d;

use super::Delaunay2;
use super::layer::insert::Spot;
use crate::error::Error;
use crate::ids::{EdgeId, Place, TriangleId, VertexId};
use crate::points::{Position2, finite};
use crate::tally::Tally;

/// The largest number of points of the rectangle that are located.
const ROUNDS: usize = 64;

/// A closed rectangle along the axes.
struct Rectangle {
    low: [f64; 2],
    high: [f64; 2],
}

impl Rectangle {
    fn contains(&self, p: [f64; 2]) -> bool {
        (0..2).all(|k| self.low[k] <= p[k] && p[k] <= self.high[k])
    }

    fn corners(&self) -> [[f64; 2]; 4] {
        let Self { low, high } = *self;
        [low, [high[0], low[1]], high, [low[0], high[1]]]
    }

    /// The point of the rectangle in the middle of a part of it, about.
    fn middle_of(&self, part: &[[f64; 2]]) -> [f64; 2] {
        let share = 1.0 / part.len() as f64;
        [0, 1].map(|k| part.iter().map(|p| p[k] * share).sum::<f64>().clamp(self.low[k], self.high[k]))
    }

    /// Whether it has a point in common with a segment: no axis and no side of the segment separates them.
    fn meets(&self, [a, b]: [[f64; 2]; 2]) -> bool {
        let apart = |k: usize| a[k].max(b[k]) < self.low[k] || a[k].min(b[k]) > self.high[k];
        if apart(0) || apart(1) {
            return false;
        }
        let sides = self.corners().map(|corner| orient2d(a, b, corner));
        sides.iter().any(|side| !side.is_positive()) && sides.iter().any(|side| !side.is_negative())
    }

    /// Whether it is strictly to the right of the line from one point to another.
    fn is_beyond(&self, [a, b]: [[f64; 2]; 2]) -> bool {
        self.corners().iter().all(|&corner| orient2d(a, b, corner).is_negative())
    }

    /// Whether, along an axis, a convex polygon ends before the rectangle begins, for a corner of it with those before and
    /// after: the corner is the last of all if it is further than one of these and no less far than the other.
    fn is_past(&self, before: [f64; 2], corner: [f64; 2], after: [f64; 2]) -> bool {
        let is_last = |p: f64, q: f64, r: f64| p <= q && r <= q && (p < q || r < q);
        (0..2).any(|k| {
            (is_last(before[k], corner[k], after[k]) && corner[k] < self.low[k])
                || (is_last(-before[k], -corner[k], -after[k]) && corner[k] > self.high[k])
        })
    }
}

impl Delaunay2 {
    /// The vertices in a rectangle given by its lower left and upper right corners, its border included, by
    /// increasing id. None if the corners are the other way round.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [3.0, 3.0]])?;
    /// let inside = d.in_rectangle([0.0, 0.0], [3.0, 3.0])?;
    /// assert_eq!(inside.iter().map(|v| v.index()).collect::<Vec<_>>(), [0, 3]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn in_rectangle<P: Position2>(&self, low: P, high: P) -> Result<Vec<VertexId>, Error> {
        self.in_rectangle_observed(low, high, &mut ())
    }

    /// Does what [`Self::in_rectangle`] does, and tells as visited the triangles of walks, those that meet the rectangle, and hull edges.
    ///
    /// # Errors
    /// As [`Self::in_rectangle`].
    pub fn in_rectangle_observed<P: Position2, T: Tally>(
        &self,
        low: P,
        high: P,
        tally: &mut T,
    ) -> Result<Vec<VertexId>, Error> {
        let rectangle = Rectangle { low: finite(low.xy())?, high: finite(high.xy())? };
        if (0..2).any(|k| rectangle.low[k] > rectangle.high[k]) {
            return Ok(Vec::new());
        }
        let inside = |v: &Place| !v.is_ghost() && rectangle.contains(self.base.points[v.index()]);
        if !self.base.spanned {
            return Ok(self.sorted_names(self.base.mesh.inhabited().filter(inside)));
        }
        let mesh = &self.base.mesh;
        let Some(start) = self.entrance(&rectangle, tally) else { return Ok(Vec::new()) };
        let mut found = BTreeSet::new();
        let mut seen = BTreeSet::from([start]);
        let mut pending = vec![start];
        while let Some(t) = pending.pop() {
            tally.visited();
            found.extend(mesh.places(t).into_iter().filter(inside));
            for e in [0, 1, 2].map(|k| t.edge(k)) {
                let across = mesh.twin(e).triangle();
                let is_finite = !mesh.tail(e).is_ghost() && !mesh.head(e).is_ghost();
                if is_finite && rectangle.meets(self.ends(e)) && seen.insert(across) {
                    pending.push(across);
                }
            }
        }
        Ok(self.sorted_names(found))
    }

    /// A finite triangle that meets a rectangle.
    fn entrance<T: Tally>(&self, rectangle: &Rectangle, tally: &mut T) -> Option<TriangleId> {
        let mesh = &self.base.mesh;
        let corners = rectangle.corners();
        let mut ghost = mesh.ghost_edge;
        let mut cuts: Vec<Cut> = Vec::new();
        let mut part = corners.to_vec();
        // The two cuts that leave nothing of the rectangle between them.
        let mut pair: Option<[usize; 2]> = None;
        for _ in 0..ROUNDS {
            let at = match pair {
                None => rectangle.middle_of(&part),
                Some([one, other]) => rectangle.middle_of(&[cuts[one].at, cuts[other].at]),
            };
            match self.spot(at, tally).spot {
                Spot::Triangle(t) => match mesh.places(t).iter().position(|v| v.is_ghost()) {
                    None => return Some(t),
                    Some(k) => ghost = t.edge(k),
                },
                Spot::Vertex(v) => return mesh.spokes(v).map(EdgeId::triangle).find(|&t| !mesh.is_ghost(t)),
                _ => return None,
            }
            let line = self.ends(mesh.twin(ghost.next()));
            if rectangle.is_beyond(line) {
                return None;
            }
            let new = cuts.len();
            let is_known = cuts.iter().any(|cut| cut.line == line);
            cuts.push(Cut { at, line });
            let is_empty = |other: usize| left_of(line, &left_of(cuts[other].line, &corners)).is_empty();
            if pair.is_none() {
                part = left_of(line, &part);
                if !part.is_empty() {
                    continue;
                }
            }
            let earlier = pair.map_or_else(|| (0..new).collect(), |pair| pair.to_vec());
            pair = earlier.into_iter().find(|&other| is_empty(other)).map(|other| [other, new]);
            if is_known || pair.is_none() {
                break;
            }
        }
        // Both ways around.
        let (mut left, mut right) = (ghost, mesh.twin(ghost).next());
        loop {
            for side in [left, right] {
                tally.visited();
                let edge = mesh.twin(side.next());
                let ends @ [corner, _] = self.ends(edge);
                if rectangle.meets(ends) {
                    return Some(edge.triangle());
                }
                let beside =
                    [mesh.spin(side), mesh.twin(side).next()].map(|e| self.ends(mesh.twin(e.next())));
                // One of them ends where this one starts.
                let before =
                    beside.into_iter().find(|other| other[1] == corner).map_or(corner, |other| other[0]);
                if rectangle.is_beyond(ends) || rectangle.is_past(before, corner, ends[1]) {
                    return None;
                }
            }
            // All around, if they have met or passed each other.
            if left == right || mesh.spin(left) == right {
                return None;
            }
            (left, right) = (mesh.spin(left), mesh.twin(right).next());
        }
    }

    /// The ends of a finite edge.
    fn ends(&self, e: EdgeId) -> [[f64; 2]; 2] {
        let mesh = &self.base.mesh;
        [mesh.tail(e), mesh.head(e)].map(|v| self.base.points[v.index()])
    }
}

/// A point of the rectangle that is outside of the hull, and the hull edge that it is beyond.
struct Cut {
    at: [f64; 2],
    line: [[f64; 2]; 2],
}

/// The part of a convex polygon to the left of a line, rounded.
fn left_of([a, b]: [[f64; 2]; 2], polygon: &[[f64; 2]]) -> Vec<[f64; 2]> {
    // The direction is of size one and coordinates are eighths, so that at any scale nothing overflows and little vanishes.
    let from_a = |p: [f64; 2]| [0, 1].map(|k| p[k] / 8.0 - a[k] / 8.0);
    let [x, y] = from_a(b);
    let size = x.abs().max(y.abs()).max(f64::MIN_POSITIVE);
    let [x, y] = [x / size, y / size];
    let height = |p: [f64; 2]| {
        let [to_x, to_y] = from_a(p);
        x * to_y - y * to_x
    };
    let mut part = Vec::with_capacity(polygon.len() + 1);
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (from, to) = (height(p), height(q));
        if from >= 0.0 {
            part.push(p);
        }
        if (from >= 0.0) != (to >= 0.0) {
            let share = from / (from - to);
            part.push([0, 1].map(|k| p[k] * (1.0 - share) + q[k] * share));
        }
    }
    part
}

#[cfg(test)]
mod tests {
    use super::{Rectangle, left_of};

    const R: Rectangle = Rectangle { low: [1.0, 2.0], high: [4.0, 8.0] };

    #[test]
    fn segments_meet_a_rectangle_or_not() {
        let both = |a: [f64; 2], b: [f64; 2]| {
            assert_eq!(R.meets([a, b]), R.meets([b, a]), "{a:?} {b:?}");
            R.meets([a, b])
        };
        // Inside, across, touching a side and a corner.
        assert!(both([2.0, 3.0], [3.0, 4.0]) && both([0.0, 3.0], [9.0, 5.0]) && both([2.0, 0.0], [2.0, 9.0]));
        assert!(both([0.0, 2.0], [9.0, 2.0]) && both([4.0, 0.0], [4.0, 3.0]) && both([0.0, 3.0], [2.0, 1.0]));
        // Apart along an axis, on each of four sides; and along none, past each corner.
        assert!(!both([0.0, 0.0], [0.9, 9.0]) && !both([4.1, 0.0], [9.0, 9.0]));
        assert!(!both([0.0, 1.9], [9.0, 0.0]) && !both([0.0, 8.1], [9.0, 9.0]));
        assert!(!both([0.0, 2.9], [1.9, 1.0]) && !both([3.1, 1.0], [5.0, 2.9]));
        assert!(!both([0.0, 7.1], [1.9, 9.0]) && !both([3.1, 9.0], [5.0, 7.1]));
    }

    /// For corners that are the last of their polygon along an axis, or share that place with one of their neighbors.
    #[test]
    fn polygons_end_before_a_rectangle_begins() {
        let turned = |p: [f64; 2]| [5.0 - p[0], 10.0 - p[1]]; // the rectangle stays where it is
        for (before, corner, after, expected) in [
            ([0.0, 3.0], [0.5, 4.0], [0.0, 5.0], true),
            ([0.0, 3.0], [1.0, 4.0], [0.0, 5.0], false), // on its border
            ([0.5, 3.0], [0.5, 4.0], [0.0, 5.0], true),
            ([0.0, 3.0], [0.5, 4.0], [0.5, 5.0], true),
            ([0.5, 3.0], [0.5, 4.0], [0.5, 5.0], false), // nothing is known of the others
            ([0.7, 3.0], [0.5, 4.0], [0.0, 5.0], false),
            ([0.0, 3.0], [0.5, 4.0], [0.7, 5.0], false),
            ([2.0, 1.0], [3.0, 1.5], [4.0, 1.0], true),
            ([2.0, 1.0], [3.0, 2.0], [4.0, 1.0], false),
            ([2.0, 1.5], [3.0, 1.5], [4.0, 1.0], true),
            ([2.0, 1.7], [3.0, 1.5], [4.0, 1.0], false),
        ] {
            assert_eq!(R.is_past(before, corner, after), expected, "{before:?} {corner:?} {after:?}");
            assert_eq!(R.is_past(after, corner, before), expected, "{after:?} {corner:?} {before:?}");
            let [p, q, r] = [before, corner, after].map(turned);
            assert_eq!(R.is_past(p, q, r), expected, "{p:?} {q:?} {r:?}");
        }
    }

    #[test]
    fn a_rectangle_is_beyond_a_line_with_all_of_its_corners() {
        assert!(R.is_beyond([[0.0, 0.0], [0.0, 1.0]]) && !R.is_beyond([[0.0, 1.0], [0.0, 0.0]]));
        assert!(!R.is_beyond([[1.0, 0.0], [1.0, 1.0]]) && !R.is_beyond([[2.0, 0.0], [2.0, 1.0]]));
        assert!(
            R.contains([1.0, 2.0])
                && R.contains([4.0, 8.0])
                && !R.contains([0.9, 3.0])
                && !R.contains([2.0, 8.1])
        );
    }

    #[test]
    fn the_middle_of_a_part_is_in_the_rectangle() {
        assert_eq!(R.middle_of(&[[2.0, 3.0], [3.0, 7.0]]), [2.5, 5.0]);
        assert_eq!(R.middle_of(&[[0.0, 0.0], [1.0, 1.0]]), [1.0, 2.0]);
    }

    #[test]
    fn lines_cut_polygons() {
        let square = [[1.0, 3.0], [5.0, 3.0], [5.0, 11.0], [1.0, 11.0]];
        // Down through x = 2, up through it, slanted through two sides, along a side, and beside all of it.
        assert_eq!(
            left_of([[2.0, 9.0], [2.0, 5.0]], &square),
            [[2.0, 3.0], [5.0, 3.0], [5.0, 11.0], [2.0, 11.0]]
        );
        assert_eq!(
            left_of([[2.0, 5.0], [2.0, 9.0]], &square),
            [[1.0, 3.0], [2.0, 3.0], [2.0, 11.0], [1.0, 11.0]]
        );
        assert_eq!(
            left_of([[0.0, 1.0], [4.0, 5.0]], &square),
            [[1.0, 3.0], [2.0, 3.0], [5.0, 6.0], [5.0, 11.0], [1.0, 11.0]]
        );
        assert_eq!(left_of([[0.0, 3.0], [9.0, 3.0]], &square), square);
        assert_eq!(left_of([[0.0, 12.0], [9.0, 12.0]], &square), [[0.0; 2]; 0]);
    }
}
