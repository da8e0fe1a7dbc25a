//! Constrained triangulations against the definition, and rounds of splits against a judge of their own.

use std::collections::BTreeSet;

use delone::{Constrained2, Crossings, Error, Fill, Polygons2, RingFill, SegmentId};
use delone_generators::{Kind, Random};
use delone_oracle::{constrained, crossings};

type Points = Vec<[f64; 2]>;
type Segments = Vec<[usize; 2]>;

fn coordinates(c: &Constrained2) -> Vec<[[f64; 2]; 3]> {
    delone_oracle::brute::normalized(c.triangles().map(|t| t.map(|v| c.point(v))))
}

/// Segments of which none crosses another one, by the judge.
fn planar(points: &[[f64; 2]], tries: usize, random: &mut Random) -> Segments {
    let mut kept: Segments = Vec::new();
    for _ in 0..tries {
        kept.push([random.below(points.len()), random.below(points.len())]);
        if !crossings::crossing_pairs(points, &kept).is_empty() {
            kept.pop();
        }
    }
    kept
}

fn hostile(random: &mut Random, n: usize) -> Points {
    let scale = [1.0, 1e-300, 1e300, f64::MIN_POSITIVE, 0.1, f64::EPSILON][random.below(6)];
    let offset = if scale == f64::EPSILON { 1.0 } else { 0.0 };
    let side = [3, 5, 9, 1000][random.below(4)];
    (0..n).map(|_| [(); 2].map(|()| offset + scale * random.below(side) as f64)).collect()
}

#[test]
fn small_sets_are_what_the_definition_says() {
    let mut random = Random::new(1);
    for round in 0..400 {
        let n = 3 + random.below(if round % 20 == 0 { 25 } else { 10 });
        let points = if round % 2 == 0 {
            hostile(&mut random, n)
        } else {
            Kind::ALL[round % Kind::ALL.len()].points(n, round as u64)
        };
        let segments = planar(&points, 2 * n, &mut random);
        let c = Constrained2::from_parts(&points, &segments).expect("nothing crosses");
        c.check().expect("canonical");
        assert_eq!(
            coordinates(&c),
            constrained::triangulation(&points, &segments),
            "{points:?} {segments:?}"
        );
        let edges = |ends: [[f64; 2]; 2]| if ends[0] <= ends[1] { ends } else { [ends[1], ends[0]] };
        let mut found: Vec<_> = c.constraints().map(|ends| edges(ends.map(|v| c.point(v)))).collect();
        let mut expected: Vec<_> =
            constrained::constraints(&points, &segments).into_iter().map(edges).collect();
        found.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
        expected.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
        assert_eq!(found, expected);
    }
}

#[test]
fn crossings_are_those_of_all_pairs_and_splits_those_of_the_judge() {
    let mut random = Random::new(2);
    for _ in 0..300 {
        let n = 4 + random.below(16);
        let points = hostile(&mut random, n);
        let segments: Segments = (0..=random.below(12)).map(|_| [random.below(n), random.below(n)]).collect();
        let pairs = crossings::crossing_pairs(&points, &segments);
        match Constrained2::from_parts(&points, &segments) {
            Ok(_) => assert!(pairs.is_empty(), "{points:?} {segments:?}"),
            Err(Error::SegmentsCross { first, second, near, count }) => {
                assert_eq!(count, pairs.len(), "{points:?} {segments:?}");
                assert!(pairs.contains(&[first.min(second), first.max(second)]));
                let ends = [first, second].map(|s| segments[s].map(|i| points[i]));
                assert_eq!(Some(near), crossings::crossing(ends[0], ends[1]));
            }
            Err(other) => panic!("{other}"),
        }
        let c = Constrained2::with_crossings(&points, &segments, Crossings::Split).expect("it ends");
        c.check().expect("canonical");
        let judge = crossings::Split::new(&points, &segments);
        assert_eq!(c.points(), &judge.points[..], "{points:?} {segments:?}");
        let edges: BTreeSet<[usize; 2]> = c.constraints().map(|ends| ends.map(|v| v.index())).collect();
        assert_eq!(edges, judge.edges().into_iter().collect(), "{points:?} {segments:?}");
        for e in c.constraint_edges() {
            let ends = [c.mesh().origin(e), c.mesh().destination(e)].map(|v| v.index());
            let found: Vec<_> = c.covering(e).iter().map(|c| (c.segment.index(), c.is_forward)).collect();
            assert_eq!(found, judge.covering(ends));
        }
    }
}

