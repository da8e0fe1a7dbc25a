//! The header for C++: a program that asserts all of it, and the examples, by each compiler and standard there is.
//!
//! Where there is no C++ compiler these tests say so and pass.

mod tools;

use std::process::Command;

use tools::{here, program, run};

const COMPILERS: [&str; 2] = ["g++", "clang++"];
const STANDARDS: [&str; 2] = ["-std=c++17", "-std=c++20"];
const STRICT: [&str; 5] = ["-pthread", "-Wall", "-Wextra", "-Wpedantic", "-Werror"];

#[test]
fn the_header_does_all_that_it_says() {
    for (i, compiler) in COMPILERS.into_iter().enumerate() {
        // The later standard by one of them: each takes seconds.
        for standard in STANDARDS.into_iter().take(2 - i) {
            let options = [&STRICT[..], &[standard]].concat();
            let Some((_folder, program)) = program(compiler, &here("tests/hpp.cpp"), &options) else {
                continue;
            };
            assert_eq!(run(&mut Command::new(program)), "0 failures\n", "{compiler} {standard}");
        }
    }
}

#[test]
fn examples_run() {
    let mut count = 0;
    for entry in std::fs::read_dir(here("examples")).expect("readable") {
        let source = entry.expect("readable").path();
        if source.extension().is_none_or(|extension| extension != "cpp") {
            continue;
        }
        for compiler in COMPILERS {
            let options = [&STRICT[..], &[STANDARDS[0]]].concat();
            let Some((_folder, program)) = program(compiler, &source, &options) else { continue };
            let told = run(&mut Command::new(program));
            assert!(told.lines().count() > 1, "{} says nothing", source.display());
        }
        count += 1;
    }
    assert!(count >= 4, "only {count} examples");
}

/// Programs that are built without exceptions can use `try_triangulate`.
#[test]
fn exceptions_may_be_off() {
    let folder = tempfile::tempdir().expect("a folder");
    let source = folder.path().join("off.cpp");
    let text = "#include <delone.hpp>\nint main() {\n    std::vector<delone::point> points{{0, 0}, {1, 0}, {0, 1}};\n    \
                auto t = delone::try_triangulate(points);\n    return t ? static_cast<int>(t->size()) - 1 : 9;\n}\n";
    std::fs::write(&source, text).expect("written");
    for compiler in COMPILERS {
        let options = [&STRICT[..], &[STANDARDS[0], "-fno-exceptions"]].concat();
        let Some((_folder, program)) = program(compiler, &source, &options) else { continue };
        assert_eq!(run(&mut Command::new(program)), "");
    }
}
