//! Triangulations of space that change: after every mix of changes, that of the points that are left; and queries
//! against brute force.

use delone::{
    Ask, Delaunay2, Delaunay3, Dimension, Error, FacetId, Hierarchy, Inserted, JumpAndWalk, Locate,
    Location3, Nearest, VertexId, Walk, Work,
};
use delone_generators::{Kind3, Random};
use delone_oracle::nearest::compare_triangles;
use delone_oracle::{exact, some_of};

type Points = Vec<[f64; 3]>;

fn strategies() -> Vec<Locate> {
    let steep = Hierarchy::default().ratio(3.0).smallest_level(2).seed(9);
    vec![
        Locate::Tree,
        Locate::Walk(Walk::Visibility),
        Locate::JumpAndWalk(JumpAndWalk::default()),
        Locate::Hierarchy(Hierarchy::default()),
        Locate::Hierarchy(steep),
        Locate::Hierarchy(steep.nearest(Nearest::Exact).levels(3)),
        Locate::DelaunayTree,
    ]
}

/// Tetrahedra, and the triangles of coplanar points, by coordinates.
fn shape(d: &Delaunay3) -> (Dimension, Vec<Points>, usize) {
    let sorted = |corners: &[VertexId]| {
        let mut corners: Points = corners.iter().map(|&v| d.point(v).map(|x| x + 0.0)).collect();
        corners.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
        corners
    };
    let mut all: Vec<_> = match d.dimension() {
        Dimension::Space => d.tetrahedra().map(|t| sorted(&t)).collect(),
        _ => d.hull_facets().map(|t| sorted(&t)).collect(),
    };
    all.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
    (d.dimension(), all, d.edges().count())
}

fn rebuilt(d: &Delaunay3) -> Delaunay3 {
    let points: Points = d.vertices().map(|v| d.point(v)).collect();
    Delaunay3::from_points(&points).expect("finite")
}

#[test]
fn any_mix_of_changes_gives_the_triangulation_of_what_is_left() {
    for &kind in Kind3::ALL {
        for (round, locate) in strategies().into_iter().enumerate() {
            let n = if kind == Kind3::HugeSpan3 { 14 } else { 45 };
            let points = kind.points(n, round as u64);
            let mut random = Random::new(round as u64);
            let mut d = Delaunay3::new();
            d.set_strategy(locate).expect("in range");
            let mut alive: Vec<VertexId> = Vec::new();
            for step in 0..4 * n {
                let p = points[random.below(n)];
                match random.below(if step < n { 3 } else { 6 }) {
                    0..3 => {
                        if let Inserted::New(v) = d.insert(p).expect("finite") {
                            alive.push(v);
                        }
                    }
                    3 | 4 if !alive.is_empty() => {
                        let v = alive.swap_remove(random.below(alive.len()));
                        d.remove(v).expect("a vertex");
                        assert_eq!(d.remove(v), Err(Error::NoSuchVertex { vertex: v }));
                    }
                    _ if !alive.is_empty() => {
                        let v = alive[random.below(alive.len())];
                        match d.move_to(v, p) {
                            Ok(()) => assert_eq!(d.point(v), p.map(|x| x + 0.0)),
                            Err(error) => assert!(matches!(error, Error::Occupied { .. }), "{error}"),
                        }
                    }
                    _ => {}
                }
                if step % 7 == 0 || d.vertex_count() < 8 {
                    assert_eq!(d.check(), Ok(()), "{} {locate:?} {step}", kind.name());
                    assert!(shape(&d) == shape(&rebuilt(&d)), "{} {locate:?} {step}", kind.name());
                }
            }
            let all: Vec<VertexId> = d.vertices().collect();
            for v in all {
                d.remove(v).expect("a vertex");
            }
            assert_eq!((d.dimension(), d.check()), (Dimension::Empty, Ok(())), "{}", kind.name());
            d.insert([1.0; 3]).expect("finite");
            assert_eq!(d.dimension(), Dimension::Point);
        }
    }
}

#[test]
fn the_center_of_a_surface_comes_and_goes() {
    // All tetrahedra are in conflict with it, and all points of the surface are its neighbors.
    for (kind, center) in [(Kind3::Sphere, [0.0; 3]), (Kind3::Sphere, [3.0, 1.0, 0.5])] {
        let mut points = kind.points(4_000, 5);
        let mut d = Delaunay3::from_points(&points).expect("finite");
        let before = shape(&d);
        let Ok(Inserted::New(v)) = d.insert(center) else { panic!("a new vertex") };
        assert_eq!(d.check(), Ok(()));
        points.push(center);
        assert!(shape(&d) == shape(&Delaunay3::from_points(&points).expect("finite")));
        d.remove(v).expect("a vertex");
        assert_eq!(d.check(), Ok(()));
        assert!(shape(&d) == before);
    }
}

