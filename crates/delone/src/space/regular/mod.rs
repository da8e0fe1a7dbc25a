//! Regular triangulations of space: Delaunay triangulations of points with weights, the duals of power diagrams.
//!
//! The statements of `plane/regular` on triangles hold for tetrahedra: a site is a vertex if and only if its closed power cell is not
//! empty, and the triangulation is a function of the set of sites.
//!
//! Sources: Aurenhammer, "Power diagrams: properties, algorithms and applications", SIAM J. Comput. 1987; Edelsbrunner & Shah,
//! "Incremental topological flipping works for regular triangulations", Algorithmica 1996; Devillers & Teillaud, "Perturbations
//! for Delaunay and weighted Delaunay 3D triangulations", CGTA 2011.

pub(super) mod build;
mod change;
mod check;
mod nearest;
mod power;
mod triangulation;

pub use power::Power3;

use std::sync::OnceLock;

use delone_predicates::power_center3;

use super::layer::Layer;
use super::locate::Location3;
use crate::error::Error;
use crate::hidden::HiddenSites;
use crate::ids::{Duplicate, MAX_TETRAHEDRA, TetrahedronId, VertexId};
use crate::locate::tree::Tree;
use crate::locate::{Start, Strategy};
use crate::mesh::{Dimension, Mesh3};
use crate::points::{Position3, check_in_space, check_weights, finite};
use crate::tally::{Counters, Work};

/// The regular triangulation of sites with weights in space. See the [crate's words](crate#names) for what it has in common with
/// [`crate::Delaunay3`].
///
/// Of sites at one point only the heaviest can be a vertex; of equal ones the first given is, and the others are its
/// duplicates. With equal weights it is the Delaunay triangulation.
///
/// Cost: O(n log n) expected where the triangulation is of size O(n).
///
/// ```
/// use delone::Regular3;
///
/// let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
/// let mut sites: Vec<_> = corners.iter().map(|&p| (p, 12.0)).collect();
/// sites.push(([1.0, 1.0, 1.0], 0.5));
/// let mut r = Regular3::from_sites(&sites)?;
/// assert_eq!((r.vertex_count(), r.hidden().count()), (4, 1));
///
/// let v = r.hidden().next().expect("one");
/// r.set_weight(v, 11.0)?;
/// assert_eq!((r.vertex_count(), r.tetrahedra().count()), (5, 4));
/// r.check()?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("Regular_triangulation_3", "weighted"))]
#[derive(Clone, Debug, Default)]
pub struct Regular3 {
    base: Layer<f64>,
    hidden_sites: HiddenSites<TetrahedronId>,
    work: Work,
    hints: OnceLock<Tree<TetrahedronId>>,
    /// The number of vertices when the hints were made.
    hinted: usize,
}

