//! Corners that are within a length of the hull of the others are left out.
//!
//! Points on the side of a box are on a plane no more once the box is turned: some are corners, by a last place. In rounds each corner is
//! measured against the hull of its neighbours, and of those within the length the nearest go first, no two neighbours in one round.
//! A point that was left out remembers a triangle of what is left that is within the length of it. When a corner of that triangle is to go,
//! another must be found, or it stays. So no point is ever further from the result than the length.
//!
//! Points are taken in lexicographic order, so that the order in which they are given does not show. What is left is an exact hull,
//! because it is made of its points alone; only distances are rounded.
//!
//! Cost: O(n log n) for n corners in each of a few rounds; the hull of its neighbours for each corner that does not stick out by more than
//! the length.

use delone_predicates::{lexicographic3, orient3d};

use super::super::merge::near_one;
use super::faces::Faces;
use super::join::{self, normal};
use super::{Hull3, Joined};
use crate::error::Error;
use crate::foot::{distance, minus};
use crate::mesh::Dimension;

/// Points and triangles that are compared for one corner at most, some tens of milliseconds; a corner that would take more stays. Only hubs come
/// near: a corner of 1,000 neighbours that holds 1,000 points.
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
    let (corners, length_there) = near_one(order.iter().map(|&i| points[i]).collect(), length);
    let left = left(&corners, length_there);
    let exact: Vec<[f64; 3]> = left.iter().map(|&k| points[order[k]]).collect();
    let made = Hull3::named(&exact, |i| i);
    if made.span < Dimension::Space {
        return Err(too_long(length));
    }
    let there: Vec<[f64; 3]> = left.iter().map(|&k| corners[k]).collect();
    let groups = join::groups(&there, &made.faces, length_there).ok_or_else(|| too_long(length))?;
    let name = |i: usize| order[left[i]];
    let rings = groups.polygons.iter().map(|(_, ring)| &ring[..]);
    let (polygons, before) = Faces::rows(rings).renamed(name);
    // By the face that others are joined to.
    let mut number = vec![0; groups.of.len()];
    (0..).zip(before).for_each(|(new, old)| number[groups.polygons[old as usize].0] = new);
    let (faces, before) = made.faces.renamed(name);
    let of = before.iter().map(|&old| number[groups.of[old as usize]]).collect();
    Ok(Hull3 { joined: Some(Joined { polygons, of }), ..Hull3::solid(faces) })
}

/// The corners that are left, as indices of all, which are corners in lexicographic order.
fn left(points: &[[f64; 3]], length: f64) -> Vec<usize> {
    let mut left: Vec<usize> = (0..points.len()).collect();
    let mut out =
        Out { points, length, near: vec![None; points.len()], held: vec![Vec::new(); points.len()] };
    loop {
        let at: Vec<[f64; 3]> = left.iter().map(|&i| points[i]).collect();
        let hull = Hull3::named(&at, |i| left[i]);
        if hull.span < Dimension::Space {
            return left;
        }
        // Without their neighbours corners may be in the middle of faces.
        let facets: Vec<[usize; 3]> = hull.facets().collect();
        for &v in left.iter().filter(|v| hull.corners.binary_search(v).is_err()) {
            out.leave(v, &facets);
        }
        left.clone_from(&hull.corners);
        let stars = Stars::of(points, &facets);
        let mut candidates: Vec<(f64, usize, Vec<[usize; 3]>)> = Vec::new();
        for &v in &left {
            if !stars.sticks_out(v, points, length)
                && let Some((part, fill)) = out.without(v, stars.around(v))
            {
                candidates.push((part, v, fill));
            }
        }
        if candidates.is_empty() {
            return left;
        }
        candidates.sort_unstable_by(|(p, v, _), (q, w, _)| p.total_cmp(q).then(v.cmp(w)));
        let mut stays = vec![false; points.len()];
        let mut goes = vec![false; points.len()];
        for (_, v, fill) in candidates {
            if !stays[v] {
                goes[v] = true;
                stars.around(v).iter().for_each(|&w| stays[w] = true);
                out.leave(v, &fill);
            }
        }
        left.retain(|&v| !goes[v]);
    }
}

/// What was left out.
struct Out<'a> {
    points: &'a [[f64; 3]],
    length: f64,
    /// For each point that was left out the corners of a triangle within the length.
    near: Vec<Option<[usize; 3]>>,
    /// For each corner the points that may be near to a triangle of its.
    held: Vec<Vec<usize>>,
}

