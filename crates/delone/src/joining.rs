//! Vertices that are one to a reader: sides of a diagram up to a length are contracted.
//!
//! Sites on a lattice of decimals, turned, or moved to the offset of a map, are not on one circle any more: where cells met in a vertex there
//! are two, apart by rounding. Here they become one again, if a reader asks for it.
//!
//! The shortest side goes first, and of its ends the lexicographically greater moves to the other. So the outcome is a function of the places
//! and sides, whatever their order, and no side up to the length is left. A vertex that is at the end of a chain of short sides may
//! move by more than the length.
//!
//! Cost: O(n log n) for n places and sides, in each of a few rounds.

use std::cmp::Ordering;

use crate::error::Error;
use crate::sets::Sets;
use crate::sorting;
use crate::triangulation::Coordinates;

/// The length up to which sides are contracted if a reader leaves it to us, as a part of the largest coordinate: 2^-40, 4096 times the last
/// place of a number. A vertex of a lattice moves by a few last places; a survey in millimetres of a country is still told apart.
pub const MERGE_AUTO: f64 = 9.094_947_017_729_282e-13;

/// Which vertex of a diagram each vertex becomes, if sides up to a length are contracted.
///
/// `places` are the vertices, in the plane or in space; `sides` their pairs as indices; the length is in coordinate units.
/// Vertices at equal places become one, too; those that are not finite are near to none. The answer has for each vertex the index of the one that it becomes. See
/// [`MERGE_AUTO`] for a length of rounding.
///
/// Errors: a length that is negative or not finite ([`Error::Parameter`]), a side with an index of no vertex ([`Error::NoSuchPoint`]).
///
/// Cost: O(n log n) for n vertices and sides, in each of a few rounds.
///
/// ```
/// use delone::{Delaunay3, Triangulation, merged_vertices};
///
/// // A cube of side 0.1, moved by what decimals do not bear: its corners are not on one sphere any more.
/// let at = |i: usize| [0.1 * (i % 2) as f64 + 0.7, 0.1 * (i / 2 % 2) as f64 + 0.3, 0.1 * (i / 4) as f64];
/// let d = Delaunay3::from_points(&[0, 1, 2, 3, 4, 5, 6, 7].map(at))?;
/// let all: Vec<_> = d.tetrahedron_ids().collect();
/// let centers: Vec<[f64; 3]> = all.iter().filter_map(|&t| d.circumcenter(t)).collect();
/// // Tetrahedra across from each other have a side of the diagram between their centers.
/// let number = |t| all.iter().position(|&other| other == t).map(|i| i as u32);
/// let across = all.iter().flat_map(|&t| (0..4).map(move |k| (t, k)));
/// let sides: Vec<[u32; 2]> =
///     across.filter_map(|(t, k)| Some([number(t)?, number(d.across(t, k)?)?])).collect();
/// let merged = merged_vertices(&centers, &sides, 1e-12)?;
/// assert!(merged.iter().all(|&i| i == merged[0]));
/// # Ok::<(), delone::Error>(())
/// ```
pub fn merged_vertices<P: Coordinates>(
    places: &[P],
    sides: &[[u32; 2]],
    length: f64,
) -> Result<Vec<u32>, Error> {
    check(length)?;
    let count = places.len();
    if let Some((segment, index)) = sides.iter().enumerate().find_map(|(segment, side)| {
        side.iter().find(|&&i| i as usize >= count).map(|&i| (segment, i as usize))
    }) {
        return Err(Error::NoSuchPoint { segment, index, count });
    }
    Ok(Numbered::of(places).joined(sides, length, &|_, _| true))
}

/// Whether a length is one.
pub(crate) fn check(length: f64) -> Result<(), Error> {
    if length >= 0.0 && length.is_finite() {
        Ok(())
    } else {
        Err(Error::Parameter { name: "merge", value: length, range: "a length: not negative, and finite" })
    }
}

/// Compares by the first coordinate that differs; zeros are equal, and NaN has an order too, or no sort would end well.
fn compare<P: Coordinates>(p: &P, q: &P) -> Ordering {
    let mut both = p.as_ref().iter().zip(q.as_ref());
    both.find_map(|(x, y)| (x != y).then(|| x.total_cmp(y))).unwrap_or(Ordering::Equal)
}

/// Places by number: by rank, then lexicographically. Equal ones have one number.
pub(crate) struct Numbered<'a, P> {
    places: &'a [P],
    /// By number, an index of the place.
    indices: Vec<u32>,
    /// By index.
    numbers: Vec<u32>,
    /// By number.
    ranks: Vec<u8>,
}

impl<'a, P: Coordinates> Numbered<'a, P> {
    /// All of one rank.
    pub(crate) fn of(places: &'a [P]) -> Self {
        let mut indices: Vec<u32> = (0..places.len() as u32).collect();
        let at = |i: u32| &places[i as usize];
        // This is most of the work.
        indices.sort_by(|&i, &j| compare(at(i), at(j)));
        let mut numbers = vec![0; places.len()];
        let mut count = 0;
        for k in 0..indices.len() {
            if k > 0 && at(indices[k]) != at(indices[count - 1]) || k == 0 {
                indices[count] = indices[k];
                count += 1;
            }
            numbers[indices[k] as usize] = count as u32 - 1;
        }
        indices.truncate(count);
        Self { places, indices, numbers, ranks: vec![0; count] }
    }

    /// For each place the index of one that it equals, the same for all of them.
    pub(crate) fn equal(&self) -> Vec<u32> {
        self.numbers.iter().map(|&number| self.indices[number as usize]).collect()
    }

