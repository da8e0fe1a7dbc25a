//! The header for C++: a program that asserts all of it, and the examples, by each compiler and standard there is.
//!
//! Where there is no C++ compiler these tests say so and pass.

use std::path::{Path, PathBuf};
use std::process::Command;

const COMPILERS: [&str; 2] = ["g++", "clang++"];
const STANDARDS: [&str; 2] = ["-std=c++17", "-std=c++20"];

/// The folder that cargo puts the library in.
fn libraries() -> PathBuf {
    let test = std::env::current_exe().expect("a path");
    test.ancestors().nth(2).expect("deps is in a folder").to_owned()
}

fn compilers() -> Vec<&'static str> {
    let has = |name: &&str| Command::new(name).arg("--version").output().is_ok_and(|o| o.status.success());
    let found: Vec<_> = COMPILERS.into_iter().filter(has).collect();
    if found.is_empty() || !cfg!(target_os = "linux") {
        println!("skipped: there is no C++ compiler");
        return Vec::new();
    }
    found
}

fn compile(compiler: &str, options: &[&str], source: &Path, to: &Path) {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut command = Command::new(compiler);
    command.args(["-Wall", "-Wextra", "-Wpedantic", "-Werror"]).args(options);
    command.arg("-I").arg(here.join("include")).arg(source).arg("-o").arg(to);
    command.arg(libraries().join("libdelone_capi.a")).args(["-lm", "-lpthread", "-ldl", "-lgcc_s"]);
    let output = command.output().expect("it runs");
    let words = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && words.is_empty(), "{command:?}:\n{words}");
}

fn run(program: &Path) -> String {
    let output = Command::new(program).output().expect("it runs");
    let words = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && words.is_empty(), "{}:\n{words}", program.display());
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn the_header_does_all_that_it_says() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = folder.path().join("program");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/hpp.cpp");
    for (i, compiler) in compilers().into_iter().enumerate() {
        // The later standard by one of them: each takes seconds.
        for standard in &STANDARDS[..if i == 0 { 2 } else { 1 }] {
            compile(compiler, &[standard, "-pthread"], &source, &program);
            assert_eq!(run(&program), "0 failures\n", "{compiler} {standard}");
        }
    }
}

#[test]
fn examples_run() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = folder.path().join("program");
    let mut count = 0;
    for entry in std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples")).expect("readable")
    {
        let source = entry.expect("readable").path();
        if source.extension().is_none_or(|extension| extension != "cpp") {
            continue;
        }
        for compiler in compilers() {
            compile(compiler, &[STANDARDS[0]], &source, &program);
            assert!(run(&program).lines().count() > 1, "{} says nothing", source.display());
        }
        count += 1;
    }
    assert!(count >= 4, "only {count} examples");
}

/// Programs that are built without exceptions can use `try_triangulate`.
#[test]
fn exceptions_may_be_off() {
    let folder = tempfile::tempdir().expect("a folder");
    let [source, program] = ["off.cpp", "program"].map(|name| folder.path().join(name));
    let text = "#include <delone.hpp>\nint main() {\n    std::vector<delone::point> points{{0, 0}, {1, 0}, {0, 1}};\n    \
                auto t = delone::try_triangulate(points);\n    return t ? static_cast<int>(t->size()) - 1 : 9;\n}\n";
    std::fs::write(&source, text).expect("written");
    for compiler in compilers() {
        compile(compiler, &[STANDARDS[0], "-fno-exceptions"], &source, &program);
        assert_eq!(run(&program), "");
    }
}
