//! No file that is read is written: whatever its name, also through links, and also where a reader opens it by itself.
//!
//! Names are compared before there is work to lose. Files that were opened are remembered, and asked for before anything is written.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use delone_io::{Format, Output, Source, decompressed, followed, has_points_beside, side};

use super::{is_special, is_standard};
use crate::closed;
use crate::message::Failure;

/// The files that this program has opened to read.
static READ: Mutex<Vec<(Identity, PathBuf)>> = Mutex::new(Vec::new());

/// The identity of a file under all its names.
#[cfg(unix)]
type Identity = (u64, u64);
#[cfg(not(unix))]
type Identity = PathBuf;

#[cfg(unix)]
fn identity(path: &Path) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt;
    let about = path.metadata().ok().filter(std::fs::Metadata::is_file)?;
    Some((about.dev(), about.ino()))
}

#[cfg(not(unix))]
fn identity(path: &Path) -> Option<Identity> {
    path.canonicalize().ok()
}

/// Opens a file to read, and remembers it.
pub(super) fn open(path: &Path) -> std::io::Result<File> {
    let file = File::open(path)?;
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    read.extend(identity(path).map(|identity| (identity, path.to_owned())));
    Ok(file)
}

/// Opens what lies beside a file, by its extension, in capital letters where the file's own is, or by its path from the same folder.
/// Nothing is beside standard input.
pub(crate) fn beside(path: &Path) -> impl FnMut(&str) -> Result<Box<dyn Source>, delone_io::Error> {
    move |extension| {
        let beside = side(path, extension);
        let named = |error: std::io::Error| {
            let what = format!("what is beside it in {}: {error}", beside.display());
            delone_io::Error::from(std::io::Error::new(error.kind(), what))
        };
        if is_standard(path) {
            return Err(named(std::io::ErrorKind::NotFound.into()));
        }
        source(&beside).map_err(named)
    }
}

/// A file beside another one.
pub(super) fn source(path: &Path) -> std::io::Result<Box<dyn Source>> {
    Ok(Box::new(BufReader::new(open(path)?)))
}

/// Refuses an output that is a file which was read.
pub(super) fn refuse_read(path: &Path) -> Result<(), Failure> {
    let Some(own) = identity(or(path, "/dev/stdout")) else { return Ok(()) };
    let read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    // The file may be gone, and another one have its place on the disk.
    match read.iter().find(|known| known.0 == own && identity(&known.1).is_some_and(|now| now == own)) {
        Some((_, known)) => Err(overwrites(path, known, READS)),
        None => Ok(()),
    }
}

const READS: &str = "reads";
const WRITES: &str = "writes too";

fn overwrites(path: &Path, other: &Path, does: &str) -> Failure {
    Failure::usage(
        format!("{} would overwrite {}, which this command {does}", path.display(), other.display()),
        "choose another name for the output",
    )
}

/// The files that are read beside a file.
fn read_with(path: &Path) -> Vec<PathBuf> {
    let Ok(format) = Format::of(path) else { return Vec::new() };
    if is_standard(path) || is_special(path) {
        return Vec::new();
    }
    let mut besides: Vec<PathBuf> = format.sides().iter().map(|extension| side(path, extension)).collect();
    let has_points = || {
        let source = decompressed(Box::new(BufReader::new(File::open(path).ok()?)), Format::Poly).ok()?;
        has_points_beside(source).ok()
    };
    if format == Format::Poly && has_points() == Some(true) {
        besides.push(path.with_extension("node"));
    }
    besides
}

/// Refuses a command that would write over a file it reads, write a file twice, or where it cannot write.
pub fn keep_apart<'a>(inputs: &[&Path], outputs: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
    let outputs: Vec<&Path> = outputs.into_iter().collect();
    keep_names_apart(inputs, outputs.iter().copied())?;
    outputs.into_iter().try_for_each(check_output)
}

/// Refuses a command that would write over a file it reads, or write a file twice.
pub(crate) fn keep_names_apart<'a>(
    inputs: &[&Path],
    outputs: impl IntoIterator<Item = &'a Path>,
) -> Result<(), Failure> {
    let beside: Vec<PathBuf> = inputs.iter().flat_map(|path| read_with(path)).collect();
    let mut known: Vec<(Known, &Path, &str)> = Vec::new();
    for &path in inputs.iter().chain(&beside.iter().map(PathBuf::as_path).collect::<Vec<_>>()) {
        known.push((Known::of(path, "/dev/stdin"), path, READS));
    }
    for path in outputs {
        let own = Known::of(path, "/dev/stdout");
        if let Some((_, other, does)) = known.iter().find(|known| known.0.is_same(&own)) {
            return Err(overwrites(path, other, does));
        }
        known.push((own, path, WRITES));
    }
    Ok(())
}

/// A known file: another name of it is noticed too, and standard input and output where these are files.
struct Known {
    identity: Option<Identity>,
    /// Where it is or will be, if it is no device or pipe, which may be named twice.
    place: Option<PathBuf>,
}

impl Known {
    fn of(path: &Path, standard: &str) -> Self {
        Self { identity: identity(or(path, standard)), place: place(path).filter(|_| !is_special(path)) }
    }

    fn is_same(&self, other: &Self) -> bool {
        let same = |one: &Option<PathBuf>, other: &Option<PathBuf>| one.is_some() && one == other;
        same(&self.place, &other.place) || self.identity.is_some() && self.identity == other.identity
    }
}

fn place(path: &Path) -> Option<PathBuf> {
    let path = &followed(path).unwrap_or_else(|_| path.to_owned());
    // The file may not exist yet, its folder should.
    let name = path.file_name().filter(|_| !is_standard(path))?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    path.canonicalize().ok().or_else(|| Some(folder.canonicalize().ok()?.join(name)))
}

/// Whether an output can be written, asked before there is work to lose. Nothing is left behind.
fn check_output(path: &Path) -> Result<(), Failure> {
    check_open(path)?;
    // A pipe may be opened once.
    if is_standard(path) || is_special(path) && !path.is_dir() {
        return Ok(());
    }
    Output::create(path).map(drop).map_err(|error| super::cannot_write(path, error.into()))
}

/// Refuses standard output where it is closed.
pub(super) fn check_open(path: &Path) -> Result<(), Failure> {
    let names = ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];
    if names.iter().any(|name| path == Path::new(name)) {
        return closed::check().map_err(|error| super::cannot_write(path, error.into()));
    }
    Ok(())
}

/// The meaning of `-`.
fn or<'a>(path: &'a Path, standard: &'a str) -> &'a Path {
    if is_standard(path) { Path::new(standard) } else { path }
}
