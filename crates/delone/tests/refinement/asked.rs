//! Triangles that a function of the caller refuses.

use std::cell::Cell;

use delone::{Constrained2, Error, Fill, Reason, Refined2, Refinement, RegionSeed2, Seeds2};

/// A square with a hole.
fn frame() -> Constrained2 {
    let points = [[0, 0], [8, 0], [8, 8], [0, 8], [3, 3], [5, 3], [5, 5], [3, 5]];
    let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]];
    Constrained2::from_parts(&points, &segments).expect("apart")
}

/// The corners and the area of each triangle of the mesh.
fn inside(c: &Constrained2, made: &Refined2) -> Vec<([[f64; 2]; 3], f64)> {
    let ids = c.triangle_ids().filter(|&t| made.domains.is_inside(t));
    ids.map(|t| (c.mesh().corners(t).map(|v| c.point(v)), c.area(t))).collect()
}

#[test]
fn no_triangle_is_left_that_is_refused() {
    // Finer towards the hole, by the corner that is nearest to it.
    let refused = |corners: [[f64; 2]; 3], area: f64| {
        let apart = |p: [f64; 2]| (p[0] - 4.0).abs().max((p[1] - 4.0).abs()) - 1.0;
        area > 0.01 + 0.1 * corners.map(apart).into_iter().fold(f64::INFINITY, f64::min)
    };
    for angle in [0.0, 25.0] {
        let mut c = frame();
        let how = Refinement::new().min_angle(angle).fill(Fill::EvenOdd).refine_if(&refused);
        let made = how.run(&mut c).expect("a mesh");
        assert_eq!(c.check(), Ok(()));
        assert!(made.report.left.is_empty() && made.report.inside > 100);
        assert!(inside(&c, &made).into_iter().all(|(corners, area)| !refused(corners, area)));
    }
}

#[test]
fn corners_are_counter_clockwise_from_the_shortest_side_on() {
    let count = Cell::new(0);
    let refused = |[a, b, c]: [[f64; 2]; 3], area: f64| {
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let length = |p: [f64; 2], q: [f64; 2]| (q[0] - p[0]).hypot(q[1] - p[1]);
        assert!(twice > 0.0 && (twice / 2.0 - area).abs() <= 1e-12 * area);
        // Of sides that are equal up to rounding any is the shortest.
        assert!(length(a, b) <= (1.0 + 1e-12) * length(b, c).min(length(c, a)));
        count.set(count.get() + 1);
        area > 0.05
    };
    let made = Refinement::new().refine_if(&refused).run(&mut frame()).expect("a mesh");
    assert!(count.get() >= made.report.triangles);
}

#[test]
fn who_is_never_content_meets_the_bound_of_vertices() {
    for most in [0, 1, 7, 1000] {
        let mut c = frame();
        let how = Refinement::new().refine_if(&|_, _| true).fill(Fill::EvenOdd).max_vertices(most);
        let made = how.run(&mut c).expect("a mesh");
        assert_eq!(c.check(), Ok(()));
        assert_eq!(c.vertex_count(), 8 + most);
        // Short edges come first, so some triangles get too small to be divided before the bound is met.
        assert_eq!(made.report.left.len(), made.report.triangles, "at {most}");
        assert!(made.report.left_for(Reason::Budget) > 0);
    }
}

/// Bounds of regions are bounds: they are refused as those of the whole.
#[test]
fn sizes_of_regions_that_are_none_are_refused() {
    let points = [[0, 0], [1, 0], [1, 1], [0, 1]];
    let segments = [[0, 1], [1, 2], [2, 3], [3, 0]];
    for area in [-1.0, 0.0, f64::NAN, 1e-300] {
        let region = RegionSeed2::new([0.5, 0.5]).max_area(area);
        let seeds = Seeds2::default().regions(vec![region]);
        let mut c = Constrained2::from_parts(&points, &segments).expect("a square");
        let refused = Refinement::new().fill(Fill::Seeds(&seeds)).run(&mut c);
        assert!(matches!(refused, Err(Error::Parameter { .. })), "{area}");
    }
}
