//! The power tests against determinants of unlimited size, on random and hostile sites.

use delone_generators::Random;
use delone_oracle::power::{Lifted, compare, has_nearest_center};
use delone_predicates::{
    Filter3, Grid, Line, Sign, Site, SpherePencil, Spot, compare_powers, in_circle, in_power_circle,
    in_power_circle_with_ties, in_power_interval, in_power_sphere, in_power_sphere_with_ties, in_sphere,
    orient2d, orient3d, power_center, power_center3,
};

/// A coordinate of a family, and a weight that ties often or nearly.
type Family = (&'static str, fn(&mut Random) -> f64, fn(&mut Random, &[f64]) -> f64);

fn square(point: &[f64]) -> f64 {
    point.iter().map(|x| x * x).sum()
}

fn power_of_two(random: &mut Random, below: usize) -> f64 {
    2f64.powi(random.below(2 * below) as i32 - below as i32)
}

const FAMILIES: &[Family] = &[
    ("uniform", |r| r.unit(), |r, _| r.unit() / 4.0),
    ("small integers", |r| r.below(4) as f64, |r, _| r.below(3) as f64),
    // All lifted points are on one plane.
    ("flat", |r| r.below(5) as f64, |_, p| square(p)),
    ("nearly flat", |r| r.below(5) as f64 / 8.0, |r, p| square(p) + [0.0, 1e-17, -1e-300][r.below(3)]),
    ("equal weights", |r| r.below(4) as f64 * 0.1, |_, _| 0.3),
    ("quarters", |r| r.below(5) as f64 / 2.0, |r, _| r.below(9) as f64 / 4.0 - 1.0),
    ("steps that no weight fits", |r| r.below(5) as f64 * 1024.0, |r, _| r.below(3) as f64 * 1e-9),
    ("centimetres far away", |r| 500_000.0 + r.below(30) as f64 / 100.0, |r, _| r.below(50) as f64 / 1000.0),
    ("large weights", |r| r.unit(), |r, _| (r.unit() - 0.5) * 1e15),
    ("small weights", |r| r.unit(), |r, _| (r.unit() - 0.5) * 1e-18),
    ("any size", |r| (r.unit() - 0.5) * power_of_two(r, 300), |r, _| (r.unit() - 0.5) * power_of_two(r, 600)),
    ("subnormal", |r| f64::from_bits(r.bits() >> 58), |r, _| f64::from_bits(r.bits() >> 60)),
    ("the largest", |r| f64::MAX * (r.unit() - 0.5), |r, _| f64::MAX * (r.unit() - 0.5)),
];

/// Sites with points that differ, but for the last, which may be at another one with another weight.
fn tuples<const D: usize, const N: usize>(seed: u64, n: usize, mut judge: impl FnMut(&str, [Site<D>; N])) {
    for (name, coordinate, weight) in FAMILIES {
        let mut random = Random::new(seed);
        for _ in 0..n {
            let sites: [Site<D>; N] = std::array::from_fn(|_| {
                let point = std::array::from_fn(|_| coordinate(&mut random));
                (point, weight(&mut random, &point))
            });
            let differ =
                |i: usize, j: usize| sites[i].0 != sites[j].0 || (i == N - 1 && sites[i].1 != sites[j].1);
            if (0..N).all(|i| (0..i).all(|j| differ(i, j))) {
                judge(name, sites);
            }
        }
    }
}

fn sign(value: i8) -> Sign {
    Sign::of(&value, &0)
}

#[test]
fn the_test_in_the_plane_is_exact_and_canonical() {
    let mut ties = 0;
    tuples::<2, 4>(1, 2500, |name, sites| {
        let [a, b, c, d] = sites;
        let turn = orient2d(a.0, b.0, c.0);
        if turn.is_zero() {
            return;
        }
        let lifted = Lifted::new(&sites);
        let expected = |perturbed| sign(lifted.is_below(&[0, 1, 2], 3, perturbed)) * turn;
        assert_eq!(in_power_circle(a, b, c, d), expected(true), "{name}: {sites:?}");
        assert_eq!(in_power_circle_with_ties(a, b, c, d), expected(false), "{name}: {sites:?}");
        assert_eq!(in_power_circle(b, a, c, d), -expected(true), "{name}: {sites:?}");
        if a.1 == b.1 && b.1 == c.1 && c.1 == d.1 {
            assert_eq!(in_circle(a.0, b.0, c.0, d.0), expected(true), "{name}: {sites:?}");
        }
        ties += usize::from(expected(false).is_zero());
    });
    assert!(ties > 2000, "only {ties} ties were met");
}

#[test]
fn the_test_on_a_line_is_exact_and_canonical() {
    let mut ties = 0;
    tuples::<2, 3>(2, 8000, |name, mut sites| {
        // Onto a horizontal, a vertical or a diagonal line.
        for k in 0..3 {
            for (point, _) in &mut sites {
                *point = [[point[0], 1.0], [0.5, point[0]], [point[0], point[0]]][k];
            }
            let [a, b, q] = sites;
            let equal = |p: Site<2>| p.0 == q.0 && p.1 == q.1;
            if a.0 == b.0 || equal(a) || equal(b) {
                continue;
            }
            let expected = Lifted::new(&sites).is_below(&[0, 1], 2, true);
            assert_eq!(in_power_interval(a, b, q), sign(expected), "{name}: {sites:?}");
            assert_eq!(in_power_interval(b, a, q), sign(expected), "{name}: {sites:?}");
            ties += usize::from(Lifted::new(&sites).is_below(&[0, 1], 2, false) == 0);
        }
    });
    assert!(ties > 1000, "only {ties} ties were met");
}

#[test]
fn the_test_in_space_is_exact_and_canonical() {
    let (mut ties, mut told) = (0, 0);
    tuples::<3, 5>(3, 1200, |name, sites| {
        let [a, b, c, d, e] = sites;
        let turn = orient3d(a.0, b.0, c.0, d.0);
        if turn.is_zero() {
            return;
        }
        let lifted = Lifted::new(&sites);
        let expected = |perturbed| sign(lifted.is_below(&[0, 1, 2, 3], 4, perturbed)) * turn;
        assert_eq!(in_power_sphere(a, b, c, d, e), expected(true), "{name}: {sites:?}");
        assert_eq!(in_power_sphere_with_ties(a, b, c, d, e), expected(false), "{name}: {sites:?}");
        if sites.iter().all(|site| site.1 == a.1) {
            assert_eq!(in_sphere(a.0, b.0, c.0, d.0, e.0), expected(true), "{name}: {sites:?}");
        }
        // The filter of the box, and of two boxes' worth of sites at once.
        let extremes = |value: &dyn Fn(&Site<3>) -> f64| {
            let all = sites.iter().map(value);
            all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
        };
        let extent = [0, 1, 2].map(|axis| extremes(&|site| site.0[axis]));
        let roots: Vec<f64> = sites.iter().flat_map(|site| site.0).collect();
        let on_grid = |grid: &Grid| sites.iter().all(|site| grid.holds_square(site.1));
        let grid = Grid::of(&roots).filter(on_grid);
        let filter =
            Filter3::for_sites(extent.map(|x| x * (1.0 + f64::EPSILON)), extremes(&|site| site.1), grid);
        let [p, q, r, s, t] = sites.each_ref().map(|site| (&site.0, site.1));
        assert_eq!(filter.in_power_sphere([p, q, r, s], t), expected(true), "{name}: {sites:?}");
        let both = filter.in_power_spheres([[p, q, r, s], [q, p, r, s]], t);
        assert_eq!(both, [expected(true), -expected(true)], "{name}: {sites:?}");
        let bundle = SpherePencil::new([a, b, c]);
        assert!(bundle.side(d, &filter).is_none_or(|side| side == turn), "{name}: {sites:?}");
        if let Some(side) = bundle.through(d).side(e, &filter) {
            told += 1;
            assert_eq!(side, expected(true), "{name}: {sites:?}");
        }
        ties += usize::from(expected(false).is_zero());
    });
    assert!(ties > 500, "only {ties} ties were met");
    assert!(told > 500, "only {told} spheres of bundles told a side");
}

/// Where the radical axes of three sites meet a fourth one has less power exactly if it is below their plane.
#[test]
fn radical_axes_are_on_the_side_that_the_power_test_says() {
    let mut ties = 0;
    tuples::<2, 4>(5, 1500, |name, sites| {
        let [a, b, c, d] = sites;
        let turn = orient2d(a.0, b.0, c.0);
        if turn.is_zero() || a.0 == d.0 {
            return;
        }
        let spot = Spot::Meeting(Line::Radical(a, b), Line::Radical(c, a));
        let expected = -in_power_circle_with_ties(a, b, c, d) * turn;
        assert_eq!(Line::Radical(a, d).side(&spot), expected, "{name}: {sites:?}");
        assert_eq!(Line::Radical(d, a).side(&spot), -expected, "{name}: {sites:?}");
        ties += usize::from(expected.is_zero());
        // At points, and without weights.
        let side = Line::Radical(a, b).side(&Spot::Point(c.0));
        assert_eq!(
            side,
            Sign::of(&compare_powers(c.0, b, a), &std::cmp::Ordering::Equal),
            "{name}: {sites:?}"
        );
        let plain = Spot::Meeting(Line::Bisector(a.0, b.0), Line::Bisector(c.0, a.0));
        let equal = |site: Site<2>| (site.0, 0.5);
        let same = Spot::Meeting(Line::Radical(equal(a), equal(b)), Line::Radical(equal(c), equal(a)));
        let third = [Line::Bisector(a.0, d.0).side(&plain), Line::Radical(equal(a), equal(d)).side(&same)];
        assert_eq!(third[0], third[1], "{name}: {sites:?}");
    });
    assert!(ties > 500, "only {ties} ties were met");
}

#[test]
fn power_centers_are_correctly_rounded() {
    let mut near = 0;
    tuples::<2, 3>(6, 2000, |name, [a, b, c]| {
        let Some(center) = power_center(a, b, c) else { return };
        let bits = center.map(f64::to_bits);
        for [p, q, r] in [[a, c, b], [b, a, c], [b, c, a], [c, a, b], [c, b, a]] {
            assert_eq!(
                power_center(p, q, r).map(|p| p.map(f64::to_bits)),
                Some(bits),
                "{name}: {a:?} {b:?} {c:?}"
            );
        }
        let spot = Spot::Meeting(Line::Radical(b, a), Line::Radical(c, b));
        assert_eq!(spot.rounded().map(|p| p.map(f64::to_bits)), Some(bits), "{name}: {a:?} {b:?} {c:?}");
        assert!(has_nearest_center(&[a, b, c], center), "{name}: {a:?} {b:?} {c:?}");
        near += 1;
    });
    assert!(near > 1000, "{near}");
}

#[test]
fn power_centers_in_space_are_correctly_rounded() {
    let mut near = 0;
    tuples::<3, 4>(7, 600, |name, sites| {
        let [a, b, c, d] = sites;
        let center = power_center3(a, b, c, d);
        if orient3d(a.0, b.0, c.0, d.0).is_zero() {
            assert_eq!(center, None, "{name}: {sites:?}");
            return;
        }
        let Some(center) = center else { return };
        assert!(has_nearest_center(&sites, center), "{name}: {sites:?} {center:?}");
        assert_eq!(power_center3(d, b, a, c), Some(center), "{name}: {sites:?}");
        near += 1;
    });
    assert!(near > 1000, "{near}");
}

#[test]
fn powers_are_compared_exactly() {
    let mut equal = 0;
    tuples::<2, 3>(4, 3000, |name, [a, b, (q, _)]| {
        let expected = compare(q, a, b);
        assert_eq!(compare_powers(q, a, b), expected, "{name}: {a:?} {b:?} {q:?}");
        equal += usize::from(expected.is_eq());
    });
    assert!(equal > 1000, "only {equal} ties were met");
}
