//! Surfaces that are smooth at the vertices too, from values and gradients there.
//!
//! Sources: Sibson, "A brief description of natural neighbor interpolation", 1981: between the plane of each neighbor, and what
//! natural neighbors give, so that spheres come out as they are. Farin, "Surfaces over Dirichlet tessellations", 1990: a cubic
//! of Bernstein and Bezier over natural neighbor coordinates, whose quadratic part comes out as it is.
//!
//! Cost: as for [`Interpolator::sibson`], and O(k) and O(k^2) for k neighbors.

use super::interpolator::{Interpolator, blend, check_values};
use crate::around::Surround;
use crate::error::Error;
use crate::ids::VertexId;
use crate::triangulation::Coordinates;

impl<T: Surround> Interpolator<'_, T> {
    /// Sibson's surface of values and [gradients](super::gradients) by the index of their vertex; continuously differentiable, with
    /// these gradients at the vertices. It reproduces linear functions and, given their gradients, spheres: a + b x + c |x|^2. Beside
    /// the weights of [`Self::sibson`], so that is what this should be. `None` outside.
    ///
    /// # Errors
    /// As [`Self::value`].
    ///
    /// ```
    /// use delone::{Delaunay2, surface::{Interpolator, gradients}};
    ///
    /// let points: Vec<[i32; 2]> = (0..100).map(|i| [i % 10, 3 * i / 10 + i % 7]).collect();
    /// let d = Delaunay2::from_points(&points)?;
    /// let values: Vec<f64> = points.iter().map(|[x, y]| f64::from(x * x + y * y)).collect();
    /// let slopes: Vec<[f64; 2]> = points.iter().map(|p| p.map(|x| f64::from(2 * x))).collect();
    /// let value = Interpolator::sibson(&d).smooth([4.3, 12.2], &values, &slopes)?;
    /// assert!((value.unwrap() - (4.3 * 4.3 + 12.2 * 12.2)).abs() < 1e-9);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn smooth(
        &mut self,
        q: T::Point,
        values: &[f64],
        gradients: &[T::Point],
    ) -> Result<Option<f64>, Error> {
        self.bent(q, values, gradients, sibson)
    }

    /// Farin's surface of values and [gradients](super::gradients) by the index of their vertex; continuously differentiable, with these
    /// gradients at the vertices. It reproduces linear functions and, given their gradients, all quadratic ones. `None` outside.
    ///
    /// # Errors
    /// As [`Self::value`].
    pub fn farin(
        &mut self,
        q: T::Point,
        values: &[f64],
        gradients: &[T::Point],
    ) -> Result<Option<f64>, Error> {
        self.bent(q, values, gradients, farin)
    }

    fn bent(
        &mut self,
        q: T::Point,
        values: &[f64],
        gradients: &[T::Point],
        surface: Bent<T::Point>,
    ) -> Result<Option<f64>, Error> {
        let d = self.triangulation();
        check_values(d, values.len(), 1)?;
        check_values(d, gradients.len(), 1)?;
        // Points on one line or plane have no gradients.
        let is_flat = d.simplices().next().is_none();
        self.weights(q)?;
        let (q, weights) = self.found();
        if weights.len() < 2 || is_flat {
            return Ok((!weights.is_empty()).then(|| blend(weights, |v| values[v])));
        }
        let neighbor = |&(v, weight): &(VertexId, f64)| {
            let i = v.index();
            let point = d.position(v).unwrap_or_default();
            Neighbor { weight, point, value: values[i], gradient: gradients[i] }
        };
        let neighbors: Vec<_> = weights.iter().filter(|weight| weight.1 > 0.0).map(neighbor).collect();
        let bent = surface(q, &neighbors);
        Ok(Some(if bent.is_finite() { bent } else { blend(weights, |v| values[v]) }))
    }
}

/// The value at a point of a surface over its natural neighbors.
type Bent<P> = fn(P, &[Neighbor<P>]) -> f64;

/// A natural neighbor.
#[derive(Clone, Copy)]
struct Neighbor<P> {
    weight: f64,
    point: P,
    value: f64,
    gradient: P,
}

/// How much a linear function with a gradient rises from one point to another.
fn rise<P: Coordinates>(gradient: P, from: P, to: P) -> f64 {
    let [g, a, b] = [gradient.as_ref(), from.as_ref(), to.as_ref()];
    (0..P::COUNT).map(|k| g[k] * (b[k] - a[k])).sum()
}

fn sibson<P: Coordinates>(q: P, neighbors: &[Neighbor<P>]) -> f64 {
    let mean: f64 = neighbors.iter().map(|n| n.weight * n.value).sum();
    let [mut planes, mut over, mut first, mut second] = [0.0; 4];
    for n in neighbors {
        let square: f64 = n.point.as_ref().iter().zip(q.as_ref()).map(|(a, b)| (a - b) * (a - b)).sum();
        let distance = square.sqrt();
        let part = n.weight / distance;
        planes += part * (n.value + rise(n.gradient, n.point, q));
        over += part;
        first += n.weight * distance;
        second += n.weight * square;
    }
    let alpha = first / over;
    (alpha * mean + second * planes / over) / (alpha + second)
}

/// With c_ij = f_i + g_i (p_j - p_i) / 3, the control points with two indices, those with three different ones are 3/2 of the mean of their
/// six c, less half of the mean of their f. Summed over all three indices only two remain.
fn farin<P: Coordinates>(_: P, neighbors: &[Neighbor<P>]) -> f64 {
    let mut total = 0.0;
    for n in neighbors {
        total += n.weight * n.weight * n.weight * n.value;
    }
    for (i, a) in neighbors.iter().enumerate() {
        for (j, b) in neighbors.iter().enumerate() {
            if i != j {
                let product = a.weight * b.weight;
                let others = 1.0 - a.weight - b.weight;
                let control = a.value + rise(a.gradient, a.point, b.point) / 3.0;
                total += product * (3.0 * a.weight * control + others * (1.5 * control - 0.5 * a.value));
            }
        }
    }
    total
}
