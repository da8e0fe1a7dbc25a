//! Construction by bistellar flips in random order, located by the history of all tetrahedra that ever were.
//!
//! A new point splits the tetrahedron that contains it into four. Across from it, where a tetrahedron is in conflict with it, a
//! facet is flipped (two tetrahedra give way to three around a new edge) or an edge with three tetrahedra (they give way to
//! two); where neither is right yet, it waits for its neighbours. Four coplanar points need no flips of their own: a flat
//! tetrahedron is made by one flip and goes by the next. A tetrahedron that is gone points to those that took its place,
//! and a point is traced through all that contain it.
//!
//! Source: the challenge at the end of §4.3 of Guibas, Knuth & Sharir, Algorithmica 1992; that it can be met: Joe, CAGD 1991, and
//! Edelsbrunner & Shah, Algorithmica 1996. The hull is closed by the vertex at infinity: the tetrahedra at it are the cones
//! beyond the hull seen from a point inside of the first tetrahedron, so that they are flipped as all others.
//!
//! Cost: O(n log n) expected where the triangulation of each sample is linear in its size; all tetrahedra ever made, twenty
//! and more a point of 40 bytes, are kept until the end.

use delone_predicates::{Sign, lexicographic3, orient3d};

use crate::duplicates::settle;
use crate::ids::{Duplicate, Place, TetrahedronId};
use crate::locate::delaunay_tree::Simplices;
use crate::mesh::Names;
use crate::mesh::tetrahedra::Tetrahedron;
use crate::order::random::SplitMix;
use crate::space::layer::Layer;
use crate::tally::Tally;

/// The vertex at infinity.
const GHOST: u32 = u32::MAX;

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
pub(super) struct Flips<'a> {
    points: &'a [[f64; 3]],
    cells: Vec<Cell>,
    root: [[f64; 3]; 4],
    /// Inside of the root.
    centre: [f64; 3],
    /// Tetrahedra at the new point, across from which is to be tested.
    pending: Vec<u32>,
}

/// Triangulates points, each at the place of its index. `None` where that cannot be begun: where they do not span space, or no
/// number of floating point is inside of the first four.
pub(super) fn triangulate<T: Tally>(
    points: &[[f64; 3]],
    seed: u64,
    tally: &mut T,
) -> Option<(Layer, Vec<Duplicate>)> {
    let (order, equal) = random_order(points, seed);
    let mut flips = Flips::new(points, &order)?;
    tally.created(flips.cells.len());
    for &i in &order {
        let q = points[i];
        let t = flips.trace(q, tally);
        if flips.cells[t as usize].position(i as u32).is_none() {
            flips.insert(i as u32, t, tally)?;
        }
    }
    let mut layer = Layer::new(points.to_vec());
    let along: Vec<u32> = (0..points.len() as u32).collect();
    layer.mesh.names = Names::along(&along);
    flips.close(&mut layer)?;
    layer.mesh.vertex_count = order.len();
    let mut duplicates = Vec::new();
    super::note_equal(&mut layer, &equal, &mut duplicates);
    settle(&mut duplicates);
    Some((layer, duplicates))
}

/// Different points in random order; and those that equal another one, the first given, with it.
fn random_order(points: &[[f64; 3]], seed: u64) -> (Vec<usize>, Vec<(Place, Place)>) {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_unstable_by(|&i, &j| lexicographic3(points[i], points[j]).then(i.cmp(&j)));
    let mut equal = Vec::new();
    order.dedup_by(|later, first| {
        let is_equal = points[*later] == points[*first];
        if is_equal {
            equal.push((Place::new(*later), Place::new(*first)));
        }
        is_equal
    });
    SplitMix(seed).shuffle(&mut order);
    (order, equal)
}

