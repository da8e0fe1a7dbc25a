//! Rings that rounding turned over are mended: corners that are nearly one become one, in all cells that have them.
//!
//! Of every bad ring the shortest side is contracted, if it is no longer than some units in the last place; then the rings that
//! changed are asked again. Of two corners that become one the corner of the region stays, else the one on its border, else the
//! lexicographically least; two corners of the region stay apart. A bad ring without a short side gets its nearest corner as a corner of
//! the side that it has crossed. So what comes out depends on the rings alone, not on their order.
//!
//! It ends: each contraction takes a corner from the diagram, and each corner that a side gets divides a ring in two.
//!
//! Cost: a look at all corners for each round, of which there are few, and only where a ring is bad.

use delone_predicates::lexicographic;

use super::cells::Cells2;
use super::rings::{is_simple, parts};
use crate::plane::region::Region2;
use crate::sorting;

/// Sides are contracted, and corners put into sides, up to this length in units in the last place of a ring's largest coordinate. Of
/// 49 sets with rings that turned over none had one whose shortest side was above 4.
const LONGEST_SIDE: f64 = 8.0;
/// Rounds at most: those sets took 13.
const ROUNDS: usize = 1000;

type Point = [f64; 2];
/// Vertices.
type Side = [u32; 2];

/// What becomes of a part of a ring; nothing if it stays.
type Rewriting<'r> = dyn Fn(&Mending<'_>, &[u32]) -> Option<Vec<u32>> + 'r;

/// Cells, and the rings that changed. Vertices with one place are one corner.
struct Mending<'a> {
    cells: &'a Cells2,
    /// The places of the corners of the region, and of those on its border, sorted.
    region: Vec<Point>,
    border: Vec<Point>,
    /// Rings by number, sorted, and what they fall apart into.
    changed: Vec<(u32, Vec<Vec<u32>>)>,
}

/// Mends the rings with these numbers, and what changes with them. `border` are corners on the border of the region.
pub(super) fn mend(cells: &mut Cells2, bad: &[u32], border: &[Point], region: &Region2) {
    let sorted = |mut places: Vec<Point>| {
        sorting::by(&mut places, |p, q| lexicographic(*p, *q));
        places
    };
    let region = sorted(region.rings().flatten().copied().collect());
    let mut mending = Mending { cells, region, border: sorted(border.to_vec()), changed: Vec::new() };
    // Rings that visit a corner twice fall apart, and may be good then.
    for &ring in bad {
        mending.change(ring, vec![mending.ring(ring).to_vec()]);
    }
    mending.run(bad.to_vec());
    let changed = mending.changed;
    replace(cells, &changed);
}

#[inline(never)]
fn contains(places: &[Point], p: Point) -> bool {
    places.binary_search_by(|q| lexicographic(*q, p)).is_ok()
}

