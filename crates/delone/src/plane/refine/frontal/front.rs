//! Free vertices, row by row from constraints inwards.
//!
//! A triangle is large if its circle is; an edge of it is active if there is none, or none that is large, across. Behind the first active
//! edge a vertex is put on its bisector, so far that both new edges are as long as sizes say. Edges of the border come first, then those
//! whose length is most nearly their size, earlier rows before later ones: so one lattice grows, and fronts that are stretched wait.
//!
//! A place is refused if a vertex or a constraint is too near; a triangle without a place is done.
//!
//! Cost: O(log n) for each vertex.

use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap};

use delone_predicates::lexicographic;

use super::super::free::Met;
use super::super::mesher::Known;
use super::super::shape::{Shape, squared, squared_height};
use super::{Frontal, distance};
use crate::error::Error;
use crate::ids::{EdgeId, Place, TriangleId};
use crate::plane::layer::insert::Spot;

// Origin of the numbers below: the twenty geometries of `compare/with_gmsh.py`, medians of quality and of its 5 percent.

/// A triangle is large from so many times the circumradius of an equilateral triangle of its size on. From 1.18 to 1.27 all is alike.
const LARGE_RADIUS: f64 = 1.22;
/// No vertex is nearer to another one than this part of a size. With 0.75 there are 4 percent more triangles, 5 percent of them below 0.947
/// instead of 0.953; with 0.84, 2 percent fewer, and the mean falls from 0.989 to 0.988.
const LEAST_DISTANCE: f64 = 0.8;
/// No vertex is nearer to a constraint than this part of a size. From 0.5 to 0.62 all is alike; below, triangles at borders are flat.
const LEAST_HEIGHT: f64 = 0.55;
/// The size counts there as so many times the length of the constraint at most.
const HEIGHT_OF_LENGTH: f64 = 1.3;
/// A new edge is from so many to so many times as long as the one that it starts at: else it would be flat, or sharp.
const LEG_OF_BASE: [f64; 2] = [0.75, 1.5];
/// The size at a place that depends on it is found in so many steps: each one is off by a fifth of the step before.
const PLACE_STEPS: usize = 3;
/// A triangle that no place behind an edge mends gets a vertex inside if its circumradius is more than so many sizes: twice what is large.
const MUCH_TOO_LARGE: f64 = 1.4;
/// After so many vertices it is asked whether to go on.
const PAUSE: usize = 256;

/// An active edge.
struct Task {
    /// How far its length is from its size, and 0 on the border; then its row.
    order: [u64; 2],
    edge: EdgeId,
    corners: [Place; 3],
    /// Its middle, then its corners.
    points: [[f64; 2]; 4],
}

impl Task {
    fn order(&self, other: &Self) -> Ordering {
        let ties = self.points.into_iter().zip(other.points).map(|(p, q)| lexicographic(p, q));
        ties.fold(self.order.cmp(&other.order), Ordering::then)
    }
}

impl PartialEq for Task {
    fn eq(&self, other: &Self) -> bool {
        self.order(other).is_eq()
    }
}

impl Eq for Task {}

impl PartialOrd for Task {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Task {
    /// The first task is the greatest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.order(self)
    }
}

/// The state of the front.
#[derive(Default)]
struct Front {
    tasks: BinaryHeap<Task>,
    /// By place: how many rows there are between a vertex and the border.
    rows: Vec<u32>,
    /// Triangles that are done, by their places in order.
    done: BTreeSet<[Place; 3]>,
}

impl Front {
    fn row(&self, p: Place) -> u32 {
        self.rows.get(p.index()).copied().unwrap_or(0)
    }
}

impl Frontal<'_, '_> {
    /// Fills the mesh until no triangle is large.
    pub(super) fn fill(&mut self) -> Result<(), Error> {
        let mut front = Front::default();
        for t in self.mesher.layer.mesh.triangles().collect::<Vec<_>>() {
            self.note(&mut front, t);
        }
        let mut steps = 0_usize;
        while let Some(task) = front.tasks.pop() {
            let mesh = &self.mesher.layer.mesh;
            let (e, t) = (task.edge, task.edge.triangle());
            let is_there = [mesh.tail(e), mesh.head(e), mesh.tip(e)] == task.corners;
            if !is_there || !self.is_large(&front, t) {
                continue;
            }
            if self.mesher.rules.is_enough(self.mesher.count, self.mesher.for_sizes, true) {
                break;
            }
            steps += 1;
            if steps.is_multiple_of(PAUSE) {
                self.mesher.rules.go_on(self.mesher.count)?;
            }
            let placed = self.place_behind(&mut front, e)
                || [e.next(), e.previous()]
                    .into_iter()
                    .any(|other| self.is_active(&front, other) && self.place_behind(&mut front, other))
                || self.place_inside(&mut front, t);
            if !placed {
                front.done.insert(sorted(task.corners));
                for k in 0..3 {
                    self.note(&mut front, self.mesher.layer.mesh.twin(t.edge(k)).triangle());
                }
            }
        }
        self.mesher.rules.go_on(self.mesher.count)
    }

