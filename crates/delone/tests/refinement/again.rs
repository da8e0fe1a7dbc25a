//! A mesh is refined again: it starts from its triangles, and keeps what is inside.

use delone::{Constrained2, Crossings, Error, Fill, Reason, Refined2, Refinement, RegionSeed2, Seeds2};
use delone_generators::Random;

use super::judge::{Points, area, coordinates, judge};

/// Slanted hull edges and segments that cross, so that new vertices on them are rounded.
fn crossing(seed: u64) -> Constrained2 {
    let mut random = Random::new(seed);
    let points: Points = (0..120).map(|_| [random.unit(), random.unit()]).collect();
    let segments: Vec<[usize; 2]> = (0..24).map(|_| [random.below(120), random.below(120)]).collect();
    Constrained2::with_crossings(&points, &segments, Crossings::Split).expect("finite")
}

fn is_inside_area(c: &Constrained2, refined: &Refined2) -> f64 {
    area(c, |t| refined.domains.is_inside(t))
}

#[test]
fn the_same_angle_of_nothing_changes_nothing() {
    let seeds = Seeds2::default().keep_concavities(true);
    for seed in 0..6 {
        for fill in [Fill::All, Fill::Seeds(&seeds)] {
            let mut c = crossing(seed);
            let first = Refinement::new().min_angle(25.0).fill(fill).run(&mut c).expect("refined");
            let mut d = c.clone();
            let how = Refinement::new().min_angle(0.0).fill(Fill::Parts(&first.domains));
            let again = how.run(&mut d).expect("refined");
            judge(&c, &d, &again, 0.0, &format!("{seed}, {fill:?}"));
            assert_eq!(coordinates(&c, &first), coordinates(&d, &again));
            let angles = |refined: &Refined2| (refined.report.smallest_angle, refined.report.largest_angle);
            assert_eq!(angles(&first), angles(&again), "{seed}, {fill:?}");
        }
    }
}

/// Small angles of the input are left as they are, and not cut into smaller ones.
#[test]
fn what_is_good_stays_as_it_is() {
    for seed in 0..6 {
        let mut c = crossing(seed);
        let first = Refinement::new().min_angle(25.0).run(&mut c).expect("refined");
        assert_eq!(first.report.left.len(), first.report.left_for(Reason::InputAngle));
        for degrees in [25.0, 24.0, 15.0, 5.0] {
            let how = Refinement::new().min_angle(degrees).fill(Fill::Parts(&first.domains));
            let again = how.run(&mut c).expect("refined");
            assert_eq!([again.report.inside, again.report.on_constraints], [0; 2], "{seed} at {degrees}");
            assert!(
                again.report.left.iter().all(|left| first.report.left.contains(left)),
                "{seed} at {degrees}"
            );
        }
    }
}

#[test]
fn it_gets_finer_and_ends() {
    for seed in 0..6 {
        let mut c = crossing(seed);
        let mut refined = Refinement::new().min_angle(10.0).run(&mut c).expect("refined");
        let before = is_inside_area(&c, &refined);
        for degrees in [20.0, 15.0, 30.0, 25.0] {
            let mut d = c.clone();
            let how = Refinement::new().min_angle(degrees).fill(Fill::Parts(&refined.domains));
            refined = how.run(&mut d).expect("refined");
            judge(&c, &d, &refined, degrees, &format!("{seed} at {degrees}"));
            c = d;
            let after = is_inside_area(&c, &refined);
            assert!((before - after).abs() <= 1e-12, "{seed} at {degrees}: area {before} became {after}");
        }
        let mut once = crossing(seed);
        Refinement::new().min_angle(30.0).run(&mut once).expect("refined");
        let [all, one] = [&c, &once].map(|c| c.vertex_count() as f64);
        assert!(all < 1.5 * one, "{seed}: {all} vertices rather than {one}");
    }
}

