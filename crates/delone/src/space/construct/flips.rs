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
//! Cost: O(n log n) expected where the triangulation of each sample is linear in its size; all tetrahedra ever made, fifty
//! and more a point of 40 bytes, are kept until the end.

use std::cmp::Ordering;

use delone_predicates::{lexicographic3, orient3d_moved};

use super::Rest;
use crate::ids::{Place, TetrahedronId};
use crate::mesh::Mesh3;
use crate::mesh::tetrahedra::Tetrahedron;
use crate::order::random::SplitMix;
use crate::sorting;
use crate::space::layer::Layer;
use crate::space::layer::kernel::Lift;
use crate::space::layer::kernel::is_in_sphere;
use crate::tally::Tally;

#[cfg(test)]
mod tests;

/// The vertex at infinity.
const GHOST: u32 = u32::MAX;

/// The largest number of tetrahedra whose indices fit, with room for those of one flip.
const MAX_TETRAHEDRA: usize = u32::MAX as usize - 8;

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
    let root = layer.mesh.cells[layer.mesh.incident[a.index()].index()].corners;
    let mut flips = Flips::new(&layer.points, &layer.weights, root);
    tally.created(flips.cells.len());
    for p in order.iter().copied().filter(|&i| !first.contains(&Place::new(i as usize))) {
        flips.insert(p, tally)?;
    }
    flips.close(&mut layer.mesh)?;
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

/// A tetrahedron, present or gone.
#[derive(Clone, Copy, Debug)]
struct Cell {
    corners: [u32; 4],
    /// Across from each corner.
    across: [u32; 4],
    /// The first of those that took its place, which are numbered in a row, and how many they are.
    next: u32,
    count: u32,
}

impl Cell {
    fn position(&self, v: u32) -> Option<usize> {
        self.corners.iter().position(|&w| w == v)
    }

    fn is_present(&self) -> bool {
        self.count == 0
    }

    /// The corners, one of them replaced.
    fn with(&self, k: usize, v: u32) -> [u32; 4] {
        let mut corners = self.corners;
        corners[k] = v;
        corners
    }
}

/// See the module.
struct Flips<'a, W> {
    points: &'a [[f64; 3]],
    weights: &'a [W],
    cells: Vec<Cell>,
    /// The corners of the first tetrahedron. The center is in its inside, infinitesimally near the first, much less so the edge to
    /// the second, and so on.
    root: [[f64; 3]; 4],
    /// Tetrahedra at the new point, across from which is to be tested.
    pending: Vec<u32>,
    /// Sites that were or might have been vertices, and are none.
    hidden: Vec<Place>,
}

impl<'a, W: Lift> Flips<'a, W> {
    /// The first tetrahedron, its corners in positive order, and the four beyond it.
    fn new(points: &'a [[f64; 3]], weights: &'a [W], root: [Place; 4]) -> Self {
        let corners = root.map(|p| p.index() as u32);
        let root = root.map(|p| points[p.index()]);
        let mut first = vec![corners];
        for k in 0..4 {
            let mut ghost = corners;
            ghost[k] = GHOST;
            ghost.swap((k + 1) % 4, (k + 2) % 4);
            first.push(ghost);
        }
        let (cells, pending, hidden) = (Vec::new(), Vec::new(), Vec::new());
        let mut flips = Self { points, weights, cells, root, pending, hidden };
        flips.replace(&[], &first);
        flips
    }

    fn site(&self, v: u32) -> ([f64; 3], W) {
        let place = Place::new(v as usize);
        (self.points[place.index()], W::at(self.weights, place))
    }

