//! Nodes of elements of second order in the middles of arcs.
//!
//! A triangle with six nodes is mapped by quadratic functions. Its Jacobian is a quadratic function of the barycentric coordinates, and positive if
//! its six coefficients in Bernstein form are (Johnen, Remacle & Geuzaine, "Geometrical validity of curvilinear finite elements", J. Comput. Phys.
//! 2013). Each is compared with a bound of its rounding error: so positive is proven, and where it is not sides are straight.
//!
//! Cost: O(1) a triangle beside an arc, O(log a) for a look at one of a arcs.

use std::collections::BTreeMap;

use super::Refined2;
use super::arcs::chords;
use crate::error::Error;
use crate::ids::{EdgeId, TriangleId, VertexId};
use crate::plane::arc::Arc2;
use crate::plane::constrained::{Constrained2, SegmentId};

/// A bound of the error of a coefficient, relative to the largest product of differences of coordinates: a side of the map is a sum of at
/// most three such differences times 4, and a coefficient four products of two sides. 32 times 2^-53 is the bound, and this is twice that.
const ERROR: f64 = 64.0 * f64::EPSILON;

/// The ends of an edge, the lesser id first, and the point in the middle of it.
pub type Middle2 = ([VertexId; 2], [f64; 2]);

impl Refined2 {
    /// The middles of the edges that are chords of arcs ([`super::Refinement::arcs`], with the same ones), on the arcs, by the ids of their ends: further
    /// nodes of triangles of second order, none of which is inverted anywhere. Edges of which that is not proven are left out, and so are
    /// edges with no triangle inside.
    ///
    /// # Errors
    /// [`Error::Arc`] for an arc that is none.
    pub fn arc_middles(
        &self,
        c: &Constrained2,
        arcs: &[(SegmentId, [f64; 2])],
    ) -> Result<Vec<Middle2>, Error> {
        let chords = chords(c, arcs, &self.domains.origins)?;
        let input = |e: EdgeId| {
            let ends = [c.mesh().origin(e), c.mesh().destination(e)];
            let origin = |v: VertexId| self.domains.origins.get(v.index()).map(|origin| origin.on);
            let on = ends.into_iter().zip(ends.map(origin)).find_map(|(v, on)| on.filter(|on| *on != [v; 2]));
            on.filter(|on| !on[0].is_ghost()).unwrap_or(ends)
        };
        let mut middles: BTreeMap<[VertexId; 2], [f64; 2]> = BTreeMap::new();
        let mut beside: Vec<TriangleId> = Vec::new();
        for e in c.constraint_edges() {
            let [a, b] = input(e);
            let Some(center) = chords.get(&[a.min(b), a.max(b)]) else { continue };
            let ends = ends_of(c, e);
            let sides = [e, c.mesh().twin(e)].map(|e| e.triangle());
            let inside = sides.into_iter().filter(|&t| self.domains.is_inside(t));
            let before = beside.len();
            beside.extend(inside);
            if beside.len() > before {
                middles.insert(ends, Arc2::of(ends.map(|v| c.point(v)), *center).middle());
            }
        }
        while let Some(t) = beside.pop() {
            let edges = [0, 1, 2].map(|k| t.edge(k));
            if edges.iter().all(|&e| !middles.contains_key(&ends_of(c, e))) || is_valid(c, t, &middles) {
                continue;
            }
            for e in edges {
                if middles.remove(&ends_of(c, e)).is_some() {
                    let other = c.mesh().twin(e).triangle();
                    beside.extend(Some(other).filter(|&t| self.domains.is_inside(t)));
                }
            }
        }
        Ok(middles.into_iter().collect())
    }
}

fn ends_of(c: &Constrained2, e: EdgeId) -> [VertexId; 2] {
    let [a, b] = [c.mesh().origin(e), c.mesh().destination(e)];
    [a.min(b), a.max(b)]
}

/// Whether the Jacobian of a triangle with six nodes is proven to be positive.
fn is_valid(c: &Constrained2, t: TriangleId, middles: &BTreeMap<[VertexId; 2], [f64; 2]>) -> bool {
    let edges = [0, 1, 2].map(|k| t.edge(k));
    let corners = edges.map(|e| c.point(c.mesh().origin(e)));
    // Opposite of each corner.
    let middles = [1, 2, 0].map(|k| {
        let ends = ends_of(c, edges[k]);
        let straight = || {
            let [p, q] = ends.map(|v| c.point(v));
            [p[0].midpoint(q[0]), p[1].midpoint(q[1])]
        };
        middles.get(&ends).copied().unwrap_or_else(straight)
    });
    let from = |p: [f64; 2], q: [f64; 2]| [q[0] - p[0], q[1] - p[1]];
    let sum = |terms: &[(f64, [f64; 2])]| [0, 1].map(|k| terms.iter().map(|(w, v)| w * v[k]).sum::<f64>());
    // The derivative along the side from corner i to corner j at each corner; k is the third one.
    let sides = |i: usize, j: usize, k: usize| {
        let mut at = [[0.0; 2]; 3];
        let (chord, middle) = (from(corners[i], corners[j]), from(corners[i], middles[k]));
        at[i] = sum(&[(4.0, middle), (-1.0, chord)]);
        at[j] = sum(&[(3.0, chord), (-4.0, middle)]);
        at[k] = sum(&[(4.0, from(middles[j], middles[i])), (-1.0, chord)]);
        at
    };
    let (u, v) = (sides(0, 1, 2), sides(0, 2, 1));
    let cross = |i: usize, j: usize| u[i][0] * v[j][1] - u[i][1] * v[j][0];
    let largest = u.iter().chain(&v).flatten().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let differences = corners.map(|p| from(corners[0], p)).into_iter().flatten();
    let scale = differences.fold(largest, |largest, x| largest.max(x.abs()));
    let bound = ERROR * scale * scale;
    let is_normal = bound > f64::MIN_POSITIVE && bound.is_finite();
    let at_corners = (0..3).map(|i| cross(i, i));
    let on_sides = [[0, 1], [1, 2], [2, 0]].into_iter().map(|[i, j]| 0.5 * (cross(i, j) + cross(j, i)));
    is_normal && at_corners.chain(on_sides).all(|coefficient| coefficient > bound)
}
