//! Tests of the share that each stage decides by itself. An answer that is right but late is seen by no comparison with the exact one: a
//! filter that never tells, or integers that never fit, only cost time. Here the stages are asked one by one.

use std::cmp::Ordering;

use delone_generators::Random;
use delone_oracle::exact as oracle;

use crate::filter::{
    Grid, in_circle_filter, in_circle_of_lengths, in_circle_scaled, in_sphere_filter, in_sphere_scaled,
    orient2d_filter, orient2d_of_lengths, orient2d_scaled, orient3d_filter, orient3d_scaled,
};
use crate::{Filter, Filter3, Plane, Point2, Point3, Sign, center, distance};

/// Four points in general position, and one inside of their circles and spheres.
const PLANE: [Point2; 4] = [[0.1, 0.2], [3.3, 0.7], [1.6, 2.9], [1.3, 1.1]];
const SPACE: [Point3; 5] =
    [[0.1, 0.2, 0.3], [3.3, 0.7, 0.4], [1.6, 2.9, 0.8], [1.2, 1.4, 3.1], [1.5, 1.3, 1.1]];

/// Sizes at which no product leaves the range of any filter.
const SIZES: [f64; 5] = [1.0, 1e-3, 1e3, 1e-20, 1e20];

fn plane(size: f64) -> [Point2; 4] {
    PLANE.map(|p| p.map(|x| x * size))
}

fn space(size: f64) -> [Point3; 5] {
    SPACE.map(|p| p.map(|x| x * size))
}

#[test]
fn filters_tell_what_is_plain() {
    for size in SIZES {
        let [a, b, c, d] = plane(size);
        assert_eq!(orient2d_filter(a, b, c), Some(Sign::Positive), "{size}");
        assert_eq!(in_circle_filter(a, b, c, d), Some(Sign::Positive), "{size}");
        assert_eq!(in_circle_filter(a, c, b, d), Some(Sign::Negative), "{size}");
        let rows = [a, b, c].map(|p| [p[0] - d[0], p[1] - d[1]]);
        let squares = rows.map(|[x, y]| x * x + y * y);
        let cross = |i: usize, j: usize| rows[i][0] * rows[j][1] - rows[j][0] * rows[i][1];
        let crosses = [cross(1, 2), cross(2, 0), cross(0, 1)];
        assert_eq!(in_circle_of_lengths(squares, crosses), Some(Sign::Positive), "{size}");
        assert_eq!(in_circle_of_lengths(squares, crosses.map(|x| -x)), Some(Sign::Negative), "{size}");
        assert_eq!(orient2d_of_lengths(crosses[2], squares[0] + squares[1]), Some(Sign::Positive), "{size}");
        let [a, b, c, d, e] = space(size);
        assert_eq!(orient3d_filter(a, b, c, d), Some(Sign::Positive), "{size}");
        assert_eq!(in_sphere_filter(a, b, c, d, e), Some(Sign::Positive), "{size}");
        assert_eq!(in_sphere_filter(b, a, c, d, e), Some(Sign::Negative), "{size}");
    }
}

#[test]
fn filters_of_a_box_tell_what_is_plain() {
    for size in SIZES {
        let filter = Filter::for_box(3.2 * size, 2.7 * size, None);
        let area = size * size;
        assert_eq!(filter.orient(1e-14 * area), Some(Sign::Positive), "{size}");
        assert_eq!(filter.orient(-1e-14 * area), Some(Sign::Negative), "{size}");
        assert_eq!(filter.circle(1e-12 * area * area), Some(Sign::Positive), "{size}");
        assert_eq!(filter.circle(-1e-12 * area * area), Some(Sign::Negative), "{size}");
        assert_eq!((filter.orient(0.0), filter.circle(0.0)), (None, None));
    }
    // On a grid of any step, whatever the shape of the box, zero is told as well.
    for step in [0.125, 1.0, 1024.0] {
        let grid = Grid::of(&[step]);
        for (w, h) in [(4000.0, 4000.0), (1.0, 100_000.0), (100_000.0, 1.0)] {
            let filter = Filter::for_box(w * step, h * step, grid);
            assert_eq!((filter.orient(0.0), filter.circle(0.0)), (Some(Sign::Zero), Some(Sign::Zero)));
        }
        for (w, h) in [(7000.0, 7000.0), (6000.0, 6000.0), (2.0, 200_000.0), (200_000.0, 2.0)] {
            assert_eq!(Filter::for_box(w * step, h * step, grid).circle(0.0), None, "{step} {w} {h}");
        }
    }
    // The finest step with which a square box is exact: 4 side^4 = 4e15 steps^4.
    let step = Filter::finest_step(3.0, 3.0) / 3.0;
    assert!((step.powi(4) * 1e15 - 1.0).abs() < 1e-12, "{step}");
    let step = Filter::finest_step(1.0, 7.0);
    assert!((step.powi(4) * 4e15 / 700.0 - 1.0).abs() < 1e-12, "{step}");
}

