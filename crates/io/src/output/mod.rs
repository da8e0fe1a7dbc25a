//! Whole files or none: output under a temporary name (`staging.rs`), renamed when complete (`naming.rs`).
//!
//! Devices and pipes are written directly; a name that points elsewhere is followed; a file keeps its
//! mode and its owner, and, if it has several names, all of them.

mod naming;
mod staging;

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, BufWriter, Stderr, Stdout, Write};
use std::path::{Path, PathBuf};

use flate2::Compression;
use flate2::write::GzEncoder;

use crate::format::is_gzip;
use crate::limit::Counted;

pub use naming::{Finished, give_names, wait_for_names};
pub use staging::{TemporaryFolder, remove_unfinished};

use naming::{How, Staged};

/// Bytes that are gathered before they are written.
const BUFFER: usize = 1 << 16;

/// An output file being written, or standard output for `-`; compressed if its name ends in `.gz`. Dropped before
/// [`Output::commit`], it leaves nothing behind.
#[derive(Debug)]
pub struct Output {
    writer: Writer,
    place: Place,
}

/// Where bytes go: as they are, or compressed.
#[derive(Debug)]
enum Writer {
    Plain(Sink),
    Gzip(Box<GzEncoder<Sink>>),
}

#[derive(Debug)]
enum Sink {
    File(BufWriter<Counted<File>>),
    Stdout(BufWriter<Counted<Stdout>>),
    Stderr(BufWriter<Counted<Stderr>>),
}

/// The fate of the file in the end.
#[derive(Debug)]
enum Place {
    /// It was written straight.
    Straight,
    Staged(Staged),
    /// The same, and it is on the disk before it has its name.
    Durable(Staged),
}

impl Output {
    /// Begins the file. Nothing with its name is touched yet.
    pub fn create(path: &Path) -> io::Result<Self> {
        let (sink, place) = open(path)?;
        let writer = if is_gzip(path) {
            Writer::Gzip(Box::new(GzEncoder::new(sink, Compression::default())))
        } else {
            Writer::Plain(sink)
        };
        Ok(Self { writer, place })
    }

    /// Begins a file of a folder that is this program's own. Whatever has its name is replaced, and nothing is followed, opened or waited
    /// for. Its bytes are on the disk before it has the name, unless the folder goes with the work.
    pub fn create_own(path: &Path) -> io::Result<Self> {
        let (file, staged) = stage(path, folder_of(path), How::Rename(None))?;
        let place = if staging::is_temporary(path) { Place::Staged(staged) } else { Place::Durable(staged) };
        Ok(Self { writer: Writer::Plain(Sink::File(BufWriter::with_capacity(BUFFER, Counted(file)))), place })
    }

    /// Ends the file and gives it its name.
    pub fn commit(self) -> io::Result<()> {
        give_names(vec![self.finish()?]).map_err(|(_, error)| error)
    }

    /// Ends the file, which is to get its name together with others.
    pub fn finish(self) -> io::Result<Finished> {
        let sink = match self.writer {
            Writer::Plain(sink) => sink,
            Writer::Gzip(encoder) => encoder.finish()?,
        };
        let file = match sink {
            Sink::Stdout(mut stdout) => {
                stdout.flush()?;
                return Ok(Finished(None));
            }
            Sink::Stderr(mut stderr) => {
                stderr.flush()?;
                return Ok(Finished(None));
            }
            Sink::File(file) => file.into_inner().map_err(io::IntoInnerError::into_error)?.0,
        };
        let mut staged = match self.place {
            Place::Straight => return Ok(Finished(None)),
            Place::Staged(staged) => staged,
            Place::Durable(staged) => {
                file.sync_data()?;
                staged
            }
        };
        if let How::Rename(Some(before)) = &staged.how
            && take_after(&file, before).is_err()
        {
            // Only its owner can make another file look like it.
            staged.how = How::Copy;
        }
        Ok(Finished(Some(staged)))
    }
}

/// Waits until a file is on the disk; not one that goes with the work.
pub fn sync_file(path: &Path) -> io::Result<()> {
    if staging::is_temporary(path) { Ok(()) } else { OpenOptions::new().append(true).open(path)?.sync_data() }
}

/// Waits until the names of a folder are on the disk; not of one that goes with the work, nor where folders cannot be asked to.
pub fn sync_folder(folder: &Path) -> io::Result<()> {
    if staging::is_temporary(folder) {
        return Ok(());
    }
    match File::open(folder).and_then(|folder| folder.sync_all()) {
        Err(error) if !cfg!(unix) || error.kind() == io::ErrorKind::InvalidInput => Ok(()),
        outcome => outcome,
    }
}

