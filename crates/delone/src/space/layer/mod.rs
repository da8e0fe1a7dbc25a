//! A triangulation of space that can change: topology, coordinates by place, static filter, and the buffers of its
//! operations. It knows no strategy of location.

pub(in crate::space) mod arena;
pub(in crate::space) mod cavity;
mod faces;
mod ground;
pub(in crate::space) mod hole;
mod hull;
pub(in crate::space) mod kernel;
mod remove;
pub(in crate::space) mod scaffold;
#[cfg(feature = "histories")]
mod simplices;
mod wrap;

pub(crate) use hull::{NearestFace, nearest_face};

use delone_predicates::{Filter3, Grid};

use crate::ids::{Place, TetrahedronId};
use crate::mesh::tetrahedra::Mesh3;
use crate::points::Bounds;
use crate::tally::Tally;
use arena::{Arena, Memory, View};
use cavity::Cavity;
use hole::Hole;
use kernel::Lift;
use wrap::Wrap;

/// See the module.
#[derive(Clone, Debug, Default)]
pub(in crate::space) struct Layer<W: Lift = ()> {
    pub(in crate::space) mesh: Mesh3,
    /// For each place its coordinates.
    pub(in crate::space) points: Vec<[f64; 3]>,
    /// For each place its weight, if there are weights.
    pub(in crate::space) weights: Vec<W>,
    /// The least and the largest.
    range: Option<[f64; 2]>,
    /// Places without a point.
    free: Vec<Place>,
    /// The box around all points, and a lattice that they are on.
    limits: Bounds<3>,
    grid: Option<Grid>,
    pub(in crate::space) filter: Filter3,
    /// The places of scaffold points.
    pub(in crate::space) scaffold: Vec<Place>,
    pub(in crate::space) cavity: Cavity,
    pub(in crate::space) hole: Hole,
    wrap: Option<Box<Wrap>>,
    /// The layer that fills holes.
    pub(in crate::space) fill: Option<Box<Layer<W>>>,
}

/// Why a point does not become a vertex.
#[derive(Clone, Copy, Debug)]
pub(in crate::space) enum Refusal {
    /// It equals this one.
    Vertex(Place),
    /// There would be too many tetrahedra.
    Full,
}

impl<W: Lift> Layer<W> {
    /// Points at their places, none a vertex yet.
    pub(in crate::space) fn new(points: Vec<[f64; 3]>) -> Self {
        let weights = vec![W::default(); points.len()];
        Self::with_weights(points, weights)
    }

    /// A layer of points with weights.
    pub(in crate::space) fn with_weights(points: Vec<[f64; 3]>, weights: Vec<W>) -> Self {
        let mesh = Mesh3 { incident: vec![TetrahedronId::NONE; points.len()], ..Mesh3::default() };
        let mut layer = Self { mesh, points, weights, ..Self::default() };
        layer.measure();
        layer
    }

    /// The box around all points, the lattice that they are on, the range of the weights, and a filter for all that.
    fn measure(&mut self) {
        (self.limits, self.grid, self.range) = measured(&self.points, &self.weights);
        self.renew_filter();
    }

    fn renew_filter(&mut self) {
        self.filter = filter_for::<W>(&(self.limits, self.grid, self.range));
    }

    /// Starts anew with other points, as [`Self::new`], in the memory that there is. They have no names.
    pub(in crate::space) fn restart(&mut self, sites: impl Iterator<Item = ([f64; 3], W)> + Clone) {
        self.weights.clear();
        self.weights.extend(sites.clone().map(|site| site.1));
        self.set_points(sites.map(|site| site.0));
        self.free.clear();
        self.mesh.incident.clear();
        self.mesh.incident.resize(self.points.len(), TetrahedronId::NONE);
        self.mesh.names.clear();
        self.clear_mesh();
    }

    /// Gives all places other points, and looks at nothing else.
    pub(in crate::space) fn set_points(&mut self, points: impl Iterator<Item = [f64; 3]>) {
        self.points.clear();
        self.points.extend(points);
        self.measure();
    }

    /// Multiplies all coordinates with a power of two. None may lose bits by that.
    pub(in crate::space) fn scale(&mut self, power: f64) {
        self.points.as_flattened_mut().iter_mut().for_each(|x| *x *= power);
        self.measure();
    }

    pub(in crate::space) fn clear_mesh(&mut self) {
        self.scaffold.clear();
        self.mesh.cells.clear();
        self.mesh.marks.clear();
        self.mesh.free.clear();
        self.mesh.vertex_count = 0;
    }

    /// Keeps a site at a place. It is no vertex yet.
    pub(in crate::space) fn keep(&mut self, (q, weight): ([f64; 3], W)) -> Place {
        let fits = self.grid.is_none_or(|grid| q.iter().all(|&x| grid.holds(x)));
        if !fits || self.points.is_empty() {
            self.grid = Grid::of(&q).filter(|_| self.points.is_empty());
        }
        let is_outside = !self.limits.contains(q);
        self.limits.include(q);
        let before = (self.grid, self.range);
        if W::HIDES {
            (self.grid, self.range) = wider(before, weight.value());
        }
        if is_outside || !fits || before != (self.grid, self.range) {
            self.renew_filter();
        }
        if let Some(place) = self.free.pop() {
            self.points[place.index()] = q;
            self.weights[place.index()] = weight;
            return place;
        }
        self.points.push(q);
        self.weights.push(weight);
        self.mesh.incident.push(TetrahedronId::NONE);
        self.mesh.names.add_place();
        Place::new(self.points.len() - 1)
    }

    /// Gives a place back.
    pub(in crate::space) fn free_place(&mut self, v: Place) {
        self.mesh.incident[v.index()] = TetrahedronId::NONE;
        self.free.push(v);
    }

