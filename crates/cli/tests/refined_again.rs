//! Meshes that are refined once more, as a user meets them.

use crate::mesh::{PLAN, mesh};
use crate::place::Place;

/// Sides between triangles of other attributes are segments: no new triangle has a part of both.
#[test]
fn materials_keep_their_areas_where_a_mesh_is_refined() {
    let place = Place::new();
    place.file("a.node", "4 2 0 0\n1 0 0\n2 2 -0.6\n3 4 0\n4 2.5 0.5\n");
    place.file("a.ele", "2 3 1\n1 1 2 3 1\n2 1 3 4 2\n");
    for options in ["--min-angle 0", "--min-angle 30 --max-area 0.01"] {
        place.succeed(&format!("-q mesh a.node --refine a.ele {options} --check -o b.node -o b.ele"));
        let made = mesh(&place, "b");
        for (material, area) in [(1.0, 1.2), (2.0, 1.0)] {
            let of = made.triangles.iter().zip(&made.regions).filter(|(_, region)| **region == material);
            let sum: f64 = of.map(|(&t, _)| made.area_of(t)).sum();
            assert!((sum - area).abs() < 1e-12, "{options}: {sum} of material {material}");
        }
    }
}

#[test]
fn a_mesh_is_refined_again() {
    let place = Place::new();
    place.file("plan.poly", PLAN);
    place.succeed("-q mesh plan.poly -o a.node -o a.ele -o a.poly");
    let first = mesh(&place, "a");
    // The triangle that is largest may keep its area, others a tenth of it.
    let largest = first.triangles.iter().map(|&t| first.area_of(t)).fold(0.0, f64::max);
    let bounds: Vec<f64> = first
        .triangles
        .iter()
        .map(|&t| if first.area_of(t) == largest { -1.0 } else { largest / 10.0 })
        .collect();
    let rows: Vec<String> =
        bounds.iter().enumerate().map(|(i, bound)| format!("{} {bound}", i + 1)).collect();
    place.file("a.area", format!("{}\n{}\n", rows.len(), rows.join("\n")));
    place.succeed("-q mesh a.node --refine a.ele --areas a.area --check -o b.node -o b.ele");
    let again = mesh(&place, "b");
    again.judge(20.0);
    assert!((again.area() - 72.0).abs() < 1e-9, "{}", again.area());
    assert_eq!(&again.points[..first.points.len()], &first.points[..]);
    assert!(again.regions.iter().all(|&region| region == 7.0) && !again.regions.is_empty());
    assert!(again.triangles.len() > 2 * first.triangles.len());
    for &t in &again.triangles {
        let middle = [0, 1].map(|k| t.iter().map(|&i| again.points[i][k]).sum::<f64>() / 3.0);
        let side = |[i, j]: [usize; 2]| {
            let (p, q) = (first.points[i], first.points[j]);
            (q[0] - p[0]) * (middle[1] - p[1]) - (q[1] - p[1]) * (middle[0] - p[0]) > 1e-9
        };
        let home =
            first.triangles.iter().position(|&[a, b, c]| [[a, b], [b, c], [c, a]].into_iter().all(side));
        let bound = home.map_or(f64::INFINITY, |home| bounds[home]);
        assert!(bound < 0.0 || again.area_of(t) <= bound, "{} > {bound}", again.area_of(t));
    }
    place.file("short.area", "1\n1 0.5\n");
    place.fail("mesh a.node --refine a.ele --areas short.area -o c.vtu", 1, "1 areas for");
    place.file("far.ele", "1 3 0\n1 1 2 99999\n");
    place.fail("mesh a.node --refine far.ele -o c.vtu", 1, "corner 99998");
    place.file("twice.ele", "2 3 0\n1 1 2 3\n2 1 2 4\n");
    place.fail("mesh a.node --refine twice.ele -o c.vtu", 1, "no mesh");
    place.fail("mesh a.node --areas a.area -o c.vtu", 2, "--refine");
}

/// A grid whose diagonals are not those of the canonical triangulation.
fn grid(place: &Place) {
    let side = 9;
    let at = |i: usize| format!("{} {} {}\n", i + 1, i % side, i / side);
    let points: String = (0..side * side).map(at).collect();
    place.file("g.node", format!("{} 2 0 0\n{points}", side * side));
    let squares = (0..(side - 1) * (side - 1)).map(|k| k / (side - 1) * side + k % (side - 1) + 1);
    let halves = squares.flat_map(|a| [[a, a + 1, a + side + 1], [a, a + side + 1, a + side]]);
    let rows: Vec<String> =
        halves.enumerate().map(|(i, [a, b, c])| format!("{} {a} {b} {c} {}\n", i + 1, 3)).collect();
    place.file("g.ele", format!("{} 3 1\n{}", rows.len(), rows.concat()));
}

#[test]
fn triangles_stay_where_nothing_has_to_change() {
    let place = Place::new();
    grid(&place);
    let sorted = |name: &str| {
        let mut triangles = mesh(&place, name).triangles;
        triangles.iter_mut().for_each(|corners| corners.sort_unstable());
        triangles.sort_unstable();
        triangles
    };
    let given = sorted("g");
    place.succeed(
        "-q mesh g.node --refine g.ele --min-angle 30 --check -o a.node -o a.ele -o a.poly -o a.edge",
    );
    assert_eq!(sorted("a"), given);
    // Edges that only keep triangles are no segments.
    assert!(place.read("a.poly").contains("\n32 "), "{}", place.read("a.poly"));
    place.succeed("-q mesh g.node --refine g.ele --rebuild -o b.node -o b.ele");
    assert_ne!(sorted("b"), given);
    place.succeed("-q mesh g.node --triangle rq -o c.node -o c.ele");
    assert_eq!(sorted("c"), given);
    place.file("g.poly", "0 2 0 0\n1 0\n1 1 12\n0\n");
    place.fail(
        "mesh g.node --segments g.poly --refine g.ele -o d.vtu",
        1,
        "crosses a segment or another triangle",
    );
    place.fail("mesh g.node --rebuild -o d.vtu", 2, "--refine");
}

/// Gmsh's files have the centers of circles among their points.
#[test]
fn points_that_nothing_has_split_nothing() {
    let place = Place::new();
    place.file("c.node", "5 2 0 0\n1 2.5 1\n2 0 0\n3 4 0\n4 4 3\n5 0 3\n");
    place.file("c.ele", "2 3 0\n1 2 3 4\n2 2 4 5\n");
    for options in ["", "--rebuild "] {
        place.succeed(&format!("-q mesh c.node --refine c.ele --min-angle 0 {options}-o d.node -o d.ele"));
        let made = mesh(&place, "d");
        assert_eq!((made.triangles.len(), made.points.len(), made.points[0]), (2, 5, [2.5, 1.0]));
    }
    place.succeed("-q mesh c.node --refine c.ele --max-area 1 -o d.node -o d.ele");
    assert!((mesh(&place, "d").area() - 12.0).abs() < 1e-12);
    place.succeed("-q mesh c.node --refine c.ele --max-area 1 --drop-unused -o d.node -o d.ele");
    assert!((mesh(&place, "d").area() - 12.0).abs() < 1e-12);
}
