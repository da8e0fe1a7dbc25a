//! Delaunay triangulations of space.

mod arena;
mod build;
mod cavity;
mod change;
pub mod check;
mod ground;
mod hints;
mod hole;
mod layer;
mod locate;
mod locator;
mod moving;
mod nearest;
mod position;
mod remove;
mod scaffold;
pub mod verify;

pub use hints::Hints3;
pub use locate::Location3;
pub use moving::{Moving3, Step3};
pub use position::Position3;

use std::collections::BTreeSet;
use std::sync::OnceLock;

use crate::error::{self, Error};
use crate::ids::{Duplicate, FacetId, MAX_POINTS_IN_SPACE, MAX_TETRAHEDRA, Place, TetrahedronId, VertexId};
use crate::locate::Locate;
use crate::locate::tally::Work;
use crate::mesh::Dimension;
use crate::mesh::tetrahedra::Mesh3;
use layer::Layer;
use locator::Locator;

/// How to build a triangulation of space. The result is the same set of tetrahedra; only cost and numbering differ.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Algorithm3 {
    /// Biased randomized insertion along a Hilbert curve, each point located from the one before: the fastest.
    Spatial {
        /// Decides the rounds.
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
/// assert_eq!(triangulation.hull().count(), 6);
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Delaunay3 {
    base: Layer,
    /// Points reported as equal to a vertex, sorted; some may be out of date.
    duplicates: Vec<Duplicate>,
    /// Vertices that were moved away from their duplicates.
    moved: BTreeSet<VertexId>,
    work: Work,
    locate: Locate,
    /// The structure of the strategy, once it was needed.
    locator: OnceLock<Locator>,
    /// The number of vertices when hints were made.
    hinted: usize,
}

impl Delaunay3 {
    /// The triangulation of no points.
    pub fn new() -> Self {
        Self::default()
    }

    /// Triangulates points.
    ///
    /// O(n log n) expected where the result has O(n) tetrahedra, as for evenly spread points; in the worst case it has
    /// O(n^2). About 280 bytes a point above the input for evenly spread points.
    /// On all threads of rayon's pool where that pays; the result is the same to the bit.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate; [`Error::TooManyPoints`] is returned beyond
    /// [`MAX_POINTS_IN_SPACE`], [`Error::TooManyTetrahedra`] beyond 2^30 of these, which some sets of 66,000 points have.
    pub fn from_points<P: Position3>(points: &[P]) -> Result<Self, Error> {
        check_points(points)?;
        Ok(Self::assemble(with_room(build::triangulate(points, 0, &mut ()))?, Work::default()))
    }

    /// The same for coordinates that need not be kept, which takes 24 bytes a point less.
    ///
    /// # Errors
    /// As [`Self::from_points`].
    pub fn from_vec(points: Vec<[f64; 3]>) -> Result<Self, Error> {
        check_points(&points)?;
        let built = build::triangulate::<[f64; 3], _>(points, 0, &mut ());
        Ok(Self::assemble(with_room(built)?, Work::default()))
    }

    /// Triangulates points with an algorithm of choice, and counts what it does; see [`Self::work`].
    ///
    /// # Errors
    /// As [`Self::from_points`]; [`Error::Parameter`] and [`Error::OnlyInThePlane`] as in [`Self::set_strategy`].
    pub fn with_algorithm<P: Position3>(points: &[P], algorithm: Algorithm3) -> Result<Self, Error> {
        check_points(points)?;
        let mut work = Work::default();
        match algorithm {
            Algorithm3::Spatial { seed } => {
                let built = build::triangulate(points, seed, &mut work);
                Ok(Self::assemble(with_room(built)?, work))
            }
            Algorithm3::Located { locate, seed } => {
                let mut d = Self::new();
                d.set_strategy(locate)?;
                d.extend_shuffled(points, seed, &mut work)?;
                d.work = work;
                Ok(d)
            }
        }
    }

    fn assemble((base, duplicates): (Layer, Vec<Duplicate>), work: Work) -> Self {
        Self { hinted: base.mesh.vertex_count(), base, duplicates, work, ..Self::default() }
    }

    /// What [`Self::with_algorithm`] did.
    pub fn work(&self) -> Work {
        self.work
    }

    /// The topology: tetrahedra, facets, neighbours. Below space its tetrahedra have corners without a name, which
    /// stand for the dimensions that are missing.
    pub fn mesh(&self) -> &Mesh3 {
        &self.base.mesh
    }

    /// What the points span.
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
    pub fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_ {
        let valid = |d: &&Duplicate| self.base.mesh.contains(d.vertex) && !self.moved.contains(&d.vertex);
        self.duplicates.iter().filter(valid).copied()
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

    /// The finite tetrahedra, by id. None below space.
    pub fn cells(&self) -> impl Iterator<Item = TetrahedronId> + '_ {
        let mesh = &self.base.mesh;
        let spanned = self.base.scaffold.is_empty();
        mesh.cells().filter(move |&t| spanned && !mesh.is_ghost(t))
    }

    /// The finite tetrahedra as corners in positive order: the first three are seen counter-clockwise from the fourth.
    pub fn tetrahedra(&self) -> impl Iterator<Item = [VertexId; 4]> + '_ {
        self.cells().map(|t| self.base.mesh.corners(t))
    }

    /// The finite facets, each from one of its two sides; of coplanar points the triangles.
    pub fn facets(&self) -> impl Iterator<Item = FacetId> + '_ {
        let (mesh, dimension) = (&self.base.mesh, self.dimension());
        let wanted = move |f: &FacetId| match dimension {
            // From the smaller of two finite sides.
            Dimension::Space => {
                let g = mesh.twin(*f);
                *f < g || mesh.is_ghost(g.tetrahedron())
            }
            Dimension::Plane => {
                self.base.is_scaffold(mesh.cells[f.tetrahedron().index()].corners[f.corner()])
            }
            _ => false,
        };
        let finite = mesh.cells().filter(|&t| !mesh.is_ghost(t));
        finite.flat_map(|t| [0, 1, 2, 3].map(|k| t.facet(k))).filter(wanted)
    }

    /// The facets of the hull, counter-clockwise seen from outside; flat faces are cut into triangles, as the
    /// triangulation has them. Coplanar points have each triangle once, seen from either side; less than a plane has
    /// none.
    pub fn hull(&self) -> impl Iterator<Item = [VertexId; 3]> + '_ {
        let (mesh, dimension) = (&self.base.mesh, self.dimension());
        let ghosts = mesh.cells().filter(move |&t| dimension == Dimension::Space && mesh.is_ghost(t));
        let outer = ghosts.map(|t| mesh.facet_corners(t.facet(3)));
        let flat = self.facets().filter(move |_| dimension == Dimension::Plane);
        outer.chain(flat.map(|f| mesh.facet_corners(f)))
    }

    /// The edges, each once, of whatever the points span.
    pub fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        let mut star = Vec::new();
        self.base.mesh.inhabited().flat_map(move |p| {
            let mut joined = self.neighbors_of(p, &mut star);
            joined.retain(|&q| q > p);
            let [v] = [self.base.mesh.name(p)];
            joined.into_iter().map(move |q| [v, self.base.mesh.name(q)])
        })
    }

    /// The vertices joined to a vertex by an edge; none for an id that is no vertex.
    pub fn neighbors(&self, v: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        let joined = self.base.mesh.place(v).map(|p| self.neighbors_of(p, &mut Vec::new()));
        joined.unwrap_or_default().into_iter().map(|p| self.base.mesh.name(p))
    }

    /// The tetrahedra at a vertex, ghosts included, in no special order; none for an id that is no vertex, and below
    /// space.
    pub fn tetrahedra_at(&self, v: VertexId) -> Vec<TetrahedronId> {
        let mut star = Vec::new();
        if let Some(place) = self.base.mesh.place(v).filter(|_| self.dimension() == Dimension::Space) {
            self.base.mesh.star(place, &mut star);
        }
        star
    }

    fn neighbors_of(&self, p: Place, star: &mut Vec<TetrahedronId>) -> Vec<Place> {
        let mut joined = Vec::new();
        if !self.base.is_scaffold(p) {
            self.base.neighbors(p, star, &mut joined);
        }
        joined
    }
}

/// What was built, or that there would be too many tetrahedra.
fn with_room<T>(built: Option<T>) -> Result<T, Error> {
    built.ok_or(Error::TooManyTetrahedra { most: MAX_TETRAHEDRA })
}

fn check_points<P: Position3>(points: &[P]) -> Result<(), Error> {
    error::check_count(points.len(), MAX_POINTS_IN_SPACE)?;
    error::check_finite(points.iter().map(Position3::xyz))
}

/// The coordinates of a point, if they are finite.
#[inline]
fn finite<P: Position3>(point: &P) -> Result<[f64; 3], Error> {
    error::finite(point.xyz())
}
