//! Geometric validity, proved with exact predicates alone.
//!
//! A three-dimensional sphere of tetrahedra (`mesh::tetrahedra`) is the canonical Delaunay triangulation of its vertices
//! if every finite tetrahedron is in positive order, the hull is convex at every edge and goes around each of its
//! vertices once, and no facet has the vertex across it inside the sphere of its tetrahedron (Delaunay's lemma: local
//! implies global, for the perturbed points too). Cost: O(n log n).

use delone_predicates::{lexicographic3, orient3d};

use super::Delaunay3;
use super::layer::Layer;
use super::layer::kernel::Lift;
use crate::ids::{Duplicate, FacetId, Place, TetrahedronId, VertexId};
use crate::mesh::{Dimension, MeshFlaw3};

/// A flaw of a triangulation of space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Flaw3 {
    /// It is no closed manifold.
    #[error(transparent)]
    Mesh(#[from] MeshFlaw3),
    /// A finite tetrahedron is turned over or flat.
    #[error("tetrahedron {0:?} is not in positive order")]
    Orientation(TetrahedronId),
    /// The hull is not convex at an edge of a facet.
    #[error("the hull is not convex at facet {0:?}")]
    Hull(FacetId),
    /// The hull does not go around a vertex once.
    #[error("the hull does not go around vertex {0:?} once")]
    Winding(VertexId),
    /// A facet is not locally Delaunay under the canonical rule.
    #[error("the vertex across facet {0:?} is inside the sphere of its tetrahedron")]
    Delaunay(FacetId),
    /// The vertices span more than is said.
    #[error("vertex {0:?} is outside of what the others span")]
    Span(VertexId),
    /// A point is called the duplicate of a vertex that was given later, or is no vertex.
    #[error("point {} is no duplicate of vertex {:?}", .0.point, .0.vertex)]
    Duplicate(Duplicate),
    /// The number of vertices is not what it is said to be.
    #[error("{0} vertices are there, not as many as are counted")]
    Count(usize),
}

impl Delaunay3 {
    /// Proves that this is the canonical Delaunay triangulation of its vertices, or returns the first flaw found.
    /// O(n log n), and independent of how it was built and changed.
    pub fn check(&self) -> Result<(), Flaw3> {
        check_geometry(&self.base)?;
        let mesh = &self.base.mesh;
        let wrong = |d: &Duplicate| {
            mesh.contains(VertexId::new(d.point)) || !mesh.contains(d.vertex) || d.vertex.index() >= d.point
        };
        self.duplicates().find(wrong).map_or(Ok(()), |d| Err(Flaw3::Duplicate(d)))
    }
}

/// The vertices of a layer have the tetrahedra that its kernel gives them.
pub(super) fn check_geometry<W: Lift>(layer: &Layer<W>) -> Result<(), Flaw3> {
    let mesh = &layer.mesh;
    mesh.check()?;
    for t in mesh.cells() {
        let cell = mesh.cells[t.index()];
        let ends = |f: FacetId| mesh.cells[f.tetrahedron().index()].corners[f.corner()];
        if mesh.is_ghost(t) {
            let [a, b, c] = [0, 1, 2].map(|k| layer.points[cell.corners[k].index()]);
            for k in 0..3 {
                // The facet of the hull beside this one, and its corner that they do not share.
                let beyond = layer.site(ends(cell.across[k]));
                let side = orient3d(a, b, c, beyond.0);
                let inner =
                    || mesh.cells[cell.across[3].tetrahedron().index()].corners.map(|p| layer.site(p));
                if side.is_positive() || (side.is_zero() && W::is_in_sphere(inner(), beyond)) {
                    return Err(Flaw3::Hull(t.facet(k)));
                }
            }
            continue;
        }
        let sites @ [a, b, c, d] = cell.corners.map(|p| layer.site(p));
        if !orient3d(a.0, b.0, c.0, d.0).is_positive() {
            return Err(Flaw3::Orientation(t));
        }
        for k in 0..4 {
            let across = ends(cell.across[k]);
            if !across.is_ghost() && W::is_in_sphere(sites, layer.site(across)) {
                return Err(Flaw3::Delaunay(t.facet(k)));
            }
        }
    }
    check_winding(layer)?;
    check_span(layer)?;
    check_names(layer)
}

/// All vertices are in the span; the scaffold is off it.
fn check_span<W: Lift>(layer: &Layer<W>) -> Result<(), Flaw3> {
    let outside = |p: &Place| !layer.is_scaffold(*p) && !layer.is_in_span(layer.points[p.index()]);
    if layer.dimension() < Dimension::Space
        && let Some(p) = layer.mesh.inhabited().find(outside)
    {
        return Err(Flaw3::Span(layer.mesh.name(p)));
    }
    Ok(())
}

