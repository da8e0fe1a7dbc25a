//! Tests of the share of lines that floating point decides by itself.

use delone_generators::Random;

use super::rounded::{MEETING_BOUND, in_floating_point, meeting};
use super::*;

/// No coordinate is known before.
const NOT_KNOWN: [Option<f64>; 2] = [None; 2];

/// Where two lines meet by floating point alone, seen from a point of one of them.
fn meeting_filter(first: &Line, second: &Line) -> Option<Point2> {
    in_floating_point(first, second, second.point().or(first.point())?, NOT_KNOWN)
}

const P: Point2 = [1.0, 2.0];
const Q: Point2 = [4.0, 6.0];

/// A line of each kind, and a, b, c and the size of c from (2, 3).
const LINES: [(Line, [f64; 4]); 8] = [
    (Line::Through(P, Q), [-4.0, 3.0, -1.0, 7.0]),
    (Line::Through(Q, P), [4.0, -3.0, 1.0, 17.0]),
    (Line::Bisector(P, Q), [-6.0, -8.0, 11.0, 25.0]),
    (Line::Above(0, 5.0), [1.0, 0.0, -3.0, 3.0]),
    (Line::Below(0, 5.0), [-1.0, 0.0, 3.0, 3.0]),
    (Line::Above(1, 5.0), [0.0, 1.0, -2.0, 2.0]),
    (Line::Below(1, 5.0), [0.0, -1.0, 2.0, 2.0]),
    (Line::Above(7, 5.0), [0.0, 1.0, -2.0, 2.0]),
];

fn power(exponent: i32) -> f64 {
    2f64.powi(exponent)
}

#[test]
fn lines_are_taken_apart() {
    for (line, [a, b, c, size]) in LINES {
        let e = line.equation([2.0, 3.0]);
        assert_eq!([e.a, e.b, e.c, e.size], [a, b, c, size], "{line:?}");
        assert_eq!(line.signs(), [a, b].map(|x| Sign::of(&x, &0.0)), "{line:?}");
        let axis = [a, b].iter().position(|&x| x == 0.0).map(|zero| 1 - zero);
        assert_eq!(line.axis(), axis, "{line:?}");
        assert_eq!([0, 1].map(|k| line.at(k)), [0, 1].map(|k| (axis == Some(k)).then_some(5.0)), "{line:?}");
        assert_eq!(line.point().is_none(), axis.is_some(), "{line:?}");
        for p in [[0.0, 0.0], [9.0, 0.0], [0.0, 9.0], [9.0, 9.0], [5.0, 5.0]] {
            let side = Sign::of(&(a * (p[0] - 2.0) + b * (p[1] - 3.0) + c), &0.0);
            assert_eq!(line.side(&Spot::Point(p)), side, "{line:?} {p:?}");
        }
    }
    assert_eq!(Line::Bisector(P, Q).point(), Some(P));
    for (e, [a, b, ..]) in LINES {
        for (f, [c, d, ..]) in LINES {
            assert_eq!(e.turn(&f), Sign::of(&(a * d - b * c), &0.0), "{e:?} {f:?}");
        }
    }
}

/// A meeting may name the line otherwise than the one that asks, and not at the same place.
#[test]
fn what_crosses_a_line_is_not_the_line_itself() {
    let (line, back) = (Line::Through(P, Q), Line::Through(Q, P));
    let other = |x: f64| Line::Bisector([x, 0.0], [x + 2.0, 1.0]);
    for same in [line, back] {
        for (p, q) in [(1.0, 3.0), (3.0, 5.0)] {
            let here = [Spot::Meeting(same, other(p)), Spot::Meeting(other(p), same)];
            let there = [Spot::Meeting(same, other(q)), Spot::Meeting(other(q), same)];
            for (p, q) in here.iter().flat_map(|p| there.iter().map(move |q| (p, q))) {
                assert_eq!([line.compare(p, q), line.compare(q, p)], [Ordering::Less, Ordering::Greater]);
                assert_eq!([back.compare(p, q), back.compare(q, p)], [Ordering::Greater, Ordering::Less]);
            }
        }
    }
}

#[test]
fn the_range_of_the_bounds_is_known() {
    assert_eq!([CEILING, FLOOR], [power(200), power(-660)]);
    assert_eq!(SIDE_BOUND, power(-49));
    assert_eq!([TURN_BOUND, MEETING_BOUND], [5.0 * power(-53), 10.0 * power(-53)]);
    for (a, b, size, expected) in [
        (power(200), -power(200), power(400), true),
        (power(201), 0.0, 0.0, false),
        (0.0, -power(201), 0.0, false),
        (0.0, 0.0, power(401), false),
    ] {
        assert_eq!(Equation { a, b, c: 0.0, size }.in_range(), expected, "{a} {b} {size}");
    }
}

