//! Every predicate against integer determinants of unlimited size, on random and adversarial tuples.

use delone_generators::Random;
use delone_oracle::{exact, share};
use delone_predicates::{
    Filter, Filter3, FixedPoint, Four, Grid, Pencil, Plane, Point2, Point3, Sign, SpherePencil, angle,
    center_direction, center_side, compare_distances, compare_distances3, compare_with_radius,
    compare_with_radius3, in_circle, in_circle_with_ties, in_sphere, in_sphere_with_ties, is_surely_further,
    lexicographic, lexicographic3, orient2d, orient3d,
};

/// A family of hostile tuples of four points.
type Family = fn(&mut Random) -> [Point2; 4];

const FAMILIES: &[(&str, Family)] = &[
    ("uniform", |r| four(|| [r.unit(), r.unit()])),
    ("small integers", |r| four(|| [r.below(5) as f64, r.below(5) as f64])),
    ("integers near 2^53", |r| four(|| [near_2_53(r), near_2_53(r)])),
    ("integers near 2^53 and small ones", |r| {
        four(|| {
            if r.below(2) == 0 {
                [near_2_53(r), r.below(9) as f64]
            } else {
                [r.below(9) as f64, near_2_53(r)]
            }
        })
    }),
    ("any magnitude", |r| four(|| [any_bits(r), any_bits(r)])),
    ("subnormal", |r| four(|| [f64::from_bits(r.bits() >> 50), -f64::from_bits(r.bits() >> 50)])),
    ("the largest", |r| four(|| [f64::MAX * (r.unit() - 0.5) * 2.0, f64::MAX * (r.unit() - 0.5) * 2.0])),
    ("nearly collinear", |r| {
        let (slope, start) = (r.unit(), r.unit());
        four(|| {
            let x = r.unit();
            nudged(r, [x, start + slope * x])
        })
    }),
    ("nearly cocircular", |r| {
        let radius = r.between(0.5, 2.0);
        four(|| {
            let angle = r.between(0.0, std::f64::consts::TAU);
            nudged(r, [3.0 + radius * angle.cos(), radius * angle.sin() - 1.0])
        })
    }),
    ("cocircular rectangles, nudged", |r| {
        let (x, y, w, h) = (r.unit(), r.unit(), r.unit(), r.unit());
        [[x, y], [x + w, y], [x + w, y + h], [x, y + h]].map(|p| nudged(r, p))
    }),
    ("cocircular lattice points", |r| {
        // Of the circle with radius 65: exact ties, in any order and at any binary scale.
        let octant = [[65, 0], [63, 16], [60, 25], [56, 33], [52, 39], [39, 52], [33, 56], [16, 63]];
        let scale = 2f64.powi(r.below(400) as i32 - 200);
        four(|| {
            let [x, y] = octant[r.below(8)].map(f64::from);
            let sign = |r: &mut Random| if r.below(2) == 0 { 1.0 } else { -1.0 };
            [x * sign(r) * scale, y * sign(r) * scale]
        })
    }),
    ("collinear on a diagonal with far points", |r| {
        four(|| {
            let x = 2f64.powi(r.below(600) as i32 - 300);
            if r.below(4) == 0 { nudged(r, [x, x]) } else { [x, x] }
        })
    }),
    ("lengths that differ, products that underflow", |r| {
        // A short vector, one at right angles to it, a long one, and any of them from anywhere in between.
        let magnitude = |r: &mut Random| 2f64.powi(r.below(1400) as i32 - 1070) * r.between(0.5, 1.0);
        let (p, q) = ([magnitude(r), magnitude(r)], magnitude(r));
        let across = [-p[1] * q, p[0] * q];
        let far = magnitude(r);
        let odd = |r: &mut Random| [far * (r.unit() - 0.5), far * (r.unit() - 0.5)];
        [[0.0, 0.0], p, odd(r), if r.below(2) == 0 { across } else { [magnitude(r), -magnitude(r)] }]
    }),
    ("cm at a UTM offset", |r| {
        four(|| [500_000.0 + r.below(300) as f64 / 100.0, 5_400_000.0 + r.below(300) as f64 / 100.0])
    }),
];

fn four(mut make: impl FnMut() -> Point2) -> [Point2; 4] {
    [(); 4].map(|()| make())
}

fn near_2_53(random: &mut Random) -> f64 {
    9_007_199_254_740_992.0 - random.below(8) as f64
}

fn any_bits(random: &mut Random) -> f64 {
    loop {
        let x = f64::from_bits(random.bits());
        if x.is_finite() {
            return x;
        }
    }
}

