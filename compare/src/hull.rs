//! Convex hulls in space: Delone beside Qhull (if `qconvex` is installed) and parry3d, on a sphere and in a ball.

use std::io::Write as _;
use std::panic::{self, AssertUnwindSafe};
use std::process::{Command, Stdio};
use std::time::Instant;

use delone::Hull3;
use delone_generators::Random;

type Points = [[f64; 3]];

/// Seconds and the number of facets; nothing if there is no such program, or it failed.
type Engine = (&'static str, fn(&Points) -> Option<(f64, usize)>);

const ENGINES: &[Engine] = &[("delone", delone), ("qhull", qhull), ("parry3d", parry)];

/// Times all engines and prints the minimum over the runs.
pub fn run(size: usize, runs: usize) {
    let mut random = Random::new(1);
    let square = |p: &[f64; 3]| p.iter().map(|x| x * x).sum::<f64>();
    let ball: Vec<[f64; 3]> = std::iter::repeat_with(|| [0, 1, 2].map(|_| random.between(-1.0, 1.0)))
        .filter(|p| square(p) <= 1.0)
        .take(size)
        .collect();
    let sphere: Vec<[f64; 3]> = ball.iter().map(|p| p.map(|x| x / square(p).sqrt())).collect();
    for (name, points) in [("sphere", &sphere), ("ball", &ball)] {
        let mut best = vec![(f64::INFINITY, 0); ENGINES.len()];
        for _ in 0..runs {
            for ((_, engine), best) in ENGINES.iter().zip(&mut best) {
                if let Ok(Some((seconds, facets))) = panic::catch_unwind(AssertUnwindSafe(|| engine(points)))
                {
                    *best = (best.0.min(seconds), facets);
                }
            }
        }
        println!("\n{name} {size}, ns per point");
        for ((engine, _), (seconds, facets)) in ENGINES.iter().zip(&best) {
            if seconds.is_finite() {
                let ns = seconds * 1e9 / size as f64;
                println!("  {engine:10} {ns:>8.0} {:>6.2} x {facets:>10} facets", seconds / best[0].0);
            } else {
                println!("  {engine:10} not there, or failed");
            }
        }
    }
}

fn delone(points: &Points) -> Option<(f64, usize)> {
    let start = Instant::now();
    let hull = Hull3::from_points(points).ok()?;
    Some((start.elapsed().as_secs_f64(), hull.facets().count()))
}

/// Without reading and writing: what Qhull says itself.
fn qhull(points: &Points) -> Option<(f64, usize)> {
    let mut child = Command::new("qconvex")
        .arg("s")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .ok()?;
    let mut text = format!("3\n{}\n", points.len());
    points.iter().for_each(|[x, y, z]| text.push_str(&format!("{x} {y} {z}\n")));
    child.stdin.take()?.write_all(text.as_bytes()).ok()?;
    let output = child.wait_with_output().ok()?;
    let said = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    let after = |label: &str| said.split(label).nth(1)?.split_whitespace().next().map(str::to_owned);
    let facets = after("Number of facets:")?.parse().ok()?;
    Some((after("compute hull (after input):")?.parse().ok()?, facets))
}

fn parry(points: &Points) -> Option<(f64, usize)> {
    let points: Vec<_> = points.iter().map(|&[x, y, z]| parry3d_f64::math::Vector::new(x, y, z)).collect();
    let start = Instant::now();
    let (_, facets) = parry3d_f64::transformation::try_convex_hull(&points).ok()?;
    Some((start.elapsed().as_secs_f64(), facets.len()))
}
