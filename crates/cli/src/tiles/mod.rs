//! `delone tiles`: more points than memory, triangulated in tiles on disk (see [`delone::tiles`]).
//!
//! Two passes over the input: one counts and draws the sample that the cuts are taken from, one puts each point into the bucket of its
//! tile. Then tiles, by several workers, then seams. Every file gets its name when it is whole, and the border of a node is written
//! last, so whatever has a border is done, and a run that was killed goes on from there.

mod buckets;
mod budget;
mod describe;
mod held;
mod input;
mod leaf;
mod manifest;
mod neighbors;
mod node;
mod own;
mod seams;
mod shards;
mod sums;
#[cfg(feature = "parquet")]
mod tables;
mod trust;
mod verdict;
mod window;

use std::fs;
use std::path::{Path, PathBuf};

use delone::surface::Duplicates;
use delone::tiles::{Cuts, Fingerprint, Node};
use delone_io::{Cloud, TemporaryFolder, followed, sync_folder};

pub(crate) use describe::describe;
pub(crate) use held::{Corner, Held};
pub(crate) use manifest::NAME as MANIFEST;
pub(crate) use verdict::check;
pub(crate) use window::run as window;

use buckets::Buckets;
use budget::Budget;
use input::Input;
use manifest::{Manifest, Outcome};
use node::Done;
use seams::Joins;
use sums::Written;

use crate::args::TilesArgs;
use crate::files;
use crate::message::{Failure, grouped, note, say};
use crate::progress::Phase;
use crate::stats::Stats;

pub(crate) fn run(args: &TilesArgs, quiet: bool) -> Result<(), Failure> {
    #[cfg(not(feature = "parquet"))]
    if args.parquet {
        return Err(Failure::left_out("--parquet", "parquet"));
    }
    files::keep_apart(&args.input.paths(), args.input.stats.as_deref())?;
    let workers = args.workers.map_or(rayon::current_num_threads(), usize::from);
    let budget = Budget::new(args.memory, workers, args.tile)?;
    let input = Input::new(args)?;
    let folder = &args.output;
    let mut stats = Stats::start();
    let _lock = lock(folder)?;
    let begun = begin(folder, args.resume)?;
    keep_out(folder, args.input.paths().into_iter().chain(args.input.stats.as_deref()))?;
    let mut plan = match begun {
        Some(plan) => {
            check_input(&plan, &input, folder)?;
            trust::check(folder, &plan, quiet)?;
            plan
        }
        None => survey(folder, &input, &budget, quiet)?.0,
    };
    stats.phase("read");
    if plan.outcome.is_none() {
        if plan.buckets.is_none() {
            distribute(folder, &mut plan, &input, (&budget, args.duplicates), quiet)?;
        }
        stats.phase("distribute");
        triangulate(folder, &plan, &budget, args.duplicates, quiet)?;
        stats.phase("build");
        finish(folder, &mut plan, &budget, quiet)?;
        stats.phase("join");
    } else {
        note(quiet, format_args!("{} was done before", folder.display()));
    }
    clean(folder, &plan);
    if args.neighbors {
        add(folder, &mut plan, quiet, neighbors::write)?;
        stats.phase("neighbors");
    }
    #[cfg(feature = "parquet")]
    if args.parquet {
        add(folder, &mut plan, quiet, tables::write)?;
        stats.phase("tables");
    }
    tell(&plan, &mut stats, quiet);
    stats.write(args.input.stats.as_deref())
}

/// Writes more files of all nodes, and then what is known of them.
fn add(
    folder: &Path,
    plan: &mut Manifest,
    quiet: bool,
    write: impl Fn(&Path, &Manifest, &Outcome, bool) -> Result<Written, Failure>,
) -> Result<(), Failure> {
    let Some(mut outcome) = plan.outcome.take() else { return Ok(()) };
    let written = write(folder, plan, &outcome, quiet)?;
    outcome.extend(written);
    plan.outcome = Some(outcome);
    plan.write(folder)
}

/// Keeps other runs out of a folder, where its file system can: two would write the same buckets. It ends with the process.
fn lock(folder: &Path) -> Result<Option<fs::File>, Failure> {
    _ = fs::create_dir_all(folder);
    if !folder.is_dir() {
        return Ok(None);
    }
    let Ok(file) = fs::File::open(folder) else { return Ok(None) };
    match file.try_lock() {
        Err(fs::TryLockError::WouldBlock) => {
            let what = format!("another run works in {}", folder.display());
            Err(Failure::usage(what, "wait for its end, or name another folder"))
        }
        _ => Ok(Some(file)),
    }
}

/// Refuses other files in a folder of tiles: they might be files of it, or become some.
fn keep_out<'a>(folder: &Path, others: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
    let place = |folder: &Path| {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        folder.canonicalize().ok()
    };
    let here = place(folder);
    let inside = |path: &&Path| {
        let path = followed(path).unwrap_or_else(|_| path.to_path_buf());
        here.is_some() && path.parent().and_then(place) == here && path != Path::new("-")
    };
    match others.into_iter().find(inside) {
        Some(path) => {
            let what = format!("{} is in the folder of the tiles", path.display());
            Err(Failure::usage(what, "name a file somewhere else"))
        }
        None => Ok(()),
    }
}

