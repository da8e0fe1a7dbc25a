//! What the plane and space have in common, so that the rest is written once: `D` is the dimension, `C` the number of
//! corners of a simplex, one more.

use delone::{
    Algorithm2, Delaunay2, Delaunay3, Duplicate, Error, HintOrder, Hints2, Hints3, Location2, Location3,
    TetrahedronId, TriangleId, VertexId,
};

/// A triangulation.
pub trait Engine<const D: usize, const C: usize>: Clone + Send + Sync + 'static {
    fn build(points: Vec<[f64; D]>) -> Result<Self, Error>;
    fn extend(&mut self, points: &[[f64; D]]) -> Result<(), Error>;
    fn remove(&mut self, v: VertexId) -> Result<(), Error>;
    fn is_vertex(&self, v: VertexId) -> bool;
    fn vertex_count(&self) -> usize;
    fn duplicates(&self) -> Vec<Duplicate>;
    /// One more than the largest number of a simplex.
    fn slots(&self) -> usize;
    /// Shows each finite simplex, by increasing number: its number, its corners, and what is across from each of these,
    /// finite or not.
    fn visit(&self, show: impl FnMut(usize, [VertexId; C], [usize; C]));
    /// A finite simplex that holds a point.
    fn find(&self, q: [f64; D]) -> Result<Option<usize>, Error>;
    fn nearest(&self, q: [f64; D]) -> Result<Option<VertexId>, Error>;
    fn k_nearest(&self, q: [f64; D], k: usize) -> Result<Vec<VertexId>, Error>;
    /// The facets of the hull.
    fn hull(&self) -> Vec<[VertexId; D]>;
    /// The edges, each once.
    fn edges(&self) -> Vec<[VertexId; 2]>;
    /// What the points span, as a number.
    fn span(&self) -> i32;
}

/// The number of a dimension; -1 for no point.
fn span_of(dimension: delone::Dimension) -> i32 {
    match dimension {
        delone::Dimension::Empty => -1,
        delone::Dimension::Point => 0,
        delone::Dimension::Line => 1,
        delone::Dimension::Plane => 2,
        delone::Dimension::Space => 3,
    }
}

/// Of the triangles beside an edge or at a vertex a finite one.
fn finite(d: &Delaunay2, mut triangles: impl Iterator<Item = TriangleId>) -> Option<usize> {
    triangles.find(|&t| !d.mesh().is_ghost(t)).map(TriangleId::index)
}

impl Engine<2, 3> for Delaunay2 {
    fn build(points: Vec<[f64; 2]>) -> Result<Self, Error> {
        Self::from_vec(points, Algorithm2::default())
    }

    fn extend(&mut self, points: &[[f64; 2]]) -> Result<(), Error> {
        Delaunay2::extend(self, points, 0).map(drop)
    }

    fn remove(&mut self, v: VertexId) -> Result<(), Error> {
        Delaunay2::remove(self, v)
    }

    fn is_vertex(&self, v: VertexId) -> bool {
        self.mesh().contains(v)
    }

    fn vertex_count(&self) -> usize {
        Delaunay2::vertex_count(self)
    }

    fn duplicates(&self) -> Vec<Duplicate> {
        Delaunay2::duplicates(self).collect()
    }

    fn slots(&self) -> usize {
        self.mesh().slot_count()
    }

    fn visit(&self, mut show: impl FnMut(usize, [VertexId; 3], [usize; 3])) {
        for t in self.mesh().triangles() {
            // Edge k leaves corner k, so it is across from the corner before.
            let [a, b, c] = self.mesh().adjacent(t).map(TriangleId::index);
            show(t.index(), self.mesh().corners(t), [b, c, a]);
        }
    }

    fn find(&self, q: [f64; 2]) -> Result<Option<usize>, Error> {
        Ok(match self.locate(q)? {
            Location2::Triangle(t) => Some(t.index()),
            Location2::Edge(e) => {
                finite(self, [e, self.mesh().twin(e)].map(delone::EdgeId::triangle).into_iter())
            }
            Location2::Vertex(v) => finite(self, self.mesh().star(v).map(delone::EdgeId::triangle)),
            Location2::Outside(_) | Location2::LowerDimensional(_) => None,
        })
    }

    fn nearest(&self, q: [f64; 2]) -> Result<Option<VertexId>, Error> {
        Delaunay2::nearest(self, q)
    }

