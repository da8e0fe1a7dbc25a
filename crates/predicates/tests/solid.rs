//! Meetings of planes against rational arithmetic, on all generators and on hostile numbers.

use delone_generators::{Kind3, Random};
use delone_oracle::share;
use delone_oracle::solid::{self, HalfSpace as Judged};
use delone_predicates::{HalfSpace, HalfSpaces, Point3, Sign, are_collinear3};

/// Coordinates of one kind.
type Family = (&'static str, fn(&mut Random) -> f64);

/// A half-space from points, of which some may be equal.
fn made(random: &mut Random, p: &[Point3; 3], own: Point3) -> Option<(HalfSpace, Judged)> {
    let [a, b, c] = *p;
    let axis = random.below(3);
    let found = match random.below(6) {
        0 | 1 if own != a => (HalfSpace::Bisector(own, a), Judged::Nearer((own, 0.0), (a, 0.0))),
        2 if a != b => {
            let (w, v) = (c[0] * 0.5, c[1]);
            (HalfSpace::Radical((a, w), (b, v)), Judged::Nearer((a, w), (b, v)))
        }
        3 => (HalfSpace::Above(axis, a[axis]), Judged::Axis(axis, a[axis], false)),
        4 => (HalfSpace::Below(axis, a[axis]), Judged::Axis(axis, a[axis], true)),
        5 if !are_collinear3(a, b, c) => (HalfSpace::Through(a, b, c), Judged::Through(a, b, c)),
        _ => return None,
    };
    Some(found)
}

/// Four planes and where they are seen from.
fn fours(seed: u64, n: usize, mut judge: impl FnMut(&str, Point3, [HalfSpace; 4], [Judged; 4])) {
    let mut random = Random::new(seed);
    let mut all = |name: &str, points: &[Point3]| {
        for p in points.chunks_exact(13) {
            let plane = |random: &mut Random, i: usize| made(random, &[p[i], p[i + 1], p[i + 2]], p[12]);
            let four = [0, 3, 6, 9].map(|i| plane(&mut random, i));
            if let [Some(i), Some(j), Some(k), Some(l)] = four {
                judge(name, p[12], [i.0, j.0, k.0, l.0], [i.1, j.1, k.1, l.1]);
            }
        }
    };
    for &kind in Kind3::ALL {
        all(kind.name(), &kind.points(n, seed));
    }
    let mut numbers = Random::new(seed + 1);
    let families: [Family; 6] = [
        ("small integers", |r| r.below(4) as f64),
        ("tenths", |r| r.below(20) as f64 * 0.1),
        ("any magnitude", |r| 2f64.powi(r.below(600) as i32 - 300) * (r.unit() - 0.5)),
        ("subnormal", |r| f64::from_bits(r.bits() >> 50)),
        ("large", |r| (r.unit() - 0.5) * 1e300),
        ("far and close together", |r| 4_500_000.7 + r.below(20) as f64 * 0.1),
    ];
    for (name, number) in families {
        let points: Vec<Point3> = (0..n).map(|_| [(); 3].map(|()| number(&mut numbers))).collect();
        all(name, &points);
    }
}

#[test]
fn sides_of_corners_are_exact() {
    let (mut all, mut ties) = (0, 0);
    fours(1, share(60_000), |name, from, four, judged| {
        let mut planes = HalfSpaces::new(from);
        let [i, j, k, l] = four.map(|plane| planes.push(plane));
        let expected = solid::side(&judged);
        let corner = planes.corner([i, j, k]);
        assert_eq!(corner.is_some(), expected.is_some(), "{name} {four:?}");
        let (Some(corner), Some(expected)) = (corner, expected) else { return };
        let found = planes.side_with_ties(&corner, l);
        assert_eq!(found, Sign::of(&expected, &0), "{name} {four:?}");
        assert!(found.is_zero() || planes.holds(&corner, l) == found.is_positive(), "{name} {four:?}");
        all += 1;
        ties += usize::from(found.is_zero());
    });
    assert!(all > share(10_000) && ties > share(1000), "{ties} ties of {all}");
}

/// The order in which planes move that depend on no site: by axis and direction, those through points last.
fn order(four: &[HalfSpace; 4]) -> Vec<usize> {
    let key = |i: &usize| match four[*i] {
        HalfSpace::Above(axis, at) => (axis, vec![at]),
        HalfSpace::Below(axis, at) => (3 + axis, vec![at]),
        HalfSpace::Through(a, b, c) => (6, [a, b, c].concat()),
        _ => (7, Vec::new()),
    };
    let mut walls: Vec<usize> = (0..4).filter(|i| key(i).0 < 7).collect();
    walls.sort_by(|i, j| key(i).partial_cmp(&key(j)).expect("finite"));
    walls
}

/// Ties are decided as after a move by real numbers.
#[test]
fn ties_are_decided_by_infinitesimals() {
    let mut ties = 0;
    fours(2, share(300_000), |name, from, four, judged| {
        if !["small integers", "repeated", "grid3", "lines"].contains(&name) {
            return;
        }
        // Twice the same plane has no side.
        if (0..4).any(|i| (0..i).any(|j| four[i] == four[j])) {
            return;
        }
        let mut planes = HalfSpaces::new(from);
        let [i, j, k, l] = four.map(|plane| planes.push(plane));
        let Some(corner) = planes.corner([i, j, k]) else { return };
        let expected = solid::side_of_moved(&judged, &order(&four), 200).expect("a corner");
        assert_eq!(planes.holds(&corner, l), expected > 0, "{name} {four:?}");
        ties += usize::from(planes.side_with_ties(&corner, l).is_zero());
    });
    assert!(ties > share(1000), "{ties} ties");
}

#[test]
fn places_are_the_nearest_numbers() {
    let mut all = 0;
    fours(3, share(60_000), |name, from, four, judged| {
        let mut planes = HalfSpaces::new(from);
        let three = [0, 1, 2].map(|i| planes.push(four[i]));
        let Some(corner) = planes.corner(three) else { return };
        let place = planes.rounded(&corner);
        if place.iter().any(|x| x.abs() >= f64::MAX) {
            return;
        }
        let expected = solid::is_nearest(&[judged[0], judged[1], judged[2]], place);
        assert_eq!(expected, Some([true; 3]), "{name} {four:?} {place:?}");
        all += 1;
    });
    assert!(all > share(10_000), "{all}");
}
