//! Constrained triangulations: the graphs of the table, and what is known of each engine on them.

mod engines;
mod polygons;

use std::fs::File;
use std::io::BufReader;
use std::ops::Range;
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::time::Duration;

use delone_generators::Graph;
use delone_oracle::certificate::{Flaw, certify};

use engines::{ENGINES, Engine, Output};
pub use polygons::run as polygons;

/// The input of all engines.
pub struct Set {
    name: String,
    points: Vec<[f64; 2]>,
    segments: Vec<[usize; 2]>,
    /// The corners of each polygon, with its holes: the ranges of their rings.
    polygons: Vec<Vec<Range<usize>>>,
}

/// All engines on each of the graphs: names, or files of polygons. False if an engine of ours is wrong.
pub fn run(names: &[String], sizes: &[usize], chosen: &[String], runs: usize) -> bool {
    println!(
        "minimum and median of {runs} alternating runs, one thread; triangles of the convex hull, or of the inside"
    );
    let is_chosen = |engine: &&Engine| chosen.is_empty() || chosen.iter().any(|name| name == engine.name);
    let engines: Vec<&Engine> = ENGINES.iter().filter(is_chosen).collect();
    let mut all_right = true;
    for name in names {
        let sets: Vec<Set> = match Graph::named(name) {
            Some(graph) => sizes.iter().map(|&size| generated(graph, size)).collect(),
            None => read(name).into_iter().collect(),
        };
        if sets.is_empty() {
            println!("\nthere is no graph named {name}, and no file of polygons");
        }
        for set in sets {
            all_right &= compare(&set, &engines, runs);
        }
    }
    all_right
}

/// Of polygons, which take longer to look at than to make, a fifth: 196,608 corners of Koch's for a million.
fn generated(graph: Graph, size: usize) -> Set {
    let size = if graph.is_polygon() { size / 5 } else { size };
    let (points, segments) = graph.parts(size, 1);
    let polygons = if graph.is_polygon() { vec![vec![0..points.len()]] } else { Vec::new() };
    Set { name: graph.name().to_owned(), points, segments, polygons }
}

/// Twice the signed area, about.
fn area(ring: &[[f64; 2]]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(p, q)| p[0] * q[1] - p[1] * q[0]).sum()
}

/// The polygons of a file: a ring that goes around in the other sense than the first is a hole of the one before.
fn read(path: &str) -> Option<Set> {
    let format = delone_io::Format::of(Path::new(path)).ok()?;
    let file = BufReader::new(File::open(path).ok()?);
    let rings = delone_io::read_rings(Box::new(file), format).ok()?.rings;
    let mut set =
        Set { name: path.to_owned(), points: Vec::new(), segments: Vec::new(), polygons: Vec::new() };
    let sense = area(rings.first()?).is_sign_positive();
    for mut ring in rings {
        if ring.first() == ring.last() {
            ring.pop();
        }
        let (first, n) = (set.points.len(), ring.len());
        set.segments.extend((0..n).map(|i| [first + i, first + (i + 1) % n]));
        set.points.extend(&ring);
        match set.polygons.last_mut() {
            Some(polygon) if area(&ring).is_sign_positive() != sense => polygon.push(first..first + n),
            _ => set.polygons.push(std::iter::once(first..first + n).collect()),
        }
    }
    Some(set)
}

/// The results of an engine on a graph.
struct Entry {
    engine: &'static Engine,
    times: Vec<Duration>,
    triangles: usize,
    remark: Remark,
}

enum Remark {
    /// Proved.
    Canonical,
    /// The inside alone, and how many of its triangles are not those of the canonical triangulation.
    Inside(Option<usize>),
    Flaw(Flaw),
    Failed(String),
    Unknown,
}

