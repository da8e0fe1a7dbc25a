//! A Voronoi diagram to be written.

use delone::{Cells2, Ring, Triangulation, VertexId};

use crate::Crs;

/// Clipped cells, with the triangulation of their sites.
#[derive(Debug)]
pub struct Diagram<'a, T> {
    /// The sites.
    pub triangulation: &'a T,
    /// Their cells.
    pub cells: &'a Cells2,
    /// What the coordinates mean; formats that can say it do.
    pub crs: Option<&'a Crs>,
}

impl<T: Triangulation<Point = [f64; 2]>> Diagram<'_, T> {
    /// The rings of a cell as polygons: each an outer ring, counter-clockwise, and its holes.
    pub(crate) fn polygons(&self, site: VertexId) -> Vec<Vec<Ring<'_>>> {
        let rings: Vec<Ring> = self.cells.rings(site).collect();
        if rings.len() < 2 {
            return rings.into_iter().map(|ring| vec![ring]).collect();
        }
        let (outer, holes): (Vec<_>, Vec<_>) = rings.into_iter().partition(|ring| ring.area() > 0.0);
        let mut polygons: Vec<Vec<Ring>> = outer.into_iter().map(|ring| vec![ring]).collect();
        for hole in holes {
            let inside = |polygon: &Vec<Ring>| hole.points().next().is_some_and(|p| contains(polygon[0], p));
            let around = polygons.iter().position(inside).unwrap_or(0);
            if let Some(polygon) = polygons.get_mut(around) {
                polygon.push(hole);
            }
        }
        polygons
    }

    /// The coordinates of a site.
    pub(crate) fn point(&self, site: VertexId) -> [f64; 2] {
        self.triangulation.position(site).unwrap_or_default()
    }

    /// The corners of all cells, and all sites.
    pub(crate) fn corners(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let cells = self.triangulation.vertices().flat_map(|v| self.cells.rings(v)).flat_map(Ring::points);
        cells.chain(self.triangulation.vertices().map(|v| self.point(v)))
    }
}

/// Whether a ring goes around a point, up to rounding.
fn contains(ring: Ring, [x, y]: [f64; 2]) -> bool {
    let crosses = |[p, q]: &[[f64; 2]; 2]| {
        (p[1] > y) != (q[1] > y) && x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
    };
    ring.sides().filter(crosses).count() % 2 == 1
}
