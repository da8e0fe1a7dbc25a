//! Properties over hostile small sets, with shrinking: whatever fails, fails small.

use delone::{Algorithm2, Delaunay2, Hierarchy, Locate};
use delone_oracle::{brute, share};
use proptest::prelude::*;

/// A coordinate from a few families that meet: small integers, their neighbors in f64, halves, tiny and huge.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => (0_i32..6).prop_map(f64::from),
        2 => (0_i32..6).prop_map(|i| f64::from(i).next_up()),
        1 => (0_i32..12).prop_map(|i| f64::from(i) / 2.0),
        1 => (0_i32..6).prop_map(|i| f64::from(i) * 0.1),
        1 => prop_oneof![Just(1e-300), Just(-1e-300), Just(5e-324), Just(1e300), Just(-1e300), Just(f64::MAX)],
        1 => any::<f64>().prop_filter("finite", |x| x.is_finite()),
    ]
}

fn points() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec([coordinate(), coordinate()], 0..14)
}

fn triangles(d: &Delaunay2) -> Vec<[[f64; 2]; 3]> {
    brute::normalized(d.triangles().map(|corners| corners.map(|v| d.point(v))))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: share(3000) as u32, ..ProptestConfig::default() })]

    #[test]
    fn every_algorithm_is_the_oracle(points in points(), seed in 0_u64..100) {
        let expected = brute::delaunay(&points);
        let all = [
            Algorithm2::DivideAndConquer,
            Algorithm2::Incremental { seed },
            Algorithm2::ConflictLists { seed },
            Algorithm2::Located { locate: Locate::Hierarchy(Hierarchy::default().ratio(2.0).seed(seed)), seed },
            Algorithm2::Located { locate: Locate::History, seed },
        ];
        for algorithm in all {
            let d = Delaunay2::with_algorithm(&points, algorithm).unwrap();
            prop_assert_eq!(d.check(), Ok(()));
            prop_assert_eq!(triangles(&d), expected.clone());
        }
    }

    #[test]
    fn order_does_not_matter(points in points(), turn in 0_usize..14) {
        let mut turned = points.clone();
        let length = turned.len().max(1);
        turned.rotate_left(turn % length);
        turned.reverse();
        let [first, second] = [points, turned].map(|p| Delaunay2::from_points(&p).unwrap());
        prop_assert_eq!(triangles(&first), triangles(&second));
    }

    #[test]
    fn scaling_by_a_power_of_two_does_not_matter(points in prop::collection::vec([0_i32..9, 0_i32..9], 0..20), k in -400_i32..400) {
        let scale = 2f64.powi(k);
        let scaled: Vec<[f64; 2]> = points.iter().map(|p| p.map(|x| f64::from(x) * scale)).collect();
        let small = Delaunay2::from_points(&points).unwrap();
        let large = Delaunay2::from_points(&scaled).unwrap();
        prop_assert_eq!(large.check(), Ok(()));
        let back = |t: [[f64; 2]; 3]| t.map(|p| p.map(|x| x / scale));
        prop_assert_eq!(triangles(&small), brute::normalized(triangles(&large).into_iter().map(back)));
    }

    #[test]
    fn anything_that_is_not_finite_is_named(mut points in points(), at in 0_usize..14, axis in 0_usize..2, bad in prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(f64::NEG_INFINITY)]) {
        if at < points.len() {
            points[at][axis] = bad;
            let error = Delaunay2::from_points(&points).unwrap_err();
            let named = format!("point {at} has the {} coordinate", ["x", "y"][axis]);
            prop_assert!(error.to_string().starts_with(&named), "{}", error);
            for algorithm in [Algorithm2::Incremental { seed: 1 }, Algorithm2::ConflictLists { seed: 1 }] {
                let error = Delaunay2::with_algorithm(&points, algorithm).unwrap_err();
                prop_assert!(error.to_string().starts_with(&named), "{:?} {}", algorithm, error);
            }
        }
    }
}
