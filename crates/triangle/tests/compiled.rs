//! Programs in C and C++ that use the header, if there are compilers.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The folder of the library that this test was built with.
fn library() -> Option<PathBuf> {
    let own = std::env::current_exe().expect("a path");
    let folders = own.ancestors().skip(1).take(2).map(Path::to_path_buf);
    folders.into_iter().find(|folder| folder.join("libdelone_triangle.so").exists())
}

fn run(command: &mut Command) -> Option<Output> {
    command.env("LC_ALL", "de_DE.UTF-8").output().ok()
}

#[cfg(target_os = "linux")]
#[test]
fn programs_in_c_and_in_cpp() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let Some(library) = library() else { return println!("skipped: there is no libdelone_triangle.so") };
    let folder = std::env::temp_dir().join(format!("delone-triangle-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let name = folder.join("libdelone_triangle.so.0");
    std::os::unix::fs::symlink(library.join("libdelone_triangle.so"), &name).expect("a link");
    let warnings = ["-Wall", "-Wextra", "-Werror", "-pedantic"];
    for (compiler, language) in [
        ("cc", &["-std=c89"][..]),
        ("cc", &["-std=c99", "-DDELONE_TRIANGLE_INT"]),
        ("cc", &["-std=c11", "-DEXTERNAL_TEST"]),
        ("cc", &["-x", "c++", "-std=c++17", "-DEXTERNAL_TEST", "-DDELONE_TRIANGLE_INT"]),
        ("clang", &["-std=c89", "-DEXTERNAL_TEST"]),
    ] {
        let program = folder.join("program");
        let mut compile = Command::new(compiler);
        compile.args(language).args(warnings).arg("-I").arg(here.join("include"));
        compile.arg(here.join("tests/client.c")).args(["-x", "none"]).arg(&name).arg("-o").arg(&program);
        let Some(compiled) = run(&mut compile) else {
            println!("skipped: there is no {compiler}");
            continue;
        };
        let said = String::from_utf8_lossy(&compiled.stderr).into_owned();
        if compiler == "cc" && language.contains(&"c++") && said.contains("cc1plus") {
            println!("skipped: there is no C++");
            continue;
        }
        assert!(compiled.status.success(), "{language:?}: {said}");
        let ran = run(Command::new(&program).env("LD_LIBRARY_PATH", &folder)).expect("it runs");
        let said = String::from_utf8_lossy(&ran.stderr);
        assert!(ran.status.success(), "{language:?}: {:?} {said}", ran.status);
        assert!(said.contains("delone: triangulate: numberofpoints is 2"), "{said}");
    }
    std::fs::remove_dir_all(&folder).expect("the folder goes");
}
