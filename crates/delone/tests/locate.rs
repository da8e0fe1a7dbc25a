//! Queries against definitions: every strategy gives the exact answer, also where it is degenerate.

use std::cmp::Ordering;

use delone::{
    Algorithm2, Ask, Delaunay2, Dimension, Error, Hierarchy, JumpAndWalk, Locate, Location2, Nearest,
    VertexId, Walk, Work,
};
use delone_generators::{Kind, Random};
use delone_oracle::exact;
use delone_oracle::nearest::compare_segments;

fn strategies() -> Vec<Locate> {
    let steep = Hierarchy::default().ratio(3.0).smallest_level(2);
    vec![
        Locate::Tree,
        Locate::Walk(Walk::Visibility),
        Locate::Walk(Walk::Stochastic { seed: 4 }),
        Locate::Walk(Walk::Straight),
        Locate::JumpAndWalk(JumpAndWalk::default()),
        Locate::JumpAndWalk(JumpAndWalk::default().rho(1e9).with_replacement(true)),
        Locate::JumpAndWalk(JumpAndWalk::default().sample(usize::MAX)),
        Locate::JumpAndWalk(JumpAndWalk::default().sample(1).seed(3)),
        Locate::Hierarchy(Hierarchy::default()),
        Locate::Hierarchy(steep),
        Locate::Hierarchy(steep.nearest(Nearest::Exact).walk(Walk::Visibility)),
        Locate::Hierarchy(steep.nearest(Nearest::InCircle)),
        Locate::Hierarchy(steep.walk(Walk::Stochastic { seed: 2 }).with_replacement(true)),
        Locate::History,
        Locate::Stars,
        Locate::DelaunayTree,
    ]
}

/// Points in, on and around a set.
fn queries(points: &[[f64; 2]], random: &mut Random) -> Vec<[f64; 2]> {
    let mut queries = vec![[0.0, 0.0], [1e300, -1e300], [-5e-324, 0.5]];
    for _ in 0..30 {
        let [p, q] = [(); 2].map(|()| points[random.below(points.len())]);
        queries.extend([p, [p[0], q[1]], [p[0] / 2.0 + q[0] / 2.0, p[1] / 2.0 + q[1] / 2.0]]);
        queries.push([p[0] + random.normal(), p[1] - random.normal()]);
    }
    queries
}

/// Whether the answer is right, by definition.
fn is_right(d: &Delaunay2, q: [f64; 2], location: Location2) -> bool {
    let mesh = d.mesh();
    let point = |v: VertexId| d.point(v);
    let between = |a: [f64; 2], b: [f64; 2]| exact::orient2d(a, b, q) == 0 && exact::angle(q, a, b) < 0;
    match location {
        Location2::Vertex(v) => point(v) == q,
        Location2::Edge(e) => {
            let [a, b] = d.segment(e);
            let [own, other] = [e, mesh.twin(e)].map(|e| mesh.is_ghost(e.triangle()));
            let is_facing = if own == other { mesh.origin(e) < mesh.destination(e) } else { other };
            between(a, b) && is_facing
        }
        Location2::Triangle(t) => {
            let [a, b, c] = mesh.corners(t).map(point);
            [[a, b], [b, c], [c, a]].iter().all(|[u, v]| exact::orient2d(*u, *v, q) > 0)
        }
        Location2::Outside(e) => {
            let own = d.segment(e);
            // Of two edges that are as near the other one begins where this one ends.
            let is_first = |f: [f64; 2], g: [f64; 2]| match compare_segments(q, own, [f, g]) {
                Ordering::Less => true,
                Ordering::Equal => own == [f, g] || f == own[1],
                Ordering::Greater => false,
            };
            let hull: Vec<_> = d.hull_vertices().map(point).collect();
            let mut edges = hull.iter().zip(hull.iter().cycle().skip(1));
            let is_beyond = |f: [f64; 2], g: [f64; 2]| exact::orient2d(f, g, q) < 0;
            !mesh.is_ghost(e.triangle())
                && mesh.apex(mesh.twin(e)).is_ghost()
                && is_beyond(own[0], own[1])
                && edges.all(|(&f, &g)| !is_beyond(f, g) || is_first(f, g))
        }
        Location2::LowerDimensional(dimension) => {
            let on_edge = d.edges().any(|[a, b]| between(point(a), point(b)));
            let at_vertex = d.vertices().any(|v| point(v) == q);
            dimension == d.dimension() && dimension != Dimension::Plane && !on_edge && !at_vertex
        }
    }
}

