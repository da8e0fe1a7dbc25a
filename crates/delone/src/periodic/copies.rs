//! The copies of sites in the cell at the origin and in a halo around it.

use super::lattice::Prepared;
use crate::error::Error;
use crate::points::Bounds;

/// A copy of a site: which site, and how often each vector of the reduced basis is added.
pub(super) type Moved<const D: usize> = (u32, [i32; D]);

/// The cell without what is so near to the border of the halo, as part of its width: more than rounding.
const SHALLOW: f64 = 1e-6;

/// All copies in a convex region: the cell at the origin, and what is beside it up to a distance.
pub(super) struct Copies<const D: usize> {
    /// First the sites themselves.
    pub points: Vec<[f64; D]>,
    /// The site and the offset of each point after these.
    pub images: Vec<Moved<D>>,
    /// Of those points, which are not at the border of the region.
    pub deep: Vec<bool>,
}

impl<const D: usize> Copies<D> {
    /// The copies of places in the cell and so many periods beside it, along each vector of the reduced basis.
    ///
    /// # Errors
    /// [`Error::TooManyPoints`] above `most`.
    pub(super) fn around(
        lattice: &Prepared<D>,
        places: &[[f64; D]],
        margins: &[f64],
        most: usize,
    ) -> Result<Self, Error> {
        let reduced = &lattice.reduced;
        // About as many as the volume says: told before memory is taken.
        let expected = margins.iter().map(|m| 1.0 + 2.0 * m).product::<f64>() * places.len() as f64;
        if expected > most as f64 {
            return Err(Error::TooManyPoints { count: expected as usize, most });
        }
        let mut copies =
            Self { points: Vec::with_capacity(expected as usize + 16), images: Vec::new(), deep: Vec::new() };
        copies.points.extend_from_slice(places);
        for (site, place) in places.iter().enumerate() {
            let mut ranges = [(0, 0); D];
            for ((range, vector), margin) in ranges.iter_mut().zip(reduced).zip(margins) {
                let at = vector.fraction(place);
                *range = ((-margin - at).ceil() as i32, (1.0 + margin - at).floor() as i32);
            }
            copies.add(lattice, margins, (site as u32, place), &ranges);
        }
        Ok(copies)
    }

    /// The copies of one site whose offsets are in ranges.
    fn add(
        &mut self,
        lattice: &Prepared<D>,
        margins: &[f64],
        (site, place): (u32, &[f64; D]),
        ranges: &[(i32, i32); D],
    ) {
        let mut offset = ranges.map(|range| range.0);
        loop {
            if offset != [0; D] {
                let moved = lattice.moved(place, offset);
                let is_deep = lattice.reduced.iter().zip(margins).all(|(vector, margin)| {
                    let margin = margin * (1.0 - SHALLOW);
                    (-margin..=1.0 + margin).contains(&vector.fraction(&moved))
                });
                self.points.push(moved);
                self.images.push((site, offset));
                self.deep.push(is_deep);
            }
            let Some(axis) = (0..D).find(|&axis| offset[axis] < ranges[axis].1) else { return };
            offset[axis] += 1;
            offset[..axis].iter_mut().zip(ranges).for_each(|(at, range)| *at = range.0);
        }
    }
}

/// A halo to begin with, for sites that are evenly spread: about as wide as their largest empty ball, 2.5 to 3 distances between neighbors.
/// Of random sets of 10^3 to 3 10^4 sites one in twenty needs more.
///
/// Axes along which the cell is thinner than that distance do not count: sites in a needle are as sites on a line.
pub(super) fn first_halo<const D: usize>(lattice: &Prepared<D>, places: &[[f64; D]]) -> f64 {
    /// The largest empty ball of n random sites grows as the cubic root of the logarithm of n; this factor is found by trial.
    const SPACINGS: f64 = 1.12;
    let spacings = SPACINGS * libm::cbrt(f64::from(usize::BITS - places.len().leading_zeros()));
    // Along axes that do not repeat the sites have an extent of their own.
    let mut extents = Bounds::of(places.iter().copied()).extent();
    extents.sort_unstable_by(|a, b| b.total_cmp(a));
    let free = extents.into_iter().take(D - lattice.reduced.len());
    let mut widths: Vec<f64> = lattice.reduced.iter().map(|v| v.width).chain(free).collect();
    widths.sort_unstable_by(|a, b| b.total_cmp(a));
    while let Some((&least, wider)) = widths.split_last() {
        let volume: f64 = widths.iter().map(|width| width / least).product();
        // In units of the least width.
        let spacing = libm::pow(volume / places.len() as f64, 1.0 / widths.len() as f64);
        if spacing <= 1.0 || wider.is_empty() {
            return spacings * spacing * least;
        }
        widths.pop();
    }
    f64::INFINITY
}
