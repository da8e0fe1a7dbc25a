//! The convex hull in space.
//!
//! Source: Barber, Dobkin & Huhdanpaa, "The quickhull algorithm for convex hulls", TOMS 1996: each point that is
//! outside waits at one facet that it sees; the furthest of a facet's points is joined to the horizon of what it
//! sees. Which point comes next is a matter of rounded distances and of speed alone; what it sees is decided
//! exactly, and strictly. Points on the plane of a facet do not see it, so a flat face may be cut anyhow and
//! may hold points that are no corners; in the end its triangles are merged, and its corners kept.
//!
//! Cost: O(n log n) in practice; inner points are dropped as soon as no facet is left that they see.

use std::cmp::Ordering;

use delone_predicates::{Plane, orient2d, orient3d};

use super::planar;
use crate::error::Error;

/// No point, no facet.
const NONE: u32 = u32::MAX;

/// What points in space span.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Span {
    /// No point.
    Empty,
    /// One point.
    Point,
    /// A line.
    Line,
    /// A plane.
    Plane,
    /// Space.
    Space,
}

/// The convex hull of points in space.
///
/// ```
/// use delone::hull::spatial::{Hull3, Span};
///
/// let cube: Vec<[f64; 3]> = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from)).collect();
/// let hull = Hull3::of(&cube)?;
/// assert_eq!(hull.span(), Span::Space);
/// assert_eq!(hull.corners().len(), 8);
/// assert_eq!((hull.faces().len(), hull.facets().count()), (6, 12));
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hull3 {
    span: Span,
    corners: Vec<usize>,
    faces: Vec<Vec<usize>>,
}

impl Hull3 {
    /// The hull. Of equal points the first stands for all.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate, [`Error::TooManyPoints`] is for more than
    /// [`crate::MAX_POINTS`].
    pub fn of(points: &[[f64; 3]]) -> Result<Self, Error> {
        if points.len() > crate::MAX_POINTS {
            return Err(Error::TooManyPoints { count: points.len() });
        }
        let flat = points.as_flattened();
        if let Some(at) = flat.iter().position(|x| !x.is_finite()) {
            return Err(Error::NotFinite { index: at / 3, axis: at % 3, value: flat[at] });
        }
        let faces = match Start::of(points) {
            Start::Lower(span, corners) => return Ok(Self { span, corners, faces: Vec::new() }),
            Start::Flat(corners) => {
                return Ok(Self { span: Span::Plane, faces: vec![corners.clone()], corners });
            }
            Start::Tetrahedron(_) => solid(points),
        };
        let mut corners: Vec<usize> = faces.iter().flatten().copied().collect();
        corners.sort_unstable();
        corners.dedup();
        Ok(Self { span: Span::Space, corners, faces })
    }

    /// What the points span: a hull of less than space has no facets.
    pub fn span(&self) -> Span {
        self.span
    }

    /// The extreme points: by increasing index; of a flat set in order around it, of one on a line from end to end.
    pub fn corners(&self) -> &[usize] {
        &self.corners
    }

    /// The flat faces as polygons, counter-clockwise seen from outside, each from its lexicographically smallest
    /// corner; sorted. The one face of a flat set may be seen from either side.
    pub fn faces(&self) -> &[Vec<usize>] {
        &self.faces
    }

    /// The faces cut into triangles, counter-clockwise seen from outside. None for less than space.
    pub fn facets(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        let solid = self.faces.iter().filter(|_| self.span == Span::Space);
        solid.flat_map(|face| face[1..].windows(2).map(|side| [face[0], side[0], side[1]]))
    }

    /// The facets that are seen from far below: the lower hull. `points` are those of the hull.
    pub fn lower<'a>(&'a self, points: &'a [[f64; 3]]) -> impl Iterator<Item = [usize; 3]> + 'a {
        self.facets().filter(|&facet| turn(points, facet, 2).is_lt())
    }

    /// The facets that are seen from far above: the upper hull. `points` are those of the hull.
    pub fn upper<'a>(&'a self, points: &'a [[f64; 3]]) -> impl Iterator<Item = [usize; 3]> + 'a {
        self.facets().filter(|&facet| turn(points, facet, 2).is_gt())
    }
}

/// The faces of points that span space. They are sorted along a curve first: neighbours in space are neighbours in
/// memory then, which halves the time for a million corners.
fn solid(points: &[[f64; 3]]) -> Vec<Vec<usize>> {
    let mut order: Vec<(u32, u32)> = morton_keys(points).zip(0..).collect();
    order.sort_unstable();
    let sorted: Vec<[f64; 3]> = order.iter().map(|&(_, i)| points[i as usize]).collect();
    let Start::Tetrahedron(corners) = Start::of(&sorted) else { return Vec::new() };
    let mut faces = Builder::new(&sorted, corners).finish();
    faces.iter_mut().flatten().for_each(|i| *i = order[*i].1 as usize);
    faces.sort_unstable();
    faces
}

