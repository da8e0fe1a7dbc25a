//! Faces of a hull that are in one plane within a length, joined to polygons.
//!
//! From the largest face on, each takes the faces around whose corners are all within the length of its plane, and that look the same way.
//! They are joined if they have one convex ring around them that holds all their corners, as in all hulls but those whose curvature is below
//! the length; else they stay as they are.
//!
//! Cost: O(f log f) for f sides of faces.

use std::cmp::Ordering;

use super::faces::Faces;
use super::start::turn;
use crate::foot::{dot, minus};

/// No face yet.
const NONE: usize = usize::MAX;

/// The unit normal of a polygon, which points outside, and twice its area. Zero for one without area.
pub(super) fn normal(corners: impl Iterator<Item = [f64; 3]>) -> ([f64; 3], f64) {
    let mut corners = corners.peekable();
    let first = corners.peek().copied().unwrap_or_default();
    let (mut sum, mut before) = ([0.0; 3], [0.0; 3]);
    for corner in corners {
        let u = minus(corner, first);
        sum = [0, 1, 2]
            .map(|k| sum[k] + before[(k + 1) % 3] * u[(k + 2) % 3] - before[(k + 2) % 3] * u[(k + 1) % 3]);
        before = u;
    }
    let size = dot(sum, sum).sqrt();
    if size > 0.0 { (sum.map(|x| x / size), size) } else { ([0.0; 3], 0.0) }
}

/// Faces that are joined.
pub(super) struct Groups {
    /// For each face that which it is joined to.
    pub(super) of: Vec<usize>,
    /// The faces that others are joined to, each with the ring around them all, from its least corner.
    pub(super) polygons: Vec<(usize, Vec<usize>)>,
}

/// Joins the faces of a hull; none if all points are within the length of one plane.
pub(super) fn groups(points: &[[f64; 3]], faces: &Faces, length: f64) -> Option<Groups> {
    let at = |face: usize| faces.get(face).iter().map(|&i| points[i]);
    let sides = Sides::of(faces);
    let planes: Vec<([f64; 3], f64)> = (0..faces.iter().len()).map(|face| normal(at(face))).collect();
    let mut order: Vec<usize> = (0..planes.len()).collect();
    order.sort_by(|&f, &g| planes[g].1.total_cmp(&planes[f].1));
    // The corner that is furthest outside, along the normal.
    let plane = |face: usize| {
        let unit = planes[face].0;
        (unit, at(face).map(|p| dot(unit, p)).fold(f64::NEG_INFINITY, f64::max))
    };
    let is_near = |(unit, most): ([f64; 3], f64), p: [f64; 3]| most - dot(unit, p) <= length;
    let largest = plane(order[0]);
    if points.iter().all(|&p| is_near(largest, p)) {
        return None;
    }
    let (mut group, mut polygons) = (vec![NONE; planes.len()], Vec::new());
    let mut members = Vec::new();
    for seed in order {
        if group[seed] != NONE {
            continue;
        }
        let plane = plane(seed);
        group[seed] = seed;
        members.clear();
        members.push(seed);
        let mut k = 0;
        while let Some(&face) = members.get(k) {
            k += 1;
            for [u, v] in sides_of(faces.get(face)) {
                let next = sides.face([v, u]);
                let same =
                    |next: usize| dot(planes[next].0, plane.0) > 0.0 && at(next).all(|p| is_near(plane, p));
                if group[next] == NONE && same(next) {
                    group[next] = seed;
                    members.push(next);
                }
            }
        }
        let is_border = |[u, v]: [usize; 2]| group[sides.face([v, u])] != seed;
        let whole = ring(faces, &members, is_border).filter(|ring| is_convex(points, ring, plane.0));
        if whole.is_none() {
            members.iter().for_each(|&face| group[face] = NONE);
            group[seed] = seed;
        }
        polygons.push((seed, whole.unwrap_or_else(|| faces.get(seed).to_vec())));
    }
    Some(Groups { of: group, polygons })
}

/// The one ring around some faces, from its least corner, if it has all their corners; of their sides those are given that are on the border.
fn ring(faces: &Faces, members: &[usize], is_border: impl Fn([usize; 2]) -> bool) -> Option<Vec<usize>> {
    if let [face] = members {
        return Some(faces.get(*face).to_vec());
    }
    let all = members.iter().flat_map(|&face| sides_of(faces.get(face)));
    let mut border: Vec<[usize; 2]> = all.filter(|&side| is_border(side)).collect();
    border.sort_unstable();
    let first = border.first()?[0];
    let mut ring = vec![first];
    let follow = |u: usize| border.binary_search_by_key(&u, |side| side[0]).ok().map(|k| border[k][1]);
    while let Some(v) = follow(*ring.last()?).filter(|&v| v != first) {
        if ring.len() == border.len() {
            return None;
        }
        ring.push(v);
    }
    let mut corners: Vec<usize> = members.iter().flat_map(|&face| faces.get(face)).copied().collect();
    corners.sort_unstable();
    corners.dedup();
    (ring.len() == border.len() && ring.len() == corners.len()).then_some(ring)
}

/// Whether a ring turns left everywhere, seen against a normal along the axis that is nearest to this. It is the border of faces that all look
/// along the normal, so it goes around once.
fn is_convex(points: &[[f64; 3]], ring: &[usize], normal: [f64; 3]) -> bool {
    let axis = (0..3).max_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs())).unwrap_or(0);
    let right = if normal[axis] > 0.0 { Ordering::Less } else { Ordering::Greater };
    let n = ring.len();
    (0..n).all(|k| turn(points, [0, 1, 2].map(|i| ring[(k + i) % n]), axis) != right)
}

fn sides_of(face: &[usize]) -> impl Iterator<Item = [usize; 2]> + '_ {
    face.iter().zip(face.iter().cycle().skip(1)).map(|(&u, &v)| [u, v])
}

/// The sides of all faces, sorted.
struct Sides(Vec<([usize; 2], usize)>);

impl Sides {
    fn of(faces: &Faces) -> Self {
        let rows = faces.iter().enumerate();
        let mut all: Vec<_> =
            rows.flat_map(|(face, row)| sides_of(row).map(move |side| (side, face))).collect();
        all.sort_unstable();
        Self(all)
    }

    /// The face that a side belongs to; hulls are closed.
    fn face(&self, side: [usize; 2]) -> usize {
        let found = self.0.binary_search_by_key(&side, |&(side, _)| side);
        self.0[found.expect("each side is left by two faces, in either direction")].1
    }
}
