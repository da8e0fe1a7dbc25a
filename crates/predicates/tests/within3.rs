//! A sphere that is said to stay inside of a box does, however close they are.

use delone_generators::Random;
use delone_oracle::exact;
use delone_predicates::{Point3, stays_within3};

/// Some tetrahedron: evenly spread corners, or nearly flat ones, perhaps far from the origin.
fn corners(r: &mut Random, size: f64, offset: f64) -> [Point3; 4] {
    let point = |r: &mut Random, size: f64| [0, 1, 2].map(|_| size * r.between(-1.0, 1.0));
    let (a, b, c) = (point(r, size), point(r, size), point(r, size));
    let flatness = [1.0, 1.0, 1e-3, 1e-7, 1e-12][r.below(5)];
    let (s, t, off) = (r.between(-1.0, 2.0), r.between(-1.0, 2.0), point(r, size * flatness));
    let d = [0, 1, 2].map(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]) + off[k]);
    let at = point(r, size * offset);
    [a, b, c, d].map(|p| [0, 1, 2].map(|k| p[k] + at[k]))
}

/// The center and the radius, rounded.
fn sphere([a, b, c, d]: [Point3; 4]) -> (Point3, f64) {
    let from = |p: Point3| [0, 1, 2].map(|k| p[k] - a[k]);
    let [b, c, d] = [b, c, d].map(from);
    let dot = |p: Point3, q: Point3| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let cross = |p: Point3, q: Point3| {
        [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    };
    let (cd, db, bc) = (cross(c, d), cross(d, b), cross(b, c));
    let det = 2.0 * dot(b, cd);
    let at = [0, 1, 2].map(|k| (dot(b, b) * cd[k] + dot(c, c) * db[k] + dot(d, d) * bc[k]) / det);
    ([0, 1, 2].map(|k| a[k] + at[k]), dot(at, at).sqrt())
}

#[test]
fn spheres_within_are_within() {
    let mut r = Random::new(5);
    let (mut within, mut close, mut inside) = (0, 0, 0);
    for _ in 0..40_000 {
        let size = [1.0, 1e-55, 1e55, 1e-70, 1e70][r.below(5)];
        let offset = [0.0, 1.0, 1e3, 1e8, 1e12][r.below(5)];
        let corners = corners(&mut r, size, offset);
        let (center, radius) = sphere(corners);
        let [a, b, c, d] = corners;
        if !(center.iter().sum::<f64>() + radius).is_finite() || exact::orient3d(a, b, c, d) == 0 {
            continue;
        }
        // A box with one side near the sphere, the others further away or at infinity.
        let gap = [0.3, 1e-3, 1e-8, 1e-12, 1e-15, 1e-17, -1e-17, -1e-15, -1e-12, -0.1][r.below(10)];
        let mut gaps = [(); 6].map(|()| [1e-3, 2.0, f64::INFINITY][r.below(3)]);
        gaps[r.below(6)] = gap;
        let low = [0, 1, 2].map(|k| center[k] - radius * (1.0 + gaps[k]));
        let high = [0, 1, 2].map(|k| center[k] + radius * (1.0 + gaps[k + 3]));
        let truth = exact::sphere_is_within(corners, low, high);
        inside += usize::from(truth);
        if stays_within3(corners, low, high) {
            within += 1;
            close += usize::from(gap < 1e-7);
            assert!(truth, "{corners:?} {low:?} {high:?}");
        } else {
            let magnitude = center.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let is_usual = size > 1e-60 && size < 1e60 && radius < 30.0 * size && magnitude < 1e4 * size;
            assert!(gap < 1e-4 || !is_usual, "{corners:?} {low:?} {high:?}");
        }
    }
    assert!(within > 5_000 && close > 500 && inside > within, "{within} {close} {inside}");
}

/// Spheres that touch a side, or would but for one unit in the last place, in numbers without rounding.
#[test]
fn what_touches_is_not_within() {
    // Around (0, 0, 0), radius 9.
    let corners = [[1.0, 4.0, 8.0], [-8.0, 1.0, 4.0], [4.0, -8.0, 1.0], [0.0, 0.0, -9.0]];
    let turned = [corners[1], corners[0], corners[2], corners[3]];
    for at in [0.0, 1.0, 4096.0] {
        let moved = |[x, y, z]: Point3| [x + at, y - at, z + 2.0 * at];
        for corners in [corners, turned].map(|corners| corners.map(moved)) {
            for k in 0..6 {
                let with = |reach: f64| {
                    let (mut low, mut high) = ([f64::NEG_INFINITY; 3], [f64::INFINITY; 3]);
                    let center = moved([0.0; 3]);
                    if k < 3 {
                        low[k] = center[k] - reach;
                    } else {
                        high[k - 3] = center[k - 3] + reach;
                    }
                    (stays_within3(corners, low, high), exact::sphere_is_within(corners, low, high))
                };
                assert_eq!(with(9.0), (false, false));
                assert_eq!(with(8.0), (false, false));
                assert_eq!(with(9.0 + 1e-9), (true, true));
                assert!(!with(9f64.next_down()).0);
                assert!(at > 0.0 || with(9f64.next_up()).1);
            }
        }
    }
}

#[test]
fn numbers_that_overflow_are_never_within() {
    let of_size = |x: f64| [[0.0; 3], [x, 0.0, 0.0], [0.0, x, 0.0], [0.0, 0.0, x]];
    let (low, high) = ([-1e308; 3], [f64::INFINITY; 3]);
    assert!(!stays_within3(of_size(1e300), low, high));
    assert!(!stays_within3(of_size(1e-300), [-1.0; 3], [1.0; 3]));
    assert!(!stays_within3([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]], low, high));
    assert!(!stays_within3([[1e308; 3]; 4], [-1e308; 3], high));
    // Space has no sides.
    assert!(stays_within3(of_size(1e300), [f64::NEG_INFINITY; 3], [f64::INFINITY; 3]));
    assert!(stays_within3(of_size(1.0), [-f64::MAX; 3], [f64::MAX; 3]));
    assert!(!stays_within3(of_size(1.0), [f64::NAN; 3], [f64::INFINITY; 3]));
    assert!(!stays_within3(of_size(1.0), [2.0; 3], [1.0; 3]));
}
