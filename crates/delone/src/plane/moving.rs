//! Points that move: from the triangulation of one step to that of the next.
//!
//! The neighbors of most points stay the same while they move little, so the triangulation is kept and repaired:
//!
//! 1. where the motion would turn a triangle over, one of its edges is flipped if that helps; otherwise one of its
//!    vertices is removed, at its old position;
//! 2. all others take their new positions, and edges are flipped until each is Delaunay (Lawson, "Software for C1
//!    surface interpolation", 1977), those of the hull by the same rule with the ghost vertex;
//! 3. the removed ones are inserted at their new positions, from where they were.
//!
//! Where too many would have to be removed, or the hull has folded over itself, the triangulation is built anew. Every
//! way leads to the canonical triangulation of the positions.
//!
//! Cost: O(n) tests, on all threads, and the flips, if few points move past others; that of a construction otherwise.

use std::ops::Range;

use delone_predicates::{Filter, orient2d};

use super::layer::Layer;
use super::layer::insert::Spot;
use super::{Delaunay2, check};
use crate::error::Error;
use crate::ids::{EdgeId, MAX_POINTS, Place, TriangleId, VertexId};
use crate::locate::{Start, Walk};
use crate::mesh::Mesh2;
use crate::parallel;
use crate::points::{Position2, check_count, check_finite, survey};
use crate::prefetch::prefetch;
use crate::tally::Tally;

/// One vertex in so many may be removed before building anew is faster.
const REMOVED: usize = 12;
/// Flips a vertex, above which the hull must have folded over itself and all is built anew.
const FLIPS: usize = 20;
/// Vertices or triangles between the one in work and the one that is prefetched.
const PREFETCH_DISTANCE: usize = 24;

/// Triangles that are tested together.
const BLOCK: usize = 16;

/// How a step was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Step2 {
    /// By repair.
    Repaired {
        /// Edges flipped.
        flips: usize,
        /// Vertices removed and inserted again.
        reinserted: usize,
    },
    /// By a construction from nothing.
    Rebuilt,
}

/// An edge to be flipped.
#[derive(Clone, Copy, Debug)]
struct Plan {
    edge: EdgeId,
    /// The triangle across it.
    other: TriangleId,
    /// The corners of the two triangles, as long as it is good.
    corners: [Place; 4],
}

/// The triangulation of points that move.
///
/// ```
/// use delone::Moving2;
///
/// let mut moving = Moving2::from_points(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [4.0, 5.0]])?;
/// moving.step(&[[0.1, 0.0], [4.0, 0.1], [0.0, 3.9], [4.1, 5.0]])?;
/// assert_eq!(moving.triangulation().triangles().count(), 2);
/// assert!(moving.triangulation().check().is_ok());
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Moving2 {
    current: Delaunay2,
    /// Memory for the next positions.
    spare: Vec<[f64; 2]>,
    /// For each place where its vertex goes.
    goals: Vec<[f64; 2]>,
    /// Triangles that may turn over.
    doubtful: Vec<TriangleId>,
    /// Edges whose flip helps a triangle that would turn over.
    plans: Vec<Plan>,
    /// For each triangle one more than the last plan that it is part of.
    planned: Vec<u32>,
    /// Vertices that were removed, each with a neighbor that it had then.
    removed: Vec<(VertexId, VertexId)>,
    /// Edges that may not be Delaunay.
    pending: Vec<EdgeId>,
}

impl Moving2 {
    /// Triangulates the first positions.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate; [`Error::TooManyPoints`].
    pub fn from_points<P: Position2>(positions: &[P]) -> Result<Self, Error> {
        check_count(positions.len(), MAX_POINTS)?;
        let positions: Vec<[f64; 2]> = positions.iter().map(Position2::xy).collect();
        check_finite(positions.iter().copied())?;
        let mut moving = Self::default();
        moving.current.rebuild(positions);
        Ok(moving)
    }

    /// The triangulation of the last positions. Vertex i is the i-th of them.
    pub fn triangulation(&self) -> &Delaunay2 {
        &self.current
    }

    /// Moves all points: point i to the i-th position.
    ///
    /// # Errors
    /// [`Error::Length`] if there are more or fewer positions than points; [`Error::NotFinite`] names the first NaN or
    /// infinite coordinate. Nothing has changed then.
    pub fn step<P: Position2>(&mut self, positions: &[P]) -> Result<Step2, Error> {
        self.step_observed(positions, &mut ())
    }