#[test]
fn large_sets_lose_half_of_their_points() {
    for kind in [Kind3::Cube, Kind3::Grid3, Kind3::Sphere, Kind3::Layers, Kind3::Lines, Kind3::SlantedGrid] {
        let points = kind.points(3_000, 5);
        let mut d = Delaunay3::from_points(&points).expect("finite");
        for v in d.vertices().collect::<Vec<_>>() {
            if v.index() % 2 == 0 {
                d.remove(v).expect("a vertex");
            }
        }
        assert_eq!(d.check(), Ok(()), "{}", kind.name());
        assert!(shape(&d) == shape(&rebuilt(&d)), "{}", kind.name());
        for p in points.iter().step_by(2) {
            d.insert(*p).expect("finite");
        }
        assert_eq!(d.check(), Ok(()), "{}", kind.name());
        assert!(shape(&d) == shape(&Delaunay3::from_points(&points).expect("finite")), "{}", kind.name());
    }
}

#[test]
fn every_strategy_locates_what_is_there() {
    for &kind in Kind3::ALL {
        let points = kind.points(if kind == Kind3::HugeSpan3 { 40 } else { 200 }, 3);
        let mut d = Delaunay3::from_points(&points).expect("finite");
        let mut queries = points.clone();
        queries.extend(points.windows(2).map(|w| [0, 1, 2].map(|k| w[0][k] / 2.0 + w[1][k] / 2.0)));
        queries.extend(points.iter().map(|p| p.map(|x| x * 1.5 + 0.1)));
        queries.retain(|q| q.iter().all(|x| x.is_finite()));
        for locate in strategies() {
            d.set_strategy(locate).expect("in range");
            for &q in some_of(&queries) {
                let at = d.locate(q).expect("finite");
                judge(&d, q, at, kind.name());
            }
        }
    }
    let mut d = Delaunay3::new();
    let hierarchy = Hierarchy::default();
    for flat in [
        Locate::History,
        Locate::Walk(Walk::Straight),
        Locate::Hierarchy(hierarchy.walk(Walk::Stochastic { seed: 1 })),
        Locate::Hierarchy(hierarchy.nearest(Nearest::InCircle)),
    ] {
        assert_eq!(d.set_strategy(flat), Err(Error::OnlyInThePlane));
    }
    assert!(d.locate([0.0, f64::NAN, 0.0]).is_err());
    assert_eq!(d.locate([0.0; 3]), Ok(Location3::LowerDimensional(Dimension::Empty)));
}

/// Whether an answer is right, by definition.
fn judge(d: &Delaunay3, q: [f64; 3], at: Location3, name: &str) {
    let side = |t: [VertexId; 3]| {
        let [a, b, c] = t.map(|v| d.point(v));
        exact::orient3d(a, b, c, q)
    };
    let facets = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];
    match at {
        Location3::Tetrahedron(t) => {
            let corners = d.mesh().corners(t);
            assert!(facets.iter().all(|f| side(f.map(|k| corners[k])) > 0), "{name} {q:?}");
        }
        Location3::Facet(f) => {
            assert_eq!(side(d.mesh().facet_corners(f)), 0, "{name} {q:?}");
            let opposite = |f: FacetId| d.mesh().corners(f.tetrahedron())[f.corner()];
            let is_spanned = d.dimension() == Dimension::Space;
            assert!(!is_spanned || opposite(f) < opposite(d.mesh().twin(f)), "{name} {q:?}");
        }
        Location3::Edge([v, w]) => {
            assert!(v < w, "{name} {q:?}");
            let (a, b) = (d.point(v), d.point(w));
            for k in 0..3 {
                let [a, b, q] = [a, b, q].map(|p| [p[(k + 1) % 3], p[(k + 2) % 3]]);
                assert_eq!(exact::orient2d(a, b, q), 0, "{name} {q:?}");
            }
            assert!((0..3).all(|k| a[k].min(b[k]) <= q[k] && q[k] <= a[k].max(b[k])), "{name} {q:?}");
        }
        Location3::Vertex(v) => assert_eq!(d.point(v), q, "{name}"),
        Location3::Outside(f) => {
            let own = d.mesh().facet_corners(f);
            assert!(side(own) < 0, "{name} {q:?}");
            let sorted = |mut corners: [VertexId; 3]| {
                corners.sort_unstable();
                corners
            };
            for other in d.hull_facets() {
                let order = compare_triangles(q, own.map(|v| d.point(v)), other.map(|v| d.point(v)));
                let is_right = side(other) <= 0 || order.then(sorted(own).cmp(&sorted(other))).is_le();
                assert!(is_right, "{name} {q:?} {own:?} {other:?}");
            }
        }
        Location3::LowerDimensional(dimension) => {
            assert!(dimension < Dimension::Space, "{name} {q:?}");
            assert!(d.vertices().all(|v| d.point(v) != q), "{name} {q:?}");
        }
    }
}

