//! Vertices by distance: nearest, k nearest, within a sphere.
//!
//! All follow edges (`locate/nearest.rs`). Equal distances are ordered by the points, lexicographically.
//!
//! Cost: location, and O(1) expected for the nearest, O(k log k) for k of them, and the size of the answer for a
//! sphere (up to logarithmic factors, on evenly spread points).

use std::cmp::Ordering;

use delone_predicates::{compare_distances3, compare_with_radius3, lexicographic3};

use super::Delaunay3;
use super::layer::Layer;
use super::layer::kernel::Lift;
use crate::error::Error;
use crate::ids::{Place, VertexId};
use crate::locate::nearest::{self, Near};
use crate::locate::{Ground, Nearest, Strategy};
use crate::points::{Position3, finite};
use crate::tally::Tally;

impl<W: Lift> Near<[f64; 3]> for Layer<W> {
    fn nearer(&self, q: [f64; 3], a: Place, b: Place) -> Ordering {
        let (a, b) = (self.points[a.index()], self.points[b.index()]);
        compare_distances3(q, a, b).then_with(|| lexicographic3(a, b))
    }

    fn is_within(&self, q: [f64; 3], v: Place, radius: f64) -> bool {
        compare_with_radius3(q, self.points[v.index()], radius).is_le()
    }

    fn beside(&self, v: Place, each: impl FnMut(Place)) {
        let (mut star, mut joined) = (Vec::new(), Vec::new());
        self.neighbors(v, &mut star, &mut joined);
        joined.into_iter().for_each(each);
    }
}

impl Delaunay3 {
    /// The vertex nearest to a point; of several at the same distance the lexicographically smallest. `None` if
    /// there is no vertex.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    ///
    /// ```
    /// use delone::Delaunay3;
    ///
    /// let d = Delaunay3::from_points(&[[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]])?;
    /// assert_eq!(d.nearest([3.0, 1.0, 0.0])?.map(|v| v.index()), Some(1));
    /// assert_eq!(d.k_nearest([0.0; 3], 2)?.len(), 2);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "nearest_vertex")]
    pub fn nearest<P: Position3>(&self, q: P) -> Result<Option<VertexId>, Error> {
        Ok(self.nearest_place(finite(q.xyz())?, &mut ()).map(|v| self.base.mesh.name(v)))
    }

    /// The vertex nearest to another one; of several at the same distance the lexicographically smallest. `None` if
    /// there is no other, and for an id that is no vertex.
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
    /// use delone::Delaunay3;
    ///
    /// let cube: Vec<[i32; 3]> = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).collect();
    /// let d = Delaunay3::from_points(&cube)?;
    /// assert_eq!(d.k_nearest([0.9, 0.1, 0.2], 2)?.iter().map(|v| v.index()).collect::<Vec<_>>(), [1, 5]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("nearest_neighbours", "query"))]
    pub fn k_nearest<P: Position3>(&self, q: P, k: usize) -> Result<Vec<VertexId>, Error> {
        let q = finite(q.xyz())?;
        let found = nearest::k_nearest(&self.base, self.nearest_place(q, &mut ()), q, k);
        Ok(found.into_iter().map(|v| self.base.mesh.name(v)).collect())
    }

    /// The vertices at most `radius` away from a point, by increasing id. None for a negative radius.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities, [`Error::Parameter`] for a radius that is not finite.
    ///
    /// ```
    /// use delone::Delaunay3;
    ///
    /// let cube: Vec<[i32; 3]> = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).collect();
    /// let d = Delaunay3::from_points(&cube)?;
    /// assert_eq!(d.within([0, 0, 0], 1.0)?.len(), 4); // the corner and those beside it
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "query_ball_point")]
    pub fn within<P: Position3>(&self, q: P, radius: f64) -> Result<Vec<VertexId>, Error> {
        let q = finite(q.xyz())?;
        if !radius.is_finite() {
            return Err(Error::Parameter { name: "radius", value: radius, range: "finite" });
        }
        let found = nearest::within(&self.base, self.nearest_place(q, &mut ()), q, radius);
        let mut names: Vec<VertexId> = found.into_iter().map(|p| self.base.mesh.name(p)).collect();
        names.sort_unstable();
        Ok(names)
    }

    pub(super) fn nearest_place<T: Tally>(&self, q: [f64; 3], tally: &mut T) -> Option<Place> {
        let layer = &self.base;
        let any = layer.any_vertex()?;
        let start = self.locator().start(layer, q, tally);
        let start = if layer.is_spanned() {
            layer.near(start, q, Nearest::Corner, tally).0
        } else {
            // Below space the walk may lead to the scaffold: from the hint the way along edges is short enough.
            let hint = layer.mesh.cells.get(layer.start_cell(start).index());
            let mut corners = hint.into_iter().flat_map(|cell| cell.corners);
            corners.find(|&p| !p.is_ghost() && !layer.is_scaffold(p)).unwrap_or(any)
        };
        Some(nearest::descend(layer, start, q, tally))
    }
}
