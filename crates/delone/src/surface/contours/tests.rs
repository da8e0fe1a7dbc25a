//! Lines are simple, end at the border alone and never cross; bands tile the triangles; the result is that of the surface alone.

use delone_generators::{Kind, Random};
use delone_predicates::orient2d;

use super::{ContourBand, ContourLine, Contours, Levels};
use crate::{Delaunay2, Error};

/// Surfaces of all kinds: smooth, rough, with whole heights (so that many vertices are at levels), with plains.
fn surfaces() -> Vec<(String, Vec<[f64; 2]>, Vec<f64>)> {
    let mut all = Vec::new();
    for kind in [Kind::Uniform, Kind::Grid, Kind::Clusters, Kind::Circle] {
        for n in [3, 4, 12, 150] {
            let points = kind.points(n, n as u64);
            let mut random = Random::new(n as u64 + 7);
            let mut heights = |scale: f64| -> Vec<f64> {
                points.iter().map(|_| (random.below(1000) as f64 / 1000.0 * scale).floor()).collect()
            };
            let (whole, plain) = (heights(9.0), heights(2.5));
            let smooth = points.iter().map(|p| 4.0 + 4.0 * (7.0 * p[0]).sin() * (5.0 * p[1]).cos()).collect();
            for (name, z) in [("whole", whole), ("plain", plain), ("smooth", smooth)] {
                all.push((format!("{} {n} {name}", kind.name()), points.clone(), z));
            }
        }
    }
    // Lattices that are turned, with hulls of slivers an ulp wide.
    for (degrees, offset) in [(1.0, 0.0), (17.0, 0.0), (30.0, 5e6), (45.0, 0.0), (61.0, 5e5)] {
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        let at = |i: u32| [f64::from(i % 12), f64::from(i / 12)];
        let turn = |[x, y]: [f64; 2]| [offset + cos * x - sin * y, offset + sin * x + cos * y];
        let height = |[x, y]: [f64; 2]| 4.0 + 4.0 * (0.7 * x).sin() * (0.5 * y).cos();
        let points: Vec<_> = (0..144).map(|i| turn(at(i))).collect();
        let smooth: Vec<_> = (0..144).map(|i| height(at(i))).collect();
        let whole = smooth.iter().map(|z| z.floor()).collect();
        all.push((format!("turned {degrees} smooth"), points.clone(), smooth));
        all.push((format!("turned {degrees} whole"), points, whole));
    }
    all
}

fn levels() -> Levels {
    Levels::given(&[-1.0, 1.0, 2.0, 2.5, 3.0, 5.25, 8.0]).expect("levels")
}

/// Twice the area inside of a ring.
fn twice_area(ring: &[[f64; 2]]) -> f64 {
    let [x, y] = ring[0];
    let corner = |i: usize| [ring[i % ring.len()][0] - x, ring[i % ring.len()][1] - y];
    (0..ring.len()).map(|i| corner(i)[0] * corner(i + 1)[1] - corner(i)[1] * corner(i + 1)[0]).sum()
}

fn sides(line: &ContourLine) -> Vec<[[f64; 2]; 2]> {
    let mut sides: Vec<_> = line.points.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    if line.is_closed {
        sides.push([line.points[line.points.len() - 1], line.points[0]]);
    }
    sides
}

