//! The trace of a segment between two vertices: the first edge at an end, the triangles on the way, vertices exactly on it.
//!
//! Exact. Cost: the smaller degree of both ends to begin, because both stars are turned through at once; two orientation
//! tests a triangle there, one for each triangle that is crossed.

use delone_predicates::{Sign, orient2d, strictly_between};

use crate::ids::{EdgeId, Place};
use crate::mesh::Mesh2;
use crate::mesh::triangles::channel::Channel;

/// How a segment leaves an end.
#[derive(Clone, Copy, Debug)]
pub(super) enum Leaves {
    /// Along this edge, which leaves the end.
    Along(EdgeId),
    /// Across this edge, of a triangle at the end.
    Across(EdgeId),
}

/// Where a segment leaves one of its ends, or both.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beginning {
    pub(super) leaves: Leaves,
    /// Whether it is the second end.
    pub(super) at_second: bool,
}

/// A triangulation with constraints as segments see it.
#[derive(Clone, Copy)]
pub(super) struct Ground<'a> {
    pub(super) mesh: &'a Mesh2,
    pub(super) points: &'a [[f64; 2]],
}

/// A turn around a vertex, spoke by spoke, looking for the way to a goal.
struct Turn {
    from: Place,
    to: Place,
    spoke: EdgeId,
    /// The side of the spoke's head, seen from `from` to `to`; none for a ghost.
    side: Option<Sign>,
}