    /// Whether corners are in positive order if one of them, not at infinity, is at a point that is moved. One that is at infinity
    /// is across the others from the center.
    fn is_positive(&self, mut corners: [u32; 4], k: usize, q: [f64; 3]) -> bool {
        corners.swap(k, 3);
        let mut is_odd = k < 3;
        let infinite = corners[..3].iter().position(|&v| v == GHOST);
        if let Some(j) = infinite {
            corners.swap(j, 2);
            is_odd ^= j == 2;
        }
        let at = |k: usize| self.points[corners[k] as usize];
        let side = match infinite {
            Some(_) => orient3d_moved(at(0), at(1), &self.root, q),
            None => orient3d_moved(at(0), at(1), &[at(2)], q),
        };
        if is_odd { side.is_negative() } else { side.is_positive() }
    }

    /// Whether a tetrahedron contains a point that is moved.
    fn holds<T: Tally>(&self, t: u32, q: [f64; 3], tally: &mut T) -> bool {
        let corners = self.cells[t as usize].corners;
        (0..4).all(|k| {
            tally.orientation();
            self.is_positive(corners, k, q)
        })
    }

    /// The present tetrahedron that contains a point, through all that contained it.
    fn trace<T: Tally>(&self, q: [f64; 3], tally: &mut T) -> u32 {
        let (mut first, mut count) = (0, 5);
        loop {
            tally.visited();
            // One of them contains it: the last need not be asked.
            let last = first + count - 1;
            let t = (first..last).find(|&t| self.holds(t, q, tally)).unwrap_or(last);
            let cell = self.cells[t as usize];
            if cell.is_present() {
                return t;
            }
            (first, count) = (cell.next, cell.count);
        }
    }

    fn is_hit(&self, t: u32, q: ([f64; 3], W)) -> bool {
        let corners = self.cells[t as usize].corners.map(|v| (v != GHOST).then(|| self.site(v)));
        is_in_sphere(corners, &self.root, q)
    }

    /// New tetrahedra with the border of old ones.
    fn replace(&mut self, old: &[u32], new: &[[u32; 4]]) {
        let facet = |corners: [u32; 4], k: usize| {
            let mut facet = corners;
            facet[k] = GHOST - 1;
            facet.sort_unstable();
            facet
        };
        let first = self.cells.len() as u32;
        // What is to be glued: facets that wait for the other side.
        let mut open: Vec<([u32; 4], u32, usize)> = Vec::new();
        for &t in old {
            let Cell { corners, across, .. } = self.cells[t as usize];
            for (k, u) in across.into_iter().enumerate().filter(|(_, u)| !old.contains(u)) {
                let outside = self.cells[u as usize];
                let border = facet(corners, k);
                let j = (0..4).find(|&j| facet(outside.corners, j) == border).unwrap_or(0);
                open.push((border, u, j));
            }
            (self.cells[t as usize].next, self.cells[t as usize].count) = (first, new.len() as u32);
        }
        for (t, &corners) in (first..).zip(new) {
            self.cells.push(Cell { corners, across: [t; 4], next: 0, count: 0 });
            for k in 0..4 {
                let side = facet(corners, k);
                if let Some(found) = open.iter().position(|other| other.0 == side) {
                    let (_, u, j) = open.swap_remove(found);
                    self.cells[t as usize].across[k] = u;
                    self.cells[u as usize].across[j] = t;
                } else {
                    open.push((side, t, k));
                }
            }
            self.pending.push(t);
        }
        debug_assert!(open.is_empty(), "new tetrahedra fill the place of the old ones");
    }

    /// Makes a site a vertex, or finds that it is hidden. `None` if there are too many tetrahedra, or if there were a conflict that
    /// no flip ends.
    fn insert<T: Tally>(&mut self, p: u32, tally: &mut T) -> Option<()> {
        let q = self.site(p);
        let t = self.trace(q.0, tally);
        if W::HIDES {
            tally.in_circle();
            if !self.is_hit(t, q) {
                self.hidden.push(Place::new(p as usize));
                return Some(());
            }
        }
        let cell = self.cells[t as usize];
        self.pending.clear();
        self.replace(&[t], &[0, 1, 2, 3].map(|k| cell.with(k, p)));
        tally.destroyed(1);
        tally.created(4);
        let mut waiting = Vec::new();
        while let Some(t) = self.pending.pop() {
            let cell = self.cells[t as usize];
            let Some(i) = cell.position(p).filter(|_| cell.is_present()) else { continue };
            tally.in_circle();
            if self.is_hit(cell.across[i], q) && !self.flip(t, i, tally) {
                waiting.push(t);
            }
            if self.cells.len() > MAX_TETRAHEDRA {
                return None;
            }
        }
        // What waited has gone with a neighbor, which was tested when it came.
        let is_done = !waiting.iter().any(|&t| self.cells[t as usize].is_present());
        debug_assert!(is_done, "a conflict is left, and no flip ends it");
        is_done.then_some(())
    }

