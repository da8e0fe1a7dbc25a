//! The centre of a circle through three points: filter, exact. A construction, so it is rounded; nothing is decided
//! by it.

use crate::{Point2, Site, exact};

/// The share of a sum that may cancel before the exact way is taken: 2^-8 leaves more than 40 correct bits.
const CANCELLED: f64 = 1.0 / 256.0;

/// The centre of the circle through three points that are not collinear. In coordinate units; the same bits for
/// every order of the points.
///
/// Triangles that are not flat are computed in floating point, with an error below 2^-40 of the radius. For
/// flat ones, whose centre hangs on the last bits of the corners, and for coordinates whose products leave the range
/// of `f64`, the exact centre is rounded once. `None` if it is too far away for an `f64`, and for collinear points.
///
/// O(1).
///
/// ```
/// use delone_predicates::circumcentre;
/// assert_eq!(circumcentre([0.0, 0.0], [2.0, 0.0], [0.0, 2.0]), Some([1.0, 1.0]));
/// assert_eq!(circumcentre([0.0, 0.0], [1.0, 1.0], [2.0, 2.0]), None);
/// // Almost on a line: floating point alone would lose the centre.
/// assert_eq!(circumcentre([-1.0, 0.0], [1.0, 0.0], [0.0, 1e-20]), Some([0.0, -5e19]));
/// ```
#[inline]
pub fn circumcentre(a: Point2, b: Point2, c: Point2) -> Option<Point2> {
    circumcentre_within(a, b, c, f64::INFINITY)
}

/// The same, rounded once from the exact centre too where the centre is further away than a reach: then the error is
/// 2^-40 of that reach at most, and a rounding.
#[inline]
pub(crate) fn circumcentre_within(a: Point2, b: Point2, c: Point2, reach: f64) -> Option<Point2> {
    in_floating_point(a, b, c, reach).or_else(|| rounded_once(a, b, c))
}

/// The larger of two numbers; `f64::max`, which also knows what is no number, is a call in WebAssembly.
#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The fast way, if it is good enough.
#[inline]
fn in_floating_point(a: Point2, b: Point2, c: Point2, reach: f64) -> Option<Point2> {
    // From the smallest point: of the other two either may be first, which changes two signs that cancel. Without
    // branches, because nothing predicts them.
    let points = [a, b, c];
    let least = usize::from(is_less(b, a));
    let least = if is_less(c, points[least]) { 2 } else { least };
    let [a, b, c] = [least, [1, 2, 0][least], [2, 0, 1][least]].map(|i| points[i]);
    let (bx, by, cx, cy) = (b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]);
    let (left, right) = (bx * cy, by * cx);
    let (area, size) = (left - right, left.abs() + right.abs());
    let (bb, cc) = (bx * bx + by * by, cx * cx + cy * cy);
    let (x, y) = (cy * bb - by * cc, bx * cc - cx * bb);
    let terms = (cy.abs() + cx.abs()) * bb + (by.abs() + bx.abs()) * cc;
    // Products of up to four factors must be normal numbers, or nothing is known about their errors: with one difference
    // near zero also those of two.
    let in_range = (1e-70..1e70).contains(&bb) && (1e-70..1e70).contains(&cc) && size > 1e-280;
    if in_range && area.abs() > CANCELLED * size && larger(x.abs(), y.abs()) > CANCELLED * terms {
        let (x, y) = (x / (2.0 * area), y / (2.0 * area));
        let centre = [a[0] + x, a[1] + y];
        // A quotient of numbers in range may be too large; only the exact centre tells.
        if larger(x.abs(), y.abs()) <= reach && centre[0].is_finite() && centre[1].is_finite() {
            return Some(centre);
        }
    }
    None
}

/// The point that has the same power to three sites whose points are not collinear: the Voronoi vertex of power diagrams. In
/// coordinate units; the same bits for every order of the sites.
///
/// Computed in floating point where nothing cancels, with an error below 2^-40 of the distance from the lexicographically least of
/// the three points, or else rounded once. `None` if it is too far away for an `f64`, and for collinear points.
///
/// O(1).
///
/// ```
/// use delone_predicates::power_centre;
/// let (a, b, c) = (([0.0, 0.0], 0.0), ([2.0, 0.0], 0.0), ([0.0, 2.0], 0.0));
/// assert_eq!(power_centre(a, b, c), Some([1.0, 1.0]));
/// assert_eq!(power_centre(a, ([2.0, 0.0], 2.0), c), Some([0.5, 1.0])); // further from the heavy one
/// ```
pub fn power_centre(a: Site<2>, b: Site<2>, c: Site<2>) -> Option<Point2> {
    power_centre_in_floating_point(a, b, c)
        .or_else(|| exact::power::power_centre(a, b, c).filter(|centre| centre.iter().all(|x| x.is_finite())))
}

/// The fast way, if it is good enough.
fn power_centre_in_floating_point(a: Site<2>, b: Site<2>, c: Site<2>) -> Option<Point2> {
    let sites = [a, b, c];
    let least = usize::from(is_less(b.0, a.0));
    let least = if is_less(c.0, sites[least].0) { 2 } else { least };
    let [(a, wa), (b, wb), (c, wc)] = [least, [1, 2, 0][least], [2, 0, 1][least]].map(|i| sites[i]);
    let (bx, by, cx, cy) = (b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]);
    let (left, right) = (bx * cy, by * cx);
    let (area, size) = (left - right, left.abs() + right.abs());
    let lift = |x: f64, y: f64, weight: f64| (x * x + y * y - weight, x * x + y * y + weight.abs());
    let ((bb, b_size), (cc, c_size)) = (lift(bx, by, wb - wa), lift(cx, cy, wc - wa));
    let (x, y) = (cy * bb - by * cc, bx * cc - cx * bb);
    let terms = (cy.abs() + cx.abs()) * b_size + (by.abs() + bx.abs()) * c_size;
    // As above; what is small beside the terms is not known well enough.
    let in_range = (1e-70..1e70).contains(&b_size) && (1e-70..1e70).contains(&c_size) && size > 1e-280;
    if in_range && area.abs() > CANCELLED * size && larger(x.abs(), y.abs()) > CANCELLED * terms {
        let (x, y) = (x / (2.0 * area), y / (2.0 * area));
        let centre = [a[0] + x, a[1] + y];
        return Some(centre).filter(|centre| centre.iter().all(|x| x.is_finite()));
    }
    None
}

