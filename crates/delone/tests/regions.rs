//! Which rings make a region, and how they lie in each other, against the plainest definitions.

use delone::{Delaunay2, Error, Polygons2, Region2, RegionProblem, VertexId};
use delone_generators::Random;

type Rings = Vec<Vec<[f64; 2]>>;

/// Of small integers: exact.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn is_between(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> bool {
    let along = (0..2).all(|k| (a[k].min(b[k])..=a[k].max(b[k])).contains(&p[k]));
    turn(a, b, p) == 0.0 && along && p != a && p != b
}

/// Whether two sides share more than a corner of both.
fn clash([p, q]: [[f64; 2]; 2], [s, t]: [[f64; 2]; 2]) -> bool {
    let proper = turn(p, q, s) * turn(p, q, t) < 0.0 && turn(s, t, p) * turn(s, t, q) < 0.0;
    let same = (p == s && q == t) || (p == t && q == s);
    proper || same || is_between(p, q, s) || is_between(p, q, t) || is_between(s, t, p) || is_between(s, t, q)
}

/// Whether the sides of one ring are between those of another one around a corner of both.
fn cross_at(at: [f64; 2], [a, b]: [[f64; 2]; 2], others: [[f64; 2]; 2]) -> bool {
    let angle = |p: [f64; 2]| (p[1] - at[1]).atan2(p[0] - at[0]);
    let (low, high) = (angle(a).min(angle(b)), angle(a).max(angle(b)));
    let inside = |p: [f64; 2]| low < angle(p) && angle(p) < high;
    inside(others[0]) != inside(others[1])
}

fn sides(ring: &[[f64; 2]]) -> Vec<[[f64; 2]; 2]> {
    (0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]]).collect()
}

/// Rings whose sides clash are wrong, and rings that cross at corners.
fn is_valid(rings: &Rings) -> bool {
    let all: Vec<_> = rings.iter().flat_map(|ring| sides(ring)).collect();
    if (0..all.len()).any(|i| (0..i).any(|j| clash(all[i], all[j]))) {
        return false;
    }
    for (r, ring) in rings.iter().enumerate() {
        for other in &rings[..r] {
            let (n, m) = (ring.len(), other.len());
            for (i, &p) in ring.iter().enumerate() {
                for j in (0..m).filter(|&j| other[j] == p) {
                    let beside = [ring[(i + 1) % n], ring[(i + n - 1) % n]];
                    if cross_at(p, beside, [other[(j + 1) % m], other[(j + m - 1) % m]]) {
                        return false;
                    }
                }
            }
        }
    }
    true
}

/// Where an odd number of rings is around.
fn is_inside(rings: &Rings, [x, y]: [f64; 2]) -> bool {
    let mut inside = false;
    for [a, b] in rings.iter().flat_map(|ring| sides(ring)) {
        let at = || a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        inside ^= (a[1] > y) != (b[1] > y) && at() < x;
    }
    inside
}

#[test]
fn rings_are_accepted_as_the_definition_says() {
    let mut random = Random::new(1);
    let (mut valid, mut touching, mut nested) = (0, 0, 0);
    for _ in 0..100_000 {
        let extent = 4 + random.below(4);
        let mut rings: Rings = (0..=random.below(4))
            .map(|_| {
                let (x, y, size) = (random.below(extent), random.below(extent), 2 + random.below(extent));
                let corner = |r: &mut Random| [(x + r.below(size)) as f64, (y + r.below(size)) as f64];
                (0..3 + random.below(3)).map(|_| corner(&mut random)).collect()
            })
            .collect();
        if random.below(2) == 0 {
            // Around everything, and touched by what is at its corner.
            rings.insert(
                random.below(rings.len()),
                vec![[0.0, 0.0], [16.0, -1.0], [16.0, 16.0], [-1.0, 16.0]],
            );
        }
        let twice = |ring: &Vec<[f64; 2]>| (0..ring.len()).any(|i| ring[..i].contains(&ring[i]));
        if rings.iter().any(twice) {
            continue;
        }
        let found = Region2::polygon(&rings);
        assert_eq!(found.is_ok(), is_valid(&rings), "{rings:?}: {found:?}");
        let Ok(region) = found else { continue };
        valid += 1;
        let corners: Vec<_> = rings.iter().flatten().collect();
        touching += usize::from((0..corners.len()).any(|i| corners[..i].contains(&corners[i])));
        // Outer rings one way round, holes the other: the winding number is that of the even-odd rule.
        let count = rings.len();
        nested += usize::from(count > 1 && region.rings().any(|ring| area(ring) < 0.0));
        for k in 0..40 {
            // No integers, and on no side.
            let p = [random.unit() * 12.0, 0.037 + 0.29 * f64::from(k)];
            let mut winding = 0;
            for [a, b] in region.rings().flat_map(sides) {
                if (a[1] > p[1]) != (b[1] > p[1])
                    && a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) < p[0]
                {
                    winding += if a[1] > b[1] { 1 } else { -1 };
                }
            }
            assert_eq!(winding, i32::from(is_inside(&rings, p)), "{rings:?} at {p:?}");
        }
    }
    assert!(valid > 3000 && touching > 300 && nested > 100, "{valid} {touching} {nested}");
}

fn area(ring: &[[f64; 2]]) -> f64 {
    sides(ring).iter().map(|[p, q]| p[0] * q[1] - p[1] * q[0]).sum::<f64>() / 2.0
}