    fn is_large(&self, front: &Front, t: TriangleId) -> bool {
        let mesh = &self.mesher.layer.mesh;
        if !self.mesher.is_inside(t) {
            return false;
        }
        let Some(shape) = Shape::of(self.mesher.layer, t) else { return false };
        let e = shape.shortest;
        let corners = [mesh.tail(e), mesh.head(e), mesh.tip(e)];
        let radius = shape.radius();
        let mean = corners.into_iter().map(|p| self.sizes.at(p)).sum::<f64>() / 3.0;
        // Inside sizes may be larger than at the corners, at most by growth.
        let size = (mean + 0.5 * self.sizes.slope * radius).min(self.mesher.rules.longest_length());
        radius > LARGE_RADIUS * size / 3.0_f64.sqrt() && !front.done.contains(&sorted(corners))
    }

    /// Whether there is no large triangle across an edge of one.
    fn is_active(&self, front: &Front, e: EdgeId) -> bool {
        let mesh = &self.mesher.layer.mesh;
        mesh.is_fixed(e) || !self.is_large(front, mesh.twin(e).triangle())
    }

    /// Notes the active edges of a triangle if it is large.
    fn note(&self, front: &mut Front, t: TriangleId) {
        if !self.is_large(front, t) {
            return;
        }
        for e in [0, 1, 2].map(|k| t.edge(k)) {
            if self.is_active(front, e) {
                let task = self.task(front, e);
                front.tasks.push(task);
            }
        }
    }

    fn task(&self, front: &Front, e: EdgeId) -> Task {
        let mesh = &self.mesher.layer.mesh;
        let corners = [mesh.tail(e), mesh.head(e), mesh.tip(e)];
        let [a, b, c] = corners.map(|p| self.point(p));
        let size = 0.5 * (self.sizes.at(corners[0]) + self.sizes.at(corners[1]));
        let row = front.row(corners[0]).max(front.row(corners[1]));
        let off = classes_off(distance(a, b), size);
        let order = if row == 0 { [0, off] } else { [1 + off, u64::from(row)] };
        let middle = [0, 1].map(|k| 0.5 * a[k] + 0.5 * b[k]);
        Task { order, edge: e, corners, points: [middle, a, b, c] }
    }

    /// Puts a vertex behind an edge, into its triangle's circle. Returns whether there is a place for it.
    fn place_behind(&mut self, front: &mut Front, e: EdgeId) -> bool {
        let mesh = &self.mesher.layer.mesh;
        let ends = [mesh.tail(e), mesh.head(e)];
        let [a, b] = ends.map(|p| self.point(p));
        let c = self.point(mesh.tip(e));
        let length = distance(a, b);
        let (u, v) = ([a[0] - c[0], a[1] - c[1]], [b[0] - c[0], b[1] - c[1]]);
        // The circumcenter is so far from the edge.
        let far = 0.5 * length * (u[0] * v[0] + u[1] * v[1]) / (u[0] * v[1] - u[1] * v[0]);
        if far.is_nan() || far <= 0.0 {
            return false;
        }
        let domain = mesh.domain(e.triangle());
        let own = self.mesher.rules.length_in(domain);
        let middle = [0, 1].map(|k| 0.5 * a[k] + 0.5 * b[k]);
        let normal = [(a[1] - b[1]) / length, (b[0] - a[0]) / length];
        let (mut q, mut size) = (middle, 0.5 * (self.sizes.at(ends[0]) + self.sizes.at(ends[1])));
        for _ in 0..PLACE_STEPS {
            let leg = size.clamp(LEG_OF_BASE[0] * length, LEG_OF_BASE[1] * length);
            let up = (leg * leg - 0.25 * length * length).max(0.0).sqrt().min(far);
            q = [0, 1].map(|k| middle[k] + up * normal[k]);
            let grown = ends.map(|p| self.sizes.from(p, distance(q, self.point(p))));
            size = self.mesher.rules.length_at(q).min(own).min(grown[0]).min(grown[1]);
        }
        let Met::Triangle(t) = self.mesher.walk(e, q) else { return false };
        let row = 1 + front.row(ends[0]).max(front.row(ends[1]));
        self.insert(e.triangle(), t, q, size).is_some_and(|made| self.note_around(front, made, row))
    }