/// Whether two segments meet strictly inside of both.
fn cross([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let side = |p, q, r| orient2d(p, q, r);
    let apart = |x: delone_predicates::Sign, y: delone_predicates::Sign| {
        x.is_positive() && y.is_negative() || x.is_negative() && y.is_positive()
    };
    apart(side(a, b, c), side(a, b, d)) && apart(side(c, d, a), side(c, d, b))
}

#[test]
fn lines_are_simple_and_do_not_cross() {
    for (name, points, heights) in surfaces() {
        let d = Delaunay2::from_points(&points).expect("finite");
        let lines = Contours::new(&d, &heights).and_then(|c| c.lines(&levels())).expect("lines");
        let all: Vec<_> = lines.iter().flat_map(sides).collect();
        for (i, &a) in all.iter().enumerate() {
            assert_ne!(a[0], a[1], "{name}");
            assert!(all[..i].iter().all(|&b| !cross(a, b)), "{name}: lines cross");
        }
        let hull: Vec<[f64; 2]> = d.hull_vertices().map(|v| d.point(v)).collect();
        let largest = points.as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        for line in &lines {
            let mut keys: Vec<_> = line.points.iter().map(|p| p.map(f64::to_bits)).collect();
            keys.sort_unstable();
            keys.dedup();
            assert_eq!(keys.len(), line.points.len(), "{name}: a point twice");
            if line.is_closed {
                assert!(line.points.len() >= 3, "{name}");
                continue;
            }
            for end in [line.points[0], line.points[line.points.len() - 1]] {
                let near = |i: usize| {
                    let (p, q) = (hull[i], hull[(i + 1) % hull.len()]);
                    let away = (q[0] - p[0]) * (end[1] - p[1]) - (q[1] - p[1]) * (end[0] - p[0]);
                    // Coordinates are rounded.
                    let rounding = 2.0 * f64::EPSILON * largest;
                    away.abs() <= rounding * ((q[0] - p[0]).abs() + (q[1] - p[1]).abs())
                };
                assert!((0..hull.len()).any(near), "{name}: a line ends inside");
            }
        }
    }
}

#[test]
fn the_higher_ground_is_on_the_left() {
    let d = Delaunay2::from_points(&Kind::Uniform.points(200, 3)).expect("finite");
    let heights: Vec<f64> = d.points().iter().map(|p| -(p[0] - 0.5).hypot(p[1] - 0.5)).collect();
    let lines = Contours::new(&d, &heights).and_then(|c| c.lines(&Levels::given(&[-0.3])?)).expect("a hill");
    let ring = lines.iter().find(|line| line.is_closed).expect("around the top");
    assert!(twice_area(&ring.points) > 0.0);
}

#[test]
fn bands_tile_the_triangles() {
    for (name, points, heights) in surfaces() {
        let d = Delaunay2::from_points(&points).expect("finite");
        // All triangles, and those that a filter leaves.
        for step in [1, 3] {
            let kept = |t: crate::TriangleId| step == 1 || !t.index().is_multiple_of(step);
            let surface = Contours::of_triangles(&d, &heights, kept).expect("heights");
            let area: f64 = d.triangle_ids().filter(|&t| kept(t)).map(|t| d.area(t)).sum();
            let bands = surface.bands(&levels()).expect("bands");
            let rings = bands.iter().flat_map(|band| &band.polygons).flatten();
            let sum: f64 = rings.map(|ring| twice_area(ring) / 2.0).sum();
            assert!((sum - area).abs() <= 1e-9 * area, "{name} {step}: {sum}, not {area}");
            check_bands(&bands, &name);
            assert!(bands.windows(2).all(|pair| pair[0].upper <= pair[1].lower), "{name}");
        }
    }
}

/// A pit whose rim is at a level and has nothing around it: above the level is the rim alone.
#[test]
fn a_rim_is_no_band() {
    let d = Delaunay2::from_points(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [1.0, 1.0]]).expect("finite");
    let bands = Contours::new(&d, &[1.0, 1.0, 1.0, 0.0])
        .and_then(|c| c.bands(&Levels::given(&[1.0])?))
        .expect("a pit");
    assert_eq!(bands.len(), 1, "{bands:?}");
    assert_eq!(
        (bands[0].upper, bands[0].polygons.len(), bands[0].polygons[0].len()),
        (1.0, 1, 1),
        "{bands:?}"
    );
}

