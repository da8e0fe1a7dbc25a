//! Every tuple of numbers where guards have their edges, against integers of unlimited size: the least and the largest
//! numbers, the roots and the fourth and fifth roots of these, and neighbors of one. A guard against underflow or overflow that is
//! off by a binade, or looks at the wrong product, lets some tuple of these through.

use delone_oracle::{exact, is_due};
use delone_predicates::{
    Point2, Sign, angle, center_direction, center_side, compare_distances, compare_distances3,
    compare_with_radius, compare_with_radius3, in_circle_with_ties, in_sphere_with_ties, orient2d, orient3d,
};

fn sign(x: i8) -> Sign {
    match x {
        0 => Sign::Zero,
        1.. => Sign::Positive,
        _ => Sign::Negative,
    }
}

/// 2^e, also where that is subnormal.
fn power(e: i32) -> f64 {
    2f64.powi(e / 2) * 2f64.powi(e - e / 2)
}

/// Zero, and both signs of some multiples of some powers of two.
fn numbers(exponents: &[i32], multiples: &[f64]) -> Vec<f64> {
    let all = exponents.iter().flat_map(|&e| multiples.iter().map(move |m| m * power(e)));
    let mut all: Vec<f64> = all.flat_map(|x| [x, -x]).chain([0.0]).filter(|x| x.is_finite()).collect();
    all.sort_unstable_by(f64::total_cmp);
    all.dedup();
    all
}

/// Calls for every tuple of N numbers of a list; the first of a tuple is not negative, as signs only mirror.
fn tuples<const N: usize>(numbers: &[f64], mut call: impl FnMut([f64; N])) {
    let mut at = [0; N];
    let mut turns = 0;
    'all: loop {
        let tuple = at.map(|i| numbers[i]);
        // Of numbers of both signs and zero there is an odd count, so that every number gets its turn at every place.
        turns += 1;
        if tuple[0] >= 0.0 && is_due(turns) {
            call(tuple);
        }
        for place in &mut at {
            *place += 1;
            if *place < numbers.len() {
                continue 'all;
            }
            *place = 0;
        }
        return;
    }
}

const O: Point2 = [0.0, 0.0];
const NEAR_ONE: f64 = 1.0 + f64::EPSILON;

#[test]
fn orientations() {
    let numbers = numbers(&[-1074, -1022, -538, -537, -511, 0, 511, 512, 1022], &[1.0, NEAR_ONE]);
    tuples(&numbers, |[ax, ay, bx, by]| {
        let (a, b) = ([ax, ay], [bx, by]);
        assert_eq!(orient2d(a, b, O), sign(exact::orient2d(a, b, O)), "{a:?} {b:?}");
    });
}

#[test]
fn distances_and_angles() {
    let numbers = numbers(&[-1074, -1022, -538, -537, -511, -480, 0, 511, 512], &[1.0, NEAR_ONE]);
    tuples(&numbers, |[ax, ay, bx, by]| {
        let (a, b) = ([ax, ay], [bx, by]);
        let expected = exact::compare_distances(O, a, b);
        assert_eq!(compare_distances(O, a, b) as i8, expected, "{a:?} {b:?}");
        assert_eq!(angle(O, a, b), sign(exact::angle(O, a, b)), "{a:?} {b:?}");
        let expected = exact::compare_with_radius(a, b, ax.abs());
        assert_eq!(compare_with_radius(a, b, ax.abs()) as i8, expected, "{a:?} {b:?}");
    });
}

#[test]
fn sides_of_centers() {
    let numbers = numbers(&[-1074, -540, -462, -1, 100, 511], &[1.0]);
    tuples(&numbers, |[ax, ay, bx, by, px, py]| {
        let (a, b, p) = ([ax, ay], [bx, by], [px, py]);
        if exact::orient2d(O, a, b) <= 0 {
            return;
        }
        assert_eq!(center_side(O, a, b, p), sign(exact::center_side(O, a, b, p)), "{a:?} {b:?} {p:?}");
        let expected = exact::center_direction(O, a, b).map(sign);
        assert_eq!(center_direction(O, a, b), expected, "{a:?} {b:?}");
    });
}

#[test]
fn circles() {
    for exponents in
        [[-1074, -282, -281, -140], [-269, -1, 0, 124], [-1022, 0, 249, 250], [0, 300, 510, 1022]]
    {
        let numbers = numbers(&exponents, &[1.0]);
        tuples(&numbers, |[ax, ay, bx, by, cx, cy]| {
            let (a, b, c) = ([ax, ay], [bx, by], [cx, cy]);
            let expected = sign(exact::in_circle_unperturbed(a, b, c, O));
            assert_eq!(in_circle_with_ties(a, b, c, O), expected, "{a:?} {b:?} {c:?}");
        });
    }
}

#[test]
fn orientations_and_distances_in_space() {
    for (least, most) in [(-1074, 0), (-359, -358), (-190, 190), (0, 499), (340, 342), (-1074, 1022)] {
        let numbers = [0.0, power(least), -power(least), power(most), -power(most)];
        tuples(&numbers, |[ax, ay, az, bx, by, bz, cx, cy]| {
            // The last is told by the others, so that there are fewer.
            let (a, b, c) = ([ax, ay, az], [bx, by, bz], [cx, cy, ax]);
            let expected = sign(exact::orient3d(a, b, c, [0.0; 3]));
            assert_eq!(orient3d(a, b, c, [0.0; 3]), expected, "{a:?} {b:?} {c:?}");
            let expected = exact::compare_distances3(a, b, c);
            assert_eq!(compare_distances3(a, b, c) as i8, expected, "{a:?} {b:?} {c:?}");
            let expected = exact::compare_with_radius3(a, b, cx.abs());
            assert_eq!(compare_with_radius3(a, b, cx.abs()) as i8, expected, "{a:?} {b:?} {cx}");
        });
    }
}

#[test]
#[ignore = "long: .ci/run --long"]
fn spheres() {
    for (one, other) in [(-1074, 0), (-216, -215), (-152, 0), (0, 100), (99, 101), (-1074, 1022)] {
        let numbers = [0.0, power(one), -power(other)];
        tuples(&numbers, |[ax, ay, az, bx, by, bz, cx, cy, cz]| {
            let (a, b, c) = ([ax, ay, az], [bx, by, bz], [cx, cy, cz]);
            let d = [power(other), power(one), -power(one)];
            let expected = sign(exact::in_sphere_unperturbed(a, b, c, d, [0.0; 3]));
            assert_eq!(in_sphere_with_ties(a, b, c, d, [0.0; 3]), expected, "{a:?} {b:?} {c:?} {d:?}");
        });
    }
}
