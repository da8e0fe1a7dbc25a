//! Properties over hostile small sets in space, with shrinking: whatever fails, fails small.

use delone::verify::verify3;
use delone::{Delaunay3, Dimension, VertexId};
use delone_oracle::brute;
use proptest::prelude::*;

/// A coordinate from a few families that meet: small integers, their neighbors in f64, halves, tiny and huge.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => (0_i32..4).prop_map(f64::from),
        2 => (0_i32..4).prop_map(|i| f64::from(i).next_up()),
        1 => (0_i32..8).prop_map(|i| f64::from(i) / 2.0),
        1 => (0_i32..4).prop_map(|i| f64::from(i) * 0.1),
        1 => prop_oneof![Just(1e-300), Just(-1e-300), Just(5e-324), Just(1e300), Just(-1e300), Just(f64::MAX)],
        1 => any::<f64>().prop_filter("finite", |x| x.is_finite()),
    ]
}

fn points(most: usize) -> impl Strategy<Value = Vec<[f64; 3]>> {
    prop::collection::vec([coordinate(), coordinate(), coordinate()], 0..most)
}

fn tetrahedra(d: &Delaunay3) -> Vec<[[f64; 3]; 4]> {
    let sorted = |mut corners: [[f64; 3]; 4]| {
        corners.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
        corners
    };
    let mut all: Vec<_> = d.tetrahedra().map(|t| sorted(t.map(|v| d.point(v).map(|x| x + 0.0)))).collect();
    all.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
    all
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

    #[test]
    fn construction_is_the_oracle(points in points(9)) {
        let d = Delaunay3::from_points(&points).unwrap();
        prop_assert_eq!(d.check(), Ok(()));
        prop_assert_eq!(tetrahedra(&d), brute::delaunay3(&points));
        let written: Vec<[u64; 4]> = d.tetrahedra().map(|t| t.map(|v| v.index() as u64)).collect();
        let verdict = verify3(&points, &written);
        prop_assert!(verdict.is_ok_and(|verdict| verdict.is_canonical()), "{:?}", verdict);
    }

    #[test]
    fn insertion_and_removal_in_any_order(points in points(24), gone in prop::collection::vec(any::<bool>(), 24)) {
        let mut d = Delaunay3::new();
        for p in &points {
            d.insert(*p).unwrap();
        }
        prop_assert_eq!(d.check(), Ok(()));
        let all: Vec<VertexId> = d.vertices().collect();
        for v in all.into_iter().filter(|v| gone[v.index()]) {
            d.remove(v).unwrap();
            prop_assert_eq!(d.check(), Ok(()));
        }
        let left: Vec<[f64; 3]> = d.vertices().map(|v| d.point(v)).collect();
        let fresh = Delaunay3::from_points(&left).unwrap();
        prop_assert_eq!(d.dimension(), fresh.dimension());
        prop_assert_eq!(tetrahedra(&d), tetrahedra(&fresh));
        prop_assert_eq!(d.edges().count(), fresh.edges().count());
    }

    #[test]
    fn scaling_by_a_power_of_two_does_not_matter(points in prop::collection::vec([0_i32..5, 0_i32..5, 0_i32..5], 0..30), k in -300_i32..300) {
        let scale = 2f64.powi(k);
        let scaled: Vec<[f64; 3]> = points.iter().map(|p| p.map(|x| f64::from(x) * scale)).collect();
        let small = Delaunay3::from_points(&points).unwrap();
        let large = Delaunay3::from_points(&scaled).unwrap();
        prop_assert_eq!(large.check(), Ok(()));
        prop_assert_eq!(small.dimension(), large.dimension());
        let back = |t: [[f64; 3]; 4]| t.map(|p| p.map(|x| x / scale));
        prop_assert_eq!(tetrahedra(&small), tetrahedra(&large).into_iter().map(back).collect::<Vec<_>>());
    }

    #[test]
    fn shifts_by_whole_numbers_do_not_matter(points in prop::collection::vec([0_i32..4, 0_i32..4, 0_i32..4], 0..30), by in [-1000_i32..1000, -1000_i32..1000, -1000_i32..1000]) {
        let shifted: Vec<[i32; 3]> = points.iter().map(|p| [0, 1, 2].map(|k| p[k] + by[k])).collect();
        let [here, there] = [&points, &shifted].map(|p| Delaunay3::from_points(p).unwrap());
        let ids = |d: &Delaunay3| {
            let mut all: Vec<[VertexId; 4]> = d.tetrahedra().map(|mut t| { t.sort_unstable(); t }).collect();
            all.sort_unstable();
            all
        };
        prop_assert_eq!(ids(&here), ids(&there));
        if here.dimension() == Dimension::Space {
            prop_assert!(here.tetrahedra().count() > 0);
        }
    }
}
