//! Constrained triangulations: one set of points and segments, one triangulation.

use std::collections::BTreeSet;

use delone::{Constrained2, Crossings, Error, Fill, SegmentEnds, SegmentId, VertexId};
use delone_generators::{Kind, Random};

type Points = Vec<[f64; 2]>;
type Segments = Vec<[usize; 2]>;

/// The triangles by coordinates, each from its least corner on, sorted.
fn triangles(c: &Constrained2) -> Vec<[[f64; 2]; 3]> {
    let mut all: Vec<_> = c
        .triangles()
        .map(|t| {
            let mut corners = t.map(|v| c.point(v));
            let least = (0..3).min_by(|&i, &j| corners[i].partial_cmp(&corners[j]).expect("finite"));
            corners.rotate_left(least.expect("three"));
            corners
        })
        .collect();
    all.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
    all
}

/// Random segments that cross none before them.
fn planar(points: &[[f64; 2]], tries: usize, random: &mut Random) -> Segments {
    let mut c = Constrained2::from_parts(points, &[]).expect("no segments");
    let mut kept = Vec::new();
    for _ in 0..tries {
        let ends = [random.below(points.len()), random.below(points.len())];
        let vertex = |i: usize| {
            let same = c.duplicates().find(|d| d.point == i).map(|d| d.vertex);
            same.unwrap_or(VertexId::new(i))
        };
        let [v, w] = ends.map(vertex);
        match c.insert_segment(v, w) {
            Ok(_) | Err(Error::NoLength { .. }) => kept.push(ends),
            Err(Error::SegmentsCross { .. }) => {}
            Err(other) => panic!("{other}"),
        }
        c.check().expect("canonical");
    }
    kept
}

fn shuffled(points: &[[f64; 2]], segments: &[[usize; 2]], random: &mut Random) -> (Points, Segments) {
    let mut order: Vec<usize> = (0..points.len()).collect();
    for i in (1..order.len()).rev() {
        order.swap(i, random.below(i + 1));
    }
    let mut place = vec![0; points.len()];
    order.iter().enumerate().for_each(|(new, &old)| place[old] = new);
    let points = order.iter().map(|&i| points[i]).collect();
    let mut segments: Segments = segments.iter().map(|ends| ends.map(|i| place[i])).collect();
    for i in (1..segments.len()).rev() {
        segments.swap(i, random.below(i + 1));
        if random.below(2) == 0 {
            segments[i].reverse();
        }
    }
    (points, segments)
}

#[test]
fn order_and_direction_do_not_show() {
    let mut random = Random::new(1);
    for &kind in Kind::ALL {
        for n in [3, 6, 12, 40] {
            let points = kind.points(n, 5);
            let segments = planar(&points, 2 * n, &mut random);
            let c = Constrained2::from_parts(&points, &segments).expect("nothing crosses");
            c.check().expect("canonical");
            let expected = triangles(&c);
            for _ in 0..3 {
                let (p, s) = shuffled(&points, &segments, &mut random);
                let other = Constrained2::from_parts(&p, &s).expect("nothing crosses");
                other.check().expect("canonical");
                assert_eq!(triangles(&other), expected, "{} {n}", kind.name());
            }
        }
    }
}

#[test]
fn long_segments_among_many_points() {
    let mut random = Random::new(7);
    for kind in [Kind::Uniform, Kind::Grid, Kind::Circle, Kind::Parabola, Kind::Clusters, Kind::HugeSpan] {
        let points = kind.points(600, 3);
        let segments = planar(&points, 150, &mut random);
        let c = Constrained2::from_parts(&points, &segments).expect("nothing crosses");
        c.check().expect("canonical");
        let (p, s) = shuffled(&points, &segments, &mut random);
        let other = Constrained2::from_parts(&p, &s).expect("nothing crosses");
        assert_eq!(triangles(&other), triangles(&c), "{}", kind.name());
    }
}

#[test]
fn what_is_taken_away_has_never_been() {
    let mut random = Random::new(11);
    for &kind in Kind::ALL {
        let points = kind.points(40, 2);
        let plain = Constrained2::from_parts(&points, &[]).expect("no segments");
        let segments = planar(&points, 60, &mut random);
        let mut c = Constrained2::from_parts(&points, &segments).expect("nothing crosses");
        let ids: Vec<SegmentId> = c.segments().map(|(s, _)| s).collect();
        for s in ids {
            c.remove_segment(s).expect("there");
            c.check().expect("canonical");
        }
        assert_eq!(triangles(&c), triangles(&plain), "{}", kind.name());
    }
}

