//! Whoever looks on while a folder is made or read.

use std::io;
use std::path::Path;

use delone_io::{Cloud, Format, Source};

use crate::error::Error;

/// Hears of the progress of work, may end it, and opens the files of the input. `()` looks away.
///
/// ```
/// use std::sync::atomic::{AtomicU64, Ordering};
/// use delone_store::Watch;
///
/// /// Counts steps, and ends work that takes too many.
/// struct Counter(AtomicU64);
///
/// impl Watch for Counter {
///     fn advance(&self) {
///         self.0.fetch_add(1, Ordering::Relaxed);
///     }
///
///     fn goes_on(&self) -> bool {
///         self.0.load(Ordering::Relaxed) < 1_000_000
///     }
/// }
/// # assert!(Counter(AtomicU64::new(0)).goes_on());
/// ```
pub trait Watch: Sync {
    /// A phase of work begins, of so many steps where that is known.
    fn begin(&self, _what: &'static str, _steps: Option<u64>) {}

    /// A step of the phase is done. Steps may be done on several threads.
    fn advance(&self) {}

    /// The phase ends.
    fn end(&self) {}

    /// A stage of a run is done: `read`, `distribute`, `build`, `join`, `neighbors`, `tables`.
    fn stage(&self, _name: &'static str) {}

    /// The folder was done before.
    fn was_done(&self) {}

    /// Whether work goes on. It is asked after each step, and ends with [`Error::Stopped`].
    fn goes_on(&self) -> bool {
        true
    }

    /// Opens a file of the input, decompressed; `what` is the phase.
    ///
    /// # Errors
    /// Why it cannot be opened.
    fn open(&self, path: &Path, format: Format, _what: &'static str) -> Result<Box<dyn Source>, Error> {
        delone_io::open_as(path, format).map_err(|error| Error::read(path, error))
    }

    /// Opens a file beside one of the input, by its extension or its path from the same folder.
    ///
    /// # Errors
    /// Why it cannot be opened.
    fn beside(&self, path: &Path, extension: &str) -> Result<Box<dyn Source>, delone_io::Error> {
        delone_io::beside(path)(extension)
    }

    /// Points of a file were read: `count` is their number so far, over all files.
    ///
    /// # Errors
    /// Why work must not go on: [`Error::Outside`].
    fn points(&self, _path: &Path, _count: u64) -> Result<(), Error> {
        Ok(())
    }

    /// A file of the input tells this beside its points.
    ///
    /// # Errors
    /// Why work must not go on: [`Error::Outside`].
    fn heed(&self, _path: &Path, _about: &mut Cloud) -> Result<(), Error> {
        Ok(())
    }

    /// The error of a file of the input.
    fn failed(&self, path: &Path, _format: Format, error: delone_io::Error) -> Error {
        Error::read(path, error)
    }
}

impl Watch for () {}

/// A phase, which ends when it is dropped.
pub(crate) struct Phase<'a>(&'a dyn Watch);

impl<'a> Phase<'a> {
    /// A phase of unknown length.
    pub(crate) fn start(watch: &'a dyn Watch, what: &'static str) -> Self {
        watch.begin(what, None);
        Self(watch)
    }

    /// A phase of so many steps.
    pub(crate) fn count(watch: &'a dyn Watch, what: &'static str, steps: u64) -> Self {
        watch.begin(what, Some(steps));
        Self(watch)
    }

    /// A step is done.
    ///
    /// # Errors
    /// [`Error::Stopped`] if nobody wants more.
    pub(crate) fn advance(&self) -> Result<(), Error> {
        self.0.advance();
        go_on(self.0)
    }
}

impl Drop for Phase<'_> {
    fn drop(&mut self) {
        self.0.end();
    }
}

/// Ends work that nobody wants.
pub(crate) fn go_on(watch: &dyn Watch) -> Result<(), Error> {
    if watch.goes_on() { Ok(()) } else { Err(Error::Stopped) }
}

/// The error of a reader that was told to stop: the true one is kept beside it.
pub(crate) fn stopped() -> delone_io::Error {
    delone_io::Error::Io(io::Error::other("stopped"))
}
