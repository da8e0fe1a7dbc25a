//! Welding against its definition, over integers.

use std::collections::BTreeSet;

use delone::{Error, Weld2};
use delone_generators::Random;

type Place = [i64; 2];

fn minus(p: Place, q: Place) -> Place {
    [p[0] - q[0], p[1] - q[1]]
}

fn dot(p: Place, q: Place) -> i64 {
    p[0] * q[0] + p[1] * q[1]
}

fn squared(p: Place, q: Place) -> i64 {
    dot(minus(p, q), minus(p, q))
}

/// Whether a vertex is at most so far from a segment that is the longest side of the triangle with it.
fn is_part(v: Place, [a, b]: [Place; 2], tolerance: i64) -> bool {
    let (d, e) = (minus(b, a), minus(v, a));
    let length = dot(d, d);
    let area = d[0] * e[1] - d[1] * e[0];
    let is_beside = dot(d, e) > 0 && dot(d, e) < length;
    is_beside
        && area * area <= tolerance * tolerance * length
        && squared(v, a) < length
        && squared(v, b) < length
}

fn floats(points: &[Place], scale: f64) -> Vec<[f64; 2]> {
    points.iter().map(|p| p.map(|x| x as f64 * scale)).collect()
}

/// The chain of each segment by places.
fn chains(welded: &Weld2, points: &[Place], count: usize) -> Vec<Vec<Place>> {
    let mut chains = vec![Vec::new(); count];
    for (&[v, w], &segment) in welded.segments.iter().zip(&welded.origins) {
        let chain: &mut Vec<Place> = &mut chains[segment];
        if chain.is_empty() {
            chain.push(points[v]);
        }
        assert_eq!(chain.last(), Some(&points[v]), "pieces follow each other");
        chain.push(points[w]);
    }
    chains
}

#[test]
fn what_is_near_is_one_and_nothing_else_moves() {
    let mut random = Random::new(58);
    let mut met = [0; 4];
    for round in 0..1500 {
        let count = 2 + random.below(24);
        let width = [6, 20, 60, 400][round % 4];
        let tolerance = [0, 1, 2, 5, 30][round % 5];
        let points: Vec<Place> = (0..count).map(|_| [(); 2].map(|()| random.below(width) as i64)).collect();
        let segments: Vec<[usize; 2]> =
            (0..random.below(20)).map(|_| [(); 2].map(|()| random.below(count))).collect();
        let weld = |points: &[Place], segments: &[[usize; 2]]| {
            Weld2::new(&floats(points, 1.0), segments, tolerance as f64).expect("finite")
        };
        let welded = weld(&points, &segments);
        // Vertices.
        let staying: BTreeSet<Place> = welded.stays.iter().map(|&i| points[i]).collect();
        let mut largest = 0;
        for (i, &to) in welded.stays.iter().enumerate() {
            assert_eq!(welded.stays[to], to);
            let way = squared(points[i], points[to]);
            assert!(way <= tolerance * tolerance && staying.iter().all(|&p| squared(points[i], p) >= way));
            largest = largest.max(way);
        }
        assert_eq!(welded.largest_move, (largest as f64).sqrt());
        for p in &staying {
            assert!(staying.iter().all(|q| p == q || squared(*p, *q) > tolerance * tolerance));
        }
        // Segments.
        let found = chains(&welded, &points, segments.len());
        for (ends, chain) in segments.iter().zip(&found) {
            let ends = ends.map(|i| points[welded.stays[i]]);
            assert!(if ends[0] == ends[1] { chain.is_empty() } else { chain.first() == Some(&ends[0]) });
            assert!(chain.is_empty() || chain.last() == Some(&ends[1]));
            for link in chain.windows(2) {
                let link = [link[0], link[1]];
                assert!(!staying.iter().any(|&v| is_part(v, link, tolerance)), "{points:?} {link:?}");
                for &v in staying.iter().filter(|v| !link.contains(v)) {
                    let (d, e) = (minus(link[1], link[0]), minus(v, link[0]));
                    let area = d[0] * e[1] - d[1] * e[0];
                    let is_beside = dot(d, e) > 0 && dot(d, e) < dot(d, d);
                    assert!(!is_beside || 2 * area * area >= tolerance * tolerance * dot(d, d));
                }
            }
        }
        met[0] += welded.moved;
        met[1] += welded.bends;
        met[2] += welded.collapsed;
        // Once more.
        let again = weld(&points, &welded.segments);
        assert_eq!((again.stays, again.segments), (welded.stays.clone(), welded.segments.clone()));
        // In another order, with segments in the other direction.
        let mut order: Vec<usize> = (0..count).collect();
        (1..count).for_each(|i| order.swap(i, random.below(i + 1)));
        let mut position = vec![0; count];
        order.iter().enumerate().for_each(|(to, &from)| position[from] = to);
        let moved: Vec<Place> = order.iter().map(|&i| points[i]).collect();
        let turned: Vec<[usize; 2]> = segments.iter().map(|&[v, w]| [position[w], position[v]]).collect();
        let other = weld(&moved, &turned);
        let mut back = chains(&other, &moved, segments.len());
        back.iter_mut().for_each(|chain| chain.reverse());
        assert_eq!(back, found);
        // At other scales.
        for exponent in [-600, 300, 900] {
            let scale = 2.0_f64.powi(exponent);
            let scaled = Weld2::new(&floats(&points, scale), &segments, tolerance as f64 * scale);
            let scaled = scaled.expect("finite");
            assert_eq!((&scaled.stays, &scaled.segments), (&welded.stays, &welded.segments));
            assert!((scaled.largest_move / scale - welded.largest_move).abs() < 1e-9);
            met[3] += 1;
        }
    }
    assert!(met.iter().all(|&count| count > 1000), "{met:?}");
}

