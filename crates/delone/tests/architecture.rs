//! The house rules that no compiler checks: arrows point down, no circles, surgery in one room, files stay short, rooms have
//! real names.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The rooms of the library, bottom to top, in floors. A room may use those on lower floors, and its own inside; rooms on
/// the same floor do not know each other.
const FLOORS: &[&[&str]] = &[
    &["ids", "prefetch", "memory", "sorting", "sets", "powers", "closest", "tally", "verdict"],
    &["error", "parallel", "vertex_map", "weight", "duplicates", "hidden", "regular"],
    &["points", "decimal"],
    &["order"],
    &["mesh"],
    &["locate", "neighbors"],
    &["triangulation", "graphs"],
    &["alpha", "around", "joining"],
    &["hull"],
    &["plane", "space"],
    &["tiles", "surface", "periodic"],
];

/// Rooms that decide by the predicates; `around` keeps what they saw, for who decides.
const DECIDE: [&str; 10] =
    ["neighbors", "graphs", "hull", "alpha", "around", "plane", "space", "tiles", "surface", "periodic"];

/// The files that write the records of triangles: surgery, and the bulk construction in its own arrays.
const SURGEONS: [&str; 3] = ["mesh/triangles", "plane/construct/builder.rs", "plane/construct/number.rs"];

/// The file that writes the records of tetrahedra.
const SURGEON_IN_SPACE: &str = "mesh/tetrahedra/surgery.rs";

/// Names that say nothing about what is inside.
const EMPTY_NAMES: [&str; 7] = ["util", "utils", "common", "helpers", "core", "misc", "shared"];

/// The longest file that one sitting allows, tests apart, and what half of all files stay below.
const LONGEST: usize = 500;
const MEDIAN: usize = 150;

fn floor(room: &str) -> Option<usize> {
    FLOORS.iter().position(|rooms| rooms.contains(&room))
}

/// All Rust files below a folder.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// The code of a file without its tests, and without comments.
fn code_of(path: &Path) -> String {
    let text = fs::read_to_string(path).expect("readable");
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let is_code = |line: &&str| !line.trim_start().starts_with("//");
    code.lines().filter(is_code).map(|line| format!("{line}\n")).collect()
}

/// The rooms that code names: after every `crate::`, with braces at the first level taken apart.
fn rooms_used(code: &str) -> Vec<String> {
    let name = |text: &str| -> String {
        text.trim_start()
            .chars()
            .take_while(|c| c.is_ascii_lowercase() || *c == '_' || c.is_ascii_digit())
            .collect()
    };
    let mut rooms = Vec::new();
    for (at, _) in code.match_indices("crate::") {
        let before = code[..at].chars().next_back();
        if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '$') {
            continue;
        }
        let rest = &code[at + "crate::".len()..];
        match rest.strip_prefix('{') {
            None => rooms.push(name(rest)),
            Some(list) => {
                let mut depth = 0;
                let mut start = 0;
                for (i, c) in list.char_indices() {
                    match c {
                        '{' => depth += 1,
                        '}' if depth > 0 => depth -= 1,
                        ',' | '}' if depth == 0 => {
                            rooms.push(name(&list[start..i]));
                            start = i + 1;
                            if c == '}' {
                                break;
                            }
                        }
                        _ => {}
                    }
                }
            }
        }
    }
    // Names in capitals are re-exports at the root, which has no room.
    rooms.retain(|room| !room.is_empty());
    rooms
}

/// The room that a file is in.
fn room_of(inside: &Path) -> String {
    let first = inside.components().next().expect("a name").as_os_str().to_string_lossy().into_owned();
    first.trim_end_matches(".rs").to_owned()
}

fn sources(package: &str) -> (PathBuf, Vec<PathBuf>) {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(package).join("src");
    let mut found = Vec::new();
    files(&source, &mut found);
    (source, found)
}

#[test]
fn arrows_point_down() {
    let (source, found) = sources("delone");
    let mut arrows = 0;
    for path in &found {
        let inside = path.strip_prefix(&source).expect("below src");
        let room = room_of(inside);
        if room == "lib" || inside.ends_with("tests.rs") {
            continue;
        }
        let own = floor(&room).unwrap_or_else(|| panic!("{room} has no floor: decide where it lives"));
        let code = code_of(path);
        for used in rooms_used(&code) {
            // Constants and types of the root are those of some room below.
            let Some(below) = floor(&used) else { panic!("{}: crate::{used}", inside.display()) };
            assert!(below < own || used == room, "{}: {room} must not use {used}", inside.display());
            arrows += usize::from(used != room);
        }
        assert!(!code.contains("delone_oracle"), "{}: the judge is for tests only", inside.display());
        assert!(
            !code.contains("delone_predicates") || DECIDE.contains(&&*room),
            "{}: only {DECIDE:?} decide",
            inside.display()
        );
    }
    assert!(arrows > 100, "only {arrows} arrows were seen: is the reader of paths broken?");
}

