//! Tiles in space: the tetrahedra of one region's points, and which of them are final.
//!
//! Borders grow with the surface of tiles, so tiles of space should be few and large.
//!
//! Cost: as for [`crate::Delaunay3`], and O(k) for k open tetrahedra: only these, and those at their side, are asked for a
//! certificate.

use super::along::Along;
use super::tile::{certified, finals, fingerprint};
use super::{Border3, Fingerprint, Region};
use crate::error::Error;
use crate::ids::{Duplicate, TetrahedronId};
use crate::space::InOrder3;

/// The triangulation of the points of a region of space, with vertices along a curve: what is near in space is near in the list of
/// points. See [`super`].
///
/// ```
/// use delone::Delaunay3;
/// use delone::tiles::{Cuts, Fingerprint, Node, Tile3, join3};
///
/// let points: Vec<[f64; 3]> =
///     (0..3000).map(|i| [f64::from(i * 37 % 1009), f64::from(i * i % 907), f64::from(i * 11 % 811)]).collect();
/// let cuts = Cuts::<3>::from_sample(&points, 4)?;
/// let (mut found, mut borders) = (Fingerprint::default(), Vec::new());
/// for node in cuts.tiles() {
///     let its: Vec<[f64; 3]> = points.iter().copied().filter(|&p| cuts.tile_of(p) == node).collect();
///     let tile = Tile3::new(&its, &cuts.region(node))?;
///     found += tile.fingerprint();
///     borders.push(tile.border(|v| node.id(v)));
/// }
/// let seam = join3(&borders, &cuts.region(Node::ROOT))?;
/// found += seam.fingerprint;
/// assert_eq!(found, Fingerprint::of(&Delaunay3::from_points(&points)?));
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Tile3 {
    along: InOrder3,
    /// By increasing index.
    open: Vec<TetrahedronId>,
}

impl Tile3 {
    /// Triangulates the points of a region: all that there are.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate, [`Error::OutsideRegion`] the first point that is not in the
    /// region; [`Error::TooManyPoints`] is returned beyond [`crate::MAX_POINTS_IN_SPACE`], [`Error::TooManyTetrahedra`] as for
    /// [`crate::Delaunay3`].
    pub fn new(points: &[[f64; 3]], region: &Region<3>) -> Result<Self, Error> {
        let (along, open) = certified::<InOrder3, 3, 4>(points, region)?;
        Ok(Self { along, open })
    }

    /// The vertices: the points that differ, along the curve.
    pub fn points(&self) -> &[[f64; 3]] {
        &self.along.points
    }

    /// For each vertex the index of its point in the input: of equal ones the first.
    pub fn order(&self) -> &[u32] {
        &self.along.indices
    }

    /// The points that equal an earlier one, by increasing index: both are indices of the input.
    pub fn duplicates(&self) -> &[Duplicate] {
        &self.along.duplicates
    }

    /// The tetrahedra that nothing outside of the region can change: indices of [`Self::points`], in positive order, the first three
    /// seen counter-clockwise from the fourth.
    pub fn finals(&self) -> impl Iterator<Item = [u32; 4]> + '_ {
        finals(&self.along, &self.open)
    }

    /// The other tetrahedra, as [`Self::finals`].
    pub fn open(&self) -> impl Iterator<Item = [u32; 4]> + '_ {
        self.open.iter().map(|&t| self.along.corners(t))
    }

    /// The fingerprint of the final tetrahedra.
    pub fn fingerprint(&self) -> Fingerprint {
        fingerprint(self.points(), self.finals())
    }

    /// The border, to be joined with those of other tiles. `name` gives the global name of a vertex by its index.
    pub fn border(&self, name: impl Fn(u32) -> u64) -> Border3 {
        Border3::of(&self.along, &self.open, name)
    }
}
