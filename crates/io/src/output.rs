//! Whole files or none: output under a temporary name, renamed when complete.
//!
//! What is no file (a device, a pipe) is written straight; a name that points elsewhere is followed; a file keeps its
//! mode and its owner, and, if it has several names, all of them.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, BufWriter, Seek, SeekFrom, Stderr, Stdout, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::Duration;

use flate2::Compression;
use flate2::write::GzEncoder;
use tempfile::{NamedTempFile, TempDir, TempPath};

use crate::format::is_gzip;

/// Bytes that are gathered before they are written.
const BUFFER: usize = 1 << 16;

/// Temporary files and folders that exist.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all temporary files and folders of this process, which is about to be ended by a signal.
pub fn remove_unfinished() {
    /// Threads go on meanwhile, and may write into a folder that is being emptied.
    const TRIES: usize = 10;
    if let Some(mut paths) = lock_soon(&UNFINISHED) {
        for path in paths.drain(..) {
            let is_gone = fs::remove_file(&path).is_ok();
            _ = is_gone || (0..TRIES).any(|_| fs::remove_dir_all(&path).is_ok());
        }
    }
}

/// Locks what another thread mostly holds for no longer than it takes to make a file; but whoever holds it may be the one that was stopped.
fn lock_soon<T>(mutex: &Mutex<T>) -> Option<MutexGuard<'_, T>> {
    const TRIES: usize = 200;
    (0..TRIES).find_map(|_| match mutex.try_lock() {
        Ok(guard) => Some(guard),
        Err(TryLockError::Poisoned(error)) => Some(error.into_inner()),
        Err(TryLockError::WouldBlock) => {
            std::thread::sleep(Duration::from_millis(5));
            None
        }
    })
}

/// A folder for work, which goes with all that is in it when this is dropped, or by [`remove_unfinished`].
#[derive(Debug)]
pub struct TemporaryFolder(TempDir);

impl TemporaryFolder {
    /// Makes it in another folder, with a name that begins so.
    pub fn create(within: &Path, prefix: &str) -> io::Result<Self> {
        // Known before a signal can come between.
        let mut paths = unfinished();
        let folder = tempfile::Builder::new().prefix(prefix).tempdir_in(within)?;
        paths.push(folder.path().to_owned());
        Ok(Self(folder))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.0.path()
    }
}

impl Drop for TemporaryFolder {
    fn drop(&mut self) {
        // Forgotten when it is gone: a signal in between still finds it.
        _ = fs::remove_dir_all(self.0.path());
        unfinished().retain(|known| known != self.0.path());
    }
}

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
    File(BufWriter<File>),
    Stdout(BufWriter<Stdout>),
    Stderr(BufWriter<Stderr>),
}

/// What becomes of the file in the end.
#[derive(Debug)]
enum Place {
    /// It was written straight.
    Straight,
    /// It gets this name, and the mode and owner of the file that has it.
    Rename { from: Temporary, to: PathBuf, before: Option<Metadata> },
    /// It is copied into the file of this name.
    Copy { from: Temporary, to: File },
}

/// A temporary file, and that it is known to [`remove_unfinished`].
#[derive(Debug)]
struct Temporary(Option<TempPath>);

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(path) = self.0.take() {
            unfinished().retain(|known| known != &*path);
        }
    }
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

    /// Ends the file and gives it its name.
    pub fn commit(self) -> io::Result<()> {
        let sink = match self.writer {
            Writer::Plain(sink) => sink,
            Writer::Gzip(encoder) => encoder.finish()?,
        };
        let file = match sink {
            Sink::Stdout(mut stdout) => return stdout.flush(),
            Sink::Stderr(mut stderr) => return stderr.flush(),
            Sink::File(file) => file.into_inner().map_err(io::IntoInnerError::into_error)?,
        };
        match self.place {
            Place::Straight => Ok(()),
            Place::Rename { mut from, to, before } => {
                let keeps = before.is_none_or(|before| take_after(&file, &before).is_ok());
                drop(file);
                if !keeps {
                    // Only its owner can make another file look like it.
                    let old = OpenOptions::new().write(true).open(&to)?;
                    return copy(&from, old);
                }
                let Some(path) = from.0.take() else { return Ok(()) };
                let known = path.to_path_buf();
                let renamed = path.persist(&to).map_err(|error| error.error);
                unfinished().retain(|path| path != &known);
                renamed
            }
            Place::Copy { from, to } => {
                drop(file);
                copy(&from, to)
            }
        }
    }
}