/// The interleaved bits of the cells that points are in, 1024 along each axis.
fn morton_keys(points: &[[f64; 3]]) -> impl Iterator<Item = u32> + '_ {
    let range = [0, 1, 2].map(|k| {
        let of = points.iter().map(|p| p[k]);
        (of.clone().fold(f64::MAX, f64::min), of.fold(f64::MIN, f64::max))
    });
    let spread = |x: u32| {
        let x = (x | x << 16) & 0x0300_00ff;
        let x = (x | x << 8) & 0x0300_f00f;
        let x = (x | x << 4) & 0x030c_30c3;
        (x | x << 2) & 0x0924_9249
    };
    points.iter().map(move |p| {
        let cell = |k: usize| {
            let (low, high) = range[k];
            let share = (p[k] / 2.0 - low / 2.0) / (high / 2.0 - low / 2.0);
            spread((share * 1024.0).clamp(0.0, 1023.0) as u32)
        };
        cell(0) << 2 | cell(1) << 1 | cell(2)
    })
}

/// The orientation of three points seen along an axis.
fn turn(points: &[[f64; 3]], corners: [usize; 3], axis: usize) -> Ordering {
    let [a, b, c] = corners.map(|i| without(points[i], axis));
    let sign = orient2d(a, b, c);
    if sign.is_positive() {
        Ordering::Greater
    } else if sign.is_negative() {
        Ordering::Less
    } else {
        Ordering::Equal
    }
}

/// The coordinates but one, in cyclic order.
fn without(p: [f64; 3], axis: usize) -> [f64; 2] {
    [p[(axis + 1) % 3], p[(axis + 2) % 3]]
}

fn are_collinear(points: &[[f64; 3]], corners: [usize; 3]) -> bool {
    (0..3).all(|axis| turn(points, corners, axis).is_eq())
}

fn lexicographic(a: [f64; 3], b: [f64; 3]) -> Ordering {
    let different = a.iter().zip(&b).find(|(x, y)| x != y);
    different.map_or(Ordering::Equal, |(x, y)| x.total_cmp(y))
}

fn cross(u: [f64; 3], v: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3])
}

fn square(u: [f64; 3]) -> f64 {
    u.iter().map(|x| x * x).sum()
}

/// Where to begin.
enum Start {
    Lower(Span, Vec<usize>),
    Flat(Vec<usize>),
    /// Four corners, the last one on the positive side of the others.
    Tetrahedron([usize; 4]),
}

impl Start {
    fn of(points: &[[f64; 3]]) -> Self {
        let order = |i: &usize, j: &usize| lexicographic(points[*i], points[*j]).then(i.cmp(j));
        let Some(a) = (0..points.len()).min_by(order) else { return Self::Lower(Span::Empty, Vec::new()) };
        let last = |i: &usize, j: &usize| lexicographic(points[*i], points[*j]).then(j.cmp(i));
        let b = (0..points.len()).max_by(last).unwrap_or(a);
        if points[a] == points[b] {
            return Self::Lower(Span::Point, vec![a]);
        }
        // Far from each other, as far as rounding tells; if it tells wrong, any that will do.
        let from = |i: usize, j: usize| [0, 1, 2].map(|k| points[j][k] / 2.0 - points[i][k] / 2.0);
        let along = from(a, b);
        let off_line = |i: usize| square(cross(along, from(a, i)));
        let furthest = |height: &dyn Fn(usize) -> f64| {
            (0..points.len()).max_by(|&i, &j| height(i).total_cmp(&height(j)).then(j.cmp(&i)))
        };
        let any = |holds: &dyn Fn(&usize) -> bool, best: Option<usize>| {
            best.filter(holds).or_else(|| (0..points.len()).find(holds))
        };
        let Some(c) = any(&|&c| !are_collinear(points, [a, b, c]), furthest(&off_line)) else {
            return Self::Lower(Span::Line, vec![a, b]);
        };
        let side = |d: usize| orient3d(points[a], points[b], points[c], points[d]);
        let normal = cross(along, from(a, c));
        let off_plane = |i: usize| (0..3).map(|k| normal[k] * from(a, i)[k]).sum::<f64>().abs();
        match any(&|&d| !side(d).is_zero(), furthest(&off_plane)) {
            Some(d) if side(d).is_positive() => Self::Tetrahedron([a, b, c, d]),
            Some(d) => Self::Tetrahedron([b, a, c, d]),
            None => {
                // Seen along an axis in which it does not vanish, a flat set keeps its corners.
                let axis = (0..3).find(|&axis| !turn(points, [a, b, c], axis).is_eq()).unwrap_or(2);
                let seen: Vec<[f64; 2]> = points.iter().map(|&p| without(p, axis)).collect();
                Self::Flat(planar::corners(&seen))
            }
        }
    }
}

