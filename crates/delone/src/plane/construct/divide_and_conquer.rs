//! Divide and conquer on ghost triangles, in place.
//!
//! Source: Guibas & Stolfi, "Primitives for the manipulation of general subdivisions and the computation of
//! Voronoi diagrams", TOG 1985 (merging by a rising bubble); Dwyer, "A faster divide-and-conquer algorithm
//! for constructing Delaunay triangulations", Algorithmica 1987 (alternating cuts). The cuts here are those of
//! the Morton order, so nothing is stored for the recursion and nothing is searched.
//!
//! Cost: O(n log n) in the worst case for any data of bounded exponent range, O(m n) for points nested at m magnitudes: each merge
//! in such a chain may replace all triangles of the inner ones. 32 bytes a triangle, and nothing is allocated while merging.
//!
//! # In place
//!
//! n points closed by ghost triangles have exactly 2n - 2 triangles. The points at positions [lo, hi) of the
//! order own the triangles 2 lo .. 2 hi - 2; merging two neighbors at position m uses the two triangles
//! 2m - 2 and 2m - 1 between them. Connecting two vertices turns one ghost into a finite triangle, removing an
//! edge turns a finite triangle and a ghost into two ghosts; the count never changes, and memory of
//! neighboring points is neighboring memory.
//!
//! While building, the ghost of a hull edge u -> v (interior on its left) always has the corners
//! (v, u, ghost): edge 0 is the hull edge reversed, edge 1 leads to the ghost of the previous hull edge, edge
//! 2 to that of the next.

use std::hint::select_unpredictable as pick;
use std::ops::Range;

use delone_predicates::{Filter, Grid};

use super::Built;
use super::builder::Builder;
use super::leaf::Leaf;
use super::merge::{Merging, Part};
use super::rescaled::{Rescaled, SIZES, finest_step, grid_of};
use crate::ids::{Duplicate, Place, TriangleId, VertexId};
use crate::memory::zeroed;
use crate::mesh::triangles::{HalfEdge, Mesh2};
use crate::order::cuts::{Cut, KeyBox};
use crate::order::morton::{self, Sorted};
use crate::order::quantize::scaled;
use crate::parallel;
use crate::plane::layer::kernel::NearestSites;
use crate::points::{Bounds, survey};
use crate::tally::{Counters, Merges};

/// Triangulates points within their bounds, all finite and at most [`crate::MAX_POINTS`]. Vertices are at the places of
/// their indices.
pub(super) fn triangulate(points: &[[f64; 2]], bounds: &Bounds<2>) -> (Mesh2, Vec<Duplicate>, Merges) {
    let Sorted { points: ordered, indices, cuts, boxes, duplicates } = morton::sort(points, bounds);
    let (edges, counters) = build::<NearestSites>(&ordered, &[], &cuts, &boxes);
    let n = ordered.len();
    drop((ordered, cuts));
    let mut mesh = Mesh2 { edges, vertex_count: n, ..Mesh2::empty(0) };
    mesh.lone = if n == 1 { Some(Place::new(indices[0] as usize)) } else { None };
    mesh.number_vertices::<false>(points.len(), |position| Place::new(indices[position.index()] as usize));
    (mesh, sorted(duplicates), counters)
}

/// The triangulation of points, with vertices at their positions in Morton order.
#[derive(Clone, Debug)]
pub(crate) struct InOrder {
    pub(crate) mesh: Mesh2,
    /// The vertices' points.
    pub(crate) points: Vec<[f64; 2]>,
    /// Their indices.
    pub(crate) indices: Vec<u32>,
    pub(crate) duplicates: Vec<Duplicate>,
    counters: Merges,
}

impl InOrder {
    /// For each of so many points the place of its vertex.
    pub(in crate::plane) fn positions(&self, count: usize) -> Vec<Place> {
        let mut positions = parallel::filled(Place::GHOST, count);
        for (position, &i) in self.indices.iter().enumerate() {
            positions[i as usize] = Place::new(position);
        }
        for duplicate in &self.duplicates {
            positions[duplicate.point] = positions[duplicate.vertex.index()];
        }
        positions
    }

    /// The vertices as points of their own, and their indices.
    pub(in crate::plane) fn distinct(self) -> (Built, Vec<u32>) {
        let Self { mesh, points, indices, counters, .. } = self;
        let counters = Counters::DivideAndConquer(counters);
        (Built { points, mesh, duplicates: Vec::new(), counters }, indices)
    }

