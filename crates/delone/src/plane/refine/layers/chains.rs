//! Chains of chosen sides, and what is at their vertices.
//!
//! A side is an edge with the mesh on its left. The next side is found by turning around its head, over the mesh, to the next constraint; so
//! a constraint with the mesh on both sides has two sides, and a vertex a place for each wedge of the mesh there.
//!
//! Cost: O(1) for each triangle around the vertices.

use delone_predicates::{lexicographic, orient2d};

use crate::ids::{EdgeId, Place};
use crate::mesh::Mesh2;
use crate::sorting;

use super::super::mesher::Mesher;

/// A wedge of the mesh at a vertex, between sides or between a side and another constraint.
#[derive(Clone, Debug)]
pub(super) struct Wedge {
    pub(super) base: Place,
    pub(super) at: [f64; 2],
    /// The sides before and after.
    pub(super) sides: [Option<usize>; 2],
    /// The other end of the constraint that is not chosen, where the chain ends.
    pub(super) beside: Option<Place>,
    /// Whether that one may be split.
    pub(super) may_follow: bool,
    /// The places on the border before and after.
    pub(super) beyond: [[f64; 2]; 2],
}

/// A chosen side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    /// The wedges at its tail and head.
    pub(super) wedges: [usize; 2],
    pub(super) length: f64,
}

/// All chains.
#[derive(Clone, Debug, Default)]
pub(super) struct Chains {
    pub(super) wedges: Vec<Wedge>,
    pub(super) runs: Vec<Run>,
}

/// The next border around the head of a side, and the one before around its tail.
fn neighbors(mesh: &Mesh2, e: EdgeId) -> [EdgeId; 2] {
    let (mut next, mut previous) = (e.next(), e.previous());
    while !mesh.is_fixed(next) {
        next = mesh.twin(next).next();
    }
    while !mesh.is_fixed(previous) {
        previous = mesh.twin(previous).previous();
    }
    [next, previous]
}

/// Whether rows may follow a constraint: it may be split, and is straight.
fn may_follow(mesher: &Mesher, e: EdgeId) -> bool {
    mesher.refusal(e).is_none() && mesher.arc(mesher.ends(e)).is_none()
}

impl Chains {
    /// Of pieces of constraints, in an order of geometry.
    pub(super) fn of(mesher: &Mesher, pieces: &[[Place; 2]]) -> Self {
        let mesh = &mesher.layer.mesh;
        let edges = pieces.iter().filter_map(|&[a, b]| mesh.edge_between(a, b));
        let both = edges.flat_map(|e| [e, mesh.twin(e)]);
        let mut sides: Vec<EdgeId> = both.filter(|e| mesher.is_inside(e.triangle())).collect();
        let place = |p: Place| mesher.point(p);
        sorting::by(&mut sides, |&e, &f| {
            let tails = lexicographic(place(mesh.tail(e)), place(mesh.tail(f)));
            tails.then_with(|| lexicographic(place(mesh.head(e)), place(mesh.head(f))))
        });
        let mut by_edge: Vec<(EdgeId, usize)> = sides.iter().copied().zip(0..).collect();
        by_edge.sort_unstable();
        let side_of = |e: EdgeId| {
            let found = by_edge.binary_search_by_key(&e, |entry| entry.0);
            found.ok().map(|at| by_edge[at].1)
        };
        let mut chains = Self::default();
        let around: Vec<[EdgeId; 2]> = sides.iter().map(|&e| neighbors(mesh, e)).collect();
        let before: Vec<Option<usize>> = around.iter().map(|around| side_of(around[1])).collect();
        // A wedge for each tail, then one for each head that is no tail of the next side.
        for (k, &e) in sides.iter().enumerate() {
            let base = mesh.tail(e);
            let previous = around[k][1];
            let other = mesh.tail(previous);
            let beside = before[k].is_none().then_some(other);
            let beyond = [place(other), place(mesh.head(e))];
            let may_follow = may_follow(mesher, previous);
            let sides = [before[k], Some(k)];
            chains.wedges.push(Wedge { base, at: place(base), sides, beside, may_follow, beyond });
        }
        for (k, &e) in sides.iter().enumerate() {
            let [tail, head] = [mesh.tail(e), mesh.head(e)];
            let next = around[k][0];
            let end = side_of(next).unwrap_or_else(|| {
                let other = mesh.head(next);
                let beyond = [place(tail), place(other)];
                chains.wedges.push(Wedge {
                    base: head,
                    at: place(head),
                    sides: [Some(k), None],
                    beside: Some(other),
                    may_follow: may_follow(mesher, next),
                    beyond,
                });
                chains.wedges.len() - 1
            });
            let length = super::length(place(tail), place(head));
            chains.runs.push(Run { wedges: [k, end], length });
        }
        chains
    }

    /// The mean length of the sides at a wedge.
    pub(super) fn spacing(&self, wedge: usize) -> f64 {
        match self.wedges[wedge].sides.map(|side| side.map(|side| self.runs[side].length)) {
            [Some(one), Some(other)] => 0.5 * (one + other),
            [one, other] => one.or(other).unwrap_or(0.0),
        }
    }

    /// The wedge beyond a side at a wedge, seen from there: the one before, or the one after.
    pub(super) fn beyond(&self, wedge: usize, is_after: bool) -> Option<(usize, f64)> {
        let run = &self.runs[self.wedges[wedge].sides[usize::from(is_after)]?];
        Some((run.wedges[usize::from(is_after)], run.length))
    }
}

impl Wedge {
    /// The directions of the border towards the wedge and away from it.
    pub(super) fn tangents(&self) -> [[f64; 2]; 2] {
        [super::unit(self.beyond[0], self.at), super::unit(self.at, self.beyond[1])]
    }

    /// Whether less than half a turn of the mesh is around the wedge.
    pub(super) fn is_hollow(&self) -> bool {
        orient2d(self.beyond[0], self.at, self.beyond[1]).is_positive()
    }

    /// Whether it is more than half a turn, and not straight on.
    pub(super) fn is_bulge(&self) -> bool {
        let turn = orient2d(self.beyond[0], self.at, self.beyond[1]);
        let [t, u] = self.tangents();
        turn.is_negative() || (turn.is_zero() && t[0] * u[0] + t[1] * u[1] < 0.0)
    }
}