#[test]
fn every_strategy_answers_by_definition() {
    for &kind in Kind::ALL {
        for (i, locate) in strategies().into_iter().enumerate() {
            let mut random = Random::new(i as u64);
            let n = [1, 2, 3, 7, 60][i % 5];
            let points = kind.points(n, i as u64);
            let mut bulk = Delaunay2::from_points(&points).expect("finite");
            bulk.set_strategy(locate).expect("in range");
            let one_by_one = Delaunay2::with_algorithm(&points, Algorithm2::Located { locate, seed: 2 });
            for d in [bulk, one_by_one.expect("finite")] {
                for q in queries(&points, &mut random) {
                    let location = d.locate(q).expect("finite");
                    assert!(is_right(&d, q, location), "{} {n} {locate:?}: {q:?} {location:?}", kind.name());
                }
            }
        }
    }
}

/// Neither on strategies, nor on what has been there before.
#[test]
fn answers_depend_on_the_vertices_alone() {
    let face = |d: &Delaunay2, q: [f64; 2]| {
        let found = d.find(q).expect("finite");
        let mut corners = found.face().to_vec();
        if corners.len() == 3 {
            corners.sort_unstable();
        }
        (found.is_outside, corners)
    };
    let mut outside = 0;
    for &kind in Kind::ALL {
        let points = kind.points(60, 4);
        let mut random = Random::new(7);
        let mut asked = queries(&points, &mut random);
        // Some that are near the hull, and some that are far away.
        for _ in 0..60 {
            let p = points[random.below(points.len())];
            let scale = [1.0 + f64::EPSILON, 1.1, 3.0, 1e9][random.below(4)];
            asked.push([p[0] * scale, p[1] * scale].map(|x| if x.is_finite() { x } else { 1e308 }));
        }
        let fresh = Delaunay2::from_points(&points).expect("finite");
        let expected: Vec<_> = asked.iter().map(|&q| face(&fresh, q)).collect();
        outside += expected.iter().filter(|found| found.0 && found.1.len() == 2).count();
        for (i, locate) in strategies().into_iter().enumerate() {
            let mut others = points.clone();
            others.extend(Kind::ALL[i].points(40, 1));
            let mut d = Delaunay2::from_points(&others).expect("finite");
            let doomed: Vec<_> = d.vertices().filter(|v| v.index() >= points.len()).collect();
            doomed.into_iter().for_each(|v| d.remove(v).expect("a vertex"));
            d.set_strategy(locate).expect("in range");
            for (&q, expected) in asked.iter().zip(&expected) {
                assert_eq!(face(&d, q), *expected, "{} {locate:?} {q:?}", kind.name());
            }
        }
    }
    assert!(outside > 1000, "{outside}");
}

#[test]
fn walks_start_anywhere() {
    let points = Kind::Grid.points(400, 1);
    let d = Delaunay2::from_points(&points).expect("finite");
    let mut random = Random::new(8);
    let starts: Vec<_> = d.mesh().triangles().collect();
    let mut work = Work::default();
    for walk in [Walk::Visibility, Walk::Stochastic { seed: 2 }, Walk::Straight] {
        for q in queries(&points, &mut random) {
            let start = starts[random.below(starts.len())];
            let location = d.locate_from(start, walk, q, &mut work).expect("finite");
            assert!(is_right(&d, q, location), "{walk:?} {q:?} {location:?}");
        }
    }
    assert!(work.visited > 1000 && work.orientations > work.visited);
}