/// Names and places are each other's, and the vertices are as many as said.
fn check_names<W: Lift>(layer: &Layer<W>) -> Result<(), Flaw3> {
    let mesh = &layer.mesh;
    let vertices = || mesh.inhabited().filter(|p| !layer.is_scaffold(*p));
    let count = vertices().count();
    if count != mesh.vertex_count || mesh.vertices().count() != count {
        return Err(Flaw3::Count(count));
    }
    match vertices().find(|&p| mesh.place(mesh.name(p)) != Some(p)) {
        Some(p) => Err(Flaw3::Mesh(MeshFlaw3::Incident(mesh.name(p)))),
        None => Ok(()),
    }
}

/// Around each of its vertices the hull goes once and is convex, given that it is convex at its edges. A closed surface
/// like that is the border of a convex body (van Heijenoort, "On locally convex manifolds", 1952).
pub(super) fn check_winding<W: Lift>(layer: &Layer<W>) -> Result<(), Flaw3> {
    let mesh = &layer.mesh;
    let point = |p: Place| layer.points[p.index()];
    let mut met = vec![false; mesh.incident.len()];
    let mut link: Vec<[f64; 3]> = Vec::new();
    let mut corners_met = 0;
    let mut corners = 0;
    let mut last = VertexId::GHOST;
    for ghost in mesh.cells().filter(|&t| mesh.is_ghost(t)) {
        corners += 3;
        for &v in &mesh.cells[ghost.index()].corners[..3] {
            if std::mem::replace(&mut met[v.index()], true) {
                continue;
            }
            last = mesh.name(v);
            link.clear();
            let mut t = ghost;
            loop {
                let cell = &mesh.cells[t.index()];
                let i = cell.corners.iter().position(|&p| p == v).unwrap_or_default();
                link.push(point(cell.corners[(i + 1) % 3]));
                t = cell.across[(i + 1) % 3].tetrahedron();
                if t == ghost {
                    break;
                }
                // In a mesh that is none the way around may lead elsewhere, and never back.
                if cell.corners[i] != v || !mesh.is_ghost(t) || link.len() > mesh.cells.len() {
                    return Err(Flaw3::Winding(last));
                }
            }
            corners_met += link.len();
            if !goes_once(point(v), &link) {
                return Err(Flaw3::Winding(last));
            }
        }
    }
    // Ghosts at a vertex that are not met on the way around it are another fan.
    if corners_met == corners { Ok(()) } else { Err(Flaw3::Winding(last)) }
}

/// Whether the cone from `v` over a closed polygon, counter-clockwise from outside, is convex and goes once around, if
/// it is convex at every edge: seen from its first edge it turns by half a circle at most and never back. Where it is
/// flat, a plane through `v` must cut it twice.
pub(super) fn goes_once(v: [f64; 3], link: &[[f64; 3]]) -> bool {
    let [first, .., last] = link else { return false };
    let next = |i: usize| &link[(i + 1) % link.len()];
    let is_beyond = |p: &[f64; 3], q: &[f64; 3], r: &[f64; 3]| orient3d(v, *p, *q, *r).is_positive();
    let before = |p: &[f64; 3]| lexicographic3(*p, v).is_lt();
    let changes = (0..link.len()).filter(|&i| before(&link[i]) != before(next(i))).count();
    changes <= 2
        && link.iter().enumerate().all(|(i, p)| {
            !is_beyond(p, next(i), first) && !is_beyond(first, &link[1], p) && !is_beyond(last, first, p)
        })
}

#[cfg(test)]
mod tests {
    use super::goes_once;

    /// The points of a polygon in the plane z = 1, seen counter-clockwise from below.
    fn cone(polygon: &[[f64; 2]]) -> Vec<[f64; 3]> {
        polygon.iter().rev().map(|&[x, y]| [x, y, 1.0]).collect()
    }

    #[test]
    fn cones_that_wind_twice_are_found() {
        let apex = [0.0, 0.0, 0.0];
        let square = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        assert!(goes_once(apex, &cone(&square)));
        // Convex at every edge, twice around: a star of five points.
        let star = [0, 2, 4, 1, 3].map(|k| {
            let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 5.0).sin_cos();
            [cos, sin]
        });
        assert!(!goes_once(apex, &cone(&star)));
        let twice = [square, square.map(|p| p.map(|x| 1.5 * x))].concat();
        assert!(!goes_once(apex, &cone(&twice)));
        // Flat: all in the plane of the apex.
        let flat = |polygon: &[[f64; 2]]| polygon.iter().map(|&[x, y]| [x, y, 0.0]).collect::<Vec<_>>();
        assert!(goes_once(apex, &flat(&square)));
        assert!(!goes_once(apex, &flat(&twice)));
    }
}