/// Each coordinate moved by up to two units in the last place.
fn nudged(random: &mut Random, p: Point2) -> Point2 {
    p.map(|x| {
        let steps = random.below(5) as i64 - 2;
        f64::from_bits(x.to_bits().wrapping_add_signed(steps))
    })
}

fn sign(value: i8) -> Sign {
    Sign::of(&value, &0)
}

fn tuples(seed: u64, n: usize, mut judge: impl FnMut(&str, [Point2; 4])) {
    for (name, family) in FAMILIES {
        let mut random = Random::new(seed);
        for _ in 0..share(n) {
            let points = family(&mut random);
            // The perturbation raises points, not places: the in-circle test is for distinct ones.
            if (0..4).all(|i| (0..i).all(|j| points[i] != points[j])) {
                judge(name, points);
            }
        }
    }
}

#[test]
fn orient2d_is_exact() {
    tuples(1, 150_000, |name, [a, b, c, _]| {
        assert_eq!(orient2d(a, b, c), sign(exact::orient2d(a, b, c)), "{name}: {a:?} {b:?} {c:?}");
    });
}

#[test]
fn in_circle_is_exact_and_canonical() {
    tuples(2, 60_000, |name, [a, b, c, d]| {
        assert_eq!(
            in_circle(a, b, c, d),
            sign(exact::in_circle(a, b, c, d)),
            "{name}: {a:?} {b:?} {c:?} {d:?}"
        );
    });
}

#[test]
fn in_circle_with_ties_is_exact() {
    tuples(8, 20_000, |name, [a, b, c, d]| {
        let expected = sign(exact::in_circle_unperturbed(a, b, c, d));
        assert_eq!(in_circle_with_ties(a, b, c, d), expected, "{name}: {a:?} {b:?} {c:?} {d:?}");
    });
}

#[test]
fn in_circle_ties_are_decided_for_distinct_points() {
    tuples(3, 20_000, |name, points| {
        let [a, b, c, d] = points;
        if !orient2d(a, b, c).is_zero() {
            assert_ne!(in_circle(a, b, c, d), Sign::Zero, "{name}: {points:?}");
        }
    });
}

/// The static filters may never say more than is true, whatever box or grid they are given.
#[test]
fn pencils_with_static_filters_are_exact() {
    let (mut told, mut chosen) = (0, 0);
    tuples(4, 60_000, |name, [l, r, p, q]| {
        let points = [l, r, p, q];
        let extent = |k: usize| {
            let low = points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
            let high = points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
            (high - low) * (1.0 + f64::EPSILON)
        };
        let filter = Filter::for_box(extent(0), extent(1), Grid::of(points.as_flattened()));
        assert_eq!(filter.orient2d(l, r, p), sign(exact::orient2d(l, r, p)), "{name}: {points:?}");
        assert_eq!(filter.in_circle(l, r, p, q), sign(exact::in_circle(l, r, p, q)), "{name}: {points:?}");
        let pencil = Pencil::new(l, r);
        let (mp, mq) = (pencil.member(p), pencil.member(q));
        assert_eq!(pencil.side(&mp, &filter), sign(exact::orient2d(l, r, p)), "{name}: {points:?}");
        assert_eq!(
            pencil.in_circle(&mp, &mq, &filter),
            sign(exact::in_circle(l, r, p, q)),
            "{name}: {points:?}"
        );
        // Of two points above the base the one inside of the other's circle, whatever is below.
        let turns = [p, q].map(|m| exact::orient2d(l, r, m) > 0);
        let is_p = turns[0] && !(turns[1] && exact::in_circle(l, r, p, q) > 0);
        if let Some((k, above)) = pencil.apex([p, q].into_iter(), &filter) {
            chosen += 1;
            assert!(turns[k] && is_p == (k == 0), "{name}: {points:?}");
            assert_eq!(above, turns.into_iter().map(usize::from).sum(), "{name}: {points:?}");
        }
        if let Some(Four { turns, circle }) = Four::of(l, r, p, q, &filter) {
            told += 1;
            for (bit, [a, b, c]) in [[l, r, p], [l, r, q], [l, p, q], [r, p, q]].into_iter().enumerate() {
                let expected = if turns >> bit & 1 == 1 { Sign::Positive } else { Sign::Negative };
                assert_eq!(expected, sign(exact::orient2d(a, b, c)), "{name}: {points:?}");
            }
            let expected = if circle { Sign::Positive } else { Sign::Negative };
            assert_eq!(expected, sign(exact::in_circle(l, r, p, q)), "{name}: {points:?}");
        }
    });
    assert!(told > share(60_000), "only {told} fours were told");
    assert!(chosen > share(60_000), "only {chosen} apexes were told");
}