#[test]
fn filters_of_a_box_in_space_leave_little_to_the_exact_stage() {
    // One step of the last place off a plane or a sphere is not told, a millionth is; two boxes that differ by a factor
    // differ by its power.
    let [one, two] =
        [1.0, 2.0].map(|size| format!("{:?}", Filter3::for_box([3.2 * size, 2.7 * size, 2.8 * size], None)));
    let numbers = |text: &str| -> Vec<f64> {
        text.split([' ', ',', '}']).filter_map(|word| word.parse().ok()).collect()
    };
    let (one, two) = (numbers(&one), numbers(&two));
    assert!((two[0] / one[0] - 8.0).abs() < 1e-9 && (two[1] / one[1] - 32.0).abs() < 1e-9);
    assert!(one[0] < 2e-13 && one[1] < 3e-11, "{one:?}");
}

#[test]
fn distances_and_centers_are_told_by_floating_point() {
    use Sign::{Negative, Positive};
    for size in [1.0, 1e-6, 1e6, 1e-100, 1e100] {
        assert_eq!(distance::told(1e-14 * size, size), Some(Positive), "{size}");
        assert_eq!(distance::told(-1e-14 * size, size), Some(Negative), "{size}");
        assert_eq!(distance::told(distance::ERROR * size, size), None, "{size}");
        assert_eq!(distance::told(-1e-16 * size, size), None, "{size}");
        let [u, v] = [[3.0 * size.cbrt(), 0.0], [1.0 * size.cbrt(), 2.0 * size.cbrt()]];
        // The center is (1.5, 0.5).
        for (w, expected) in [([0.0, 1.0], Positive), ([1.0, 0.0], Negative), ([2.9, 1.0], Positive)] {
            assert_eq!(center::side(u, v, w), Some(expected), "{size} {w:?}");
        }
        assert_eq!(center::side(u, v, [3.0, 1.0]), None, "{size}");
    }
    assert_eq!(distance::compared(1.0, 2.0), Some(Ordering::Less));
    assert_eq!(distance::compared(2.0, 1.0), Some(Ordering::Greater));
    assert_eq!(distance::compared(1.0, 1.0), None);
    assert_eq!(distance::told(1e-291, 1e-291), None);
    assert_eq!(distance::told(1e-290, 1e-290), Some(Positive));
    assert_eq!(distance::told(f64::INFINITY, f64::INFINITY), None);
    // Too small, or a product beside huge lengths that may have lost what counts.
    assert_eq!(center::side([3e-141, 0.0], [1e-141, 2e-141], [0.0, 1.0]), None);
    assert_eq!(center::side([1e150, 0.0], [0.0, 1.0], [0.0, 5e-324]), None);
    assert_eq!(center::side([1.0, 0.0], [0.0, 1e150], [5e-324, 0.0]), None);
    assert_eq!(center::side([1e150, 0.0], [0.0, 1e-100], [0.0, 1e-202]), None);
    assert_eq!(center::side([1e150, 0.0], [0.0, 1.0], [0.0, 1e-290]), Some(Positive));
}

/// Distances that are equal but for their rounding are compared exactly.
#[test]
fn distances_that_are_nearly_equal_are_left_to_the_exact_stage() {
    for size in [1.0, 2f64.powi(-40), 2f64.powi(40)] {
        let close = |sum: f64| 4.0 * f64::EPSILON * sum / 8.0;
        assert_eq!(distance::told(close(size), size), None);
        // (3, 4) and (5, 0), moved where differences round: the answer is that of big integers.
        let q = [0.1 * size, 0.7 * size];
        for k in 1..3000 {
            let t = f64::from(k) / 7.0;
            let [a, b] = [[q[0] + 3.0 * t * size, q[1] + 4.0 * t * size], [q[0] - 5.0 * t * size, q[1]]];
            let expected = oracle::compare_distances(q, a, b);
            assert_eq!(crate::compare_distances(q, a, b), expected.cmp(&0), "{size} {t}");
            let (q, a, b) = ([q[0], q[1], q[0]], [a[0], a[1], q[0]], [b[0], b[1], q[0]]);
            assert_eq!(crate::compare_distances3(q, a, b), expected.cmp(&0), "{size} {t}");
            let w = [[a[0], a[1]], [q[0] - 0.3 * (a[1] - q[1]), q[1] + 0.3 * (a[0] - q[0])]];
            let right = oracle::angle([q[0], q[1]], w[0], w[1]);
            assert_eq!(crate::angle([q[0], q[1]], w[0], w[1]), Sign::of(&right, &0), "{size} {t}");
        }
    }
}