impl<'a> Flips<'a> {
    /// The first tetrahedron of an order, and the four beyond it.
    fn new(points: &'a [[f64; 3]], order: &[usize]) -> Option<Self> {
        let ordered: Vec<[f64; 3]> = order.iter().map(|&i| points[i]).collect();
        let corners = <Layer as Simplices<4>>::first(&ordered)?.map(|k| order[k] as u32);
        let root = corners.map(|i| points[i as usize]);
        let centre = [0, 1, 2].map(|k| root.iter().map(|p| 0.25 * p[k]).sum());
        let mut flips = Self { points, cells: Vec::new(), root, centre, pending: Vec::new() };
        let mut first = vec![corners];
        for k in 0..4 {
            let mut ghost = corners;
            ghost[k] = GHOST;
            ghost.swap((k + 1) % 4, (k + 2) % 4);
            first.push(ghost);
        }
        flips.replace(&[], &first);
        let is_inside = (1..5).all(|t| flips.turn(flips.at(flips.cells[t].corners)).is_positive());
        is_inside.then_some(flips)
    }

    fn at(&self, corners: [u32; 4]) -> [Option<[f64; 3]>; 4] {
        corners.map(|v| (v != GHOST).then(|| self.points[v as usize]))
    }

    /// The orientation of four corners, one of which may be at infinity: across three others from the centre.
    fn turn(&self, mut corners: [Option<[f64; 3]>; 4]) -> Sign {
        let infinite = corners.iter().position(Option::is_none);
        if let Some(k) = infinite {
            // Two exchanges leave the orientation as it is, unless it is last already.
            corners.swap(k, 3);
            if k < 3 {
                corners.swap((k + 1) % 3, (k + 2) % 3);
            }
        }
        let [Some(a), Some(b), Some(c), d] = corners else { return Sign::Zero };
        match d {
            Some(d) => orient3d(a, b, c, d),
            None => orient3d(b, a, c, self.centre),
        }
    }

