//! Triangles that points are inserted into one by one, and which triangles came of it: what `Delaunay2` does not tell.
//!
//! Bowyer & Watson's insertion with the canonical in-circle test: the triangles in conflict with a point are a cavity, its star takes
//! their place. Fixed edges bound cavities, as those of a constrained triangulation do, so what comes out is the one canonical
//! (constrained) triangulation of the vertices so far. Every point is inside of the hull that there is at the beginning.
//!
//! Cost: the walk, and O(1) for each triangle of the cavity.

use delone_predicates::Filter;

/// Nothing there.
pub(super) const NONE: u32 = u32::MAX;

/// A triangle, counter-clockwise. Edge k is opposite to corner k, from corner k + 1 to corner k + 2.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    pub(super) corners: [u32; 3],
    /// The edges on the other sides: three times the triangle and the edge's number there.
    pub(super) across: [u32; 3],
    /// Which edges are fixed, a bit each.
    pub(super) fixed: u8,
}

/// See the module.
#[derive(Debug)]
pub(super) struct Mesh {
    pub(super) triangles: Vec<Triangle>,
    /// The coordinates of the vertices.
    pub(super) points: Vec<[f64; 2]>,
    pub(super) filter: Filter,
    /// When a triangle was last put into a cavity, by the number of the insertion.
    pub(super) stamps: Vec<u32>,
    now: u32,
    cavity: Vec<u32>,
    /// Edges around the cavity: from, to, what is across, whether it is fixed.
    border: Vec<(u32, u32, u32, bool)>,
    /// For each vertex the new triangle whose border edge begins there, and when.
    pub(super) begins: Vec<(u32, u32)>,
    /// The triangles of the last insertion.
    pub(super) star: Vec<u32>,
}

/// The place where a point falls.
enum Spot {
    Inside(u32),
    /// On this edge, not at its ends.
    Edge(u32),
    /// On a vertex.
    Vertex,
    /// Outside of all triangles.
    Outside,
}

pub(super) fn next(k: usize) -> usize {
    (k + 1) % 3
}

impl Mesh {
    /// Triangles by their corners, with those across each edge and whether that is fixed.
    pub(super) fn new(
        points: Vec<[f64; 2]>,
        triangles: &[([u32; 3], [u32; 3], [bool; 3])],
        filter: Filter,
    ) -> Self {
        let back = |t: u32, from: u32, to: u32| {
            let corners = triangles[t as usize].0;
            (0..3)
                .find(|&k| corners[next(k)] == to && corners[next(k + 1)] == from)
                .map_or(NONE, |k| 3 * t + k as u32)
        };
        let made = triangles.iter().map(|&(corners, across, fixed)| Triangle {
            corners,
            across: [0, 1, 2].map(|k| match across[k] {
                NONE => NONE,
                t => back(t, corners[next(k)], corners[next(k + 1)]),
            }),
            fixed: (0..3).filter(|&k| fixed[k]).fold(0, |bits, k| bits | 1 << k),
        });
        let (triangles, vertices): (Vec<_>, _) = (made.collect(), points.len());
        Self {
            stamps: vec![0; triangles.len()],
            begins: vec![(0, 0); vertices],
            triangles,
            points,
            filter,
            now: 0,
            cavity: Vec::new(),
            border: Vec::new(),
            star: Vec::new(),
        }
    }

    pub(super) fn point(&self, v: u32) -> [f64; 2] {
        self.points[v as usize]
    }

    fn edge(&self, e: u32) -> (&Triangle, usize) {
        (&self.triangles[(e / 3) as usize], (e % 3) as usize)
    }

    /// The ends of an edge, its triangle on the left.
    fn ends(&self, e: u32) -> [u32; 2] {
        let (t, k) = self.edge(e);
        [t.corners[next(k)], t.corners[next(k + 1)]]
    }

