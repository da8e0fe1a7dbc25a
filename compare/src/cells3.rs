//! Voronoi cells of space, clipped to the unit cube: Delone beside Voro++ (if its headers are installed, Debian: `voro++-dev`).
//!
//! Every engine finds volumes, centers of mass, neighbors, areas of faces and their corners of all cells. Judged by the sum of the volumes and the
//! number of faces.

use std::time::Instant;

use delone::{Delaunay3, Region3};
use delone_generators::Kind3;

type Points = [[f64; 3]];

/// Seconds of each step, the sum of the volumes, and the number of faces.
struct Run {
    steps: Vec<(&'static str, f64)>,
    volume: f64,
    faces: usize,
}

/// Times the engines on uniform points and prints the minimum over the runs. False if volumes do not add up.
pub fn run(size: usize, runs: usize) -> bool {
    let points = Kind3::Cube.points(size, 1);
    let mut good = true;
    println!("\ncube {size}, cells clipped to the cube, ns per site");
    let mut best: Vec<Option<Run>> = vec![None, None];
    for _ in 0..runs {
        for (best, run) in best.iter_mut().zip([Some(delone(&points)), voro(&points)]) {
            let Some(run) = run else { continue };
            match best {
                Some(best) => {
                    best.steps
                        .iter_mut()
                        .zip(&run.steps)
                        .for_each(|(best, step)| best.1 = best.1.min(step.1));
                }
                None => *best = Some(run),
            }
        }
    }
    for (name, best) in ["delone", "voro++"].into_iter().zip(best) {
        let Some(Run { steps, volume, faces }) = best else {
            println!("  {name:8} not there");
            continue;
        };
        let all: f64 = steps.iter().map(|step| step.1).sum();
        let ns = |seconds: f64| seconds * 1e9 / size as f64;
        let steps: Vec<String> =
            steps.iter().map(|(step, seconds)| format!("{step} {:.0}", ns(*seconds))).collect();
        let error = (volume - 1.0).abs();
        println!("  {name:8} {:>8.0}  {}; {faces} faces, volumes {error:.1e} off", ns(all), steps.join(", "));
        good &= error < 1e-9;
    }
    good
}

fn delone(points: &Points) -> Run {
    let start = Instant::now();
    let d = Delaunay3::from_points(points).expect("finite");
    let built = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let cells = d.voronoi().clip(&Region3::cuboid([0.0; 3], [1.0; 3]).expect("a box"));
    let clipped = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let (mut volume, mut faces, mut rest) = (0.0, 0, 0.0);
    for v in d.vertices() {
        let cell = cells.cell(v);
        volume += cell.volume();
        rest += cell.centroid().map_or(0.0, |center| center[0]) + cell.area();
        faces += cell.faces().len();
    }
    assert!(std::hint::black_box(rest).is_finite(), "centers and areas");
    let measured = start.elapsed().as_secs_f64();
    Run { steps: vec![("triangulation", built), ("cells", clipped), ("measures", measured)], volume, faces }
}

#[cfg(voro)]
fn voro(points: &Points) -> Option<Run> {
    unsafe extern "C" {
        fn voro_cells(xyz: *const f64, n: usize, volume: *mut f64, faces: *mut usize) -> f64;
    }
    let (mut volume, mut faces) = (0.0, 0);
    // SAFETY: the array has three numbers for each of the points, and both results have room.
    let seconds = unsafe { voro_cells(points.as_ptr().cast(), points.len(), &mut volume, &mut faces) };
    Some(Run { steps: vec![("all", seconds)], volume, faces })
}

#[cfg(not(voro))]
fn voro(_: &Points) -> Option<Run> {
    None
}