/// A triangle of the hull so far.
#[derive(Clone, Copy, Debug)]
struct Facet {
    /// Counter-clockwise seen from outside; none where the facet is gone.
    corners: [u32; 3],
    /// The facets across the edges that leave the corners.
    across: [u32; 3],
    /// The first of the points that wait here.
    waiting: u32,
    /// The number of the point that last asked whether it sees this.
    asked: u32,
    seen: bool,
    plane: Plane,
}

struct Builder<'a> {
    points: &'a [[f64; 3]],
    facets: Vec<Facet>,
    free: Vec<u32>,
    /// For each point the one that waits after it.
    next: Vec<u32>,
    /// For each corner of a horizon the new facet whose first corner it is.
    starting: Vec<u32>,
    /// Facets where points may wait.
    pending: Vec<u32>,
    /// The size of the box around the points.
    extent: [f64; 3],
}

impl<'a> Builder<'a> {
    fn new(points: &'a [[f64; 3]], [a, b, c, d]: [usize; 4]) -> Self {
        let mut builder = Self {
            points,
            facets: Vec::new(),
            free: Vec::new(),
            next: vec![NONE; points.len()],
            starting: vec![NONE; points.len()],
            pending: Vec::new(),
            extent: [0, 1, 2].map(|k| {
                let of = points.iter().map(|p| p[k]);
                of.clone().fold(f64::MIN, f64::max) - of.fold(f64::MAX, f64::min)
            }),
        };
        let [a, b, c, d] = [a, b, c, d].map(|i| i as u32);
        // The base from below, and the three sides.
        let corners = [[a, c, b], [a, b, d], [b, c, d], [c, a, d]];
        let across = [[3, 2, 1], [0, 2, 3], [0, 3, 1], [0, 1, 2]];
        for (corners, across) in corners.into_iter().zip(across) {
            let facet = builder.facet(corners, across);
            builder.facets.push(facet);
        }
        for p in 0..points.len() as u32 {
            builder.wait(p, &[0, 1, 2, 3]);
        }
        builder.pending.extend(0..4);
        builder
    }

    fn facet(&self, corners: [u32; 3], across: [u32; 3]) -> Facet {
        let [a, b, c] = corners.map(|i| self.points[i as usize]);
        let plane = Plane::new(a, b, c, self.extent);
        Facet { corners, across, waiting: NONE, asked: NONE, seen: false, plane }
    }

    /// Whether a point is strictly outside of a facet.
    fn sees(&self, p: u32, facet: u32) -> bool {
        let facet = &self.facets[facet as usize];
        let q = self.points[p as usize];
        let exact = || {
            let [a, b, c] = facet.corners.map(|i| self.points[i as usize]);
            orient3d(a, b, c, q)
        };
        facet.plane.side(q).unwrap_or_else(exact).is_positive()
    }

    /// Lets a point wait at the first of some facets that it sees, if any.
    fn wait(&mut self, p: u32, facets: &[u32]) {
        if let Some(&f) = facets.iter().find(|&&f| self.sees(p, f)) {
            self.next[p as usize] = std::mem::replace(&mut self.facets[f as usize].waiting, p);
        }
    }

    /// Of the points that wait at a facet the furthest, as far as rounding tells; of equal ones the first.
    fn furthest(&self, facet: Facet) -> u32 {
        let height = |p: u32| facet.plane.height(self.points[p as usize]);
        let (mut best, mut highest) = (facet.waiting, height(facet.waiting));
        let mut p = self.next[best as usize];
        while p != NONE {
            let h = height(p);
            if h > highest || (h == highest && p < best) {
                (best, highest) = (p, h);
            }
            p = self.next[p as usize];
        }
        best
    }

