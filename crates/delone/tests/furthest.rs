//! Furthest sites against their definitions, by brute force over exact arithmetic.

use delone::{Delaunay2, Hull3, VertexId, VoronoiEdge2};
use delone_generators::Kind;
use delone_oracle::exact;

/// The furthest point, the lexicographically smallest of several.
fn brute(points: &[[f64; 2]], q: [f64; 2]) -> Option<usize> {
    let further = |&i: &usize, &j: &usize| {
        let far = exact::compare_distances(q, points[i], points[j]).cmp(&0);
        let tie = points[j][0].total_cmp(&points[i][0]).then(points[j][1].total_cmp(&points[i][1]));
        far.then(tie).then(j.cmp(&i))
    };
    (0..points.len()).max_by(further)
}

#[test]
fn the_furthest_vertex_is_the_furthest() {
    for &kind in Kind::ALL {
        for n in [0, 1, 2, 3, 10, 60, 400] {
            let points: Vec<[f64; 2]> = kind.points(n, 7).iter().map(|p| p.map(|x| x + 0.0)).collect();
            let d = Delaunay2::from_points(&points).expect("finite");
            let furthest = d.furthest();
            let queries =
                points.iter().copied().take(20).chain(Kind::Uniform.points(20, 9)).chain([[0.0, 0.0]]);
            for q in queries {
                let found = furthest.furthest(q).expect("finite").map(VertexId::index);
                assert_eq!(found, brute(&points, q), "{kind:?} {n} {q:?}");
            }
        }
    }
}

#[test]
fn circles_contain_all_points() {
    for &kind in Kind::ALL {
        for n in [3, 10, 60] {
            let points = kind.points(n, 11);
            let d = Delaunay2::from_points(&points).expect("finite");
            let furthest = d.furthest();
            let corners = furthest.corners().len();
            assert_eq!(furthest.triangles().count(), corners.saturating_sub(2), "{kind:?} {n}");
            for triangle in furthest.triangles() {
                let [a, b, c] = triangle.map(|v| d.point(v));
                assert!(exact::orient2d(a, b, c) > 0, "{kind:?} {n}");
                for &p in &points {
                    assert!(exact::in_circle(a, b, c, p) >= 0, "{kind:?} {n} {triangle:?} {p:?}");
                }
            }
        }
    }
}

/// Guibas, Knuth & Sharir 1992, §4.1: of the points lifted to a paraboloid the upper hull. Chew's algorithm knows nothing of it.
#[test]
fn the_furthest_triangulation_is_the_upper_hull_of_the_lifted_points() {
    for kind in [
        Kind::Uniform,
        Kind::Grid,
        Kind::Clusters,
        Kind::Circle,
        Kind::Ellipse,
        Kind::Ellipse2,
        Kind::Parabola,
    ] {
        // Integers whose squares are exact.
        let raw = kind.points(400, 2);
        let low = [0, 1].map(|k| raw.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min));
        let spans = [0, 1].map(|k| raw.iter().map(|p| p[k] - low[k]).fold(0.0, f64::max));
        let scale = f64::from(1 << 20) / spans[0].max(spans[1]);
        let points: Vec<[f64; 2]> =
            raw.iter().map(|p| [0, 1].map(|k| ((p[k] - low[k]) * scale).round())).collect();
        let lifted: Vec<[f64; 3]> = points.iter().map(|&[x, y]| [x, y, x * x + y * y]).collect();
        let d = Delaunay2::from_points(&points).expect("finite");
        let furthest = d.furthest();
        let hull = Hull3::from_points(&lifted).expect("finite");
        assert_eq!(hull.upper(&lifted).count(), furthest.triangles().count(), "{kind:?}");
        // Sites on one circle are one face; every triangle is in one, with all points below it.
        let mut of_corner = vec![Vec::new(); points.len()];
        for (f, face) in hull.faces().enumerate() {
            face.iter().for_each(|&v| of_corner[v].push(f));
        }
        for triangle in furthest.triangles() {
            // Of equal points the hull may know another one.
            let corners = triangle.map(|v| {
                let is_same = |&i: &usize| points[i] == d.point(v);
                hull.corners().iter().copied().find(is_same).expect("a corner of the hull")
            });
            let [a, b, c] = corners.map(|i| &of_corner[i]);
            assert!(a.iter().any(|f| b.contains(f) && c.contains(f)), "{kind:?} {triangle:?}");
            let [a, b, c] = corners.map(|i| lifted[i]);
            assert!(lifted.iter().all(|&p| exact::orient3d(a, b, c, p) <= 0), "{kind:?} {triangle:?}");
        }
    }
}