#[test]
fn nothing_and_little_can_be_asked() {
    let empty = Delaunay2::new();
    assert_eq!(empty.locate([0.0, 0.0]), Ok(Location2::LowerDimensional(Dimension::Empty)));
    assert_eq!(empty.nearest([0.0, 0.0]), Ok(None));
    assert_eq!(empty.k_nearest([0.0, 0.0], 3), Ok(vec![]));
    assert_eq!(empty.within([0.0, 0.0], 3.0), Ok(vec![]));
    assert_eq!(empty.in_rectangle([0.0, 0.0], [1.0, 1.0]), Ok(vec![]));
    let lone = Delaunay2::from_points(&[[1.0, 1.0]]).expect("finite");
    assert_eq!(lone.locate([0.0, 0.0]), Ok(Location2::LowerDimensional(Dimension::Point)));
    assert_eq!(lone.locate([1.0, 1.0]), Ok(Location2::Vertex(VertexId::new(0))));
    assert_eq!(lone.nearest([9.0, 0.0]), Ok(Some(VertexId::new(0))));
    assert_eq!(lone.in_rectangle([0.0, 0.0], [1.0, 1.0]), Ok(vec![VertexId::new(0)]));
    assert_eq!(lone.in_rectangle([1.0, 1.0], [0.0, 0.0]), Ok(vec![]));
    assert!(matches!(lone.nearest([f64::NAN, 0.0]), Err(Error::Coordinate { axis: 0, .. })));
    assert!(matches!(lone.within([0.0, 0.0], f64::NAN), Err(Error::Parameter { name: "radius", .. })));
}

/// All vertices by distance from q, then lexicographically.
fn by_distance(d: &Delaunay2, q: [f64; 2]) -> Vec<VertexId> {
    let mut all: Vec<_> = d.vertices().collect();
    all.sort_by(|&a, &b| {
        let (a, b) = (d.point(a), d.point(b));
        exact::compare_distances(q, a, b).cmp(&0).then_with(|| a.partial_cmp(&b).expect("finite"))
    });
    all
}

#[test]
fn distances_and_regions_against_sorting() {
    for &kind in Kind::ALL {
        for n in [2, 5, 40, 150] {
            let points = kind.points(n, 3);
            let mut d = Delaunay2::from_points(&points).expect("finite");
            let mut random = Random::new(n as u64);
            for round in 0..2 {
                for q in queries(&points, &mut random).into_iter().step_by(7) {
                    let sorted = by_distance(&d, q);
                    let what = format!("{} {n} {q:?}", kind.name());
                    assert_eq!(d.nearest(q).expect("finite"), sorted.first().copied(), "{what}");
                    for k in [1, 4, n + 1] {
                        let expected = &sorted[..k.min(sorted.len())];
                        assert_eq!(d.k_nearest(q, k).expect("finite"), expected, "{what} {k}");
                    }
                    let radius = random.unit() * 2.0;
                    let mut inside: Vec<_> = sorted.clone();
                    inside.retain(|&v| exact::compare_with_radius(q, d.point(v), radius) <= 0);
                    inside.sort_unstable();
                    assert_eq!(d.within(q, radius).expect("finite"), inside, "{what} {radius}");
                    let p = points[random.below(points.len())];
                    let (low, high) = ([0, 1].map(|k| q[k].min(p[k])), [0, 1].map(|k| q[k].max(p[k])));
                    let mut inside = sorted.clone();
                    inside.retain(|&v| {
                        let x = d.point(v);
                        (0..2).all(|k| low[k] <= x[k] && x[k] <= high[k])
                    });
                    inside.sort_unstable();
                    assert_eq!(d.in_rectangle(low, high).expect("finite"), inside, "{what} {p:?}");
                }
                if round == 0 {
                    // Some go, and the answers change.
                    let doomed: Vec<_> = d.vertices().filter(|v| v.index() % 3 == 1).collect();
                    for v in doomed {
                        d.remove(v).expect("a vertex");
                    }
                }
            }
        }
    }
}

#[test]
fn many_vertices_at_the_same_distance() {
    // Around the center of a circle of lattice points (radius 65) the smallest is at the left.
    let mut points = Vec::new();
    for [x, y] in
        [[65, 0], [63, 16], [60, 25], [56, 33], [52, 39], [39, 52], [33, 56], [25, 60], [16, 63], [0, 65]]
    {
        for [x, y] in [[x, y], [-x, y], [x, -y], [-x, -y]] {
            points.push([f64::from(x), f64::from(y)]);
        }
    }
    let d = Delaunay2::from_points(&points).expect("finite");
    let v = d.nearest([0.0, 0.0]).expect("finite").expect("there are vertices");
    assert_eq!(d.point(v), [-65.0, 0.0]);
    assert_eq!(d.k_nearest([0.0, 0.0], 100).expect("finite"), by_distance(&d, [0.0, 0.0]));
    assert_eq!(d.within([0.0, 0.0], 65.0).expect("finite").len(), d.vertex_count());
    assert_eq!(exact::compare_distances([0.0, 0.0], points[0], points[5]).cmp(&0), Ordering::Equal);
}
