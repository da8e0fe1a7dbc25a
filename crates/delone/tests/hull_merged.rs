//! Hulls without what rounding has made: parts with known faces, turned; and what is promised of any set and length.

use std::collections::{BTreeMap, BTreeSet};

use delone::{Dimension, Error, Hull2, Hull3, MERGE_AUTO};
use delone_generators::Random;

type Point = [f64; 3];

/// A rotation by a random unit quaternion.
fn rotation(random: &mut Random) -> [Point; 3] {
    let [w, x, y, z] = loop {
        let q = [0; 4].map(|_| random.between(-1.0, 1.0));
        let size = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        if (0.1..=1.0).contains(&size) {
            break q.map(|x| x / size);
        }
    };
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
        [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
        [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

fn moved(points: &[Point], turn: [Point; 3], scale: f64, by: Point) -> Vec<Point> {
    let row = |p: &Point, k: usize| scale * (0..3).map(|i| turn[k][i] * p[i]).sum::<f64>() + by[k];
    points.iter().map(|p| [0, 1, 2].map(|k| row(p, k))).collect()
}

fn largest(points: &[Point]) -> f64 {
    points.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()))
}

fn auto(points: &[Point]) -> Hull3 {
    let hull = Hull3::from_points(points).expect("finite");
    let merged = hull.merged(points, MERGE_AUTO * largest(points)).expect("a body");
    proper(points, &merged);
    merged
}

/// Polygons and triangles are closed surfaces of a sphere with the corners.
fn proper(points: &[Point], hull: &Hull3) {
    let mut sides = BTreeSet::new();
    for face in hull.faces() {
        for (&u, &v) in face.iter().zip(face.iter().cycle().skip(1)) {
            assert!(sides.insert((u, v)), "a side twice");
        }
        let least = face.iter().min_by(|&&i, &&j| points[i].partial_cmp(&points[j]).expect("finite"));
        assert_eq!(least, face.first());
    }
    assert!(sides.iter().all(|&(u, v)| sides.contains(&(v, u))));
    assert_eq!(hull.corners().len() + hull.faces().len(), sides.len() / 2 + 2);
    let mut edges = BTreeMap::new();
    for (face, [a, b, c]) in hull.facets_of_faces() {
        assert!(face < hull.faces().len());
        for edge in [(a, b), (b, c), (c, a)] {
            assert!(edges.insert(edge, face).is_none(), "an edge twice");
        }
    }
    // What is between two faces is a side of both.
    for (&(u, v), face) in &edges {
        let other = edges[&(v, u)];
        assert_eq!(sides.contains(&(u, v)), *face != other, "{u} {v}");
    }
    assert_eq!(hull.facets().count(), 2 * hull.corners().len() - 4);
}

/// Points of a grid on the surface of a box or inside of it.
fn grid(counts: [usize; 3]) -> Vec<Point> {
    let [x, y, z] = counts;
    (0..x * y * z).map(|i| [i % x, i / x % y, i / x / y].map(|k| k as f64)).collect()
}

/// A prism on a regular polygon, with points along all its edges and on its sides.
fn prism(sides: usize, layers: usize, steps: usize) -> Vec<Point> {
    let corner = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / sides as f64;
        [angle.cos(), angle.sin()]
    };
    let mut points = Vec::new();
    for k in 0..sides * steps {
        let (from, to) = (corner(k / steps), corner(k / steps + 1));
        let part = (k % steps) as f64 / steps as f64;
        let [x, y] = [0, 1].map(|i| from[i] * (1.0 - part) + to[i] * part);
        points.extend((0..layers).map(|z| [x, y, z as f64]));
    }
    points
}

