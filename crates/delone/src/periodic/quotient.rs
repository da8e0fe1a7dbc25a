//! The triangulation of all copies, up to translation; and the proof that a part of it is enough.
//!
//! F is the set of all copies in a convex region, T(F) its triangulation, T the periodic one. Of all translates of a simplex one has its
//! lexicographically least corner at a site of the cell; it stands for them.
//!
//! *Proof.* Let C be the simplices of T(F) that stand for themselves, H all simplices with a corner at a site of the cell. The test is: each
//! simplex of H is the translate of one in C; each translate of a simplex in C that has a corner at a site of the cell is in H; no corner of C
//! is at the border of the region; a facet with such a corner and without a neighbor
//! is parallel to the lattice. Then C is T:
//!
//! 1. Each facet has a translate whose least corner is at a site. Both simplices there are in H, so C and its translates are closed: across
//!    each facet there is one of them, or the facet is on the hull of all copies. Across it both spheres are locally empty, as in T(F).
//! 2. From a simplex s in C to any copy q, walk along a segment from simplex to simplex. The power of q to the spheres on the way
//!    decreases, and the last simplex contains q. It has a translate in C, in the region, where T(F) knows of all copies: the
//!    power of q to its sphere is not negative. So q is not inside of the sphere of s.
//! 3. So each simplex of C is one of T, and because C is closed and T is connected it is all of T.
//!
//! If the test fails, the halo is widened. It cannot fail for a halo of twice the covering radius r of the lattice, measured in its
//! span: a ball that has a site on it and no copies of that site inside has its center within r of the site.
//!
//! Cost: O(n), and a sort of what lies across the border of the cell.

use std::cmp::Ordering;

use super::copies::{Copies, Moved};
use super::kinds::PeriodicKind;
use super::lattice::Prepared;
use crate::ids::VertexId;
use crate::triangulation::Corners;

/// No number of a simplex.
const NONE: u32 = u32::MAX;

/// A simplex of H that does not stand for itself: a translate of one that does.
#[derive(Clone, Copy, Debug)]
pub(super) struct Translate<S, const D: usize> {
    /// The number of that one.
    pub number: u32,
    pub offset: [i32; D],
    pub simplex: S,
}

/// See the module.
#[derive(Clone, Debug)]
pub(super) struct Quotient<T: PeriodicKind<D, N>, const D: usize, const N: usize> {
    /// The triangulation of the copies.
    pub copies: T,
    /// The site and the offset of each vertex after the sites.
    pub images: Vec<Moved<D>>,
    /// How many sites there are.
    pub sites: usize,
    /// Which of them are vertices.
    pub(super) vertices: Vec<bool>,
    /// The simplices that stand for themselves.
    pub simplices: Vec<T::Simplex>,
    /// By slot of a simplex of H the number of the one that stands for it.
    numbers: Vec<u32>,
    /// By number, then offset.
    translates: Vec<Translate<T::Simplex, D>>,
    /// Their indices, by simplex.
    by_simplex: Vec<u32>,
}

impl<T: PeriodicKind<D, N>, const D: usize, const N: usize> Quotient<T, D, N> {
    /// The periodic triangulation in that of its copies; `None` if these are too few.
    pub(super) fn of(lattice: &Prepared<D>, copies: T, found: Copies<D>) -> Option<Self> {
        let Copies { points, images, deep } = found;
        let sites = points.len() - images.len();
        let mut vertices = vec![false; sites];
        copies.vertices().map(VertexId::index).take_while(|&v| v < sites).for_each(|v| vertices[v] = true);
        let mut quotient = Self {
            numbers: vec![NONE; copies.slot_count()],
            copies,
            images,
            sites,
            vertices,
            simplices: Vec::with_capacity(7 * sites),
            translates: Vec::new(),
            by_simplex: Vec::new(),
        };
        let is_on_hull = |facet: T::Facet| Self::is_on_hull(lattice, &points, facet);
        let mut facets = quotient.copies.hull_facets().filter(|facet| facet.indices().any(|v| v < sites));
        let is_flat = quotient.copies.simplices().next().is_none();
        if !is_flat && !facets.all(is_on_hull) {
            return None;
        }
        drop(facets);
        // Simplices with corners at sites and at copies: corners from the least one on, sorted, and the number; or the translation.
        let (mut mixed, mut moved) = (Vec::new(), Vec::new());
        let push = |quotient: &mut Self, simplex: T::Simplex| {
            let number = quotient.simplices.len() as u32;
            quotient.numbers[quotient.copies.index(simplex)] = number;
            quotient.simplices.push(simplex);
            number
        };
        for simplex in quotient.copies.simplices().collect::<Vec<_>>() {
            let corners = quotient.copies.corners(simplex).map(VertexId::index);
            if corners.iter().all(|&v| v >= sites) {
                continue;
            }
            if corners.iter().all(|&v| v < sites) {
                push(&mut quotient, simplex);
                continue;
            }
            let least = least(corners, &points);
            let from = quotient.image(least).1;
            let key = quotient.key(corners, from);
            if from == [0; D] {
                if corners.iter().any(|&v| v >= sites && !deep[v - sites]) {
                    return None;
                }
                mixed.push((key, push(&mut quotient, simplex)));
            } else {
                moved.push((key, from, simplex));
            }
        }
        mixed.sort_unstable();
        for (key, offset, simplex) in moved {
            let at = mixed.binary_search_by(|(other, _)| other.cmp(&key)).ok()?;
            let number = mixed[at].1;
            quotient.numbers[quotient.copies.index(simplex)] = number;
            quotient.translates.push(Translate { number, offset, simplex });
        }
        quotient.translates.sort_unstable_by_key(|t| (t.number, t.offset));
        if !quotient.has_all_translates(mixed) {
            return None;
        }
        let mut by_simplex: Vec<u32> = (0..quotient.translates.len() as u32).collect();
        by_simplex.sort_unstable_by_key(|&i| quotient.translates[i as usize].simplex);
        quotient.by_simplex = by_simplex;
        Some(quotient)
    }

