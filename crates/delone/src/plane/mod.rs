//! Delaunay triangulations of the plane.

pub mod build;
mod cavity;
pub mod check;
mod ground;
mod insert;
mod line;
mod position;
pub mod verify;

pub use build::{Algorithm, Counters};
pub use position::Position2;

use crate::error::Error;
use crate::ids::{EdgeId, MAX_POINTS, TriangleId, VertexId};
use crate::mesh::{Dimension, Mesh};

/// A point that equals an earlier one and is no vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Duplicate {
    /// The index of the point.
    pub point: usize,
    /// The vertex that stands for it: the first point given with these coordinates.
    pub vertex: VertexId,
}

/// The Delaunay triangulation of a set of points in the plane.
///
/// It is a function of the set of points alone: four cocircular points always get the same diagonal (see
/// [`delone_predicates::in_circle`]), whatever the order of the points and the algorithm. A vertex is known by
/// the index of its point in the input. Sets that span less than the plane (no point, one point, collinear
/// points) are valid triangulations without triangles.
///
/// The combinatorial questions (neighbours, stars, hull) are answered by [`Delaunay2::mesh`].
///
/// ```
/// use delone::Delaunay2;
///
/// let triangulation = Delaunay2::from_points(&[[0.0, 0.0], [2.0, 0.0], [1.0, 2.0], [1.0, 0.7]])?;
/// assert_eq!(triangulation.triangles().count(), 3);
/// assert_eq!(triangulation.hull().map(|v| v.index()).count(), 3);
/// for [a, b, c] in triangulation.triangles() {
///     println!("{} {} {}", a.index(), b.index(), c.index()); // counter-clockwise
/// }
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Delaunay2 {
    points: Vec<[f64; 2]>,
    mesh: Mesh,
    duplicates: Vec<Duplicate>,
    counters: Counters,
}

impl Delaunay2 {
    /// Triangulates points with the default algorithm.
    ///
    /// O(n log n) in the worst case; about 100 bytes a point above the input.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate; [`Error::TooManyPoints`] is returned
    /// beyond [`MAX_POINTS`].
    pub fn from_points<P: Position2>(points: &[P]) -> Result<Self, Error> {
        Self::with_algorithm(points, Algorithm::default())
    }

    /// Triangulates points with an algorithm of choice. Errors as [`Self::from_points`].
    pub fn with_algorithm<P: Position2>(points: &[P], algorithm: Algorithm) -> Result<Self, Error> {
        check_count(points.len())?;
        Self::from_vec(points.iter().map(Position2::xy).collect(), algorithm)
    }

    /// The same for coordinates that can be kept, which saves a copy. Errors as [`Self::from_points`].
    pub fn from_vec(points: Vec<[f64; 2]>, algorithm: Algorithm) -> Result<Self, Error> {
        check_count(points.len())?;
        if let Some(at) = points.as_flattened().iter().position(|x| !x.is_finite()) {
            return Err(Error::NotFinite { index: at / 2, axis: at % 2, value: points.as_flattened()[at] });
        }
        let (mesh, duplicates, counters) = build::build(&points, algorithm);
        Ok(Self { points, mesh, duplicates, counters })
    }

    /// The topology: vertices, edges, triangles, stars, hull.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The coordinates of all input points, duplicates included.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// The points that equal an earlier one, by increasing index.
    pub fn duplicates(&self) -> &[Duplicate] {
        &self.duplicates
    }

    /// What the construction did.
    pub fn counters(&self) -> Counters {
        self.counters
    }

    /// What the points span.
    pub fn dimension(&self) -> Dimension {
        self.mesh.dimension()
    }

    /// The number of vertices: points without duplicates.
    pub fn vertex_count(&self) -> usize {
        self.mesh.vertex_count()
    }

    /// The vertices, by increasing index.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.mesh.vertices()
    }

    /// The finite triangles as corners in counter-clockwise order.
    pub fn triangles(&self) -> impl Iterator<Item = [VertexId; 3]> + '_ {
        self.mesh.triangles().map(|t| self.mesh.corners(t))
    }

    /// The finite edges, each once.
    pub fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.mesh.undirected_edges().map(|e| [self.mesh.origin(e), self.mesh.destination(e)])
    }

    /// The vertices of the hull, counter-clockwise; see [`Mesh::hull`].
    pub fn hull(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.mesh.hull()
    }

    /// The coordinates of a vertex.
    ///
    /// # Panics
    /// For the ghost vertex and for a vertex of another, larger triangulation.
    #[inline]
    pub fn point(&self, v: VertexId) -> [f64; 2] {
        self.points[v.index()]
    }

    /// The coordinates of the ends of a finite edge.
    pub fn segment(&self, e: EdgeId) -> [[f64; 2]; 2] {
        [self.mesh.origin(e), self.mesh.destination(e)].map(|v| self.point(v))
    }

    /// The area of a finite triangle, zero for a ghost; positive up to rounding. In coordinate units squared.
    pub fn area(&self, t: TriangleId) -> f64 {
        if self.mesh.is_ghost(t) {
            return 0.0;
        }
        let [a, b, c] = self.mesh.corners(t).map(|v| self.point(v));
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
    }

    /// The centre of the circle through the corners of a finite triangle, rounded; `None` for a ghost, and
    /// where it is too far away for `f64`.
    pub fn circumcentre(&self, t: TriangleId) -> Option<[f64; 2]> {
        if self.mesh.is_ghost(t) {
            return None;
        }
        let [a, b, c] = self.mesh.corners(t).map(|v| self.point(v));
        let (bx, by, cx, cy) = (b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]);
        let twice_area = 2.0 * (bx * cy - by * cx);
        let (b2, c2) = (bx * bx + by * by, cx * cx + cy * cy);
        let centre = [a[0] + (cy * b2 - by * c2) / twice_area, a[1] + (bx * c2 - cx * b2) / twice_area];
        centre.iter().all(|x| x.is_finite()).then_some(centre)
    }
}

fn check_count(count: usize) -> Result<(), Error> {
    if count > MAX_POINTS { Err(Error::TooManyPoints { count }) } else { Ok(()) }
}