#[test]
fn one_set_has_one_furthest_triangulation() {
    for kind in [Kind::Grid, Kind::Circle, Kind::Uniform, Kind::Duplicates] {
        let points = kind.points(200, 1);
        let triangles = |points: &[[f64; 2]]| {
            let d = Delaunay2::from_points(points).expect("finite");
            let mut all: Vec<Vec<[u64; 2]>> = d
                .furthest()
                .triangles()
                .map(|t| {
                    let mut corners: Vec<_> = t.iter().map(|v| d.point(*v).map(f64::to_bits)).collect();
                    corners.sort_unstable();
                    corners
                })
                .collect();
            all.sort();
            all
        };
        let reversed: Vec<_> = points.iter().rev().copied().collect();
        assert_eq!(triangles(&points), triangles(&reversed), "{kind:?}");
    }
    // All corners on one circle: the ties are broken, and all the same way.
    let ring: Vec<[f64; 2]> =
        [[5., 0.], [4., 3.], [3., 4.], [0., 5.], [-3., 4.], [-4., 3.], [-5., 0.], [0., -5.]].to_vec();
    let d = Delaunay2::from_points(&ring).expect("finite");
    let furthest = d.furthest();
    assert_eq!(furthest.triangles().count(), 6);
    assert_eq!(furthest.furthest([0.0, 0.0]).expect("finite").map(VertexId::index), Some(6));
    let circle = furthest.enclosing_circle().expect("there are points");
    assert_eq!((circle.center, circle.radius), ([0.0, 0.0], 5.0));
}

#[test]
fn the_enclosing_circle_is_the_smallest() {
    for &kind in Kind::ALL {
        for n in [1, 2, 3, 4, 12, 40] {
            let points = kind.points(n, 13);
            let d = Delaunay2::from_points(&points).expect("finite");
            let Some(circle) = d.furthest().enclosing_circle() else {
                panic!("{kind:?} {n}: there are points");
            };
            let support: Vec<[f64; 2]> = circle.support.iter().map(|&v| d.point(v)).collect();
            // It contains all points, and those that determine it are not in a smaller one. Exact.
            match support[..] {
                [p] => assert!(points.iter().all(|&q| q == p), "{kind:?} {n}"),
                [p, q] => assert!(
                    points.iter().all(|&r| r == p || r == q || exact::angle(r, p, q) <= 0),
                    "{kind:?} {n}"
                ),
                [a, b, c] => {
                    assert!(points.iter().all(|&p| exact::in_circle(a, b, c, p) >= 0), "{kind:?} {n}");
                    for (o, p, q) in [(a, b, c), (b, c, a), (c, a, b)] {
                        assert!(exact::angle(o, p, q) > 0, "{kind:?} {n}");
                    }
                }
                _ => panic!("{} points", support.len()),
            }
        }
    }
    assert_eq!(Delaunay2::new().furthest().enclosing_circle(), None);
}

