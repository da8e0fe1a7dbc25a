//! Borders as bytes, for files and for other machines: the same on all of them, with a sum that shows damage.
//!
//! Eight letters for format and version, the numbers of points and of triangles, the points, their ids, the triangles, the sum.
//! All numbers with the least byte first.

use super::Border;
use super::fingerprint::mixed;
use crate::error::BorderProblem;

const MAGIC: &[u8; 8] = b"DELONEB1";
const HEAD: usize = 24;

impl Border {
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
        let mut bytes = Vec::with_capacity(HEAD + 24 * self.points.len() + 12 * self.open.len() + 8);
        bytes.extend(MAGIC);
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
        let head = bytes.get(..HEAD).filter(|head| head.starts_with(MAGIC)).ok_or(BorderProblem::Unknown)?;
        let count = |at: usize| u64::from_le_bytes(eight(&head[at..at + 8]));
        let (points, open) = (count(8), count(16));
        let needed = 24 * u128::from(points) + 12 * u128::from(open) + HEAD as u128 + 8;
        if needed != bytes.len() as u128 {
            let expected = u64::try_from(needed).unwrap_or(u64::MAX);
            return Err(BorderProblem::Length { expected, found: bytes.len() as u64 });
        }
        let (content, written) = bytes.split_at(bytes.len() - 8);
        if sum(content) != u64::from_le_bytes(eight(written)) {
            return Err(BorderProblem::Damaged);
        }
        let (points, rest) = content[HEAD..].split_at(16 * points as usize);
        let (ids, open) = rest.split_at(points.len() / 2);
        let number = |bytes: &[u8]| f64::from_le_bytes(eight(bytes));
        let corner = |bytes: &[u8]| u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        let border = Self {
            points: points.chunks_exact(16).map(|p| [number(&p[..8]), number(&p[8..])]).collect(),
            ids: ids.chunks_exact(8).map(|id| u64::from_le_bytes(eight(id))).collect(),
            open: open.chunks_exact(12).map(|t| [corner(t), corner(&t[4..]), corner(&t[8..])]).collect(),
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
    use super::{Border, sum};
    use crate::error::BorderProblem;

    fn some() -> Border {
        Border {
            points: vec![[0.5, -1.0], [2.0, 3.0], [1e300, 5e-324]],
            ids: vec![7, u64::MAX, 0],
            open: vec![[0, 1, 2]],
        }
    }

    #[test]
    fn bytes_are_read_back() {
        for border in [Border::default(), some()] {
            assert_eq!(Border::from_bytes(&border.to_bytes()), Ok(border));
        }
    }

    /// Each bit, and each end.
    #[test]
    fn damage_is_seen() {
        let bytes = some().to_bytes();
        for bit in 0..8 * bytes.len() {
            let mut damaged = bytes.clone();
            damaged[bit / 8] ^= 1 << (bit % 8);
            assert!(Border::from_bytes(&damaged).is_err(), "bit {bit}");
        }
        for end in 0..bytes.len() {
            assert!(Border::from_bytes(&bytes[..end]).is_err(), "{end} bytes");
        }
        let longer = [&bytes[..], &[0; 8]].concat();
        let expected = bytes.len() as u64;
        let wrong = BorderProblem::Length { expected, found: expected + 8 };
        assert_eq!(Border::from_bytes(&longer), Err(wrong));
        assert_eq!(Border::from_bytes(b"something else that is long enough"), Err(BorderProblem::Unknown));
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
        assert_eq!(found(|b| b.open[0][2] = 3), Some(BorderProblem::Corner { triangle: 0, points: 3 }));
        // A length that no memory has.
        let mut bytes = some().to_bytes();
        bytes[8..16].fill(0xff);
        let end = bytes.len() - 8;
        let right = sum(&bytes[..end]).to_le_bytes();
        bytes[end..].copy_from_slice(&right);
        assert!(matches!(Border::from_bytes(&bytes), Err(BorderProblem::Length { expected: u64::MAX, .. })));
    }
}
