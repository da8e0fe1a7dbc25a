//! A triangulation of space that can change: topology, coordinates by place, static filter, and the buffers of its
//! operations. It knows no strategy of location.

use delone_predicates::{Filter3, Grid};

use super::arena::{Arena, Memory, View};
use super::cavity::Cavity;
use super::hole::Hole;
use crate::ids::{Place, TetrahedronId};
use crate::locate::tally::Tally;
use crate::mesh::tetrahedra::Mesh3;

/// See the module.
#[derive(Clone, Debug, Default)]
pub(super) struct Layer {
    pub(super) mesh: Mesh3,
    /// For each place its coordinates.
    pub(super) points: Vec<[f64; 3]>,
    /// Places without a point.
    free: Vec<Place>,
    /// The box around all points, and a lattice that they are on.
    limits: Limits,
    grid: Option<Grid>,
    pub(super) filter: Filter3,
    /// The places of scaffold points.
    pub(super) scaffold: Vec<Place>,
    pub(super) cavity: Cavity,
    pub(super) hole: Hole,
    /// What holes are filled with.
    pub(super) fill: Option<Box<Layer>>,
}

/// Why a point does not become a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) enum Refusal {
    /// It equals this one.
    Vertex(Place),
    /// There would be too many tetrahedra.
    Full,
}

/// The box around points, axis by axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    pub(super) low: [f64; 3],
    pub(super) high: [f64; 3],
}

impl Default for Limits {
    fn default() -> Self {
        Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] }
    }
}

impl Limits {
    pub(super) fn around(points: impl IntoIterator<Item = [f64; 3]>) -> Self {
        let mut limits = Self::default();
        points.into_iter().for_each(|p| _ = limits.include(p));
        limits
    }

    fn include(&mut self, p: [f64; 3]) -> bool {
        let grown = !self.contains(p);
        self.low = [0, 1, 2].map(|k| self.low[k].min(p[k]));
        self.high = [0, 1, 2].map(|k| self.high[k].max(p[k]));
        grown
    }

    fn contains(&self, p: [f64; 3]) -> bool {
        (0..3).all(|k| self.low[k] <= p[k] && p[k] <= self.high[k])
    }

    pub(super) fn extent(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| (self.high[k] - self.low[k]).max(0.0))
    }
}

impl Layer {
    /// Points at their places, none a vertex yet.
    pub(super) fn new(points: Vec<[f64; 3]>) -> Self {
        let limits = Limits::around(points.iter().copied());
        let grid = Grid::of(points.as_flattened());
        let mesh = Mesh3 { incident: vec![TetrahedronId::NONE; points.len()], ..Mesh3::default() };
        let filter = Filter3::for_box(limits.extent(), grid);
        Self { mesh, points, limits, grid, filter, ..Self::default() }
    }

    /// Starts anew with other points, as [`Self::new`], in the memory that there is. They have no names.
    pub(super) fn restart(&mut self, points: impl Iterator<Item = [f64; 3]>) {
        self.set_points(points);
        self.free.clear();
        self.mesh.incident.clear();
        self.mesh.incident.resize(self.points.len(), TetrahedronId::NONE);
        self.mesh.names.clear();
        self.clear_mesh();
    }

    /// Gives all places other points, and looks at nothing else.
    pub(super) fn set_points(&mut self, points: impl Iterator<Item = [f64; 3]>) {
        self.points.clear();
        self.points.extend(points);
        self.limits = Limits::around(self.points.iter().copied());
        self.grid = Grid::of(self.points.as_flattened());
        self.filter = Filter3::for_box(self.limits.extent(), self.grid);
    }

    /// Multiplies all coordinates with a power of two. None may lose bits by that.
    pub(super) fn scale(&mut self, power: f64) {
        self.points.as_flattened_mut().iter_mut().for_each(|x| *x *= power);
        self.limits = Limits::around(self.points.iter().copied());
        self.grid = Grid::of(self.points.as_flattened());
        self.filter = Filter3::for_box(self.limits.extent(), self.grid);
    }

    pub(super) fn clear_mesh(&mut self) {
        self.scaffold.clear();
        self.mesh.cells.clear();
        self.mesh.marks.clear();
        self.mesh.free.clear();
        self.mesh.vertex_count = 0;
    }

    /// Keeps a point at a place. It is no vertex yet.
    pub(super) fn keep(&mut self, q: [f64; 3]) -> Place {
        let fits = self.grid.is_none_or(|grid| q.iter().all(|&x| grid.holds(x)));
        if !fits || self.points.is_empty() {
            self.grid = Grid::of(&q).filter(|_| self.points.is_empty());
        }
        if self.limits.include(q) || !fits {
            self.filter = Filter3::for_box(self.limits.extent(), self.grid);
        }
        if let Some(place) = self.free.pop() {
            self.points[place.index()] = q;
            return place;
        }
        self.points.push(q);
        self.mesh.incident.push(TetrahedronId::NONE);
        self.mesh.names.add_place();
        Place::new(self.points.len() - 1)
    }