    /// Some tetrahedron; there must be a vertex.
    pub(in crate::space) fn any_cell(&self) -> TetrahedronId {
        self.mesh.cells().next().unwrap_or(TetrahedronId::NONE)
    }

    /// Memory in bytes, buffers not counted.
    pub(in crate::space) fn bytes(&self) -> usize {
        self.mesh.bytes() + size_of_val(&*self.points)
    }

    /// The data that decisions read.
    #[inline]
    pub(in crate::space) fn view(&self) -> View<'_, W> {
        View { cells: &self.mesh.cells, points: &self.points, weights: &self.weights, filter: &self.filter }
    }

    /// The site at a place.
    pub(in crate::space) fn site(&self, p: Place) -> ([f64; 3], W) {
        (self.points[p.index()], W::at(&self.weights, p))
    }

    /// [`View::conflicts`].
    #[inline]
    pub(in crate::space) fn conflicts(&self, t: TetrahedronId, q: ([f64; 3], W)) -> bool {
        self.view().conflicts(t, (&q.0, q.1))
    }

    /// Whether the corners of a finite tetrahedron are in positive order.
    #[inline]
    pub(in crate::space) fn is_positive(&self, t: TetrahedronId) -> bool {
        let [a, b, c, d] = self.mesh.cells[t.index()].corners.map(|p| self.points[p.index()]);
        self.filter.orient3d(a, b, c, d).is_positive()
    }

    /// The longest side of the box around all points.
    pub(in crate::space) fn size(&self) -> f64 {
        self.limits.extent().into_iter().fold(0.0, f64::max)
    }

    /// The filter for the vertices and one more point.
    #[inline]
    pub(in crate::space) fn filter_with(&self, q: [f64; 3]) -> Filter3 {
        if self.limits.contains(q) && self.grid.is_none_or(|grid| q.iter().all(|&x| grid.holds(x))) {
            return self.filter;
        }
        let mut limits = self.limits;
        limits.include(q);
        // Without weights: walks ask for orientations alone.
        Filter3::for_box(limits.extent(), None)
    }

    /// [`View::walk`], for a point that may be outside of the box around the others.
    #[inline]
    pub(in crate::space) fn walk<T: Tally>(
        &self,
        from: TetrahedronId,
        q: [f64; 3],
        tally: &mut T,
    ) -> TetrahedronId {
        View { filter: &self.filter_with(q), ..self.view() }.walk(from, q, tally)
    }

    /// The vertex of a tetrahedron that a point equals.
    #[inline]
    pub(in crate::space) fn vertex_at(&self, t: TetrahedronId, q: [f64; 3]) -> Option<Place> {
        self.view().vertex_at(t, q).filter(|&p| !self.is_scaffold(p))
    }

    /// Makes the point at a place a vertex, from a tetrahedron in conflict with it. `None`, and nothing has changed, if there
    /// is no room.
    #[inline]
    pub(in crate::space) fn insert<T: Tally>(
        &mut self,
        v: Place,
        seed: TetrahedronId,
        tally: &mut T,
    ) -> Option<()> {
        let mut cavity = std::mem::take(&mut self.cavity);
        let inserted = cavity.insert(self, v, seed, tally);
        self.cavity = cavity;
        inserted?;
        self.mesh.vertex_count += 1;
        if W::HIDES {
            self.mesh.vertex_count -= self.cavity.hidden().len();
        }
        Some(())
    }
}

impl Layer {
    /// Makes a point a vertex, found from a tetrahedron near it, and returns its place; or says why not, and nothing has
    /// changed.
    pub(in crate::space) fn add_point<T: Tally>(
        &mut self,
        from: TetrahedronId,
        q: [f64; 3],
        tally: &mut T,
    ) -> Result<Place, Refusal> {
        if !self.is_in_span(q) {
            let v = self.keep((q, ()));
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
        let v = self.keep((q, ()));
        if self.insert(v, t, tally).is_none() {
            self.free_place(v);
            return Err(Refusal::Full);
        }
        Ok(v)
    }
}

/// The box around points, the lattice that they and the square roots of weights are on, and the range of these.
type Measures = (Bounds<3>, Option<Grid>, Option<[f64; 2]>);

fn measured<W: Lift>(points: &[[f64; 3]], weights: &[W]) -> Measures {
    let mut measures = (Grid::of(points.as_flattened()), None);
    if W::HIDES {
        for w in weights {
            measures = wider(measures, w.value());
        }
    }
    (Bounds::of(points.iter().copied()), measures.0, measures.1)
}

fn filter_for<W: Lift>(&(limits, grid, range): &Measures) -> Filter3 {
    let spread = range.map_or(0.0, |[least, most]| most - least);
    W::filter(limits.extent(), spread, grid)
}

/// A filter for sites.
pub(in crate::space) fn filter_of<W: Lift>(points: &[[f64; 3]], weights: &[W]) -> Filter3 {
    filter_for::<W>(&measured(points, weights))
}

/// The lattice that a weight's square root may be on too, and the range with it.
fn wider((grid, range): (Option<Grid>, Option<[f64; 2]>), weight: f64) -> (Option<Grid>, Option<[f64; 2]>) {
    let [least, most] = range.unwrap_or([weight; 2]);
    (grid.filter(|grid| grid.holds_square(weight)), Some([least.min(weight), most.max(weight)]))
}

impl<W: Lift> Arena for Layer<W> {
    type Weight = W;

    #[inline]
    fn view(&self) -> View<'_, W> {
        self.view()
    }

    #[inline]
    fn memory(&mut self) -> Memory<'_, W> {
        let Mesh3 { cells, marks, incident, .. } = &mut self.mesh;
        Memory { cells, marks, incident, points: &self.points, weights: &self.weights, filter: &self.filter }
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