    /// Whether a tetrahedron contains a point, in its inside or on its border.
    fn holds<T: Tally>(&self, t: u32, q: [f64; 3], tally: &mut T) -> bool {
        let corners = self.at(self.cells[t as usize].corners);
        (0..4).all(|k| {
            let mut with = corners;
            with[k] = Some(q);
            tally.orientation();
            !self.turn(with).is_negative()
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

    fn is_hit(&self, t: u32, q: [f64; 3]) -> bool {
        <Layer as Simplices<4>>::is_in_circle(self.at(self.cells[t as usize].corners), &self.root, q)
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

    /// Makes a point in a present tetrahedron a vertex. `None` if there is a conflict that no flip ends.
    fn insert<T: Tally>(&mut self, p: u32, t: u32, tally: &mut T) -> Option<()> {
        let cell = self.cells[t as usize];
        self.pending.clear();
        self.replace(&[t], &[0, 1, 2, 3].map(|k| cell.with(k, p)));
        tally.destroyed(1);
        tally.created(4);
        let q = self.points[p as usize];
        let mut waiting = Vec::new();
        while let Some(t) = self.pending.pop() {
            let cell = self.cells[t as usize];
            let Some(i) = cell.position(p).filter(|_| cell.is_present()) else { continue };
            tally.in_circle();
            if self.is_hit(cell.across[i], q) && !self.flip(t, i, tally) {
                waiting.push((t, i));
            }
        }
        let is_stuck = |&(t, i): &(u32, usize)| {
            let cell = self.cells[t as usize];
            cell.is_present() && self.is_hit(cell.across[i], q)
        };
        let is_done = !waiting.iter().any(is_stuck);
        debug_assert!(is_done, "a conflict is left, and no flip ends it");
        is_done.then_some(())
    }

    /// Flips the facet of a tetrahedron across from the new point, its corner `i`, or an edge of that facet, if one can be.
    fn flip<T: Tally>(&mut self, t: u32, i: usize, tally: &mut T) -> bool {
        let (cell, g) = (self.cells[t as usize], self.cells[t as usize].across[i]);
        let (p, beyond) = (cell.corners[i], self.cells[g as usize]);
        let Some(apex) = beyond.across.iter().position(|&u| u == t) else { return false };
        let d = beyond.corners[apex];
        let others = [1, 2, 3].map(|k| (i + k) % 4);
        // Beside the facet: the tetrahedron with the new point at the edge across from a corner, if there is one.
        let beside = others.map(|k| {
            let u = beyond.across[beyond.position(cell.corners[k]).unwrap_or(apex)];
            self.cells[u as usize].position(p).map(|_| u)
        });
        let (old, kept): (Vec<u32>, Vec<usize>) = match beside.iter().flatten().count() {
            0 => (vec![t, g], others.to_vec()),
            1 => {
                let h = beside.iter().flatten().copied();
                let kept = others.iter().zip(beside).filter(|(_, u)| u.is_none()).map(|(&k, _)| k);
                ([t, g].into_iter().chain(h).collect(), kept.collect())
            }
            _ => return false,
        };
        let new: Vec<[u32; 4]> = kept.into_iter().map(|k| cell.with(k, d)).collect();
        if new.iter().any(|&corners| self.turn(self.at(corners)).is_negative()) {
            return false;
        }
        self.replace(&old, &new);
        tally.destroyed(old.len());
        tally.created(new.len());
        // What waited for its neighbour waits no more.
        for k in 0..new.len() {
            let made = self.cells[self.cells.len() - 1 - k];
            self.pending.extend(made.across);
        }
        true
    }

    /// The present tetrahedra as a layer's.
    fn close(&self, layer: &mut Layer) -> Option<()> {
        let mut numbers = vec![None; self.cells.len()];
        let present = |t: &usize| self.cells[*t].is_present();
        let place = |v: u32| if v == GHOST { Place::GHOST } else { Place::new(v as usize) };
        for t in (0..self.cells.len()).filter(present) {
            numbers[t] = Some(TetrahedronId::new(layer.mesh.cells.len()));
            layer.mesh.cells.push(Tetrahedron::FREE);
        }
        layer.mesh.marks.resize(layer.mesh.cells.len(), 0);
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
            let (cell, number) = (&self.cells[t], numbers[t]?);
            let order = turned(cell);
            let made = &mut layer.mesh.cells[number.index()];
            made.corners = order.map(|k| place(cell.corners[k]));
            for (k, &from) in order.iter().enumerate() {
                let other = &self.cells[cell.across[from] as usize];
                let j = other.across.iter().position(|&u| u as usize == t)?;
                let j = turned(other).iter().position(|&k| k == j)?;
                made.across[k] = numbers[cell.across[from] as usize]?.facet(j);
            }
            for v in made.corners.into_iter().filter(|v| !v.is_ghost()) {
                layer.mesh.incident[v.index()] = number;
            }
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::Kind3;

    use super::*;
    use crate::space::delaunay::Delaunay3;
    use crate::tally::Work;

    fn tetrahedra(d: &Delaunay3) -> Vec<Vec<usize>> {
        let sorted = |t| {
            let mut corners: Vec<usize> = d.mesh().corners(t).map(|v| v.index()).to_vec();
            corners.sort_unstable();
            corners
        };
        let mut all: Vec<Vec<usize>> = d.tetrahedron_ids().map(sorted).collect();
        all.sort_unstable();
        all
    }

    /// By flips alone, to the last tetrahedron, wherever there is a point to look from.
    #[test]
    fn flips_end_in_the_triangulation() {
        let mut by_flips = 0;
        for &kind in Kind3::ALL {
            for (n, seeds) in [(4, 3), (5, 3), (8, 3), (30, 3), (200, 2), (900, 1)] {
                for seed in 0..seeds {
                    let points = kind.points(n, seed);
                    let mut work = Work::default();
                    let Some(built) = triangulate(&points, seed, &mut work) else {
                        assert!(
                            Flips::new(&points, &random_order(&points, seed).0).is_none(),
                            "{} {n}",
                            kind.name()
                        );
                        continue;
                    };
                    by_flips += 1;
                    let d = Delaunay3::assemble(built, work);
                    let expected = Delaunay3::from_points(&points).expect("finite");
                    assert_eq!(d.check(), Ok(()), "{} {n} {seed}", kind.name());
                    assert!(tetrahedra(&d) == tetrahedra(&expected), "{} {n} {seed}", kind.name());
                    assert!(d.duplicates().eq(expected.duplicates()), "{} {n} {seed}", kind.name());
                }
            }
        }
        assert!(by_flips > 8 * Kind3::ALL.len(), "{by_flips} of {} kinds", Kind3::ALL.len());
    }
}
