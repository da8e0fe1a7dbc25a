//! What the papers prove and measure, asserted on the tables of the experiments.

use std::sync::{Arc, Mutex};

use delone_experiments::{Experiment, Findings, Options, Watch};

/// A table by its heads and cells.
struct Cells(Vec<Vec<String>>);

impl Cells {
    fn of(findings: &Findings, name: &str) -> Self {
        let table = findings.tables.iter().find(|table| table.name == name).expect("a table");
        // No cell that is read here holds a comma.
        Self(table.csv().lines().map(|line| line.split(',').map(str::to_owned).collect()).collect())
    }

    /// The mean in a cell of each row, without its deviation.
    fn column(&self, head: &str) -> Vec<f64> {
        let k = self.0[0].iter().position(|cell| cell == head).unwrap_or_else(|| panic!("{head}"));
        let mean = |cell: &String| cell.split(' ').next().and_then(|mean| mean.parse().ok());
        self.0[1..].iter().map(|row| mean(&row[k]).unwrap_or(f64::NAN)).collect()
    }
}

fn run(name: &str, largest: usize) -> Findings {
    let threads = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let options = Options { largest, trials: 2, seed: 1, model: &[], threads: &threads, watch: None };
    Experiment::named(name).expect("an experiment").run(&options).expect("findings")
}

#[track_caller]
fn near(values: &[f64], expected: &[f64], tolerance: f64) {
    for (value, expected) in values.iter().zip(expected) {
        assert!(
            (value - expected).abs() <= tolerance * expected.abs(),
            "{values:?}: {value} is not {expected}"
        );
    }
}

/// Guibas, Knuth & Sharir 1992: Lemmas 2.1, 2.2, 2.4, 2.5, 4.4, the pair of §4.2, the point of §4.3 that undoes much.
#[test]
fn scopes_decide_what_appears() {
    let findings = run("scopes", 100);
    let table = Cells::of(&findings, "scopes-triangles");
    near(&table.column("appeared")[..12], &table.column("6/((k+1)(k+2)(k+3))")[..12], 0.08);
    let table = Cells::of(&findings, "scopes-means");
    near(&table.column("simulated"), &table.column("computed"), 0.01);
    let table = Cells::of(&findings, "scopes-tetrahedra");
    near(&table.column("appeared")[..6], &table.column("24/((k+1)(k+2)(k+3)(k+4))")[..6], 0.08);
    let table = Cells::of(&findings, "scopes-edges");
    let [appeared, paths] = ["appeared", "by zig-zag paths"].map(|head| table.column(head));
    near(&appeared[..8], &paths[..8], 0.08);
    let bounds = ["at least a(2w)", "at most 2 a(w) - a(2w)"].map(|head| table.column(head));
    for ((path, least), most) in paths.iter().zip(&bounds[0]).zip(&bounds[1]).take(paths.len() - 1) {
        assert!((least..=most).contains(&path), "{least} {path} {most}");
    }
    for (name, head, bound) in [
        ("scopes-lemma-2-2", "in units of n (k+1)^2", 3.6),
        ("scopes-lemma-2-5", "in units of n (k+1)", 16.0),
    ] {
        assert!(Cells::of(&findings, name).column(head).iter().all(|units| *units < bound), "{name}");
    }
    assert!(Cells::of(&findings, "scopes-pair").column("uniform: share").iter().all(|share| *share >= 0.2));
    assert!(Cells::of(&findings, "scopes-triple").column("share").iter().all(|share| *share >= 0.2));
    // With zeta the end is linear, and what appears is not.
    let table = Cells::of(&findings, "scopes-samples");
    let [end, appeared] = ["in the end", "appeared"].map(|head| table.column(head));
    assert!(end[11] < 2.0 * 401.0 && appeared[11] > 5.0 * end[11], "{end:?} {appeared:?}");
    assert!(
        Cells::of(&findings, "scopes-samples").column("appeared / sum").iter().all(|ratio| *ratio < 24.0)
    );
}

