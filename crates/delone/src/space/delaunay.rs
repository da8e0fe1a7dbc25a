//! The Delaunay triangulation of space: a layer, with names and a strategy of location.

use std::sync::OnceLock;

use delone_predicates::circumcenter3;

use super::construct;
use super::layer::Layer;
use super::locator::Locator;
use crate::duplicates::Duplicates;
use crate::error::Error;
use crate::ids::{Duplicate, FacetId, MAX_TETRAHEDRA, Place, TetrahedronId, VertexId};
use crate::locate::Locate;
use crate::mesh::Dimension;
use crate::mesh::tetrahedra::Mesh3;
use crate::points::{Position3, check_in_space};
use crate::tally::{Counters, Work};

/// How to build a triangulation of space. The result is the same set of tetrahedra; only cost and numbering differ.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Algorithm3 {
    /// Biased randomized insertion along a Hilbert curve, each point located from the one before: the fastest.
    Incremental {
        /// Decides the rounds.
        seed: u64,
    },
    /// One by one in random order by bistellar flips, each point traced through all tetrahedra that ever were: for study.
    Flips {
        /// Decides the order.
        seed: u64,
    },
    /// One by one in random order, located by a strategy.
    Located {
        /// The strategy.
        locate: Locate,
        /// Decides the order.
        seed: u64,
    },
}

/// The Delaunay triangulation of a set of points in space.
///
/// It is a function of the set of points alone: ties of cospherical points are always broken in the same way (see
/// [`delone_predicates::in_sphere`]), whatever the order of the points. A vertex is known by the index of its point.
/// Sets that span less than space are valid triangulations without tetrahedra; coplanar points have triangles.
///
/// ```
/// use delone::Delaunay3;
///
/// let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
/// let triangulation = Delaunay3::from_points(&points)?;
/// assert_eq!(triangulation.tetrahedra().count(), 2);
/// assert_eq!(triangulation.hull_facets().count(), 6);
/// # Ok::<(), delone::Error>(())
/// ```
#[doc(alias = "Delaunay_triangulation_3")]
#[derive(Clone, Debug, Default)]
pub struct Delaunay3 {
    pub(super) base: Layer,
    pub(super) duplicates: Duplicates,
    pub(super) work: Work,
    pub(super) locate: Locate,
    /// The structure of the strategy, once it was needed.
    pub(super) locator: OnceLock<Locator>,
    /// The number of vertices when hints were made.
    pub(super) hinted: usize,
}

impl Delaunay3 {
    /// The triangulation of no points.
    pub fn new() -> Self {
        Self::default()
    }

    /// The triangulation of no points, with a strategy of location.
    ///
    /// # Errors
    /// As [`Self::set_strategy`].
    pub fn with_strategy(locate: Locate) -> Result<Self, Error> {
        let mut triangulation = Self::new();
        triangulation.set_strategy(locate)?;
        Ok(triangulation)
    }

