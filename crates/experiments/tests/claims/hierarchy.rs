//! Devillers 1998: the lemmas and tables of the Delaunay hierarchy.

use std::sync::LazyLock;

use delone_experiments::Findings;

use super::cells::{Cells, near, run};

static TUNING: LazyLock<Findings> = LazyLock::new(|| run("tuning", 3000));
static HIERARCHY: LazyLock<Findings> = LazyLock::new(|| run("hierarchy", 5000));

/// The five sets of §5.5.1.
const SETS: [&str; 5] = ["random", "ellipse2", "ellipse", "parabola", "circle"];

fn table(name: &str) -> Cells {
    Cells::of(&TUNING, name)
}

/// Lemmas 1, 3 and 5, on all sets and by two ratios.
#[test]
fn lemmas_bound_each_phase() {
    let lemmas = table("tuning-lemmas");
    for set in SETS.into_iter().chain(["clusters"]) {
        for ratio in ["4", "30"] {
            let row = lemmas.rows(&["1000", set, ratio]);
            row.below("degree of nearest", "Lemma 1");
            row.below("edges crossed", "Lemma 3");
            row.below("triangles of phase 3", "Lemma 5");
        }
    }
}

/// Lemmas 2 and 4, for the point that is in the most disks.
#[test]
fn lemmas_bound_the_disks_around_a_point() {
    let disks = table("tuning-disks");
    for set in SETS {
        for ratio in ["4", "30"] {
            let row = disks.rows(&[set, ratio]);
            for [mean, most, lemma] in
                [["between, mean", "between, most", "Lemma 2"], ["around, mean", "around, most", "Lemma 4"]]
            {
                row.below(mean, most);
                row.below(most, lemma);
            }
        }
    }
}

/// Theorems 6 and 7, by levels alone on any set.
#[test]
fn locations_take_a_logarithm_on_any_set() {
    let theorem = table("tuning-theorem");
    for set in SETS {
        let of_set = theorem.rows(&[set]);
        assert_eq!(of_set.column("points"), [1000.0, 3000.0]);
        // The lemmas allow 36 + (24 ratio + 3) + 36 ratio for each of ln n / ln 30 levels: 540 ln n at ratio 30.
        of_set.within("visited / ln n", 1.0, 20.0);
        of_set.within("tests / ln n", 5.0, 50.0);
        of_set.within("to build: tests a point / ln n", 5.0, 60.0);
    }
}

/// §4.1 to §4.3: what each phase does on a level.
#[test]
fn phases_cost_what_is_expected() {
    let phases = table("tuning-phases").rows(&["1000"]);
    assert_eq!(phases.len(), 6);
    near(&phases.column("turn: orientations"), &[3.0; 6], 0.1);
    phases.below("walk: edges crossed", "paper's walk");
    for (ratio, phase, most) in
        [("8", "exact", 8.0), ("8", "in-circle", 8.0), ("30", "exact", 8.0), ("30", "in-circle", 8.0)]
    {
        table("tuning-phases").rows(&["1000", ratio, phase]).within("phase 3: triangles", 1.0, most);
    }
}

/// §4.4: operations by the ratio, and memory (Theorem 7).
#[test]
fn ratios_decide_operations_and_memory() {
    let ratios = table("tuning-ratio").rows(&["1000"]);
    assert_eq!(ratios.column("ratio"), [2.0, 4.0, 8.0, 18.0, 30.0, 40.0, 60.0, 90.0]);
    // Links are a tenth of the triangulation at ratio 2, and nothing later.
    for (memory, levels) in ratios.column("memory").into_iter().zip(ratios.column("ratio / (ratio - 1)")) {
        assert!(memory > 0.98 * levels && memory < 1.12 * levels, "{memory} {levels}");
    }
    // With a sample on top the cost is flat from 8 on, and twice as much at 2.
    let with_sample = ratios.column("with sample: operations");
    let flat = &with_sample[2..];
    assert!(
        flat.iter().all(|cost| *cost < 0.75 * with_sample[0] && *cost < 1.35 * flat[0]),
        "{with_sample:?}"
    );
    // Levels alone cost no less.
    let alone = ratios.column("operations");
    assert!(alone.iter().zip(&with_sample).all(|(alone, sampled)| *alone > 0.9 * sampled), "{alone:?}");
    // What is counted is between the paper's formula and twice the same with the edges of §4.2.
    ratios.rows(&["1000", "2"]).within("operations", 250.0, 500.0);
}