/// A ridge at a level between two slopes below it: the slopes are one area, without a seam.
#[test]
fn a_ridge_is_no_seam() {
    let d = Delaunay2::from_points(&[[-2.0, 0.0], [2.0, 0.0], [0.0, -1.0], [0.0, 1.0]]).expect("finite");
    let surface = Contours::new(&d, &[-1.0, -1.0, 0.0, 0.0]).expect("heights");
    let at = Levels::given(&[0.0]).expect("a level");
    let bands = surface.bands(&at).expect("bands");
    let around = vec![vec![vec![[-2.0, 0.0], [0.0, -1.0], [2.0, 0.0], [0.0, 1.0]]]];
    assert_eq!(bands, [ContourBand { lower: f64::NEG_INFINITY, upper: 0.0, polygons: around }]);
    assert_eq!(surface.lines(&at).expect("lines"), []);
}

/// Sides of one band are there once, in one direction; sides of all bands do not cross, and no ring comes to a point twice.
#[test]
fn bands_have_no_seams_and_do_not_cross() {
    for (name, points, heights) in surfaces() {
        let d = Delaunay2::from_points(&points).expect("finite");
        let bands = Contours::new(&d, &heights).and_then(|c| c.bands(&levels())).expect("bands");
        let mut all = Vec::new();
        for band in &bands {
            let mut own = Vec::new();
            for ring in band.polygons.iter().flatten() {
                let mut keys: Vec<_> = ring.iter().map(|p| p.map(f64::to_bits)).collect();
                keys.sort_unstable();
                keys.dedup();
                assert_eq!(keys.len(), ring.len(), "{name}: a point twice");
                own.extend((0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]]));
            }
            let key = |[p, q]: [[f64; 2]; 2]| [p, q].map(|p| p.map(f64::to_bits));
            let mut keys: Vec<_> = own.iter().flat_map(|&[p, q]| [key([p, q]), key([q, p])]).collect();
            keys.sort_unstable();
            assert!(keys.windows(2).all(|pair| pair[0] != pair[1]), "{name}: a seam");
            all.extend(own);
        }
        for (i, &a) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|&b| !cross(a, b)), "{name}: bands cross");
        }
    }
}

fn check_bands(bands: &[ContourBand], name: &str) {
    for polygon in bands.iter().flat_map(|band| &band.polygons) {
        let whole = twice_area(&polygon[0]);
        assert!(whole > 0.0, "{name}: clockwise");
        let holes: f64 = polygon[1..].iter().map(|hole| twice_area(hole)).sum();
        assert!(polygon[1..].iter().all(|hole| twice_area(hole) < 0.0) && -holes < whole, "{name}: holes");
        for hole in &polygon[1..] {
            let inside = |q: &[f64; 2]| polygon[0].contains(q) || super::loops::holds(&polygon[0], *q);
            let outside = hole.iter().filter(|q| !inside(q)).count();
            assert!(outside < hole.len(), "{name}: a hole is outside");
        }
    }
}

/// The sides of bands are the lines, in both directions, and nothing else inside of the border.
#[test]
fn bands_meet_in_lines() {
    let points = Kind::Uniform.points(300, 9);
    let heights: Vec<f64> =
        points.iter().map(|p| 4.0 + 4.0 * (9.0 * p[0]).sin() * (8.0 * p[1]).cos()).collect();
    let d = Delaunay2::from_points(&points).expect("finite");
    let surface = Contours::new(&d, &heights).expect("heights");
    let lines = surface.lines(&levels()).expect("lines");
    let bands = surface.bands(&levels()).expect("bands");
    let mut sides: Vec<_> = lines.iter().flat_map(sides).collect();
    let key = |[p, q]: [[f64; 2]; 2]| [p, q].map(|p| p.map(f64::to_bits));
    sides.sort_by_key(|&side| key(side));
    let rings = bands.iter().flat_map(|band| &band.polygons).flatten();
    let mut uses = vec![0; sides.len()];
    for ring in rings {
        for (i, &p) in ring.iter().enumerate() {
            let q = ring[(i + 1) % ring.len()];
            for side in [[p, q], [q, p]] {
                if let Ok(at) = sides.binary_search_by_key(&key(side), |&side| key(side)) {
                    uses[at] += 1;
                }
            }
        }
    }
    assert!(uses.iter().all(|&n| n == 2), "each line is a side of two bands");
}

