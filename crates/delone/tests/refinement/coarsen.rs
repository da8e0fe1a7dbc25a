//! Meshes are made coarser: angles hold, what is not marked stays, and refinement is undone.

use std::collections::BTreeSet;

use delone::{Constrained2, Error, Fill, Refined2, Refinement, RegionSeed2, Seeds2, TriangleId};
use delone_generators::Random;

use super::judge::{area, coordinates, corners, has_angles};
use super::nasty::nasty;

/// The corners of the triangles inside, in order.
fn inside(c: &Constrained2, refined: &Refined2) -> BTreeSet<[usize; 3]> {
    let of = |t: TriangleId| {
        let mut corners = c.mesh().corners(t).map(|v| v.index());
        corners.sort_unstable();
        corners
    };
    c.triangle_ids().filter(|&t| refined.domains.is_inside(t)).map(of).collect()
}

#[test]
fn refinement_is_undone_and_angles_hold() {
    let square = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let mut c = Constrained2::from_parts(&square, &[]).expect("finite");
    let mut refined = Refinement::new().min_angle(30.0).max_area(0.01).run(&mut c).expect("it ends");
    let first = refined.report.triangles;
    for round in 0..12 {
        let before = refined.report.triangles;
        refined = refined.coarsen(&mut c, &|_| true, 28.0).expect("as it was");
        assert_eq!(c.check(), Ok(()), "{round}");
        let all = c.triangle_ids().filter(|&t| refined.domains.is_inside(t));
        assert!(all.into_iter().all(|t| has_angles(corners(&c, t), 28.0)), "{round}");
        assert!((area(&c, |t| refined.domains.is_inside(t)) - 16.0).abs() < 1e-9, "{round}");
        assert!(refined.report.triangles <= before, "{round}");
    }
    assert!(refined.report.triangles * 6 < first, "{} of {first}", refined.report.triangles);
    // It is refined as any other mesh.
    let fill = Fill::Parts(&refined.domains);
    let fine = Refinement::new().min_angle(30.0).max_area(0.1).fill(fill).run(&mut c).expect("it ends");
    assert!(fine.report.left.is_empty() && c.check().is_ok());
}

#[test]
fn what_is_not_marked_stays() {
    let square = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let walls = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]];
    let mut c = Constrained2::from_parts(&square, &walls).expect("finite");
    let regions =
        vec![RegionSeed2::new([3.0, 1.0]).attribute(7.0), RegionSeed2::new([1.0, 3.0]).attribute(8.0)];
    let seeds = Seeds2::default().regions(regions);
    let refined = Refinement::new().max_area(0.02).fill(Fill::Seeds(&seeds)).run(&mut c).expect("it ends");
    let is_left = |c: &Constrained2, t: TriangleId| corners(c, t).iter().all(|p| p[0] < 1.5);
    let before = c.clone();
    let old = inside(&before, &refined);
    let coarse = refined.coarsen(&mut c, &|t| is_left(&before, t), 20.0).expect("as it was");
    assert_eq!(c.check(), Ok(()));
    let new = inside(&c, &coarse);
    assert!(new.len() + 50 < old.len());
    for t in before.triangle_ids().filter(|&t| !is_left(&before, t)) {
        let mut corners = before.mesh().corners(t).map(|v| v.index());
        corners.sort_unstable();
        assert!(new.contains(&corners));
    }
    for (attribute, side) in [(7.0, 1.0), (8.0, -1.0)] {
        let of = |t: TriangleId| coarse.domains.attribute(t) == Some(attribute);
        assert!((area(&c, of) - 8.0).abs() < 1e-9);
        let mut all = c.triangle_ids().filter(|&t| of(t));
        assert!(all.all(|t| corners(&c, t).iter().map(|p| side * (p[0] - p[1])).sum::<f64>() > 0.0));
    }
    let vertices = c.vertex_count();
    // With nothing marked nothing changes.
    let same = coarse.coarsen(&mut c, &|_| false, 20.0).expect("as it was");
    assert_eq!((c.vertex_count(), inside(&c, &same)), (vertices, new));
}

#[test]
fn any_mesh_stays_one() {
    for (name, points, segments) in &nasty() {
        let Ok(before) = Constrained2::with_crossings(points, segments, delone::Crossings::Split) else {
            continue;
        };
        let mut c = before.clone();
        let wanted = Refinement::new().min_angle(25.0).fill(Fill::EvenOdd).max_vertices(500);
        let refined = wanted.run(&mut c).expect("it ends");
        let whole = area(&c, |t| refined.domains.is_inside(t));
        let coarse = refined.coarsen(&mut c, &|_| true, 25.0).expect("as it was");
        assert_eq!(c.check(), Ok(()), "{name}");
        let now = area(&c, |t| coarse.domains.is_inside(t));
        assert!((whole - now).abs() <= 1e-9 * whole, "{name}: {whole} became {now}");
        assert!(coarse.report.smallest_angle >= refined.report.smallest_angle.min(25.0) - 1e-9, "{name}");
        for v in before.vertices() {
            assert!(c.vertices().any(|w| w == v), "{name}: {v:?} is lost");
        }
    }
}

#[test]
fn it_is_a_function_of_the_input() {
    let mut random = Random::new(4);
    let points: Vec<[f64; 2]> = (0..40).map(|_| [random.unit(), random.unit()]).collect();
    let run = |points: &[[f64; 2]]| {
        let mut c = Constrained2::from_parts(points, &[]).expect("finite");
        let refined = Refinement::new().min_angle(30.0).max_area(0.002).run(&mut c).expect("it ends");
        let coarse = refined.coarsen(&mut c, &|_| true, 25.0).expect("as it was");
        coordinates(&c, &coarse)
    };
    let expected = run(&points);
    for _ in 0..3 {
        let mut moved = points.clone();
        random.shuffle(&mut moved);
        assert_eq!(run(&moved), expected);
    }
}

/// A vertex at the centroid of the only triangle that is left of its part.
#[test]
fn a_part_of_one_triangle_stays() {
    let mut c = Constrained2::from_parts(&[[0, 0], [3, 0], [0, 3]], &[]).expect("finite");
    let wanted = Refinement::new().min_angle(0.0).max_area(2.0).keep(delone::Keep::Border);
    let refined = wanted.run(&mut c).expect("it ends");
    assert_eq!(refined.report.triangles, 3);
    let coarse = refined.coarsen(&mut c, &|_| true, 0.0).expect("as it was");
    assert_eq!((coarse.report.triangles, area(&c, |t| coarse.domains.is_inside(t))), (1, 4.5));
}

#[test]
fn meshes_of_before_are_refused() {
    let mut c = Constrained2::from_parts(&[[0, 0], [4, 0], [4, 4], [0, 4]], &[]).expect("finite");
    let refined = Refinement::new().max_area(0.5).run(&mut c).expect("it ends");
    assert!(matches!(
        refined.coarsen(&mut c, &|_| true, 60.0),
        Err(Error::Parameter { name: "min_angle", .. })
    ));
    c.insert([1.25, 1.375]).expect("finite");
    assert_eq!(refined.coarsen(&mut c, &|_| true, 20.0).map(|_| ()), Err(Error::Parts));
}
