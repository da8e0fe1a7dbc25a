//! Programs in C, compiled and run against the library; the header against the functions; forks, threads, memory that ends.
//!
//! Where there is no C compiler these tests say so and pass.

mod tools;

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::Command;

use tools::{has, here, libraries, run};

fn program(name: &str, options: &[&str]) -> Option<(tempfile::TempDir, PathBuf)> {
    tools::program("cc", &here(name), options)
}

#[test]
fn a_program_in_c_does_everything() {
    let strict = ["-std=c89", "-pedantic", "-Wall", "-Wextra", "-Werror"];
    let Some((_folder, program)) = program("tests/library.c", &strict) else { return };
    assert_eq!(run(&mut Command::new(program)), "all is well\n");
}

#[test]
fn the_example_runs() {
    let Some((_folder, program)) = program("examples/triangulate.c", &["-std=c99"]) else { return };
    assert_eq!(run(&mut Command::new(program)).lines().count(), 4);
}

#[test]
fn forks_threads_and_unloading() {
    let Some((_folder, program)) =
        program("tests/processes.c", &["-std=gnu11", "-Wall", "-Wextra", "-Werror"])
    else {
        return;
    };
    assert_eq!(run(&mut Command::new(&program)), "all is well\n");
}

#[test]
fn a_library_is_loaded_again_and_twice() {
    let Some((folder, program)) = program("tests/loading.c", &["-std=gnu11", "-Wall", "-Wextra", "-Werror"])
    else {
        return;
    };
    let library = libraries().join("libdelone_capi.so");
    let copy = folder.path().join("libother.so");
    std::fs::copy(&library, &copy).expect("a copy");
    assert_eq!(run(Command::new(&program).arg(library).arg(copy)), "all is well\n");
}

/// Where memory ends the library says so, and the program goes on.
#[test]
fn memory_that_cannot_be_had() {
    let Some((_folder, program)) = program("tests/memory.c", &["-std=gnu11", "-Wall", "-Wextra", "-Werror"])
    else {
        return;
    };
    assert_eq!(run(&mut Command::new(&program)), "all is well\n");
}

