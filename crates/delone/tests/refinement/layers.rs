//! Boundary layers: rows as high as was asked for, no cell missing, the rest of the mesh as good as without them, and the same for the same input.

use std::collections::BTreeMap;

use delone::{
    Constrained2, Error, Fill, Layers2, Refined2, Refinement, RegionSeed2, Seeds2, SegmentId, Triangulation,
    VertexId,
};
use delone_generators::Random;
use delone_oracle::all_cases;

use super::judge::{Points, Segments, area, corners, refine};
use super::nasty::nasty;

fn ring(points: &mut Points, segments: &mut Segments, corners: impl IntoIterator<Item = [f64; 2]>) {
    let first = points.len();
    points.extend(corners);
    let count = points.len() - first;
    segments.extend((0..count).map(|i| [first + i, first + (i + 1) % count]));
}

fn rings(all: Vec<Points>) -> (Points, Segments) {
    let (mut points, mut segments) = (Points::new(), Segments::new());
    all.into_iter().for_each(|corners| ring(&mut points, &mut segments, corners));
    (points, segments)
}

fn circle(count: usize, radius: f64, [x, y]: [f64; 2]) -> Points {
    let angle = |i: usize| std::f64::consts::TAU * i as f64 / count as f64;
    (0..count).map(|i| [x + radius * angle(i).cos(), y + radius * angle(i).sin()]).collect()
}

fn rectangle([x, y]: [f64; 2], [z, w]: [f64; 2]) -> Points {
    vec![[x, y], [z, y], [z, w], [x, w]]
}

/// A wing with a sharp tail.
fn wing() -> Points {
    let half = |x: f64| 0.6 * (0.2969 * x.sqrt() - x * (0.126 + x * (0.3516 - x * (0.2843 - x * 0.1036))));
    let x = |k: usize| 0.5 - 0.5 * (std::f64::consts::PI * k as f64 / 30.0).cos();
    let upper = (0..=30).rev().map(|k| [x(k), half(x(k))]);
    upper.chain((1..30).map(|k| [x(k), -half(x(k))])).collect()
}

fn ids(of: &[usize]) -> Vec<SegmentId> {
    of.iter().map(|&index| SegmentId::new(index)).collect()
}

/// The triangles of layers, and for each of their vertices the distance from a border.
fn distances(c: &Constrained2, refined: &Refined2, to: impl Fn([f64; 2]) -> f64) -> Vec<f64> {
    let inside = c.triangle_ids().filter(|&t| refined.domains.is_layer(t));
    let mut vertices: Vec<VertexId> = inside.flat_map(|t| c.mesh().corners(t)).collect();
    vertices.sort_unstable();
    vertices.dedup();
    vertices.into_iter().map(|v| to(c.point(v))).collect()
}

/// How many vertices are at each of some distances; all must be at one of them.
fn by_line(found: &[f64], heights: &[f64], error: f64) -> Vec<usize> {
    let mut counts = vec![0; heights.len()];
    for distance in found {
        let line = heights.iter().position(|height| (height - distance).abs() <= error);
        counts[line.unwrap_or_else(|| panic!("{distance} is no distance of {heights:?}"))] += 1;
    }
    counts
}

#[test]
fn rows_of_a_channel_go_from_inlet_to_outlet() {
    let (points, segments) = rings(vec![rectangle([0.0, 0.0], [6.0, 1.0])]);
    let layers = Layers2::new(0.01, 5).growth(1.4).on(ids(&[0, 2]));
    let heights = layers.heights();
    let how = Refinement::new().edge(0.2).layers(&layers);
    let (c, refined) = refine(&points, &segments, how, Fill::EvenOdd, 30.0, "channel");
    let report = &refined.report;
    assert!(report.left.is_empty() && report.smallest_angle > 32.0, "{report:?}");
    assert_eq!((report.layers.rows, report.layers.shortened), (5, 0));
    let found = distances(&c, &refined, |[_, y]| y.min(1.0 - y));
    let counts = by_line(&found, &heights, 1e-15);
    assert_eq!(counts, vec![report.layers.places; 6]);
    assert_eq!(report.layers.triangles, 2 * 5 * (report.layers.places - 2));
    assert_eq!(report.layers.vertices, 5 * report.layers.places);
    // Ribs are at right angles to the walls: each line has the same places.
    let mut at: BTreeMap<u64, usize> = BTreeMap::new();
    for v in c.vertices().filter(|&v| c.point(v)[1] < heights[5] + 1e-9) {
        *at.entry(c.point(v)[0].to_bits()).or_default() += 1;
    }
    assert!(at.values().all(|&count| count == 6), "{at:?}");
    let layer_area = area(&c, |t| refined.domains.is_layer(t));
    assert!((layer_area / (12.0 * heights[5]) - 1.0).abs() < 1e-13);
}

