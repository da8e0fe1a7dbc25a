//! The number of threads never shows: the same bits for one and for many.

use delone::{Algorithm3, Delaunay2, Delaunay3, Locate, Regular2, Regular3, VertexId};
use delone_generators::{Kind, Kind3};
use delone_oracle::all_cases;
use rayon::ThreadPoolBuilder;

/// Everything that a triangulation is: corners and neighbors by triangle, an edge of each vertex, duplicates.
fn bits(d: &Delaunay2) -> impl PartialEq + use<> {
    let mesh = d.mesh();
    let triangles: Vec<_> = mesh.triangles().map(|t| (t, mesh.corners(t), mesh.adjacent(t))).collect();
    let stars: Vec<_> = d.vertices().map(|v| mesh.star(v).next()).collect();
    let hull: Vec<VertexId> = d.hull_vertices().collect();
    (triangles, stars, hull, d.duplicates().collect::<Vec<_>>(), d.counters())
}

#[test]
fn threads_never_show() {
    let pools: Vec<_> = [1, 2, 3, 8]
        .map(|threads| ThreadPoolBuilder::new().num_threads(threads).build().expect("threads"))
        .into();
    for &kind in Kind::ALL {
        // Cells that hold a large part of the points are sorted and built in parallel too.
        let n = if kind.is_extreme() { 40_000 } else { 80_000 };
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

/// Nor from how many points on they share the work.
#[test]
fn small_shares_never_show() {
    let on = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let of = |&kind: &Kind| bits(&Delaunay2::from_points(&kind.points(9000, 1)).expect("finite"));
        pool.install(|| Kind::ALL.iter().map(of).collect::<Vec<_>>())
    };
    let one = on(1);
    delone::share_work_from(0);
    assert!(on(3) == one);
    delone::share_work_from(1 << 15);
    assert!(on(3) == one);
}

/// Nor where sites are hidden.
#[test]
fn threads_never_show_with_weights() {
    let on = |threads, points: &[[f64; 2]], weights: &[f64]| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let r = pool.install(|| Regular2::from_parts(points, weights).expect("finite"));
        r.check().expect("canonical");
        let triangles: Vec<_> =
            r.triangle_ids().map(|t| (t, r.mesh().corners(t), r.mesh().adjacent(t))).collect();
        (triangles, r.hidden().collect::<Vec<_>>(), r.duplicates().collect::<Vec<_>>())
    };
    for kind in [Kind::Uniform, Kind::Grid, Kind::Clusters] {
        let points = kind.points(100_000, 1);
        let spread = points.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs())).powi(2) / 100_000.0;
        let weights: Vec<f64> = (0..points.len()).map(|i| spread * ((i * 7919) % 5) as f64).collect();
        let one = on(1, &points, &weights);
        assert!(one == on(2, &points, &weights) && one == on(3, &points, &weights), "{}", kind.name());
        assert!(!one.1.is_empty(), "{}", kind.name());
    }
}

/// A crowd, and points at every power of two around it: thousands of cuts, one below the other, with all but a point on one
/// side.
#[test]
fn deep_trees_fit_on_the_stack() {
    let mut points = Kind::Uniform.points(100_000, 1);
    points.iter_mut().flatten().for_each(|x| *x *= 2f64.powi(-1000));
    for far in (-1000..1000).map(|e| 2f64.powi(e)) {
        points.extend([[1.1 * far, 0.3 * far], [0.2 * far, 1.7 * far]]);
    }
    let on = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| bits(&Delaunay2::from_points(&points).expect("finite")))
    };
    let one = on(1);
    assert!(on(2) == one && on(4) == one);
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

/// All bits of a triangulation in space.
fn bits3(d: &Delaunay3) -> impl PartialEq + use<> {
    let mesh = d.mesh();
    let cells: Vec<_> = d.tetrahedron_ids().map(|t| (t, mesh.corners(t), mesh.adjacent(t))).collect();
    let hull: Vec<_> = d.hull_vertices().collect();
    (cells, hull, d.duplicates().collect::<Vec<_>>(), d.counters())
}

