//! Who is inside of the smallest orthogonal spheres, and how large these are, against fractions of determinants.

use delone_generators::Random;
use delone_oracle::alpha;
use delone_predicates::{
    RadiusScale, Site, are_collinear3, edge_is_attached, orient2d, orient3d, squared_radius,
    triangle_is_attached, vertex_is_attached,
};

/// A coordinate of a family, and a weight.
type Family = (&'static str, fn(&mut Random) -> f64, fn(&mut Random, &[f64]) -> f64);

fn power_of_two(random: &mut Random, below: usize) -> f64 {
    2f64.powi(random.below(2 * below) as i32 - below as i32)
}

fn square(point: &[f64]) -> f64 {
    point.iter().map(|x| x * x).sum()
}

const FAMILIES: &[Family] = &[
    ("uniform", |r| r.unit(), |_, _| 0.0),
    ("uniform with weights", |r| r.unit(), |r, _| r.unit() / 4.0),
    ("around zero", |r| (r.unit() - 0.5) * power_of_two(r, 20), |_, _| 0.0),
    ("small integers", |r| r.below(4) as f64, |_, _| 0.0),
    ("small integers with weights", |r| r.below(4) as f64, |r, _| r.below(3) as f64),
    ("orthogonal to the origin", |r| r.below(5) as f64, |_, p| square(p)),
    ("nearly", |r| r.below(5) as f64 / 8.0, |r, p| square(p) + [0.0, 1e-17, -1e-300][r.below(3)]),
    ("nearly flat", |r| r.below(4) as f64 + 1e-14 * r.unit(), |_, _| 0.3),
    ("centimetres far away", |r| 500_000.0 + r.below(30) as f64 / 100.0, |r, _| r.below(50) as f64 / 1000.0),
    ("large weights", |r| r.unit(), |r, _| (r.unit() - 0.5) * 1e15),
    ("small weights", |r| r.unit(), |r, _| (r.unit() - 0.5) * 1e-18),
    ("any size", |r| (r.unit() - 0.5) * power_of_two(r, 300), |r, _| (r.unit() - 0.5) * power_of_two(r, 600)),
    ("at the ends of the range", |r| (r.unit() - 0.5) * [1e-160, 1e160][r.below(2)], |_, _| 0.0),
    ("tiny", |r| r.unit() * 1e-160, |r, _| r.unit() * 1e-310),
    ("subnormal", |r| f64::from_bits(r.bits() >> 58), |r, _| f64::from_bits(r.bits() >> 60)),
    ("the largest", |r| f64::MAX * (r.unit() - 0.5), |r, _| f64::MAX * (r.unit() - 0.5)),
];

fn tuples<const D: usize, const N: usize>(seed: u64, n: usize, mut judge: impl FnMut(&str, [Site<D>; N])) {
    for (name, coordinate, weight) in FAMILIES {
        let mut random = Random::new(seed);
        for _ in 0..n {
            let sites: [Site<D>; N] = std::array::from_fn(|_| {
                let point = std::array::from_fn(|_| coordinate(&mut random));
                (point, weight(&mut random, &point))
            });
            if (0..N).all(|i| (0..i).all(|j| sites[i].0 != sites[j].0)) {
                judge(name, sites);
            }
        }
    }
}

/// Of random numbers some are inside and some are not, and of integers many are on the sphere.
#[test]
fn who_is_inside_is_exact() {
    let mut inside = [0; 4];
    tuples::<2, 3>(1, 1500, |name, sites| {
        let [a, b, q] = sites;
        assert_eq!(vertex_is_attached(a, q), alpha::is_inside(&[a, q]), "{name}: {sites:?}");
        let expected = alpha::is_inside(&sites);
        assert_eq!(edge_is_attached(a, b, q), expected, "{name}: {sites:?}");
        assert_eq!(edge_is_attached(b, a, q), expected, "{name}: {sites:?}");
        inside[0] += usize::from(vertex_is_attached(a, q));
        inside[1] += usize::from(expected);
    });
    tuples::<3, 3>(2, 1500, |name, sites| {
        let [a, b, q] = sites;
        let expected = alpha::is_inside(&sites);
        assert_eq!(edge_is_attached(a, b, q), expected, "{name}: {sites:?}");
        inside[2] += usize::from(expected);
    });
    tuples::<3, 4>(3, 1500, |name, sites| {
        let [a, b, c, q] = sites;
        if are_collinear3(a.0, b.0, c.0) {
            return;
        }
        let expected = alpha::is_inside(&sites);
        assert_eq!(triangle_is_attached(a, b, c, q), expected, "{name}: {sites:?}");
        assert_eq!(triangle_is_attached(c, a, b, q), expected, "{name}: {sites:?}");
        inside[3] += usize::from(expected);
    });
    assert!(inside.iter().all(|&count| count > 1000), "{inside:?}");
}

/// By every door: alone, in pairs with another one, on a scale of its own, with the corners in another order.
fn check_radius<const D: usize, const N: usize>(name: &str, sites: [Site<D>; N]) {
    let radius = squared_radius(sites);
    let exact = alpha::squared_radius(&sites);
    assert!(exact.is_rounded_to(radius), "{name}: {radius:e} {sites:?}");
    let mut turned = sites;
    turned.rotate_left(1);
    let all = sites.iter().flat_map(|site| site.0);
    let side = all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min);
    let scale = RadiusScale::for_box(side);
    let both = scale.radii([sites, turned]);
    let found = [squared_radius(turned), scale.radius(sites), both[0], both[1]];
    assert_eq!(found.map(f64::to_bits), [radius.to_bits(); 4], "{name}: {sites:?}");
}

#[test]
fn radii_are_rounded_once() {
    tuples::<2, 1>(4, 20, check_radius);
    tuples::<2, 2>(4, 1200, check_radius);
    tuples::<3, 2>(5, 1200, check_radius);
    tuples::<2, 3>(6, 1200, |name, sites| {
        let [a, b, c] = sites.map(|site| site.0);
        if !orient2d(a, b, c).is_zero() {
            check_radius(name, sites);
        }
    });
    tuples::<3, 3>(7, 1200, |name, sites| {
        let [a, b, c] = sites.map(|site| site.0);
        if !are_collinear3(a, b, c) {
            check_radius(name, sites);
        }
    });
    tuples::<3, 4>(8, 1200, |name, sites| {
        let [a, b, c, d] = sites.map(|site| site.0);
        if !orient3d(a, b, c, d).is_zero() {
            check_radius(name, sites);
        }
    });
}

#[test]
fn what_is_no_simplex_has_no_radius() {
    let line = [[0.0, 0.0], [1.0, 1.0], [3.0, 3.0], [4.0, 5.0]].map(|p| (p, 0.0));
    assert_eq!(squared_radius([line[0], line[1], line[2]]), f64::INFINITY);
    assert_eq!(squared_radius(line), f64::INFINITY);
    let place = ([0.1, 0.2, 0.3], 0.0);
    assert_eq!(squared_radius([place, place]), f64::INFINITY);
    assert!(squared_radius([(place.0, 0.0)]).is_sign_positive());
}
