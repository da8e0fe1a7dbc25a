//! Certain and possible edges of points in disks: against all pairs and all obstacles by angles, and against instances.

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;

use delone::{Delaunay2, Error, VertexId};
use delone_generators::{Kind, Random, moved};

type Pairs = BTreeSet<[usize; 2]>;

fn pairs(edges: impl IntoIterator<Item = [VertexId; 2]>) -> Pairs {
    edges.into_iter().map(|[v, w]| [v.index().min(w.index()), v.index().max(w.index())]).collect()
}

fn edges(points: &[[f64; 2]]) -> Pairs {
    pairs(Delaunay2::from_points(points).expect("finite").edges())
}

fn found(centers: &[[f64; 2]], radius: f64) -> [Pairs; 2] {
    let edges = Delaunay2::from_points(centers).expect("finite").disk_edges(radius).expect("a radius");
    [edges.certain(), edges.possible()].map(|list| {
        assert!(list.is_sorted());
        pairs(list.iter().copied())
    })
}

/// Where on the bisector of i and j, as angles, d_k exceeds d by 2 r (sign 1), or is less by that (sign -1).
fn cap(i: [f64; 2], j: [f64; 2], k: [f64; 2], radius: f64, sign: f64) -> Option<[f64; 2]> {
    let u = [j[0] - i[0], j[1] - i[1]];
    let length = u[0].hypot(u[1]);
    // In units of half the distance of i and j, with both on an axis: (-1, 0) and (1, 0).
    let m = [k[0] - f64::midpoint(i[0], j[0]), k[1] - f64::midpoint(i[1], j[1])];
    let x = 2.0 * (m[0] * u[0] + m[1] * u[1]) / (length * length);
    let y = 2.0 * (m[1] * u[0] - m[0] * u[1]) / (length * length);
    let e = 4.0 * radius / length;
    // From the place at height tan(t), cos(t) times d is 1.
    if sign < 0.0 && (x + 1.0).hypot(y).min((x - 1.0).hypot(y)) <= e {
        return None;
    }
    let (a, b) = (sign * (x * x + y * y - 1.0 - e * e), sign * 2.0 * y);
    let size = a.hypot(b);
    if size <= 2.0 * e {
        return None;
    }
    let (middle, half) = ((-b).atan2(a), (2.0 * e / size).acos());
    let ends = [(middle - half).max(-FRAC_PI_2), (middle + half).min(FRAC_PI_2)];
    (ends[0] < ends[1]).then_some(ends)
}

/// By definition: certain, possible, and by how much of an angle the two answers are plain.
fn by_definition(c: &[[f64; 2]], i: usize, j: usize, radius: f64) -> [(bool, f64); 2] {
    let others = || (0..c.len()).filter(|&k| k != i && k != j);
    let (mut low, mut high, mut empty) = (-FRAC_PI_2, FRAC_PI_2, false);
    for k in others() {
        match cap(c[i], c[j], c[k], radius, 1.0) {
            Some([from, to]) => (low, high) = (low.max(from), high.min(to)),
            None => empty = true,
        }
    }
    let distance = (c[i][0] - c[j][0]).hypot(c[i][1] - c[j][1]);
    let certain =
        (!empty && low < high && distance > 2.0 * radius, if empty { 1.0 } else { (high - low).abs() });
    let mut caps: Vec<_> = others().filter_map(|k| cap(c[i], c[j], c[k], radius, -1.0)).collect();
    caps.sort_by(|p, q| p[0].total_cmp(&q[0]));
    let (mut reach, mut gap) = (-FRAC_PI_2, f64::NEG_INFINITY);
    for [from, to] in caps {
        gap = gap.max(from - reach);
        reach = reach.max(to);
    }
    gap = gap.max(FRAC_PI_2 - reach);
    // A line that is covered without overlap has a gap of nothing; open ends at infinity are no gap.
    [certain, (gap > 1e-9, if gap > 1e-9 { gap } else { 1.0 })]
}

