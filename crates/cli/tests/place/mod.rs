//! What tests of the program share.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

/// A folder of its own for each test.
pub(crate) struct Place(pub(crate) TempDir);

impl Place {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder"))
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn file(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        std::fs::write(self.path(name), content).expect("written");
        self.path(name)
    }

    /// The text of a file in this folder.
    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).expect(name)
    }

    /// Runs the program in this folder.
    pub(crate) fn run(&self, line: &str) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_delone"));
        command.current_dir(self.0.path()).args(line.split_whitespace()).stdin(Stdio::null());
        command.output().expect("the program starts")
    }

    /// Runs a line that must succeed; returns standard output.
    pub(crate) fn succeed(&self, line: &str) -> String {
        let output = self.run(line);
        assert!(output.status.success(), "{line}: {}", text(&output.stderr));
        text(&output.stdout)
    }

    /// Runs a line that must fail with a status, a message of two lines, and no new file.
    pub(crate) fn fail(&self, line: &str, status: i32, message: &str) {
        let before = self.names();
        let output = self.run(line);
        let stderr = text(&output.stderr);
        assert_eq!(output.status.code(), Some(status), "{line}: {stderr}");
        let lines: Vec<_> = stderr.lines().filter(|line| !line.starts_with("note: ")).collect();
        assert_eq!(lines.len(), 2, "{line}: {stderr}");
        assert!(lines[0].starts_with("error: ") && lines[0].contains(message), "{line}: {stderr}");
        assert!(lines[1].starts_with("help: "), "{line}: {stderr}");
        assert_eq!(self.names(), before, "{line} left something behind");
    }

    fn names(&self) -> Vec<PathBuf> {
        let mut names: Vec<_> = std::fs::read_dir(self.0.path())
            .expect("readable")
            .map(|entry| entry.expect("readable").path())
            .collect();
        names.sort();
        names
    }
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

pub(crate) fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data").join(name)
}

/// The rows of a csv of integers.
pub(crate) fn rows(text: &str) -> Vec<Vec<i64>> {
    text.lines().map(|line| line.split(',').map(|x| x.parse().expect("an integer")).collect()).collect()
}
