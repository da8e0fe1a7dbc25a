//! Compiles programs in C and C++ against the library, and runs them.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The folder that cargo puts the library in, beside the tests.
pub(crate) fn libraries() -> PathBuf {
    let test = std::env::current_exe().expect("a path");
    test.parent().expect("a folder").to_owned()
}

/// A file of this package.
pub(crate) fn here(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// Whether there is a program; a test that needs it passes without.
pub(crate) fn has(program: &str) -> bool {
    let found = Command::new(program).arg("--version").output().is_ok_and(|output| output.status.success());
    if !found {
        println!("skipped: there is no {program}");
    }
    found
}

/// The output of a program. It must succeed, and say nothing on standard error.
pub(crate) fn run(command: &mut Command) -> String {
    let output = command.output().expect("it runs");
    let [told, wrong] =
        [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(output.status.success(), "{command:?}: {:?}\n{told}{wrong}", output.status);
    assert!(wrong.is_empty(), "{command:?} printed: {wrong}");
    told
}

/// A program against the static library, so that it runs wherever it is, in a folder of its own.
pub(crate) fn program(
    compiler: &str,
    source: &Path,
    options: &[&str],
) -> Option<(tempfile::TempDir, PathBuf)> {
    if !cfg!(target_os = "linux") || !has(compiler) {
        return None;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let to = folder.path().join("program");
    let mut command = Command::new(compiler);
    command.args(options).arg("-I").arg(here("include")).arg(source).arg("-o").arg(&to);
    command.arg(libraries().join("libdelone_capi.a")).args(["-lm", "-lpthread", "-ldl", "-lgcc_s"]);
    run(&mut command);
    Some((folder, to))
}