    /// Moves vertices to the places of their indices among all points; fixed edges stay.
    pub(in crate::plane) fn numbered(self, points: Vec<[f64; 2]>) -> Built {
        let Self { mut mesh, indices, duplicates, counters, .. } = self;
        mesh.move_vertices(points.len(), |position| Place::new(indices[position.index()] as usize));
        Built { points, mesh, duplicates, counters: Counters::DivideAndConquer(counters) }
    }
}

/// Triangulates like `triangulate`, but in the order of memory.
pub(crate) fn in_order(points: &[[f64; 2]]) -> InOrder {
    let Sorted { points, indices, cuts, boxes, duplicates } = morton::sort(points, &survey(points).0);
    let (edges, counters) = build::<NearestSites>(&points, &[], &cuts, &boxes);
    let n = points.len();
    let mut mesh = Mesh2 { edges, vertex_count: n, ..Mesh2::empty(0) };
    mesh.lone = if n == 1 { Some(Place::new(0)) } else { None };
    mesh.number_vertices::<false>(n, |position| position);
    InOrder { mesh, points, indices, duplicates: sorted(duplicates), counters }
}

fn sorted(duplicates: Vec<(u32, u32)>) -> Vec<Duplicate> {
    // By point, which no two have in common; as words, which Morton order sorts too.
    let mut words: Vec<u64> =
        duplicates.into_iter().map(|(point, vertex)| u64::from(point) << 32 | u64::from(vertex)).collect();
    words.sort_unstable();
    let named = |word: u64| Duplicate {
        point: (word >> 32) as usize,
        vertex: VertexId::new((word & u64::from(u32::MAX)) as usize),
    };
    words.into_iter().map(named).collect()
}

pub(super) fn build<K: Merging>(
    ordered: &[[f64; 2]],
    weights: &[K::Weight],
    cuts: &[Cut],
    boxes: &[KeyBox],
) -> (Vec<HalfEdge>, Merges) {
    let n = ordered.len();
    // Weights would have to be scaled by the square, which may leave the range.
    let scaled = if K::HIDES { None } else { scaled(n, |i| ordered[i], &SIZES) };
    let (ordered, scale) = scaled.as_ref().map_or((ordered, 1.0), |(points, scale)| (&points[..], *scale));
    let mut edges: Vec<HalfEdge> = zeroed(8 * n.saturating_sub(1));
    let mut leaving: Vec<TriangleId> = zeroed(n);
    let mut builder = Builder::<K>::new(ordered, weights, 0, &mut edges, &mut leaving);
    if n > 0 {
        let grid = grid_of(ordered.as_flattened(), finest_step(boxes, scale));
        let near = if K::HIDES { None } else { Rescaled::of(ordered, boxes, scale) };
        Tree { cuts, boxes, scale, grid, near: near.as_ref() }.build(0, LEVELS, &mut builder);
    }
    let counters = builder.counters;
    (edges, counters)
}

/// The tree that the cuts are, walked without being built.
#[derive(Clone, Copy)]
struct Tree<'a> {
    cuts: &'a [Cut],
    boxes: &'a [KeyBox],
    /// The factor of all coordinates since the boxes were made.
    scale: f64,
    grid: Option<Grid>,
    near: Option<&'a Rescaled>,
}

/// Halves of halves are on the stack, and far points can make thousands of them: deeper than this, one thread goes on.
const LEVELS: u32 = 128;

/// The part of a box that threads share.
struct Work<'a> {
    index: usize,
    cells: &'a Cells<'a>,
    /// A run of so many points is not worth another thread.
    most: usize,
}

/// A box, and the static filters of its depths.
struct Cells<'a> {
    key_box: KeyBox,
    filters: &'a [Filter],
}

/// Parts that wait for their right neighbor, with the cuts behind them, deeper and deeper.
type Waiting = Vec<(Part, Cut)>;

