//! Construction by bistellar flips in random order, located by the history of all tetrahedra that ever were.
//!
//! A new site splits the tetrahedron that contains it into four, unless it is above that tetrahedron and hidden. Where a
//! tetrahedron across from it is in conflict with it, a flip takes that one in: at one facet two tetrahedra give way to three
//! around a new edge, at two facets three give way to two, and at three facets four to one, which hides their common corner.
//! Where none of them is right yet, it waits for its neighbors. A tetrahedron that is gone points to those that took its
//! place, and a site is traced through all that contain it.
//!
//! Sources: the challenge at the end of §4.3 of Guibas, Knuth & Sharir, Algorithmica 1992; that it can be met: Joe, CAGD 1991,
//! and with weights Edelsbrunner & Shah, "Incremental topological flipping works for regular triangulations", Algorithmica
//! 1996. The hull is closed by the vertex at infinity: the tetrahedra at it are the cones beyond the hull seen from a center inside
//! of the first tetrahedron, infinitesimally near one of its corners, so that they are flipped as all others. Sites that span less
//! than space have the scaffold of a layer beside them.
//!
//! The proof of Edelsbrunner & Shah needs general position. Heights have it by the perturbation of the conflict tests. Of points it
//! is enough that the new one is in no plane through three others, or through two others and the center; so while it is located
//! and inserted it is moved by a step that is too small to show anywhere else ([`orient3d_moved`]). Then some flip is always
//! possible: lower the lifted site from far above, and of all tetrahedra that are in conflict with it and still there take the one
//! whose hyperplane it passes first. What it passes before is gone, so exactly the facets that face the moved site are at new
//! tetrahedra already; they are one, two or three, and what the flip makes is in positive order. With weights, flips without the step go wrong on lattices.
//! New tetrahedra with four coplanar corners come and go, and none is left in the end, when all that was in conflict is gone.
//! They stay in the history, where they contain nothing.
//!
//! Cost: O(n log n) expected where the triangulation of each sample is linear in its size; the corners of all tetrahedra ever
//! made, fifty and more a point of 24 bytes, are kept until the end.

use std::cmp::Ordering;

use delone_predicates::{lexicographic3, orient3d_moved};

use super::Rest;
use crate::ids::{Place, TetrahedronId};
use crate::mesh::Mesh3;
use crate::order::random::SplitMix;
use crate::sorting;
use crate::space::layer::Layer;
use crate::space::layer::kernel::Lift;
use crate::space::layer::kernel::is_in_sphere;
use crate::tally::Tally;

#[cfg(test)]
mod tests;

/// The largest number of tetrahedra whose numbers fit, with room for those of one flip.
const MAX_EVER: usize = u32::MAX as usize - 8;

/// Makes all sites of a layer vertices, but for those that others hide or equal. Names are left alone. `None` if there is no
/// room.
pub(in crate::space) fn build<W: Lift, T: Tally>(
    layer: &mut Layer<W>,
    seed: u64,
    tally: &mut T,
) -> Option<Rest> {
    let (order, mut rest) = random_order(layer, seed);
    let first = layer.begin(&order)?;
    let Some(&a) = first.first() else { return Some(rest) };
    let root = layer.mesh.incident[a.index()];
    let mut flips = Flips::new(&layer.points, &layer.weights, &mut layer.mesh, root);
    tally.created(flips.history.len());
    for p in order.iter().map(|&i| Place::new(i as usize)).filter(|p| !first.contains(p)) {
        flips.insert(p, tally)?;
    }
    rest.hidden.append(&mut flips.hidden);
    layer.mesh.vertex_count =
        layer.points.len() - layer.scaffold.len() - rest.equal.len() - rest.hidden.len();
    Some(rest)
}

/// The heaviest site of each point, in random order; and the others, which are no vertices: with them those that equal one of
/// these, the first given.
fn random_order<W: Lift>(layer: &Layer<W>, seed: u64) -> (Vec<u32>, Rest) {
    let site = |i: u32| layer.site(Place::new(i as usize));
    let mut order: Vec<u32> = (0..layer.points.len() as u32).collect();
    sorting::by(&mut order, |&i, &j| {
        let ((p, v), (q, w)) = (site(i), site(j));
        let heavier = w.value().partial_cmp(&v.value()).unwrap_or(Ordering::Equal);
        lexicographic3(p, q).then(heavier).then(i.cmp(&j))
    });
    let mut rest = Rest::default();
    order.dedup_by(|later, first| {
        let (place, (p, v), (q, w)) = (Place::new(*later as usize), site(*later), site(*first));
        if p == q && v == w {
            rest.equal.push((place, Place::new(*first as usize)));
        } else if p == q {
            rest.hidden.push(place);
        }
        p == q
    });
    SplitMix(seed).shuffle(&mut order);
    (order, rest)
}

