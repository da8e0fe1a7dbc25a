//! Divide and conquer on ghost triangles, in place.
//!
//! Source: Guibas & Stolfi, "Primitives for the manipulation of general subdivisions and the computation of
//! Voronoi diagrams", TOG 1985 (merging by a rising bubble); Dwyer, "A faster divide-and-conquer algorithm
//! for constructing Delaunay triangulations", Algorithmica 1987 (alternating cuts). The cuts here are those of
//! the Morton order, so nothing is stored for the recursion and nothing is searched.
//!
//! Cost: O(n log n) in the worst case for any data of bounded exponent range; 32 bytes a triangle and nothing
//! is allocated while merging.
//!
//! # In place
//!
//! n points closed by ghost triangles have exactly 2n - 2 triangles. The points at positions [lo, hi) of the
//! order own the triangles 2 lo .. 2 hi - 2; merging two neighbours at position m uses the two triangles
//! 2m - 2 and 2m - 1 between them. Connecting two vertices turns one ghost into a finite triangle, removing an
//! edge turns a finite triangle and a ghost into two ghosts; the count never changes, and memory of
//! neighbouring points is neighbouring memory.
//!
//! While building, the ghost of a hull edge u -> v (interior on its left) always has the corners
//! (v, u, ghost): edge 0 is the hull edge reversed, edge 1 leads to the ghost of the previous hull edge, edge
//! 2 to that of the next.

use delone_predicates::{Filter, Grid, lexicographic};

use super::leaf::Leaf;
use super::merge::Part;
use crate::ids::{Duplicate, EdgeId, Place, TriangleId, VertexId};
use crate::mesh::{HalfEdge, Mesh};
use crate::order::morton::{self, Cut, KeyBox, Sorted};

/// What was done, for those who measure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Counters {
    /// Sets of two, three or four points triangulated at once.
    pub leaves: u64,
    /// Pairs of triangulations merged.
    pub merges: u64,
    /// Edges added across a cut, the first of each merge not counted.
    pub connected: u64,
    /// Edges removed along a cut.
    pub removed: u64,
}

/// The state of the algorithm. Vertices are positions in the order until the very end.
pub(super) struct Builder<'a> {
    pub(super) points: &'a [[f64; 2]],
    pub(super) edges: Vec<HalfEdge>,
    /// For each strict corner of a hull the ghost of the hull edge that leaves it.
    pub(super) leaving: Vec<TriangleId>,
    pub(super) counters: Counters,
}

/// Triangulates points, all finite and at most [`crate::MAX_POINTS`]. Vertices are at the places of their
/// indices.
pub(super) fn triangulate(points: &[[f64; 2]]) -> (Mesh, Vec<Duplicate>, Counters) {
    let Sorted { points: ordered, indices, cuts, boxes, duplicates } = morton::sort(points);
    let (edges, counters) = build(&ordered, &cuts, &boxes);
    let n = ordered.len();
    drop((ordered, cuts));
    let mut mesh = Mesh { edges, vertex_count: n, ..Mesh::empty(points.len()) };
    mesh.lone = if n == 1 { Some(Place::new(indices[0] as usize)) } else { None };
    mesh.number_vertices(|position| Place::new(indices[position.index()] as usize));
    (mesh, sorted(duplicates), counters)
}

/// The triangulation of points, with vertices at their positions in Morton order.
pub(in crate::plane) struct InOrder {
    pub(in crate::plane) mesh: Mesh,
    /// The vertices' points.
    pub(in crate::plane) points: Vec<[f64; 2]>,
    /// Their indices.
    pub(in crate::plane) indices: Vec<u32>,
    pub(in crate::plane) duplicates: Vec<Duplicate>,
}

