//! Drawings with arcs as a user meets them.

use crate::mesh::mesh;
use crate::place::{Place, text};

/// Groups of a drawing, apart by blanks, as lines.
fn drawing(entities: &str) -> String {
    format!("0 SECTION 2 ENTITIES {entities} 0 ENDSEC 0 EOF\n").replace(' ', "\n")
}

/// A square plate with a round hole.
const PLATE: &str =
    "0 LWPOLYLINE 70 1 10 -2 20 -2 10 2 20 -2 10 2 20 2 10 -2 20 2 0 CIRCLE 10 0.25 20 0 40 1";

fn radius(p: [f64; 2]) -> f64 {
    (p[0] - 0.25).hypot(p[1])
}

#[test]
fn meshes_follow_arcs() {
    let place = Place::new();
    place.file("plate.dxf", drawing(PLATE));
    let run = place
        .run("mesh plate.dxf --fill even-odd --edge 0.2 --min-angle 28 --check -o m.node -o m.ele -o m.edge");
    assert!(run.status.success(), "{}", text(&run.stderr));
    assert!(
        text(&run.stderr)
            .contains("arcs and circles, as chords of at most 11.25 degrees that meshes follow: 1")
    );
    let m = mesh(&place, "m");
    assert!((m.area() / (16.0 - std::f64::consts::PI) - 1.0).abs() < 0.003, "{}", m.area());
    let (on, near): (Vec<[f64; 2]>, Vec<[f64; 2]>) = m
        .points
        .iter()
        .copied()
        .filter(|&p| radius(p) < 1.0 + 1e-3)
        .partition(|&p| (radius(p) - 1.0).abs() < 4e-16);
    assert!(on.len() >= 32 && near.is_empty(), "{} {near:?}", on.len());

    place.succeed("-q mesh plate.dxf --fill even-odd --edge 0.2 --second-order -o n.node -o n.ele -o n.edge");
    let n = place.read("n.node");
    let nodes: Vec<[f64; 2]> = n
        .lines()
        .skip(1)
        .filter_map(|line| {
            let numbers: Vec<f64> = line.split_whitespace().map_while(|word| word.parse().ok()).collect();
            Some([*numbers.get(1)?, *numbers.get(2)?])
        })
        .collect();
    let on_circle = nodes.iter().filter(|&&p| (radius(p) - 1.0).abs() < 4e-16).count();
    // The circle ends where it begins: one position is there twice.
    assert_eq!(on_circle, 2 * on.len() - 1);
    assert!(nodes.iter().all(|&p| radius(p) > 1.0 - 4e-16));

    // Quadrilaterals alone have corners in the middles of sides.
    place.succeed("-q mesh plate.dxf --fill even-odd --edge 0.2 --all-quads -o q.su2 --stats s.json");
    let stats: serde_json::Value = serde_json::from_str(&place.read("s.json")).expect("JSON");
    assert_eq!(stats["quads"]["not_convex"].as_u64(), Some(0));
    let corners: Vec<[f64; 2]> = place
        .read("q.su2")
        .lines()
        .filter_map(|line| {
            let numbers: Vec<f64> = line.split_whitespace().map_while(|word| word.parse().ok()).collect();
            line.contains('.').then(|| Some([*numbers.first()?, *numbers.get(1)?]))?
        })
        .collect();
    let on_circle = corners.iter().filter(|&&p| (radius(p) - 1.0).abs() < 4e-16).count();
    assert_eq!(on_circle, 2 * (on.len() - 1));
    assert!(corners.iter().all(|&p| radius(p) > 1.0 - 4e-16));
}

#[test]
fn lines_bound_where_there_are_no_polygons() {
    let place = Place::new();
    place.file("plate.dxf", drawing(PLATE));
    let triangles = |fill: &str| {
        place.succeed(&format!("-q triangulate plate.dxf {fill} -o t.ele --stats s.json"));
        let stats: serde_json::Value = serde_json::from_str(&place.read("s.json")).expect("JSON");
        stats["simplices"].as_u64().expect("a number") - stats["left_out"].as_u64().unwrap_or(0)
    };
    // The hole is a polygon of 32 corners.
    assert_eq!(triangles("") - triangles("--fill even-odd"), 30);
    assert_eq!(triangles("--fill even-odd"), triangles("--fill nonzero") - 30);
}

/// A flat arc over a line, and two over one chord: they bound what is between.
#[test]
fn flat_arcs_over_other_segments_bound_areas() {
    let place = Place::new();
    let (bulge, turn) = (0.03f64, 4.0 * 0.03f64.atan());
    let radius = 0.5 / (turn / 2.0).sin();
    let cap = radius * radius * (turn - turn.sin()) / 2.0;
    for (second, expected) in [(0.0, cap), (bulge, 2.0 * cap)] {
        let entities = format!("0 LWPOLYLINE 70 1 10 0 20 0 42 {bulge} 10 1 20 0 42 {second}");
        place.file("cap.dxf", drawing(&entities));
        place.succeed("-q mesh cap.dxf --fill even-odd --edge 0.02 -o m.node -o m.ele -o m.edge");
        let area = mesh(&place, "m").area();
        assert!((area / expected - 1.0).abs() < 0.01, "{second}: {area}, not {expected}");
    }
}
