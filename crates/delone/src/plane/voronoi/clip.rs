//! Rings of a polygon cut by a half-plane.
//!
//! Every edge of a ring knows the line that it lies on, and every corner is computed from what was given: two lines
//! of the input meet there, never two rounded corners. So two cells that share a corner share its bits, and clipped
//! cells tile without gaps.
//!
//! Source: Sutherland & Hodgman, "Reentrant polygon clipping", CACM 1974, with the pieces joined along the line in
//! pairs, so that a polygon falls apart into as many rings as it should. Whatever the pairs, the area is right,
//! because all of them are on one line.
//!
//! Cost: O(k log k) for k corners, O(k) for a convex ring.

use delone_predicates::circumcentre;

/// A corner that is off its edge by more than this share of its coordinates is not just rounded.
const ROUNDED: f64 = 1.0 / (1 << 30) as f64;

/// What an edge lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Line {
    /// A side of the region, from corner to corner.
    Side([[f64; 2]; 2]),
    /// The border of a box that the region was cut into; on no result.
    Cut,
    /// The bisector of the site and another one.
    Bisector([f64; 2]),
}

/// A corner of a ring, and the line of the edge that leaves it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub(super) at: [f64; 2],
    pub(super) line: Line,
}

/// Corners of a closed line, the polygon on its left.
pub(super) type Ring = Vec<Corner>;

/// What is kept.
#[derive(Clone, Copy, Debug)]
pub(super) enum HalfPlane {
    /// Points at least as near to the site as to the other one.
    Nearer {
        /// The site.
        site: [f64; 2],
        /// The other site.
        other: [f64; 2],
    },
    /// Points whose coordinate on an axis is at most this.
    Below(usize, f64),
    /// Points whose coordinate on an axis is at least this.
    Above(usize, f64),
}

impl HalfPlane {
    /// Non-negative where it is kept, and proportional to the distance from the line.
    fn value(self, p: [f64; 2]) -> f64 {
        match self {
            Self::Nearer { site, other } => {
                let [nx, ny] = normal(site, other);
                let beyond =
                    |axis: usize| (p[axis] / 2.0 - site[axis] / 2.0) + (p[axis] / 2.0 - other[axis] / 2.0);
                nx * beyond(0) + ny * beyond(1)
            }
            Self::Below(axis, at) => at - p[axis],
            Self::Above(axis, at) => p[axis] - at,
        }
    }

    /// Increases along the line, with what is kept on the left.
    fn along(self, p: [f64; 2]) -> f64 {
        let [nx, ny] = match self {
            Self::Nearer { site, other } => normal(site, other),
            Self::Below(axis, _) => [0.0 - f64::from(axis == 0), 0.0 - f64::from(axis == 1)],
            Self::Above(axis, _) => [f64::from(axis == 0), f64::from(axis == 1)],
        };
        ny * (p[0] / 2.0) - nx * (p[1] / 2.0)
    }

    fn line(self) -> Line {
        match self {
            Self::Nearer { other, .. } => Line::Bisector(other),
            _ => Line::Cut,
        }
    }

    /// Where the edge between two corners on different sides meets the line.
    fn meet(self, from: &Corner, to: &Corner) -> [f64; 2] {
        let between = |p: [f64; 2], q: [f64; 2]| {
            let (at_p, at_q) = (self.value(p), self.value(q));
            let t = at_p / (at_p - at_q);
            let t = if t.is_finite() { t.clamp(0.0, 1.0) } else { 0.5 };
            [0, 1].map(|axis| {
                let (a, b) = (p[axis], q[axis]);
                (a * (1.0 - t) + b * t).clamp(a.min(b), a.max(b))
            })
        };
        let meeting = match (self, from.line) {
            (_, Line::Side([p, q])) => Some(between(p, q)),
            (Self::Nearer { site, other }, Line::Bisector(third)) => circumcentre(site, other, third),
            _ => None,
        };
        // Lines that are the same up to rounding may meet anywhere; where does not matter then, but it must be
        // on the edge.
        let on_edge = |p: &[f64; 2]| {
            [0, 1].into_iter().all(|axis| {
                let (a, b) = (from.at[axis], to.at[axis]);
                let slack = a.abs().max(b.abs()) * ROUNDED;
                (a.min(b) - slack..=a.max(b) + slack).contains(&p[axis])
            })
        };
        meeting.filter(on_edge).unwrap_or_else(|| between(from.at, to.at))
    }
}

/// From the other site to the site, the larger component 1.
fn normal(site: [f64; 2], other: [f64; 2]) -> [f64; 2] {
    let [x, y] = [0, 1].map(|axis| site[axis] / 2.0 - other[axis] / 2.0);
    let size = x.abs().max(y.abs());
    if size > 0.0 { [x / size, y / size] } else { [0.0, 0.0] }
}

/// The part of a polygon in a half-plane.
pub(super) fn clip(rings: &[Ring], half: HalfPlane) -> Vec<Ring> {
    let mut kept = Vec::with_capacity(rings.len());
    let mut chains = Vec::new();
    for ring in rings {
        let inside: Vec<bool> = ring.iter().map(|corner| half.value(corner.at) >= 0.0).collect();
        if inside.iter().all(|&inside| inside) {
            kept.push(ring.clone());
        } else if inside.contains(&true) {
            cut(ring, &inside, half, &mut chains);
        }
    }
    join(chains, half, &mut kept);
    kept
}

/// Cuts a ring into chains, each from where it comes in to where it goes out.
fn cut(ring: &Ring, inside: &[bool], half: HalfPlane, chains: &mut Vec<Ring>) {
    let n = ring.len();
    for first in (0..n).filter(|&i| !inside[i] && inside[(i + 1) % n]) {
        let mut chain =
            vec![Corner { at: half.meet(&ring[first], &ring[(first + 1) % n]), line: ring[first].line }];
        let mut i = (first + 1) % n;
        while inside[i] {
            chain.push(ring[i]);
            i = (i + 1) % n;
        }
        let last = (i + n - 1) % n;
        chain.push(Corner { at: half.meet(&ring[last], &ring[i]), line: half.line() });
        chains.push(chain);
    }
}

/// Joins chains to rings: from where one goes out, along the line to where the next one comes in.
fn join(chains: Vec<Ring>, half: HalfPlane, kept: &mut Vec<Ring>) {
    let position = |corner: Option<&Corner>| corner.map_or(0.0, |corner| half.along(corner.at));
    let mut ins: Vec<usize> = (0..chains.len()).collect();
    let mut outs = ins.clone();
    ins.sort_by(|&i, &j| position(chains[i].first()).total_cmp(&position(chains[j].first())));
    outs.sort_by(|&i, &j| position(chains[i].last()).total_cmp(&position(chains[j].last())));
    let mut next = vec![0; chains.len()];
    for (&out, &to) in outs.iter().zip(&ins) {
        next[out] = to;
    }
    let mut used = vec![false; chains.len()];
    for first in 0..chains.len() {
        let mut ring = Ring::new();
        let mut i = first;
        while !used[i] {
            used[i] = true;
            for &corner in &chains[i] {
                // A corner on the line is met twice; the edge that leaves it is that of the second.
                match ring.last_mut() {
                    Some(last) if last.at == corner.at => *last = corner,
                    _ => ring.push(corner),
                }
            }
            i = next[i];
        }
        while ring.len() > 1 && ring.first().map(|c| c.at) == ring.last().map(|c| c.at) {
            ring.pop();
        }
        if ring.len() > 2 {
            kept.push(ring);
        }
    }
}
