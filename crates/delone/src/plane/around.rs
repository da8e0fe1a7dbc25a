//! The surroundings of a point of the plane: the triangles whose circles contain it.

use delone_predicates::{FixedPoint, SeenCorner, Sign};

use super::Delaunay2;
use super::layer::insert::Spot;
use super::layer::kernel::{Kernel, NearestSites};
use crate::around::{Around, Side, Surround};
use crate::error::Error;
use crate::ids::{EdgeId, TriangleId};
use crate::locate::Start;
use crate::locate::conflict::{self, Beyond};
use crate::locate::walk::walk;
use crate::points::finite;
use crate::triangulation::Found;

/// Steps, after which a walk from a hint is given up and the point is located anew.
const HINTED_STEPS: usize = 12;

impl Surround for Delaunay2 {
    fn find_near(&self, near: Option<TriangleId>, q: [f64; 2]) -> Result<Found<TriangleId>, Error> {
        let q = finite(q)?;
        match self.inside_near(near, &FixedPoint::new(q)) {
            Ok(seed) => Ok(self.inside(seed)),
            Err(last) => Ok(self.find_from(last, q)),
        }
    }

    fn surround(
        &self,
        near: Option<TriangleId>,
        q: [f64; 2],
        around: &mut Around<Self>,
    ) -> Result<Found<TriangleId>, Error> {
        let q = finite(q)?;
        around.clear();
        let fixed = FixedPoint::new(q);
        let last = match self.inside_near(near, &fixed) {
            Ok(seed) => {
                self.dig(seed, &fixed, around);
                return Ok(self.inside(seed));
            }
            Err(last) => last,
        };
        let found = self.find_from(last, q);
        if let (Some(t), 2..) = (found.simplex, found.face().len()) {
            self.dig(t.edge(0), &fixed, around);
        }
        Ok(found)
    }
}

impl Delaunay2 {
    /// Strictly inside of a triangle.
    fn inside(&self, edge: EdgeId) -> Found<TriangleId> {
        let t = edge.triangle();
        Found::on(&self.mesh().corners(t), Some(t))
    }

    /// The corners of a triangle from the origin of an edge on, as seen from a point, and the cross product of each with the next.
    #[inline]
    fn seen(&self, edge: EdgeId, fixed: &FixedPoint) -> ([SeenCorner; 3], [f64; 3]) {
        let (mesh, points) = (&self.base.mesh, &self.base.points);
        let [a, b, c] =
            [mesh.tail(edge), mesh.head(edge), mesh.tip(edge)].map(|p| fixed.corner(points[p.index()]));
        ([a, b, c], [a.cross(&b), b.cross(&c), c.cross(&a)])
    }

    /// Where a point is in general, from the edge that a walk ended at.
    fn find_from(&self, last: Option<EdgeId>, q: [f64; 2]) -> Found<TriangleId> {
        let spot = last.and_then(|e| self.base.spot_within(Start::Hint(e, 0), q, HINTED_STEPS, &mut ()));
        let spot = spot.map_or_else(|| self.spot(q, &mut ()).spot, |found| found.0);
        match spot {
            Spot::Triangle(t) if self.mesh().is_ghost(t) => Found::beyond(&[]),
            _ => self.found(self.base.classify(spot, q)),
        }
    }

