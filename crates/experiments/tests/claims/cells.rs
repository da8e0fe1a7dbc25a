//! The tables of an experiment's smallest sizes, by the names of their columns.

use delone_experiments::{Experiment, Findings, Options};

use crate::csv::fields;

/// A table by its heads and cells.
pub(super) struct Cells {
    heads: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Cells {
    pub(super) fn of(findings: &Findings, name: &str) -> Self {
        let table = findings.tables.iter().find(|table| table.name == name);
        let csv = table.unwrap_or_else(|| panic!("there is no table {name}")).csv();
        let mut rows: Vec<Vec<String>> = csv.lines().map(fields).collect();
        let heads = rows.remove(0);
        assert!(!rows.is_empty(), "{name}");
        Self { heads, rows }
    }

    /// The rows that begin with these cells.
    #[track_caller]
    pub(super) fn rows(&self, keys: &[&str]) -> Self {
        let rows: Vec<_> =
            self.rows.iter().filter(|row| row.iter().zip(keys).all(|(a, b)| a == b)).cloned().collect();
        assert!(!rows.is_empty(), "{keys:?}");
        Self { heads: self.heads.clone(), rows }
    }

    pub(super) fn len(&self) -> usize {
        self.rows.len()
    }

    #[track_caller]
    fn position(&self, head: &str) -> usize {
        self.heads.iter().position(|cell| cell == head).unwrap_or_else(|| panic!("there is no column {head}"))
    }

    /// The text of each row.
    #[track_caller]
    pub(super) fn texts(&self, head: &str) -> Vec<&str> {
        let k = self.position(head);
        self.rows.iter().map(|row| row[k].as_str()).collect()
    }

    /// The mean in a cell of each row, without its error; every cell has a number.
    #[track_caller]
    pub(super) fn column(&self, head: &str) -> Vec<f64> {
        let texts = self.texts(head);
        let mean = |text: &&str| text.split(' ').next().and_then(|mean| mean.parse().ok());
        texts.iter().map(|text| mean(text).unwrap_or_else(|| panic!("{head}: {text} is no number"))).collect()
    }

    /// All values of a column are in a range, both ends included.
    #[track_caller]
    pub(super) fn within(&self, head: &str, least: f64, most: f64) {
        let values = self.column(head);
        assert!(
            values.iter().all(|value| (least..=most).contains(value)),
            "{head}: {values:?}: {least} to {most}"
        );
    }

    /// All values of a column are positive, and at most those of another.
    #[track_caller]
    pub(super) fn below(&self, head: &str, bound: &str) {
        let (values, bounds) = (self.column(head), self.column(bound));
        let holds = |(value, bound): (&f64, &f64)| *value > 0.0 && value <= bound;
        assert!(values.iter().zip(&bounds).all(holds), "{head}: {values:?}, {bound}: {bounds:?}");
    }
}

/// An experiment up to a size, twice from other points.
pub(super) fn run(name: &str, largest: usize) -> Findings {
    run_on(name, largest, 2, &[])
}

/// Runs an experiment `trials` times, on the points of a model where it takes one.
pub(super) fn run_on(name: &str, largest: usize, trials: usize, model: &[[f64; 3]]) -> Findings {
    let threads = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let options = Options { largest, trials, seed: 1, model, threads: &threads, watch: None };
    Experiment::named(name).expect("an experiment").run(&options).expect("findings")
}

/// Values are equal up to a share of themselves.
#[track_caller]
pub(super) fn near(values: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(values.len(), expected.len());
    for (value, expected) in values.iter().zip(expected) {
        assert!(
            (value - expected).abs() <= tolerance * expected.abs(),
            "{values:?}: {value} is not {expected}"
        );
    }
}
