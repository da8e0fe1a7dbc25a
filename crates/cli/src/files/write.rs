//! Outputs: each is written under a temporary name, and all of a command get their names in the end, or none.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use delone_io::{Finished, Format, Output, Remark, give_names};

use super::apart::{check_open, refuse_read};
use super::sides::remove_stale;
use super::{attributes, systems};
use super::{is_special, is_standard};
use crate::message::{Failure, lost, note, refuse_losses};

/// Outputs that are written and have no name yet.
static FINISHED: Mutex<Vec<Finished>> = Mutex::new(Vec::new());

/// Gives all outputs of the command their names.
pub(crate) fn publish(quiet: bool) -> Result<(), Failure> {
    let finished = std::mem::take(&mut *FINISHED.lock().unwrap_or_else(PoisonError::into_inner));
    remove_stale()?;
    systems::tell(quiet);
    attributes::tell(quiet);
    refuse_losses()?;
    give_names(finished).map_err(|(path, error)| cannot_write(&path, error.into()))?;
    systems::outputs().iter().for_each(|(path, format)| tell_size(path, *format, quiet));
    Ok(())
}

/// Vector pictures of more bytes than this are slow to open everywhere.
const LARGE_SVG_BYTES: u64 = 20_000_000;

/// Tells of vector pictures that few programs show.
fn tell_size(path: &Path, format: Format, quiet: bool) {
    let length = path.metadata().map_or(0, |about| about.len());
    if format == Format::Svg && length > LARGE_SVG_BYTES {
        let megabytes = length / 1_000_000;
        let help = "a png shows as much, and delone tiles with window --points draws some of the points";
        note(quiet, format_args!("{}: {megabytes} megabytes are slow to open: {help}", path.display()));
    }
}

/// The folder that a path is in.
pub(crate) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The folder for what waits on disk until an output can be written: that of the output, if it is a file.
pub(crate) fn scratch(path: &Path) -> Option<PathBuf> {
    (!is_standard(path) && !is_special(path)).then(|| folder_of(path).to_owned())
}

/// Begins an output that is no input.
pub(crate) fn create(path: &Path) -> Result<Output, Failure> {
    check_open(path)?;
    refuse_read(path)?;
    Output::create(path).map_err(|error| cannot_write(path, error.into()))
}

/// Ends an output, which gets its name with all others.
pub(crate) fn finish(output: Output) -> Result<(), delone_io::Error> {
    let finished = output.finish()?;
    FINISHED.lock().unwrap_or_else(PoisonError::into_inner).push(finished);
    Ok(())
}

/// Writes a mesh, and says what a user should know of it.
pub(crate) fn write_mesh(
    path: &Path,
    quiet: bool,
    content: impl FnOnce(&mut Output) -> Result<Remark, delone_io::Error>,
) -> Result<(), Failure> {
    if let Some(remark) = write(path, content)? {
        lost(quiet, format_args!("{}: {remark}", path.display()));
    }
    Ok(())
}

/// Writes a file whole, or leaves what was there. What the writer returns is there unless nobody reads on.
pub fn write<T: Default>(
    path: &Path,
    content: impl FnOnce(&mut Output) -> Result<T, delone_io::Error>,
) -> Result<T, Failure> {
    let mut output = create(path)?;
    let attempt = || {
        let outcome = content(&mut output)?;
        finish(output)?;
        Ok(outcome)
    };
    let outcome = match attempt() {
        // A reader that has seen enough (`| head`) is no failure.
        Err(delone_io::Error::Io(error))
            if error.kind() == ErrorKind::BrokenPipe && (is_standard(path) || is_special(path)) =>
        {
            Ok(T::default())
        }
        outcome => outcome,
    };
    outcome.map_err(|error| cannot_write(path, error))
}

/// Writes a file of a folder that is this program's own, which has its name at once.
pub fn write_own<T>(
    path: &Path,
    content: impl FnOnce(&mut Output) -> Result<T, delone_io::Error>,
) -> Result<T, Failure> {
    refuse_read(path)?;
    let attempt = || {
        let mut output = Output::create_own(path)?;
        let outcome = content(&mut output)?;
        output.commit()?;
        Ok(outcome)
    };
    attempt().map_err(|error| cannot_write(path, error))
}

/// The failure of an output.
pub(crate) fn cannot_write(path: &Path, error: delone_io::Error) -> Failure {
    match error {
        delone_io::Error::Io(error) => Failure::new(
            format!("cannot write {}: {error}", path.display()),
            "check the name, the permissions and the room on the disk",
        ),
        other => Failure::file(path, &other),
    }
}
