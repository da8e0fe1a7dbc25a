//! Claims and measurements of the papers, asserted on the tables that experiments make of small sets: a file a paper.
//!
//! Where a paper gives a number, it is the bound; where it gives only an order of growth, a constant with a margin stands here,
//! and is asserted at each size of the table.

mod cells;
mod csv;
mod hierarchy;
mod hints;
mod jump_and_walk;
mod random_orders;
mod scopes;

use std::sync::{Arc, Mutex};

use delone_experiments::{Experiment, Options, Watch};

/// All that was told, by the names of tables.
#[derive(Debug, Default)]
struct Told(Mutex<Vec<(String, String)>>);

impl Watch for Told {
    fn line(&self, table: &str, line: &str) {
        self.0.lock().expect("nobody panics").push((table.to_owned(), line.to_owned()));
    }
}

/// Whoever watches has every row, whether the experiment comes to its end or not.
#[test]
fn rows_are_told_as_they_come() {
    let threads = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    for (name, largest) in
        [("scopes", 100), ("order", 100), ("hierarchy", 5000), ("tuning", 1000), ("disks", 1000)]
    {
        let told = Arc::new(Told::default());
        let watch = Some(told.clone() as Arc<dyn Watch>);
        let options = Options { largest, trials: 1, seed: 1, model: &[], threads: &threads, watch };
        let findings = Experiment::named(name).expect("an experiment").run(&options).expect("findings");
        let told = told.0.lock().expect("nobody panics");
        for table in &findings.tables {
            let lines: String =
                told.iter().filter(|(of, _)| *of == table.name).map(|(_, line)| line.as_str()).collect();
            assert_eq!(lines, table.csv(), "{name}");
        }
    }
}

/// No experiment has an empty table at its smallest size, and none runs below.
#[test]
fn small_sizes_are_refused() {
    let threads = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    for experiment in delone_experiments::EXPERIMENTS {
        let largest = experiment.smallest - 1;
        let options = Options { largest, trials: 1, seed: 1, model: &[], threads: &threads, watch: None };
        assert!(experiment.run(&options).is_err(), "{}", experiment.name);
    }
}
