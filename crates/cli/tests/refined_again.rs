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
