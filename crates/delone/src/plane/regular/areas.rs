//! Weights for which the clipped power cells have prescribed areas: the discrete side of optimal transport.
//!
//! There are such weights, unique up to a constant, for any positive areas that sum to the region's (Aurenhammer, Hoffmann &
//! Aronov, "Minkowski-type theorems and least-squares clustering", Algorithmica 1998). Newton's method finds them as long as
//! no cell is empty; a step that makes one so small, or does not come nearer, is halved until it is not and does (Kitagawa,
//! Mérigot & Thibert, "Convergence of a Newton algorithm for semi-discrete optimal transport", JEMS 2019, Algorithm 1). The
//! Jacobian is a Laplacian of the cells' borders, and its systems are solved by conjugate gradients.
//!
//! Cost: a clipping and O(n sqrt n) for a system on evenly spread sites, times the number of steps, seldom more than ten.

use super::{Jacobian2, Regular2};
use crate::error::Error;
use crate::ids::VertexId;
use crate::plane::region::Region2;
use crate::points::Position2;
use crate::sorting;

/// Systems are solved to this share of what they are to make up for: more would not make fewer steps.
const PRECISION: f64 = 1e-4;
/// The areas that a region may have, so that those of its parts are numbers, and weights are.
const SMALLEST: f64 = 1e-280;
const LARGEST: f64 = 1e300;
/// A step is halved so often at most.
const HALVINGS: usize = 40;

/// The result of a search for prescribed areas.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Prescribed2 {
    /// Newton steps.
    pub steps: usize,
    /// The largest difference of an area from what it should be, as a share of that.
    pub error: f64,
}

impl Regular2 {
    /// Sites whose power cells, clipped to a region, divide its area in given shares: positive numbers, of which only the ratios
    /// matter. Ends when no area is wrong by more than a share of itself, or a step does not come nearer; the error tells.
    ///
    /// In a convex region that contains all sites it comes as near as rounding allows: areas are wrong by some 1e-16 of the whole. A region of several parts that no cell
    /// joins may have no solution.
    ///
    /// ```
    /// use delone::{Region2, Regular2, VertexId};
    ///
    /// let points = [[0.1, 0.2], [0.3, 0.9], [0.5, 0.4], [0.9, 0.8]];
    /// let square = Region2::rectangle([0.0, 0.0], [1.0, 1.0])?;
    /// let (r, prescribed) = Regular2::with_areas(&points, &[1.0, 1.0, 2.0, 4.0], &square, 1e-9)?;
    /// assert!(prescribed.error <= 1e-9);
    /// assert!((r.power().clip(&square).area(VertexId::new(3)) - 0.5).abs() < 1e-9);
    /// # Ok::<(), delone::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Self::from_parts`]; [`Error::Area`] for a share that is not positive; [`Error::Parameter`] for a tolerance below zero, and
    /// for a region whose area is beyond 1e-280 to 1e300; [`Error::NoCell`]
    /// for a site that has no area even without weights: outside of the region, or at the point of another one.
    pub fn with_areas<P: Position2>(
        points: &[P],
        shares: &[f64],
        region: &Region2,
        tolerance: f64,
    ) -> Result<(Self, Prescribed2), Error> {
        if points.len() != shares.len() {
            return Err(Error::Length { expected: points.len(), found: shares.len() });
        }
        if let Some(index) = shares.iter().position(|share| !(share.is_finite() && *share > 0.0)) {
            return Err(Error::Area { index, value: shares[index] });
        }
        let unit = region.area();
        if !(SMALLEST..LARGEST).contains(&unit) {
            let range = "from 1e-280 to 1e300, so that its parts are numbers";
            return Err(Error::Parameter { name: "the area of the region", value: unit, range });
        }
        if tolerance.is_nan() || tolerance < 0.0 {
            let range = "at least zero";
            return Err(Error::Parameter { name: "the tolerance", value: tolerance, range });
        }
        let mut weights = vec![0.0; points.len()];
        let mut r = Self::from_parts(points, &weights)?;
        let mut now = r.power().jacobian(region);
        if let Some(site) = now.areas.iter().position(|&area| area <= 0.0) {
            return Err(Error::NoCell { site });
        }
        // All sums are in this order, which depends on the points alone; and neighbors in the plane are neighbors in memory.
        let mut order: Vec<usize> = (0..points.len()).collect();
        sorting::by_key(&mut order, |&i| r.mesh().place(VertexId::new(i)));
        let mut rank = vec![0_u32; points.len()];
        order.iter().enumerate().for_each(|(k, &i)| rank[i] = k as u32);
        let largest = shares.iter().fold(0.0, |m: f64, &share| m.max(share));
        let whole: f64 = order.iter().map(|&i| shares[i] / largest).sum();
        // In units of the region's area, whose square may be no number.
        let wanted: Vec<f64> = order.iter().map(|&i| shares[i] / largest / whole).collect();
        if let Some(k) = wanted.iter().position(|&wanted| wanted < f64::MIN_POSITIVE) {
            return Err(Error::Area { index: order[k], value: wanted[k] });
        }
        let smallest = |areas: &[f64]| areas.iter().fold(f64::INFINITY, |m, &area| m.min(area));
        let floor = (smallest(&now.areas) / unit).min(smallest(&wanted)) / 2.0;
        let missing = |now: &Jacobian2| -> Vec<f64> {
            wanted.iter().zip(&order).map(|(wanted, &i)| wanted - now.areas[i] / unit).collect()
        };
        let mut rest = missing(&now);
        let worst = |rest: &[f64]| {
            rest.iter().zip(&wanted).fold(0.0, |m: f64, (rest, wanted)| m.max(rest.abs() / wanted))
        };
        let mut steps = 0;
        while worst(&rest) > tolerance {
            let step = solve(&now, &rest, &rank);
            let mut share = 1.0;
            let mut halvings = 0;
            loop {
                let moved = |(w, &k): (&f64, &u32)| w + share * step[k as usize] * unit;
                let other: Vec<f64> = weights.iter().zip(&rank).map(moved).collect();
                if halvings == HALVINGS || other.iter().any(|w| !w.is_finite()) {
                    r.set_weights(&weights)?;
                    return Ok((r, Prescribed2 { steps, error: worst(&rest) }));
                }
                r.set_weights(&other)?;
                let then = r.power().jacobian(region);
                let left = missing(&then);
                let is_nearer = length(&left) < (1.0 - share / 2.0) * length(&rest);
                if smallest(&then.areas) / unit >= floor && is_nearer {
                    (weights, now, rest) = (other, then, left);
                    break;
                }
                share /= 2.0;
                halvings += 1;
            }
            steps += 1;
        }
        Ok((r, Prescribed2 { steps, error: worst(&rest) }))
    }
}