/// Points and segments come and go among some points; after each step it is proved, and now and then compared with a
/// construction of the same.
fn live(name: &str, points: &[[f64; 2]], steps: usize, random: &mut Random) {
    let mut c = Constrained2::new();
    for step in 0..steps {
        let vertices: Vec<VertexId> = c.vertices().collect();
        let any = |random: &mut Random| vertices[random.below(vertices.len())];
        match random.below(8) {
            _ if vertices.len() < 4 => _ = c.insert(points[random.below(points.len())]).expect("finite"),
            0..3 => _ = c.insert(points[random.below(points.len())]).expect("finite"),
            3 | 4 => _ = c.insert_segment(any(random), any(random)),
            5 => {
                let ids: Vec<SegmentId> = c.segments().map(|(s, _)| s).collect();
                if !ids.is_empty() {
                    c.remove_segment(ids[random.below(ids.len())]).expect("there");
                }
            }
            6 => {
                let ends = [SegmentEnds::Refuse, SegmentEnds::Join, SegmentEnds::Drop][random.below(3)];
                _ = c.remove_with(any(random), ends);
            }
            _ => {
                // In the middle of a constraint.
                let segments: Vec<_> = c.segments().collect();
                if let Some(&(_, [v, w])) = segments.get(random.below(segments.len() + 1)) {
                    let [p, q] = [c.point(v), c.point(w)];
                    c.insert([0, 1].map(|k| p[k] / 2.0 + q[k] / 2.0)).expect("finite");
                }
            }
        }
        if let Err(flaw) = c.check() {
            panic!("{name} step {step}: {flaw}");
        }
        if step % 10 == 0 {
            let alive: Vec<VertexId> = c.vertices().collect();
            let place = |v: VertexId| alive.binary_search(&v).expect("a vertex");
            let p: Points = alive.iter().map(|&v| c.point(v)).collect();
            let s: Segments = c.segments().map(|(_, ends)| ends.map(place)).collect();
            let anew = Constrained2::from_parts(&p, &s).expect("nothing crosses");
            assert_eq!(triangles(&c), triangles(&anew), "{name} step {step}");
        }
    }
}

#[test]
fn lives() {
    let mut random = Random::new(3);
    for &kind in Kind::ALL {
        live(kind.name(), &kind.points(60, 4), 300, &mut random);
    }
}

/// A million changes of small sets.
#[test]
#[ignore = "long: .ci/run --long"]
fn long_lives() {
    let mut random = Random::new(17);
    let mut done = 0;
    while done < 1_000_000 {
        let kind = Kind::ALL[random.below(Kind::ALL.len())];
        let points = kind.points(5 + random.below(25), random.bits());
        live(kind.name(), &points, 1000, &mut random);
        done += 1000;
    }
}

#[test]
fn crossings_are_named_or_split() {
    let points = [[0, 0], [4, 4], [0, 4], [4, 0], [2, 7], [2, -7], [9, 9]];
    let segments = [[6, 1], [0, 1], [2, 3], [4, 5]];
    let refused = Constrained2::from_parts(&points, &segments).expect_err("they cross");
    assert_eq!(refused, Error::SegmentsCross { first: 1, second: 2, near: [2.0, 2.0], count: 3 });
    let c = Constrained2::with_crossings(&points, &segments, Crossings::Split).expect("split");
    c.check().expect("canonical");
    assert_eq!((c.report().crossings, c.report().added_points), (3, 1));
    assert_eq!(c.chain(SegmentId::new(1)).map(|v| v.len()), Some(3));
}

#[test]
fn splitting_ends_and_does_not_depend_on_order() {
    let mut random = Random::new(5);
    for scale in [1.0, 1e-300, 1e300, f64::EPSILON] {
        for side in [4, 24, 1000] {
            for _ in 0..20 {
                let offset = if scale == f64::EPSILON { 1.0 } else { 0.0 };
                let mut coordinate = || offset + scale * random.below(side) as f64;
                let points: Points = (0..30).map(|_| [coordinate(), coordinate()]).collect();
                let segments: Segments = (0..30).map(|_| [random.below(30), random.below(30)]).collect();
                let split = |p: &Points, s: &Segments| {
                    let c = Constrained2::with_crossings(p, s, Crossings::Split).expect("it ends");
                    c.check().expect("canonical");
                    c
                };
                let c = split(&points, &segments);
                let (p, s) = shuffled(&points, &segments, &mut random);
                let other = split(&p, &s);
                assert_eq!(triangles(&c), triangles(&other));
                let constraints = |c: &Constrained2| -> BTreeSet<_> {
                    c.constraints()
                        .map(|ends| {
                            let mut ends =
                                ends.map(|v| c.point(v).map(|x| if x == 0.0 { 0 } else { x.to_bits() }));
                            ends.sort_unstable();
                            ends
                        })
                        .collect()
                };
                assert_eq!(constraints(&c), constraints(&other));
            }
        }
    }
}

