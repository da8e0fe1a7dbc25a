//! Forty commands have the outputs that they had: each file byte by byte.
//!
//! `bytes/outputs.txt` has the commands, each with its files, their lengths and hashes. A change that is wanted is written there by
//! `BLESS=1 cargo test -p delone-cli --test all bytes`, and told in the changelog. Only Linux is held to it: some outputs have
//! directions of light, whose sines a system computes.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use crate::place::{Place, data, text};

/// The commands and their outputs, as they were.
const OUTPUTS: &str = include_str!("bytes/outputs.txt");

/// Files that commands read, by name.
const INPUTS: [(&str, &str); 5] = [
    ("area.geojson", include_str!("bytes/area.geojson")),
    ("ridge.geojson", include_str!("bytes/ridge.geojson")),
    ("lake.geojson", include_str!("bytes/lake.geojson")),
    ("plan.poly", include_str!("bytes/plan.poly")),
    ("places.csv", "x,y\n12.5,7.25\n30,20\n59.9,39.9\n-5,3\n"),
];

/// FNV-1a of 64 bits: <http://www.isthe.com/chongo/tech/comp/fnv/>.
fn hash(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// Points on a curve that fills 60 by 40, each with a height of few digits: no file of them needs a rounding.
fn heights() -> String {
    let row = |i: u32| {
        let (x, y) = (i * 7919 % 6000, i * 104_729 % 4000);
        format!("{}.{:02},{}.{:02},{}\n", x / 100, x % 100, y / 100, y % 100, (x / 7 + y / 3) % 97)
    };
    (0..800).map(row).fold("x,y,z\n".to_owned(), |text, row| text + &row)
}

/// All files of a folder and of those in it, with their lengths and hashes.
fn files(folder: &Path, inside: &str, found: &mut BTreeMap<String, (usize, u64)>) {
    for entry in std::fs::read_dir(folder).expect("readable") {
        let path = entry.expect("there").path();
        let name = format!("{inside}{}", path.file_name().expect("a name").display());
        if path.is_dir() {
            files(&path, &format!("{name}/"), found);
        } else {
            let bytes = std::fs::read(&path).expect("readable");
            found.insert(name, (bytes.len(), hash(&bytes)));
        }
    }
}

/// Runs the commands of a list; returns it with the outputs that they have now.
fn run(list: &str) -> String {
    let place = Place::new();
    INPUTS.iter().for_each(|(name, content)| drop(place.file(name, content)));
    place.file("heights.csv", heights());
    let data = data("");
    let seen = |place: &Place| {
        let mut found = BTreeMap::new();
        files(&place.path(""), "", &mut found);
        found
    };
    let (mut before, mut told) = (seen(&place), String::new());
    for line in list.lines().filter_map(|line| line.strip_prefix("$ ")) {
        let output = place.run(&line.replace("DATA/", &data.display().to_string()));
        assert!(output.status.success(), "{line}: {}", text(&output.stderr));
        writeln!(told, "$ {line}").expect("a string");
        if !output.stdout.is_empty() {
            writeln!(told, "- {} {:016x}", output.stdout.len(), hash(&output.stdout)).expect("a string");
        }
        let after = seen(&place);
        for (name, (length, hash)) in after.iter().filter(|(name, is)| before.get(*name) != Some(is)) {
            // A folder of tiles tells when its inputs changed.
            if !name.ends_with("tiles.json") {
                writeln!(told, "{name} {length} {hash:016x}").expect("a string");
            }
        }
        before = after;
    }
    told
}

#[test]
fn outputs_are_what_they_were() {
    let found = run(OUTPUTS);
    assert!(found.lines().filter(|line| line.starts_with("$ ")).count() >= 40, "{found}");
    if std::env::var_os("BLESS").is_some() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bytes/outputs.txt");
        return std::fs::write(path, found).expect("written");
    }
    let mut command = "";
    for (found, expected) in found.lines().zip(OUTPUTS.lines()) {
        command = if found.starts_with("$ ") { found } else { command };
        assert_eq!(found, expected, "after {command}");
    }
    assert_eq!(found.lines().count(), OUTPUTS.lines().count());
}
