//! Alpha complexes: the part of a triangulation that balls around its vertices reach when they grow, and the shape of that.
//!
//! Source: Edelsbrunner and Mücke, "Three-dimensional alpha shapes", ACM Transactions on Graphics 13 (1994); with weights
//! Edelsbrunner, "The union of balls and its dual shape", DCG 13 (1995). What is computed how is in `build.rs`.

mod buckets;
mod build;
mod components;
mod facing;
mod manifold;
mod outline;
mod sites;
mod surface;

use crate::ids::VertexId;

pub(crate) use build::build;
pub use manifold::Manifold3;
pub use outline::OutlinePart;

/// The alpha complexes of a triangulation of the plane.
pub type Alpha2 = Alpha<2>;

/// The alpha complexes of a triangulation of space.
pub type Alpha3 = Alpha<3>;

/// All alpha complexes of a triangulation: its faces of all dimensions, each with the least squared radius at which it is there.
///
/// A ball around each vertex grows, with the squared radius `alpha`, in regular triangulations `alpha` and the weight; it is cut to
/// the vertex's cell. The *value* of a face is the least `alpha` at which the balls of its corners meet: if no vertex is inside of the
/// smallest (ortho)sphere of the face its squared radius, or else the least value of the faces that it is a side of. So values are in squared
/// units of the coordinates; without weights vertices have 0, with weights the negative weight, or a little more if the vertex is not
/// in its own cell, and edges may be negative too. Gudhi and CGAL define the same.
///
/// Values are *correctly rounded*: the `f64` nearest to the exact one, infinite where none is as large. Rounding keeps order,
/// so a face never comes before its sides, and the filtration is the same for all orders of the points, on every machine.
///
/// In each dimension faces are sorted by value, then by their corners; corners by id. So the complex for any `alpha` is a beginning of
/// each array, found in O(log n).
///
/// Made by `alpha()` of [`crate::Delaunay2`], [`crate::Delaunay3`], [`crate::Regular2`] and [`crate::Regular3`]: O(n log n) for n faces, on all threads, with an exact
/// copy of the points. It does not follow later changes. Points that are no vertices, duplicates and hidden ones, are in no face.
///
/// ```
/// use delone::Delaunay2;
///
/// // Two triangles far from each other.
/// let points = [[0, 0], [2, 0], [0, 2], [20, 0], [22, 0], [20, 2]];
/// let alpha = Delaunay2::from_points(&points)?.alpha();
/// let complex = alpha.complex(2.0);
/// assert_eq!((complex.edges.len(), complex.triangles.len()), (6, 2));
/// assert_eq!(alpha.components(2.0), [0, 0, 0, 1, 1, 1].map(Some));
/// assert_eq!(alpha.outline(2.0).len(), 2);
/// assert_eq!(alpha.optimal(2), Some(2.0));
///
/// // The filtration: six points, then edges of length two.
/// let first = alpha.filtration().nth(6).expect("an edge");
/// assert_eq!((first.value, first.corners().len()), (1.0, 2));
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Alpha<const D: usize> {
    /// The points by id.
    points: Vec<[f64; D]>,
    vertices: Faces<1>,
    edges: Faces<2>,
    triangles: Faces<3>,
    tetrahedra: Faces<4>,
}

/// The faces of one dimension in the order of the filtration.
#[derive(Clone, Debug, Default)]
struct Faces<const N: usize> {
    corners: Vec<[VertexId; N]>,
    values: Vec<f64>,
}

impl<const N: usize> Faces<N> {
    /// The faces at `alpha`; none for NaN.
    fn until(&self, alpha: f64) -> &[[VertexId; N]] {
        &self.corners[..self.values.partition_point(|&value| value <= alpha)]
    }

    fn iter(&self) -> impl Iterator<Item = Face> + '_ {
        self.corners.iter().zip(&self.values).map(|(corners, &value)| {
            let mut face = Face { corners: [VertexId::GHOST; 4], count: N, value };
            face.corners[..N].copy_from_slice(corners);
            face
        })
    }
}

