//! Convex hulls by definition: all points are on one side of the plane of a face.

use std::collections::BTreeSet;

use super::delaunay::combinations;
use super::exact::{Vector, along, axes, cofactors, dot, integers, minus, orientation, sign, squared};

/// The first index of each distinct point.
fn firsts<const D: usize>(points: &[[f64; D]]) -> Vec<usize> {
    (0..points.len()).filter(|&i| (0..i).all(|j| points[j] != points[i])).collect()
}

/// The corners of the hull of points of the plane, counter-clockwise from the lexicographically smallest; the two ends
/// for points on a line; of equal points the first.
pub(crate) fn corners2(points: &[[f64; 2]]) -> Vec<usize> {
    let kept = firsts(points);
    let exact = integers(points);
    cycle(&exact, &kept, |i| points[i])
}

/// The hull of integer points with two coordinates, with an order for the first of the cycle.
fn cycle<T: PartialOrd>(exact: &[Vector], kept: &[usize], key: impl Fn(usize) -> T) -> Vec<usize> {
    let least = |among: &[usize]| among.iter().copied().reduce(|i, j| if key(j) < key(i) { j } else { i });
    let is_side = |i: usize, j: usize| {
        kept.iter().filter(|&&k| k != i && k != j).all(|&k| {
            match orientation(&[&exact[i], &exact[j], &exact[k]]) {
                0 => sign(&dot(&minus(&exact[i], &exact[k]), &minus(&exact[j], &exact[k]))) < 0,
                side => side > 0,
            }
        })
    };
    let mut corners: Vec<usize> = least(kept).into_iter().collect();
    while let Some(&at) = corners.last() {
        match kept.iter().copied().find(|&next| next != at && is_side(at, next)) {
            Some(next) if next != corners[0] => corners.push(next),
            _ => break,
        }
    }
    corners
}

/// The hull of points in space: what they span, and its faces as [`corners2`] has them, seen from outside. A flat set has
/// one face, seen from either side; less has one `face` of two corners or one.
pub(crate) fn faces(points: &[[f64; 3]]) -> (usize, Vec<Vec<usize>>) {
    let kept = firsts(points);
    let exact = integers(points);
    let distinct: Vec<Vector> = kept.iter().map(|&i| exact[i].clone()).collect();
    let all = axes(&distinct);
    if all.len() < 3 {
        return (all.len(), vec![flat(&exact, &kept, &all, points)]);
    }
    let mut planes = BTreeSet::new();
    let mut found = Vec::new();
    combinations(kept.len(), 3, &mut Vec::new(), &mut |chosen| {
        let [a, b, c] = [0, 1, 2].map(|k| &exact[kept[chosen[k]]]);
        let normal = cofactors(&[minus(b, a), minus(c, a)]);
        if normal.iter().all(|x| sign(x) == 0) {
            return;
        }
        let sides: Vec<i8> = kept.iter().map(|&i| sign(&dot(&normal, &minus(&exact[i], a)))).collect();
        if sides.contains(&1) && sides.contains(&-1) {
            return;
        }
        let on: Vec<usize> = (0..kept.len()).filter(|&k| sides[k] == 0).map(|k| kept[k]).collect();
        if !planes.insert(on.clone()) {
            return;
        }
        let of_face: Vec<Vector> = on.iter().map(|&i| exact[i].clone()).collect();
        let seen = axes(&of_face);
        let mut face = flat(&exact, &on, &seen, points);
        // Projected along the missing axis it is counter-clockwise from above; y of an odd axis is turned over.
        let missing = (0..3).find(|k| !seen.contains(k)).unwrap_or(2);
        let outward = if sides.contains(&1) { -sign(&normal[missing]) } else { sign(&normal[missing]) };
        let turned = if missing == 1 { -outward } else { outward };
        if turned < 0 {
            face[1..].reverse();
        }
        found.push(face);
    });
    found.sort();
    (3, found)
}

fn flat(exact: &[Vector], kept: &[usize], axes: &[usize], points: &[[f64; 3]]) -> Vec<usize> {
    // A line or a point has coordinates to spare, which are the same everywhere.
    let of = |p: &Vector| {
        let mut flat = along(p, axes);
        flat.resize(2, 0.into());
        flat
    };
    let flat: Vec<Vector> = exact.iter().map(of).collect();
    cycle(&flat, kept, |i| points[i])
}

/// Whether the hull of points does not grow by another one.
pub(crate) fn contains(points: &[[f64; 3]], q: [f64; 3]) -> bool {
    let mut more = points.to_vec();
    more.push(q);
    !faces(&more).1.concat().contains(&points.len())
}

/// The index of the point that is extreme in distance from q, the lexicographically smallest and first of several.
pub(crate) fn by_distance<const D: usize>(points: &[[f64; D]], q: [f64; D], furthest: bool) -> Option<usize> {
    let mut all = points.to_vec();
    all.push(q);
    let exact = integers(&all);
    let (q, exact) = exact.split_last()?;
    let distances: Vec<_> = exact.iter().map(|p| squared(p, q)).collect();
    (0..points.len()).min_by(|&i, &j| {
        let order = distances[i].cmp(&distances[j]);
        let order = if furthest { order.reverse() } else { order };
        order.then(points[i].partial_cmp(&points[j]).expect("finite")).then(i.cmp(&j))
    })
}

#[cfg(test)]
mod tests {
    use super::{by_distance, contains, corners2, faces};

    #[test]
    fn hulls_in_the_plane() {
        let points = [[1.0, 0.0], [0.0, 0.0], [2.0, 0.0], [0.0, 0.0], [2.0, 2.0], [1.0, 1.0], [0.0, 2.0]];
        assert_eq!(corners2(&points), [1, 2, 4, 6]);
        assert_eq!(corners2(&[[3.0, 3.0], [1.0, 1.0], [2.0, 2.0]]), [1, 0]);
        assert_eq!(corners2(&[[1.0, 1.0]; 2]), [0]);
    }

    #[test]
    fn the_hull_of_a_cube() {
        let mut cube: Vec<[f64; 3]> = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from)).collect();
        cube.push([0.5; 3]);
        let (span, found) = faces(&cube);
        assert_eq!((span, found.len()), (3, 6));
        assert!(found.contains(&vec![0, 2, 3, 1]), "seen from below: {found:?}");
        assert!(found.contains(&vec![0, 1, 5, 4]), "seen from the front: {found:?}");
        assert!(contains(&cube, [0.0, 0.5, 1.0]));
        assert!(!contains(&cube, [0.0, -1e-300, 1.0]));
    }

    #[test]
    fn flat_hulls_in_space() {
        let line = [[0.0; 3], [2.0; 3], [1.0; 3]];
        assert_eq!(faces(&line), (1, vec![vec![0, 1]]));
        let square = [[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [0.0, 1.0, 2.0], [0.0, 0.0, 2.0], [0.0, 0.5, 1.5]];
        assert_eq!(faces(&square).1[0].len(), 4);
        assert!(contains(&square, [0.0, 0.25, 1.0]));
        assert!(!contains(&square, [1e-300, 0.25, 1.0]));
    }

    #[test]
    fn extremes_in_distance() {
        let points = [[2.0, 0.0], [0.0, 2.0], [0.0, 2.0], [3.0, 0.0]];
        assert_eq!(by_distance(&points, [0.0, 0.0], false), Some(1));
        assert_eq!(by_distance(&points, [0.0, 0.0], true), Some(3));
    }
}
