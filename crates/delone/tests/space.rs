//! Triangulations of space against their definition, and each other.

use delone::verify::{Objection3, verify3};
use delone::{Algorithm3, Delaunay3, Dimension, Hierarchy, Locate, Regular3, VertexId};
use delone_generators::{Kind3, Random};
use delone_oracle::{all_cases, brute};

type Points = Vec<[f64; 3]>;

/// Tetrahedra by coordinates, in a form that can be compared.
fn tetrahedra(d: &Delaunay3) -> Vec<[[f64; 3]; 4]> {
    let sorted = |mut corners: [[f64; 3]; 4]| {
        corners.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
        corners
    };
    let mut all: Vec<_> = d.tetrahedra().map(|t| sorted(t.map(|v| d.point(v).map(|x| x + 0.0)))).collect();
    all.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
    all
}

/// The triangles of coplanar points, likewise.
fn triangles(d: &Delaunay3) -> Vec<[[f64; 3]; 3]> {
    let sorted = |mut corners: [[f64; 3]; 3]| {
        corners.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
        corners
    };
    let mut all: Vec<_> = d.hull_facets().map(|t| sorted(t.map(|v| d.point(v).map(|x| x + 0.0)))).collect();
    all.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
    all
}

#[test]
fn small_sets_against_the_oracle() {
    for &kind in Kind3::ALL {
        for seed in 0..120 {
            let points = kind.points(1 + seed as usize % 10, seed);
            let d = Delaunay3::from_points(&points).expect("finite");
            assert_eq!(d.check(), Ok(()), "{} {seed}", kind.name());
            assert_eq!(tetrahedra(&d), brute::delaunay3(&points), "{} {seed}", kind.name());
            if d.dimension() == Dimension::Plane {
                let apex = [0, 1, 2].map(|k| {
                    let mut p = points[0];
                    p[k] = if p[k] == 1.0 { 0.5 } else { 1.0 };
                    p
                });
                let off = |p: &[f64; 3]| !brute::delaunay3(&[points.clone(), vec![*p]].concat()).is_empty();
                let apex = apex.into_iter().find(off).expect("one axis leaves the plane");
                assert_eq!(triangles(&d), brute::delaunay_of_plane(&points, apex), "{} {seed}", kind.name());
            }
        }
    }
}

#[test]
fn large_sets_agree_across_orders() {
    for &kind in Kind3::ALL {
        let n = match kind {
            Kind3::HugeSpan3 => 100,
            Kind3::Linked | Kind3::Far => 200,
            _ if all_cases() => 4_000,
            _ => 1_000,
        };
        let mut points = kind.points(n, 2);
        let d = Delaunay3::from_points(&points).expect("finite");
        assert_eq!(d.check(), Ok(()), "{}", kind.name());
        let expected = (tetrahedra(&d), d.dimension(), d.edges().count());
        Random::new(4).shuffle(&mut points);
        let hierarchy = Locate::Hierarchy(Hierarchy::default());
        for algorithm in [
            Algorithm3::Incremental { seed: 1 },
            Algorithm3::Located { locate: Locate::Tree, seed: 2 },
            Algorithm3::Flips { seed: 3 },
            Algorithm3::Located { locate: Locate::DelaunayTree, seed: 3 },
            Algorithm3::Located { locate: hierarchy, seed: 3 },
        ] {
            let d = Delaunay3::with_algorithm(&points, algorithm).expect("finite");
            assert_eq!(d.check(), Ok(()), "{}", kind.name());
            assert!((tetrahedra(&d), d.dimension(), d.edges().count()) == expected, "{}", kind.name());
        }
    }
}