impl Tree<'_> {
    /// Triangulates the points of a box, in parallel if they are many: the tree is divided at its shallowest cuts into runs
    /// that are not too large, which tasks build in memory of their own.
    fn build<K: Merging>(&self, index: usize, levels: u32, builder: &mut Builder<K>) -> Part {
        let key_box = self.boxes[index];
        let near = self.near.filter(|near| near.powers[index] != 1.0);
        let (power, grid) = near.map_or((1.0, self.grid), |near| (near.powers[index], None));
        let cell_filter = |depth| {
            let [width, height] = key_box.cell(depth).map(|side| side * self.scale * power);
            Filter::for_box(width, height, grid)
        };
        // A few points have one depth, and need no memory for it.
        let (one, many);
        let filters: &[Filter] = if key_box.depths() == 1 {
            one = [cell_filter(0)];
            &one
        } else {
            many = (0..key_box.depths()).map(cell_filter).collect::<Vec<_>>();
            &many
        };
        let cells = Cells { key_box, filters };
        let all = key_box.start..key_box.end;
        let most = all.len().div_ceil(parallel::parts(all.len()));
        let work = Work { index, cells: &cells, most };
        let Some(near) = near else {
            return self.halve(&work, all, levels, builder);
        };
        let mut scaled = builder.over(&near.points);
        let part = self.halve(&work, all, levels, &mut scaled);
        let counters = scaled.counters;
        builder.counters.add(&counters);
        part
    }

    /// Triangulates a run of points of a box that is a subtree. If it has too many, both halves at its shallowest cut at once,
    /// in memory of their own.
    fn halve<K: Merging>(
        &self,
        work: &Work,
        run: Range<usize>,
        levels: u32,
        builder: &mut Builder<K>,
    ) -> Part {
        let &Work { index, cells, most } = work;
        let is_large = run.len() > most && levels > 0;
        let shallowest = if is_large { self.shallowest_cut(index, &run) } else { None };
        let Some(middle) = shallowest else {
            // A run that is a box of its own may be as large as all of this one.
            return match self.box_of(index, &run) {
                Some(nested) => self.build(nested, levels, builder),
                None => self.run(index, cells, run, builder),
            };
        };
        let [mut left, mut right] = builder.split(middle);
        let levels = levels - 1;
        let (a, b) = parallel::join(
            || self.halve(work, run.start..middle, levels, &mut left),
            || self.halve(work, middle..run.end, levels, &mut right),
        );
        let counters = [left.counters, right.counters];
        counters.iter().for_each(|of_half| builder.counters.add(of_half));
        let (depth, by_x) = cells.key_box.split(self.cuts[middle]);
        builder.merge(&a, &b, by_x, &cells.filters[depth])
    }

    /// The position before which a run has its shallowest cut, those inside of nested boxes not counted.
    fn shallowest_cut(&self, index: usize, run: &Range<usize>) -> Option<usize> {
        let mut best = None;
        let mut nested = self.first_nested(index, run.start);
        let mut at = run.start + 1;
        while at < run.end {
            let inner = self.boxes.get(nested).filter(|inner| inner.start < run.end);
            let limit = inner.map_or(run.end, |inner| inner.start + 1).max(at);
            let shallowest = Cut::first_shallowest(&self.cuts[at..limit]).map(|k| at + k);
            best = best.into_iter().chain(shallowest).min_by_key(|&at| self.cuts[at]);
            at = inner.map_or(run.end, |inner| inner.end);
            nested = self.first_nested(nested, at);
        }
        best
    }

    /// The box that is nested in another one and is the whole of a run.
    fn box_of(&self, index: usize, run: &Range<usize>) -> Option<usize> {
        let nested = self.first_nested(index, run.start);
        self.boxes.get(nested).is_some_and(|b| b.start == run.start && b.end == run.end).then_some(nested)
    }

    /// The first box after another one that starts at a position or later.
    fn first_nested(&self, index: usize, start: usize) -> usize {
        let after = self.boxes.get(index + 1..).unwrap_or_default();
        index + 1 + after.partition_point(|b| b.start < start)
    }

    /// Triangulates a run of points of a box that is a subtree. Recursion follows the nesting of boxes, whose depth the
    /// exponent range bounds; inside a box the parts that wait for a neighbor are on a stack.
    fn run<K: Merging>(
        &self,
        index: usize,
        cells: &Cells,
        run: Range<usize>,
        builder: &mut Builder<K>,
    ) -> Part {
        let mut waiting = Waiting::with_capacity(8);
        let mut next_box = self.first_nested(index, run.start);
        let mut at = run.start;
        loop {
            let nested = self.boxes.get(next_box).filter(|b| b.start < run.end);
            let limit = nested.map_or(run.end, |b| b.start);
            let part = if at == limit {
                let part = self.build(next_box, 0, builder);
                next_box = self.first_nested(next_box, part.end);
                part
            } else {
                let (count, shallowest) = self.leaf_at(at, limit, &run);
                let depth = shallowest.map_or(0, |cut| cells.key_box.split(cut).0);
                let filter = &cells.filters[depth];
                let leaf = if count > 1 { builder.leaf(at, count, filter) } else { Leaf::Collinear };
                match leaf {
                    Leaf::Part(part) => part,
                    Leaf::Collinear => Part::single(at),
                }
            };
            at = part.end;
            let after = if at == run.end { Cut::OUTSIDE } else { self.cuts[at] };
            let part = cells.join(builder, &mut waiting, part, after);
            if at == run.end {
                return part;
            }
            waiting.push((part, after));
        }
    }

    /// The size of the largest subtree of at most four points of a run that starts at a position, and its shallowest cut.
    fn leaf_at(&self, at: usize, limit: usize, run: &Range<usize>) -> (usize, Option<Cut>) {
        let outside = |i: usize| i == run.start || i == run.end;
        let cut = |i: usize| if outside(i) { Cut::OUTSIDE } else { self.cuts[i] };
        if at + 4 < limit {
            // All four at once: which one it is cannot be foretold.
            let before = cut(at);
            let [a, b, c, d] = [1, 2, 3, 4].map(|k| self.cuts[at + k]);
            let (ab, abc) = (a.min(b), a.min(b).min(c));
            let two = 1 + usize::from(a > before.max(b));
            let three = 3 * usize::from(ab > before.max(c));
            let four = 4 * usize::from(abc > before.max(d));
            let count = two.max(three).max(four);
            return (count, [None, Some(a), Some(ab), Some(abc)][count - 1]);
        }
        let whole = |&count: &usize| {
            let border = cut(at).max(cut(at + count));
            self.cuts[at + 1..at + count].iter().all(|&inner| inner > border)
        };
        let longest = (limit - at).min(4);
        let count = (2..=longest).rev().find(whole).unwrap_or(1);
        (count, self.cuts[at + 1..at + count].iter().min().copied())
    }
}