    /// Triangulates points by the default algorithm.
    ///
    /// O(n log n) expected where the result has O(n) tetrahedra, as for evenly spread points; in the worst case it has
    /// O(n^2). About 280 bytes a point above the input for evenly spread points.
    /// On all threads of rayon's pool where that pays; the result is the same to the bit.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate; [`Error::TooManyPoints`] is returned beyond
    /// [`crate::MAX_POINTS_IN_SPACE`], [`Error::TooManyTetrahedra`] beyond 2^30 of these, which some sets of 66,000 points have.
    ///
    /// ```
    /// use delone::Delaunay3;
    ///
    /// let cube: Vec<[i32; 3]> = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).collect();
    /// let d = Delaunay3::from_points(&cube)?;
    /// assert_eq!((d.vertex_count(), d.hull_facets().count()), (8, 12));
    /// assert!((5..=6).contains(&d.tetrahedron_count()));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn from_points<P: Position3>(points: &[P]) -> Result<Self, Error> {
        check_in_space(points)?;
        Ok(Self::assemble(with_room(construct::triangulate(points, 0, &mut ()))?, Work::default()))
    }

    /// Triangulates coordinates that it may take apart, which takes 24 bytes a point less.
    ///
    /// # Errors
    /// As [`Self::from_points`].
    pub fn from_vec(points: Vec<[f64; 3]>) -> Result<Self, Error> {
        check_in_space(&points)?;
        let built = construct::triangulate::<[f64; 3], _>(points, 0, &mut ());
        Ok(Self::assemble(with_room(built)?, Work::default()))
    }

    /// Triangulates points with an algorithm of choice, and counts what it does; see [`Self::counters`].
    ///
    /// # Errors
    /// As [`Self::from_points`]; [`Error::Parameter`] and [`Error::OnlyInThePlane`] as in [`Self::set_strategy`].
    pub fn with_algorithm<P: Position3>(points: &[P], algorithm: Algorithm3) -> Result<Self, Error> {
        check_in_space(points)?;
        let mut work = Work::default();
        match algorithm {
            Algorithm3::Incremental { seed } => {
                let built = construct::triangulate(points, seed, &mut work);
                Ok(Self::assemble(with_room(built)?, work))
            }
            Algorithm3::Flips { seed } => {
                let built = construct::by_flips(&P::all(points), seed, &mut work);
                Ok(Self::assemble(with_room(built)?, work))
            }
            Algorithm3::Located { locate, seed } => {
                let mut d = Self::with_strategy(locate)?;
                d.extend_shuffled(points, seed, &mut work)?;
                d.work = work;
                Ok(d)
            }
        }
    }

    pub(super) fn assemble((base, duplicates): (Layer, Vec<Duplicate>), work: Work) -> Self {
        Self {
            hinted: base.mesh.vertex_count(),
            base,
            duplicates: Duplicates::new(duplicates),
            work,
            ..Self::default()
        }
    }

    /// Counters of the construction, if it was by [`Self::with_algorithm`].
    pub fn counters(&self) -> Counters {
        Counters::Incremental(self.work)
    }

    /// The topology: tetrahedra, facets, neighbors. Below space its tetrahedra have corners without a name, which
    /// stand for the dimensions that are missing.
    pub fn mesh(&self) -> &Mesh3 {
        &self.base.mesh
    }

    /// The dimension of the span of the points.
    pub fn dimension(&self) -> Dimension {
        self.base.dimension()
    }

    /// The number of vertices: points without duplicates.
    pub fn vertex_count(&self) -> usize {
        self.base.mesh.vertex_count()
    }

    /// The vertices, by increasing index.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.base.mesh.vertices()
    }

    /// The points that equal an earlier one which is a vertex, by increasing index.
    #[doc(alias = "coplanar")]
    pub fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_ {
        self.duplicates.iter(|v| self.base.mesh.contains(v))
    }

    /// The coordinates of a vertex.
    ///
    /// # Panics
    /// For an id that is no vertex.
    #[inline]
    pub fn point(&self, v: VertexId) -> [f64; 3] {
        let place = self.base.mesh.place(v).expect("a vertex");
        self.base.points[place.index()]
    }

    /// The vertices with their coordinates, by increasing index. Of points that are no vertices, duplicates and those removed, nothing is
    /// kept in space; so this is no slice by index, as in the plane.
    ///
    /// ```
    /// use delone::{Delaunay3, VertexId};
    ///
    /// let d = Delaunay3::from_points(&[[0, 0, 0], [1, 0, 0], [0, 0, 0]])?;
    /// assert!(d.points().eq([([0.0; 3], 0), ([1.0, 0.0, 0.0], 1)].map(|(p, i)| (VertexId::new(i), p))));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn points(&self) -> impl Iterator<Item = (VertexId, [f64; 3])> + '_ {
        self.vertices().map(|v| (v, self.point(v)))
    }

    /// The finite tetrahedra, by id. None below space.
    pub fn tetrahedron_ids(&self) -> impl Iterator<Item = TetrahedronId> + '_ {
        self.base.tetrahedra()
    }

    /// The finite tetrahedra as corners in positive order: the first three are seen counter-clockwise from the fourth.
    ///
    /// ```
    /// use delone::Delaunay3;
    ///
    /// let cube: Vec<[i32; 3]> = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).collect();
    /// let d = Delaunay3::from_points(&cube)?;
    /// let volume = |corners: [delone::VertexId; 4]| {
    ///     let [a, b, c, d] = corners.map(|v| d.point(v));
    ///     let [u, v, w] = [a, b, c].map(|p| [0, 1, 2].map(|axis| p[axis] - d[axis]));
    ///     let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    ///     (cross[0] * w[0] + cross[1] * w[1] + cross[2] * w[2]).abs() / 6.0
    /// };
    /// assert!((d.tetrahedra().map(volume).sum::<f64>() - 1.0).abs() < 1e-12);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("simplices", "finite_cells"))]
    pub fn tetrahedra(&self) -> impl Iterator<Item = [VertexId; 4]> + '_ {
        self.tetrahedron_ids().map(|t| self.base.mesh.corners(t))
    }

    /// The number of finite tetrahedra. O(n).
    pub fn tetrahedron_count(&self) -> usize {
        self.tetrahedron_ids().count()
    }

    /// The center of the sphere through the corners of a finite tetrahedron, correctly rounded (see
    /// [`delone_predicates::circumcenter3`]): a vertex of the Voronoi diagram, in coordinate units. `None` for a ghost, and where it is
    /// too far away for `f64`. O(1).
    ///
    /// ```
    /// use delone::Delaunay3;
    /// // The corners of a box are on one sphere: all its tetrahedra have the same center, to the bit.
    /// let corners: Vec<[f64; 3]> = (0..8).map(|i| [0, 1, 2].map(|k| if i >> k & 1 == 0 { 0.1 } else { 0.3 })).collect();
    /// let d = Delaunay3::from_points(&corners)?;
    /// assert!(d.tetrahedron_ids().all(|t| d.circumcenter(t) == Some([0.2; 3])));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("circumcentre", "dual"))]
    pub fn circumcenter(&self, t: TetrahedronId) -> Option<[f64; 3]> {
        if self.base.mesh.is_ghost(t) {
            return None;
        }
        let [a, b, c, d] = self.base.mesh.corners(t).map(|v| self.point(v));
        circumcenter3(a, b, c, d)
    }

    /// The finite facets, each from one of its two sides; of coplanar points the triangles.
    #[doc(alias = "finite_facets")]
    pub fn facets(&self) -> impl Iterator<Item = FacetId> + '_ {
        self.base.facets()
    }

    /// The facets of the hull, counter-clockwise seen from outside; flat faces are cut into triangles, as the
    /// triangulation has them. Coplanar points have each triangle once, seen from either side; less than a plane has
    /// none.
    ///
    /// ```
    /// use delone::Delaunay3;
    ///
    /// let cube: Vec<[i32; 3]> = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).collect();
    /// let d = Delaunay3::from_points(&cube)?;
    /// assert_eq!(d.hull_facets().count(), 12); // two triangles on each side
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "convex_hull")]
    pub fn hull_facets(&self) -> impl Iterator<Item = [VertexId; 3]> + '_ {
        self.base.hull_facets()
    }

    /// The vertices on the hull by increasing index: the corners of [`Self::hull_facets`], so none of less than a plane.
    ///
    /// ```
    /// use delone::Delaunay3;
    ///
    /// let cube: Vec<[i32; 3]> = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).collect();
    /// let mut d = Delaunay3::from_points(&cube)?;
    /// d.insert([0.5, 0.5, 0.5])?;
    /// assert_eq!(d.hull_vertices().count(), 8);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "convex_hull")]
    pub fn hull_vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        let mut corners: Vec<VertexId> = self.hull_facets().flatten().collect();
        corners.sort_unstable();
        corners.dedup();
        corners.into_iter()
    }

    /// The edges, each once, of whatever the points span.
    ///
    /// ```
    /// use delone::Delaunay3;
    ///
    /// let d = Delaunay3::from_points(&[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])?;
    /// assert_eq!(d.edges().count(), 6);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "finite_edges")]
    pub fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.base.edges()
    }

    /// The vertices joined to a vertex by an edge; none for an id that is no vertex.
    ///
    /// ```
    /// use delone::Delaunay3;
    ///
    /// let cube: Vec<[i32; 3]> = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).collect();
    /// let mut d = Delaunay3::from_points(&cube)?;
    /// let middle = d.insert([0.5, 0.5, 0.5])?.vertex();
    /// assert_eq!(d.neighbors(middle).count(), 8);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("neighbours", "adjacent_vertices", "vertex_neighbor_vertices"))]
    pub fn neighbors(&self, v: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        let joined = self.base.mesh.place(v).map(|p| self.neighbors_of(p, &mut Vec::new()));
        joined.unwrap_or_default().into_iter().map(|p| self.base.mesh.name(p))
    }

    /// The tetrahedra at a vertex, ghosts included, in no special order; none for an id that is no vertex, and below
    /// space.
    ///
    /// ```
    /// use delone::Delaunay3;
    ///
    /// let cube: Vec<[i32; 3]> = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).collect();
    /// let mut d = Delaunay3::from_points(&cube)?;
    /// let middle = d.insert([0.5, 0.5, 0.5])?.vertex();
    /// assert_eq!(d.tetrahedra_at(middle).len(), d.tetrahedron_count()); // it is in all of them
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "incident_cells")]
    pub fn tetrahedra_at(&self, v: VertexId) -> Vec<TetrahedronId> {
        let mut star = Vec::new();
        if let Some(place) = self.base.mesh.place(v).filter(|_| self.dimension() == Dimension::Space) {
            self.base.mesh.star(place, &mut star);
        }
        star
    }

    pub(super) fn neighbors_of(&self, p: Place, star: &mut Vec<TetrahedronId>) -> Vec<Place> {
        self.base.joined_to(p, star)
    }
}

/// The result, or the error that there would be too many tetrahedra.
fn with_room<T>(built: Option<T>) -> Result<T, Error> {
    built.ok_or(Error::TooManyTetrahedra { most: MAX_TETRAHEDRA })
}
