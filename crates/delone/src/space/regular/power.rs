//! Power diagrams of space, as a view of the regular triangulation: what belongs to whom if distances are powers.
//!
//! The power cell of a site is what has no less power to another one; hidden sites have none. Cells are convex, and tile space.
//!
//! Source: Aurenhammer, "Power diagrams: properties, algorithms and applications", SIAM J. Comput. 1987.
//!
//! Cost: as for Voronoi cells (`space/voronoi/clip.rs`).

use super::Regular3;
use crate::ids::{TetrahedronId, VertexId};
use crate::space::region::Region3;
use crate::space::voronoi::cells::{Cell3, Cells3};
use crate::space::voronoi::{clip, faces};

/// The power diagram of the sites of a triangulation of space: radical cells, for weights that are squared radii.
///
/// ```
/// use delone::{Region3, Regular3};
///
/// // Two sites one apart: with the same weights the border is in the middle, and the heavier one moves it away.
/// let cube = Region3::cuboid([0.0, 0.0, 0.0], [1.0, 1.0, 1.0])?;
/// let mut r = Regular3::from_sites(&[([0.0, 0.5, 0.5], 0.0), ([1.0, 0.5, 0.5], 0.0)])?;
/// let [a, b] = [0, 1].map(delone::VertexId::new);
/// assert_eq!(r.power().clip(&cube).volume(a), 0.5);
/// r.set_weight(a, 0.5)?;
/// assert_eq!(r.power().clip(&cube).volume(a), 0.75);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("radical", "Laguerre"))]
#[derive(Clone, Copy, Debug)]
pub struct Power3<'a> {
    triangulation: &'a Regular3,
}

impl Regular3 {
    /// The power diagram.
    pub fn power(&self) -> Power3<'_> {
        Power3 { triangulation: self }
    }
}

impl<'a> Power3<'a> {
    /// The triangulation that it is a view of.
    pub fn triangulation(self) -> &'a Regular3 {
        self.triangulation
    }

    /// The corner of four cells that is dual to a tetrahedron. `None` for a ghost, and if it is too far away for `f64`.
    pub fn vertex(self, t: TetrahedronId) -> Option<[f64; 3]> {
        self.triangulation.power_center(t)
    }

    /// Whether the cell of a site is bounded: it is for vertices that are not on the hull. Exact; false for a hidden site.
    pub fn is_bounded(self, site: VertexId) -> bool {
        faces::is_bounded(&self.triangulation.base, site)
    }

    /// The sites whose cells share more than a point or a line with a cell, by increasing id; none for a hidden site. Exact.
    pub fn neighbors(self, site: VertexId) -> Vec<VertexId> {
        faces::neighbors(&self.triangulation.base, site)
    }

    /// Clips all cells to a region. Sites may be outside of it, and of their cells. The clipped cells tile the region. On all threads, as
    /// [`crate::Voronoi3::clip`].
    ///
    /// A site that ties with others may be a vertex whose cell has no volume. It has faces then if the cell is a polygon, one towards each
    /// side.
    pub fn clip(self, region: &Region3) -> Cells3 {
        clip::of(&self.triangulation.base, self.triangulation.ids_given(), region)
    }

    /// The cells of all vertices that are not on the hull, as they are; see [`crate::Voronoi3::bounded`].
    pub fn bounded(self) -> Cells3 {
        self.cells_of(None, |_| true)
    }

    /// The cells of some of the sites, clipped; without a region those that are bounded.
    pub(crate) fn cells_of(
        self,
        region: Option<&Region3>,
        is_wanted: impl Fn(VertexId) -> bool + Send + Sync,
    ) -> Cells3 {
        clip::of_wanted(&self.triangulation.base, self.triangulation.ids_given(), region, is_wanted)
    }

    /// Clips all cells to a region, and hands out one after the other, as [`crate::Voronoi3::clip_each`].
    pub fn clip_each(self, region: &Region3, each: impl FnMut(VertexId, Cell3<'_>)) {
        clip::each(&self.triangulation.base, region, each);
    }
}
