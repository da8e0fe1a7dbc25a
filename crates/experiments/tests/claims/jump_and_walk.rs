//! Devroye, Mücke & Zhu 1998: the theorem and its remarks.

use std::sync::LazyLock;

use delone_experiments::Findings;

use super::cells::{Cells, near, run_on};

/// Twenty thousand queries are enough once.
static WALKS: LazyLock<Findings> = LazyLock::new(|| run_on("jump-and-walk", 3000, 1, &[]));

fn table(name: &str) -> Cells {
    Cells::of(&WALKS, name)
}

/// An exponent in the last row of a table.
#[track_caller]
fn exponent(name: &str, head: &str, expected: f64, tolerance: f64) {
    let fitted = table(name).rows(&["exponent"]).column(head)[0];
    assert!((fitted - expected).abs() <= tolerance, "{name}: {head}: {fitted}");
}

/// The lemma: a segment crosses c4 L sqrt(n) edges, and c4 is 64 / (3 pi^2) for random points.
#[test]
fn segments_cross_as_many_edges_as_long_as_they_are() {
    let crossed = table("jump-and-walk-segments");
    for n in ["1000", "3000"] {
        let of_size = crossed.rows(&[n]);
        assert_eq!(of_size.column("L"), [0.05, 0.1, 0.2]);
        near(&of_size.column("/ (L sqrt n)"), &[2.16; 3], 0.1);
    }
}

/// Remark 6: fewer than the paper's, and what segments cross by theory with the turn at the start.
#[test]
fn walks_from_32_samples_are_shorter_than_the_papers() {
    let visited = table("jump-and-walk-visited");
    let turn: Vec<f64> = visited.column("expected crossings").iter().map(|crossed| crossed + 2.0).collect();
    near(&visited.column("visited"), &turn, 0.1);
    for (head, most) in [("visited", [36.0, 50.0]), ("visited, at the border", [36.0, 55.0])] {
        let visited = visited.column(head);
        assert!(visited.iter().zip(most).all(|(visited, most)| *visited < most), "{head}: {visited:?}");
    }
}

/// The theorem, and remark 2: a query costs O(n^(1/3)), at the border too, by another constant.
#[test]
fn a_query_costs_the_cube_root() {
    let growth = table("jump-and-walk-growth");
    for n in ["1000", "3000"] {
        let row = growth.rows(&[n]);
        row.within("in n^(1/3)", 2.0, 2.5);
        let [inside, border] = ["visited", "visited, at the border"].map(|head| row.column(head)[0]);
        assert!(border > 1.2 * inside && border < 1.7 * inside, "{n}: {inside} {border}");
    }
    exponent("jump-and-walk-growth", "visited + m", 1.0 / 3.0, 0.03);
    exponent("jump-and-walk-growth", "visited, at the border", 1.0 / 3.0, 0.1);
    // The least cost is near a sample of n^(1/3), here 10, and much larger far from it.
    let samples = table("jump-and-walk-sample").rows(&["1000"]);
    let cost = samples.column("visited + m");
    let m = samples.column("m");
    let least = (0..m.len()).min_by(|&i, &j| cost[i].total_cmp(&cost[j])).expect("some");
    assert!((4.0..=16.0).contains(&m[least]), "{m:?} {cost:?}");
    assert!(cost[0] > 1.4 * cost[least] && cost[cost.len() - 1] > 3.0 * cost[least], "{cost:?}");
}

/// Remark 1: other densities.
#[test]
fn other_densities_change_the_constant() {
    let densities = table("jump-and-walk-densities");
    for n in ["1000", "3000"] {
        for head in ["uniform", "clusters", "log-normal", "circle"] {
            densities.rows(&[n]).within(head, 1.3, 3.0);
        }
        // On an ellipse walks cross long triangles: no density, and no theorem.
        densities.rows(&[n]).within("ellipse2", 4.0, 12.0);
    }
    for head in ["uniform", "clusters", "log-normal"] {
        exponent("jump-and-walk-densities", head, 1.0 / 3.0, 0.07);
    }
}

/// Remarks 3 and 4: changes, and constructions by them.
#[test]
fn changes_cost_a_query() {
    let changes = table("jump-and-walk-changes");
    for n in ["1000", "3000"] {
        changes.rows(&[n]).within("in n^(4/3)", 1.3, 2.2);
        changes.rows(&[n]).within("in n^(1/3)", 1.8, 2.8);
    }
    exponent("jump-and-walk-changes", "to build", 4.0 / 3.0, 0.04);
    exponent("jump-and-walk-changes", "a change", 1.0 / 3.0, 0.04);
}

/// Remark 7: O(n^(1/4)) in space.
#[test]
fn a_query_in_space_costs_the_fourth_root() {
    let space = table("jump-and-walk-space");
    for n in ["1000", "3000"] {
        space.rows(&[n]).within("in n^(1/4)", 2.8, 4.2);
    }
    exponent("jump-and-walk-space", "visited + m", 0.25, 0.04);
}