impl Mending<'_> {
    fn at(&self, vertex: u32) -> Point {
        self.cells.vertices[vertex as usize]
    }

    #[inline(never)]
    fn order(&self, v: u32, w: u32) -> std::cmp::Ordering {
        lexicographic(self.at(v), self.at(w))
    }

    /// The corners of a ring as it was.
    fn ring(&self, ring: u32) -> &[u32] {
        let [start, end] = [0, 1].map(|k| self.cells.starts[ring as usize + k] as usize);
        &self.cells.corners[start..end]
    }

    /// What has become of a ring, if it changed.
    #[inline(never)]
    fn found(&self, ring: u32) -> Result<usize, usize> {
        self.changed.binary_search_by_key(&ring, |changed| changed.0)
    }

    /// Gives a ring other corners.
    fn change(&mut self, ring: u32, new: Vec<Vec<u32>>) {
        let mut all = Vec::new();
        new.iter().for_each(|part| all.append(&mut parts(part, &self.cells.vertices)));
        match self.found(ring) {
            Ok(i) => self.changed[i].1 = all,
            Err(i) => self.changed.insert(i, (ring, all)),
        }
    }

    /// The corners of all parts of a ring mapped, if one of them is another then; adds the ring to those that changed.
    fn rewrite(&mut self, asked: &mut Vec<u32>, new: &Rewriting<'_>) {
        for ring in 0..self.cells.starts.len() as u32 - 1 {
            let rewritten: Vec<(Option<Vec<u32>>, &[u32])> = match self.found(ring) {
                Ok(i) => self.changed[i].1.iter().map(|part| (new(self, part), part.as_slice())).collect(),
                Err(_) => vec![(new(self, self.ring(ring)), self.ring(ring))],
            };
            if rewritten.iter().any(|(new, _)| new.is_some()) {
                let parts =
                    rewritten.into_iter().map(|(new, old)| new.unwrap_or_else(|| old.to_vec())).collect();
                self.change(ring, parts);
                asked.push(ring);
            }
        }
    }

    fn run(&mut self, mut asked: Vec<u32>) {
        for _ in 0..ROUNDS {
            let (mut joins, mut inserts, mut waiting) = (Vec::new(), Vec::new(), Vec::new());
            for &ring in &asked {
                let Ok(i) = self.found(ring) else { continue };
                for part in &self.changed[i].1 {
                    // Where corners became one even sides between exact corners are new.
                    let places: Vec<Point> = part.iter().map(|&v| self.at(v)).collect();
                    if is_simple(&places, &|_| false) {
                        continue;
                    }
                    if let Some(side) = self.shortest(part) {
                        joins.push(side);
                    } else if let Some(insert) = self.nearest(part) {
                        inserts.push(insert);
                        waiting.push(ring);
                    }
                }
            }
            // Corners that become one may spare the others.
            asked = self.join_all(joins);
            if asked.is_empty() {
                asked = self.insert_all(&inserts);
            } else {
                asked.append(&mut waiting);
            }
            if asked.is_empty() {
                return;
            }
        }
    }

    /// What is some units in the last place of the largest coordinate.
    fn longest(&self, part: &[u32]) -> f64 {
        let largest = part.iter().flat_map(|&v| self.at(v)).fold(0.0_f64, |max, x| max.max(x.abs()));
        LONGEST_SIDE * (largest.next_up() - largest)
    }

    /// The sides, each from its lesser end.
    fn sides<'p>(&'p self, part: &'p [u32]) -> impl Iterator<Item = Side> + 'p {
        let next = part.iter().cycle().skip(1);
        part.iter().zip(next).map(|(&v, &w)| if self.order(v, w).is_lt() { [v, w] } else { [w, v] })
    }

    /// The shortest side that may be contracted; of several the lexicographically least.
    fn shortest(&self, part: &[u32]) -> Option<Side> {
        let mut best: Option<(f64, Side)> = None;
        let longest = self.longest(part);
        for side in self.sides(part) {
            let [p, q] = side.map(|v| self.at(v));
            let length = (p[0] - q[0]).abs().max((p[1] - q[1]).abs());
            let is_fixed = contains(&self.region, p) && contains(&self.region, q);
            let is_better = best.is_none_or(|(least, other)| {
                length < least || (length == least && self.compare_sides(side, other).is_lt())
            });
            if length <= longest && !is_fixed && is_better {
                best = Some((length, side));
            }
        }
        Some(best?.1)
    }

    /// The corner that is nearest to a side, seen from which it is between the ends. Floating point chooses what is mended, no more.
    fn nearest(&self, part: &[u32]) -> Option<(u32, Side)> {
        let mut best: Option<(f64, u32, Side)> = None;
        let longest = self.longest(part);
        for side in self.sides(part) {
            let [p, q] = side.map(|v| self.at(v));
            let u = [q[0] - p[0], q[1] - p[1]];
            let length = u[0].hypot(u[1]);
            for &v in part.iter().filter(|v| !side.contains(v)) {
                let w = [self.at(v)[0] - p[0], self.at(v)[1] - p[1]];
                let along = (u[0] * w[0] + u[1] * w[1]) / length;
                let height = ((u[0] * w[1] - u[1] * w[0]) / length).abs();
                let is_better = best.is_none_or(|(least, other, of)| {
                    let order = self.order(v, other).then_with(|| self.compare_sides(side, of));
                    height < least || (height == least && order.is_lt())
                });
                if 0.0 < along && along < length && height <= longest && is_better {
                    best = Some((height, v, side));
                }
            }
        }
        best.map(|(_, v, side)| (v, side))
    }

    fn compare_sides(&self, a: Side, b: Side) -> std::cmp::Ordering {
        self.order(a[0], b[0]).then_with(|| self.order(a[1], b[1]))
    }

    /// Makes the ends of sides one; the rings that changed.
    fn join_all(&mut self, mut sides: Vec<Side>) -> Vec<u32> {
        sorting::by(&mut sides, |a, b| self.compare_sides(*a, *b));
        // Vertices that go, sorted by place, each with one that stays or goes too.
        let mut to: Vec<Side> = Vec::new();
        for side in sides {
            let [a, b] = side.map(|v| self.moved(&to, v));
            let [p, q] = [a, b].map(|v| self.at(v));
            if p == q || (contains(&self.region, p) && contains(&self.region, q)) {
                continue;
            }
            let rank = |p: Point| (!contains(&self.region, p), !contains(&self.border, p));
            let is_first = rank(p).cmp(&rank(q)).then(lexicographic(p, q)).is_lt();
            let [stays, goes] = if is_first { [a, b] } else { [b, a] };
            if let Err(i) = to.binary_search_by(|pair| self.order(pair[0], goes)) {
                to.insert(i, [goes, stays]);
            }
        }
        let mut asked = Vec::new();
        if !to.is_empty() {
            self.rewrite(&mut asked, &|mending, part| {
                let moved = |&v: &u32| mending.moved(&to, v);
                part.iter().any(|v| moved(v) != *v).then(|| part.iter().map(moved).collect())
            });
        }
        asked
    }

    /// The vertex that one has become.
    #[inline(never)]
    fn moved(&self, to: &[Side], mut v: u32) -> u32 {
        while let Ok(i) = to.binary_search_by(|pair| self.order(pair[0], v)) {
            v = to[i][1];
        }
        v
    }

    /// Makes corners part of sides; the rings that changed.
    fn insert_all(&mut self, inserts: &[(u32, Side)]) -> Vec<u32> {
        let mut asked = Vec::new();
        for &(corner, side) in inserts {
            let ends = side.map(|v| self.at(v));
            self.rewrite(&mut asked, &|mending, part| {
                let mut new = Vec::new();
                for (&v, &w) in part.iter().zip(part.iter().cycle().skip(1)) {
                    new.push(v);
                    let [p, q] = [v, w].map(|v| mending.at(v));
                    if [p, q] == ends || [q, p] == ends {
                        new.push(corner);
                    }
                }
                (new.len() > part.len()).then_some(new)
            });
        }
        asked
    }
}

