//! A triangulation of the plane that can change: topology, coordinates by place, and the buffers of its
//! operations. It knows no names and chooses no strategy: `Delaunay2` is one with names, a level of the
//! hierarchy is one without.
//!
//! Cost: [`Layer::lay_out`] a sort and O(n); the operations are in `insert` and `remove`.

pub(in crate::plane) mod cavity;
mod hull;
pub(in crate::plane) mod insert;
pub(in crate::plane) mod kernel;
mod line;
pub(in crate::plane) mod remove;
mod search;
pub(in crate::plane) mod walk;

use std::cmp::Ordering;
use std::marker::PhantomData;
use std::sync::OnceLock;

use delone_predicates::{Sign, angle, compare_distances, orient2d};

use crate::ids::{EdgeId, Place};
use crate::locate::{Ground, Level, Nearest, Start};
use crate::memory::{make_room, room_for};
use crate::mesh::triangles::{Room, with_spare};
use crate::mesh::{Dimension, Mesh2, Slots};
use crate::order::morton::{self, Sorted};
use crate::points::survey;
use crate::prefetch::prefetch;
use crate::tally::Tally;
use crate::weight::Weight;
use cavity::Cavity;
use kernel::{Kernel, NearestSites, Site};
use line::Line;
use remove::Hole;

/// See the module.
#[derive(Clone, Debug)]
pub(in crate::plane) struct Layer<K: Kernel = NearestSites> {
    pub(in crate::plane) mesh: Mesh2,
    /// For each place its coordinates.
    pub(in crate::plane) points: Vec<[f64; 2]>,
    /// For each place its weight, if the kernel knows weights.
    pub(in crate::plane) weights: Vec<K::Weight>,
    /// Free places.
    pub(in crate::plane) free: Slots,
    pub(in crate::plane) cavity: Cavity,
    pub(in crate::plane) hole: Hole<K>,
    /// Whether the vertices span the plane; kept because most operations ask.
    pub(in crate::plane) spanned: bool,
    /// The vertices in order, where all are on one line and somebody has searched it.
    line: OnceLock<Line>,
    /// The test for conflicts.
    kernel: PhantomData<K>,
}

impl<K: Kernel> Default for Layer<K> {
    fn default() -> Self {
        Self::new(Mesh2::empty(0), Vec::new())
    }
}

impl<K: Kernel> Layer<K> {
    /// A mesh built in bulk, its vertices at the places of their indices.
    pub(in crate::plane) fn new(mesh: Mesh2, points: Vec<[f64; 2]>) -> Self {
        let weights = vec![K::Weight::default(); points.len()];
        Self::with_weights(mesh, points, weights)
    }

    /// A layer of points with weights.
    pub(in crate::plane) fn with_weights(
        mesh: Mesh2,
        points: Vec<[f64; 2]>,
        weights: Vec<K::Weight>,
    ) -> Self {
        let spanned = mesh.dimension() == Dimension::Plane;
        Self {
            mesh,
            points,
            weights,
            free: Slots::default(),
            cavity: Cavity::default(),
            hole: Hole::default(),
            spanned,
            line: OnceLock::new(),
            kernel: PhantomData,
        }
    }

    /// Starts anew with other points, none a vertex yet, in the memory that there is.
    pub(in crate::plane) fn restart(&mut self, points: impl Iterator<Item = [f64; 2]>) {
        self.points.clear();
        self.points.extend(points);
        self.weights.resize(self.points.len(), K::Weight::default());
        self.mesh.restart(self.points.len());
        self.free = Slots::default();
        self.spanned = false;
        self.line.take();
    }

    /// Memory in bytes, buffers not counted.
    pub(in crate::plane) fn bytes(&self) -> usize {
        self.mesh.bytes() + size_of_val(&*self.points)
    }

    /// The site at a place.
    #[inline]
    pub(in crate::plane) fn site(&self, p: Place) -> Site<K> {
        (self.points[p.index()], K::Weight::at(&self.weights, p))
    }