#[test]
fn a_negative_radius_is_smaller_than_every_distance_and_zero_is_not() {
    let (q, a) = ([1.0, 2.0], [3.0, 4.0]);
    let (q3, a3) = ([1.0, 2.0, 3.0], [3.0, 4.0, 5.0]);
    for radius in [-5.0, -1e-300] {
        assert_eq!(crate::compare_with_radius(q, a, radius), Ordering::Greater);
        assert_eq!(crate::compare_with_radius(q, q, radius), Ordering::Greater);
        assert_eq!(crate::compare_with_radius3(q3, a3, radius), Ordering::Greater);
        assert_eq!(crate::compare_with_radius3(q3, q3, radius), Ordering::Greater);
    }
    assert_eq!(crate::compare_with_radius(q, q, 0.0), Ordering::Equal);
    assert_eq!(crate::compare_with_radius3(q3, q3, 0.0), Ordering::Equal);
}

#[test]
fn scaled_filters_tell_what_spans_the_range() {
    for size in [1e-160, 1e-100, 1e100, 1e150, 1.0] {
        let [a, b, c, d] = plane(size);
        assert_eq!(orient2d_scaled(a, b, c), Some(Sign::Positive), "{size}");
        assert_eq!(orient2d_scaled(b, a, c), Some(Sign::Negative), "{size}");
        assert_eq!(in_circle_scaled(a, b, c, d), Some(Sign::Positive), "{size}");
        assert_eq!(in_circle_scaled(b, a, c, d), Some(Sign::Negative), "{size}");
        let [a, b, c, d, e] = space(size);
        assert_eq!(orient3d_scaled(a, b, c, d), Some(Sign::Positive), "{size}");
        assert_eq!(orient3d_scaled(b, a, c, d), Some(Sign::Negative), "{size}");
        assert_eq!(in_sphere_scaled(a, b, c, d, e), Some(Sign::Positive), "{size}");
        assert_eq!(in_sphere_scaled(b, a, c, d, e), Some(Sign::Negative), "{size}");
        // Equal points have no row.
        assert_eq!(
            orient2d_scaled(a.first_chunk().copied().expect("two of three"), [0.0; 2], [0.0; 2]),
            None
        );
    }
    // Two near points and far ones, each at its own scale.
    assert_eq!(orient2d_scaled([0.0, 0.0], [1e-200, 0.0], [1e150, 1e150]), Some(Sign::Positive));
    assert_eq!(
        in_circle_scaled([0.0, 0.0], [1e-200, 0.0], [0.0, 1e-100], [1e150, 1e150]),
        Some(Sign::Negative)
    );
    // Subnormal numbers, and differences that no number holds.
    let [o, p, q] = [[0.0, 0.0], [8.0, 0.0], [3.0, 8.0]].map(|p| p.map(|x| x * f64::from_bits(1)));
    assert_eq!(orient2d_scaled(o, p, q), Some(Sign::Positive));
    let m = f64::MAX;
    assert_eq!(orient2d_scaled([m, m], [-m, m], [m, -m]), None);
    // Nearly on one line, which rounding could turn over.
    let tiny = |x: f64| x * 2f64.powi(-700);
    assert_eq!(orient2d_scaled([tiny(0.1), tiny(0.1)], [tiny(0.7), tiny(0.7)], [tiny(0.3), tiny(0.3)]), None);
}

