//! Alpha complexes by definition: the smallest sphere orthogonal to the corners of every face is tried against all sites, and
//! sizes are fractions of determinants of scalar products.
//!
//! With u the corners as seen from the last one, G their scalar products and h their squared lengths less differences of weights,
//! the squared distance of the center from that corner is h G^-1 h / 4, a quotient of a bordered determinant and that of G.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use num_bigint::BigInt;

use crate::exact::sign;
use crate::power::{Site, determinant, on_one_scale};

/// A number `numerator / denominator * 2^exponent` with a positive denominator.
#[derive(Clone, Debug)]
pub struct Size {
    numerator: BigInt,
    denominator: BigInt,
    exponent: i64,
}

/// The product of a number and a power of two, and what divides it.
fn shifted(x: &BigInt, exponent: i64) -> [BigInt; 2] {
    let power = BigInt::from(1) << exponent.unsigned_abs();
    if exponent < 0 { [x.clone(), power] } else { [x * power, BigInt::from(1)] }
}

impl Size {
    /// The order of this number and `mantissa * 2^exponent`.
    fn compare(&self, mantissa: &BigInt, exponent: i64) -> Ordering {
        let [mine, divisor] = shifted(&self.numerator, self.exponent - exponent);
        mine.cmp(&(mantissa * &self.denominator * divisor))
    }

    /// The order of two numbers on the same scale.
    fn cmp(&self, other: &Self) -> Ordering {
        (&self.numerator * &other.denominator).cmp(&(&other.numerator * &self.denominator))
    }

    /// Whether this number is rounded to `x`, ties to even.
    pub fn is_rounded_to(&self, x: f64) -> bool {
        if x.is_nan() {
            return false;
        }
        // Numbers are steps of 2^-1075, half of the least one; beyond the largest the next one would be 2^1024.
        let steps = |x: f64| -> BigInt {
            let biased = ((x.to_bits() >> 52) & 0x7ff) as i64;
            let fraction = x.to_bits() & ((1 << 52) - 1);
            let digits = BigInt::from(if biased == 0 { fraction } else { fraction | 1 << 52 });
            let magnitude =
                if biased == 0x7ff { BigInt::from(1) << (1024 + 1075) } else { digits << biased.max(1) };
            if x.is_sign_negative() { -magnitude } else { magnitude }
        };
        let beside = |y: f64, order: Ordering| {
            let middle = steps(x) + steps(y);
            let found = self.compare(&middle, -1076);
            found == order || (found.is_eq() && x.to_bits().is_multiple_of(2))
        };
        (x == f64::NEG_INFINITY || beside(x.next_down(), Ordering::Greater))
            && (x == f64::INFINITY || beside(x.next_up(), Ordering::Less))
    }
}

/// The sites on one scale, and its exponent.
struct Scaled<const D: usize> {
    points: Vec<[BigInt; D]>,
    weights: Vec<BigInt>,
    exponent: i64,
}

impl<const D: usize> Scaled<D> {
    fn new(sites: &[Site<D>]) -> Self {
        let (points, weights, exponent) = on_one_scale(sites);
        Self { points, weights, exponent }
    }

    fn seen(&self, i: usize, from: usize) -> [BigInt; D] {
        std::array::from_fn(|axis| &self.points[i][axis] - &self.points[from][axis])
    }

    fn lift(&self, i: usize, from: usize) -> BigInt {
        let u = self.seen(i, from);
        dot(&u, &u) - (&self.weights[i] - &self.weights[from])
    }

    /// The scalar products of the corners, with a last row and a last column added.
    fn bordered(&self, simplex: &[usize], last_row: &[BigInt]) -> [BigInt; 2] {
        let (&from, others) = simplex.split_last().expect("a corner");
        let rows: Vec<[BigInt; D]> = others.iter().map(|&i| self.seen(i, from)).collect();
        let gram: Vec<Vec<BigInt>> = rows.iter().map(|u| rows.iter().map(|v| dot(u, v)).collect()).collect();
        let lift = |k: usize| self.lift(others[k], from);
        let mut wide: Vec<Vec<BigInt>> =
            gram.iter().enumerate().map(|(k, row)| row.iter().cloned().chain([lift(k)]).collect()).collect();
        wide.push(last_row.iter().cloned().chain([BigInt::ZERO]).collect());
        [determinant(&gram), determinant(&wide)]
    }

    fn size(&self, simplex: &[usize]) -> Size {
        let (&from, others) = simplex.split_last().expect("a corner");
        let lifts: Vec<BigInt> = others.iter().map(|&i| self.lift(i, from)).collect();
        let [gram, bordered] = self.bordered(simplex, &lifts);
        let denominator = gram * 4;
        Size {
            numerator: -bordered - &self.weights[from] * &denominator,
            denominator,
            exponent: 2 * self.exponent,
        }
    }

