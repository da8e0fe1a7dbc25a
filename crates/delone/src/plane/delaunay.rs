//! The Delaunay triangulation of the plane: a layer, with names and a strategy of location.

use std::sync::OnceLock;

use delone_predicates::circumcenter;

use super::change::Upkeep;
use super::construct::{self, Algorithm2, Built, InOrder};
#[cfg(feature = "histories")]
use super::histories;
use super::layer::Layer;
use super::locator::Locator;
use crate::duplicates::Duplicates;
use crate::error::Error;
use crate::ids::{Duplicate, EdgeId, MAX_POINTS, Place, TriangleId, VertexId};
use crate::locate::Locate;
use crate::mesh::{Dimension, Mesh2, Names};
use crate::order::random::SplitMix;
use crate::parallel;
use crate::points::{Position2, check_count, check_finite};
use crate::tally::{Counters, Work};

/// The Delaunay triangulation of a set of points in the plane.
///
/// It is a function of the set of points alone: four cocircular points always get the same diagonal (see
/// [`delone_predicates::in_circle`]), whatever the order of the points and the algorithm. A vertex is known by
/// the index of its point: first those given in bulk, then those inserted, in their order. Vertices can be inserted,
/// removed and moved at any time, and what is left is the triangulation of what is left. Sets that span less than
/// the plane (no point, one point, collinear points) are valid triangulations without triangles.
///
/// The combinatorial questions (neighbors, stars, hull) are answered by [`Delaunay2::mesh`].
///
/// ```
/// use delone::Delaunay2;
///
/// let triangulation = Delaunay2::from_points(&[[0.0, 0.0], [2.0, 0.0], [1.0, 2.0], [1.0, 0.7]])?;
/// assert_eq!(triangulation.triangles().count(), 3);
/// assert_eq!(triangulation.hull_vertices().map(|v| v.index()).count(), 3);
/// for [a, b, c] in triangulation.triangles() {
///     println!("{} {} {}", a.index(), b.index(), c.index()); // counter-clockwise
/// }
/// # Ok::<(), delone::Error>(())
/// ```
#[doc(alias("DelaunayTriangulation", "Delaunay_triangulation_2"))]
#[derive(Clone, Debug)]
pub struct Delaunay2 {
    pub(super) base: Layer,
    /// The coordinates by id; until the first change these are those by place.
    pub(super) named: Option<Vec<[f64; 2]>>,
    pub(super) duplicates: Duplicates,
    pub(super) counters: Counters,
    pub(super) locate: Locate,
    /// The structure of the strategy, once it was needed.
    pub(super) locator: OnceLock<Locator>,
    pub(super) upkeep: Upkeep,
}

impl Default for Delaunay2 {
    fn default() -> Self {
        Self::new()
    }
}

impl Delaunay2 {
    /// The triangulation of no points.
    pub fn new() -> Self {
        Self::assemble(construct::incremental(Vec::new(), 0))
    }

    /// The triangulation of no points, with a strategy of location.
    ///
    /// # Errors
    /// [`Error::Parameter`] names a parameter that is out of range.
    pub fn with_strategy(locate: Locate) -> Result<Self, Error> {
        let mut triangulation = Self::new();
        triangulation.set_strategy(locate)?;
        Ok(triangulation)
    }

