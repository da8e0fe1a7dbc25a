//! The regions of a diagram, clipped.
//!
//! A region is what its sides leave of the plane, each the bisector of two sites; it is cut as the cells of the plain diagram
//! are (`voronoi/cells.rs`).
//!
//! Cost: O(1) a corner for regions inside, O(d (d + s)) for one with d sides where s sides of what it is clipped to are near.

use delone_predicates::{Line, circumcenter};

use super::circle::Circle;
use super::{OrderK2, OrderRegion2};
use crate::error::Error;
use crate::ids::VertexId;
use crate::plane::region::Region2;
use crate::plane::voronoi::build::Builder;
use crate::plane::voronoi::{Cells2, Ring};

/// Clipped regions of a diagram of some order: polygons, of several rings where what they are clipped to is not convex.
#[derive(Clone, Debug, Default)]
pub struct OrderCells2 {
    /// By the index of the region where plain cells are by that of the site.
    cells: Cells2,
}

impl OrderK2<'_> {
    /// Clips all regions. Sites may be outside. The clipped regions tile what they are clipped to.
    pub fn cells(&self, region: &Region2) -> OrderCells2 {
        let point = |v: VertexId| self.triangulation.point(v);
        let center = |circle: &Circle| match circle.on.map(|v| (!v.is_ghost()).then(|| point(v))) {
            [Some(a), Some(b), Some(c)] => circumcenter(a, b, c),
            _ => None,
        };
        let far = [f64::INFINITY; 2];
        let centers = self.circles.iter().map(|circle| center(circle).unwrap_or(far)).collect();
        let mut builder = Builder::new(region, self.region_count(), self.region_count(), centers);
        for own in self.regions() {
            let corners = own.corners().iter().map(|&corner| corner as usize / 3);
            builder.add(own.index(), corners, || {
                own.sides().map(|(side, _)| Line::Bisector(point(side.lost), point(side.gained)))
            });
        }
        OrderCells2 { cells: builder.finish() }
    }
}

impl OrderCells2 {
    /// The regions with sides up to a length contracted; see [`Cells2::merged`].
    pub fn merged(self, length: f64, region: &Region2) -> Result<Self, Error> {
        Ok(Self { cells: self.cells.merged(length, region)? })
    }

    /// The rings of a region: none if it is outside of what was clipped to, or has no area.
    pub fn rings(&self, region: OrderRegion2) -> impl Iterator<Item = Ring<'_>> + Clone {
        self.cells.rings(VertexId::new(region.index()))
    }

    /// The area of a region, in coordinate units squared; see [`Cells2::area`].
    pub fn area(&self, region: OrderRegion2) -> f64 {
        self.cells.area(VertexId::new(region.index()))
    }

    /// The length of the border of a region, in coordinate units.
    pub fn perimeter(&self, region: OrderRegion2) -> f64 {
        self.cells.perimeter(VertexId::new(region.index()))
    }

    /// The center of mass of a region. `None` if it is empty, or so small that its rounded corners have no area.
    pub fn centroid(&self, region: OrderRegion2) -> Option<[f64; 2]> {
        self.cells.centroid(VertexId::new(region.index()))
    }

    /// The vertices of all rings. Those that no ring uses may be infinite.
    pub fn vertices(&self) -> &[[f64; 2]] {
        self.cells.vertices()
    }
}