/// Lecture notes: (1) and (4) are equal to the last, (2) is a bound, (3) an expectation, (5) below six; the sum below its bound.
#[test]
fn conflicts_obey_their_equations() {
    let findings = run("conflicts", 100);
    let table = Cells::of(&findings, "conflicts");
    assert_eq!(table.column("(1) sizes"), table.column("(1) by points"));
    assert_eq!(table.column("(4) destroyed"), table.column("(4) created - 2"));
    near(&table.column("(3) of the next"), &table.column("(3) of the mean"), 0.1);
    for (new, bound) in table.column("(2) new").iter().zip(table.column("(2) 3/r of all")) {
        assert!(*new <= 1.05 * bound, "{new} {bound}");
    }
    let created = table.0[1..].iter().map(|row| row.last().and_then(|cell| cell.parse::<f64>().ok()));
    assert!(created.into_iter().flatten().filter(|created| *created < 6.0).count() == table.0.len() - 1);
    let table = Cells::of(&findings, "conflicts-total");
    assert!(table.column("measured")[0] < table.column("bound 12 sum (n-r)/r")[0]);
}

/// Guibas, Knuth & Sharir 1992, §2.1, §2.3, §3: a bad order is quadratic, random ones are linear; adding n to m; sorting.
#[test]
fn order_decides_the_work() {
    let findings = run("order", 300);
    let table = Cells::of(&findings, "order-bad");
    near(&table.column("in m^2"), &[1.0; 2], 0.01);
    assert!(table.column("a point").iter().all(|triangles| *triangles < 22.0));
    let ratios = Cells::of(&findings, "order-adding").column("two rows / (m H(n) + n)");
    assert!(ratios.iter().all(|ratio| *ratio < 5.0), "{ratios:?}");
    assert!(Cells::of(&findings, "order-variance").column("most / mean").iter().all(|ratio| *ratio < 1.5));
    let ratios = Cells::of(&findings, "order-sorting").0;
    let tests: Vec<f64> =
        ratios[1..].iter().filter_map(|row| row[2].split(' ').next()?.parse().ok()).collect();
    assert!(!tests.is_empty() && tests.iter().all(|ratio| (0.8..1.6).contains(ratio)), "{tests:?}");
}

/// Guibas, Knuth & Sharir 1992, §4.2: Lemma 4.3, and Lee's count of the regions.
#[test]
fn orders_are_as_large_as_proved() {
    let table = Cells::of(&run("order-k", 1000), "order-k");
    assert_eq!(table.column("regions / n"), table.column("2k - 1 - (k^2 - 1 + k-sets below) / n"));
    // Both are in the edges of symmetric scope at most k, of which Lemma 2.5 has 16 n (k + 1).
    let pairs = table.column("pairs / (n k)");
    assert!(pairs.len() == 36 && pairs.iter().all(|pairs| *pairs < 8.0), "{pairs:?}");
}

/// Devillers 2011: Lemma 1 and the claims of Theorem 3 (§4), overlaps (§6.1), disks that differ and mislead (§6.2).
#[test]
fn hints_cost_what_is_proved() {
    let findings = run("disks", 1000);
    let table = Cells::of(&findings, "disks-claims");
    for (head, bound) in [("most in W(q)", 22.0), ("degree of a hint", 36.0), ("sum of degrees", 132.0)] {
        assert!(table.column(head).iter().all(|value| *value > 0.0 && *value <= bound), "{head}");
    }
    // The heads of these have a comma.
    let overlap = &findings.tables.iter().find(|table| table.name == "disks-overlap").expect("a table").csv();
    assert_eq!(overlap.lines().count(), 7);
    let visited = Cells::of(&findings, "disks-radii").column("visited");
    assert!(visited.iter().all(|visited| *visited < 5.0), "{visited:?}");
    // What all instances have, what a hundred have, what one of them has, what any can have.
    let edges = Cells::of(&findings, "disks-edges");
    let heads = ["certain", "in all of 100", "in any of 100", "possible"].map(|head| edges.column(head));
    assert_eq!(heads[0].len(), 6);
    assert!(
        heads.windows(2).all(|two| two[0].iter().zip(&two[1]).all(|(less, more)| less <= more)),
        "{heads:?}"
    );
    let misled = Cells::of(&findings, "disks-misled").column("visited");
    assert!(misled[3] > 3.0 * misled[0], "{misled:?}");
}

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
