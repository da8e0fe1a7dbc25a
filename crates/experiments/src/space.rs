//! Randomized incremental construction in space: Guibas, Knuth & Sharir 1992, §4.3.
//!
//! The simplices that ever appear are O(n^2) (Theorem 4.6), and for sets whose samples of r points have F(r) tetrahedra O of the sum of
//! F(n / k) / k (4.7): linear where F is. The paper's example says that the size of the result says nothing: two skew lines have
//! a quadratic triangulation, and one more point between them makes it linear, but not what appears before it comes. With weights
//! (Edelsbrunner & Shah 1996) sites are hidden at once or later.

use std::f64::consts::PI;

use delone::{Algorithm3, Delaunay3, Locate, Regular3, Triangulation, Work};
use delone_generators::{Kind3, Random};

use super::trials::Trials;
use super::{Error, Findings, Options, sizes};

/// The set whose points have weights.
const WITH_WEIGHTS: &str = "ball, with weights";

/// Makes `n` points from a seed.
type Make = fn(usize, u64) -> Vec<[f64; 3]>;

/// The largest radius of a site with a weight, in sides of the cube that is its share: more than half of many are hidden.
const RADIUS: f64 = 2.0;

/// The skew lines have a quadratic number of tetrahedra.
const MOST_ON_LINES: usize = 1000;

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut table = options.table(
        "history-space",
        "Per point, in random order: tetrahedra that ever were Delaunay (the paper: O(n) of them in all for a ball, O(n^2) on skew \
         lines, also with the point between them), and flips that trace each point through all",
        &[
            "set",
            "points",
            "hidden / n",
            "in the end / n",
            "ever / n",
            "ever / n^2",
            "made by flips / n",
            "traced",
            "traced / ln n",
            "orientations",
            "conflict tests",
        ],
    );
    let ball: Make = |n, seed| Kind3::Ball.points(n, seed);
    let sets: [(&str, Make, usize); 5] = [
        ("ball", ball, 100_000),
        (WITH_WEIGHTS, ball, 100_000),
        ("sphere", |n, seed| Kind3::Sphere.points(n, seed), 100_000),
        ("skew lines", skew, MOST_ON_LINES),
        ("and a point between", |n, seed| [skew(n - 1, seed), vec![[0.0, 0.0, 0.5]]].concat(), MOST_ON_LINES),
    ];
    for (set, make, most) in sets {
        for n in sizes(100, options.largest.min(most)) {
            let mut trials: [Trials; 7] = Default::default();
            for seed in options.seeds() {
                let points = make(n, seed);
                let ([hidden, end, ever], work) =
                    if set == WITH_WEIGHTS { weighted(&points, seed)? } else { plain(&points, seed)? };
                let counts =
                    [hidden, end, ever, work.created, work.visited, work.orientations, work.in_circles];
                trials.iter_mut().zip(counts).for_each(|(trials, count)| trials.add(count as f64 / n as f64));
            }
            let [hidden, end, ever, made, traced, orientations, tests] = &trials;
            table.row([
                set.to_owned(),
                n.to_string(),
                hidden.to_string(),
                end.to_string(),
                ever.to_string(),
                ever.over(n as f64).to_string(),
                made.to_string(),
                traced.to_string(),
                traced.over((n as f64).ln()).to_string(),
                orientations.to_string(),
                tests.to_string(),
            ]);
        }
    }
    Ok(Findings { tables: vec![table], plots: Vec::new() })
}

/// The sites hidden, the tetrahedra in the end and those that ever were Delaunay, and the work of flips.
fn plain(points: &[[f64; 3]], seed: u64) -> Result<([u64; 3], Work), Error> {
    let d = Delaunay3::with_algorithm(points, Algorithm3::Flips { seed })?;
    let mut tree = Delaunay3::from_points(points)?;
    tree.set_strategy(Locate::DelaunayTree)?;
    let counts = [0, d.tetrahedron_count(), tree.footprint().versions].map(|count| count as u64);
    Ok((counts, d.counters().work().unwrap_or_default()))
}

/// Counts for points in a ball with random radii.
fn weighted(points: &[[f64; 3]], seed: u64) -> Result<([u64; 3], Work), Error> {
    let mut random = Random::new(seed);
    let side = (4.0 / 3.0 * PI / points.len() as f64).cbrt();
    let weights: Vec<f64> = points.iter().map(|_| (random.unit() * RADIUS * side).powi(2)).collect();
    let r = Regular3::by_flips(points, &weights, seed)?;
    let mut grown = Regular3::new();
    let mut ever = 0;
    for (&p, &w) in points.iter().zip(&weights) {
        let v = grown.insert(p, w)?.vertex();
        ever += if grown.is_hidden(v) { 0 } else { grown.simplices_at(v).len() };
    }
    let counts = [r.hidden().count(), r.tetrahedra().count(), ever].map(|count| count as u64);
    Ok((counts, r.counters().work().unwrap_or_default()))
}

/// Points on the x axis, and on a line along y above it: so near the middle of both, for the distance of the lines, that all
/// spheres of theirs hold the point halfway.
fn skew(n: usize, seed: u64) -> Vec<[f64; 3]> {
    let mut random = Random::new(seed);
    let mut point = |i: usize| {
        let x = random.between(-0.4, 0.4);
        if i.is_multiple_of(2) { [x, 0.0, 0.0] } else { [0.0, x, 1.0] }
    };
    (0..n).map(&mut point).collect()
}
