//! The house rules that no compiler checks: arrows point down, files stay short, rooms have real names.

use std::fs;
use std::path::{Path, PathBuf};

/// The rooms, bottom to top, in floors. A room may use those on lower floors, and its own inside; rooms on the
/// same floor do not know each other.
const FLOORS: &[&[&str]] = &[
    &["ids", "fetch", "memory"],
    &["error", "parallel"],
    &["order"],
    &["mesh"],
    &["locate"],
    &["hull"],
    &["plane", "space"],
    &["moving"],
];

/// Names that say nothing about what is inside.
const EMPTY_NAMES: [&str; 7] = ["util", "utils", "common", "helpers", "core", "misc", "shared"];

/// The longest file that one sitting allows, tests apart.
const LONGEST: usize = 800;

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

/// The rooms named by the `use crate::` lines of a file, braces at the first level taken apart.
fn rooms_used(text: &str) -> Vec<String> {
    let mut rooms = Vec::new();
    for line in
        text.lines().filter_map(|line| line.trim_start().split_once("use crate::").map(|parts| parts.1))
    {
        let names = line.trim_start_matches('{').split(',');
        let whole = if line.starts_with('{') { usize::MAX } else { 1 };
        for name in names.take(whole) {
            let room: String =
                name.trim().chars().take_while(|c| c.is_ascii_lowercase() || *c == '_').collect();
            rooms.push(room);
        }
    }
    rooms
}

#[test]
fn arrows_point_down() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    files(&source, &mut found);
    let mut arrows = 0;
    for path in &found {
        let inside = path.strip_prefix(&source).expect("below src");
        let first = inside.components().next().expect("a name").as_os_str().to_string_lossy();
        let room = first.trim_end_matches(".rs");
        let is_test = inside.ends_with("tests.rs");
        if room == "lib" || is_test {
            continue;
        }
        let own = floor(room).unwrap_or_else(|| panic!("{room} has no floor: decide where it lives"));
        let text = fs::read_to_string(path).expect("readable");
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        for used in rooms_used(code) {
            let below = floor(&used).unwrap_or_else(|| panic!("{}: use crate::{used}", inside.display()));
            assert!(below < own || used == room, "{}: {room} must not use {used}", inside.display());
            arrows += usize::from(used != room);
        }
        for stranger in ["delone_oracle", "delone_generators"] {
            assert!(!code.contains(stranger), "{}: {stranger} is for tests only", inside.display());
        }
        let decides = code.contains("delone_predicates");
        assert!(
            !decides || ["hull", "plane", "space"].contains(&room),
            "{}: only hull, plane and space decide",
            inside.display()
        );
    }
    assert!(arrows > 20, "only {arrows} arrows were seen: is the reader of `use` lines broken?");
}

#[test]
fn the_reader_of_use_lines_reads() {
    let text =
        "use crate::ids::{A, B};\n    use crate::{mesh, order::x};\npub(crate) use crate::error::Error;";
    assert_eq!(rooms_used(text), ["ids", "mesh", "order", "error"]);
}

#[test]
fn files_are_short_and_rooms_have_names() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut found = Vec::new();
    files(&crates, &mut found);
    assert!(found.len() > 40);
    for path in found {
        let text = fs::read_to_string(&path).expect("readable");
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let length = code.lines().count();
        assert!(length <= LONGEST, "{} has {length} lines: is it one idea?", path.display());
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let folder = path.parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
        for name in [stem, folder] {
            assert!(!EMPTY_NAMES.contains(&&*name), "{}: {name} says nothing", path.display());
        }
    }
}
