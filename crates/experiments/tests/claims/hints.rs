//! Devillers 2011: what hints cost, in tables and in the proof.

use std::sync::LazyLock;

use delone_experiments::Findings;
use delone_generators::Kind3;

use super::cells::{Cells, near, run, run_on};

static IMPRECISE: LazyLock<Findings> = LazyLock::new(|| run("imprecise", 10_000));
static DISKS: LazyLock<Findings> = LazyLock::new(|| run("disks", 1000));

/// Triangles visited at each of the sizes: as in the paper up to a tenth, or fewer.
#[track_caller]
fn as_published(table: &Cells, head: &str, least: f64) {
    for n in ["1000", "10000"] {
        let [found, published] =
            [n.to_owned(), format!("{n} in 2011")].map(|row| table.rows(&[&row]).column(head)[0]);
        assert!(
            found > least * published && found < 1.03 * published,
            "{head} {n}: {found}, published {published}"
        );
    }
}

/// §5, disks: the table of triangles visited.
#[test]
fn walks_visit_as_many_triangles_as_published() {
    let table = Cells::of(&IMPRECISE, "imprecise-visited");
    as_published(&table, "hints, random order", 0.97);
    as_published(&table, "one Hilbert curve, straight", 0.95);
    // Fewer than in the paper, for reasons that the page tells.
    as_published(&table, "hints, spatial order", 0.85);
    as_published(&table, "spatial sort", 0.85);
    as_published(&table, "hierarchy", 0.75);
    for n in ["1000", "10000"] {
        // The order saves triangles, the kind of walk hardly any.
        near(
            &table.rows(&[n]).column("spatial sort, straight"),
            &table.rows(&[n]).column("spatial sort"),
            0.05,
        );
        let [levels, both] =
            ["hierarchy", "hierarchy and sample"].map(|head| table.rows(&[n]).column(head)[0]);
        assert!(both < 0.8 * levels && both > 8.0, "{n}: {levels} {both}");
    }
}

/// §5, balls: fewer than the paper's 5.3, 4.5, 6.6 and 34 at a hundred times the points.
#[test]
fn walks_in_space_visit_fewer_than_published() {
    let table = Cells::of(&IMPRECISE, "imprecise-space-visited");
    for (head, least, most) in [
        ("hints, random order", 4.5, 5.3),
        ("hints, spatial order", 3.8, 4.5),
        ("spatial sort", 5.0, 6.6),
        ("hierarchy", 12.0, 34.0),
        ("hierarchy and sample", 9.0, 34.0),
    ] {
        table.rows(&["1000"]).within(head, least, most);
    }
}

/// §5, scanned models: points on a surface; hints in spatial order visit fewer than spatial sort does.
#[test]
fn walks_on_a_surface_visit_fewer_than_published() {
    let findings = run_on("scan", 3000, 2, &Kind3::Sphere.points(3000, 5));
    let table = Cells::of(&findings, "scan-visited");
    assert_eq!(table.len(), 2);
    table.within("hints, spatial order", 4.0, 6.4);
    table.within("spatial sort", 5.0, 7.9);
    table.below("hints, spatial order", "spatial sort");
    table.below("hints, spatial order", "hints, random order");
}

/// §5, Brownian motion: 2.77 visited by the hints of the last step, and 3.6 to 3.8 by spatial sort; repair is never given up.
#[test]
fn hints_follow_a_brownian_motion() {
    let findings = run("brownian", 1000);
    let table = Cells::of(&findings, "brownian").rows(&["1000"]);
    table.within("hints of the last step: visited", 2.4, 2.77);
    table.within("spatial sort: visited", 3.0, 3.81);
    assert_eq!(table.texts("rebuilt"), ["0 of 100"]);
}

/// §4: Lemma 1 and the claims of Theorem 3.
#[test]
fn the_constants_of_the_proof_hold() {
    let table = Cells::of(&DISKS, "disks-claims");
    for (head, bound) in [("most in W(q)", 22.0), ("degree of a hint", 36.0), ("sum of degrees", 132.0)] {
        table.within(head, 1.0, bound);
    }
}

/// §4: Lemma 2.
#[test]
fn every_edge_on_the_way_from_a_hint_ends_nearby() {
    let table = Cells::of(&DISKS, "disks-crossed");
    assert_eq!(table.column("without an end in D(p)"), [0.0; 6]);
    for n in ["300", "1000"] {
        // There are such edges where disks overlap.
        table.rows(&[n, "16.0"]).within("crossed after", 0.05, 132.0);
        let of_size = table.rows(&[n]);
        of_size.within("crossed after", 0.0, 132.0);
        assert!(of_size.column("crossed after") < of_size.column("crossed before"));
    }
}

/// §1: what all instances have, what a hundred have, what one of them has, what any can have.
#[test]
fn certain_and_possible_edges_enclose_those_of_instances() {
    let edges = Cells::of(&DISKS, "disks-edges");
    let heads = ["certain", "in all of 100", "in any of 100", "possible"];
    let columns = heads.map(|head| edges.column(head));
    assert_eq!(edges.len(), 6);
    for two in columns.windows(2) {
        assert!(two[0].iter().zip(&two[1]).all(|(less, more)| less <= more), "{columns:?}");
    }
    // Points alone have one instance; the larger disks are, the less is certain and the more is possible.
    assert!(columns.iter().all(|column| column[0] == columns[0][0]), "{columns:?}");
    assert!(columns[0].windows(2).all(|two| two[0] > two[1]), "{columns:?}");
    assert!(columns[3].windows(2).all(|two| two[0] < two[1]), "{columns:?}");
}

/// §6.1 and §6.3: where at most k disks have a point in common the cost is O(k) a point; ours grows with the square root of k.
#[test]
fn overlaps_cost_at_most_their_depth() {
    let table = Cells::of(&DISKS, "disks-overlap");
    assert_eq!(table.len(), 6);
    table.within("visited / k", 0.01, 3.0);
    let [radii, plane, space] = ["radius", "visited", "visited in space"].map(|head| table.column(head));
    assert_eq!(radii, [1.0, 2.0, 4.0, 8.0, 16.0, 32.0]);
    for (visited, per_radius) in [(plane, 1.0), (space, 1.5)] {
        assert!(visited.windows(2).all(|two| two[0] < two[1]), "{visited:?}");
        assert!(
            visited.iter().zip(&radii).all(|(visited, r)| *visited < 5.0 + per_radius * r),
            "{visited:?}"
        );
    }
}

/// §6.2: disks of different radii, and nested ones.
#[test]
fn radii_cost_nothing_until_disks_are_nested() {
    Cells::of(&DISKS, "disks-radii").within("visited", 2.5, 5.0);
    let misled = Cells::of(&DISKS, "disks-misled");
    let [points, visited] = ["points", "visited"].map(|head| misled.column(head));
    assert_eq!(points[..4], [51.0, 101.0, 201.0, 401.0]);
    // Linear a point, so quadratic in all, until walks are given up.
    assert!(visited[3] > 3.0 * visited[0], "{visited:?}");
    near(&misled.column("in n")[1..3], &[0.165; 2], 0.25);
    assert_eq!(misled.texts("given up")[6], "2 of 2");
    assert!(visited[6] < 60.0, "{visited:?}");
}
