//! The triangles between the neighbors of a corner that take its place on the hull.
//!
//! They are the facets of the hull of the neighbors that the corner sees. Each two of them meet in an edge, and those that meet one other
//! are ears of the ring: three neighbors in a row with all others below their plane. For a few neighbors ears are cut off until three are
//! left; for many, and where more than three are in one plane, the hull is made.
//!
//! Source: Devillers, "On deletion in Delaunay triangulations", IJCGA 2002, for ears. Cost: O(k^3) for k neighbors, but they are few; else
//! O(k log k).

use delone_predicates::{Sign, orient3d};

use super::Hull3;
use crate::mesh::Dimension;

/// Neighbors, up to which a hole is filled by ears; with more of them a hull is faster.
const EAR_NEIGHBORS: usize = 16;

/// The triangles that take the place of a corner with a ring of neighbors, seen from the corner; each from its least neighbor, sorted. None
/// if there are no such, as for points that are not those of the hull.
pub(super) fn fill(points: &[[f64; 3]], v: usize, ring: &[usize]) -> Option<Vec<[usize; 3]>> {
    let ears = if ring.len() <= EAR_NEIGHBORS { ears(points, ring) } else { None };
    let mut fill = ears.or_else(|| seen(points, v, ring))?;
    for triangle in &mut fill {
        let least = (0..3).min_by_key(|&k| triangle[k]).unwrap_or(0);
        triangle.rotate_left(least);
    }
    fill.sort_unstable();
    Some(fill)
}

/// Fills by ears, in any order; none where four points are in one plane.
fn ears(points: &[[f64; 3]], ring: &[usize]) -> Option<Vec<[usize; 3]>> {
    let mut rest = ring.to_vec();
    let mut fill = Vec::with_capacity(ring.len());
    // Ears that are none, one after the other.
    let (mut k, mut missed) = (0, 0);
    while rest.len() > 3 {
        let n = rest.len();
        let ear = [k, (k + 1) % n, (k + 2) % n];
        let [a, b, c] = ear.map(|i| points[rest[i]]);
        let mut others = (0..n).filter(|i| !ear.contains(i)).map(|i| orient3d(a, b, c, points[rest[i]]));
        match others.find(|side| !side.is_negative()) {
            None => {
                fill.push(ear.map(|i| rest[i]));
                rest.remove(ear[1]);
                (k, missed) = (k % rest.len(), 0);
            }
            Some(Sign::Zero) => return None,
            Some(_) if missed == n => return None,
            Some(_) => (k, missed) = (ear[1], missed + 1),
        }
    }
    fill.push([*rest.first()?, *rest.get(1)?, *rest.get(2)?]);
    Some(fill)
}

/// Fills by the hull of the neighbors.
fn seen(points: &[[f64; 3]], v: usize, ring: &[usize]) -> Option<Vec<[usize; 3]>> {
    // In order of their indices, as the hull of all of them has them.
    let mut around = ring.to_vec();
    around.sort_unstable();
    let at: Vec<[f64; 3]> = around.iter().map(|&i| points[i]).collect();
    let hull = Hull3::named(&at, |i| around[i]);
    let side = |[a, b, c]: [usize; 3]| orient3d(points[a], points[b], points[c], points[v]);
    match hull.span {
        Dimension::Space => Some(hull.facets().filter(|&facet| !side(facet).is_negative()).collect()),
        Dimension::Plane => {
            let corners = &hull.corners;
            let fan = corners[1..].windows(2).map(|ends| [corners[0], ends[0], ends[1]]);
            let outwards = |[a, b, c]: [usize; 3]| {
                if side([a, b, c]).is_negative() { [a, c, b] } else { [a, b, c] }
            };
            Some(fan.map(outwards).collect())
        }
        _ => None,
    }
}

/// Whether triangles that share edges are in one plane.
pub(super) fn is_flat(points: &[[f64; 3]], fill: &[[usize; 3]]) -> bool {
    let Some(&[a, b, c]) = fill.first() else { return true };
    fill.iter().flatten().all(|&d| orient3d(points[a], points[b], points[c], points[d]).is_zero())
}