#[test]
fn order_and_numbers_do_not_show() {
    for (name, points, heights) in surfaces() {
        let n = points.len();
        let turned = |i: usize| (i * 7 + 3) % n;
        if n.is_multiple_of(7) {
            continue;
        }
        let result = |points: &[[f64; 2]], heights: &[f64]| {
            let d = Delaunay2::from_points(points).expect("finite");
            // Of equal points the first is the vertex: those are for the caller to decide.
            let surface = Contours::new(&d, heights).expect("heights");
            (d.duplicates().count(), surface.lines(&levels()), surface.bands(&levels()))
        };
        let other: Vec<[f64; 2]> = (0..n).map(|i| points[turned(i)]).collect();
        let others: Vec<f64> = (0..n).map(|i| heights[turned(i)]).collect();
        let (a, b) = (result(&points, &heights), result(&other, &others));
        assert!(a.0 > 0 || a == b, "{name}");
    }
}

#[test]
fn plains_at_a_level_are_above_it() {
    let points: Vec<[f64; 2]> = (0..25).map(|i| [f64::from(i % 5), f64::from(i / 5)]).collect();
    let d = Delaunay2::from_points(&points).expect("finite");
    let at = Levels::given(&[2.0]).expect("a level");
    // All at the level: no line, one band.
    let surface = Contours::new(&d, &[2.0; 25]).expect("heights");
    assert_eq!(surface.lines(&at).expect("lines"), []);
    let bands = surface.bands(&at).expect("bands");
    assert_eq!((bands.len(), bands[0].lower, bands[0].upper), (1, 2.0, f64::INFINITY));
    assert_eq!(
        bands[0].polygons[0],
        [[
            [0.0, 0.0],
            [1.0, 0.0],
            [2.0, 0.0],
            [3.0, 0.0],
            [4.0, 0.0],
            [4.0, 1.0],
            [4.0, 2.0],
            [4.0, 3.0],
            [4.0, 4.0],
            [3.0, 4.0],
            [2.0, 4.0],
            [1.0, 4.0],
            [0.0, 4.0],
            [0.0, 3.0],
            [0.0, 2.0],
            [0.0, 1.0]
        ]]
    );
    // A plateau of nine vertices: a line along its border. A peak and a ridge: none.
    let inside = |i: usize| (1..4).contains(&(i % 5)) && (1..4).contains(&(i / 5));
    let heights = |is_high: &dyn Fn(usize) -> bool| {
        (0..25).map(|i| if is_high(i) { 2.0 } else { 0.0 }).collect::<Vec<_>>()
    };
    let lines = |z: &[f64]| Contours::new(&d, z).and_then(|c| c.lines(&at)).expect("lines");
    let plateau = lines(&heights(&inside));
    assert_eq!((plateau.len(), twice_area(&plateau[0].points)), (1, 8.0));
    assert_eq!(lines(&heights(&|i| i == 12)), []);
    assert_eq!(lines(&heights(&|i| i == 11 || i == 12)), []);
}

#[test]
fn what_is_wrong_is_named() {
    let d = Delaunay2::from_points(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]).expect("finite");
    let error = |heights: &[f64]| Contours::new(&d, heights).map(|_| ()).expect_err("refused");
    assert_eq!(error(&[1.0; 2]), Error::Values { expected: 3, found: 2 });
    assert!(matches!(error(&[1.0, f64::NAN, 2.0]), Error::Height { index: 1, .. }));
    assert!(matches!(error(&[1.0, 2.0, f64::INFINITY]), Error::Height { index: 2, .. }));
    // Heights and coordinates at the end of the numbers.
    let far = [[-1e308, -1e308], [1e308, -1e308], [0.0, 1e308]];
    let d = Delaunay2::from_points(&far).expect("finite");
    let lines = Contours::new(&d, &[-1e308, 1e308, 1.0])
        .and_then(|c| c.lines(&Levels::given(&[0.5])?))
        .expect("a line");
    assert_eq!(lines.len(), 1);
    assert!(lines[0].points.as_flattened().iter().all(|x| x.is_finite()));
    // No triangles, no contours.
    let line = Delaunay2::from_points(&[[0.0, 0.0], [1.0, 1.0]]).expect("finite");
    let surface = Contours::new(&line, &[0.0, 2.0]).expect("heights");
    assert_eq!((surface.range(), surface.lines(&levels()).expect("none").len()), (None, 0));
    assert_eq!(surface.bands(&levels()).expect("none"), []);
}