    fn finish(mut self) -> Vec<Vec<usize>> {
        let (mut seen, mut horizon, mut fresh) = (Vec::new(), Vec::new(), Vec::new());
        while let Some(f) = self.pending.pop() {
            let facet = self.facets[f as usize];
            if facet.corners[0] == NONE || facet.waiting == NONE {
                continue;
            }
            let p = self.furthest(facet);
            self.look(p, f, &mut seen, &mut horizon);
            fresh.clear();
            for &(a, b, outside) in &horizon {
                let g = self.facet([a, b, p], [outside, NONE, NONE]);
                let slot = self.free.pop().unwrap_or(self.facets.len() as u32);
                if slot as usize == self.facets.len() {
                    self.facets.push(g);
                } else {
                    self.facets[slot as usize] = g;
                }
                self.starting[a as usize] = slot;
                fresh.push(slot);
            }
            for (&slot, &(a, b, outside)) in fresh.iter().zip(&horizon) {
                let following = self.starting[b as usize];
                self.facets[slot as usize].across[1] = following;
                self.facets[following as usize].across[2] = slot;
                let beyond = &mut self.facets[outside as usize];
                let k = (0..3).find(|&k| beyond.corners[k] == b && beyond.corners[(k + 1) % 3] == a);
                beyond.across[k.expect("the horizon is an edge of what is not seen")] = slot;
            }
            for &s in &seen {
                let mut q = self.facets[s as usize].waiting;
                while q != NONE {
                    let after = self.next[q as usize];
                    if q != p {
                        self.wait(q, &fresh);
                    }
                    q = after;
                }
                self.facets[s as usize].corners[0] = NONE;
                self.free.push(s);
            }
            self.pending.extend(&fresh);
        }
        Faces::of(self.points, &self.facets)
    }

    /// Finds what a point sees, from a facet that it sees; and the edges around it, with the facets outside.
    fn look(&mut self, p: u32, from: u32, seen: &mut Vec<u32>, horizon: &mut Vec<(u32, u32, u32)>) {
        seen.clear();
        horizon.clear();
        (self.facets[from as usize].asked, self.facets[from as usize].seen) = (p, true);
        seen.push(from);
        let mut k = 0;
        while let Some(&f) = seen.get(k) {
            k += 1;
            let Facet { corners, across, .. } = self.facets[f as usize];
            for (i, g) in across.into_iter().enumerate() {
                if self.facets[g as usize].asked != p {
                    let sees = self.sees(p, g);
                    (self.facets[g as usize].asked, self.facets[g as usize].seen) = (p, sees);
                    if sees {
                        seen.push(g);
                    }
                }
                if !self.facets[g as usize].seen {
                    horizon.push((corners[i], corners[(i + 1) % 3], g));
                }
            }
        }
    }
}

/// Flat faces from triangles.
struct Faces<'a> {
    points: &'a [[f64; 3]],
    facets: &'a [Facet],
    /// For each triangle its face.
    face: Vec<u32>,
}

impl<'a> Faces<'a> {
    fn of(points: &'a [[f64; 3]], facets: &'a [Facet]) -> Vec<Vec<usize>> {
        let mut faces = Self { points, facets, face: vec![NONE; facets.len()] };
        let mut all = Vec::new();
        for (f, facet) in facets.iter().enumerate() {
            if facet.corners[0] != NONE && faces.face[f] == NONE {
                all.push(faces.merge(f as u32));
            }
        }
        all.sort_unstable();
        all
    }

    /// The corners of the face that a triangle belongs to.
    fn merge(&mut self, first: u32) -> Vec<usize> {
        let mut members = vec![first];
        self.face[first as usize] = first;
        let [a, b, c] = self.facets[first as usize].corners.map(|i| self.points[i as usize]);
        let is_flat = |j: u32| orient3d(a, b, c, self.points[j as usize]).is_zero();
        let mut k = 0;
        while let Some(&f) = members.get(k) {
            k += 1;
            for g in self.facets[f as usize].across {
                if self.face[g as usize] == NONE && self.facets[g as usize].corners.into_iter().all(is_flat) {
                    self.face[g as usize] = first;
                    members.push(g);
                }
            }
        }
        let mut border = Vec::new();
        for &f in &members {
            let Facet { corners, across, .. } = self.facets[f as usize];
            let outer = (0..3).filter(|&i| self.face[across[i] as usize] != first);
            border.extend(outer.map(|i| (corners[i] as usize, corners[(i + 1) % 3] as usize)));
        }
        self.polygon(border)
    }

    /// The strict corners of a border, from the smallest one.
    fn polygon(&self, mut border: Vec<(usize, usize)>) -> Vec<usize> {
        border.sort_unstable();
        let follow = |u: usize| border.binary_search_by_key(&u, |&(from, _)| from).ok().map(|i| border[i].1);
        let mut around = vec![border[0].0];
        while let Some(v) = follow(around[around.len() - 1]).filter(|&v| v != around[0]) {
            around.push(v);
        }
        let n = around.len();
        let strict = |&i: &usize| {
            !are_collinear(self.points, [around[(i + n - 1) % n], around[i], around[(i + 1) % n]])
        };
        let mut corners: Vec<usize> = (0..n).filter(strict).map(|i| around[i]).collect();
        let order = |i: &usize| self.points[corners[*i]];
        let least = (0..corners.len()).min_by(|i, j| lexicographic(order(i), order(j))).unwrap_or(0);
        corners.rotate_left(least);
        corners
    }
}
