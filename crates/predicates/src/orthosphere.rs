//! The smallest spheres orthogonal to points with weights, which alpha complexes are made of: who is inside of one, and how
//! large it is.
//!
//! A sphere with center c and squared radius r is orthogonal to a site (p, w) if |p - c|^2 = r + w; without weights it goes
//! through p. Of those orthogonal to all corners of a simplex the smallest has its center in the span of the corners. Source:
//! Edelsbrunner, "The union of balls and its dual shape", DCG 13 (1995), from the equations c . 2 u = |u|^2 - (w - w'), one for
//! each corner as seen from the last one.
//!
//! Questions read filter, integers, big integers; zero is no answer that matters here: whoever is on a sphere makes one of the same
//! size. Sizes are rounded once: [`crate::ball`] arithmetic knows a number to a hundred bits with a bound of its error, and if all that
//! it may be is rounded to one `f64` that is the result; otherwise a fraction of big integers is rounded. So no size is ever in
//! the wrong order with a size that it is part of, and all machines find the same bits.

mod exact;
mod filter;
pub(crate) mod fraction;
#[cfg(test)]
mod tests;

use crate::ball::{Ball, Lane, Number};
use crate::lanes::Lanes;

use crate::{Sign, Site, angle, compare_powers};
use fraction::{Fraction, smallest};

/// Whether `q` is strictly inside of the smallest sphere orthogonal to one site: has less power at its point than the site itself.
///
/// Exact for every finite input. O(1).
pub fn vertex_is_attached<const D: usize>(a: Site<D>, q: Site<D>) -> bool {
    q.1 > a.1 && compare_powers(a.0, q, a).is_lt()
}

/// Whether `q` is strictly inside of the smallest sphere orthogonal to two sites at different points; with equal weights, whether
/// it sees them at an obtuse angle.
///
/// Exact for every finite input. O(1).
///
/// ```
/// use delone_predicates::edge_is_attached;
/// let (a, b) = (([0.0, 0.0], 0.0), ([4.0, 0.0], 0.0));
/// assert!(edge_is_attached(a, b, ([1.0, 1.0], 0.0)));
/// assert!(!edge_is_attached(a, b, ([2.0, 2.0], 0.0)));
/// // A heavier one reaches further.
/// assert!(edge_is_attached(a, b, ([2.0, 2.0], 0.1)));
/// ```
#[inline]
pub fn edge_is_attached<const D: usize>(a: Site<D>, b: Site<D>, q: Site<D>) -> bool {
    if a.1 == b.1 && b.1 == q.1 {
        return sees_obtuse(a.0, b.0, q.0);
    }
    filter::edge(a, b, q).unwrap_or_else(|| exact::edge([a, q, b])).is_negative()
}

#[inline]
fn sees_obtuse<const D: usize>(a: [f64; D], b: [f64; D], q: [f64; D]) -> bool {
    if let ([ax, ay], [bx, by], [qx, qy]) = (&a[..], &b[..], &q[..]) {
        return angle([*qx, *qy], [*ax, *ay], [*bx, *by]).is_negative();
    }
    filter::angle(a, b, q).unwrap_or_else(|| exact::angle(a, b, q)).is_negative()
}

/// Whether `q` is strictly inside of the smallest sphere orthogonal to three sites of space that are not on a line.
///
/// Exact for every finite input; false for collinear points. O(1).
#[inline]
pub fn triangle_is_attached(a: Site<3>, b: Site<3>, c: Site<3>, q: Site<3>) -> bool {
    filter::triangle(a, b, c, q).unwrap_or_else(|| exact::triangle([a, b, q, c])).is_negative()
}

