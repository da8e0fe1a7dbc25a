//! Verdicts on simplices of points with weights: ties that others break in another way are right, other differences are not.

use delone::verify::{self, Objection2, Objection3};
use delone::{Regular2, Regular3, Verdict};
use delone_generators::Random;

/// Sites on a lattice, with weights that tie or nearly tie them all.
fn sites<const D: usize>(random: &mut Random, count: usize) -> (Vec<[f64; D]>, Vec<f64>) {
    let family = random.below(3);
    let site = |_| {
        let p: [f64; D] = [(); D].map(|()| random.below(4) as f64);
        let square: f64 = p.iter().map(|x| x * x).sum();
        let weight = match family {
            0 => square,
            1 => random.below(3) as f64,
            _ => square + random.below(2) as f64,
        };
        (p, weight)
    };
    (0..count).map(site).unzip()
}

fn triangles(points: &[[f64; 2]], weights: &[f64]) -> Vec<[u64; 3]> {
    let r = Regular2::from_parts(points, weights).expect("finite");
    r.triangles().map(|t| t.map(|v| v.index() as u64)).collect()
}

fn tetrahedra(points: &[[f64; 3]], weights: &[f64]) -> Vec<[u64; 4]> {
    let r = Regular3::from_parts(points, weights).expect("finite");
    r.tetrahedra().map(|t| t.map(|v| v.index() as u64)).collect()
}

/// The mirror image breaks ties in another way.
fn mirrored<const D: usize>(points: &[[f64; D]]) -> Vec<[f64; D]> {
    let mirror = |p: &[f64; D]| {
        let mut p = *p;
        p[0] = -p[0];
        p
    };
    points.iter().map(mirror).collect()
}

#[test]
fn other_ties_are_right_and_all_else_is_not() {
    let mut random = Random::new(1);
    let (mut others, mut objections) = ([0; 2], [0; 2]);
    for _ in 0..400 {
        let (points, weights) = sites::<2>(&mut random, 12);
        let own = triangles(&points, &weights);
        let verdict = verify::verify_weighted2(&points, &weights, &own).expect("ours");
        assert!(verdict.is_canonical());
        let mirror = triangles(&mirrored(&points), &weights);
        let verdict = verify::verify_weighted2(&points, &weights, &mirror).expect("with other ties");
        assert!(verdict.negative == mirror.len(), "{verdict:?}");
        others[0] += usize::from(!verdict.is_canonical());
        // With other weights.
        let mut changed = weights.clone();
        changed[random.below(12)] += 1.5;
        let found = verify::verify_weighted2(&points, &changed, &own);
        let is_canonical = found.as_ref().is_ok_and(Verdict::is_canonical);
        assert_eq!(is_canonical, as_sets(&own) == as_sets(&triangles(&points, &changed)), "{found:?}");
        objections[0] +=
            usize::from(matches!(found, Err(Objection2::Power { .. } | Objection2::Surfaces(_))));

        let (points, weights) = sites::<3>(&mut random, 12);
        let own = tetrahedra(&points, &weights);
        let verdict = verify::verify_weighted3(&points, &weights, &own).expect("ours");
        assert!(verdict.is_canonical());
        let mirror = tetrahedra(&mirrored(&points), &weights);
        let verdict = verify::verify_weighted3(&points, &weights, &mirror).expect("with other ties");
        others[1] += usize::from(!verdict.is_canonical());
        let mut changed = weights.clone();
        changed[random.below(12)] += 1.5;
        let found = verify::verify_weighted3(&points, &changed, &own);
        let is_canonical = found.as_ref().is_ok_and(Verdict::is_canonical);
        assert_eq!(is_canonical, as_sets(&own) == as_sets(&tetrahedra(&points, &changed)), "{found:?}");
        objections[1] +=
            usize::from(matches!(found, Err(Objection3::Power { .. } | Objection3::Surfaces(_))));
    }
    assert!(others.iter().chain(&objections).all(|&count| count > 100), "{others:?} {objections:?}");
}

fn as_sets<const N: usize>(simplices: &[[u64; N]]) -> Vec<[u64; N]> {
    let mut sorted = simplices.to_vec();
    sorted.iter_mut().for_each(|s| s.sort_unstable());
    sorted.sort_unstable();
    sorted
}

/// Three tetrahedra of which two lie over each other in the hull: the second point is on an edge of the first one.
#[test]
fn what_is_folded_flat_is_no_triangulation() {
    let points: [[f64; 3]; 6] = [
        [0.0, 2.0, 3.0],
        [1.0, 1.0, 3.0],
        [2.0, 0.0, 3.0],
        [2.0, 2.0, 0.0],
        [3.0, 0.0, 0.0],
        [0.0, 3.0, 1.0],
    ];
    let weights = points.map(|p| p.iter().map(|x| x * x).sum());
    let tetrahedra = [[2, 0, 3, 5], [2, 4, 3, 5], [4, 2, 5, 1]];
    let found = verify::verify_weighted3(&points, &weights, &tetrahedra);
    assert!(matches!(found, Err(Objection3::Dent(..))), "{found:?}");
    assert!(verify::verify3(&points, &tetrahedra).is_err());
}

/// Eight tetrahedra of which one has a wrong corner: their border is convex at every edge, and winds around a vertex twice.
#[test]
fn what_winds_twice_is_no_triangulation() {
    let points: [[f64; 3]; 8] = [
        [2.0, 1.0, 2.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 2.0],
        [0.0, 0.0, 1.0],
        [0.0, 1.0, 0.0],
        [0.0, 2.0, 2.0],
        [2.0, 1.0, 0.0],
        [1.0, 2.0, 1.0],
    ];
    let tetrahedra = [
        [7, 4, 2, 5],
        [7, 4, 3, 2],
        [0, 7, 3, 2],
        [0, 7, 2, 5],
        [1, 0, 7, 3],
        [1, 2, 6, 7],
        [1, 7, 4, 3],
        [1, 7, 6, 4],
    ];
    assert!(verify::verify3(&points, &tetrahedra).is_err());
    assert!(verify::verify_weighted3(&points, &[0.0; 8], &tetrahedra).is_err());
}

#[test]
fn equal_sites_and_bad_numbers_are_told_apart() {
    let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [0.0, 0.0]];
    let verify = |weights: &[f64]| verify::verify_weighted2(&points, weights, &[[0, 1, 2]]);
    assert_eq!(verify(&[0.5, 0.0, 0.0, 0.5, 0.0]).map(|verdict| verdict.duplicates), Ok(1));
    assert_eq!(verify(&[0.5, 0.0, 0.0, 0.75, 0.0]), Err(Objection2::Surfaces(3)));
    assert!(matches!(verify(&[0.0; 4]), Err(Objection2::Points(_))));
    assert!(matches!(verify(&[0.0, f64::NAN, 0.0, 0.0, 0.0]), Err(Objection2::Points(_))));
}
