//! Periodic triangulations: of sites and of all their copies by the vectors of a lattice.
//!
//! *Statement.* Let S be a finite set of sites, and L a lattice that repeats along some axes. Each Delaunay polytope of S + L (the sites of a
//! maximal empty sphere) is cut by placing its corners in lexicographic order. That is the canonical triangulation T. It is
//! invariant under L, and a simplex is in T if and only if it is in the canonical triangulation of every finite part of S + L that has all
//! sites of its closed ball.
//!
//! *Proof.* Signs depend on the sites of one predicate and on their lexicographic order alone, and translation changes neither. A polytope has
//! finitely many corners, because S + L is discrete. On a facet of two polytopes both sides place the same corners in the same order. With
//! weights the height replaces the squared distance.
//!
//! So the periodic triangulation is a part of an ordinary one, of enough copies; `quotient` proves that they are enough, without
//! rounding. No copy is rounded either: `lattice` puts sites and vectors on a common grid first.
//!
//! Cost: for evenly spread sites in space 1.5 times that of the plain triangulation of 10^6, 1.7 of 10^5, 3 of 10^4 and 4.5 of 10^3 (28 November
//! 2026, `compare -- --periodic`). Sites in dense clusters cost up to that of all copies within twice the covering radius of the lattice, some 90
//! of each in a cube.

mod cells;
mod copies;
mod faces;
mod flat;
mod kinds;
mod lattice;
mod quotient;
mod reduced;
mod walls;

pub use cells::{
    AcrossPeriodic, AcrossPeriodic2, AcrossPeriodic3, PeriodicCell, PeriodicCell2, PeriodicCell3,
    PeriodicCells, PeriodicCells2, PeriodicCells3, PeriodicFace, PeriodicFace3, PeriodicSide2,
};
pub use kinds::{CellularKind, PeriodicKind};
pub use lattice::{Grid, Lattice, Lattice2, Lattice3};

use copies::{Copies, first_halo};
use lattice::{Prepared, Wrapped};
use quotient::Quotient;
use reduced::{MORE, covering_radius};

use crate::error::Error;
use crate::ids::{Duplicate, VertexId};
use crate::mesh::Dimension;
use crate::plane::{Delaunay2, Regular2};
use crate::points::check_weights;
use crate::space::{Delaunay3, Regular3};

/// A copy of a site: the site, and how often each axis of the lattice is added to its point.
pub type Image<const D: usize> = (VertexId, [i64; D]);

/// A triangulation that repeats, of a kind, in D dimensions, with N corners a simplex. See [`Periodic2`], [`Periodic3`],
/// [`PeriodicRegular2`], [`PeriodicRegular3`].
///
/// Each simplex stands for all its translates: its least corner in lexicographic order is a site as it was given, with the offset zero. A site may
/// be a corner of a simplex twice, in different copies, and its own neighbor: see [`Self::is_simplicial`].
///
/// ```
/// use delone::{Lattice3, Periodic3};
///
/// // One site in a cube that repeats: seven edges lead to its own copies, and six tetrahedra fill the cube.
/// let cube = Lattice3::with_sides([1.0, 1.0, 1.0])?;
/// let alone = Periodic3::from_points(&[[0.5, 0.5, 0.5]], &cube)?;
/// assert_eq!(alone.simplices().count(), 6);
/// assert_eq!(alone.edges().count(), 7);
/// assert!(!alone.is_simplicial());
///
/// for simplex in alone.simplices() {
///     for (site, offset) in simplex {
///         assert_eq!(alone.position((site, offset)), std::array::from_fn(|k| 0.5 + offset[k] as f64));
///     }
/// }
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
#[doc(alias("Periodic_3_Delaunay_triangulation_3", "Periodic_2_Delaunay_triangulation_2", "torus"))]
pub struct Periodic<T: PeriodicKind<D, N>, const D: usize, const N: usize> {
    lattice: Prepared<D>,
    /// Where the sites are in the cell of the reduced basis.
    wrapped: Vec<Wrapped<D>>,
    rounding: f64,
    quotient: Quotient<T, D, N>,
}