/// Refuses outputs in a folder of tiles that is read, or that are files of it by other names, or cannot be written.
fn keep_apart<'a>(folder: &Path, outputs: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
    let outputs: Vec<&Path> = outputs.into_iter().collect();
    keep_out(folder, outputs.iter().copied())?;
    let own: Vec<_> =
        fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    files::keep_apart(&own.iter().map(PathBuf::as_path).collect::<Vec<_>>(), outputs)
}

/// Makes the folder, or finds what is in it.
fn begin(folder: &Path, resume: bool) -> Result<Option<Manifest>, Failure> {
    let failed = |error: std::io::Error| {
        let help = "name a folder that can be made or written";
        Failure::new(format!("{}: {error}", folder.display()), help)
    };
    fs::create_dir_all(folder).map_err(failed)?;
    // Its own name too, where the folder that it is in may be read.
    let parent = folder.parent().filter(|parent| !parent.as_os_str().is_empty());
    _ = sync_folder(parent.unwrap_or(Path::new(".")));
    if resume {
        // What a run that was killed had half written goes.
        _ = TemporaryFolder::create(folder);
    }
    let is_empty = fs::read_dir(folder).map_err(failed)?.next().is_none();
    if is_empty {
        return Ok(None);
    }
    let plan = Manifest::read(folder)?;
    match (resume, plan) {
        (false, None) => {
            let what = format!("{} is not empty", folder.display());
            Err(Failure::usage(what, "name another folder for the tiles"))
        }
        (false, Some(_)) => {
            let what = format!("{} has tiles already", folder.display());
            Err(Failure::usage(what, "go on with --resume, or name another folder"))
        }
        (true, None) => {
            let what = format!("{} is not empty and has no {}", folder.display(), manifest::NAME);
            Err(Failure::usage(what, "name the folder of the run that is to go on"))
        }
        (true, Some(plan)) => Ok(Some(plan)),
    }
}

/// Refuses to go on with other files, or with the same ones read in another way.
fn check_input(plan: &Manifest, input: &Input, folder: &Path) -> Result<(), Failure> {
    let now = input.describe()?;
    if now == plan.input {
        return Ok(());
    }
    let what = if now["files"] == plan.input["files"] {
        "--from, --class, --columns or --heights are others than"
    } else if names(&now["files"]) == names(&plan.input["files"]) {
        "the input has changed since"
    } else {
        "the input is another one than that of"
    };
    let what = format!("{what} the run in {}", folder.display());
    Err(Failure::usage(what, "go on with what that run began with, or start again in another folder"))
}

fn names(files: &serde_json::Value) -> Vec<&serde_json::Value> {
    files.as_array().into_iter().flatten().map(|file| &file["file"]).collect()
}

/// Counts the points and cuts the plane; says what the files tell besides.
fn survey(folder: &Path, input: &Input, budget: &Budget, quiet: bool) -> Result<(Manifest, Cloud), Failure> {
    let described = input.describe()?;
    let (count, sample, about) = input.survey(budget.sample(), quiet)?;
    let cuts =
        Cuts::from_sample(&sample, budget.tiles(count)).map_err(|error| Failure::points(folder, &error))?;
    let has_heights = described["heights"] == true;
    let plan =
        Manifest { input: described, count, has_heights, cuts, buckets: None, left_out: 0, outcome: None };
    plan.write(folder)?;
    Ok((plan, about))
}

/// Puts every point into the bucket of its tile.
fn distribute(
    folder: &Path,
    plan: &mut Manifest,
    input: &Input,
    (budget, rule): (&Budget, Duplicates),
    quiet: bool,
) -> Result<(), Failure> {
    // Those of a run that was stopped while it filled them; of none of its tiles it can be known what it was made of.
    buckets::remove_all(folder);
    node::remove_all(folder);
    let has_heights = plan.has_heights;
    let buffer = budget.buffer(plan.cuts.tiles().len());
    let mut buckets = Buckets::new(folder, &plan.cuts, Node::ROOT, has_heights, buffer)?;
    let mut count = 0;
    input.read_again("distributing", quiet, &mut |_, first, points, heights| {
        count += points.len() as u64;
        buckets.take(first, points, heights)
    })?;
    let mut counts = buckets.finish()?;
    let is_same = input.describe()? == plan.input;
    if count != plan.count && is_same {
        let path = folder.join(manifest::NAME);
        let what = format!("{}: it has {} points, and the input {count}", path.display(), plan.count);
        return Err(Failure::new(
            what,
            "it was changed: start again in another folder, or with this one empty",
        ));
    }
    if !is_same {
        let what = format!("the input changed while it was read: {count} points, {} before", plan.count);
        return Err(Failure::new(what, "start again in another folder when nobody writes to it"));
    }
    let heights = (has_heights, rule);
    plan.left_out = buckets::cut_again(folder, &mut plan.cuts, &mut counts, heights, budget.most(), buffer)?;
    plan.buckets = Some(counts);
    plan.write(folder)
}