#[test]
fn rows_go_around_corners() {
    let (points, segments) = rings(vec![rectangle([0.0, 0.0], [1.0, 1.0])]);
    let layers = Layers2::new(0.01, 6).growth(1.3);
    let heights = layers.heights();
    let how = Refinement::new().edge(0.1).layers(&layers);
    let (c, refined) = refine(&points, &segments, how, Fill::EvenOdd, 30.0, "square");
    assert!(refined.report.layers.shortened == 0 && refined.report.left.is_empty());
    let found = distances(&c, &refined, |[x, y]| x.min(y).min(1.0 - x).min(1.0 - y));
    assert_eq!(by_line(&found, &heights, 1e-15), vec![refined.report.layers.places; 7]);
    let inner = 1.0 - 2.0 * heights[6];
    assert!((area(&c, |t| refined.domains.is_layer(t)) - (1.0 - inner * inner)).abs() < 1e-14);
    // A square hole: fans, whose lines are arcs.
    let (points, segments) =
        rings(vec![rectangle([-2.0, -2.0], [3.0, 3.0]), rectangle([0.0, 0.0], [1.0, 1.0])]);
    let layers = layers.on(ids(&[4, 5, 6, 7]));
    let how = Refinement::new().edge(0.2).layers(&layers);
    let (c, refined) = refine(&points, &segments, how, Fill::EvenOdd, 28.0, "hole");
    let beyond = |x: f64| (x - 1.0).max(-x).max(0.0);
    let found = distances(&c, &refined, |[x, y]| beyond(x).hypot(beyond(y)));
    let counts = by_line(&found, &heights, 1e-15);
    // Four corners with a fan of three ribs each.
    let [on_border, on_line] = [counts[0], counts[1]];
    assert!(on_line == on_border + 4 * 2 && counts[1..].iter().all(|&count| count == on_line), "{counts:?}");
    assert_eq!((refined.report.layers.shortened, refined.report.left.len()), (0, 0));
}

#[test]
fn rows_are_around_a_wing_and_in_a_disk() {
    let far = rectangle([-2.0, -2.0], [4.0, 2.0]);
    let (points, segments) = rings(vec![far, wing()]);
    let on: Vec<usize> = (4..segments.len()).collect();
    let layers = Layers2::new(0.001, 10).growth(1.3).on(ids(&on));
    let how = Refinement::new().edge(0.3).layers(&layers);
    let (c, refined) = refine(&points, &segments, how, Fill::EvenOdd, 25.0, "wing");
    let report = &refined.report;
    assert!(report.layers.shortened == 0 && report.left.is_empty(), "{report:?}");
    // Lines are at least as far as they are to be from all but the corners, where ribs are longer.
    let sides = &segments[4..];
    let at = |&[i, j]: &[usize; 2]| [points[i], points[j]];
    let found = distances(&c, &refined, |p| {
        let to = |side| to_segment(p, at(side)[0], at(side)[1]);
        sides.iter().map(to).fold(f64::INFINITY, f64::min)
    });
    let highest = found.iter().copied().fold(0.0, f64::max);
    assert!((1.0 - 1e-9..1.16).contains(&(highest / layers.heights()[10])), "{highest}");
    let (points, segments) = rings(vec![circle(64, 1.0, [0.0; 2]), circle(24, 0.2, [0.1, 0.0])]);
    for fill in [Fill::EvenOdd, Fill::All] {
        let layers = Layers2::new(0.01, 8).growth(1.2);
        let how = Refinement::new().edge(0.12).layers(&layers);
        let (_, refined) = refine(&points, &segments, how, fill, 25.0, "disk");
        assert!(
            refined.report.layers.shortened == 0 && refined.report.left.is_empty(),
            "{:?}",
            refined.report
        );
    }
}

