//! Convex hulls in space against their definition, and the lifting map.

use delone::{Delaunay2, Dimension};
use delone::{Hull3, HullHistory3};
use delone_generators::{Kind, Random};
use delone_oracle::exact;

type Points = Vec<[f64; 3]>;

/// Named sets, hostile ones among them.
fn sets() -> Vec<(String, Points)> {
    let mut random = Random::new(5);
    let mut sets: Vec<(String, Points)> = Vec::new();
    let mut add = |name: &str, points: Points| sets.push((format!("{name} {}", points.len()), points));
    for n in [4, 5, 8, 30, 200] {
        add("cube", (0..n).map(|_| [random.unit(), random.unit(), random.unit()]).collect());
        let sphere = |r: &mut Random| {
            let p = [0, 1, 2].map(|_| r.between(-1.0, 1.0));
            let size = p.iter().map(|x| x * x).sum::<f64>().sqrt();
            p.map(|x| x / size)
        };
        add("sphere", (0..n).map(|_| sphere(&mut random)).collect());
        let small = |r: &mut Random| [0, 1, 2].map(|_| (r.unit() * 4.0).floor());
        add("lattice", (0..n).map(|_| small(&mut random)).collect());
        add(
            "twice",
            (0..n).map(|i| [f64::from(i / 2 % 5), f64::from(i / 2 % 7), f64::from(i / 2 % 3)]).collect(),
        );
        add(
            "flat",
            (0..n)
                .map(|_| {
                    let [x, y, _] = small(&mut random);
                    [x, y, x + y]
                })
                .collect(),
        );
        add("line", (0..n).map(|i| [f64::from(i), 2.0 * f64::from(i), 1.0]).collect());
        add(
            "layers",
            (0..n)
                .map(|_| {
                    let [x, y, z] = small(&mut random);
                    [x, y, (z / 2.0).floor()]
                })
                .collect(),
        );
        add("nearly flat", (0..n).map(|_| [random.unit(), random.unit(), 1e-300 * random.unit()]).collect());
        add("huge", (0..n).map(|_| [0, 1, 2].map(|_| random.between(-1.0, 1.0) * 1e300)).collect());
    }
    let grid = |k: i32| (0..k * k * k).map(|i| [i % k, i / k % k, i / k / k].map(f64::from)).collect();
    add("grid", grid(5));
    for n in 0..4 {
        add("few", (0..n).map(|i| [f64::from(i), f64::from(i * i), 0.0]).collect());
        add("equal", vec![[1.0, 2.0, 3.0]; n as usize]);
    }
    sets
}

#[test]
fn hulls_are_convex_closed_and_hold_everything() {
    for (name, points) in sets() {
        let hull = Hull3::from_points(&points).expect("finite");
        let facets: Vec<[usize; 3]> = hull.facets().collect();
        if hull.dimension() < Dimension::Space {
            assert!(facets.is_empty(), "{name}");
            continue;
        }
        for &[a, b, c] in &facets {
            for &p in &points {
                assert!(exact::orient3d(points[a], points[b], points[c], p) <= 0, "{name}: {p:?} is outside");
            }
        }
        // Every edge is met once in each direction.
        let mut edges: Vec<(usize, usize)> =
            facets.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).collect();
        edges.sort_unstable();
        assert!(edges.windows(2).all(|w| w[0] != w[1]), "{name}");
        assert!(edges.iter().all(|&(a, b)| edges.binary_search(&(b, a)).is_ok()), "{name}");
        // Euler's relation, of triangles and of faces.
        let corners = hull.corners().len();
        assert_eq!(corners + facets.len(), edges.len() / 2 + 2, "{name}");
        let sides: usize = hull.faces().map(<[usize]>::len).sum();
        assert_eq!(corners + hull.faces().len(), sides / 2 + 2, "{name}");
        // Corners are extreme: each is strictly outside of the hull of the others.
        for &v in hull.corners().iter().take(12) {
            let others: Points = points.iter().copied().filter(|&p| p != points[v]).collect();
            let without = Hull3::from_points(&others).expect("finite");
            let outside = without.dimension() < Dimension::Space
                || without.facets().any(|f| {
                    let [a, b, c] = f.map(|i| others[i]);
                    exact::orient3d(a, b, c, points[v]) > 0
                });
            assert!(outside, "{name}: {v} is no corner");
        }
    }
}

#[test]
fn one_set_has_one_hull() {
    for (name, points) in sets() {
        let shape = |points: &[[f64; 3]]| {
            let hull = Hull3::from_points(points).expect("finite");
            let of = |face: &[usize]| face.iter().map(|&i| points[i].map(|x| x + 0.0)).collect::<Vec<_>>();
            let mut faces: Vec<_> = hull.faces().map(of).collect();
            faces.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
            (hull.dimension(), hull.corners().len(), faces)
        };
        let mut shuffled = points.clone();
        Random::new(3).shuffle(&mut shuffled);
        let (one, other) = (shape(&points), shape(&shuffled));
        // A flat face has two sides.
        if one.0 == Dimension::Space {
            assert_eq!(one, other, "{name}");
        } else {
            assert_eq!((one.0, one.1), (other.0, other.1), "{name}");
        }
    }
}