fn compare(set: &Set, engines: &[&'static Engine], runs: usize) -> bool {
    let mut entries: Vec<Entry> = engines
        .iter()
        .map(|engine| Entry { engine, times: Vec::new(), triangles: 0, remark: Remark::Unknown })
        .collect();
    let mut canonical: Option<Vec<[usize; 3]>> = None;
    for round in 0..runs {
        for entry in &mut entries {
            if matches!(entry.remark, Remark::Failed(_)) {
                continue;
            }
            let outcome = panic::catch_unwind(AssertUnwindSafe(|| (entry.engine.run)(set, round == 0)));
            match outcome.unwrap_or_else(|_| Err("panics".to_owned())) {
                Err(why) => entry.remark = Remark::Failed(why),
                Ok(Output { time, triangles, is_inside }) => {
                    entry.times.push(time);
                    if round == 0 {
                        entry.triangles = triangles.len();
                        entry.remark = judge(set, triangles, is_inside, &mut canonical);
                    }
                }
            }
        }
    }
    report(set, &mut entries);
    // What is in brackets says why an engine was not asked.
    let is_wrong = |e: &Entry| {
        let fails = match &e.remark {
            Remark::Flaw(_) => true,
            Remark::Failed(why) => !why.starts_with('('),
            _ => false,
        };
        fails && e.engine.name.starts_with("delone")
    };
    !entries.iter().any(is_wrong)
}

/// Each starts with its least index.
fn turned([a, b, c]: [usize; 3]) -> [usize; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

fn judge(
    set: &Set,
    triangles: Vec<[usize; 3]>,
    is_inside: bool,
    canonical: &mut Option<Vec<[usize; 3]>>,
) -> Remark {
    if is_inside {
        let Some(canonical) = canonical else { return Remark::Inside(None) };
        let is_other = |t: &&[usize; 3]| canonical.binary_search(&turned(**t)).is_err();
        return Remark::Inside(Some(triangles.iter().filter(is_other).count()));
    }
    match certify(&set.points, &set.segments, &triangles) {
        Ok(_) => {
            let mut sorted: Vec<_> = triangles.into_iter().map(turned).collect();
            sorted.sort_unstable();
            *canonical = Some(sorted);
            Remark::Canonical
        }
        Err(flaw) => Remark::Flaw(flaw),
    }
}

fn report(set: &Set, entries: &mut [Entry]) {
    let n = set.points.len();
    println!("\n{}: {n} points, {} segments", set.name, set.segments.len());
    println!("  {:20} {:>8} {:>8} {:>9} {:>8} {:>10}", "", "minimum", "median", "ns/point", "", "triangles");
    entries.iter_mut().for_each(|entry| entry.times.sort_unstable());
    let least = |entry: &Entry| entry.times.first().map(Duration::as_secs_f64);
    let ours = entries.iter().find(|e| e.engine.name == "delone").and_then(least);
    for entry in entries.iter() {
        let remark = match &entry.remark {
            Remark::Canonical => "canonical, proved".to_owned(),
            Remark::Inside(None) => "the inside".to_owned(),
            Remark::Inside(Some(other)) => {
                format!(
                    "the inside; {:.1} % are not canonical",
                    100.0 * *other as f64 / entry.triangles as f64
                )
            }
            Remark::Flaw(Flaw::InCircle { .. }) => "not canonical: ties, or not Delaunay".to_owned(),
            Remark::Flaw(flaw) => format!("WRONG: {flaw:?}"),
            Remark::Failed(why) if why.starts_with('(') => why.clone(),
            Remark::Failed(why) => format!("FAILS: {why}"),
            Remark::Unknown => String::new(),
        };
        let (Some(minimum), Some(median)) = (least(entry), entry.times.get(entry.times.len() / 2)) else {
            println!(
                "  {:20} {:>8} {:>8} {:>9} {:>8} {:>10}  {remark}",
                entry.engine.name, "-", "-", "-", "", ""
            );
            continue;
        };
        let ratio = ours.map_or(String::new(), |ours| format!("{:.2} x", minimum / ours));
        println!(
            "  {:20} {minimum:>8.3} {:>8.3} {:>9.0} {ratio:>8} {:>10}  {remark}",
            entry.engine.name,
            median.as_secs_f64(),
            minimum * 1e9 / n as f64,
            entry.triangles,
        );
    }
}
