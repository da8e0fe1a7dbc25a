//! The history of radial triangles against `nearest` of the triangulation and against brute force.

use delone::{Delaunay2, Inserted, NearestSites2, VertexId, Work};
use delone_generators::Kind;
use delone_oracle::exact;

fn queries(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut queries: Vec<[f64; 2]> = points.iter().copied().take(40).collect();
    // Halfway between neighbors in the list, where there are ties on grids.
    queries.extend(points.windows(2).take(60).map(|p| [0, 1].map(|k| p[0][k] / 2.0 + p[1][k] / 2.0)));
    queries.extend(Kind::Uniform.points(40, 9));
    queries.extend([[0.0, 0.0], [1e300, 1.0], [-3.0, 1e-300]]);
    queries
}

#[test]
fn the_nearest_site_is_the_nearest() {
    for &kind in Kind::ALL {
        for n in [0, 1, 2, 3, 4, 9, 60, 700] {
            for seed in 0..2 {
                let points = kind.points(n, 3 + seed);
                let d = Delaunay2::from_points(&points).expect("finite");
                let sites = NearestSites2::from_points(&points, seed).expect("finite");
                for q in queries(&points) {
                    let expected = d.nearest(q).expect("finite").map(VertexId::index);
                    assert_eq!(sites.nearest(q).expect("finite"), expected, "{kind:?} {n} {q:?}");
                }
            }
        }
    }
}

#[test]
fn nothing_is_nearer() {
    for kind in [Kind::Grid, Kind::Uniform, Kind::Circle, Kind::Line] {
        let points = kind.points(100, 1);
        let sites = NearestSites2::from_points(&points, 7).expect("finite");
        for q in queries(&points) {
            let found = points[sites.nearest(q).expect("finite").expect("there are sites")];
            assert!(points.iter().all(|&p| exact::compare_distances(q, found, p) <= 0), "{kind:?} {q:?}");
        }
    }
}

/// Sites added one by one, in the generator's order, in that along the axis, and after a start on one line.
#[test]
fn sites_may_come_one_by_one() {
    for &kind in Kind::ALL {
        let points = kind.points(50, 5);
        let mut along = points.clone();
        along.sort_unstable_by(|a, b| a.partial_cmp(b).expect("finite"));
        let line = (0..9).map(|i| [f64::from(i * 5 % 9), 2.0 * f64::from(i * 5 % 9)]);
        let late: Vec<[f64; 2]> = line.chain(points.iter().copied().take(30)).collect();
        for points in [points, along, late] {
            let mut sites = NearestSites2::new();
            let mut given: Vec<[f64; 2]> = Vec::new();
            for &p in points.iter().chain(&points[..4]) {
                let expected = match given.iter().position(|&q| q == p) {
                    Some(i) => Inserted::Existing(VertexId::new(i)),
                    None => Inserted::New(VertexId::new(given.len())),
                };
                assert_eq!(sites.insert(p).expect("finite"), expected, "{kind:?} {p:?}");
                if let Inserted::New(_) = expected {
                    given.push(p);
                }
                let about = p.map(|x| x / 2.0);
                for q in [p, about, [p[1], p[0]], [-1e300, 1.0], [given[0][0], p[1]]] {
                    let found = sites.nearest(q).expect("finite").expect("there are sites");
                    let is_less = |a: [f64; 2], b: [f64; 2]| {
                        let order = exact::compare_distances(q, a, b);
                        order < 0 || (order == 0 && (a[0], a[1]) < (b[0], b[1]))
                    };
                    let best =
                        (0..given.len()).reduce(|i, j| if is_less(given[j], given[i]) { j } else { i });
                    assert_eq!(Some(found), best, "{kind:?} {q:?} in {given:?}");
                }
            }
        }
    }
}

/// The work of a query grows with the square of the logarithm, also where a site has much of the set for neighbors: what
/// 10,000 sites take says what 80,000 do.
#[test]
fn work_is_that_of_a_squared_logarithm() {
    for kind in [Kind::Uniform, Kind::Ellipse2] {
        let [small, large] = [10_000, 80_000].map(|n| {
            let sites = NearestSites2::from_points(&kind.points(n, 1), 5).expect("finite");
            let mut work = Work::default();
            for q in Kind::Uniform.points(2000, 2) {
                sites.nearest_observed(q, &mut work).expect("finite");
            }
            (work.compared + work.orientations) as f64 / 2000.0 / (n as f64).ln().powi(2)
        });
        assert!(large < 1.5 * small && large < 3.0, "{kind:?}: {small} {large}");
    }
}

/// A hub with a ring of neighbors: each query looks at a logarithm of them.
#[test]
fn no_neighbors_are_scanned() {
    for n in [2000, 16_000] {
        let mut points = Kind::Circle.points(n, 3);
        points.push([0.001, 0.002]);
        let sites = NearestSites2::from_points(&points, 1).expect("finite");
        let mut work = Work::default();
        let queries = Kind::Circle.points(500, 8);
        for &[x, y] in &queries {
            sites.nearest_observed([0.4 * x, 0.4 * y], &mut work).expect("finite");
        }
        let each = (work.compared + work.orientations) as f64 / queries.len() as f64;
        assert!(each < 3.0 * (n as f64).ln().powi(2), "{n}: {each} comparisons and rays");
    }
}

#[test]
fn size_and_work_are_as_proved() {
    // Guibas, Knuth & Sharir, theorems 5.2 and 5.4: linear size, O(log n) planes, O(log^2 n) comparisons.
    let mut planes = Vec::new();
    for n in [1000, 4000, 16_000] {
        let sites = NearestSites2::from_points(&Kind::Uniform.points(n, 1), 5).expect("finite");
        let size = sites.size() as f64 / n as f64;
        assert!((20.0..24.1).contains(&size), "{n}: {size} triangles a site");
        let mut work = Work::default();
        let queries = Kind::Uniform.points(1000, 2);
        for &q in &queries {
            sites.nearest_observed(q, &mut work).expect("finite");
        }
        planes.push(work.visited as f64 / queries.len() as f64);
        // A triangle hangs on four sites, so it is new in step i with probability at most 4 / i.
        let bound = 4.0 * (n as f64).ln();
        assert!(planes.last().is_some_and(|p| *p < bound), "{n}: {planes:?}, at most {bound}");
    }
    let growth = (planes[2] - planes[0]) / 16f64.ln();
    assert!((1.0..4.0).contains(&growth), "{planes:?}: {growth} planes for each unit of ln n");
}

#[test]
fn bad_input_is_named() {
    assert!(NearestSites2::from_points(&[[0.0, 0.0], [f64::NAN, 1.0]], 0).is_err());
    let sites = NearestSites2::from_points(&[[0.0, 0.0]], 0).expect("finite");
    assert!(sites.nearest([f64::INFINITY, 0.0]).is_err());
    let mut sites = sites;
    assert!(sites.insert([0.0, f64::NAN]).is_err());
    assert_eq!(sites.insert([1.0, 0.0]), Ok(Inserted::New(VertexId::new(1))));
}