    /// Does what [`Self::step`] does, and tells: as visited the triangles that are looked at beyond one pass over all, and as created and
    /// destroyed those of the vertices that are removed and inserted again.
    ///
    /// # Errors
    /// As [`Self::step`].
    pub fn step_observed<P: Position2, T: Tally>(
        &mut self,
        positions: &[P],
        tally: &mut T,
    ) -> Result<Step2, Error> {
        let expected = self.current.points().len();
        if positions.len() != expected {
            return Err(Error::Length { expected, found: positions.len() });
        }
        let mut given = std::mem::take(&mut self.spare);
        given.clear();
        given.extend(positions.iter().map(Position2::xy));
        if let Err(error) = all_finite(&given) {
            self.spare = given;
            return Err(error);
        }
        if let Some(step) = self.repair(&given, tally) {
            self.spare = self.current.named.replace(given).unwrap_or_default();
            self.current.locator.take();
            return Ok(step);
        }
        self.current.rebuild(given);
        Ok(Step2::Rebuilt)
    }

    /// Repairs the triangulation, or says that it cannot.
    fn repair<T: Tally>(&mut self, positions: &[[f64; 2]], tally: &mut T) -> Option<Step2> {
        self.removed.clear();
        if !self.current.base.spanned || !self.current.duplicates.is_empty() {
            return None;
        }
        let filter = self.set_goals(positions);
        self.untangle(&filter, tally)?;

        let layer = &mut self.current.base;
        std::mem::swap(&mut layer.points, &mut self.goals);
        let flips = flip_all(layer, &filter, &mut self.pending)?;
        check::check_hull(&layer.points, &layer.mesh).ok()?;
        // The last one first: its neighbor is there.
        for &(v, near) in self.removed.iter().rev() {
            let q = positions[v.index()];
            let near = layer.mesh.place(near);
            let start =
                near.map_or(Start::Anywhere, |p| Start::At(layer.mesh.incident[p.index()], Walk::Visibility));
            match layer.spot(start, q, tally).0 {
                // Two points in one place: a duplicate has no place of its own.
                Spot::Vertex(_) => return None,
                spot => {
                    let place = layer.insert(spot, q, tally).ok()?;
                    layer.mesh.names().bind(v, place);
                }
            }
        }
        Some(Step2::Repaired { flips, reinserted: self.removed.len() })
    }

    /// Puts positions in the order of places; returns the filter for their box.
    fn set_goals(&mut self, positions: &[[f64; 2]]) -> Filter {
        let layer = &self.current.base;
        let name = |place: usize| layer.mesh.name(Place::new(place));
        self.goals.resize(layer.points.len(), [0.0; 2]);
        let ends = parallel::even_ends(self.goals.len(), parallel::parts(self.goals.len()));
        let starts = std::iter::once(0).chain(ends.iter().copied());
        let tasks = starts.zip(parallel::split_at(&mut self.goals, &ends)).collect();
        parallel::map(tasks, |(start, goals): (usize, &mut [[f64; 2]])| {
            for (place, goal) in (start..).zip(goals) {
                if place + PREFETCH_DISTANCE < layer.points.len() {
                    prefetch(positions, name(place + PREFETCH_DISTANCE).index());
                }
                // A free place goes nowhere.
                *goal = positions.get(name(place).index()).copied().unwrap_or(positions[0]);
            }
        });
        let extent = survey(&self.goals).0.extent();
        Filter::for_box(extent[0], extent[1], None)
    }

