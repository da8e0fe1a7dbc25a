//! Where does a point fall? The answer of [`Delaunay2::locate`].

use delone_predicates::orient2d;

use super::Delaunay2;
use super::layer::Layer;
use super::layer::insert::Spot;
use super::layer::kernel::Kernel;
use super::locator::Locator;
use crate::error::Error;
use crate::ids::{EdgeId, TriangleId, VertexId};
use crate::locate::{Locate, Start, Strategy, Walk};
use crate::mesh::Dimension;
use crate::points::{Position2, finite};
use crate::tally::Tally;

/// Where a point falls. A point of the plane is in exactly one of these places, so a match may name them all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Location2 {
    /// Strictly inside this triangle.
    Triangle(TriangleId),
    /// Strictly inside this edge: on the hull the one whose triangle is finite, elsewhere from the smaller vertex to the other one.
    Edge(EdgeId),
    /// On this vertex.
    Vertex(VertexId),
    /// Strictly outside of the convex hull: beyond this hull edge, whose triangle is finite. It has the point of the hull that is nearest;
    /// if two edges have it that the point is beyond, this is the first counter-clockwise.
    Outside(EdgeId),
    /// On no vertex and no edge of a triangulation that has no triangle.
    LowerDimensional(Dimension),
}

/// A point that was looked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub(super) spot: Spot,
    /// The length of the walk.
    pub(super) steps: usize,
    /// Where it started.
    pub(super) start: Start,
}

impl Delaunay2 {
    /// Finds where a point falls. Exact.
    ///
    /// The first call on a triangulation built in bulk makes the structure of the strategy, O(n log n) at most;
    /// the cost of the others is that of the strategy, see [`Locate`].
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    ///
    /// ```
    /// use delone::{Delaunay2, Location2};
    ///
    /// let d = Delaunay2::from_points(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]])?;
    /// assert!(matches!(d.locate([1.0, 1.0])?, Location2::Triangle(_)));
    /// assert!(matches!(d.locate([2.0, 2.0])?, Location2::Edge(_)));
    /// assert!(matches!(d.locate([3.0, 2.0])?, Location2::Outside(_)));
    /// assert!(matches!(d.locate([4.0, 0.0])?, Location2::Vertex(v) if v.index() == 1));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("find_simplex", "point_location"))]
    pub fn locate<P: Position2>(&self, q: P) -> Result<Location2, Error> {
        self.locate_observed(q.xy(), &mut ())
    }

    /// Finds where a point falls, and tells each step.
    pub(super) fn locate_observed<T: Tally>(&self, q: [f64; 2], tally: &mut T) -> Result<Location2, Error> {
        let q = finite(q)?;
        let spot = self.spot(q, tally).spot;
        Ok(self.classify(spot, q, tally))
    }

    /// Finds where a point falls by a walk from a triangle that is near it: O(1) expected from nearby.
    ///
    /// # Errors
    /// As [`Self::locate`].
    pub fn locate_from<P: Position2, T: Tally>(
        &self,
        start: TriangleId,
        walk: Walk,
        q: P,
        tally: &mut T,
    ) -> Result<Location2, Error> {
        let q = finite(q.xy())?;
        let known = self.base.mesh.is_triangle(start);
        let start = if known { Start::At(start.edge(0), walk) } else { Start::Anywhere };
        Ok(self.base.classify(self.base.spot(start, q, tally).0, q))
    }

    /// The strategy of location.
    pub fn strategy(&self) -> Locate {
        self.locate
    }

