//! Incremental construction by splits and flips inside a triangle of three dummy points at infinity.
//!
//! Source: Guibas, Knuth & Sharir, Algorithmica 1992, §3; Sheehy's lecture notes on randomized incremental Delaunay
//! triangulation. A new point splits the triangle that contains it into three, then edges across from it are
//! flipped while the triangle beyond is in conflict with it.
//!
//! # Dummy points
//!
//! The dummies have no coordinates; the predicates take limits. Dummy 0 is infinitely far to the right and
//! a trace below, dummy 1 infinitely far up and a trace to the right, dummy 2 infinitely far to the left and a
//! trace below, and each is infinitely farther away than the one before. So
//!
//! - the side of a line through two points on which a dummy lies is decided by comparing coordinates;
//! - a circle through two points and a dummy is the half-plane on the dummy's side, with the inside of the
//!   segment between the points: the rule of ghost triangles;
//! - a circle through one point and two dummies is the half-plane bounded by the line from the point to the
//!   nearer dummy, on the side of the farther one.
//!
//! A point on an edge makes one flat triangle, which the first flip removes.
//!
//! Cost: O(1) expected flips an insertion in random order; where to insert is for others to say.

use delone_predicates::{Sign, in_circle, orient2d, strictly_between};

use super::conflict_lists::Branch;
use super::history::{Fork, Observer};
use crate::ids::{EdgeId, Place, TriangleId};
use crate::locate::delaunay_tree::Simplices;
use crate::mesh::Mesh2;
use crate::plane::layer::Layer;
use crate::tally::Tally;

/// The number of dummies; the place of point i is i + DUMMIES.
pub(super) const DUMMIES: usize = 3;

/// Triangles, present ones and, if the observer keeps them, past ones.
#[derive(Clone, Debug)]
pub(super) struct Flips {
    /// The triangles in front of that of the dummies, which closes them from behind. The twins of past triangles mean
    /// nothing.
    pub(super) mesh: Mesh2,
    /// The points, after a stand-in for each dummy.
    pub(super) points: Vec<[f64; 2]>,
    /// Edges across from the new point that are to be tested.
    pending: Vec<EdgeId>,
}

/// The triangle of the three dummies behind all others.
fn back() -> TriangleId {
    TriangleId::new(1)
}

fn is_dummy(p: Place) -> bool {
    p.index() < DUMMIES
}

impl Flips {
    /// The triangle of the dummies.
    pub(super) fn new() -> Self {
        Self { mesh: Mesh2::pillow(), points: vec![[0.0; 2]; DUMMIES], pending: Vec::new() }
    }

    /// The number of triangles, past ones and those at the dummies included.
    pub(super) fn count(&self) -> usize {
        self.mesh.slot_count() - 1
    }

    /// The memory of the history, in bytes.
    pub(super) fn bytes(&self) -> usize {
        self.mesh.bytes() + size_of_val(&*self.points)
    }

    pub(super) fn corners(&self, t: TriangleId) -> [Place; 3] {
        self.mesh.places(t)
    }

    fn point(&self, p: Place) -> [f64; 2] {
        self.points[p.index()]
    }

    /// On which side of the line from a to b a point is, a and b corners of the triangulation, not both dummies.
    pub(super) fn side(&self, a: Place, b: Place, q: [f64; 2]) -> Sign {
        match (is_dummy(a), is_dummy(b)) {
            (false, false) => orient2d(self.point(a), self.point(b), q),
            (true, false) => towards(self.point(b), q, a),
            (false, true) => towards(q, self.point(a), b),
            (true, true) => Sign::Positive, // the dummies are around everything, counter-clockwise
        }
    }

    /// Decides where the point may be a dummy too, and `a` is none.
    pub(super) fn turn(&self, a: Place, b: Place, c: Place) -> Sign {
        match (is_dummy(b), is_dummy(c)) {
            (_, false) => self.side(a, b, self.point(c)),
            (false, true) => towards(self.point(a), self.point(b), c),
            // They are around everything in their order.
            (true, true) if (b.index() + 1) % DUMMIES == c.index() => Sign::Positive,
            (true, true) => Sign::Negative,
        }
    }

    /// Whether the circle of a triangle with a finite corner contains a point.
    fn conflicts(&self, t: TriangleId, q: [f64; 2]) -> bool {
        let corners = self.corners(t);
        let from = |k: usize| [0, 1, 2].map(|i| corners[(k + i) % 3]);
        let dummies = corners.iter().filter(|p| is_dummy(**p)).count();
        match dummies {
            0 => in_circle(self.point(corners[0]), self.point(corners[1]), self.point(corners[2]), q)
                .is_positive(),
            1 => {
                let [_, u, v] = from(corners.iter().position(|p| is_dummy(*p)).unwrap_or(0));
                let (u, v) = (self.point(u), self.point(v));
                match orient2d(u, v, q) {
                    Sign::Positive => true,
                    Sign::Zero => strictly_between(u, v, q),
                    Sign::Negative => false,
                }
            }
            _ => {
                let [u, d, e] = from(corners.iter().position(|p| !is_dummy(*p)).unwrap_or(0));
                // The half-plane on the side of the farther dummy; u, d, e turn left.
                let beside_nearer = self.side(u, d.min(e), q);
                if d < e { beside_nearer.is_positive() } else { beside_nearer.is_negative() }
            }
        }
    }

