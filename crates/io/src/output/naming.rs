//! Finished files get their names: all of them, or none.
//!
//! Earlier files of these names are kept until all is done, and put back if something fails. A file that has to keep its place on the disk, because it
//! has several names or its folder may not be written, is written over in place; what it held is beside it meanwhile, as `NAME.old-XXXXXX`,
//! and stays there if even the machine fails.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use tempfile::TempPath;

use super::staging::TemporaryFolder;

/// Held while files get their names.
static NAMING: Mutex<()> = Mutex::new(());

/// Waits until files that get their names just now have them: between, some would have them and some not.
pub fn wait_for_names() {
    drop(NAMING.lock().unwrap_or_else(PoisonError::into_inner));
}

/// A file that is written and has not its name yet; without one, if it was written straight.
#[derive(Debug)]
pub struct Finished(pub(super) Option<Staged>);

/// A file on its way to a name.
#[derive(Debug)]
pub(super) struct Staged {
    /// The folder that it is in.
    pub(super) stage: Arc<TemporaryFolder>,
    pub(super) from: PathBuf,
    pub(super) to: PathBuf,
    pub(super) how: How,
}

impl Drop for Staged {
    fn drop(&mut self) {
        // Where it has its name there is nothing left.
        _ = fs::remove_file(&self.from);
    }
}

#[derive(Debug)]
pub(super) enum How {
    /// It gets the name, and the mode and owner of the file that has it.
    Rename(Option<Metadata>),
    /// It is copied into the file of that name.
    Copy,
}

/// A step that restores the earlier state.
enum Undo {
    Remove(PathBuf),
    Rename { from: PathBuf, to: PathBuf },
    Copy { from: TempPath, to: PathBuf },
}

/// Gives all files their names, or none.
///
/// # Errors
/// The name that could not be given, and why.
pub fn give_names(finished: Vec<Finished>) -> Result<(), (PathBuf, io::Error)> {
    let _held = NAMING.lock().unwrap_or_else(PoisonError::into_inner);
    let mut staged: Vec<Staged> = finished.into_iter().filter_map(|finished| finished.0).collect();
    // What may fail for want of room comes first.
    staged.sort_by_key(|one| matches!(one.how, How::Rename(_)));
    let has_others = staged.len() > 1;
    let mut done = Vec::new();
    for one in &staged {
        match one.name(has_others) {
            Ok(undo) => done.push(undo),
            Err(error) => {
                for undo in done.into_iter().rev() {
                    undo.run().map_err(|error| (one.to.clone(), error))?;
                }
                return Err((one.to.clone(), error));
            }
        }
    }
    Ok(())
}

impl Staged {
    /// Gives it its name; says how to take it back.
    fn name(&self, has_others: bool) -> io::Result<Undo> {
        if let How::Copy = self.how {
            let old = kept(&self.to)?;
            return match overwrite(&mut File::open(&self.from)?, &self.to) {
                Ok(()) => Ok(Undo::Copy { from: old, to: self.to.clone() }),
                Err(error) => {
                    Undo::Copy { from: old, to: self.to.clone() }.run()?;
                    Err(error)
                }
            };
        }
        let mut undo = Undo::Remove(self.to.clone());
        let before = self.to.symlink_metadata().ok();
        if before.as_ref().is_some_and(Metadata::is_dir) {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"));
        }
        if has_others && before.is_some() {
            let old = self.stage.new_name();
            // Where files have one name only, there is none for a moment.
            fs::hard_link(&self.to, &old).or_else(|_| fs::rename(&self.to, &old))?;
            undo = Undo::Rename { from: old, to: self.to.clone() };
        }
        match fs::rename(&self.from, &self.to) {
            Ok(()) => Ok(undo),
            Err(error) => {
                if let Undo::Rename { .. } = undo {
                    undo.run()?;
                }
                Err(error)
            }
        }
    }
}

impl Undo {
    fn run(self) -> io::Result<()> {
        match self {
            Self::Remove(path) => fs::remove_file(path),
            Self::Rename { from, to } => fs::rename(from, to),
            Self::Copy { from, to } => {
                let back = File::open(&from).and_then(|mut old| overwrite(&mut old, &to));
                back.map_err(|error| {
                    let old = from.display().to_string();
                    _ = from.keep();
                    io::Error::new(error.kind(), format!("{error}; what it held is in {old}"))
                })
            }
        }
    }
}