#[test]
fn a_tolerance_larger_than_the_set_leaves_one_point() {
    let points: Vec<[f64; 2]> = (0..20_000).map(|i| [f64::from(i % 141), f64::from(i / 141)]).collect();
    let segments: Vec<[usize; 2]> = (0..19_999).map(|i| [i, i + 1]).collect();
    let welded = Weld2::new(&points, &segments, 1e3).expect("finite");
    assert!(welded.stays.iter().all(|&i| i == 0) && welded.segments.is_empty());
    assert_eq!((welded.moved, welded.collapsed), (19_999, 19_999));
}

#[test]
fn nearly_equal_rings_become_one() {
    let ring =
        |k: usize| (0..12).map(move |i| (f64::from(i) * std::f64::consts::FRAC_PI_6, 1.0 + k as f64 * 1e-9));
    let points: Vec<[f64; 2]> = (0..1000).flat_map(ring).map(|(t, r)| [r * t.cos(), r * t.sin()]).collect();
    let segments: Vec<[usize; 2]> = (0..12_000).map(|i| [i, i / 12 * 12 + (i + 1) % 12]).collect();
    let welded = Weld2::new(&points, &segments, 1e-5).expect("finite");
    let staying: BTreeSet<usize> = welded.stays.iter().copied().collect();
    assert_eq!((staying.len(), welded.segments.len(), welded.collapsed), (12, 12_000, 0));
    assert!(welded.largest_move < 1e-5);
}

/// Each piece is looked for in halves: neither time nor memory is the square of the count.
#[test]
fn many_vertices_on_one_segment() {
    let count = 100_000;
    let mut points: Vec<[f64; 2]> = (0..count).map(|i| [f64::from(i), f64::from(i % 7) * 0.01]).collect();
    points.extend([[-1.0, 0.0], [f64::from(count), 0.0]]);
    let ends = [points.len() - 2, points.len() - 1];
    let welded = Weld2::new(&points, &[ends], 0.1).expect("finite");
    assert_eq!((welded.bends, welded.segments.len(), welded.moved), (100_000, 100_001, 0));
}

#[test]
fn bad_input_is_named() {
    let points = [[0.0, 0.0], [1.0, 0.0]];
    for tolerance in [-1.0, f64::NAN, f64::INFINITY] {
        let error = Weld2::new(&points, &[[0, 1]], tolerance).expect_err("no distance");
        assert!(matches!(error, Error::Parameter { name: "tolerance", .. }));
    }
    assert!(matches!(
        Weld2::new(&points, &[[0, 2]], 0.1),
        Err(Error::NoSuchPoint { segment: 0, index: 2, count: 2 })
    ));
    assert!(matches!(Weld2::new(&[[f64::NAN, 0.0]], &[], 0.1), Err(Error::NotFinite { .. })));
    let extreme = [[-1.7e308, 0.0], [1.7e308, 1e-320], [0.0, 5e-324], [5e-324, 0.0]];
    let welded = Weld2::new(&extreme, &[[0, 1], [2, 3]], 1e308).expect("finite");
    assert_eq!(welded.segments.len(), 2);
    assert_eq!(Weld2::new::<[f64; 2]>(&[], &[], 0.0).expect("nothing"), Weld2::default());
}
