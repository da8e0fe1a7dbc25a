//! Borders as bytes, for files and for other machines: the same on all of them, with a sum that shows damage.
//!
//! Eight letters for format, dimension and version, the numbers of points and of open simplices, the points, their ids, the simplices, the sum.
//! All numbers with the least byte first.

use super::BorderOf;
use super::fingerprint::mixed;
use crate::error::BorderProblem;

const HEAD: usize = 24;

/// The first bytes of borders.
const MAGIC: [(usize, &[u8; 8]); 2] = [(2, b"DELONEB1"), (3, b"DELON3B1")];

impl<const D: usize, const C: usize> BorderOf<D, C> {
    /// The bytes of a point with its id, and of a simplex.
    const SIZES: [usize; 2] = [8 * D + 8, 4 * C];

    /// As bytes; [`Self::from_bytes`] reads them.
    ///
    /// ```
    /// use delone::tiles::{Border, Region, Tile};
    ///
    /// let tile = Tile::new(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], &Region::ALL)?;
    /// let border = tile.border(u64::from);
    /// let mut bytes = border.to_bytes();
    /// assert_eq!(Border::from_bytes(&bytes), Ok(border));
    /// bytes[30] ^= 1;
    /// assert!(Border::from_bytes(&bytes).is_err());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn to_bytes(&self) -> Vec<u8> {
        let [point, simplex] = Self::SIZES;
        let mut bytes = Vec::with_capacity(HEAD + point * self.points.len() + simplex * self.open.len() + 8);
        bytes.extend(MAGIC.iter().filter(|(dimension, _)| *dimension == D).flat_map(|(_, magic)| *magic));
        bytes.extend((self.points.len() as u64).to_le_bytes());
        bytes.extend((self.open.len() as u64).to_le_bytes());
        self.points.as_flattened().iter().for_each(|x| bytes.extend(x.to_le_bytes()));
        self.ids.iter().for_each(|id| bytes.extend(id.to_le_bytes()));
        self.open.as_flattened().iter().for_each(|v| bytes.extend(v.to_le_bytes()));
        bytes.extend(sum(&bytes).to_le_bytes());
        bytes
    }

    /// From bytes that [`Self::to_bytes`] made.
    ///
    /// # Errors
    /// What is wrong with bytes that are not, or that were changed.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, BorderProblem> {
        let head = bytes.get(..HEAD).ok_or(BorderProblem::Unknown)?;
        let known = MAGIC.iter().find(|(_, magic)| head.starts_with(*magic));
        let &(found, _) = known.ok_or(BorderProblem::Unknown)?;
        if found != D {
            return Err(BorderProblem::Dimension { expected: D, found });
        }
        let count = |at: usize| u64::from_le_bytes(eight(&head[at..at + 8]));
        let (points, open) = (count(8), count(16));
        let [point, simplex] = Self::SIZES.map(|size| size as u128);
        let needed = point * u128::from(points) + simplex * u128::from(open) + HEAD as u128 + 8;
        if needed != bytes.len() as u128 {
            let expected = u64::try_from(needed).unwrap_or(u64::MAX);
            return Err(BorderProblem::Length { expected, found: bytes.len() as u64 });
        }
        let (content, written) = bytes.split_at(bytes.len() - 8);
        if sum(content) != u64::from_le_bytes(eight(written)) {
            return Err(BorderProblem::Damaged);
        }
        let (coordinates, rest) = content[HEAD..].split_at(8 * D * points as usize);
        let (ids, open) = rest.split_at(8 * points as usize);
        let number = |p: &[u8], k: usize| f64::from_le_bytes(eight(&p[8 * k..]));
        let corner = |s: &[u8], k: usize| u32::from_le_bytes(std::array::from_fn(|i| s[4 * k + i]));
        let border = Self {
            points: coordinates.chunks_exact(8 * D).map(|p| std::array::from_fn(|k| number(p, k))).collect(),
            ids: ids.chunks_exact(8).map(|id| u64::from_le_bytes(eight(id))).collect(),
            open: open.chunks_exact(4 * C).map(|s| std::array::from_fn(|k| corner(s, k))).collect(),
        };
        border.check()?;
        Ok(border)
    }
}