#[test]
fn all_pairs_and_obstacles_by_angles() {
    let mut checked = [0; 4];
    for (seed, n) in [(1, 3), (2, 5), (3, 12), (4, 30), (5, 60)] {
        for kind in [Kind::Uniform, Kind::Clusters, Kind::Circle, Kind::Disks] {
            let centers = kind.points(n, seed);
            let distance =
                |i: usize, k: usize| (centers[i][0] - centers[k][0]).hypot(centers[i][1] - centers[k][1]);
            let spacing = edges(&centers).iter().map(|&[i, k]| distance(i, k)).fold(f64::INFINITY, f64::min);
            for radius in [0.05, 0.3, 1.0, 5.0].map(|x| x * spacing) {
                let [certain, possible] = found(&centers, radius);
                for (i, j) in (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))) {
                    let [sure, some] = by_definition(&centers, i, j, radius);
                    let what = format!("{} {n} {radius} {i} {j}", kind.name());
                    if sure.1 > 1e-9 {
                        assert_eq!(certain.contains(&[i, j]), sure.0, "certain {what}");
                        checked[usize::from(sure.0)] += 1;
                    }
                    assert_eq!(possible.contains(&[i, j]), some.0, "possible {what}");
                    checked[2 + usize::from(some.0)] += 1;
                }
            }
        }
    }
    assert!(checked.iter().all(|&count| count > 500), "{checked:?}");
}

/// Instances inside, on the borders of the disks, and with all points pushed from or to one place.
fn instances(centers: &[[f64; 2]], radius: f64, random: &mut Random) -> Vec<Vec<[f64; 2]>> {
    // What rounding moves a point outside is less than this.
    let radius = radius * (1.0 - 1e-9);
    let mut all = vec![centers.to_vec()];
    for round in 0..60 {
        all.push(moved(centers, radius, random));
        let middle = centers[round % centers.len()].map(|x| x + random.between(-radius, radius));
        for choice in 0..3 {
            let pushed = centers.iter().map(|p| {
                let (x, y) = (p[0] - middle[0], p[1] - middle[1]);
                let angle = if choice < 2 { y.atan2(x) } else { random.between(0.0, 7.0) };
                let to = if choice == 1 { -radius } else { radius };
                [p[0] + to * angle.cos(), p[1] + to * angle.sin()]
            });
            all.push(pushed.collect());
        }
    }
    all
}

#[test]
fn instances_lie_between() {
    let mut random = Random::new(9);
    for kind in [Kind::Uniform, Kind::Grid, Kind::Disks, Kind::Line, Kind::Circle] {
        let centers = kind.points(50, 3);
        let [a, b] = [centers[0], centers[1]];
        let distance = (a[0] - b[0]).hypot(a[1] - b[1]);
        for radius in [0.0, 0.01, 0.1, 0.4].map(|x| x * distance) {
            let [certain, possible] = found(&centers, radius);
            assert!(certain.is_subset(&possible));
            for instance in instances(&centers, radius, &mut random) {
                let edges = edges(&instance);
                assert!(certain.is_subset(&edges), "{} {radius}", kind.name());
                assert!(edges.is_subset(&possible), "{} {radius}", kind.name());
            }
        }
    }
}

/// An edge of the centers that is not certain is missing in an instance: the two as far as possible from a place of their
/// bisector, all others as near.
#[test]
fn what_is_not_certain_is_missing_somewhere() {
    let centers = Kind::Disks.points(40, 7);
    let (mut missing, mut uncertain) = (0, 0);
    for radius in [0.3, 0.6] {
        let [certain, _] = found(&centers, radius);
        for [i, j] in edges(&centers).difference(&certain).copied() {
            uncertain += 1;
            let (p, q) = (centers[i], centers[j]);
            let is_missing = (-400..=400).any(|t| {
                let s = (f64::from(t) / 401.0 * FRAC_PI_2).tan() / 2.0;
                let c = [
                    f64::midpoint(p[0], q[0]) - s * (q[1] - p[1]),
                    f64::midpoint(p[1], q[1]) + s * (q[0] - p[0]),
                ];
                let instance: Vec<[f64; 2]> = (0..centers.len())
                    .map(|k| {
                        let to = [centers[k][0] - c[0], centers[k][1] - c[1]];
                        let by = if k == i || k == j { radius } else { -radius } / to[0].hypot(to[1]);
                        [centers[k][0] + by * to[0], centers[k][1] + by * to[1]]
                    })
                    .collect();
                !edges(&instance).contains(&[i, j])
            });
            missing += usize::from(is_missing);
        }
    }
    assert!(uncertain > 20 && missing * 100 >= uncertain * 95, "{missing} of {uncertain}");
}