/// Where an output goes, and how it gets there.
fn open(path: &Path) -> io::Result<(Sink, Place)> {
    let is = |names: [&str; 3]| names.iter().any(|name| path == Path::new(name));
    if path == Path::new("-") || is(["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"]) {
        return Ok((Sink::Stdout(BufWriter::with_capacity(BUFFER, io::stdout())), Place::Straight));
    }
    if is(["/dev/stderr", "/dev/fd/2", "/proc/self/fd/2"]) {
        return Ok((Sink::Stderr(BufWriter::with_capacity(BUFFER, io::stderr())), Place::Straight));
    }
    let straight = |file| (Sink::File(BufWriter::with_capacity(BUFFER, file)), Place::Straight);
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
    let old = before.as_ref().map(|_| OpenOptions::new().write(true).open(&path)).transpose()?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let beside = temporary(folder);
    let (file, from, old) = match (beside, old) {
        (Ok((file, from)), Some(old)) if before.as_ref().is_some_and(has_many_names) => {
            (file, from, Some(old))
        }
        (Ok((file, from)), _) => (file, from, None),
        // The file may be written, its folder not.
        (Err(_), Some(old)) => {
            let (file, from) = temporary(&std::env::temp_dir())?;
            (file, from, Some(old))
        }
        (Err(error), None) => return Err(error),
    };
    let place = match old {
        Some(to) => Place::Copy { from, to },
        None => Place::Rename { from, to: path, before },
    };
    Ok((Sink::File(BufWriter::with_capacity(BUFFER, file)), place))
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

fn temporary(folder: &Path) -> io::Result<(File, Temporary)> {
    let mut name = tempfile::Builder::new();
    name.prefix(".delone-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As any new file: the process's mask decides.
        name.permissions(fs::Permissions::from_mode(0o666));
    }
    // Known before a signal can come between.
    let mut paths = unfinished();
    let (file, path) = NamedTempFile::into_parts(name.tempfile_in(folder)?);
    paths.push(path.to_path_buf());
    Ok((file, Temporary(Some(path))))
}

fn copy(from: &Temporary, mut to: File) -> io::Result<()> {
    if let Some(path) = &from.0 {
        let mut source = File::open(path)?;
        to.set_len(0)?;
        io::copy(&mut source, &mut to)?;
    }
    Ok(())
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

/// Files can be written anywhere; what is compressed, and what is no file, from its beginning to its end.
impl Seek for Output {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match (&mut self.writer, &self.place) {
            (Writer::Plain(Sink::File(file)), Place::Rename { .. } | Place::Copy { .. }) => file.seek(to),
            _ => {
                Err(io::Error::new(io::ErrorKind::NotSeekable, "it is written from its beginning to its end"))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Output, lock_soon};
    use std::fs;
    use std::io::{Seek, SeekFrom, Write};
    use std::path::Path;
    use std::sync::{Mutex, mpsc};
    use std::time::Duration;

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

    #[test]
    fn files_alone_can_be_written_anywhere() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("out.txt");
        let mut output = Output::create(&path).expect("writable");
        output.write_all(b"12345").expect("written");
        output.seek(SeekFrom::Start(1)).expect("a file");
        output.write_all(b"xy").expect("written");
        output.commit().expect("renamed");
        assert_eq!(fs::read(&path).expect("readable"), b"1xy45");
        assert!(Output::create(Path::new("-")).expect("there").stream_position().is_err());
        let mut packed = Output::create(&folder.path().join("out.txt.gz")).expect("writable");
        assert!(packed.stream_position().is_err());
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

    #[test]
    fn a_lock_that_another_thread_holds_is_waited_for() {
        let mutex = Mutex::new(1);
        let (ready, wait) = mpsc::channel();
        std::thread::scope(|scope| {
            scope.spawn(|| {
                let _held = mutex.lock();
                _ = ready.send(());
                std::thread::sleep(Duration::from_millis(30));
            });
            assert!(wait.recv().is_ok());
            assert!(lock_soon(&mutex).is_some());
        });
        // One that is never given back ends the patience.
        let _held = mutex.lock();
        assert!(lock_soon(&mutex).is_none());
    }
}