    /// Removes vertices until no triangle turns over on the way to the goals. None if they are too many.
    fn untangle<T: Tally>(&mut self, filter: &Filter, tally: &mut T) -> Option<()> {
        let Self { current: Delaunay2 { base: layer, .. }, goals, doubtful, plans, planned, removed, .. } =
            self;
        let most = layer.mesh.vertex_count / REMOVED + 8;
        let turns_over = |mesh: &Mesh2, t: TriangleId| {
            let [a, b, c] = mesh.places(t);
            let finite = !a.is_ghost() && !b.is_ghost() && !c.is_ghost();
            finite && !filter.orient2d(goals[a.index()], goals[b.index()], goals[c.index()]).is_positive()
        };
        for plan in plans.drain(..) {
            plan.triangles().into_iter().for_each(|t| planned[t.index()] = 0);
        }
        planned.resize(layer.mesh.slot_count(), 0);
        doubtful.clear();
        let mesh = &layer.mesh;
        let parts = parallel::map(parallel::ranges(mesh.slot_count()), |slots| {
            slots.map(TriangleId::new).filter(|&t| turns_over(mesh, t)).collect::<Vec<_>>()
        });
        doubtful.extend(parts.into_iter().flatten());
        if doubtful.len() > 2 * most {
            return None;
        }
        while let Some(t) = doubtful.pop() {
            if !layer.mesh.is_triangle(t) || !turns_over(&layer.mesh, t) {
                continue;
            }
            // A triangle is part of one good plan at most.
            let is_planned = |t: TriangleId| {
                let plan = planned.get(t.index()).and_then(|&k| plans.get((k as usize).wrapping_sub(1)));
                plan.is_some_and(|plan| plan.is_good(&layer.mesh))
            };
            if is_planned(t) {
                continue;
            }
            let plan = Plan::find(&layer.mesh, goals, filter, t);
            if let Some(plan) = plan.filter(|plan| !is_planned(plan.other)) {
                plans.push(plan);
                // Removal makes no triangles beyond those that there are.
                plan.triangles().into_iter().for_each(|t| planned[t.index()] = plans.len() as u32);
                continue;
            }
            // Of the corners the one that goes furthest.
            let way = |p: Place| {
                let (from, to) = (layer.points[p.index()], goals[p.index()]);
                (to[0] - from[0]).powi(2) + (to[1] - from[1]).powi(2)
            };
            let v = layer.mesh.places(t).into_iter().reduce(|p, q| if way(q) > way(p) { q } else { p })?;
            // The nearest neighbor: a hub that all others are joined to is a bad start.
            let near = nearest_neighbor(layer, v)?;
            let name = layer.mesh.name(v);
            removed.push((name, layer.mesh.name(near)));
            layer.mesh.names().release(name);
            layer.remove(v, tally);
            if removed.len() > most || !layer.spanned {
                return None;
            }
            // Those that are new, and those that have lost the other triangle of their plan.
            let (filling, border) = layer.hole.last();
            let beside = border.iter().map(|(_, outside)| outside.triangle());
            (0..filling.len() + border.len()).for_each(|_| tally.visited());
            doubtful.extend(filling.iter().copied().chain(beside).filter(|&t| turns_over(&layer.mesh, t)));
        }
        for plan in &*plans {
            if plan.is_good(&layer.mesh) {
                layer.mesh.flip(plan.edge);
            }
        }
        // Every triangle that turned over has been destroyed, or there is a plan for it; this proves that plans did not
        // spoil each other.
        let good = |&t: &TriangleId| !layer.mesh.is_triangle(t) || !turns_over(&layer.mesh, t);
        plans.iter().flat_map(|plan| plan.triangles()).all(|t| good(&t)).then_some(())
    }
}

/// On all threads, unless there is something to name.
fn all_finite(positions: &[[f64; 2]]) -> Result<(), Error> {
    if survey(positions).1 { Ok(()) } else { check_finite(positions.iter().copied()) }
}

/// The neighbor of a vertex that is nearest to it, as far as rounding tells.
fn nearest_neighbor(layer: &Layer, v: Place) -> Option<Place> {
    let from = layer.points[v.index()];
    let distance = |w: Place| {
        let to = layer.points[w.index()];
        (to[0] - from[0]).powi(2) + (to[1] - from[1]).powi(2)
    };
    let around = layer.mesh.spokes(v).map(|e| layer.mesh.head(e)).filter(|w| !w.is_ghost());
    around.min_by(|&w, &x| distance(w).total_cmp(&distance(x)))
}

impl Plan {
    /// An edge of a triangle after whose flip both triangles are counter-clockwise.
    fn find(mesh: &Mesh2, goals: &[[f64; 2]], filter: &Filter, t: TriangleId) -> Option<Self> {
        let turns_left = |p: Place, q: Place, r: Place| {
            filter.orient2d(goals[p.index()], goals[q.index()], goals[r.index()]).is_positive()
        };
        [t.edge(0), t.edge(1), t.edge(2)].into_iter().find_map(|edge| {
            let corners @ [a, b, c, d] = corners_around(mesh, edge);
            let helps = !d.is_ghost() && turns_left(d, c, a) && turns_left(c, d, b);
            helps.then(|| Self { edge, other: mesh.twin(edge).triangle(), corners })
        })
    }

    fn triangles(&self) -> [TriangleId; 2] {
        [self.edge.triangle(), self.other]
    }