    /// A place near another one in memory for a new point, without a weight.
    pub(in crate::plane) fn new_place(&mut self, near: usize, q: [f64; 2]) -> Place {
        if let Some(slot) = self.free.take_near(near) {
            self.points[slot] = q;
            return Place::new(slot);
        }
        make_room(&mut self.points, 1);
        self.points.push(q);
        self.weights.push(K::Weight::default());
        make_room(&mut self.mesh.incident, 1);
        self.mesh.incident.push(EdgeId::NONE);
        Place::new(self.points.len() - 1)
    }

    /// Gives a place back. Its point stays to be read until the place is used again.
    pub(in crate::plane) fn free_place(&mut self, v: Place) {
        self.mesh.incident[v.index()] = EdgeId::NONE;
        self.free.give(v.index());
    }

    /// Asks memory for what is kept around a place, where the layout is that of `lay_out`: this many cache lines
    /// of triangles and of points on either side.
    #[inline]
    pub(in crate::plane) fn prefetch_window<const TRIANGLES: usize, const POINTS: usize>(
        &self,
        place: usize,
    ) {
        let first = (8 * place).wrapping_sub(8 * TRIANGLES);
        for k in 0..=2 * TRIANGLES {
            prefetch(&self.mesh.edges, first.wrapping_add(8 * k));
        }
        let first = place.wrapping_sub(4 * POINTS);
        for k in 0..=2 * POINTS {
            prefetch(&self.points, first.wrapping_add(4 * k));
        }
        for k in 0..3 {
            prefetch(&self.mesh.incident, place.wrapping_sub(16).wrapping_add(16 * k));
        }
    }

    /// Lays points and triangles out in Morton order, with room between neighbors. Returns for each old place
    /// the new one.
    pub(in crate::plane) fn lay_out(&mut self, room: Room) -> Vec<Place> {
        let order = self.sort(room);
        let (moved, free) = self.mesh.lay_out(&order, room);
        self.free = free;
        self.line.take();
        moved
    }

    /// Puts the points in the order of the new layout. Returns the old place of each.
    fn sort(&mut self, room: Room) -> Vec<Place> {
        let places: Vec<Place> = self.mesh.inhabited().collect();
        let points: Vec<[f64; 2]> = places.iter().map(|p| self.points[p.index()]).collect();
        // Copied: what comes may use the memory.
        self.points = Vec::new();
        let Sorted { points, indices, .. } = morton::sort(&points, &survey(&points).0);
        self.points = room_for(with_spare(room.place(points.len())));
        self.points.extend(room.spread(points.iter().copied()));
        let weights = indices.iter().map(|&i| K::Weight::at(&self.weights, places[i as usize]));
        self.weights = room.spread(weights).collect();
        indices.iter().map(|&i| places[i as usize]).collect()
    }
}

impl<K: Kernel> Ground for Layer<K> {
    type Point = [f64; 2];
    type Hint = EdgeId;
    const DIMENSIONS: usize = 2;
    const NOWHERE: EdgeId = EdgeId::NONE;

    #[inline]
    fn is_spanned(&self) -> bool {
        self.spanned
    }

    fn leads(&self) -> bool {
        self.mesh.vertex_count > 1
    }

    fn vertex_count(&self) -> usize {
        self.mesh.vertex_count
    }

    fn place_count(&self) -> usize {
        self.mesh.incident.len()
    }

    fn inhabited(&self) -> impl Iterator<Item = Place> {
        self.mesh.inhabited()
    }

    #[inline]
    fn hint(&self, v: Place) -> EdgeId {
        self.mesh.incident[v.index()]
    }

    #[inline]
    fn is_alive(&self, hint: EdgeId) -> bool {
        self.mesh.is_triangle(hint.triangle())
    }

    fn any_vertex(&self) -> Option<Place> {
        let first = self.mesh.ghost_edge;
        (first != EdgeId::NONE).then(|| self.mesh.head(first))
    }

    fn neighbor(&self, v: Place) -> Option<Place> {
        self.mesh.spokes(v).map(|e| self.mesh.head(e)).find(|w| !w.is_ghost())
    }

    #[inline]
    fn point(&self, v: Place) -> [f64; 2] {
        self.points[v.index()]
    }