/// At the top of every crate: who uses whom never leads back.
#[test]
fn rooms_stand_in_no_circle() {
    for package in
        ["delone", "predicates", "io", "store", "terrain", "cli", "lab", "oracle", "generators", "fuzz"]
    {
        let (source, found) = sources(package);
        let mut uses: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for path in &found {
            let room = room_of(path.strip_prefix(&source).expect("below src"));
            if room != "lib" && room != "main" && !path.ends_with("tests.rs") {
                let used = rooms_used(&code_of(path)).into_iter().filter(|used| *used != room);
                uses.entry(room.clone()).or_default().extend(used);
            }
        }
        // What uses nothing that is left goes first; what stays is a circle.
        while let Some(done) = uses.iter().find(|(_, used)| used.iter().all(|u| !uses.contains_key(u))) {
            let done = done.0.clone();
            uses.remove(&done);
        }
        assert!(uses.is_empty(), "{package}: a circle among {uses:?}");
    }
}

/// Whether a line writes what has a name, or an element of it.
fn is_written(line: &str, name: &str) -> bool {
    line.match_indices(name).any(|(at, _)| {
        // Behind its indices.
        let mut depth = i32::from(name.ends_with('['));
        let behind = line[at + name.len()..].find(|c| {
            depth += i32::from(c == '[') - i32::from(c == ']');
            depth == 0 && c != ']'
        });
        behind.is_some_and(|k| line[at + name.len() + k..].starts_with(" = "))
    })
}

/// Whether a line writes the record of a tetrahedron, or borrows it to be written.
fn writes_tetrahedron(line: &str) -> bool {
    let borrowed = line.split_once("&mut ").map_or("", |(_, rest)| rest);
    ["cells[", ".corners", ".across"].iter().any(|name| is_written(line, name) || borrowed.contains(name))
        || ["cells.iter_mut(", "cells.swap"].iter().any(|call| line.contains(call))
}

/// The corners and twins of triangles are written in one room; only the construction in bulk has arrays of its own. Those of
/// tetrahedra are written in one file.
#[test]
fn surgery_has_one_room() {
    let (source, found) = sources("delone");
    let (mut seen, mut operations) = (0, 0);
    for path in &found {
        let inside = path.strip_prefix(&source).expect("below src").to_string_lossy().replace('\\', "/");
        if inside.ends_with("tests.rs") {
            continue;
        }
        let code = code_of(path);
        let writes = |name: &&str| code.lines().any(|line| is_written(line, name));
        let is_surgeon = [".origin", ".twin", ".edges["].iter().any(writes);
        let may = SURGEONS.iter().any(|place| inside.starts_with(place));
        assert!(!is_surgeon || may, "{inside} writes the records of triangles: that is surgery");
        seen += usize::from(is_surgeon);
        // Facets of hulls have links of their own.
        let knows = inside.starts_with("space/") || code.contains("Mesh3") || code.contains("Tetrahedron");
        let in_space = knows && !inside.starts_with("hull/");
        for line in code.lines().filter(|line| in_space && writes_tetrahedron(line)) {
            assert!(inside == SURGEON_IN_SPACE, "{inside} writes records of tetrahedra: {}", line.trim());
            operations += 1;
        }
    }
    assert!(seen >= 3, "only {seen} surgeons were seen");
    assert!(operations >= 8, "only {operations} operations on tetrahedra were seen");
}

#[test]
fn the_reader_of_writes_reads() {
    for line in [
        "self.cells[t.index()] = cell;",
        "cells[t.index()].across[k] = g;",
        "memory.cells[[1, 2][k]].corners = [a, b, c, d];",
        "let across = &mut mesh.cells[t.index()].across;",
        "mesh.cells.iter_mut().for_each(|cell| cell.corners = corners);",
    ] {
        assert!(writes_tetrahedron(line), "{line}");
    }
    for line in [
        "let across = cells[t.index()].across;",
        "if cells[i].corners == other { cells = Vec::new(); }",
        "let k = mesh.cells[t.index()].across[k];",
        "mesh.cells = Vec::new();",
    ] {
        assert!(!writes_tetrahedron(line), "{line}");
    }
}