#[test]
fn turned_parts_have_the_faces_that_they_had() {
    let parts: Vec<(&str, Vec<Point>, [usize; 3])> = vec![
        ("grid", grid([5, 5, 5]), [8, 6, 12]),
        ("plate", grid([12, 9, 2]), [8, 6, 12]),
        ("bar", grid([40, 2, 2]), [8, 6, 12]),
        ("hexagon", prism(6, 4, 5), [12, 8, 20]),
        ("octagon", prism(8, 3, 4), [16, 10, 28]),
        ("wheel", prism(60, 2, 3), [120, 62, 236]),
    ];
    let mut random = Random::new(11);
    for (name, part, expected) in parts {
        for round in 0..12 {
            let scale = [1.0, 0.1, 0.037, 250.0, 1e-6, 1e9][round % 6];
            let far = if round % 4 == 3 { 30.0 * scale } else { scale };
            let by = [0; 3].map(|_| far * random.between(-1.0, 1.0));
            let points = moved(&part, rotation(&mut random), scale, by);
            let hull = auto(&points);
            let found = [hull.corners().len(), hull.faces().len(), hull.facets().count()];
            assert_eq!(found, expected, "{name}, round {round}");
        }
    }
}

/// The distance from the nearest triangle, in floats, over all.
fn distance(points: &[Point], hull: &Hull3, q: Point) -> f64 {
    let minus = |p: Point, q: Point| [0, 1, 2].map(|k| p[k] - q[k]);
    let dot = |p: Point, q: Point| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let on_edge = |a: Point, b: Point| {
        let along = minus(b, a);
        let t = (dot(minus(q, a), along) / dot(along, along)).clamp(0.0, 1.0);
        let foot = [0, 1, 2].map(|k| a[k] + t * along[k]);
        dot(minus(q, foot), minus(q, foot)).sqrt()
    };
    let cross = |u: Point, v: Point| {
        [0, 1, 2].map(|k| u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3])
    };
    let on_triangle = |[a, b, c]: [usize; 3]| {
        let [a, b, c] = [a, b, c].map(|i| points[i]);
        let n = cross(minus(b, a), minus(c, a));
        let inside =
            [(a, b), (b, c), (c, a)].iter().all(|&(u, v)| dot(cross(minus(v, u), minus(q, u)), n) >= 0.0);
        if inside {
            dot(minus(q, a), n).abs() / dot(n, n).sqrt()
        } else {
            on_edge(a, b).min(on_edge(b, c)).min(on_edge(c, a))
        }
    };
    hull.facets().map(on_triangle).fold(f64::INFINITY, f64::min)
}

fn sets(random: &mut Random) -> Vec<(&'static str, Vec<Point>)> {
    let sphere = |r: &mut Random| loop {
        let p = [0; 3].map(|_| r.between(-1.0, 1.0));
        let size = p.iter().map(|x| x * x).sum::<f64>().sqrt();
        if (0.1..=1.0).contains(&size) {
            break p.map(|x| x / size);
        }
    };
    let turn = rotation(random);
    let cone = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / 200.0;
        if k == 200 { [0.0, 0.0, 0.01] } else { [angle.cos(), angle.sin(), 0.0] }
    };
    vec![
        ("cube", (0..80).map(|_| [0; 3].map(|_| random.unit())).collect()),
        ("sphere", (0..300).map(|_| sphere(random)).collect()),
        ("lattice", (0..200).map(|_| [0; 3].map(|_| (random.unit() * 4.0).floor())).collect()),
        ("turned", moved(&grid([4, 4, 4]), turn, 1.0, [0.3; 3])),
        ("cone", (0..=200).map(cone).collect()),
        ("curve", (0..150).map(|i| f64::from(i) / 150.0).map(|t| [t, t * t, t * t * t]).collect()),
        (
            "round box",
            grid([5, 5, 5])
                .iter()
                .zip((0..125).map(|_| sphere(random)))
                .map(|(p, s)| [0, 1, 2].map(|k| p[k] + 0.3 * s[k]))
                .collect(),
        ),
    ]
}

#[test]
fn no_point_is_further_from_the_result_than_the_length() {
    let mut random = Random::new(12);
    let mut bodies = 0;
    for round in 0..2 {
        for (name, points) in sets(&mut random) {
            let exact = Hull3::from_points(&points).expect("finite");
            for exponent in [-40, -20, -12, -8, -6, -4, -3, -2, -1] {
                let length = 2.0_f64.powi(exponent) * largest(&points);
                let Ok(hull) = exact.merged(&points, length) else { continue };
                bodies += 1;
                proper(&points, &hull);
                for &i in exact.corners().iter().filter(|i| hull.corners().binary_search(i).is_err()) {
                    let away = distance(&points, &hull, points[i]);
                    assert!(
                        away <= length * (1.0 + 1e-9) + 1e-15,
                        "{name} {round}: {i} is {away} away, not {length}"
                    );
                }
                assert!(hull.corners().iter().all(|i| exact.corners().binary_search(i).is_ok()));
            }
        }
    }
    assert!(bodies > 75, "{bodies}");
}