/// Two lines that cross, often at a small angle, and a third one past their meeting, often near.
fn three(random: &mut Random) -> ([Line; 3], Point2) {
    // Directions that are often nearly along an axis make each product the largest one at times.
    let mut around = |at: Point2| at.map(|x| x + random.between(-1.0, 1.0).powi(5));
    let (from, meeting) = (around([0.0; 2]), around([0.0; 2]));
    let [p, q, r] = [(); 3].map(|()| around([0.0; 2]));
    let mirrored = [2.0 * meeting[0] - q[0], 2.0 * meeting[1] - q[1]];
    // The circle around the meeting through the first site has the second one.
    let [x, y] = [0, 1].map(|k| from[k] - meeting[k]);
    let bisector = Line::Bisector(from, [meeting[0] - y, meeting[1] + x]);
    let off = power(-25 - random.below(28) as i32);
    let beside = [meeting[0] * 2.0 - r[0] + off, meeting[1] * 2.0 - r[1]];
    let second = match random.below(3) {
        0 => Line::Above(1, meeting[1]),
        1 => Line::Through(mirrored, q),
        _ => {
            let [x, y] = [0, 1].map(|k| p[k] - meeting[k]);
            Line::Bisector(p, [meeting[0] - y, meeting[1] + x])
        }
    };
    ([bisector, second, Line::Through(beside, r)], meeting)
}

/// A determinant, and the permanent of sizes.
fn sums([e, f, g]: [Equation; 3]) -> [f64; 2] {
    let rows = [e, f, g].map(|e| [e.a, e.b, e.c]);
    let sizes = [e, f, g].map(|e| [e.a.abs(), e.b.abs(), e.size]);
    let product = |of: &[[f64; 3]; 3], [i, j, k]: [usize; 3]| of[0][i] * of[1][j] * of[2][k];
    let (even, odd) = ([[0, 1, 2], [1, 2, 0], [2, 0, 1]], [[0, 2, 1], [1, 0, 2], [2, 1, 0]]);
    let sum = |of, orders: [[usize; 3]; 3]| orders.into_iter().map(|order| product(of, order)).sum::<f64>();
    [sum(&rows, even) - sum(&rows, odd), sum(&sizes, even) + sum(&sizes, odd)]
}

#[test]
fn the_side_of_a_meeting_is_told_from_its_bound_on() {
    let mut random = Random::new(1);
    let (mut told, mut not) = (0, 0);
    for _ in 0..40_000 {
        let ([first, second, third], _) = three(&mut random);
        let from = first.point().expect("a bisector");
        let [e, f, g] = [first, second, third].map(|line| line.equation(from));
        let [value, permanent] = sums([e, f, g]);
        let turn = e.a * f.b - e.b * f.a;
        if turn.abs() < 1e-12 * ((e.a * f.b).abs() + (e.b * f.a).abs()) {
            continue;
        }
        let found = side_filter(&first, &second, &third);
        // The sum here is rounded otherwise.
        let units = value.abs() / (permanent * U);
        if units > 19.0 {
            assert_eq!(found, Some(Sign::of(&(value * turn), &0.0)), "{first:?} {second:?} {third:?}");
            told += usize::from(units < 40.0);
        } else if units < 13.0 {
            assert_eq!(found, None, "{first:?} {second:?} {third:?}");
            not += usize::from(units > 6.0);
        }
    }
    assert!(told > 300 && not > 300, "{told} {not}");
}

#[test]
fn turns_are_told_from_their_bound_on() {
    let mut random = Random::new(2);
    let (mut told, mut not) = (0, 0);
    for _ in 0..20_000 {
        let [p, d] = [(); 2].map(|()| [(); 2].map(|()| random.between(-1.0, 1.0).powi(3)));
        let bent = [d[0] * (1.0 + power(-50) * random.between(-1.0, 1.0)), d[1]];
        let (first, second) =
            (Line::Through([0.0; 2], d), Line::Bisector(p, [p[0] - bent[1], p[1] + bent[0]]));
        let (e, f) = (first.equation([0.0; 2]), second.equation([0.0; 2]));
        let (left, right) = (e.a * f.b, e.b * f.a);
        let units = (left - right).abs() / ((left.abs() + right.abs()) * U);
        let found = turn_filter(&first, &second);
        let meets = meeting_filter(&first, &second);
        if units > 5.01 {
            assert_eq!(found, Some(Sign::of(&left, &right)), "{first:?} {second:?}");
            told += usize::from(units < 8.0);
        } else if units < 4.99 {
            assert_eq!(found, None, "{first:?} {second:?}");
            // On which side they meet is not known either, however far away.
            assert_eq!(side_filter(&first, &second, &Line::Through(P, Q)), None, "{first:?} {second:?}");
            not += usize::from(units > 2.0);
        }
        // A denominator keeps half of its value.
        assert!(units > 9.99 || meets.is_none(), "{first:?} {second:?}");
    }
    assert!(told > 300 && not > 300, "{told} {not}");
}