/// A tetrahedron that is or was.
#[derive(Clone, Copy, Debug)]
struct Past {
    corners: [Place; 4],
    /// The first of those that took its place, which are numbered in a row, and how many they are. None while it is there: then its
    /// slot.
    next: u32,
    count: u32,
}

/// See the module.
struct Flips<'a, W> {
    points: &'a [[f64; 3]],
    weights: &'a [W],
    mesh: &'a mut Mesh3,
    /// All tetrahedra that ever were, by number.
    history: Vec<Past>,
    /// For each slot of the mesh the number of the tetrahedron there.
    numbers: Vec<u32>,
    /// The corners of the first tetrahedron. The center is in its inside, infinitesimally near the first, much less so the edge to
    /// the second, and so on.
    root: [[f64; 3]; 4],
    /// Tetrahedra at the new point, across from which is to be tested, by number.
    pending: Vec<u32>,
    /// Sites that were or might have been vertices, and are none.
    hidden: Vec<Place>,
}

impl<'a, W: Lift> Flips<'a, W> {
    /// A mesh of one tetrahedron, and the four beyond it.
    fn new(points: &'a [[f64; 3]], weights: &'a [W], mesh: &'a mut Mesh3, first: TetrahedronId) -> Self {
        let root = mesh.cells[first.index()].corners.map(|p| points[p.index()]);
        let all: Vec<TetrahedronId> = mesh.cells().collect();
        let (history, numbers, pending, hidden) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut flips = Self { points, weights, mesh, history, numbers, root, pending, hidden };
        flips.note(&all);
        flips
    }

    fn site(&self, p: Place) -> ([f64; 3], W) {
        (self.points[p.index()], W::at(self.weights, p))
    }

    /// The slot of a tetrahedron, if it is still there.
    fn slot(&self, number: u32) -> Option<TetrahedronId> {
        let past = self.history[number as usize];
        (past.count == 0).then(|| TetrahedronId::new(past.next as usize))
    }

    /// Whether corners are in positive order if one of them, not at infinity, is at a point that is moved. One that is at infinity
    /// is across the others from the center.
    fn is_positive(&self, mut corners: [Place; 4], k: usize, q: [f64; 3]) -> bool {
        corners.swap(k, 3);
        let mut is_odd = k < 3;
        let infinite = corners[..3].iter().position(|p| p.is_ghost());
        if let Some(j) = infinite {
            corners.swap(j, 2);
            is_odd ^= j == 2;
        }
        let at = |k: usize| self.points[corners[k].index()];
        let side = match infinite {
            Some(_) => orient3d_moved(at(0), at(1), &self.root, q),
            None => orient3d_moved(at(0), at(1), &[at(2)], q),
        };
        if is_odd { side.is_negative() } else { side.is_positive() }
    }

    /// Whether a tetrahedron contains a point that is moved.
    fn holds<T: Tally>(&self, number: u32, q: [f64; 3], tally: &mut T) -> bool {
        let corners = self.history[number as usize].corners;
        (0..4).all(|k| {
            tally.orientation();
            self.is_positive(corners, k, q)
        })
    }

    /// The tetrahedron that contains a point, through all that contained it.
    fn trace<T: Tally>(&self, q: [f64; 3], tally: &mut T) -> TetrahedronId {
        let (mut first, mut count) = (0, 5);
        loop {
            tally.visited();
            // One of them contains it: the last need not be asked.
            let last = first + count - 1;
            let number = (first..last).find(|&number| self.holds(number, q, tally)).unwrap_or(last);
            if let Some(t) = self.slot(number) {
                return t;
            }
            let past = self.history[number as usize];
            (first, count) = (past.next, past.count);
        }
    }

