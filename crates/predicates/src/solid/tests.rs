//! The share that floating point decides by itself, and what is the same decided otherwise.

use delone_generators::{Kind3, Random};
use delone_oracle::share;

use super::{HalfSpace, HalfSpaces, exact, in_balls};
use crate::{Sign, circumcenter3, in_sphere, in_sphere_with_ties, orient3d, power_center3};

/// Four bisectors of one site decide as the in-sphere test does, ties too, and meet at the center of the sphere.
#[test]
fn bisectors_of_a_site_are_spheres() {
    let (mut all, mut ties, mut by_filter) = (0, 0, 0);
    for &kind in Kind3::ALL {
        for p in kind.points(share(4000), 3).chunks_exact(5) {
            let distinct = (0..5).all(|i| (0..i).all(|j| p[i] != p[j]));
            let turn = orient3d(p[0], p[1], p[2], p[3]);
            if !distinct || turn.is_zero() {
                continue;
            }
            let mut planes = HalfSpaces::new(p[0]);
            let [b, c, d, e] = [1, 2, 3, 4].map(|i| planes.push(HalfSpace::Bisector(p[0], p[i])));
            let corner = planes.corner([b, c, d]).expect("not flat");
            // Whoever is in the sphere takes the corner away.
            let expected = in_sphere(p[0], p[1], p[2], p[3], p[4]) * turn;
            assert_eq!(planes.holds(&corner, e), expected.is_negative(), "{kind:?} {p:?}");
            let expected = in_sphere_with_ties(p[0], p[1], p[2], p[3], p[4]) * turn;
            assert_eq!(planes.side_with_ties(&corner, e), -expected, "{kind:?} {p:?}");
            ties += usize::from(expected.is_zero());
            by_filter += usize::from(planes.filtered(&corner, e).is_some());
            all += 1;
            let place = planes.rounded(&corner);
            let center = circumcenter3(p[0], p[1], p[2], p[3]);
            assert_eq!(Some(place).filter(|x| x.iter().all(|x| x.is_finite())), center, "{kind:?} {p:?}");
        }
    }
    assert!(ties > 5 && 3 * by_filter > 2 * all, "{by_filter} of {all} by the filter, {ties} ties");
}

/// Planes of any kind, in small integers, so that much is a tie.
fn some_plane(random: &mut Random) -> HalfSpace {
    let mut number = || random.below(5) as f64 * 0.5;
    let mut point = || [number(), number(), number()];
    let (p, q, r) = (point(), point(), point());
    let (w, v, axis) = (number(), number(), (2.0 * number()) as usize % 3);
    match random.below(5) {
        0 if p != q => HalfSpace::Bisector(p, q),
        1 if p != q => HalfSpace::Radical((p, w), (q, v)),
        2 => HalfSpace::Above(axis, p[0]),
        3 => HalfSpace::Below(axis, p[0]),
        4 if !crate::are_collinear3(p, q, r) => HalfSpace::Through(p, q, r),
        _ => some_plane(random),
    }
}

