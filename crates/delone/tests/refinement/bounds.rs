//! Bounds of sizes and numbers, constraints that are kept, and what cannot be.

use std::collections::BTreeSet;

use delone::{Constrained2, Error, Fill, Keep, Reason, Refinement, RegionSeed2, Seeds2};
use delone_generators::Random;
use delone_oracle::exact;

use super::judge::{Points, Segments, coordinates, corners, judge, refine};

fn square() -> (Points, Segments) {
    let points = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [1.0, 1.0], [3.0, 1.0], [2.0, 3.0]];
    (points, vec![[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]])
}

#[test]
fn bounds_hold() {
    let (points, segments) = square();
    let edges = |c: &Constrained2, t| {
        let [p, q, r] = corners(c, t);
        [(p, q), (q, r), (r, p)].map(|(a, b): ([f64; 2], [f64; 2])| (b[0] - a[0]).hypot(b[1] - a[1]))
    };
    for smooth in [0, 3] {
        let how = Refinement::new().smooth(smooth);
        let (c, refined) = refine(&points, &segments, how.max_area(0.01), Fill::EvenOdd, 30.0, "area");
        let inside = || c.triangle_ids().filter(|&t| refined.domains.is_inside(t));
        assert!(inside().all(|t| c.area(t) <= 0.01) && refined.report.left.is_empty());
        assert!(inside().count() > 1400 && inside().count() < 4200);

        let (c, refined) = refine(&points, &segments, how.max_edge(0.2), Fill::EvenOdd, 25.0, "edge");
        let inside = || c.triangle_ids().filter(|&t| refined.domains.is_inside(t));
        assert!(inside().flat_map(|t| edges(&c, t)).all(|length| length <= 0.2));

        let size = |[x, y]: [f64; 2]| 0.05 + 0.2 * x.hypot(y);
        let (c, refined) = refine(&points, &segments, how.size(&size), Fill::EvenOdd, 25.0, "size");
        let inside = || c.triangle_ids().filter(|&t| refined.domains.is_inside(t));
        for t in inside() {
            let [p, q, r] = corners(&c, t);
            let center = [0, 1].map(|k| (p[k] + q[k] + r[k]) / 3.0);
            assert!(edges(&c, t).into_iter().all(|length| length <= size(center) * (1.0 + 1e-12)));
        }
        let near = inside().filter(|&t| corners(&c, t)[0][0] < 1.0).count();
        assert!(inside().count() > near && 3 * near > inside().count(), "small where small is wanted");

        let at = |[x, _]: [f64; 2]| if x < 2.0 { 0.01 } else { f64::INFINITY };
        let (c, refined) = refine(&points, &segments, how.max_area_at(&at), Fill::EvenOdd, 25.0, "area at");
        let inside = || c.triangle_ids().filter(|&t| refined.domains.is_inside(t));
        assert!(inside().all(|t| c.area(t) <= 0.01 || corners(&c, t).iter().any(|p| p[0] > 2.0)));
    }
}

/// However far below the distances of the input.
#[test]
fn small_sizes_are_reached() {
    let (points, segments) = (vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], Vec::new());
    let size = |_: [f64; 2]| 0.008;
    for (name, how) in [
        ("area", Refinement::new().max_area(3e-5)),
        ("edge", Refinement::new().max_edge(0.008)),
        ("size", Refinement::new().size(&size)),
    ] {
        let (c, refined) = refine(&points, &segments, how, Fill::All, 25.0, name);
        assert!(refined.report.left.is_empty() && c.triangle_count() > 30_000, "{name}");
    }
    // Where a border may not be split, too, as far as that goes.
    let how = Refinement::new().max_area(1e-4).keep(Keep::Border);
    let (c, refined) = refine(&points, &segments, how, Fill::All, 25.0, "kept");
    assert!(c.triangle_count() > 5_000 && refined.report.left.len() < 500);
}

