//! Rings that rounding turned over are mended: corners that are nearly one become one, in all cells that have them.
//!
//! Of every bad ring the shortest side is contracted, if it is no longer than some units in the last place; then the cells that
//! changed are asked again. Of two corners that become one the corner of the region stays, else the one on its border, else the
//! lexicographically least; two corners of the region stay apart. A bad ring without a short side gets its nearest corner as a corner of
//! the side that it has crossed. So what comes out depends on the rings alone, not on their order.
//!
//! It ends: each contraction takes a corner from the diagram, and each corner that a side gets divides a ring in two.
//!
//! Cost: a look at all corners for each round, of which there are few, and only where a ring is bad. Lists are sorted where sets would do,
//! because this is in every program that clips cells, and hardly ever runs.

use std::cmp::Ordering;

use delone_predicates::{hypotenuse, lexicographic, orient2d};

use super::cells::Cells2;
use crate::plane::region::Region2;
use crate::plane::region::rings::{is_border, simple_orientation};
use crate::sorting;

/// Sides are contracted, and corners put into sides, up to this length in units in the last place of a ring's largest coordinate. Of
/// 49 sets with rings that turned over none had one whose shortest side was above 4.
const LONGEST_SIDE: f64 = 8.0;
/// Rounds at most: those sets took 13.
const ROUNDS: usize = 1000;

type Point = [f64; 2];
/// The vertices of its ends; two vertices may be at one place.
type Side = [u32; 2];
/// The rings of a cell, as vertices.
type Parts = Vec<Vec<u32>>;
/// The new form of a ring; nothing if it stays.
type Rewriting<'r> = dyn Fn(&Mending<'_>, &[u32]) -> Option<Vec<u32>> + 'r;

/// Cells, and those that changed.
struct Mending<'a> {
    cells: &'a Cells2,
    /// The test whether several rings are a whole border.
    are_border: fn(&[Vec<Point>]) -> bool,
    /// The places of the corners of the region, and of those on its border, sorted.
    region: Vec<Point>,
    border: Vec<Point>,
    /// Cells by id, sorted.
    changed: Vec<(u32, Parts)>,
    /// Sides that were gone and come again, with a corner of the region at one end.
    spikes: Vec<Side>,
}

/// A corner that is near to a side, and how near.
#[derive(Clone, Copy)]
struct Near {
    height: f64,
    corner: u32,
    side: Side,
}

/// Mends the cells of the rings with these numbers, and what changes with them. `border` are corners on the border of the region.
pub(super) fn mend(cells: &mut Cells2, bad: &[u32], border: &[Point], region: &Region2) {
    let sorted = |mut places: Vec<Point>| {
        sorting::by(&mut places, |p, q| lexicographic(*p, *q));
        places
    };
    let mut mending = Mending {
        cells,
        are_border: region.are_border(),
        region: sorted(region.rings().flatten().copied().collect()),
        border: sorted(border.to_vec()),
        changed: Vec::new(),
        spikes: Vec::new(),
    };
    let mut asked = Vec::new();
    for (id, [first, count]) in mending.cells.sites.iter().enumerate() {
        let from = bad.partition_point(|ring| ring < first);
        if bad.get(from).is_some_and(|&ring| ring < first + count) {
            // Rings that visit a corner twice fall apart, and may be good then.
            let rings = mending.rings(id as u32).into_iter().map(<[u32]>::to_vec).collect();
            mending.put(id as u32, rings);
            asked.push(id as u32);
        }
    }
    mending.run(asked);
    // Changed cells have their rings after all others.
    for (id, parts) in mending.changed {
        let start = cells.starts.len() as u32 - 1;
        for part in parts {
            cells.corners.extend(part);
            cells.starts.push(cells.corners.len() as u32);
        }
        cells.sites[id as usize] = [start, cells.starts.len() as u32 - 1 - start];
    }
}

/// The length up to which sides of such corners are contracted.
pub(super) fn longest_side(corners: &[Point]) -> f64 {
    let largest = corners.iter().flatten().fold(0.0_f64, |max, x| max.max(x.abs()));
    LONGEST_SIDE * (largest.next_up() - largest)
}