#[test]
fn the_header_is_for_all_compilers() {
    if !has("cc") {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("empty.c");
    std::fs::write(&file, "#include \"delone.h\"\nint nothing;\n").expect("written");
    for (compiler, standard) in [
        ("cc", "-std=c89"),
        ("cc", "-std=c99"),
        ("cc", "-std=c11"),
        ("c++", "-std=c++17"),
        ("c++", "-std=c++20"),
    ] {
        let language = if compiler == "cc" { "c" } else { "c++" };
        let mut command = Command::new(compiler);
        command.args([
            standard,
            "-pedantic",
            "-Wall",
            "-Wextra",
            "-Werror",
            "-fsyntax-only",
            "-x",
            language,
            "-I",
        ]);
        run(command.arg(here("include")).arg(&file));
    }
}

/// The library has its name for linkers, stays loaded, and shows what the header has, and nothing else.
#[test]
fn the_shared_library_is_as_distributions_want_it() {
    if !cfg!(target_os = "linux") || !has("nm") || !has("readelf") {
        return;
    }
    let library = libraries().join("libdelone_capi.so");
    let shown = run(Command::new("nm").args(["-D", "--defined-only", "--format=posix"]).arg(&library));
    let shown: BTreeSet<&str> = shown.lines().filter_map(|line| line.split(' ').next()).collect();
    let header = std::fs::read_to_string(here("include/delone.h")).expect("a header");
    let names: Vec<String> = of_header(&header).into_iter().map(|function| function.1).collect();
    assert_eq!(shown, names.iter().map(String::as_str).collect());
    let dynamic = run(Command::new("readelf").arg("-d").arg(&library));
    for expected in ["[libdelone.so.0]", "NODELETE"] {
        assert!(dynamic.contains(expected), "{expected}: {dynamic}");
    }
}

/// The words of a declaration: what it returns, its name, and the types of its parameters.
type Declaration = (String, String, Vec<String>);

/// Types in Rust by those in C.
fn rust_type(c: &str) -> String {
    let plain = c.replace("const ", "");
    let stars = plain.matches('*').count();
    let name = match plain.replace('*', "").trim() {
        "double" => "f64",
        "int32_t" => "i32",
        "int64_t" => "i64",
        "uint32_t" => "u32",
        "uint8_t" => "u8",
        "size_t" => "usize",
        "char" => "c_char",
        "void" => "()",
        "delone_points" => "CPoints",
        "delone_error" => "CError",
        "delone_counts" => "CCounts",
        "delone_mesh_options" => "COptions",
        "delone_tri2" => "Tri2",
        "delone_tri3" => "Tri3",
        "delone_cells" => "Cells",
        other => panic!("{other} is no type of the table"),
    }
    .to_owned();
    // The pointer that is nearest to the name is the outermost; only what is pointed to first is const.
    let is_const = c.contains("const ");
    (0..stars).fold(
        name,
        |of, level| if level == 0 && is_const { format!("*const {of}") } else { format!("*mut {of}") },
    )
}

fn of_header(text: &str) -> Vec<Declaration> {
    let mut code = String::new();
    let mut rest = text;
    while let Some((before, comment)) = rest.split_once("/*") {
        code.push_str(before);
        rest = comment.split_once("*/").expect("comments end").1;
    }
    code.push_str(rest);
    let code: Vec<&str> = code.lines().filter(|line| !line.starts_with('#')).collect();
    let statements = code.join(" ");
    let functions = statements
        .split(';')
        .filter(|one| one.contains("delone_") && one.ends_with(')') && !one.contains('{'));
    let parse = |one: &str| {
        let (head, parameters) = one.rsplit_once('(').expect("a function");
        let at = head.rfind("delone_").expect("a name");
        let one_type = |parameter: &str| {
            let name = parameter.rfind([' ', '*']).map_or(0, |at| at + 1);
            rust_type(parameter[..name].trim())
        };
        let parameters = parameters.trim_end_matches(')');
        let types = if parameters == "void" {
            vec![]
        } else {
            parameters.split(',').map(|p| one_type(p.trim())).collect()
        };
        (rust_type(head[..at].trim()), head[at..].to_owned(), types)
    };
    functions.map(|one| parse(one.trim())).collect()
}

fn of_sources() -> Vec<Declaration> {
    let mut all = Vec::new();
    for file in std::fs::read_dir(here("src")).expect("sources") {
        let text = std::fs::read_to_string(file.expect("a file").path()).expect("text");
        for function in text.split("#[unsafe(no_mangle)]").skip(1) {
            let head: String =
                function.split('{').next().expect("a head").split_whitespace().collect::<Vec<_>>().join(" ");
            let (_, declaration) = head.split_once("fn ").expect("a function");
            let (name, rest) = declaration.split_once('(').expect("parameters");
            let (parameters, result) = rest.rsplit_once(')').expect("parameters");
            let types =
                parameters.split(',').filter_map(|one| Some(one.split_once(':')?.1.trim().to_owned()));
            let result = result.trim().strip_prefix("-> ").unwrap_or("()").to_owned();
            all.push((result, name.to_owned(), types.collect()));
        }
    }
    all
}

/// Each function of the header is in the library, with the types that it has there, and none is missing in the header.
#[test]
fn the_header_is_the_library() {
    let header: BTreeSet<Declaration> =
        of_header(&std::fs::read_to_string(here("include/delone.h")).expect("a header"))
            .into_iter()
            .collect();
    let sources: BTreeSet<Declaration> = of_sources().into_iter().collect();
    assert!(header.len() > 30, "{} functions were found", header.len());
    let differ: Vec<_> = header.symmetric_difference(&sources).collect();
    assert!(differ.is_empty(), "{differ:#?}");
}
