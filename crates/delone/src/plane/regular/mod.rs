//! Regular triangulations of the plane: Delaunay triangulations of points with weights, the duals of power diagrams.
//!
//! A site (p, w) has at x the power |x - p|^2 - w: a weight is the square of a radius, and may be negative. Lifted to |p|^2 - w,
//! the sites that are corners of the lower hull are the vertices, and its facets the triangles: a site is a vertex if and only
//! if its closed power cell is not empty. The others are *hidden*. Ties are broken as for Delaunay triangulations, by raising sites
//! in the lexicographic order of their points, which never hides one: the triangulation is a function of the set of sites.
//!
//! Sources: Aurenhammer, "Power diagrams: properties, algorithms and applications", SIAM J. Comput. 1987; Edelsbrunner & Shah,
//! "Incremental topological flipping works for regular triangulations", Algorithmica 1996; Devillers & Teillaud, "Perturbations
//! for Delaunay and weighted Delaunay 3D triangulations", CGTA 2011.

mod areas;
mod build;
mod change;
mod check;
mod nearest;
mod power;
mod reweigh;
mod settle;
mod triangulation;

use std::sync::OnceLock;

use crate::error::Error;
use crate::hidden::HiddenSites;
use crate::ids::{Duplicate, EdgeId, MAX_POINTS, Place, TriangleId, VertexId};
use crate::locate::tree::Tree;
use crate::locate::{Start, Strategy};
use crate::mesh::{Dimension, Mesh2};
use crate::plane::layer::Layer;
use crate::plane::layer::insert::Spot;
use crate::plane::layer::kernel::Power;
use crate::plane::locate::Location2;
use crate::points::{Position2, check_count, check_finite, check_weights, finite};
use crate::tally::{Counters, Work};
pub use areas::Prescribed2;
pub use power::{Jacobian2, Power2};

/// The regular triangulation of sites with weights in the plane. See the [crate's words](crate#names) for what it has in common with
/// [`crate::Delaunay2`].
///
/// Of sites at one point only the heaviest can be a vertex; of equal ones the first given is, and the others are its
/// duplicates. With equal weights it is the Delaunay triangulation.
///
/// Cost: O(n log n) expected; 24 bytes a site, 36 a vertex more.
///
/// ```
/// use delone::Regular2;
///
/// // Four disks around a fifth, which they leave nothing.
/// let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]].map(|p| (p, 9.0));
/// let mut sites = corners.to_vec();
/// sites.push(([2.0, 2.0], 0.5));
/// let mut r = Regular2::from_sites(&sites)?;
/// assert_eq!(r.vertex_count(), 4);
/// assert!(r.hidden().map(|v| v.index()).eq([4]));
///
/// // A larger disk is a vertex.
/// let v = r.hidden().next().expect("one");
/// r.set_weight(v, 3.0)?;
/// assert_eq!((r.vertex_count(), r.triangles().count()), (5, 4));
/// r.check()?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("Regular_triangulation_2", "weighted"))]
#[derive(Clone, Debug)]
pub struct Regular2 {
    base: Layer<Power>,
    hidden_sites: HiddenSites<TriangleId>,
    counters: Counters,
    hints: OnceLock<Tree<EdgeId>>,
    /// The number of vertices when the hints were made.
    hinted: usize,
}

impl Default for Regular2 {
    fn default() -> Self {
        Self {
            base: Layer::default(),
            hidden_sites: HiddenSites::default(),
            counters: Counters::Incremental(Work::default()),
            hints: OnceLock::new(),
            hinted: 0,
        }
    }
}

impl Regular2 {
    /// No site yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Triangulates points with weights, squared radii in the units of the coordinates: by divide and conquer, on all threads of the
    /// current pool. O(n log n) in the worst case.
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::Weight`] for numbers that are not finite, by index; [`Error::TooManyPoints`].
    ///
    /// ```
    /// use delone::Regular2;
    ///
    /// let r = Regular2::from_sites(&[([0, 0], 9.0), ([4, 0], 9.0), ([0, 4], 9.0), ([1, 1], 0.0)])?;
    /// assert_eq!(r.vertex_count(), 3); // large circles hide the small one among them
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn from_sites<P: Position2>(sites: &[(P, f64)]) -> Result<Self, Error> {
        let (points, weights): (Vec<_>, Vec<_>) = sites.iter().map(|(p, w)| (p.xy(), *w)).unzip();
        Self::from_parts(&points, &weights)
    }