#[test]
fn it_can_be_stopped() {
    let (points, segments) = square();
    let mut c = Constrained2::from_parts(&points, &segments).expect("planar");
    let asked = std::cell::Cell::new(0);
    let stop = || asked.replace(asked.get() + 1) == 3;
    let told = std::cell::RefCell::new(Vec::new());
    let watch = |count| told.borrow_mut().push(count);
    let stopped = Refinement::new().max_area(1e-6).stop_if(&stop).watch(&watch).run(&mut c);
    assert_eq!(stopped.map(|refined| refined.report), Err(Error::Stopped));
    assert!(asked.get() == 4 && c.vertex_count() > 100 && c.vertex_count() < 10_000);
    let told = told.into_inner();
    assert!(told.len() == 4 && told.is_sorted() && 7 + told[3] == c.vertex_count(), "{told:?}");
    c.check().expect("valid");
}

#[test]
fn regions_have_areas_of_their_own() {
    let (points, segments) = square();
    let region = |at, max_area| RegionSeed2::new(at).attribute(7.0).max_area(max_area);
    let seeds =
        Seeds2::default().regions(vec![region([0.5, 0.5], Some(0.05)), region([2.0, 1.5], Some(0.002))]);
    let (c, refined) = refine(&points, &segments, Refinement::new(), Fill::Seeds(&seeds), 28.0, "regions");
    for t in c.triangle_ids() {
        let most = [0.05, 0.002][refined.domains.region(t).expect("everything is in one")];
        assert!(c.area(t) <= most);
    }
    let parts = refined.domains.parts();
    assert_eq!(parts.iter().map(|part| part.triangles).sum::<usize>(), c.triangle_count());
    let most = Refinement::new().max_area(0.01);
    let (c, _) = refine(&points, &segments, most, Fill::Seeds(&seeds), 28.0, "both");
    assert!(c.triangle_ids().all(|t| c.area(t) <= 0.01));
}

#[test]
fn constraints_are_kept_where_they_are_to_be() {
    let (points, segments) = square();
    let before = Constrained2::from_parts(&points, &segments).expect("planar");
    for (keep, kept) in [(Keep::Border, 7), (Keep::Constraints, 7)] {
        let how = Refinement::new().keep(keep).max_area(0.05);
        let (c, refined) = refine(&points, &segments, how, Fill::EvenOdd, 30.0, "kept");
        assert_eq!((c.constraints().count(), refined.report.on_constraints), (kept, 0));
        assert!(refined.report.left_for(Reason::Kept) > 0);
        assert!(refined.report.inside > 0, "{keep:?}");
        let ends = |c: &Constrained2| c.constraints().collect::<BTreeSet<_>>();
        assert_eq!(ends(&before), ends(&c));
    }
    // The triangle is not on the border of all of the square.
    let how = Refinement::new().keep(Keep::Border).max_area(0.05);
    let (c, _) = refine(&points, &segments, how, Fill::All, 30.0, "border");
    let on_border = c.hull_vertices().count();
    assert!(on_border == 4 && c.constraints().count() > 7);
}

#[test]
fn a_budget_is_kept() {
    let (points, segments) = square();
    for most in [0, 1, 10, 100] {
        let how = Refinement::new().max_area(0.001).max_vertices(most);
        let (_, refined) = refine(&points, &segments, how, Fill::All, 33.0, "budget");
        assert_eq!(refined.report.inside + refined.report.on_constraints, most);
        assert!(refined.report.left_for(Reason::Budget) > 0);
    }
    // What cannot be is tried only with a budget.
    let (_, refined) =
        refine(&points, &segments, Refinement::new().max_vertices(500), Fill::All, 50.0, "impossible");
    assert!(refined.report.left_for(Reason::Budget) > 0);
}