/// The squared radius of the smallest sphere orthogonal to all sites of a simplex, correctly rounded; without weights of the
/// smallest one through their points. Negative where weights are large; infinite where no `f64` is as large, and for points
/// that are no simplex. The same bits for every order of the sites.
///
/// O(1): below a microsecond unless coordinates span hundreds of binary orders.
///
/// ```
/// use delone_predicates::squared_radius;
/// let [a, b, c] = [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]].map(|p| (p, 0.0));
/// assert_eq!((squared_radius([a, b]), squared_radius([a, b, c])), (1.0, 2.0));
/// assert_eq!(squared_radius([(a.0, 0.25)]), -0.25);
/// // A third is rounded once.
/// let equilateral = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|p| (p, 0.0));
/// assert_eq!(squared_radius(equilateral), 2.0 / 3.0);
/// ```
pub fn squared_radius<const D: usize, const N: usize>(sites: [Site<D>; N]) -> f64 {
    RadiusScale::ONE.radius(sites)
}

/// The power of two by which coordinates are multiplied before their radii are taken, so that no product leaves the range.
#[derive(Clone, Copy, Debug)]
pub struct RadiusScale {
    factor: f64,
    /// The square of the factor, and of its inverse.
    unit: f64,
    back: f64,
}

impl RadiusScale {
    const ONE: Self = Self { factor: 1.0, unit: 1.0, back: 1.0 };

    /// The best one for points in a box with sides of at most this length.
    pub fn for_box(side: f64) -> Self {
        // Products have eight factors: from 2^60 down to 2^-60 they are far from both ends.
        let exponent = (60 - ((side.to_bits() >> 52) as i32 - 1023)).clamp(-400, 400);
        let power = |exponent| 2f64.powi(exponent);
        Self { factor: power(exponent), unit: power(2 * exponent), back: power(-2 * exponent) }
    }

    /// [`squared_radius`], sooner for coordinates far from one.
    #[inline]
    pub fn radius<const D: usize, const N: usize>(self, sites: [Site<D>; N]) -> f64 {
        if let [site] = sites[..] {
            return 0.0 - site.1;
        }
        if N > D + 1 {
            return f64::INFINITY;
        }
        let [least, most] = self.bounds(&sites, |x| x);
        self.rounded(&sites, least, most)
    }

    /// The radii of two simplices at once.
    #[inline]
    pub fn radii<const D: usize, const N: usize>(self, [first, second]: [[Site<D>; N]; 2]) -> [f64; 2] {
        if N == 1 || N > D + 1 {
            return [self.radius(first), self.radius(second)];
        }
        let both: [([[f64; 2]; D], [f64; 2]); N] = std::array::from_fn(|i| {
            (std::array::from_fn(|axis| [first[i].0[axis], second[i].0[axis]]), [first[i].1, second[i].1])
        });
        let [least, most] = self.bounds(&both, Lanes::new).map(Lanes::to_array);
        [self.rounded(&first, least[0], most[0]), self.rounded(&second, least[1], most[1])]
    }

    /// The least and the greatest number that the squared radius may be rounded to, in the units of this scale; or NaN.
    #[inline]
    fn bounds<T: Copy, L: Lane, const D: usize, const N: usize>(
        self,
        sites: &[([T; D], T); N],
        lane: impl Fn(T) -> L,
    ) -> [L; 2] {
        let last = &sites[N - 1];
        let scaled = |x: T, y: T| Ball::difference(lane(x), lane(y)).scaled(self.factor);
        let Fraction { numerator, denominator } = smallest::<_, D, N>(
            |i, axis| scaled(sites[i].0[axis], last.0[axis]),
            |i, square| square.minus(&scaled(sites[i].1, last.1).scaled(self.factor)),
        );
        // A weight that loses bits here is left to integers.
        let weight = Ball::exactly(lane(last.1) * L::all(self.unit));
        numerator.over(&denominator).scaled(0.25).minus(&weight).bounds()
    }

    /// In the units of the coordinates, if both are the same number.
    #[inline]
    fn rounded<const D: usize, const N: usize>(self, sites: &[Site<D>; N], least: f64, most: f64) -> f64 {
        let (radius, weight) = (least * self.back, sites[N - 1].1);
        let is_kept = radius.is_normal() && radius * self.unit == least;
        let is_whole = weight * self.unit * self.back == weight;
        if least == most && is_kept && is_whole { radius } else { exact::radius(sites) }
    }
}

/// The sign of a difference that a filter or integers have found.
type Side = Sign;
