//! Triangles that are given stay until a new vertex comes near, whether they are Delaunay or not.

use delone::{Constrained2, Error, Fill, Refined2, Refinement, Triangulation as _, VertexId};
use delone_generators::{Kind, Random};

use super::judge::{Points, area, coordinates, judge};

/// Triangles by the indices of their corners.
type Triangles = Vec<[usize; 3]>;

fn named(triangles: &[[usize; 3]]) -> Vec<[VertexId; 3]> {
    triangles.iter().map(|corners| corners.map(VertexId::new)).collect()
}

/// The triangles inside, each from its least corner on, in order.
fn inside(c: &Constrained2, refined: &Refined2) -> Triangles {
    let of = |t| {
        let mut corners = c.corners(t).map(VertexId::index);
        let least = (0..3).min_by_key(|&k| corners[k]).unwrap_or(0);
        corners.rotate_left(least);
        corners
    };
    let mut all: Triangles = c.triangle_ids().filter(|&t| refined.domains.is_inside(t)).map(of).collect();
    all.sort_unstable();
    all
}

/// Unit squares, each cut along the diagonal that `is_rising` chooses.
fn grid(side: usize, is_rising: impl Fn(usize, usize) -> bool) -> (Points, Triangles) {
    let points = (0..=side).flat_map(|y| (0..=side).map(move |x| [x as f64, y as f64])).collect();
    let mut triangles = Triangles::new();
    for y in 0..side {
        for x in 0..side {
            let a = y * (side + 1) + x;
            let (b, c, d) = (a + 1, a + side + 2, a + side + 1);
            triangles.extend(if is_rising(x, y) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
        }
    }
    triangles.sort_unstable();
    (points, triangles)
}

/// A triangulation that is not Delaunay: edges are flipped at random.
fn flipped(points: &[[f64; 2]], seed: u64) -> Triangles {
    let plain = Constrained2::from_parts(points, &[]).expect("finite");
    let mut triangles: Triangles = plain.triangles().map(|corners| corners.map(VertexId::index)).collect();
    let mut random = Random::new(seed);
    let area = |[a, b, c]: [usize; 3]| {
        let [p, q, r] = [a, b, c].map(|i| points[i]);
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    };
    for _ in 0..20 * triangles.len() {
        let (i, j) = (random.below(triangles.len()), random.below(triangles.len()));
        let Some(k) = (0..3).find(|&k| !triangles[j].contains(&triangles[i][k])) else { continue };
        let [a, b, c] = [0, 1, 2].map(|step| triangles[i][(k + step) % 3]);
        let Some(&d) = triangles[j].iter().find(|&v| ![a, b, c].contains(v)) else { continue };
        let is_beside = triangles[j].contains(&b) && triangles[j].contains(&c) && i != j;
        // Clearly convex.
        if is_beside && area([a, b, d]) > 1e-3 && area([a, d, c]) > 1e-3 {
            (triangles[i], triangles[j]) = ([a, b, d], [a, d, c]);
        }
    }
    triangles
}

#[test]
fn triangles_that_are_good_enough_stay() {
    for (name, rule) in [("rising", 0), ("falling", 1), ("mixed", 2)] {
        let (points, triangles) = grid(8, |x, y| [true, false, (x + y) % 2 == 0][rule]);
        let given = named(&triangles);
        for angle in [0.0, 20.0, 44.0] {
            let mut c = Constrained2::from_parts(&points, &[]).expect("finite");
            let how = Refinement::new().min_angle(angle).triangles(&given);
            let refined = how.run(&mut c).expect("it ends");
            assert_eq!(c.check(), Ok(()), "{name}");
            assert_eq!(inside(&c, &refined), triangles, "{name} at {angle}");
            // Once more, and with a finer corner.
            let fill = Fill::Parts(&refined.domains);
            let same = Refinement::new().min_angle(angle).fill(fill).run(&mut c.clone()).expect("it ends");
            assert_eq!(same.kept.len(), refined.kept.len(), "{name}");
            let area = |[x, y]: [f64; 2]| if x < 2.0 && y < 2.0 { 0.1 } else { f64::INFINITY };
            let finer = Refinement::new().fill(fill).max_area_at(&area).run(&mut c).expect("it ends");
            assert_eq!(c.check(), Ok(()), "{name}");
            let now = inside(&c, &finer);
            let is_far =
                |corners: &&[usize; 3]| corners.iter().any(|&v| points[v][0] > 4.0 || points[v][1] > 4.0);
            assert!(triangles.iter().filter(is_far).all(|corners| now.contains(corners)), "{name}");
            assert!(now.len() > triangles.len() + 30, "{name}");
        }
    }
}

#[test]
fn what_is_not_delaunay_is_refined_as_all_else() {
    for kind in [Kind::Uniform, Kind::Grid, Kind::Circle, Kind::Clusters] {
        for seed in 0..4 {
            let name = &format!("{kind:?} {seed}");
            let points = kind.points(60, seed);
            let triangles = flipped(&points, seed);
            let given = named(&triangles);
            let mut c = Constrained2::from_parts(&points, &[]).expect("finite");
            let refined = Refinement::new().min_angle(0.0).triangles(&given).run(&mut c).expect("it ends");
            assert_eq!(c.check(), Ok(()), "{name}");
            assert_eq!(inside(&c, &refined).len(), triangles.len(), "{name}");
            let mut sorted: Triangles = triangles.clone();
            sorted.iter_mut().for_each(|corners| {
                let least = (0..3).min_by_key(|&k| corners[k]).unwrap_or(0);
                corners.rotate_left(least);
            });
            sorted.sort_unstable();
            assert_eq!(inside(&c, &refined), sorted, "{name}");
            for how in [Refinement::new().min_angle(30.0), Refinement::new().min_angle(25.0).conforming(true)]
            {
                let mut c = Constrained2::from_parts(&points, &[]).expect("finite");
                let before = c.clone();
                let refined = how.triangles(&given).run(&mut c).expect("it ends");
                judge(&before, &c, &refined, if refined.report.left.is_empty() { 25.0 } else { 0.0 }, name);
            }
        }
    }
}

#[test]
fn the_mesh_is_a_function_of_the_triangles() {
    let points = Kind::Uniform.points(80, 5);
    let triangles = flipped(&points, 5);
    let mesh = |points: &[[f64; 2]], triangles: &[[usize; 3]]| {
        let mut c = Constrained2::from_parts(points, &[]).expect("finite");
        let how = Refinement::new().min_angle(28.0).max_area(0.002).smooth(2);
        let refined = how.triangles(&named(triangles)).run(&mut c).expect("it ends");
        coordinates(&c, &refined)
    };
    let expected = mesh(&points, &triangles);
    let mut random = Random::new(9);
    for _ in 0..4 {
        let mut order: Vec<usize> = (0..points.len()).collect();
        random.shuffle(&mut order);
        let mut place = vec![0; points.len()];
        order.iter().enumerate().for_each(|(now, &before)| place[before] = now);
        let moved: Points = order.iter().map(|&before| points[before]).collect();
        let mut turned: Triangles = triangles.iter().map(|corners| corners.map(|v| place[v])).collect();
        turned.iter_mut().for_each(|corners| corners.rotate_left(random.below(3)));
        turned.reverse();
        assert_eq!(mesh(&moved, &turned), expected);
    }
}

#[test]
fn triangles_that_cannot_be_kept_are_errors() {
    let points = [[0, 0], [4, 0], [4, 4], [0, 4], [2, 0]];
    let mut c = Constrained2::from_parts(&points, &[[0, 2]]).expect("finite");
    let before = format!("{c:?}");
    let mut run = |triangles: &[[usize; 3]]| {
        let given = named(triangles);
        let error = Refinement::new().triangles(&given).run(&mut c).expect_err("it cannot be");
        assert_eq!(format!("{c:?}"), before);
        error
    };
    let crosses = "crosses a segment or another triangle";
    let of = |triangle, near, flaw| Error::KeptTriangle { triangle, near, flaw };
    assert_eq!(run(&[[0, 1, 2], [0, 1, 3]]), of(1, [2.0, 2.0], crosses));
    assert_eq!(run(&[[0, 1, 4]]), of(0, [2.0, 0.0], "has no area"));
    assert!(matches!(run(&[[0, 1, 9]]), Error::NoSuchVertex { .. }));
    // Two that cross each other, of which one is there already.
    let mut c = Constrained2::from_parts(&[[0, 0], [4, 0], [5, 4], [0, 4]], &[]).expect("finite");
    let given = named(&[[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]]);
    assert!(matches!(
        Refinement::new().triangles(&given).run(&mut c),
        Err(Error::KeptTriangle { flaw, .. }) if flaw == crosses
    ));
}

#[test]
fn lengths_of_edges_keep_nothing() {
    let (points, triangles) = grid(4, |_, _| false);
    let given = named(&triangles);
    let plain = Refinement::new().edge(0.5);
    let mut c = Constrained2::from_parts(&points, &[]).expect("finite");
    let expected = plain.run(&mut c).expect("it ends");
    let expected = coordinates(&c, &expected);
    let mut c = Constrained2::from_parts(&points, &[]).expect("finite");
    let kept = Refinement::new().min_angle(0.0).triangles(&given).run(&mut c).expect("it ends");
    let refined = plain.fill(Fill::Parts(&kept.domains)).run(&mut c).expect("it ends");
    assert_eq!(c.check(), Ok(()));
    assert!(refined.kept.is_empty());
    assert_eq!(coordinates(&c, &refined), expected);
}

/// Vertices on the sides of given triangles, and inside of them: they split what they are in.
#[test]
fn vertices_on_sides_split_given_triangles() {
    let points: Points = [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1], [1, 1]]
        .map(|p| p.map(f64::from))
        .to_vec();
    let given = [[0, 1, 2], [0, 2, 3]].map(|corners| corners.map(VertexId::new));
    let segments = [[0, 1], [1, 2], [2, 3], [3, 0]];
    for how in [
        Refinement::new().min_angle(0.0),
        Refinement::new().max_area(0.01),
        Refinement::new().min_angle(30.0),
    ] {
        let before = Constrained2::from_parts(&points, &segments).expect("finite");
        let mut c = before.clone();
        let refined = how.triangles(&given).run(&mut c).expect("it ends");
        c.check().expect("a triangulation");
        assert!((area(&c, |t| refined.domains.is_inside(t)) - 4.0).abs() < 1e-12);
    }
}
