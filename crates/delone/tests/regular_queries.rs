//! Queries and changes of many sites of regular triangulations, by their definition: all powers compared, and all built anew.

use std::collections::BTreeSet;

use delone::{Delaunay2, Delaunay3, Error, Regular, Regular2, Regular3, Triangulation, VertexId};
use delone_generators::{Kind, Kind3, Random};
use delone_oracle::power::{compare, has_nearest_center};
use delone_oracle::share;

type Site<const D: usize> = ([f64; D], f64);

/// Sites on half-integers, which tie, or spread; on a line, or in a plane, now and then.
fn sites<const D: usize>(random: &mut Random, count: usize) -> Vec<Site<D>> {
    let (family, span) = (random.below(3), 1 + random.below(D + 2).min(D - 1));
    let coordinate = |random: &mut Random| match family {
        0 => random.below(4) as f64,
        1 => random.below(9) as f64 / 2.0,
        _ => random.between(0.0, 4.0),
    };
    (0..count)
        .map(|_| {
            let mut p = [1.0; D];
            p[..span].iter_mut().for_each(|x| *x = coordinate(random));
            (p, if family == 2 { random.unit() } else { random.below(3) as f64 })
        })
        .collect()
}

fn simplices<T: Triangulation>(t: &T, name: impl Fn(VertexId) -> VertexId) -> BTreeSet<BTreeSet<VertexId>> {
    t.simplices().map(|s| t.corners(s).as_ref().iter().map(|&v| name(v)).collect()).collect()
}

fn queries_by_definition<const D: usize, R: Regular<Point = [f64; D]>>() {
    let mut random = Random::new(21);
    let mut counts = [0; 3];
    for round in 0..share(400) {
        let count = random.below(30);
        let all = sites::<D>(&mut random, count);
        let (points, weights): (Vec<_>, Vec<_>) = all.iter().copied().unzip();
        let mut r = R::from_parts(&points, &weights).expect("finite");
        if round % 2 == 1 && count > 0 {
            r.remove(VertexId::new(random.below(count))).expect("there");
        }
        let site = |v: VertexId| r.site(v).expect("alive");
        for _ in 0..6 {
            let q =
                [(); D].map(|()| [random.below(9) as f64 / 2.0, random.between(-2.0, 6.0)][random.below(2)]);
            let mut expected: Vec<VertexId> = r.vertices().collect();
            expected.sort_by(|&a, &b| {
                let [a, b] = [a, b].map(site);
                compare(q, a, b).then_with(|| a.0.partial_cmp(&b.0).expect("numbers"))
            });
            for k in [0, 1, 3, count, usize::MAX] {
                let found = r.k_nearest(q, k).expect("finite");
                assert_eq!(found, expected[..k.min(expected.len())], "{k} at {q:?} of {all:?}");
            }
            assert_eq!(r.nearest(q), Ok(expected.first().copied()));
            for power in [-1.0, 0.0, 0.25, 2.0, 1e300, random.between(0.0, 9.0)] {
                // A site at the place has the power that its weight is the negative of.
                let is_within = |&v: &VertexId| compare(q, site(v), (q, -power)).is_le();
                let within: Vec<VertexId> = r.vertices().filter(is_within).collect();
                counts[0] += within.len();
                assert_eq!(r.within(q, power), Ok(within), "{power} at {q:?} of {all:?}");
            }
        }
        counts[1] += r.hidden().count();
        counts[2] += usize::from(r.simplex_count() == 0);
    }
    assert!(counts.iter().all(|&count| count > share(100)), "{counts:?}");
    let r = R::default();
    assert_eq!((r.k_nearest([0.0; D], 3), r.within([0.0; D], 1.0)), (Ok(Vec::new()), Ok(Vec::new())));
    assert!(matches!(r.within([0.0; D], f64::NAN), Err(Error::Parameter { name: "power", .. })));
    assert!(matches!(r.k_nearest([f64::INFINITY; D], 1), Err(Error::Coordinate { axis: 0, .. })));
}

#[test]
fn vertices_by_power_in_the_plane() {
    queries_by_definition::<2, Regular2>();
}

#[test]
fn vertices_by_power_in_space() {
    queries_by_definition::<3, Regular3>();
}

