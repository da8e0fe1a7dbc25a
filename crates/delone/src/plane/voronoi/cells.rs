//! Clipped cells: rings of corners that neighboring cells share.
//!
//! Cost: O(k) for what is asked of a cell with k corners.

use crate::ids::VertexId;
use crate::plane::region::measure;
use delone_predicates::hypotenuse;

/// Clipped cells, by site: polygons of one ring or, where the region is not convex, of several. Neighboring cells
/// share the vertices between them.
#[derive(Clone, Debug, Default)]
pub struct Cells2 {
    /// For each site the first of its rings, and how many there are.
    pub(super) sites: Vec<[u32; 2]>,
    /// Where each ring starts among the corners; and the end of the last.
    pub(super) starts: Vec<u32>,
    /// Indices of vertices, ring by ring.
    pub(super) corners: Vec<u32>,
    /// First the circumcenters by triangle, then what clipping has made.
    pub(super) vertices: Vec<[f64; 2]>,
}

/// A clipped cell: no ring if nothing of it is left.
#[derive(Clone, Copy, Debug)]
pub struct Cell2<'a> {
    /// Where rings start among the corners, and the end of the last; one number, or none, if there is no ring.
    ends: &'a [u32],
    corners: &'a [u32],
    vertices: &'a [[f64; 2]],
}

/// A closed line of the border of a cell, the cell on its left: an outer ring is counter-clockwise, a hole clockwise.
#[derive(Clone, Copy, Debug)]
pub struct Ring<'a> {
    corners: &'a [u32],
    vertices: &'a [[f64; 2]],
}

impl Cells2 {
    /// Cells by the rings of each, with vertices of their own.
    pub(crate) fn of_rings(cells: impl Iterator<Item = Vec<Vec<[f64; 2]>>>) -> Self {
        let mut all = Self { starts: vec![0], ..Self::default() };
        for rings in cells {
            all.sites.push([all.starts.len() - 1, rings.len()].map(|n| n as u32));
            for ring in rings {
                all.vertices.extend(ring);
                all.starts.push(all.vertices.len() as u32);
            }
        }
        all.corners = (0..all.vertices.len() as u32).collect();
        all
    }

    /// The rings of one after the other.
    pub(super) fn all(&self) -> Cell2<'_> {
        Cell2 { ends: &self.starts, corners: &self.corners, vertices: &self.vertices }
    }

    /// The cell of a site: without rings for an id that is no vertex, and for a cell outside of the region.
    pub fn cell(&self, site: VertexId) -> Cell2<'_> {
        let [first, count] = self.sites.get(site.index()).copied().unwrap_or_default();
        let ends = &self.starts[first as usize..][..count as usize + usize::from(count > 0)];
        Cell2 { ends, corners: &self.corners, vertices: &self.vertices }
    }

    /// The index of the first corner of each ring of a cell, among those of all.
    pub(crate) fn ring_starts(&self, site: VertexId) -> impl Iterator<Item = usize> + '_ {
        let [first, count] = self.sites.get(site.index()).copied().unwrap_or_default();
        self.starts[first as usize..][..count as usize].iter().map(|&start| start as usize)
    }

    /// The rings of a cell: none for an id that is no vertex, and for a cell outside of the region.
    pub fn rings(&self, site: VertexId) -> impl Iterator<Item = Ring<'_>> + Clone {
        self.cell(site).rings()
    }

    /// The vertices of all cells. Those that no ring uses may be infinite.
    pub fn vertices(&self) -> &[[f64; 2]] {
        &self.vertices
    }

    /// See [`Cell2::area`].
    pub fn area(&self, site: VertexId) -> f64 {
        self.cell(site).area()
    }

    /// See [`Cell2::perimeter`].
    ///
    /// ```
    /// use delone::{Delaunay2, Region2, VertexId};
    ///
    /// let d = Delaunay2::from_points(&[[1, 1], [3, 1]])?;
    /// let cells = d.voronoi().clip(&Region2::rectangle([0, 0], [4, 4])?);
    /// assert_eq!(cells.perimeter(VertexId::new(0)), 12.0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn perimeter(&self, site: VertexId) -> f64 {
        self.cell(site).perimeter()
    }

    /// See [`Cell2::second_moment`].
    pub fn second_moment(&self, site: VertexId, about: [f64; 2]) -> f64 {
        self.cell(site).second_moment(about)
    }

    /// See [`Cell2::centroid`].
    ///
    /// ```
    /// use delone::{Delaunay2, Region2, VertexId};
    ///
    /// let d = Delaunay2::from_points(&[[1, 1], [3, 1]])?;
    /// let cells = d.voronoi().clip(&Region2::rectangle([0, 0], [4, 4])?);
    /// assert_eq!(cells.centroid(VertexId::new(0)), Some([1.0, 2.0]));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn centroid(&self, site: VertexId) -> Option<[f64; 2]> {
        self.cell(site).centroid()
    }
}

impl<'a> Cell2<'a> {
    /// Its rings.
    pub fn rings(self) -> impl Iterator<Item = Ring<'a>> + Clone {
        let corners = self.ends.windows(2).map(move |ends| &self.corners[ends[0] as usize..ends[1] as usize]);
        corners.map(move |corners| Ring { corners, vertices: self.vertices })
    }

    /// The area, in coordinate units squared. Never negative: less than nothing is rounding. Infinite if it is beyond
    /// the range of `f64`. O(k) for k corners.
    pub fn area(self) -> f64 {
        measure::area(self.rings().map(Ring::points)).max(0.0)
    }

    /// The length of the border, holes included, in coordinate units.
    pub fn perimeter(self) -> f64 {
        let lengths = self.rings().flat_map(Ring::sides).map(|[p, q]| hypotenuse(q[0] - p[0], q[1] - p[1]));
        lengths.fold(0.0, |sum, length| sum + length)
    }

    /// The integral over the cell of the squared distance from a point: with the site, what it costs to carry the cell there. O(k)
    /// for k corners. Not finite beyond the range of `f64`.
    pub fn second_moment(self, about: [f64; 2]) -> f64 {
        measure::second_moment(self.rings().map(Ring::points), about)
    }

    /// The center of mass. `None` if the cell is empty, or so small that its rounded corners have no area.
    pub fn centroid(self) -> Option<[f64; 2]> {
        measure::centroid(self.rings().map(Ring::points))
    }
}

impl<'a> Ring<'a> {
    /// Its corners, in order.
    pub fn points(self) -> impl ExactSizeIterator<Item = [f64; 2]> + Clone + 'a {
        self.corners.iter().map(move |&i| self.vertices[i as usize])
    }

    /// Its corners as indices into [`Cells2::vertices`].
    pub fn indices(self) -> &'a [u32] {
        self.corners
    }

    /// Its sides, from corner to corner, the last one back to the first.
    pub fn sides(self) -> impl Iterator<Item = [[f64; 2]; 2]> + 'a {
        let next = self.points().cycle().skip(1);
        self.points().zip(next).map(|(p, q)| [p, q])
    }

    /// The area inside, in coordinate units squared; negative for a hole. Infinite beyond the range of `f64`.
    pub fn area(self) -> f64 {
        measure::area(std::iter::once(self.points()))
    }
}
