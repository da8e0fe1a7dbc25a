//! Stage two: big integers. An end is (n + s sqrt(q d)) / m, and q is the same for all ends of a pair.

use std::cmp::Ordering;

use super::{DiskPair, End, Number, Question, Shape, Terms};
use crate::exact::big;
use crate::exact::big_int::BigInt;
use crate::{Point2, Sign};

impl Number for BigInt {
    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn minus(&self, other: &Self) -> Self {
        self - other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn sign(&self) -> Option<Sign> {
        Some(self.sign())
    }
}

#[cold]
pub(super) fn shape(pair: &DiskPair, k: Point2, question: Question) -> Shape {
    let numbers: [BigInt; 7] = big::integers(&pair.numbers(k, pair.diameter)).0.try_into().expect("seven");
    Terms::new(&numbers, question).shape().expect("signs of integers are known")
}

/// (n + s sqrt(q d)) / m.
struct Surd {
    n: BigInt,
    s: i64,
    d: BigInt,
    m: BigInt,
}

fn surd(terms: Terms<BigInt>, is_low: bool) -> Surd {
    let Terms { a, b, q, d, m } = terms;
    let ab = &a * &b;
    if m == BigInt::ZERO {
        // The quadratic is linear.
        return Surd { n: &a * &a - q, s: 0, d, m: ab << 1 };
    }
    Surd { n: ab, s: if is_low { 1 } else { -1 }, d, m }
}

#[cold]
pub(super) fn compare(pair: &DiskPair, first: &End, second: &End) -> Ordering {
    let [k, l] = [first.k, second.k];
    let mut numbers = Vec::from(pair.numbers(k, pair.diameter));
    numbers.extend(l);
    // All on one scale, so that q is one number.
    let (all, _) = big::integers(&numbers);
    let terms = |k: &[BigInt], question: Question| {
        let mut seven: [BigInt; 7] = all[..7].to_vec().try_into().expect("seven");
        seven[4..6].clone_from_slice(k);
        Terms::new(&seven, question)
    };
    let (one, two) = (terms(&all[4..6], first.question), terms(&all[7..9], second.question));
    let q = one.q.clone();
    let (one, two) = (surd(one, first.is_low), surd(two, second.is_low));
    let rational = &one.n * &two.m - &two.n * &one.m;
    let sum = sign_of_sum(
        &rational,
        (&two.m * BigInt::from(one.s), &one.d),
        (&one.m * BigInt::from(-two.s), &two.d),
        &q,
    );
    (sum * one.m.sign() * two.m.sign()).cmp(&Sign::Zero)
}

/// The sign of a + b sqrt(q d) + c sqrt(q e), for q, d and e that are not negative.
fn sign_of_sum(a: &BigInt, (b, d): (BigInt, &BigInt), (c, e): (BigInt, &BigInt), q: &BigInt) -> Sign {
    let (x, y) = (&b * &b * d * q, &c * &c * e * q);
    let surds = opposed(part(&b, &x), part(&c, &y), || Sign::of(&x, &y));
    opposed(a.sign(), surds, || {
        // a^2 against the square of the rest, x + y + 2 b c q sqrt(d e).
        let rational = a * a - &x - &y;
        let factor = -((b * c * q) << 1);
        let square = &factor * &factor * d * e;
        opposed(rational.sign(), part(&factor, &square), || Sign::of(&(&rational * &rational), &square))
    })
}

/// The sign of a product with a root, given its square.
fn part(factor: &BigInt, square: &BigInt) -> Sign {
    factor.sign() * square.sign()
}

/// The sign of a sum of two numbers of known signs. If they are opposed, `magnitudes` compares them.
fn opposed(first: Sign, second: Sign, magnitudes: impl FnOnce() -> Sign) -> Sign {
    if first == second || second.is_zero() {
        first
    } else if first.is_zero() {
        second
    } else {
        first * magnitudes()
    }
}
