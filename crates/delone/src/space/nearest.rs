//! Vertices by distance: nearest, k nearest, within a sphere.
//!
//! Why following edges is enough: as in the plane (`plane/nearest.rs`), because the edges contain those of the Delaunay
//! graph. Equal distances are ordered by the points, lexicographically.
//!
//! Cost: location, and O(1) expected for the nearest, O(k log k) for k of them, and the size of the answer for a
//! sphere (up to logarithmic factors, on evenly spread points).

use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap};

use delone_predicates::{compare_distances3, compare_with_radius3, lexicographic3};

use super::{Delaunay3, Position3, finite};
use crate::error::Error;
use crate::ids::{Place, VertexId};
use crate::locate::tally::Tally;
use crate::locate::{Ground, Strategy};

/// A vertex on the way to becoming one of the nearest. The greatest is the nearest, as a heap wants it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Candidate {
    place: Place,
    point: [f64; 3],
    q: [f64; 3],
}

/// By distance, then lexicographically.
fn nearer(q: [f64; 3], a: [f64; 3], b: [f64; 3]) -> Ordering {
    compare_distances3(q, a, b).then_with(|| lexicographic3(a, b))
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        nearer(self.q, other.point, self.point)
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
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
    pub fn nearest<P: Position3>(&self, q: P) -> Result<Option<VertexId>, Error> {
        self.nearest_counted(q, &mut ())
    }

    /// The same, and counts what it does.
    ///
    /// # Errors
    /// As [`Self::nearest`].
    pub fn nearest_counted<P: Position3, T: Tally>(
        &self,
        q: P,
        tally: &mut T,
    ) -> Result<Option<VertexId>, Error> {
        let q = finite(&q)?;
        Ok(self.nearest_place(q, tally).map(|v| self.base.mesh.name(v)))
    }

    /// The k vertices nearest to a point, nearest first, ties as in [`Self::nearest`]; all of them if there are
    /// fewer.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    pub fn k_nearest<P: Position3>(&self, q: P, k: usize) -> Result<Vec<VertexId>, Error> {
        let q = finite(&q)?;
        let candidate = |place: Place| Candidate { place, point: self.base.points[place.index()], q };
        let (mut star, mut joined) = (Vec::new(), Vec::new());
        let mut found = Vec::new();
        let mut waiting: BinaryHeap<Candidate> =
            self.nearest_place(q, &mut ()).into_iter().map(candidate).collect();
        let mut seen: BTreeSet<Place> = waiting.iter().map(|c| c.place).collect();
        while found.len() < k {
            let Some(Candidate { place, .. }) = waiting.pop() else { break };
            found.push(self.base.mesh.name(place));
            self.base.neighbors(place, &mut star, &mut joined);
            let fresh = joined.iter().copied().filter(|w| seen.insert(*w));
            waiting.extend(fresh.map(candidate));
        }
        Ok(found)
    }

    /// The vertices at most `radius` away from a point, by increasing id. None for a negative radius.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities, [`Error::Parameter`] for a radius that is not finite.
    pub fn within<P: Position3>(&self, q: P, radius: f64) -> Result<Vec<VertexId>, Error> {
        let q = finite(&q)?;
        if !radius.is_finite() {
            return Err(Error::Parameter { name: "radius", value: radius, range: "finite" });
        }
        let inside = |v: &Place| compare_with_radius3(q, self.base.points[v.index()], radius).is_le();
        let (mut star, mut joined) = (Vec::new(), Vec::new());
        let mut pending: Vec<Place> = self.nearest_place(q, &mut ()).into_iter().filter(inside).collect();
        let mut seen: BTreeSet<Place> = pending.iter().copied().collect();
        while let Some(v) = pending.pop() {
            self.base.neighbors(v, &mut star, &mut joined);
            pending.extend(joined.iter().copied().filter(|w| inside(w) && seen.insert(*w)));
        }
        let mut names: Vec<VertexId> = seen.into_iter().map(|p| self.base.mesh.name(p)).collect();
        names.sort_unstable();
        Ok(names)
    }

    fn nearest_place<T: Tally>(&self, q: [f64; 3], tally: &mut T) -> Option<Place> {
        let layer = &self.base;
        // Below space the walk may lead to the scaffold; the way along edges is short enough.
        let mut best = if layer.is_spanned() {
            layer.near(self.locator().start(layer, q, tally), q, false, tally)
        } else {
            layer.any_vertex()?
        };
        let point = |v: Place| layer.points[v.index()];
        let (mut star, mut joined) = (Vec::new(), Vec::new());
        loop {
            layer.neighbors(best, &mut star, &mut joined);
            joined.iter().for_each(|_| tally.compared());
            let next = joined.iter().copied().min_by(|&v, &w| nearer(q, point(v), point(w)));
            match next.filter(|&next| nearer(q, point(next), point(best)).is_lt()) {
                Some(next) => best = next,
                None => return Some(best),
            }
        }
    }
}