/// The periodic Delaunay triangulation of points of the plane.
pub type Periodic2 = Periodic<Delaunay2, 2, 3>;
/// The periodic Delaunay triangulation of points of space.
pub type Periodic3 = Periodic<Delaunay3, 3, 4>;
/// The periodic regular triangulation of sites with weights in the plane.
pub type PeriodicRegular2 = Periodic<Regular2, 2, 3>;
/// The periodic regular triangulation of sites with weights in space.
pub type PeriodicRegular3 = Periodic<Regular3, 3, 4>;

impl Periodic2 {
    /// Triangulates points and all their copies. They may be anywhere: only where they are in the lattice matters.
    ///
    /// # Errors
    /// As [`Periodic3::from_points`].
    pub fn from_points(points: &[[f64; 2]], lattice: &Lattice2) -> Result<Self, Error> {
        Self::build(points, &[], lattice)
    }
}

impl Periodic3 {
    /// Triangulates points and all their copies. They may be anywhere: only where they are in the lattice matters.
    ///
    /// # Errors
    /// [`Error::NotFinite`] and [`Error::FarAway`] by point; [`Error::Lattice`] if an axis vanishes on a grid that was chosen;
    /// [`Error::TooManyPoints`], [`Error::TooManyTetrahedra`] if so many copies are needed.
    pub fn from_points(points: &[[f64; 3]], lattice: &Lattice3) -> Result<Self, Error> {
        Self::build(points, &[], lattice)
    }
}

macro_rules! regular {
    ($kind:ident, $lattice:ident, $d:literal) => {
        impl $kind {
            /// Triangulates sites with weights, squared radii in coordinate units, and all their copies.
            ///
            /// # Errors
            /// As [`Periodic3::from_points`]; [`Error::Length`] if there are not as many weights as points, and [`Error::Weight`].
            pub fn from_parts(
                points: &[[f64; $d]],
                weights: &[f64],
                lattice: &$lattice,
            ) -> Result<Self, Error> {
                if weights.len() != points.len() {
                    return Err(Error::Length { expected: points.len(), found: weights.len() });
                }
                check_weights(weights)?;
                Self::build(points, weights, lattice)
            }
        }
    };
}

regular!(PeriodicRegular2, Lattice2, 2);
regular!(PeriodicRegular3, Lattice3, 3);

impl<T: PeriodicKind<D, N>, const D: usize, const N: usize> Periodic<T, D, N> {
    fn build(points: &[[f64; D]], weights: &[f64], lattice: &Lattice<D>) -> Result<Self, Error> {
        if points.len() > T::MOST_POINTS {
            return Err(Error::TooManyPoints { count: points.len(), most: T::MOST_POINTS });
        }
        for (index, point) in points.iter().enumerate() {
            if let Some(axis) = point.iter().position(|x| !x.is_finite()) {
                return Err(Error::NotFinite { index, axis, value: point[axis] });
            }
        }
        let lattice = lattice.prepare(points)?;
        let wrap = |(index, &point): (usize, &[f64; D])| {
            lattice.wrap(point).map_err(|axis| Error::FarAway { index, axis, value: point[axis] })
        };
        let all = points.iter().enumerate().map(wrap).collect::<Result<Vec<_>, _>>()?;
        let (wrapped, roundings): (Vec<_>, Vec<f64>) = all.into_iter().unzip();
        let rounding = roundings.into_iter().fold(lattice.rounding, f64::max);
        let places: Vec<[f64; D]> = wrapped.iter().map(|at| at.place).collect();
        let weights: Vec<f64> = weights.iter().map(|&w| lattice.weight(w)).collect();
        let quotient = triangulate::<T, D, N>(&lattice, &places, &weights)?;
        Ok(Self { lattice, wrapped, rounding, quotient })
    }

    /// The dimension of the span of all copies. Below D there are no simplices.
    pub fn dimension(&self) -> Dimension {
        self.quotient.copies.dimension()
    }

    /// The number of points given: one more than the largest index of a site.
    pub fn ids_given(&self) -> usize {
        self.wrapped.len()
    }