fn problem(rings: &[Vec<[f64; 2]>]) -> Option<(usize, usize, RegionProblem)> {
    match Region2::polygon(rings) {
        Err(Error::Region { ring, corner, problem }) => Some((ring, corner, problem)),
        _ => None,
    }
}

#[test]
fn rings_that_cross_at_shared_corners_are_named() {
    let first = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0]];
    let second = vec![[1.0, 1.0], [2.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0], [1.0, 2.0]];
    let crossing = |ring, corner| Some((ring, corner, RegionProblem::Crossing));
    assert_eq!(problem(&[first.clone(), second.clone()]), crossing(1, 5));
    assert_eq!(problem(&[second.clone(), first.clone()]), crossing(1, 4));
    // The first one from the left, wherever rings start and whichever way they go.
    for (k, l) in (0..12).flat_map(|k| (0..12).map(move |l| (k, l))) {
        let mut rings = [first.clone(), second.clone()];
        for (ring, k) in rings.iter_mut().zip([k, l]) {
            ring.rotate_left(k % 6);
            if k > 5 {
                ring.reverse();
            }
        }
        let at = rings[1].iter().position(|p| *p == [1.0, 2.0]).expect("a corner");
        assert_eq!(problem(&rings), crossing(1, at), "{k} {l}");
    }
    // Between the two sides of the other one.
    for k in 0..6 {
        let mut wide = [[0.0, 0.0], [2.0, -2.0], [2.0, 2.0]];
        wide.rotate_left(k % 3);
        if k > 2 {
            wide.reverse();
        }
        let at = wide.iter().position(|p| *p == [0.0, 0.0]).expect("a corner");
        let through = vec![[0.0, 0.0], [4.0, 0.5], [-4.0, 8.0]];
        assert_eq!(problem(&[through, wide.to_vec()]), crossing(1, at), "{k}");
    }
    // Touching is fine: beside each other, one in the other, four at one corner.
    let wedge = |from: [f64; 2], to: [f64; 2]| vec![[0.0, 0.0], from, to];
    let beside = [wedge([2.0, 0.0], [2.0, 1.0]), wedge([1.0, 2.0], [0.0, 2.0])];
    assert_eq!(Region2::polygon(&beside).map(|region| region.area()), Ok(2.0));
    let within = [wedge([3.0, 0.0], [0.0, 3.0]), wedge([1.0, 0.5], [0.5, 1.0])];
    assert_eq!(Region2::polygon(&within).map(|region| region.area()), Ok(4.5 - 0.375));
    let four = [
        wedge([3.0, 0.0], [0.0, 3.0]),
        wedge([-3.0, 0.0], [0.0, -3.0]),
        wedge([1.0, 0.5], [0.5, 1.0]),
        wedge([3.0, -1.0], [3.0, -2.0]),
    ];
    assert_eq!(Region2::polygon(&four).map(|region| region.area()), Ok(9.0 - 0.375 + 1.5));
    let d = Delaunay2::from_points(&[[0.5, 0.5], [2.5, -1.0], [-1.0, -1.0]]).expect("finite");
    let region = Region2::polygon(&four).expect("a region");
    let cells = d.voronoi().clip(&region);
    let sum: f64 = d.vertices().map(|v| cells.area(v)).sum();
    assert!((sum - region.area()).abs() < 1e-12);
}

#[test]
fn coordinates_of_all_sizes_are_compared_exactly() {
    let tiny = f64::from_bits(1);
    // A corner one unit in the last place beside a side, on either side of it.
    let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let inside = vec![[tiny, 0.5], [0.5, 0.25], [0.5, 0.75]];
    assert_eq!(Region2::polygon(&[square.clone(), inside.clone()]).map(|region| region.area()), Ok(0.875));
    let outside: Vec<[f64; 2]> = inside.iter().map(|p| [0.0 - p[0], p[1]]).collect();
    assert_eq!(Region2::polygon(&[square.clone(), outside]).map(|region| region.area()), Ok(1.125));
    let on = vec![[0.0, 0.5], [0.5, 0.25], [0.5, 0.75]];
    assert_eq!(problem(&[square, on]).map(|p| p.2), Some(RegionProblem::Crossing));
    let huge = f64::MAX;
    let all = vec![[-huge, -huge], [huge, -huge], [huge, huge], [-huge, huge]];
    let small = vec![[0.0, 0.0], [tiny, 0.0], [0.0, tiny]];
    let region = Region2::polygon(&[small, all]).expect("nested");
    assert_eq!(region.rings().next().map(|ring| ring[0]), Some([0.0, tiny]), "the hole is clockwise");
}

/// Not -0.0, which files would show.
#[test]
fn nothing_has_the_size_zero() {
    let d = Delaunay2::from_points(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [9.0, 9.0]]).expect("finite");
    let region = Region2::rectangle([0.0, 0.0], [1.0, 1.0]).expect("a box");
    let cells = d.voronoi().clip(&region);
    let far = VertexId::new(3);
    assert_eq!(cells.rings(far).count(), 0);
    for size in [cells.area(far), cells.perimeter(far), cells.second_moment(far, [0.0, 0.0])] {
        assert_eq!(size.to_bits(), 0.0_f64.to_bits(), "{size:?}");
    }
    let nothing = Polygons2::default().triangulate::<Vec<[f64; 2]>>(&[]);
    assert_eq!(nothing.expect("no polygon").area().to_bits(), 0.0_f64.to_bits());
}