/// The tetrahedra, whatever their order and that of their corners.
fn set(d: &Delaunay3) -> Vec<[VertexId; 4]> {
    let sorted = |mut corners: [VertexId; 4]| {
        corners.sort_unstable();
        corners
    };
    let mut set: Vec<_> = d.tetrahedra().map(sorted).collect();
    set.sort_unstable();
    set
}

#[test]
fn threads_never_show_in_space() {
    let on = |threads: usize, points: &[[f64; 3]]| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            Delaunay3::with_algorithm(points, Algorithm3::Incremental { seed: 0 }).expect("finite")
        })
    };
    // Enough for cuts.
    let many = if all_cases() { 130_000 } else { 60_000 };
    for (kind, n) in
        [(Kind3::Cube, many), (Kind3::Clusters3, 50_000), (Kind3::Grid3, 40_000), (Kind3::Sphere, 20_000)]
    {
        // Points that equal others, on either side of every cut.
        let mut points = kind.points(n, 1);
        points.extend_from_within(..n / 50);
        let one = on(1, &points);
        for threads in [2, 5] {
            assert!(bits3(&on(threads, &points)) == bits3(&one), "{} on {threads} threads", kind.name());
        }
        assert_eq!(one.check(), Ok(()), "{}", kind.name());
        let random = Algorithm3::Located { locate: Locate::default(), seed: 1 };
        let other = Delaunay3::with_algorithm(&points, random).expect("finite");
        assert!(set(&one) == set(&other), "{}", kind.name());
    }
}

/// Tetrahedra with their neighbors, and what is no vertex.
fn bits_of_regular(r: &Regular3) -> impl PartialEq + use<> {
    let mesh = r.mesh();
    let cells: Vec<_> = r.tetrahedron_ids().map(|t| (t, mesh.corners(t), mesh.adjacent(t))).collect();
    let vertices: Vec<_> = r.vertices().collect();
    (cells, vertices, r.hidden().collect::<Vec<_>>(), r.duplicates().collect::<Vec<_>>(), r.counters())
}

#[test]
fn threads_never_show_in_space_with_weights() {
    let on = |threads: usize, points: &[[f64; 3]], weights: &[f64]| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| Regular3::from_parts(points, weights).expect("finite"))
    };
    let sorted = |r: &Regular3| {
        let mut all: Vec<_> = r
            .tetrahedra()
            .map(|mut corners| {
                corners.sort_unstable();
                corners
            })
            .collect();
        all.sort_unstable();
        all
    };
    let mut hidden = 0;
    for (kind, n, share) in
        [(Kind3::Cube, 60_000, 0.6), (Kind3::Cube, 60_000, 4.0), (Kind3::Grid3, 40_000, 1.2)]
    {
        let mut points = kind.points(n, 1);
        let spacing = points.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs())) / (n as f64).cbrt();
        points.extend_from_within(..n / 50);
        // Steps, so that lattices tie.
        let step = 2f64.powf((share * spacing).log2().floor());
        let weights: Vec<f64> =
            (0..points.len()).map(|i| ((i * 7919) % 5) as f64 * step * step / 4.0).collect();
        let one = on(1, &points, &weights);
        for threads in [2, 7] {
            let same = bits_of_regular(&on(threads, &points, &weights)) == bits_of_regular(&one);
            assert!(same, "{} on {threads} threads", kind.name());
        }
        assert_eq!(one.check(), Ok(()), "{}", kind.name());
        hidden += one.hidden().count();
        // Another order of insertion.
        let seeded = Regular3::with_seed(&points, &weights, 1).expect("finite");
        assert!(sorted(&one) == sorted(&seeded), "{}", kind.name());
        assert!(one.hidden().eq(seeded.hidden()) && one.duplicates().eq(seeded.duplicates()));
    }
    assert!(hidden > 1000, "{hidden}");
}
