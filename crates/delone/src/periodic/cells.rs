//! Voronoi and power cells of periodic triangulations.
//!
//! They are cells of the triangulation of the copies, of which those of the sites in the cell of the lattice are right (`quotient`): all simplices at
//! such a site are among the periodic ones. Each is moved to where its site was given.
//!
//! Cost: that of the cells of as many sites without a lattice, in the plane of all copies; O(k) for what is asked of a cell with k corners.

use std::fmt::Debug;

use super::kinds::CellularKind;
use super::walls::{Side, Walls};
use super::{Image, Periodic, Wrapped};
use crate::error::Error;
use crate::ids::VertexId;
use crate::plane::Cells2;
use crate::space::{Across3, Cells3, Face3};

/// The cells of a triangulation that repeats: convex polygons or polyhedra around the sites, which together with their copies tile the plane or
/// space, or as far as the walls along axes that do not repeat. Their sizes add up to that of the box. See [`crate::Cells2`] and
/// [`Cells3`] for bounds.
///
/// ```
/// use delone::{Lattice2, Lattice3, Periodic2, Periodic3};
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
/// // A square with a site in its middle, between walls on two sides.
/// let strip = Lattice2::with_sides([2.0, 2.0])?.periodic([true, false]);
/// let alone = Periodic2::from_points(&[[0.0, 1.0]], &strip)?;
/// let cells = alone.cells()?;
/// let cell = cells.cell(alone.vertices().next().unwrap());
/// assert_eq!((cell.area(), cell.perimeter(), cell.centroid()), (4.0, 8.0, Some([0.0, 1.0])));
/// assert_eq!(cell.faces().filter(|side| side.neighbor().is_none()).count(), 2);
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct PeriodicCells<'a, T: CellularKind<D, N>, const D: usize, const N: usize> {
    triangulation: &'a Periodic<T, D, N>,
    cells: T::Cells,
    /// Which side of the box each wall is.
    sides: Vec<Option<Side>>,
}

/// A cell around a site, where that was given.
#[derive(Debug)]
pub struct PeriodicCell<'a, T: CellularKind<D, N>, const D: usize, const N: usize> {
    of: &'a PeriodicCells<'a, T, D, N>,
    site: VertexId,
}

/// The cell or the wall beyond a face. There is no third, so a match may name both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum AcrossPeriodic<const D: usize> {
    /// The cell of this copy of a site.
    Site(Image<D>),
    /// A wall of the box.
    Wall {
        /// The axis, along which the box does not repeat.
        axis: usize,
        /// Whether it is at the end of the axis, and not at its beginning.
        is_end: bool,
    },
}

/// A face of a cell: in space a convex polygon, in the plane a side.
#[derive(Debug)]
pub struct PeriodicFace<'a, T: CellularKind<D, N>, const D: usize, const N: usize> {
    of: PeriodicCell<'a, T, D, N>,
    face: <T::Cells as Faces<D>>::Face<'a>,
}

/// Cells in the plane.
pub type PeriodicCells2<'a, T> = PeriodicCells<'a, T, 2, 3>;
/// A cell in the plane.
pub type PeriodicCell2<'a, T> = PeriodicCell<'a, T, 2, 3>;
/// A side of a cell in the plane.
pub type PeriodicSide2<'a, T> = PeriodicFace<'a, T, 2, 3>;
/// The neighbor beyond a side.
pub type AcrossPeriodic2 = AcrossPeriodic<2>;
/// Cells in space.
pub type PeriodicCells3<'a, T> = PeriodicCells<'a, T, 3, 4>;
/// A cell in space.
pub type PeriodicCell3<'a, T> = PeriodicCell<'a, T, 3, 4>;
/// A face of a cell in space.
pub type PeriodicFace3<'a, T> = PeriodicFace<'a, T, 3, 4>;
/// The neighbor beyond a face.
pub type AcrossPeriodic3 = AcrossPeriodic<3>;

/// The neighbor of a cell among copies: a cell, or a wall by its number.
#[derive(Clone, Copy, Debug)]
#[expect(unnameable_types, reason = "how cells are kept is hidden")]
pub enum Beyond {
    Site(VertexId),
    Wall(usize),
}

/// Cells as they are kept, by site.
#[expect(unnameable_types, reason = "how cells are kept is hidden")]
pub trait Faces<const D: usize>: Clone + Debug {
    type Face<'a>: Copy + Debug
    where
        Self: 'a;

    fn faces(&self, site: VertexId) -> impl ExactSizeIterator<Item = Self::Face<'_>> + Clone;

    fn beyond(face: Self::Face<'_>) -> Beyond;

    /// The corners of a face as indices of vertices.
    fn indices<'a>(face: Self::Face<'a>) -> &'a [u32]
    where
        Self: 'a;

    fn vertices(&self) -> &[[f64; D]];

    /// The volume of a cell, in the plane its area.
    fn size(&self, site: VertexId) -> f64;

    fn centroid(&self, site: VertexId) -> Option<[f64; D]>;

