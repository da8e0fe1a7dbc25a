//! Meshes of a wanted length of edges, as a user meets them.

use serde_json::Value;

use crate::mesh::{PLAN, mesh};
use crate::place::Place;

fn number(stats: &Value, names: &[&str]) -> f64 {
    names.iter().fold(stats, |at, name| &at[*name]).as_f64().expect("a number")
}

#[test]
fn statistics_tell_how_good_a_mesh_is() {
    let place = Place::new();
    place.file("plan.poly", PLAN);
    let mut counts = Vec::new();
    for growth in ["", "--growth 1.1", "--growth 1.5"] {
        place.succeed(&format!(
            "-q mesh plan.poly --edge 0.5 {growth} --min-angle 28 --check -o m.node -o m.ele -o m.vtu --stats s.json"
        ));
        let made = mesh(&place, "m");
        made.judge(28.0);
        assert!((made.area() - 72.0).abs() < 1e-9);
        let stats: Value = serde_json::from_str(&place.read("s.json")).expect("statistics");
        let [mean, p5] = ["mean", "p5"].map(|name| number(&stats, &["quality", name]));
        let step = number(&stats, &["step", "p95"]);
        assert!(
            mean > 0.97 && p5 > 0.9 && p5 < mean && step > 1.0 && step < 1.4,
            "{growth}: {mean}, {p5}, {step}"
        );
        assert!(number(&stats, &["smallest_angle"]) > 28.0);
        let quality = |t: [usize; 3]| {
            let corners = t.map(|v| made.points[v]);
            let squares = (0..3).map(|k| {
                let [p, q] = [corners[k], corners[(k + 1) % 3]];
                (q[0] - p[0]).powi(2) + (q[1] - p[1]).powi(2)
            });
            4.0 * 3.0_f64.sqrt() * made.area_of(t) / squares.sum::<f64>()
        };
        let sum: f64 = made.triangles.iter().map(|&t| quality(t)).sum();
        assert!((sum / made.triangles.len() as f64 - mean).abs() < 1e-9, "{growth}");
        counts.push(made.triangles.len());
    }
    assert!(counts[1] >= counts[0] && counts[0] >= counts[2], "{counts:?}");
}

/// A file of sizes says what is wanted, and a bound stays a bound.
#[test]
fn lengths_come_from_a_file_too() {
    let place = Place::new();
    place.file("plan.poly", PLAN);
    place.file("sizes.csv", "x,y,length\n0,0,0.1\n9,0,1\n9,9,1\n0,9,1\n");
    place.succeed("-q mesh plan.poly --edge 1 --size sizes.csv --size-columns x,y,length --max-edge 0.9 -o m.node -o m.ele");
    let made = mesh(&place, "m");
    let near = |t: &&[usize; 3]| t.iter().all(|&v| made.points[v].iter().all(|&x| x < 1.0));
    let count = made.triangles.iter().filter(near).count();
    assert!(count > 40 && count < 200, "{count} in the corner");
    let length = |[a, b]: [usize; 2]| {
        let [p, q] = [a, b].map(|v| made.points[v]);
        (q[0] - p[0]).hypot(q[1] - p[1])
    };
    assert!(made.edges().into_iter().map(length).all(|length| length <= 0.9));
}

#[test]
fn what_is_no_length_is_refused() {
    let place = Place::new();
    place.file("plan.poly", PLAN);
    for (options, says) in [
        ("--edge 0", "edge is 0"),
        ("--edge=-1", "edge is -1"),
        ("--edge nan", "edge is NaN"),
        ("--edge 1 --growth 1", "growth is 1"),
        ("--growth 1.2", "--edge"),
    ] {
        place.fail(&format!("mesh plan.poly {options} -o m.vtu"), 2, says);
    }
    place.fail("mesh plan.poly --edge 1e-9 -o m.vtu", 1, "edge is");
}
