//! A triangulation in rows: the triangles inside, numbered, and the edges that are segments.

use std::ffi::c_int;

use delone::{Constrained2, Delaunay2, EdgeId, Mesh2, TriangleId, VertexId};
use rayon::prelude::*;

use crate::fault::Fault;
use crate::input::Input;

/// Triangles of a task for several threads.
pub(crate) const BLOCK: usize = 1 << 13;

/// A triangulation of points alone, or with segments.
#[derive(Debug)]
pub(crate) enum Triangulated {
    Plain(Box<Delaunay2>),
    Graph(Box<Constrained2>),
}

/// An edge that is a segment, or a piece of one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    pub(crate) ends: [VertexId; 2],
    /// In one of its directions.
    pub(crate) edge: EdgeId,
    /// The row of the input, of several the first; none where it closes the hull.
    pub(crate) origin: Option<usize>,
}

/// See the module.
#[derive(Debug)]
pub(crate) struct Built {
    pub(crate) triangulation: Triangulated,
    /// By slot of the mesh, the row of its triangle; -1 outside.
    rows: Vec<c_int>,
    /// By row.
    pub(crate) triangles: Vec<TriangleId>,
    pub(crate) segments: Vec<Segment>,
    /// Segments with nothing of the mesh beside them.
    pub(crate) outside: Vec<Segment>,
    /// The first edge of each block of triangles, and their number.
    pub(crate) starts: Vec<usize>,
    /// Attributes of all points.
    pub(crate) values: Vec<f64>,
    /// Attributes of triangles, by row, and how many each has.
    pub(crate) triangle_values: Vec<f64>,
    pub(crate) triangle_value_count: usize,
}

/// An edge, from the triangle with the least row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    pub(crate) row: usize,
    pub(crate) edge: EdgeId,
    /// The row across; -1 outside.
    pub(crate) across: c_int,
}

impl Built {
    /// Numbers the triangles inside.
    pub(crate) fn new(triangulation: Triangulated, is_inside: impl Fn(TriangleId) -> bool) -> Self {
        let mesh = triangulation.mesh();
        let mut rows = vec![-1; mesh.slot_count()];
        let mut triangles = Vec::with_capacity(mesh.triangle_count());
        for t in mesh.triangles().filter(|&t| is_inside(t)) {
            rows[t.index()] = triangles.len() as c_int;
            triangles.push(t);
        }
        let mut built = Self {
            triangulation,
            rows,
            triangles,
            segments: Vec::new(),
            outside: Vec::new(),
            starts: Vec::new(),
            values: Vec::new(),
            triangle_values: Vec::new(),
            triangle_value_count: 0,
        };
        let count = |rows: &[TriangleId]| -> usize {
            let of = |&t: &TriangleId| built.sides(t).count();
            rows.iter().map(of).sum()
        };
        let counts: Vec<usize> = built.triangles.par_chunks(BLOCK).map(count).collect();
        let sum = |sum: &mut usize, count: usize| Some(std::mem::replace(sum, *sum + count));
        built.starts = counts.into_iter().chain([0]).scan(0, sum).collect();
        built
    }

    /// The triangulation of points alone.
    pub(crate) fn plain(input: &mut Input) -> Result<Self, Fault> {
        let d = Delaunay2::from_vec(std::mem::take(&mut input.points))?;
        let mut built = Self::new(Triangulated::Plain(Box::new(d)), |_| true);
        built.values = std::mem::take(&mut input.attributes);
        let mesh = built.mesh();
        let edge = |[v, w]: [VertexId; 2]| mesh.star(v).find(|&e| mesh.destination(e) == w);
        let hull = built.triangulation.hull();
        let segment = |ends: [VertexId; 2]| Some(Segment { ends, edge: edge(ends)?, origin: None });
        built.segments = hull.into_iter().filter_map(segment).collect();
        Ok(built)
    }

    pub(crate) fn mesh(&self) -> &Mesh2 {
        self.triangulation.mesh()
    }

    /// All points, those of the input first.
    pub(crate) fn points(&self) -> &[[f64; 2]] {
        match &self.triangulation {
            Triangulated::Plain(d) => d.points(),
            Triangulated::Graph(c) => c.points(),
        }
    }

    pub(crate) fn is_plain(&self) -> bool {
        matches!(self.triangulation, Triangulated::Plain(_))
    }

    /// The row of a triangle; -1 outside.
    #[inline]
    pub(crate) fn row(&self, t: TriangleId) -> c_int {
        self.rows[t.index()]
    }

    /// The row across an edge; -1 outside.
    #[inline]
    pub(crate) fn across(&self, e: EdgeId) -> c_int {
        self.row(self.mesh().twin(e).triangle())
    }

    /// The number of edges.
    pub(crate) fn edge_count(&self) -> usize {
        self.starts.last().copied().unwrap_or(0)
    }

    /// The edges that are told with this triangle: those to later rows, and to nothing.
    #[inline]
    fn sides(&self, t: TriangleId) -> impl Iterator<Item = Side> + '_ {
        let row = self.row(t);
        // Opposite to the corners, in their order.
        let side = move |k: usize| {
            let edge = t.edge(k);
            Side { row: row as usize, edge, across: self.across(edge) }
        };
        [1, 2, 0].into_iter().map(side).filter(move |side| side.across < 0 || row < side.across)
    }

    /// The edges told with the triangles of a block, in their order.
    pub(crate) fn sides_of_block(&self, block: usize) -> impl Iterator<Item = Side> + '_ {
        let rows = self.triangles.chunks(BLOCK).nth(block).unwrap_or_default();
        rows.iter().flat_map(|&t| self.sides(t))
    }

    /// All edges, in their order.
    pub(crate) fn all_sides(&self) -> impl Iterator<Item = Side> + '_ {
        self.triangles.iter().flat_map(|&t| self.sides(t))
    }

    /// The ends of an edge, counter-clockwise around its triangle.
    #[inline]
    pub(crate) fn ends(&self, side: &Side) -> [VertexId; 2] {
        [self.mesh().origin(side.edge), self.mesh().destination(side.edge)]
    }

    /// The corners of a triangle, by row.
    #[inline]
    pub(crate) fn corners(&self, row: usize) -> [VertexId; 3] {
        self.mesh().corners(self.triangles[row])
    }

    /// Where the corners of a triangle are.
    pub(crate) fn places(&self, row: usize) -> [[f64; 2]; 3] {
        self.corners(row).map(|v| self.points()[v.index()])
    }
}

impl Triangulated {
    fn mesh(&self) -> &Mesh2 {
        match self {
            Self::Plain(d) => d.mesh(),
            Self::Graph(c) => c.mesh(),
        }
    }

    /// The edges of the hull, counter-clockwise.
    fn hull(&self) -> Vec<[VertexId; 2]> {
        match self {
            Self::Plain(d) => d.hull_facets().collect(),
            Self::Graph(c) => c.hull_facets().collect(),
        }
    }
}
