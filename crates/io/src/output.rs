//! Whole files or none: output under a temporary name, renamed when complete.

use std::io::{self, BufWriter, Stdout, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// An output file being written, or standard output for `-`. Dropped before [`Output::commit`], it leaves
/// nothing behind.
#[derive(Debug)]
pub struct Output {
    target: Target,
}

#[derive(Debug)]
enum Target {
    File { path: PathBuf, file: BufWriter<NamedTempFile> },
    Stdout(BufWriter<Stdout>),
}

impl Output {
    /// Begins the file. Nothing with its name is touched yet.
    pub fn create(path: &Path) -> io::Result<Self> {
        if path == Path::new("-") {
            return Ok(Self { target: Target::Stdout(BufWriter::new(io::stdout())) });
        }
        if path.is_dir() {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"));
        }
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let mut name = tempfile::Builder::new();
        name.prefix(".delone-").suffix(".tmp");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // As any new file: the process's mask decides.
            name.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let file = name.tempfile_in(folder.unwrap_or(Path::new(".")))?;
        Ok(Self {
            target: Target::File { path: path.to_owned(), file: BufWriter::with_capacity(1 << 16, file) },
        })
    }

    /// Ends the file and gives it its name.
    pub fn commit(self) -> io::Result<()> {
        match self.target {
            Target::Stdout(mut stdout) => stdout.flush(),
            Target::File { path, file } => {
                let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
                file.persist(path).map_err(|error| error.error)?;
                Ok(())
            }
        }
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.target {
            Target::File { file, .. } => file.write(bytes),
            Target::Stdout(stdout) => stdout.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.target {
            Target::File { file, .. } => file.flush(),
            Target::Stdout(stdout) => stdout.flush(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Output;
    use std::io::Write;

    #[test]
    fn an_output_appears_whole_or_not_at_all() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("out.txt");
        let mut dropped = Output::create(&path).expect("writable");
        dropped.write_all(b"half").expect("written");
        drop(dropped);
        assert_eq!(std::fs::read_dir(folder.path()).expect("readable").count(), 0);
        let mut kept = Output::create(&path).expect("writable");
        kept.write_all(b"whole").expect("written");
        assert!(!path.exists());
        kept.commit().expect("renamed");
        assert_eq!(std::fs::read(&path).expect("readable"), b"whole");
        assert!(Output::create(folder.path()).is_err());
        assert!(Output::create(&folder.path().join("no/such/folder.txt")).is_err());
    }
}