/// Triangulates all tiles that are not done.
fn triangulate(
    folder: &Path,
    plan: &Manifest,
    budget: &Budget,
    rule: Duplicates,
    quiet: bool,
) -> Result<(), Failure> {
    let mut open = Vec::new();
    for (&node, &filled) in plan.buckets.iter().flatten() {
        if let Some(done) = Done::find(folder, node)? {
            done.check_points(folder, filled.points)?;
        } else {
            buckets::check(folder, node, filled.points, plan.has_heights)?;
            open.push((node, filled));
        }
    }
    let Some(&(largest, filled)) = open.iter().max_by_key(|&&(_, filled)| filled.points) else {
        return Ok(());
    };
    let workers = budget.workers(filled.points, &buckets::bucket(folder, largest))?;
    leaf::all(folder, &plan.cuts, &open, (plan.has_heights, rule), workers, quiet)
}

/// Joins all borders, and adds up what there is.
fn finish(folder: &Path, plan: &mut Manifest, budget: &Budget, quiet: bool) -> Result<(), Failure> {
    let cuts = &plan.cuts;
    let phase = Phase::start(quiet, "joining");
    let joins = Joins { folder, cuts, budget, count: plan.count, phase };
    let root = joins.settle(Node::ROOT)?;
    let mut nodes = Vec::new();
    let mut waiting = vec![Node::ROOT];
    let (mut fingerprint, mut vertices, mut duplicates) = (Fingerprint::default(), 0, plan.left_out);
    while let Some(node) = waiting.pop() {
        waiting.extend(cuts.halves(node).into_iter().flatten().rev());
        let Some(done) = Done::find(folder, node)? else { continue };
        let of_bucket = plan.buckets.as_ref().and_then(|buckets| buckets.get(&node));
        done.check_points(folder, of_bucket.map_or(0, |filled| filled.points))?;
        fingerprint += done.fingerprint;
        vertices += done.vertices;
        duplicates += done.duplicates;
        nodes.push(done.describe());
    }
    let (triangles, hull) = (fingerprint.count(), root.border);
    let is_whole = triangles + hull + 2 == 2 * vertices || triangles == 0 && hull == vertices;
    if vertices + duplicates != plan.count || !is_whole {
        let what = format!(
            "{}: {vertices} vertices, {duplicates} duplicates, {triangles} triangles and {hull} vertices of the hull are no \
             triangulation of {} points",
            folder.display(),
            plan.count
        );
        let help = "start again in another folder; if nobody changed files in this one, please report it: it is a bug";
        return Err(Failure::new(what, help));
    }
    plan.outcome = Some(Outcome { fingerprint, vertices, duplicates, hull, nodes });
    plan.write(folder)
}

/// Removes what nobody needs any more.
fn clean(folder: &Path, plan: &Manifest) {
    let nodes = plan.outcome.iter().flat_map(|outcome| &outcome.nodes);
    nodes.filter_map(Done::parse).for_each(|done| node::forget(folder, done.node));
    if plan.outcome.is_some() {
        buckets::remove_all(folder);
    }
}

/// So many, in words.
fn in_tiles(count: usize) -> String {
    format!("{} {}", grouped(count as u64), if count == 1 { "tile" } else { "tiles" })
}

/// Says what was done.
fn tell(plan: &Manifest, stats: &mut Stats, quiet: bool) {
    let Some(outcome) = &plan.outcome else { return };
    if outcome.duplicates > 0 {
        note(
            quiet,
            format_args!(
                "{} of {} points equal earlier ones and are no vertices",
                outcome.duplicates, plan.count
            ),
        );
    }
    let tiles = plan.cuts.tiles().len();
    let nodes: Vec<Done> = outcome.nodes.iter().filter_map(Done::parse).collect();
    let of_tiles = nodes.iter().filter(|done| plan.cuts.halves(done.node).is_none());
    let border: u64 = of_tiles.map(|done| done.border).sum();
    stats.set("points", plan.count);
    stats.set("duplicates", outcome.duplicates);
    stats.set("vertices", outcome.vertices);
    stats.set("simplices", outcome.triangles());
    stats.set("hull", outcome.hull);
    stats.set("fingerprint", outcome.fingerprint.to_string());
    stats.set("tiles", tiles);
    stats.set("joins", nodes.len() - tiles);
    stats.set("border", border);
    say(
        quiet,
        format_args!(
            "{} points, {} triangles, {} on the hull, in {} with {} points of borders ({:.2} s)",
            grouped(plan.count),
            grouped(outcome.triangles()),
            grouped(outcome.hull),
            in_tiles(tiles),
            grouped(border),
            stats.total()
        ),
    );
}