    fn k_nearest(&self, q: [f64; 2], k: usize) -> Result<Vec<VertexId>, Error> {
        Delaunay2::k_nearest(self, q, k)
    }

    fn hull(&self) -> Vec<[VertexId; 2]> {
        let corners: Vec<VertexId> = Delaunay2::hull(self).collect();
        let next = corners.iter().cycle().skip(1);
        let sides = corners.iter().zip(next).map(|(&v, &w)| [v, w]);
        if self.span() == 2 { sides.collect() } else { Vec::new() }
    }

    fn edges(&self) -> Vec<[VertexId; 2]> {
        Delaunay2::edges(self).collect()
    }

    fn span(&self) -> i32 {
        span_of(self.dimension())
    }
}

impl Engine<3, 4> for Delaunay3 {
    fn build(points: Vec<[f64; 3]>) -> Result<Self, Error> {
        Self::from_vec(points)
    }

    fn extend(&mut self, points: &[[f64; 3]]) -> Result<(), Error> {
        Delaunay3::extend(self, points, 0).map(drop)
    }

    fn remove(&mut self, v: VertexId) -> Result<(), Error> {
        Delaunay3::remove(self, v)
    }

    fn is_vertex(&self, v: VertexId) -> bool {
        self.mesh().contains(v)
    }

    fn vertex_count(&self) -> usize {
        Delaunay3::vertex_count(self)
    }

    fn duplicates(&self) -> Vec<Duplicate> {
        Delaunay3::duplicates(self).collect()
    }

    fn slots(&self) -> usize {
        self.mesh().slot_count()
    }

    fn visit(&self, mut show: impl FnMut(usize, [VertexId; 4], [usize; 4])) {
        for t in self.cells() {
            show(t.index(), self.mesh().corners(t), self.mesh().adjacent(t).map(TetrahedronId::index));
        }
    }

    fn find(&self, q: [f64; 3]) -> Result<Option<usize>, Error> {
        let is_finite = |t: &TetrahedronId| !self.mesh().is_ghost(*t);
        let there = match self.locate(q)? {
            Location3::Tetrahedron(t) => Some(t),
            Location3::Facet(f) if self.span() == 3 => {
                [f, self.mesh().twin(f)].map(delone::FacetId::tetrahedron).into_iter().find(is_finite)
            }
            Location3::Vertex(v) => self.tetrahedra_at(v).into_iter().find(is_finite),
            Location3::Edge([v, w]) => self
                .tetrahedra_at(v)
                .into_iter()
                .find(|t| is_finite(t) && self.mesh().corners(*t).contains(&w)),
            _ => None,
        };
        Ok(there.map(TetrahedronId::index))
    }

    fn nearest(&self, q: [f64; 3]) -> Result<Option<VertexId>, Error> {
        Delaunay3::nearest(self, q)
    }

    fn k_nearest(&self, q: [f64; 3], k: usize) -> Result<Vec<VertexId>, Error> {
        Delaunay3::k_nearest(self, q, k)
    }

    fn hull(&self) -> Vec<[VertexId; 3]> {
        if self.span() == 3 { Delaunay3::hull(self).collect() } else { Vec::new() }
    }

    fn edges(&self) -> Vec<[VertexId; 2]> {
        Delaunay3::edges(self).collect()
    }

    fn span(&self) -> i32 {
        span_of(self.dimension())
    }
}

/// Imprecise points.
pub trait Imprecise<const D: usize, const C: usize>: Send + Sync + 'static {
    type Engine: Engine<D, C>;
    fn preprocess(centres: &[[f64; D]]) -> Result<Self, Error>
    where
        Self: Sized;
    fn instance(&mut self, points: &[[f64; D]]) -> Result<Self::Engine, Error>;
}

impl Imprecise<2, 3> for Hints2 {
    type Engine = Delaunay2;

    fn preprocess(centres: &[[f64; 2]]) -> Result<Self, Error> {
        Hints2::from_points(centres, HintOrder::default())
    }

    fn instance(&mut self, points: &[[f64; 2]]) -> Result<Delaunay2, Error> {
        self.triangulate(points).cloned()
    }
}

impl Imprecise<3, 4> for Hints3 {
    type Engine = Delaunay3;

    fn preprocess(centres: &[[f64; 3]]) -> Result<Self, Error> {
        Hints3::from_points(centres, HintOrder::default())
    }

    fn instance(&mut self, points: &[[f64; 3]]) -> Result<Delaunay3, Error> {
        self.triangulate(points).cloned()
    }
}
