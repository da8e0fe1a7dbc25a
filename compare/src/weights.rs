//! Regular triangulations of sites with weights: Delone beside CGAL, whose perturbation is the same, so that triangles must be
//! equal, ties and hidden sites included.

use std::time::Instant;

use delone::{Delaunay2, Delaunay3, Regular2, Regular3, Triangulation};
use delone_generators::{Kind, Kind3, Random};

use crate::engines::POOLS;

/// Weights for points with a spacing between them.
type Weights = fn(&mut Random, f64, &[f64]) -> f64;

/// Radii up to a share of the spacing; and weights that tie all points of a lattice.
const SETS: [(&str, Weights); 4] = [
    ("radii to 0.3 spacings", |r, spacing, _| (0.3 * spacing * r.unit()).powi(2)),
    ("radii to 3 spacings", |r, spacing, _| (3.0 * spacing * r.unit()).powi(2)),
    ("steps of a quarter of the spacing squared", |r, spacing, _| {
        // Of a power of two, so that many tie.
        let step = 2f64.powi(spacing.log2().floor() as i32);
        r.below(5) as f64 * step * step / 4.0
    }),
    ("lifted points on a plane", |_, _, p| p.iter().map(|x| x * x).sum()),
];

/// Simplices as sorted indices, and the seconds that they took.
type Run<const N: usize> = (f64, Vec<[u32; N]>);

fn sorted<const N: usize>(mut simplices: Vec<[u32; N]>) -> Vec<[u32; N]> {
    simplices.iter_mut().for_each(|s| s.sort_unstable());
    simplices.sort_unstable();
    simplices
}

fn simplices<T: Triangulation, const N: usize>(t: &T) -> Vec<[u32; N]> {
    let corners = |s| {
        let corners = t.corners(s);
        std::array::from_fn(|k| corners.as_ref()[k].index() as u32)
    };
    sorted(t.simplices().map(corners).collect())
}

fn timed<T>(build: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let built = build();
    (start.elapsed().as_secs_f64(), built)
}

/// Times all engines on sets of the plane and of space; false if triangles differ.
pub fn run(size: usize, runs: usize) -> bool {
    let mut all_right = true;
    for kind in [Kind::Uniform, Kind::Grid] {
        let points = kind.points(size, 1);
        let all: Vec<[f64; 2]> = points.clone();
        for (name, weight) in SETS {
            if (name == SETS[3].0) != (kind == Kind::Grid) {
                continue;
            }
            let weights = weights(&all, weight, 1.0 / 2.0);
            println!("\nplane, {} {size}, {name}, ns per site", kind.name());
            all_right &= table(runs, points.len(), engines_2(&points, &weights));
        }
    }
    for kind in [Kind3::Cube, Kind3::Grid3] {
        let points = kind.points(size, 1);
        for (name, weight) in SETS {
            if (name == SETS[3].0) != (kind == Kind3::Grid3) {
                continue;
            }
            let weights = weights(&points, weight, 1.0 / 3.0);
            println!("\nspace, {} {}, {name}, ns per site", kind.name(), points.len());
            all_right &= table(runs, points.len(), engines_3(&points, &weights));
        }
    }
    all_right
}

fn weights<const D: usize>(points: &[[f64; D]], weight: Weights, power: f64) -> Vec<f64> {
    let side = (0..D).map(|k| points.iter().fold(0.0_f64, |m, p| m.max(p[k].abs()))).fold(0.0, f64::max);
    let spacing = side / (points.len() as f64).powf(power);
    let mut random = Random::new(2);
    points.iter().map(|p| weight(&mut random, spacing, p)).collect()
}

type Engine<'a, const N: usize> = (&'static str, bool, Box<dyn Fn() -> Run<N> + 'a>);

