//! The hull so far: triangles closed to a sphere, what a point sees of them, and its cap over what it sees.
//!
//! Visibility of facets is decided exactly, and strictly. Points on the plane of a facet do not see it, so a flat face
//! may be cut anyhow and may hold points that are no corners of the hull.

use delone_predicates::{Plane, orient3d};

/// No point, no facet.
pub(super) const NONE: u32 = u32::MAX;

/// A triangle of the hull so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    /// Counter-clockwise seen from outside.
    pub(super) corners: [u32; 3],
    /// The facets across the edges that leave the corners.
    pub(super) across: [u32; 3],
    /// The first of a list that the algorithm keeps.
    pub(super) head: u32,
    /// The point that last asked whether it sees this, and the answer.
    asked: u32,
    seen: bool,
    /// Whether it is a facet of the hull still.
    pub(super) alive: bool,
    plane: Plane,
}

impl Facet {
    /// Proportional to the distance of a point from the facet's plane, rounded; infinite where products overflow, so that
    /// heights can be compared.
    pub(super) fn height(&self, p: [f64; 3]) -> f64 {
        let height = self.plane.height(p);
        if height.is_nan() { f64::INFINITY } else { height }
    }
}

/// An edge of the border of what a point sees.
#[derive(Clone, Copy, Debug)]
pub(super) struct Horizon {
    /// Its ends, with what is seen on the left.
    ends: [u32; 2],
    /// The facet that is seen.
    pub(super) inside: u32,
    /// The facet that is not.
    pub(super) outside: u32,
}

#[derive(Clone, Debug)]
pub(super) struct Shell {
    pub(super) points: Vec<[f64; 3]>,
    pub(super) facets: Vec<Facet>,
    /// Facets whose place may be taken.
    pub(super) free: Vec<u32>,
    /// The facets that the last point saw.
    pub(super) seen: Vec<u32>,
    /// Its border.
    pub(super) horizon: Vec<Horizon>,
    /// The facets made last, one for each edge of the horizon.
    pub(super) fresh: Vec<u32>,
    /// For each corner of a horizon the fresh facet whose first corner it is.
    starting: Vec<u32>,
    /// The box around the points: its ends, axis by axis.
    pub(super) limits: [(f64, f64); 3],
    /// Its size.
    extent: [f64; 3],
}

impl Shell {
    /// The tetrahedron of four points, the last one on the positive side of the others.
    pub(super) fn new(points: Vec<[f64; 3]>, corners: [usize; 4]) -> Self {
        let limits = [0, 1, 2].map(|k| {
            let of = points.iter().map(|p| p[k]);
            (of.clone().fold(f64::MAX, f64::min), of.fold(f64::MIN, f64::max))
        });
        let [a, b, c, d] = corners.map(|i| i as u32);
        let mut shell = Self {
            starting: vec![NONE; points.len()],
            points,
            facets: Vec::new(),
            free: Vec::new(),
            seen: Vec::new(),
            horizon: Vec::new(),
            fresh: Vec::new(),
            limits,
            extent: limits.map(|(low, high)| high - low),
        };
        // The base from below, and the three sides.
        let corners = [[a, c, b], [a, b, d], [b, c, d], [c, a, d]];
        let across = [[3, 2, 1], [0, 2, 3], [0, 3, 1], [0, 1, 2]];
        shell.facets = corners.into_iter().zip(across).map(|(c, a)| shell.facet(c, a)).collect();
        shell
    }

    pub(super) fn facet(&self, corners: [u32; 3], across: [u32; 3]) -> Facet {
        let [a, b, c] = corners.map(|i| self.points[i as usize]);
        let plane = Plane::new(a, b, c, self.extent);
        Facet { corners, across, head: NONE, asked: NONE, seen: false, alive: true, plane }
    }

    /// Adds a point. Where it is outside of the box, that grows to twice the size, and all planes are for the larger box.
    pub(super) fn add(&mut self, q: [f64; 3]) -> u32 {
        self.points.push(q);
        self.starting.push(NONE);
        if !self.is_in_box(q) {
            for (&x, (low, high)) in q.iter().zip(&mut self.limits) {
                let size = *high - *low;
                if x < *low {
                    *low = (x - size).max(f64::MIN);
                } else if x > *high {
                    *high = (x + size).min(f64::MAX);
                }
            }
            self.extent = self.limits.map(|(low, high)| high - low);
            for facet in &mut self.facets {
                let [a, b, c] = facet.corners.map(|i| self.points[i as usize]);
                facet.plane = Plane::new(a, b, c, self.extent);
            }
        }
        self.points.len() as u32 - 1
    }

    /// Whether a point is in the box around the points.
    pub(super) fn is_in_box(&self, q: [f64; 3]) -> bool {
        q.iter().zip(self.limits).all(|(&x, (low, high))| (low..=high).contains(&x))
    }

    /// Whether a point in the box is strictly outside of a facet.
    pub(super) fn sees(&self, q: [f64; 3], facet: u32) -> bool {
        let facet = &self.facets[facet as usize];
        let exact = || {
            let [a, b, c] = facet.corners.map(|i| self.points[i as usize]);
            orient3d(a, b, c, q)
        };
        facet.plane.side(q).unwrap_or_else(exact).is_positive()
    }

    /// Finds what a point of the set sees, from a facet that it sees; and the border of that.
    pub(super) fn look(&mut self, p: u32, from: u32) {
        self.seen.clear();
        self.horizon.clear();
        let q = self.points[p as usize];
        (self.facets[from as usize].asked, self.facets[from as usize].seen) = (p, true);
        self.seen.push(from);
        let mut k = 0;
        while let Some(&f) = self.seen.get(k) {
            k += 1;
            let Facet { corners, across, .. } = self.facets[f as usize];
            for (i, g) in across.into_iter().enumerate() {
                if self.facets[g as usize].asked != p {
                    let sees = self.sees(q, g);
                    (self.facets[g as usize].asked, self.facets[g as usize].seen) = (p, sees);
                    if sees {
                        self.seen.push(g);
                    }
                }
                if !self.facets[g as usize].seen {
                    let ends = [corners[i], corners[(i + 1) % 3]];
                    self.horizon.push(Horizon { ends, inside: f, outside: g });
                }
            }
        }
    }

    /// Joins a point to the border of what it sees. What it saw is alive no more, but still in its place.
    pub(super) fn cap(&mut self, p: u32) {
        self.fresh.clear();
        for k in 0..self.horizon.len() {
            let Horizon { ends: [a, b], outside, .. } = self.horizon[k];
            let facet = self.facet([a, b, p], [outside, NONE, NONE]);
            let slot = self.free.pop().unwrap_or(self.facets.len() as u32);
            if slot as usize == self.facets.len() {
                self.facets.push(facet);
            } else {
                self.facets[slot as usize] = facet;
            }
            self.starting[a as usize] = slot;
            self.fresh.push(slot);
        }
        for (&slot, &Horizon { ends: [a, b], outside, .. }) in self.fresh.iter().zip(&self.horizon) {
            let following = self.starting[b as usize];
            self.facets[slot as usize].across[1] = following;
            self.facets[following as usize].across[2] = slot;
            let beyond = &mut self.facets[outside as usize];
            let k = (0..3).find(|&k| beyond.corners[k] == b && beyond.corners[(k + 1) % 3] == a);
            beyond.across[k.expect("the horizon is an edge of what is not seen")] = slot;
        }
        self.seen.iter().for_each(|&f| self.facets[f as usize].alive = false);
    }
}
