//! `experiment`: tables, plots, and what is left of a run that ends early.

use std::fs;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::place::Place;
use crate::set;

#[test]
fn experiments_leave_tables_and_plots() {
    let place = Place::new();
    let table = place.succeed("experiment order --largest 100 -o out --stats s.json");
    assert!(table.contains("the order of Figure 1") && table.contains("100       2499   1.000"), "{table}");
    assert!(place.path("s.json").exists());
    place.succeed("experiment history --largest 300 -o out");
    let table = place.succeed("experiment hierarchy --largest 5000 --trials 1 -o out");
    assert!(table.contains("parabola  5000") && table.contains("paper hier.+MSZ"), "{table}");
    for name in ["order-bad", "history-growth", "hierarchy-random"] {
        let svg = std::fs::read_to_string(place.path(&format!("out/{name}.svg"))).expect("a plot");
        assert!(svg.starts_with("<svg") && svg.matches("<polyline").count() > 1, "{name}");
    }
    let csv = std::fs::read_to_string(place.path("out/hierarchy-seconds.csv")).expect("a table");
    assert_eq!(csv.lines().count(), 6);
    place.fail("experiment nothing", 2, "nothing");
    place.fail("experiment history --trials 0", 2, "--trials");
    place.file("taken", "a file");
    place.fail("experiment hierarchy --largest 100 --stats no/s.json", 1, "cannot write");
    place.fail("experiment conflicts -o taken", 1, "cannot write into the folder");
    // Below the smallest set of each there is no empty table, and with it no bug.
    for (name, smallest) in
        [("history", 100), ("jump-and-walk", 1000), ("hierarchy", 5000), ("imprecise", 10_000)]
    {
        place.fail(
            &format!("experiment {name} --largest {}", smallest - 1),
            2,
            &format!("is below {smallest}"),
        );
    }
}

/// Who interrupts an experiment has the rows that were there, and no table that looks whole.
#[test]
fn an_interrupted_experiment_leaves_its_rows() {
    let place = Place::new();
    let mut program = Command::new(crate::PROGRAM)
        .current_dir(place.0.path())
        .args(["experiment", "hull", "--largest", "300000", "-o", "out"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let rows =
        || fs::read_to_string(place.path("out/hull.part.csv")).map_or(0, |text| text.matches('\n').count());
    let start = Instant::now();
    while rows() < 3 && start.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(20));
    }
    program.kill().expect("it still runs");
    program.wait().expect("it has ended");
    assert!(rows() >= 3, "{}", rows());
    assert!(!place.path("out/hull.csv").exists());
    // A whole run leaves tables alone.
    place.succeed("experiment hull --largest 100 -o out");
    assert!(place.path("out/hull.csv").exists() && !place.path("out/hull.part.csv").exists());
}

#[test]
fn an_experiment_takes_a_model() {
    let place = Place::new();
    set(&place, "cube", 200, "model.csv");
    let table = place.succeed("experiment scan model.csv --largest 200");
    assert!(table.contains("Noisy samples of a scanned model"), "{table}");
    place.fail("experiment scan", 2, "needs a file");
    place.fail("experiment imprecise model.csv", 2, "only scan");
    let last = u64::MAX;
    place.fail(&format!("experiment scopes --largest 100 --seed {last}"), 2, "seed");
    place.file("few.csv", "1,2,3\n");
    place.fail("experiment scan few.csv", 1, "too few");
    // Points are named as they are in the file, and the file is not blamed for sums that overflow.
    let model = |wide: &str| -> String {
        let row = |i: i32| {
            if i == 77 { format!("{wide} 1 2\n") } else { format!("{i} {} {}\n", i * i % 17, i % 5) }
        };
        (0..150).map(row).collect()
    };
    place.file("nan.xyz", model("nan"));
    place.fail("experiment scan nan.xyz", 1, "point 77 has the x coordinate NaN");
    place.file("wide.xyz", model("1e300"));
    place.fail("experiment scan wide.xyz", 1, "the model is too large");
}