    /// Gives the places ranks, by index: of two that become one, the place of the lower rank stays.
    pub(crate) fn ranked(self, rank: impl Fn(usize) -> u8) -> Self {
        let ranks: Vec<u8> = self.indices.iter().map(|&i| rank(i as usize)).collect();
        let mut order: Vec<u32> = (0..ranks.len() as u32).collect();
        order.sort_by_key(|&number| ranks[number as usize]);
        let mut new = vec![0; order.len()];
        order.iter().enumerate().for_each(|(number, &old)| new[old as usize] = number as u32);
        Self {
            places: self.places,
            indices: order.iter().map(|&old| self.indices[old as usize]).collect(),
            numbers: self.numbers.iter().map(|&old| new[old as usize]).collect(),
            ranks: order.iter().map(|&old| ranks[old as usize]).collect(),
        }
    }

    fn place(&self, number: u32) -> &P {
        &self.places[self.indices[number as usize] as usize]
    }

    /// For each place the index of that which it becomes if sides up to a length are contracted which may be: asked with the ranks of
    /// their ends as they are then, and the index of the side.
    pub(crate) fn joined(
        &self,
        sides: &[[u32; 2]],
        length: f64,
        may: &dyn Fn([u8; 2], usize) -> bool,
    ) -> Vec<u32> {
        let mut sets = Sets::new(self.indices.len());
        let ends = |sets: &mut Sets, side: usize| {
            let [a, b] = sides[side].map(|i| sets.find(self.numbers[i as usize]));
            let part = part(self.place(a), self.place(b), length);
            let ranks = [a, b].map(|number| self.ranks[number as usize]);
            (a != b && part <= 1.0 && may(ranks, side)).then_some((part, [a.min(b), a.max(b)]))
        };
        loop {
            let short = (0..sides.len()).filter_map(|side| Some((ends(&mut sets, side)?, side)));
            let mut short: Vec<((f64, [u32; 2]), usize)> = short.collect();
            if short.is_empty() {
                break;
            }
            sorting::by(&mut short, |((p, a), _), ((q, b), _)| p.total_cmp(q).then_with(|| a.cmp(b)));
            for (_, side) in short {
                // Those before may have moved its ends apart.
                if let Some((_, [a, b])) = ends(&mut sets, side) {
                    sets.join(a, b);
                }
            }
        }
        self.numbers.iter().map(|&number| self.indices[sets.find(number) as usize]).collect()
    }
}

/// The distance of two places as a part of a length; above one also where it is not a number.
fn part<P: Coordinates>(p: &P, q: &P, length: f64) -> f64 {
    let mut sum = 0.0;
    for (x, y) in p.as_ref().iter().zip(q.as_ref()) {
        let apart = (x - y).abs();
        // Zero over zero is no number.
        let along = if apart == 0.0 { 0.0 } else { apart / length };
        sum += along * along;
    }
    if sum <= 1.0 { sum.sqrt() } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::merged_vertices;
    use crate::error::Error;

    #[test]
    fn short_sides_are_contracted_to_their_least_ends() {
        let places = [[3.0, 0.0], [0.0, 0.0], [0.0, 1.0], [0.0, 0.0], [0.5, 0.0], [f64::INFINITY; 2]];
        let sides = [[0, 4], [4, 1], [1, 2], [0, 5]];
        let of = |length| merged_vertices(&places, &sides, length).expect("a length");
        assert_eq!(of(0.0), [0, 1, 2, 1, 4, 5]);
        assert_eq!(of(0.5), [0, 1, 2, 1, 1, 5]);
        assert_eq!(of(1.0), [0, 1, 1, 1, 1, 5]);
        assert_eq!(of(f64::MAX), [1, 1, 1, 1, 1, 5]);
    }

    /// Whatever the order, at any scale; and no short side is left.
    #[test]
    fn chains_become_one_vertex_a_length() {
        let count = 60_u32;
        for scale in [1.0, 2.0_f64.powi(-1000), 2.0_f64.powi(1000)] {
            let at = |i: u32| [f64::from(i) * scale, f64::from(i * i % 7) * scale / 64.0, 0.0];
            let places: Vec<[f64; 3]> = (0..count).map(at).collect();
            let mut sides: Vec<[u32; 2]> = (1..count).map(|i| [i - 1, i]).collect();
            let length = 2.5 * scale;
            let merged = merged_vertices(&places, &sides, length).expect("a length");
            sides.reverse();
            sides.iter_mut().for_each(|side| side.reverse());
            assert_eq!(merged_vertices(&places, &sides, length).expect("a length"), merged);
            let backwards: Vec<[f64; 3]> = places.iter().rev().copied().collect();
            let mirrored: Vec<u32> = merged_vertices(&backwards, &sides, length)
                .expect("a length")
                .iter()
                .rev()
                .map(|i| count - 1 - i)
                .collect();
            assert_eq!(mirrored, merged);
            for [i, j] in sides {
                let [i, j] = [i, j].map(|i| merged[i as usize]);
                assert!(i == j || i.abs_diff(j) > 2, "{i} and {j} are near");
            }
        }
    }

    #[test]
    fn lengths_and_sides_are_checked() {
        for length in [-1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(merged_vertices(&[[0.0; 2]], &[], length), Err(Error::Parameter { .. })));
        }
        // What is no place is near to none, and nothing panics.
        let places: Vec<[f64; 2]> =
            (0..200).map(|i| [[f64::NAN, 1.0, f64::INFINITY][i % 3], i as f64]).collect();
        let sides: Vec<[u32; 2]> = (0..199).map(|i| [i, i + 1]).collect();
        assert_eq!(merged_vertices(&places, &sides, 9.0), Ok((0..200).collect()));
        let wrong = merged_vertices(&[[0.0; 2]], &[[0, 0], [0, 1]], 1.0);
        assert_eq!(wrong, Err(Error::NoSuchPoint { segment: 1, index: 1, count: 1 }));
    }
}