    /// Walks from a triangle to where a point is. Exact.
    fn spot(&self, from: u32, q: [f64; 2]) -> Spot {
        let mut t = from;
        // Walks in constrained triangulations may turn in circles; they begin where the point is, up to rounding.
        'walk: for step in 0..4 * self.triangles.len() {
            let mut on = None;
            for j in 0..3 {
                let e = 3 * t + ((j + step) % 3) as u32;
                let [v, w] = self.ends(e).map(|v| self.point(v));
                let side = self.filter.orient2d(v, w, q);
                if side.is_negative() {
                    let (triangle, k) = self.edge(e);
                    match triangle.across[k] {
                        NONE => return Spot::Outside,
                        other => t = other / 3,
                    }
                    continue 'walk;
                }
                if side.is_zero() {
                    on = Some(e);
                }
            }
            if self.triangles[t as usize].corners.iter().any(|&v| self.point(v) == q) {
                return Spot::Vertex;
            }
            return on.map_or(Spot::Inside(t), Spot::Edge);
        }
        Spot::Outside
    }

    /// The triangles that a point is in or on the border of, from another one; none outside of all, and for a vertex.
    pub(super) fn around(&self, from: u32, q: [f64; 2]) -> [Option<u32>; 2] {
        match self.spot(from, q) {
            Spot::Inside(t) => [Some(t), None],
            Spot::Edge(e) => {
                let (triangle, k) = self.edge(e);
                let beyond = triangle.across[k];
                [Some(e / 3), (beyond != NONE).then_some(beyond / 3)]
            }
            Spot::Vertex | Spot::Outside => [None; 2],
        }
    }

    /// Makes a point a vertex, from a triangle that it is in; the new triangles are `star`. Says whether it is one: a point that is a
    /// vertex already is not, nor one that is outside.
    pub(super) fn insert(&mut self, q: [f64; 2], from: u32) -> bool {
        let (first, on) = match self.spot(from, q) {
            Spot::Vertex | Spot::Outside => return false,
            Spot::Inside(t) => (t, NONE),
            Spot::Edge(e) => (e / 3, e),
        };
        self.now += 1;
        let (now, v) = (self.now, self.points.len() as u32);
        self.points.push(q);
        self.begins.push((0, 0));
        self.cavity.clear();
        self.border.clear();
        self.cavity.push(first);
        self.stamps[first as usize] = now;
        let mut is_on_fixed = false;
        let mut ends = [NONE; 2];
        if on != NONE {
            let (triangle, k) = self.edge(on);
            is_on_fixed = triangle.fixed >> k & 1 == 1;
            let beyond = triangle.across[k];
            ends = self.ends(on);
            if beyond != NONE {
                self.cavity.push(beyond / 3);
                self.stamps[(beyond / 3) as usize] = now;
            }
        }
        let mut i = 0;
        while let Some(&t) = self.cavity.get(i) {
            i += 1;
            let triangle = self.triangles[t as usize];
            for k in 0..3 {
                let (beyond, is_fixed) = (triangle.across[k], triangle.fixed >> k & 1 == 1);
                let (from, to) = (triangle.corners[next(k)], triangle.corners[next(k + 1)]);
                if 3 * t + k as u32 == on || beyond == on && on != NONE {
                    continue;
                }
                if beyond != NONE {
                    let other = beyond / 3;
                    if self.stamps[other as usize] == now {
                        continue;
                    }
                    if !is_fixed {
                        let (neighbor, side) = self.edge(beyond);
                        let apex = self.point(neighbor.corners[side]);
                        let [from, to] = [from, to].map(|v| self.point(v));
                        if self.filter.in_circle(to, from, apex, q).is_positive() {
                            self.stamps[other as usize] = now;
                            self.cavity.push(other);
                            continue;
                        }
                    }
                }
                self.border.push((from, to, beyond, is_fixed));
            }
        }
        self.fill(v, is_on_fixed.then_some(ends));
        true
    }

    /// Fills the cavity with the star of a vertex.
    fn fill(&mut self, v: u32, split: Option<[u32; 2]>) {
        self.star.clear();
        let now = self.now;
        for (i, &(from, to, beyond, is_fixed)) in self.border.iter().enumerate() {
            let t = self.cavity.get(i).copied().unwrap_or(self.triangles.len() as u32);
            let splits = |w: u32| split.is_some_and(|ends| ends.contains(&w));
            let fixed = u8::from(is_fixed) | u8::from(splits(to)) << 1 | u8::from(splits(from)) << 2;
            let triangle = Triangle { corners: [v, from, to], across: [beyond, NONE, NONE], fixed };
            if t as usize == self.triangles.len() {
                self.triangles.push(triangle);
                self.stamps.push(0);
            } else {
                self.triangles[t as usize] = triangle;
                self.stamps[t as usize] = 0;
            }
            if beyond != NONE {
                self.triangles[(beyond / 3) as usize].across[(beyond % 3) as usize] = 3 * t;
            }
            self.begins[from as usize] = (t, now);
            self.star.push(t);
        }
        for i in 0..self.star.len() {
            let t = self.star[i];
            let to = self.triangles[t as usize].corners[2];
            let (other, when) = self.begins[to as usize];
            if when == now {
                self.triangles[t as usize].across[1] = 3 * other + 2;
                self.triangles[other as usize].across[2] = 3 * t + 1;
            }
        }
    }
}
