//! Delaunay triangulations of the plane.

pub mod build;
mod cavity;
mod change;
pub mod check;
mod flips;
mod furthest;
mod hints;
mod hull;
mod insert;
mod layer;
mod line;
mod locate;
mod locator;
mod moving;
mod nearest;
mod position;
mod radial;
mod rectangle;
mod remove;
pub mod verify;
mod voronoi;

pub use build::{Algorithm, Counters};
pub use furthest::{EnclosingCircle, Furthest2};
pub use hints::Hints2;
pub use hull::convex_hull;
pub use locate::Location;
pub use locator::Footprint;
pub use moving::{Moving2, Step};
pub use position::Position2;
pub use radial::NearestSites;
pub use voronoi::{Cells, Region, Relaxation, Ring, Voronoi2, VoronoiEdge};

use std::sync::OnceLock;

use delone_predicates::circumcentre;

use crate::error::{self, Error, check_finite};
use crate::ids::{Duplicate, EdgeId, MAX_POINTS, Place, TriangleId, VertexId};
use crate::locate::Locate;
use crate::locate::tally::Work;
use crate::mesh::{Dimension, Mesh, Names};
use crate::order::random::SplitMix;
use crate::parallel;
use build::{Built, InOrder};
use change::Upkeep;
use layer::Layer;
use locator::Locator;

/// The Delaunay triangulation of a set of points in the plane.
///
/// It is a function of the set of points alone: four cocircular points always get the same diagonal (see
/// [`delone_predicates::in_circle`]), whatever the order of the points and the algorithm. A vertex is known by
/// the index of its point: first those given in bulk, then those inserted, in their order. Vertices can be inserted,
/// removed and moved at any time, and what is left is the triangulation of what is left. Sets that span less than
/// the plane (no point, one point, collinear points) are valid triangulations without triangles.
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
    base: Layer,
    /// The coordinates by id; until the first change these are those by place.
    named: Option<Vec<[f64; 2]>>,
    /// Points reported as equal to a vertex, sorted; some may be out of date.
    duplicates: Vec<Duplicate>,
    counters: Counters,
    locate: Locate,
    /// The structure of the strategy, once it was needed.
    locator: OnceLock<Locator>,
    upkeep: Upkeep,
}

impl Default for Delaunay2 {
    fn default() -> Self {
        Self::new()
    }
}

impl Delaunay2 {
    /// The triangulation of no points.
    pub fn new() -> Self {
        Self::assemble(build::incremental(Vec::new(), 0))
    }

    /// The same with a strategy of location.
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
    /// O(n log n) in the worst case; about 100 bytes a point above the input.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate; [`Error::TooManyPoints`] is returned
    /// beyond [`MAX_POINTS`].
    pub fn from_points<P: Position2>(points: &[P]) -> Result<Self, Error> {
        Self::with_algorithm(points, Algorithm::default())
    }

    /// Triangulates points with an algorithm of choice. Errors as [`Self::from_points`], and
    /// [`Error::Parameter`] for a strategy whose parameters are out of range.
    pub fn with_algorithm<P: Position2>(points: &[P], algorithm: Algorithm) -> Result<Self, Error> {
        check_count(points.len())?;
        Self::from_vec(parallel::collect(points.len(), |i| points[i].xy()), algorithm)
    }

    /// The same for coordinates that can be kept, which saves a copy. Errors as [`Self::with_algorithm`].
    pub fn from_vec(points: Vec<[f64; 2]>, algorithm: Algorithm) -> Result<Self, Error> {
        check_count(points.len())?;
        if algorithm != Algorithm::DivideAndConquer {
            check_finite(points.iter().copied())?;
        }
        Ok(Self::assemble(match algorithm {
            Algorithm::DivideAndConquer => build::divide_and_conquer(points)?,
            Algorithm::Incremental { seed } => build::incremental(points, seed),
            Algorithm::ConflictLists { seed } => build::conflict_lists(points, seed),
            Algorithm::Located { locate, seed } => return Self::located(&points, locate, seed),
        }))
    }

    /// Inserts points one by one in random order.
    fn located(points: &[[f64; 2]], locate: Locate, seed: u64) -> Result<Self, Error> {
        let mut triangulation = Self::with_strategy(locate)?;
        let mut order: Vec<u32> = (0..points.len() as u32).collect();
        SplitMix(seed).shuffle(&mut order);
        let mut work = Work::default();
        triangulation.extend_in_order(points, &order, true, &mut work)?;
        triangulation.counters = Counters::Incremental(work);
        Ok(triangulation)
    }

