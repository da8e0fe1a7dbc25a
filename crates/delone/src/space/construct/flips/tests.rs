use delone_generators::{Kind3, Random};
use delone_oracle::share;

use super::*;
use crate::mesh::Names;
use crate::space::check::check_geometry;
use crate::space::delaunay::Delaunay3;
use crate::space::regular::Regular3;
use crate::tally::Work;

/// The result to compare: the number of vertices, and the tetrahedra, those at the scaffold too.
fn made<W: Lift>(layer: &Layer<W>) -> (usize, Vec<[usize; 4]>) {
    let index = |p: Place| layer.mesh.names.of(p).index();
    let sorted = |t: TetrahedronId| {
        let mut corners = layer.mesh.cells[t.index()].corners.map(index);
        corners.sort_unstable();
        corners
    };
    let mut all: Vec<_> = layer.mesh.cells().filter(|&t| !layer.mesh.is_ghost(t)).map(sorted).collect();
    all.sort_unstable();
    (layer.mesh.vertex_count, all)
}

/// By flips alone.
fn flipped<W: Lift>(points: &[[f64; 3]], weights: &[W], seed: u64) -> (Layer<W>, Rest) {
    let mut layer = Layer::with_weights(points.to_vec(), weights.to_vec());
    layer.mesh.names = Names::identical(points.len(), |_| true);
    let rest = build(&mut layer, seed, &mut Work::default()).expect("no flip is missing");
    let names = &mut layer.mesh.names;
    for &(v, w) in &rest.equal {
        names.coincide(names.of(v), w);
    }
    rest.hidden.iter().for_each(|&p| names.release(names.of(p)));
    (layer, rest)
}

/// To the last tetrahedron, also where points span less than space, and their scaffold is flipped with them.
#[test]
fn flips_end_in_the_triangulation() {
    for &kind in Kind3::ALL {
        for (n, seeds) in [(1, 1), (2, 1), (3, 2), (4, 3), (5, 3), (8, 3), (30, 3), (200, 2), (900, 1)] {
            for seed in 0..seeds {
                let points = kind.points(n, seed);
                let (layer, rest) = flipped(&points, &vec![(); n], seed);
                let what = format!("{} {n} {seed}", kind.name());
                assert_eq!(check_geometry(&layer), Ok(()), "{what}");
                assert!(rest.hidden.is_empty(), "{what}");
                let d = Delaunay3::from_points(&points).expect("finite");
                assert!(rest.equal.len() == d.duplicates().count(), "{what}");
                assert!(made(&layer) == made(&d.base), "{what}");
            }
        }
    }
}

/// Weights of several families for points: none, few, those that lift all points to one height, and some of any size.
fn weights(points: &[[f64; 3]], family: usize, random: &mut Random) -> Vec<f64> {
    let largest = points.iter().flatten().fold(0.0, |largest, x| f64::max(largest, x.abs()));
    let square = |p: &[f64; 3]| p.iter().map(|x| x * x).sum::<f64>();
    let mut weight = |p: &[f64; 3]| match family {
        0 => 0.0,
        1 => random.below(3) as f64,
        2 => square(p),
        3 => square(p) + [0.0, 0.0, 0.0, 1.0, -1.0][random.below(5)],
        4 => 0.02 * largest * largest * random.unit(),
        _ => 4.0 * largest * largest * random.unit(),
    };
    points.iter().map(&mut weight).map(|w| if w.is_finite() { w } else { f64::MAX }).collect()
}

/// Judges sites with weights, and counts the hidden ones.
fn judge(points: &[[f64; 3]], weights: &[f64], seed: u64, what: &str) -> usize {
    let (layer, rest) = flipped(points, weights, seed);
    assert_eq!(check_geometry(&layer), Ok(()), "{what}: {points:?} {weights:?}");
    let expected = Regular3::from_parts(points, weights).expect("finite");
    let mut found: Vec<usize> = rest.hidden.iter().map(|p| p.index()).collect();
    found.extend(rest.equal.iter().filter(|(_, w)| rest.hidden.contains(w)).map(|(p, _)| p.index()));
    found.sort_unstable();
    assert!(expected.hidden().map(|v| v.index()).eq(found.iter().copied()), "{what}: {points:?} {weights:?}");
    assert!(made(&layer) == made(expected.layer()), "{what}: {points:?} {weights:?}");
    found.len()
}

#[test]
fn flips_hide_what_is_hidden() {
    let mut random = Random::new(1);
    let mut hidden = 0;
    for &kind in Kind3::ALL {
        for family in 0..6 {
            for (n, seeds) in [(1, 1), (3, 2), (4, 2), (5, 2), (6, 2), (9, 3), (30, 2), (200, 1)] {
                for seed in 0..seeds {
                    let points = kind.points(n, seed);
                    let weights = weights(&points, family, &mut random);
                    let what = format!("{} {n} {seed}, weights {family}", kind.name());
                    hidden += judge(&points, &weights, seed, &what);
                }
            }
        }
    }
    assert!(hidden > 7_000, "{hidden}");
}

/// Lattices of few points, where most planes hold many.
#[test]
fn flips_end_on_lattices() {
    let mut random = Random::new(2);
    let mut hidden = 0;
    for round in 0..share(3000) {
        let (side, n) = (2 + random.below(4), 1 + random.below(60));
        let flat = random.below(8);
        let scale = [1.0, 1.0, 1e-200, 1e200][random.below(4)];
        let mut point = || {
            let [x, y, z] = [(); 3].map(|()| random.below(side) as f64);
            match flat {
                0 => [x, y, x + y],
                1 => [x, 2.0 * x, -x],
                2 => [x, y, 1.0],
                _ => [x, y, z],
            }
        };
        let points: Vec<[f64; 3]> = (0..n).map(|_| point()).collect();
        let family = random.below(6);
        let weights: Vec<f64> = weights(&points, family, &mut random);
        let points: Vec<[f64; 3]> = points.iter().map(|p| p.map(|x| x * scale)).collect();
        let weights: Vec<f64> =
            weights.iter().map(|w| (w * scale * scale).clamp(-f64::MAX, f64::MAX)).collect();
        for seed in 0..2 {
            let what = format!("round {round} {seed}, {side} {flat} {scale}, weights {family}");
            hidden += judge(&points, &weights, seed, &what);
        }
    }
    assert!(hidden > share(10_000), "{hidden}");
}
