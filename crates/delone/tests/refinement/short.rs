//! Shortest edges, and gaps that are too narrow to be meant.

use delone::{Constrained2, Error, Fill, Keep, Reason, Refinement};
use delone_generators::Random;

use super::judge::{Points, Segments, refine};

/// Segments that have no point in common, each in a cell of a grid.
fn apart(seed: u64) -> (Points, Segments) {
    let mut random = Random::new(seed);
    let mut point = |x: u32, y: u32| [x, y].map(|cell| f64::from(cell) + random.unit());
    let points = (0..36).flat_map(|k| [point(k % 6, k / 6), point(k % 6, k / 6)]).collect();
    (points, (0..36).map(|k| [2 * k, 2 * k + 1]).collect())
}

fn length([a, b]: [[f64; 2]; 2]) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

#[test]
fn edges_with_a_new_vertex_are_not_shorter() {
    let mut left = 0;
    for seed in 0..6 {
        let (points, segments) = apart(seed);
        for least in [0.0, 0.01, 0.2, 5.0] {
            let how = Refinement::new().min_edge(least);
            for how in
                [how, how.smooth(4), how.edge(0.15), how.edge(0.3).smooth(2), how.keep(Keep::Constraints)]
            {
                let mut c = Constrained2::from_parts(&points, &segments).expect("apart");
                let refined = how.min_angle(33.0).run(&mut c).expect("an end");
                assert_eq!(c.check(), Ok(()));
                let is_new = |v: delone::VertexId| v.index() >= points.len();
                let new = c
                    .mesh()
                    .undirected_edges()
                    .filter(|&e| is_new(c.mesh().origin(e)) || is_new(c.mesh().destination(e)));
                let shortest = new.map(|e| length(c.segment(e))).fold(f64::INFINITY, f64::min);
                assert!(shortest >= least * (1.0 - 1e-15), "{shortest} at {seed}, {least}");
                let short = refined.report.left_for(Reason::Short);
                assert!(least > 0.0 || short == 0);
                left += usize::from(short > 0);
            }
        }
    }
    assert!(left > 15, "{left}");
}

/// Nothing changes where nothing is short.
#[test]
fn a_least_edge_that_is_not_reached_changes_nothing() {
    let (points, segments) = apart(7);
    let made = |how: Refinement| refine(&points, &segments, how, Fill::All, 30.0, "least").0;
    let (plain, least) = (made(Refinement::new()), made(Refinement::new().min_edge(1e-12)));
    assert!(plain.triangles().eq(least.triangles()));
}

#[test]
fn a_least_edge_is_a_length() {
    for least in [-1.0, f64::NAN] {
        let refused = Refinement::new().min_edge(least).run(&mut Constrained2::new());
        assert!(matches!(refused, Err(Error::Parameter { name: "min_edge", .. })));
    }
}

/// The least distance of an end of a segment from another segment, by all pairs.
fn least_distance(points: &Points, segments: &Segments) -> f64 {
    let to = |q: [f64; 2], [a, b]: [[f64; 2]; 2]| {
        let (u, w) = ([b[0] - a[0], b[1] - a[1]], [q[0] - a[0], q[1] - a[1]]);
        let part = ((u[0] * w[0] + u[1] * w[1]) / (u[0] * u[0] + u[1] * u[1])).clamp(0.0, 1.0);
        length([q, [a[0] + part * u[0], a[1] + part * u[1]]])
    };
    let ends = |s: &[usize; 2]| s.map(|i| points[i]);
    let others = |k: usize| segments.iter().enumerate().filter(move |&(other, _)| other != k);
    let of = |k: usize| others(k).flat_map(move |(_, s)| ends(&segments[k]).map(|q| to(q, ends(s))));
    (0..segments.len()).flat_map(of).fold(f64::INFINITY, f64::min)
}