/// A border that bends past a seed leaves the seed in another part.
#[test]
fn seeds_are_not_asked_again() {
    let (mut bent, mut random) = (0, Random::new(7));
    for _ in 0..200 {
        let [x, y] = [random.unit(), random.unit()];
        let points = [[0.0, 0.0], [x, y], [-y, x]];
        let segments = [[0, 1], [1, 2], [2, 0]];
        let mut c = Constrained2::from_parts(&points, &segments).expect("a triangle");
        let at = [0, 1].map(|k| points.iter().map(|p| p[k] / 3.0).sum());
        // Every middle of a side is a seed too, if it is inside.
        let middles = segments.map(|[i, j]| [0, 1].map(|k| f64::midpoint(points[i][k], points[j][k])));
        let mut regions = vec![RegionSeed2::new(at).attribute(3.0).max_area(1e-2)];
        regions.extend(middles.map(|at| RegionSeed2::new(at).attribute(4.0)));
        regions.retain(|seed| c.domains(&Fill::EvenOdd).and_then(|mut d| c.claim(&mut d, &[*seed])).is_ok());
        bent += regions.len() - 1;
        let seeds = Seeds2::default().regions(regions);
        let first = Refinement::new().fill(Fill::Seeds(&seeds)).run(&mut c).expect("refined");
        let how = Refinement::new().min_angle(0.0).fill(Fill::Parts(&first.domains));
        let again = how.run(&mut c).expect("refined again");
        assert_eq!(again.report.triangles, first.report.triangles);
        assert!(again.report.left.is_empty(), "the area of the region holds");
        let attributes = c.triangle_ids().filter_map(|t| again.domains.attribute(t));
        assert_eq!(attributes.filter(|&value| value == 3.0).count(), again.report.triangles);
    }
    assert!(bent > 10, "{bent} seeds are beside sides");
}

/// Borders on the hull that bend outwards have triangles beyond, which bays beside them see.
#[test]
fn borders_that_bend_outwards_are_no_trouble() {
    let points = [[999.0, 1000.0], [1000.0, 1001.0], [1001.0, 999.0], [999.0, 1003.0]];
    let segments = [[0, 1], [2, 1], [2, 0]];
    for fill in [Fill::EvenOdd, Fill::NonZero] {
        let mut c = Constrained2::from_parts(&points, &segments).expect("planar");
        let how = Refinement::new().min_angle(25.0).max_area(0.02);
        let first = how.fill(fill).run(&mut c).expect("refined");
        let count = c.vertex_count();
        let again = how.fill(Fill::Parts(&first.domains)).run(&mut c).expect("refined again");
        assert_eq!((again.report.triangles, c.vertex_count()), (first.report.triangles, count));
    }
}

#[test]
fn parts_of_another_triangulation_are_refused() {
    let mut c = crossing(1);
    let old = c.domains(&Fill::All).expect("parts");
    let other = crossing(2).domains(&Fill::All).expect("parts");
    let before = c.points().to_vec();
    assert_eq!(c.domains(&Fill::Parts(&other)), Err(Error::Parts));
    let run = |c: &mut Constrained2, parts| Refinement::new().fill(Fill::Parts(parts)).run(c).map(|_| ());
    assert_eq!(run(&mut c, &other), Err(Error::Parts));
    assert_eq!(c.points(), before);
    assert_eq!(run(&mut c, &old), Ok(()));
    assert_eq!(run(&mut c, &old), Err(Error::Parts));
}

#[test]
fn regions_are_claimed_whatever_is_inside() {
    let square = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [3, 3], [1, 3]];
    let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]];
    let c = Constrained2::from_parts(&square, &segments).expect("planar");
    let mut domains = c.domains(&Fill::EvenOdd).expect("rings");
    let seed = |x: f64, attribute| RegionSeed2::new([x, 2.0]).attribute(attribute);
    c.claim(&mut domains, &[seed(0.5, 5.0), seed(2.0, 6.0), seed(0.25, 7.0)]).expect("seeds");
    assert_eq!(domains.rivals(), [[0, 2]]);
    for t in c.triangle_ids() {
        assert_eq!(domains.attribute(t), Some(if domains.is_inside(t) { 5.0 } else { 6.0 }));
    }
    assert!(matches!(
        c.claim(&mut domains, &[seed(9.0, 1.0)]),
        Err(Error::Seed { what: "region", index: 0, .. })
    ));
    assert!(c.triangle_ids().all(|t| domains.region(t).is_none()));
    c.claim(&mut domains, &[]).expect("nothing");
    assert!(domains.rivals().is_empty());
}
