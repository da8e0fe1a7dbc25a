//! Quadrilaterals alone: each of a pairing becomes four and each triangle that is left three, about its center.
//!
//! Every edge gets a vertex in its middle and every cell one in the mean of its corners. Both are rounded once, so neighbors agree. Before
//! rounding all are convex: two sides of a part are halves of sides of its cell, and the two others lead to the middles of sides that the
//! center sees on different sides. After rounding each is judged exactly.
//!
//! Cost: O(n log n).

use std::collections::BTreeMap;

use delone_predicates::{mean, orient2d};

use super::middles::Middle2;
use super::quads::Quads2;
use crate::ids::{TriangleId, VertexId};
use crate::plane::Constrained2;

/// A mesh of quadrilaterals alone, between the vertices of a triangulation and new points.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct AllQuads2 {
    /// The points of the triangulation, then the middles of edges, then the centers of cells.
    pub points: Vec<[f64; 2]>,
    /// The number of the first middle.
    pub first: usize,
    /// The edge that each middle is of, its lesser vertex first, by increasing vertices.
    pub middles: Vec<[VertexId; 2]>,
    /// The corners of each quadrilateral, counter-clockwise: a vertex, the middle of an edge, the center, the middle of an edge.
    pub corners: Vec<[usize; 4]>,
    /// A triangle of the cell that each is a part of.
    pub triangles: Vec<TriangleId>,
    /// Quadrilaterals that are not convex because coordinates are rounded, by their index.
    pub left: Vec<usize>,
}

impl AllQuads2 {
    /// Divides the cells of a pairing.
    ///
    /// Cost: O(n log n).
    ///
    /// ```
    /// use delone::{AllQuads2, Constrained2, Quads2, Refinement};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [3, 0], [3, 2], [0, 2]], &[])?;
    /// let refined = Refinement::new().edge(0.5).run(&mut c)?;
    /// let quads = Quads2::of(&c, &refined);
    /// let all = AllQuads2::of(&c, &quads);
    /// assert_eq!(all.corners.len(), 4 * quads.corners.len() + 3 * quads.triangles.len());
    /// assert!(all.left.is_empty());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn of(c: &Constrained2, quads: &Quads2) -> Self {
        let mesh = c.mesh();
        let pairs = quads.corners.iter().zip(&quads.pairs).map(|(corners, pair)| (corners.to_vec(), pair[0]));
        let left = quads.triangles.iter().map(|&t| (mesh.corners(t).to_vec(), t));
        let cells: Vec<(Vec<VertexId>, TriangleId)> = pairs.chain(left).collect();
        let side = |corners: &[VertexId], k: usize| {
            let (v, w) = (corners[k], corners[(k + 1) % corners.len()]);
            [v.min(w), v.max(w)]
        };
        let mut middles: Vec<[VertexId; 2]> =
            cells.iter().flat_map(|(corners, _)| (0..corners.len()).map(|k| side(corners, k))).collect();
        middles.sort_unstable();
        middles.dedup();
        let first = c.points().len();
        let halfway = middles.iter().map(|ends| {
            let [p, q] = ends.map(|v| c.point(v));
            [0, 1].map(|k| mean([p[k], q[k]]))
        });
        let points = c.points().iter().copied().chain(halfway).collect();
        let mut made = Self { points, first, ..Self::default() };
        for (corners, t) in &cells {
            let center = made.points.len();
            made.points.push(center_of(c, corners));
            let middle = |k: usize| first + middles.partition_point(|ends| *ends < side(corners, k));
            for (k, v) in corners.iter().enumerate() {
                let before = (k + corners.len() - 1) % corners.len();
                made.corners.push([v.index(), middle(k), center, middle(before)]);
                made.triangles.push(*t);
            }
        }
        made.middles = middles;
        made.judge();
        made
    }

    /// Puts middles of edges onto arcs ([`super::Refined2::arc_middles`]), but for those beside a quadrilateral that is not convex then.
    ///
    /// Cost: O(n log a) for a middles on arcs.
    ///
    /// ```
    /// use delone::{AllQuads2, Constrained2, Quads2, Refinement, SegmentId};
    ///
    /// let corners = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
    /// let mut c = Constrained2::from_parts(&corners, &[[0, 1], [1, 2], [2, 3], [3, 0]])?;
    /// let arcs: Vec<_> = (0..4).map(|s| (SegmentId::new(s), [0.0, 0.0])).collect();
    /// let refined = Refinement::new().edge(0.2).arcs(&arcs).run(&mut c)?;
    /// let mut all = AllQuads2::of(&c, &Quads2::of(&c, &refined));
    /// all.bend(&refined.arc_middles(&c, &arcs)?);
    /// let on_circle = all.points.iter().filter(|[x, y]| (x * x + y * y - 1.0).abs() < 1e-14).count();
    /// assert!(on_circle >= 50 && all.left.is_empty());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn bend(&mut self, middles: &[Middle2]) {
        if middles.is_empty() {
            return;
        }
        let number = |ends: &[VertexId; 2]| self.middles.binary_search(ends).ok();
        let mut straight: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
        for (ends, place) in middles {
            if let Some(i) = number(ends).map(|k| self.first + k) {
                straight.insert(i, std::mem::replace(&mut self.points[i], *place));
            }
        }
        loop {
            let bent = |row: &usize| self.corners[*row].iter().any(|i| straight.contains_key(i));
            let all = (0..self.corners.len()).filter(bent);
            let flawed: Vec<usize> = all.filter(|&row| !is_convex(self.places(row))).collect();
            if flawed.is_empty() {
                break;
            }
            for i in flawed.into_iter().flat_map(|row| self.corners[row]) {
                if let Some(place) = straight.remove(&i) {
                    self.points[i] = place;
                }
            }
        }
        self.judge();
    }

    /// Notes which quadrilaterals are not convex.
    pub(super) fn judge(&mut self) {
        self.left = (0..self.corners.len()).filter(|&row| !is_convex(self.places(row))).collect();
    }

    /// The places of the corners of a quadrilateral.
    ///
    /// # Panics
    ///
    /// If there is no such quadrilateral.
    pub fn places(&self, row: usize) -> [[f64; 2]; 4] {
        self.corners[row].map(|i| self.points[i])
    }

    /// The smallest and the largest angle of the quadrilaterals in degrees, rounded; nothing if there are none.
    pub fn angles(&self) -> Option<[f64; 2]> {
        range_of_angles((0..self.corners.len()).map(|row| self.places(row)))
    }
}

