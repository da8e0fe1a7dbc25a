//! Meshes of a wanted length of edges: as uniform as was promised, the angles proven, the same for the same input, an end whatever is asked.

use delone::{
    Constrained2, Crossings, Error, Fill, Keep, Reason, Refined2, Refinement, RegionSeed2, Seeds2, Shapes2,
};
use delone_generators::Random;
use delone_oracle::all_cases;

use super::judge::{Points, Segments, coordinates, corners, judge, refine};
use super::nasty::{nasty, wedge};

fn ring(points: &mut Points, segments: &mut Segments, corners: impl IntoIterator<Item = [f64; 2]>) {
    let first = points.len();
    points.extend(corners);
    let count = points.len() - first;
    segments.extend((0..count).map(|i| [first + i, first + (i + 1) % count]));
}

fn circle(count: usize, radius: f64, center: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    (0..count).map(move |i| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / count as f64).sin_cos();
        [center[0] + radius * cos, center[1] + radius * sin]
    })
}

/// Plane geometries of engineering, with the length that is wanted.
fn geometries() -> Vec<(&'static str, Points, Segments, f64)> {
    let mut all = Vec::new();
    let mut add = |name, length, rings: Vec<Points>| {
        let (mut points, mut segments) = (Points::new(), Segments::new());
        rings.into_iter().for_each(|corners| ring(&mut points, &mut segments, corners));
        all.push((name, points, segments, length));
    };
    let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    add("square", 0.04, vec![square.clone()]);
    let angle = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    add("angle", 0.1, vec![angle]);
    add("disk", 0.05, vec![circle(120, 1.0, [0.0; 2]).collect()]);
    let inner = circle(80, 0.55, [0.4, 0.0]).collect();
    add("eccentric", 0.05, vec![circle(120, 1.0, [0.0; 2]).collect(), inner]);
    let tooth = |k: usize| {
        [(-0.28, 1.0), (-0.17, 1.12), (-0.06, 1.125), (0.06, 1.125), (0.17, 1.12), (0.28, 1.0)].map(
            |(a, radius)| {
                let (sin, cos) = ((k as f64 + a) * std::f64::consts::TAU / 24.0).sin_cos();
                [radius * cos, radius * sin]
            },
        )
    };
    add("gear", 0.05, vec![(0..24).flat_map(tooth).collect(), circle(48, 0.4, [0.0; 2]).collect()]);
    let holes = (0..100).map(|k| {
        let center = [0.05 + 0.1 * f64::from(k % 10), 0.05 + 0.1 * f64::from(k / 10)];
        circle(24, 0.025, center).collect()
    });
    add("plate", 0.02, std::iter::once(square).chain(holes).collect());
    all
}

#[test]
fn triangles_are_nearly_equilateral_and_as_large_as_was_asked() {
    for (name, points, segments, length) in geometries() {
        let how = Refinement::new().edge(length);
        let (c, refined) = refine(&points, &segments, how, Fill::EvenOdd, 30.0, name);
        let Shapes2 { quality_mean, quality_p5, step_p95, .. } = Shapes2::of(&c, &refined.domains);
        assert!(
            quality_mean > 0.978 && quality_p5 > 0.925 && step_p95 < 1.45,
            "{name}: {quality_mean}, {step_p95}"
        );
        assert!(refined.report.left.is_empty() && refined.report.smallest_angle > 32.0, "{name}");
        let inside = c.triangle_ids().filter(|&t| refined.domains.is_inside(t));
        let edges = inside.flat_map(|t| [0, 1, 2].map(|k| c.segment(t.edge(k))));
        let mut lengths: Vec<f64> = edges.map(|[a, b]| (b[0] - a[0]).hypot(b[1] - a[1]) / length).collect();
        lengths.sort_by(f64::total_cmp);
        let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
        // Holes and teeth ask for shorter ones.
        let is_plain = ["square", "angle", "disk"].contains(&name);
        assert!(!is_plain || (0.95..1.05).contains(&mean), "{name}: {mean}");
        assert!(lengths[lengths.len() * 19 / 20] < 1.25 && lengths[lengths.len() - 1] < 1.6, "{name}");
        assert!(!is_plain || lengths[lengths.len() / 20] > 0.85, "{name}");
    }
}

