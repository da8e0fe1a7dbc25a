//! Rings that rounding turned over are mended: corners that are nearly one become one, in all cells that have them.
//!
//! Of every bad ring the shortest side is contracted, if it is no longer than some units in the last place; then the rings that
//! changed are asked again. Of two corners that become one the corner of the region stays, else the one on its border, else the
//! lexicographically least; two corners of the region stay apart. A bad ring without a short side gets its nearest corner as a corner of
//! the side that it has crossed. So what comes out depends on the rings alone, not on their order.
//!
//! It ends: each contraction takes a corner from the diagram, and each corner that a side gets divides a ring in two.
//!
//! Cost: a look at all corners for each time that new ones are asked about, and O(k log n) for k corners that move.

use std::collections::{BTreeMap, BTreeSet};

use super::cells::Cells2;
use super::rings::{At, is_border, parts};
use crate::plane::region::Region2;

/// Sides are contracted, and corners put into sides, up to this length in units in the last place of a ring's largest coordinate. Of
/// 49 sets with rings that turned over none had one whose shortest side was above 4.
const LONGEST_SIDE: f64 = 8.0;
/// Rounds at most: those sets took 13.
const ROUNDS: usize = 1000;

/// The parts of a ring.
type Parts = Vec<Vec<At>>;

/// Rings that may change, and which corners belong to which.
struct Rings<'a> {
    cells: &'a Cells2,
    region: BTreeSet<At>,
    border: BTreeSet<At>,
    /// By number, those that have a corner which was asked about.
    rings: BTreeMap<u32, Parts>,
    /// The corners all of whose rings are there.
    known: BTreeSet<At>,
    /// The rings of each corner.
    of: BTreeMap<At, BTreeSet<u32>>,
    /// The vertex that a corner comes from.
    vertices: BTreeMap<At, u32>,
    changed: BTreeSet<u32>,
}

/// What a bad ring asks for.
enum Wish {
    /// The ends of a side become one.
    Join([At; 2]),
    /// A corner becomes one of a side.
    Insert(At, [At; 2]),
}

/// Mends the rings with these numbers, and what changes with them. `border` are corners on the border of the region.
pub(super) fn mend(cells: &mut Cells2, bad: &[u32], border: &[[f64; 2]], region: &Region2) {
    let mut rings = Rings {
        cells,
        region: region.rings().flatten().copied().map(At).collect(),
        border: border.iter().copied().map(At).collect(),
        rings: BTreeMap::new(),
        known: BTreeSet::new(),
        of: BTreeMap::new(),
        vertices: BTreeMap::new(),
        changed: BTreeSet::new(),
    };
    let corners = bad.iter().flat_map(|&ring| corners(cells, ring).map(|(_, at)| at)).collect();
    rings.ask(&corners);
    // Rings that visit a corner twice fall apart, and may be good then.
    rings.changed.extend(bad);
    rings.run(bad.iter().copied().collect());
    let Rings { rings, changed, vertices, .. } = rings;
    replace(cells, &rings, &changed, &vertices);
}

/// The vertices and corners of a ring.
fn corners(cells: &Cells2, ring: u32) -> impl Iterator<Item = (u32, At)> + '_ {
    let [start, end] = [0, 1].map(|k| cells.starts[ring as usize + k] as usize);
    cells.corners[start..end].iter().map(|&i| (i, At(cells.vertices[i as usize])))
}

