//! Lengths and lunes against their definitions over big integers, on tuples that lie on borders or nearly.

use delone_generators::Random;
use delone_oracle::{exact, graphs};
use delone_predicates::{Lune, LunePlace, angle, compare_lengths, compare_with_radius, in_diametral_ball};

const BETAS: [f64; 9] = [1.0, 1.0 + f64::EPSILON, 1.5, 1.7, 2.0, 3.0, 1e9, 1e300, f64::MAX];

/// A number of a kind: on a small lattice, anywhere, at a large offset, with a huge span of exponents, subnormal.
fn number(kind: usize, r: &mut Random) -> f64 {
    match kind {
        0 => r.below(7) as f64,
        1 => r.between(-1.0, 1.0),
        2 => 500_000.0 + r.below(9) as f64 / 100.0,
        3 => 2f64.powi(r.below(1900) as i32 - 950) * r.between(-1.0, 1.0),
        4 => f64::from_bits(r.below(30) as u64),
        _ => [f64::MAX, -f64::MAX, 1.0, 0.0, 1e154, -1e-154][r.below(6)],
    }
}

fn point<const D: usize>(kind: usize, r: &mut Random) -> [f64; D] {
    std::array::from_fn(|_| number(kind, r))
}

/// Whether a point is strictly in the lune: whether the skeleton of the three misses the edge. For beta = 1 the skeleton has
/// the closed ball, so that the open one is asked by a power next to it.
fn is_inside<const D: usize>(a: [f64; D], b: [f64; D], p: [f64; D], beta: f64) -> bool {
    !graphs::beta_skeleton(&[a, b, p], beta).contains(&[0, 1])
}

fn lunes<const D: usize>(seed: u64, rounds: usize) {
    let (mut inside, mut away, mut borders) = (0, 0, 0);
    for kind in 0..6 {
        let mut r = Random::new(seed);
        for _ in 0..rounds {
            let (a, b, p) = (point::<D>(kind, &mut r), point::<D>(kind, &mut r), point::<D>(kind, &mut r));
            if a == b || a == p || b == p {
                continue;
            }
            let closed = !graphs::gabriel(&[a, b, p]).contains(&[0, 1]);
            assert_eq!(in_diametral_ball(a, b, p), closed, "{a:?} {b:?} {p:?}");
            for beta in BETAS {
                let place = Lune::new(a, b, beta).place(&p);
                assert_eq!(Lune::new(b, a, beta).place(&p), place, "exchanged");
                if beta > 1.0 {
                    assert_eq!(
                        place == LunePlace::Inside,
                        is_inside(a, b, p, beta),
                        "{a:?} {b:?} {p:?} {beta}"
                    );
                } else {
                    assert!(closed || place != LunePlace::Inside);
                    borders += usize::from(closed && place != LunePlace::Inside);
                }
                inside += usize::from(place == LunePlace::Inside);
                if place == LunePlace::Away {
                    // All larger lunes that hold it reach further than the ball about the middle does.
                    assert!(!is_inside(a, b, p, beta.max(1.0 + f64::EPSILON)));
                    away += 1;
                }
            }
        }
    }
    assert!(inside > rounds && away > rounds && borders > rounds / 20, "{inside} {away} {borders}");
}

#[test]
fn lunes_of_the_plane_are_exact() {
    lunes::<2>(1, 1500);
}

#[test]
fn lunes_of_space_are_exact() {
    lunes::<3>(2, 1500);
}

/// A point told to be away is outside of the ball about the middle, whose border has the height sqrt(2 beta - 1) of half the
/// length there; and points plainly outside are told.
#[test]
fn only_what_is_outside_of_the_ball_is_away() {
    for (beta, height) in [(1.0, 1.0), (1.625, 1.5), (2.5, 2.0), (5.0, 3.0), (50.5, 10.0)] {
        for size in [1.0, 2f64.powi(-300), 2f64.powi(300)] {
            let lune = Lune::new([-size, 0.0], [size, 0.0], beta);
            let place = |x: f64| lune.place(&[0.0, x * height * size]);
            assert_ne!(place(1.0), LunePlace::Away, "{beta} {size}");
            assert_ne!(place(1.0 - f64::EPSILON), LunePlace::Away);
            assert_eq!(place(1.0 + 1e-14), LunePlace::Away, "{beta} {size}");
            assert_eq!(lune.place(&[height * size * (1.0 + 1e-14), 0.0]), LunePlace::Away);
            assert_eq!(place(0.99), LunePlace::Inside);
        }
    }
}

