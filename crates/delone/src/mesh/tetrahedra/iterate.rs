//! Walks over all of a mesh of space, around its vertices and around its edges.

use super::{FACETS, Mesh3};
use crate::ids::{FacetId, Place, TetrahedronId, VertexId};

impl Mesh3 {
    /// The finite tetrahedra; none if the points span less than space.
    #[doc(alias("finite_cells", "all_cells"))]
    pub fn tetrahedra(&self) -> impl Iterator<Item = TetrahedronId> + Clone + '_ {
        // Where points span less than space, other corners have no name either.
        self.cells().filter(|&t| self.corners(t).iter().all(|v| !v.is_ghost()))
    }

    /// The facets of finite tetrahedra, each in one of its two directions. Those of the hull are included. None if the points span less than
    /// space.
    #[doc(alias = "finite_facets")]
    pub fn facets(&self) -> impl Iterator<Item = FacetId> + Clone + '_ {
        let facets = self.tetrahedra().flat_map(|t| [0, 1, 2, 3].map(|k| t.facet(k)));
        facets.filter(|&f| {
            let across = self.twin(f);
            f < across || self.is_ghost(across.tetrahedron())
        })
    }

    /// The tetrahedra at a vertex, ghosts included, in no order: O(d log d) for d of them. Empty for an index that is no vertex. Where the
    /// points span less than space, corners that are invented are ghosts too.
    #[doc(alias("incident_cells", "star"))]
    pub fn tetrahedra_at(&self, v: VertexId) -> Vec<TetrahedronId> {
        let mut star = Vec::new();
        if let Some(place) = self.place(v) {
            self.star(place, &mut star);
        }
        star
    }

    /// The vertices joined to `v` by an edge, by increasing index: O(d log d) for d tetrahedra at `v`.
    #[doc(alias("neighbours", "adjacent_vertices"))]
    pub fn neighbors(&self, v: VertexId) -> Vec<VertexId> {
        let corners = self.tetrahedra_at(v).into_iter().flat_map(|t| self.corners(t));
        let mut joined: Vec<VertexId> = corners.filter(|&w| w != v && !w.is_ghost()).collect();
        joined.sort_unstable();
        joined.dedup();
        joined
    }

    /// A tetrahedron at the edge from one vertex to another, ghosts included, and which of its corners these are, if there is such an edge:
    /// O(d log d) for d tetrahedra at the first one.
    #[doc(alias = "is_edge")]
    pub fn edge_between(&self, v: VertexId, w: VertexId) -> Option<(TetrahedronId, [usize; 2])> {
        let at = |t: TetrahedronId| {
            let corners = self.corners(t);
            let corner = |v| corners.iter().position(|&corner| corner == v);
            Some((t, [corner(v)?, corner(w)?]))
        };
        self.tetrahedra_at(v).into_iter().filter(|_| v != w).find_map(at)
    }

    /// The tetrahedra around the edge from one corner of a tetrahedron to another, ghosts included: from this one on, counter-clockwise for
    /// who looks from the second corner to the first. O(1) a step.
    ///
    /// # Panics
    /// If the corners are not two different ones of 0 to 3.
    ///
    /// ```
    /// use delone::{Delaunay3, VertexId};
    ///
    /// // Four tetrahedra around the edge from 0 to 1.
    /// let points = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 2.1, 0.0], [-2.2, 0.0, 0.0], [0.0, -2.3, 0.0]];
    /// let d = Delaunay3::from_points(&points)?;
    /// let (t, edge) = d.mesh().edge_between(VertexId::new(0), VertexId::new(1)).expect("an edge");
    /// assert_eq!(d.mesh().around_edge(t, edge).count(), 4);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("circulator", "incident_cells", "ring"))]
    pub fn around_edge(&self, t: TetrahedronId, [i, j]: [usize; 2]) -> AroundEdge<'_> {
        assert!(i != j && i < 4 && j < 4, "an edge is between two different corners of 0 to 3");
        let edge = [i, j].map(|k| self.cells[t.index()].corners[k]);
        AroundEdge { mesh: self, first: t, next: Some(first_around(t, [i, j])), edge }
    }

    /// The facet by which a turn around an edge leaves the tetrahedron that it entered by a facet: across from the corner that is neither on the edge
    /// nor new there.
    #[inline]
    pub(crate) fn next_around(&self, entered: FacetId, edge: [Place; 2]) -> FacetId {
        let t = entered.tetrahedron();
        let [i, j] = edge.map(|end| self.cells[t.index()].corner(end));
        t.facet(6 - entered.corner() - i - j)
    }
}

/// The facet by which a turn around the edge from corner i to corner j leaves a tetrahedron, counter-clockwise for who looks from j to i.
#[inline]
pub(crate) fn first_around(t: TetrahedronId, [i, j]: [usize; 2]) -> FacetId {
    // Seen from its corner, a facet has its corners counter-clockwise: the corner before the end is left behind.
    let facet = FACETS[i];
    let [_, second, third] = facet.map(|corner| corner == j);
    t.facet(facet[(2 + usize::from(second) + 2 * usize::from(third)) % 3])
}

/// The tetrahedra around an edge.
#[derive(Clone, Debug)]
pub struct AroundEdge<'a> {
    mesh: &'a Mesh3,
    first: TetrahedronId,
    /// The facet by which the next tetrahedron is left.
    next: Option<FacetId>,
    edge: [Place; 2],
}

