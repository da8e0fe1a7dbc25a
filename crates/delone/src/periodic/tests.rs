use delone_generators::Random;

use super::copies::first_halo;
use super::quotient::Quotient;
use super::reduced::{MORE, covering_radius};
use super::{Lattice3, within};
use crate::space::Delaunay3;

/// On a grid of its inverse everything here is exact.
const FINE: f64 = (1 << 20) as f64;

/// A halo that passes the test gives what the widest gives, which is proved to be enough; and some do not pass.
#[test]
fn halos_do_not_show() {
    let lattices = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [-0.25, 0.5, 1.5]],
        [[4.0, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.5]],
    ];
    let mut enough = [0; 2];
    for (i, axes) in lattices.into_iter().enumerate() {
        for n in [1, 2, 5, 40] {
            let mut random = Random::new((10 * n + i) as u64);
            // Half of the sets are clusters.
            let size = if n % 2 == 0 { 1.0 } else { 0.2 };
            let points: Vec<[f64; 3]> = (0..n).map(|_| [(); 3].map(|()| random.between(0.0, size))).collect();
            for periodic in [[true; 3], [true, true, false], [false, true, false]] {
                let lattice = Lattice3::with_axes(axes).expect("a lattice").periodic(periodic);
                let lattice = lattice.prepare(&points).expect("a lattice");
                let places: Vec<[f64; 3]> =
                    points.iter().map(|&p| lattice.wrap(p).expect("near").0.place).collect();
                let widest = 2.0 * MORE * covering_radius(&lattice.reduced);
                let all = |q: Quotient<Delaunay3, 3, 4>| {
                    let mut all: Vec<_> = (0..q.simplices.len())
                        .map(|number| {
                            let mut corners = q.corners(number);
                            corners.sort_unstable();
                            corners
                        })
                        .collect();
                    all.sort_unstable();
                    all
                };
                let margins = |halo: f64| lattice.reduced.iter().map(|v| halo / v.width).collect::<Vec<_>>();
                let expected =
                    all(within(&lattice, &places, &[], &margins(widest)).expect("few").expect("enough"));
                for k in [1, 2, 3, 5, 8] {
                    let halo = widest * f64::from(k) / 12.0;
                    let found = within(&lattice, &places, &[], &margins(halo)).expect("few").map(&all);
                    enough[usize::from(found.is_some())] += 1;
                    if let Some(found) = found {
                        assert!(found == expected || found.is_empty(), "{axes:?} {n} {periodic:?} {halo}");
                    }
                }
                assert!(first_halo(&lattice, &places) > 0.0);
            }
        }
    }
    assert!(enough.iter().all(|&count| count > 20), "{enough:?}");
}

/// Points that differ by a vector of the lattice have one place, on its faces, edges and corners too.
#[test]
fn copies_have_one_place() {
    let axes = [[3.0, 0.0, 0.0], [1.0, 2.0, 0.0], [0.5, -1.0, 4.0]];
    let lattice = Lattice3::with_axes(axes).expect("a lattice").prepare(&[]).expect("a lattice");
    let mut random = Random::new(7);
    for _ in 0..2000 {
        let at = [(); 3].map(|()| [0.0, 0.5, 1.0, random.between(0.0, 1.0)][random.below(4)]);
        let times = [(); 3].map(|()| random.below(2_000_001) as f64 - 1e6);
        let moved = |by: [f64; 3]| std::array::from_fn(|k| (0..3).map(|i| by[i] * axes[i][k]).sum::<f64>());
        let place: [f64; 3] = moved(at);
        let place = place.map(|x| (x * FINE).round() / FINE);
        let far: [f64; 3] = std::array::from_fn(|k| place[k] + moved(times)[k]);
        let [(near, _), (far, _)] = [place, far].map(|p| lattice.wrap(p).expect("near"));
        assert_eq!(near.place, far.place);
        let apart: [i64; 3] = std::array::from_fn(|k| far.offset[k] - near.offset[k]);
        assert_eq!(lattice.in_axes(apart), times.map(|x| x as i64));
    }
}
