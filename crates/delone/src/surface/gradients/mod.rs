//! Gradients at the vertices, from the values of their neighbors, for surfaces that are smooth at the vertices too.
//!
//! Source: Sibson, "A brief description of natural neighbor interpolation", 1981. The gradient fits the differences to the neighbors best,
//! each with its weight over the squared distance. The weights are those of Laplace, which the star of a vertex has without another
//! triangulation: the weighted differences of points are zero in sum, so gradients of linear functions and of spheres come out as they are.
//! On the hull all neighbors weigh the same. Cost: O(1) on average for each vertex.
//!
//! A sliver makes weights as large as it is thin: along the hull of a turned lattice they are 1e15 beside others of one. Where that is
//! so, weights and fit are computed in twice the precision, without forming the normal equations of the differences (`fit.rs`).
//! Values are rounded, too, and a fit may multiply that: where the neighbors with weight are on a line, or in a plane, but for rounding, by
//! 1e16. So each fit says by how much. Where it is too much all neighbors weigh the same, and where that is not enough, between slivers
//! alone, the neighbors of neighbors take part (`wide.rs`).

mod fit;
mod wide;

use super::interpolator::check_values;
use super::natural::{apart, compare, duals, scale, three};
use super::real::{Double, Real};
use crate::around::Surround;
use crate::error::Error;
use crate::ids::VertexId;
use crate::parallel;
use crate::sorting;
use crate::triangulation::Coordinates;
use fit::{Row, double, power};
use wide::Wide;

/// Pivots of normal equations from this part of all weights on lose at most eight of 53 bits: 2^-8.
const GOOD_PIVOT: f64 = 0.003_906_25;

/// A fit that makes more of the rounding of values is done again with others: 2^20. What is left of 53 bits is enough for nine digits.
const NOISE_LIMIT: f64 = 1_048_576.0;

/// Squared lengths between 2^-900 and 2^900 have all their bits, and so have quotients of two of them.
const SQUARES: std::ops::Range<f64> = 1.183_052_186_166_774_8e-271..8.452_712_498_170_644e270;

/// The range in space, 2^-450 to 2^450, because weights there are made of fourth powers of lengths.
const SQUARES_IN_SPACE: std::ops::Range<f64> = 3.439_552_567_074_349_4e-136..2.907_354_897_182_427_6e135;

/// The gradients at all vertices, by the index of the vertex: values per unit of length along each axis. Zero for ids that are no
/// vertices, along directions in which there are no neighbors, and where a number would leave the range of `f64`.
///
/// Linear functions are reproduced: a gradient is in error by at most 2^-36 of its length, and by at most 2^-32 m / s for values of size m,
/// which are rounded, and points that are s apart or more. Where all points are close to one line or plane the second bound grows: as many
/// times as the set is thinner than 2^-20 of its length.
///
/// # Errors
/// [`Error::Values`] if there are not as many values as ids of vertices.
///
/// ```
/// use delone::{Delaunay2, surface::gradients};
///
/// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [0, 4], [1, 1]])?;
/// let slopes = gradients(&d, &[1.0, 9.0, 13.0, 6.0])?; // 1 + 2 x + 3 y
/// assert!(slopes.iter().all(|[x, y]| (x - 2.0).abs() < 1e-12 && (y - 3.0).abs() < 1e-12));
/// # Ok::<(), delone::Error>(())
/// ```
pub fn gradients<T: Surround>(d: &T, values: &[f64]) -> Result<Vec<T::Point>, Error> {
    check_values(d, values.len(), 1)?;
    let part = |range: std::ops::Range<usize>| {
        let mut star = Star::new();
        range.map(|v| at(d, VertexId::new(v), values, &mut star)).collect::<Vec<_>>()
    };
    Ok(parallel::map(parallel::ranges(values.len()), part).concat())
}

/// Neighbors with their weights, in the order of their points.
type Star<R = f64> = Vec<(VertexId, R)>;

fn at<T: Surround>(d: &T, v: VertexId, values: &[f64], star: &mut Star) -> T::Point {
    let mut gradient = T::Point::default();
    if d.position(v).is_none() {
        return gradient;
    }
    let (mut is_in_range, mut quick) = quick_slope(d, v, values, 1.0, star);
    if !is_in_range {
        let unit = Rows::new(d, v, values).map_or(1.0, |rows| rows.length[0] * rows.length[1]);
        (is_in_range, quick) = quick_slope(d, v, values, unit, star);
    }
    let slope = quick.filter(|_| is_in_range).or_else(|| careful(d, v, values)).unwrap_or_default();
    gradient.as_mut().copy_from_slice(&slope[..T::Point::COUNT]);
    gradient
}