    /// The sites that are vertices, by increasing index.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        let sites = self.quotient.vertices.iter().enumerate();
        sites.filter(|(_, is_vertex)| **is_vertex).map(|(i, _)| VertexId::new(i))
    }

    /// The sites that equal a copy of a vertex, by increasing index, with that copy: of sites at one place of the lattice the first given is the
    /// vertex. With weights the heaviest is, and these are of equal weight.
    pub fn duplicates(&self) -> impl Iterator<Item = (VertexId, Image<D>)> + '_ {
        let sites = self.quotient.copies.duplicates().take_while(|twin| twin.point < self.wrapped.len());
        sites.map(|Duplicate { point, vertex }| {
            let [own, stays] = [point, vertex.index()].map(|i| self.wrapped[i].offset);
            let offset = std::array::from_fn(|k| own[k] - stays[k]);
            (VertexId::new(point), (vertex, self.lattice.in_axes(offset)))
        })
    }

    /// The sites that are no vertices and equal none: those with an empty power cell, by increasing index.
    pub fn hidden(&self) -> impl Iterator<Item = VertexId> + '_ {
        let mut twins = self.duplicates().map(|twin| twin.0).peekable();
        let others = (0..self.wrapped.len()).filter(|&i| !self.quotient.vertices[i]).map(VertexId::new);
        others.filter(move |v| twins.next_if_eq(v).is_none())
    }

    /// The simplices in positive order, each by the copies that are its corners: triangles counter-clockwise, of tetrahedra the first three
    /// corners counter-clockwise seen from the fourth.
    #[doc(alias("tetrahedra", "triangles", "finite_cells"))]
    pub fn simplices(&self) -> impl Iterator<Item = [Image<D>; N]> + '_ {
        (0..self.simplex_count()).map(|i| self.simplex(i))
    }

    /// The number of simplices, up to translation.
    pub fn simplex_count(&self) -> usize {
        self.quotient.simplices.len()
    }

    /// The corners of a simplex, by its number in [`Self::simplices`].
    ///
    /// # Panics
    /// For a number that is too large.
    pub fn simplex(&self, number: usize) -> [Image<D>; N] {
        let corners = self.quotient.corners(number);
        // The least corner is at the site's place in the cell.
        let least = corners.iter().filter(|corner| corner.1 == [0; D]);
        let place = |corner: &&(u32, [i32; D])| self.place(corner.0).place;
        let least = least.min_by(|a, b| place(a).partial_cmp(&place(b)).unwrap_or(std::cmp::Ordering::Equal));
        let from = least.map_or([0; D], |corner| self.place(corner.0).offset);
        corners.map(|corner| self.image(corner, from))
    }

    /// The simplices across the facets of a simplex: that opposite to corner k has the number `[k].0`, and the offset `[k].1` is to be added
    /// to all of its corners. `None` where the triangulation ends, along axes that do not repeat.
    ///
    /// # Panics
    /// For a number that is too large.
    pub fn neighbors(&self, number: usize) -> [Option<(usize, [i64; D])>; N] {
        let here = self.origin(number);
        std::array::from_fn(|k| {
            let (other, offset) = self.quotient.across(number, k)?;
            let there = self.origin(other);
            let offset = self.lattice.in_axes(offset.map(i64::from));
            Some((other, std::array::from_fn(|i| offset[i] + here[i] - there[i])))
        })
    }

    /// The edges, up to translation, each once: from a site to a copy of one, or of itself.
    pub fn edges(&self) -> impl Iterator<Item = (VertexId, Image<D>)> + '_ {
        let edges = self.quotient.faces(2).into_iter();
        edges.map(|edge| {
            let from = self.place(edge[0].0).offset;
            (VertexId::new(edge[0].0 as usize), self.image(edge[1], from))
        })
    }

    /// How many faces there are of 1, 2, ... N corners, up to translation.
    pub fn face_counts(&self) -> [usize; N] {
        std::array::from_fn(|k| self.quotient.faces(k + 1).len())
    }

    /// Whether the simplices are a simplicial complex when all copies of a site are one vertex: no simplex has a site as corner twice, and no two have
    /// the same corners. True for evenly spread sites from some fifty on. O(n log n).
    pub fn is_simplicial(&self) -> bool {
        (2..=N).all(|size| self.quotient.is_known_by_sites(size))
    }

    /// The coordinates of a copy of a site: those of the site on the grid, and the axes of the lattice added, rounded.
    ///
    /// # Panics
    /// For an id that is no site.
    pub fn position(&self, (site, offset): Image<D>) -> [f64; D] {
        let Wrapped { place, offset: from } = self.wrapped[site.index()];
        let from = self.lattice.in_axes(from);
        self.lattice.far(&place, std::array::from_fn(|k| offset[k] + from[k]))
    }

    /// By how much a coordinate of a point, or of an axis along which it repeats, was rounded at most, so that copies are exact, in coordinate
    /// units: zero for integers and other numbers with few bits.
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// The step of the decimal grid that was taken, if one was.
    pub fn decimal_step(&self) -> Option<f64> {
        self.lattice.decimal.map(crate::DecimalGrid::step)
    }

    fn place(&self, site: u32) -> &Wrapped<D> {
        &self.wrapped[site as usize]
    }

    /// A copy, seen from an offset of the reduced basis.
    fn image(&self, (site, offset): (u32, [i32; D]), from: [i64; D]) -> Image<D> {
        let own = self.place(site).offset;
        // The copy is at the place in the cell, moved; the point is there, moved by its own offset.
        let times = std::array::from_fn(|k| i64::from(offset[k]) - own[k] + from[k]);
        (VertexId::new(site as usize), self.lattice.in_axes(times))
    }

    /// How far a simplex as it is told is from the one in the cell.
    fn origin(&self, number: usize) -> [i64; D] {
        let (site, offset) = self.quotient.corners(number)[0];
        let told = self.simplex(number)[0].1;
        let own = self.lattice.in_axes(self.place(site).offset);
        let offset = self.lattice.in_axes(offset.map(i64::from));
        std::array::from_fn(|k| told[k] + own[k] - offset[k])
    }
}

