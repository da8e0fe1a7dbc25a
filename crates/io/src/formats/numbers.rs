//! Numbers of a type that a header names, in bytes.

/// A type of number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    Float(usize),
    Signed(usize),
    Unsigned(usize),
}

impl Number {
    /// Bytes of one.
    pub(super) fn size(self) -> usize {
        match self {
            Self::Float(size) | Self::Signed(size) | Self::Unsigned(size) => size,
        }
    }

    /// The type if there are numbers of that size.
    pub(super) fn checked(self) -> Option<Self> {
        let sizes: &[usize] = if matches!(self, Self::Float(_)) { &[4, 8] } else { &[1, 2, 4, 8] };
        sizes.contains(&self.size()).then_some(self)
    }

    /// The number in as many bytes as it has.
    pub(super) fn read(self, bytes: &[u8], big_endian: bool) -> f64 {
        let size = self.size();
        let mut word = [0; 8];
        word[..size].copy_from_slice(&bytes[..size]);
        if big_endian {
            word[..size].reverse();
        }
        let unsigned = u64::from_le_bytes(word);
        match self {
            Self::Float(4) => f32::from_bits(unsigned as u32).into(),
            Self::Float(_) => f64::from_bits(unsigned),
            Self::Unsigned(_) => unsigned as f64,
            Self::Signed(_) => {
                let shift = 64 - 8 * size;
                ((unsigned << shift) as i64 >> shift) as f64
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Number;

    #[test]
    fn numbers_of_all_types() {
        assert_eq!(Number::Float(4).read(&1.5_f32.to_le_bytes(), false), 1.5);
        assert_eq!(Number::Float(8).read(&(-2.5_f64).to_be_bytes(), true), -2.5);
        assert_eq!(Number::Signed(2).read(&(-3_i16).to_be_bytes(), true), -3.0);
        assert_eq!(Number::Unsigned(1).read(&[200], false), 200.0);
        assert_eq!(Number::Signed(8).read(&(-7_i64).to_le_bytes(), false), -7.0);
        assert_eq!(
            (Number::Float(2).checked(), Number::Signed(4).checked()),
            (None, Some(Number::Signed(4)))
        );
    }
}