#[test]
fn what_is_asked_about_a_hub_is_exact() {
    tuples(10, 60_000, |name, [a, b, c, center]| {
        let fixed = FixedPoint::new(center);
        let [at_a, at_b, at_c] = [a, b, c].map(|p| fixed.corner(p));
        let crosses @ [bc, ca, ab] = [at_b.cross(&at_c), at_c.cross(&at_a), at_a.cross(&at_b)];
        for (p, q, side) in [
            (a, b, fixed.side(&at_a, &at_b, ab)),
            (c, a, fixed.side(&at_c, &at_a, ca)),
            (c, b, fixed.side(&at_c, &at_b, -bc)),
        ] {
            assert_eq!(side, sign(exact::orient2d(p, q, center)), "{name}: {p:?} {q:?} {center:?}");
        }
        let expected = sign(exact::in_circle(a, b, c, center));
        assert_eq!(
            fixed.in_circle([&at_a, &at_b, &at_c], crosses),
            expected,
            "{name}: {a:?} {b:?} {c:?} {center:?}"
        );
        let turned = fixed.in_circle([&at_b, &at_a, &at_c], [-ca, -bc, -ab]);
        assert_eq!(turned, -expected, "{name}: {a:?} {b:?} {c:?} {center:?}");
    });
}

#[test]
fn swapping_two_points_flips_the_sign() {
    tuples(5, 60_000, |name, [a, b, c, d]| {
        let (turn, circle) = (orient2d(a, b, c), in_circle(a, b, c, d));
        assert_eq!(orient2d(b, a, c), -turn, "{name}");
        assert_eq!(orient2d(b, c, a), turn, "{name}");
        assert_eq!(orient2d(c, a, b), turn, "{name}");
        for swapped in
            [in_circle(b, a, c, d), in_circle(a, c, b, d), in_circle(a, b, d, c), in_circle(d, b, c, a)]
        {
            assert_eq!(swapped, -circle, "{name}: {a:?} {b:?} {c:?} {d:?}");
        }
        assert_eq!(in_circle(b, c, a, d), circle, "{name}");
    });
}

#[test]
fn lexicographic_order_is_total() {
    tuples(6, 20_000, |name, points| {
        for p in points {
            for q in points {
                assert_eq!(lexicographic(p, q), lexicographic(q, p).reverse(), "{name}");
                assert_eq!(lexicographic(p, q).is_eq(), p == q, "{name}");
            }
        }
    });
}

#[test]
fn orientation_of_equal_points_is_zero() {
    let mut random = Random::new(7);
    for _ in 0..10_000 {
        let (a, b) = ([any_bits(&mut random), any_bits(&mut random)], [any_bits(&mut random), 1.0]);
        for turn in [orient2d(a, a, b), orient2d(a, b, a), orient2d(b, a, a), orient2d(a, a, a)] {
            assert_eq!(turn, Sign::Zero);
        }
    }
}

#[test]
fn distances_and_angles_are_exact() {
    let mut equal = 0;
    tuples(9, 60_000, |name, [q, a, b, d]| {
        let expected = sign(exact::compare_distances(q, a, b)) as i8;
        assert_eq!(compare_distances(q, a, b) as i8, expected, "{name}: {q:?} {a:?} {b:?}");
        equal += usize::from(expected == 0);
        let squared = |p: Point2| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2);
        assert!(
            !is_surely_further(squared(a), squared(b)) || expected > 0,
            "{name}: {q:?} {a:?} {b:?} are told wrongly"
        );
        // A radius that is nearly the distance: the rounded distance itself.
        for radius in [d[0], (a[0] - q[0]).hypot(a[1] - q[1])] {
            let expected = if radius < 0.0 || !radius.is_finite() {
                continue;
            } else {
                exact::compare_with_radius(q, a, radius)
            };
            assert_eq!(compare_with_radius(q, a, radius) as i8, expected, "{name}: {q:?} {a:?} {radius:?}");
        }
        assert_eq!(angle(q, a, b), sign(exact::angle(q, a, b)), "{name}: {q:?} {a:?} {b:?}");
    });
    assert!(equal > share(1000), "only {equal} ties were met");
}