#[test]
fn the_hull_is_the_same_either_way() {
    for &kind in Kind::ALL {
        for n in [0, 1, 2, 3, 10, 100, 500] {
            let points = kind.points(n, 5);
            let d = Delaunay2::from_points(&points).expect("finite");
            let hull = delone::Hull2::from_points(&points).expect("finite");
            let hull = hull.corners().to_vec();
            let corners: Vec<usize> = d.furthest().corners().iter().map(|v| v.index()).collect();
            assert_eq!(hull, corners, "{kind:?} {n}");
            // Every point is inside, and every corner is one.
            for (i, &a) in hull.iter().enumerate().filter(|_| hull.len() > 2) {
                let (b, c) = (hull[(i + 1) % hull.len()], hull[(i + 2) % hull.len()]);
                assert!(exact::orient2d(points[a], points[b], points[c]) > 0, "{kind:?} {n}");
                assert!(
                    points.iter().all(|&p| exact::orient2d(points[a], points[b], p) >= 0),
                    "{kind:?} {n}"
                );
            }
            let strict = |v: &VertexId| hull.contains(&v.index());
            assert_eq!(d.hull_vertices().filter(strict).count(), hull.len(), "{kind:?} {n}");
        }
    }
    assert!(delone::Hull2::from_points(&[[0.0, f64::NAN]]).is_err());
}

/// A point of each edge of the diagram is as far from its two sites as from each other, and from no site further.
#[test]
fn edges_are_where_two_sites_are_furthest() {
    for kind in [Kind::Uniform, Kind::Circle, Kind::Grid, Kind::Clusters] {
        for n in [2, 3, 5, 40] {
            let points = kind.points(n, 17);
            let d = Delaunay2::from_points(&points).expect("finite");
            let furthest = d.furthest();
            let corners = furthest.corners().len();
            let (mut segments, mut rays, mut lines) = (0, 0, 0);
            for ([v, w], edge) in furthest.edges() {
                let along = |from: [f64; 2], direction: [f64; 2]| {
                    [0.0, 1.0, 10.0]
                        .map(|t| [from[0] + t * direction[0], from[1] + t * direction[1]])
                        .to_vec()
                };
                let met = match edge {
                    VoronoiEdge2::Segment([from, to]) => {
                        segments += 1;
                        vec![from, to, [0, 1].map(|k| from[k] / 2.0 + to[k] / 2.0)]
                    }
                    VoronoiEdge2::Ray { from, direction } => {
                        rays += 1;
                        along(from, direction)
                    }
                    VoronoiEdge2::Line { through, direction } => {
                        lines += 1;
                        [along(through, direction), along(through, direction.map(|x| -x))].concat()
                    }
                };
                for q in met {
                    let distance = |p: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
                    let (far, error) = (distance(d.point(v)), 1e-9 * (1.0 + distance(d.point(v))));
                    assert!((far - distance(d.point(w))).abs() < error, "{kind:?} {n} {edge:?}");
                    assert!(points.iter().all(|&p| distance(p) < far + error), "{kind:?} {n} {edge:?}");
                }
            }
            let expected = match corners {
                0 | 1 => (0, 0, 0),
                2 => (0, 0, 1),
                h => (h - 3, h, 0),
            };
            assert_eq!((segments, rays, lines), expected, "{kind:?} {n}");
        }
    }
}

#[test]
fn the_support_of_an_enclosing_circle_is_on_it() {
    for kind in [Kind::Uniform, Kind::Circle, Kind::Grid, Kind::Clusters] {
        for n in [1, 2, 3, 4, 12, 40] {
            let points: Vec<[f64; 2]> =
                kind.points(n, 19).into_iter().map(|[x, y]| [x + 3.0, y - 2.0]).collect();
            let d = Delaunay2::from_points(&points).expect("finite");
            let circle = d.furthest().enclosing_circle().expect("there are points");
            for v in circle.support {
                let [x, y] = d.point(v);
                let distance = (x - circle.center[0]).hypot(y - circle.center[1]);
                assert!((distance - circle.radius).abs() < 1e-9 * (1.0 + circle.radius), "{kind:?} {n}");
            }
        }
    }
}
