//! Triangles from elsewhere, right and wrong.

use delone::verify::{Objection2, verify2};
use delone::{Algorithm2, Delaunay2};
use delone_generators::Kind;

fn triangles(d: &Delaunay2) -> Vec<[u64; 3]> {
    d.triangles().map(|corners| corners.map(|v| v.index() as u64)).collect()
}

#[test]
fn what_delone_gives_is_canonical() {
    for &kind in Kind::ALL {
        let points = kind.points(if kind.is_extreme() { 300 } else { 3000 }, 4);
        let d = Delaunay2::with_algorithm(&points, Algorithm2::default()).expect("finite");
        let verdict = verify2(&points, &triangles(&d)).unwrap_or_else(|o| panic!("{}: {o}", kind.name()));
        assert!(verdict.is_canonical(), "{}", kind.name());
        assert_eq!(verdict.negative, 0);
        if d.triangles().count() > 0 {
            assert_eq!(verdict.hull, d.hull_vertices().count(), "{}", kind.name());
            assert_eq!(verdict.duplicates, d.duplicates().count(), "{}", kind.name());
        }
    }
}

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

#[test]
fn the_other_diagonal_is_delaunay_but_not_canonical() {
    let canonical = verify2(&SQUARE, &[[0, 1, 3], [1, 2, 3]]).expect("Delaunay");
    assert!(canonical.is_canonical());
    let other = verify2(&SQUARE, &[[0, 1, 2], [0, 3, 2]]).expect("Delaunay");
    assert_eq!((other.other_ties, other.negative), (1, 1));
    assert!(!other.is_canonical());
    // Nothing to triangulate: no point, points in one place, on a line.
    for (points, duplicates) in [(vec![], 0), (vec![[1.0, 2.0]; 3], 2), (vec![[1.0, 2.0], [3.0, 4.0]], 0)] {
        let verdict = verify2(&points, &[]).expect("Delaunay");
        assert_eq!((verdict.duplicates, verdict.hull), (duplicates, 0), "{points:?}");
    }
}

#[test]
fn objections_name_the_culprit() {
    let mut kite = SQUARE.to_vec();
    kite[2] = [1.5, 1.5];
    kite.push([0.4, 0.4]);
    let points = &kite[..4];
    assert_eq!(
        verify2(points, &[[0, 1, 2], [0, 2, 3]]),
        Err(Objection2::Circle { triangle: 0, neighbor: 1, point: 3 })
    );
    assert_eq!(
        verify2(points, &[[0, 1, 3], [1, 2, 4]]),
        Err(Objection2::Index { triangle: 1, corner: 4, points: 4 })
    );
    assert_eq!(verify2(points, &[[0, 1, 3]]), Err(Objection2::Missing(2)));
    assert_eq!(verify2(points, &[]), Err(Objection2::Missing(2)));
    assert_eq!(verify2(points, &[[0, 1, 3], [1, 2, 3], [1, 3, 0]]), Err(Objection2::Overlap(0, 2)));
    assert_eq!(verify2(&kite, &[[0, 1, 3], [1, 2, 3]]), Err(Objection2::Missing(4)));
    assert_eq!(verify2(points, &[[0, 0, 1]]), Err(Objection2::Flat(0)));
    // A fan with one triangle left out has a dent; two triangles that touch in a vertex are no disk.
    assert_eq!(verify2(&kite, &[[0, 1, 4], [1, 2, 4], [2, 3, 4]]), Err(Objection2::Dent(4)));
    let bow = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
    assert_eq!(verify2(&bow, &[[0, 1, 2], [0, 3, 4]]), Err(Objection2::Border(0)));
    let apart = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [5.0, 0.0], [6.0, 0.0], [5.0, 1.0]];
    assert_eq!(verify2(&apart, &[[0, 1, 2], [3, 4, 5]]), Err(Objection2::Border(3)));
    assert!(matches!(verify2(&[[f64::NAN, 0.0]], &[]), Err(Objection2::Points(_))));
}

#[test]
fn a_hole_is_seen() {
    let points = Kind::Uniform.points(100, 1);
    let d = Delaunay2::from_points(&points).expect("finite");
    let hull: Vec<_> = d.hull_vertices().collect();
    let mut with_hole = triangles(&d);
    let inner = d.triangles().position(|t| t.iter().all(|v| !hull.contains(v))).expect("an inner triangle");
    with_hole.remove(inner);
    assert!(verify2(&points, &with_hole).is_err());
}
