//! STL, whose numbers have single precision: no triangle turns over, closed surfaces stay closed, and what is left out is told.

use std::collections::HashMap;

use delone::{Delaunay2, Delaunay3};
use delone_generators::{Kind3, Random};
use delone_io::{Format, Mesh, Remark, picture, write_mesh};

/// Corners in single precision.
type Facet = [[f32; 3]; 3];

/// The triangles of a binary file, by what its format says.
fn facets(content: &[u8]) -> Vec<Facet> {
    let number = |at: usize| f32::from_le_bytes([0, 1, 2, 3].map(|k| content[at + k]));
    let corner = |at: usize| [0, 4, 8].map(|k| number(at + k));
    let count = u32::from_le_bytes([80, 81, 82, 83].map(|k| content[k])) as usize;
    assert_eq!(content.len(), 84 + 50 * count);
    (0..count).map(|i| [12, 24, 36].map(|k| corner(84 + 50 * i + k))).collect()
}

/// Twice the area seen from above: single precision makes products exact in double precision, but for their sum.
fn seen_from_above([a, b, c]: &Facet) -> f64 {
    let side = |p: &[f32; 3], axis: usize| f64::from(p[axis]) - f64::from(a[axis]);
    side(b, 0) * side(c, 1) - side(b, 1) * side(c, 0)
}

fn of_plane(points: &[[f64; 3]]) -> (Vec<Facet>, String, usize, Remark) {
    let (flat, heights): (Vec<_>, Vec<_>) = points.iter().map(|&[x, y, z]| ([x, y], z)).unzip();
    let d = Delaunay2::from_points(&flat).expect("finite");
    let mesh = Mesh { heights: Some(&heights), ..Mesh::new(&d, &flat) };
    let mut content = Vec::new();
    let remark = write_mesh(&mut content, Format::Stl, &mesh, &picture::Options::default()).expect("written");
    let title = String::from_utf8_lossy(&content[..80]).trim_end().to_owned();
    (facets(&content), title, d.triangle_count(), remark)
}

/// A walk in degrees, where a metre is a hundred thousandth, with heights in metres.
fn track() -> Vec<[f64; 3]> {
    let mut random = Random::new(3);
    let mut p = [7.62, 51.96, 60.0];
    let step = |random: &mut Random, size: f64| random.between(-size, size);
    let walk = (0..900).map(|_| {
        p = [p[0] + step(&mut random, 4e-5), p[1] + step(&mut random, 2e-5), p[2] + step(&mut random, 1.0)];
        [(p[0] * 1e6).round() / 1e6, (p[1] * 1e6).round() / 1e6, p[2]]
    });
    walk.collect()
}

#[test]
fn each_axis_is_moved_by_its_own_extent() {
    let points = track();
    let (facets, title, triangles, remark) = of_plane(&points);
    assert_eq!(facets.len(), triangles, "{remark:?}");
    assert!(facets.iter().all(|facet| seen_from_above(facet) > 0.0));
    let words: Vec<f64> = title.split(' ').skip(3).map(|word| word.parse().expect("a number")).collect();
    let [x, y, z] = words[..] else { panic!("{title}") };
    assert!((-7.63..-7.6).contains(&x) && (-52.0..-51.9).contains(&y) && z == 0.0, "{title}");
    let remark = remark.expect("it was moved");
    assert!(remark.starts_with(&format!("moved by {x:?}, {y:?}, {z:?}, because")), "{remark}");
    // Moved back, every corner is a point, but for a millionth of the extent.
    for corner in facets.as_flattened() {
        let back = [f64::from(corner[0]) - x, f64::from(corner[1]) - y, f64::from(corner[2])];
        let is_near = |p: &[f64; 3]| (0..3).all(|k| (p[k] - back[k]).abs() < [1e-8, 1e-8, 1e-4][k]);
        assert!(points.iter().any(is_near), "{back:?}");
    }
}

#[test]
fn what_became_flat_or_turned_over_is_left_out_of_surfaces() {
    // A turned lattice: triangles along its border are as thin as doubles are fine.
    let (sin, cos) = 0.3_f64.sin_cos();
    let turned = |i: usize| {
        let (x, y) = ((i % 25) as f64, (i / 25) as f64);
        [x * cos - y * sin, x * sin + y * cos, (x * y).sin()]
    };
    let points: Vec<_> = (0..625).map(turned).collect();
    let (facets, _, triangles, remark) = of_plane(&points);
    assert!(facets.len() < triangles && facets.len() >= 2 * 24 * 24);
    assert!(facets.iter().all(|facet| seen_from_above(facet) > 0.0));
    let remark = remark.expect("some are left out");
    let left_out = triangles - facets.len();
    assert!(remark.contains(&format!("{left_out} of {triangles} triangles are left out")), "{remark}");
}

#[test]
fn closed_surfaces_stay_closed() {
    let mut points = Kind3::Sphere.points(400, 5);
    // Neighbors that single precision does not tell apart, or hardly.
    let near: Vec<_> =
        points.iter().take(60).enumerate().map(|(i, p)| p.map(|x| x * (1.0 + 1e-9 * i as f64))).collect();
    let beside: Vec<_> = points.iter().skip(60).take(60).map(|&[x, y, z]| [x + 3e-8, y - 3e-8, z]).collect();
    points.extend(near);
    points.extend(beside);
    let d = Delaunay3::from_points(&points).expect("finite");
    let mut content = Vec::new();
    let mesh = Mesh::new(&d, &points);
    let remark = write_mesh(&mut content, Format::Stl, &mesh, &picture::Options::default()).expect("written");
    let (facets, all) = (facets(&content), d.hull_facets().count());
    let mut sides: HashMap<[[u32; 3]; 2], i32> = HashMap::new();
    for facet in &facets {
        // Zero has two signs.
        let corners = facet.map(|p| p.map(|x| (x + 0.0).to_bits()));
        for k in 0..3 {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            assert_ne!(from, to);
            *sides.entry([from.min(to), from.max(to)]).or_default() += if from < to { 1 } else { -1 };
        }
    }
    assert!(sides.values().all(|&sum| sum == 0), "open");
    let remark = remark.expect("some corners are one point");
    let left_out = all - facets.len();
    assert!(
        left_out > 0 && remark.contains(&format!("{left_out} of {all} triangles are left out")),
        "{remark}"
    );
}

#[test]
fn what_has_no_number_in_single_precision_is_told() {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 1e39]];
    let (facets, _, triangles, remark) = of_plane(&points);
    assert_eq!((facets.len(), triangles), (1, 2));
    assert_eq!(remark.as_deref(), Some("1 of 2 triangles are left out: STL has no numbers above 3.4e38"));
    let (facets, title, ..) = of_plane(&points.map(|[x, y, _]| [x, y, 0.0]));
    assert_eq!((facets.len(), &*title), (2, "delone"));
}