/// All that is true of any refined mesh, of inputs with every fault.
#[test]
fn promises_hold_whatever_the_input() {
    for (name, points, segments) in nasty() {
        let low = |k: usize| points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
        let high = |k: usize| points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
        let size = (high(0) - low(0)).max(high(1) - low(1));
        for &part in if all_cases() { &[0.7, 0.2, 0.06][..] } else { &[0.2] } {
            for fill in [Fill::All, Fill::EvenOdd] {
                let how = Refinement::new().edge(part * size);
                refine(&points, &segments, how, fill, 28.0, &format!("{name}, {part}, {fill:?}"));
            }
        }
    }
}

/// Only triangles between two segments that meet at a small angle may be as sharp as these.
#[test]
fn small_angles_of_the_input_make_no_others() {
    for seed in 0..if all_cases() { 300 } else { 40 } {
        let mut random = Random::new(seed);
        let mut points: Points = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        points.extend((0..3 + seed % 20).map(|_| [0.03 + 0.94 * random.unit(), 0.03 + 0.94 * random.unit()]));
        // Some edges of a triangulation: none cross.
        let all = Constrained2::from_parts(&points, &[]).expect("points");
        let kept = all.edges().map(|e| e.map(|v| v.index()));
        let segments: Segments = kept.filter(|_| random.unit() < 0.4).collect();
        let before = Constrained2::from_parts(&points, &segments).expect("planar");
        let mut c = before.clone();
        let refined = Refinement::new().min_angle(30.0).edge(0.06).run(&mut c).expect("refined");
        judge(&before, &c, &refined, 30.0, &format!("{seed}"));
        let others = refined.report.left.iter().filter(|left| left.reason != Reason::InputAngle).count();
        assert_eq!(others, 0, "{seed}");
        for left in &refined.report.left {
            assert!(
                is_between_segments(&c, corners(&c, left.triangle)),
                "{seed}: {:?}",
                corners(&c, left.triangle)
            );
        }
    }
}

/// Whether each end of the shortest side of a triangle is on one of two segments that meet at less than 60 degrees, or it has that corner.
fn is_between_segments(c: &Constrained2, corners: [[f64; 2]; 3]) -> bool {
    let length = |[p, q]: [[f64; 2]; 2]| (q[0] - p[0]).hypot(q[1] - p[1]);
    let sides = [0, 1, 2].map(|k| [corners[k], corners[(k + 1) % 3]]);
    let shortest = sides.into_iter().min_by(|p, q| length(*p).total_cmp(&length(*q))).expect("three");
    let is_on = |q: [f64; 2], [a, b]: [[f64; 2]; 2]| {
        let off = (b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0]);
        off.abs() < 1e-12 && (0..2).all(|k| (a[k].min(b[k])..=a[k].max(b[k])).contains(&q[k]))
    };
    let lines: Vec<_> = c.segments().map(|(_, ends)| ends.map(|v| c.point(v))).collect();
    let on = |q: [f64; 2]| lines.iter().filter(|line| is_on(q, **line)).copied().collect::<Vec<_>>();
    let pairs = on(shortest[0]).into_iter().flat_map(|p| on(shortest[1]).into_iter().map(move |q| (p, q)));
    pairs.filter(|(p, q)| p != q).any(|(p, q)| {
        let Some(&tip) = p.iter().find(|end| q.contains(end)) else { return false };
        let [u, v] = [p, q].map(|line| {
            let end = if line[0] == tip { line[1] } else { line[0] };
            [end[0] - tip[0], end[1] - tip[1]]
        });
        u[0] * v[0] + u[1] * v[1] > 0.5 * u[0].hypot(u[1]) * v[0].hypot(v[1])
    })
}