/// The same as `triangulate`, in the order of memory.
pub(in crate::plane) fn in_order(points: &[[f64; 2]]) -> InOrder {
    let Sorted { points, indices, cuts, boxes, duplicates } = morton::sort(points);
    let (edges, _) = build(&points, &cuts, &boxes);
    let n = points.len();
    let mut mesh = Mesh { edges, vertex_count: n, ..Mesh::empty(n) };
    mesh.lone = if n == 1 { Some(Place::new(0)) } else { None };
    mesh.number_vertices(|position| position);
    InOrder { mesh, points, indices, duplicates: sorted(duplicates) }
}

fn sorted(duplicates: Vec<(u32, u32)>) -> Vec<Duplicate> {
    let named = |(point, vertex): (u32, u32)| Duplicate {
        point: point as usize,
        vertex: VertexId::new(vertex as usize),
    };
    let mut duplicates: Vec<Duplicate> = duplicates.into_iter().map(named).collect();
    duplicates.sort_unstable_by_key(|duplicate| duplicate.point);
    duplicates
}

fn build(ordered: &[[f64; 2]], cuts: &[Cut], boxes: &[KeyBox]) -> (Vec<HalfEdge>, Counters) {
    let n = ordered.len();
    let mut builder = Builder {
        points: ordered,
        edges: vec![HalfEdge::UNUSED; 8 * n.saturating_sub(1)],
        leaving: vec![TriangleId::new(0); n],
        counters: Counters::default(),
    };
    if n > 0 {
        let grid = Grid::of(ordered.iter().copied().flatten());
        Tree { cuts, boxes, next_box: 0, grid }.build(&mut builder);
    }
    (builder.edges, builder.counters)
}

impl Mesh {
    /// Puts each vertex from its position in an order to its place, and remembers an edge of each.
    fn number_vertices(&mut self, place: impl Fn(Place) -> Place) {
        for (slot, records) in self.edges.chunks_exact_mut(4).enumerate() {
            for (k, record) in records[..3].iter_mut().enumerate() {
                let e = EdgeId::new(4 * slot + k);
                if record.origin.is_ghost() {
                    self.ghost_edge = e;
                } else {
                    record.origin = place(record.origin);
                    self.incident[record.origin.index()] = e;
                }
            }
        }
    }
}

/// The tree that the cuts are, walked without being built.
struct Tree<'a> {
    cuts: &'a [Cut],
    boxes: &'a [KeyBox],
    next_box: usize,
    grid: Option<Grid>,
}

impl Tree<'_> {
    /// Triangulates the points of the next box. Recursion follows the nesting of boxes, whose depth the
    /// exponent range bounds; inside a box the parts that wait for a neighbour are on a stack.
    fn build(&mut self, builder: &mut Builder) -> Part {
        let key_box = self.boxes[self.next_box];
        self.next_box += 1;
        let cell_filter = |depth| {
            let [width, height] = key_box.cell(depth);
            Filter::for_box(width, height, self.grid)
        };
        let filters: Vec<Filter> = (0..key_box.depths()).map(cell_filter).collect();
        let mut waiting: Vec<(Part, Cut)> = Vec::with_capacity(40);
        let mut at = key_box.start;
        loop {
            let limit = self.boxes.get(self.next_box).map_or(key_box.end, |b| b.start.min(key_box.end));
            let mut part = if at == limit {
                self.build(builder)
            } else {
                let count = self.leaf_size(at, limit, &key_box);
                let shallowest = self.cuts[at + 1..at + count].iter().min();
                let depth = shallowest.map_or(0, |&cut| key_box.split(cut).0);
                let leaf = if count > 1 { builder.leaf(at, count, &filters[depth]) } else { Leaf::Collinear };
                match leaf {
                    Leaf::Part(part) => part,
                    Leaf::Collinear => Part::single(at),
                }
            };
            at = part.end();
            let after = if at == key_box.end { Cut::OUTSIDE } else { self.cuts[at] };
            while let Some((left, cut)) = waiting.pop_if(|(_, cut)| *cut > after) {
                let (depth, by_x) = key_box.split(cut);
                part = builder.merge(&left, &part, by_x, &filters[depth]);
            }
            if at == key_box.end {
                return part;
            }
            waiting.push((part, after));
        }
    }

    /// The size of the largest subtree of at most four points that starts at a position.
    fn leaf_size(&self, at: usize, limit: usize, key_box: &KeyBox) -> usize {
        let outside = |i: usize| i == key_box.start || i == key_box.end;
        let cut = |i: usize| if outside(i) { Cut::OUTSIDE } else { self.cuts[i] };
        let whole = |&count: &usize| {
            let border = cut(at).max(cut(at + count));
            self.cuts[at + 1..at + count].iter().all(|&inner| inner > border)
        };
        let longest = (limit - at).min(4);
        (2..=longest).rev().find(whole).unwrap_or(1)
    }
}

