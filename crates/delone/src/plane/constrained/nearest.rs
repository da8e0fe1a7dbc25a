//! Vertices by distance, whether they are seen or not.
//!
//! Where edges are fixed the nearest vertex need not be at the end of a descent. But what is nearer to a point than some vertex
//! is in a disk, the triangles that meet the disk are connected, and edges that keep away from the disk need not be passed.
//! Around vertices in the disk all triangles are looked at, so nothing depends on how they are connected there.
//!
//! Cost: location, and O(log t) for each of the t triangles that meet the disk: some ten for the nearest on evenly spread
//! points, O(n) where thin triangles reach far.

use std::collections::{BTreeSet, VecDeque};

use delone_predicates::{SearchLimit, compare_with_radius, segment_keeps_away};

use super::Constrained2;
use crate::error::Error;
use crate::ids::{EdgeId, Place, TriangleId, VertexId};
use crate::plane::layer::insert::Spot;
use crate::plane::nearest::nearer;
use crate::points::{Position2, finite};
use crate::tally::Tally;

/// A search: its results so far, and its limit.
struct Search<'a> {
    points: &'a [[f64; 2]],
    q: [f64; 2],
    /// The number of vertices wanted, or the radius within which all are.
    wanted: Result<usize, f64>,
    /// Nearest first; all within the radius in no special order.
    found: Vec<Place>,
}

impl Search<'_> {
    /// Takes a vertex if it is wanted.
    fn meet(&mut self, v: Place) -> bool {
        let point = |v: Place| self.points[v.index()];
        match self.wanted {
            Ok(count) => {
                let at = self.found.partition_point(|&w| nearer(self.q, point(w), point(v)).is_lt());
                if at == count {
                    return false;
                }
                self.found.insert(at, v);
                self.found.truncate(count);
                true
            }
            Err(radius) => {
                let is_within = compare_with_radius(self.q, point(v), radius).is_le();
                self.found.extend(Some(v).filter(|_| is_within));
                is_within
            }
        }
    }

    /// Whether nothing that is wanted is seen across an edge only.
    fn keeps_away(&self, edge: [Place; 2]) -> bool {
        let point = |v: Place| self.points[v.index()];
        let reach = match (self.wanted, self.found.last()) {
            (Ok(count), Some(&last)) if self.found.len() == count => SearchLimit::To(point(last)),
            (Ok(_), _) => return false,
            (Err(radius), _) => SearchLimit::Radius(radius),
        };
        segment_keeps_away(self.q, edge.map(point), reach)
    }
}

impl Constrained2 {
    /// The vertex nearest to a point, seen or not; of several at the same distance the lexicographically smallest. `None` if
    /// there is no vertex.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    ///
    /// ```
    /// use delone::Constrained2;
    ///
    /// let c = Constrained2::from_parts(&[[0, 0], [4, 0], [0, 4]], &[[1, 2]])?;
    /// assert_eq!(c.nearest([3, 1])?.map(|v| v.index()), Some(1)); // segments hide nothing
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "nearest_vertex")]
    pub fn nearest<P: Position2>(&self, q: P) -> Result<Option<VertexId>, Error> {
        Ok(self.k_nearest(q, 1)?.first().copied())
    }

    /// The k vertices nearest to a point, nearest first, ties as in [`Self::nearest`]; all of them if there are fewer.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    pub fn k_nearest<P: Position2>(&self, q: P, k: usize) -> Result<Vec<VertexId>, Error> {
        let q = finite(q.xy())?;
        let found = self.search(q, Ok(k.min(self.vertex_count())), &mut ());
        Ok(found.into_iter().map(|v| self.mesh().name(v)).collect())
    }

    /// The vertices at most `radius` away from a point, by increasing id. None for a negative radius.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities, [`Error::Parameter`] for a radius that is not finite.
    pub fn within<P: Position2>(&self, q: P, radius: f64) -> Result<Vec<VertexId>, Error> {
        let q = finite(q.xy())?;
        if !radius.is_finite() {
            return Err(Error::Parameter { name: "radius", value: radius, range: "finite" });
        }
        Ok(self.graph.sorted_names(self.search(q, Err(radius), &mut ())))
    }

    /// The vertices that are wanted, in a triangulation of any dimension.
    pub(super) fn search<T: Tally>(
        &self,
        q: [f64; 2],
        wanted: Result<usize, f64>,
        tally: &mut T,
    ) -> Vec<Place> {
        let layer = &self.graph.base;
        let mesh = &layer.mesh;
        let mut search = Search { points: &layer.points, q, wanted, found: Vec::new() };
        if wanted == Ok(0) {
            return Vec::new();
        }
        if !layer.spanned {
            for v in mesh.inhabited() {
                tally.compared();
                search.meet(v);
            }
            return search.found;
        }
        let start = match (self.graph.spot(q, tally).spot, wanted) {
            // A radius may end before the hull edge that the point is beyond, and not before another one.
            (Spot::Triangle(t), Err(radius)) if mesh.is_ghost(t) => {
                let nearest = self.search(q, Ok(1), tally)[0];
                if compare_with_radius(q, layer.points[nearest.index()], radius).is_gt() {
                    return Vec::new();
                }
                mesh.incident[nearest.index()].triangle()
            }
            (Spot::Triangle(t), _) => t,
            (Spot::Vertex(v), _) => mesh.incident[v.index()].triangle(),
            _ => return Vec::new(),
        };
        let mut seen = BTreeSet::from([start]);
        let mut met = BTreeSet::new();
        let mut pending: VecDeque<TriangleId> = VecDeque::from([start]);
        while let Some(t) = pending.pop_front() {
            let mut look = |e: EdgeId| {
                if seen.insert(e.triangle()) {
                    pending.push_back(e.triangle());
                }
            };
            let corners = mesh.places(t);
            for v in corners.into_iter().filter(|v| !v.is_ghost()) {
                if met.insert(v) {
                    tally.compared();
                    if search.meet(v) {
                        mesh.spokes(v).for_each(&mut look);
                    }
                }
            }
            for e in [0, 1, 2].map(|k| t.edge(k)) {
                let ends = [mesh.tail(e), mesh.head(e)];
                if !ends.iter().any(|v| v.is_ghost()) && !search.keeps_away(ends) {
                    look(mesh.twin(e));
                }
            }
        }
        search.found
    }
}