#[test]
fn the_mesh_is_a_function_of_the_input() {
    let mut random = Random::new(5);
    let mut sets: Vec<_> = geometries().into_iter().filter(|set| set.0 != "plate").collect();
    let (points, segments) = wedge(7.0, 0.7, true);
    sets.push(("wedge", points, segments, 0.2));
    for (name, points, segments, length) in sets {
        let how = Refinement::new().edge(length).growth(1.3);
        let run = |points: &Points, segments: &Segments| {
            let (c, refined) = refine(points, segments, how, Fill::EvenOdd, 30.0, name);
            coordinates(&c, &refined)
        };
        let expected = run(&points, &segments);
        for _ in 0..3 {
            let mut order: Vec<usize> = (0..points.len()).collect();
            random.shuffle(&mut order);
            let mut rank = vec![0; order.len()];
            order.iter().enumerate().for_each(|(new, &old)| rank[old] = new);
            let moved: Points = order.iter().map(|&old| points[old]).collect();
            let mut renamed: Segments = segments.iter().map(|s| s.map(|v| rank[v])).collect();
            random.shuffle(&mut renamed);
            renamed.iter_mut().filter(|_| random.unit() < 0.5).for_each(|s| s.reverse());
            assert_eq!(run(&moved, &renamed), expected, "{name}");
        }
        let thrice: Segments = segments.iter().flat_map(|&s| [s, s, [s[1], s[0]]]).collect();
        assert_eq!(run(&points, &thrice), expected, "{name}: repeated");
    }
}

#[test]
fn lengths_may_differ_by_place() {
    let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let length = |[x, y]: [f64; 2]| 0.01 + 0.2 * x.hypot(y);
    let how = Refinement::new().edge_at(&length);
    let (c, refined) = refine(&square, &[], how, Fill::All, 30.0, "graded");
    let shapes = Shapes2::of(&c, &refined.domains);
    assert!(shapes.quality_mean > 0.95 && refined.report.left.is_empty(), "{shapes:?}");
    let near = c.vertices().filter(|&v| c.point(v)[0].hypot(c.point(v)[1]) < 0.1).count();
    assert!(near > 15 && c.vertex_count() < 300, "{near} of {}", c.vertex_count());

    // A jump by a factor of a thousand: it grows on both sides.
    let jump = |[x, _]: [f64; 2]| if (0.499..0.501).contains(&x) { 0.001 } else { 1.0 };
    let how = Refinement::new().edge_at(&jump);
    let (c, refined) = refine(&square, &[], how, Fill::All, 30.0, "jump");
    assert!(refined.report.left.is_empty() && c.vertex_count() > 150, "{}", c.vertex_count());
}

