//! Delone beside its peers: one command, runs interleaved, every result judged exactly.
//!
//! `cargo run --release --manifest-path compare/Cargo.toml -- --help`

mod cells3;
mod changes;
mod constrained;
mod engines;
mod graphs;
mod hull;
mod memory;
mod mesh;
mod periodic;
mod space;
mod surface;
mod tiles;
mod tiles3;
mod voronoi;
mod weights;

use std::fs::File;
use std::io::BufReader;
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Parser;
use delone::verify::verify2;
use delone_generators::Kind;

use engines::{ENGINES, Engine};

/// Time and memory per point of Delone and of other Delaunay software; wrong results are shown as wrong.
#[derive(Parser)]
struct Args {
    /// Points in each set; several sizes give several tables.
    #[arg(long, value_delimiter = ',', default_value = "1000000")]
    size: Vec<usize>,
    /// Runs of each engine, interleaved; the minimum counts.
    #[arg(long, default_value_t = 5)]
    runs: usize,
    /// Sets of points, by name or as files.
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "uniform,clusters,grid,circle,ellipse2,parabola,lognormal,outliers"
    )]
    kinds: Vec<String>,
    /// Engines; all when empty.
    #[arg(long, value_delimiter = ',')]
    engines: Vec<String>,
    /// Time insertion one by one, location, nearest vertex and removal instead of building.
    #[arg(long)]
    changes: bool,
    /// Time Voronoi cells clipped to the bounding box instead of building.
    #[arg(long)]
    voronoi: bool,
    /// Time proximity graphs instead of building.
    #[arg(long)]
    graphs: bool,
    /// Time surfaces instead of building: a cell of a raster beyond the triangulation, by each method, and thinning.
    #[arg(long)]
    surface: bool,
    /// Time triangulation in tiles instead of building.
    #[arg(long)]
    tiles: bool,
    /// Time triangulation in 64 tiles of space of these sets (cube, clusters3, ...) instead, and measure its memory.
    #[arg(long, value_delimiter = ',')]
    tiles3: Vec<String>,
    /// Time Voronoi cells of space instead of building.
    #[arg(long)]
    cells3: bool,
    /// Time periodic triangulations of space instead of building.
    #[arg(long)]
    periodic: bool,
    /// Time convex hulls in space instead of building.
    #[arg(long)]
    hull: bool,
    /// Time triangulations of space of these sets (cube, sphere, ...; or a PLY file) instead.
    #[arg(long, value_delimiter = ',')]
    space: Vec<String>,
    /// Time constrained triangulations of these graphs (planar-subset, koch, ...; or a GeoJSON file of polygons) instead; of
    /// four when empty.
    #[arg(
        long,
        value_delimiter = ',',
        num_args = 0..,
        default_missing_value = "planar-subset,planar-grid,long,koch"
    )]
    constrained: Option<Vec<String>>,
    /// Time refinement of these graphs (koch, ...; or files of polygons or `.poly` files) to meshes instead; of two when empty,
    /// from the root of the repository.
    #[arg(long, value_delimiter = ',', num_args = 0.., default_missing_value = "koch,data/great_lakes.geojson")]
    mesh: Option<Vec<String>>,
    /// The angles that meshes should have at least: degrees.
    #[arg(long, value_delimiter = ',', default_value = "20,25,30,33")]
    angles: Vec<f64>,
    /// A Python that has the package `triangle`; the variable TRIANGLE_PYTHON, or python3, where this is not given.
    #[arg(long)]
    python: Option<PathBuf>,
    /// Seconds after which the refinement of an engine is ended.
    #[arg(long, default_value_t = 120.0)]
    limit: f64,
    /// Time regular triangulations of sites with weights, in the plane and (up to 100,000 sites) in space, instead.
    #[arg(long)]
    weights: bool,
    /// Time the inside of many polygons instead of building.
    #[arg(long)]
    polygons: bool,
    /// Measure peak memory too (one more process for each engine and set).
    #[arg(long)]
    memory: bool,
    /// An engine that takes longer than this many seconds is not run again on the same set.
    #[arg(long, default_value_t = 5.0)]
    patience: f64,
}

/// The results of an engine on a set.
struct Entry {
    engine: &'static Engine,
    times: Vec<Duration>,
    /// Why the result is wrong.
    wrong: Option<String>,
}

