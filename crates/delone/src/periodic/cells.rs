//! Voronoi and power cells of periodic triangulations of space.
//!
//! They are cells of the triangulation of the copies, of which those of the sites in the cell of the lattice are right (`quotient`): all tetrahedra at
//! such a site are among the periodic ones. Each is moved to where its site was given.
//!
//! Cost: that of the cells of as many sites without a lattice; O(k) for what is asked of a cell with k corners.

use super::kinds::CellularKind;
use super::walls::{Side, Walls};
use super::{Image, Periodic, Wrapped};
use crate::error::Error;
use crate::ids::VertexId;
use crate::space::{Across3, Cell3, Cells3, Face3};

/// The cells of a triangulation of space that repeats: convex polyhedra around the sites, which together with their copies tile space, or as far as the
/// walls along axes that do not repeat. Volumes add up to that of the box. See [`Cells3`] for bounds.
///
/// ```
/// use delone::{Lattice3, Periodic3};
///
/// // Body-centered: each cell has 14 faces, six squares towards its own copies.
/// let cube = Lattice3::with_sides([2.0, 2.0, 2.0])?;
/// let crystal = Periodic3::from_points(&[[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]], &cube)?;
/// let cells = crystal.cells()?;
/// for site in crystal.vertices() {
///     let cell = cells.cell(site);
///     assert_eq!((cell.volume(), cell.faces().count()), (4.0, 14));
///     let own = cell.faces().filter(|face| face.neighbor().is_some_and(|(other, _)| other == site));
///     assert!(own.clone().all(|face| face.area() == 0.5));
///     assert_eq!(own.count(), 6);
/// }
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct PeriodicCells3<'a, T: CellularKind> {
    triangulation: &'a Periodic<T, 3, 4>,
    cells: Cells3,
    /// Which side of the box each wall is.
    sides: Vec<Option<Side>>,
}

/// A cell around a site, where that was given.
#[derive(Debug)]
pub struct PeriodicCell3<'a, T: CellularKind> {
    triangulation: &'a Periodic<T, 3, 4>,
    cell: Cell3<'a>,
    of: &'a PeriodicCells3<'a, T>,
    site: VertexId,
}

/// The cell or the wall beyond a face. There is no third, so a match may name both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum AcrossPeriodic3 {
    /// The cell of this copy of a site.
    Site(Image<3>),
    /// A wall of the box.
    Wall {
        /// The axis, along which the box does not repeat.
        axis: usize,
        /// Whether it is at the end of the axis, and not at its beginning.
        is_end: bool,
    },
}

/// A face of a cell: a convex polygon.
#[derive(Debug)]
pub struct PeriodicFace3<'a, T: CellularKind> {
    of: PeriodicCell3<'a, T>,
    face: Face3<'a>,
}

#[expect(clippy::expl_impl_clone_on_copy, reason = "a derived one asks the kind to be `Copy` too")]
impl<T: CellularKind> Clone for PeriodicCell3<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: CellularKind> Copy for PeriodicCell3<'_, T> {}

#[expect(clippy::expl_impl_clone_on_copy, reason = "a derived one asks the kind to be `Copy` too")]
impl<T: CellularKind> Clone for PeriodicFace3<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: CellularKind> Copy for PeriodicFace3<'_, T> {}

impl<T: CellularKind> Periodic<T, 3, 4> {
    /// The cells of all sites: without faces for duplicates, for hidden sites, and for those whose cell is beyond the walls. On all threads of
    /// rayon's pool where that pays; the result is the same to the bit.
    ///
    /// # Errors
    /// [`Error::Lattice`] for an axis along which the box does not repeat, and that is no axis of a box.
    #[doc(alias("compute_voronoi", "container_periodic"))]
    pub fn cells(&self) -> Result<PeriodicCells3<'_, T>, Error> {
        let walls = Walls::of(&self.lattice)?;
        let region = walls.as_ref().map(|walls| &walls.region);
        let sites = self.wrapped.len();
        let cells = self.quotient.copies.cells_of(region, |v| v.index() < sites);
        Ok(PeriodicCells3 {
            triangulation: self,
            cells,
            sides: walls.map_or(Vec::new(), |walls| walls.sides),
        })
    }
}

impl<'a, T: CellularKind> PeriodicCells3<'a, T> {
    /// The cell of a site; without faces for an id that is no vertex.
    pub fn cell(&'a self, site: VertexId) -> PeriodicCell3<'a, T> {
        let is_site = site.index() < self.triangulation.wrapped.len();
        let cell = self.cells.cell(if is_site { site } else { VertexId::GHOST });
        PeriodicCell3 { triangulation: self.triangulation, cell, of: self, site }
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
        self.numbers().into_iter().map(move |i| self.moved(self.of.cells.vertices()[i as usize]))
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
    /// The cell or the wall beyond it.
    pub fn across(self) -> AcrossPeriodic3 {
        let PeriodicCell3 { triangulation, site, of, .. } = self.of;
        match self.face.across() {
            Across3::Site(v) => {
                let seen_from = triangulation.wrapped[site.index()].offset;
                AcrossPeriodic3::Site(triangulation.image(triangulation.quotient.image(v.index()), seen_from))
            }
            Across3::Wall(k) => {
                let (axis, is_end) = of.sides.get(k).copied().flatten().unwrap_or_default();
                AcrossPeriodic3::Wall { axis, is_end }
            }
        }
    }

    /// The copy of a site that is beyond it, seen from the site as it was given; none beyond walls.
    pub fn neighbor(self) -> Option<Image<3>> {
        match self.across() {
            AcrossPeriodic3::Site(image) => Some(image),
            AcrossPeriodic3::Wall { .. } => None,
        }
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

    /// The outward normal, of length one; none if the rounded corners have no area, see [`Face3::normal`].
    pub fn normal(self) -> Option<[f64; 3]> {
        self.face.normal()
    }

    /// From the site to the copy beyond, in coordinate units, rounded: normal to the face. None beyond walls.
    pub fn vector(self) -> Option<[f64; 3]> {
        let PeriodicCell3 { triangulation, site, .. } = self.of;
        let (other, offset) = triangulation.quotient.image(self.face.neighbor()?.index());
        let lattice = &triangulation.lattice;
        let there = lattice.moved(&triangulation.wrapped[other as usize].place, offset);
        let here = triangulation.wrapped[site.index()].place;
        Some(std::array::from_fn(|k| lattice.length(there[k] - here[k])))
    }
}
