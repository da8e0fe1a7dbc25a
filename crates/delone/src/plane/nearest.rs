//! Vertices by distance: nearest, k nearest, within a circle.
//!
//! All follow edges (`locate/nearest.rs`). Equal distances are ordered by the points, so answers are functions of the set.
//!
//! Cost: location, and O(1) expected for the nearest, O(k log k) for k of them, and the size of the answer for
//! circles (up to logarithmic factors, on evenly spread points). Where the nearest vertex, or one on the way to it, has
//! many neighbors all of them are looked at: O(d) for degree d. Where that hurts,
//! [`NearestSites2`](super::NearestSites2) answers in O(log^2 n) expected for any set.

use std::cmp::Ordering;

use delone_predicates::{compare_distances, compare_with_radius, lexicographic};

use super::Delaunay2;
use super::layer::Layer;
use super::layer::insert::Spot;
use super::locator::Locator;
use crate::error::Error;
use crate::ids::{Place, VertexId};
use crate::locate::nearest::{self, Near};
use crate::points::{Position2, finite};
use crate::tally::Tally;

/// By distance, then lexicographically.
pub(super) fn nearer(q: [f64; 2], a: [f64; 2], b: [f64; 2]) -> Ordering {
    compare_distances(q, a, b).then_with(|| lexicographic(a, b))
}

impl Near<[f64; 2]> for Layer {
    fn nearer(&self, q: [f64; 2], a: Place, b: Place) -> Ordering {
        nearer(q, self.points[a.index()], self.points[b.index()])
    }

    fn is_within(&self, q: [f64; 2], v: Place, radius: f64) -> bool {
        compare_with_radius(q, self.points[v.index()], radius).is_le()
    }

    #[inline]
    fn beside(&self, v: Place, each: impl FnMut(Place)) {
        self.mesh.spokes(v).map(|e| self.mesh.head(e)).filter(|w| !w.is_ghost()).for_each(each);
    }
}

impl Delaunay2 {
    /// The vertex nearest to a point; of several at the same distance the lexicographically smallest. `None` if
    /// there is no vertex.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]])?;
    /// assert_eq!(d.nearest([3.0, 1.0])?.map(|v| v.index()), Some(1));
    /// assert_eq!(d.nearest([2.0, 2.0])?.map(|v| v.index()), Some(0)); // all three are as near
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "nearest_vertex")]
    pub fn nearest<P: Position2>(&self, q: P) -> Result<Option<VertexId>, Error> {
        self.nearest_unobserved(q.xy())
    }

    /// Compiled once, whatever is taken for a point.
    fn nearest_unobserved(&self, q: [f64; 2]) -> Result<Option<VertexId>, Error> {
        Ok(self.nearest_place(finite(q)?, &mut ()).map(|v| self.base.mesh.name(v)))
    }

    /// The vertex nearest to another one; of several at the same distance the lexicographically smallest. `None` if
    /// there is no other, and for an id that is no vertex.
    ///
    /// ```
    /// use delone::{Delaunay2, VertexId};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [1, 0], [5, 0]])?;
    /// assert_eq!(d.nearest_neighbor(VertexId::new(2)), Some(VertexId::new(1)));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "nearest_neighbour")]
    pub fn nearest_neighbor(&self, v: VertexId) -> Option<VertexId> {
        let (layer, place) = (&self.base, self.base.mesh.place(v)?);
        let q = layer.points[place.index()];
        let mut best = None;
        layer.beside(place, |w| {
            if best.is_none_or(|best| Near::nearer(layer, q, w, best).is_lt()) {
                best = Some(w);
            }
        });
        best.map(|w| layer.mesh.name(w))
    }

    /// The k vertices nearest to a point, nearest first, ties as in [`Self::nearest`]; all of them if there are
    /// fewer.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [1, 0], [5, 0], [0, 3]])?;
    /// let near: Vec<_> = d.k_nearest([0.9, 0.0], 3)?.iter().map(|v| v.index()).collect();
    /// assert_eq!(near, [1, 0, 3]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("nearest_neighbours", "query"))]
    pub fn k_nearest<P: Position2>(&self, q: P, k: usize) -> Result<Vec<VertexId>, Error> {
        let q = finite(q.xy())?;
        let found = nearest::k_nearest(&self.base, self.nearest_place(q, &mut ()), q, k);
        Ok(found.into_iter().map(|v| self.base.mesh.name(v)).collect())
    }

    /// The vertices at most `radius` away from a point, by increasing id. None for a negative radius.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities, [`Error::Parameter`] for a radius that is not finite.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [1, 0], [5, 0], [0, 3]])?;
    /// assert_eq!(d.within([0, 0], 3.0)?.len(), 3); // the circle itself is within
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("query_ball_point", "vertices_in_circle"))]
    pub fn within<P: Position2>(&self, q: P, radius: f64) -> Result<Vec<VertexId>, Error> {
        let q = finite(q.xy())?;
        if !radius.is_finite() {
            return Err(Error::Parameter { name: "radius", value: radius, range: "finite" });
        }
        Ok(self.sorted_names(nearest::within(&self.base, self.nearest_place(q, &mut ()), q, radius)))
    }

    /// The place of the nearest vertex: down along edges from the triangle that contains the point.
    pub(super) fn nearest_place<T: Tally>(&self, q: [f64; 2], tally: &mut T) -> Option<Place> {
        let mesh = &self.base.mesh;
        let point = |v: Place| self.base.points[v.index()];
        let better = |a: Place, b: Place| if nearer(q, point(b), point(a)).is_lt() { b } else { a };
        let start = match self.spot(q, tally).spot {
            Spot::Empty => return None,
            Spot::Vertex(v) | Spot::End(v) => return Some(v),
            Spot::BesidePoint => return mesh.lone,
            Spot::Segment(e) => better(mesh.tail(e), mesh.head(e)),
            Spot::Triangle(t) if mesh.is_ghost(t) => {
                let e = self.hull_edge_beyond(t, q, tally);
                better(mesh.tail(e), mesh.head(e))
            }
            Spot::Triangle(t) | Spot::BesideLine(t) => {
                mesh.places(t).into_iter().filter(|v| !v.is_ghost()).reduce(better)?
            }
        };
        Some(match self.locator() {
            Locator::Tree(hints) => hints.nearest(&self.base, start, q, tally),
            _ => nearest::descend(&self.base, start, q, tally),
        })
    }

    pub(super) fn sorted_names(&self, places: impl IntoIterator<Item = Place>) -> Vec<VertexId> {
        // Sorted as the words that are sorted elsewhere, by the same code.
        let mut names: Vec<u64> = places.into_iter().map(|v| self.base.mesh.name(v).index() as u64).collect();
        names.sort_unstable();
        names.into_iter().map(|name| VertexId::new(name as usize)).collect()
    }
}