#[inline]
#[expect(clippy::needless_bitwise_bool, reason = "a branch would be mispredicted every other time")]
fn is_less(a: Point2, b: Point2) -> bool {
    (a[0] < b[0]) | ((a[0] == b[0]) & (a[1] < b[1]))
}

#[cold]
#[inline(never)]
fn rounded_once(a: Point2, b: Point2, c: Point2) -> Option<Point2> {
    exact::circumcentre(a, b, c).filter(|centre| centre.iter().all(|x| x.is_finite()))
}

#[cfg(test)]
mod tests {
    use super::{circumcentre, rounded_once};
    use crate::Point2;
    use delone_generators::Kind;

    fn in_floating_point(a: Point2, b: Point2, c: Point2) -> Option<Point2> {
        super::in_floating_point(a, b, c, f64::INFINITY)
    }

    #[test]
    fn a_centre_too_far_away_is_none() {
        let [a, b, c] =
            [[9e-310, 0.0], [0.0, -9.006_755_220_184_234e30], [3e-310, -1.801_351_044_036_846_7e31]];
        assert_eq!(circumcentre(a, b, c), None);
    }

    #[test]
    fn the_fast_way_is_near_the_exact_one() {
        let mut fast = 0;
        for &kind in Kind::ALL {
            for p in kind.points(3000, 1).chunks_exact(3) {
                let (Some(near), Some(exact)) =
                    (circumcentre(p[0], p[1], p[2]), rounded_once(p[0], p[1], p[2]))
                else {
                    continue;
                };
                let radius = (exact[0] - p[0][0]).hypot(exact[1] - p[0][1]);
                let error = (near[0] - exact[0]).hypot(near[1] - exact[1]);
                let rounding = exact[0].abs().max(exact[1].abs()) * f64::EPSILON;
                assert!(error <= radius * 2f64.powi(-40) + rounding, "{kind:?} {p:?}: {near:?}, {exact:?}");
                fast += usize::from(error > 0.0);
            }
        }
        assert!(fast > 100, "only {fast} centres came from floating point");
    }

    #[test]
    fn the_fast_way_is_taken_where_nothing_cancels() {
        let triangle = |size: f64| [[0.0, 0.0], [2.0 * size, 0.5 * size], [0.5 * size, 2.0 * size]];
        for size in [1.0, 1e-30, 1e30] {
            let [a, b, c] = triangle(size);
            assert!(in_floating_point(a, b, c).is_some(), "{size}");
            // An eighth of a sum is left, which is enough; a thousandth is not.
            assert!(in_floating_point(a, b, [1.75 * size, 0.5625 * size]).is_some(), "{size}");
            assert_eq!(in_floating_point(a, b, [1.75 * size, 0.438 * size]), None, "{size}");
        }
        // One side alone leaves the range, and then the other.
        for size in [1e-36, 1e36] {
            assert_eq!(
                in_floating_point([-1.0, -1.0], [size, 2.0 * size], [2.0, 0.25]).is_some(),
                size < 1.0
            );
            let [a, b, c] = triangle(size);
            assert_eq!(in_floating_point(a, b, c), None);
            let other = size.recip();
            assert_eq!(in_floating_point([0.0, 0.0], [size, 0.0], [size, other]), None);
        }
        // The points are taken in the same order, whatever their x coordinates have in common.
        let points = [[0.1, 0.7], [0.1, 0.3], [0.9, 0.2]];
        let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
        let centres = orders.map(|order| {
            let [a, b, c] = order.map(|i| points[i]);
            in_floating_point(a, b, c).expect("an even triangle")
        });
        assert_eq!(centres, [centres[0]; 6]);
    }

    #[test]
    fn the_order_of_the_points_does_not_matter() {
        for &kind in Kind::ALL {
            for p in kind.points(300, 2).chunks_exact(3) {
                let centre = circumcentre(p[0], p[1], p[2]);
                for [i, j, k] in [[0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
                    assert_eq!(circumcentre(p[i], p[j], p[k]), centre);
                }
            }
        }
    }

    #[test]
    fn centres_beyond_the_range_are_none() {
        assert_eq!(circumcentre([-1e200, 0.0], [1e200, 0.0], [0.0, 1e-20]), None);
        assert_eq!(circumcentre([-1e-200, 0.0], [1e-200, 0.0], [0.0, 1e-200]), Some([0.0, 0.0]));
        // Differences that are subnormal: their products lose bits, or all of them.
        let [near, far] = [1.25e-309, 1.981_116_490_576_4e-310];
        let centre = circumcentre([near, 1e-4], [near, -1e-4], [far, 3.981_071_705_534_969_5e-5]);
        assert_eq!(centre, Some([4.000_000_000_000_001e300, 0.0]));
        assert_eq!(circumcentre([1e300, 0.0], [0.0, 1e300], [0.0, 0.0]), Some([5e299, 5e299]));
    }
}