    /// The area of a face, in the plane its length.
    fn face_size(&self, face: Self::Face<'_>) -> f64;

    fn normal(&self, face: Self::Face<'_>) -> Option<[f64; D]>;
}

impl Faces<3> for Cells3 {
    type Face<'a> = Face3<'a>;

    fn faces(&self, site: VertexId) -> impl ExactSizeIterator<Item = Face3<'_>> + Clone {
        self.faces(site)
    }

    fn beyond(face: Face3<'_>) -> Beyond {
        match face.across() {
            Across3::Site(v) => Beyond::Site(v),
            Across3::Wall(k) => Beyond::Wall(k),
        }
    }

    fn indices<'a>(face: Face3<'a>) -> &'a [u32]
    where
        Self: 'a,
    {
        face.indices()
    }

    fn vertices(&self) -> &[[f64; 3]] {
        self.vertices()
    }

    fn size(&self, site: VertexId) -> f64 {
        self.volume(site)
    }

    fn centroid(&self, site: VertexId) -> Option<[f64; 3]> {
        self.centroid(site)
    }

    fn face_size(&self, face: Face3<'_>) -> f64 {
        face.area()
    }

    fn normal(&self, face: Face3<'_>) -> Option<[f64; 3]> {
        face.normal()
    }
}

#[expect(clippy::expl_impl_clone_on_copy, reason = "a derived one asks the kind to be `Copy` too")]
impl<T: CellularKind<D, N>, const D: usize, const N: usize> Clone for PeriodicCell<'_, T, D, N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: CellularKind<D, N>, const D: usize, const N: usize> Copy for PeriodicCell<'_, T, D, N> {}

#[expect(clippy::expl_impl_clone_on_copy, reason = "a derived one asks the kind to be `Copy` too")]
impl<T: CellularKind<D, N>, const D: usize, const N: usize> Clone for PeriodicFace<'_, T, D, N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: CellularKind<D, N>, const D: usize, const N: usize> Copy for PeriodicFace<'_, T, D, N> {}

impl<T: CellularKind<D, N>, const D: usize, const N: usize> Periodic<T, D, N> {
    /// The cells of all sites: without faces for duplicates, for hidden sites, and for those whose cell is beyond the walls. In space on all
    /// threads of rayon's pool where that pays; the result is the same to the bit.
    ///
    /// # Errors
    /// [`Error::Lattice`] for an axis along which the box does not repeat, and that is no axis of a box.
    #[doc(alias("compute_voronoi", "container_periodic"))]
    pub fn cells(&self) -> Result<PeriodicCells<'_, T, D, N>, Error> {
        let walls = Walls::of(&self.lattice)?;
        let cells = self.quotient.copies.cells_of(&walls, self.wrapped.len());
        Ok(PeriodicCells { triangulation: self, cells, sides: walls.sides })
    }
}

impl<'a, T: CellularKind<D, N>, const D: usize, const N: usize> PeriodicCells<'a, T, D, N> {
    /// The cell of a site; without faces for an id that is no vertex.
    pub fn cell(&'a self, site: VertexId) -> PeriodicCell<'a, T, D, N> {
        let is_site = site.index() < self.triangulation.wrapped.len();
        PeriodicCell { of: self, site: if is_site { site } else { VertexId::GHOST } }
    }
}

impl<'a, T: CellularKind<D, N>, const D: usize, const N: usize> PeriodicCell<'a, T, D, N> {
    /// Its faces; in the plane its sides, counter-clockwise.
    #[doc(alias("sides"))]
    pub fn faces(self) -> impl ExactSizeIterator<Item = PeriodicFace<'a, T, D, N>> + Clone {
        self.of.cells.faces(self.site).map(move |face| PeriodicFace { of: self, face })
    }

    /// The center of mass. `None` without faces, and if the cell is so small that nothing is left between its rounded corners.
    pub fn centroid(self) -> Option<[f64; D]> {
        self.of.cells.centroid(self.site).map(|place| self.moved(place))
    }

    /// A vertex of the cells of all copies, seen from where the site was given.
    fn at(self, vertex: u32) -> [f64; D] {
        self.moved(self.of.cells.vertices()[vertex as usize])
    }

    /// A place of the triangulation of the copies, seen from where the site was given.
    fn moved(self, place: [f64; D]) -> [f64; D] {
        let triangulation = self.of.triangulation;
        let Wrapped { offset, .. } = triangulation.wrapped[self.site.index()];
        triangulation.lattice.shifted(place, offset)
    }

    /// A length in coordinate units.
    fn length(self, length: f64) -> f64 {
        self.of.triangulation.lattice.length(length)
    }
}

impl<T: CellularKind<2, 3>> PeriodicCells2<'_, T> {
    /// The cells by site as clipped ones are kept, each around the point where that was given, and with vertices of its own. What
    /// neighbors share may differ by rounding, where points were given in different periods.
    pub fn to_cells(&self) -> Cells2 {
        let sites = (0..self.triangulation.ids_given()).map(VertexId::new);
        Cells2::of_rings(sites.map(|site| self.cell(site).rings()))
    }
}