#[test]
fn sides_of_circumcenters_are_exact() {
    let mut zero = 0;
    tuples(10, 60_000, |name, [o, a, b, p]| {
        let (a, b) = if exact::orient2d(o, a, b) < 0 { (b, a) } else { (a, b) };
        let expected = exact::center_side(o, a, b, p);
        assert_eq!(center_side(o, a, b, p), sign(expected), "{name}: {o:?} {a:?} {b:?} {p:?}");
        let expected_direction = exact::center_direction(o, a, b).map(sign);
        assert_eq!(center_direction(o, a, b), expected_direction, "{name}: {o:?} {a:?} {b:?}");
        zero += usize::from(expected == 0);
    });
    assert!(zero > share(1000), "only {zero} ties were met");
}

#[test]
fn a_lost_product_decides_no_side() {
    let (o, a, b) = ([0.0, 0.0], [1e18, -1e18 - 1e14], [1e9 + 0.3, -(1e9 + 0.4)]);
    let p = [5e-324, 5e-324];
    assert_eq!(center_side(o, a, b, p), sign(exact::center_side(o, a, b, p)));
}

#[test]
fn orient3d_is_exact() {
    let (mut zero, mut told) = (0, 0);
    // Heights that are nearly, or exactly, on one plane over each family of the plane.
    tuples(11, 40_000, |name, points| {
        let slope = points[3][0];
        for (i, heights) in [
            points.map(|[x, y]| x + y),
            points.map(|[x, y]| y - 2.0 * x),
            points.map(|[x, _]| x * slope),
            [points[0][0], points[1][1], points[2][0], points[3][1]],
            [0.0, 0.0, 0.0, points[0][1]],
        ]
        .into_iter()
        .enumerate()
        {
            if heights.iter().any(|z| !z.is_finite()) {
                continue;
            }
            let at = |k: usize| [points[k][0], points[k][1], heights[k]];
            let [a, b, c, d] = [0, 1, 2, 3].map(at);
            let expected = exact::orient3d(a, b, c, d);
            assert_eq!(orient3d(a, b, c, d), sign(expected), "{name} {i}: {a:?} {b:?} {c:?} {d:?}");
            assert_eq!(orient3d(b, a, c, d), -sign(expected), "{name} {i}: swapped");
            assert_eq!(orient3d(b, c, d, a), -sign(expected), "{name} {i}: turned");
            zero += usize::from(expected == 0);
            let extent = [0, 1, 2].map(|k| {
                let of = [a, b, c, d].map(|p| p[k]);
                of.iter().fold(f64::MIN, |m, x| m.max(*x)) - of.iter().fold(f64::MAX, |m, x| m.min(*x))
            });
            let plane = Plane::new(a, b, c, extent);
            if let Some(side) = plane.side(d) {
                assert_eq!(side, sign(expected), "{name} {i}: plane");
                told += 1;
            }
        }
    });
    assert!(told > share(100_000), "planes told only {told} sides");
    assert!(zero > share(10_000), "only {zero} coplanar tuples were met");
}

/// Families of five points in space, made of those in the plane.
fn tuples_in_space(seed: u64, n: usize, mut judge: impl FnMut(&str, [Point3; 5])) {
    tuples(seed, n, |name, points| {
        let [p, q, r, s] = points;
        let five = |z: [f64; 5], last: Point2| {
            let at = |i: usize| if i < 4 { points[i] } else { last };
            [0, 1, 2, 3, 4].map(|i| [at(i)[0], at(i)[1], z[i]])
        };
        // On a sphere with the plane's circles as parallels, on a prism, on planes, and anyhow.
        let up = s[1] - s[0];
        let families = [
            ("prism", five([p[0], p[0], p[0], p[0] + up, p[0] + up], p)),
            ("pyramid", five([0.0, 0.0, 0.0, 0.0, up], r)),
            ("slanted", five([p[0] + p[1], q[0] + q[1], r[0] + r[1], s[0] + s[1], s[0]], q)),
            ("anyhow", five([p[1], s[0], q[1], r[0], r[1]], [s[1], p[0]])),
            (
                "lattice",
                [
                    [p[0], p[0], p[0]],
                    [p[0], q[0], p[0]],
                    [q[0], p[0], p[0]],
                    [q[0], q[0], q[0]],
                    [p[0], p[0], q[0]],
                ],
            ),
        ];
        for (kind, five) in families {
            let finite = five.as_flattened().iter().all(|x| x.is_finite());
            if finite && (0..5).all(|i| (0..i).all(|j| five[i] != five[j])) {
                judge(&format!("{name}, {kind}"), five);
            }
        }
    });
}

