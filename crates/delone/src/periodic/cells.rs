//! Voronoi and power cells of periodic triangulations of space.
//!
//! They are cells of the triangulation of the copies, of which those of the sites in the cell of the lattice are right (`quotient`): all tetrahedra at
//! such a site are among the periodic ones. Each is moved to where its site was given.
//!
//! Cost: that of the cells of as many sites without a lattice; O(k) for what is asked of a cell with k corners.

use super::kinds::CellularKind;
use super::{Image, Periodic, Wrapped};
use crate::ids::VertexId;
use crate::space::{Cell3, Cells3, Face3};

/// The cells of a triangulation of space that repeats along all axes: convex polyhedra around the sites, which together with their copies tile
/// space. Volumes add up to that of the box. See [`Cells3`] for bounds.
///
/// ```
/// use delone::{Lattice3, Periodic3};
///
/// // Body-centered: each cell has 14 faces, six squares towards its own copies.
/// let cube = Lattice3::with_sides([2.0, 2.0, 2.0])?;
/// let crystal = Periodic3::from_points(&[[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]], &cube)?;
/// let cells = crystal.cells();
/// for site in crystal.vertices() {
///     let cell = cells.cell(site);
///     assert_eq!((cell.volume(), cell.faces().count()), (4.0, 14));
///     let own = cell.faces().filter(|face| face.neighbor().0 == site);
///     assert!(own.clone().all(|face| face.area() == 0.5));
///     assert_eq!(own.count(), 6);
/// }
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct PeriodicCells3<'a, T: CellularKind> {
    triangulation: &'a Periodic<T, 3, 4>,
    cells: Cells3,
}

/// A cell around a site, where that was given.
#[derive(Debug)]
pub struct PeriodicCell3<'a, T: CellularKind> {
    triangulation: &'a Periodic<T, 3, 4>,
    cell: Cell3<'a>,
    vertices: &'a [[f64; 3]],
    site: VertexId,
}

/// A face of a cell: a convex polygon, which a copy of a site is beyond.
#[derive(Debug)]
pub struct PeriodicFace3<'a, T: CellularKind> {
    of: PeriodicCell3<'a, T>,
    face: Face3<'a>,
}

// Whatever the kind, which a derived implementation would ask to be `Copy` too.
impl<T: CellularKind> Clone for PeriodicCell3<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: CellularKind> Copy for PeriodicCell3<'_, T> {}

impl<T: CellularKind> Clone for PeriodicFace3<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: CellularKind> Copy for PeriodicFace3<'_, T> {}

impl<T: CellularKind> Periodic<T, 3, 4> {
    /// The cells of all sites: without faces for duplicates and hidden sites, and for cells that are not bounded, which there are only if the lattice
    /// does not repeat along all axes. On all threads of rayon's pool where that pays; the result is the same to the bit.
    #[doc(alias("compute_voronoi", "container_periodic"))]
    pub fn cells(&self) -> PeriodicCells3<'_, T> {
        let sites = self.wrapped.len();
        PeriodicCells3 { triangulation: self, cells: self.quotient.copies.bounded_of(|v| v.index() < sites) }
    }
}

impl<T: CellularKind> PeriodicCells3<'_, T> {
    /// The cell of a site; without faces for an id that is no vertex.
    pub fn cell(&self, site: VertexId) -> PeriodicCell3<'_, T> {
        let is_site = site.index() < self.triangulation.wrapped.len();
        let cell = self.cells.cell(if is_site { site } else { VertexId::GHOST });
        PeriodicCell3 { triangulation: self.triangulation, cell, vertices: self.cells.vertices(), site }
    }
}

impl<'a, T: CellularKind> PeriodicCell3<'a, T> {
    /// Its faces.
    pub fn faces(self) -> impl ExactSizeIterator<Item = PeriodicFace3<'a, T>> + Clone {
        self.cell.faces().map(move |face| PeriodicFace3 { of: self, face })
    }

    /// The volume, in coordinate units cubed.
    pub fn volume(self) -> f64 {
        let length = self.triangulation.lattice.length(1.0);
        self.cell.volume() * length * length * length
    }

    /// The area of the surface, in coordinate units squared.
    pub fn area(self) -> f64 {
        self.faces().fold(0.0, |sum, face| sum + face.area())
    }

    /// The center of mass. `None` without faces, and if the cell is so small that its rounded corners have no volume.
    pub fn centroid(self) -> Option<[f64; 3]> {
        self.cell.centroid().map(|place| self.moved(place))
    }

    /// Its corners, each once: what [`Self::rings`] numbers.
    pub fn corners(self) -> impl Iterator<Item = [f64; 3]> + 'a {
        self.numbers().into_iter().map(move |i| self.moved(self.vertices[i as usize]))
    }

    /// The indices of its corners, increasing.
    fn numbers(self) -> Vec<u32> {
        let mut numbers: Vec<u32> = self.cell.faces().flat_map(Face3::indices).copied().collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }

    /// The faces, each by the numbers of its corners among [`Self::corners`], counter-clockwise seen from outside. O(k log k).
    pub fn rings(self) -> Vec<Vec<usize>> {
        let numbers = self.numbers();
        let number = |i: &u32| numbers.binary_search(i).unwrap_or_default();
        self.cell.faces().map(|face| face.indices().iter().map(number).collect()).collect()
    }

    /// A place of the triangulation of the copies, seen from where the site was given.
    fn moved(self, place: [f64; 3]) -> [f64; 3] {
        let lattice = &self.triangulation.lattice;
        let Wrapped { offset, .. } = self.triangulation.wrapped[self.site.index()];
        lattice.shifted(place, offset)
    }
}

impl<T: CellularKind> PeriodicFace3<'_, T> {
    /// The copy of a site that is beyond it, seen from the site as it was given.
    pub fn neighbor(self) -> Image<3> {
        let PeriodicCell3 { triangulation, site, .. } = self.of;
        let beyond = self.face.neighbor().map_or(0, VertexId::index);
        triangulation.image(triangulation.quotient.image(beyond), triangulation.wrapped[site.index()].offset)
    }

    /// Its corners, counter-clockwise seen from outside of the cell.
    pub fn points(self) -> impl ExactSizeIterator<Item = [f64; 3]> + Clone {
        self.face.points().map(move |place| self.of.moved(place))
    }

    /// The area, in coordinate units squared.
    pub fn area(self) -> f64 {
        let length = self.of.triangulation.lattice.length(1.0);
        self.face.area() * length * length
    }

    /// From the site to the copy beyond, in coordinate units, rounded: normal to the face.
    pub fn vector(self) -> [f64; 3] {
        let PeriodicCell3 { triangulation, site, .. } = self.of;
        let beyond = self.face.neighbor().map_or(0, VertexId::index);
        let (other, offset) = triangulation.quotient.image(beyond);
        let lattice = &triangulation.lattice;
        let there = lattice.moved(&triangulation.wrapped[other as usize].place, offset);
        let here = triangulation.wrapped[site.index()].place;
        std::array::from_fn(|k| lattice.length(there[k] - here[k]))
    }
}