/// With weights, by cavities and by flips.
#[test]
fn sites_agree_across_algorithms() {
    type Made = (Vec<Vec<[u64; 4]>>, Vec<[u64; 4]>);
    let made = |r: &Regular3| -> Made {
        let bits = |v| {
            let (p, w) = r.site(v).expect("given");
            [p[0], p[1], p[2], w].map(|x| (x + 0.0).to_bits())
        };
        let sorted = |t: [VertexId; 4]| {
            let mut corners = t.map(bits).to_vec();
            corners.sort_unstable();
            corners
        };
        let mut all: Vec<_> = r.tetrahedra().map(sorted).collect();
        let mut hidden: Vec<_> = r.hidden().map(bits).collect();
        all.sort_unstable();
        hidden.sort_unstable();
        (all, hidden)
    };
    for &kind in Kind3::ALL {
        let n = if matches!(kind, Kind3::HugeSpan3 | Kind3::Linked | Kind3::Far) { 300 } else { 800 };
        let points = kind.points(n, 2);
        let size = points.iter().flatten().fold(0.0, |size, x| f64::max(size, x.abs()));
        let mut random = Random::new(5);
        // Lattices tie where several weights are equal.
        let levels = [1 << 20, 4];
        for level in levels {
            let mut weight = || {
                let part = random.below(level) as f64 / level as f64;
                (0.01 * size * size * part).min(f64::MAX)
            };
            let mut sites: Vec<([f64; 3], f64)> = points.iter().map(|&p| (p, weight())).collect();
            let expected = made(&Regular3::from_sites(&sites).expect("finite"));
            for seed in 0..2 {
                random.shuffle(&mut sites);
                let (points, weights): (Vec<_>, Vec<_>) = sites.iter().copied().unzip();
                let r = Regular3::by_flips(&points, &weights, seed).expect("finite");
                assert_eq!(r.check(), Ok(()), "{} {level}", kind.name());
                assert!(made(&r) == expected, "{} {level} {seed}", kind.name());
            }
        }
    }
}

#[test]
fn grids_tile_their_box() {
    for [x, y, z] in [[2, 2, 2], [3, 3, 2], [3, 3, 3], [10, 10, 10], [5, 1, 7], [30, 2, 3], [16, 16, 16]] {
        let mut points: Points =
            (0..x * y * z).map(|i| [i % x, i / x % y, i / x / y].map(|c| f64::from(c as u32))).collect();
        Random::new(1).shuffle(&mut points);
        let d = Delaunay3::from_points(&points).expect("finite");
        assert_eq!(d.check(), Ok(()));
        let six_volumes: f64 = d
            .tetrahedra()
            .map(|t| {
                let [a, b, c, p] = t.map(|v| d.point(v));
                let [u, v, w] = [b, c, p].map(|q| [0, 1, 2].map(|k| q[k] - a[k]));
                let cross =
                    [0, 1, 2].map(|k| v[(k + 1) % 3] * w[(k + 2) % 3] - v[(k + 2) % 3] * w[(k + 1) % 3]);
                u.iter().zip(cross).map(|(x, y)| x * y).sum::<f64>()
            })
            .inspect(|volume| assert!(*volume > 0.0))
            .sum();
        let boxes: usize = [x, y, z].map(|side| side - 1).into_iter().product();
        assert_eq!(six_volumes, 6.0 * boxes as f64, "{x} {y} {z}");
        // Euler's relation of a ball, and of what the hull adds.
        let [v, e, f, t] =
            [d.vertex_count(), d.edges().count(), d.facets().count(), d.tetrahedron_ids().count()];
        if t > 0 {
            assert_eq!(v + f, e + t + 1, "{x} {y} {z}");
            assert_eq!(2 * f, 4 * t + d.hull_facets().count(), "{x} {y} {z}");
        }
        for v in d.vertices().take(30) {
            let star = d.tetrahedra_at(v);
            assert!(star.iter().all(|&t| d.mesh().corners(t).contains(&v)));
            let at = d.tetrahedron_ids().filter(|&t| d.mesh().corners(t).contains(&v)).count();
            assert_eq!(
                star.iter().filter(|&&t| !d.mesh().is_ghost(t)).count(),
                if t > 0 { at } else { star.len() / 2 }
            );
        }
    }
}

