//! `delone triangulate --hints`: one instance of imprecise points, or many.

use std::path::{Path, PathBuf};

use delone::{HintOrder, Hints2, Hints3, Imprecise, Work};
use delone_io::{Cloud, Format};
use serde_json::{Map, Value, json};

use crate::args::{InputArgs, TriangulateArgs};
use crate::message::{Failure, note};
use crate::progress::Phase;
use crate::stats::Stats;
use crate::{files, space, triangulate};

/// What stands for the name of an instance in the name of an output.
pub(crate) const NAME: &str = "{}";
/// What is told of each instance, and added up.
const COUNTS: [&str; 5] = ["points", "duplicates", "vertices", "simplices", "hull"];

/// What differs between the plane and space.
trait Room: Sized {
    type Points;

    fn preprocess(centres: &Path, order: HintOrder, quiet: bool) -> Result<Self, Failure>;
    fn read(input: &InputArgs, quiet: bool) -> Result<Self::Points, Failure>;
    fn triangulate(&mut self, points: &Self::Points, work: &mut Work) -> Result<(), delone::Error>;
    fn gave_up(&self) -> bool;
    fn finish(
        &self,
        args: &TriangulateArgs,
        outputs: &[(PathBuf, Format)],
        points: &Self::Points,
        stats: &mut Stats,
        quiet: bool,
    ) -> Result<(), Failure>;
}

impl Room for Hints2 {
    type Points = Cloud;

    fn preprocess(centres: &Path, order: HintOrder, quiet: bool) -> Result<Self, Failure> {
        let points = files::queries(centres, quiet)?;
        let _phase = Phase::start(quiet, "preprocessing");
        Self::preprocess(&points, order).map_err(|error| Failure::points(centres, &error))
    }

    fn read(input: &InputArgs, quiet: bool) -> Result<Cloud, Failure> {
        files::points(input, 2, quiet)
    }

    fn triangulate(&mut self, points: &Cloud, work: &mut Work) -> Result<(), delone::Error> {
        self.triangulate_observed(&points.xy, work).map(|_| ())
    }

    fn gave_up(&self) -> bool {
        self.gave_up()
    }

    fn finish(
        &self,
        args: &TriangulateArgs,
        outputs: &[(PathBuf, Format)],
        points: &Cloud,
        stats: &mut Stats,
        quiet: bool,
    ) -> Result<(), Failure> {
        triangulate::finish(args, outputs, self.current(), points, stats, quiet)
    }
}

impl Room for Hints3 {
    type Points = Vec<[f64; 3]>;

    fn preprocess(centres: &Path, order: HintOrder, quiet: bool) -> Result<Self, Failure> {
        let points = files::queries_in_space(centres, quiet)?;
        let _phase = Phase::start(quiet, "preprocessing");
        Self::preprocess(&points, order).map_err(|error| Failure::points(centres, &error))
    }

    fn read(input: &InputArgs, quiet: bool) -> Result<Vec<[f64; 3]>, Failure> {
        Ok(files::points_in_space(input, quiet)?.0)
    }

    fn triangulate(&mut self, points: &Vec<[f64; 3]>, work: &mut Work) -> Result<(), delone::Error> {
        self.triangulate_observed(points, work).map(|_| ())
    }

    fn gave_up(&self) -> bool {
        self.gave_up()
    }

    fn finish(
        &self,
        args: &TriangulateArgs,
        outputs: &[(PathBuf, Format)],
        points: &Vec<[f64; 3]>,
        stats: &mut Stats,
        quiet: bool,
    ) -> Result<(), Failure> {
        space::finish(args, outputs, self.current(), points, &Cloud::default(), stats, quiet)
    }
}

/// Preprocesses the centres and triangulates all instances.
pub(crate) fn run(args: &TriangulateArgs, centres: &Path, quiet: bool) -> Result<(), Failure> {
    if args.dim.is_space() {
        run_in::<Hints3>(args, centres, &space::check_formats, quiet)
    } else {
        run_in::<Hints2>(args, centres, &triangulate::check_formats, quiet)
    }
}

fn run_in<R: Room>(
    args: &TriangulateArgs,
    centres: &Path,
    check_formats: &impl Fn(&[(PathBuf, Format)]) -> Result<(), Failure>,
    quiet: bool,
) -> Result<(), Failure> {
    let inputs = args.input.paths();
    let stats_path = args.input.stats.as_deref();
    let (all, each) = outputs(args, centres, &inputs)?;
    check_formats(&all)?;
    let mut stats = Stats::start();
    let mut hints = R::preprocess(centres, HintOrder::Spatial { seed: args.seed }, quiet)?;
    stats.phase("preprocess");
    let mut visited = 0;
    let mut records = Vec::new();
    for (input, outputs) in inputs.iter().zip(all.chunks(each)) {
        let one = InputArgs { input: vec![input.to_path_buf()], ..args.input.clone() };
        let points = R::read(&one, quiet)?;
        stats.phase("read");
        let mut work = Work::default();
        {
            let _phase = Phase::start(quiet, "triangulating");
            hints.triangulate(&points, &mut work).map_err(|error| Failure::points(input, &error))?;
        }
        stats.phase("build");
        if hints.gave_up() {
            let name = input.display();
            note(quiet, format_args!("{name}: far from the centres: walks from hints were given up"));
        }
        hints.finish(args, outputs, &points, &mut stats, quiet)?;
        let mut record: Map<String, Value> =
            COUNTS.into_iter().map(|key| (key.to_owned(), stats.get(key))).collect();
        record.insert("input".to_owned(), json!(input.display().to_string()));
        record.insert("visited_triangles".to_owned(), json!(work.visited));
        record.insert("gave_up".to_owned(), json!(hints.gave_up()));
        records.push(record);
        visited += work.visited;
    }
    stats.set("algorithm", "hints");
    stats.set("visited_triangles", visited);
    stats.set("gave_up", records.iter().any(|record| record["gave_up"] == json!(true)));
    if records.len() > 1 {
        for key in COUNTS {
            stats.set(key, records.iter().filter_map(|record| record[key].as_u64()).sum::<u64>());
        }
        stats.set("instances", records);
    }
    stats.write(stats_path)
}

/// The outputs of all instances, one instance after the other, and how many each has.
fn outputs(
    args: &TriangulateArgs,
    centres: &Path,
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
    let read: Vec<&Path> = inputs.iter().copied().chain([centres]).collect();
    Ok((files::outputs(&paths, args.to, args.input.stats.as_deref(), &read)?, args.output.len()))
}