    /// Flips the facet of a tetrahedron across from the new site, its corner `i`, an edge of that facet, or a corner, if
    /// one can be.
    fn flip<T: Tally>(&mut self, t: u32, i: usize, tally: &mut T) -> bool {
        let (cell, g) = (self.cells[t as usize], self.cells[t as usize].across[i]);
        let (p, beyond) = (cell.corners[i], self.cells[g as usize]);
        let Some(apex) = beyond.across.iter().position(|&u| u == t) else { return false };
        let d = beyond.corners[apex];
        // The facets of what is beyond that are at the new site already.
        let mut old = vec![t, g];
        let mut kept = Vec::new();
        for k in [1, 2, 3].map(|k| (i + k) % 4) {
            let u = beyond.across[beyond.position(cell.corners[k]).unwrap_or(apex)];
            if self.cells[u as usize].position(p).is_some() {
                old.push(u);
            } else {
                kept.push(k);
            }
        }
        let new: Vec<[u32; 4]> = kept.iter().map(|&k| cell.with(k, d)).collect();
        let q = self.points[p as usize];
        if new.is_empty() || !new.iter().all(|&corners| self.is_positive(corners, i, q)) {
            return false;
        }
        if let [k] = kept[..] {
            self.hidden.push(Place::new(cell.corners[k] as usize));
        }
        self.replace(&old, &new);
        tally.destroyed(old.len());
        tally.created(new.len());
        true
    }

    /// Puts the present tetrahedra in the place of those of a mesh.
    fn close(&self, mesh: &mut Mesh3) -> Option<()> {
        let mut numbers = vec![None; self.cells.len()];
        let present = |t: &usize| self.cells[*t].is_present();
        let place = |v: u32| if v == GHOST { Place::GHOST } else { Place::new(v as usize) };
        mesh.cells.clear();
        mesh.marks.clear();
        for t in (0..self.cells.len()).filter(present) {
            numbers[t] = Some(mesh.new_cell()?);
        }
        // Ghosts have the vertex at infinity last, in positive order as before.
        let turned = |cell: &Cell| {
            let mut order = [0, 1, 2, 3];
            if let Some(k) = cell.position(GHOST).filter(|&k| k < 3) {
                order.swap(k, 3);
                order.swap((k + 1) % 3, (k + 2) % 3);
            }
            order
        };
        for t in (0..self.cells.len()).filter(present) {
            let (cell, number): (_, TetrahedronId) = (&self.cells[t], numbers[t]?);
            let order = turned(cell);
            let mut made =
                Tetrahedron { corners: order.map(|k| place(cell.corners[k])), ..Tetrahedron::FREE };
            for (k, &from) in order.iter().enumerate() {
                let other = &self.cells[cell.across[from] as usize];
                let j = other.across.iter().position(|&u| u as usize == t)?;
                let j = turned(other).iter().position(|&k| k == j)?;
                made.across[k] = numbers[cell.across[from] as usize]?.facet(j);
            }
            for v in made.corners.into_iter().filter(|v| !v.is_ghost()) {
                mesh.incident[v.index()] = number;
            }
            mesh.cells[number.index()] = made;
        }
        self.hidden.iter().for_each(|p| mesh.incident[p.index()] = TetrahedronId::NONE);
        Some(())
    }
}