/// The weights that would make up for what is missing, if areas were linear: conjugate gradients, each row by its diagonal, with
/// sites by their rank.
fn solve(now: &Jacobian2, missing: &[f64], rank: &[u32]) -> Vec<f64> {
    let count = missing.len();
    let ranked = |&([v, w], value): &([VertexId; 2], f64)| {
        let [v, w] = [v, w].map(|v| rank[v.index()]);
        ([v.min(w), v.max(w)], value)
    };
    let mut derivatives: Vec<([u32; 2], f64)> = now.derivatives.iter().map(ranked).collect();
    sorting::by_key(&mut derivatives, |derivative| derivative.0);
    let mut diagonal = vec![0.0; count];
    for &([v, w], value) in &derivatives {
        diagonal[v as usize] -= value;
        diagonal[w as usize] -= value;
    }
    let times = |x: &[f64]| -> Vec<f64> {
        let mut product: Vec<f64> = diagonal.iter().zip(x).map(|(d, x)| d * x).collect();
        for &([v, w], value) in &derivatives {
            let [v, w] = [v as usize, w as usize];
            product[v] += value * x[w];
            product[w] += value * x[v];
        }
        product
    };
    let scaled = |rest: &[f64]| -> Vec<f64> {
        rest.iter().zip(&diagonal).map(|(r, d)| if *d > 0.0 { r / d } else { 0.0 }).collect()
    };
    let mut solution = vec![0.0; count];
    // What constants cannot make up for: areas and wishes sum to the same but for rounding.
    let mean = missing.iter().sum::<f64>() / count as f64;
    let mut rest: Vec<f64> = missing.iter().map(|missing| missing - mean).collect();
    let goal = PRECISION * length(&rest);
    let mut direction = scaled(&rest);
    let mut energy = dot(&rest, &direction);
    for _ in 0..count.saturating_mul(2) + 20 {
        if length(&rest) <= goal || energy <= 0.0 {
            break;
        }
        let image = times(&direction);
        let curvature = dot(&direction, &image);
        if curvature <= 0.0 {
            break;
        }
        let way = energy / curvature;
        for ((x, r), (d, i)) in solution.iter_mut().zip(&mut rest).zip(direction.iter().zip(&image)) {
            *x += way * d;
            *r -= way * i;
        }
        let next = scaled(&rest);
        let before = std::mem::replace(&mut energy, dot(&rest, &next));
        let turn = energy / before;
        direction.iter_mut().zip(&next).for_each(|(d, n)| *d = n + turn * *d);
    }
    solution
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

fn length(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}
