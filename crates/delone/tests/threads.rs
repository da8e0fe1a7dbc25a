//! The number of threads never shows: the same bits for one and for many.
#![cfg(feature = "rayon")]

use delone::{Delaunay2, VertexId};
use delone_oracle::generate::Kind;
use rayon::ThreadPoolBuilder;

/// Everything that a triangulation is: corners and neighbours by triangle, an edge of each vertex, duplicates.
fn bits(d: &Delaunay2) -> impl PartialEq + use<> {
    let mesh = d.mesh();
    let triangles: Vec<_> = mesh.triangles().map(|t| (t, mesh.corners(t), mesh.adjacent(t))).collect();
    let stars: Vec<_> = d.vertices().map(|v| mesh.star(v).next()).collect();
    let hull: Vec<VertexId> = d.hull().collect();
    (triangles, stars, hull, d.duplicates().collect::<Vec<_>>(), d.counters())
}

#[test]
fn threads_never_show() {
    let pools: Vec<_> = [1, 2, 3, 8]
        .map(|threads| ThreadPoolBuilder::new().num_threads(threads).build().expect("threads"))
        .into();
    for &kind in Kind::ALL {
        // Cells that hold a large part of the points are sorted and built in parallel too.
        let n = if kind.is_extreme() { 40_000 } else { 150_000 };
        let points = kind.points(n, 1);
        let all: Vec<_> = pools
            .iter()
            .map(|pool| pool.install(|| bits(&Delaunay2::from_points(&points).expect("finite"))))
            .collect();
        for (k, other) in all.iter().enumerate() {
            assert!(*other == all[0], "{} with pool {k}", kind.name());
        }
    }
}

#[test]
fn many_threads_give_the_canonical_triangulation() {
    let pool = ThreadPoolBuilder::new().num_threads(4).build().expect("threads");
    for &kind in Kind::ALL {
        let points = kind.points(if kind.is_extreme() { 35_000 } else { 60_000 }, 2);
        let d = pool.install(|| Delaunay2::from_points(&points).expect("finite"));
        assert_eq!(d.check(), Ok(()), "{}", kind.name());
    }
}
