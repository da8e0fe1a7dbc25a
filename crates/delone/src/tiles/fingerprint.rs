//! Fingerprints: a short number of a set of triangles, independent of their order and numbering.
//!
//! Coordinates are hashed, corners combined symmetrically, triangles summed. So it is a function of the set alone, sums of parts add
//! up to that of the whole, and no triangulation has to be in memory.
//!
//! Cost: O(1) a triangle, about a twentieth of what it takes to find it. Sets of triangles that differ have the same fingerprint with
//! a chance of about 2^-128, unless somebody makes them for it.

use std::fmt;
use std::ops::AddAssign;
use std::str::FromStr;

use crate::triangulation::Triangulation;

/// Of a set of triangles, or of tetrahedra: two sums of hashes, and how many there are. As text 48 hexadecimal digits.
///
/// ```
/// use delone::{Algorithm2, Delaunay2, tiles::Fingerprint};
///
/// let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
/// let one = Fingerprint::of(&Delaunay2::from_points(&points)?);
/// let other = Delaunay2::with_algorithm(&points, Algorithm2::Incremental { seed: 1 })?;
/// assert_eq!(one, Fingerprint::of(&other));
/// assert_eq!(one.to_string().parse(), Ok(one));
/// assert_eq!(one.count(), 2);
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Fingerprint {
    sums: [u64; 2],
    count: u64,
}

impl Fingerprint {
    /// Of all finite simplices of a triangulation. O(n).
    pub fn of<T: Triangulation>(triangulation: &T) -> Self {
        let mut all = Self::default();
        for s in triangulation.simplices() {
            let corners = triangulation.corners(s);
            all.add(corners.as_ref().iter().filter_map(|&v| triangulation.position(v)));
        }
        all
    }

    /// Takes in a simplex by its corners, in any order.
    #[inline]
    pub fn add<P: AsRef<[f64]>>(&mut self, corners: impl IntoIterator<Item = P>) {
        let (mut sum, mut parity) = (0u64, 0u64);
        for p in corners {
            // Minus zero is the same number as zero, with other bits.
            let hash = p.as_ref().iter().fold(SEED, |hash, x| mixed(hash ^ (x + 0.0).to_bits()));
            sum = sum.wrapping_add(hash);
            parity ^= hash.wrapping_mul(ODD);
        }
        let first = mixed(sum ^ parity.rotate_left(32));
        self.sums[0] = self.sums[0].wrapping_add(first);
        self.sums[1] = self.sums[1].wrapping_add(mixed(first ^ sum.wrapping_mul(ODD)));
        self.count += 1;
    }

    /// How many simplices were taken in.
    pub fn count(&self) -> u64 {
        self.count
    }
}

/// Multipliers of good spectra (Steele & Vigna, "Computationally easy, spectrally good multipliers", 2022).
const SEED: u64 = 0x9e37_79b9_7f4a_7c15;
const ODD: u64 = 0xd134_2543_de82_ef95;

/// The finalizer of splitmix64: each bit of the result hangs on all (Steele, Lea & Flood, OOPSLA 2014).
#[inline]
pub(super) fn mixed(z: u64) -> u64 {
    let z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ z >> 31).wrapping_add(SEED)
}

impl AddAssign for Fingerprint {
    /// That of two sets that have no simplex in common.
    fn add_assign(&mut self, other: Self) {
        self.sums = [0, 1].map(|k| self.sums[k].wrapping_add(other.sums[k]));
        self.count += other.count;
    }
}

impl std::iter::Sum for Fingerprint {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        let mut sum = Self::default();
        all.for_each(|part| sum += part);
        sum
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}{:016x}{:016x}", self.sums[0], self.sums[1], self.count)
    }
}

/// A text that is no fingerprint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a fingerprint is 48 hexadecimal digits")]
pub struct NoFingerprint;

impl FromStr for Fingerprint {
    type Err = NoFingerprint;

    fn from_str(text: &str) -> Result<Self, NoFingerprint> {
        if text.len() != 48 || !text.bytes().all(|b| b.is_ascii_hexdigit()) {
            return Err(NoFingerprint);
        }
        let part = |k: usize| u64::from_str_radix(&text[16 * k..16 * (k + 1)], 16).map_err(|_| NoFingerprint);
        Ok(Self { sums: [part(0)?, part(1)?], count: part(2)? })
    }
}

#[cfg(test)]
mod tests {
    use super::Fingerprint;

    fn of(triangles: &[[[f64; 2]; 3]]) -> Fingerprint {
        let mut all = Fingerprint::default();
        triangles.iter().for_each(|&t| all.add(t));
        all
    }

    /// Nine points, all triangles, all pairs of them that share an edge flipped: every set has a fingerprint of its own.
    #[test]
    fn sets_that_differ_are_told_apart() {
        let p: Vec<[f64; 2]> = (0..9).map(|i| [f64::from(i % 3), f64::from(i / 3)]).collect();
        let mut seen = std::collections::BTreeSet::new();
        let mut sets = 0;
        for a in 0..9 {
            for b in 0..a {
                for c in 0..b {
                    sets += 1;
                    seen.insert(of(&[[p[a], p[b], p[c]]]).to_string());
                    for d in 0..c {
                        for pair in [[[a, b, c], [a, c, d]], [[a, b, d], [b, c, d]], [[a, b, c], [b, c, d]]] {
                            sets += 1;
                            seen.insert(of(&pair.map(|t| t.map(|i| p[i]))).to_string());
                        }
                    }
                }
            }
        }
        assert_eq!(seen.len(), sets);
    }

    #[test]
    fn order_turns_and_signs_of_zero_do_not_matter() {
        let (s, t) = ([[0.0, 1.0], [2.0, 3.0], [4.0, -5.0]], [[0.0, 0.0], [2.0, 3.0], [7.0, 1.0]]);
        let turned = [[2.0, 3.0], [-0.0, 1.0], [4.0, -5.0]];
        assert_eq!(of(&[s, t]), of(&[t, turned]));
        assert_eq!([of(&[s]), of(&[t])].into_iter().sum::<Fingerprint>(), of(&[s, t]));
        // Coordinates that change places are another point.
        assert_ne!(of(&[s]), of(&[[[1.0, 0.0], [2.0, 3.0], [4.0, -5.0]]]));
        assert_ne!(of(&[s]), of(&[s, s]));
    }

    #[test]
    fn text_is_read_back() {
        let found = of(&[[[0.0, 1.0], [2.0, 3.0], [4.0, -5.0]]]);
        assert_eq!(found.to_string().parse(), Ok(found));
        for bad in ["", "12", &"g".repeat(48), &"é".repeat(24), &format!("{found}0")] {
            assert!(bad.parse::<Fingerprint>().is_err(), "{bad}");
        }
    }

    /// It is written into files: a change of the function is a change of the format.
    #[test]
    fn bits_are_fixed() {
        assert_eq!(
            of(&[[[0.0, 1.0], [2.0, 3.0], [4.0, -5.0]]]).to_string(),
            "e4ea7c171f406eb064511b8ca98a05ce0000000000000001"
        );
    }
}
