//! Signed integers of any size, for what no machine integer holds.
//!
//! The predicates add, subtract, multiply and compare, and divide only where a coordinate is rounded. Their numbers have up to seventy words
//! where differences span the range of the exponents, and their products some hundreds; schoolbook multiplication is the right one for these.
//! Numbers on a common scale mostly end in words that are zero, which are not kept, and words that are zero in between cost nothing: that
//! gains more than what general libraries do for numbers of other sizes, and is a tenth of the code, which web pages load.
//!
//! Words have 64 bits on every platform: half the memory of 32 and a quarter of the products where a processor has products of 128 bits,
//! and the same code for tests and for 32-bit platforms, which have these products as a function that other exact stages call too.

use std::borrow::Borrow;
use std::cmp::Ordering;
use std::iter::Sum;
use std::ops::{Add, Mul, Neg, Shl, Sub};

use crate::Sign;

#[cfg(test)]
mod tests;

/// Sign and magnitude. The first and the last word are not zero; zero has no words, none below, and is not negative.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct BigInt {
    is_negative: bool,
    /// How many words that are zero are below.
    below: usize,
    /// The lowest first.
    words: Vec<u64>,
}

impl BigInt {
    pub(crate) const ZERO: Self = Self { is_negative: false, below: 0, words: Vec::new() };

    /// With words of which the first ones and the last ones may be zero.
    fn new(is_negative: bool, below: usize, mut words: Vec<u64>) -> Self {
        while words.last() == Some(&0) {
            words.pop();
        }
        let Some(zeros) = words.iter().position(|word| *word != 0) else { return Self::ZERO };
        if zeros > 0 {
            words.drain(..zeros);
        }
        Self { is_negative, below: below + zeros, words }
    }

    /// A number times a power of two.
    pub(crate) fn shifted(x: i64, bits: u32) -> Self {
        let both = u128::from(x.unsigned_abs()) << (bits % 64);
        Self::new(x < 0, (bits / 64) as usize, vec![both as u64, (both >> 64) as u64])
    }

    pub(crate) fn sign(&self) -> Sign {
        if self.is_negative {
            Sign::Negative
        } else if self.words.is_empty() {
            Sign::Zero
        } else {
            Sign::Positive
        }
    }

    /// Words of the magnitude, with those below.
    fn size(&self) -> usize {
        self.below + self.words.len()
    }

    /// Bits of the magnitude.
    pub(crate) fn bits(&self) -> i64 {
        self.words.last().map_or(0, |last| 64 * self.size() as i64 - i64::from(last.leading_zeros()))
    }

    pub(crate) fn magnitude(mut self) -> Self {
        self.is_negative = false;
        self
    }

    fn compare_magnitudes(&self, other: &Self) -> Ordering {
        let sizes = self.size().cmp(&other.size());
        // What has more words after all the same ones is larger, because the lowest one is not zero.
        sizes.then_with(|| self.words.iter().rev().cmp(other.words.iter().rev()))
    }

    /// A copy with words down to those of a number and with room for their sum.
    fn reaching(&self, other: &Self) -> Self {
        let below = if other.words.is_empty() { self.below } else { self.below.min(other.below) };
        let mut words = Vec::with_capacity(self.size().max(other.size()) - below + 1);
        words.resize(self.below - below, 0);
        words.extend_from_slice(&self.words);
        Self { is_negative: self.is_negative, below, words }
    }

    /// The sum with a number that has another sign, if `turned`.
    fn sum(self, other: &Self, turned: bool) -> Self {
        if other.words.is_empty() {
            return self;
        }
        let is_negative = other.is_negative != turned;
        if self.words.is_empty() {
            return Self { is_negative, ..other.clone() };
        }
        let is_difference = self.is_negative != is_negative;
        let Self { mut is_negative, below, mut words } =
            if self.below > other.below { self.reaching(other) } else { self };
        let from = other.below - below;
        if words.len() < from + other.words.len() {
            words.resize(from + other.words.len(), 0);
        }
        if is_difference {
            if carried(&mut words[from..], &other.words, u64::overflowing_sub) {
                // The other number was larger: the difference is the complement.
                is_negative = !is_negative;
                let mut carry = true;
                for word in &mut words {
                    (*word, carry) = (!*word).overflowing_add(u64::from(carry));
                }
            }
        } else if carried(&mut words[from..], &other.words, u64::overflowing_add) {
            words.push(1);
        }
        Self::new(is_negative, below, words)
    }