#[test]
fn few_collinear_equal_and_cocircular_centers() {
    assert_eq!(found(&[], 1.0), [Pairs::new(), Pairs::new()]);
    assert_eq!(found(&[[1.0, 2.0]], 1.0), [Pairs::new(), Pairs::new()]);
    let one = Pairs::from([[0, 1]]);
    assert_eq!(found(&[[0.0, 0.0], [3.0, 0.0]], 1.0), [one.clone(), one.clone()]);
    // Disks that touch may be one point.
    assert_eq!(found(&[[0.0, 0.0], [2.0, 0.0]], 1.0), [Pairs::new(), one.clone()]);
    // All equal, and two of three equal.
    assert_eq!(found(&[[1.0, 1.0]; 4], 1.0), [Pairs::new(), Pairs::new()]);
    assert_eq!(found(&[[0.0, 0.0], [3.0, 0.0], [3.0, 0.0]], 1.0), [Pairs::new(), one.clone()]);
    assert_eq!(found(&[[0.0, 0.0], [3.0, 0.0], [3.0, 0.0]], 0.0), [one.clone(), one]);
    // On a line: a disk of no size is always between, one of some size not.
    let line: Vec<[f64; 2]> = (0..6).map(|i| [f64::from(i), 2.0 * f64::from(i)]).collect();
    let next: Pairs = (0..5).map(|i| [i, i + 1]).collect();
    assert_eq!(found(&line, 0.0), [next.clone(), next.clone()]);
    let [certain, possible] = found(&line, 0.125);
    assert_eq!(certain, next);
    assert_eq!(possible.len(), 15);
    // A grid without radius: all sides, both diagonals of each cell, or none.
    let grid: Vec<[f64; 2]> = (0..16).map(|i| [f64::from(i % 4), f64::from(i / 4)]).collect();
    let [certain, possible] = found(&grid, 0.0);
    assert_eq!((certain.len(), possible.len()), (24, 24 + 18));
}

#[test]
fn any_numbers() {
    let d = Delaunay2::from_points(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]).expect("finite");
    for radius in [-1.0, f64::NAN, f64::INFINITY, f64::MAX] {
        assert!(matches!(d.disk_edges(radius), Err(Error::Parameter { name: "radius", .. })), "{radius}");
    }
    assert_eq!(d.disk_edges(1e300).expect("a radius").possible().len(), 3);
    assert_eq!(d.disk_edges(f64::from_bits(1)).expect("a radius").certain().len(), 3);
    // A power of two changes nothing, as long as no bit is lost.
    let centers = Kind::Disks.points(30, 2);
    for radius in [0.5, 1.0, 3.0] {
        let expected = found(&centers, radius);
        for scale in [2f64.powi(990), 2f64.powi(-900)] {
            let scaled: Vec<[f64; 2]> = centers.iter().map(|p| p.map(|x| x * scale)).collect();
            assert_eq!(found(&scaled, radius * scale), expected, "{radius} {scale:e}");
        }
    }
    let wild = [[1e300, 1e300], [-1e300, 3.0], [1e-300, 0.0], [0.0, 1e-300], [7.0, 8.0], [1e300, -1e300]];
    for radius in [0.0, 1e-300, 1.0, 1e299, 1e300] {
        let [certain, possible] = found(&wild, radius);
        let edges = edges(&wild);
        assert!(certain.is_subset(&edges) && edges.is_subset(&possible), "{radius}");
    }
}
