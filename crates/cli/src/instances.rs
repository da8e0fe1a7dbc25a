//! `delone triangulate --hints`: one instance of imprecise points, or many.

use std::path::{Path, PathBuf};

use delone::{HintOrder, Imprecise, Tally, Work};
use delone_io::Format;
use serde_json::{Map, Value, json};

use crate::args::{HintOrderName, InputArgs, TriangulateArgs};
use crate::message::{Failure, note};
use crate::progress::Phase;
use crate::room::{self, Room};
use crate::stats::{Stats, work_done};
use crate::{files, outcome};

/// The placeholder of the name of an instance in the name of an output.
pub(crate) const NAME: &str = "{}";
/// Counts of each instance, which are added up.
const COUNTS: [&str; 5] = ["points", "duplicates", "vertices", "simplices", "hull"];

/// Preprocesses the centers and triangulates all instances.
pub(crate) fn run<R: Room>(args: &TriangulateArgs, centers: &Path, quiet: bool) -> Result<(), Failure> {
    let inputs = args.input.paths();
    let stats_path = args.input.stats.as_deref();
    let (all, each) = outputs(args, centers, &inputs)?;
    room::check_formats::<R>(&all)?;
    let mut stats = Stats::start();
    let mut hints = preprocess::<R>(args, centers, quiet)?;
    stats.phase("preprocess");
    let mut all_work = Work::default();
    let mut records = Vec::new();
    for (input, outputs) in inputs.iter().zip(all.chunks(each)) {
        let one = InputArgs { input: vec![input.to_path_buf()], ..args.input.clone() };
        let (points, mut about) = room::read::<R>(&one, quiet)?;
        stats.phase("read");
        let mut work = Work::default();
        {
            let _phase = Phase::start(quiet, "triangulating");
            // Steps are counted on one thread.
            let done = match stats_path {
                None => hints.triangulate(&points),
                Some(_) => hints.triangulate_observed(&points, &mut work),
            };
            done.map_err(|error| Failure::points(input, &error))?;
        }
        stats.phase("build");
        if hints.gave_up() {
            let name = input.display();
            note(quiet, format_args!("{name}: far from the centers: walks from hints were given up"));
        }
        room::settle(args.duplicates.rule(), hints.current(), &mut about);
        outcome::finish(args, outputs, hints.current(), &points, &about, &mut stats, quiet)?;
        let mut record: Map<String, Value> =
            COUNTS.into_iter().map(|key| (key.to_owned(), stats.get(key))).collect();
        record.insert("input".to_owned(), json!(input.display().to_string()));
        record.insert("visited_triangles".to_owned(), json!(work.visited));
        record.insert("gave_up".to_owned(), json!(hints.gave_up()));
        records.push(record);
        all_work.add(&work);
    }
    stats.set("algorithm", "hints");
    stats.set("threads", 1);
    stats.set("visited_triangles", all_work.visited);
    stats.set("counters", work_done(&all_work));
    stats.set("gave_up", records.iter().any(|record| record["gave_up"] == json!(true)));
    if records.len() > 1 {
        for key in COUNTS {
            stats.set(key, records.iter().filter_map(|record| record[key].as_u64()).sum::<u64>());
        }
        stats.set("instances", records);
    }
    stats.write(stats_path)
}

/// Finds order and hints.
fn preprocess<R: Room>(args: &TriangulateArgs, centers: &Path, quiet: bool) -> Result<R::Hints, Failure> {
    let points = room::queries::<R>(centers, quiet)?;
    let _phase = Phase::start(quiet, "preprocessing");
    let seed = args.strategy.seed;
    let order = match args.hint_order {
        None | Some(HintOrderName::Spatial) => HintOrder::Spatial { seed },
        Some(HintOrderName::Random) => HintOrder::Random { seed },
    };
    let hints = R::Hints::from_centers(&points, order);
    hints.map_err(|error| Failure::points(centers, &error))
}

/// The outputs of all instances, one instance after the other, and how many each has.
fn outputs(
    args: &TriangulateArgs,
    centers: &Path,
    inputs: &[&Path],
) -> Result<(Vec<(PathBuf, Format)>, usize), Failure> {
    if inputs.len() > 1
        && let Some(path) = args.output.iter().find(|path| !path.to_string_lossy().contains(NAME))
    {
        return Err(Failure::usage(
            format!("{}: one output for {} instances", path.display(), inputs.len()),
            "write {} where the name of each instance shall stand, as in -o 'mesh-{}.npy'",
        ));
    }
    let named = |input: &Path, output: &PathBuf| {
        let name = input.file_stem().unwrap_or_default().to_string_lossy();
        if inputs.len() > 1 {
            PathBuf::from(output.to_string_lossy().replace(NAME, &name))
        } else {
            output.clone()
        }
    };
    let paths: Vec<PathBuf> =
        inputs.iter().flat_map(|input| args.output.iter().map(|output| named(input, output))).collect();
    let read: Vec<&Path> = inputs.iter().copied().chain([centers]).collect();
    let outputs = files::outputs(&paths, args.to, args.input.stats.as_deref(), &read)?;
    Ok((args.wkt.of(outputs)?, args.output.len()))
}