/// A face in a filtration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    corners: [VertexId; 4],
    count: usize,
    /// The least squared radius at which it is there.
    pub value: f64,
}

impl Face {
    /// Its corners, by increasing id: one is a vertex, two are an edge, three a triangle, four a tetrahedron.
    pub fn corners(&self) -> &[VertexId] {
        &self.corners[..self.count]
    }
}

/// The faces at some squared radius: in each dimension in the order of the filtration, corners by increasing id.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Complex<'a> {
    /// The vertices.
    pub vertices: &'a [[VertexId; 1]],
    /// The edges.
    pub edges: &'a [[VertexId; 2]],
    /// The triangles.
    pub triangles: &'a [[VertexId; 3]],
    /// The tetrahedra; none in the plane.
    pub tetrahedra: &'a [[VertexId; 4]],
}

impl Complex<'_> {
    /// Vertices less edges plus triangles less tetrahedra: components less tunnels plus voids.
    pub fn euler_characteristic(&self) -> i64 {
        let [v, e, t, c] =
            [self.vertices.len(), self.edges.len(), self.triangles.len(), self.tetrahedra.len()]
                .map(|count| count as i64);
        v - e + t - c
    }
}

impl<const D: usize> Alpha<D> {
    /// The faces at a squared radius, those of exactly this radius included. O(log n).
    pub fn complex(&self, alpha: f64) -> Complex<'_> {
        Complex {
            vertices: self.vertices.until(alpha),
            edges: self.edges.until(alpha),
            triangles: self.triangles.until(alpha),
            tetrahedra: self.tetrahedra.until(alpha),
        }
    }

    /// All faces of the triangulation: the complex of an infinite radius. O(1).
    pub fn all(&self) -> Complex<'_> {
        self.complex(f64::INFINITY)
    }

    /// The values of the faces of a dimension, 0 for vertices to 3 for tetrahedra, increasing, in the order of [`Self::all`]; none of a
    /// higher dimension.
    pub fn values(&self, dimension: usize) -> &[f64] {
        match dimension {
            0 => &self.vertices.values,
            1 => &self.edges.values,
            2 => &self.triangles.values,
            3 => &self.tetrahedra.values,
            _ => &[],
        }
    }

    /// The filtration: all faces by value, then by dimension, then by corners; each after its sides. O(1) a face.
    pub fn filtration(&self) -> impl Iterator<Item = Face> + '_ {
        let mut vertices = self.vertices.iter().peekable();
        let mut edges = self.edges.iter().peekable();
        let mut triangles = self.triangles.iter().peekable();
        let mut tetrahedra = self.tetrahedra.iter().peekable();
        std::iter::from_fn(move || {
            let heads = [vertices.peek(), edges.peek(), triangles.peek(), tetrahedra.peek()];
            let values = heads.map(|head| head.map(|face| face.value));
            // Of equal values the first one.
            let first = (0..4)
                .filter(|&k| values[k].is_some())
                .min_by(|&i, &j| values[i].partial_cmp(&values[j]).unwrap_or(std::cmp::Ordering::Equal))?;
            match first {
                0 => vertices.next(),
                1 => edges.next(),
                2 => triangles.next(),
                _ => tetrahedra.next(),
            }
        })
    }

    /// All values, each once, increasing: where complexes change. O(n log n).
    pub fn spectrum(&self) -> Vec<f64> {
        let mut values: Vec<f64> = (0..4).flat_map(|dimension| self.values(dimension)).copied().collect();
        values.sort_unstable_by(f64::total_cmp);
        values.dedup();
        values
    }

    /// The coordinates of all points by id; those of the origin for what is no vertex.
    pub fn positions(&self) -> &[[f64; D]] {
        &self.points
    }

    /// The coordinates of a vertex; those of the origin for an id that is none.
    pub fn position(&self, v: VertexId) -> [f64; D] {
        self.points.get(v.index()).copied().unwrap_or([0.0; D])
    }
}