impl Entry {
    fn nanoseconds(&self, n: usize) -> Option<f64> {
        self.times.iter().min().map(|time| time.as_secs_f64() * 1e9 / n as f64)
    }
}

fn main() {
    if let Ok(task) = std::env::var(memory::CHILD) {
        memory::child(&task);
        return;
    }
    let args = Args::parse();
    // One thread for all that does not ask for more.
    engines::POOLS[0].install(|| compare(&args));
}

fn compare(args: &Args) {
    let chosen: Vec<&'static Engine> = ENGINES
        .iter()
        .filter(|e| args.engines.is_empty() || args.engines.iter().any(|name| name == e.name))
        .collect();
    if args.changes {
        let chosen = changes::chosen(&args.engines);
        let run = |kind, size, runs| changes::run(&chosen, kind, size, runs);
        std::process::exit(i32::from(!each_set(args, run)));
    }
    if args.surface {
        std::process::exit(i32::from(!each_set(args, surface::run)));
    }
    if args.tiles {
        std::process::exit(i32::from(!each_set(args, tiles::run)));
    }
    if !args.tiles3.is_empty() {
        let each = |name: &String| args.size.iter().all(|&size| tiles3::run(name, size, args.runs));
        let wrong = args.tiles3.iter().filter(|name| !each(name)).count();
        std::process::exit(i32::from(wrong > 0));
    }
    if args.graphs {
        std::process::exit(i32::from(!each_set(args, graphs::run)));
    }
    if args.cells3 {
        let wrong = args.size.iter().filter(|&&size| !cells3::run(size, args.runs)).count();
        std::process::exit(i32::from(wrong > 0));
    }
    if args.periodic {
        let wrong = args.size.iter().filter(|&&size| !periodic::run(size, args.runs)).count();
        std::process::exit(i32::from(wrong > 0));
    }
    if args.hull {
        panic::set_hook(Box::new(|_| {}));
        args.size.iter().for_each(|&size| hull::run(size, args.runs));
        return;
    }
    if !args.space.is_empty() {
        let each =
            |name: &String| args.size.iter().all(|&size| space::run(name, size, args.runs, args.memory));
        let wrong = args.space.iter().filter(|name| !each(name)).count();
        std::process::exit(i32::from(wrong > 0));
    }
    if let Some(names) = &args.constrained {
        panic::set_hook(Box::new(|_| {}));
        let all_right = constrained::run(names, &args.size, &args.engines, args.runs);
        std::process::exit(i32::from(!all_right));
    }
    if let Some(names) = &args.mesh {
        std::process::exit(i32::from(!meshes(args, names)));
    }
    if args.weights {
        let wrong = args.size.iter().filter(|&&size| !weights::run(size, args.runs)).count();
        std::process::exit(i32::from(wrong > 0));
    }
    if args.polygons {
        args.size.iter().for_each(|&size| constrained::polygons(size, args.runs));
        return;
    }
    if args.voronoi {
        panic::set_hook(Box::new(|_| {}));
        std::process::exit(i32::from(!each_set(args, voronoi::run)));
    }
    println!("ns/point, minimum of {} interleaved runs, one thread; output included", args.runs);
    let mut all_right = true;
    panic::set_hook(Box::new(|_| {})); // peers may panic: that is a result, not a report
    for name in &args.kinds {
        let sets: Vec<Vec<[f64; 2]>> = match Kind::named(name) {
            Some(kind) => args.size.iter().map(|&size| kind.points(size, 1)).collect(),
            None => read(name).into_iter().collect(),
        };
        if sets.is_empty() {
            println!("\nthere is no set named {name}, and no file of points");
        }
        for points in sets {
            let size = points.len();
            let mut entries: Vec<_> =
                chosen.iter().map(|engine| Entry { engine, times: Vec::new(), wrong: None }).collect();
            for run in 0..args.runs {
                for entry in &mut entries {
                    measure(entry, &points, run == 0, args.patience);
                    // Small sets come many times over: what counts is not the first time.
                    for _ in 1..POINTS_A_RUN.div_ceil(size.max(1)) {
                        measure(entry, &points, false, args.patience);
                    }
                }
            }
            report(name, size, &entries, args.memory);
            all_right &= entries.iter().all(|e| !e.engine.name.starts_with("delone") || e.wrong.is_none());
        }
    }
    if !all_right {
        println!("\nDelone is wrong somewhere: see above");
        std::process::exit(1);
    }
}

