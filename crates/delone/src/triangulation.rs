//! Traits of all kinds of triangulations: their simplices, queries and changes.
//!
//! Whatever stands on these traits (files, pictures, the program, the Python package) works for a new kind as soon as it has
//! them. The types themselves have more, and say it in their own words: [`crate::Delaunay2`] has triangles and edges,
//! [`crate::Delaunay3`] tetrahedra and facets. Methods whose name ends in `observed` tell a [`Tally`] each step; `&mut ()`
//! hears nothing, and costs nothing.

use std::fmt::Debug;
use std::hash::Hash;
use std::ops::Range;

use crate::error::Error;
use crate::ids::{Duplicate, Inserted, VertexId};
use crate::locate::Locate;
use crate::mesh::Dimension;
use crate::order::HintOrder;
use crate::regular::Reweighed;
use crate::tally::{Counters, Tally};

/// The coordinates of a point: `[f64; 2]` or `[f64; 3]`.
pub trait Coordinates:
    AsRef<[f64]> + AsMut<[f64]> + Copy + Default + Debug + PartialEq + Send + Sync + 'static
{
    /// How many there are.
    const COUNT: usize;
}

impl Coordinates for [f64; 2] {
    const COUNT: usize = 2;
}

impl Coordinates for [f64; 3] {
    const COUNT: usize = 3;
}

/// The corners of a simplex or of one of its facets: an array of vertices.
pub trait Corners: AsRef<[VertexId]> + Copy + Debug + Send + Sync + 'static {
    /// The indices of the vertices, in their order.
    fn indices(self) -> impl Iterator<Item = usize> + Send {
        (0..self.as_ref().len()).map(move |k| self.as_ref()[k].index())
    }
}

impl<const N: usize> Corners for [VertexId; N] {}

/// A triangulation of points: triangles in the plane, tetrahedra in space.
///
/// ```
/// use delone::{Delaunay2, Delaunay3, Triangulation};
///
/// /// The mean number of simplices at a corner, of any kind of triangulation.
/// fn load<T: Triangulation>(t: &T) -> f64 {
///     let corners: usize = t.simplices().map(|s| t.corners(s).as_ref().len()).sum();
///     corners as f64 / t.vertex_count() as f64
/// }
///
/// assert_eq!(load(&Delaunay2::from_points(&[[0, 0], [1, 0], [0, 1]])?), 1.0);
/// assert_eq!(load(&Delaunay3::from_points(&[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])?), 1.0);
/// # Ok::<(), delone::Error>(())
/// ```
pub trait Triangulation: Debug + Send + Sync {
    /// A point.
    type Point: Coordinates;
    /// The name of a simplex: a triangle in the plane, a tetrahedron in space.
    type Simplex: Copy + Debug + Eq + Ord + Hash + Send + Sync + 'static;
    /// The corners of a simplex.
    type Corners: Corners;
    /// The corners of a facet: an edge in the plane, a triangle in space.
    type Facet: Corners;
    /// The flaws that a check finds.
    type Flaw: std::error::Error + Send + Sync + 'static;

    /// The dimension of the span of the points.
    fn dimension(&self) -> Dimension;

    /// The number of ids given so far: points of the input and of all insertions, which the largest id is below. It is the size
    /// of what is indexed by vertices.
    fn ids_given(&self) -> usize;

    /// The number of vertices.
    fn vertex_count(&self) -> usize;

    /// The vertices, by increasing index.
    fn vertices(&self) -> impl Iterator<Item = VertexId> + '_;

    /// The coordinates of a vertex; `None` for an id that is none.
    fn position(&self, v: VertexId) -> Option<Self::Point>;

    /// The points that equal an earlier one which is a vertex, by increasing index.
    fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_;

    /// The edges between vertices, each once, of whatever the points span.
    fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_;

    /// The finite simplices, by increasing index.
    fn simplices(&self) -> impl Iterator<Item = Self::Simplex> + Send + '_;