    /// Triangulates points with the default algorithm.
    ///
    /// O(n log n) in the worst case for coordinates of few magnitudes (see [`Algorithm2`]); about 100 bytes a point above the input.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate; [`Error::TooManyPoints`] is returned
    /// beyond [`MAX_POINTS`].
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [2, 0], [0, 2], [2, 2], [2, 0]])?; // the last one equals the second
    /// assert_eq!((d.vertex_count(), d.triangle_count()), (4, 2));
    /// assert!(Delaunay2::from_points(&[[0.0, f64::NAN]]).is_err());
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "bulk_load")]
    pub fn from_points<P: Position2>(points: &[P]) -> Result<Self, Error> {
        check_count(points.len(), MAX_POINTS)?;
        Self::divided(parallel::collect(points.len(), |i| points[i].xy()))
    }

    /// Triangulates points with an algorithm of choice. Errors as [`Self::from_points`], and
    /// [`Error::Parameter`] for a strategy whose parameters are out of range.
    ///
    /// ```
    /// use delone::{Algorithm2, Delaunay2};
    ///
    /// let points = [[0, 0], [3, 1], [1, 3], [2, 2], [4, 4]];
    /// let mut edges = Vec::new();
    /// for algorithm in [Algorithm2::DivideAndConquer, Algorithm2::Incremental { seed: 1 }] {
    ///     let mut of_this: Vec<_> = Delaunay2::with_algorithm(&points, algorithm)?.edges().collect();
    ///     of_this.iter_mut().for_each(|edge| edge.sort());
    ///     of_this.sort();
    ///     edges.push(of_this);
    /// }
    /// assert_eq!(edges[0], edges[1]); // the same triangulation
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn with_algorithm<P: Position2>(points: &[P], algorithm: Algorithm2) -> Result<Self, Error> {
        check_count(points.len(), MAX_POINTS)?;
        Self::build(parallel::collect(points.len(), |i| points[i].xy()), algorithm)
    }

    /// Triangulates coordinates that it may keep, which saves a copy.
    ///
    /// # Errors
    /// As [`Self::from_points`].
    pub fn from_vec(points: Vec<[f64; 2]>) -> Result<Self, Error> {
        check_count(points.len(), MAX_POINTS)?;
        Self::divided(points)
    }

    /// By the default algorithm alone, so that programs that know no other do not contain them.
    fn divided(points: Vec<[f64; 2]>) -> Result<Self, Error> {
        Ok(Self::assemble(construct::divide_and_conquer(points)?))
    }

    /// Triangulates points, and numbers those that differ along a curve: what is near in the plane is near in memory, so whoever
    /// goes through all triangles meets what belongs to their corners (heights, say) nearly in order. Says for each vertex which
    /// point it is, of equal ones the first. O(n log n).
    ///
    /// # Errors
    /// As [`Self::from_points`].
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let points = [[5.0, 0.0], [0.0, 0.0], [5.0, 0.0], [4.0, 1.0], [1.0, 3.0]];
    /// let (triangulation, order) = Delaunay2::along_curve(&points)?;
    /// assert_eq!((triangulation.points().len(), order.len()), (4, 4));
    /// assert!(triangulation.vertices().all(|v| triangulation.point(v) == points[order[v.index()] as usize]));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn along_curve<P: Position2>(points: &[P]) -> Result<(Self, Vec<u32>), Error> {
        check_count(points.len(), MAX_POINTS)?;
        let points = P::all(points);
        check_finite(points.iter().copied())?;
        let (built, order) = construct::in_order(&points).distinct();
        Ok((Self::assemble(built), order))
    }

    fn build(points: Vec<[f64; 2]>, algorithm: Algorithm2) -> Result<Self, Error> {
        if algorithm != Algorithm2::DivideAndConquer {
            check_finite(points.iter().copied())?;
        }
        Ok(Self::assemble(match algorithm {
            Algorithm2::DivideAndConquer => return Self::divided(points),
            Algorithm2::Incremental { seed } => construct::incremental(points, seed),
            #[cfg(feature = "histories")]
            Algorithm2::ConflictLists { seed } => histories::by_conflict_lists(points, seed),
            #[cfg(not(feature = "histories"))]
            Algorithm2::ConflictLists { seed } => construct::incremental(points, seed),
            Algorithm2::Located { locate, seed } => return Self::located(points, locate, seed),
        }))
    }

    /// Inserts points one by one in random order.
    fn located(points: Vec<[f64; 2]>, locate: Locate, seed: u64) -> Result<Self, Error> {
        #[cfg(feature = "histories")]
        if locate == Locate::History {
            let (built, histories) = histories::by_history(points, seed);
            let locator = OnceLock::from(Locator::Histories(Box::new(histories)));
            return Ok(Self { locate, locator, ..Self::assemble(built) });
        }
        let mut triangulation = Self::with_strategy(locate)?;
        let mut order: Vec<u32> = (0..points.len() as u32).collect();
        SplitMix(seed).shuffle(&mut order);
        let mut work = Work::default();
        triangulation.extend_in_order(&points, &order, true, &mut work)?;
        triangulation.counters = Counters::Incremental(work);
        Ok(triangulation)
    }

    pub(super) fn assemble(built: Built) -> Self {
        let Built { points, mesh, duplicates, counters } = built;
        let mut upkeep = Upkeep::default();
        upkeep.renew(mesh.vertex_count());
        let base = Layer::new(mesh, points);
        Self {
            base,
            named: None,
            duplicates: Duplicates::new(duplicates),
            counters,
            locate: Locate::default(),
            locator: OnceLock::new(),
            upkeep,
        }
    }

    /// The topology: vertices, edges, triangles, stars, hull.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [2, 0], [0, 2], [2, 2]])?;
    /// let t = d.triangle_ids().next().expect("there are two");
    /// let beside = d.mesh().adjacent(t); // some of them ghosts, beyond the hull
    /// assert_eq!(beside.iter().filter(|&&t| !d.mesh().is_ghost(t)).count(), 1);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn mesh(&self) -> &Mesh2 {
        &self.base.mesh
    }

    /// The coordinates of all points ever given, by id: vertices, duplicates, and those since removed.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let mut d = Delaunay2::from_points(&[[0, 0], [1, 0]])?;
    /// let v = d.insert([0, 1])?.vertex();
    /// assert_eq!(d.points(), [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    /// assert_eq!(d.points()[v.index()], d.point(v));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn points(&self) -> &[[f64; 2]] {
        self.named.as_deref().unwrap_or(&self.base.points)
    }

    /// The points that equal an earlier one which is a vertex, by increasing index.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[5, 5], [1, 0], [5, 5]])?;
    /// let pairs: Vec<_> = d.duplicates().map(|same| (same.point, same.vertex.index())).collect();
    /// assert_eq!(pairs, [(2, 0)]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "coplanar")]
    pub fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_ {
        self.duplicates.iter(|v| self.mesh().contains(v))
    }

    /// Counters of the construction.
    pub fn counters(&self) -> Counters {
        self.counters
    }

    /// The dimension of the span of the points.
    ///
    /// ```
    /// use delone::{Delaunay2, Dimension};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [1, 1], [2, 2]])?;
    /// assert_eq!((d.dimension(), d.triangle_count(), d.edges().count()), (Dimension::Line, 0, 2));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn dimension(&self) -> Dimension {
        self.mesh().dimension()
    }

    /// The number of vertices: points without duplicates.
    pub fn vertex_count(&self) -> usize {
        self.mesh().vertex_count()
    }

    /// The vertices, by increasing index.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let mut d = Delaunay2::from_points(&[[0, 0], [4, 0], [0, 4]])?;
    /// d.remove(delone::VertexId::new(0))?;
    /// assert_eq!(d.vertices().map(|v| v.index()).collect::<Vec<_>>(), [1, 2]); // ids stay as they are
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.mesh().vertices()
    }

    /// The finite triangles as corners in counter-clockwise order.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [0, 4]])?;
    /// let [corners] = d.triangles().collect::<Vec<_>>()[..] else { panic!("one") };
    /// let mut indices = corners.map(|v| v.index()); // counter-clockwise, from any corner on
    /// indices.sort();
    /// assert_eq!(indices, [0, 1, 2]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("simplices", "finite_faces", "inner_faces"))]
    pub fn triangles(&self) -> impl Iterator<Item = [VertexId; 3]> + '_ {
        self.mesh().triangles().map(|t| self.mesh().corners(t))
    }

    /// The finite triangles, by id.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]])?;
    /// assert_eq!(d.triangle_ids().map(|t| d.area(t)).sum::<f64>(), 16.0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn triangle_ids(&self) -> impl Iterator<Item = TriangleId> + '_ {
        self.mesh().triangles()
    }

    /// The number of finite triangles. O(h) for a hull of h vertices.
    pub fn triangle_count(&self) -> usize {
        match self.dimension() {
            Dimension::Plane => self.mesh().triangle_count() - self.mesh().hull().count(),
            _ => 0,
        }
    }

    /// The finite edges, each once.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [3, 0], [0, 4]])?;
    /// let lengths = d.edges().map(|[a, b]| {
    ///     let ([x0, y0], [x1, y1]) = (d.point(a), d.point(b));
    ///     (x1 - x0).hypot(y1 - y0)
    /// });
    /// assert_eq!(lengths.sum::<f64>(), 12.0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("finite_edges", "undirected_edges"))]
    pub fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.mesh().undirected_edges().map(|e| [self.mesh().origin(e), self.mesh().destination(e)])
    }

    /// The vertices joined to a vertex by an edge, counter-clockwise; none for an id that is no vertex.
    ///
    /// ```
    /// use delone::{Delaunay2, VertexId};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]])?;
    /// assert_eq!(d.neighbors(VertexId::new(4)).count(), 4); // of the one in the middle
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("neighbours", "incident_vertices", "vertex_neighbor_vertices"))]
    pub fn neighbors(&self, v: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        self.mesh().neighbors(v)
    }

    /// The vertices of the hull, counter-clockwise; of a line those from end to end; see [`Mesh2::hull`].
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]])?;
    /// let mut hull: Vec<_> = d.hull_vertices().map(|v| v.index()).collect();
    /// let least = hull.iter().position(|&v| v == 0).expect("a corner");
    /// hull.rotate_left(least);
    /// assert_eq!(hull, [0, 1, 2, 3]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "convex_hull")]
    pub fn hull_vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.mesh().hull()
    }

    /// The edges of the hull, counter-clockwise; none below the plane.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]])?;
    /// let length = |[a, b]: [delone::VertexId; 2]| {
    ///     let ([x0, y0], [x1, y1]) = (d.point(a), d.point(b));
    ///     (x1 - x0).hypot(y1 - y0)
    /// };
    /// assert_eq!(d.hull_facets().map(length).sum::<f64>(), 16.0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("convex_hull", "hull_edges"))]
    pub fn hull_facets(&self) -> impl Iterator<Item = [VertexId; 2]> + Send + '_ {
        self.mesh().hull_facets()
    }

    /// The coordinates of a vertex.
    ///
    /// # Panics
    /// For an id that is no vertex.
    #[inline]
    pub fn point(&self, v: VertexId) -> [f64; 2] {
        let place = self.mesh().place(v).expect("a vertex");
        self.base.points[place.index()]
    }

    /// The coordinates of the ends of a finite edge.
    pub fn segment(&self, e: EdgeId) -> [[f64; 2]; 2] {
        [self.mesh().origin(e), self.mesh().destination(e)].map(|v| self.point(v))
    }

    /// The area of a finite triangle, zero for a ghost; positive up to rounding, infinite if it is too large for an `f64`,
    /// and never NaN. In coordinate units squared.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [0, 3]])?;
    /// assert_eq!(d.triangle_ids().map(|t| d.area(t)).collect::<Vec<_>>(), [6.0]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn area(&self, t: TriangleId) -> f64 {
        if self.mesh().is_ghost(t) {
            return 0.0;
        }
        let corners = self.mesh().corners(t).map(|v| self.point(v));
        let twice = |[a, b, c]: [[f64; 2]; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let area = twice(corners) / 2.0;
        if area.is_finite() {
            return area;
        }
        // Products that overflow may cancel: large coordinates are made small, axis by axis, and the area large again.
        let scale = [0, 1].map(|axis| {
            let is_large = corners.iter().any(|p| p[axis].abs() > 2f64.powi(500));
            if is_large { 2f64.powi(-520) } else { 1.0 }
        });
        twice(corners.map(|p| [p[0] * scale[0], p[1] * scale[1]])) / 2.0 / scale[0] / scale[1]
    }

    /// The center of the circle through the corners of a finite triangle, correctly rounded (see
    /// [`delone_predicates::circumcenter`]), in coordinate units. `None` for a ghost, and where it is too far away for `f64`. O(1).
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [0, 2]])?;
    /// let t = d.triangle_ids().next().expect("one");
    /// assert_eq!(d.circumcenter(t), Some([2.0, 1.0]));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("circumcentre", "dual"))]
    pub fn circumcenter(&self, t: TriangleId) -> Option<[f64; 2]> {
        if self.mesh().is_ghost(t) {
            return None;
        }
        let [a, b, c] = self.mesh().corners(t).map(|v| self.point(v));
        circumcenter(a, b, c)
    }

    /// Becomes the triangulation of other points, with vertices at places along a curve.
    pub(super) fn rebuild(&mut self, positions: Vec<[f64; 2]>) {
        let InOrder { mut mesh, points, indices, duplicates, .. } = construct::in_order(&positions);
        let mut names = Names::default();
        names.reserve(positions.len());
        indices.iter().enumerate().for_each(|(k, &i)| names.bind(VertexId::new(i as usize), Place::new(k)));
        mesh.names = Some(names);
        self.base = Layer::new(mesh, points);
        self.duplicates = Duplicates::new(duplicates);
        self.named = Some(positions);
        self.locator.take();
        self.upkeep.renew(self.vertex_count());
    }
}

#[cfg(test)]
impl Delaunay2 {
    /// For tests that change what no operation does.
    pub(crate) fn mesh_mut(&mut self) -> &mut Mesh2 {
        &mut self.base.mesh
    }

    /// Moves everything to other places, as changes do in the long run.
    pub(crate) fn lay_out(&mut self) {
        self.rearrange_now(crate::mesh::triangles::Room::Much);
    }
}