#[test]
fn bounds_regions_and_what_is_kept_count_too() {
    let (_, points, segments, length) = geometries().remove(3);
    for (name, how) in [
        ("edge", Refinement::new().edge(length).max_edge(0.06)),
        ("area", Refinement::new().edge(10.0 * length).max_area(0.001)),
    ] {
        let (c, refined) = refine(&points, &segments, how, Fill::EvenOdd, 30.0, name);
        assert!(refined.report.left.is_empty(), "{name}");
        let inside = || c.triangle_ids().filter(|&t| refined.domains.is_inside(t));
        assert!(name == "edge" || inside().all(|t| c.area(t) <= 0.001));
        let edges = inside().flat_map(|t| [0, 1, 2].map(|k| c.segment(t.edge(k))));
        let longest = edges.map(|[a, b]| (b[0] - a[0]).hypot(b[1] - a[1])).fold(0.0, f64::max);
        assert!(name == "area" || longest <= 0.06, "{longest}");
        assert!(Shapes2::of(&c, &refined.domains).quality_mean > 0.95, "{name}");
    }
    for keep in [Keep::Border, Keep::Constraints] {
        let how = Refinement::new().edge(0.02).keep(keep);
        let (c, refined) = refine(&points, &segments, how, Fill::EvenOdd, 30.0, "kept");
        assert_eq!((refined.report.on_constraints, c.constraints().count()), (0, segments.len()));
        assert!(refined.report.inside > 2000);
    }
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let how = Refinement::new().edge(0.05).keep(Keep::Constraints);
    let (_, refined) = refine(&square, &[], how, Fill::All, 30.0, "whole sides");
    assert!(refined.report.triangles > 500, "{}", refined.report.triangles);
    let fine = RegionSeed2::new([-0.9, 0.0]).max_area(0.0002);
    let seeds = Seeds2::default().regions(vec![fine, RegionSeed2::new([0.4, 0.0])]);
    let how = Refinement::new().edge(0.1);
    let (c, refined) = refine(&points, &segments, how, Fill::Seeds(&seeds), 30.0, "regions");
    let domains = &refined.domains;
    let region = |k: usize| c.triangle_ids().filter(move |&t| domains.region(t) == Some(k));
    assert!(region(0).all(|t| c.area(t) <= 0.0002) && region(1).any(|t| c.area(t) > 0.002));
}

#[test]
fn it_ends_where_it_is_told_to() {
    let square: Points = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let before = Constrained2::from_parts(&square, &[]).expect("points");
    let run = |how: Refinement| {
        let mut c = before.clone();
        let made = how.run(&mut c);
        c.check().expect("valid");
        (c, made)
    };
    for most in [0, 1, 50, 1000] {
        let (c, made) = run(Refinement::new().edge(0.01).max_vertices(most));
        assert!(made.is_ok() && c.vertex_count() <= 4 + most, "{most}");
    }
    let count = std::cell::Cell::new(0);
    let stop = || count.replace(count.get() + 1) == 5;
    assert_eq!(
        run(Refinement::new().edge(0.002).stop_if(&stop)).1.map(|made| made.report),
        Err(Error::Stopped)
    );
    for bad in [0.0, -1.0, f64::NAN] {
        let at = |[x, _]: [f64; 2]| if x > 0.5 { bad } else { 0.1 };
        assert!(matches!(run(Refinement::new().edge_at(&at)).1, Err(Error::Size { .. })), "{bad}");
        assert!(
            matches!(run(Refinement::new().edge(bad)).1, Err(Error::Parameter { name: "edge", .. })),
            "{bad}"
        );
        let how = Refinement::new().edge(0.1).growth(bad);
        assert!(matches!(run(how).1, Err(Error::Parameter { name: "growth", .. })), "{bad}");
    }
    assert!(matches!(run(Refinement::new().edge(1e-9)).1, Err(Error::Parameter { name: "edge", .. })));
    // Nothing to divide, and lengths without a bound.
    for length in [10.0, f64::INFINITY, f64::MAX] {
        let (c, made) = run(Refinement::new().min_angle(0.0).edge(length));
        assert!(made.is_ok() && c.vertex_count() == 4, "{length}");
    }
    for points in [vec![], vec![[1.0, 1.0]], vec![[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]] {
        let mut c = Constrained2::from_parts(&points, &[]).expect("points");
        assert!(Refinement::new().edge(0.1).run(&mut c).is_ok());
    }
}

/// Constraints are divided whatever their direction, however much longer than their parts, and where sizes are least on them.
#[test]
fn borders_have_all_their_vertices() {
    let turned = |degrees: f64| -> Points {
        let (sin, cos) = degrees.to_radians().sin_cos();
        [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]]
            .map(|[x, y]: [f64; 2]| [x * cos - y * sin, x * sin + y * cos])
            .to_vec()
    };
    let least = |[x, y]: [f64; 2]| 0.3 + 0.2 * (x - 50.0).hypot(y);
    for degrees in [0.0, 7.0, 36.87, 45.0, 71.0] {
        for length in [0.9, 3.3, 10.1] {
            let how = Refinement::new().edge(length);
            let name = format!("{degrees}, {length}");
            let (c, refined) = refine(&turned(degrees), &[], how, Fill::All, 30.0, &name);
            assert!(refined.report.left.is_empty(), "{name}");
            let parts =
                c.constraint_edges().map(|e| c.segment(e)).map(|[a, b]| (b[0] - a[0]).hypot(b[1] - a[1]));
            assert!(parts.map(|part| part / length).all(|part| (0.8..1.3).contains(&part)), "{name}");
        }
    }
    let (c, refined) = refine(&turned(0.0), &[], Refinement::new().edge_at(&least), Fill::All, 30.0, "least");
    assert!(refined.report.left.is_empty());
    for [a, b] in c.constraint_edges().map(|e| c.segment(e)) {
        let middle = [0, 1].map(|k| 0.5 * (a[k] + b[k]));
        assert!((b[0] - a[0]).hypot(b[1] - a[1]) < 1.4 * least(middle), "{a:?}, {b:?}");
    }
    // A long strip takes no longer than its triangles.
    let strip = vec![[0.0, 0.0], [2000.0, 0.0], [2000.0, 1.0], [0.0, 1.0]];
    let (_, refined) = refine(&strip, &[], Refinement::new().edge(1.0), Fill::All, 30.0, "strip");
    assert!((3900..4700).contains(&refined.report.triangles), "{}", refined.report.triangles);
}

