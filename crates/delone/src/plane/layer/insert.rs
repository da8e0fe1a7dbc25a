//! Insertion of a point, whatever the dimension so far.
//!
//! Cost: the walk, and the cavity (see `cavity`); on a line O(log n) expected (see `line`).

use delone_predicates::orient2d;

use super::Layer;
use super::kernel::{Kernel, Sites};
use super::walk::{walk, walk_within};
use crate::ids::{EdgeId, Place, TriangleId};
use crate::locate::Start;
use crate::mesh::Dimension;
use crate::tally::Tally;

/// Where a point falls, as insertion sees it.
#[derive(Clone, Copy, Debug)]
pub(in crate::plane) enum Spot {
    /// There is no vertex.
    Empty,
    /// On this vertex.
    Vertex(Place),
    /// Beside the only vertex.
    BesidePoint,
    /// Inside the segment of this edge; all vertices are on its line.
    Segment(EdgeId),
    /// On the line of all vertices, beyond this end.
    End(Place),
    /// Off the line of all vertices, on the side of this triangle.
    BesideLine(TriangleId),
    /// In this finite triangle or on its border; or strictly beyond the hull edge of this ghost.
    Triangle(TriangleId),
}

impl<K: Kernel> Layer<K> {
    /// Finds where a point falls, and how many steps the walk took. Exact.
    #[inline]
    pub(in crate::plane) fn spot<T: Tally>(&self, start: Start, q: [f64; 2], tally: &mut T) -> (Spot, usize) {
        if !self.spanned {
            return self.spot_below_plane(q, tally);
        }
        let goal = walk(self, start, q, tally);
        (self.spot_in(goal.triangle, q), goal.steps)
    }

    /// Locates by a visibility walk from a hint or from anywhere, unless that takes more steps than `most`.
    #[inline]
    pub(in crate::plane) fn spot_within<T: Tally>(
        &self,
        start: Start,
        q: [f64; 2],
        most: usize,
        tally: &mut T,
    ) -> Option<(Spot, usize)> {
        if !self.spanned {
            return Some(self.spot_below_plane(q, tally));
        }
        let from = if let Start::Hint(e, _) = start { e } else { self.mesh.ghost_edge };
        let goal = walk_within(self, from, q, most, tally);
        (goal.steps <= most).then(|| (self.spot_in(goal.triangle, q), goal.steps))
    }

    /// The vertex, if a point located in a triangle or beyond it is one of its corners.
    #[inline]
    fn spot_in(&self, triangle: TriangleId, q: [f64; 2]) -> Spot {
        let equal = |v: &Place| !v.is_ghost() && self.points[v.index()] == q;
        match self.mesh.places(triangle).into_iter().find(equal) {
            Some(v) => Spot::Vertex(v),
            None => Spot::Triangle(triangle),
        }
    }

    fn spot_below_plane<T: Tally>(&self, q: [f64; 2], tally: &mut T) -> (Spot, usize) {
        let mesh = &self.mesh;
        match mesh.lone {
            Some(v) if self.points[v.index()] == q => return (Spot::Vertex(v), 1),
            Some(_) => return (Spot::BesidePoint, 1),
            None if mesh.dimension() == Dimension::Empty => return (Spot::Empty, 1),
            None => {}
        }
        let e = mesh.ghost_edge.next(); // along the line, the ghost on its left
        let [a, b] = [mesh.tail(e), mesh.head(e)].map(|w| self.points[w.index()]);
        tally.orientation();
        let side = orient2d(a, b, q);
        if !side.is_zero() {
            return (Spot::BesideLine(if side.is_positive() { e } else { mesh.twin(e) }.triangle()), 1);
        }
        self.spot_on_line(q, tally)
    }

    /// Makes a point a vertex where it falls. If there is one already, that is the error.
    #[inline]
    pub(in crate::plane) fn insert<T: Tally>(
        &mut self,
        spot: Spot,
        q: [f64; 2],
        tally: &mut T,
    ) -> Result<Place, Place> {
        if let Spot::Vertex(v) = spot {
            return Err(v);
        }
        let v = self.place_for(spot, q);
        self.insert_at(v, spot, tally);
        Ok(v)
    }

    /// A place for a point that falls where `spot` says, near its neighbors in memory.
    #[inline]
    pub(in crate::plane) fn place_for(&mut self, spot: Spot, q: [f64; 2]) -> Place {
        let near = match spot {
            Spot::Triangle(triangle) => self.mesh.tail(triangle.edge(0)),
            _ => Place::new(0),
        };
        self.new_place(if near.is_ghost() { 0 } else { near.index() }, q)
    }

    /// Makes the point at a place a vertex. It falls where `spot` says, which is no vertex.
    #[inline]
    pub(in crate::plane) fn insert_at<T: Tally>(&mut self, v: Place, spot: Spot, tally: &mut T) {
        match spot {
            Spot::Vertex(_) => debug_assert!(false, "there is a vertex already"),
            Spot::Empty => {
                self.mesh.lone = Some(v);
                self.mesh.vertex_count = 1;
            }
            Spot::BesidePoint => {
                self.mesh.begin_line(v);
                self.line.take();
            }
            Spot::Segment(e) => {
                self.mesh.split_segment(e, v);
                self.join_line(v);
            }
            Spot::End(end) => {
                self.mesh.extend_line(end, v);
                self.join_line(v);
            }
            // The ghosts on one side of the line are in conflict; joining the point to them makes the plane.
            Spot::BesideLine(triangle) | Spot::Triangle(triangle) => {
                let sites = Sites { points: &self.points, weights: &self.weights };
                self.cavity.insert::<K, T>(&mut self.mesh, sites, v, triangle, tally);
                self.spanned = true;
                self.line.take();
            }
        }
    }
}
