//! Periodic triangulations of the unit cube: Delone beside its own plain triangulation and CGAL's `Periodic_3`, all with the same
//! tetrahedra, which is judged.

use std::time::Instant;

use delone::{Delaunay3, Image, Lattice3, Periodic3, PeriodicRegular3};
use delone_generators::{Kind3, Random};

/// Corners are exact for all engines on a grid of its inverse.
const GRID: f64 = (1_u64 << 40) as f64;

/// CGAL allows no weight of a 64th of the square of the side or more.
const MOST_WEIGHT: f64 = 1.0 / 65.0;

/// CGAL takes a minute for more sites.
const MOST_SITES_OF_CGAL: usize = 30_000;

/// A tetrahedron up to translation: its corners in order, seen from the first.
type Standing = [(u32, [i32; 3]); 4];

/// Times the engines and prints the minimum over the runs. False if tetrahedra differ.
pub fn run(size: usize, runs: usize) -> bool {
    let points: Vec<[f64; 3]> =
        Kind3::Cube.points(size, 1).iter().map(|p| p.map(|x| (x * GRID).floor() / GRID)).collect();
    let mut random = Random::new(2);
    // Small beside the squares of distances between neighbors, so that few sites are hidden.
    let most = MOST_WEIGHT.min(0.1 * (size as f64).powf(-2.0 / 3.0));
    let weights: Vec<f64> = (0..size).map(|_| random.between(0.0, most)).collect();
    let cube = Lattice3::with_sides([1.0; 3]).expect("a box");
    let (mut plain, mut periodic, mut weighted) = (f64::MAX, f64::MAX, f64::MAX);
    let mut theirs = [f64::MAX; 2];
    let mut good = true;
    let timed = |best: &mut f64, start: Instant| *best = best.min(start.elapsed().as_secs_f64());
    for _ in 0..runs {
        let start = Instant::now();
        Delaunay3::from_points(&points).expect("finite");
        timed(&mut plain, start);
        let start = Instant::now();
        let ours = Periodic3::from_points(&points, &cube).expect("finite");
        timed(&mut periodic, start);
        let start = Instant::now();
        let with_weights = PeriodicRegular3::from_parts(&points, &weights, &cube).expect("finite");
        timed(&mut weighted, start);
        if size > MOST_SITES_OF_CGAL {
            continue;
        }
        let both = [(all(ours.simplices()), None), (all(with_weights.simplices()), Some(&weights[..]))];
        for ((ours, weights), best) in both.into_iter().zip(&mut theirs) {
            let Some((found, seconds)) = cgal(&points, weights, ours.len()) else { continue };
            *best = best.min(seconds);
            if found != ours {
                println!("  CGAL has other tetrahedra: {} and {}", found.len(), ours.len());
                good = false;
            }
        }
    }
    let ns = |seconds: f64| seconds * 1e9 / size as f64;
    println!("\nperiodic cube {size}, ns per site");
    println!(
        "  plain {:.0}, periodic {:.0} ({:.2} times), with weights {:.0}",
        ns(plain),
        ns(periodic),
        periodic / plain,
        ns(weighted)
    );
    for (name, theirs, ours) in [("cgal", theirs[0], periodic), ("cgal with weights", theirs[1], weighted)] {
        if theirs < f64::MAX {
            println!("  {name} {:.0} ({:.1} times ours)", ns(theirs), theirs / ours);
        } else {
            println!("  {name} not there, or too many sites");
        }
    }
    good && lattices_agree(&cube)
}

/// Crystals, whose cells have many corners on one sphere each: CGAL breaks these ties alike.
fn lattices_agree(cube: &Lattice3) -> bool {
    /// Cells of the crystal along each side: a power of two, so that coordinates are exact.
    const CELLS: usize = 4;
    let half = [0.5, 0.5, 0.5];
    let crystals: [(&str, &[[f64; 3]]); 3] = [
        ("simple cubic", &[[0.0; 3]]),
        ("body-centered", &[[0.0; 3], half]),
        ("face-centered", &[[0.0; 3], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.5, 0.5, 0.0]]),
    ];
    let mut good = true;
    for (name, basis) in crystals {
        let corner = |i: usize| [i % CELLS, i / CELLS % CELLS, i / CELLS / CELLS];
        let sites = (0..CELLS.pow(3)).flat_map(|i| {
            let at = corner(i);
            basis.iter().map(move |b| [0, 1, 2].map(|k| (at[k] as f64 + b[k]) / CELLS as f64))
        });
        let sites: Vec<[f64; 3]> = sites.collect();
        let ours = all(Periodic3::from_points(&sites, cube).expect("finite").simplices());
        let Some((found, _)) = cgal(&sites, None, ours.len()) else { continue };
        println!("  {name}, {} sites: {} tetrahedra", sites.len(), ours.len());
        if found != ours {
            println!("  CGAL has other tetrahedra: {}", found.len());
            good = false;
        }
    }
    good
}

fn all(simplices: impl Iterator<Item = [Image<3>; 4]>) -> Vec<Standing> {
    let mut all: Vec<Standing> = simplices
        .map(|corners| standing(corners.map(|(v, o)| (v.index() as u32, o.map(|x| x as i32)))))
        .collect();
    all.sort_unstable();
    all
}

fn standing(corners: Standing) -> Standing {
    let from = |origin: usize| {
        let mut seen = corners.map(|(site, o)| (site, std::array::from_fn(|k| o[k] - corners[origin].1[k])));
        seen.sort_unstable();
        seen
    };
    (1..4).map(from).fold(from(0), Standing::min)
}

#[cfg(cgal)]
fn cgal(points: &[[f64; 3]], weights: Option<&[f64]>, expected: usize) -> Option<(Vec<Standing>, f64)> {
    unsafe extern "C" {
        fn cgal_periodic(
            xyz: *const f64,
            weights: *const f64,
            n: usize,
            out: *mut i32,
            room: usize,
            seconds: *mut f64,
        ) -> usize;
    }
    let mut out = vec![0_i32; 16 * expected];
    let mut seconds = 0.0;
    let weights = weights.map_or(std::ptr::null(), <[f64]>::as_ptr);
    // SAFETY: the arrays have three numbers and, if there are any, a weight for each of the points, and room for as many tetrahedra as is said.
    let count = unsafe {
        cgal_periodic(points.as_ptr().cast(), weights, points.len(), out.as_mut_ptr(), expected, &mut seconds)
    };
    let corner = |c: &[i32]| (c[0] as u32, [c[1], c[2], c[3]]);
    let tetrahedra = out.chunks_exact(16).take(count);
    let mut found: Vec<Standing> =
        tetrahedra.map(|t| standing(std::array::from_fn(|k| corner(&t[4 * k..4 * k + 4])))).collect();
    // More than there is room for are others.
    found.resize(count, Standing::default());
    found.sort_unstable();
    Some((found, seconds))
}

#[cfg(not(cgal))]
fn cgal(_: &[[f64; 3]], _: Option<&[f64]>, _: usize) -> Option<(Vec<Standing>, f64)> {
    None
}