/// A copy of a file, beside it if that may be.
fn kept(path: &Path) -> io::Result<TempPath> {
    let mut name = tempfile::Builder::new();
    let prefix = format!("{}.old-", path.file_name().unwrap_or_default().to_string_lossy());
    name.prefix(&prefix);
    let beside = name.tempfile_in(super::folder_of(path));
    let mut copy = beside.or_else(|_| name.tempfile_in(std::env::temp_dir()))?;
    io::copy(&mut File::open(path)?, &mut copy)?;
    Ok(copy.into_temp_path())
}

/// Writes over a file in its place. It is cut to its length in the end, so that what was there can be written back without more room.
fn overwrite(source: &mut impl Read, path: &Path) -> io::Result<()> {
    let mut file = OpenOptions::new().write(true).open(path)?;
    io::copy(source, &mut file)?;
    file.flush()?;
    let length = file.stream_position()?;
    file.set_len(length)
}

#[cfg(test)]
mod tests {
    use super::{Finished, How, Staged, TemporaryFolder, give_names};
    use std::fs;
    use std::path::{Path, PathBuf};

    /// A finished file with the content `new`.
    fn finished(to: &Path, how: How) -> Finished {
        let stage = TemporaryFolder::shared(to.parent().expect("a folder")).expect("room");
        let from = stage.new_name();
        fs::write(&from, "new").expect("room");
        Finished(Some(Staged { stage, from, to: to.to_owned(), how }))
    }

    fn contents(folder: &Path) -> Vec<(PathBuf, String)> {
        let mut names: Vec<PathBuf> =
            fs::read_dir(folder).expect("readable").map(|entry| entry.expect("there").path()).collect();
        names.sort();
        names.into_iter().map(|path| (path.clone(), fs::read_to_string(path).unwrap_or_default())).collect()
    }

    #[test]
    fn several_files_get_their_names_or_none() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let at = |name: &str| folder.path().join(name);
        fs::write(at("a"), "old").expect("room");
        fs::write(at("c"), "longer than what is new").expect("room");
        // A folder in the way of the last one.
        fs::create_dir(at("d")).expect("room");
        fs::write(at("d/in it"), "").expect("room");
        let before = contents(folder.path());
        let all = |last: &str| {
            let rename = |name: &str| finished(&at(name), How::Rename(None));
            vec![rename("a"), rename("b"), finished(&at("c"), How::Copy), rename(last)]
        };
        let (path, _) = give_names(all("d")).expect_err("a folder has that name");
        assert_eq!(path, at("d"));
        assert_eq!(contents(folder.path()), before);
        give_names(all("e")).expect("room");
        for name in ["a", "b", "c", "e"] {
            assert_eq!(fs::read_to_string(at(name)).expect(name), "new");
        }
        assert_eq!(contents(folder.path()).len(), 5);
    }

    #[test]
    fn a_file_that_is_written_in_place_comes_back() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a");
        for old in ["old", "longer than what is new", ""] {
            fs::write(&path, old).expect("room");
            let mut one = finished(&path, How::Copy);
            // Half of it can be read: a folder cannot.
            if let Some(staged) = &mut one.0 {
                fs::remove_file(&staged.from).expect("there");
                fs::create_dir(&staged.from).expect("room");
            }
            give_names(vec![one]).expect_err("there is nothing to read");
            assert_eq!(contents(folder.path()), [(path.clone(), old.to_owned())]);
        }
    }

    #[test]
    fn what_was_written_half_is_written_back() {
        use std::io::{self, Read};
        /// Gives some bytes, and then an error.
        struct Half(bool);
        impl Read for Half {
            fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
                if std::mem::replace(&mut self.0, true) {
                    return Err(io::Error::other("no more"));
                }
                bytes[..2].copy_from_slice(b"ne");
                Ok(2)
            }
        }
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a");
        fs::write(&path, "old and long").expect("room");
        let old = super::kept(&path).expect("room");
        assert!(old.file_name().expect("a name").to_string_lossy().starts_with("a.old-"));
        super::overwrite(&mut Half(false), &path).expect_err("no more");
        assert_eq!(fs::read(&path).expect("there"), b"ned and long");
        super::Undo::Copy { from: old, to: path.clone() }.run().expect("room");
        assert_eq!(contents(folder.path()), [(path.clone(), "old and long".to_owned())]);
    }
}