#[test]
fn large_hulls_are_the_same_by_all_algorithms() {
    let mut random = Random::new(11);
    let n = 20_000;
    for round in 0..12 {
        let mut point = |i: usize| {
            let p = [0, 1, 2].map(|_| random.between(-1.0, 1.0));
            let size = p.iter().map(|x| x * x).sum::<f64>().sqrt();
            match round {
                0 => p,
                1 => p.map(|x| x / size),
                // Many points on few faces, and on their edges.
                2 => p.map(|x| (x * 1.5).clamp(-1.0, 1.0)),
                3 => p.map(|x| (x * 12.0).round()),
                // A cylinder whose ends are nearly flat: rounding decides what is above what.
                4 => [p[0] / size, p[1] / size, if i.is_multiple_of(2) { 1.0 } else { -1.0 } + 1e-16 * p[2]],
                5 => [p[0], p[1], p[0] * 0.3 + p[1] * 0.7],
                // Balls: of a lattice, with many points at each place; of any size; where few numbers are; long in each way.
                _ if size > 1.0 => [0.0; 3],
                6 => p.map(|x| (x * 9.0).round()),
                7 => p.map(|x| x * 1e-310),
                8 => p.map(|x| x * 1e308),
                9 => p.map(|x| 1e9 + x * 1e-5),
                10 => [p[0] * 1e300, p[1] * 1e-300, p[2]],
                _ => [p[0] * 1e-300, p[1], p[2] * 1e300],
            }
        };
        let points: Points = (0..n).map(&mut point).collect();
        let hull = Hull3::from_points(&points).expect("finite");
        let history = HullHistory3::from_points(&points, round).expect("finite");
        assert_eq!(history.hull(), &hull, "round {round}");
        let (by_flips, counters) = Hull3::by_flips(&points, round).expect("finite");
        assert_eq!(by_flips, hull, "round {round}");
        // By flips indeed: a corner comes with three facets at least. The last set is flat but for rounding, and no number is
        // inside of it.
        let created = counters.work().expect("counted").created;
        assert!(round == 5 || created >= 3 * hull.corners().len() as u64 - 8, "round {round}: {created}");
        assert_eq!(hull.dimension(), Dimension::Space);
        let edges = hull.faces().map(<[usize]>::len).sum::<usize>() / 2;
        assert_eq!(hull.corners().len() + hull.faces().len(), edges + 2, "round {round}");
    }
}

/// Powers of two change nothing, however far they bring products out of the range of numbers.
#[test]
fn scales_do_not_show() {
    let curve: Points = (0..900).map(|i| f64::from(i) / 1024.0).map(|t| [t, t * t, t * t * t]).collect();
    let plain = Hull3::from_points(&curve).expect("finite");
    assert_eq!(plain.corners().len(), 900);
    for exponent in [-900, -400, 400, 1000] {
        let scaled: Points = curve.iter().map(|p| p.map(|x| x * 2_f64.powi(exponent))).collect();
        assert_eq!(Hull3::from_points(&scaled).expect("finite"), plain, "2^{exponent}");
    }
}

#[test]
fn spans_are_told() {
    let span = |points: &[[f64; 3]]| Hull3::from_points(points).expect("finite").dimension();
    assert_eq!(span(&[]), Dimension::Empty);
    assert_eq!(span(&[[1.0; 3], [1.0; 3]]), Dimension::Point);
    assert_eq!(span(&[[0.0; 3], [1.0; 3], [3.0; 3]]), Dimension::Line);
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.5, 0.0, 0.5]];
    let hull = Hull3::from_points(&square).expect("finite");
    assert_eq!((hull.dimension(), hull.corners().len(), hull.faces().len()), (Dimension::Plane, 4, 1));
    assert!(Hull3::from_points(&[[0.0, f64::NAN, 0.0]]).is_err());
}

#[test]
fn the_lower_hull_of_the_lifted_points_is_the_delaunay_triangulation() {
    for kind in [Kind::Uniform, Kind::Grid, Kind::Clusters] {
        // Small integers, so that squares are exact.
        let scale =
            |p: [f64; 2], low: [f64; 2], size: f64| [0, 1].map(|k| ((p[k] - low[k]) / size * 1000.0).round());
        let raw = kind.points(400, 2);
        let low = [0, 1].map(|k| raw.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min));
        let size = [0, 1].map(|k| raw.iter().map(|p| p[k] - low[k]).fold(0.0, f64::max));
        let points: Vec<[f64; 2]> = raw.iter().map(|&p| scale(p, low, size[0].max(size[1]))).collect();
        let lifted: Points = points.iter().map(|&[x, y]| [x, y, x * x + y * y]).collect();
        let d = Delaunay2::from_points(&points).expect("finite");
        let hull = Hull3::from_points(&lifted).expect("finite");
        assert_eq!(hull.lower(&lifted).count(), d.triangles().count(), "{kind:?}");
        // Sites on one circle are one face; every triangle is in one.
        let mut of_corner = vec![Vec::new(); points.len()];
        for (f, face) in hull.faces().enumerate() {
            face.iter().for_each(|&v| of_corner[v].push(f));
        }
        for triangle in d.triangles() {
            let [a, b, c] = triangle.map(|v| &of_corner[v.index()]);
            assert!(a.iter().any(|f| b.contains(f) && c.contains(f)), "{kind:?} {triangle:?}");
        }
    }
}

