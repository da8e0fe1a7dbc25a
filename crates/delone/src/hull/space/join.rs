//! Faces of a hull that are in one plane within a length, joined to polygons.
//!
//! From the largest face on, each takes the faces around whose corners are all within the length of its plane, and that look the same way.
//! They are joined if they have one convex ring around them that holds all their corners, as in all hulls but those whose curvature is below
//! the length; else they stay as they are.
//!
//! Cost: O(f log f) for f sides of faces.

use std::cmp::Ordering;

use super::faces::Faces;
use super::sides::{Sides, value};
use super::start::turn;
use crate::closest::{cross, dot, minus};

/// No face yet.
const NONE: usize = usize::MAX;

/// The unit normal of a polygon, which points outside, and twice its area. Zero for one without area.
pub(super) fn normal(corners: impl Iterator<Item = [f64; 3]>) -> ([f64; 3], f64) {
    let mut corners = corners.peekable();
    let first = corners.peek().copied().unwrap_or_default();
    let (mut sum, mut before) = ([0.0; 3], [0.0; 3]);
    for corner in corners {
        let u = minus(corner, first);
        let normal = cross(before, u);
        sum = [0, 1, 2].map(|k| sum[k] + normal[k]);
        before = u;
    }
    let size = dot(sum, sum).sqrt();
    if size > 0.0 { (sum.map(|x| x / size), size) } else { ([0.0; 3], 0.0) }
}

/// Faces that are joined.
pub(super) struct Groups {
    /// For each face that which it is joined to.
    pub(super) of: Vec<usize>,
    /// The faces that others are joined to.
    pub(super) seeds: Vec<usize>,
    /// For each of these the ring around them all, from its least corner.
    pub(super) rings: Faces,
}

/// Joins the faces of a hull; none if all points are within the length of one plane.
pub(super) fn groups(points: &[[f64; 3]], faces: &Faces, length: f64) -> Option<Groups> {
    let at = |face: usize| faces.get(face).iter().map(|&i| points[i]);
    let across = across(points.len(), faces);
    let planes: Vec<([f64; 3], f64)> = (0..faces.iter().len()).map(|face| normal(at(face))).collect();
    // The corner that is furthest outside, along the normal.
    let plane = |face: usize| {
        let unit = planes[face].0;
        (unit, at(face).map(|p| dot(unit, p)).fold(f64::NEG_INFINITY, f64::max))
    };
    let is_near = |(unit, most): ([f64; 3], f64), p: [f64; 3]| most - dot(unit, p) <= length;
    // The largest first.
    let mut order: Vec<(f64, usize)> =
        planes.iter().enumerate().map(|(face, &(_, size))| (size, face)).collect();
    let by_size = |(p, f): &(f64, usize), (q, g): &(f64, usize)| q.total_cmp(p).then(f.cmp(g));
    let largest = plane(order.iter().min_by(|p, q| by_size(p, q))?.1);
    if points.iter().all(|&p| is_near(largest, p)) {
        return None;
    }
    let same = |plane: ([f64; 3], f64), next: usize| {
        dot(planes[next].0, plane.0) > 0.0 && at(next).all(|p| is_near(plane, p))
    };
    let is_alone = |face: usize| {
        let plane = plane(face);
        across[faces.range(face)].iter().all(|&next| !same(plane, next))
    };
    if (0..planes.len()).all(is_alone) {
        let each: Vec<usize> = (0..planes.len()).collect();
        return Some(Groups { of: each.clone(), seeds: each, rings: faces.clone() });
    }
    order.sort_unstable_by(by_size);
    let (mut group, mut seeds, mut rings) = (vec![NONE; planes.len()], Vec::new(), Faces::none());
    let mut members = Vec::new();
    for (_, seed) in order {
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
            for &next in &across[faces.range(face)] {
                if group[next] == NONE && same(plane, next) {
                    group[next] = seed;
                    members.push(next);
                }
            }
        }
        let is_border = |next: usize| group[next] != seed;
        let whole = if members.len() > 1 {
            ring(faces, &members, &across, is_border).filter(|ring| is_convex(points, ring, plane.0))
        } else {
            None
        };
        if whole.is_none() {
            members.iter().for_each(|&face| group[face] = NONE);
            group[seed] = seed;
        }
        seeds.push(seed);
        rings.push(whole.as_deref().unwrap_or_else(|| faces.get(seed)));
    }
    Some(Groups { of: group, seeds, rings })
}

/// The one ring around some faces, from its least corner, if it has all their corners; a side is on the border if the face across says so.
fn ring(
    faces: &Faces,
    members: &[usize],
    across: &[usize],
    is_border: impl Fn(usize) -> bool,
) -> Option<Vec<usize>> {
    let all = members.iter().flat_map(|&face| sides_of(faces.get(face)).zip(&across[faces.range(face)]));
    let mut border: Vec<[usize; 2]> =
        all.filter(|&(_, &next)| is_border(next)).map(|(side, _)| side).collect();
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

/// For each side of faces, in their order, the face across; hulls are closed.
fn across(corners: usize, faces: &Faces) -> Vec<usize> {
    let all = faces.iter().enumerate().flat_map(|(face, row)| sides_of(row).map(move |side| (side, face)));
    let sides = Sides::of(corners, all.clone().map(|([u, v], face)| (u, (v, face))));
    let face = |[u, v]: [usize; 2]| value(sides.leaving(v), u);
    all.map(|(side, _)| face(side).expect("each side is left by two faces, in either direction")).collect()
}

fn sides_of(face: &[usize]) -> impl Iterator<Item = [usize; 2]> + Clone + '_ {
    face.iter().zip(face.iter().cycle().skip(1)).map(|(&u, &v)| [u, v])
}
