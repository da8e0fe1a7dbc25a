//! Guibas, Knuth & Sharir 1992, §2.1, §2.2, §4.2 and §4.3: what scopes say of what appears.

use std::sync::LazyLock;

use delone_experiments::Findings;

use super::cells::{Cells, near, run};

static SCOPES: LazyLock<Findings> = LazyLock::new(|| run("scopes", 100));

/// How many scopes are frequent enough in the simulated orders for their shares to be known within a twelfth.
const FREQUENT: usize = 8;

/// The sets whose scopes are counted.
const CURVES: [&str; 4] = ["uniform", "ellipse", "parabola", "circle"];

fn table(name: &str) -> Cells {
    Cells::of(&SCOPES, name)
}

/// Lemma 2.1, Lemma 2.2, Theorem 2.3 and Figure 2.
#[test]
fn triangles_appear_by_their_scope() {
    let triangles = table("scopes-triangles");
    let [appeared, lemma] = ["appeared", "6/((k+1)(k+2)(k+3))"].map(|head| triangles.column(head));
    near(&appeared[..12], &lemma[..12], 0.08);
    let means = table("scopes-means");
    near(&means.column("simulated"), &means.column("computed"), 0.01);
    means.below("computed a point", "bound a point");
    let counted = table("scopes-lemma-2-2");
    for set in CURVES {
        counted.rows(&[set]).below("in units of n (k+1)^2", "bound");
    }
    let figure = table("scopes-figure-2");
    assert_eq!(figure.texts("computed"), figure.texts("paper"));
    assert_eq!(figure.texts("paper"), ["34.592", "44.559"]);
}

/// Formula (4) of §2.2 and the one that is equivalent, Lemma 2.4 and the bounds of its remark, Lemma 2.5.
#[test]
fn edges_appear_by_their_paths() {
    let edges = table("scopes-edges");
    let [appeared, paths] = ["appeared", "by zig-zag paths"].map(|head| edges.column(head));
    near(&appeared[..FREQUENT], &paths[..FREQUENT], 0.08);
    assert_eq!(edges.texts("by zig-zag paths"), edges.texts("by squares above them"));
    // The last row is the sum of all.
    near(&appeared[appeared.len() - 1..], &paths[paths.len() - 1..], 0.01);
    let of_scope = edges.len() - 1;
    let number = |text: &&str| text.parse::<f64>().expect("a number");
    let [most, least] = ["at most 2 a(w) - a(2w)", "at least a(2w)"]
        .map(|head| edges.texts(head)[..of_scope].iter().map(number).collect::<Vec<_>>());
    for ((path, least), most) in paths.iter().zip(&least).zip(&most) {
        assert!((least..=most).contains(&path), "{least} {path} {most}");
    }
    for (w, most) in edges.texts("w").iter().zip(&most) {
        let w = number(w);
        assert!(*most <= 1.001 * 4.0 / ((w + 1.0) * (w + 2.0)), "{w}: {most}");
    }
    let counted = table("scopes-lemma-2-5");
    for set in CURVES {
        counted.rows(&[set]).below("in units of n (k+1)", "bound");
    }
}

/// §4.2 and §4.3: some pair has half of all points in every circle, nearly, and some triple much of them in every sphere.
#[test]
fn some_circles_and_spheres_are_never_empty() {
    let pairs = table("scopes-pair");
    for share in ["uniform: share", "log-normal: share"] {
        pairs.within(share, 0.3, 0.5);
    }
    table("scopes-triple").within("share", 0.25, 0.5);
}