impl Cells<'_> {
    /// Merges a part with those to its left, as long as the cuts between them are deeper than the one after it.
    fn join<K: Merging>(
        &self,
        builder: &mut Builder<K>,
        waiting: &mut Waiting,
        mut part: Part,
        after: Cut,
    ) -> Part {
        while let Some((left, cut)) = waiting.pop_if(|(_, cut)| *cut > after) {
            let (depth, by_x) = self.key_box.split(cut);
            part = builder.merge(&left, &part, by_x, &self.filters[depth]);
        }
        part
    }
}

impl Part {
    /// One point.
    pub(super) fn single(at: usize) -> Self {
        let v = Place::new(at);
        Self { start: at, end: at + 1, west: v, east: v, south: v, north: v }
    }

    /// The extreme corners of a few points.
    pub(super) fn of_points(points: &[[f64; 2]], start: usize, end: usize) -> Self {
        let mut part = Self::single(start);
        part.end = end;
        for at in start + 1..end {
            let v = Place::new(at);
            let p = |v: Place| points[v.index()];
            part.west = pick(precedes(p(v), p(part.west)), v, part.west);
            part.east = pick(precedes(p(part.east), p(v)), v, part.east);
            part.south = pick(precedes(turned(p(v)), turned(p(part.south))), v, part.south);
            part.north = pick(precedes(turned(p(part.north)), turned(p(v))), v, part.north);
        }
        part
    }

    /// The positions and extreme corners of two parts, `a` to the left of `b` if cut by x, else below.
    pub(super) fn union(points: &[[f64; 2]], a: &Self, b: &Self, by_x: bool) -> Self {
        let p = |v: Place| points[v.index()];
        let mut part = Self { end: b.end, ..*a };
        if by_x {
            part.east = b.east;
            part.south = pick(precedes(turned(p(b.south)), turned(p(a.south))), b.south, a.south);
            part.north = pick(precedes(turned(p(a.north)), turned(p(b.north))), b.north, a.north);
        } else {
            part.north = b.north;
            part.west = pick(precedes(p(b.west), p(a.west)), b.west, a.west);
            part.east = pick(precedes(p(a.east), p(b.east)), b.east, a.east);
        }
        part
    }
}

/// Lexicographic order of points, for choosing corners. Without branches: either answer is as likely.
#[inline]
fn precedes(p: [f64; 2], q: [f64; 2]) -> bool {
    let [is_less, is_equal, is_below] = [p[0] < q[0], p[0] == q[0], p[1] < q[1]];
    pick(is_equal, is_below, is_less)
}