fn to_segment(q: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (u, w) = ([b[0] - a[0], b[1] - a[1]], [q[0] - a[0], q[1] - a[1]]);
    let part = ((u[0] * w[0] + u[1] * w[1]) / (u[0] * u[0] + u[1] * u[1])).clamp(0.0, 1.0);
    (w[0] - part * u[0]).hypot(w[1] - part * u[1])
}

#[test]
fn there_are_fewer_rows_where_there_is_no_room() {
    // A channel that becomes a slot.
    let outline = vec![
        [0.0, 0.0],
        [2.0, 0.0],
        [2.0, 0.45],
        [4.0, 0.45],
        [4.0, 0.55],
        [2.0, 0.55],
        [2.0, 1.0],
        [0.0, 1.0],
    ];
    let (points, segments) = rings(vec![outline]);
    let layers = Layers2::new(0.01, 8).growth(1.2);
    let how = Refinement::new().edge(0.1).layers(&layers);
    let (c, refined) = refine(&points, &segments, how, Fill::EvenOdd, 20.0, "slot");
    let report = &refined.report.layers;
    assert!(report.rows == 8 && report.shortened > 0 && report.shortened < report.places, "{report:?}");
    let in_slot = c.triangle_ids().filter(|&t| refined.domains.is_layer(t));
    assert!(in_slot.filter(|&t| corners(&c, t).iter().all(|p| p[0] > 2.5)).count() > 0);
    // No room at all, and rows that are lost in rounding.
    let points: Points = points.iter().map(|p| p.map(|x| x + 1.0)).collect();
    for height in [0.5, 1e-18] {
        let layers = Layers2::new(height, 3);
        let how = Refinement::new().edge(0.1).layers(&layers);
        let (_, refined) = refine(&points, &segments, how, Fill::EvenOdd, 20.0, "none");
        let report = &refined.report.layers;
        assert!((report.rows, report.triangles) == (0, 0) && report.shortened == report.places, "{report:?}");
    }
    // A chain that ends at a wall that goes straight on.
    let (points, segments) = rings(vec![vec![[0.0, 0.0], [1.0, 0.0], [4.0, 0.0], [4.0, 2.0], [0.0, 2.0]]]);
    let layers = Layers2::new(0.01, 6).on(ids(&[1]));
    let how = Refinement::new().edge(0.1).layers(&layers);
    let (c, refined) = refine(&points, &segments, how, Fill::EvenOdd, 30.0, "plate");
    assert_eq!((refined.report.layers.rows, refined.report.layers.shortened), (6, 6));
    let found = distances(&c, &refined, |[_, y]| y);
    let counts = by_line(&found, &layers.heights(), 1e-15);
    assert!(counts.windows(2).all(|pair| pair[0] == pair[1] + 1), "one by one: {counts:?}");
}

#[test]
fn all_promises_hold_whatever_the_input() {
    for (name, points, segments) in nasty() {
        let low = |k: usize| points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
        let high = |k: usize| points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
        let size = (high(0) - low(0)).max(high(1) - low(1));
        for part in if all_cases() { vec![0.2, 0.01, 1e-4] } else { vec![0.01] } {
            let layers = Layers2::new(part * size, 4).growth(1.5);
            let name = format!("{name}, {part}");
            let how = Refinement::new().layers(&layers);
            refine(&points, &segments, how.edge(0.2 * size), Fill::EvenOdd, 28.0, &name);
            refine(&points, &segments, how, Fill::All, 20.0, &name);
        }
    }
}

