//! Triangulations of space: Delone beside CGAL (if its headers are installed) and Qhull (if `qdelaunay` is, up to 1e5
//! points). Every engine must find as many tetrahedra.

use std::io::Write as _;
use std::process::{Command, Stdio};
use std::time::Instant;

use delone::Delaunay3;
use delone_generators::Kind3;

use crate::engines::POOLS;

type Points = [[f64; 3]];

/// Seconds to build, the number of tetrahedra where points are in general position, and seconds to remove each of the
/// first tenth of the points.
type Run = Option<(f64, usize, Option<f64>)>;

type Engine = (&'static str, fn(&Points) -> Run);

const ENGINES: &[Engine] = &[
    ("delone", delone),
    ("delone-2-threads", delone_on_two_threads),
    #[cfg(cgal)]
    ("cgal", cgal_plain),
    #[cfg(cgal)]
    ("cgal-indexed", cgal),
    ("qhull", qhull),
];

/// Times all engines and prints the minimum over the runs. False if numbers of tetrahedra differ.
pub fn run(name: &str, size: usize, runs: usize, memory: bool) -> bool {
    let points = match Kind3::named(name) {
        Some(kind) => kind.points(size, 1),
        None => match scan(name) {
            Some(points) => points,
            None => {
                println!("\n{name}: neither a set nor a model that can be read");
                return true;
            }
        },
    };
    let n = points.len();
    let mut best = vec![(f64::INFINITY, 0, f64::INFINITY); ENGINES.len()];
    for _ in 0..runs {
        for ((_, engine), best) in ENGINES.iter().zip(&mut best) {
            if let Some((seconds, cells, removal)) = engine(&points) {
                *best = (best.0.min(seconds), cells, best.2.min(removal.unwrap_or(f64::INFINITY)));
            }
        }
    }
    println!("\n{name} {n}, ns per point: to build, and to remove a random tenth one by one");
    for ((engine, _), (seconds, cells, removal)) in ENGINES.iter().zip(&best) {
        if seconds.is_finite() {
            let ns = seconds * 1e9 / n as f64;
            print!("  {engine:16} {ns:>8.0} {:>6.2} x {cells:>10} tetrahedra", seconds / best[0].0);
            if removal.is_finite() {
                print!(" {:>10.0} {:>6.2} x", removal * 1e9, removal / best[0].2);
            }
            let peak =
                if memory { crate::memory::peak(&format!("space/{engine}"), name, size) } else { None };
            if let Some(bytes) = peak {
                print!(" {bytes:>6.0} B/point");
            }
            println!();
        }
    }
    let general = matches!(name, "cube" | "ball" | "balls" | "clusters3");
    !general
        || best.iter().all(|&(seconds, cells, _)| !seconds.is_finite() || cells == 0 || cells == best[0].1)
}

/// Builds once, for who measures memory. Delone is given the points themselves.
pub fn build(name: &str, points: Vec<[f64; 3]>) -> Option<()> {
    match name {
        "delone" => Delaunay3::from_vec(points).ok().map(drop),
        "delone-2-threads" => POOLS[1].install(|| Delaunay3::from_vec(points).ok().map(drop)),
        _ => {
            let engine = ENGINES.iter().find(|engine| engine.0 == name)?;
            (engine.1)(&points).map(drop)
        }
    }
}

/// The vertices of a model in PLY, ascii or binary, as far as three doubles or floats begin each.
fn scan(path: &str) -> Option<Vec<[f64; 3]>> {
    let file = std::io::BufReader::new(std::fs::File::open(path).ok()?);
    let cloud =
        delone_io::read_points(Box::new(file), delone_io::Format::Ply, &delone_io::ReadOptions::default())
            .ok()?;
    let z = cloud.z?;
    Some(cloud.xy.iter().zip(z).map(|(&[x, y], z)| [x, y, z]).collect())
}

fn delone(points: &Points) -> Run {
    let start = Instant::now();
    let mut d = Delaunay3::from_points(points).ok()?;
    let seconds = start.elapsed().as_secs_f64();
    let cells = d.tetrahedra().count();
    let start = Instant::now();
    let mut removed = 0_u32;
    for v in d.vertices().take(points.len() / 10).collect::<Vec<_>>() {
        d.remove(v).ok()?;
        removed += 1;
    }
    Some((seconds, cells, Some(start.elapsed().as_secs_f64() / f64::from(removed.max(1)))))
}

fn delone_on_two_threads(points: &Points) -> Run {
    let start = Instant::now();
    let d = POOLS[1].install(|| Delaunay3::from_points(points)).ok()?;
    Some((start.elapsed().as_secs_f64(), d.tetrahedra().count(), None))
}

#[cfg(cgal)]
unsafe extern "C" {
    fn cgal_space(xyz: *const f64, n: usize, m: usize, seconds: *mut f64) -> usize;
    fn cgal_space_plain(xyz: *const f64, n: usize) -> f64;
}

#[cfg(cgal)]
fn cgal_plain(points: &Points) -> Run {
    // SAFETY: the shim reads n points.
    Some((unsafe { cgal_space_plain(points.as_ptr().cast(), points.len()) }, 0, None))
}

#[cfg(cgal)]
fn cgal(points: &Points) -> Run {
    let mut seconds = [0.0; 2];
    // SAFETY: the shim reads n points and writes two times.
    let cells =
        unsafe { cgal_space(points.as_ptr().cast(), points.len(), points.len() / 10, seconds.as_mut_ptr()) };
    Some((seconds[0], cells, Some(seconds[1] / (points.len() / 10) as f64)))
}

/// Without reading and writing: what Qhull says itself.
fn qhull(points: &Points) -> Run {
    if points.len() > 100_000 {
        return None;
    }
    let mut child = Command::new("qdelaunay")
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
    Some((after("compute hull (after input):")?.parse().ok()?, 0, None))
}
