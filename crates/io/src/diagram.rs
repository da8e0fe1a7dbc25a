//! A Voronoi diagram to be written.

use delone::{Cells, Delaunay2, VertexId};

/// Clipped cells, with the triangulation of their sites.
#[derive(Clone, Copy, Debug)]
pub struct Diagram<'a> {
    /// The sites.
    pub triangulation: &'a Delaunay2,
    /// Their cells.
    pub cells: &'a Cells,
}

impl Diagram<'_> {
    /// The rings of a cell as polygons: each an outer ring, counter-clockwise, and its holes.
    pub(crate) fn polygons(&self, site: VertexId) -> Vec<Vec<&[[f64; 2]]>> {
        let rings: Vec<&[[f64; 2]]> = self.cells.rings(site).collect();
        if rings.len() < 2 {
            return rings.into_iter().map(|ring| vec![ring]).collect();
        }
        let (outer, holes): (Vec<_>, Vec<_>) = rings.into_iter().partition(|ring| twice_area(ring) > 0.0);
        let mut polygons: Vec<Vec<&[[f64; 2]]>> = outer.into_iter().map(|ring| vec![ring]).collect();
        for hole in holes {
            let around = polygons.iter().position(|polygon| contains(polygon[0], hole[0])).unwrap_or(0);
            if let Some(polygon) = polygons.get_mut(around) {
                polygon.push(hole);
            }
        }
        polygons
    }

    /// The smallest and the largest corner of all cells and sites.
    pub(crate) fn corners(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let cells = self.triangulation.vertices().flat_map(|v| self.cells.rings(v)).flatten().copied();
        cells.chain(self.triangulation.vertices().map(|v| self.triangulation.point(v)))
    }
}

fn twice_area(ring: &[[f64; 2]]) -> f64 {
    let [x, y] = ring[0];
    let cross = |p: &[[f64; 2]]| (p[0][0] - x) * (p[1][1] - y) - (p[0][1] - y) * (p[1][0] - x);
    ring.windows(2).map(cross).sum()
}

/// Whether a ring goes around a point, up to rounding.
fn contains(ring: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let next = ring.iter().cycle().skip(1);
    let crosses = |(p, q): (&[f64; 2], &[f64; 2])| {
        (p[1] > y) != (q[1] > y) && x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
    };
    ring.iter().zip(next).filter(|&sides| crosses(sides)).count() % 2 == 1
}
