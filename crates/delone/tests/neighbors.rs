//! The tree of points: all answers against definitions, and against those of the triangulations.

use std::cmp::Ordering;

use delone::{Delaunay2, Delaunay3, Error, Neighbors, Neighbors2, Neighbors3};
use delone_generators::{Kind, Kind3, Random};
use delone_oracle::some_of;
use delone_predicates::{
    compare_distances, compare_distances3, compare_with_radius, lexicographic, lexicographic3,
};

fn nearer2(q: [f64; 2], points: &[[f64; 2]]) -> impl Fn(&usize, &usize) -> Ordering {
    move |&a, &b| {
        let (p, r) = (points[a], points[b]);
        compare_distances(q, p, r).then_with(|| lexicographic(p, r)).then(a.cmp(&b))
    }
}

fn nearer3(q: [f64; 3], points: &[[f64; 3]]) -> impl Fn(&usize, &usize) -> Ordering {
    move |&a, &b| {
        let (p, r) = (points[a], points[b]);
        compare_distances3(q, p, r).then_with(|| lexicographic3(p, r)).then(a.cmp(&b))
    }
}

/// All answers for one query.
fn judge<const D: usize>(
    tree: &Neighbors<D>,
    q: [f64; D],
    nearer: impl Fn(&usize, &usize) -> Ordering,
    name: &str,
) -> Vec<usize> {
    let mut order: Vec<usize> = (0..tree.len()).collect();
    order.sort_by(nearer);
    assert_eq!(tree.nearest(q), Ok(order.first().copied()), "{name} {q:?}");
    for k in [0, 1, 2, 7, tree.len(), tree.len() + 3] {
        assert_eq!(tree.k_nearest(q, k).expect("finite"), order[..k.min(order.len())], "{name} {q:?} {k}");
    }
    order
}

/// Points, what is between them, and what is far away.
fn queries<const D: usize>(points: &[[f64; D]], random: &mut Random) -> Vec<[f64; D]> {
    let mut queries = vec![[0.0; D], [1e300; D], [-1e-300; D]];
    for _ in 0..12 {
        let [p, r] = [0, 1].map(|_| points[random.below(points.len())]);
        queries.extend([p, std::array::from_fn(|k| p[k] / 2.0 + r[k] / 2.0)]);
    }
    queries
}

#[test]
fn answers_in_the_plane_are_those_of_the_definition() {
    let mut random = Random::new(1);
    for &kind in Kind::ALL {
        for count in [1, 2, 8, 9, 17, 100, 300] {
            for scale in [1.0, 1e-300, 1e200] {
                let mut points = kind.points(count, 1);
                points.iter_mut().flatten().for_each(|x| *x *= scale);
                if points.iter().flatten().any(|x| !x.is_finite()) {
                    continue;
                }
                // Some of them twice.
                points.extend_from_within(..count / 4);
                let tree = Neighbors2::from_points(&points).expect("finite");
                for q in some_of(queries(&points, &mut random)) {
                    let name = format!("{} {count} {scale}", kind.name());
                    let order = judge(&tree, q, nearer2(q, &points), &name);
                    for r in [-1.0, 0.0, 0.1 * scale, scale] {
                        let is_in = |&i: &usize| compare_with_radius(q, points[i], r).is_le();
                        let mut within: Vec<usize> = order.iter().copied().filter(is_in).collect();
                        within.sort_unstable();
                        assert_eq!(tree.within(q, r), Ok(within), "{name} {q:?} {r}");
                    }
                }
            }
        }
    }
}

#[test]
fn answers_in_space_are_those_of_the_definition() {
    let mut random = Random::new(2);
    for &kind in Kind3::ALL {
        for count in [1, 9, 200] {
            let points = kind.points(count, 1);
            let tree = Neighbors3::from_points(&points).expect("finite");
            for q in queries(&points, &mut random) {
                judge(&tree, q, nearer3(q, &points), kind.name());
            }
        }
    }
}

#[test]
fn answers_are_those_of_triangulations() {
    let mut random = Random::new(3);
    for &kind in Kind::ALL.iter().filter(|kind| !kind.is_extreme()) {
        let points = kind.points(20_000, 4);
        let (tree, d) = (
            Neighbors2::from_points(&points).expect("finite"),
            Delaunay2::from_points(&points).expect("finite"),
        );
        for q in queries(&points, &mut random) {
            let expected = d.nearest(q).expect("finite").map(|v| v.index());
            assert_eq!(tree.nearest(q).expect("finite"), expected, "{} {q:?}", kind.name());
        }
    }
    let points = Kind3::Cube.points(20_000, 4);
    let (tree, d) =
        (Neighbors3::from_points(&points).expect("finite"), Delaunay3::from_points(&points).expect("finite"));
    for q in queries(&points, &mut random) {
        let expected = d.nearest(q).expect("finite").map(|v| v.index());
        assert_eq!(tree.nearest(q).expect("finite"), expected, "{q:?}");
    }
}

#[test]
fn what_is_wrong_is_named() {
    let wrong = Neighbors2::from_points(&[[0.0, 0.0], [1.0, f64::NAN]]);
    assert!(matches!(wrong, Err(Error::NotFinite { index: 1, axis: 1, .. })), "{wrong:?}");
    let tree = Neighbors2::from_points(&[[0.0, 0.0]]).expect("finite");
    assert!(matches!(tree.nearest([0.0, f64::INFINITY]), Err(Error::Coordinate { axis: 1, .. })));
    assert!(matches!(tree.within([0.0, 0.0], f64::NAN), Err(Error::Parameter { name: "radius", .. })));
    let none = Neighbors2::from_points::<[f64; 2]>(&[]).expect("no points");
    assert!(none.is_empty());
    assert_eq!((none.nearest([0.0, 0.0]), none.k_nearest([0.0, 0.0], 3)), (Ok(None), Ok(vec![])));
}
