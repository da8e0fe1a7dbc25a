//! Corners that are within a length of the hull of the others are left out.
//!
//! Points on the side of a box are on a plane no more once the box is turned: some are corners, by a last place. In rounds each corner is
//! measured against the hull of its neighbors, and of those within the length the nearest go first, no two neighbors in one round.
//! A point that was left out remembers a triangle of what is left that is within the length of it. When a corner of that triangle is to go,
//! another must be found, or it stays. So no point is ever further from the result than the length.
//!
//! Points are taken in lexicographic order, so that the order in which they are given does not show. What is left is an exact hull,
//! because it is made of its points alone; only distances are rounded, upwards.
//!
//! After the first round only corners around those that went are measured again (`rings.rs`): no other could go.
//!
//! Cost: O(n log n) for n corners; for each corner that is measured, the hull of its neighbors and the distances of what it holds.

use delone_predicates::lexicographic3;

use super::super::merge::near_one;
use super::fill::{fill, is_flat};
use super::join;
use super::rings::Rings;
use super::{Hull3, Joined, SIZES};
use crate::closest::{cross, distance_bound, dot, minus};
use crate::error::Error;
use crate::mesh::Dimension;
use crate::order::quantize::scaled;
use crate::tally::Tally;

/// Points and triangles that are compared for one corner at most, some tens of milliseconds; a corner that would take more stays. Only hubs come
/// near: a corner of 1,000 neighbors that holds 1,000 points.
const MOST_PAIRS: usize = 1 << 20;

/// A length that leaves nothing.
fn too_long(length: f64) -> Error {
    Error::Parameter {
        name: "merge",
        value: length,
        range: "less than the thickness of the hull, which is flat within this",
    }
}

/// A hull without the corners and edges that are within a length.
pub(super) fn merged(hull: &Hull3, points: &[[f64; 3]], length: f64) -> Result<Hull3, Error> {
    if hull.span < Dimension::Space || length == 0.0 {
        return Ok(hull.clone());
    }
    let mut order = hull.corners.clone();
    order.sort_unstable_by(|&i, &j| lexicographic3(points[i], points[j]));
    let corners: Vec<[f64; 3]> = order.iter().map(|&i| points[i]).collect();
    let scaled = scaled(corners.len(), |i| corners[i], &SIZES);
    let exact = scaled.as_ref().map_or(&corners, |(corners, _)| corners);
    let (near, length_there) = near_one(corners.clone(), length);
    let mut place = vec![0; points.len()];
    order.iter().enumerate().for_each(|(k, &i)| place[i] = k);
    let (all, _) = hull.faces.clone().renamed(|i| place[i]);
    let all =
        Hull3 { corners: (0..corners.len()).collect(), faces: all, span: Dimension::Space, joined: None };
    let left = left(exact, &near, all.facets().collect(), length_there, &mut ());
    let made = if left.len() == corners.len() {
        all
    } else {
        let exact: Vec<[f64; 3]> = left.iter().map(|&k| exact[k]).collect();
        Hull3::named(&exact, |i| i)
    };
    if made.span < Dimension::Space {
        return Err(too_long(length));
    }
    let there: Vec<[f64; 3]> = left.iter().map(|&k| near[k]).collect();
    let groups = join::groups(&there, &made.faces, length_there).ok_or_else(|| too_long(length))?;
    if left.len() == corners.len() && groups.seeds.len() == groups.of.len() {
        return Ok(Hull3 { joined: None, ..hull.clone() });
    }
    let name = |i: usize| order[left[i]];
    let (polygons, before) = groups.rings.renamed(name);
    // By the face that others are joined to.
    let mut number = vec![0; groups.of.len()];
    (0..).zip(before).for_each(|(new, old)| number[groups.seeds[old as usize]] = new);
    let (faces, before) = made.faces.renamed(name);
    let of = before.iter().map(|&old| number[groups.of[old as usize]]).collect();
    Ok(Hull3 { joined: Some(Joined { polygons, of }), ..Hull3::solid(faces) })
}

/// The corners that are left, as indices of all, which are corners in lexicographic order with the facets of their hull. Decisions are for
/// `exact`, distances for `near`, the same points near to one.
fn left(
    exact: &[[f64; 3]],
    near: &[[f64; 3]],
    facets: Vec<[usize; 3]>,
    length: f64,
    tally: &mut impl Tally,
) -> Vec<usize> {
    let mut rings = Rings::of(near.len(), &facets);
    drop(facets);
    let mut out =
        Out { points: near, length, near: vec![None; near.len()], held: vec![Vec::new(); near.len()] };
    let mut left: Vec<usize> = (0..near.len()).collect();
    // A corner that did not go, and whose ring is the same still, does not go now.
    let mut changed = left.clone();
    let (mut stays, mut goes) = (vec![0; near.len()], vec![false; near.len()]);
    for round in 1.. {
        let mut candidates: Vec<(f64, usize, Vec<[usize; 3]>)> = Vec::new();
        for &v in &changed {
            let ring = rings.around(v);
            if sticks_out(near, v, ring, length) {
                continue;
            }
            tally.compared();
            if let Some(fill) = fill(exact, v, ring)
                && let Some(part) = out.without(v, &fill)
            {
                candidates.push((part, v, fill));
            }
        }
        // Of equal ones hubs come last: a hub that goes keeps all around it for the next round.
        candidates.sort_unstable_by(|(p, v, f), (q, w, g)| {
            p.total_cmp(q).then(f.len().cmp(&g.len())).then(v.cmp(w))
        });
        let (mut changes, mut count) = (Vec::new(), left.len());
        for (_, v, fill) in candidates {
            let ring = rings.around(v);
            if stays[v] == round {
                continue;
            }
            let Some(change) = rings.changes(v, &fill) else { continue };
            changes.extend(change);
            goes[v] = true;
            ring.iter().for_each(|&w| stays[w] = round);
            out.leave(v, &fill);
            if ring.len() + 1 == count && is_flat(exact, &fill) {
                return ring.to_vec();
            }
            count -= 1;
        }
        changed = rings.change(changes);
        if changed.is_empty() {
            break;
        }
        left.retain(|&v| !goes[v]);
    }
    left
}