#[test]
fn what_is_fine_stays() {
    let (points, segments) = square();
    let (mut c, first) = refine(&points, &segments, Refinement::new(), Fill::EvenOdd, 30.0, "first");
    let before = c.clone();
    let again = Refinement::new().min_angle(30.0).fill(Fill::EvenOdd).run(&mut c).expect("again");
    assert_eq!(again.report.inside + again.report.on_constraints, 0);
    assert_eq!(coordinates(&before, &first), coordinates(&c, &again));
    let finer =
        Refinement::new().min_angle(32.0).max_area(0.1).fill(Fill::EvenOdd).run(&mut c).expect("finer");
    judge(&before, &c, &finer, 32.0, "finer");
    // It can be changed as ever.
    c.insert([0.123, 0.456]).expect("finite");
    let v = c.vertices().last().expect("some");
    c.remove(v).expect("free");
    for s in c.segments().map(|(s, _)| s).collect::<Vec<_>>() {
        c.remove_segment(s).expect("there");
        c.check().expect("canonical");
    }
    assert_eq!(c.constraints().count(), 0);
}

#[test]
fn markers_follow_chains() {
    let (points, segments) = square();
    let (c, _) = refine(&points, &segments, Refinement::new().max_edge(0.3), Fill::EvenOdd, 20.0, "markers");
    for e in c.constraint_edges() {
        let covering = c.covering(e);
        assert_eq!(covering.len(), 1);
        let (_, ends) = c.segments().nth(covering[0].segment.index()).expect("there");
        let [p, q] = ends.map(|v| c.point(v));
        assert!(c.segment(e).iter().all(|x| exact::orient2d(p, q, *x) == 0 || x[0].fract() != 0.0));
    }
}

#[test]
fn what_cannot_be_is_an_error() {
    let (points, segments) = square();
    let c = Constrained2::from_parts(&points, &segments).expect("planar");
    let parameter = |how: Refinement, expected: &str| {
        let mut d = c.clone();
        match how.run(&mut d) {
            Err(Error::Parameter { name, .. }) => assert_eq!(name, expected),
            other => panic!("{expected}: {other:?}"),
        }
        assert_eq!(d.points(), c.points());
    };
    for degrees in [60.0, -1.0, f64::NAN, f64::INFINITY] {
        parameter(Refinement::new().min_angle(degrees), "min_angle");
    }
    parameter(Refinement::new().min_angle(60.0).max_vertices(10), "min_angle");
    for bad in [0.0, -1.0, f64::NAN] {
        parameter(Refinement::new().max_area(bad), "max_area");
        parameter(Refinement::new().max_edge(bad), "max_edge");
        let size = |_: [f64; 2]| bad;
        for how in [Refinement::new().size(&size), Refinement::new().max_area_at(&size)] {
            let mut d = c.clone();
            let error = how.run(&mut d).expect_err("no size");
            assert!(
                matches!(error, Error::Size { value, .. } if value.to_bits() == bad.to_bits()),
                "{error:?}"
            );
            d.check().expect("valid all the same");
        }
    }
    // More triangles than there can be; their squares may be no numbers.
    for tiny in [1e-20, 1e-200, 5e-324] {
        parameter(Refinement::new().max_area(tiny), "max_area");
        parameter(Refinement::new().max_edge(tiny), "max_edge");
        let mut d = c.clone();
        Refinement::new().max_edge(tiny).max_vertices(1000).run(&mut d).expect("a budget");
        assert_eq!(d.points().len(), 1007);
    }
    let infinite = |_: [f64; 2]| f64::INFINITY;
    let mut d = c.clone();
    Refinement::new().size(&infinite).run(&mut d).expect("no bound");
    let seeds = Seeds2::default().holes(vec![[0.0, 0.0]]);
    assert!(matches!(Refinement::new().fill(Fill::Seeds(&seeds)).run(&mut d), Err(Error::Seed { .. })));
}