/// The folder of a file.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A file in a temporary folder in another one, on its way to a name.
fn stage(to: &Path, within: &Path, how: How) -> io::Result<(File, Staged)> {
    let stage = TemporaryFolder::shared(within)?;
    let from = stage.new_name();
    let file = OpenOptions::new().read(true).write(true).create_new(true).open(&from)?;
    Ok((file, Staged { stage, from, to: to.to_owned(), how }))
}

/// Where an output goes, and how it gets there.
fn open(path: &Path) -> io::Result<(Sink, Place)> {
    let is = |names: [&str; 3]| names.iter().any(|name| path == Path::new(name));
    if path == Path::new("-") || is(["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"]) {
        return Ok((Sink::Stdout(BufWriter::with_capacity(BUFFER, Counted(io::stdout()))), Place::Straight));
    }
    if is(["/dev/stderr", "/dev/fd/2", "/proc/self/fd/2"]) {
        return Ok((Sink::Stderr(BufWriter::with_capacity(BUFFER, Counted(io::stderr()))), Place::Straight));
    }
    let straight = |file| (Sink::File(BufWriter::with_capacity(BUFFER, Counted(file))), Place::Straight);
    let path = followed(path)?;
    if is_descriptor(&path) {
        // A descriptor of a file that others write to is written to at its end.
        return Ok(straight(OpenOptions::new().append(true).open(&path)?));
    }
    let before = match fs::metadata(&path) {
        Ok(about) => Some(about),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    match &before {
        Some(about) if about.is_dir() => {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"));
        }
        Some(about) if !about.is_file() => {
            return Ok(straight(OpenOptions::new().write(true).open(&path)?));
        }
        Some(about) if about.permissions().readonly() => {
            return Err(io::Error::new(io::ErrorKind::PermissionDenied, "it may not be written"));
        }
        _ => {}
    }
    // Whether it may be written is asked now, not when all work is done.
    if before.is_some() {
        OpenOptions::new().write(true).open(&path)?;
    }
    let is_copied = before.as_ref().is_some_and(has_many_names);
    let is_there = before.is_some();
    let how = if is_copied { How::Copy } else { How::Rename(before) };
    let (file, staged) = match stage(&path, folder_of(&path), how) {
        // The file may be written, its folder not.
        Err(_) if is_there => stage(&path, &std::env::temp_dir(), How::Copy)?,
        staged => staged?,
    };
    Ok((Sink::File(BufWriter::with_capacity(BUFFER, Counted(file))), Place::Staged(staged)))
}

/// Whether a path is a descriptor, whose link is not the name of a file: /dev/fd/3, /proc/self/fd/3.
fn is_descriptor(path: &Path) -> bool {
    let parts: Vec<&str> = path.iter().filter_map(|part| part.to_str()).collect();
    let number = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    match parts[..] {
        ["/", "dev", "fd", n] | ["/", "proc", _, "fd", n] => number(n),
        ["/", "dev", name] => ["stdin", "stdout", "stderr"].contains(&name),
        _ => false,
    }
}

/// The file that a name stands for, which need not exist; descriptors stand for themselves.
pub fn followed(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    // As many links as systems follow.
    for _ in 0..40 {
        match fs::read_link(&path) {
            _ if is_descriptor(&path) => return Ok(path),
            Ok(to) => path = path.parent().unwrap_or(Path::new("")).join(to),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("too many links"))
}

/// Gives a file the mode and the owner of another.
#[cfg(unix)]
fn take_after(file: &File, before: &Metadata) -> io::Result<()> {
    use std::os::unix::fs::MetadataExt;
    let new = file.metadata()?;
    if (new.uid(), new.gid()) != (before.uid(), before.gid()) {
        std::os::unix::fs::fchown(file, Some(before.uid()), Some(before.gid()))?;
    }
    file.set_permissions(before.permissions())
}

#[cfg(not(unix))]
fn take_after(_: &File, _: &Metadata) -> io::Result<()> {
    Ok(())
}

#[cfg(unix)]
fn has_many_names(about: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    about.nlink() > 1
}

#[cfg(not(unix))]
fn has_many_names(_: &Metadata) -> bool {
    false
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::File(file) => file.write(bytes),
            Self::Stdout(stdout) => stdout.write(bytes),
            Self::Stderr(stderr) => stderr.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::File(file) => file.flush(),
            Self::Stdout(stdout) => stdout.flush(),
            Self::Stderr(stderr) => stderr.flush(),
        }
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.writer {
            Writer::Plain(sink) => sink.write(bytes),
            Writer::Gzip(encoder) => encoder.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.writer {
            Writer::Plain(sink) => sink.flush(),
            Writer::Gzip(encoder) => encoder.flush(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Output;
    use std::fs;
    use std::io::Write;
    use std::path::Path;

    fn write(path: &Path, content: &[u8]) {
        let mut output = Output::create(path).expect("writable");
        output.write_all(content).expect("written");
        output.commit().expect("named");
    }

    #[test]
    fn an_output_appears_whole_or_not_at_all() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("out.txt");
        let mut dropped = Output::create(&path).expect("writable");
        dropped.write_all(b"half").expect("written");
        drop(dropped);
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 0);
        let mut kept = Output::create(&path).expect("writable");
        kept.write_all(b"whole").expect("written");
        assert!(!path.exists());
        kept.commit().expect("renamed");
        assert_eq!(fs::read(&path).expect("readable"), b"whole");
        assert!(Output::create(folder.path()).is_err());
        assert!(Output::create(&folder.path().join("no/such/folder.txt")).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn what_is_no_plain_file_stays_what_it_is() {
        use std::os::unix::fs::{FileTypeExt, MetadataExt, PermissionsExt, symlink};
        let folder = tempfile::tempdir().expect("a temporary folder");
        let place = |name: &str| folder.path().join(name);
        // A link is followed, where it leads to nothing too.
        symlink("real.txt", place("link.txt")).expect("linked");
        write(&place("link.txt"), b"1");
        assert!(place("link.txt").is_symlink());
        assert_eq!(fs::read(place("real.txt")).expect("readable"), b"1");
        // The mode stays.
        fs::set_permissions(place("real.txt"), fs::Permissions::from_mode(0o640)).expect("set");
        write(&place("link.txt"), b"22");
        assert_eq!(fs::metadata(place("real.txt")).expect("there").permissions().mode() & 0o777, 0o640);
        // All names of a file see what is written.
        fs::hard_link(place("real.txt"), place("other.txt")).expect("linked");
        write(&place("other.txt"), b"3");
        assert_eq!(fs::read(place("real.txt")).expect("readable"), b"3");
        assert_eq!(fs::metadata(place("real.txt")).expect("there").nlink(), 2);
        // What may not be written is refused.
        fs::set_permissions(place("real.txt"), fs::Permissions::from_mode(0o444)).expect("set");
        assert!(Output::create(&place("real.txt")).is_err());
        // A device takes the bytes.
        write(Path::new("/dev/null"), b"gone");
        assert!(fs::metadata("/dev/null").expect("there").file_type().is_char_device());
        // Links in a circle.
        symlink("a", place("b")).expect("linked");
        symlink("b", place("a")).expect("linked");
        assert!(Output::create(&place("a")).is_err());
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 5);
    }

    #[cfg(unix)]
    #[test]
    fn own_files_replace_what_has_their_name() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().expect("a temporary folder");
        let place = |name: &str| folder.path().join(name);
        fs::write(place("victim"), "precious").expect("room");
        symlink(place("victim"), place("link")).expect("linked");
        fs::hard_link(place("victim"), place("second")).expect("linked");
        assert!(std::process::Command::new("mkfifo").arg(place("pipe")).status().expect("mkfifo").success());
        for name in ["link", "second", "pipe", "new"] {
            let mut output = Output::create_own(&place(name)).expect("writable");
            output.write_all(b"own").expect("written");
            output.commit().expect("renamed");
            assert!(place(name).symlink_metadata().expect("there").is_file(), "{name}");
            assert_eq!(fs::read(place(name)).expect("readable"), b"own");
        }
        assert_eq!(fs::read(place("victim")).expect("readable"), b"precious");
    }

    #[test]
    fn a_name_may_ask_for_compression() {
        use std::io::Read;
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("out.csv.gz");
        write(&path, b"0,1\n");
        let mut text = String::new();
        let bytes = fs::read(&path).expect("readable");
        flate2::read::GzDecoder::new(&bytes[..]).read_to_string(&mut text).expect("gzip");
        assert_eq!(text, "0,1\n");
    }
}