/// The gradient, computed in places times a power of two: whether what they are multiplied to is in the range of numbers; and `None` where
/// the fit is bad.
fn quick_slope<T: Surround>(
    d: &T,
    v: VertexId,
    values: &[f64],
    unit: f64,
    star: &mut Star,
) -> (bool, Option<[f64; 3]>) {
    let place = |w: VertexId| three(d.position(w).unwrap_or_default()).map(|x| x * unit);
    let p = place(v);
    let size = weigh(d, v, place, star);
    let mut matrix = [[0.0; 4]; 3];
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    for &(w, weight) in star.iter() {
        let q = place(w);
        let away = [0, 1, 2].map(|k| q[k] - p[k]);
        let square: f64 = away.iter().map(|x| x * x).sum();
        (least, most) = (least.min(square), most.max(square));
        // Halves of the differences, which cannot overflow.
        let rise = (values[w.index()] / 2.0 - values[v.index()] / 2.0) * 2.0;
        for i in 0..3 {
            let part = weight * away[i] / square;
            (0..3).for_each(|j| matrix[i][j] += part * away[j]);
            matrix[i][3] += part * rise;
        }
    }
    let range = if T::Point::COUNT == 3 { SQUARES_IN_SPACE } else { SQUARES };
    let slope = solve(matrix, T::Point::COUNT, size * GOOD_PIVOT);
    (range.contains(&least) && range.contains(&most), slope.map(|slope| slope.map(|x| x * unit)))
}

/// The neighbors of a vertex, in the order of their points, with the weights of Laplace; with equal ones on the hull. What the weights are
/// made of is this large in sum, which is no number where weights are none. `place` says where a vertex is, from anywhere.
fn weigh<T: Surround, R: Real>(
    d: &T,
    v: VertexId,
    place: impl Fn(VertexId) -> [R; 3],
    star: &mut Star<R>,
) -> f64 {
    star.clear();
    let mut is_on_hull = false;
    let mut size = 0.0;
    for s in d.simplices_at(v) {
        let corners = d.corners(s);
        let corners = corners.as_ref();
        let points = [0, 1, 2, 3].map(|k| corners.get(k).map_or([R::default(); 3], |&w| place(w)));
        // In space roundings depend on the order of corners, which in the plane only turns.
        let mut order = [0, 1, 2, 3];
        if corners.len() == 4 {
            let places = [0, 1, 2, 3].map(|k| three(d.position(corners[k]).unwrap_or_default()));
            sorting::by(&mut order, |&i, &j| compare(places[i], places[j]));
        }
        let sums = duals(&order.map(|k| points[k])[..corners.len()]);
        let rank = |corner: usize| order.iter().position(|&k| k == corner).unwrap_or_default();
        let own = corners.iter().position(|&w| w == v).unwrap_or_default();
        for (k, &w) in corners.iter().enumerate() {
            if k != own {
                let part = sums[rank(own)][rank(k)];
                size += part.value().abs();
                star.push((w, part));
                is_on_hull |= d.across(s, k).is_none();
            }
        }
    }
    // Sums have the same bits whatever the triangulation was made of.
    let at = |v: VertexId| three(d.position(v).unwrap_or_default());
    sorting::by(star, |a, b| compare(at(a.0), at(b.0)).then(a.1.value().total_cmp(&b.1.value())));
    star.dedup_by(|next, kept| {
        let is_same = next.0 == kept.0;
        kept.1 += if is_same { next.1 } else { R::default() };
        is_same
    });
    let are_weights = star.iter().all(|weight| weight.1.value().is_finite());
    let are_equal = is_on_hull || !are_weights;
    for (_, weight) in star.iter_mut() {
        let positive = if weight.value() > 0.0 { *weight } else { R::default() };
        *weight = if are_equal { R::one() } else { positive };
    }
    if is_on_hull { star.len() as f64 } else { size }
}