/// Points that were left out.
struct Out<'a> {
    points: &'a [[f64; 3]],
    length: f64,
    /// For each point that was left out the corners of a triangle within the length.
    near: Vec<Option<[usize; 3]>>,
    /// For each corner the points that may be near to a triangle of its.
    held: Vec<Vec<usize>>,
}

impl Out<'_> {
    /// The distance of a point from a triangle as a part of the length; none beyond that.
    fn part(&self, p: usize, triangle: [usize; 3]) -> Option<f64> {
        let part = distance_bound(self.points[p], triangle.map(|i| self.points[i])) / self.length;
        (part <= 1.0).then_some(part)
    }

    /// The nearest of some triangles, and its distance as a part of the length; none beyond that.
    fn nearest(&self, p: usize, triangles: &[[usize; 3]]) -> Option<(f64, [usize; 3])> {
        let near = triangles.iter().filter_map(|&triangle| Some((self.part(p, triangle)?, triangle)));
        near.min_by(|(p, _), (q, _)| p.total_cmp(q))
    }

    /// The distance of a corner from the triangles that would take its place, as a part of the length; none if it, or a point that it
    /// holds, is further away than the length.
    fn without(&mut self, v: usize, fill: &[[usize; 3]]) -> Option<f64> {
        let (part, _) = self.nearest(v, fill)?;
        let mut held = std::mem::take(&mut self.held[v]);
        held.retain(|&p| self.near[p].is_some_and(|corners| corners.contains(&v)));
        let is_far = |&p: &usize| fill.iter().all(|&triangle| self.part(p, triangle).is_none());
        let far = match held.len().saturating_mul(fill.len()) {
            0..=MOST_PAIRS => held.iter().position(is_far),
            _ => Some(0),
        };
        // A point that is too far away is likely to be so next time: it is asked first.
        far.into_iter().for_each(|k| held.swap(0, k));
        self.held[v] = held;
        far.is_none().then_some(part)
    }

    /// A corner is left out, and some triangles take its place.
    fn leave(&mut self, v: usize, fill: &[[usize; 3]]) {
        for p in std::mem::take(&mut self.held[v]).into_iter().chain([v]) {
            let before = self.near[p].unwrap_or([v; 3]);
            self.near[p] = self.nearest(p, fill).map(|(_, triangle)| triangle);
            let fresh = self.near[p].into_iter().flatten().filter(|w| !before.contains(w));
            fresh.for_each(|w| self.held[w].push(p));
        }
    }
}

/// Whether a corner is further than a length beyond a plane that has all its neighbors on the other side: then it is to stay.
fn sticks_out(points: &[[f64; 3]], v: usize, ring: &[usize], length: f64) -> bool {
    let mut sum = [0.0; 3];
    let to = |w: usize| minus(points[w], points[v]);
    let mut before = ring.last().map_or([0.0; 3], |&w| to(w));
    for w in ring.iter().map(|&w| to(w)) {
        let normal = cross(before, w);
        sum = [0, 1, 2].map(|k| sum[k] + normal[k]);
        before = w;
    }
    let least = length * dot(sum, sum).sqrt();
    ring.iter().all(|&w| -dot(sum, to(w)) > least)
}

#[cfg(test)]
mod tests {
    use super::{left, lexicographic3};
    use crate::hull::Hull3;
    use crate::tally::Work;
    use delone_generators::Random;

    fn sphere(count: usize, random: &mut Random) -> Vec<[f64; 3]> {
        let mut point = || loop {
            let p = [0; 3].map(|_| random.between(-1.0, 1.0));
            let size = p.iter().map(|x| x * x).sum::<f64>().sqrt();
            if (0.1..=1.0).contains(&size) {
                break p.map(|x| x / size);
            }
        };
        let mut points: Vec<[f64; 3]> = (0..count).map(|_| point()).collect();
        points.sort_unstable_by(|p, q| lexicographic3(*p, *q));
        points
    }

    #[test]
    fn corners_are_measured_again_only_beside_those_that_went() {
        let points = sphere(3000, &mut Random::new(21));
        let hull = Hull3::from_points(&points).expect("finite");
        let of = |length: f64| {
            let mut work = Work::default();
            let left = left(&points, &points, hull.facets().collect(), length, &mut work);
            (points.len() - left.len(), work.compared as usize)
        };
        assert_eq!(of(1e-12), (0, 0), "all stick out");
        for (length, least) in [(1e-4, 1), (1e-3, 500), (1e-2, 2500)] {
            let (gone, measured) = of(length);
            // A corner has six neighbors in the mean, and each is measured at first.
            assert!(gone >= least && measured <= points.len() + 6 * gone, "{length}: {gone} {measured}");
        }
    }
}