impl Ground<'_> {
    /// The point of a vertex.
    #[inline]
    pub(super) fn point(&self, v: Place) -> [f64; 2] {
        self.points[v.index()]
    }

    /// Where the segment between two different vertices leaves one of them.
    pub(super) fn begin(&self, a: Place, b: Place) -> Beginning {
        let mut turns = [self.turn(a, b), self.turn(b, a)];
        loop {
            for (k, turn) in turns.iter_mut().enumerate() {
                if let Some(leaves) = self.step(turn) {
                    return Beginning { leaves, at_second: k == 1 };
                }
            }
        }
    }

    /// Where the segment between two different vertices leaves the first.
    pub(super) fn leave(&self, a: Place, b: Place) -> Leaves {
        let mut turn = self.turn(a, b);
        loop {
            if let Some(leaves) = self.step(&mut turn) {
                return leaves;
            }
        }
    }

    fn turn(&self, from: Place, to: Place) -> Turn {
        let spoke = self.mesh.incident[from.index()];
        let mut turn = Turn { from, to, spoke, side: None };
        turn.side = self.side(&turn, self.mesh.head(spoke));
        turn
    }

    fn side(&self, turn: &Turn, v: Place) -> Option<Sign> {
        (!v.is_ghost()).then(|| orient2d(self.point(turn.from), self.point(turn.to), self.point(v)))
    }

    /// Looks at a spoke and at its triangle, and goes on to the next.
    fn step(&self, turn: &mut Turn) -> Option<Leaves> {
        let head = self.mesh.head(turn.spoke);
        if turn.side == Some(Sign::Zero) && self.is_towards(turn.from, turn.to, head) {
            return Some(Leaves::Along(turn.spoke));
        }
        let next = self.side(turn, self.mesh.tip(turn.spoke));
        if turn.side == Some(Sign::Negative) && next == Some(Sign::Positive) {
            return Some(Leaves::Across(turn.spoke.next()));
        }
        turn.spoke = self.mesh.spin(turn.spoke);
        turn.side = next;
        None
    }

    /// Whether a vertex on the line through two others is on the segment between them, the first end apart.
    fn is_towards(&self, from: Place, to: Place, v: Place) -> bool {
        v == to || strictly_between(self.point(from), self.point(to), self.point(v))
    }

    /// Follows the segment from `a` across an edge of a triangle there, to the first vertex on it, which is returned. `each`
    /// is told of every edge crossed, as seen from where the segment comes from; where it says no, that is the end.
    #[inline]
    pub(super) fn cross(
        &self,
        [a, b]: [Place; 2],
        across: EdgeId,
        mut each: impl FnMut(EdgeId, Option<Sign>) -> bool,
    ) -> Option<Place> {
        let (from, to) = (self.point(a), self.point(b));
        let mut crossed = across;
        let mut side = None;
        loop {
            if !each(crossed, side) {
                return None;
            }
            let entered = self.mesh.twin(crossed);
            let tip = self.mesh.tip(entered);
            let sign = if tip == b { Sign::Zero } else { orient2d(from, to, self.point(tip)) };
            crossed = match sign {
                Sign::Zero => return Some(tip),
                Sign::Positive => entered.next(),
                Sign::Negative => entered.previous(),
            };
            side = Some(sign);
        }
    }

    /// Follows the segment between two vertices, from both of its ends as is cheapest. `along` is told of every edge on it,
    /// in the segment's direction, and whether it was met from the second end, backwards; `across` of every edge crossed, and
    /// ends it all by saying no. Returns whether all was seen.
    pub(super) fn follow(
        &self,
        [mut a, mut b]: [Place; 2],
        mut along: impl FnMut(EdgeId, bool),
        mut across: impl FnMut(EdgeId) -> bool,
    ) -> bool {
        while a != b {
            let Beginning { leaves, at_second } = self.begin(a, b);
            let [near, far] = if at_second { [b, a] } else { [a, b] };
            let reached = match leaves {
                Leaves::Along(e) => {
                    along(if at_second { self.mesh.twin(e) } else { e }, at_second);
                    Some(self.mesh.head(e))
                }
                Leaves::Across(first) => self.cross([near, far], first, |e, _| across(e)),
            };
            let Some(reached) = reached else { return false };
            *(if at_second { &mut b } else { &mut a }) = reached;
        }
        true
    }

    /// The vertices strictly inside of a segment, in no special order.
    pub(super) fn vertices_on(&self, [a, b]: [Place; 2]) -> Vec<Place> {
        let (mut ends, mut inner) = ([a, b], Vec::new());
        while ends[0] != ends[1] {
            let Beginning { leaves, at_second } = self.begin(ends[0], ends[1]);
            let [near, far] = if at_second { [ends[1], ends[0]] } else { ends };
            let reached = match leaves {
                Leaves::Along(e) => self.mesh.head(e),
                Leaves::Across(first) => self.cross([near, far], first, |_, _| true).expect("all is crossed"),
            };
            if reached != far {
                inner.push(reached);
            }
            ends[usize::from(at_second)] = reached;
        }
        inner
    }

    /// The edges of a segment that is a chain of edges, in its direction.
    pub(super) fn chain(&self, ends: [Place; 2]) -> Vec<EdgeId> {
        let (mut edges, mut from_second) = (Vec::new(), Vec::new());
        let along =
            |e: EdgeId, at_second: bool| (if at_second { &mut from_second } else { &mut edges }).push(e);
        self.follow(ends, along, |_| true);
        edges.extend(from_second.into_iter().rev());
        edges
    }

    /// The channel of the segment from `a`, across an edge of a triangle there, and the vertex at its end; or the first fixed
    /// edge that is crossed.
    pub(super) fn channel(
        &self,
        [a, b]: [Place; 2],
        across: EdgeId,
        channel: &mut Channel,
    ) -> Result<Place, EdgeId> {
        let mesh = self.mesh;
        let Channel { left, right, triangles, .. } = channel;
        left.clear();
        right.clear();
        triangles.clear();
        let (to_right, from_left) = (across.previous(), across.next());
        left.push((mesh.tail(from_left), mesh.twin(from_left)));
        right.push((a, mesh.twin(to_right)));
        triangles.push(across.triangle());
        let mut last = across;
        let mut obstacle = None;
        let end = self.cross([a, b], across, |crossed, side| {
            if mesh.is_fixed(crossed) {
                obstacle = Some(crossed);
                return false;
            }
            let t = crossed.triangle();
            match side {
                None => {}
                // The triangle was entered across l -> r, with the tip on the left: r -> tip is crossed, tip -> l is not.
                Some(Sign::Positive) => {
                    let side = crossed.next();
                    left.push((mesh.tail(side), mesh.twin(side)));
                    triangles.push(t);
                }
                Some(_) => {
                    let side = crossed.previous();
                    right.push((mesh.tail(side), mesh.twin(side)));
                    triangles.push(t);
                }
            }
            last = crossed;
            true
        });
        let Some(end) = end else { return Err(obstacle.expect("nothing else ends it")) };
        let entered = mesh.twin(last);
        triangles.push(entered.triangle());
        let [from_right, to_left] = [entered.next(), entered.previous()];
        left.push((end, mesh.twin(to_left)));
        right.push((mesh.tail(from_right), mesh.twin(from_right)));
        left.reverse();
        Ok(end)
    }
}