    /// Whether each translate with a corner at a site is there: of a simplex as many as it has corners at different copies, less itself.
    fn has_all_translates(&self, mut mixed: Vec<([Moved<D>; N], u32)>) -> bool {
        mixed.sort_unstable_by_key(|entry| entry.1);
        let mut rest = &self.translates[..];
        mixed.iter().all(|(key, number)| {
            let mut offsets = key.map(|corner| corner.1);
            offsets.sort_unstable();
            let expected = offsets.windows(2).filter(|pair| pair[0] != pair[1]).count();
            let found = rest.iter().take_while(|t| t.number == *number).count();
            rest = &rest[found..];
            found == expected
        })
    }

    /// Whether a facet of the hull of the copies that are there is one of the hull of all: a plane with all sites on one side that is
    /// parallel to the lattice.
    fn is_on_hull(lattice: &Prepared<D>, points: &[[f64; D]], facet: T::Facet) -> bool {
        let mut places = [[0.0; D]; D];
        places.iter_mut().zip(facet.indices()).for_each(|(place, v)| *place = points[v]);
        // All of space is no half of it.
        lattice.reduced.len() < D
            && (0..lattice.reduced.len()).all(|i| {
                let step = std::array::from_fn(|j| i32::from(i == j));
                T::is_in_plane(&places, lattice.moved(&places[0], step))
            })
    }

    /// The site of a vertex, and the offset of the copy.
    pub(super) fn image(&self, v: usize) -> Moved<D> {
        if v < self.sites { (v as u32, [0; D]) } else { self.images[v - self.sites] }
    }

    /// The corners of a simplex in order, seen from an offset.
    fn key(&self, corners: [usize; N], from: [i32; D]) -> [Moved<D>; N] {
        let mut key = corners.map(|v| {
            let (site, offset) = self.image(v);
            (site, minus(offset, from))
        });
        key.sort_unstable();
        key
    }

    /// The corners of the simplex with a number.
    pub(super) fn corners(&self, number: usize) -> [Moved<D>; N] {
        self.copies.corners(self.simplices[number]).map(|v| self.image(v.index()))
    }

    /// The number of the simplex across the facet opposite to corner `k`, and the offset to be added to its corners; `None` on the hull.
    pub(super) fn across(&self, number: usize, k: usize) -> Option<(usize, [i32; D])> {
        let simplex = self.simplices[number];
        let corners = self.copies.corners(simplex).map(VertexId::index);
        let facet = (0..N).filter(|&i| i != k).map(|i| corners[i]);
        // Where the facet has a corner at a site, T(F) is right on both sides.
        let site = facet.clone().find(|&v| v < self.sites);
        let offset = site.or_else(|| facet.min()).map_or([0; D], |v| self.image(v).1);
        let (there, k) = if offset == [0; D] {
            (simplex, k)
        } else {
            let there = self.translate(number as u32, minus([0; D], offset))?;
            let apex = self.image(corners[k]);
            let moved = (apex.0, minus(apex.1, offset));
            let is_apex = |v: &VertexId| self.image(v.index()) == moved;
            (there, self.copies.corners(there).iter().position(is_apex)?)
        };
        let (number, from) = self.number(self.copies.across(there, k)?)?;
        Some((number, std::array::from_fn(|i| from[i] + offset[i])))
    }

    /// The translate of a simplex that has a corner at a site.
    fn translate(&self, number: u32, offset: [i32; D]) -> Option<T::Simplex> {
        let order = |t: &Translate<T::Simplex, D>| (t.number, t.offset).cmp(&(number, offset));
        self.translates.binary_search_by(order).ok().map(|at| self.translates[at].simplex)
    }

    /// The number of the simplex that a simplex of H is a translate of, and the translation.
    fn number(&self, simplex: T::Simplex) -> Option<(usize, [i32; D])> {
        let number = self.numbers[self.copies.index(simplex)];
        let standing = *self.simplices.get(number as usize)?;
        if standing == simplex {
            return Some((number as usize, [0; D]));
        }
        let order = |&i: &u32| self.translates[i as usize].simplex.cmp(&simplex);
        let at = self.by_simplex.binary_search_by(order).ok()?;
        Some((number as usize, self.translates[self.by_simplex[at] as usize].offset))
    }
}

/// The least of some corners in lexicographic order.
fn least<const D: usize, const N: usize>(corners: [usize; N], points: &[[f64; D]]) -> usize {
    let order = |a: &[f64; D], b: &[f64; D]| a.partial_cmp(b).unwrap_or(Ordering::Equal);
    corners.into_iter().min_by(|&v, &w| order(&points[v], &points[w])).unwrap_or(0)
}

pub(super) fn minus<const D: usize>(u: [i32; D], v: [i32; D]) -> [i32; D] {
    std::array::from_fn(|k| u[k] - v[k])
}
