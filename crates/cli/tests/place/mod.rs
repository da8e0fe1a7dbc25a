//! Common parts of the tests of the program.

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
        let mut command = Command::new(crate::PROGRAM);
        command.current_dir(self.0.path()).args(line.split_whitespace()).stdin(Stdio::null());
        command.output().expect("the program starts")
    }

    /// Runs the program in this folder after some words of a shell, as a user whom limits and permissions hold: they do not hold root.
    #[cfg(target_os = "linux")]
    pub(crate) fn run_as_other(&self, words: &str, line: &str) -> Output {
        use std::os::unix::fs::{MetadataExt, PermissionsExt};
        // Where another user finds it.
        if !self.path("delone").exists() {
            std::fs::copy(crate::PROGRAM, self.path("delone")).expect("room");
        }
        let is_root = self.path("").metadata().expect("there").uid() == 0;
        let mut command = Command::new(if is_root { "setpriv" } else { "sh" });
        if is_root {
            std::fs::set_permissions(self.path(""), std::fs::Permissions::from_mode(0o777)).expect("ours");
            command.args(["--reuid=65534", "--regid=65534", "--clear-groups", "sh"]);
        }
        command.args(["-c", &format!("{words}; exec ./delone {line}")]);
        command.current_dir(self.path("")).stdin(Stdio::null()).output().expect("setpriv, or a shell")
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

/// The answers to queries in a table: the last columns, below its header.
pub(crate) fn answers(text: &str, columns: usize) -> Vec<Vec<f64>> {
    let row = |line: &str| {
        let fields: Vec<f64> = line.split(',').filter_map(|field| field.parse().ok()).collect();
        fields[fields.len() - columns..].to_vec()
    };
    text.lines().skip(1).map(row).collect()
}

/// The rows of a csv of integers.
pub(crate) fn rows(text: &str) -> Vec<Vec<i64>> {
    text.lines().map(|line| line.split(',').map(|x| x.parse().expect("an integer")).collect()).collect()
}