#[test]
fn below_the_plane_there_is_nothing_to_refine() {
    for points in
        [vec![], vec![[1.0, 2.0]], vec![[0.0, 0.0], [1.0, 1.0]], vec![[0.0, 0.0], [1.0, 1.0], [3.0, 3.0]]]
    {
        let segments: Segments = (1..points.len()).map(|i| [0, i]).collect();
        for fill in [Fill::All, Fill::EvenOdd] {
            let mut c = Constrained2::from_parts(&points, &segments).expect("finite");
            let refined = Refinement::new().max_area(0.1).fill(fill).run(&mut c).expect("nothing to do");
            assert_eq!((refined.report.triangles, c.vertex_count()), (0, points.len()));
            c.check().expect("canonical");
        }
    }
}

/// Where squares leave the range of numbers nothing can be measured, and that is said.
#[test]
fn sizes_at_the_ends_of_the_range() {
    for scale in [1e-300, 1e-150, 1e-100, 1e100, 1e150, 1e300] {
        let (points, segments) = square();
        let points: Points = points.iter().map(|p| p.map(|x| scale * x)).collect();
        let before = Constrained2::from_parts(&points, &segments).expect("finite");
        let mut c = before.clone();
        let refined = Refinement::new().min_angle(30.0).run(&mut c).expect("an end");
        c.check().expect("canonical");
        let is_measured = (1e-130..1e130).contains(&scale);
        assert_eq!(refined.report.left.is_empty(), is_measured, "{scale:e}");
        assert_eq!(refined.report.left.len(), refined.report.left_for(Reason::Precision));
        if is_measured {
            judge(&before, &c, &refined, 30.0, &format!("{scale:e}"));
        }
        let mut c = before;
        let how = Refinement::new().conforming(true).max_vertices(1000);
        how.run(&mut c).expect("whatever can be measured");
        c.check().expect("canonical");
    }
}

/// More than 34 degrees are tried: they are reached, or the report says that vertices were used up.
#[test]
fn steeper_angles_are_tried() {
    let square = [[0, 0], [1, 0], [1, 1], [0, 1]];
    for (degrees, is_reached) in [(34.3, true), (45.0, false), (59.9, false)] {
        let mut c = Constrained2::from_parts(&square, &[]).expect("a square");
        let how = Refinement::new().max_area(0.01);
        let steepest = how.min_angle(34.0).run(&mut c.clone()).expect("an end").report;
        let report = how.min_angle(degrees).run(&mut c).expect("an end").report;
        assert_eq!(report.inside + report.on_constraints + square.len(), c.vertex_count());
        assert_eq!(report.left.is_empty(), is_reached, "{degrees} degrees: {:?}", report.left);
        assert!(report.smallest_angle >= degrees || report.left_for(Reason::Budget) > 0);
        assert!(c.vertex_count() <= 2 * (steepest.inside + steepest.on_constraints + square.len()));
    }
}

/// At a few units in the last place circumcenters are rounded out of their circles. What is left is not for an angle of the input.
#[test]
fn what_no_vertex_mends_is_left_for_precision() {
    let mut random = Random::new(7);
    for _ in 0..200 {
        let coordinate = |random: &mut Random| 4_503_599_627_370_496.0 + random.below(16) as f64;
        let points: Points = (0..40).map(|_| [(); 2].map(|()| coordinate(&mut random))).collect();
        let mut c = Constrained2::from_parts(&points, &[]).expect("finite");
        let how = Refinement::new().min_angle(45.0).max_vertices(2000);
        let report = how.run(&mut c).expect("an end").report;
        let is_on = |v| c.mesh().star(v).any(|e| c.is_constraint(e));
        for left in report.left.iter().filter(|left| left.reason == Reason::InputAngle) {
            let on = c.mesh().corners(left.triangle).into_iter().filter(|&v| is_on(v)).count();
            assert!(on >= 2, "{:?} is left for an angle of the input", corners(&c, left.triangle));
        }
    }
}
