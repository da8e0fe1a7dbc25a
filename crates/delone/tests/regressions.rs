//! Inputs that broke a promise once, each as small as it could be made, and the promise.

use delone::{Delaunay2, Delaunay3, Error, Hierarchy, Locate, Moving2, Moving3, Step2, VertexId, Work};
use delone::{Hull3, HullHistory3};
use delone_generators::{Kind, Kind3, Random};
use delone_oracle::share;

const LEAST: f64 = f64::from_bits(1);

/// Points on a sphere and its center, some of which change places: the border of what was to be mended did not part the
/// filling in two, and the mesh led nowhere.
#[test]
fn points_that_change_places_on_a_sphere_come_to_an_end() {
    let on_sphere = |random: &mut Random| {
        let p = [(); 3].map(|()| random.between(-1.0, 1.0));
        let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
        p.map(|x| x / length)
    };
    let mut repaired = 0;
    for seed in 0..1500 {
        let mut random = Random::new(seed);
        let n = 10 + random.below(30);
        let mut points: Vec<[f64; 3]> = (0..n).map(|_| on_sphere(&mut random)).collect();
        points.push([0.0; 3]);
        let mut moving = Moving3::from_points(&points).expect("finite");
        for _ in 0..2 {
            for _ in 0..=random.below(3) {
                let (i, j) = (random.below(n), random.below(n));
                if random.below(2) == 0 { points.swap(i, j) } else { points[i] = on_sphere(&mut random) }
            }
            let step = moving.step(&points).expect("finite");
            repaired += usize::from(matches!(step, delone::Step3::Repaired { .. }));
            moving.triangulation().check().unwrap_or_else(|flaw| panic!("seed {seed}: {flaw}"));
            let anew = Delaunay3::from_points(&points).expect("finite");
            assert_eq!(moving.triangulation().tetrahedra().count(), anew.tetrahedra().count(), "seed {seed}");
        }
    }
    assert!(repaired > 100, "only {repaired} were repaired");
}

/// The work of a step grows with the number of removed vertices, not with that times the degree of a hub.
#[test]
fn a_hub_does_not_slow_motion_down() {
    for n in [2000, 8000, 32_000] {
        let mut random = Random::new(1);
        let mut around = |noise: f64| {
            let mut at = |i: usize| (i as f64 + noise * random.unit()) * std::f64::consts::TAU / n as f64;
            let angles: Vec<f64> = (0..n).map(&mut at).collect();
            angles.iter().map(|a| [a.cos(), a.sin()]).chain([[0.0, 0.0]]).collect::<Vec<_>>()
        };
        let (before, after) = (around(0.5), around(1.5));
        let mut moving = Moving2::from_points(&before).expect("finite");
        let mut work = Work::default();
        let step = moving.step_observed(&after, &mut work).expect("finite");
        let Step2::Repaired { reinserted, .. } = step else { panic!("{n}: {step:?}") };
        assert!(reinserted > n / 40, "only {reinserted} of {n} were removed");
        assert!(work.visited < 40 * reinserted as u64, "{} visits for {reinserted}", work.visited);
        moving.triangulation().check().expect("canonical");
    }
}

/// Numbers far below the step of a lattice are not on it, though their number of steps is rounded to zero.
#[test]
fn tiny_numbers_beside_a_lattice_are_not_on_it() {
    let mut d = Delaunay3::new();
    for p in [[2., 2., 4.], [6., 4., 2.], [2., 6., 2.], [4., 6., 4.], [4., 4., -LEAST]] {
        d.insert(p).expect("finite");
        d.check().expect("canonical");
    }
    let mut points: Vec<[f64; 2]> =
        (0..40_000).map(|i| [i % 200, i / 200].map(|x| f64::from(2 * x))).collect();
    let mut random = Random::new(1);
    points.extend(
        (0..100).map(|k| {
            [if k % 2 == 0 { LEAST } else { -LEAST }, f64::from(200 + 2 * random.below(100) as u32)]
        }),
    );
    for threads in [1, 2, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| Delaunay2::from_points(&points).expect("finite").check().expect("canonical"));
    }
}

/// Heights above facets overflow, and cannot be compared.
#[test]
fn the_first_of_equal_points_is_the_corner_at_any_scale() {
    for scale in [1.0, 1e100, 1e149, 1e200, 1e300, 1e-100, 1e-300] {
        let mut random = Random::new(3);
        let distinct: Vec<[f64; 3]> =
            (0..60).map(|_| [(); 3].map(|()| (random.unit() - 0.5) * scale)).collect();
        let points: Vec<[f64; 3]> = distinct.iter().cycle().take(180).copied().collect();
        let hull = Hull3::from_points(&points).expect("finite");
        assert!(hull.corners().iter().all(|&i| i < 60), "{scale:e}: {:?}", hull.corners());
        assert_eq!(&hull, HullHistory3::from_points(&points, 1).expect("finite").hull(), "{scale:e}");
    }
}