#[test]
fn the_narrowest_gap_is_that_of_all_pairs() {
    for seed in 0..300 {
        let (points, segments) = apart(seed);
        let c = Constrained2::from_parts(&points, &segments).expect("apart");
        let gap = c.narrowest_gap(&c.domains(&Fill::All).expect("parts")).expect("a gap");
        let least = least_distance(&points, &segments);
        assert!((gap.width - least).abs() < 1e-14, "{} and {least} at {seed}", gap.width);
        let [one, other] = gap.segments.map(|s| segments[s.index()].map(|i| points[i]));
        assert!(other.contains(&gap.at) && one != other);
        let pair = vec![segments[gap.segments[0].index()], segments[gap.segments[1].index()]];
        assert!((least_distance(&points, &pair) - least).abs() < 1e-14);
        // A function of the set: order and directions change nothing.
        let reversed: Segments = segments.iter().rev().map(|&[v, w]| [w, v]).collect();
        let again = Constrained2::from_parts(&points, &reversed).expect("apart");
        let other = again.narrowest_gap(&again.domains(&Fill::All).expect("parts")).expect("a gap");
        assert_eq!((gap.width, gap.at, gap.part), (other.width, other.at, other.part));
        assert_eq!(gap.segments.map(|s| 35 - s.index()), other.segments.map(|s| s.index()));
    }
}

#[test]
fn corners_are_no_gaps() {
    let ring = |points: Points| {
        let n = points.len();
        let sides: Segments = (0..n).map(|i| [i, (i + 1) % n]).collect();
        let c = Constrained2::from_parts(&points, &sides).expect("a ring");
        c.narrowest_gap(&c.domains(&Fill::EvenOdd).expect("parts"))
    };
    let thin = ring(vec![[0.0, 0.0], [1.0, 0.0], [1.0 + 1e-9, 1e-9]]); // a small angle, and a short side
    assert!(thin.is_none_or(|gap| gap.width > 1e-9), "{thin:?}");
    let square = ring(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    assert!(square.is_none_or(|gap| !gap.is_tiny()));
    let notch = ring(vec![
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [0.5 + 1e-9, 1.0],
        [0.5, 1e-8],
        [0.5 - 1e-9, 1.0],
        [0.0, 1.0],
    ]);
    let gap = notch.expect("above the lower side");
    assert!(gap.is_tiny() && gap.width == 1e-8);
    assert_eq!(gap.exponent(), -7);
    let strip = ring(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1e-9], [0.0, 1e-9]]).expect("a strip");
    assert!(strip.is_tiny() && strip.width == 1e-9);
}

#[test]
fn the_exponent_is_of_twice_the_width() {
    for (y, exponent) in [(0.5, 0), (0.05, -1), (0.06, 0), (5e-7, -6), (3e-9, -8)] {
        let points = [[0.0, 0.0], [1.0, 0.0], [0.5, y], [0.5, 9.0]];
        let c = Constrained2::from_parts(&points, &[[0, 1], [2, 3]]).expect("two segments");
        let gap = c.narrowest_gap(&c.domains(&Fill::All).expect("parts")).expect("a gap");
        assert_eq!((gap.width, gap.exponent()), (y, exponent));
    }
}

/// A hub has many segments; no vertex looks at all of them. Gaps of normal width are not looked for.
#[test]
fn hubs_and_rings_have_no_tiny_gap() {
    let n = 20_000;
    let angle = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
    let around: Points = (0..n).map(|i| [angle(i).cos(), angle(i).sin()]).collect();
    let hub: Points = around.iter().copied().chain([[0.0, 0.0]]).collect();
    let spokes: Segments = (0..n).map(|i| [n, i]).collect();
    let ring: Segments = (0..n).map(|i| [i, (i + 1) % n]).collect();
    for segments in [&spokes, &ring, &[&spokes[..], &ring[..]].concat()] {
        let c = Constrained2::from_parts(&hub, segments).expect("planar");
        assert_eq!(c.tiny_gap(&c.domains(&Fill::All).expect("parts")), None);
    }
}

/// Widths and segments at all scales, as nothing is squared.
#[test]
fn gaps_have_all_scales() {
    for scale in [1.0, 2.0_f64.powi(660), 2.0_f64.powi(-660)] {
        let points =
            [[0.0, 0.0], [1.0, 0.0], [0.5, 1e-9], [0.5, 9.0]].map(|p: [f64; 2]| p.map(|x| x * scale));
        let c = Constrained2::from_parts(&points, &[[0, 1], [2, 3]]).expect("two segments");
        let gap = c.tiny_gap(&c.domains(&Fill::All).expect("parts")).expect("a gap");
        assert_eq!((gap.width, gap.segments.map(|s| s.index())), (1e-9 * scale, [0, 1]));
    }
}
