//! The hull by flips: points in random order, each joined to the facet in front of it, edges flipped until nothing is seen.
//!
//! A point is looked for along the ray to it from a point o inside of the first tetrahedron. The facet that the ray leaves the
//! hull by tells whether the point is outside, and is split in three then. Across each edge of the star of the new point, if
//! the point sees what is there, the edge is flipped; or a corner with three facets, which the point has covered, is cut off
//! (three facets give way to one). An edge whose flip would fold the hull waits until its neighbors have been flipped. No
//! facet is forgotten: each points to the one, two or three that took its place, which the ray is traced through. A facet on the way
//! that has the point behind it ends the search: the point is inside.
//!
//! Source: Guibas, Knuth & Sharir, "Randomized incremental construction of Delaunay and Voronoi diagrams", Algorithmica 1992,
//! §4.1. The paper makes the lower hull and the upper one, seen along parallel lines; lines from inside make both at once.
//!
//! Cost: O(n log n) time and O(n) facets, intermediate ones included, both expected (Theorems 4.1 and 4.2). Where no number of
//! floating point is inside of four points far from each other, there is nothing to look from, and quickhull makes the hull.

use delone_predicates::{Sign, lexicographic3, orient3d};

use super::faces::Faces;
use super::shell::Shell;
use super::start::Start;
use super::{Hull3, check};
use crate::error::Error;
use crate::order::random::SplitMix;
use crate::points::Position3;
use crate::sorting;
use crate::tally::{Counters, Tally, Work};

impl Hull3 {
    /// Finds the hull by splits and flips in random order, which the seed decides: for study. Tells also what it did: facets
    /// traced, orientations asked for it, facets created and destroyed, intermediate ones included.
    ///
    /// # Errors
    /// As [`Self::from_points`].
    ///
    /// ```
    /// use delone::Hull3;
    ///
    /// let points: Vec<[f64; 3]> = (0..27).map(|i| [i % 3, i / 3 % 3, i / 9].map(f64::from)).collect();
    /// let (hull, counters) = Hull3::by_flips(&points, 1)?;
    /// assert_eq!(hull, Hull3::from_points(&points)?);
    /// assert!(counters.work().is_some_and(|work| work.created >= 12));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn by_flips<P: Position3>(points: &[P], seed: u64) -> Result<(Self, Counters), Error> {
        let (points, mut work) = (&*P::all(points), Work::default());
        check(points)?;
        let flips = match Start::of(points) {
            Start::Tetrahedron(corners) => Flips::new(points, corners),
            _ => None,
        };
        let Some(mut flips) = flips else {
            return Ok((Self::of(points), Counters::Incremental(work)));
        };
        let mut order: Vec<usize> = (0..points.len()).collect();
        sorting::by(&mut order, |&i, &j| lexicographic3(points[i], points[j]).then(i.cmp(&j)));
        order.dedup_by(|later, first| points[*later] == points[*first]);
        SplitMix(seed).shuffle(&mut order);
        work.created(4);
        for i in order {
            if let Some(f) = flips.trace(points[i], &mut work) {
                flips.insert(i as u32, f, &mut work);
            }
        }
        Ok((Self::solid(Faces::of(&flips.shell, |i| i)), Counters::Incremental(work)))
    }
}

/// All facets that ever were.
struct Flips {
    /// The head of a facet that is gone is the first of those that took its place, which are numbered in a row.
    shell: Shell,
    /// For each facet how many took its place.
    counts: Vec<u8>,
    /// Inside of the first tetrahedron.
    center: [f64; 3],
    /// Facets of the star of the new point whose edges across from it are to be tested.
    pending: Vec<u32>,
}

impl Flips {
    fn new(points: &[[f64; 3]], corners: [usize; 4]) -> Option<Self> {
        let shell = Shell::new(points.to_vec(), corners);
        let center = [0, 1, 2].map(|k| corners.iter().map(|&i| 0.25 * points[i][k]).sum());
        // Strictly inside, whatever rounding has done.
        let is_inside = shell.facets.iter().all(|facet| {
            let [a, b, c] = facet.corners.map(|i| points[i as usize]);
            orient3d(a, b, c, center).is_negative()
        });
        is_inside.then(|| Self { shell, counts: vec![0; 4], center, pending: Vec::new() })
    }

    /// On which side of the plane through the center and two corners a point is: positive on the left, seen from outside.
    fn side(&self, a: u32, b: u32, q: [f64; 3]) -> Sign {
        let [a, b] = [a, b].map(|i| self.shell.points[i as usize]);
        orient3d(self.center, a, b, q)
    }

