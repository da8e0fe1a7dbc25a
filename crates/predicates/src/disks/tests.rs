//! Ends of stretches against the definition: signs of d_k - d - e and of d_k - d + e at rational places, in integers.

use std::cmp::Ordering;

use delone_generators::Random;

use super::{DiskPair, Stretch, exact};
use crate::Point2;

/// Whether d_k > d + e, or d_k < d - e, at s = n / 64: all lengths times 128 are roots of integers.
fn holds(i: [i128; 2], j: [i128; 2], k: [i128; 2], e: i128, n: i128, is_clear: bool) -> bool {
    let u = [j[0] - i[0], j[1] - i[1]];
    let c = [64 * (i[0] + j[0]) - n * u[1], 64 * (i[1] + j[1]) + n * u[0]];
    let squared = |p: [i128; 2]| [0, 1].map(|x| c[x] - 128 * p[x]).map(|x| x * x).iter().sum::<i128>();
    let (d, dk, e) = (squared(i), squared(k), 128 * e);
    assert_eq!(d, squared(j));
    // x > y + e for roots of x, y iff x - y - e^2 > 2 e sqrt(y).
    let exceeds = |x: i128, y: i128| {
        let left = x - y - e * e;
        left > 0 && left * left > 4 * e * e * y
    };
    if is_clear { exceeds(dk, d) } else { exceeds(d, dk) }
}

fn points(random: &mut Random, range: f64) -> [f64; 7] {
    std::array::from_fn(|_| random.between(-range, range).round())
}

#[test]
fn stretches_hold_what_the_definition_holds() {
    let mut random = Random::new(5);
    for range in [3.0, 8.0, 40.0] {
        for _ in 0..3000 {
            let [ix, iy, jx, jy, kx, ky, e] = points(&mut random, range);
            let (i, j, k, e) = ([ix, iy], [jx, jy], [kx, ky], e.abs());
            if i == j {
                continue;
            }
            let pair = DiskPair::new(i, j, e);
            let whole = |p: Point2| p.map(|x| x as i128);
            for is_clear in [true, false] {
                let stretch = if is_clear { pair.clear_of(k) } else { pair.blocked_by(k) };
                for n in [-1_000_000, -640, -200, -64, -33, -7, 0, 1, 5, 30, 64, 100, 320, 2000, 1_000_000] {
                    let expected = holds(whole(i), whole(j), whole(k), e as i128, n, is_clear);
                    let s = n as f64 / 64.0;
                    let found = stretch.is_some_and(|Stretch { low, high }| {
                        low.is_none_or(|low| low.value.compare(&s.into()) != Some(Ordering::Greater))
                            && high.is_none_or(|high| high.value.compare(&s.into()) != Some(Ordering::Less))
                    });
                    let is_near = stretch.is_some_and(|t| {
                        [t.low, t.high].into_iter().flatten().any(|x| x.value.compare(&s.into()).is_none())
                    });
                    assert!(found == expected || is_near, "{i:?} {j:?} {k:?} {e} {s} {is_clear} {stretch:?}");
                }
            }
        }
    }
}

/// Floating point agrees with integers wherever it answers, and integers agree with themselves in reverse.
#[test]
fn stages_agree() {
    let mut random = Random::new(6);
    let (mut told, mut equal) = (0, 0);
    for range in [2.0, 5.0, 1000.0] {
        for _ in 0..2000 {
            let [ix, iy, jx, jy, kx, ky, e] = points(&mut random, range);
            let [lx, ly, ..] = points(&mut random, range);
            let (i, j, e) = ([ix, iy], [jx, jy], (e / 2.0).abs());
            if i == j {
                continue;
            }
            let pair = DiskPair::new(i, j, e);
            let of = |k: Point2| [pair.clear_of(k), pair.blocked_by(k)].into_iter().flatten();
            let ends: Vec<_> =
                of([kx, ky]).chain(of([lx, ly])).flat_map(|s| [s.low, s.high]).flatten().collect();
            for (a, b) in ends.iter().flat_map(|a| ends.iter().map(move |b| (a, b))) {
                let order = exact::compare(&pair, a, b);
                assert_eq!(order, exact::compare(&pair, b, a).reverse());
                if let Some(filtered) = a.value.compare(&b.value) {
                    assert_eq!(filtered, order);
                    told += 1;
                }
                equal += usize::from(order.is_eq() && a.k != b.k);
            }
        }
    }
    assert!(told > 5000 && equal > 20, "{told} {equal}");
}

/// Four cocircular centers without radius: both ends at the center of the circle. Mirror images: both at the same place.
#[test]
fn ties_are_ties() {
    let pair = DiskPair::new([0.0, 0.0], [1.0, 1.0], 0.0);
    let (left, right) = (pair.clear_of([0.0, 1.0]).unwrap(), pair.clear_of([1.0, 0.0]).unwrap());
    assert!(left.low.is_none() && right.high.is_none());
    assert_eq!(pair.compare(&left.high.unwrap(), &right.low.unwrap()), Ordering::Equal);
    for size in [1.0, 1e-160, 1e150, 1e300] {
        let pair = DiskPair::new([-2.0 * size, 0.0], [2.0 * size, 0.0], size);
        let near = pair.clear_of([-size, 5.0 * size]).unwrap().high.unwrap();
        let mirrored = pair.clear_of([size, 5.0 * size]).unwrap().high.unwrap();
        assert_eq!(pair.compare(&near, &mirrored), Ordering::Equal);
        let further = pair.clear_of([size, (5.0 + 1e-15) * size]).unwrap().high.unwrap();
        assert_eq!(pair.compare(&near, &further), Ordering::Less);
    }
}

/// Plain cases do not reach integers.
#[test]
fn intervals_tell_what_is_plain() {
    let pair = DiskPair::new([0.1, 0.2], [3.3, 0.7], 0.25);
    let [a, b] = [[1.6, 2.9], [1.3, -2.1]].map(|k| pair.clear_of(k).unwrap());
    let (high, low) = (a.high.unwrap(), b.low.unwrap());
    assert_eq!(high.value.compare(&low.value), Some(Ordering::Greater));
    assert!(!pair.may_hold([1.6, 9.0], Some(&low), Some(&high)) && pair.may_hold([1.6, 0.6], None, None));
    assert_eq!(pair.compare(&high, &low), Ordering::Greater);
}