#[test]
fn the_reader_of_paths_reads() {
    let text = "use crate::ids::{A, B};\n    use crate::{mesh, order::{x, y}, Z};\npub(crate) use crate::error::Error;
        let a = crate::points::survey(p); delone_crate::no(); $crate::no();";
    assert_eq!(rooms_used(text), ["ids", "mesh", "order", "error", "points"]);
}

#[test]
fn files_are_short_and_rooms_have_names() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut found = Vec::new();
    files(&crates, &mut found);
    let mut lengths = Vec::new();
    for path in found {
        let text = fs::read_to_string(&path).expect("readable");
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let length = code.lines().count();
        assert!(length <= LONGEST, "{} has {length} lines: is it one idea?", path.display());
        lengths.push(length);
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let folder = path.parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
        for name in [stem, folder] {
            assert!(!EMPTY_NAMES.contains(&&*name), "{}: {name} says nothing", path.display());
        }
    }
    lengths.sort_unstable();
    assert!(lengths.len() > 150);
    let median = lengths[lengths.len() / 2];
    assert!(median < MEDIAN, "half of all files have {median} lines and more");
}

/// A file of tests that no program has would never run.
#[test]
fn every_file_of_tests_is_in_a_program() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut programs = 0;
    for package in fs::read_dir(crates).expect("readable") {
        let package = package.expect("readable").path();
        let Ok(main) = fs::read_to_string(package.join("tests/main.rs")) else { continue };
        programs += 1;
        let manifest = fs::read_to_string(package.join("Cargo.toml")).expect("readable");
        assert!(manifest.contains("autotests = false"), "{}", package.display());
        for entry in fs::read_dir(package.join("tests")).expect("readable") {
            let path = entry.expect("readable").path();
            let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let is_code = path.is_dir() || path.extension().is_some_and(|extension| extension == "rs");
            let is_there = main.lines().any(|line| line == format!("mod {stem};"))
                || manifest.lines().any(|line| line == format!("name = \"{stem}\""));
            assert!(!is_code || stem == "main" || is_there, "{} is in no program", path.display());
        }
    }
    assert!(programs >= 4);
}

/// A fork changes one address, and a test finds the copies of it.
#[test]
fn packages_name_one_repository() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let text = |name: &str| fs::read_to_string(root.join(name)).expect(name);
    let manifest = text("Cargo.toml");
    let line = manifest.lines().find_map(|line| line.strip_prefix("repository = \"")).expect("an address");
    let address = line.trim_end_matches('"');
    for name in ["bindings/python/pyproject.toml", "bindings/wasm/package.json", "CITATION.cff"] {
        assert!(text(name).contains(address), "{name} does not name {address}");
    }
    let mut published = 0;
    for entry in fs::read_dir(root.join("crates")).expect("readable") {
        let folder = entry.expect("readable").path();
        let manifest = fs::read_to_string(folder.join("Cargo.toml")).expect("a manifest");
        if manifest.contains("publish = false") {
            continue;
        }
        published += 1;
        let name = folder.display();
        assert!(manifest.contains("repository.workspace = true"), "{name} names no repository");
        assert!(manifest.contains("description = "), "{name} has no description");
        let has_readme = manifest.contains("readme = ") || folder.join("README.md").exists();
        assert!(has_readme, "{name} has no README");
        for licence in ["LICENSE-MIT", "LICENSE-APACHE"] {
            assert!(folder.join(licence).exists(), "{name} has no {licence}");
        }
    }
    assert!(published >= 8, "only {published} crates are published");
}

/// Functions of the mathematical library of a system, which differ in the last bit from machine to machine. `libm` has its own everywhere, and
/// `hypotenuse` is the nearest number.
const OF_SYSTEMS: [&str; 17] = [
    "hypot", "sin", "cos", "tan", "sin_cos", "asin", "acos", "atan", "atan2", "exp", "exp2", "ln", "log10",
    "log2", "powf", "cbrt", "tanh",
];

#[test]
fn results_are_of_functions_that_are_alike_on_all_machines() {
    let mut found = Vec::new();
    for package in ["predicates", "delone", "io", "terrain", "store", "cli", "generators"] {
        let (root, sources) = sources(package);
        for path in sources {
            let code = code_of(&path);
            let is_test = path.ends_with("tests.rs") || path.ends_with("decided.rs");
            for name in OF_SYSTEMS.iter().filter(|_| !is_test) {
                let count = code.matches(&format!(".{name}(")).count()
                    + code.matches(&format!("f64::{name}")).count();
                found.extend(
                    (0..count)
                        .map(|_| format!("{}: {name}", path.strip_prefix(&root).unwrap_or(&path).display())),
                );
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}
