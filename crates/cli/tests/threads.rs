//! Work is done on the threads that there are: no more than are of use, and where the system gives none, on the one there is.

use std::process::Command;

use serde_json::Value;

use crate::place::{Place, text};

fn threads(place: &Place, variable: &str, options: &str) -> (u64, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_delone"));
    command.current_dir(place.path("")).env("RAYON_NUM_THREADS", variable);
    let line = format!("{options} info p.csv --stats s.json");
    let output = command.args(line.split_whitespace()).output().expect("the program starts");
    assert!(output.status.success(), "{variable} {options}: {}", text(&output.stderr));
    let stats: Value = serde_json::from_str(&place.read("s.json")).expect("JSON");
    (stats["threads"].as_u64().expect("a number"), text(&output.stderr))
}

#[test]
fn the_variable_is_limited_as_the_option_is() {
    let place = Place::new();
    place.file("p.csv", "0,0\n1,0\n0,1\n");
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get) as u64;
    let most = (4 * cores).max(16);
    assert_eq!(threads(&place, "3", "").0, 3);
    assert_eq!(threads(&place, "3", "--threads 2").0, 2);
    let (found, told) = threads(&place, "4000", "");
    assert_eq!(found, most);
    assert!(told.contains(&format!("{most} threads are used, not 4000")), "{told}");
    // What is no number of threads says nothing.
    for variable in ["0", "many", "-1"] {
        assert_eq!(threads(&place, variable, "").0, cores, "{variable}");
    }
}

/// Shells have two names for this limit; without it nothing would be tested.
#[cfg(target_os = "linux")]
const ALONE: &str = "ulimit -u 1 2>/dev/null || ulimit -p 1; \
    while read -r line; do case $line in 'Max processes '*' 1 '*) one=1;; esac; done < /proc/self/limits; \
    test $one || exit 99";

#[cfg(target_os = "linux")]
#[test]
fn one_thread_is_enough() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 60000 -o p.npy");
    place.succeed("-q generate uniform -n 60000 -o p.csv");
    place.succeed("-q generate cube -n 9000 -o s.npy");
    place.succeed("-q triangulate p.npy -o expected.npy");
    let expected = place.succeed("-q triangulate p.npy --fingerprint");
    for line in [
        "info p.npy",
        "info p.npy --threads 1",
        "triangulate p.npy -o m.npy",
        "triangulate p.npy -o m.npy --threads 1",
        "triangulate p.csv -o m.vtu",
        "triangulate s.npy --dim 3 -o t.npy",
        "voronoi p.npy -o v.geojson",
        "tiles p.npy -o t --tile 9000 --workers 4",
        "check t",
        "window t -o w.png",
    ] {
        let output = place.run_as_other(ALONE, line);
        let told = text(&output.stderr);
        assert!(output.status.success() && !told.contains("panicked"), "{line}: {told}");
        if line.starts_with("check") {
            assert!(text(&output.stdout).contains(expected.trim()), "{line}");
        }
    }
    // Some threads, and not all that are asked for.
    for limit in 2..8 {
        let words = format!("ulimit -u {limit} 2>/dev/null || ulimit -p {limit}");
        for line in ["triangulate p.npy -o m.npy --threads 4", "tiles p.npy -o t --resume --threads 4"] {
            let output = place.run_as_other(&words, line);
            assert!(output.status.success(), "{limit}, {line}: {}", text(&output.stderr));
        }
    }
    let read = |name: &str| std::fs::read(place.path(name)).expect("written");
    assert!(read("m.npy") == read("expected.npy"));
}
