//! The program looks on: progress, the times of stages, files that are opened as those of other commands.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use delone_io::{Cloud, Format, Source};
use delone_store::{Error, Watch};

use super::failure::outside;
use crate::files;
use crate::limits;
use crate::message::note;
use crate::progress::Phase;
use crate::stats::Stats;

/// Whoever looks on, for a command.
pub(crate) struct Watched<'a> {
    folder: PathBuf,
    /// The statistics, if stages are told apart there.
    stats: Mutex<Option<&'a mut Stats>>,
    phase: Mutex<Option<Phase>>,
    quiet: bool,
    /// Whether the stages after the first are told as one, by the command.
    is_until_read: bool,
}

impl<'a> Watched<'a> {
    /// Progress alone.
    pub(crate) fn new(folder: &Path, quiet: bool) -> Self {
        Self {
            folder: folder.to_owned(),
            stats: Mutex::new(None),
            phase: Mutex::new(None),
            quiet,
            is_until_read: false,
        }
    }

    /// Progress, and the times of stages.
    pub(crate) fn of(folder: &Path, stats: &'a mut Stats, quiet: bool) -> Self {
        Self { stats: Mutex::new(Some(stats)), ..Self::new(folder, quiet) }
    }

    /// The time of the first stage alone: what follows is one to its command.
    pub(crate) fn until_read(self) -> Self {
        Self { is_until_read: true, ..self }
    }

    fn show(&self, phase: Option<Phase>) {
        *self.phase.lock().unwrap_or_else(PoisonError::into_inner) = phase;
    }
}

impl Watch for Watched<'_> {
    fn begin(&self, what: &'static str, steps: Option<u64>) {
        self.show(Some(match steps {
            Some(steps) => Phase::count(self.quiet, what, steps),
            None => Phase::start(self.quiet, what),
        }));
    }

    fn advance(&self) {
        let phase = self.phase.lock().unwrap_or_else(PoisonError::into_inner);
        phase.iter().for_each(Phase::advance);
    }

    fn end(&self) {
        self.show(None);
    }

    fn stage(&self, name: &'static str) {
        if self.is_until_read && name != "read" {
            return;
        }
        let mut stats = self.stats.lock().unwrap_or_else(PoisonError::into_inner);
        stats.iter_mut().for_each(|stats| stats.phase(name));
    }

    fn was_done(&self) {
        note(self.quiet, format_args!("{} was done before", self.folder.display()));
    }

    fn open(&self, path: &Path, format: Format, what: &'static str) -> Result<Box<dyn Source>, Error> {
        let (source, phase) = files::open(path, format, what, self.quiet).map_err(outside)?;
        self.show(Some(phase));
        Ok(source)
    }

    fn beside(&self, path: &Path, extension: &str) -> Result<Box<dyn Source>, delone_io::Error> {
        files::beside(path)(extension)
    }

    fn points(&self, path: &Path, count: u64) -> Result<(), Error> {
        limits::check_points(count as usize, path).map_err(outside)
    }

    fn heed(&self, path: &Path, about: &mut Cloud) -> Result<(), Error> {
        files::heed(about, path, files::Role::Input, self.quiet).map_err(outside)
    }

    fn failed(&self, path: &Path, format: Format, error: delone_io::Error) -> Error {
        outside(files::wrong(path, format, &error))
    }
}