/// Lemmas 2.7, 2.8 and 2.9: edges between new points, and between new and old ones, when points are added.
#[test]
fn added_edges_appear_by_their_scope() {
    let added = table("scopes-adding");
    let counted = table("scopes-lemma-2-9");
    for set in ["uniform", "ellipse", "parabola", "two rows"] {
        for (kind, bound) in [("P-P", "4/((k+1)(k+2))"), ("P-Q", "2/(k+1)")] {
            let mut rows = 0;
            for k in ["0", "1", "2", "3", "4", "5", "6"] {
                let row = added.rows(&[set, k]);
                if row.column(&format!("{kind} edges"))[0] == 0.0 {
                    continue;
                }
                rows += 1;
                let [appeared, computed] =
                    ["appeared", "computed"].map(|head| row.column(&format!("{kind}: {head}"))[0]);
                row.below(&format!("{kind}: computed"), bound);
                // A hundred times in 4000 orders, within four deviations, whatever hangs together.
                let edges = row.column(&format!("{kind} edges"))[0];
                let deviation = (computed / 4000.0 / edges).sqrt();
                assert!(
                    (appeared - computed).abs() < 0.01 * computed + 6.0 * deviation,
                    "{set} {kind} {k}: {appeared} {computed}"
                );
            }
            assert!(rows >= 3, "{set} {kind}");
        }
        let of_set = counted.rows(&[set]);
        of_set.below("in m (k+1)^2 + n (k+1)", "P-P: by the proof");
        of_set.below("in m (k+1) + n", "P-Q: by the proof");
    }
}

/// The remark after Lemma 4.3: O(k n) edges in space have at most k points beyond a plane.
#[test]
fn few_edges_in_space_have_few_points_beyond() {
    let planes = table("scopes-planes");
    for set in ["cube", "sphere", "moment curve"] {
        for n in ["20", "40"] {
            planes.rows(&[set, n]).below("in units of n (k+1)", "by the proof");
        }
    }
    // A hull of points on a sphere has 3n - 6 edges.
    for n in [20.0, 40.0] {
        let row = planes.rows(&["sphere", &n.to_string(), "0"]);
        assert_eq!(row.column("edges"), [3.0 * n - 6.0]);
    }
}

/// Lemmas 4.4 and 4.5.
#[test]
fn tetrahedra_appear_by_their_scope() {
    let tetrahedra = table("scopes-tetrahedra");
    let [appeared, lemma] = ["appeared", "24/((k+1)(k+2)(k+3)(k+4))"].map(|head| tetrahedra.column(head));
    near(&appeared[..6], &lemma[..6], 0.08);
    let counted = table("scopes-lemma-4-5");
    for set in ["cube", "skew lines"] {
        for n in ["16", "32"] {
            counted.rows(&[set, n]).below("in n^2 (k+1)^2", "by the proof");
        }
    }
}

/// Theorems 4.6 and 4.7, and the point zeta.
#[test]
fn samples_bound_what_appears_in_space() {
    let samples = table("scopes-samples");
    for set in ["cube", "skew lines", "and zeta"] {
        let of_set = samples.rows(&[set]);
        assert_eq!(of_set.len(), 4, "{set}");
        // Four corners of a tetrahedron are new with probability 4 / r: four times the sum would be exact for its integral.
        of_set.within("appeared / sum", 0.5, 24.0);
        // Theorem 4.6: less than n^2 of them, on all sets.
        let [points, appeared] = ["points", "appeared"].map(|head| of_set.column(head));
        assert!(appeared.iter().zip(&points).all(|(count, n)| *count < n * n), "{set}: {appeared:?}");
    }
    // Linear in a cube.
    samples.rows(&["cube"]).within("appeared / end", 1.0, 6.0);
    // On lines all pairs of neighbors on both are in a tetrahedron; with zeta the end is linear, and what appears is not.
    let lines = samples.rows(&["skew lines"]);
    for (end, n) in lines.column("in the end").into_iter().zip(lines.column("points")) {
        assert_eq!(end, (n / 2.0 - 1.0).powi(2));
    }
    let zeta = samples.rows(&["and zeta"]);
    let [points, end, appeared] = ["points", "in the end", "appeared"].map(|head| zeta.column(head));
    assert!(end.iter().zip(&points).all(|(end, n)| *end <= 2.0 * n), "{end:?}");
    assert!(appeared[3] > 5.0 * end[3] && appeared[3] > 20.0 * appeared[0], "{end:?} {appeared:?}");
}
