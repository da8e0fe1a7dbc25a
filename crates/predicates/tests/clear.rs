//! A sphere that is said to keep clear of a box does, however close they are.

use delone_generators::Random;
use delone_oracle::exact;
use delone_predicates::{
    Point3, Site, in_power_sphere_with_ties, keeps_clear, keeps_clear_of_sites, orient3d,
};

fn point(r: &mut Random, size: f64) -> Point3 {
    [0, 1, 2].map(|_| size * r.between(-1.0, 1.0))
}

/// Some tetrahedron: evenly spread corners, nearly flat ones, or four nearly on one circle.
fn corners(r: &mut Random, size: f64) -> [Point3; 4] {
    let [a, b, c] = [(); 3].map(|()| point(r, size));
    let flatness = [1.0, 1e-3, 1e-8, 1e-13][r.below(4)];
    let (s, t) = (r.between(-1.0, 1.0), r.between(-1.0, 1.0));
    let off = point(r, size * flatness);
    let d = [0, 1, 2].map(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]) + off[k]);
    [a, b, c, d]
}

/// The center and the radius, rounded.
fn sphere([a, b, c, d]: [Point3; 4]) -> (Point3, f64) {
    let from = |p: Point3| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
    let cross = |p: Point3, q: Point3| {
        [0, 1, 2].map(|k| p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3])
    };
    let dot = |p: Point3, q: Point3| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let (b, c, d) = (from(b), from(c), from(d));
    let (cd, db, bc) = (cross(c, d), cross(d, b), cross(b, c));
    let at =
        [0, 1, 2].map(|k| (dot(b, b) * cd[k] + dot(c, c) * db[k] + dot(d, d) * bc[k]) / (2.0 * dot(b, cd)));
    ([0, 1, 2].map(|k| a[k] + at[k]), dot(at, at).sqrt())
}

/// Whether a point is outside of the sphere, and not on it.
fn is_outside([a, b, c, d]: [Point3; 4], q: Point3) -> bool {
    i32::from(exact::in_sphere_unperturbed(a, b, c, d, q)) * i32::from(exact::orient3d(a, b, c, d)) < 0
}

#[test]
fn clear_spheres_are_clear() {
    let mut r = Random::new(5);
    let (mut clear, mut close) = (0, 0);
    for _ in 0..40_000 {
        let size = [1.0, 1e-55, 1e55, 1e-100, 1e200][r.below(5)];
        let corners = corners(&mut r, size);
        let (center, radius) = sphere(corners);
        if !center.iter().all(|x| x.is_finite())
            || exact::orient3d(corners[0], corners[1], corners[2], corners[3]) == 0
        {
            continue;
        }
        // A box with a side, an edge or a corner near the sphere.
        let direction = [[1.0, 0.0, 0.0], [0.0, -0.6, 0.8], [-0.36, 0.48, 0.8]][r.below(3)];
        let gap = [0.3, 1e-3, 1e-8, 1e-12, 1e-15, -1e-15, -1e-12, -0.1][r.below(8)];
        let nearest = [0, 1, 2].map(|k| center[k] + radius * (1.0 + gap) * direction[k]);
        let away = |k: usize| if direction[k] == 0.0 { radius } else { 0.0 };
        let low = [0, 1, 2].map(|k| nearest[k] - if direction[k] < 0.0 { radius } else { away(k) });
        let high = [0, 1, 2].map(|k| nearest[k] + if direction[k] > 0.0 { radius } else { away(k) });
        if keeps_clear(corners, low, high) {
            clear += 1;
            close += usize::from(gap < 1e-7);
            let corner = |m: usize| [0, 1, 2].map(|k| if m >> k & 1 == 0 { low[k] } else { high[k] });
            assert!(is_outside(corners, nearest), "{corners:?} {nearest:?}");
            assert!((0..8).map(corner).all(|q| is_outside(corners, q)), "{corners:?} {low:?} {high:?}");
        } else {
            let is_usual = size > 1e-60 && size < 1e60 && radius < 100.0 * size;
            assert!(gap < 0.3 || !is_usual, "{corners:?}");
        }
    }
    assert!(clear > 5_000 && close > 500, "{clear} {close}");
}

#[test]
fn numbers_that_overflow_are_never_clear() {
    let huge = [[0.0; 3], [1e300, 0.0, 0.0], [0.0, 1e300, 0.0], [0.0, 0.0, 1e300]];
    assert!(!keeps_clear(huge, [1e305; 3], [1e306; 3]));
    let flat = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    assert!(!keeps_clear(flat, [5.0; 3], [6.0; 3]));
    let unit = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert!(!keeps_clear(unit, [f64::MAX; 3], [f64::MAX; 3]));
}

