//! The kinds of triangulations that have a periodic form.

use delone_predicates::{orient2d, orient3d};

use super::cells::Faces;
use super::flat::FlatCells;
use super::walls::{Region, Walls};
use crate::error::Error;
use crate::ids::{MAX_POINTS, MAX_POINTS_IN_SPACE, VertexId};
use crate::plane::{Delaunay2, Power2, Region2, Regular2, Voronoi2};
use crate::space::{Cells3, Delaunay3, Power3, Region3, Regular3, Voronoi3};
use crate::triangulation::Triangulation;

/// A kind of triangulation that has a periodic form, [`crate::Periodic`]: of D coordinates, with N corners a simplex.
///
/// These are [`Delaunay2`], [`Delaunay3`], [`Regular2`] and [`Regular3`], and no others.
pub trait PeriodicKind<const D: usize, const N: usize>:
    Triangulation<Point = [f64; D], Corners = [VertexId; N]> + Clone + sealed::Sealed
{
    /// The most points.
    #[doc(hidden)]
    const MOST_POINTS: usize;

    /// Triangulates; kinds without weights are given none.
    #[doc(hidden)]
    fn build(points: &[[f64; D]], weights: &[f64]) -> Result<Self, Error>;

    /// Whether a point is in the line, or the plane, of a facet.
    #[doc(hidden)]
    fn is_in_plane(facet: &[[f64; D]; D], point: [f64; D]) -> bool;
}

/// A kind of triangulation whose periodic form has cells: all of them have.
pub trait CellularKind<const D: usize, const N: usize>: PeriodicKind<D, N> {
    /// The walls that cells end at.
    #[doc(hidden)]
    type Region: Region<D>;

    /// How cells are kept.
    #[doc(hidden)]
    type Cells: Faces<D>;

    /// The cells of so many vertices, which end at walls.
    #[doc(hidden)]
    fn cells_of(&self, walls: &Walls<Self::Region, D>, sites: usize) -> Self::Cells;
}

macro_rules! cellular {
    ($($kind:ident $d:literal $n:literal $region:ident $cells:ident $diagram:ident $of:expr;)*) => { $(
        impl CellularKind<$d, $n> for $kind {
            type Region = $region;
            type Cells = $cells;

            fn cells_of(&self, walls: &Walls<$region, $d>, sites: usize) -> $cells {
                $of(self.$diagram(), walls, sites)
            }
        }
    )* };
}

cellular! {
    Delaunay2 2 3 Region2 FlatCells voronoi |all: Voronoi2<'_>, walls: &Walls<_, 2>, sites| FlatCells::new(all.clip(&walls.region), walls, sites);
    Regular2 2 3 Region2 FlatCells power |all: Power2<'_>, walls: &Walls<_, 2>, sites| FlatCells::new(all.clip(&walls.region), walls, sites);
    Delaunay3 3 4 Region3 Cells3 voronoi |all: Voronoi3<'_>, walls: &Walls<_, 3>, sites| all.cells_of(walls.within(), |v: VertexId| v.index() < sites);
    Regular3 3 4 Region3 Cells3 power |all: Power3<'_>, walls: &Walls<_, 3>, sites| all.cells_of(walls.within(), |v: VertexId| v.index() < sites);
}

mod sealed {
    #[expect(unnameable_types, reason = "no other type can implement the trait")]
    pub trait Sealed {}
}

macro_rules! kinds {
    ($($kind:ident $d:literal $n:literal $most:ident $build:expr, $is_in_plane:expr;)*) => { $(
        impl sealed::Sealed for $kind {}

        impl PeriodicKind<$d, $n> for $kind {
            const MOST_POINTS: usize = $most;

            fn build(points: &[[f64; $d]], weights: &[f64]) -> Result<Self, Error> {
                $build(points, weights)
            }

            fn is_in_plane(facet: &[[f64; $d]; $d], point: [f64; $d]) -> bool {
                $is_in_plane(facet, point)
            }
        }
    )* };
}

fn on_line(&[a, b]: &[[f64; 2]; 2], p: [f64; 2]) -> bool {
    orient2d(a, b, p).is_zero()
}

fn on_plane(&[a, b, c]: &[[f64; 3]; 3], p: [f64; 3]) -> bool {
    orient3d(a, b, c, p).is_zero()
}

kinds! {
    Delaunay2 2 3 MAX_POINTS |points, _| Self::from_points(points), on_line;
    Delaunay3 3 4 MAX_POINTS_IN_SPACE |points, _| Self::from_points(points), on_plane;
    Regular2 2 3 MAX_POINTS Self::from_parts, on_line;
    Regular3 3 4 MAX_POINTS_IN_SPACE Self::from_parts, on_plane;
}