/// A quarter turn: the order by (y, -x) is the lexicographic order of turned points.
#[inline]
fn turned([x, y]: [f64; 2]) -> [f64; 2] {
    [y, -x]
}

#[cfg(test)]
mod tests {
    use delone_generators::Kind;

    use super::*;

    fn counters_of(points: &[[f64; 2]]) -> Merges {
        triangulate(points, &survey(points).0).2
    }

    /// Points of which no three are on a line: in the order of x, cut in the middle, into fours as long as there are four.
    #[test]
    fn up_to_four_points_are_a_leaf() {
        let expected = [
            (1, 0, 0),
            (2, 1, 0),
            (3, 1, 0),
            (4, 1, 0),
            (5, 1, 1),
            (6, 2, 1),
            (7, 2, 1),
            (8, 2, 1),
            (9, 2, 2),
            (11, 3, 2),
            (12, 3, 2),
        ];
        for (n, leaves, merges) in expected {
            let points: Vec<_> = (0..n).map(f64::from).map(|x| [x, x * x]).collect();
            let found = counters_of(&points);
            assert_eq!((found.leaves, found.merges), (leaves, merges), "{n} points");
        }
    }

    #[test]
    fn counters_are_added() {
        let mut sum = Merges { leaves: 1, merges: 2, connected: 3, removed: 4 };
        sum.add(&Merges { leaves: 10, merges: 20, connected: 30, removed: 40 });
        assert_eq!(sum, Merges { leaves: 11, merges: 22, connected: 33, removed: 44 });
    }

    /// The definitions of where a run of a box is cut and of which runs are boxes, on every run down to single points.
    fn judge_runs(tree: &Tree, index: usize, run: Range<usize>, met: &mut [usize; 2]) {
        let nested = || tree.boxes.iter().enumerate().skip(index + 1);
        let is_inside = |at: &usize| nested().any(|(_, b)| b.start < *at && *at < b.end);
        let cuts = (run.start + 1..run.end).filter(|at| !is_inside(at));
        let shallowest = cuts.min_by_key(|&at| (tree.cuts[at], at));
        assert_eq!(tree.shallowest_cut(index, &run), shallowest, "{run:?} of box {index}");
        let whole = nested().find(|(_, b)| (b.start..b.end) == run).map(|(k, _)| k);
        assert_eq!(tree.box_of(index, &run), whole, "{run:?} of box {index}");
        if let Some(middle) = shallowest {
            met[0] += 1;
            judge_runs(tree, index, run.start..middle, met);
            judge_runs(tree, index, middle..run.end, met);
        } else if let Some(nested) = whole {
            met[1] += 1;
            judge_runs(tree, nested, run, met);
        }
    }

    #[test]
    fn runs_are_cut_where_cuts_are_shallowest() {
        // Crowds in the crowds of crowds, and some alone.
        let mut points = Kind::Uniform.points(40, 1);
        for size in [1e-5, 1e-11] {
            let around = Kind::Uniform.points(50, 2);
            let add = |&[x, y]: &[f64; 2]| around.iter().map(move |&[u, v]| [x + size * u, y + size * v]);
            let crowds: Vec<_> = points.iter().step_by(10).flat_map(add).collect();
            points.extend(crowds);
        }
        let Sorted { points: sorted, cuts, boxes, .. } = morton::sort(&points, &survey(&points).0);
        let tree = Tree { cuts: &cuts, boxes: &boxes, scale: 1.0, grid: None, near: None };
        let mut met = [0; 2];
        judge_runs(&tree, 0, 0..sorted.len(), &mut met);
        assert_eq!(met, [sorted.len() - 1, boxes.len() - 1]);
        assert!(boxes.len() > 10, "{} boxes", boxes.len());
    }

    /// Counters include steps that only one of many threads makes.
    #[test]
    fn grids_hold_all_coordinates() {
        let mut coordinates: Vec<f64> = (0..100_000).map(f64::from).collect();
        assert!(grid_of(&coordinates, 0.5).is_some_and(|grid| grid.holds(1.0) && !grid.holds(0.5)));
        *coordinates.last_mut().expect("many") = 0.25;
        assert!(grid_of(&coordinates, 0.125).is_some_and(|grid| grid.holds(0.25)));
        assert!(grid_of(&coordinates, 0.5).is_none());
    }
}
