//! Ribs: the direction in which rows go from a vertex of the border, as a step for a height of one.
//!
//! At a corner the step leads to where the lines at that height beside both sides meet. So it leans along the sides, and where there is less
//! than half a turn of the mesh the vertices of a line would come too near to each other, or change places. Neighbors share that: from vertex
//! to vertex they lean less, over four times what the corner does at full height.
//!
//! Around more than 240 degrees there is a fan. Its ribs are found by halving angles, with square roots alone: so they are the same on every
//! machine.
//!
//! Cost: O(1) for each rib, and for each vertex that a corner leans over.

use super::chains::{Chains, Wedge};

/// The cosine of the turn from which on there is a fan: 60 degrees, that is 240 of the mesh.
const FAN_COSINE: f64 = 0.5;
/// The square of the largest distance of neighboring steps of a fan: that of 50 degrees.
const WIDEST_STEP: f64 = 0.714;
/// The longest edge of the last line around a fan, in lengths of the sides there, or heights of the last row if that is more.
const LONGEST_OF_FAN: f64 = 1.4;
/// One and the cosine of a turn, below which there are no rows in a corner: 26 degrees of the mesh.
const NARROWEST_CORNER: f64 = 0.1;
/// The cosine of the turn, from which on a corner does not lean over another one: 30 degrees.
const CORNER_COSINE: f64 = 0.866;
/// The largest cosine of the angle between a side and a constraint that rows follow: from 50 to 130 degrees.
const FOLLOWED_COSINE: f64 = 0.643;
/// Neighbors lean over a way so many times as long as a corner leans at full height.
const LEANING_WAY: f64 = 4.0;

/// The ribs of a wedge.
#[derive(Clone, Debug, Default)]
pub(super) struct Ribs {
    /// From the one of the side before to the one of the side after; none where there are no rows.
    pub(super) steps: Vec<[f64; 2]>,
    /// How far the one rib leans over the side before, and the side after.
    lean: [f64; 2],
    /// Whether the rib is on the constraint beside.
    pub(super) follows: bool,
}

fn dot(u: [f64; 2], v: [f64; 2]) -> f64 {
    u[0] * v[0] + u[1] * v[1]
}

/// The ribs of all wedges, for rows so high together, and a last one so high.
pub(super) fn all(chains: &Chains, height: f64, last: f64) -> Vec<Ribs> {
    let spacing = |k: usize| chains.spacing(k).max(last);
    let mut ribs: Vec<Ribs> =
        chains.wedges.iter().enumerate().map(|(k, wedge)| of(wedge, height, spacing(k))).collect();
    let leans: Vec<f64> = (0..ribs.len()).map(|k| lean(chains, &ribs, k, height)).collect();
    for (k, lean) in leans.into_iter().enumerate() {
        if let [step] = &mut ribs[k].steps[..]
            && lean != 0.0
        {
            let [t, u] = chains.wedges[k].tangents();
            let along = [t[0] + u[0], t[1] + u[1]];
            let part = lean / dot(along, along).sqrt();
            *step = [0, 1].map(|axis| step[axis] + part * along[axis]);
        }
    }
    ribs
}

/// The ribs of a wedge, without regard to others.
fn of(wedge: &Wedge, height: f64, spacing: f64) -> Ribs {
    let [t, u] = wedge.tangents();
    let cosine = dot(t, u);
    if wedge.beside.is_some() {
        return following(wedge, [t, u]).unwrap_or_default();
    }
    let [n, m] = [t, u].map(|v| [-v[1], v[0]]);
    if wedge.has_fan() {
        return Ribs { steps: fan([n, m], [t, u], height, spacing), ..Ribs::default() };
    }
    if 1.0 + cosine < NARROWEST_CORNER {
        return Ribs::default();
    }
    let step = [0, 1].map(|k| (n[k] + m[k]) / (1.0 + cosine));
    // The same from either side.
    let lean = 0.5 * (dot(step, u) - dot(step, t));
    Ribs { steps: vec![step], lean: [lean; 2], follows: false }
}

impl Wedge {
    /// Whether there is a fan.
    pub(super) fn has_fan(&self) -> bool {
        let [t, u] = self.tangents();
        self.beside.is_none() && self.is_bulge() && dot(t, u) < FAN_COSINE
    }
}