/// Sites that are added at once, and those that stay after some are removed, make the triangulation that is built anew.
fn many_at_once<const D: usize, R: Regular<Point = [f64; D]>>(
    compact: impl Fn(&mut R) -> Vec<Option<VertexId>>,
) {
    let mut random = Random::new(22);
    let mut counts = [0; 3];
    for round in 0..share(300) {
        let count = 1 + random.below(40);
        let all = sites::<D>(&mut random, count);
        let first = random.below(all.len());
        let (points, weights): (Vec<_>, Vec<_>) = all.iter().copied().unzip();
        let mut r = R::from_parts(&points[..first], &weights[..first]).expect("finite");
        assert_eq!(r.extend(&all[first..], round as u64), Ok(first..all.len()));
        r.check().unwrap_or_else(|flaw| panic!("{all:?}: {flaw}"));
        let whole = R::from_parts(&points, &weights).expect("finite");
        assert_eq!(simplices(&r, |v| v), simplices(&whole, |v| v), "{first} of {all:?}");
        assert!(r.vertices().eq(whole.vertices()) && r.hidden().eq(whole.hidden()), "{first} of {all:?}");
        assert!(r.duplicates().eq(whole.duplicates()), "{first} of {all:?}");
        assert!((0..all.len()).all(|i| r.site(VertexId::new(i)) == Some(all[i])));
        counts[0] += r.duplicates().count();
        counts[1] += r.hidden().count();

        for _ in 0..random.below(all.len() + 1) {
            let _ = r.remove(VertexId::new(random.below(all.len())));
        }
        let before = r.clone();
        let ids = compact(&mut r);
        r.check().unwrap_or_else(|flaw| panic!("{all:?}: {flaw}"));
        let is_duplicate = |v| before.duplicates().any(|duplicate| duplicate.point == v);
        let mut expected = 0;
        assert_eq!(ids.len(), all.len());
        for (i, id) in ids.iter().enumerate() {
            let old = before.site(VertexId::new(i)).filter(|_| !is_duplicate(i));
            assert_eq!(*id, old.map(|_| VertexId::new(expected)), "{i}: {all:?}");
            assert_eq!(id.and_then(|v| r.site(v)), old, "{i}: {all:?}");
            expected += usize::from(old.is_some());
        }
        assert_eq!((r.ids_given(), r.duplicates().count()), (expected, 0));
        let name = |v: VertexId| ids[v.index()].expect("kept");
        assert_eq!(simplices(&before, name), simplices(&r, |v| v), "{all:?}");
        assert!(before.hidden().map(name).eq(r.hidden()), "{all:?}");
        counts[2] += r.hidden().count();
    }
    assert!(counts.iter().all(|&count| count > share(100)), "{counts:?}");
    // Nothing changes where something is wrong.
    let mut r = R::from_parts(&[[1.0; D]], &[0.0]).expect("finite");
    let wrong = r.extend(&[([0.0; D], 1.0), ([0.0; D], f64::NAN)], 0);
    assert!(matches!(wrong, Err(Error::Weight { index: 1, .. })), "{wrong:?}");
    let wrong = r.extend(&[([0.0; D], 1.0), ([f64::NAN; D], 1.0)], 0);
    assert!(matches!(wrong, Err(Error::NotFinite { index: 1, axis: 0, .. })), "{wrong:?}");
    assert_eq!((r.ids_given(), r.vertex_count(), r.extend(&[], 0)), (1, 1, Ok(1..1)));
}

#[test]
fn many_sites_at_once_in_the_plane() {
    many_at_once::<2, Regular2>(Regular2::compact);
}

#[test]
fn many_sites_at_once_in_space() {
    many_at_once::<3, Regular3>(|r| r.compact().expect("room"));
}

#[test]
fn power_centers_are_where_powers_are_equal() {
    let mut random = Random::new(23);
    for round in 0..share(60) {
        let (points, in_space) =
            (Kind::Uniform.points(40, round as u64), Kind3::Cube.points(30, round as u64));
        let weights: Vec<f64> = (0..40).map(|_| random.unit() / 16.0).collect();
        let r = Regular2::from_parts(&points, &weights).expect("finite");
        for t in r.triangle_ids() {
            let corners = r.mesh().corners(t).map(|v| r.site(v).expect("a vertex"));
            assert!(has_nearest_center(&corners, r.power_center(t).expect("near")), "{corners:?}");
        }
        let r = Regular3::from_parts(&in_space, &weights[..30]).expect("finite");
        for t in r.tetrahedron_ids() {
            let corners = r.mesh().corners(t).map(|v| r.site(v).expect("a vertex"));
            assert!(has_nearest_center(&corners, r.power_center(t).expect("near")), "{corners:?}");
        }
        // Without weights they are the centers of circles and spheres.
        let (r, d) = (
            Regular2::from_parts(&points, &[0.5; 40]).expect("finite"),
            Delaunay2::from_points(&points).expect("finite"),
        );
        let centers = |all: &mut dyn Iterator<Item = Option<[f64; 2]>>| -> BTreeSet<[u64; 2]> {
            all.map(|p| p.expect("near").map(f64::to_bits)).collect()
        };
        let of_weights = centers(&mut r.triangle_ids().map(|t| r.power_center(t)));
        assert_eq!(of_weights, centers(&mut d.triangle_ids().map(|t| d.circumcenter(t))));
        // Ghosts have none.
        let mesh = r.mesh();
        let around = r.vertices().flat_map(|v| mesh.star(v)).map(|e| e.triangle());
        let beyond: Vec<_> = around.filter(|&t| mesh.is_ghost(t)).collect();
        assert!(!beyond.is_empty() && beyond.into_iter().all(|t| r.power_center(t).is_none()));
    }
}

#[test]
fn points_of_space_are_those_of_the_vertices() {
    let points = Kind3::Grid3.points(60, 1);
    let mut d = Delaunay3::from_points(&points).expect("finite");
    d.extend(&points[..5], 0).expect("room");
    d.remove(VertexId::new(2)).expect("there");
    let expected = (0..60).filter(|&i| d.vertices().any(|v| v.index() == i));
    assert!(d.points().eq(expected.map(|i| (VertexId::new(i), points[i]))));
    assert_eq!(d.points().count(), d.vertex_count());
}