/// A segment of a family: on others, through one point, of a lattice, nearly parallel, between thirds.
fn nasty(family: usize, random: &mut Random) -> [[f64; 2]; 2] {
    let (last, third) = (2f64.powi(-50), 1.0 / 3.0);
    let mut below = |n: usize| random.below(n) as f64;
    match family {
        0 => {
            let (slope, from, to) = (below(3), below(20), below(20));
            [[from, slope * from], [to, slope * to]]
        }
        1 => {
            let d = [0; 2].map(|_| below(1000) / 999.0 - 0.5);
            [[third - d[0], 0.7 - d[1]], [third + d[0], 0.7 + d[1]]]
        }
        2 => {
            let at = below(12) + 0.1;
            if below(2) > 0.0 { [[at, -1.0], [at, 13.0]] } else { [[-1.0, at], [13.0, at]] }
        }
        3 => [[1.0 + below(8) * last, 1.0 + below(8) * last], [2.0 + below(8) * last, 1.5 + below(8) * last]],
        _ => [0; 2].map(|_| [0; 2].map(|_| below(12) * third)),
    }
}

#[test]
fn splits_of_nasty_segments_are_those_of_the_judge() {
    let mut random = Random::new(6);
    let scales = [1.0, 2f64.powi(500), 2f64.powi(-500), 1e200, 1e-200];
    let mut crossing_count = 0;
    for round in 0..200 {
        let (family, scale) = (round % 5, scales[round / 5 % 5]);
        let mut points: Points = (0..2 + random.below(14)).flat_map(|_| nasty(family, &mut random)).collect();
        points.iter_mut().flatten().for_each(|x| *x *= scale);
        let segments: Segments = (0..points.len() / 2).map(|i| [2 * i, 2 * i + 1]).collect();
        let c = Constrained2::with_crossings(&points, &segments, Crossings::Split).expect("it ends");
        c.check().expect("canonical");
        let judge = crossings::Split::new(&points, &segments);
        assert_eq!(c.points(), &judge.points[..], "{points:?}");
        let edges: BTreeSet<[usize; 2]> = c.constraints().map(|ends| ends.map(|v| v.index())).collect();
        assert_eq!(edges, judge.edges().into_iter().collect(), "{points:?}");
        assert_eq!((c.report().crossings, c.report().rounds), (judge.crossings, judge.rounds), "{points:?}");
        crossing_count += judge.crossings;
    }
    assert!(crossing_count > 3000, "{crossing_count}");
}