    /// Triangulates points and weights that are given apart.
    ///
    /// # Errors
    /// As [`Self::from_sites`], and [`Error::Length`] if there are more of one than of the other.
    ///
    /// ```
    /// use delone::Regular2;
    ///
    /// let r = Regular2::from_parts(&[[0, 0], [4, 0], [0, 4]], &[0.0, 4.0, 0.0])?;
    /// assert_eq!(r.site(delone::VertexId::new(1)), Some(([4.0, 0.0], 4.0)));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn from_parts<P: Position2>(points: &[P], weights: &[f64]) -> Result<Self, Error> {
        Self::check_input(points, weights)?;
        Ok(build::divide_and_conquer(&P::all(points), weights))
    }

    /// Triangulates by insertion one by one, in a random order from the seed. The order does not show in the triangles.
    /// O(n log n) expected.
    ///
    /// # Errors
    /// As [`Self::from_parts`].
    pub fn with_seed<P: Position2>(points: &[P], weights: &[f64], seed: u64) -> Result<Self, Error> {
        Self::check_input(points, weights)?;
        Ok(build::incremental(&P::all(points), weights, seed))
    }

    fn check_input<P: Position2>(points: &[P], weights: &[f64]) -> Result<(), Error> {
        if points.len() != weights.len() {
            return Err(Error::Length { expected: points.len(), found: weights.len() });
        }
        check_count(points.len(), MAX_POINTS)?;
        check_finite(points.iter().map(Position2::xy))?;
        check_weights(weights)
    }

    /// Counters of the construction.
    pub fn counters(&self) -> Counters {
        self.counters
    }

    /// The topology. Its vertices are those that are not hidden.
    pub fn mesh(&self) -> &Mesh2 {
        &self.base.mesh
    }

    /// The dimension of the span of the sites; hidden sites add nothing to it.
    pub fn dimension(&self) -> Dimension {
        self.mesh().dimension()
    }

    /// The number of sites ever given: one more than the largest id.
    pub fn ids_given(&self) -> usize {
        self.base.mesh.names.as_ref().map_or(0, crate::mesh::Names::given)
    }

    /// The number of sites that are vertices.
    pub fn vertex_count(&self) -> usize {
        self.mesh().vertex_count()
    }

    /// The sites that are vertices, by increasing id.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.mesh().vertices()
    }

    /// The sites whose power cells are empty, by increasing id; duplicates of vertices are not among them.
    ///
    /// ```
    /// use delone::Regular2;
    ///
    /// let r = Regular2::from_sites(&[([0, 0], 9.0), ([4, 0], 9.0), ([0, 4], 9.0), ([1, 1], 0.0)])?;
    /// assert_eq!(r.hidden().map(|v| v.index()).collect::<Vec<_>>(), [3]);
    /// assert!(r.is_hidden(delone::VertexId::new(3)));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "hidden_vertices")]
    pub fn hidden(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.hidden_sites.hidden()
    }

    /// Whether a site is hidden.
    pub fn is_hidden(&self, v: VertexId) -> bool {
        self.hidden_sites.is_hidden(v)
    }

    /// Sites that equal a vertex given earlier, their weights too, by increasing id.
    pub fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_ {
        self.hidden_sites.duplicates()
    }

    /// Point and weight of a site, hidden or not; none if it was removed or never given.
    pub fn site(&self, v: VertexId) -> Option<([f64; 2], f64)> {
        self.place(v).map(|place| self.base.site(place))
    }

    fn place(&self, v: VertexId) -> Option<Place> {
        self.mesh().place(v).or_else(|| self.hidden_sites.place(v))
    }

    /// The corners of all triangles, counter-clockwise.
    pub fn triangles(&self) -> impl Iterator<Item = [VertexId; 3]> + '_ {
        self.mesh().triangles().map(|t| self.mesh().corners(t))
    }

    /// The finite triangles.
    pub fn triangle_ids(&self) -> impl Iterator<Item = TriangleId> + '_ {
        self.mesh().triangles()
    }

    /// The point that has the same power to the corners of a finite triangle, correctly rounded: a corner of the power diagram, as
    /// [`Power2::vertex`]. With equal weights the circumcenter. `None` for a ghost, and where it is too far away for `f64`. O(1).
    ///
    /// ```
    /// use delone::Regular2;
    ///
    /// let r = Regular2::from_sites(&[([0, 0], 0.0), ([4, 0], 8.0), ([0, 4], 0.0)])?;
    /// let t = r.triangle_ids().next().expect("one");
    /// assert_eq!(r.power_center(t), Some([1.0, 2.0]));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("weighted_circumcenter", "circumcenter", "dual"))]
    pub fn power_center(&self, t: TriangleId) -> Option<[f64; 2]> {
        self.power().vertex(t)
    }

    /// All edges, each once.
    pub fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.mesh().undirected_edges().map(|e| [self.mesh().origin(e), self.mesh().destination(e)])
    }

    /// Finds where a point falls among the triangles. Exact. O(log n) on average on evenly spread sites.
    ///
    /// # Errors
    /// [`Error::Coordinate`] if a coordinate is not finite.
    pub fn locate<P: Position2>(&self, q: P) -> Result<Location2, Error> {
        let q = finite(q.xy())?;
        Ok(self.base.classify(self.spot(q).0, q))
    }

    fn spot(&self, q: [f64; 2]) -> (Spot, usize) {
        let start = if self.base.spanned {
            self.hints.get_or_init(|| Tree::build(&self.base)).start(&self.base, q, &mut ())
        } else {
            Start::Anywhere
        };
        self.base.spot(start, q, &mut ())
    }
}