    /// Whether a site is strictly inside of the smallest sphere orthogonal to a simplex.
    fn is_inside(&self, simplex: &[usize], q: usize) -> bool {
        let (&from, others) = simplex.split_last().expect("a corner");
        let seen = self.seen(q, from);
        let products: Vec<BigInt> = others.iter().map(|&i| dot(&self.seen(i, from), &seen)).collect();
        let [gram, bordered] = self.bordered(simplex, &products);
        sign(&(self.lift(q, from) * gram + bordered)) < 0
    }
}

fn dot(u: &[BigInt], v: &[BigInt]) -> BigInt {
    u.iter().zip(v).map(|(x, y)| x * y).sum()
}

/// The squared radius of the smallest sphere orthogonal to all sites of a simplex.
pub fn squared_radius<const D: usize>(sites: &[Site<D>]) -> Size {
    Scaled::new(sites).size(&(0..sites.len()).collect::<Vec<_>>())
}

/// Whether the last site is strictly inside of that of the others.
pub fn is_inside<const D: usize>(sites: &[Site<D>]) -> bool {
    let last = sites.len() - 1;
    Scaled::new(sites).is_inside(&(0..last).collect::<Vec<_>>(), last)
}

/// All faces of a regular triangulation, given by its simplices of the highest dimension, each with the least squared radius at which
/// it is there: that of its own sphere if no site is inside, or else the least of the faces that it is a facet of.
pub fn complex<const D: usize>(sites: &[Site<D>], simplices: &[Vec<usize>]) -> BTreeMap<Vec<usize>, Size> {
    let scaled = Scaled::new(sites);
    let mut values: BTreeMap<Vec<usize>, Size> = BTreeMap::new();
    let mut layer: BTreeMap<Vec<usize>, Option<Size>> = BTreeMap::new();
    for simplex in simplices {
        let mut simplex = simplex.clone();
        simplex.sort_unstable();
        layer.insert(simplex, None);
    }
    while !layer.is_empty() {
        let mut below: BTreeMap<Vec<usize>, Option<Size>> = BTreeMap::new();
        for (simplex, least) in layer {
            let mut others = (0..sites.len()).filter(|q| !simplex.contains(q));
            let is_attached = least.is_some() && others.any(|q| scaled.is_inside(&simplex, q));
            let size = if is_attached { least.expect("a coface") } else { scaled.size(&simplex) };
            for k in 0..simplex.len() {
                let mut facet = simplex.clone();
                facet.remove(k);
                if facet.is_empty() {
                    continue;
                }
                let known = below.entry(facet).or_insert(None);
                if known.as_ref().is_none_or(|known| size.cmp(known).is_lt()) {
                    *known = Some(size.clone());
                }
            }
            values.insert(simplex, size);
        }
        layer = below;
    }
    values
}

#[cfg(test)]
mod tests {
    use super::{complex, squared_radius};

    #[test]
    fn a_flat_triangle_is_there_before_its_circle_is_small() {
        // Legs of 2 at an obtuse angle: the long side comes with the triangle.
        let sites = [[-4.0, 0.0], [4.0, 0.0], [0.0, 2.0]].map(|p| (p, 0.0));
        let values = complex(&sites, &[vec![0, 1, 2]]);
        let expected: [(&[usize], f64); 7] = [
            (&[0], 0.0),
            (&[0, 1], 25.0),
            (&[0, 1, 2], 25.0),
            (&[0, 2], 5.0),
            (&[1], 0.0),
            (&[1, 2], 5.0),
            (&[2], 0.0),
        ];
        assert_eq!(values.len(), 7);
        for ((simplex, size), (corners, value)) in values.iter().zip(expected) {
            assert_eq!(simplex, corners);
            assert!(size.is_rounded_to(value), "{simplex:?}");
            assert!(!size.is_rounded_to(value.next_up()) && !size.is_rounded_to(value.next_down()));
        }
    }

    #[test]
    fn rounding_is_to_the_nearest() {
        // A quarter of 3 * 2^-1074 is nearer to one step than to none; half a step is rounded to none.
        let edge = |x: f64, w: f64| squared_radius(&[([0.0, 0.0], w), ([x, 0.0], w)]);
        let root = 2f64.powi(-537);
        assert!(edge(root, 0.0).is_rounded_to(0.0), "a quarter of a step");
        assert!(edge(2.0 * root, 0.0).is_rounded_to(f64::from_bits(1)));
        assert!(edge(2f64.powi(600), 0.0).is_rounded_to(f64::INFINITY));
        assert!(edge(2.0, 4.0).is_rounded_to(-3.0) && !edge(2.0, 4.0).is_rounded_to(3.0));
        // (1 + 2^-53) + 2^-106 is above half a step.
        let near = edge(2.0 * (1.0 + f64::EPSILON), 0.0);
        assert!(near.is_rounded_to((1.0 + f64::EPSILON).powi(2)));
    }
}
