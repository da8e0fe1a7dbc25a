//! Whether a point is in the lune of a segment, which decides the edges of proximity graphs: filter, exact. In up to three
//! dimensions.
//!
//! Source: Kirkpatrick and Radke, "A framework for computational morphology", 1985. The lune of a, b for beta >= 1 is the
//! meeting of two balls of radius beta |ab| / 2: one has a on its border and its center on the ray from a through b, the other
//! the same with a and b exchanged. For beta = 1 both are the ball with diameter ab, for beta = 2 they go around a and b. With
//! u = p - a and v = b - a, p is inside of the first where |u - beta v / 2|^2 < |beta v / 2|^2, which is
//!
//! ```text
//! |u|^2 < beta u.v
//! ```
//!
//! and inside of the second where |u - v|^2 < beta (v - u).v. Degree two, and one factor.
//!
//! The smallest ball around a lune is about the middle of ab, and its border goes through the edge where those of the two
//! balls meet. Its equation is the sum of theirs, so what both inequalities together exclude is surely outside of it.
//!
//! Filter: a product of two rounded differences is wrong by 3u of itself, sums of three by 2u more, the factor, and the last
//! difference, by u each: 7u of the sum of all magnitudes, for which [`told`] allows 8u. What underflow loses, at most beta
//! times three of the least numbers, is as nothing beside u times a size of beta 1e-290. All differences are scaled by the power
//! of two that brings v near to one, so that segments of any length are alike; those beyond 2^400 are cut off there, where every
//! lune has ended (those of larger beta than 2^300 are taken as they are).

use crate::distance::{ERROR, angle_at, told};
use crate::{Sign, exact};

/// Below beta times this a size could be wrong by more than the error bound.
pub(crate) const SMALLEST: f64 = 1e-290;

/// The lune of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lune<const D: usize> {
    a: [f64; D],
    b: [f64; D],
    beta: f64,
    scale: Scale,
    /// From a to b, scaled.
    v: [f64; D],
}

/// The factor of differences of coordinates that brings those of a segment's ends near to one.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Scale {
    /// A power of two, at most one: of what is long, before it is subtracted, or the difference might be too large.
    before: f64,
    /// A power of two, at least one: of what is short, after it was subtracted, or it might be too large before.
    after: f64,
    /// Where differences are cut off.
    most: f64,
}

impl Scale {
    /// For a larger beta nothing is scaled.
    const LARGEST_BETA: f64 = f64::from_bits((1023 + 300) << 52);

    #[inline]
    fn of<const D: usize>(a: &[f64; D], b: &[f64; D], beta: f64) -> Self {
        if beta > Self::LARGEST_BETA {
            return Self { before: 1.0, after: 1.0, most: f64::INFINITY };
        }
        let length = (0..D).fold(0.0f64, |most, k| most.max((0.5 * b[k] - 0.5 * a[k]).abs()));
        let exponent = ((length.to_bits() >> 52) as i64 - 1022).clamp(-1000, 1000);
        let power = |exponent: i64| f64::from_bits(((1023 + exponent) as u64) << 52);
        Self { before: power((-exponent).min(0)), after: power((-exponent).max(0)), most: power(400) }
    }

    #[inline]
    fn difference(&self, to: f64, from: f64) -> f64 {
        ((to * self.before - from * self.before) * self.after).max(-self.most).min(self.most)
    }
}

/// Where a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LunePlace {
    /// Strictly inside of the lune.
    Inside,
    /// Not inside; it may be in the smallest ball around the lune.
    Beside,
    /// Surely outside of the smallest ball around the lune. What is far away is told so, what is near its border may not.
    Away,
}

impl<const D: usize> Lune<D> {
    /// Of the segment from `a` to `b`, which differ; `beta` is finite and at least 1.
    #[inline]
    pub fn new(a: [f64; D], b: [f64; D], beta: f64) -> Self {
        let scale = Scale::of(&a, &b, beta);
        Self { a, b, beta, scale, v: std::array::from_fn(|k| scale.difference(b[k], a[k])) }
    }