#[test]
fn in_sphere_is_exact() {
    let (mut ties, mut told, mut total) = (0, 0, 0);
    tuples_in_space(12, 5_000, |name, five| {
        let [a, b, c, d, e] = five;
        let expected = exact::in_sphere_unperturbed(a, b, c, d, e);
        assert_eq!(in_sphere_with_ties(a, b, c, d, e), sign(expected), "{name}: {five:?}");
        let perturbed = exact::in_sphere(a, b, c, d, e);
        assert_eq!(in_sphere(a, b, c, d, e), sign(perturbed), "{name}: {five:?}, perturbed");
        total += 1;
        ties += usize::from(expected == 0 && perturbed != 0);
        // The static filter of any box around them.
        let extent = [0, 1, 2].map(|k| {
            let of = five.map(|p| p[k]);
            of.iter().fold(f64::MIN, |m, x| m.max(*x)) - of.iter().fold(f64::MAX, |m, x| m.min(*x))
        });
        let grid = Grid::of(five.as_flattened());
        for (extent, grid) in [(extent, None), (extent, grid), (extent.map(|side| side * 1e6), None)] {
            let filter = Filter3::for_box(extent, grid);
            assert_eq!(filter.in_sphere(a, b, c, d, e), sign(perturbed), "{name}: {five:?}, in a box");
            assert_eq!(filter.orient3d(a, b, c, d), orient3d(a, b, c, d), "{name}: {five:?}, in a box");
            let both = filter.in_spheres([[&a, &b, &c, &d], [&b, &a, &c, &d]], &e);
            assert_eq!(both, [sign(perturbed), -sign(perturbed)], "{name}: {five:?}, two at once");
            let bundle = SpherePencil::new([a, b, c].map(|p| (p, 0.0)));
            let turn = bundle.side((d, 0.0), &filter);
            assert!(
                turn.is_none_or(|turn| turn == orient3d(a, b, c, d)),
                "{name}: {five:?}, a bundle's side"
            );
            if let Some(side) = bundle.through((d, 0.0)).side((e, 0.0), &filter) {
                told += 1;
                assert_eq!(side, sign(perturbed), "{name}: {five:?}, of a bundle");
            }
            let [a, b] = if orient3d(a, b, c, d).is_positive() { [a, b] } else { [b, a] };
            let is_beyond = [[b, d, c], [a, c, d], [a, d, b], [a, b, c]]
                .map(|[u, v, w]| orient3d(u, v, w, e).is_negative());
            match filter.facet_towards([&a, &b, &c, &d], &e) {
                Some(k) => assert!(is_beyond[k], "{name}: {five:?}, facet {k}"),
                None => assert_eq!(is_beyond, [false; 4], "{name}: {five:?}, no facet"),
            }
        }
        for swapped in [in_sphere(b, a, c, d, e), in_sphere(a, c, b, d, e), in_sphere(a, b, d, c, e)] {
            assert_eq!(swapped, -sign(perturbed), "{name}: {five:?}, swapped");
        }
        let turned = [in_sphere(e, b, c, d, a), in_sphere(a, b, c, e, d)];
        assert!(turned.iter().all(|&s| s == -sign(perturbed)), "{name}: {five:?}, turned");
    });
    assert!(total > share(150_000), "only {total} tuples");
    assert!(ties > share(5_000), "only {ties} ties");
    assert!(told > share(50_000), "only {told} spheres of bundles told a side");
}

#[test]
fn lexicographic_order_in_space_is_total() {
    tuples_in_space(13, 2_000, |name, five| {
        for p in five {
            for q in five {
                assert_eq!(lexicographic3(p, q), p.partial_cmp(&q).expect("finite"), "{name}");
            }
        }
    });
}

#[test]
fn distances_in_space_are_exact() {
    let mut equal = 0;
    tuples_in_space(14, 5_000, |name, [q, a, b, d, _]| {
        let expected = exact::compare_distances3(q, a, b);
        assert_eq!(compare_distances3(q, a, b) as i8, expected, "{name}: {q:?} {a:?} {b:?}");
        equal += usize::from(expected == 0);
        for radius in [d[0], (0..3).map(|k| (a[k] - q[k]).powi(2)).sum::<f64>().sqrt()] {
            if radius >= 0.0 && radius.is_finite() {
                let expected = exact::compare_with_radius3(q, a, radius);
                assert_eq!(
                    compare_with_radius3(q, a, radius) as i8,
                    expected,
                    "{name}: {q:?} {a:?} {radius:?}"
                );
            }
        }
    });
    assert!(equal > share(1000), "only {equal} ties were met");
}