/// Corners by their coordinates, and faces as rings of them.
fn as_set(points: &[Point], hull: &Hull3) -> Vec<Vec<[u64; 3]>> {
    let place = |i: &usize| points[*i].map(|x| (x + 0.0).to_bits());
    let mut faces: Vec<Vec<_>> = hull.faces().map(|face| face.iter().map(place).collect()).collect();
    faces.extend(hull.facets().map(|facet| facet.iter().map(place).collect()));
    faces.sort_unstable();
    faces
}

#[test]
fn orders_copies_and_powers_of_two_do_not_show() {
    let mut random = Random::new(13);
    for (name, points) in sets(&mut random) {
        for exponent in [-40, -8, -5] {
            let length = 2.0_f64.powi(exponent) * largest(&points);
            let of = |points: &[Point], length: f64| {
                Hull3::from_points(points)
                    .expect("finite")
                    .merged(points, length)
                    .map(|hull| as_set(points, &hull))
            };
            let plain = of(&points, length);
            let mut other: Vec<Point> = points.iter().chain(&points[..points.len() / 3]).copied().collect();
            for k in (1..other.len()).rev() {
                other.swap(k, random.below(k + 1));
            }
            assert_eq!(of(&other, length), plain, "{name}: another order");
            for power in [2.0_f64.powi(-300), 2.0_f64.powi(300)] {
                let scaled: Vec<Point> = points.iter().map(|p| p.map(|x| x * power)).collect();
                let hull = Hull3::from_points(&scaled).expect("finite").merged(&scaled, length * power);
                assert_eq!(
                    hull.map(|hull| as_set(&points, &hull)).ok(),
                    plain.as_ref().ok().cloned(),
                    "{name}: {power}"
                );
            }
        }
    }
}

/// A flat cone on a circle: over its base the apex is over a needle of any triangulation.
#[test]
fn flat_hubs_go_whatever_needles_are_below() {
    const RING: usize = 3000;
    let at = |k: usize| (std::f64::consts::TAU * k as f64 / RING as f64).sin_cos();
    for (height, is_left) in [(1e-13, false), (5e-13, false), (9e-13, false), (9.2e-13, true), (1e-11, true)]
    {
        let mut points: Vec<Point> = (0..RING).map(|k| [at(k).1, at(k).0, 0.0]).collect();
        points.extend([[0.0, 0.0, -1.0], [0.0, 0.0, height]]);
        let hull = Hull3::from_points(&points).expect("finite");
        assert_eq!(hull.corners().len(), RING + 2);
        let merged = auto(&points);
        assert_eq!(merged.corners().len(), RING + 1 + usize::from(is_left), "{height}");
        assert_eq!(merged.corners().contains(&(RING + 1)), is_left);
    }
}

/// Corners that are one point once the set is scaled by a power of two: they are left out only within the length.
#[test]
fn corners_that_scales_do_not_tell_apart_are_not_lost() {
    const RING: usize = 600;
    let big = 2.0_f64.powi(1000);
    let at = |k: usize| (std::f64::consts::TAU * k as f64 / RING as f64).sin_cos();
    let small = 2.0_f64.powi(-70);
    let mut points: Vec<Point> = (0..RING).map(|k| [small * at(k).1, small * at(k).0, big]).collect();
    points.extend([[big, 0.0, 0.0], [-big, 0.0, 0.0], [0.0, big, 0.0], [0.0, -big, 0.0], [0.0, 0.0, -big]]);
    let hull = Hull3::from_points(&points).expect("finite");
    assert_eq!(hull.corners().len(), RING + 5);
    assert_eq!(hull.merged(&points, small).expect("a body").corners(), hull.corners());
    let merged = hull.merged(&points, MERGE_AUTO * big).expect("a body");
    proper(&points, &merged);
    assert_eq!(merged.corners().len(), 6);
}