fn engines_2<'a>(points: &'a [[f64; 2]], weights: &'a [f64]) -> Vec<Engine<'a, 3>> {
    let delone = move || {
        let (seconds, r) = timed(|| Regular2::from_parts(points, weights).expect("finite"));
        (seconds, simplices(&r))
    };
    let plain = move || {
        let (seconds, d) = timed(|| Delaunay2::from_points(points).expect("finite"));
        (seconds, simplices(&d))
    };
    let two = move || POOLS[1].install(delone);
    let one_by_one = move || {
        let (seconds, r) = timed(|| Regular2::with_seed(points, weights, 0).expect("finite"));
        (seconds, simplices(&r))
    };
    // From weights in which about one edge in a hundred is another one.
    let spacing = (points.len() as f64).sqrt().recip() * points.iter().flatten().fold(0.0, |m, &x| x.max(m));
    let mut random = Random::new(3);
    let before = weights.iter().map(|w| w + 0.02 * spacing * spacing * (random.unit() - 0.5));
    let before = Regular2::from_parts(points, &before.collect::<Vec<_>>()).expect("finite");
    let step = move || {
        let mut r = before.clone();
        let (seconds, _) = timed(|| r.set_weights(weights).expect("finite"));
        (seconds, simplices(&r))
    };
    vec![
        ("delone", true, Box::new(delone)),
        ("delone-2-threads", true, Box::new(two)),
        ("delone-incremental", true, Box::new(one_by_one)),
        ("delone, one step", true, Box::new(step)),
        #[cfg(cgal)]
        ("cgal", true, Box::new(|| cgal::plane(points, weights))),
        ("delone, no weights", false, Box::new(plain)),
    ]
}

fn engines_3<'a>(points: &'a [[f64; 3]], weights: &'a [f64]) -> Vec<Engine<'a, 4>> {
    let delone = move || {
        let (seconds, r) = timed(|| Regular3::from_parts(points, weights).expect("finite"));
        (seconds, simplices(&r))
    };
    let plain = move || {
        let (seconds, d) = timed(|| Delaunay3::from_points(points).expect("finite"));
        (seconds, simplices(&d))
    };
    let two = move || POOLS[1].install(delone);
    vec![
        ("delone", true, Box::new(delone)),
        ("delone-2-threads", true, Box::new(two)),
        #[cfg(cgal)]
        ("cgal", true, Box::new(|| cgal::space(points, weights))),
        ("delone, no weights", false, Box::new(plain)),
    ]
}

/// In turns; the least of the times counts.
fn table<const N: usize>(runs: usize, count: usize, engines: Vec<Engine<'_, N>>) -> bool {
    let mut best = vec![f64::INFINITY; engines.len()];
    let mut found: Vec<Vec<[u32; N]>> = vec![Vec::new(); engines.len()];
    for _ in 0..runs {
        for (k, (_, _, engine)) in engines.iter().enumerate() {
            let (seconds, simplices) = engine();
            best[k] = best[k].min(seconds);
            found[k] = simplices;
        }
    }
    let mut all_right = true;
    for (k, (name, is_weighted, _)) in engines.iter().enumerate() {
        let ns = best[k] * 1e9 / count as f64;
        let is_right = !is_weighted || found[k] == found[0];
        all_right &= is_right;
        let judged = match (is_weighted, is_right) {
            (true, true) => "the same simplices",
            (true, false) => "OTHER SIMPLICES",
            _ => "",
        };
        println!("  {name:20} {ns:>8.0} {:>6.2} x {:>10} {judged}", best[k] / best[0], found[k].len());
    }
    all_right
}

#[cfg(cgal)]
mod cgal {
    use super::{Run, sorted};

    unsafe extern "C" {
        fn cgal_regular_2(
            xy: *const f64,
            weights: *const f64,
            n: usize,
            triangles: *mut u32,
            seconds: *mut f64,
        ) -> usize;
        fn cgal_regular_3(
            xyz: *const f64,
            weights: *const f64,
            n: usize,
            tetrahedra: *mut u32,
            room: usize,
            seconds: *mut f64,
        ) -> usize;
    }

    pub fn plane(points: &[[f64; 2]], weights: &[f64]) -> Run<3> {
        let (mut triangles, mut seconds) = (vec![[0; 3]; 2 * points.len() + 1], 0.0);
        let n = points.len();
        // SAFETY: as many numbers as said, and room for all triangles that there can be.
        let count = unsafe {
            let out = triangles.as_mut_ptr().cast();
            cgal_regular_2(points.as_ptr().cast(), weights.as_ptr(), n, out, &raw mut seconds)
        };
        triangles.truncate(count);
        (seconds, sorted(triangles))
    }

    pub fn space(points: &[[f64; 3]], weights: &[f64]) -> Run<4> {
        let (mut tetrahedra, mut seconds) = (vec![[0; 4]; 12 * points.len() + 1], 0.0);
        let (n, room) = (points.len(), tetrahedra.len());
        // SAFETY: as many numbers as said, and it writes no more than there is room for.
        let count = unsafe {
            let out = tetrahedra.as_mut_ptr().cast();
            cgal_regular_3(points.as_ptr().cast(), weights.as_ptr(), n, out, room, &raw mut seconds)
        };
        assert!(count <= room, "{count} tetrahedra");
        tetrahedra.truncate(count);
        (seconds, sorted(tetrahedra))
    }
}
