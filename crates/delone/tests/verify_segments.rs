//! Judging constrained triangulations from elsewhere: what is right passes whatever its order, and every change is noticed.

use delone::verify::{Objection2, verify_constrained2, verify2};
use delone::{Constrained2, Crossings, Error};
use delone_generators::{Graph, Random};

fn triangles(c: &Constrained2) -> Vec<[u64; 3]> {
    c.triangles().map(|t| t.map(|v| v.index() as u64)).collect()
}

type Built = (Vec<[f64; 2]>, Vec<[usize; 2]>, Vec<[u64; 3]>);

fn built(graph: Graph, n: usize) -> Built {
    let (points, segments) = graph.parts(n, 5);
    let c = Constrained2::from_parts(&points, &segments).expect("planar");
    (points, segments, triangles(&c))
}

#[test]
fn what_is_built_is_canonical() {
    let mut random = Random::new(3);
    for &graph in Graph::ALL.iter().filter(|graph| graph.is_planar()) {
        for n in [3, 30, 400] {
            let (points, segments, mut mesh) = built(graph, n);
            random.shuffle(&mut mesh);
            for (i, t) in mesh.iter_mut().enumerate() {
                t.rotate_left(i % 3);
                if i % 2 == 0 {
                    t.swap(0, 1);
                }
            }
            let verdict = verify_constrained2(&points, &segments, &mesh);
            let verdict = verdict.unwrap_or_else(|objection| panic!("{} {n}: {objection}", graph.name()));
            assert!(verdict.is_canonical(), "{} {n}: {verdict:?}", graph.name());
            assert_eq!(verdict.negative, mesh.len().div_ceil(2));
        }
    }
}

#[test]
fn split_segments_are_judged_by_their_pieces() {
    let (points, segments) = Graph::Crossing.parts(200, 1);
    let c = Constrained2::with_crossings(&points, &segments, Crossings::Split).expect("split");
    let pieces: Vec<[usize; 2]> = c.constraints().map(|ends| ends.map(|v| v.index())).collect();
    let verdict = verify_constrained2(c.points(), &pieces, &triangles(&c)).expect("right");
    assert!(verdict.is_canonical());
    // The segments as they were cross: no triangulation has them all.
    let whole = verify_constrained2(
        &points,
        &segments,
        &triangles(&Constrained2::from_parts(&points, &[]).expect("none")),
    );
    assert!(matches!(whole, Err(Objection2::Segment { .. })), "{whole:?}");
}

#[test]
fn every_flip_is_noticed() {
    for &graph in Graph::ALL.iter().filter(|graph| graph.is_planar()) {
        let (points, segments, mesh) = built(graph, 40);
        let mut flips = 0;
        for i in 0..mesh.len() {
            for j in 0..i {
                let common: Vec<u64> = mesh[i].iter().copied().filter(|v| mesh[j].contains(v)).collect();
                let &[a, b] = &common[..] else { continue };
                let apex = |t: usize| mesh[t].iter().copied().find(|v| !common.contains(v)).expect("three");
                let mut other = mesh.clone();
                (other[i], other[j]) = ([a, apex(i), apex(j)], [b, apex(i), apex(j)]);
                let verdict = verify_constrained2(&points, &segments, &other);
                let is_canonical = verdict.as_ref().is_ok_and(|verdict| verdict.is_canonical());
                assert!(!is_canonical, "{}: {a} {b}: {verdict:?}", graph.name());
                flips += 1;
            }
        }
        assert!(flips >= 20, "{}", graph.name());
    }
}

#[test]
fn culprits_are_named() {
    // A long thin quadrilateral whose constraint is its long diagonal.
    let points = [[0.0, 0.0], [8.0, 0.0], [4.0, 1.0], [4.0, -1.0]];
    let (with, without) = ([[0, 1, 2], [0, 3, 1]], [[0, 3, 2], [3, 1, 2]]);
    assert!(verify_constrained2(&points, &[[1, 0]], &with).expect("right").is_canonical());
    assert!(matches!(verify2(&points, &with), Err(Objection2::Circle { .. })));
    assert_eq!(verify_constrained2(&points, &[], &without), verify2(&points, &without));
    assert_eq!(
        verify_constrained2(&points, &[[2, 0], [0, 1]], &without),
        Err(Objection2::Segment { segment: 1, point: 0 })
    );
    assert_eq!(
        verify_constrained2(&points, &[[0, 4]], &with),
        Err(Objection2::Points(Error::NoSuchPoint { segment: 0, index: 4, count: 4 }))
    );
    // A tie that is divided in the other way, unless it is a constraint that divides it.
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let halves = [[[0, 1, 2], [0, 2, 3]], [[0, 1, 3], [1, 2, 3]]];
    let canonical =
        halves.map(|half| verify_constrained2(&square, &[], &half).expect("Delaunay").is_canonical());
    assert_ne!(canonical[0], canonical[1]);
    for (half, diagonal) in halves.iter().zip([[0, 2], [1, 3]]) {
        assert!(verify_constrained2(&square, &[diagonal], half).expect("right").is_canonical());
    }
}

#[test]
fn segments_run_through_vertices_and_end_at_duplicates() {
    let points = [[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [1.0, 9.0], [1.0, -9.0], [3.0, 0.0], [0.0, 0.0]];
    let c = Constrained2::from_parts(&points, &[[5, 6], [2, 2], [2, 5]]).expect("planar");
    let mesh = triangles(&c);
    for segments in [[[5, 6], [2, 2]], [[0, 2], [1, 1]], [[0, 1], [2, 1]]] {
        assert!(verify_constrained2(&points, &segments, &mesh).expect("right").is_canonical());
    }
    // The chain is broken after point 1.
    let other = [[0, 4, 1], [0, 1, 3], [1, 4, 3], [4, 2, 3]];
    let verdict = verify_constrained2(&points[..5], &[[0, 2]], &other);
    assert!(matches!(verdict, Err(Objection2::Flat(2) | Objection2::Segment { .. })), "{verdict:?}");
    // Points on a line have no triangles, whatever joins them.
    assert!(verify_constrained2(&points[..3], &[[0, 2]], &[]).is_ok());
    assert!(verify_constrained2(&[], &[], &[]).is_ok());
    let verdict = verify_constrained2(&[[0.0, f64::NAN]], &[], &[]);
    assert!(matches!(verdict, Err(Objection2::Points(Error::NotFinite { .. }))));
}