    /// Puts a vertex into the middle of a triangle that is much too large: beside a constraint that is kept whole all places behind edges
    /// may be on it. Returns whether there is a place.
    fn place_inside(&mut self, front: &mut Front, t: TriangleId) -> bool {
        let Some(shape) = Shape::of(self.mesher.layer, t) else { return false };
        let q = shape.centroid();
        let own = self.mesher.rules.length_in(self.mesher.layer.mesh.domain(t));
        let size = self.mesher.rules.length_at(q).min(own);
        shape.radius() > MUCH_TOO_LARGE * size
            && self.mesher.is_strictly_in(t, q)
            && self.insert(t, t, q, size).is_some_and(|made| self.note_around(front, made, 1))
    }

    /// Notes a new vertex with its size, and the active edges around it.
    fn note_around(&mut self, front: &mut Front, (v, size): (Place, f64), row: u32) -> bool {
        self.sizes.set(v, size);
        if front.rows.len() <= v.index() {
            front.rows.resize(v.index() + 1, 0);
        }
        front.rows[v.index()] = row;
        let star: Vec<EdgeId> = self.mesher.layer.mesh.spokes(v).collect();
        for e in star {
            self.note(front, e.triangle());
            self.note(front, self.mesher.layer.mesh.twin(e.next()).triangle());
        }
        true
    }

    /// Makes a point in triangle `t` a vertex that mends a large triangle, unless it is too near to others. Gives it with its size.
    fn insert(&mut self, large: TriangleId, t: TriangleId, q: [f64; 2], size: f64) -> Option<(Place, f64)> {
        self.mesher.dig(q, t);
        let mesh = &self.mesher.layer.mesh;
        let border = self.mesher.layer.cavity.border();
        let known = border.iter().map(|edge| edge.0).filter(|v| !v.is_ghost());
        let allowed = known.map(|v| self.sizes.from(v, distance(q, self.point(v))));
        let size = allowed.fold(size, f64::min);
        let (nearest, square) = self.mesher.nearest(q);
        let is_near = |&(_, e): &(Place, EdgeId)| mesh.is_fixed(e) && self.is_near_constraint(e, q, size);
        if square < (LEAST_DISTANCE * size) * (LEAST_DISTANCE * size)
            || square < self.mesher.rules.squared_least
            || !mesh.is_marked(large)
            || border.iter().any(is_near)
        {
            self.mesher.abandon();
            return None;
        }
        let v = self.mesher.layer.place_for(Spot::Triangle(t), q);
        self.mesher.fill(v);
        let scale = self.mesher.known[nearest.index()].scale.min(square.sqrt());
        self.mesher.note_vertex(v, Known::free(scale));
        self.mesher.for_sizes += 1;
        Some((v, size))
    }

    fn is_near_constraint(&self, e: EdgeId, q: [f64; 2], size: f64) -> bool {
        let mesh = &self.mesher.layer.mesh;
        let [a, b] = [mesh.tail(e), mesh.head(e)].map(|p| self.point(p));
        let square = squared(a, b);
        let along = (b[0] - a[0]) * (q[0] - a[0]) + (b[1] - a[1]) * (q[1] - a[1]);
        let least = LEAST_HEIGHT * size.min(HEIGHT_OF_LENGTH * square.sqrt());
        (0.0..=square).contains(&along) && squared_height(q, [a, b]) < least * least
    }
}

/// How far a length is from a size: classes of a sixteenth of a doubling or halving, by the bits of the ratio, so that no logarithm decides.
fn classes_off(length: f64, size: f64) -> u64 {
    /// Bits of the mantissa below the four highest.
    const CLASS_SHIFT: u32 = 48;
    let ratio = (length / size).max(size / length).max(1.0);
    (ratio.to_bits() - 1.0_f64.to_bits()) >> CLASS_SHIFT
}

fn sorted(mut corners: [Place; 3]) -> [Place; 3] {
    corners.sort_unstable();
    corners
}
