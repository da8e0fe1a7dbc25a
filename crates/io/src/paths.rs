//! Files by their paths, and the files beside them.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};

use crate::{Error, Format, Source, decompressed};

/// Opens a file and decompresses it.
///
/// ```no_run
/// use std::path::Path;
/// use delone_io::{ReadOptions, beside, open, read_points_beside};
///
/// let path = Path::new("survey.laz");
/// let (source, format) = open(path)?;
/// let cloud = read_points_beside(source, format, &ReadOptions::default(), &mut beside(path))?;
/// # Ok::<(), delone_io::Error>(())
/// ```
///
/// # Errors
/// [`Error::UnknownExtension`], and those of the system.
pub fn open(path: &Path) -> Result<(Box<dyn Source>, Format), Error> {
    let format = Format::of(path)?;
    Ok((open_as(path, format)?, format))
}

/// Opens a file of a format that is known, and decompresses it.
///
/// # Errors
/// Those of the system.
pub fn open_as(path: &Path, format: Format) -> Result<Box<dyn Source>, Error> {
    decompressed(Box::new(BufReader::with_capacity(1 << 16, File::open(path)?)), format)
}

/// Opens what lies beside a file, by the names of [`side`], as readers ask for it ([`crate::read_points_beside`]).
pub fn beside(path: &Path) -> impl FnMut(&str) -> Result<Box<dyn Source>, Error> {
    move |extension| {
        let beside = side(path, extension);
        let opened = File::open(&beside).map_err(|error| {
            let what = format!("what is beside it in {}: {error}", beside.display());
            Error::from(io::Error::new(error.kind(), what))
        })?;
        Ok(Box::new(BufReader::new(opened)))
    }
}

/// The name of a file beside another one: by its extension, in capital letters where the file's own is, or by its path from the same
/// folder.
///
/// ```
/// use std::path::Path;
/// use delone_io::side;
///
/// assert_eq!(side(Path::new("maps/lots.shp"), "dbf"), Path::new("maps/lots.dbf"));
/// assert_eq!(side(Path::new("ept/ept.json"), "ept-data/0-0-0-0.laz"), Path::new("ept/ept-data/0-0-0-0.laz"));
/// ```
pub fn side(path: &Path, extension: &str) -> PathBuf {
    if extension.contains('/') {
        return path.with_file_name(extension);
    }
    let is_capital = |own: &OsStr| own.as_encoded_bytes().iter().all(u8::is_ascii_uppercase);
    let capital = path.with_extension(extension.to_ascii_uppercase());
    if path.extension().is_some_and(is_capital) && capital.exists() {
        return capital;
    }
    path.with_extension(extension)
}
