//! Whether a segment has a point that a vertex is the rounding of: 1-ulp boxes, exact.
//!
//! Where segments are split at rounded crossings, one that passes through the cell of a rounded point goes through that point
//! too: else edges that nearly coincide cross again and again (Hobby, "Practical segment intersection with finite precision
//! output", CGTA 1999, for the cells of a uniform grid).

use crate::exact::big;
use crate::exact::big_int::BigInt;
use crate::{Point2, Sign, orient2d};

/// Whether some point of the segment between two different points is rounded to a third one, each coordinate to the nearest
/// `f64`, ties to even.
///
/// Exact for every finite input. O(1), mostly four orientation tests.
///
/// ```
/// use delone_predicates::segment_rounds_to;
/// let near = 0.5 + f64::EPSILON / 8.0; // what rounds to 0.5 reaches further up than this
/// assert!(segment_rounds_to([0.0, near], [1.0, near], [0.25, near]));
/// assert!(!segment_rounds_to([0.0, 0.0], [1.0, 1.0], [0.25, 0.5]));
/// ```
pub fn segment_rounds_to(a: Point2, b: Point2, v: Point2) -> bool {
    let [low, high] = [v.map(f64::next_down), v.map(f64::next_up)];
    let apart = |k: usize| a[k].max(b[k]) < low[k] || a[k].min(b[k]) > high[k];
    if apart(0) || apart(1) {
        return false;
    }
    if low.iter().chain(&high).all(|x| x.is_finite()) {
        let sides = [low, [high[0], low[1]], high, [low[0], high[1]]].map(|corner| orient2d(a, b, corner));
        if sides.iter().all(|&side| side == sides[0] && side != Sign::Zero) {
            return false;
        }
    }
    passes(a, b, v)
}

/// A part of the way along a segment, with a positive denominator, and whether it belongs to an interval that it bounds.
type Bound = (BigInt, BigInt, bool);

/// The later of two beginnings, or of two ends turned around.
fn inner(p: Bound, q: Bound, turned: bool) -> Bound {
    let order = (&p.0 * &q.1).cmp(&(&q.0 * &p.1));
    match if turned { order.reverse() } else { order } {
        std::cmp::Ordering::Greater => p,
        std::cmp::Ordering::Less => q,
        std::cmp::Ordering::Equal => {
            let closed = p.2 && q.2;
            (p.0, p.1, closed)
        }
    }
}

fn passes(a: Point2, b: Point2, v: Point2) -> bool {
    let mut from: Bound = (BigInt::ZERO, BigInt::from(1), true);
    let mut to: Bound = (BigInt::from(1), BigInt::from(1), true);
    for k in 0..2 {
        // The neighbor of the largest number is as far away as the other one.
        let finite = |x: f64| if x.is_finite() { x } else { v[k] };
        let (numbers, _) =
            big::integers(&[a[k], b[k], v[k], finite(v[k].next_down()), finite(v[k].next_up())]);
        let [p, q, middle, below, above] = &numbers[..] else { return false };
        let step = |neighbor: &BigInt, other: &BigInt| {
            if neighbor == middle { (middle + middle) - other } else { neighbor.clone() }
        };
        // Everything doubled: the borders of the cell are between numbers.
        let (low, high) = (middle + step(below, above), middle + step(above, below));
        let (start, way) = (p + p, (q - p) << 1);
        let is_closed = v[k].to_bits() & 1 == 0;
        let [first, last] = if way < BigInt::ZERO { [&high, &low] } else { [&low, &high] };
        if way == BigInt::ZERO {
            let is_inside =
                if is_closed { low <= start && start <= high } else { low < start && start < high };
            if !is_inside {
                return false;
            }
            continue;
        }
        let part = |border: &BigInt| {
            let (n, d) = (border - &start, way.clone());
            if d < BigInt::ZERO { (-n, -d, is_closed) } else { (n, d, is_closed) }
        };
        from = inner(from, part(first), false);
        to = inner(to, part(last), true);
    }
    match (&from.0 * &to.1).cmp(&(&to.0 * &from.1)) {
        std::cmp::Ordering::Less => true,
        std::cmp::Ordering::Equal => from.2 && to.2,
        std::cmp::Ordering::Greater => false,
    }
}

#[cfg(test)]
mod tests {
    use super::segment_rounds_to;

    /// Points of a segment that are numbers are rounded to themselves, and to nothing else.
    #[test]
    fn cells_are_half_a_step_wide() {
        let (one, up) = (1.0, 1.0_f64.next_up());
        let level = |y: f64, v: f64| segment_rounds_to([0.0, y], [4.0, y], [2.0, v]);
        assert!(level(one, one) && !level(one, up) && !level(up, one) && level(up, up));
        // From one number to its neighbor, through the middle between them in the middle of the way: a tie, to the even one.
        let slope = |x: f64, v: f64| segment_rounds_to([0.0, one], [4.0, up], [x, v]);
        assert!(slope(2.0, one) && slope(1.0, one) && !slope(3.0, one));
        assert!(!slope(1.0, up) && slope(3.0, up));
        // At 2 the cell of the odd one begins beyond the middle, but that of 2.0 is half a step wide itself.
        assert!(slope(2.0, up) && !slope(2.0_f64.next_down().next_down(), up));
        assert!(!segment_rounds_to([0.0, 1.0], [1.0, 1.0], [2.0, 1.0]));
    }

    #[test]
    fn the_ends_of_the_numbers_have_cells() {
        let (most, least) = (f64::MAX, f64::from_bits(1));
        assert!(segment_rounds_to([-most, -most], [most, most], [most, most]));
        assert!(segment_rounds_to([-most, 0.0], [most, most], [most, most]));
        assert!(!segment_rounds_to([-most, 0.0], [most, 0.0], [most, most]));
        assert!(segment_rounds_to([-1.0, -least], [1.0, least], [0.0, 0.0]));
        assert!(segment_rounds_to([-1.0, 0.0], [1.0, least], [0.0, 0.0]));
        assert!(segment_rounds_to([-1.0, 0.0], [1.0, least], [0.0, least]));
        assert!(!segment_rounds_to([-1.0, 0.0], [1.0, least], [-least, least]));
    }
}