/// Bounds allow for underflow.
#[test]
fn nothing_is_told_from_what_underflows() {
    let (right, up) =
        (|w: f64| Line::Through([0.0; 2], [w, 0.0]), |w: f64| Line::Through([0.0; 2], [0.0, w]));
    let two = |w: f64| (right(w), up(w));
    for (exponent, told) in [(-500, true), (-510, true), (-511, false), (-512, false), (-600, false)] {
        let (first, second) = two(power(exponent));
        assert_eq!(turn_filter(&first, &second), told.then_some(Sign::Positive), "{exponent}");
        assert_eq!(turn_filter(&second, &first), told.then_some(Sign::Negative), "{exponent}");
        assert!(told || meeting_filter(&first, &second).is_none(), "{exponent}");
    }
    for (exponent, told) in [(-327, true), (-328, true), (-330, false), (-340, false)] {
        let third = Line::Through([0.5, 0.0], [0.5, power(exponent)]);
        let found = side_filter(&Line::Above(0, 1.0), &right(power(-330)), &third);
        assert_eq!(found, told.then_some(Sign::Negative), "{exponent}");
    }
    // A denominator that has vanished, where the determinant has not.
    let (w, far, large) = (power(-540), power(400), power(200));
    let (first, second) = (right(w), Line::Through([far, w], [far, 0.0]));
    let third = Line::Through([1.0, large], [1.0, 0.0]);
    assert_eq!(side_filter(&first, &second, &third), None);
    assert_eq!(third.side(&Spot::Meeting(first, second)), Sign::Positive);
    // Coefficients out of range.
    let huge = Line::Through([0.0; 2], [power(201), power(201)]);
    let [one, other, far] = [Line::Above(0, 1.0), Line::Through([0.0; 2], [1.0, 0.0]), Line::Above(0, 3.0)];
    for [e, f, g] in [[huge, one, other], [one, huge, other], [one, other, huge]] {
        assert_eq!(side_filter(&e, &f, &g), None);
    }
    assert_eq!(meeting_filter(&huge, &one), None);
    assert_eq!(meeting_filter(&one, &huge), None);
    assert_eq!(meeting(&other, &far, [far.fixed(0), other.fixed(1)]), Some([3.0, 0.0]));
}

/// Floating point and balls give the nearest place wherever they answer, and they mostly do.
#[test]
fn meetings_are_told_only_where_they_are_sure() {
    let mut random = Random::new(3);
    let tiny = [Line::Through([0.0; 2], [power(-1020), 0.0]), Line::Above(0, power(380))];
    let small = [Line::Through([0.0; 2], [power(-640), 0.0]), Line::Above(0, 1.0)];
    // Where numbers are denser than errors are large floating point tells little: most pairs are moved away from there.
    let moved = |line: Line, by: f64| {
        let to = |p: Point2| p.map(|x| x + by);
        match line {
            Line::Through(p, q) => Line::Through(to(p), to(q)),
            Line::Bisector(p, q) => Line::Bisector(to(p), to(q)),
            Line::Above(axis, at) => Line::Above(axis, at + by),
            other => other,
        }
    };
    let pairs = (0..5000).map(|i| {
        let [first, second, _] = three(&mut random).0;
        [first, second].map(|line| moved(line, if i % 5 == 0 { 0.0 } else { 1000.0 }))
    });
    let (mut by_numbers, mut by_balls) = (0, 0);
    for [first, second] in pairs.chain([tiny, small]) {
        let exact = exact::meeting(&first, &second).expect("they meet");
        if let Some(found) = meeting_filter(&first, &second) {
            assert_eq!(found, exact, "{first:?} {second:?}");
            by_numbers += 1;
        }
        if let Some(found) = meeting(&first, &second, NOT_KNOWN) {
            assert_eq!(found, exact, "{first:?} {second:?}");
            by_balls += 1;
        }
    }
    assert!(by_numbers > 1500 && by_balls > 4400, "{by_numbers} {by_balls}");
}