    /// Where a point is. Exact in whether it is inside, for every finite input. O(1).
    ///
    /// ```
    /// use delone_predicates::{Lune, LunePlace};
    /// let lune = Lune::new([0.0, 0.0], [4.0, 0.0], 2.0);
    /// assert_eq!(lune.place(&[2.0, 3.0]), LunePlace::Inside);
    /// assert_eq!(lune.place(&[4.0, 0.0]), LunePlace::Beside);
    /// assert_eq!(lune.place(&[2.0, 4.0]), LunePlace::Away);
    /// ```
    #[inline]
    pub fn place(&self, p: &[f64; D]) -> LunePlace {
        let (one, one_size) = self.ball_terms(&self.a, p, 1.0);
        let (two, two_size) = self.ball_terms(&self.b, p, -1.0);
        let least = self.beta * SMALLEST;
        if one_size >= least && two_size >= least {
            // The error of the sum is that of both.
            let (sum, size) = (one + two, one_size + two_size);
            if sum < -ERROR * size && size.is_finite() {
                return LunePlace::Away;
            }
            let signs = (told(one, one_size), told(two, two_size));
            match signs {
                (Some(Sign::Positive), Some(Sign::Positive)) => return LunePlace::Inside,
                (Some(Sign::Negative), _) | (_, Some(Sign::Negative)) => return LunePlace::Beside,
                _ => {}
            }
        }
        let is_in = |from, to| exact::lengths::ball(from, to, *p, self.beta).is_positive();
        if is_in(self.a, self.b) && is_in(self.b, self.a) { LunePlace::Inside } else { LunePlace::Beside }
    }

    /// Whether surely no point of a box is inside, because the box is outside of one of the two balls. Of boxes that hardly are,
    /// it is not told. O(1).
    ///
    /// ```
    /// use delone_predicates::Lune;
    /// let lune = Lune::new([0.0, 0.0], [4.0, 0.0], 2.0);
    /// assert!(lune.is_clear_of(&[4.5, -9.0], &[9.0, 9.0]));
    /// assert!(!lune.is_clear_of(&[3.5, -9.0], &[9.0, 9.0]));
    /// ```
    pub fn is_clear_of(&self, low: &[f64; D], high: &[f64; D]) -> bool {
        let is_beyond = |from: &[f64; D], sign: f64| {
            let (mut least, mut size) = (0.0, 0.0);
            for k in 0..D {
                // Of u^2 - beta u v the least is at beta v / 2, or as near to it as the box goes.
                let v = self.beta * sign * self.v[k];
                let [low, high] = [low[k], high[k]].map(|x| self.scale.difference(x, from[k]));
                let u = (0.5 * v).max(low).min(high);
                least += u * (u - v);
                size += u.abs() * (u.abs() + v.abs());
            }
            // Where u is, is wrong by as much as it is rounded, and the product by twice that.
            least > 4.0 * ERROR * size && size >= self.beta * SMALLEST && size.is_finite()
        };
        is_beyond(&self.a, 1.0) || is_beyond(&self.b, -1.0)
    }

    /// beta u.v - |u|^2, scaled, and the sum of the magnitudes of its products: of the ball at an end, for the other one with the
    /// sign of v turned.
    #[inline]
    fn ball_terms(&self, from: &[f64; D], p: &[f64; D], sign: f64) -> (f64, f64) {
        let (mut dot, mut size, mut square) = (0.0, 0.0, 0.0);
        for k in 0..D {
            let u = self.scale.difference(p[k], from[k]);
            let product = u * self.v[k];
            dot += product;
            size += product.abs();
            square += u * u;
        }
        (self.beta * sign * dot - square, self.beta * size + square)
    }
}

/// Whether the closed ball with diameter ab holds a point: whether a and b are seen from it at a right angle or a wider one.
///
/// Exact for every finite input, in up to three dimensions. O(1).
///
/// ```
/// use delone_predicates::in_diametral_ball;
/// assert!(in_diametral_ball([0.0, 0.0], [2.0, 0.0], [1.0, 1.0]));
/// assert!(!in_diametral_ball([0.0, 0.0], [2.0, 0.0], [1.0, 1.0 + 1e-15]));
/// ```
#[inline]
pub fn in_diametral_ball<const D: usize>(a: [f64; D], b: [f64; D], p: [f64; D]) -> bool {
    !angle_at(p, a, b).is_positive()
}
