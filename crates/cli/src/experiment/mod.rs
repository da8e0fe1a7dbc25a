//! `delone experiment`: the papers' experiments on this machine, with the papers' figures beside.

mod brownian;
mod growth;
mod hierarchy;
mod history;
mod imprecise;
mod jump_and_walk;
mod plot;
mod radial;
mod table;

use std::path::Path;
use std::time::Instant;

use crate::args::{ExperimentArgs, ExperimentName};
use crate::files;
use crate::message::{Failure, answer};
use crate::progress::Phase;
use crate::stats::Stats;
use plot::Plot;
use table::Table;

/// What an experiment found.
#[derive(Default)]
struct Findings {
    tables: Vec<Table>,
    plots: Vec<Plot>,
}

pub(crate) fn run(args: &ExperimentArgs, quiet: bool) -> Result<(), Failure> {
    if args.largest < 100 {
        return Err(Failure::usage("--largest is below 100", "an experiment needs some points"));
    }
    if args.model.is_some() && args.name != ExperimentName::Scan {
        return Err(Failure::usage(
            "only scan takes a file",
            "leave the file out, or name the experiment scan",
        ));
    }
    if let Some(folder) = &args.output {
        std::fs::create_dir_all(folder).map_err(|error| {
            Failure::new(
                format!("cannot make the folder {}: {error}", folder.display()),
                "check the name and the permissions",
            )
        })?;
    }
    let mut stats = Stats::start();
    // What is compared works on one thread, as in the papers.
    let pool = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.map_err(|error| Failure::new(error, "the system gives no thread: try again"))
    };
    let (one, all) = (pool(1)?, pool(rayon::current_num_threads())?);
    let findings = one.install(|| {
        let _phase = Phase::start(quiet, "experimenting");
        let (n, seed) = (args.largest, args.seed);
        let findings = match args.name {
            ExperimentName::Hierarchy => hierarchy::run(n, seed),
            ExperimentName::JumpAndWalk => jump_and_walk::run(n, seed),
            ExperimentName::Radial => radial::run(n, seed),
            ExperimentName::Imprecise => imprecise::run(n, seed),
            ExperimentName::Brownian => brownian::run(n, seed),
            ExperimentName::Scan => Ok(imprecise::scan(model(args)?, n, seed)?),
            ExperimentName::History => history::run(n, seed),
            ExperimentName::Growth => growth::run(n, seed, &all),
        };
        findings.map_err(|error| Failure::new(error, "please report this: it is a bug"))
    })?;
    stats.phase("build");
    let text: Vec<String> = findings.tables.iter().map(Table::to_string).collect();
    answer(&text.join("\n"))?;
    if let Some(folder) = &args.output {
        for table in &findings.tables {
            write(folder, &table.name, "csv", &table.csv())?;
        }
        for plot in &findings.plots {
            let svg = plot.svg().map_err(|error| Failure::new(error, "please report this: it is a bug"))?;
            write(folder, &plot.name, "svg", &svg)?;
        }
    }
    stats.phase("write");
    stats.write(args.stats.as_deref())
}

/// The file of the experiment that needs one.
fn model(args: &ExperimentArgs) -> Result<&Path, Failure> {
    args.model.as_deref().ok_or_else(|| {
        Failure::usage("scan needs a file of points in space", "as in: delone experiment scan model.ply")
    })
}

fn write(folder: &Path, name: &str, extension: &str, content: &str) -> Result<(), Failure> {
    use std::io::Write;
    let path = folder.join(format!("{name}.{extension}"));
    files::write(&path, |out| Ok(out.write_all(content.as_bytes())?))
}

/// What a piece of work gives, and the seconds it takes.
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed().as_secs_f64())
}