/// The rib on the constraint that a chain ends at.
fn following(wedge: &Wedge, [t, u]: [[f64; 2]; 2]) -> Option<Ribs> {
    let is_end = wedge.sides[1].is_none();
    let sine = t[0] * u[1] - t[1] * u[0];
    let cosine = -dot(t, u);
    if !wedge.may_follow || !wedge.is_hollow() || cosine.abs() > FOLLOWED_COSINE {
        return None;
    }
    let away = if is_end { u } else { [-t[0], -t[1]] };
    let lean = cosine / sine;
    let lean = if is_end { [lean, 0.0] } else { [0.0, lean] };
    Some(Ribs { steps: vec![away.map(|x| x / sine)], lean, follows: true })
}

/// Steps of length one from one normal to another, clockwise, by halves.
fn fan([n, m]: [[f64; 2]; 2], [t, u]: [[f64; 2]; 2], height: f64, spacing: f64) -> Vec<[f64; 2]> {
    let unit = |v: [f64; 2]| {
        let length = dot(v, v).sqrt();
        v.map(|x| x / length)
    };
    // The normals may be opposite to each other, the directions of the border are not.
    let middle = unit([t[0] - u[0], t[1] - u[1]]);
    let mut steps = vec![n, middle, m];
    loop {
        let chord = |pair: &[[f64; 2]]| {
            let way = [0, 1].map(|k| pair[1][k] - pair[0][k]);
            dot(way, way)
        };
        let widest = steps.windows(2).map(chord).fold(0.0, f64::max);
        let is_long = widest.sqrt() * height > LONGEST_OF_FAN * spacing;
        if steps.len() > MOST_OF_FAN || !(widest > WIDEST_STEP || is_long) {
            return steps;
        }
        let halves = steps
            .windows(2)
            .flat_map(|pair| [pair[0], unit([pair[0][0] + pair[1][0], pair[0][1] + pair[1][1]])]);
        steps = halves.chain([m]).collect();
    }
}

/// The ribs of a fan, from which on it is not halved again.
const MOST_OF_FAN: usize = 64;

/// How much a wedge leans along the border because its neighbors do.
fn lean(chains: &Chains, ribs: &[Ribs], wedge: usize, height: f64) -> f64 {
    if ribs[wedge].follows || is_corner(chains, ribs, wedge) {
        return 0.0;
    }
    let [from_before, from_after] = [false, true].map(|is_after| {
        let mut sum = 0.0;
        let (mut at, mut way) = (wedge, 0.0);
        // Corners lean over at most so much.
        while let Some((next, length)) = chains.beyond(at, is_after) {
            way += length;
            if next == wedge || way > LEANING_WAY * height * STEEPEST_LEAN {
                break;
            }
            let own = ribs[next].lean[usize::from(!is_after)];
            let reach = LEANING_WAY * height * own.abs();
            let whole =
                if way < reach { reach.min(to_corner(chains, ribs, next, !is_after, reach)) } else { 0.0 };
            if way < whole {
                sum += own * (1.0 - way / whole);
            }
            if is_corner(chains, ribs, next) {
                break;
            }
            at = next;
        }
        sum
    });
    from_before - from_after
}

/// The largest lean that there is: of the narrowest corner.
const STEEPEST_LEAN: f64 = 4.4;

/// Whether leaning ends at a wedge: at a corner, at a fan, and where chains or rows end.
fn is_corner(chains: &Chains, ribs: &[Ribs], wedge: usize) -> bool {
    let [t, u] = chains.wedges[wedge].tangents();
    ribs[wedge].steps.len() != 1 || ribs[wedge].follows || dot(t, u) < CORNER_COSINE
}

/// The way from a wedge to the next corner, as far as that is less than a bound.
fn to_corner(chains: &Chains, ribs: &[Ribs], wedge: usize, is_after: bool, bound: f64) -> f64 {
    let (mut at, mut way) = (wedge, 0.0);
    while let Some((next, length)) = chains.beyond(at, is_after) {
        way += length;
        if way >= bound || next == wedge || is_corner(chains, ribs, next) {
            break;
        }
        at = next;
    }
    way
}