/// Figures 3 and 4: the formulas cross where the paper says, and what is counted in the same order.
#[test]
fn crossovers_come_in_the_order_of_the_figures() {
    let crossovers = table("tuning-crossovers");
    near(&crossovers.column("its formulas"), &crossovers.column("paper"), 0.13);
    let derived = crossovers.column("with the edges of 4.2");
    assert!(derived.is_sorted(), "{derived:?}");
    // Up to this size two levels need not be better than a sample yet.
    let counted =
        ["sample", "two levels"].map(|way| crossovers.rows(&[way, "walk"]).column("measured crossover")[0]);
    assert!(counted[0] < 40.0 && counted[1] < 180.0 && counted[0] < counted[1], "{counted:?}");
}

/// Appendix: Figure 6.
#[test]
fn a_hub_misleads_by_corners_and_not_by_circles() {
    let hub = table("tuning-counterexample");
    let growth = |head: &str| {
        let [few, many] = ["100", "1600"].map(|n| hub.rows(&["2", n]).column(head)[0]);
        many / few
    };
    // Sixteen times the points.
    let [corner, circles] = ["corner", "in-circle"].map(growth);
    assert!(corner > 6.0 && circles < 3.5, "{corner} {circles}");
    for n in ["100", "200", "400", "800", "1600"] {
        let row = hub.rows(&["2", n]);
        assert_eq!(row.column("degree of the hub")[0] * 2.0, row.column("points")[0]);
    }
}

/// §5.4 and §5.5.2: the modes rank as in the paper's table of 5,000 points, on all five sets.
#[test]
fn modes_rank_as_in_the_paper() {
    let visited = Cells::of(&HIERARCHY, "hierarchy-visited");
    for set in ["random", "ellipse2", "ellipse", "parabola"] {
        let [walk, sample, levels, both] = ["walk", "MSZ", "hierarchy", "hierarchy+MSZ"]
            .map(|way| visited.rows(&[set, "5000"]).column(way)[0]);
        assert!(walk > 1.6 * sample.max(levels), "{set}: {walk} {sample} {levels}");
        // Sampling saves random points, and only levels save curves.
        assert!(set == "random" || sample > 1.5 * levels, "{set}: {sample} {levels}");
        assert!(both < 0.9 * levels && both < sample, "{set}: {sample} {levels} {both}");
    }
    // On the circle the paper's four times are the same; sampling alone visits the fewest.
    let circle = visited.rows(&["circle", "5000"]);
    for way in ["walk", "MSZ", "hierarchy", "hierarchy+MSZ"] {
        circle.within(way, 10.0, 30.0);
    }
    assert!(circle.column("hierarchy+MSZ") < circle.column("hierarchy"));
}

/// §6: in space.
#[test]
fn the_hierarchy_generalizes_to_space() {
    let space = Cells::of(&HIERARCHY, "hierarchy-space");
    assert_eq!(space.len(), 2);
    let [walk, both] = ["walk", "hierarchy+MSZ"].map(|head| space.column(head));
    assert!(walk.iter().zip(&both).all(|(walk, both)| *both < 0.7 * walk), "{walk:?} {both:?}");
    // Three times the points; a walk grows with the cube root.
    assert!(walk[1] > 1.3 * walk[0] && both[1] < 1.25 * both[0], "{walk:?} {both:?}");
}

/// §5.1: a random vertex is removed in constant time, and from all its levels.
#[test]
fn removals_take_constant_time() {
    let findings = run("deletion", 10_000);
    let removal = Cells::of(&findings, "deletion");
    assert_eq!(removal.len(), 2);
    removal.within("in-circle tests", 4.8, 6.0);
    removal.within("new triangles", 3.7, 4.1);
    let plain = removal.column("in-circle tests");
    for (head, ratio) in [("ratio 30: in-circle tests", 30.0), ("ratio 4: in-circle tests", 4.0)] {
        // The mean number of levels of a vertex.
        let levels: Vec<f64> = plain.iter().map(|tests| tests * ratio / (ratio - 1.0)).collect();
        near(&removal.column(head), &levels, 0.08);
    }
}