/// A lune told to be clear of a box has no point of it inside; and most boxes that are far away are told.
fn boxes<const D: usize>(seed: u64, rounds: usize) {
    let (mut clear, mut held) = (0, 0);
    for kind in 0..6 {
        let mut r = Random::new(seed);
        for _ in 0..rounds {
            let (a, b) = (point::<D>(kind, &mut r), point::<D>(kind, &mut r));
            let some: [[f64; D]; 3] = std::array::from_fn(|_| point::<D>(kind, &mut r));
            let low = std::array::from_fn(|k| some.iter().fold(f64::INFINITY, |least, p| least.min(p[k])));
            let high = std::array::from_fn(|k| some.iter().fold(f64::NEG_INFINITY, |most, p| most.max(p[k])));
            if a == b {
                continue;
            }
            for beta in BETAS {
                let lune = Lune::new(a, b, beta);
                // The points, the corners, and the nearest one to the middle.
                let middle: [f64; D] =
                    std::array::from_fn(|k| (0.5 * a[k] + 0.5 * b[k]).max(low[k]).min(high[k]));
                let corners = (0..1 << D).map(|c| std::array::from_fn(|k| [low, high][c >> k & 1][k]));
                let inside = some
                    .into_iter()
                    .chain(corners)
                    .chain([middle])
                    .any(|p| lune.place(&p) == LunePlace::Inside);
                let is_clear = lune.is_clear_of(&low, &high);
                assert!(!(inside && is_clear), "{a:?} {b:?} {beta} {low:?} {high:?}");
                clear += usize::from(is_clear);
                held += usize::from(inside);
            }
        }
    }
    assert!(clear > rounds && held > rounds, "{clear} {held}");
}

#[test]
fn boxes_are_clear_of_lunes() {
    boxes::<2>(5, 3000);
    boxes::<3>(6, 2000);
}

#[test]
fn lengths_are_exact() {
    let mut equal = 0;
    for kind in 0..6 {
        let mut r = Random::new(3);
        for _ in 0..10_000 {
            let [a, b, c, d] = [(); 4].map(|()| point::<3>(kind, &mut r));
            let expected = exact::compare_lengths([a, b], [c, d]);
            assert_eq!(compare_lengths([a, b], [c, d]) as i8, expected, "{a:?} {b:?} {c:?} {d:?}");
            assert_eq!(compare_lengths([d, c], [a, b]) as i8, -expected, "{a:?} {b:?} {c:?} {d:?}");
            let flat = [a, b, c, d].map(|[x, y, _]| [x, y]);
            let expected = exact::compare_lengths([flat[0], flat[1]], [flat[2], flat[3]]);
            assert_eq!(compare_lengths([flat[0], flat[1]], [flat[2], flat[3]]) as i8, expected, "{flat:?}");
            equal += usize::from(expected == 0);
        }
    }
    assert!(equal > 300, "only {equal} ties were met");
}

/// One question in two words.
#[test]
fn words_agree() {
    let mut r = Random::new(4);
    for kind in 0..6 {
        for _ in 0..3000 {
            let [a, b, p] = [(); 3].map(|()| point::<2>(kind, &mut r));
            assert_eq!(in_diametral_ball(a, b, p), !angle(p, a, b).is_positive());
            let radius = r.between(0.0, 5.0);
            let segment = [[0.0, 0.0], [radius, 0.0]];
            assert_eq!(compare_lengths([a, p], segment), compare_with_radius(a, p, radius));
        }
    }
}