impl Rings<'_> {
    /// Makes sure that all rings of some corners are there.
    fn ask(&mut self, asked: &BTreeSet<At>) {
        let new: BTreeSet<At> = asked.difference(&self.known).copied().collect();
        if new.is_empty() {
            return;
        }
        for ring in 0..self.cells.starts.len() as u32 - 1 {
            let has_new = || corners(self.cells, ring).any(|(_, at)| new.contains(&at));
            if self.rings.contains_key(&ring) || !has_new() {
                continue;
            }
            for (vertex, at) in corners(self.cells, ring) {
                self.vertices.entry(at).or_insert(vertex);
                self.of.entry(at).or_default().insert(ring);
            }
            self.rings.insert(ring, parts(corners(self.cells, ring).map(|(_, at)| at)));
        }
        self.known.extend(new);
    }

    fn run(&mut self, mut asked: BTreeSet<u32>) {
        for _ in 0..ROUNDS {
            let (mut joins, mut inserts, mut waiting) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
            for ring in asked {
                let parts = self.rings[&ring].iter();
                for part in parts.filter(|part| !is_border(part.iter().map(|at| at.0))) {
                    match self.wish(part) {
                        Some(Wish::Join(side)) => joins.extend([side]),
                        Some(Wish::Insert(at, side)) => {
                            inserts.extend([(at, side)]);
                            waiting.extend([ring]);
                        }
                        None => (),
                    }
                }
            }
            // Corners that become one may spare the others.
            asked = self.join_all(&joins);
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

    /// The shortest side, or else the corner nearest to a side.
    fn wish(&self, part: &[At]) -> Option<Wish> {
        let largest = part.iter().flat_map(|at| at.0).fold(0.0_f64, |max, x| max.max(x.abs()));
        let longest = LONGEST_SIDE * (largest.next_up() - largest);
        let next = part.iter().cycle().skip(1);
        let sides: Vec<[At; 2]> = part.iter().zip(next).map(|(&p, &q)| [p.min(q), p.max(q)]).collect();
        let length = |[p, q]: [At; 2]| (p.0[0] - q.0[0]).abs().max((p.0[1] - q.0[1]).abs());
        let may_join =
            |side: &&[At; 2]| length(**side) <= longest && !side.iter().all(|at| self.region.contains(at));
        let order = |a: &&[At; 2], b: &&[At; 2]| length(**a).total_cmp(&length(**b)).then_with(|| a.cmp(b));
        if let Some(&side) = sides.iter().filter(may_join).min_by(order) {
            return Some(Wish::Join(side));
        }
        let heights = sides.iter().flat_map(|&side| {
            let others = part.iter().filter(move |at| !side.contains(at));
            others.filter_map(move |&at| Some((height(at, side)?, at, side)))
        });
        let near = heights.filter(|(height, ..)| *height <= longest);
        let (_, at, side) =
            near.min_by(|a, b| a.0.total_cmp(&b.0).then_with(|| (a.1, a.2).cmp(&(b.1, b.2))))?;
        Some(Wish::Insert(at, side))
    }

    /// Makes the ends of sides one; the rings that changed.
    fn join_all(&mut self, sides: &BTreeSet<[At; 2]>) -> BTreeSet<u32> {
        self.ask(&sides.iter().flatten().copied().collect());
        let mut to: BTreeMap<At, At> = BTreeMap::new();
        let mut touched = BTreeSet::new();
        for side in sides {
            let [a, b] = side.map(|at| moved(&to, at));
            if a == b || (self.region.contains(&a) && self.region.contains(&b)) {
                continue;
            }
            let rank = |at: At| (!self.region.contains(&at), !self.border.contains(&at), at);
            let (stays, goes) = if rank(a) < rank(b) { (a, b) } else { (b, a) };
            let of = self.of.remove(&goes).unwrap_or_default();
            touched.extend(&of);
            self.of.entry(stays).or_default().extend(of);
            to.insert(goes, stays);
        }
        for ring in &touched {
            let old = self.rings.get_mut(ring).map(std::mem::take).unwrap_or_default();
            let new =
                old.into_iter().flat_map(|part| parts(part.into_iter().map(|at| moved(&to, at)))).collect();
            self.rings.insert(*ring, new);
        }
        self.changed.extend(&touched);
        touched
    }

    /// Makes corners part of sides; the rings that changed.
    fn insert_all(&mut self, inserts: &BTreeSet<(At, [At; 2])>) -> BTreeSet<u32> {
        self.ask(&inserts.iter().flat_map(|(at, side)| [*at, side[0], side[1]]).collect());
        let mut touched = BTreeSet::new();
        for &(at, side) in inserts {
            let of = |at: &At| self.of.get(at).cloned().unwrap_or_default();
            let both: BTreeSet<u32> = of(&side[0]).intersection(&of(&side[1])).copied().collect();
            for ring in both {
                let old = self.rings.get_mut(&ring).map(std::mem::take).unwrap_or_default();
                let with = |part: Vec<At>| {
                    let next: Vec<At> = part.iter().cycle().skip(1).take(part.len()).copied().collect();
                    part.into_iter().zip(next).flat_map(move |(p, q)| {
                        let is_side = [p.min(q), p.max(q)] == side;
                        std::iter::once(p).chain(is_side.then_some(at))
                    })
                };
                let new: Parts = old.into_iter().flat_map(|part| parts(with(part))).collect();
                self.rings.insert(ring, new);
                self.of.entry(at).or_default().insert(ring);
                touched.insert(ring);
            }
        }
        self.changed.extend(&touched);
        touched
    }
}

/// The corner that one has become.
fn moved(to: &BTreeMap<At, At>, mut at: At) -> At {
    while let Some(&other) = to.get(&at) {
        at = other;
    }
    at
}

/// How far a corner is from a side, if the nearest point is between its ends. Floating point chooses what is mended first, no more.
fn height(at: At, [p, q]: [At; 2]) -> Option<f64> {
    let less = |a: At, b: At| [a.0[0] - b.0[0], a.0[1] - b.0[1]];
    let (u, w) = (less(q, p), less(at, p));
    let length = u[0].hypot(u[1]);
    let (along, across) = ((u[0] / length, u[1] / length), (w[0], w[1]));
    let share = along.0 * across.0 + along.1 * across.1;
    (0.0 < share && share < length).then(|| (along.0 * across.1 - along.1 * across.0).abs())
}

/// Gives the cells of changed rings new ones, after all others.
fn replace(
    cells: &mut Cells2,
    rings: &BTreeMap<u32, Parts>,
    changed: &BTreeSet<u32>,
    vertices: &BTreeMap<At, u32>,
) {
    for id in 0..cells.sites.len() {
        let [first, count] = cells.sites[id];
        if changed.range(first..first + count).next().is_none() {
            continue;
        }
        let start = cells.starts.len() as u32 - 1;
        for ring in first..first + count {
            let corners: Vec<Vec<u32>> = if changed.contains(&ring) {
                rings[&ring].iter().map(|part| part.iter().map(|at| vertices[at]).collect()).collect()
            } else {
                vec![corners(cells, ring).map(|(vertex, _)| vertex).collect()]
            };
            for part in corners {
                cells.corners.extend(part);
                cells.starts.push(cells.corners.len() as u32);
            }
        }
        cells.sites[id] = [start, cells.starts.len() as u32 - 1 - start];
    }
}

#[cfg(test)]
mod tests {
    use super::{mend, parts};
    use crate::plane::region::Region2;
    use crate::plane::voronoi::cells::Cells2;
    use crate::plane::voronoi::rings::{At, is_border};

    type Ring = Vec<[f64; 2]>;

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
            if !is_border(ring.iter().copied()) {
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
            assert!(is_border(expected.iter().copied()), "{expected:?}");
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
        let region = Region2::polygon(&[corners.clone()]).expect("a polygon");
        let turned: Ring = vec![corners[0], corners[3], corners[1]];
        let found = mended(&[turned], &region);
        assert!(found[0].iter().all(|ring| ring.iter().all(|corner| corners.contains(corner))));
        assert!(parts([At([0.0, 0.0])]).is_empty());
    }
}