/// Whether a site is above the hyperplane through the lifted corners, and not on it.
fn is_above(corners: [Site<3>; 4], q: Site<3>) -> bool {
    let [a, b, c, d] = corners;
    let turned = orient3d(a.0, b.0, c.0, d.0);
    (in_power_sphere_with_ties(a, b, c, d, q) * turned).is_negative()
}

#[test]
fn what_is_clear_of_the_heaviest_is_so_exactly() {
    let mut r = Random::new(6);
    let (mut clear, mut close) = (0, 0);
    for round in 0..40_000 {
        let size = [1.0, 1e-3, 1e20, 1e-55, 1e55][r.below(5)];
        let weigh = [0.0, 1e-6, 0.3, 30.0, 1e9][r.below(5)] * size * size;
        let all = corners(&mut r, size).map(|p| (p, weigh * r.between(-1.0, 1.0)));
        // The center and the power of the first corner, rounded.
        let from = |p: Point3| [0, 1, 2].map(|k| p[k] - all[0].0[k]);
        let cross = |p: Point3, q: Point3| {
            [0, 1, 2].map(|k| p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3])
        };
        let dot = |p: Point3, q: Point3| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
        let [b, c, d] = [1, 2, 3].map(|i| from(all[i].0));
        let [lb, lc, ld] = [(b, 1), (c, 2), (d, 3)].map(|(p, i)| dot(p, p) - (all[i].1 - all[0].1));
        let (cd, db, bc) = (cross(c, d), cross(d, b), cross(b, c));
        let at = [0, 1, 2].map(|k| (lb * cd[k] + lc * db[k] + ld * bc[k]) / (2.0 * dot(b, cd)));
        let center = [0, 1, 2].map(|k| all[0].0[k] + at[k]);
        let radius = dot(at, at).sqrt().max(size);
        // A box at some distance, and weights that reach the sphere from there, nearly.
        let direction = point(&mut r, 1.0);
        let length = dot(direction, direction).sqrt();
        let distance = radius * [0.0, 0.2, 1.0, 1.5, 3.0][r.below(5)];
        let nearest = [0, 1, 2].map(|k| center[k] + distance * direction[k] / length);
        let low = [0, 1, 2].map(|k| nearest[k] - if direction[k] < 0.0 { radius } else { 0.0 });
        let high = [0, 1, 2].map(|k| nearest[k] + if direction[k] > 0.0 { radius } else { 0.0 });
        let reach = distance * distance - dot(at, at) + all[0].1;
        let gap = [0.3, 1e-3, 1e-8, 1e-12, 1e-15, -1e-15, -1e-12, -0.1][r.below(8)];
        let most = reach - gap * (radius * radius + weigh);
        if keeps_clear_of_sites(all, low, high, most) {
            clear += 1;
            close += usize::from(gap < 1e-7);
            assert!(gap > -0.01, "round {round}");
            let corner = |m: usize| [0, 1, 2].map(|k| if m >> k & 1 == 0 { low[k] } else { high[k] });
            assert!(is_above(all, (nearest, most)), "round {round}: {all:?} {nearest:?} {most}");
            assert!(
                (0..8).all(|m| is_above(all, (corner(m), most))),
                "round {round}: {all:?} {low:?} {high:?}"
            );
            assert!(is_above(all, (nearest, most - weigh - radius)), "a lighter one");
        } else {
            let is_usual = radius < 100.0 * size && weigh < size * size && size.max(1.0 / size) < 1e30;
            assert!(gap < 0.3 || !is_usual, "round {round}: {all:?}");
        }
    }
    assert!(clear > 5_000 && close > 500, "{clear} {close}");
}

#[test]
fn weights_that_overflow_are_never_clear() {
    let unit = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for (weights, most) in [
        ([0.0, 0.0, 0.0, 1e300], 0.0),
        ([0.0; 4], f64::MAX),
        ([f64::MAX, -f64::MAX, 0.0, 0.0], -f64::MAX),
        ([f64::MAX; 4], -f64::MAX),
    ] {
        let sites = [0, 1, 2, 3].map(|k| (unit[k], weights[k]));
        assert!(!keeps_clear_of_sites(sites, [5.0; 3], [6.0; 3], most), "{weights:?}");
    }
    let sites = unit.map(|p| (p, f64::NEG_INFINITY));
    assert!(!keeps_clear_of_sites(sites, [5.0; 3], [6.0; 3], f64::NEG_INFINITY));
}
