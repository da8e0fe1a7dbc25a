//! Where a hull begins: four points that span space, far from each other; or what the points span instead.

use std::cmp::Ordering;

use delone_predicates::{are_collinear3, lexicographic3, orient2d, orient3d};

use super::super::plane;
use crate::closest::cross;
use crate::mesh::Dimension;

/// The orientation of three points seen along an axis.
pub(super) fn turn(points: &[[f64; 3]], corners: [usize; 3], axis: usize) -> Ordering {
    let [a, b, c] = corners.map(|i| without(points[i], axis));
    let sign = orient2d(a, b, c);
    if sign.is_positive() {
        Ordering::Greater
    } else if sign.is_negative() {
        Ordering::Less
    } else {
        Ordering::Equal
    }
}

/// The coordinates but one, in cyclic order.
pub(super) fn without(p: [f64; 3], axis: usize) -> [f64; 2] {
    [p[(axis + 1) % 3], p[(axis + 2) % 3]]
}

fn square(u: [f64; 3]) -> f64 {
    u.iter().map(|x| x * x).sum()
}

/// Where to begin.
pub(super) enum Start {
    Lower(Dimension, Vec<usize>),
    Flat(Vec<usize>),
    /// Four corners, the last one on the positive side of the others.
    Tetrahedron([usize; 4]),
}

impl Start {
    pub(super) fn of(points: &[[f64; 3]]) -> Self {
        let order = |i: &usize, j: &usize| lexicographic3(points[*i], points[*j]).then(i.cmp(j));
        let Some(a) = (0..points.len()).min_by(order) else {
            return Self::Lower(Dimension::Empty, Vec::new());
        };
        let last = |i: &usize, j: &usize| lexicographic3(points[*i], points[*j]).then(j.cmp(i));
        let b = (0..points.len()).max_by(last).unwrap_or(a);
        if points[a] == points[b] {
            return Self::Lower(Dimension::Point, vec![a]);
        }
        // Far from each other, as far as rounding tells; if it tells wrong, any that will do.
        let from = |i: usize, j: usize| [0, 1, 2].map(|k| points[j][k] / 2.0 - points[i][k] / 2.0);
        let along = from(a, b);
        let off_line = |i: usize| square(cross(along, from(a, i)));
        let furthest = |height: &dyn Fn(usize) -> f64| {
            (0..points.len()).max_by(|&i, &j| height(i).total_cmp(&height(j)).then(j.cmp(&i)))
        };
        let any = |holds: &dyn Fn(&usize) -> bool, best: Option<usize>| {
            best.filter(holds).or_else(|| (0..points.len()).find(holds))
        };
        let Some(c) = any(&|&c| !are_collinear3(points[a], points[b], points[c]), furthest(&off_line)) else {
            return Self::Lower(Dimension::Line, vec![a, b]);
        };
        let side = |d: usize| orient3d(points[a], points[b], points[c], points[d]);
        let normal = cross(along, from(a, c));
        let off_plane = |i: usize| (0..3).map(|k| normal[k] * from(a, i)[k]).sum::<f64>().abs();
        match any(&|&d| !side(d).is_zero(), furthest(&off_plane)) {
            Some(d) if side(d).is_positive() => Self::Tetrahedron([a, b, c, d]),
            Some(d) => Self::Tetrahedron([b, a, c, d]),
            None => {
                // Seen along an axis in which it does not vanish, a flat set keeps its corners.
                let axis = (0..3).find(|&axis| !turn(points, [a, b, c], axis).is_eq()).unwrap_or(2);
                let seen: Vec<[f64; 2]> = points.iter().map(|&p| without(p, axis)).collect();
                let mut corners = plane::corners(&seen);
                let first = (0..corners.len()).min_by(|&i, &j| order(&corners[i], &corners[j]));
                corners.rotate_left(first.unwrap_or(0));
                Self::Flat(corners)
            }
        }
    }
}