/// Solves linear equations whose matrix is symmetric and has no negative eigenvalue; `None` where a pivot is less than it should be.
fn solve(mut m: [[f64; 4]; 3], axes: usize, least: f64) -> Option<[f64; 3]> {
    let mut order = [0, 1, 2];
    for step in 0..axes {
        let pivot = (step..axes)
            .max_by(|&i, &j| m[order[i]][order[i]].total_cmp(&m[order[j]][order[j]]))
            .unwrap_or(step);
        order.swap(step, pivot);
        let p = order[step];
        if !(m[p][p] >= least && m[p][p].is_finite() && least > 0.0) {
            return None;
        }
        for &i in &order[step + 1..axes] {
            let factor = m[i][p] / m[p][p];
            (0..4).for_each(|j| m[i][j] -= factor * m[p][j]);
        }
    }
    let mut solution = [0.0; 3];
    for step in (0..axes).rev() {
        let p = order[step];
        let known: f64 = order[step + 1..axes].iter().map(|&j| m[p][j] * solution[j]).sum();
        solution[p] = (m[p][3] - known) / m[p][p];
    }
    solution.iter().all(|x| x.is_finite()).then_some(solution)
}

/// Fits in twice the precision, among slivers and near the ends of the range; `None` where neighbors span nothing.
#[cold]
fn careful<T: Surround>(d: &T, v: VertexId, values: &[f64]) -> Option<[f64; 3]> {
    let axes = T::Point::COUNT;
    let rows = Rows::new(d, v, values)?;
    let mut star: Star<Double> = Vec::new();
    weigh(d, v, |w| rows.away(w), &mut star);
    let first = fit::fit(&rows.of(&star), axes);
    if let Some(fit) = first.filter(|fit| fit.noise <= NOISE_LIMIT) {
        return Some(rows.slope(fit.slope));
    }
    let mut wide = Wide::new(star.iter().map(|neighbor| neighbor.0).collect());
    let mut best = first;
    loop {
        star.clear();
        star.extend(wide.neighbors().iter().map(|&w| (w, Double::one())));
        if let Some(fit) = fit::fit(&rows.of(&star), axes) {
            if fit.noise <= NOISE_LIMIT {
                return Some(rows.slope(fit.slope));
            }
            best = best.filter(|best| best.noise <= fit.noise).or(Some(fit));
        }
        if !wide.widen(d, v) {
            return best.map(|fit| rows.slope(fit.slope));
        }
    }
}

/// Differences from a vertex to others, in a unit that keeps them in the range of numbers.
struct Rows<'a, T> {
    d: &'a T,
    values: &'a [f64],
    /// The vertex, and its value.
    from: ([f64; 3], f64),
    length: [f64; 2],
    height: [f64; 2],
}

impl<'a, T: Surround> Rows<'a, T> {
    fn new(d: &'a T, v: VertexId, values: &'a [f64]) -> Option<Self> {
        let from = (three(d.position(v)?), values[v.index()]);
        let [mut length, mut height] = [0.0f64; 2];
        for s in d.simplices_at(v) {
            for &w in d.corners(s).as_ref() {
                let q = three(d.position(w)?);
                length = (0..3).fold(length, |most, k| most.max(apart(q[k], from.0[k])));
                height = height.max(apart(values[w.index()], from.1));
            }
        }
        Some(Self { d, values, from, length: scale(length), height: scale(height) })
    }

    fn away(&self, w: VertexId) -> [Double; 3] {
        let (q, p) = (three(self.d.position(w).unwrap_or_default()), self.from.0);
        let [before, after] = self.length;
        [0, 1, 2].map(|k| Double::difference(q[k] * before, p[k] * before, after))
    }

    /// Each row in a unit of its own, so that squares stay in range.
    fn of(&self, star: &Star<Double>) -> Vec<Row> {
        let [before, after] = self.height;
        let row = |&(w, weight): &(VertexId, Double)| {
            let away = self.away(w);
            let own = 1.0 / power(away.iter().map(|x| x.value().abs()).fold(0.0, f64::max));
            let rise = Double::difference(self.values[w.index()] * before, self.from.1 * before, after);
            Row { away: away.map(|x| x * double(own)), rise: rise * double(own), weight }
        };
        star.iter().map(row).collect()
    }

    /// A gradient in the unit of the points and values.
    fn slope(&self, slope: [f64; 3]) -> [f64; 3] {
        let ([before, after], [low, high]) = (self.length, self.height);
        let slope = slope.map(|x| x * after * before / high / low);
        if slope.iter().all(|x| x.is_finite()) { slope } else { [0.0; 3] }
    }
}
