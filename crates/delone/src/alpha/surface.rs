//! The outline in space: the border of the tetrahedra as triangles.

use delone_predicates::orient3d;

use super::Alpha;
use super::facing::{NONE, across};
use crate::ids::VertexId;

impl Alpha<3> {
    /// The border of the tetrahedra that are there at a squared radius: triangles, counter-clockwise seen from outside, each from its least
    /// vertex on, sorted. Every edge has as many of them in one direction as in the other, so they are closed surfaces; where parts touch
    /// along an edge or in a vertex, surfaces do ([`Self::manifold`] has these apart). Triangles, edges and vertices outside of all tetrahedra are no part of it. O(k log k) for
    /// k tetrahedra, and O(n).
    ///
    /// ```
    /// use delone::Delaunay3;
    /// let points: Vec<[i32; 3]> = (0..27).map(|i| [i % 3, i / 3 % 3, i / 9]).collect();
    /// let alpha = Delaunay3::from_points(&points)?.alpha();
    /// assert_eq!(alpha.outline(0.75).len(), 6 * 8);
    /// assert!(alpha.outline(0.74).is_empty());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn outline(&self, alpha: f64) -> Vec<[VertexId; 3]> {
        let tetrahedra = self.tetrahedra.until(alpha);
        let across = across(self.points.len(), tetrahedra);
        self.facets(tetrahedra, &across).into_iter().map(|facet| facet.corners).collect()
    }

    /// The facets of tetrahedra that have nothing across them, sorted.
    pub(super) fn facets(&self, tetrahedra: &[[VertexId; 4]], across: &[[u32; 4]]) -> Vec<Facet> {
        let mut facets = Vec::new();
        for (i, (corners, beyond)) in tetrahedra.iter().zip(across).enumerate() {
            for k in (0..4).filter(|&k| beyond[k] == NONE) {
                let [a, b, c] = std::array::from_fn(|i| corners[i + usize::from(i >= k)]);
                let [p, q, r, s] = [a, b, c, corners[k]].map(|v| self.position(v));
                // Counter-clockwise seen from outside is clockwise from the fourth corner.
                let corners = if orient3d(p, q, r, s).is_negative() { [a, b, c] } else { [a, c, b] };
                facets.push(Facet { corners, inside: i as u32, opposite: k });
            }
        }
        facets.sort_unstable();
        facets
    }
}

/// A facet of the border, by its corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Facet {
    /// Counter-clockwise seen from outside, from the least one on.
    pub(super) corners: [VertexId; 3],
    /// The tetrahedron.
    pub(super) inside: u32,
    /// Which of its corners is opposite.
    pub(super) opposite: usize,
}