/// From wherever they are seen, in whatever units and order.
#[test]
fn answers_do_not_depend_on_the_view() {
    let mut random = Random::new(7);
    let (mut ties, mut met) = (0, 0);
    for _ in 0..share(40_000) {
        let four = [(); 4].map(|()| some_plane(&mut random));
        let scaled = |power: i32| {
            let unit = 2f64.powi(power);
            four.map(|plane| {
                let point = |p: [f64; 3]| p.map(|x| x * unit);
                match plane {
                    HalfSpace::Bisector(p, q) => HalfSpace::Bisector(point(p), point(q)),
                    HalfSpace::Radical((p, w), (q, v)) => {
                        HalfSpace::Radical((point(p), w * unit * unit), (point(q), v * unit * unit))
                    }
                    HalfSpace::Above(axis, at) => HalfSpace::Above(axis, at * unit),
                    HalfSpace::Below(axis, at) => HalfSpace::Below(axis, at * unit),
                    HalfSpace::Through(p, q, r) => HalfSpace::Through(point(p), point(q), point(r)),
                }
            })
        };
        let ask = |power: i32, from: [f64; 3], order: [usize; 4]| {
            let mut planes = HalfSpaces::new(from.map(|x| x * 2f64.powi(power)));
            let all = scaled(power);
            let [i, j, k, l] = order.map(|i| planes.push(all[i]));
            let corner = planes.corner([i, j, k])?;
            let place = planes.rounded(&corner).map(|x| x * 2f64.powi(-power));
            Some((planes.holds(&corner, l), planes.side_with_ties(&corner, l), place))
        };
        let expected = ask(0, [0.0; 3], [0, 1, 2, 3]);
        for (power, from, order) in [
            (0, [0.5, 1.0, 0.0], [1, 0, 2, 3]),
            (0, [1e-9, 0.3, 0.0], [2, 1, 0, 3]),
            (300, [0.0; 3], [1, 2, 0, 3]),
            (-300, [1.0; 3], [0, 2, 1, 3]),
        ] {
            assert_eq!(ask(power, from, order), expected, "{four:?} {power} {from:?}");
        }
        if let Some((holds, side, _)) = expected {
            met += 1;
            ties += usize::from(side.is_zero());
            assert!(side.is_zero() || holds == side.is_positive());
        }
    }
    assert!(met > share(20_000) && ties > share(1000), "{met} met, {ties} ties");
}

/// In general position exactly one of two opposite half-spaces has a corner. So it is with ties, but for planes that are moved themselves.
#[test]
fn bisectors_seen_from_both_sites_divide() {
    let mut random = Random::new(8);
    for _ in 0..share(20_000) {
        let mut planes = HalfSpaces::new([0.0; 3]);
        let three = [(); 3].map(|()| planes.push(some_plane(&mut random)));
        let Some(corner) = planes.corner(three) else { continue };
        let HalfSpace::Bisector(p, q) = some_plane(&mut random) else { continue };
        let [there, back] = [planes.push(HalfSpace::Bisector(p, q)), planes.push(HalfSpace::Bisector(q, p))];
        let is_own = three.iter().any(|&i| {
            let of = |p, q| planes.all[i].0 == HalfSpace::Bisector(p, q);
            of(p, q) || of(q, p)
        });
        assert!(is_own || planes.holds(&corner, there) != planes.holds(&corner, back));
    }
}

#[test]
fn what_only_touches_from_outside_is_outside() {
    let mut planes = HalfSpaces::new([0.0; 3]);
    let walls = [HalfSpace::Above(0, 0.0), HalfSpace::Above(1, 0.0), HalfSpace::Below(2, 1.0)];
    let corner = walls.map(|wall| planes.push(wall));
    let corner = planes.corner(corner).expect("a corner");
    let outer = planes.push(HalfSpace::Bisector([-1.0, 0.5, 0.5], [1.0, 0.5, 0.5]));
    let inner = planes.push(HalfSpace::Bisector([1.0, 0.5, 0.5], [-1.0, 0.5, 0.5]));
    assert_eq!([outer, inner].map(|i| planes.holds(&corner, i)), [false, true]);
    assert_eq!([outer, inner].map(|i| planes.side_with_ties(&corner, i)), [Sign::Zero; 2]);
}

/// Balls know most places, and power centers are met too.
#[test]
fn places_are_correctly_rounded() {
    let mut random = Random::new(9);
    let (mut all, mut by_balls) = (0, 0);
    for _ in 0..share(8000) {
        let site = |r: &mut Random| ([r.unit(), r.unit(), r.unit()], r.unit());
        let own = site(&mut random);
        let others = [(); 3].map(|()| site(&mut random));
        let planes = others.map(|other| HalfSpace::Radical(own, other));
        let expected = power_center3(own, others[0], others[1], others[2]).expect("not flat");
        assert_eq!(exact::place(own.0, &planes), expected);
        if let Some(found) = in_balls(own.0, &planes, [None; 3]) {
            assert_eq!(found, expected);
            by_balls += 1;
        }
        all += 1;
    }
    assert!(10 * by_balls > 9 * all, "{by_balls} of {all}");
}
