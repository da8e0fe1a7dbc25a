//! Where does a point fall? The answer of [`Delaunay3::locate`].

use delone_predicates::orient3d;

use super::Delaunay3;
use super::layer::Layer;
use super::layer::kernel::Lift;
use super::locator::Locator;
use crate::error::Error;
use crate::ids::{FacetId, TetrahedronId, VertexId};
use crate::locate::{Locate, Strategy};
use crate::mesh::Dimension;
use crate::mesh::tetrahedra::FACETS;
use crate::points::{Position3, finite};
use crate::tally::Tally;

/// Where a point of space falls. A point is in exactly one of these places, so a match may name them all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Location3 {
    /// Strictly inside this tetrahedron.
    Tetrahedron(TetrahedronId),
    /// Strictly inside this facet, from the side where the opposite vertex is the smaller one, and on the hull from inside; of coplanar
    /// points, inside this triangle.
    Facet(FacetId),
    /// Strictly inside the edge between these vertices, the smaller one first.
    Edge([VertexId; 2]),
    /// On this vertex.
    Vertex(VertexId),
    /// Strictly outside of the convex hull: beyond this facet of it, seen from inside. It has the point of the hull that is nearest; of several
    /// facets that have it and that the point is beyond, this is the one with the smallest vertices.
    Outside(FacetId),
    /// Outside of the hull of points that do not span space.
    LowerDimensional(Dimension),
}

impl Delaunay3 {
    /// Finds where a point falls. Exact.
    ///
    /// The first call on a triangulation built in bulk makes the structure of the strategy, O(n log n) at most;
    /// the cost of the others is that of the strategy, see [`Locate`].
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    ///
    /// ```
    /// use delone::{Delaunay3, Location3};
    ///
    /// let d = Delaunay3::from_points(&[[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]])?;
    /// assert!(matches!(d.locate([1.0, 1.0, 1.0])?, Location3::Tetrahedron(_)));
    /// assert!(matches!(d.locate([1.0, 1.0, 0.0])?, Location3::Facet(_)));
    /// assert!(matches!(d.locate([1.0, 0.0, 0.0])?, Location3::Edge(_)));
    /// assert!(matches!(d.locate([2.0, 2.0, 2.0])?, Location3::Outside(_)));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("find_simplex", "point_location"))]
    pub fn locate<P: Position3>(&self, q: P) -> Result<Location3, Error> {
        self.locate_observed(q.xyz(), &mut ())
    }

    /// Finds where a point falls, and tells each step.
    pub(super) fn locate_observed<T: Tally>(&self, q: [f64; 3], tally: &mut T) -> Result<Location3, Error> {
        let q = finite(q)?;
        Ok(match self.walk_to(q, tally) {
            Some(t) => self.base.classify(t, q, tally),
            None => Location3::LowerDimensional(self.dimension()),
        })
    }

    /// The tetrahedron that a point falls into, by the strategy, or a ghost that it falls beyond; none off the span.
    pub(super) fn walk_to<T: Tally>(&self, q: [f64; 3], tally: &mut T) -> Option<TetrahedronId> {
        if !self.base.is_in_span(q) {
            return None;
        }
        let start = self.locator().start(&self.base, q, tally);
        Some(self.base.walk(self.base.start_cell(start), q, tally))
    }

    /// Finds where a point falls by a walk from a tetrahedron that is near it: O(1) expected from nearby.
    ///
    /// # Errors
    /// As [`Self::locate`].
    pub fn locate_from<P: Position3>(&self, start: TetrahedronId, q: P) -> Result<Location3, Error> {
        let q = finite(q.xyz())?;
        let known = self.dimension() == Dimension::Space && self.base.mesh.is_cell(start);
        if !known {
            return self.locate_observed(q, &mut ());
        }
        Ok(self.base.classify(self.base.walk(start, q, &mut ()), q, &mut ()))
    }

    /// The strategy of location.
    pub fn strategy(&self) -> Locate {
        self.locate
    }

    /// Chooses the strategy of location; the structure is made when it is needed.
    ///
    /// # Errors
    /// [`Error::Parameter`] names a parameter that is out of range; [`Error::OnlyInThePlane`] for [`Locate::History`],
    /// [`Locate::Stars`], other walks than the visibility walk, and [`Nearest::InCircle`](crate::Nearest::InCircle).
    pub fn set_strategy(&mut self, locate: Locate) -> Result<(), Error> {
        Locator::validate(locate)?;
        self.locate = locate;
        self.locator.take();
        Ok(())
    }
}

impl<W: Lift> Layer<W> {
    /// Where a point is that falls into a tetrahedron or beyond it: the same for one set of vertices, wherever a walk began.
    pub(super) fn classify<T: Tally>(&self, t: TetrahedronId, q: [f64; 3], tally: &mut T) -> Location3 {
        let (layer, mesh) = (self, &self.mesh);
        let dimension = self.dimension();
        if mesh.is_ghost(t) {
            return match dimension {
                Dimension::Space => {
                    Location3::Outside(mesh.twin(self.nearest_hull_facet(t, q, tally).facet(3)))
                }
                _ => Location3::LowerDimensional(dimension),
            };
        }
        if let Some(v) = layer.vertex_at(t, q) {
            return Location3::Vertex(mesh.name(v));
        }
        let corners = mesh.cells[t.index()].corners;
        let points = corners.map(|p| layer.points[p.index()]);
        let is_on = |k: &usize| {
            let [a, b, c] = FACETS[*k].map(|i| points[i]);
            orient3d(a, b, c, q).is_zero()
        };
        let on: Vec<usize> = (0..4).filter(is_on).collect();
        match on[..] {
            [] => Location3::Tetrahedron(t),
            [k] => {
                let sides = [t.facet(k), mesh.twin(t.facet(k))];
                // The ghost vertex is larger than all others.
                let opposite =
                    sides.map(|f| mesh.name(mesh.cells[f.tetrahedron().index()].corners[f.corner()]));
                let is_turned = dimension == Dimension::Space && opposite[1] < opposite[0];
                Location3::Facet(sides[usize::from(is_turned)])
            }
            _ => {
                let mut ends = (0..4).filter(|k| !on.contains(k)).map(|k| mesh.name(corners[k]));
                let mut ends = [(); 2].map(|()| ends.next().unwrap_or(VertexId::GHOST));
                ends.sort_unstable();
                Location3::Edge(ends)
            }
        }
    }
}
