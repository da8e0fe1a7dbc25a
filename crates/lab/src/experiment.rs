//! `delone-lab experiment`: the papers' experiments on this machine, with the papers' figures beside.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use delone::Delaunay3;
use delone_cli::files;
use delone_cli::message::{Failure, answer};
use delone_cli::progress::Phase;
use delone_cli::room;
use delone_cli::stats::Stats;
use delone_experiments::{Error, Experiment, Options, Table, Watch};

use crate::args::ExperimentArgs;

pub(crate) fn run(args: &ExperimentArgs, quiet: bool) -> Result<(), Failure> {
    let experiment = args.experiment();
    let model = match &args.model {
        Some(_) if !experiment.takes_model() => {
            return Err(Failure::usage(
                "only scan takes a file",
                "leave the file out, or name the experiment scan",
            ));
        }
        Some(path) => room::queries::<Delaunay3>(path, true)?,
        None if experiment.takes_model() => {
            return Err(Failure::usage(
                "scan needs a file of points in space",
                "as in: delone-lab experiment scan model.ply",
            ));
        }
        None => Vec::new(),
    };
    files::keep_apart(args.model.as_deref().as_slice(), args.stats.as_deref())?;
    if let Some(folder) = &args.output {
        std::fs::create_dir_all(folder).map_err(|error| cannot_write(folder, &error))?;
        // What runs for hours should not find out in the end that it cannot be kept.
        tempfile::tempfile_in(folder).map_err(|error| cannot_write(folder, &error))?;
    }
    let kept = args.output.as_deref().map(|folder| Arc::new(Kept::new(folder)));
    let mut stats = Stats::start();
    // What is compared works on one thread, as in the papers.
    let pool = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.map_err(|error| Failure::new(error, "the system gives no thread: try again"))
    };
    let (one, all) = (pool(1)?, pool(rayon::current_num_threads())?);
    let findings = one.install(|| {
        let _phase = Phase::start(quiet, "experimenting");
        let options = Options {
            largest: args.largest,
            trials: args.trials as usize,
            seed: args.seed,
            model: &model,
            threads: &all,
            watch: kept.clone().map(|kept| kept as Arc<dyn Watch>),
        };
        experiment.run(&options).map_err(|error| failure(experiment, &error, args))
    })?;
    stats.phase("build");
    let text: Vec<String> = findings.tables.iter().map(Table::to_string).collect();
    answer(&text.join("\n"))?;
    if let Some(folder) = &args.output {
        for table in &findings.tables {
            write(folder, &table.name, "csv", &table.csv())?;
        }
        kept.map_or(Ok(()), |kept| kept.remove()).map_err(|error| cannot_write(folder, &error))?;
        for plot in &findings.plots {
            let svg = plot.svg().map_err(|error| Failure::new(error, "please report this: it is a bug"))?;
            write(folder, &plot.name, "svg", &svg)?;
        }
    }
    stats.phase("write");
    stats.write(args.stats.as_deref())
}

/// Rows as they come, in files beside the tables: who interrupts an experiment has them.
#[derive(Debug)]
struct Kept {
    folder: PathBuf,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    /// By the names of tables.
    files: BTreeMap<String, File>,
    /// The first thing that went wrong.
    trouble: Option<io::Error>,
}

impl Kept {
    fn new(folder: &Path) -> Self {
        Self { folder: folder.to_owned(), state: Mutex::default() }
    }

    fn path(&self, table: &str) -> PathBuf {
        self.folder.join(format!("{table}.part.csv"))
    }

    fn keep(&self, files: &mut BTreeMap<String, File>, table: &str, line: &str) -> io::Result<()> {
        let file = match files.entry(table.to_owned()) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => {
                let path = self.path(table);
                // One that a run left which was stopped; nothing is followed.
                _ = std::fs::remove_file(&path);
                new.insert(File::create_new(path)?)
            }
        };
        file.write_all(line.as_bytes())
    }

    /// Removes the files, once the tables are whole.
    fn remove(&self) -> io::Result<()> {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        for (table, file) in std::mem::take(&mut state.files) {
            drop(file);
            std::fs::remove_file(self.path(&table))?;
        }
        state.trouble.take().map_or(Ok(()), Err)
    }
}

impl Watch for Kept {
    fn line(&self, table: &str, line: &str) {
        let state = &mut *self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if let Err(error) = self.keep(&mut state.files, table, line) {
            state.trouble.get_or_insert(error);
        }
    }
}

fn failure(experiment: &Experiment, error: &Error, args: &ExperimentArgs) -> Failure {
    match error {
        Error::TooSmall { smallest, .. } => {
            Failure::usage(error, format!("give at least --largest {smallest} to {}", experiment.name))
        }
        Error::LargeSeed(_) => Failure::usage(error, "give a smaller --seed"),
        Error::WideModel => Failure::new(error, "scan needs coordinates whose squares are finite"),
        Error::SmallModel(_) | Error::Library(_) => match &args.model {
            Some(path) => {
                Failure::new(format!("{}: {error}", path.display()), "give a model of some thousand points")
            }
            None => Failure::new(error, "try a smaller --largest"),
        },
        _ => Failure::new(error, "please report this: it is a bug"),
    }
}

fn cannot_write(folder: &Path, error: &io::Error) -> Failure {
    Failure::new(
        format!("cannot write into the folder {}: {error}", folder.display()),
        "check the name and the permissions",
    )
}

fn write(folder: &Path, name: &str, extension: &str, content: &str) -> Result<(), Failure> {
    let path = folder.join(format!("{name}.{extension}"));
    files::write_own(&path, |out| Ok(out.write_all(content.as_bytes())?))
}
