//! The history of radial triangles against `nearest` of the triangulation and against brute force.

use delone::{Delaunay2, NearestSites2, VertexId, Work};
use delone_generators::Kind;
use delone_oracle::exact;

fn queries(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut queries: Vec<[f64; 2]> = points.iter().copied().take(40).collect();
    // Halfway between neighbours in the list, where there are ties on grids.
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
}