#[test]
fn random_segments_get_rows_on_both_sides() {
    for seed in 0..if all_cases() { 200 } else { 25 } {
        let mut random = Random::new(seed);
        let mut points: Points = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        points.extend((0..3 + seed % 20).map(|_| [0.03 + 0.94 * random.unit(), 0.03 + 0.94 * random.unit()]));
        let all = Constrained2::from_parts(&points, &[]).expect("points");
        let kept = all.edges().map(|e| e.map(|v| v.index()));
        let segments: Segments = kept.filter(|_| random.unit() < 0.3).collect();
        let on: Vec<usize> = (0..segments.len()).filter(|_| random.unit() < 0.5).collect();
        let layers = Layers2::new(0.002, 6).on(ids(&on));
        let how = Refinement::new().edge(0.06).layers(&layers);
        let (_, refined) = refine(&points, &segments, how, Fill::All, 25.0, &format!("{seed}"));
        let report = &refined.report;
        assert!(on.is_empty() || report.layers.triangles > 0, "{seed}");
        assert!(report.left.len() * 20 < report.triangles + 100, "{seed}: {} left", report.left.len());
    }
}

/// All triangles with the parts that they are in, as bits in an order of geometry.
fn shape(c: &Constrained2, refined: &Refined2, map: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<[[u64; 2]; 4]> {
    let of = |t| {
        let mut bits = corners(c, t).map(|p| map(p).map(|x| (x + 0.0).to_bits()));
        bits.sort_unstable();
        [bits[0], bits[1], bits[2], [u64::from(refined.domains.is_layer(t)), 0]]
    };
    let mut all: Vec<_> = c.triangle_ids().filter(|&t| refined.domains.is_inside(t)).map(of).collect();
    all.sort_unstable();
    all
}

#[test]
fn layers_are_a_function_of_the_input() {
    let (points, segments) =
        rings(vec![rectangle([-1.0, -1.1], [2.0, 1.3]), wing(), circle(9, 0.2, [1.5, 0.9])]);
    let layers = Layers2::new(0.002, 7).growth(1.3);
    let run = |points: &[[f64; 2]], segments: &[[usize; 2]], scale: f64| {
        let mut c = Constrained2::from_parts(points, segments).expect("planar");
        let mut layers = layers.clone();
        layers.first_height *= scale;
        let how = Refinement::new().edge(0.2 * scale).min_angle(28.0).fill(Fill::EvenOdd).layers(&layers);
        let refined = how.run(&mut c).expect("refined");
        (c, refined)
    };
    let (c, refined) = run(&points, &segments, 1.0);
    let expected = shape(&c, &refined, |p| p);
    let mut random = Random::new(1);
    for _ in 0..3 {
        let mut order: Vec<usize> = (0..points.len()).collect();
        (1..order.len()).for_each(|k| order.swap(k, random.below(k + 1)));
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(new, &old)| place[old] = new);
        let moved: Points = order.iter().map(|&old| points[old]).collect();
        let mut other: Segments = segments.iter().rev().map(|&[i, j]| [place[j], place[i]]).collect();
        let half = other.len() / 2;
        other.rotate_left(half);
        let (d, again) = run(&moved, &other, 1.0);
        assert!(shape(&d, &again, |p| p) == expected);
        assert_eq!(again.report.layers, refined.report.layers);
    }
    for scale in [0.125, 4.0, 2.0_f64.powi(40)] {
        let scaled: Points = points.iter().map(|p| p.map(|x| x * scale)).collect();
        let (d, again) = run(&scaled, &segments, scale);
        assert!(shape(&d, &again, |p| p.map(|x| x / scale)) == expected, "{scale}");
    }
    // In a mirror constraints are divided from their other ends, at almost the same places.
    let mirrored: Points = points.iter().map(|&[x, y]| [-x, y]).collect();
    let (d, again) = run(&mirrored, &segments, 1.0);
    assert_eq!(again.report.layers, refined.report.layers);
    let of_layers = |c: &Constrained2, refined: &Refined2| -> Points {
        c.triangle_ids().filter(|&t| refined.domains.is_layer(t)).flat_map(|t| corners(c, t)).collect()
    };
    let others = of_layers(&d, &again);
    for [x, y] in of_layers(&c, &refined) {
        assert!(others.iter().any(|q| (q[0] + x).abs().max((q[1] - y).abs()) < 2e-3), "{x}, {y}");
    }
}