impl<T: CellularKind<2, 3>> PeriodicCell2<'_, T> {
    /// The area, in coordinate units squared.
    pub fn area(self) -> f64 {
        let length = self.length(1.0);
        self.of.cells.size(self.site) * length * length
    }

    /// The length of the border, in coordinate units.
    pub fn perimeter(self) -> f64 {
        self.faces().fold(0.0, |sum, side| sum + side.length())
    }

    /// Its corners, counter-clockwise: one ring, but for a cell that rounding has parted.
    pub fn rings(self) -> Vec<Vec<[f64; 2]>> {
        let (mut rings, mut ring, mut first) = (Vec::new(), Vec::new(), None);
        for side in self.of.cells.faces(self.site) {
            let &[from, to] = T::Cells::indices(side) else { continue };
            ring.push(self.at(from));
            if to == *first.get_or_insert(from) {
                rings.push(std::mem::take(&mut ring));
                first = None;
            }
        }
        rings
    }
}

impl<'a, T: CellularKind<3, 4>> PeriodicCell3<'a, T> {
    /// The volume, in coordinate units cubed.
    pub fn volume(self) -> f64 {
        let length = self.length(1.0);
        self.of.cells.size(self.site) * length * length * length
    }

    /// The area of the surface, in coordinate units squared.
    pub fn area(self) -> f64 {
        self.faces().fold(0.0, |sum, face| sum + face.area())
    }

    /// Its corners, each once: what [`Self::rings`] numbers.
    pub fn corners(self) -> impl Iterator<Item = [f64; 3]> + 'a {
        self.numbers().into_iter().map(move |i| self.at(i))
    }

    /// The indices of its corners, increasing.
    fn numbers(self) -> Vec<u32> {
        let faces = self.of.cells.faces(self.site);
        let mut numbers: Vec<u32> = faces.flat_map(T::Cells::indices).copied().collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }

    /// The faces, each by the numbers of its corners among [`Self::corners`], counter-clockwise seen from outside. O(k log k).
    pub fn rings(self) -> Vec<Vec<usize>> {
        let numbers = self.numbers();
        let number = |i: &u32| numbers.binary_search(i).unwrap_or_default();
        let faces = self.of.cells.faces(self.site);
        faces.map(|face| T::Cells::indices(face).iter().map(number).collect()).collect()
    }
}

impl<'a, T: CellularKind<D, N>, const D: usize, const N: usize> PeriodicFace<'a, T, D, N> {
    /// The cell or the wall beyond it.
    pub fn across(self) -> AcrossPeriodic<D> {
        let PeriodicCell { of, site } = self.of;
        match T::Cells::beyond(self.face) {
            Beyond::Site(v) => {
                let triangulation = of.triangulation;
                let seen_from = triangulation.wrapped[site.index()].offset;
                AcrossPeriodic::Site(triangulation.image(triangulation.quotient.image(v.index()), seen_from))
            }
            Beyond::Wall(k) => {
                let (axis, is_end) = of.sides.get(k).copied().flatten().unwrap_or_default();
                AcrossPeriodic::Wall { axis, is_end }
            }
        }
    }

    /// The copy of a site that is beyond it, seen from the site as it was given; none beyond walls.
    pub fn neighbor(self) -> Option<Image<D>> {
        match self.across() {
            AcrossPeriodic::Site(image) => Some(image),
            AcrossPeriodic::Wall { .. } => None,
        }
    }

    /// Its corners, counter-clockwise seen from outside of the cell; those of a side with the cell on the left.
    pub fn points(self) -> impl ExactSizeIterator<Item = [f64; D]> + Clone + use<'a, T, D, N> {
        <T::Cells as Faces<D>>::indices(self.face).iter().map(move |&i| self.of.at(i))
    }

    /// The outward normal, of length one; none if rounding has left nothing of the face, see [`Face3::normal`].
    pub fn normal(self) -> Option<[f64; D]> {
        self.of.of.cells.normal(self.face)
    }

    /// From the site to the copy beyond, in coordinate units, rounded: normal to the face. None beyond walls.
    pub fn vector(self) -> Option<[f64; D]> {
        let Beyond::Site(beyond) = T::Cells::beyond(self.face) else { return None };
        let PeriodicCell { of: PeriodicCells { triangulation, .. }, site } = self.of;
        let (other, offset) = triangulation.quotient.image(beyond.index());
        let lattice = &triangulation.lattice;
        let there = lattice.moved(&triangulation.wrapped[other as usize].place, offset);
        let here = triangulation.wrapped[site.index()].place;
        Some(std::array::from_fn(|k| lattice.length(there[k] - here[k])))
    }
}

impl<T: CellularKind<2, 3>> PeriodicSide2<'_, T> {
    /// The length, in coordinate units.
    pub fn length(self) -> f64 {
        self.of.length(self.of.of.cells.face_size(self.face))
    }
}

impl<T: CellularKind<3, 4>> PeriodicFace3<'_, T> {
    /// The area, in coordinate units squared.
    pub fn area(self) -> f64 {
        let length = self.of.length(1.0);
        self.of.of.cells.face_size(self.face) * length * length
    }
}