impl Iterator for AroundEdge<'_> {
    type Item = TetrahedronId;

    fn next(&mut self) -> Option<TetrahedronId> {
        let f = self.next?;
        let t = f.tetrahedron();
        let entered = self.mesh.twin(f);
        let is_last = entered.tetrahedron() == self.first;
        self.next = (!is_last).then(|| self.mesh.next_around(entered, self.edge));
        Some(t)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use crate::{Delaunay3, TetrahedronId, VertexId};

    fn triangulated() -> Vec<(Vec<[f64; 3]>, Delaunay3)> {
        let cube = |n: usize| {
            (0..n).map(|i| [i * 7919 % 97, i * 104_729 % 89, i * 1_299_709 % 83].map(|x| x as f64)).collect()
        };
        let grid = (0..27).map(|i| [i % 3, i / 3 % 3, i / 9].map(f64::from)).collect();
        let sets: [Vec<[f64; 3]>; 3] = [cube(5), cube(60), grid];
        sets.into_iter()
            .map(|points| (points.clone(), Delaunay3::from_points(&points).expect("points")))
            .collect()
    }

    #[test]
    fn rings_are_the_tetrahedra_of_both_ends() {
        for (points, d) in triangulated() {
            let mesh = d.mesh();
            let all: Vec<TetrahedronId> = mesh.cells().collect();
            for &t in &all {
                for i in 0..4 {
                    for j in (0..4).filter(|&j| j != i) {
                        let [v, w] = [i, j].map(|k| mesh.corners(t)[k]);
                        let ring: Vec<_> = mesh.around_edge(t, [i, j]).collect();
                        assert_eq!(ring[0], t);
                        let has_both =
                            |&&t: &&TetrahedronId| [v, w].iter().all(|v| mesh.corners(t).contains(v));
                        let expected: BTreeSet<_> = all.iter().filter(has_both).copied().collect();
                        assert_eq!(ring.iter().copied().collect::<BTreeSet<_>>(), expected);
                        assert_eq!(ring.len(), expected.len());
                        let after = ring.iter().cycle().skip(1);
                        assert!(ring.iter().zip(after).all(|(&t, &next)| mesh.adjacent(t).contains(&next)));
                        let back: Vec<_> = mesh.around_edge(t, [j, i]).collect();
                        assert!(ring.iter().skip(1).eq(back.iter().skip(1).rev()));
                    }
                }
            }
            turns_counter_clockwise(&points, &d);
        }
    }

    /// Around an edge inside of the hull, corners follow one another by increasing angle for who looks from its end.
    fn turns_counter_clockwise(points: &[[f64; 3]], d: &Delaunay3) {
        let mesh = d.mesh();
        for t in mesh.tetrahedra() {
            let ring: Vec<_> = mesh.around_edge(t, [0, 1]).collect();
            if ring.iter().any(|&t| mesh.is_ghost(t)) {
                continue;
            }
            let [a, b] = [0, 1].map(|k| mesh.corners(t)[k]);
            for (&t, &next) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                let only = |t: TetrahedronId, other: TetrahedronId| {
                    let corners = mesh.corners(other);
                    let own = mesh.corners(t).into_iter().find(|v| !corners.contains(v)).expect("a corner");
                    points[own.index()]
                };
                if ring.len() > 3 {
                    let (from, to) = (only(t, next), only(next, t));
                    let shared = mesh
                        .corners(t)
                        .into_iter()
                        .find(|v| ![a, b].contains(v) && mesh.corners(next).contains(v));
                    let middle = points[shared.expect("a facet").index()];
                    let [start, end] = [a, b].map(|v| points[v.index()]);
                    for (p, q) in [(from, middle), (middle, to)] {
                        assert!(turn(start, end, p, q) > 0.0, "clockwise");
                    }
                }
            }
        }
    }

    /// Positive if the turn from `p` to `q` around the axis is counter-clockwise seen from the end of the axis.
    fn turn(start: [f64; 3], end: [f64; 3], p: [f64; 3], q: [f64; 3]) -> f64 {
        let from = |x: [f64; 3]| [0, 1, 2].map(|k| x[k] - start[k]);
        let ([ax, ay, az], [px, py, pz], [qx, qy, qz]) = (from(end), from(p), from(q));
        ax * (py * qz - pz * qy) + ay * (pz * qx - px * qz) + az * (px * qy - py * qx)
    }

    #[test]
    fn facets_and_neighbors_are_counted_once() {
        for (points, d) in triangulated() {
            let mesh = d.mesh();
            let (cells, facets) = (mesh.tetrahedra().count(), mesh.facets().count());
            let hull = mesh.cells().count() - cells;
            assert_eq!(2 * facets, 4 * cells + hull);
            let mut edges = 0;
            for v in (0..points.len()).map(VertexId::new) {
                let near = mesh.neighbors(v);
                edges += near.len();
                for w in (0..points.len()).map(VertexId::new) {
                    let found = mesh.edge_between(v, w);
                    assert_eq!(found.is_some(), near.contains(&w), "{v:?} {w:?}");
                    assert!(found.is_none_or(|(t, [i, j])| {
                        let corners = mesh.corners(t);
                        corners[i] == v && corners[j] == w
                    }));
                }
            }
            // Euler's formula of a ball.
            assert_eq!(points.len() + facets, 1 + edges / 2 + cells);
        }
        let flat: Vec<_> = (0..9).map(|i| [f64::from(i % 3), f64::from(i / 3), 1.0]).collect();
        for points in [&flat[..], &flat[..3], &flat[..1], &[]] {
            let d = Delaunay3::from_points(points).expect("points");
            assert_eq!((d.mesh().tetrahedra().count(), d.mesh().facets().count()), (0, 0));
            assert!(d.mesh().tetrahedra_at(VertexId::new(9)).is_empty());
            assert!(
                (0..points.len()).all(|v| !d.mesh().neighbors(VertexId::new(v)).contains(&VertexId::GHOST))
            );
        }
    }
}