impl Builder<'_> {
    /// The edge records of a triangle that is the ghost of hull edge u -> v.
    #[inline]
    pub(super) fn set_ghost_corners(&mut self, ghost: TriangleId, u: Place, v: Place) {
        let first = ghost.edge(0).index();
        let records = &mut self.edges[first..first + 3];
        records[0].origin = v;
        records[1].origin = u;
        records[2].origin = Place::GHOST;
    }

    #[inline]
    pub(super) fn link(&mut self, e: EdgeId, f: EdgeId) {
        self.edges[e.index()].twin = f;
        self.edges[f.index()].twin = e;
    }

    #[inline]
    pub(super) fn twin(&self, e: EdgeId) -> EdgeId {
        self.edges[e.index()].twin
    }

    #[inline]
    pub(super) fn tail(&self, e: EdgeId) -> Place {
        self.edges[e.index()].origin
    }

    /// The ghost of the hull edge after that of `ghost`, counter-clockwise.
    #[inline]
    pub(super) fn next_ghost(&self, ghost: TriangleId) -> TriangleId {
        self.twin(ghost.edge(2)).triangle()
    }

    /// The ghost of the hull edge before that of `ghost`.
    #[inline]
    pub(super) fn previous_ghost(&self, ghost: TriangleId) -> TriangleId {
        self.twin(ghost.edge(1)).triangle()
    }

    #[inline]
    pub(super) fn point(&self, v: Place) -> [f64; 2] {
        self.points[v.index()]
    }
}

impl Part {
    /// One point.
    fn single(at: usize) -> Self {
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
            part.west = if precedes(p(v), p(part.west)) { v } else { part.west };
            part.east = if precedes(p(part.east), p(v)) { v } else { part.east };
            part.south = if precedes(turned(p(v)), turned(p(part.south))) { v } else { part.south };
            part.north = if precedes(turned(p(part.north)), turned(p(v))) { v } else { part.north };
        }
        part
    }

    /// The positions and extreme corners of two parts, `a` to the left of `b` if cut by x, else below.
    pub(super) fn union(points: &[[f64; 2]], a: &Self, b: &Self, by_x: bool) -> Self {
        let p = |v: Place| points[v.index()];
        let mut part = Self { end: b.end, ..*a };
        if by_x {
            part.east = b.east;
            part.south = if precedes(turned(p(b.south)), turned(p(a.south))) { b.south } else { a.south };
            part.north = if precedes(turned(p(a.north)), turned(p(b.north))) { b.north } else { a.north };
        } else {
            part.north = b.north;
            part.west = if precedes(p(b.west), p(a.west)) { b.west } else { a.west };
            part.east = if precedes(p(a.east), p(b.east)) { b.east } else { a.east };
        }
        part
    }

    fn end(&self) -> usize {
        self.end
    }
}

/// Lexicographic order of points, for choosing corners.
#[inline]
fn precedes(p: [f64; 2], q: [f64; 2]) -> bool {
    lexicographic(p, q).is_lt()
}

/// A quarter turn: the order by (y, -x) is the lexicographic order of turned points.
#[inline]
fn turned([x, y]: [f64; 2]) -> [f64; 2] {
    [y, -x]
}