/// Gives the cells of changed rings new ones, after all others.
fn replace(cells: &mut Cells2, changed: &[(u32, Vec<Vec<u32>>)]) {
    for id in 0..cells.sites.len() {
        let [first, count] = cells.sites[id];
        let from = changed.partition_point(|changed| changed.0 < first);
        if changed.get(from).is_none_or(|changed| changed.0 >= first + count) {
            continue;
        }
        let start = cells.starts.len() as u32 - 1;
        for ring in first..first + count {
            if let Ok(i) = changed.binary_search_by_key(&ring, |changed| changed.0) {
                for part in &changed[i].1 {
                    cells.corners.extend(part);
                    cells.starts.push(cells.corners.len() as u32);
                }
            } else {
                let [start, end] = [0, 1].map(|k| cells.starts[ring as usize + k] as usize);
                cells.corners.extend_from_within(start..end);
                cells.starts.push(cells.corners.len() as u32);
            }
        }
        cells.sites[id] = [start, cells.starts.len() as u32 - 1 - start];
    }
}

#[cfg(test)]
mod tests {
    use super::mend;
    use crate::plane::region::Region2;
    use crate::plane::voronoi::cells::Cells2;

    type Ring = Vec<[f64; 2]>;

    fn is_border(ring: &[[f64; 2]]) -> bool {
        crate::plane::voronoi::rings::is_border(ring.iter().copied(), |_| false)
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

    /// A cell of some ulps that is turned over becomes a side of its neighbours.
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
}