#[test]
fn levels_that_hardly_shrink_are_refused() {
    for ratio in [1.0 + 1e-12, 1.2] {
        let mut d = Delaunay2::new();
        let wrong = d.set_strategy(Locate::Hierarchy(Hierarchy::default().ratio(ratio)));
        assert!(matches!(wrong, Err(Error::Parameter { name: "ratio", .. })), "{ratio}");
    }
}

#[test]
fn ids_beyond_all_points_are_no_vertices() {
    let mut d = Delaunay2::from_points(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]).expect("finite");
    for index in [3, delone::MAX_POINTS, u32::MAX as usize, 1 << 32, (1 << 32) + 1, usize::MAX] {
        let v = VertexId::new(index);
        assert!(!d.mesh().contains(v) && !v.is_ghost(), "{index}");
        assert_eq!(d.remove(v), Err(Error::NoSuchVertex { vertex: v }), "{index}");
    }
}

#[test]
fn areas_are_numbers() {
    let h = 1e308;
    for (corners, area) in [
        ([[-h, -h], [h, -h], [0.0, h]], f64::INFINITY),
        ([[-h, 0.0], [h, 1e-300], [0.0, 1e-290]], 1e18),
        ([[0.0, 0.0], [1e200, 1e200], [-1.0, 1.0]], 1e200),
        ([[0.0, 0.0], [2f64.powi(512), 0.0], [0.0, 2f64.powi(512)]], 2f64.powi(1023)),
    ] {
        let d = Delaunay2::from_points(&corners).expect("finite");
        let found: f64 = d.mesh().triangles().map(|t| d.area(t)).sum();
        assert!(found == area || (found / area - 1.0).abs() < 1e-9, "{corners:?}: {found}");
    }
}

/// The middle of a rectangle of subnormal numbers is outside of it.
#[test]
fn rectangles_of_the_smallest_numbers_hold_their_vertices() {
    let mut random = Random::new(2);
    let mut found = 0;
    for _ in 0..400 {
        let tiny = |random: &mut Random| (random.below(7) as f64 - 3.0) * LEAST;
        let points: Vec<[f64; 2]> =
            (0..3 + random.below(12)).map(|_| [(); 2].map(|()| tiny(&mut random))).collect();
        let d = Delaunay2::from_points(&points).expect("finite");
        for _ in 0..20 {
            let [p, q] = [(); 2].map(|()| [(); 2].map(|()| tiny(&mut random)));
            let (low, high) = ([0, 1].map(|k| p[k].min(q[k])), [0, 1].map(|k| p[k].max(q[k])));
            let mut inside: Vec<_> = d.vertices().collect();
            inside.retain(|&v| (0..2).all(|k| low[k] <= d.point(v)[k] && d.point(v)[k] <= high[k]));
            assert_eq!(d.in_rectangle(low, high).expect("finite"), inside, "{points:?} {low:?} {high:?}");
            found += inside.len();
        }
    }
    assert!(found > 1000, "{found}");
}

/// Rectangles beside a hull of many corners are seen to be outside from near, at any scale.
#[test]
fn rectangles_outside_of_large_hulls_are_cheap() {
    let n = 100_000;
    let at = |i: u32| (f64::from(i) * std::f64::consts::TAU / f64::from(n)).sin_cos();
    for scale in [1.0, 2.0_f64.powi(1000), 2.0_f64.powi(-900)] {
        let scaled = |p: [f64; 2]| p.map(|x| x * scale);
        let points: Vec<[f64; 2]> = (0..n).map(|i| scaled(at(i).into())).collect();
        let d = Delaunay2::from_points(&points).expect("finite");
        let mut random = Random::new(5);
        let mut most = 0;
        for _ in 0..share(1000) {
            let (size, reach) = (4.0 * random.unit().powi(4), 2.0 + random.normal().abs());
            let low = [(); 2].map(|()| random.between(-reach, reach));
            let high = low.map(|x| x + size * random.unit());
            let mut work = Work::default();
            let [lowest, highest] = [low, high].map(scaled);
            let found = d.in_rectangle_observed(lowest, highest, &mut work).expect("finite");
            let is_inside = |p: &&[f64; 2]| (0..2).all(|k| lowest[k] <= p[k] && p[k] <= highest[k]);
            assert_eq!(found.len(), points.iter().filter(is_inside).count());
            let corners = [low, [low[0], high[1]], high, [high[0], low[1]]];
            let nearest = [0, 1].map(|k| 0.0_f64.clamp(low[k], high[k]));
            if nearest[0].hypot(nearest[1]) > 1.0 && corners.iter().all(|c| c[0].hypot(c[1]) > 1.0) {
                assert!(found.is_empty());
                most = most.max(work.visited);
            }
        }
        assert!(most > 0 && most < 1000, "{most} visited at {scale:e}");
    }
}