/// Of which there are eight.
fn eight(bytes: &[u8]) -> [u8; 8] {
    std::array::from_fn(|k| bytes[k])
}

/// Hangs on every bit and on the order of the bytes.
fn sum(bytes: &[u8]) -> u64 {
    let (words, rest) = bytes.as_chunks::<8>();
    let of_words = words.iter().fold(bytes.len() as u64, |sum, &word| mixed(sum ^ u64::from_le_bytes(word)));
    rest.iter().fold(of_words, |sum, &byte| mixed(sum ^ u64::from(byte)))
}

#[cfg(test)]
mod tests {
    use super::super::{Border, Border3};
    use super::{BorderOf, sum};
    use crate::error::BorderProblem;

    fn some() -> Border {
        Border {
            points: vec![[0.5, -1.0], [2.0, 3.0], [1e300, 5e-324]],
            ids: vec![7, u64::MAX, 0],
            open: vec![[0, 1, 2]],
        }
    }

    fn some_in_space() -> Border3 {
        Border3 {
            points: vec![[0.5, -1.0, 7.0], [2.0, 3.0, -0.0], [1e300, 5e-324, 1.0], [4.0; 3]],
            ids: vec![7, u64::MAX, 0, 1],
            open: vec![[0, 1, 2, 3], [3, 2, 1, 0]],
        }
    }

    #[test]
    fn bytes_are_read_back() {
        for border in [Border::default(), some()] {
            assert_eq!(Border::from_bytes(&border.to_bytes()), Ok(border));
        }
        for border in [Border3::default(), some_in_space()] {
            assert_eq!(Border3::from_bytes(&border.to_bytes()), Ok(border));
        }
    }

    #[test]
    fn dimensions_are_told_apart() {
        let found = Border3::from_bytes(&some().to_bytes());
        assert_eq!(found, Err(BorderProblem::Dimension { expected: 3, found: 2 }));
        let found = Border::from_bytes(&some_in_space().to_bytes());
        assert_eq!(found, Err(BorderProblem::Dimension { expected: 2, found: 3 }));
    }

    /// Each bit, and each end.
    #[test]
    fn damage_is_seen() {
        damage::<2, 3>(&some().to_bytes());
        damage::<3, 4>(&some_in_space().to_bytes());
    }

    fn damage<const D: usize, const C: usize>(bytes: &[u8]) {
        for bit in 0..8 * bytes.len() {
            let mut damaged = bytes.to_vec();
            damaged[bit / 8] ^= 1 << (bit % 8);
            assert!(BorderOf::<D, C>::from_bytes(&damaged).is_err(), "bit {bit}");
        }
        for end in 0..bytes.len() {
            assert!(BorderOf::<D, C>::from_bytes(&bytes[..end]).is_err(), "{end} bytes");
        }
        let longer = [bytes, &[0; 8]].concat();
        let expected = bytes.len() as u64;
        let wrong = BorderProblem::Length { expected, found: expected + 8 };
        assert_eq!(BorderOf::<D, C>::from_bytes(&longer), Err(wrong));
        assert_eq!(
            BorderOf::<D, C>::from_bytes(b"something else that is long enough"),
            Err(BorderProblem::Unknown)
        );
    }

    /// Bytes whose sum is right and whose content is not.
    #[test]
    fn borders_that_are_none_are_named() {
        let found = |change: fn(&mut Border)| {
            let mut border = some();
            change(&mut border);
            Border::from_bytes(&border.to_bytes()).err()
        };
        assert_eq!(found(|b| b.points[1][1] = f64::NAN), Some(BorderProblem::NotFinite { point: 1 }));
        assert_eq!(found(|b| b.open[0][2] = 3), Some(BorderProblem::Corner { simplex: 0, points: 3 }));
        // A length that no memory has.
        let mut bytes = some().to_bytes();
        bytes[8..16].fill(0xff);
        let end = bytes.len() - 8;
        let right = sum(&bytes[..end]).to_le_bytes();
        bytes[end..].copy_from_slice(&right);
        assert!(matches!(Border::from_bytes(&bytes), Err(BorderProblem::Length { expected: u64::MAX, .. })));
    }
}