    /// The number of finite simplices.
    fn simplex_count(&self) -> usize {
        self.simplices().count()
    }

    /// The index of a simplex, below [`Self::slot_count`].
    fn index(&self, s: Self::Simplex) -> usize;

    /// One more than the largest index of a simplex: the size of what is indexed by simplices.
    fn slot_count(&self) -> usize;

    /// The corners of a simplex, in positive order.
    fn corners(&self, s: Self::Simplex) -> Self::Corners;

    /// The finite simplex across the facet that is opposite to corner `k`; `None` beyond the hull.
    fn across(&self, s: Self::Simplex, k: usize) -> Option<Self::Simplex>;

    /// The finite simplices at a vertex, in no special order; none for an id that is no vertex.
    fn simplices_at(&self, v: VertexId) -> Vec<Self::Simplex>;

    /// The facets of the hull, counter-clockwise seen from outside. Where the points span less than the whole there are
    /// none, but for coplanar points of space: each of their triangles once, seen from either side.
    fn hull_facets(&self) -> impl Iterator<Item = Self::Facet> + Send + '_;

    /// Proves that it is the one canonical triangulation, or tells the first flaw found.
    fn check(&self) -> Result<(), Self::Flaw>;
}

/// Where a point falls, told in vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Found<S> {
    corners: [VertexId; 4],
    count: usize,
    /// A finite simplex that holds the point, in its inside or on its border; none outside of the hull, and where there are no
    /// simplices.
    pub simplex: Option<S>,
    /// Whether the point is strictly outside of the hull.
    pub is_outside: bool,
}

impl<S> Found<S> {
    /// On a face: strictly inside of the simplex, facet or edge with these corners, or on the vertex.
    pub fn on(face: &[VertexId], simplex: Option<S>) -> Self {
        let mut corners = [VertexId::GHOST; 4];
        let count = face.len().min(4);
        corners[..count].copy_from_slice(&face[..count]);
        Self { corners, count, simplex, is_outside: false }
    }

    /// Outside, beyond the nearest facet of the hull; or off everything, if there is none.
    pub fn beyond(facet: &[VertexId]) -> Self {
        Self { is_outside: true, ..Self::on(facet, None) }
    }

    /// The corners of the smallest face that holds the point: one is a vertex, two are an edge, three a triangle, four a
    /// tetrahedron; the first of three or four may be any of them. Outside those of the facet of the hull that is nearest to the
    /// point, counter-clockwise seen from there; none where the points span less than the whole.
    pub fn face(&self) -> &[VertexId] {
        &self.corners[..self.count]
    }
}

/// A triangulation that answers where points are.
pub trait Ask: Triangulation {
    /// Finds where a point falls. Exact.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities; so for all questions.
    fn find_observed<O: Tally>(
        &self,
        q: Self::Point,
        observer: &mut O,
    ) -> Result<Found<Self::Simplex>, Error>;

    /// Finds the vertex nearest to a point, of equally near ones the lexicographically smallest; none of no vertices.
    fn nearest_observed<O: Tally>(&self, q: Self::Point, observer: &mut O)
    -> Result<Option<VertexId>, Error>;

    /// Finds the `k` vertices nearest to a point, nearest first; fewer if there are not so many.
    fn k_nearest(&self, q: Self::Point, k: usize) -> Result<Vec<VertexId>, Error>;

    /// Finds the vertices within a distance of a point, by increasing id.
    fn within(&self, q: Self::Point, radius: f64) -> Result<Vec<VertexId>, Error>;

    /// Finds where a point falls, unobserved.
    fn find(&self, q: Self::Point) -> Result<Found<Self::Simplex>, Error> {
        self.find_observed(q, &mut ())
    }
}

/// A triangulation whose points come, go and move.
pub trait Change: Ask + Clone + Default {
    /// Triangulates points by the fastest algorithm.
    fn from_vec(points: Vec<Self::Point>) -> Result<Self, Error>;

    /// Chooses the strategy of location.
    fn set_strategy(&mut self, locate: Locate) -> Result<(), Error>;