impl Regular3 {
    /// No site yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Triangulates points with weights, squared radii in the units of the coordinates. O(n log n) expected where the triangulation
    /// is of size O(n).
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::Weight`] for numbers that are not finite, by index; [`Error::TooManyPoints`],
    /// [`Error::TooManyTetrahedra`].
    pub fn from_sites<P: Position3>(sites: &[(P, f64)]) -> Result<Self, Error> {
        let (points, weights): (Vec<_>, Vec<_>) = sites.iter().map(|(p, w)| (p.xyz(), *w)).unzip();
        Self::from_parts(&points, &weights)
    }

    /// Triangulates points and weights that are given apart.
    ///
    /// # Errors
    /// As [`Self::from_sites`], and [`Error::Length`] if there are more of one than of the other.
    pub fn from_parts<P: Position3>(points: &[P], weights: &[f64]) -> Result<Self, Error> {
        Self::with_seed(points, weights, 0)
    }

    /// Triangulates in a random order of insertion from the seed. The order does not show in the tetrahedra.
    ///
    /// # Errors
    /// As [`Self::from_parts`].
    pub fn with_seed<P: Position3>(points: &[P], weights: &[f64], seed: u64) -> Result<Self, Error> {
        check_parts(points, weights)?;
        with_room(build::build(&P::all(points), weights, seed))
    }

    /// Triangulates one by one in random order by bistellar flips, each site traced through all tetrahedra that ever were, as
    /// [`crate::Algorithm3::Flips`]: for study. What it did is in [`Self::counters`].
    ///
    /// # Errors
    /// As [`Self::from_parts`].
    pub fn by_flips<P: Position3>(points: &[P], weights: &[f64], seed: u64) -> Result<Self, Error> {
        check_parts(points, weights)?;
        with_room(build::by_flips(&P::all(points), weights, seed))
    }

    /// Counters of the construction.
    pub fn counters(&self) -> Counters {
        Counters::Incremental(self.work)
    }

    /// The topology. Its vertices are those that are not hidden.
    pub fn mesh(&self) -> &Mesh3 {
        &self.base.mesh
    }

    /// The dimension of the span of the sites; hidden sites add nothing to it.
    pub fn dimension(&self) -> Dimension {
        self.base.dimension()
    }

    /// The number of sites ever given: one more than the largest id.
    pub fn ids_given(&self) -> usize {
        self.base.mesh.names.given()
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
    pub fn site(&self, v: VertexId) -> Option<([f64; 3], f64)> {
        self.mesh().place(v).or_else(|| self.hidden_sites.place(v)).map(|place| self.base.site(place))
    }

    /// The finite tetrahedra, by id. None below space.
    pub fn tetrahedron_ids(&self) -> impl Iterator<Item = TetrahedronId> + '_ {
        self.base.tetrahedra()
    }

    /// The finite tetrahedra as corners in positive order: the first three are seen counter-clockwise from the fourth.
    pub fn tetrahedra(&self) -> impl Iterator<Item = [VertexId; 4]> + '_ {
        self.tetrahedron_ids().map(|t| self.base.mesh.corners(t))
    }

    /// The point that has the same power to the corners of a finite tetrahedron, correctly rounded (see
    /// [`delone_predicates::power_center3`]): a corner of the power diagram. With equal weights the circumcenter. `None` for a ghost, and
    /// where it is too far away for `f64`. O(1).
    ///
    /// ```
    /// use delone::Regular3;
    ///
    /// let r = Regular3::from_sites(&[([0, 0, 0], 0.0), ([4, 0, 0], 8.0), ([0, 4, 0], 0.0), ([0, 0, 4], 0.0)])?;
    /// let t = r.tetrahedron_ids().next().expect("one");
    /// assert_eq!(r.power_center(t), Some([1.0, 2.0, 2.0]));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("weighted_circumcenter", "circumcenter", "dual"))]
    pub fn power_center(&self, t: TetrahedronId) -> Option<[f64; 3]> {
        let mesh = &self.base.mesh;
        if mesh.is_ghost(t) {
            return None;
        }
        let [a, b, c, d] = mesh.cells[t.index()].corners.map(|p| self.base.site(p));
        power_center3(a, b, c, d)
    }

    /// The edges, each once, of whatever the sites span.
    pub fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.base.edges()
    }

    /// Finds where a point falls among the tetrahedra. Exact. O(log n) on average on evenly spread sites.
    ///
    /// # Errors
    /// [`Error::Coordinate`] if a coordinate is not finite.
    pub fn locate<P: Position3>(&self, q: P) -> Result<Location3, Error> {
        let q = finite(q.xyz())?;
        if !self.base.is_in_span(q) {
            return Ok(Location3::LowerDimensional(self.dimension()));
        }
        Ok(self.base.classify(self.cell_at(q), q, &mut ()))
    }

    /// The tetrahedra, to look at those that stand for what is missing below space.
    #[cfg(test)]
    pub(in crate::space) fn layer(&self) -> &Layer<f64> {
        &self.base
    }

    fn start(&self, q: [f64; 3]) -> Start<TetrahedronId> {
        self.hints.get_or_init(|| Tree::build(&self.base)).start(&self.base, q, &mut ())
    }

    /// The tetrahedron that a point of what is spanned is in or beside.
    fn cell_at(&self, q: [f64; 3]) -> TetrahedronId {
        self.base.walk(self.base.start_cell(self.start(q)), q, &mut ())
    }
}

/// Whether all is finite, and a weight is there for each point.
fn check_parts<P: Position3>(points: &[P], weights: &[f64]) -> Result<(), Error> {
    if points.len() != weights.len() {
        return Err(Error::Length { expected: points.len(), found: weights.len() });
    }
    check_in_space(points)?;
    check_weights(weights)
}

fn with_room(built: Option<Regular3>) -> Result<Regular3, Error> {
    built.ok_or(Error::TooManyTetrahedra { most: MAX_TETRAHEDRA })
}