#[inline(never)]
fn contains(places: &[Point], p: Point) -> bool {
    places.binary_search_by(|q| lexicographic(*q, p)).is_ok()
}

fn pairs(corners: &[u32]) -> impl Iterator<Item = Side> {
    (0..corners.len()).flat_map(move |i| (0..i).map(move |j| [corners[i], corners[j]]))
}

impl Mending<'_> {
    fn at(&self, vertex: u32) -> Point {
        self.cells.vertices[vertex as usize]
    }

    fn places(&self, ring: &[u32]) -> Vec<Point> {
        ring.iter().map(|&v| self.at(v)).collect()
    }

    #[inline(never)]
    fn order(&self, v: u32, w: u32) -> Ordering {
        lexicographic(self.at(v), self.at(w))
    }

    fn compare_sides(&self, a: Side, b: Side) -> Ordering {
        self.order(a[0], b[0]).then_with(|| self.order(a[1], b[1]))
    }

    fn is_corner(&self, v: u32) -> bool {
        contains(&self.region, self.at(v))
    }

    /// The new form of a cell, if it changed.
    #[inline(never)]
    fn found(&self, id: u32) -> Result<usize, usize> {
        self.changed.binary_search_by_key(&id, |changed| changed.0)
    }

    /// The rings of a cell as they are now.
    fn rings(&self, id: u32) -> Vec<&[u32]> {
        if let Ok(i) = self.found(id) {
            return self.changed[i].1.iter().map(Vec::as_slice).collect();
        }
        let [first, count] = self.cells.sites[id as usize].map(|n| n as usize);
        let ends = self.cells.starts[first..].windows(2).take(count);
        ends.map(|ends| &self.cells.corners[ends[0] as usize..ends[1] as usize]).collect()
    }

    /// Gives a cell rings, which fall apart into parts and grow together.
    fn put(&mut self, id: u32, rings: Parts) {
        let vertices = &self.cells.vertices;
        let (mut spikes, mut all) = (Vec::new(), Parts::new());
        rings.iter().for_each(|ring| all.append(&mut parts(ring, vertices, &mut spikes)));
        while let Some([[i, at_i], [j, at_j]]) = self.seam(&all) {
            let (mut ring, mut other) = (all.swap_remove(i.max(j)), all.swap_remove(i.min(j)));
            let (of_ring, of_other) = if i > j { (at_i, at_j) } else { (at_j, at_i) };
            ring.rotate_left(of_ring + 1);
            other.rotate_left(of_other + 1);
            ring.append(&mut other);
            all.append(&mut parts(&ring, vertices, &mut spikes));
        }
        for [v, w] in spikes {
            let side = if self.order(v, w).is_lt() { [v, w] } else { [w, v] };
            if self.is_corner(v) != self.is_corner(w) && self.length(side) <= self.longest(&side) {
                self.spikes.push(side);
            }
        }
        match self.found(id) {
            Ok(i) => self.changed[i].1 = all,
            Err(i) => self.changed.insert(i, (id, all)),
        }
    }

    /// Two rings with a side in common, one backwards, and where it begins in each.
    fn seam(&self, rings: &Parts) -> Option<[[usize; 2]; 2]> {
        if rings.len() < 2 {
            return None;
        }
        let mut sides: Vec<(Side, bool, [usize; 2])> = Vec::new();
        for (i, ring) in rings.iter().enumerate() {
            for (k, &v) in ring.iter().enumerate() {
                let w = ring[(k + 1) % ring.len()];
                let is_forward = self.order(v, w).is_lt();
                sides.push((if is_forward { [v, w] } else { [w, v] }, is_forward, [i, k]));
            }
        }
        sorting::by(&mut sides, |a, b| {
            self.compare_sides(a.0, b.0).then_with(|| (a.1, a.2).cmp(&(b.1, b.2)))
        });
        let is_seam = |pair: &&[(Side, bool, [usize; 2])]| {
            let [a, b] = [&pair[0], &pair[1]];
            self.compare_sides(a.0, b.0).is_eq() && a.1 != b.1 && a.2[0] != b.2[0]
        };
        sides.windows(2).find(is_seam).map(|pair| [pair[0].2, pair[1].2])
    }

    /// All rings rewritten; the cells that changed.
    fn rewrite(&mut self, new: &Rewriting<'_>) -> Vec<u32> {
        let mut asked = Vec::new();
        for id in 0..self.cells.sites.len() as u32 {
            let rings = self.rings(id);
            let rewritten: Vec<Option<Vec<u32>>> = rings.iter().map(|ring| new(self, ring)).collect();
            if rewritten.iter().any(Option::is_some) {
                let both = rewritten.into_iter().zip(rings);
                let all = both.map(|(new, old)| new.unwrap_or_else(|| old.to_vec())).collect();
                self.put(id, all);
                asked.push(id);
            }
        }
        asked
    }

    fn run(&mut self, mut asked: Vec<u32>) {
        for _ in 0..ROUNDS {
            let mut joins = std::mem::take(&mut self.spikes);
            let (mut inserts, mut waiting) = (Vec::new(), Vec::new());
            for &id in &asked {
                let before = inserts.len();
                self.wishes(&self.rings(id), &mut joins, &mut inserts);
                if inserts.len() > before {
                    waiting.push(id);
                }
            }
            // Corners that become one may spare the others.
            asked = self.join_all(joins);
            if asked.is_empty() {
                asked = self.insert_all(inserts);
            } else {
                asked.append(&mut waiting);
                sorting::by(&mut asked, u32::cmp);
                asked.dedup();
            }
            if asked.is_empty() {
                return;
            }
        }
    }

    /// The requests of the rings of a cell: sides to contract, and corners to insert into sides. Nothing if they are its border.
    fn wishes(&self, rings: &[&[u32]], joins: &mut Vec<Side>, inserts: &mut Vec<Near>) {
        let places: Vec<Vec<Point>> = rings.iter().map(|ring| self.places(ring)).collect();
        let is_good = match &places[..] {
            [ring] => is_border(ring.iter().copied(), |_| false),
            _ => (self.are_border)(&places),
        };
        if is_good {
            return;
        }
        let is_one = rings.len() == 1;
        let mut crossed =
            (0..rings.len()).filter(|&i| is_one || simple_orientation(&places[i], &|_| false).is_none());
        let mut any = false;
        for i in &mut crossed {
            any = true;
            self.wish(rings[i], joins, inserts);
        }
        if any {
            return;
        }
        // Rings that each are good: one has crossed another one, or was turned over.
        let mut best = None;
        for (i, ring) in rings.iter().enumerate() {
            for (_, other) in rings.iter().enumerate().filter(|(j, _)| *j != i) {
                self.nearest(other, ring, self.longest(&rings.concat()), &mut best);
            }
        }
        let all = rings.concat();
        if let Some(near) = best {
            inserts.push(near);
        } else if let Some(side) = self.shortest(pairs(&all), self.longest(&all)) {
            joins.push(side);
        } else {
            rings.iter().for_each(|ring| self.wish(ring, joins, inserts));
        }
    }

    /// The shortest side, or else the corner nearest to a side, or else the two nearest corners.
    fn wish(&self, ring: &[u32], joins: &mut Vec<Side>, inserts: &mut Vec<Near>) {
        let longest = self.longest(ring);
        if let Some(near) = self.tip(ring) {
            inserts.push(near);
            return;
        }
        let next = ring.iter().cycle().skip(1);
        let sides = ring.iter().zip(next).map(|(&v, &w)| [v, w]);
        if let Some(side) = self.shortest(sides, longest) {
            joins.push(side);
            return;
        }
        let mut best = None;
        self.nearest(ring, ring, longest, &mut best);
        if let Some(near) = best {
            inserts.push(near);
            return;
        }
        joins.extend(self.shortest(pairs(ring), longest));
    }

    /// A corner of the region alone on its side of the other two, in a ring that was turned over: it goes to the cell across.
    fn tip(&self, ring: &[u32]) -> Option<Near> {
        let [u, v, w] = *ring else { return None };
        let [p, q, r] = [u, v, w].map(|v| self.at(v));
        if !orient2d(p, q, r).is_negative() {
            return None;
        }
        let tips = [[u, v, w], [v, w, u], [w, u, v]];
        let only = |[a, b, c]: &[u32; 3]| self.is_corner(*a) && !self.is_corner(*b) && !self.is_corner(*c);
        let [corner, b, c] = tips.into_iter().find(only)?;
        Some(Near { height: 0.0, corner, side: if self.order(b, c).is_lt() { [b, c] } else { [c, b] } })
    }

    /// The length up to which sides of such corners are contracted.
    fn longest(&self, corners: &[u32]) -> f64 {
        longest_side(&self.places(corners))
    }

    fn length(&self, side: Side) -> f64 {
        let [p, q] = side.map(|v| self.at(v));
        (p[0] - q[0]).abs().max((p[1] - q[1]).abs())
    }

    /// The sides, each from its lesser end.
    fn sides(&self, ring: &[u32]) -> Vec<Side> {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(&v, &w)| if self.order(v, w).is_lt() { [v, w] } else { [w, v] }).collect()
    }

    /// The shortest side that may be contracted, from its lesser end; of several the lexicographically least.
    fn shortest(&self, sides: impl Iterator<Item = Side>, longest: f64) -> Option<Side> {
        let mut best: Option<Side> = None;
        for [v, w] in sides {
            let side = if self.order(v, w).is_lt() { [v, w] } else { [w, v] };
            let is_better = best.is_none_or(|other| {
                let order = self.length(side).total_cmp(&self.length(other));
                order.then_with(|| self.compare_sides(side, other)).is_lt()
            });
            let is_fixed = side.iter().all(|&v| self.is_corner(v));
            let is_side = self.order(v, w).is_ne();
            if is_side && self.length(side) <= longest && !is_fixed && is_better {
                best = Some(side);
            }
        }
        best
    }

    /// The corner that is nearest to a side of a ring, if it is between the ends along the axis on which these are furthest apart.
    /// Floating point chooses what is mended first, no more.
    fn nearest(&self, corners: &[u32], ring: &[u32], longest: f64, best: &mut Option<Near>) {
        for side in self.sides(ring) {
            let [p, q] = side.map(|v| self.at(v));
            let u = [q[0] - p[0], q[1] - p[1]];
            let axis = usize::from(u[0].abs() < u[1].abs());
            let [from, to] = [p[axis].min(q[axis]), p[axis].max(q[axis])];
            let length = hypotenuse(u[0], u[1]);
            for &corner in corners {
                let at = self.at(corner);
                let w = [at[0] - p[0], at[1] - p[1]];
                let height = (u[0] / length * w[1] - u[1] / length * w[0]).abs();
                let is_between = from < at[axis] && at[axis] < to;
                let is_better = best.is_none_or(|best| {
                    let order = height.total_cmp(&best.height).then_with(|| self.order(corner, best.corner));
                    order.then_with(|| self.compare_sides(side, best.side)).is_lt()
                });
                if is_between && height <= longest && is_better {
                    *best = Some(Near { height, corner, side });
                }
            }
        }
    }

    /// Makes the ends of sides one; the cells that changed.
    fn join_all(&mut self, mut sides: Vec<Side>) -> Vec<u32> {
        sorting::by(&mut sides, |a, b| self.compare_sides(*a, *b));
        // Vertices that go, sorted by place, each with one that stays or goes too.
        let mut to: Vec<Side> = Vec::new();
        for side in sides {
            let [a, b] = side.map(|v| self.moved(&to, v));
            let [p, q] = [a, b].map(|v| self.at(v));
            if p == q || (self.is_corner(a) && self.is_corner(b)) {
                continue;
            }
            let rank = |p: Point| (!contains(&self.region, p), !contains(&self.border, p));
            let is_first = rank(p).cmp(&rank(q)).then(lexicographic(p, q)).is_lt();
            let [stays, goes] = if is_first { [a, b] } else { [b, a] };
            if let Err(i) = to.binary_search_by(|pair| self.order(pair[0], goes)) {
                to.insert(i, [goes, stays]);
            }
        }
        if to.is_empty() {
            return Vec::new();
        }
        self.rewrite(&|mending, ring| {
            let moved = |&v: &u32| mending.moved(&to, v);
            ring.iter().any(|v| moved(v) != *v).then(|| ring.iter().map(moved).collect())
        })
    }

    /// The vertex that one has become.
    #[inline(never)]
    fn moved(&self, to: &[Side], mut v: u32) -> u32 {
        while let Ok(i) = to.binary_search_by(|pair| self.order(pair[0], v)) {
            v = to[i][1];
        }
        v
    }

    /// Makes corners part of sides, of several for a side the nearest; the cells that changed.
    fn insert_all(&mut self, mut inserts: Vec<Near>) -> Vec<u32> {
        sorting::by(&mut inserts, |a, b| {
            let nearest = || a.height.total_cmp(&b.height).then_with(|| self.order(a.corner, b.corner));
            self.compare_sides(a.side, b.side).then_with(nearest)
        });
        inserts.dedup_by(|a, b| self.compare_sides(a.side, b.side).is_eq());
        self.rewrite(&|mending, ring| {
            let mut new = Vec::new();
            for (&v, &w) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                new.push(v);
                let side = if mending.order(v, w).is_lt() { [v, w] } else { [w, v] };
                let found = inserts.binary_search_by(|near| mending.compare_sides(near.side, side));
                new.extend(found.map(|i| inserts[i].corner));
            }
            (new.len() > ring.len()).then_some(new)
        })
    }
}