/// Refinement; polygons have a fifth as many corners as sets have points, as in the table of constrained triangulations.
fn meshes(args: &Args, names: &[String]) -> bool {
    let python = args.python.clone().or_else(|| std::env::var_os("TRIANGLE_PYTHON").map(PathBuf::from));
    let python = python.unwrap_or_else(|| "python3".into());
    // Children work in folders of their own; a bare name is looked for in the path.
    let is_path = python.components().count() > 1;
    let python = if is_path { std::path::absolute(&python).unwrap_or(python) } else { python };
    let run = |&size: &usize| {
        mesh::run(&mesh::Plan {
            names,
            size: size / 5,
            angles: &args.angles,
            engines: &args.engines,
            runs: args.runs,
            python: python.clone(),
            limit: Duration::from_secs_f64(args.limit),
        })
    };
    args.size.iter().filter(|size| !run(size)).count() == 0
}

/// Points that are triangulated in one timed run: smaller sets are built repeatedly.
const POINTS_A_RUN: usize = 20_000;

/// The points of a file.
fn read(path: &str) -> Option<Vec<[f64; 2]>> {
    let format = delone_io::Format::of(Path::new(path)).ok()?;
    let file = BufReader::new(File::open(path).ok()?);
    let options = delone_io::ReadOptions::default().dimension(2);
    Some(delone_io::read_points(Box::new(file), format, &options).ok()?.xy)
}

/// Another comparison on each set.
fn each_set(args: &Args, run: impl Fn(Kind, usize, usize) -> bool) -> bool {
    println!("minimum of {} interleaved runs, one thread", args.runs);
    let mut all_right = true;
    for kind in args.kinds.iter().filter_map(|name| Kind::named(name)) {
        for &size in &args.size {
            all_right &= run(kind, size, args.runs);
        }
    }
    all_right
}

/// One run, judged if it is the first.
fn measure(entry: &mut Entry, points: &[[f64; 2]], judge: bool, patience: f64) {
    if points.len() > entry.engine.most {
        entry.wrong = Some(format!("(not run: too slow beyond {} points)", entry.engine.most));
    }
    if entry.wrong.is_some() || entry.times.last().is_some_and(|time| time.as_secs_f64() > patience) {
        return;
    }
    let outcome = panic::catch_unwind(AssertUnwindSafe(|| (entry.engine.run)(points, judge)));
    match outcome {
        Err(_) => entry.wrong = Some("panics".to_owned()),
        Ok(Err(error)) => entry.wrong = Some(error),
        Ok(Ok((time, triangles))) => {
            entry.times.push(time);
            if judge {
                entry.wrong = verify2(points, &triangles).err().map(|objection| objection.to_string());
            }
        }
    }
}

fn report(name: &str, size: usize, entries: &[Entry], memory: bool) {
    println!("\n{name} {size}");
    let ours = entries.iter().find(|e| e.engine.name == "delone").and_then(|e| e.nanoseconds(size));
    for entry in entries {
        let time = entry.nanoseconds(size).map_or("-".to_owned(), |ns| format!("{ns:.0}"));
        let ratio = match (ours, entry.nanoseconds(size)) {
            (Some(ours), Some(theirs)) => format!("{:.2} x", theirs / ours),
            _ => String::new(),
        };
        let bytes = if memory && !entry.times.is_empty() {
            crate::memory::peak(entry.engine.name, name, size)
        } else {
            None
        };
        let bytes = bytes.map_or(String::new(), |bytes| format!("{bytes:.0} B/point"));
        let wrong = entry.wrong.as_ref().map_or(String::new(), |why| {
            if why.starts_with('(') { why.clone() } else { format!("WRONG: {why}") }
        });
        println!("  {:20} {time:>8} {ratio:>8} {bytes:>12}  {wrong}", entry.engine.name);
    }
    let best = |among: fn(&Engine) -> bool| {
        let right = entries.iter().filter(|e| e.wrong.is_none() && among(e.engine));
        right.filter_map(|e| e.nanoseconds(size)).min_by(f64::total_cmp)
    };
    if let Some(ours) = ours {
        let ratio = |time: Option<f64>| time.map_or("-".to_owned(), |time| format!("{:.2} x", time / ours));
        println!(
            "  best correct Rust crate / delone: {}; CGAL / delone: {}",
            ratio(best(|e| e.is_peer_crate)),
            ratio(best(|e| e.name.starts_with("cgal")))
        );
    }
}