/// Where squares of lengths leave the range of numbers nothing is divided, and that is told.
#[test]
fn lengths_without_squares_are_left() {
    for scale in [2.0_f64.powi(-600), 1e-320, 1e200, 1e300] {
        let points = [[0.0, 0.0], [scale, 0.0], [scale, scale], [0.0, scale]];
        let mut c = Constrained2::from_parts(&points, &[]).expect("points");
        let made = Refinement::new().edge(0.1 * scale).run(&mut c).expect("refined");
        assert_eq!(made.report.left_for(Reason::Precision), made.report.triangles, "{scale}");
    }
}

/// A mesh that exists may be made finer, and keeps its vertices; one that is fine enough stays as it is, whatever the lengths of its edges.
#[test]
fn a_mesh_is_made_finer() {
    let (_, points, segments, length) = geometries().remove(1);
    let mut c = Constrained2::with_crossings(&points, &segments, Crossings::Split).expect("planar");
    let how = |length| Refinement::new().min_angle(28.0).edge(length);
    let first: Refined2 = how(2.0 * length).fill(Fill::EvenOdd).run(&mut c).expect("coarse");
    let before = c.clone();
    let again = how(length).fill(Fill::Parts(&first.domains)).run(&mut c).expect("fine");
    judge(&before, &c, &again, 28.0, "finer");
    assert!(again.report.triangles > 3 * first.report.triangles && again.report.left.is_empty());
    let (mut c, first) =
        refine(&points, &segments, Refinement::new().max_area(0.003), Fill::EvenOdd, 28.0, "areas");
    let again = how(2.0 * length).fill(Fill::Parts(&first.domains)).run(&mut c).expect("as it is");
    assert_eq!([again.report.inside, again.report.on_constraints], [0; 2]);
}

/// Angles that are tried only change what they must.
#[test]
fn steeper_angles_are_tried_once() {
    let (_, points, segments, length) = geometries().remove(1);
    let how = Refinement::new().edge(length);
    let count = |degrees| refine(&points, &segments, how, Fill::EvenOdd, degrees, "steep").1.report.triangles;
    let [plain, steep] = [30.0, 37.0].map(count);
    assert!(steep >= plain && 10 * steep < 11 * plain, "{plain}, then {steep}");
}