/// Points that are not those of the hull: a closed hull, or an error.
#[test]
fn other_points_are_no_panic() {
    let mut random = Random::new(16);
    for (name, points) in sets(&mut random) {
        let hull = Hull3::from_points(&points).expect("finite");
        let equal = vec![[0.0; 3]; points.len()];
        let turned: Vec<Point> = points.iter().rev().copied().collect();
        for (other, length) in
            [(&equal, 1e-9), (&equal, 0.1), (&turned, 1e-9), (&turned, 0.1), (&turned, 0.5)]
        {
            if let Ok(merged) = hull.merged(other, length) {
                assert_eq!(merged.facets().count(), 2 * merged.corners().len() - 4, "{name} {length}");
            }
        }
    }
}

#[test]
fn what_is_flat_within_the_length_is_told() {
    let mut random = Random::new(14);
    let square = moved(&grid([6, 6, 1]), rotation(&mut random), 0.1, [7.0, 3.0, -2.0]);
    let hull = Hull3::from_points(&square).expect("finite");
    assert_eq!(hull.dimension(), Dimension::Space, "rounding has made a body of it");
    let flat = |hull: &Hull3, points: &[Point], length: f64| {
        matches!(hull.merged(points, length), Err(Error::Parameter { name: "merge", .. }))
    };
    assert!(flat(&hull, &square, MERGE_AUTO * 7.0));
    let cube = grid([3, 3, 3]);
    let hull = Hull3::from_points(&cube).expect("finite");
    for length in [-1.0, f64::NAN, f64::INFINITY, 2.5, 1e300, f64::MAX] {
        assert!(flat(&hull, &cube, length), "{length}");
    }
    assert_eq!(hull.merged(&cube, 0.0).expect("a body"), hull);
    // Of lesser sets there is nothing to merge.
    let line = Hull3::from_points(&[[0.0; 3], [1.0; 3]]).expect("finite");
    assert_eq!(line.merged(&[[0.0; 3], [1.0; 3]], 9.0).expect("a line"), line);
}

#[test]
fn the_plane_has_the_same() {
    let mut random = Random::new(15);
    for round in 0..100 {
        let angle = random.between(0.0, 7.0);
        let (s, c) = angle.sin_cos();
        let scale = [1.0, 0.1, 1e-9, 1e6][round % 4];
        let turned = |i: usize| {
            let [x, y] = [(i % 9) as f64 + 100.0, (i / 9) as f64];
            [scale * (c * x - s * y), scale * (s * x + c * y)]
        };
        let points: Vec<[f64; 2]> = (0..81).map(turned).collect();
        let hull = Hull2::from_points(&points).expect("finite");
        let merged = hull.merged(&points, MERGE_AUTO * 100.0 * scale).expect("an area");
        let mut corners = merged.corners().to_vec();
        assert_eq!(
            corners.iter().min_by(|&&i, &&j| points[i].partial_cmp(&points[j]).expect("finite")),
            corners.first()
        );
        corners.sort_unstable();
        assert_eq!(corners, [0, 8, 72, 80], "round {round}");
        for length in [-1.0, f64::NAN, 100.0 * scale] {
            assert!(hull.merged(&points, length).is_err());
        }
        assert_eq!(hull.merged(&points, 0.0).expect("an area"), hull);
    }
    // A circle of many points within lengths: nothing left out is further away.
    for n in [10, 100, 600] {
        let at = |k: usize| std::f64::consts::TAU * k as f64 / n as f64;
        let points: Vec<[f64; 2]> = (0..n).map(|k| [at(k).cos(), at(k).sin()]).collect();
        let hull = Hull2::from_points(&points).expect("finite");
        for exponent in (2..30).step_by(3) {
            let length = 2.0_f64.powi(-exponent);
            let left = hull.merged(&points, length).expect("an area");
            for p in &points {
                let beyond = |[i, j]: [usize; 2]| {
                    let (a, b) = (points[i], points[j]);
                    let along = [b[0] - a[0], b[1] - a[1]];
                    ((p[0] - a[0]) * along[1] - (p[1] - a[1]) * along[0]) / along[0].hypot(along[1])
                };
                let furthest = left.facets().map(beyond).fold(f64::NEG_INFINITY, f64::max);
                assert!(furthest <= length * (1.0 + 1e-9), "{n} {length}: {furthest}");
            }
        }
    }
}