    /// Whether its triangles are those that it was made for.
    fn is_good(&self, mesh: &Mesh2) -> bool {
        mesh.is_triangle(self.edge.triangle()) && corners_around(mesh, self.edge) == self.corners
    }
}

/// The ends of an edge, and the apexes on its left and on its right.
#[inline]
fn corners_around(mesh: &Mesh2, e: EdgeId) -> [Place; 4] {
    [mesh.tail(e), mesh.head(e), mesh.tip(e), mesh.tip(mesh.twin(e))]
}

/// Flips edges until all are Delaunay, and counts. None if there is no end to it.
///
/// All edges are tested first, on all threads; which ones are to be flipped then does not depend on how many these are.
fn flip_all(layer: &mut Layer, filter: &Filter, pending: &mut Vec<EdgeId>) -> Option<usize> {
    let Layer { mesh, points, .. } = layer;
    let most = FLIPS * mesh.vertex_count;
    let found = parallel::map(parallel::ranges(mesh.slot_count()), |slots| {
        let mut found = Vec::new();
        edges_to_flip(mesh, points, filter, slots, &mut found);
        found
    });
    let mut flips = 0;
    pending.clear();
    for e in found.into_iter().flatten() {
        pending.push(e);
        while let Some(e) = pending.pop() {
            if is_to_flip(mesh, points, filter, e) {
                let f = mesh.twin(e);
                mesh.flip(e);
                flips += 1;
                if flips > most {
                    return None;
                }
                pending.extend([e.next(), e.previous(), f.next(), f.previous()]);
            }
        }
    }
    Some(flips)
}

/// Notes the edges of some triangles that are to be flipped.
///
/// Triangles are looked at block by block: which of their edges is to be tested is decided without branches, which would
/// go the wrong way half of the time.
fn edges_to_flip(
    mesh: &Mesh2,
    points: &[[f64; 2]],
    filter: &Filter,
    slots: Range<usize>,
    found: &mut Vec<EdgeId>,
) {
    let mut edges = [EdgeId::NONE; 3 * BLOCK];
    for first in slots.clone().step_by(BLOCK) {
        let mut count = 0;
        for t in first..slots.end.min(first + BLOCK) {
            ask_ahead(mesh, points, t);
            let t = TriangleId::new(t);
            for e in [t.edge(0), t.edge(1), t.edge(2)] {
                edges[count] = e;
                let twin = mesh.twin(e);
                count += usize::from(e < twin && twin != EdgeId::NONE);
            }
        }
        found.extend(edges[..count].iter().filter(|&&e| is_to_flip(mesh, points, filter, e)));
    }
}

/// Asks for what lies elsewhere, across a cut of the order, and will be looked at some triangles later.
#[inline]
fn ask_ahead(mesh: &Mesh2, points: &[[f64; 2]], t: usize) {
    for record in mesh.edges.get(4 * (t + 2 * PREFETCH_DISTANCE)..).into_iter().flatten().take(3) {
        prefetch(&mesh.edges, record.twin.index());
    }
    for record in mesh.edges.get(4 * (t + PREFETCH_DISTANCE)..).into_iter().flatten().take(3) {
        if let Some(beyond) = mesh.edges.get(record.twin.previous().index()) {
            prefetch(points, beyond.origin.index());
        }
    }
}

/// Whether the triangle of an edge is in conflict with the apex on the other side.
#[inline]
fn is_to_flip(mesh: &Mesh2, points: &[[f64; 2]], filter: &Filter, e: EdgeId) -> bool {
    let [a, b, c, d] = corners_around(mesh, e);
    if a.is_ghost() || b.is_ghost() || c.is_ghost() || d.is_ghost() {
        return is_hull_to_flip([a, b, c, d], points);
    }
    let at = |p: Place| points[p.index()];
    filter.in_circle(at(a), at(b), at(c), at(d)).is_positive()
}

/// Decides at the hull.
#[cold]
fn is_hull_to_flip([a, b, c, d]: [Place; 4], points: &[[f64; 2]]) -> bool {
    let turns_left = |p: Place, q: Place, r: Place| {
        orient2d(points[p.index()], points[q.index()], points[r.index()]).is_positive()
    };
    // A hull edge has nothing beyond it; one to the ghost leaves a dent if what is next to it is beyond the hull.
    (a.is_ghost() && turns_left(b, c, d)) || (b.is_ghost() && turns_left(c, a, d))
}
