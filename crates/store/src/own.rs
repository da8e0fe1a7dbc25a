//! Files of a folder that somebody else may have touched: nothing but files is opened, nothing is waited for, and nothing is written
//! through a link.

use std::fs::{File, OpenOptions};
use std::io;
use std::path::Path;

use delone_io::Output;

use crate::error::Error;

#[cfg(unix)]
use rustix::fs::OFlags;

/// Opens a file to read.
pub(crate) fn open(path: &Path) -> io::Result<File> {
    plain(OpenOptions::new().read(true), path, 0)
}

/// Opens a file to write at its end; it is made if there is none.
pub(crate) fn append(path: &Path) -> io::Result<File> {
    plain(OpenOptions::new().append(true).create(true), path, NO_LINK)
}

/// Opens a file that is there to change it.
pub(crate) fn change(path: &Path) -> io::Result<File> {
    plain(OpenOptions::new().read(true).write(true), path, NO_LINK)
}

/// Writes a file whole, which has its name at once.
pub(crate) fn write<T>(
    path: &Path,
    content: impl FnOnce(&mut Output) -> Result<T, delone_io::Error>,
) -> Result<T, Error> {
    let attempt = || {
        let mut output = Output::create_own(path)?;
        let outcome = content(&mut output)?;
        output.commit()?;
        Ok(outcome)
    };
    attempt().map_err(|error: delone_io::Error| Error::write(path, error))
}

#[cfg(unix)]
const NO_LINK: i32 = OFlags::NOFOLLOW.bits() as i32;
#[cfg(not(unix))]
const NO_LINK: i32 = 0;

#[cfg_attr(not(unix), expect(unused_variables, reason = "there are no pipes among files"))]
fn plain(options: &mut OpenOptions, path: &Path, flags: i32) -> io::Result<File> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt;
        // A pipe that nobody writes to is open at once.
        options.custom_flags(OFlags::NONBLOCK.bits() as i32 | flags);
    }
    let file = options.open(path)?;
    if file.metadata()?.is_file() { Ok(file) } else { Err(io::Error::other("it is no file")) }
}