/// The definition of what is inside: what a ray crosses.
#[test]
fn what_is_inside_is_what_rays_say() {
    let mut random = Random::new(3);
    for _ in 0..200 {
        let rings: Vec<Points> = (0..=random.below(4))
            .map(|_| (0..3 + random.below(6)).map(|_| [(); 2].map(|()| random.below(40) as f64)).collect())
            .collect();
        let points: Points = rings.concat();
        let mut sides: Segments = Vec::new();
        let mut ring_of = Vec::new();
        for (number, ring) in rings.iter().enumerate() {
            let first = sides.len();
            sides.extend((0..ring.len()).map(|i| [first + i, first + (i + 1) % ring.len()]));
            ring_of.resize(sides.len(), number);
        }
        // The first ring is a shell, and perhaps the second is one.
        let second = random.below(2);
        let shells: Vec<usize> = (0..rings.len()).map(|ring| ring.min(second)).collect();
        let ring = |s: SegmentId| Some(ring_of[s.index()]);
        let c = Constrained2::with_crossings(&points, &sides, Crossings::Split).expect("it ends");
        // Chains, as the rounding of crossings has bent them.
        let chains: Vec<Vec<[f64; 2]>> = (0..sides.len())
            .filter_map(|s| c.chain(SegmentId::new(s)))
            .map(|chain| chain.into_iter().map(|v| c.point(v)).collect())
            .collect();
        let [even_odd, nonzero, positive, negative] =
            [Fill::EvenOdd, Fill::NonZero, Fill::Positive, Fill::Negative]
                .map(|fill| c.domains(&fill).expect("no seeds"));
        let holed = c.shells_minus_holes(ring, &shells);
        let mut filled_holes = BTreeSet::new();
        for t in c.triangle_ids() {
            let corners = c.mesh().corners(t).map(|v| c.point(v));
            let middle = [0, 1].map(|k| corners.iter().map(|p| p[k]).sum::<f64>() / 3.0);
            if c.area(t) < 1e-6 {
                continue; // its middle may be rounded to beyond its sides
            }
            let (mut crossed, mut winding) = (0, 0);
            let mut is_around = vec![false; rings.len()];
            let links =
                chains.iter().zip(0..).flat_map(|(chain, s)| chain.windows(2).map(move |link| (link, s)));
            for (link, s) in links {
                let [p, q] = [link[0], link[1]];
                let upwards = p[1] <= middle[1] && q[1] > middle[1];
                let downwards = q[1] <= middle[1] && p[1] > middle[1];
                if !(upwards || downwards) {
                    continue;
                }
                let side = delone_predicates::orient2d(p, q, middle);
                if upwards == side.is_positive() {
                    crossed += 1;
                    winding += if upwards { 1 } else { -1 };
                    is_around[ring_of[s]] ^= true;
                }
            }
            assert_eq!(even_odd.is_inside(t), crossed % 2 == 1, "{rings:?}");
            assert_eq!(nonzero.is_inside(t), winding != 0, "{rings:?}");
            assert_eq!(positive.is_inside(t), winding > 0, "{rings:?}");
            assert_eq!(negative.is_inside(t), winding < 0, "{rings:?}");
            let is_hole_around = |r: usize, shell: usize| r != shell && shells[r] == shell && is_around[r];
            let is_left =
                |shell: usize| is_around[shell] && !(0..rings.len()).any(|r| is_hole_around(r, shell));
            let is_in_shells = (0..rings.len()).filter(|&r| shells[r] == r).any(is_left);
            assert_eq!(holed.is_inside(t), is_in_shells, "{rings:?} {shells:?}");
            if winding > 0 && !is_in_shells {
                filled_holes.extend((0..rings.len()).filter(|&r| shells[r] != r && is_around[r]));
            }
        }
        let told = c.filled_holes(&positive, ring, &shells);
        assert!(filled_holes.iter().all(|hole| told.contains(hole)), "{rings:?} {shells:?}");
        assert!(c.filled_holes(&holed, ring, &shells).is_empty());
        let filled =
            Polygons2::default().with_crossings(Crossings::Split).triangulate(&rings).expect("it ends");
        let inside = c.triangle_ids().filter(|&t| even_odd.is_inside(t)).count();
        assert_eq!(filled.triangles.len(), inside);
        if second == 0 {
            let how =
                Polygons2::default().with_crossings(Crossings::Split).with_fill(RingFill::ShellMinusHoles);
            let left = how.triangulate(&rings).expect("it ends");
            assert_eq!(left.triangles.len(), c.triangle_ids().filter(|&t| holed.is_inside(t)).count());
        }
    }
}

/// The inside of a polygon is the same alone as among others.
#[test]
fn what_is_inside_does_not_depend_on_what_is_outside() {
    let mut random = Random::new(4);
    for n in [8, 40, 200] {
        let ring: Points = (0..n)
            .map(|i| {
                let angle = std::f64::consts::TAU * i as f64 / n as f64;
                let radius = 1.0 + random.unit();
                [radius * angle.cos(), radius * angle.sin()]
            })
            .collect();
        let sides: Segments = (0..n).map(|i| [i, (i + 1) % n]).collect();
        let inside = |points: &Points, sides: &Segments| {
            let c = Constrained2::from_parts(points, sides).expect("a simple polygon");
            let domains = c.domains(&Fill::EvenOdd).expect("no seeds");
            let inside = c.triangle_ids().filter(|&t| domains.is_inside(t));
            delone_oracle::brute::normalized(inside.map(|t| c.mesh().corners(t).map(|v| c.point(v))))
        };
        let alone = inside(&ring, &sides);
        let c = Constrained2::from_parts(&ring, &sides).expect("a simple polygon");
        let domains = c.domains(&Fill::EvenOdd).expect("no seeds");
        let mut points = ring.clone();
        while points.len() < 3 * n {
            let q = [random.between(-3.0, 3.0), random.between(-3.0, 3.0)];
            let is_outside = match c.locate(q).expect("finite") {
                delone::Location2::Triangle(t) => !domains.is_inside(t),
                delone::Location2::Outside(_) => true,
                _ => false,
            };
            points.extend(is_outside.then_some(q));
        }
        assert_eq!(inside(&points, &sides), alone);
    }
}