    /// Walks to a triangle that a point is strictly inside of: what there mostly is, and needs no more decisions.
    /// An edge of it; or of where the walk ended, if it began.
    #[inline]
    fn inside_near(&self, near: Option<TriangleId>, fixed: &FixedPoint) -> Result<EdgeId, Option<EdgeId>> {
        let (mesh, points) = (&self.base.mesh, &self.base.points);
        let near = near.filter(|&t| mesh.is_triangle(t)).ok_or(None)?;
        if mesh.is_tagged || mesh.is_ghost(near) || !self.base.spanned {
            return Err(Some(near.edge(0)));
        }
        let first = near.edge(0);
        // What is known of the edge that a triangle was entered by: the point is not behind it, but for the first.
        let [mut a, mut b] = [mesh.tail(first), mesh.head(first)].map(|p| fixed.corner(points[p.index()]));
        let mut ab = a.cross(&b);
        let mut behind = fixed.side(&a, &b, ab);
        let mut is_inside = false;
        let end = walk(first, HINTED_STEPS, |edge| {
            let tip = mesh.tip(edge);
            if tip.is_ghost() {
                return None;
            }
            let c = fixed.corner(points[tip.index()]);
            let (bc, ca) = (b.cross(&c), c.cross(&a));
            let sides = [behind, fixed.side(&b, &c, bc), fixed.side(&c, &a, ca)];
            behind = Sign::Positive;
            let crossed = if sides[0].is_negative() {
                (a, b, ab) = (b, a, -ab);
                edge
            } else if sides[1].is_negative() {
                (a, ab) = (c, -bc);
                edge.next()
            } else if sides[2].is_negative() {
                (b, ab) = (c, -ca);
                edge.previous()
            } else {
                is_inside = !sides.contains(&Sign::Zero);
                return None;
            };
            Some(mesh.twin(crossed))
        });
        if is_inside { Ok(end.at) } else { Err(Some(end.at)) }
    }

    /// Depth first in counter-clockwise order, so that the border comes in its cyclic order. No vertex is inside of the cavity: no
    /// triangle is met twice.
    fn dig(&self, seed: EdgeId, fixed: &FixedPoint, around: &mut Around<Self>) {
        let (mesh, points) = (&self.base.mesh, &self.base.points);
        let Around { ring, cavity, border, .. } = &mut *around;
        cavity.push(seed.triangle());
        ring.triangles.push([0, 1, 2]);
        ring.vertices.extend([mesh.origin(seed), mesh.destination(seed), mesh.apex(seed)]);
        let (corners, [ab, bc, ca]) = self.seen(seed, fixed);
        ring.corners_seen.extend(corners);
        let mut put = |edge, ends, cross| ring.pending.push(Side { edge: mesh.twin(edge), ends, cross });
        put(seed.previous(), [2, 0], ca);
        put(seed.next(), [1, 2], bc);
        put(seed, [0, 1], ab);
        let has_ended = conflict::search(&mut ring.pending, |side| {
            let &Side { edge, ends: [from, to], cross } = side;
            let [a, b] = [from, to].map(|k| &ring.corners_seen[k as usize]);
            let ends = || [from, to].map(|k| ring.vertices[k as usize]);
            let tip = mesh.tip(edge);
            if tip.is_ghost() {
                if NearestSites::contains_beyond((b.end(), ()), (a.end(), ()), (fixed.center(), ())) {
                    return Beyond::End;
                }
                border.push((ends(), mesh.twin(edge).triangle()));
                ring.order.push(from);
                return Beyond::Outside;
            }
            let c = fixed.corner(points[tip.index()]);
            let (ac, cb) = (a.cross(&c), c.cross(b));
            // The corners are counter-clockwise as b, a and c.
            if !fixed.in_circle([b, a, &c], [ac, cb, -cross]).is_positive() {
                border.push((ends(), edge.triangle()));
                ring.order.push(from);
                return Beyond::Outside;
            }
            let number = ring.corners_seen.len() as u32;
            cavity.push(edge.triangle());
            ring.triangles.push([from, number, to]);
            ring.vertices.push(mesh.name(tip));
            ring.corners_seen.push(c);
            let [right, left] = [edge.next(), edge.previous()].map(|e| mesh.twin(e));
            let left = Side { edge: left, ends: [number, to], cross: cb };
            Beyond::Inside(Side { edge: right, ends: [from, number], cross: ac }, [left])
        });
        if !has_ended {
            around.stop_at_hull();
        }
    }
}