    /// Chooses the strategy of location; the structure is made when it is needed.
    ///
    /// # Errors
    /// [`Error::Parameter`] names a parameter that is out of range.
    ///
    /// ```
    /// use delone::{Delaunay2, Locate, Location2, Walk};
    ///
    /// let mut d = Delaunay2::from_points(&[[0, 0], [4, 0], [0, 4]])?;
    /// d.set_strategy(Locate::Walk(Walk::default()))?; // queries that follow each other in space
    /// assert!(matches!(d.locate([1, 1])?, Location2::Triangle(_)));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn set_strategy(&mut self, locate: Locate) -> Result<(), Error> {
        locate.validate()?;
        self.locate = locate;
        self.locator.take();
        Ok(())
    }

    /// The structure of the strategy, made at the first need.
    #[inline]
    pub(super) fn locator(&self) -> &Locator {
        self.locator.get_or_init(|| Locator::build(self.locate, &self.base))
    }

    /// Finds a point by the strategy.
    #[inline]
    pub(super) fn spot<T: Tally>(&self, q: [f64; 2], tally: &mut T) -> Found {
        let locator = self.locator();
        if let Locator::Tree(hints) = locator {
            let (spot, steps, start) = hints.spot(&self.base, q, tally);
            return Found { spot, steps, start };
        }
        let start = locator.start(&self.base, q, tally);
        let (spot, steps) = self.base.spot(start, q, tally);
        Found { spot, steps, start }
    }

    /// Where a point is that falls on a spot.
    pub(super) fn classify<T: Tally>(&self, spot: Spot, q: [f64; 2], tally: &mut T) -> Location2 {
        match spot {
            Spot::Triangle(t) if self.mesh().is_ghost(t) => {
                Location2::Outside(self.hull_edge_beyond(t, q, tally))
            }
            _ => self.base.classify(spot, q),
        }
    }

    /// The hull edge that is nearest to a point beyond that of a ghost. The way along the hull is not the only one.
    pub(super) fn hull_edge_beyond<T: Tally>(&self, ghost: TriangleId, q: [f64; 2], tally: &mut T) -> EdgeId {
        match self.locator() {
            Locator::Tree(hints) => hints.hull_edge(&self.base, ghost, q, tally),
            _ => self.base.hull_edge_nearest_to(q, ghost, tally),
        }
    }

    /// Finds a point that will be inserted, if it is no vertex yet, by the strategy.
    #[inline]
    pub(super) fn spot_to_insert<T: Tally>(&mut self, q: [f64; 2], tally: &mut T) -> Found {
        match self.locator.get_mut() {
            None | Some(Locator::Tree(_)) => self.spot(q, tally),
            Some(locator) => {
                let start = locator.start_to_insert(&self.base, q, tally);
                let (spot, steps) = self.base.spot(start, q, tally);
                Found { spot, steps, start }
            }
        }
    }
}

impl<K: Kernel> Layer<K> {
    /// Where a point is that falls on a spot: the same for one set of vertices, wherever a walk began.
    pub(super) fn classify(&self, spot: Spot, q: [f64; 2]) -> Location2 {
        let mesh = &self.mesh;
        let on_edge = |e: EdgeId| {
            let twin = mesh.twin(e);
            let is_turned = match [e, twin].map(|e| mesh.is_ghost(e.triangle())) {
                [is_outside, is_inside] if is_outside != is_inside => is_outside,
                _ => mesh.origin(e) > mesh.destination(e),
            };
            Location2::Edge(if is_turned { twin } else { e })
        };
        match spot {
            Spot::Vertex(v) => Location2::Vertex(mesh.name(v)),
            Spot::Segment(e) => on_edge(e),
            Spot::Triangle(triangle) => {
                if mesh.is_ghost(triangle) {
                    return Location2::Outside(self.nearest_hull_edge(triangle, q, usize::MAX).0);
                }
                let through = |e: &EdgeId| {
                    let [a, b] = [mesh.tail(*e), mesh.head(*e)].map(|v| self.points[v.index()]);
                    orient2d(a, b, q).is_zero()
                };
                let edges = [0, 1, 2].map(|k| triangle.edge(k));
                let on = edges.into_iter().find(through);
                on.map_or(Location2::Triangle(triangle), on_edge)
            }
            Spot::Empty | Spot::BesidePoint | Spot::End(_) | Spot::BesideLine(_) => {
                Location2::LowerDimensional(mesh.dimension())
            }
        }
    }
}