/// Segments across curves, whose sides are long and have their apexes at the ends.
#[test]
fn long_channels_are_no_trouble() {
    for n in [100, 1000, 20_000] {
        // Two parabolas bent towards each other, and a segment between them.
        let curve = |i: usize, sign: f64| {
            let x = i as f64 - n as f64 / 2.0;
            [x, sign * (x * x / n as f64 + 1.0)]
        };
        let mut points: Points = (0..n).flat_map(|i| [curve(i, 1.0), curve(i, -1.0)]).collect();
        points.extend([[-(n as f64), 0.0], [n as f64, 0.0]]);
        let segments = [[2 * n, 2 * n + 1]];
        let c = Constrained2::from_parts(&points, &segments).expect("nothing crosses");
        c.check().expect("canonical");
        assert_eq!(c.constraints().count(), 1);
        let mut other = Constrained2::from_parts(&points, &[]).expect("no segments");
        let [v, w] = segments[0].map(VertexId::new);
        other.insert_segment(v, w).expect("nothing crosses");
        assert_eq!(triangles(&other), triangles(&c));
    }
}

/// Without regard to cells, pieces of these grow from round to round, or a crossing moves by a power of two in each.
#[test]
fn splits_of_what_nearly_coincides_end_soon() {
    let third = 1.0 / 3.0;
    let coincide = [
        [[28.0 * third, -10.0], [14.0 * third, -3.0]],
        [[6.0, -5.0], [4.0 * third, 2.0]],
        [[28.0 * third, -10.0], [2.0 * third, 3.0]],
        [[6.0, -5.0], [2.0 * third, 3.0]],
        [[14.0 * third, -3.0], [4.0 * third, 2.0]],
    ];
    let near_zero = [[[4.0, 2.0], [1e-200, -2.0]], [[-2.0, -4.0], [4.0, 2.0]], [[4.0, 4.0], [1e-200, -2.0]]];
    for (segments, most) in [(&coincide[..], 2), (&near_zero[..], 2)] {
        let points: Points = segments.concat();
        let ends: Segments = (0..segments.len()).map(|s| [2 * s, 2 * s + 1]).collect();
        let c = Constrained2::with_crossings(&points, &ends, Crossings::Split).expect("it ends");
        c.check().expect("canonical");
        assert!(c.report().rounds <= most, "{:?}", c.report());
    }
}

/// A point exactly on a segment: given whole or in two pieces, it is split alike.
#[test]
fn splits_do_not_depend_on_the_pieces_of_a_segment() {
    let points = [[0.0, 0.0], [1.0, 3.0], [2.0, 6.0], [0.1, 0.3], [1.0, 4.0], [2.0, 4.0]];
    let split = |segments: &[[usize; 2]]| {
        let c = Constrained2::with_crossings(&points, segments, Crossings::Split).expect("it ends");
        let edges: BTreeSet<_> = c.constraints().map(|ends| ends.map(|v| v.index())).collect();
        (triangles(&c), edges)
    };
    assert_eq!(split(&[[0, 2], [4, 5]]), split(&[[0, 1], [1, 2], [4, 5]]));
}

#[test]
fn a_radius_from_beyond_the_hull_finds_all() {
    for (points, q, radius, expected) in [
        (vec![[0.0, 0.0], [1.0, 2.0], [1.0, 3.0]], [2.0, 3.0], 1.0, 2),
        (vec![[0.0, 0.0], [0.0, 1.0], [1.0, 3.0]], [-1.0, 3.0], 2.0, 2),
    ] {
        let c = Constrained2::from_parts(&points, &[]).expect("no segments");
        let found = c.within(q, radius).expect("finite");
        assert_eq!(found.iter().map(|v| v.index()).collect::<Vec<_>>(), [expected]);
    }
}

#[test]
fn a_drop_is_all_or_nothing() {
    let points = [[0, 0], [2, 2], [0, 2], [2, 0], [1, 1], [1, 3]];
    let mut c = Constrained2::from_parts(&points, &[[0, 1], [2, 3], [4, 5]]).expect("they meet at a point");
    let refused = c.remove_with(VertexId::new(4), SegmentEnds::Drop);
    assert_eq!(refused, Err(Error::ConstraintsEnd { vertex: VertexId::new(4), count: 3 }));
    assert_eq!(c.segments().count(), 3);
}

/// Where depth depends on the way, neither order nor history decides.
#[test]
fn parts_of_open_chains_do_not_depend_on_history() {
    let points = [[0, 0], [3, 0], [0, 3]];
    for side in [[0, 1], [1, 2], [2, 0]] {
        let mut c = Constrained2::from_parts(&points, &[side]).expect("one segment");
        let inside = |c: &Constrained2| {
            let domains = c.domains(&delone::Fill::EvenOdd).expect("no seeds");
            c.triangle_ids().filter(|&t| domains.is_inside(t)).count()
        };
        assert_eq!(inside(&c), 0);
        for q in [[-1, -1], [5, 5], [6, -2]] {
            let v = c.insert(q).expect("finite").vertex();
            c.remove(v).expect("no segment ends there");
            assert_eq!(inside(&c), 0);
        }
    }
}

