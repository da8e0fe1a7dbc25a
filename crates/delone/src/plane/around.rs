//! What surrounds a point of the plane: the triangles whose circles hold it.

use delone_predicates::{Sign, in_circle, orient2d};

use super::Delaunay2;
use super::layer::kernel::{Kernel, NearestSites};
use crate::around::{Around, Surround};
use crate::error::Error;
use crate::ids::TriangleId;
use crate::locate::Start;
use crate::points::finite;
use crate::triangulation::Found;

/// Walks from a hint that are longer cost more than the search for a better one.
const NEAR: usize = 12;

impl Surround for Delaunay2 {
    fn find_near(&self, near: Option<TriangleId>, q: [f64; 2]) -> Result<Found<TriangleId>, Error> {
        let q = finite(q)?;
        let near = near.filter(|&t| self.mesh().is_triangle(t));
        if let Some(t) = near.and_then(|t| self.inside_near(t, q)) {
            return Ok(Found::on(&self.mesh().corners(t), Some(t)));
        }
        let spot = near.and_then(|t| self.base.spot_within(Start::Hint(t.edge(0), 0), q, NEAR, &mut ()));
        let spot = spot.map_or_else(|| self.spot(q, &mut ()).spot, |found| found.0);
        Ok(self.found(self.base.classify(spot, q)))
    }

    fn surround(
        &self,
        near: Option<TriangleId>,
        q: [f64; 2],
        around: &mut Around<Self>,
    ) -> Result<Found<TriangleId>, Error> {
        let found = self.find_near(near, q)?;
        around.clear();
        if let (Some(seed), 2..) = (found.simplex, found.face().len()) {
            self.dig(seed, q, around);
        }
        Ok(found)
    }
}

impl Delaunay2 {
    /// Walks to a triangle that a point is strictly inside of: what there mostly is, and needs no more decisions.
    #[inline]
    fn inside_near(&self, near: TriangleId, q: [f64; 2]) -> Option<TriangleId> {
        let (mesh, points) = (&self.base.mesh, &self.base.points);
        if !self.base.spanned || mesh.is_tagged || mesh.is_ghost(near) {
            return None;
        }
        let mut e = near.edge(0);
        let [a, b, mut c] = mesh.places(near).map(|p| points[p.index()]);
        let mut ends = [a, b];
        let mut side = orient2d(a, b, q);
        for _ in 0..NEAR {
            let sides = [side, orient2d(ends[1], c, q), orient2d(c, ends[0], q)];
            let crossed = match sides.iter().position(|side| side.is_negative()) {
                Some(0) => e,
                Some(1) => {
                    ends = [ends[1], c];
                    e.next()
                }
                Some(_) => {
                    ends = [c, ends[0]];
                    e.previous()
                }
                None if sides.contains(&Sign::Zero) => return None,
                None => return Some(e.triangle()),
            };
            e = mesh.twin(crossed);
            ends = [ends[1], ends[0]];
            side = Sign::Positive;
            let tip = mesh.tip(e);
            if tip.is_ghost() {
                return None;
            }
            c = points[tip.index()];
        }
        None
    }

    /// Depth first in counter-clockwise order, so that the border comes in its cyclic order. No vertex is inside of the cavity: no
    /// triangle is met twice.
    fn dig(&self, seed: TriangleId, q: [f64; 2], around: &mut Around<Self>) {
        let (mesh, points) = (&self.base.mesh, &self.base.points);
        let Around { ring, cavity, border, .. } = &mut *around;
        cavity.push(seed);
        ring.triangles.push([0, 1, 2]);
        ring.corners.extend(mesh.places(seed).map(|p| (mesh.name(p), points[p.index()])));
        let sides = [(2, [2, 0]), (1, [1, 2]), (0, [0, 1])];
        ring.pending.extend(sides.map(|(k, ends)| (mesh.twin(seed.edge(k)), ends)));
        while let Some((outside, [from, to])) = ring.pending.pop() {
            let tip = mesh.tip(outside);
            let [(first, a), (second, b)] = [from, to].map(|k| ring.corners[k as usize]);
            if tip.is_ghost() {
                if NearestSites::contains_beyond((b, ()), (a, ()), (q, ())) {
                    return around.stop_at_hull();
                }
                border.push(([first, second], mesh.twin(outside).triangle()));
                ring.order.push(from);
                continue;
            }
            let c = points[tip.index()];
            if in_circle(b, a, c, q).is_positive() {
                let number = ring.corners.len() as u32;
                cavity.push(outside.triangle());
                ring.triangles.push([from, number, to]);
                ring.corners.push((mesh.name(tip), c));
                ring.pending.push((mesh.twin(outside.previous()), [number, to]));
                ring.pending.push((mesh.twin(outside.next()), [from, number]));
                continue;
            }
            border.push(([first, second], outside.triangle()));
            ring.order.push(from);
        }
    }
}