    fn assemble(built: Built) -> Self {
        let Built { points, mesh, duplicates, counters } = built;
        let mut upkeep = Upkeep::default();
        upkeep.renew(mesh.vertex_count());
        let base = Layer::new(mesh, points);
        Self {
            base,
            named: None,
            duplicates,
            counters,
            locate: Locate::default(),
            locator: OnceLock::new(),
            upkeep,
        }
    }

    /// The topology: vertices, edges, triangles, stars, hull.
    pub fn mesh(&self) -> &Mesh {
        &self.base.mesh
    }

    /// The coordinates of all points ever given, by id: vertices, duplicates, and those since removed.
    pub fn points(&self) -> &[[f64; 2]] {
        self.named.as_deref().unwrap_or(&self.base.points)
    }

    /// The points that equal an earlier one which is a vertex, by increasing index.
    pub fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_ {
        let points = self.points();
        let valid =
            |d: &&Duplicate| self.mesh().contains(d.vertex) && points[d.point] == points[d.vertex.index()];
        self.duplicates.iter().filter(move |d| self.named.is_none() || valid(d)).copied()
    }

    /// What the construction did.
    pub fn counters(&self) -> Counters {
        self.counters
    }

    /// What the points span.
    pub fn dimension(&self) -> Dimension {
        self.mesh().dimension()
    }

    /// The number of vertices: points without duplicates.
    pub fn vertex_count(&self) -> usize {
        self.mesh().vertex_count()
    }

    /// The vertices, by increasing index.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.mesh().vertices()
    }

    /// The finite triangles as corners in counter-clockwise order.
    pub fn triangles(&self) -> impl Iterator<Item = [VertexId; 3]> + '_ {
        self.mesh().triangles().map(|t| self.mesh().corners(t))
    }

    /// The number of finite triangles. O(h) for a hull of h vertices.
    pub fn triangle_count(&self) -> usize {
        match self.dimension() {
            Dimension::Plane => self.mesh().triangle_count() - self.hull().count(),
            _ => 0,
        }
    }

    /// The finite edges, each once.
    pub fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.mesh().undirected_edges().map(|e| [self.mesh().origin(e), self.mesh().destination(e)])
    }

    /// The vertices of the hull, counter-clockwise; see [`Mesh::hull`].
    pub fn hull(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.mesh().hull()
    }

    /// The coordinates of a vertex.
    ///
    /// # Panics
    /// For the ghost vertex and for a vertex of another, larger triangulation.
    #[inline]
    pub fn point(&self, v: VertexId) -> [f64; 2] {
        self.points()[v.index()]
    }

    /// The coordinates of the ends of a finite edge.
    pub fn segment(&self, e: EdgeId) -> [[f64; 2]; 2] {
        [self.mesh().origin(e), self.mesh().destination(e)].map(|v| self.point(v))
    }

    /// The area of a finite triangle, zero for a ghost; positive up to rounding, infinite if it is too large for an `f64`,
    /// and never NaN. In coordinate units squared.
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

    /// The centre of the circle through the corners of a finite triangle, rounded (see
    /// [`delone_predicates::circumcentre`]); `None` for a ghost, and where it is too far away for `f64`.
    pub fn circumcentre(&self, t: TriangleId) -> Option<[f64; 2]> {
        if self.mesh().is_ghost(t) {
            return None;
        }
        let [a, b, c] = self.mesh().corners(t).map(|v| self.point(v));
        circumcentre(a, b, c)
    }

    /// Becomes the triangulation of other points, with vertices at places along a curve.
    fn rebuild(&mut self, positions: Vec<[f64; 2]>) {
        let InOrder { mut mesh, points, indices, duplicates } = build::in_order(&positions);
        let mut names = Names::default();
        names.reserve(positions.len());
        indices.iter().enumerate().for_each(|(k, &i)| names.bind(VertexId::new(i as usize), Place::new(k)));
        mesh.names = Some(names);
        self.base = Layer::new(mesh, points);
        self.duplicates = duplicates;
        self.named = Some(positions);
        self.locator.take();
        self.upkeep.renew(self.vertex_count());
    }
}

fn check_count(count: usize) -> Result<(), Error> {
    error::check_count(count, MAX_POINTS)
}

/// The coordinates of a point, if they are finite.
#[inline]
fn finite<P: Position2>(point: &P) -> Result<[f64; 2], Error> {
    error::finite(point.xy())
}