    /// Gives a place back.
    pub(super) fn free_place(&mut self, v: Place) {
        self.mesh.incident[v.index()] = TetrahedronId::NONE;
        self.free.push(v);
    }

    /// Makes a point a vertex, found from a tetrahedron near it, and returns its place; or says why not, and nothing has
    /// changed.
    pub(super) fn add_point<T: Tally>(
        &mut self,
        from: TetrahedronId,
        q: [f64; 3],
        tally: &mut T,
    ) -> Result<Place, Refusal> {
        if !self.is_in_span(q) {
            let v = self.keep(q);
            if self.rebuild(Some(v)).is_none() {
                self.free_place(v);
                return Err(Refusal::Full);
            }
            return Ok(v);
        }
        let t = self.walk(from, q, tally);
        if let Some(w) = self.vertex_at(t, q) {
            return Err(Refusal::Vertex(w));
        }
        let v = self.keep(q);
        if self.insert(v, t, tally).is_none() {
            self.free_place(v);
            return Err(Refusal::Full);
        }
        Ok(v)
    }

    /// Some tetrahedron; there must be a vertex.
    pub(super) fn any_cell(&self) -> TetrahedronId {
        self.mesh.cells().next().unwrap_or(TetrahedronId::NONE)
    }

    /// What decisions look at.
    #[inline]
    pub(super) fn view(&self) -> View<'_> {
        View { cells: &self.mesh.cells, points: &self.points, filter: &self.filter }
    }

    /// [`View::conflicts`].
    #[inline]
    pub(super) fn conflicts(&self, t: TetrahedronId, q: [f64; 3]) -> bool {
        self.view().conflicts(t, &q)
    }

    /// Whether the corners of a finite tetrahedron are in positive order.
    #[inline]
    pub(super) fn is_positive(&self, t: TetrahedronId) -> bool {
        let [a, b, c, d] = self.mesh.cells[t.index()].corners.map(|p| self.points[p.index()]);
        self.filter.orient3d(a, b, c, d).is_positive()
    }

    /// The longest side of the box around all points.
    pub(super) fn size(&self) -> f64 {
        self.limits.extent().into_iter().fold(0.0, f64::max)
    }

    /// The filter for the vertices and one more point.
    #[inline]
    fn filter_with(&self, q: [f64; 3]) -> Filter3 {
        if self.limits.contains(q) && self.grid.is_none_or(|grid| q.iter().all(|&x| grid.holds(x))) {
            return self.filter;
        }
        let mut limits = self.limits;
        limits.include(q);
        Filter3::for_box(limits.extent(), None)
    }

    /// [`View::walk`], for a point that may be outside of the box around the others.
    #[inline]
    pub(super) fn walk<T: Tally>(&self, from: TetrahedronId, q: [f64; 3], tally: &mut T) -> TetrahedronId {
        View { filter: &self.filter_with(q), ..self.view() }.walk(from, q, tally)
    }

    /// The vertex of a tetrahedron that a point equals.
    #[inline]
    pub(super) fn vertex_at(&self, t: TetrahedronId, q: [f64; 3]) -> Option<Place> {
        self.view().vertex_at(t, q).filter(|&p| !self.is_scaffold(p))
    }

    /// Makes the point at a place a vertex, from a tetrahedron in conflict with it. `None`, and nothing has changed, if there
    /// is no room.
    #[inline]
    pub(super) fn insert<T: Tally>(&mut self, v: Place, seed: TetrahedronId, tally: &mut T) -> Option<()> {
        let mut cavity = std::mem::take(&mut self.cavity);
        let inserted = cavity.insert(self, v, seed, tally);
        self.cavity = cavity;
        inserted?;
        self.mesh.vertex_count += 1;
        Some(())
    }
}

impl Arena for Layer {
    #[inline]
    fn view(&self) -> View<'_> {
        self.view()
    }

    #[inline]
    fn memory(&mut self) -> Memory<'_> {
        let Mesh3 { cells, marks, incident, .. } = &mut self.mesh;
        Memory { cells, marks, incident, points: &self.points, filter: &self.filter }
    }

    fn room(&self) -> usize {
        self.mesh.room()
    }

    #[inline]
    fn new_cell(&mut self) -> Option<TetrahedronId> {
        self.mesh.new_cell()
    }

    #[inline]
    fn free_cell(&mut self, t: TetrahedronId) {
        self.mesh.free_cell(t);
    }
}