#[test]
fn levels_on_one_edge_are_in_order() {
    // A steep edge far from the origin: a hundred levels within few units in the last place.
    let points = [[5e5, 5e6], [5e5 + 1e-8, 5e6 + 1e-9], [5e5, 5e6 + 1.0]];
    let d = Delaunay2::from_points(&points).expect("finite");
    let levels: Vec<f64> = (1..100).map(f64::from).collect();
    let levels = Levels::given(&levels).expect("levels");
    let lines = Contours::new(&d, &[0.0, 100.0, 0.0]).and_then(|c| c.lines(&levels)).expect("lines");
    let xs: Vec<f64> = lines.iter().map(|line| line.points[line.points.len() - 1][0]).collect();
    assert!(xs.is_sorted() || xs.iter().rev().is_sorted(), "{xs:?}");
}

/// Slivers whose contours rounding lays over each other, and peaks so high that most contours are in one place.
#[test]
fn rounding_takes_nothing_away() {
    let sets: [&[([f64; 2], f64)]; 3] = [
        &[
            ([0.0, 0.600_000_000_000_000_1], -0.335_225_121_536_340_2),
            ([0.5, 0.1], -0.139_011_717_472_513_84),
            ([-0.2, -0.1], -0.423_928_440_115_801),
            ([0.1, 0.5], -0.791_436_932_929_251_7),
        ],
        &[
            ([4.0, -8.0], -1.491_949_815_669_938_8e231),
            ([-1.0, -1.0], 3.919_978_121_066_352e36),
            ([-8.0, -1.0], -1.270_795_143_182_943_3e-213),
            ([6.0, 4.0], -1.814_748_882_517_37e-191),
            ([6.0, -1.0], -1.350_128_513_359_763_6e-225),
            ([-6.0, -1.0], -3.056_765_052_017_385e-152),
        ],
        &[
            ([0.0, -0.2], 7.472_143_945_040_289e86),
            ([-0.2, -0.2], -4.034_913_496_296_375_7e220),
            ([0.2, 0.0], -2.278_700_466_914_862_8e-231),
            ([0.1, 0.0], 3.494_188_295_145_534e-297),
            ([0.1, 0.1], 7.565_270_066_254_337e143),
        ],
    ];
    for set in sets {
        let mut random = Random::new(1);
        let mut levels: Vec<f64> = set.iter().map(|sample| sample.1).collect();
        levels.extend([-0.49, -0.34, -0.18, -1.27e231, -1e231, -4.3e230, -1e220, 1e86]);
        let levels = Levels::given(&levels).expect("finite");
        let mut first = None;
        let mut set = set.to_vec();
        for turn in 0..40 {
            let (points, heights): (Vec<_>, Vec<_>) = set.iter().copied().unzip();
            let d = Delaunay2::from_points(&points).expect("finite");
            let surface = Contours::new(&d, &heights).expect("heights");
            let bands = surface.bands(&levels).expect("bands");
            let area: f64 = d.triangle_ids().map(|t| d.area(t)).sum();
            let of_bands: f64 = bands
                .iter()
                .flat_map(|band| band.polygons.iter().flatten())
                .map(|ring| twice_area(ring) / 2.0)
                .sum();
            assert!((of_bands - area).abs() < 1e-12 * area, "{turn}: {of_bands} of {area}");
            let found = (surface.lines(&levels).expect("lines"), bands);
            assert_eq!(first.get_or_insert_with(|| found.clone()), &found, "{set:?}");
            random.shuffle(&mut set);
        }
    }
}