    /// Inserts a point.
    fn insert_observed<O: Tally>(&mut self, p: Self::Point, observer: &mut O) -> Result<Inserted, Error>;

    /// Removes a vertex.
    fn remove_observed<O: Tally>(&mut self, v: VertexId, observer: &mut O) -> Result<(), Error>;

    /// Moves a vertex, which keeps its id.
    fn move_to(&mut self, v: VertexId, p: Self::Point) -> Result<(), Error>;

    /// Inserts many points in an order that the seed decides, and returns their ids as a range of indices.
    fn extend(&mut self, points: &[Self::Point], seed: u64) -> Result<Range<usize>, Error>;
}

/// A triangulation of points with weights: they come, go and change their weights, and may be hidden. It has no [`Ask`], as that is by
/// distance: edges of a regular triangulation lead to the least power, and not to the nearest vertex.
pub trait Regular: Triangulation + Clone + Default {
    /// Triangulates points with weights, squared radii, by the fastest algorithm.
    fn from_parts(points: &[Self::Point], weights: &[f64]) -> Result<Self, Error>;

    /// Triangulates them by insertion one by one, in an order that the seed decides.
    fn with_seed(points: &[Self::Point], weights: &[f64], seed: u64) -> Result<Self, Error>;

    /// Counters of the construction.
    fn counters(&self) -> Counters;

    /// Point and weight of a site, hidden or not; none if it was removed or never given.
    fn site(&self, v: VertexId) -> Option<(Self::Point, f64)>;

    /// The sites whose power cells are empty, by increasing id.
    fn hidden(&self) -> impl Iterator<Item = VertexId> + '_;

    /// Adds a site.
    fn insert(&mut self, point: Self::Point, weight: f64) -> Result<Inserted, Error>;

    /// Takes a site away.
    fn remove(&mut self, v: VertexId) -> Result<(), Error>;

    /// Gives a site another weight.
    fn set_weight(&mut self, v: VertexId, weight: f64) -> Result<(), Error>;

    /// Gives all sites other weights, by id.
    fn set_weights(&mut self, weights: &[f64]) -> Result<Reweighed, Error>;

    /// Adds many sites in an order that the seed decides, and returns their ids as a range of indices.
    fn extend(&mut self, sites: &[(Self::Point, f64)], seed: u64) -> Result<Range<usize>, Error>;

    /// The vertex with the least power at a point.
    fn nearest(&self, q: Self::Point) -> Result<Option<VertexId>, Error>;

    /// The `k` vertices with the least powers at a point, the least first; fewer if there are not so many.
    fn k_nearest(&self, q: Self::Point, k: usize) -> Result<Vec<VertexId>, Error>;

    /// The vertices whose power at a point is at most `power`, by increasing id.
    fn within(&self, q: Self::Point, power: f64) -> Result<Vec<VertexId>, Error>;
}

/// Points that are nearly known beforehand: an order and a hint for each, found once.
pub trait Imprecise: Sized + Send + Sync {
    /// The triangulation of an instance.
    type Triangulation: Change;

    /// Finds order and hints.
    fn from_centers(
        centers: &[<Self::Triangulation as Triangulation>::Point],
        order: HintOrder,
    ) -> Result<Self, Error>;

    /// Triangulates an instance: point i near center i.
    fn triangulate(
        &mut self,
        instance: &[<Self::Triangulation as Triangulation>::Point],
    ) -> Result<&Self::Triangulation, Error>;

    /// Triangulates by hints, and reports each step.
    fn triangulate_observed<O: Tally>(
        &mut self,
        instance: &[<Self::Triangulation as Triangulation>::Point],
        observer: &mut O,
    ) -> Result<&Self::Triangulation, Error>;

    /// The triangulation of the last instance.
    fn current(&self) -> &Self::Triangulation;

    /// Whether hints misled so much that the last instance was triangulated without them.
    fn gave_up(&self) -> bool;
}