#[test]
fn history_makes_the_same_hull_and_knows_what_is_inside() {
    for (name, points) in sets() {
        let hull = Hull3::from_points(&points).expect("finite");
        for seed in 0..3 {
            let history = HullHistory3::from_points(&points, seed).expect("finite");
            assert_eq!(history.hull(), &hull, "{name}");
            assert_eq!(Hull3::by_flips(&points, seed).expect("finite").0, hull, "{name}");
            let inside = |q: [f64; 3]| history.contains(q).expect("finite");
            assert!(points.iter().all(|&p| inside(p)), "{name}");
            // Between neighbors in the list, and beyond them: some on faces, some outside.
            for pair in points.windows(2).take(60) {
                for share in [0.25, 0.5, 1.25, -3.0] {
                    let q = [0, 1, 2].map(|k| pair[0][k] * (1.0 - share) + pair[1][k] * share);
                    assert_eq!(inside(q), is_inside(&points, &hull, q), "{name}: {q:?}");
                }
            }
        }
    }
    let history = HullHistory3::from_points(&[[0.0; 3]], 1).expect("finite");
    assert!(history.contains([0.0, f64::NAN, 0.0]).is_err());
}

/// On line: after each point the hull of those so far, and whether the point was outside of the one before.
#[test]
fn a_hull_may_grow_point_by_point() {
    for (name, mut points) in sets() {
        points.truncate(40);
        let mut history = HullHistory3::new();
        for (i, &p) in points.iter().enumerate() {
            let before = history.hull().clone();
            let was_inside = i > 0 && is_inside(&points[..i], &before, p);
            assert_eq!(history.insert(p).expect("finite"), !was_inside, "{name}: {p:?}");
            assert_eq!(history.hull(), &Hull3::from_points(&points[..=i]).expect("finite"), "{name} {i}");
            assert!(history.contains(p).expect("finite"), "{name}");
        }
        for pair in points.windows(2) {
            let q = [0, 1, 2].map(|k| pair[0][k] / 2.0 + pair[1][k] / 2.0);
            assert_eq!(history.contains(q), Ok(is_inside(&points, history.hull(), q)), "{name}: {q:?}");
        }
    }
    let mut history = HullHistory3::new();
    assert!(history.insert([0.0, f64::NAN, 0.0]).is_err());
    assert_eq!(history.hull().dimension(), Dimension::Empty);
}

/// By definition: not outside of any facet; for flat sets, if the hull does not grow by it.
fn is_inside(points: &[[f64; 3]], hull: &Hull3, q: [f64; 3]) -> bool {
    if hull.dimension() == Dimension::Space {
        let beyond = |[a, b, c]: [usize; 3]| exact::orient3d(points[a], points[b], points[c], q) > 0;
        return !hull.facets().any(beyond);
    }
    let with: Points = points.iter().copied().chain([q]).collect();
    let grown = Hull3::from_points(&with).expect("finite");
    grown.dimension() == hull.dimension() && grown.corners().iter().all(|&i| i < points.len())
}

#[test]
fn history_is_linear_and_descents_are_logarithmic() {
    // Theorem 4.1 and the cost of location, for points that are all extreme: fewer than six facets a point.
    let mut random = Random::new(8);
    for n in [1_000, 10_000] {
        let points: Points = (0..n)
            .map(|_| {
                let p = [0, 1, 2].map(|_| random.between(-1.0, 1.0));
                let size = p.iter().map(|x| x * x).sum::<f64>().sqrt();
                p.map(|x| x / size)
            })
            .collect();
        let history = HullHistory3::from_points(&points, 4).expect("finite");
        let work = history.counters().work().expect("counted");
        assert_eq!(history.size() as u64, work.created);
        assert!((5.5..6.0).contains(&(work.created as f64 / f64::from(n))), "{n}: {}", work.created);
        assert_eq!(work.created - work.destroyed, 2 * u64::try_from(n).expect("small") - 4);
        let asked = work.orientations as f64 / f64::from(n) / f64::from(n).ln();
        // A point sees four facets of any hull before it, each with chance 3 / r one of the step r: 12 ln n in all,
        // which are asked about besides those that hang beside them and are not seen.
        assert!((4.0..24.0).contains(&asked), "{n}: {asked} ln n");
    }
}
