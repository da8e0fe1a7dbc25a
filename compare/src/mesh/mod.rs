//! Refinement to meshes without small angles: the inputs, and what is known of each engine on them at each angle.
//!
//! Every engine gets the same points, segments and points in holes, starts from these arrays, and runs in a process of its own.

mod chains;
mod child;
mod engines;
mod input;
mod judge;
mod summary;
mod wedges;

use std::path::{Path, PathBuf};
use std::time::Duration;

pub use child::child;
use child::{Folder, Sample};
use engines::{ENGINES, Engine, TRIANGLE};
use input::Input;
use judge::{Verdict, judge};
use summary::{Row, Summary};
use wedges::Wedges;

/// The measurements to make.
pub struct Plan<'a> {
    /// Graphs by name, or files.
    pub names: &'a [String],
    /// Corners of those that are generated.
    pub size: usize,
    /// Degrees.
    pub angles: &'a [f64],
    /// Engines; all when empty.
    pub engines: &'a [String],
    pub runs: usize,
    /// A Python that may have Triangle.
    pub python: PathBuf,
    /// An engine that takes longer is ended.
    pub limit: Duration,
}

/// The results of an engine on an input at an angle.
struct Entry {
    engine: &'static Engine,
    samples: Vec<Sample>,
    verdict: Verdict,
    failure: Option<String>,
}

/// Triangles, from which on peak memory is reported; below, it is that of pages and not of a mesh.
const MEASURED_TRIANGLES: usize = 10_000;

/// All engines on all inputs at all angles. False if an engine of ours is wrong.
pub fn run(plan: &Plan) -> bool {
    println!(
        "no angle below a bound, no bound on areas; from points and segments to the refined mesh, one thread;"
    );
    println!("median of {} alternating runs, each in a process of its own", plan.runs);
    println!(
        "below: triangles with a smaller angle, exactly; in brackets those at small angles of the input"
    );
    let is_chosen =
        |engine: &&Engine| plan.engines.is_empty() || plan.engines.iter().any(|name| name == engine.name);
    let engines: Vec<&Engine> = ENGINES.iter().filter(is_chosen).collect();
    let mut summary = Summary::default();
    let mut all_right = true;
    for name in plan.names {
        let result = Input::named(name, plan.size).and_then(|input| Ok((Folder::of(&input)?, input)));
        let (folder, input) = match result {
            Ok(result) => result,
            Err(why) => {
                println!("\nthere is no graph named {name}, and no file of one: {why}");
                continue;
            }
        };
        let wedges = Wedges::new(&input);
        for &angle in plan.angles {
            let entries = measure(plan, &engines, &folder, &input, &wedges, angle);
            report(&input, angle, &entries);
            entries.iter().filter_map(|entry| row(&input, angle, entry)).for_each(|row| summary.add(row));
            let is_wrong = |e: &Entry| e.failure.is_some() || e.verdict.wrong.is_some();
            all_right &= !entries.iter().any(|e| e.engine.name.starts_with("delone") && is_wrong(e));
        }
    }
    summary.print();
    all_right
}

fn measure(
    plan: &Plan,
    engines: &[&'static Engine],
    folder: &Folder,
    input: &Input,
    wedges: &Wedges,
    angle: f64,
) -> Vec<Entry> {
    let entry =
        |&engine: &_| Entry { engine, samples: Vec::new(), verdict: Verdict::default(), failure: None };
    let mut entries: Vec<Entry> = engines.iter().map(entry).collect();
    let python: &Path = &plan.python;
    for round in 0..plan.runs {
        for entry in entries.iter_mut().filter(|entry| entry.failure.is_none()) {
            let first = round == 0;
            match folder.measure(entry.engine, angle, input.is_hull, first, python, plan.limit) {
                Err(why) => entry.failure = Some(why),
                Ok(sample) => {
                    entry.samples.push(sample);
                    if first {
                        match folder.mesh() {
                            Ok(mesh) => entry.verdict = judge(input, wedges, &mesh, angle, sample.left),
                            Err(why) => entry.failure = Some(why),
                        }
                    }
                }
            }
        }
    }
    entries
}

/// The median of the samples.
fn median(samples: &[Sample], value: impl Fn(&Sample) -> f64) -> Option<f64> {
    let mut values: Vec<f64> = samples.iter().map(value).collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// The row of an entry in the summary: meshes of the inside, whether or not all angles are reached.
fn row(input: &Input, angle: f64, entry: &Entry) -> Option<Row> {
    let first = entry.samples.first()?;
    (entry.failure.is_none() && entry.verdict.wrong.is_none()).then(|| Row {
        engine: entry.engine.name,
        case: format!("{} {angle}", input.name),
        steiner: first.vertices - input.points.len(),
        seconds: median(&entry.samples, |sample| sample.seconds).unwrap_or(f64::NAN),
    })
}

fn report(input: &Input, angle: f64, entries: &[Entry]) {
    println!(
        "\n{}, {angle} degrees: {} points, {} segments, {} holes",
        input.name,
        input.points.len(),
        input.segments.len(),
        input.holes.len()
    );
    println!(
        "  {:9} {:>9} {:>6} {:>9} {:>9} {:>6} {:>6} {:>8}  below",
        "", "Steiner", "ratio", "triangles", "seconds", "ns/t", "B/t", "smallest"
    );
    let of_triangle = entries.iter().find(|entry| entry.engine.name == TRIANGLE);
    let reference = of_triangle.and_then(|entry| row(input, angle, entry)).map(|row| row.steiner);
    for entry in entries {
        let Entry { engine, samples, verdict, failure } = entry;
        let (None, Some(sample)) = (failure, samples.first()) else {
            println!("  {:9} {}", engine.name, failure.as_deref().unwrap_or("(no runs)"));
            continue;
        };
        let steiner = sample.vertices.saturating_sub(input.points.len());
        let triangles = sample.triangles;
        let ratio = reference.map_or("-".to_owned(), |other| format!("{:.3}", steiner as f64 / other as f64));
        let seconds = median(samples, |sample| sample.seconds).unwrap_or(f64::NAN);
        let bytes = median(samples, |sample| sample.bytes / triangles as f64)
            .filter(|_| triangles >= MEASURED_TRIANGLES);
        let bytes = bytes.map_or("-".to_owned(), |bytes| format!("{bytes:.0}"));
        let remark = match (&verdict.wrong, verdict.below) {
            (Some(why), _) => format!("WRONG: {why}"),
            (None, 0) => "0".to_owned(),
            (None, below) => format!("{below} ({})", verdict.excused),
        };
        let smallest =
            if verdict.wrong.is_some() { String::new() } else { format!("{:.3}", verdict.smallest) };
        println!(
            "  {:9} {steiner:>9} {ratio:>6} {triangles:>9} {seconds:>9.6} {:>6.0} {bytes:>6} {smallest:>8}  {remark}",
            engine.name,
            seconds * 1e9 / triangles as f64,
        );
    }
}