    /// The facet by which the ray from the center to a point leaves the hull. None at the first facet, of those that ever were, that has
    /// the point behind it: the hull has grown since.
    fn trace<T: Tally>(&self, q: [f64; 3], tally: &mut T) -> Option<u32> {
        let corners = |f: u32| self.shell.facets[f as usize].corners;
        let side = |tally: &mut T, a: u32, b: u32| {
            tally.orientation();
            self.side(a, b, q)
        };
        let holds = |f: &u32| {
            let [a, b, c] = corners(*f);
            [[a, b], [b, c], [c, a]].into_iter().all(|[u, v]| !side(tally, u, v).is_negative())
        };
        let mut f = (0..4).find(holds).unwrap_or(0);
        loop {
            tally.visited();
            tally.orientation();
            let (is_seen, [a, b, c]) = (self.shell.sees(q, f), corners(f));
            if self.shell.facets[f as usize].alive {
                return is_seen.then_some(f);
            }
            // A facet in a plane with the center has nothing behind it.
            if !is_seen && self.side(a, b, self.shell.points[c as usize]).is_positive() {
                return None;
            }
            let first = self.shell.facets[f as usize].head;
            f = match self.counts[f as usize] {
                // Around the new point, which is their last corner.
                3 => {
                    let ([a, b, p], c) = (corners(first), corners(first + 1)[1]);
                    let (a_b, b_c, c_a) = (first, first + 1, first + 2);
                    if side(tally, p, b).is_positive() {
                        if side(tally, p, c).is_negative() { b_c } else { c_a }
                    } else if side(tally, p, a).is_negative() {
                        c_a
                    } else {
                        a_b
                    }
                }
                // On the two sides of the edge that the flip made.
                2 => {
                    let [_, z, p] = corners(first);
                    if side(tally, z, p).is_negative() { first + 1 } else { first }
                }
                _ => first,
            };
        }
    }

    /// Facets in the place of others.
    fn replace<T: Tally>(&mut self, old: &[u32], new: &[([u32; 3], [u32; 3])], tally: &mut T) {
        let first = self.shell.facets.len() as u32;
        for (t, &(corners, across)) in (first..).zip(new) {
            let facet = self.shell.facet(corners, across);
            self.shell.facets.push(facet);
            self.counts.push(0);
            self.pending.push(t);
            for (k, g) in across.into_iter().enumerate().filter(|(_, g)| *g < first) {
                let (from, to) = (corners[(k + 1) % 3], corners[k]);
                let beyond = &mut self.shell.facets[g as usize];
                let j = (0..3).find(|&j| beyond.corners[j] == from && beyond.corners[(j + 1) % 3] == to);
                beyond.across[j.expect("facets across an edge share it")] = t;
                // What waited for its neighbor waits no more.
                if k > 0 {
                    self.pending.push(g);
                }
            }
        }
        for &f in old {
            let facet = &mut self.shell.facets[f as usize];
            (facet.alive, facet.head) = (false, first);
            self.counts[f as usize] = new.len() as u8;
        }
        tally.destroyed(old.len());
        tally.created(new.len());
    }

    /// Joins a point to the facet before it, which it sees, and flips edges until it sees nothing more.
    fn insert<T: Tally>(&mut self, p: u32, f: u32, tally: &mut T) {
        let facet = self.shell.facets[f as usize];
        let ([a, b, c], [x, y, z], n) = (facet.corners, facet.across, self.shell.facets.len() as u32);
        let new = [([a, b, p], [x, n + 1, n + 2]), ([b, c, p], [y, n + 2, n]), ([c, a, p], [z, n, n + 1])];
        self.replace(&[f], &new, tally);
        let q = self.shell.points[p as usize];
        while let Some(t) = self.pending.pop() {
            let star = self.shell.facets[t as usize];
            let g = star.across[0];
            if star.alive && star.corners[2] == p && self.shell.sees(q, g) {
                self.flip(t, g, tally);
            }
        }
    }

    /// Flips the edge x -> y, across from the new point p, of two facets; or cuts off x or y; or waits.
    ///
    /// ```text
    ///        p                    p
    ///      /   \                / | \
    ///     x --> y     =>       x  |  y
    ///      \   /                \ | /
    ///        z                    z
    /// ```
    fn flip<T: Tally>(&mut self, t: u32, g: u32, tally: &mut T) {
        let [x, y, p] = self.shell.facets[t as usize].corners;
        let [_, right, left] = self.shell.facets[t as usize].across;
        let beyond = self.shell.facets[g as usize];
        let k = (0..3).find(|&k| beyond.across[k] == t && beyond.corners[k] == y).unwrap_or(0);
        let z = beyond.corners[(k + 2) % 3];
        let (x_z, z_y) = (beyond.across[(k + 1) % 3], beyond.across[(k + 2) % 3]);
        let n = self.shell.facets.len() as u32;
        let across = |f: u32, k: usize| self.shell.facets[f as usize].across[k];
        let q = self.shell.points[p as usize];
        if x_z == left {
            self.replace(&[t, left, g], &[([z, y, p], [z_y, right, across(left, 2)])], tally);
        } else if z_y == right {
            self.replace(&[t, right, g], &[([x, z, p], [x_z, across(right, 1), left])], tally);
        } else if !self.side(x, z, q).is_negative() && !self.side(z, y, q).is_negative() {
            let new = [([x, z, p], [x_z, n + 1, left]), ([z, y, p], [z_y, right, n])];
            self.replace(&[t, g], &new, tally);
        }
    }
}