/// The rings that a ring falls apart into where it visits a corner again, by the indices of its corners; what has fewer than three corners
/// is gone, and of two corners noted among the spikes.
fn parts(ring: &[u32], vertices: &[Point], spikes: &mut Vec<Side>) -> Vec<Vec<u32>> {
    let at = |i: &u32| vertices[*i as usize];
    let mut sorted = ring.to_vec();
    sorting::by(&mut sorted, |i, j| lexicographic(at(i), at(j)));
    let mut parts = Vec::new();
    let mut open: Vec<u32> = Vec::new();
    if sorted.windows(2).all(|pair| at(&pair[0]) != at(&pair[1])) {
        open.extend(ring);
    } else {
        for corner in ring {
            if let Some(start) = open.iter().position(|other| at(other) == at(corner)) {
                parts.push(open.split_off(start));
            }
            open.push(*corner);
        }
    }
    parts.push(open);
    spikes.extend(parts.iter().filter_map(|part| Side::try_from(&part[..]).ok()));
    parts.retain(|part| part.len() > 2);
    parts
}

#[cfg(test)]
mod tests {
    use super::{mend, parts};
    use crate::plane::region::Region2;
    use crate::plane::voronoi::cells::Cells2;

    type Ring = Vec<[f64; 2]>;

    fn is_border(ring: &[[f64; 2]]) -> bool {
        crate::plane::region::rings::is_border(ring.iter().copied(), |_| false)
    }