/// Nearly on one line, circle, plane and sphere, at a scale where only these filters are asked: they may say nothing, but
/// nothing wrong.
#[test]
fn scaled_filters_never_say_more_than_is_true() {
    let mut random = Random::new(21);
    let mut told = [0; 4];
    for round in 0..4000 {
        let scale = 2f64.powi([-700, 600, -300][round % 3]);
        let mut near =
            |x: f64| f64::from_bits(x.to_bits().wrapping_add(random.below(1 << (round % 8)) as u64)) * scale;
        let t = |k: i32| f64::from(k * 37 + round as i32 % 101) / 17.0;
        let line = [t(1), t(3), t(-2)].map(|x| [near(x), near(x * [0.33, 0.97, 1.9][round % 5 % 3])]);
        let circle = [1, 3, 4, 6].map(|k| t(k).sin_cos()).map(|(s, c)| [near(2.0 * s), near(2.0 * c)]);
        let plane =
            [1, 3, 4, 6].map(|k| (t(k).sin(), t(k).cos())).map(|(s, c)| [near(s), near(c), near(s + c)]);
        let sphere = [1, 2, 4, 5, 7].map(|k| {
            let ((s, c), (up, out)) = (t(k).sin_cos(), t(k * k).sin_cos());
            [near(out * s), near(out * c), near(up)]
        });
        let [a, b, c] = line;
        let answers = [
            (orient2d_scaled(a, b, c), oracle::orient2d(a, b, c)),
            {
                let [a, b, c, d] = circle;
                (in_circle_scaled(a, b, c, d), oracle::in_circle_unperturbed(a, b, c, d))
            },
            {
                let [a, b, c, d] = plane;
                (orient3d_scaled(a, b, c, d), oracle::orient3d(a, b, c, d))
            },
            {
                let [a, b, c, d, e] = sphere;
                (in_sphere_scaled(a, b, c, d, e), oracle::in_sphere_unperturbed(a, b, c, d, e))
            },
        ];
        for (k, (answer, expected)) in answers.into_iter().enumerate() {
            if let Some(sign) = answer {
                assert_eq!(sign, Sign::of(&expected, &0), "{k}, round {round}");
                told[k] += 1;
            }
        }
    }
    assert!(told.iter().all(|&n| n > 40 && n < 3990), "{told:?}");
}

#[test]
fn planes_tell_what_is_not_near() {
    for size in SIZES {
        let [a, b, c, d, _] = space(size);
        let plane = Plane::new(a, b, c, [3.2 * size, 2.7 * size, 2.8 * size]);
        assert_eq!(plane.side(d), Some(Sign::Positive), "{size}");
        let above = [0, 1, 2].map(|k| c[k] + if k == 2 { 1e-12 * size } else { 0.0 });
        assert_eq!(plane.side(above), Some(Sign::Positive), "{size}");
    }
}

#[test]
fn bounds_are_those_of_their_derivations() {
    let u = 2f64.powi(-53);
    assert_eq!(distance::ERROR, 8.0 * u);
    assert_eq!((center::ERROR, center::LOST), (20.0 * u, 2f64.powi(-1000)));
    assert_eq!(crate::plane::BOUND, 10.0 * u);
    assert_eq!((crate::clear::UNIT, crate::clear::FLAT), (u, 2f64.powi(-30)));
}

#[test]
fn signs_and_orders_of_few_points() {
    for sign in [Sign::Negative, Sign::Zero, Sign::Positive] {
        assert_eq!(sign.is_negative(), sign as i8 == -1);
        assert_eq!(sign.is_zero(), sign as i8 == 0);
        assert_eq!(sign.is_positive(), sign as i8 == 1);
    }
    let [low, middle, high] = [[1.0, 2.0], [1.0, 3.0], [2.0, 0.0]];
    for (a, b) in [(low, high), (high, low)] {
        assert!(crate::strictly_between(a, b, middle));
        assert!(!crate::strictly_between(a, b, a) && !crate::strictly_between(a, b, b));
        assert!(!crate::strictly_between(a, middle, b) && !crate::strictly_between(middle, b, a));
    }
}

#[test]
fn points_are_collinear_only_if_they_are_along_every_axis() {
    let origin = [0.0; 3];
    for axis in 0..3 {
        let unit = |k: usize, x: f64| std::array::from_fn::<f64, 3, _>(|i| if i == k { x } else { 0.0 });
        assert!(crate::are_collinear3(origin, unit(axis, 1.0), unit(axis, 5.0)));
        assert!(!crate::are_collinear3(origin, unit(axis, 1.0), unit((axis + 1) % 3, 1.0)));
    }
    assert!(!crate::are_collinear3(origin, [1.0, 2.0, 4.0], [2.0, 4.0, 9.0]));
    assert!(crate::are_collinear3(origin, [1.0, 2.0, 4.0], [2.0, 4.0, 8.0]));
}

/// Of two spheres at once one is told by floating point, and the other is not.
#[test]
fn of_two_spheres_each_is_told_by_itself() {
    let (filter, origin) = (Filter3::for_box([8.0; 3], None), [0.0; 3]);
    let tie = [[1.0, 1.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let plain = [[5.0, 5.0, 5.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]];
    let orders = |[a, b, c, d]: [Point3; 4]| [[a, b, c, d], [b, a, c, d]];
    for tie in orders(tie) {
        for plain in orders(plain) {
            let sign = |[a, b, c, d]: [Point3; 4]| crate::in_sphere(a, b, c, d, origin);
            let both = filter.in_spheres([tie.each_ref(), plain.each_ref()], &origin);
            assert_eq!(both, [sign(tie), sign(plain)]);
            let both = filter.in_spheres([plain.each_ref(), tie.each_ref()], &origin);
            assert_eq!(both, [sign(plain), sign(tie)]);
        }
    }
}