/// Intervals on lines in three directions, which meet only where all of them do: at no inner point of any.
#[test]
fn reports_count_what_pairs_of_segments_share() {
    let mut random = Random::new(5);
    let mut counted = [0; 3];
    for round in 0..300 {
        let count = 2 + random.below(20);
        let directions = [[1, 0], [0, 1], [2, 3]];
        let mut points: Vec<[i32; 2]> = Vec::new();
        for (line, [x, y]) in directions.into_iter().enumerate() {
            points.extend(
                (1..=count as i32).map(|i| [x * i, (y * i) + if line == 2 { 0 } else { line as i32 - 1 }]),
            );
        }
        let segments: Vec<[usize; 2]> = (0..random.below(30))
            .map(|_| {
                let line = count * random.below(3);
                [line + random.below(count), line + random.below(count)]
            })
            .collect();
        let interval = |s: &[usize; 2]| [s[0].min(s[1]), s[0].max(s[1])];
        let share = |s: &[usize; 2], t: &[usize; 2]| {
            let ([a, b], [c, d]) = (interval(s), interval(t));
            s[0] / count == t[0] / count && a.max(c) < b.min(d)
        };
        let real: Vec<[usize; 2]> = segments.iter().copied().filter(|s| s[0] != s[1]).collect();
        let mut distinct: Vec<[usize; 2]> = real.iter().map(interval).collect();
        distinct.sort_unstable();
        distinct.dedup();
        let overlaps = |s: &&[usize; 2]| real.iter().any(|t| interval(t) != interval(s) && share(s, t));
        let c = Constrained2::from_parts(&points, &segments).expect("nothing crosses");
        c.check().expect("canonical");
        let report = c.report();
        assert_eq!(report.zero_length, segments.len() - real.len(), "round {round}");
        assert_eq!(report.repeated, real.len() - distinct.len(), "round {round}: {segments:?}");
        assert_eq!(report.overlapping, real.iter().filter(overlaps).count(), "round {round}: {segments:?}");
        let through = real.iter().filter(|s| s[0].abs_diff(s[1]) > 1).count();
        assert_eq!(report.through_vertices, through, "round {round}: {segments:?}");
        counted = [0, 1, 2].map(|k| counted[k] + [report.repeated, report.overlapping, through][k]);
    }
    assert!(counted.iter().all(|&count| count > 100), "{counted:?}");
}

/// Each within the one after it, on one line: as many steps as segments, where edges met would be ten thousand million.
/// Both ends of a segment that comes again and again are hubs: each time their stars are looked at would be too often.
#[test]
fn a_segment_between_hubs_comes_fifty_thousand_times() {
    let n = 50_000;
    let around = |k: usize| (std::f64::consts::PI * (0.5 + k as f64 / n as f64)).sin_cos();
    let fan = (1..n).map(around).flat_map(|(y, x)| [[x, y], [0.5 - x, y]]);
    let points: Vec<[f64; 2]> = [[0.0, 0.0], [0.5, 0.0]].into_iter().chain(fan).collect();
    let segments: Vec<[usize; 2]> = (0..n).map(|k| if k % 2 == 0 { [0, 1] } else { [1, 0] }).collect();
    let c = Constrained2::from_parts(&points, &segments).expect("nothing crosses");
    assert_eq!((c.constraints().count(), c.report().repeated), (1, n - 1));
    c.check().expect("canonical");
    // From the top on the left to the bottom on the right.
    let crossing: Vec<[usize; 2]> = [[2, points.len() - 1]].into_iter().chain(segments).collect();
    let refused = Constrained2::from_parts(&points, &crossing);
    assert!(matches!(refused, Err(Error::SegmentsCross { count, .. }) if count == n));
}

#[test]
fn a_hundred_thousand_nested_segments() {
    let n = 100_000;
    let points: Vec<[f64; 2]> = (0..2 * n).map(|i| [i as f64, 0.5 * i as f64]).chain([[0.0, 1e6]]).collect();
    let segments: Vec<[usize; 2]> = (0..n).map(|i| [n - 1 - i, n + i]).collect();
    let c = Constrained2::from_parts(&points, &segments).expect("nothing crosses");
    assert_eq!(c.constraints().count(), 2 * n - 1);
    assert_eq!((c.report().overlapping, c.report().through_vertices), (n, n - 1));
    c.check().expect("canonical");
    assert_eq!(c.domains(&Fill::EvenOdd).expect("no seeds").parts().len(), 1);
}