impl Out<'_> {
    /// The nearest of some triangles, and its distance as a part of the length; none beyond that.
    fn nearest(&self, p: usize, triangles: &[[usize; 3]]) -> Option<(f64, [usize; 3])> {
        let q = self.points[p];
        let part = |triangle: &[usize; 3]| distance(q, triangle.map(|i| self.points[i])) / self.length;
        let near =
            triangles.iter().map(|triangle| (part(triangle), *triangle)).filter(|(part, _)| *part <= 1.0);
        near.min_by(|(p, _), (q, _)| p.total_cmp(q))
    }

    /// The points that a corner holds, and itself.
    fn with_held(&self, v: usize) -> impl Iterator<Item = usize> + '_ {
        let near = move |p: usize| self.near[p].is_some_and(|corners| corners.contains(&v));
        let held = self.held[v].iter().copied();
        std::iter::once(v).chain(held.filter(move |&p| near(p)))
    }

    /// The distance of a corner from the hull of its neighbours, as a part of the length, and the triangles of that which take its
    /// place; none if it, or what it holds, is further away than the length.
    fn without(&self, v: usize, around: &[usize]) -> Option<(f64, Vec<[usize; 3]>)> {
        let at: Vec<[f64; 3]> = around.iter().map(|&i| self.points[i]).collect();
        let hull = Hull3::named(&at, |i| around[i]);
        let q = self.points[v];
        let is_seen = |[a, b, c]: &[usize; 3]| {
            !orient3d(self.points[*a], self.points[*b], self.points[*c], q).is_negative()
        };
        let fill: Vec<[usize; 3]> = match hull.span {
            Dimension::Space => hull.facets().filter(is_seen).collect(),
            Dimension::Plane => {
                hull.corners[1..].windows(2).map(|side| [hull.corners[0], side[0], side[1]]).collect()
            }
            _ => return None,
        };
        if self.held[v].len().saturating_mul(fill.len()) > MOST_PAIRS {
            return None;
        }
        let (part, _) = self.nearest(v, &fill)?;
        self.with_held(v).all(|p| self.nearest(p, &fill).is_some()).then_some((part, fill))
    }

    /// A corner is left out, and some triangles take its place.
    fn leave(&mut self, v: usize, fill: &[[usize; 3]]) {
        let mut those: Vec<usize> = self.with_held(v).collect();
        those.sort_unstable();
        those.dedup();
        for p in those {
            self.near[p] = self.nearest(p, fill).map(|(_, triangle)| triangle);
            self.near[p].iter().flatten().for_each(|&w| self.held[w].push(p));
        }
        self.held[v] = Vec::new();
    }
}

/// The neighbours of corners, row after row, and where they look to.
struct Stars {
    starts: Vec<usize>,
    neighbors: Vec<usize>,
    normals: Vec<[f64; 3]>,
}

impl Stars {
    fn of(points: &[[f64; 3]], facets: &[[usize; 3]]) -> Self {
        let mut starts = vec![0; points.len() + 1];
        let mut normals = vec![[0.0; 3]; points.len()];
        // Each edge is left by one facet in either direction.
        let mut edges: Vec<[usize; 2]> = Vec::with_capacity(3 * facets.len());
        for &[a, b, c] in facets {
            edges.extend([[a, b], [b, c], [c, a]]);
            let (unit, _) = normal([a, b, c].map(|i| points[i]).into_iter());
            for v in [a, b, c] {
                starts[v + 1] += 1;
                normals[v] = [0, 1, 2].map(|k| normals[v][k] + unit[k]);
            }
        }
        edges.sort_unstable();
        (0..points.len()).for_each(|v| starts[v + 1] += starts[v]);
        Self { starts, neighbors: edges.into_iter().map(|[_, w]| w).collect(), normals }
    }

    fn around(&self, v: usize) -> &[usize] {
        &self.neighbors[self.starts[v]..self.starts[v + 1]]
    }

    /// Whether a corner is further than a length beyond a plane that has all its neighbours on the other side: then it is to stay.
    fn sticks_out(&self, v: usize, points: &[[f64; 3]], length: f64) -> bool {
        let [x, y, z] = self.normals[v];
        let size = (x * x + y * y + z * z).sqrt();
        self.around(v).iter().all(|&w| {
            let away = minus(points[v], points[w]);
            x * away[0] + y * away[1] + z * away[2] > length * size
        })
    }
}
