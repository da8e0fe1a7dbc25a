//! Meetings of lines against rational arithmetic, on random and adversarial lines.

use std::cmp::Ordering;

use delone_generators::Random;
use delone_oracle::lines::{self, Line as Judged};
use delone_oracle::share;
use delone_predicates::{Line, Point2, Sign, Spot, circumcenter};

/// Coordinates of one kind; lines are made of those of one kind.
type Family = (&'static str, fn(&mut Random) -> f64);

const FAMILIES: &[Family] = &[
    ("uniform", |r| r.unit()),
    ("small integers", |r| r.below(5) as f64),
    ("tenths", |r| r.below(20) as f64 * 0.1),
    ("integers near 2^53", |r| 9_007_199_254_740_992.0 - r.below(8) as f64),
    ("far away and close together", |r| 4_500_000.7 + r.below(20) as f64 * 0.1),
    ("subnormal", |r| f64::from_bits(r.bits() >> 50) * if r.below(2) == 0 { 1.0 } else { -1.0 }),
    ("a few subnormals among integers", |r| {
        if r.below(3) == 0 { f64::from_bits(1 + r.below(2) as u64) } else { r.below(4) as f64 }
    }),
    ("the largest", |r| f64::MAX * (r.unit() - 0.5) * 2.0),
    ("any magnitude", |r| {
        loop {
            let x = f64::from_bits(r.bits());
            if x.is_finite() {
                return x;
            }
        }
    }),
    ("magnitudes at which products underflow", |r| r.unit() * 2f64.powi(r.below(300) as i32 - 500)),
    ("nearly the same", |r| f64::from_bits(1.0_f64.to_bits() + r.below(4) as u64)),
];

fn line(random: &mut Random, coordinate: fn(&mut Random) -> f64) -> (Line, Judged) {
    loop {
        let mut point = || [coordinate(random), coordinate(random)];
        let (p, q) = (point(), point());
        let made = match random.below(5) {
            0 if p != q => (Line::Through(p, q), Judged::Through(p, q)),
            1 | 2 if p != q => (Line::Bisector(p, q), Judged::Bisector(p, q)),
            3 => (Line::Above(usize::from(p < q), p[0]), Judged::Axis(usize::from(p < q), p[0], true)),
            4 => (Line::Below(usize::from(p < q), p[0]), Judged::Axis(usize::from(p < q), p[0], false)),
            _ => continue,
        };
        return made;
    }
}

fn sign(value: i8) -> Sign {
    Sign::of(&value, &0)
}

/// Three lines, often with a site in common, as in a cell.
fn triples(seed: u64, n: usize, mut judge: impl FnMut(&str, [Line; 3], [Judged; 3])) {
    for &(name, coordinate) in FAMILIES {
        let mut random = Random::new(seed);
        for _ in 0..n {
            let mut three = [(); 3].map(|()| line(&mut random, coordinate));
            if random.below(2) == 0 {
                let site = [coordinate(&mut random), coordinate(&mut random)];
                for line in &mut three {
                    match *line {
                        (Line::Bisector(_, other), _) if site != other => {
                            *line = (Line::Bisector(site, other), Judged::Bisector(site, other));
                        }
                        _ => (),
                    }
                }
            }
            judge(name, three.map(|line| line.0), three.map(|line| line.1));
        }
    }
}

#[test]
fn sides_of_meetings_are_exact() {
    let mut zero = 0;
    triples(1, 20_000, |name, [e, f, g], judged| {
        let expected = lines::side(judged[0], judged[1], judged[2]);
        assert_eq!(g.side(&Spot::Meeting(e, f)), sign(expected), "{name}: {e:?} {f:?} {g:?}");
        assert_eq!(g.side(&Spot::Meeting(f, e)), sign(expected), "{name}: {e:?} {f:?} {g:?}, swapped");
        zero += usize::from(expected == 0);
    });
    assert!(zero > 10_000, "only {zero} ties were met");
}

/// The order along a line is that of sides of a line across, by definition: whatever crosses it has what is before on
/// one side.
#[test]
fn orders_along_lines_are_exact() {
    let (mut decided, mut equal) = (0, 0);
    triples(2, 20_000, |name, [e, f, g], judged| {
        let [p, q] = [Spot::Meeting(e, g), Spot::Meeting(g, f)];
        let meets = |k: usize| lines::meet_near(judged[k], judged[2], [0.0; 2], [0.0; 2]).is_some();
        if !(meets(0) && meets(1)) {
            return;
        }
        // Where f crosses g, the side of f that g goes to: that of a point further along than the meeting.
        let order = g.compare(&p, &q);
        assert_eq!(g.compare(&q, &p), order.reverse(), "{name}: {e:?} {f:?} {g:?}");
        let side = lines::side(judged[0], judged[2], judged[1]);
        assert_eq!(order == Ordering::Equal, side == 0, "{name}: {e:?} {f:?} {g:?}");
        equal += usize::from(side == 0);
        // An axis-parallel line that the meetings are on different sides of tells which is first.
        for (axis, back) in [(0, false), (1, true)] {
            let direction = match judged[2] {
                Judged::Through(p, q) => q[axis].total_cmp(&p[axis]) as i8,
                Judged::Bisector(p, q) => {
                    let across = p[1 - axis].total_cmp(&q[1 - axis]) as i8;
                    if back { -across } else { across }
                }
                Judged::Axis(..) => continue,
            };
            let [at_p, at_q] = [p, q].map(|spot| spot.rounded());
            let (Some(at_p), Some(at_q)) = (at_p, at_q) else { continue };
            if at_p[axis] != at_q[axis] {
                let expected = (at_p[axis].total_cmp(&at_q[axis]) as i8 * direction).cmp(&0);
                assert_eq!(order, expected, "{name}: {e:?} {f:?} {g:?}");
                decided += 1;
            }
        }
    });
    assert!(decided > 20_000 && equal > 2_000, "{decided} decided, {equal} equal");
}

#[test]
fn points_of_a_line_are_in_its_order() {
    let diagonal = Line::Through([0.0, 0.0], [3.0, 3.0]);
    let bisector = Line::Bisector([0.0, 2.0], [2.0, 0.0]);
    let points = [-1.0, 0.0, 5e-324, 0.1, 7.0].map(|x| Spot::Point([x, x]));
    for (i, p) in points.iter().enumerate() {
        for (j, q) in points.iter().enumerate() {
            assert_eq!(diagonal.compare(p, q), i.cmp(&j));
            // The first is nearer on its left, which is above.
            assert_eq!(bisector.compare(p, q), i.cmp(&j));
        }
    }
    let third = Spot::Meeting(Line::Above(0, 0.1), diagonal);
    assert_eq!(points.each_ref().map(|p| diagonal.compare(p, &third) as i8), [-1, -1, -1, 0, 1]);
    assert_eq!(points.each_ref().map(|p| bisector.compare(&third, p) as i8), [1, 1, 1, 0, -1]);
    let down = Line::Below(0, 1.0);
    assert!(down.compare(&Spot::Point([1.0, 0.0]), &Spot::Point([1.0, 2.0])).is_lt());
    let up = Line::Above(0, 1.0);
    assert!(up.compare(&Spot::Point([1.0, 0.0]), &Spot::Point([1.0, 2.0])).is_gt());
}

/// The nearest number of each exact coordinate, and so the same bits from all sides.
#[test]
fn meetings_are_correctly_rounded() {
    let mut rounded = 0;
    triples(3, 20_000, |name, [e, f, _], judged| {
        let Some(at) = Spot::Meeting(e, f).rounded() else {
            let far = lines::meet_near(judged[0], judged[1], [0.0; 2], [f64::MAX; 2]);
            assert_ne!(far, Some(true), "{name}: {e:?} {f:?} meet");
            return;
        };
        let swapped = |line: Line| match line {
            Line::Through(p, q) => Line::Through(q, p),
            Line::Bisector(p, q) => Line::Bisector(q, p),
            Line::Radical(p, q) => Line::Radical(q, p),
            Line::Above(axis, at) => Line::Below(axis, at),
            Line::Below(axis, at) => Line::Above(axis, at),
        };
        for other in
            [Spot::Meeting(f, e), Spot::Meeting(swapped(e), f), Spot::Meeting(swapped(f), swapped(e))]
        {
            let same = other.rounded().is_some_and(|p| p.map(f64::to_bits) == at.map(f64::to_bits));
            assert!(same, "{name}: {e:?} {f:?}: {at:?} and {other:?}");
        }
        let nearest = lines::meet_nearest_to(judged[0], judged[1], at);
        assert_eq!(nearest, Some([true; 2]), "{name}: {e:?} {f:?} at {at:?}");
        rounded += 1;
    });
    assert!(rounded > 50_000, "only {rounded}");
}

/// Right angles, equal heights and slivers: centers half way between two numbers, and such that hang on the last bits.
#[test]
fn circumcenters_are_correctly_rounded() {
    let mut random = Random::new(9);
    let judge = |name: &str, [a, b, c]: [Point2; 3]| {
        let Some(at) = circumcenter(a, b, c) else { return 0 };
        let nearest = lines::meet_nearest_to(Judged::Bisector(a, b), Judged::Bisector(a, c), at);
        assert_eq!(nearest, Some([true; 2]), "{name}: {a:?} {b:?} {c:?} at {at:?}");
        for [p, q, r] in [[a, c, b], [b, a, c], [b, c, a], [c, a, b], [c, b, a]] {
            assert_eq!(circumcenter(p, q, r).map(|p| p.map(f64::to_bits)), Some(at.map(f64::to_bits)));
        }
        1
    };
    let mut judged = 0;
    for &(name, coordinate) in FAMILIES {
        for _ in 0..share(20_000) {
            let mut point = || [coordinate(&mut random), coordinate(&mut random)];
            let [a, b, [x, y]] = [(); 3].map(|()| point());
            let (u, w) = ([b[0] - a[0], b[1] - a[1]], f64::from(random.below(5) as u8));
            let turned = [a[0] - w * u[1], a[1] + w * u[0]];
            let beside = [0, 1].map(|k| (a[k] / 2.0 + b[k] / 2.0).next_up());
            for c in [[x, y], [x, a[1]], [b[0], y], [b[0], a[1]], turned, beside] {
                if a.iter().chain(&b).chain(&c).all(|x| x.is_finite()) && a != b {
                    judged += judge(name, [a, b, c]);
                }
            }
        }
    }
    assert!(judged > share(500_000), "only {judged}");
}

#[test]
fn meetings_of_bisectors_are_circumcenters() {
    let mut random = Random::new(4);
    for _ in 0..10_000 {
        let mut point = || -> Point2 { [random.unit(), random.unit()] };
        let (a, b, c) = (point(), point(), point());
        let center = circumcenter(a, b, c);
        for (e, f) in [((a, b), (a, c)), ((b, a), (c, a)), ((b, c), (a, b)), ((c, b), (c, a))] {
            let spot = Spot::Meeting(Line::Bisector(e.0, e.1), Line::Bisector(f.0, f.1));
            assert_eq!(spot.rounded(), center);
        }
    }
}
