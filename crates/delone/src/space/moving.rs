//! Points that move in space: from the triangulation of one step to that of the next.
//!
//! Connectivity is kept. Tetrahedra that turned over, and pairs of neighbors of which one has the other's apex in its
//! sphere, are taken out in connected holes. A hole is refilled with the triangulation of its own vertices
//! (`hole.rs`); where that does not fit the border, or is in conflict with what is outside of it, the hole grows. A
//! vertex that has left its hole is inserted again from where it was.
//!
//! When all tetrahedra are in positive order, no facet is in conflict, and the hull is convex and goes around once, what
//! came out is proved. Where too much would have to go, or anything does not hold, all points are located from hints
//! (Devillers, "Delaunay triangulation of imprecise points", JoCG 2011, §5: Brownian motion). Every way leads to the
//! canonical triangulation of the positions.
//!
//! Cost: O(n) tests, and O(d log d) for each hole of d tetrahedra as often as it is filled, an eighth of all tetrahedra at most; that of
//! an instance with hints otherwise. After a repair that gave up, hints make the next steps, so that points which move far cost an
//! instance with hints and a few hundredths.

use super::check::check_winding;
use super::layer::Layer;
use super::layer::hole::{Border, Hole};
use super::{Delaunay3, Hints3};
use crate::error::Error;
use crate::ids::{FacetId, Place, TetrahedronId};
use crate::mesh::Dimension;
use crate::order::HintOrder;
use crate::points::{Position3, check_in_space};
use crate::prefetch::prefetch;

/// One tetrahedron in so many may be bad: with a twelfth, repair takes as long as a construction (2,000 points, 100,000 points; one in
/// seven: 1.5 times as long; one in twenty: hints take over where repair is 1.5 times as fast).
const BAD: usize = 12;
/// One tetrahedron in so many may go.
const GONE: usize = 3;
/// One tetrahedron in so many may be filled, counted each time that its hole is: holes that grow into each other are filled again and
/// again (one in four: a step that gives up took 2.1 constructions of 100,000 points; one in sixteen: small steps give up).
const FILLED: usize = 8;
/// Tetrahedra that may be replaced in addition, for sets of a few points.
const SMALL_SET: usize = 16;
/// Steps by hints after a repair that gave up, at most: one after the first, then twice as many and one more each time.
const PAUSE: u32 = 31;
/// Tetrahedra between the one that is tested and the one that is prefetched.
const PREFETCH_DISTANCE: usize = 12;
/// Marks while holes are made: to go, and in the hole at hand.
const TO_GO: u8 = 1;
const GOING: u8 = 2;

/// How a step was made in space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Step3 {
    /// By repair.
    Repaired {
        /// Holes made and refilled.
        holes: usize,
        /// Vertices inserted again.
        reinserted: usize,
    },
    /// All points were located from their hints, which are new now; also in the steps after a repair that gave up, 31 at most.
    Hinted,
    /// By a construction from nothing: hints misled.
    Rebuilt,
}

/// The triangulation of points that move in space.
///
/// ```
/// use delone::Moving3;
///
/// let mut moving = Moving3::from_points(&[[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]])?;
/// moving.step(&[[0.1, 0.0, 0.0], [4.0, 0.1, 0.0], [0.0, 3.9, 0.0], [0.1, 0.0, 4.0]])?;
/// assert_eq!(moving.triangulation().tetrahedra().count(), 1);
/// assert!(moving.triangulation().check().is_ok());
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Moving3 {
    /// With the triangulation of the last positions.
    hints: Hints3,
    /// Tetrahedra that have to go.
    bad: Vec<TetrahedronId>,
    /// Vertices that left their hole, each with a tetrahedron near where it was.
    lost: Vec<(Place, TetrahedronId)>,
    /// Steps until repair is tried again, and how many these were after the last repair that gave up.
    pause: u32,
    last_pause: u32,
}

impl Moving3 {
    /// Triangulates the first positions, and finds hints.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate; [`Error::TooManyPoints`].
    pub fn from_points<P: Position3>(positions: &[P]) -> Result<Self, Error> {
        let mut hints = Hints3::from_points(positions, HintOrder::default())?;
        hints.triangulate(positions)?;
        Ok(Self { hints, bad: Vec::new(), lost: Vec::new(), pause: 0, last_pause: 0 })
    }

    /// The triangulation of the last positions. Vertex i is the i-th of them.
    pub fn triangulation(&self) -> &Delaunay3 {
        self.hints.current()
    }

