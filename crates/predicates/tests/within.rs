//! A circle that is said to stay inside of a box does, however close they are.

use delone_generators::Random;
use delone_oracle::exact;
use delone_predicates::{Point2, stays_within};

/// Some triangle: evenly spread corners, or nearly flat ones, perhaps far from the origin.
fn corners(r: &mut Random, size: f64, offset: f64) -> [Point2; 3] {
    let point = |r: &mut Random, size: f64| [0, 1].map(|_| size * r.between(-1.0, 1.0));
    let (a, b) = (point(r, size), point(r, size));
    let flatness = [1.0, 1.0, 1e-3, 1e-8, 1e-13][r.below(5)];
    let (s, off) = (r.between(-1.0, 2.0), point(r, size * flatness));
    let c = [0, 1].map(|k| a[k] + s * (b[k] - a[k]) + off[k]);
    let at = point(r, size * offset);
    [a, b, c].map(|p| [p[0] + at[0], p[1] + at[1]])
}

/// The center and the radius, rounded.
fn circle([a, b, c]: [Point2; 3]) -> (Point2, f64) {
    let from = |p: Point2| [p[0] - a[0], p[1] - a[1]];
    let (b, c) = (from(b), from(c));
    let det = 2.0 * (b[0] * c[1] - b[1] * c[0]);
    let dot = |p: Point2| p[0] * p[0] + p[1] * p[1];
    let at = [(c[1] * dot(b) - b[1] * dot(c)) / det, (b[0] * dot(c) - c[0] * dot(b)) / det];
    ([a[0] + at[0], a[1] + at[1]], dot(at).sqrt())
}

#[test]
fn circles_within_are_within() {
    let mut r = Random::new(5);
    let (mut within, mut close, mut inside) = (0, 0, 0);
    for _ in 0..40_000 {
        let size = [1.0, 1e-55, 1e55, 1e-100, 1e140][r.below(5)];
        let offset = [0.0, 1.0, 1e3, 1e8, 1e12][r.below(5)];
        let corners = corners(&mut r, size, offset);
        let (center, radius) = circle(corners);
        if !(center[0] + center[1] + radius).is_finite()
            || exact::orient2d(corners[0], corners[1], corners[2]) == 0
        {
            continue;
        }
        // A box with one side near the circle, the others further away or at infinity.
        let gap = [0.3, 1e-3, 1e-8, 1e-12, 1e-15, 1e-17, -1e-17, -1e-15, -1e-12, -0.1][r.below(10)];
        let mut gaps = [(); 4].map(|()| [1e-3, 2.0, f64::INFINITY][r.below(3)]);
        gaps[r.below(4)] = gap;
        let low = [0, 1].map(|k| center[k] - radius * (1.0 + gaps[k]));
        let high = [0, 1].map(|k| center[k] + radius * (1.0 + gaps[k + 2]));
        let truth = exact::circle_is_within(corners, low, high);
        inside += usize::from(truth);
        if stays_within(corners, low, high) {
            within += 1;
            close += usize::from(gap < 1e-7);
            assert!(truth, "{corners:?} {low:?} {high:?}");
        } else {
            let magnitude = center.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let is_usual = size > 1e-60 && size < 1e60 && radius < 100.0 * size && magnitude < 1e4 * size;
            assert!(gap < 1e-4 || !is_usual, "{corners:?} {low:?} {high:?}");
        }
    }
    assert!(within > 5_000 && close > 500 && inside > within, "{within} {close} {inside}");
}

/// Circles that touch a side, or would but for one unit in the last place, in numbers without rounding.
#[test]
fn what_touches_is_not_within() {
    // Around (0, 0), radius 5.
    let corners = [[3.0, 4.0], [-4.0, 3.0], [0.0, -5.0]];
    let turned = [corners[1], corners[2], corners[0]];
    for at in [0.0, 1.0, 4096.0] {
        let moved = |[x, y]: Point2| [x + at, y - at];
        for corners in [corners, turned].map(|corners| corners.map(moved)) {
            for k in 0..4 {
                let with = |reach: f64| {
                    let mut sides = [f64::NEG_INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::INFINITY];
                    let center = moved([0.0; 2]);
                    sides[k] = if k < 2 { center[k] - reach } else { center[k - 2] + reach };
                    let (low, high) = ([sides[0], sides[1]], [sides[2], sides[3]]);
                    (stays_within(corners, low, high), exact::circle_is_within(corners, low, high))
                };
                assert_eq!(with(5.0), (false, false));
                assert_eq!(with(4.0), (false, false));
                assert_eq!(with(5.0 + 1e-9), (true, true));
                assert!(!with(5f64.next_down()).0);
                assert!(at > 0.0 || with(5f64.next_up()).1);
            }
        }
    }
}

#[test]
fn numbers_that_overflow_are_never_within() {
    let (low, high) = ([-1e308; 2], [f64::INFINITY; 2]);
    assert!(!stays_within([[0.0; 2], [1e300, 0.0], [0.0, 1e300]], low, high));
    assert!(!stays_within([[0.0; 2], [1e-300, 0.0], [0.0, 1e-300]], [-1.0; 2], [1.0; 2]));
    assert!(!stays_within([[0.0; 2], [1.0, 0.0], [2.0, 0.0]], low, high));
    assert!(!stays_within([[1e308; 2]; 3], [-1e308; 2], high));
    // The plane has no sides.
    let everywhere = ([f64::NEG_INFINITY; 2], [f64::INFINITY; 2]);
    assert!(stays_within([[0.0; 2], [1e300, 0.0], [0.0, 1e300]], everywhere.0, everywhere.1));
    let unit = [[0.0; 2], [1.0, 0.0], [0.0, 1.0]];
    assert!(stays_within(unit, [-f64::MAX; 2], [f64::MAX; 2]));
    assert!(!stays_within(unit, [f64::NAN; 2], [f64::INFINITY; 2]));
    assert!(!stays_within(unit, [2.0; 2], [1.0; 2]));
}
