//! Beside integers that others wrote.

use std::cmp::Ordering;

use delone_generators::Random;
use num_bigint::{BigInt as Judge, BigUint, Sign as JudgeSign};
use proptest::collection::vec;
use proptest::prelude::*;

use super::BigInt;
use crate::Sign;

/// Words at which carries begin, end and are passed on.
const EDGES: [u64; 8] = [0, 1, 2, u64::MAX, u64::MAX - 1, 1 << 63, u64::MAX >> 1, u32::MAX as u64];

fn judge(x: &BigInt) -> Judge {
    assert!(x.words.first() != Some(&0) && x.words.last() != Some(&0), "{x:?}");
    let bytes: Vec<u8> = x.words.iter().flat_map(|word| word.to_le_bytes()).collect();
    let magnitude = BigUint::from_bytes_le(&bytes) << (64 * x.below);
    let sign = match (x.is_negative, x.words.is_empty()) {
        (true, false) => JudgeSign::Minus,
        (false, true) if x.below == 0 => JudgeSign::NoSign,
        (false, false) => JudgeSign::Plus,
        (_, true) => panic!("zero has one form"),
    };
    Judge::from_biguint(sign, magnitude)
}

fn negated(x: &BigInt) -> BigInt {
    -x.clone()
}

/// All that two numbers can be asked.
fn agree(x: &BigInt, y: &BigInt) {
    let (a, b) = (&judge(x), &judge(y));
    assert_eq!(judge(&(x + y)), a + b, "{x:?} + {y:?}");
    assert_eq!(judge(&(x - y)), a - b, "{x:?} - {y:?}");
    assert_eq!(judge(&(x * y)), a * b, "{x:?} * {y:?}");
    assert_eq!((x.clone() + y, x.clone() - y), (x + y.clone(), x - y.clone()));
    assert_eq!((x.cmp(y), x == y), (a.cmp(b), a == b), "{x:?} {y:?}");
    assert_eq!(judge(&negated(x)), -a);
    assert_eq!(x.bits(), a.bits() as i64);
    assert_eq!(x.sign(), Sign::of(a, &Judge::ZERO));
    assert_eq!(judge(&x.clone().magnitude()), Judge::from(a.magnitude().clone()));
    let (n, d) = (x.clone().magnitude(), y.clone().magnitude());
    if d != BigInt::ZERO && n.bits() - d.bits() < 127 {
        let (a, b) = (a.magnitude(), b.magnitude());
        let (whole, is_more) = n.divided(&d);
        assert_eq!((BigUint::from(whole), is_more), (a / b, a % b != BigUint::ZERO), "{x:?} / {y:?}");
    }
}

/// Numbers of up to two words of which each is an edge, and longer ones: all the same word, powers of two, edges at random.
fn hostile() -> Vec<BigInt> {
    let mut words = vec![vec![]];
    for low in EDGES {
        words.push(vec![low]);
        words.extend(EDGES.map(|high| vec![low, high]));
        words.extend([3, 5, 33, 70].map(|count| vec![low; count]));
    }
    let mut random = Random::new(1);
    for count in (1..40).chain([65, 66, 67]) {
        words.push((0..count).map(|_| EDGES[random.below(EDGES.len())]).collect());
    }
    let powers = [0, 1, 62, 63, 64, 65, 127, 128, 129, 255, 2100].map(|bits| BigInt::shifted(1, bits));
    let beside = powers.iter().flat_map(|power| [power + BigInt::from(1), power - BigInt::from(1)]);
    let plain = words.into_iter().map(|words| BigInt::new(false, 0, words));
    plain.chain(beside).chain(powers.clone()).collect()
}

#[test]
fn hostile_numbers() {
    let numbers = hostile();
    for x in &numbers {
        for y in &numbers {
            agree(x, y);
            agree(x, &negated(y));
            agree(&negated(x), y);
            agree(&negated(x), &negated(y));
        }
    }
}

#[test]
fn powers_of_two() {
    for x in hostile() {
        for bits in [0, 1, 31, 32, 63, 64, 65, 127, 128, 192, 1000, 2100] {
            assert_eq!(judge(&(x.clone() << bits)), judge(&x) << bits, "{x:?} {bits}");
            assert_eq!(judge(&(negated(&x) << bits)), judge(&negated(&x)) << bits, "{x:?} {bits}");
        }
    }
    for x in [0, 1, -1, i64::MAX, i64::MIN, i64::MIN + 1] {
        assert_eq!(judge(&BigInt::from(x)), Judge::from(x));
        assert_eq!(judge(&BigInt::shifted(x, 2098)), Judge::from(x) << 2098);
    }
}

/// Quotients of all lengths that are whole, and those one below and above.
#[test]
fn quotients() {
    for divisor in hostile().into_iter().filter(|d| *d != BigInt::ZERO) {
        for bits in 0..126 {
            for whole in [BigInt::shifted(1, bits), BigInt::shifted(1, bits + 1) - BigInt::from(1)] {
                let product = &divisor * &whole;
                for n in [&product - BigInt::from(1), &product + BigInt::from(1), product] {
                    agree(&n, &divisor);
                }
            }
        }
    }
}

#[test]
fn sums_of_many() {
    let numbers = hostile();
    let terms = || numbers.iter().map(|x| x * x).chain(numbers.iter().map(negated));
    assert_eq!(judge(&terms().sum()), terms().map(|x| judge(&x)).sum());
    assert_eq!((BigInt::default(), std::iter::empty::<BigInt>().sum()), (BigInt::ZERO, BigInt::ZERO));
    assert_eq!(BigInt::ZERO.cmp(&BigInt::from(-1)), Ordering::Greater);
}

prop_compose! {
    /// Up to forty words, each of any bits, an edge or zero.
    fn number()(is_negative: bool, below in 0..20_usize, words in vec(prop_oneof![any::<u64>(), (0..8_usize).prop_map(|k| EDGES[k]), Just(0)], 0..40))
        -> BigInt {
        BigInt::new(is_negative, below, words)
    }
}

proptest! {
    #[test]
    fn any_numbers(x in number(), y in number()) {
        agree(&x, &y);
        agree(&(&x + &y), &y);
        agree(&(&x * &y + BigInt::from(1)), &y);
        agree(&(&x * &y), &(&y * &x));
    }
}