/// Triangulates copies in wider and wider halos, until they are enough.
fn triangulate<T: PeriodicKind<D, N>, const D: usize, const N: usize>(
    lattice: &Prepared<D>,
    places: &[[f64; D]],
    weights: &[f64],
) -> Result<Quotient<T, D, N>, Error> {
    /// Where a cell is far thinner along one axis than along another, wide spheres touch few of the copies beside it.
    const FIRST_PERIODS: f64 = 2.5;
    /// A step costs at most as much as all steps before it.
    const WIDER: f64 = 1.5;
    let widest = 2.0 * MORE * covering_radius(&lattice.reduced);
    let (mut halo, mut periods) = (first_halo(lattice, places), FIRST_PERIODS);
    loop {
        let margins: Vec<f64> =
            lattice.reduced.iter().map(|v| (halo.min(widest) / v.width).min(periods)).collect();
        let is_widest = lattice.reduced.iter().zip(&margins).all(|(v, &margin)| margin >= widest / v.width);
        if let Some(quotient) = within(lattice, places, weights, &margins)? {
            // What spans less than the whole in a narrow halo may span more in a wider one.
            if is_widest || !quotient.simplices.is_empty() {
                return Ok(quotient);
            }
        }
        assert!(!is_widest, "copies within twice the covering radius are enough");
        (halo, periods) = (WIDER * halo, WIDER * periods);
    }
}

/// The triangulation, if copies in the cell and so many periods beside it, along each vector of the reduced basis, are enough for it.
fn within<T: PeriodicKind<D, N>, const D: usize, const N: usize>(
    lattice: &Prepared<D>,
    places: &[[f64; D]],
    weights: &[f64],
    margins: &[f64],
) -> Result<Option<Quotient<T, D, N>>, Error> {
    let found = Copies::around(lattice, places, margins, T::MOST_POINTS)?;
    let weighed = found.images.iter().filter(|_| !weights.is_empty()).map(|image| weights[image.0 as usize]);
    let weighed: Vec<f64> = weights.iter().copied().chain(weighed).collect();
    let copies = T::build(&found.points, &weighed)?;
    Ok(Quotient::of(lattice, copies, found))
}

#[cfg(test)]
mod tests;