#[test]
fn less_than_space() {
    let d = Delaunay3::from_points::<[f64; 3]>(&[]).expect("finite");
    assert_eq!((d.dimension(), d.vertex_count()), (Dimension::Empty, 0));
    let d = Delaunay3::from_points(&[[1.0, 2.0, 3.0]; 4]).expect("finite");
    assert_eq!((d.dimension(), d.vertex_count(), d.duplicates().count()), (Dimension::Point, 1, 3));
    assert_eq!((d.edges().count(), d.hull_facets().count(), d.check()), (0, 0, Ok(())));
    let line: Points = (0..50).map(|i| [f64::from(i), f64::from(2 * i), 0.5]).collect();
    let d = Delaunay3::from_points(&line).expect("finite");
    assert_eq!((d.dimension(), d.edges().count(), d.check()), (Dimension::Line, 49, Ok(())));
    let plane = Kind3::SlantedGrid.points(100, 1);
    let d = Delaunay3::from_points(&plane).expect("finite");
    assert_eq!((d.dimension(), d.hull_facets().count(), d.check()), (Dimension::Plane, 162, Ok(())));
    assert_eq!(d.edges().count(), 261);
    assert_eq!(d.facets().count(), 162);
    assert!(Delaunay3::from_points(&[[0.0, f64::NAN, 0.0]]).is_err());
    // The first of equal points is the vertex.
    let twice = [[0.0; 3], [1.0, 0.0, 0.0], [0.0; 3], [-0.0; 3], [1.0, 0.0, 0.0]];
    let d = Delaunay3::from_points(&twice).expect("finite");
    let pairs: Vec<_> = d.duplicates().map(|d| (d.point, d.vertex.index())).collect();
    assert_eq!(pairs, [(2, 0), (3, 0), (4, 1)]);
    let located = Algorithm3::Located { locate: Locate::Tree, seed: 1 };
    let d = Delaunay3::with_algorithm(&twice, located).expect("finite");
    assert!(d.duplicates().map(|d| (d.point, d.vertex.index())).eq(pairs));
}

#[test]
fn verdicts_on_tetrahedra_from_elsewhere() {
    for kind in [Kind3::Cube, Kind3::Grid3, Kind3::Sphere, Kind3::Layers, Kind3::Repeated, Kind3::Slanted] {
        let points = kind.points(300, 6);
        let d = Delaunay3::from_points(&points).expect("finite");
        let right: Vec<[u64; 4]> = d.tetrahedra().map(|t| t.map(|v| v.index() as u64)).collect();
        let verdict =
            verify3(&points, &right).unwrap_or_else(|objection| panic!("{}: {objection}", kind.name()));
        assert!(verdict.is_canonical() && verdict.negative == 0, "{}", kind.name());
        assert_eq!(verdict.duplicates, d.duplicates().count(), "{}", kind.name());
        if right.is_empty() {
            continue;
        }
        let mut turned = right.clone();
        turned[0].swap(1, 2);
        assert_eq!(verify3(&points, &turned).map(|v| v.negative), Ok(1));
        let without = &right[1..];
        assert!(verify3(&points, without).is_err(), "{}: one is missing", kind.name());
        let twice = [right.clone(), vec![right[0]]].concat();
        assert!(matches!(verify3(&points, &twice), Err(Objection3::Overlap(..))));
        let mut beyond = right.clone();
        beyond[3][2] = 300;
        assert!(matches!(
            verify3(&points, &beyond),
            Err(Objection3::Index { tetrahedron: 3, corner: 300, .. })
        ));
        let mut flat = right.clone();
        flat[2][0] = flat[2][1];
        assert_eq!(verify3(&points, &flat), Err(Objection3::Flat(2)));
        // Of other points they are not Delaunay, or no triangulation.
        let moved = Kind3::Cube.points(300, 9);
        assert!(verify3(&moved, &right).is_err());
    }
    // A cube cut in another way than the canonical one.
    let cube: Points = (0..8_u32).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from)).collect();
    let five = [[0, 1, 2, 4], [3, 2, 1, 7], [5, 4, 7, 1], [6, 7, 4, 2], [1, 2, 4, 7]];
    let verdict = verify3(&cube, &five).expect("Delaunay");
    assert!(!verdict.is_canonical());
    assert_eq!(verdict.hull, 12);
    // Two heaps that do not touch.
    let apart: Points = (0..8_u32)
        .map(|i| if i < 4 { cube[i as usize] } else { cube[i as usize].map(|x| x + 9.0) })
        .collect();
    let heaps = [[0, 1, 2, 4], [4, 5, 6, 7]];
    assert!(verify3(&apart, &heaps).is_err());
    assert_eq!(verify3(&cube, &[]), Err(Objection3::Missing(4)));
}