    /// Cells of one ring each, and all of which are mended.
    fn mended(rings: &[Ring], region: &Region2) -> Vec<Vec<Ring>> {
        let mut cells = Cells2 { starts: vec![0], ..Cells2::default() };
        let mut bad = Vec::new();
        for (i, ring) in rings.iter().enumerate() {
            for &corner in ring {
                cells.corners.push(cells.vertices.len() as u32);
                cells.vertices.push(corner);
            }
            cells.starts.push(cells.corners.len() as u32);
            cells.sites.push([i as u32, 1]);
            if !is_border(ring) {
                bad.push(i as u32);
            }
        }
        mend(&mut cells, &bad, &[], region);
        let of = |i: usize| cells.cell(crate::VertexId::new(i));
        (0..rings.len()).map(|i| of(i).rings().map(|ring| ring.points().collect()).collect()).collect()
    }

    fn unit() -> Region2 {
        Region2::rectangle([0.0, 0.0], [2.0, 2.0]).expect("a rectangle")
    }

    /// A cell of some ulps that is turned over becomes a side of its neighbors.
    #[test]
    fn cells_of_a_rounding_become_a_side() {
        let e = f64::EPSILON;
        let [a, b, c] = [[1.0, 1.0], [1.0 + e, 1.0], [1.0, 1.0 + e]];
        let rings = [
            vec![a, c, b],
            vec![[0.0, 0.0], [2.0, 0.0], b, a],
            vec![[2.0, 0.0], [2.0, 2.0], c, b],
            vec![[2.0, 2.0], [0.0, 2.0], [0.0, 0.0], a, c],
        ];
        let found = mended(&rings, &unit());
        assert_eq!(found[0], Vec::<Ring>::new());
        // Of the shortest sides that with the least ends was contracted, to the lesser end.
        let rest =
            [&rings[1], &vec![[2.0, 0.0], [2.0, 2.0], a, b], &vec![[2.0, 2.0], [0.0, 2.0], [0.0, 0.0], a]];
        for (found, expected) in found[1..].iter().zip(rest) {
            assert_eq!(found, std::slice::from_ref(expected));
            assert!(is_border(expected), "{expected:?}");
        }
    }