    #[inline]
    fn coordinate(q: [f64; 2], axis: usize) -> f64 {
        q[axis]
    }

    #[inline]
    fn prefetch_around(&self, e: EdgeId) {
        let slot = e.triangle().index();
        self.prefetch_window::<6, 3>(slot / 2);
        self.free.prefetch(slot / 2);
        self.mesh.free.prefetch(slot);
    }

    #[inline]
    fn compare_distances(&self, q: [f64; 2], a: Place, b: Place) -> Ordering {
        compare_distances(q, self.points[a.index()], self.points[b.index()])
    }

    fn near<T: Tally>(&self, start: Start, q: [f64; 2], nearest: Nearest, tally: &mut T) -> (Place, EdgeId) {
        search::near(self, start, q, nearest, tally)
    }
}

/// Questions of walks.
impl<K: Kernel> Layer<K> {
    /// Asks memory for the triangle of an edge, and for its corners where they are likely to be.
    #[inline]
    fn prefetch_triangle(&self, e: EdgeId) {
        prefetch(&self.mesh.edges, e.index());
        prefetch(&self.points, e.triangle().index() / 2);
    }

    /// Whether `q` is strictly on the right of a finite edge: beyond it, seen from the edge's triangle.
    #[inline]
    fn is_beyond(&self, e: EdgeId, q: [f64; 2]) -> bool {
        let [a, b] = [self.mesh.tail(e), self.mesh.head(e)].map(|v| self.points[v.index()]);
        orient2d(a, b, q).is_negative()
    }

    /// On which side of the line from `from` to `to` a vertex is: `Greater` on the left.
    #[inline]
    fn side(&self, from: [f64; 2], to: [f64; 2], v: Place) -> Ordering {
        match orient2d(from, to, self.points[v.index()]) {
            Sign::Negative => Ordering::Less,
            Sign::Zero => Ordering::Equal,
            Sign::Positive => Ordering::Greater,
        }
    }

    /// Whether the angle at `w` between `q` and `x` is acute.
    fn is_acute(&self, w: Place, q: [f64; 2], x: Place) -> bool {
        angle(self.points[w.index()], q, self.points[x.index()]).is_positive()
    }
}

impl<K: Kernel> Level for Layer<K> {
    fn add<T: Tally>(&mut self, q: [f64; 2], start: Start, tally: &mut T) -> Option<Place> {
        let (spot, _) = self.spot(start, q, tally);
        match self.insert(spot, q, tally) {
            Ok(place) | Err(place) => Some(place),
        }
    }

    fn take<T: Tally>(&mut self, v: Place, tally: &mut T) -> Option<()> {
        self.remove(v, tally);
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::Kind;

    use super::*;
    use crate::{Delaunay2, Work};

    /// And not by looking at all; beyond the hull too.
    #[test]
    fn the_nearest_vertex_is_near_exactly() {
        for kind in [Kind::Uniform, Kind::Clusters, Kind::Grid, Kind::Circle, Kind::Ellipse2] {
            let points = kind.points(400, 1);
            let d = Delaunay2::from_points(&points).expect("finite");
            let mut queries = kind.points(400, 2);
            let around = queries.clone().into_iter().map(|q| q.map(|x| 3.0 * x - points[0][0]));
            queries.extend(around);
            queries.extend(&points[..50]);
            let mut visited = [Nearest::Corner, Nearest::Exact, Nearest::InCircle].map(|nearest| {
                let mut work = Work::default();
                for &q in &queries {
                    let found = d.base.point(d.base.near(Start::Anywhere, q, nearest, &mut work).0);
                    let is_nearest = points.iter().all(|&p| compare_distances(q, found, p).is_le());
                    assert!(is_nearest || nearest == Nearest::Corner, "{} {q:?} {nearest:?}", kind.name());
                }
                work.visited
            });
            let walk = visited[0];
            visited.iter_mut().for_each(|visited| *visited -= walk);
            // Circles of many ghosts contain what is far beyond the hull.
            assert!(visited[1] < 5 * queries.len() as u64, "{}: {visited:?} triangles", kind.name());
        }
    }
}
