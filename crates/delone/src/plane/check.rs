//! Geometric validity, proved with exact predicates alone.
//!
//! A sphere of triangles (`mesh::check`) is the canonical Delaunay triangulation of its vertices if every finite
//! triangle is counter-clockwise, the hull turns left or goes straight everywhere and only once around, and no
//! edge has the vertex across it inside the circle of its triangle (Delaunay's lemma: local implies global, for
//! the perturbed points too), fixed edges apart. Cost: O(n).
//!
//! That every point is a vertex or a duplicate holds where no site hides another; `regular` proves what is hidden.

use delone_predicates::{lexicographic, orient2d, strictly_between};

use super::Delaunay2;
use super::layer::Layer;
use super::layer::kernel::Kernel;
use crate::ids::{Duplicate, EdgeId, Place, TriangleId, VertexId};
use crate::mesh::{Dimension, Mesh2, MeshFlaw2};

/// A flaw of a triangulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Flaw2 {
    /// It is no closed surface.
    #[error(transparent)]
    Mesh(#[from] MeshFlaw2),
    /// A finite triangle is clockwise or flat.
    #[error("triangle {0:?} is not counter-clockwise")]
    Orientation(TriangleId),
    /// The hull turns right at a vertex.
    #[error("the hull is not convex at vertex {0:?}")]
    Hull(VertexId),
    /// The hull goes around more than once.
    #[error("the hull goes around {0} times")]
    Winding(usize),
    /// An edge is not locally Delaunay under the canonical rule.
    #[error("the vertex across edge {0:?} is inside the circle of its triangle")]
    Delaunay(EdgeId),
    /// The vertices of a line are not in order, or not on a line.
    #[error("vertex {0:?} is out of place on the line")]
    Line(VertexId),
    /// An input point is neither a vertex nor the duplicate of one.
    #[error("point {0} is neither a vertex nor a duplicate")]
    Missing(usize),
    /// A vertex is kept at a place that is not its own.
    #[error("vertex {0:?} is not where its name says")]
    Name(VertexId),
    /// A point is called the duplicate of a vertex that it does not equal, or that was given later.
    #[error("point {} is no duplicate of vertex {:?}", .0.point, .0.vertex)]
    Duplicate(Duplicate),
}

impl Delaunay2 {
    /// Proves that this is the canonical Delaunay triangulation of all its points, or returns the first flaw
    /// found. O(n), and independent of how it was built and changed.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let mut d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4]])?; // four points on one circle
    /// d.insert([1, 3])?;
    /// assert!(d.check().is_ok());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn check(&self) -> Result<(), Flaw2> {
        self.base.mesh.check()?;
        match &self.named {
            None => check_points(&self.base.points, &self.base.mesh, self.duplicates.iter(|_| true))?,
            Some(named) => check_names(named, &self.base.points, &self.base.mesh)?,
        }
        check_geometry(&self.base)
    }
}

/// Names and places are each other's, with the same coordinates.
fn check_names(named: &[[f64; 2]], points: &[[f64; 2]], mesh: &Mesh2) -> Result<(), Flaw2> {
    let kept = |v: VertexId| {
        mesh.place(v).is_some_and(|place| {
            mesh.is_vertex(place) && mesh.name(place) == v && points[place.index()] == named[v.index()]
        })
    };
    if let Some(v) = mesh.vertices().find(|&v| !kept(v)) {
        return Err(Flaw2::Name(v));
    }
    match mesh.inhabited().find(|&place| mesh.place(mesh.name(place)) != Some(place)) {
        Some(place) => Err(Flaw2::Name(mesh.name(place))),
        None => Ok(()),
    }
}

/// Every point is a vertex, or the later duplicate of an equal vertex.
fn check_points(
    points: &[[f64; 2]],
    mesh: &Mesh2,
    duplicates: impl Iterator<Item = Duplicate>,
) -> Result<(), Flaw2> {
    let mut represented: Vec<bool> = (0..points.len()).map(|i| mesh.contains(VertexId::new(i))).collect();
    for duplicate in duplicates {
        let Duplicate { point, vertex } = duplicate;
        let right = point < points.len()
            && mesh.contains(vertex)
            && vertex.index() < point
            && points[vertex.index()] == points[point]
            && !represented[point];
        if !right {
            return Err(Flaw2::Duplicate(duplicate));
        }
        represented[point] = true;
    }
    represented.iter().position(|there| !there).map_or(Ok(()), |index| Err(Flaw2::Missing(index)))
}

/// The vertices of a layer have the triangles that its kernel gives them.
pub(super) fn check_geometry<K: Kernel>(layer: &Layer<K>) -> Result<(), Flaw2> {
    match layer.mesh.dimension() {
        Dimension::Empty | Dimension::Point => Ok(()),
        Dimension::Line => check_line(layer),
        Dimension::Plane | Dimension::Space => {
            check_hull(&layer.points, &layer.mesh)?;
            check_triangles(layer)
        }
    }
}

/// All vertices, in lexicographic order and on one line, none hidden by its neighbors.
fn check_line<K: Kernel>(layer: &Layer<K>) -> Result<(), Flaw2> {
    let mesh = &layer.mesh;
    let chain: Vec<_> = mesh.border().collect();
    let p = |v: Place| layer.points[v.index()];
    for w in chain.windows(3) {
        let is_between = strictly_between(p(w[0]), p(w[2]), p(w[1]));
        let [a, b, c] = [w[0], w[1], w[2]].map(|v| layer.site(v));
        if !orient2d(a.0, b.0, c.0).is_zero() || !is_between || !K::contains_on_line(a, c, b) {
            return Err(Flaw2::Line(mesh.name(w[1])));
        }
    }
    if chain.len() == mesh.vertex_count() { Ok(()) } else { Err(Flaw2::Line(mesh.name(chain[0]))) }
}

/// Convex at every vertex, and once around: the hull has one lexicographic minimum.
pub(super) fn check_hull(points: &[[f64; 2]], mesh: &Mesh2) -> Result<(), Flaw2> {
    let hull: Vec<_> = mesh.border().collect();
    let n = hull.len();
    let mut minima = 0;
    for i in 0..n {
        let [a, b, c] = [0, 1, 2].map(|k| points[hull[(i + k) % n].index()]);
        let turn = orient2d(a, b, c);
        if turn.is_negative() || (turn.is_zero() && !strictly_between(a, c, b)) {
            return Err(Flaw2::Hull(mesh.name(hull[(i + 1) % n])));
        }
        minima += usize::from(lexicographic(b, a).is_lt() && lexicographic(b, c).is_lt());
    }
    if minima == 1 { Ok(()) } else { Err(Flaw2::Winding(minima)) }
}

fn check_triangles<K: Kernel>(layer: &Layer<K>) -> Result<(), Flaw2> {
    let mesh = &layer.mesh;
    for t in mesh.triangles() {
        let [a, b, c] = mesh.places(t).map(|v| layer.site(v));
        if !orient2d(a.0, b.0, c.0).is_positive() {
            return Err(Flaw2::Orientation(t));
        }
        for e in [0, 1, 2].map(|k| t.edge(k)) {
            let across = mesh.tip(mesh.twin(e));
            let may_be_inside = across.is_ghost() || mesh.is_fixed(e);
            if !may_be_inside && K::contains(a, b, c, layer.site(across)) {
                return Err(Flaw2::Delaunay(e));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