    /// Where no side is short the corner that has crossed a side becomes one of it, for both cells.
    #[test]
    fn corners_become_corners_of_sides() {
        let (p, q, far) = ([0.5, 0.5], [1.5, 0.5], [1.0, 1.5]);
        // The corner of the thin cell is a step on the wrong side of the side that it shares with the upper one.
        let crossed = [1.0, 0.5_f64.next_down()];
        let found = mended(&[vec![p, q, crossed], vec![p, q, far]], &unit());
        assert_eq!(found, [vec![], vec![vec![p, crossed, q, far]]]);
        // Far from the side it is none of it.
        let rings = [vec![p, q, [1.0, 0.25]], vec![p, q, far]];
        assert_eq!(mended(&rings, &unit()), rings.map(|ring| vec![ring]));
    }

    #[test]
    fn corners_of_the_region_stay_apart() {
        let e = f64::EPSILON;
        let corners = vec![[1.0, 1.0], [1.0 + e, 1.0], [1.0 + e, 2.0], [1.0, 2.0]];
        let region = Region2::polygon(std::slice::from_ref(&corners)).expect("a polygon");
        let turned: Ring = vec![corners[0], corners[3], corners[1]];
        let found = mended(&[turned], &region);
        assert!(found[0].iter().all(|ring| ring.iter().all(|corner| corners.contains(corner))));
    }

    #[test]
    fn rings_fall_apart_where_they_meet_themselves() {
        // Two vertices of each place.
        let vertices: Vec<[f64; 2]> = (0..20).map(|i| [f64::from(i % 10), 0.0]).collect();
        let of = |ring: &[u32]| {
            let other: Vec<u32> = ring.iter().enumerate().map(|(k, i)| i + 10 * (k as u32 % 2)).collect();
            let parts = parts(&other, &vertices, &mut Vec::new());
            parts
                .into_iter()
                .map(|part| part.into_iter().map(|i| i % 10).collect())
                .collect::<Vec<Vec<u32>>>()
        };
        assert_eq!(of(&[1, 2, 3, 4]), [[1, 2, 3, 4]]);
        // A spike goes, and a side that is gone and come again.
        assert_eq!(of(&[1, 2, 3, 2, 4]), [[1, 2, 4]]);
        assert_eq!(of(&[1, 2, 1, 2]), Vec::<Vec<u32>>::new());
        assert_eq!(of(&[1, 2, 2, 3, 3, 1]), [[1, 2, 3]]);
        assert_eq!(of(&[1, 2, 3, 1, 4, 5]), [[1, 2, 3], [1, 4, 5]]);
    }
}
