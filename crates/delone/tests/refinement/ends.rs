//! All that is said is true, it always ends, and the mesh is a function of the input.

use std::collections::BTreeSet;

use delone::{Constrained2, Fill, Reason, Refined2, Refinement};
use delone_generators::{Graph, Random};
use delone_oracle::{all_cases, exact};

use super::judge::{Points, Segments, area, coordinates, refine};
use super::nasty::{nasty, slit};

#[test]
fn all_that_is_said_is_true() {
    for (name, points, segments) in nasty() {
        for degrees in [0.0, 20.0, 30.0] {
            for (fill, conforming) in [(Fill::All, false), (Fill::EvenOdd, false), (Fill::EvenOdd, true)] {
                let how = Refinement::new().conforming(conforming);
                let name = format!("{name} at {degrees}, {fill:?}, conforming {conforming}");
                let (c, refined) = refine(&points, &segments, how, fill, degrees, &name);
                let asked_for_nothing = degrees == 0.0 && !conforming;
                assert!(
                    !asked_for_nothing || refined.report.inside + refined.report.on_constraints == 0,
                    "{name}"
                );
                if conforming {
                    assert_is_gabriel(&c, &refined, &name);
                }
            }
        }
    }
}

/// No vertex that a constraint sees is inside of its diametral circle; those that could not be split are left.
fn assert_is_gabriel(c: &Constrained2, refined: &Refined2, name: &str) {
    let mesh = c.mesh();
    let sides = c.constraint_edges().flat_map(|e| [e, mesh.twin(e)]);
    let near = sides.filter(|e| refined.domains.is_inside(e.triangle())).filter(|&e| {
        let [o, a, b] = [mesh.apex(e), mesh.origin(e), mesh.destination(e)].map(|v| c.point(v));
        exact::angle(o, a, b) < 0
    });
    let left: BTreeSet<_> = refined.report.left.iter().map(|left| left.triangle).collect();
    for e in near {
        assert!(left.contains(&e.triangle()), "{name}: a constraint is encroached");
    }
}

/// Every new vertex is in the circles of all triangles that are left: with one beside the other in time this would take hours.
#[test]
fn corners_on_a_circle_are_no_burden() {
    let count = if all_cases() { 200_000 } else { 40_000 };
    let corner = |i: usize| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / count as f64).sin_cos();
        [cos, sin]
    };
    let points: Points = (0..count).map(corner).collect();
    let mut c = Constrained2::from_parts(&points, &[]).expect("finite");
    let report = Refinement::new().run(&mut c).expect("angles").report;
    assert!(report.left.is_empty() && report.smallest_angle >= 20.0, "{report:?}");
    assert!(
        (count * 3 / 4..count * 11 / 10).contains(&(report.inside + report.on_constraints)),
        "{report:?}"
    );
}

/// From 0 to 34 degrees by half a degree.
#[test]
fn it_always_ends() {
    let mut left = [0; 6];
    for (index, (name, points, segments)) in nasty().into_iter().enumerate() {
        for half in (0..=68).filter(|half| (half + index) % 9 == 0) {
            let degrees = f64::from(half as u32) / 2.0;
            let (_, refined) = refine(
                &points,
                &segments,
                Refinement::new(),
                Fill::All,
                degrees,
                &format!("{name} at {degrees}"),
            );
            for (count, reason) in left.iter_mut().zip(Reason::ALL) {
                *count += refined.report.left_for(reason);
            }
        }
    }
    assert!(left[0] > 0 && left[3] == 0 && left[4] == 0 && left[5] == 0, "{left:?}");
}

/// A test for each, so that they run at the same time.
fn ends_in_a_slit(gap: f64, how: Refinement) {
    let (points, segments) = slit(gap);
    let mut c = Constrained2::from_parts(&points, &segments).expect("planar");
    let refined = how.min_angle(33.0).run(&mut c).expect("an end");
    assert!(refined.report.left_for(Reason::Budget) > 0, "{gap}: {:?}", refined.report.inside);
}

#[test]
#[ignore = "long: a narrow gap"]
fn it_always_ends_in_a_slit() {
    ends_in_a_slit(1e-6, Refinement::new());
}

#[test]
#[ignore = "long: a narrower gap"]
fn it_always_ends_in_a_narrow_slit() {
    ends_in_a_slit(1e-9, Refinement::new().max_vertices(200_000));
}

#[test]
#[ignore = "long: a gap as narrow as a rounding error"]
fn it_always_ends_in_a_rounding_error() {
    ends_in_a_slit(f64::EPSILON, Refinement::new().max_vertices(200_000));
}

#[test]
#[ignore = "long: every angle"]
fn it_always_ends_at_whole_degrees() {
    at_angles((0..=34).map(f64::from));
}

#[test]
#[ignore = "long: every angle"]
fn it_always_ends_at_half_degrees() {
    at_angles((0..34).map(|degrees| f64::from(degrees) + 0.5));
}

fn at_angles(angles: impl Iterator<Item = f64>) {
    let inputs = nasty();
    for degrees in angles {
        for (name, points, segments) in &inputs {
            let name = format!("{name} at {degrees}");
            refine(points, segments, Refinement::new(), Fill::All, degrees, &name);
        }
    }
}

#[test]
#[ignore = "long: larger inputs"]
fn it_always_ends_on_large_inputs() {
    on_large_inputs(&[10.0, 25.0, 33.0]);
}

#[test]
#[ignore = "long: larger inputs"]
fn it_always_ends_on_large_inputs_at_other_angles() {
    on_large_inputs(&[20.0, 30.0, 34.0]);
}

fn on_large_inputs(angles: &[f64]) {
    for graph in Graph::ALL {
        let (points, segments) = graph.parts(1_000, 3);
        for &degrees in angles {
            let name = format!("{} at {degrees}", graph.name());
            refine(&points, &segments, Refinement::new(), Fill::All, degrees, &name);
        }
    }
}

#[test]
fn the_mesh_is_a_function_of_the_input() {
    let mut random = Random::new(5);
    for (name, points, segments) in nasty() {
        if Constrained2::from_parts(&points, &segments).is_err() {
            continue; // Splitting crossings is canonical by its own tests, and slow.
        }
        let whole = area(&Constrained2::from_parts(&points, &segments).expect("planar"), |_| true);
        for (how, degrees) in [
            (Refinement::new(), 31.0),
            (Refinement::new().conforming(true).max_area((whole / 300.0).max(1e-9)), 20.0),
            (Refinement::new().smooth(2), 27.0),
        ] {
            let (c, refined) = refine(&points, &segments, how, Fill::All, degrees, &name);
            let mut order: Vec<usize> = (0..points.len()).collect();
            random.shuffle(&mut order);
            let mut at = vec![0; points.len()];
            order.iter().enumerate().for_each(|(new, &old)| at[old] = new);
            let shuffled: Points = order.iter().map(|&i| points[i]).collect();
            let mut turned: Segments = segments.iter().map(|&[a, b]| [at[b], at[a]]).collect();
            random.shuffle(&mut turned);
            let (d, other) = refine(&shuffled, &turned, how, Fill::All, degrees, &name);
            assert_eq!(coordinates(&c, &refined), coordinates(&d, &other), "{name}");
            assert_eq!(refined.report.angles, other.report.angles, "{name}");
            // New vertices come in the same order, too.
            let new = |c: &Constrained2| c.points()[points.len()..].to_vec();
            assert_eq!(new(&c), new(&d), "{name}");
        }
    }
}