    /// Moves all points: point i to the i-th position.
    ///
    /// # Errors
    /// [`Error::Length`] if there are more or fewer positions than points; [`Error::NotFinite`] names the first NaN or
    /// infinite coordinate. Nothing has changed then. [`Error::TooManyTetrahedra`] leaves no triangulation, until the next
    /// step.
    pub fn step<P: Position3>(&mut self, positions: &[P]) -> Result<Step3, Error> {
        let expected = self.hints.order().len();
        if positions.len() != expected {
            return Err(Error::Length { expected, found: positions.len() });
        }
        check_in_space(positions)?;
        if self.pause == 0 {
            if let Some(step) = self.repair(positions) {
                self.last_pause = 0;
                return Ok(step);
            }
            self.last_pause = (2 * self.last_pause + 1).min(PAUSE);
            self.pause = self.last_pause;
        } else {
            self.pause -= 1;
        }
        self.hints.follow(positions)?;
        Ok(if self.hints.gave_up() { Step3::Rebuilt } else { Step3::Hinted })
    }

    /// Repairs the triangulation, or says that it cannot.
    fn repair<P: Position3>(&mut self, positions: &[P]) -> Option<Step3> {
        let Delaunay3 { base: layer, duplicates, locator, .. } = &mut self.hints.current;
        if layer.dimension() != Dimension::Space || !duplicates.is_empty() {
            return None;
        }
        let names = std::mem::take(&mut layer.mesh.names);
        layer.set_points((0..positions.len()).map(|k| positions[names.of(Place::new(k)).index()].xyz()));
        layer.mesh.names = names;
        locator.take();
        find_bad(layer, &mut self.bad)?;
        let mut hole = std::mem::take(&mut layer.hole);
        let mut fill = layer.fill.take().unwrap_or_default();
        self.lost.clear();
        let mut mend = Mend {
            room: layer.mesh.cells.len() / GONE + SMALL_SET,
            work: layer.mesh.cells.len() / FILLED + SMALL_SET,
            layer: &mut *layer,
            hole: &mut hole,
            fill: &mut fill,
            lost: &mut self.lost,
        };
        let holes = mend.all(&self.bad);
        (layer.hole, layer.fill) = (hole, Some(fill));
        let holes = holes?;
        if !self.bad.is_empty() {
            check_winding(layer).ok()?;
        }
        for &(v, from) in &self.lost {
            let q = layer.points[v.index()];
            let from = if layer.mesh.is_cell(from) { from } else { layer.any_cell() };
            let t = layer.walk(from, q, &mut ());
            // Two points in one place: a duplicate is no vertex.
            if layer.vertex_at(t, q).is_some() {
                return None;
            }
            layer.insert(v, t, &mut ())?;
        }
        Some(Step3::Repaired { holes, reinserted: self.lost.len() })
    }
}

/// Collects and marks the tetrahedra that are not in positive order, or in conflict with the apex of a neighbor. None if
/// they are too many.
fn find_bad(layer: &mut Layer, bad: &mut Vec<TetrahedronId>) -> Option<()> {
    let most = layer.mesh.cells.len() / BAD + SMALL_SET;
    bad.clear();
    let mut mark = |layer: &mut Layer, t: TetrahedronId| {
        let mark = &mut layer.mesh.marks[t.index()];
        if *mark == 0 {
            *mark = TO_GO;
            bad.push(t);
        }
        bad.len()
    };
    for t in (0..layer.mesh.cells.len()).map(TetrahedronId::new) {
        let cell = layer.mesh.cells[t.index()];
        ask_ahead(layer, t);
        if !layer.mesh.is_cell(t) {
            continue;
        }
        let ghost = layer.mesh.is_ghost(t);
        if !ghost && !layer.is_positive(t) {
            if mark(layer, t) > most {
                return None;
            }
            continue;
        }
        for across in cell.across {
            let u = across.tetrahedron();
            // Each pair once; what is between a finite one and a ghost is on the hull.
            if u < t || layer.mesh.is_ghost(u) != ghost {
                continue;
            }
            let apex = layer.mesh.cells[u.index()].corners[across.corner()];
            if layer.conflicts(t, layer.site(apex)) {
                mark(layer, t);
                if mark(layer, u) > most {
                    return None;
                }
            }
        }
    }
    Some(())
}

/// Asks for what will be looked at some tetrahedra later.
#[inline]
fn ask_ahead(layer: &Layer, t: TetrahedronId) {
    let cells = &layer.mesh.cells;
    for across in cells.get(t.index() + 2 * PREFETCH_DISTANCE).into_iter().flat_map(|cell| cell.across) {
        prefetch(cells, across.tetrahedron().index());
    }
    for across in cells.get(t.index() + PREFETCH_DISTANCE).into_iter().flat_map(|cell| cell.across) {
        if let Some(beyond) = cells.get(across.tetrahedron().index()) {
            prefetch(&layer.points, beyond.corners[across.corner()].index());
        }
    }
}

/// The state of mending.
struct Mend<'a> {
    layer: &'a mut Layer,
    hole: &'a mut Hole,
    fill: &'a mut Layer,
    lost: &'a mut Vec<(Place, TetrahedronId)>,
    /// Tetrahedra that may still go.
    room: usize,
    /// Tetrahedra that may still be filled, each counted as often as its hole is filled anew.
    work: usize,
}