/// The mean of the corners of a cell, rounded once.
fn center_of(c: &Constrained2, corners: &[VertexId]) -> [f64; 2] {
    let coordinate = |i: usize, k: usize| c.point(corners[i])[k];
    [0, 1].map(|k| match corners.len() {
        3 => mean([0, 1, 2].map(|i| coordinate(i, k))),
        _ => mean([0, 1, 2, 3].map(|i| coordinate(i, k))),
    })
}

/// Whether all turns are to the left.
pub(super) fn is_convex(p: [[f64; 2]; 4]) -> bool {
    (0..4).all(|k| orient2d(p[(k + 3) % 4], p[k], p[(k + 1) % 4]).is_positive())
}

/// The smallest and the largest of all angles, in degrees.
pub(super) fn range_of_angles(quads: impl Iterator<Item = [[f64; 2]; 4]>) -> Option<[f64; 2]> {
    let angles = quads.flat_map(|p| [0, 1, 2, 3].map(|k| angle(p, k)));
    angles.fold(None, |range, angle| {
        let [low, high] = range.unwrap_or([angle; 2]);
        Some([angle.min(low), angle.max(high)])
    })
}

/// The angle at a corner, in degrees from 0 to 360.
fn angle(p: [[f64; 2]; 4], k: usize) -> f64 {
    let [u, v] = [p[(k + 1) % 4], p[(k + 3) % 4]].map(|q| super::quads::direction(p[k], q));
    let degrees = libm::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]).to_degrees();
    if degrees < 0.0 { degrees + 360.0 } else { degrees }
}