    fn is_hit(&self, t: TetrahedronId, q: ([f64; 3], W)) -> bool {
        let corners = self.mesh.cells[t.index()].corners;
        is_in_sphere(corners.map(|p| (!p.is_ghost()).then(|| self.site(p))), &self.root, q)
    }

    /// Numbers new tetrahedra.
    fn note(&mut self, new: &[TetrahedronId]) {
        self.numbers.resize(self.mesh.slot_count(), 0);
        for &t in new {
            let number = self.history.len() as u32;
            let corners = self.mesh.cells[t.index()].corners;
            self.history.push(Past { corners, next: t.index() as u32, count: 0 });
            self.numbers[t.index()] = number;
            self.pending.push(number);
        }
    }

    /// Some tetrahedra give way to others. `None` if they are too many.
    fn replace<T: Tally>(
        &mut self,
        old: &[TetrahedronId],
        new: impl ExactSizeIterator<Item = [Place; 4]>,
        tally: &mut T,
    ) -> Option<()> {
        let (next, count) = (self.history.len() as u32, new.len() as u32);
        let made = self.mesh.flip(old, new).filter(|_| self.history.len() <= MAX_EVER)?;
        for t in old {
            let past = &mut self.history[self.numbers[t.index()] as usize];
            (past.next, past.count) = (next, count);
        }
        self.note(&made);
        tally.destroyed(old.len());
        tally.created(made.len());
        Some(())
    }

    /// Makes a site a vertex, or finds that it is hidden. `None` if there are too many tetrahedra, or if there were a conflict that
    /// no flip ends.
    fn insert<T: Tally>(&mut self, p: Place, tally: &mut T) -> Option<()> {
        let q = self.site(p);
        let t = self.trace(q.0, tally);
        if W::HIDES {
            tally.in_circle();
            if !self.is_hit(t, q) {
                self.hidden.push(p);
                return Some(());
            }
        }
        let corners = self.mesh.cells[t.index()].corners;
        self.pending.clear();
        self.replace(&[t], (0..4).map(|k| with(corners, k, p)), tally)?;
        let mut waiting = Vec::new();
        while let Some(number) = self.pending.pop() {
            let Some(t) = self.slot(number) else { continue };
            let cell = self.mesh.cells[t.index()];
            let Some(i) = cell.corners.iter().position(|&v| v == p) else { continue };
            tally.in_circle();
            if self.is_hit(cell.across[i].tetrahedron(), q) && !self.flip(t, i, tally)? {
                waiting.push(number);
            }
        }
        // What waited has gone with a neighbor, which was tested when it came.
        let is_done = waiting.iter().all(|&number| self.slot(number).is_none());
        debug_assert!(is_done, "a conflict is left, and no flip ends it");
        is_done.then_some(())
    }

    /// Flips the facet of a tetrahedron across from the new site, its corner `i`, an edge of that facet, or a corner. False if none
    /// of them can be, `None` if there are too many tetrahedra.
    fn flip<T: Tally>(&mut self, t: TetrahedronId, i: usize, tally: &mut T) -> Option<bool> {
        let cell = self.mesh.cells[t.index()];
        let (p, g, apex) = (cell.corners[i], cell.across[i].tetrahedron(), cell.across[i].corner());
        let beyond = self.mesh.cells[g.index()];
        let d = beyond.corners[apex];
        // The facets of what is beyond that are at the new site already.
        let mut old = vec![t, g];
        let mut kept = Vec::new();
        for k in [1, 2, 3].map(|k| (i + k) % 4) {
            let from = beyond.corners.iter().position(|&v| v == cell.corners[k]);
            let u = beyond.across[from.unwrap_or(apex)].tetrahedron();
            if self.mesh.cells[u.index()].corners.contains(&p) {
                old.push(u);
            } else {
                kept.push(k);
            }
        }
        let new = kept.iter().map(|&k| with(cell.corners, k, d));
        let q = self.points[p.index()];
        if kept.is_empty() || !new.clone().all(|corners| self.is_positive(corners, i, q)) {
            return Some(false);
        }
        if let [k] = kept[..] {
            self.hidden.push(cell.corners[k]);
        }
        self.replace(&old, new, tally)?;
        Some(true)
    }
}

/// Corners, one of them replaced.
fn with(mut corners: [Place; 4], k: usize, p: Place) -> [Place; 4] {
    corners[k] = p;
    corners
}