    fn product(&self, other: &Self) -> Self {
        let is_longer = self.words.len() > other.words.len();
        let [x, y] = if is_longer { [&other.words, &self.words] } else { [&self.words, &other.words] };
        let mut words = Vec::with_capacity(x.len() + y.len());
        words.resize(y.len(), 0);
        for (i, &x) in x.iter().enumerate() {
            let mut carry = 0;
            if x != 0 {
                for (word, &y) in words[i..].iter_mut().zip(y) {
                    // At most (2^64 - 1)^2 + 2 (2^64 - 1): fits.
                    let part = u128::from(x) * u128::from(y) + u128::from(*word) + u128::from(carry);
                    (*word, carry) = (part as u64, (part >> 64) as u64);
                }
            }
            words.push(carry);
        }
        Self::new(self.is_negative != other.is_negative, self.below + other.below, words)
    }

    /// The highest 64 bits of the magnitude of a number that is not zero, which the highest bit is one of.
    fn leading(&self) -> u64 {
        let mut words = self.words.iter().rev();
        let (first, second) = (words.next().copied().unwrap_or(0), words.next().copied().unwrap_or(0));
        let both = u128::from(first) << 64 | u128::from(second);
        (both << first.leading_zeros() >> 64) as u64
    }

    /// How often a positive number goes into one that is not negative, and whether something is left. For quotients of up to 127 bits.
    ///
    /// Of each rest 31 bits more are found at once, from below: by its highest 64 bits and the highest 32 of the divisor, plus one.
    pub(crate) fn divided(mut self, divisor: &Self) -> (u128, bool) {
        let (mut whole, above) = (0, (divisor.leading() >> 32) + 1);
        while self >= *divisor {
            let (part, shift) = (self.leading() / above, self.bits() - divisor.bits() - 32);
            // At the end a part is less than one, and the divisor still goes into the rest.
            let part = if shift < 0 { (part >> -shift).max(1) } else { part };
            let shift = shift.max(0) as u32;
            whole += u128::from(part) << shift;
            self = self - divisor * Self::shifted(part as i64, shift);
        }
        (whole, self != Self::ZERO)
    }
}

/// Adds words to the same ones of a number that has as many or more, or subtracts them, as `step` does. Gives the last carry.
#[inline]
fn carried(words: &mut [u64], others: &[u64], step: impl Fn(u64, u64) -> (u64, bool)) -> bool {
    let (low, high) = words.split_at_mut(others.len());
    let mut carry = false;
    for (word, &other) in low.iter_mut().zip(others) {
        let (part, first) = step(*word, other);
        let (part, second) = step(part, u64::from(carry));
        (*word, carry) = (part, first | second);
    }
    for word in high {
        if !carry {
            break;
        }
        (*word, carry) = step(*word, 1);
    }
    carry
}

impl From<i64> for BigInt {
    fn from(x: i64) -> Self {
        Self::shifted(x, 0)
    }
}

impl PartialOrd for BigInt {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for BigInt {
    fn cmp(&self, other: &Self) -> Ordering {
        match (self.is_negative, other.is_negative) {
            (false, false) => self.compare_magnitudes(other),
            (true, true) => other.compare_magnitudes(self),
            (true, false) => Ordering::Less,
            (false, true) => Ordering::Greater,
        }
    }
}

/// For numbers and references, on either side.
macro_rules! operator {
    ($Operator:ident, $name:ident, |$x:ident, $y:ident| $of_number:expr, $of_reference:expr) => {
        impl<T: Borrow<BigInt>> $Operator<T> for BigInt {
            type Output = Self;

            fn $name(self, other: T) -> Self {
                let ($x, $y) = (self, other.borrow());
                $of_number
            }
        }

        impl<T: Borrow<BigInt>> $Operator<T> for &BigInt {
            type Output = BigInt;

            fn $name(self, other: T) -> BigInt {
                let ($x, $y) = (self, other.borrow());
                $of_reference
            }
        }
    };
}

operator!(Add, add, |x, y| x.sum(y, false), x.reaching(y).sum(y, false));
operator!(Sub, sub, |x, y| x.sum(y, true), x.reaching(y).sum(y, true));
operator!(Mul, mul, |x, y| x.product(y), x.product(y));

impl Neg for BigInt {
    type Output = Self;

    fn neg(mut self) -> Self {
        self.is_negative = !self.is_negative && !self.words.is_empty();
        self
    }
}

impl Shl<u32> for BigInt {
    type Output = Self;

    fn shl(mut self, bits: u32) -> Self {
        let mut carry = 0;
        for word in &mut self.words {
            let both = u128::from(*word) << (bits % 64) | carry;
            (*word, carry) = (both as u64, both >> 64);
        }
        if carry > 0 {
            self.words.push(carry as u64);
        }
        Self::new(self.is_negative, self.below + (bits / 64) as usize, self.words)
    }
}

impl Sum for BigInt {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::ZERO, |sum, term| sum + term)
    }
}