/// A flat set is projected to find its corners, whose order along one axis less is another.
#[test]
fn the_face_of_a_flat_set_starts_at_its_smallest_corner() {
    for points in [
        [[1.5, 1.5, 0.0], [-8.0, 8.0, 8.0], [8.0, -8.0, 8.0]],
        [[-8.0, 8.0, -8.0], [-8.0, 8.0, 8.0], [8.0, -8.0, 8.0]],
    ] {
        let hull = Hull3::from_points(&points).expect("finite");
        let smallest = (0..3).min_by(|&i, &j| points[i].partial_cmp(&points[j]).expect("finite"));
        let face = hull.faces().next().expect("a flat set has one face");
        assert_eq!(Some(face[0]), smallest);
        assert_eq!(hull.corners(), face);
    }
}

/// Coordinates are scaled by powers of two where the filters could not bear them, which must not show.
#[test]
fn every_scale_has_the_same_triangulation() {
    for kind in [Kind::Uniform, Kind::Grid, Kind::Clusters, Kind::UnitCircle] {
        let points = kind.points(600, 1);
        let mut expected: Vec<_> = Delaunay2::from_points(&points).expect("finite").triangles().collect();
        expected.sort_unstable();
        for exponent in [-1000, -500, -100, -81, 199, 201, 500, 1000] {
            for far in [false, true] {
                let scale = 2f64.powi(exponent);
                let mut scaled: Vec<_> = points.iter().map(|p| p.map(|x| x * scale)).collect();
                if far {
                    scaled.extend([[1e308, 0.0], [1e-320, LEAST], [0.0, -1e300]]);
                }
                let d = Delaunay2::from_points(&scaled).expect("finite");
                d.check().unwrap_or_else(|flaw| panic!("{} 2^{exponent} {far}: {flaw}", kind.name()));
                let mut found: Vec<_> = d.triangles().collect();
                found.sort_unstable();
                assert!(far || found == expected, "{} 2^{exponent}", kind.name());
            }
        }
    }
}

#[test]
fn every_scale_has_the_same_triangulation_in_space() {
    for kind in Kind3::ALL {
        let points = kind.points(200, 1);
        let cells = |d: &Delaunay3| {
            let mut cells: Vec<_> = d
                .tetrahedra()
                .map(|mut t| {
                    t.sort_unstable();
                    t
                })
                .collect();
            cells.sort_unstable();
            cells
        };
        let expected = cells(&Delaunay3::from_points(&points).expect("finite"));
        for exponent in [-900, -200, -131, 91, 200, 900] {
            let scaled: Vec<_> = points.iter().map(|p| p.map(|x| x * 2f64.powi(exponent))).collect();
            let same = |(p, q): (&[f64; 3], &[f64; 3])| p.map(|x| x * 2f64.powi(-exponent)) == *q;
            if !scaled.iter().zip(&points).all(same) {
                continue;
            }
            let mut d = Delaunay3::from_points(&scaled).expect("finite");
            d.check().unwrap_or_else(|flaw| panic!("{} 2^{exponent}: {flaw}", kind.name()));
            assert_eq!(cells(&d), expected, "{} 2^{exponent}", kind.name());
            // It is as it was given, and changes like any other.
            assert!(d.vertices().all(|v| d.point(v) == scaled[v.index()]), "{} 2^{exponent}", kind.name());
            let first = d.vertices().next();
            if let Some(v) = first {
                d.remove(v).expect("a vertex");
                d.insert(scaled[v.index()]).expect("finite");
                d.check().unwrap_or_else(|flaw| panic!("{} 2^{exponent}, changed: {flaw}", kind.name()));
            }
        }
    }
}

/// Flat sets near the largest numbers: what is made up beside them is finite, too.
#[test]
fn flat_sets_of_the_largest_numbers_have_a_scaffold() {
    let mut random = Random::new(8);
    for dimensions in 1..=2 {
        let points: Vec<[f64; 3]> = (0..40)
            .map(|_| {
                [0, 1, 2]
                    .map(|axis| if axis < dimensions { random.between(1.3e308, 1.7e308) } else { 1.7e308 })
            })
            .collect();
        let mut d = Delaunay3::from_points(&points).expect("finite");
        d.check().expect("canonical");
        d.insert([1.4e308, 1.5e308, 1.6e308]).expect("finite");
        d.insert([1.5e308, 1.4e308, 1.5e308]).expect("finite");
        d.check().expect("canonical");
    }
}