#[test]
fn nearest_vertices_by_brute_force() {
    for &kind in Kind3::ALL {
        let points = kind.points(if kind == Kind3::HugeSpan3 { 30 } else { 120 }, 8);
        let d = Delaunay3::from_points(&points).expect("finite");
        let vertices: Vec<VertexId> = d.vertices().collect();
        let mut queries: Points = points.iter().take(20).map(|p| p.map(|x| x * 0.75 + 0.125)).collect();
        queries.extend(points.iter().take(10));
        queries.retain(|q| q.iter().all(|x| x.is_finite()));
        for q in queries {
            let mut sorted = vertices.clone();
            sorted.sort_by(|&v, &w| {
                let by_distance = exact::compare_distances3(q, d.point(v), d.point(w));
                by_distance.cmp(&0).then(d.point(v).partial_cmp(&d.point(w)).expect("finite"))
            });
            assert_eq!(d.nearest(q).expect("finite"), sorted.first().copied(), "{}", kind.name());
            assert_eq!(d.k_nearest(q, 7).expect("finite"), sorted[..7.min(sorted.len())], "{}", kind.name());
            let radius =
                (0..3).map(|k| (d.point(sorted[sorted.len() / 3])[k] - q[k]).powi(2)).sum::<f64>().sqrt();
            if radius.is_finite() {
                let inside = |v: &VertexId| exact::compare_with_radius3(q, d.point(*v), radius) <= 0;
                let expected: Vec<VertexId> = vertices.iter().copied().filter(inside).collect();
                assert_eq!(d.within(q, radius).expect("finite"), expected, "{}", kind.name());
            }
        }
    }
}

#[test]
fn many_points_at_once_or_in_two_goes() {
    for &kind in Kind3::ALL {
        let points = kind.points(400, 5);
        for first in [0, 3, 200] {
            let mut d = Delaunay3::from_points(&points[..first]).expect("finite");
            assert_eq!(d.extend(&points[first..], 1).expect("finite"), first..points.len());
            assert_eq!(d.check(), Ok(()), "{}", kind.name());
            let whole = Delaunay3::from_points(&points).expect("finite");
            assert!(shape(&d) == shape(&whole), "{} after {first}", kind.name());
            assert!(d.duplicates().eq(whole.duplicates()), "{} after {first}", kind.name());
        }
    }
    let mut d = Delaunay3::new();
    assert!(d.extend(&[[0.0; 3], [f64::NAN, 0.0, 0.0]], 0).is_err());
    assert_eq!(d.extend(&[[0.0; 3]], 0), Ok(0..1));
}

/// In the plane and in space alike: what equals a vertex is forgotten when that moves away, and only then.
#[test]
fn duplicates_follow_their_vertex() {
    use delone::Change;
    fn life<T: Change>(at: impl Fn(f64) -> T::Point) {
        let seen = |d: &T| d.duplicates().map(|d| (d.point, d.vertex.index())).collect::<Vec<_>>();
        let points = [0.0, 1.0, 2.0, 3.0, 1.0, 2.0].map(&at);
        let mut d = T::from_vec(points.to_vec()).expect("finite");
        assert_eq!(seen(&d), [(4, 1), (5, 2)]);
        d.move_to(VertexId::new(1), at(7.0)).expect("free");
        assert_eq!(seen(&d), [(5, 2)]);
        // What comes later may equal it again, where it is now.
        d.extend(&[at(7.0), at(1.0)], 0).expect("finite");
        assert_eq!(seen(&d), [(5, 2), (6, 1)]);
        d.remove_observed(VertexId::new(2), &mut ()).expect("a vertex");
        assert_eq!(seen(&d), [(6, 1)]);
        assert!(d.check().is_ok());
    }
    life::<Delaunay2>(|x| [x, x * x]);
    life::<Delaunay3>(|x| [x, x * x, x * x * x]);
}

/// Points on a line, and in a plane, are found from the hints there.
#[test]
fn nearest_below_space_does_not_go_through_all() {
    for (kind, most) in [(Kind3::OnLine, 200), (Kind3::Slanted, 800)] {
        let points = kind.points(20_000, 3);
        let d = Delaunay3::from_points(&points).expect("finite");
        assert!(d.dimension() < Dimension::Space);
        let mut work = Work::default();
        for (p, q) in points.iter().zip(points.iter().skip(7)).take(1000) {
            d.nearest_observed([0, 1, 2].map(|k| p[k] * 0.75 + q[k] * 0.25), &mut work).expect("finite");
        }
        assert!(work.compared < most * 1000, "{} {}", kind.name(), work.compared);
    }
}