#[test]
fn regions_stay_and_meshes_are_refined_again() {
    let (points, mut segments) = rings(vec![rectangle([0.0, 0.0], [4.0, 2.0])]);
    let points: Points = points.into_iter().chain([[2.0, 0.0], [2.0, 2.0]]).collect();
    segments.push([4, 5]);
    let regions = vec![
        RegionSeed2::new([1.0, 1.0]).attribute(3.0),
        RegionSeed2::new([3.0, 1.0]).attribute(7.0).max_area(0.01),
    ];
    let seeds = Seeds2::default().regions(regions);
    let mut c = Constrained2::from_parts(&points, &segments).expect("planar");
    let layers = Layers2::new(0.01, 4);
    let how = Refinement::new().max_area(0.05).min_angle(25.0).fill(Fill::Seeds(&seeds));
    let refined = how.layers(&layers).run(&mut c).expect("refined");
    c.check().expect("valid");
    let own = |at: [f64; 2]| if at[0] < 2.0 { 3.0 } else { 7.0 };
    let middle = |t| {
        let [p, q, r] = corners(&c, t);
        [0, 1].map(|k| (p[k] + q[k] + r[k]) / 3.0)
    };
    for t in c.triangle_ids() {
        assert_eq!(refined.domains.attribute(t), Some(own(middle(t))));
    }
    let parts = refined.domains.parts();
    assert_eq!(parts.iter().filter(|part| part.is_layer).count(), 2);
    assert_eq!(parts.iter().map(|part| part.triangles).sum::<usize>(), c.simplex_count());
    // Once more, finer: the layers stay.
    let before = shape(&c, &refined, |p| p);
    let finer = Refinement::new().max_area(0.005).min_angle(25.0).fill(Fill::Parts(&refined.domains));
    let again = finer.run(&mut c).expect("refined");
    let after = shape(&c, &again, |p| p);
    let kept = |all: &[[[u64; 2]; 4]]| all.iter().filter(|t| t[3][0] == 1).copied().collect::<Vec<_>>();
    assert!(kept(&before) == kept(&after));
    assert_eq!(again.report.layers.triangles, refined.report.layers.triangles);
}

#[test]
fn bounds_of_vertices_hold() {
    let (points, segments) = rings(vec![rectangle([0.0, 0.0], [1.0, 1.0])]);
    for most in [0, 7, 50, 200, 1000] {
        let mut c = Constrained2::from_parts(&points, &segments).expect("planar");
        let layers = Layers2::new(0.001, 9);
        let how = Refinement::new().edge(0.05).max_vertices(most).layers(&layers);
        how.run(&mut c).expect("refined");
        c.check().expect("valid");
        assert!(c.vertex_count() <= 4 + most, "{most}: {}", c.vertex_count());
    }
}

#[test]
fn wrong_numbers_are_refused() {
    let (points, segments) = rings(vec![rectangle([0.0, 0.0], [1.0, 1.0])]);
    let good = Layers2::new(0.1, 2);
    let refused = [
        (Layers2::new(0.0, 2), "layer_height"),
        (Layers2::new(-1.0, 2), "layer_height"),
        (Layers2::new(f64::NAN, 2), "layer_height"),
        (Layers2::new(f64::INFINITY, 2), "layer_height"),
        (good.clone().growth(0.99), "layer_growth"),
        (good.clone().growth(f64::NAN), "layer_growth"),
        (Layers2::new(0.1, 0), "layer_count"),
        (Layers2::new(0.1, 2000), "layer_count"),
        (good.clone().thickness(0.0), "layer_thickness"),
        (good.clone().thickness(f64::NAN), "layer_thickness"),
    ];
    for (layers, expected) in refused {
        let mut c = Constrained2::from_parts(&points, &segments).expect("planar");
        let error = Refinement::new().layers(&layers).run(&mut c).expect_err("wrong");
        assert!(matches!(error, Error::Parameter { name, .. } if name == expected), "{error}");
        assert_eq!(c.vertex_count(), 4);
    }
    let mut c = Constrained2::from_parts(&points, &segments).expect("planar");
    let unknown = good.on(ids(&[1, 4]));
    let error = Refinement::new().layers(&unknown).run(&mut c).expect_err("unknown");
    assert_eq!(error, Error::NoSuchSegment { segment: 4 });
}