impl Mend<'_> {
    /// Makes and refills holes until nothing that is bad is left, and counts them. None if too much would go.
    fn all(&mut self, bad: &[TetrahedronId]) -> Option<usize> {
        let mut holes = 0;
        for &t in bad {
            // It may have gone with others.
            if self.layer.mesh.marks[t.index()] == TO_GO {
                self.one(t)?;
                holes += 1;
            }
        }
        Some(holes)
    }

    /// Takes out what is bad around a tetrahedron, and more until the filling fits.
    fn one(&mut self, seed: TetrahedronId) -> Option<()> {
        self.hole.cells.clear();
        self.take(seed)?;
        self.pay()?;
        while let Some(more) = self.fill() {
            if more.is_empty() {
                return None;
            }
            for t in more {
                self.take(t)?;
            }
            self.pay()?;
        }
        self.close()
    }

    /// Counts the filling of the hole at hand. None if there have been too many.
    fn pay(&mut self) -> Option<()> {
        self.work = self.work.checked_sub(self.hole.cells.len())?;
        Some(())
    }

    /// Takes a tetrahedron and all bad ones that hang together with it into the hole. None if there is no more room. What
    /// is beyond the hull goes with what is inside.
    fn take(&mut self, seed: TetrahedronId) -> Option<()> {
        let mesh = &mut self.layer.mesh;
        let mut k = self.hole.cells.len();
        if mesh.marks[seed.index()] != GOING {
            mesh.marks[seed.index()] = GOING;
            self.hole.cells.push(seed);
        }
        while let Some(&t) = self.hole.cells.get(k) {
            k += 1;
            self.room = self.room.checked_sub(1)?;
            let cell = mesh.cells[t.index()];
            for next in cell.across.map(FacetId::tetrahedron) {
                let at_hull = cell.corners[3].is_ghost() != mesh.is_ghost(next);
                let mark = mesh.marks[next.index()];
                if mark == TO_GO || (at_hull && mark != GOING) {
                    mesh.marks[next.index()] = GOING;
                    self.hole.cells.push(next);
                }
            }
        }
        Some(())
    }

    /// Fills the hole apart. Returns the tetrahedra outside that have to go too, none of them if there is no way; `None` if
    /// the filling fits.
    fn fill(&mut self) -> Option<Vec<TetrahedronId>> {
        let Self { layer, hole, fill, .. } = self;
        let mesh = &layer.mesh;
        hole.set_vertices(layer, None, None);
        if hole.has_equal_points(layer) {
            return Some(Vec::new());
        }
        hole.triangulate(layer, fill);
        let facets = hole.cells.iter().flat_map(|t| [0, 1, 2, 3].map(|k| t.facet(k)));
        let at_border = |f: &FacetId| mesh.marks[mesh.twin(*f).tetrahedron().index()] != GOING;
        let facets: Vec<FacetId> = facets.filter(at_border).collect();
        hole.set_border(layer, &facets);
        let outside = |border: &Border| border.outside.tetrahedron();
        if fill.dimension() < Dimension::Space {
            return Some(hole.border.iter().map(outside).collect());
        }
        if !hole.find_inside(fill) {
            let unmet = hole.border.iter().filter(|border| border.inside == FacetId::NONE);
            return Some(unmet.map(outside).collect());
        }
        let has_ghosts = hole.cells.iter().any(|&t| mesh.is_ghost(t));
        if has_ghosts != hole.inside.iter().any(|&(t, _)| fill.mesh.is_ghost(t)) {
            return Some(hole.border.iter().map(outside).collect());
        }
        let conflicts = |border: &&Border| {
            let (t, k) = (border.inside.tetrahedron(), border.inside.corner());
            let apex = fill.mesh.cells[t.index()].corners[k];
            !apex.is_ghost() && layer.conflicts(outside(border), fill.site(apex))
        };
        let more: Vec<TetrahedronId> = hole.border.iter().filter(conflicts).map(outside).collect();
        (!more.is_empty()).then_some(more)
    }

    /// Puts the filling in its place. None if there is no room.
    fn close(&mut self) -> Option<()> {
        let Self { layer, hole, fill, .. } = self;
        for t in &hole.cells {
            layer.mesh.marks[t.index()] = 0;
        }
        hole.copy(layer, fill)?;
        let mut used = vec![false; hole.vertices.len()];
        for (t, _) in &hole.inside {
            let corners = fill.mesh.cells[t.index()].corners;
            corners.into_iter().filter(|p| !p.is_ghost()).for_each(|p| used[p.index()] = true);
        }
        let near = hole.inside.first().map_or(TetrahedronId::NONE, |pair| pair.1);
        for (&v, _) in hole.vertices.iter().zip(used).filter(|(_, used)| !used) {
            layer.mesh.incident[v.index()] = TetrahedronId::NONE;
            layer.mesh.vertex_count -= 1;
            self.lost.push((v, near));
        }
        Some(())
    }
}
