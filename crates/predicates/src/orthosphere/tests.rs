//! The bounds, derived again, and what each stage decides by itself: an answer that is right but late is seen by no comparison.

use delone_generators::Random;

use super::filter::{CEILING, EDGE_BOUND, FLOOR, TRIANGLE_BOUND};
use super::{RadiusScale, filter};
use crate::ball::{ALLOWANCE, Ball, Number};
use crate::exact::big;
use crate::exact::big_int::BigInt;
use crate::{Sign, Site};

const U: f64 = f64::EPSILON / 2.0;

/// A computed quantity of known sign of all its terms: the relative error of their sum.
fn product(a: f64, b: f64) -> f64 {
    let inherited = a + b + a * b;
    inherited + U * (1.0 + inherited)
}

fn sum(a: f64, b: f64) -> f64 {
    a.max(b) + U * (1.0 + a.max(b))
}

/// Errors relative to the sums of magnitudes. The last rounding is relative to the result, so it changes no sign; the computed size is
/// off by as much as a value at most.
#[test]
fn bounds_cover_their_formulas() {
    let (u, one) = (2f64.powi(-53), U);
    let square = product(one, one);
    let length = sum(sum(square, square), square);
    let lift = sum(length, one);
    let edge = product(lift, length).max(product(lift, length));
    assert!(edge <= EDGE_BOUND * (1.0 - 20.0 * U), "{} u", edge / u);
    let minor = sum(square, square);
    let normal = sum(sum(product(minor, minor), product(minor, minor)), product(minor, minor));
    let t = sum(product(lift, one), product(lift, one));
    let side = sum(product(minor, one), product(minor, one));
    let other = sum(sum(product(t, side), product(t, side)), product(t, side));
    let triangle = product(lift, normal).max(other);
    assert!(triangle <= TRIANGLE_BOUND * (1.0 - 24.0 * U), "{} u", triangle / u);
    assert!(edge >= 0.8 * EDGE_BOUND && triangle >= 0.8 * TRIANGLE_BOUND, "{} {}", edge / u, triangle / u);
    assert_eq!((CEILING, FLOOR), (2f64.powi(200), 2f64.powi(-660)));
    assert_eq!((U, ALLOWANCE), (u, 16.0 * u * u));
}

/// Sums, differences and products of random balls, and of what comes of them, hold the exact results.
#[test]
fn balls_hold_what_they_stand_for() {
    let mut random = Random::new(1);
    for round in 0..20_000 {
        let size = [0, 3, 60, 200][round % 4];
        let mut number = || {
            let power = 2f64.powi(random.below(2 * size + 1) as i32 - size as i32);
            let x = (random.unit() - 0.5) * power;
            if random.below(3) == 0 { (x * 4.0).round() / 4.0 } else { x }
        };
        let numbers = [number(), number(), number(), number()];
        let (integers, scale) = big::integers(&numbers);
        if scale == i32::MAX {
            continue;
        }
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| integers[i].clone());
        let [x, y, z, w] = numbers.map(Ball::exactly);
        let difference = Ball::difference(numbers[0], numbers[1]);
        holds(&difference, &(&a - &b), scale);
        let ball = difference.times(&z.minus(&w)).plus(&x.times(&y));
        let exact = (&a - &b) * (&c - &d) + &a * &b;
        holds(&ball, &exact, 2 * scale);
        holds(
            &ball.square().minus(&ball.times(&z.times(&w))),
            &(&exact * &exact - &exact * &c * &d),
            4 * scale,
        );
    }
}

fn holds(ball: &Ball<f64>, exact: &BigInt, scale: i32) {
    let (parts, of_parts) = big::integers(&[ball.high, ball.low, ball.radius, 1.0]);
    let (of_exact, finest) = (scale - scale.min(of_parts), scale.min(of_parts));
    let exact = exact.clone() << of_exact.unsigned_abs();
    let parts: Vec<_> = parts.into_iter().map(|x| x << (of_parts - finest).unsigned_abs()).collect();
    let off = &parts[0] + &parts[1] - exact;
    assert!(off.magnitude() <= parts[2], "{ball:?}");
    assert!(ball.low.abs() <= U * ball.high.abs(), "{ball:?}");
}

/// Points with weights in general position.
const SITES: [Site<3>; 4] =
    [([0.1, 0.2, 0.3], 0.25), ([3.3, 0.7, 0.4], 0.5), ([1.6, 2.9, 0.8], 0.125), ([1.2, 1.4, 3.1], 0.75)];

fn scaled(size: f64) -> [Site<3>; 4] {
    SITES.map(|(p, w)| (p.map(|x| x * size), w * size * size))
}

#[test]
fn floating_point_tells_what_is_plain() {
    for size in [1.0, 1e-3, 1e3, 1e-20, 1e20] {
        let [a, b, c, d] = scaled(size);
        let between = |w: f64| ([1.5 * size, 1.5 * size, 0.4 * size], w * size * size);
        assert_eq!(filter::triangle(a, b, c, d), Some(Sign::Positive), "{size}");
        assert_eq!(filter::triangle(a, b, c, between(0.3)), Some(Sign::Negative), "{size}");
        assert_eq!(filter::edge(a, b, c), Some(Sign::Positive), "{size}");
        assert_eq!(filter::edge(a, b, between(2.0)), Some(Sign::Negative), "{size}");
        assert_eq!(filter::angle(a.0, b.0, between(0.0).0), Some(Sign::Negative), "{size}");
    }
    // What is too large for the floor is left to integers.
    let [a, b, c, d] = scaled(2f64.powi(110));
    assert_eq!((filter::triangle(a, b, c, d), filter::edge(a, b, c)), (None, None));
}

/// Radii of simplices that are not flat need no big integers, at any size on a scale of their own; ends of the range do.
#[test]
fn balls_tell_nearly_all_radii() {
    let told = |scale: RadiusScale, sites: [Site<3>; 4]| {
        let [least, most] = scale.bounds(&sites, |x| x);
        least == most && (least * scale.back).is_normal()
    };
    for size in [1.0, 1e-6, 1e6, 1e-60, 1e60, 1e-110, 1e110] {
        assert!(told(RadiusScale::for_box(4.0 * size), scaled(size)), "{size}");
    }
    assert!(!told(RadiusScale::ONE, scaled(1e150)) && !told(RadiusScale::ONE, scaled(1e-150)));
    let mut random = Random::new(2);
    let count = (0..10_000)
        .filter(|_| {
            let sites =
                std::array::from_fn(|_| (std::array::from_fn(|_| random.unit()), 0.1 * random.unit()));
            told(RadiusScale::ONE, sites)
        })
        .count();
    assert!(count > 9990, "{count}");
}