    /// An edge of a layer with the same vertices, at the triangle that contains a point here: the present triangle `t`. Where a corner
    /// is a dummy it is on the hull. `places` are those of the points.
    ///
    /// The triangle is looked for around its corners, around all at once, so that this costs three times the smallest of their degrees.
    /// At most 12 n / d triangles have three corners of degrees above d, because at most 6 n / d vertices have.
    pub(super) fn hint<T: Tally>(
        &self,
        layer: &Layer,
        places: &[Place],
        t: TriangleId,
        q: [f64; 2],
        tally: &mut T,
    ) -> EdgeId {
        let finite = |p: &Place| !is_dummy(*p);
        let mut corners: Vec<Place> = self.corners(t).into_iter().filter(finite).collect();
        if let [u] = corners[..] {
            let mesh = &self.mesh;
            let first = [0, 1, 2].map(|k| t.edge(k)).into_iter().find(|&e| mesh.tail(e) == u);
            let beside = |turn: &dyn Fn(EdgeId) -> EdgeId| {
                let spokes = std::iter::successors(first, |&e| Some(turn(e)));
                spokes.take(DUMMIES + 1).map(|e| mesh.head(e)).find(finite)
            };
            // What is between dummies at a vertex of the hull is beyond one of the two edges there.
            corners.extend(beside(&|e| mesh.spin(e)));
            if corners.get(1).is_some_and(|&next| !self.side(u, next, q).is_negative()) {
                corners[1] = beside(&|e| mesh.twin(e).next()).unwrap_or(u);
            }
        }
        let place = |p: Place| places[p.index() - DUMMIES];
        layer.hint_at(&corners.into_iter().map(place).collect::<Vec<_>>(), tally)
    }

    /// The corner of a triangle that is at a point: the vertex of an equal point.
    pub(super) fn equal(&self, t: TriangleId, q: [f64; 2]) -> Option<Place> {
        self.corners(t).into_iter().find(|&p| !is_dummy(p) && self.point(p) == q)
    }

    /// Makes `p` a vertex. Its point is in or on the border of the present triangle `t`, and not a vertex.
    pub(super) fn insert<O: Observer<Self>, T: Tally>(
        &mut self,
        p: Place,
        t: TriangleId,
        observer: &mut O,
        tally: &mut T,
    ) {
        let border = [0, 1, 2].map(|k| (self.mesh.tail(t.edge(k)), self.mesh.twin(t.edge(k))));
        let new = [if O::KEEPS { self.allocate() } else { t }, self.allocate(), self.allocate()];
        self.mesh.incident.resize(self.points.len(), EdgeId::NONE);
        self.mesh.fill_star(p, &border, &new);
        tally.destroyed(1);
        tally.created(3);
        observer.split(self, t, new, tally);
        self.pending.extend(new.map(|t| t.edge(0)));
        let q = self.point(p);
        while let Some(e) = self.pending.pop() {
            let f = self.mesh.twin(e);
            if f.triangle() == back() {
                continue;
            }
            tally.in_circle();
            if self.conflicts(f.triangle(), q) {
                self.flip(e, f, observer, tally);
                tally.destroyed(2);
                tally.created(2);
            }
        }
    }

    /// Replaces the edge e = x -> y, across from the new point p, and its twin by p - z.
    ///
    /// ```text
    ///        p                    p
    ///      /   \                / | \
    ///     x --> y     =>       x  |  y
    ///      \   /                \ | /
    ///        z                    z
    /// ```
    fn flip<O: Observer<Self>, T: Tally>(&mut self, e: EdgeId, f: EdgeId, observer: &mut O, tally: &mut T) {
        let old = [e.triangle(), f.triangle()];
        let [left, right] = if O::KEEPS { [self.allocate(), self.allocate()] } else { old };
        self.mesh.flip_into(e, [left.edge(1), right.edge(2)]);
        observer.flip(self, old, [left, right], tally);
        self.pending.extend([left.edge(0), right.edge(0)]);
    }

    fn allocate(&mut self) -> TriangleId {
        self.mesh.new_triangle(TriangleId::new(0))
    }
}

/// On which side of the line from a to b a dummy is.
fn towards(a: [f64; 2], b: [f64; 2], dummy: Place) -> Sign {
    let sign = |x: f64, y: f64| Sign::of(&x, &y);
    let decided = |first: Sign, tie: Sign| if first.is_zero() { tie } else { first };
    match dummy.index() {
        0 => decided(sign(a[1], b[1]), sign(a[0], b[0])),
        1 => decided(sign(b[0], a[0]), sign(a[1], b[1])),
        _ => decided(sign(b[1], a[1]), sign(a[0], b[0])),
    }
}

impl Branch for Flips {
    fn numbered(&self, point: u32) -> [f64; 2] {
        self.points[DUMMIES + point as usize]
    }

    /// Each triangle of a split has the new point p last, and the corners a, b, c of the old one turn around it: the ray from p
    /// to b tells on which side of it to ask for another. What is on that ray is not left of it, so that it is right also where
    /// p is on the border, and one of the three flat. A flip made the edge z -> p, which decides.
    fn branch<T: Tally>(&self, fork: Fork, q: [f64; 2], tally: &mut T) -> TriangleId {
        let mut side = |a: Place, b: Place| {
            tally.orientation();
            self.side(a, b, q)
        };
        match fork {
            Fork::Split([a_b, b_c, c_a]) => {
                let [a, b, p] = self.corners(a_b);
                let c = self.mesh.tail(c_a.edge(0));
                if side(p, b).is_positive() {
                    if side(p, c).is_negative() { b_c } else { c_a }
                } else if side(p, a).is_negative() {
                    c_a
                } else {
                    a_b
                }
            }
            Fork::Flip([left, right]) => {
                let e = left.edge(1);
                if side(self.mesh.tail(e), self.mesh.head(e)).is_negative() { right } else { left }
            }
        }
    }
}
