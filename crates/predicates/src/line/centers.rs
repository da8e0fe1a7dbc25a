//! The center of a circle through three points, and the point with the same power to three sites: floating point,
//! balls, exact. Constructions, so they are rounded, and correctly; nothing is decided by them.
//!
//! Correctly rounded means: each coordinate is the nearest `f64` of the exact one. Rounding keeps order, so corners of a cell that are
//! nearer to each other than a unit in the last place may become one, but seldom change places.

use super::{Line, middle, rounded};
use crate::ball::{Ball, U, two_product, two_sum};
use crate::{Point2, Site, exact};

/// Squares of lengths in this range have products of four factors that are normal numbers.
const LEAST_SQUARE: f64 = 1e-70;
const LARGEST_SQUARE: f64 = 1e70;
/// The products that an area is the difference of are together larger than this: what underflows is nothing beside them.
const LEAST_PRODUCTS: f64 = 1e-280;
/// Products below this one do not overflow in halves of their factors.
const LARGEST_PRODUCTS: f64 = 1e280;
/// An area is at least this share of its products: its error is 2^-39 of it then, which the room in the bounds covers.
const LEAST_SHARE: f64 = 1.0 / 4096.0;
/// Half of the error of n, in u of its terms.
pub(crate) const TERMS_BOUND: f64 = 4.02;
/// The error of d, in u of its products.
pub(crate) const AREA_BOUND: f64 = 5.02;
/// Added to the bound of a numerator's terms, it covers what an underflow may take from them.
const TERMS_FLOOR: f64 = 1e-300;

/// The center of the circle through three points that are not collinear. In coordinate units, correctly rounded: each coordinate
/// is the nearest `f64` of the exact one, so the same bits for every order of the points, and for four points on one circle
/// whichever three are asked.
///
/// `None` if it is too far away for an `f64`, and for collinear points. O(1).
///
/// ```
/// use delone_predicates::circumcenter;
/// assert_eq!(circumcenter([0.0, 0.0], [2.0, 0.0], [0.0, 2.0]), Some([1.0, 1.0]));
/// assert_eq!(circumcenter([0.0, 0.0], [1.0, 1.0], [2.0, 2.0]), None);
/// // Almost on a line: floating point alone would lose the center.
/// assert_eq!(circumcenter([-1.0, 0.0], [1.0, 0.0], [0.0, 1e-20]), Some([0.0, -5e19]));
/// ```
#[inline]
pub fn circumcenter(a: Point2, b: Point2, c: Point2) -> Option<Point2> {
    in_floating_point(a, b, c).or_else(|| slowly([a, b, c]))
}

/// The fast way, if it surely gives the nearest numbers.
///
/// The offset from a corner is n / 2d. Differences, products and sums have one rounding each, the inverse of d and the product with n
/// one more each.
#[inline]
fn in_floating_point(a: Point2, b: Point2, c: Point2) -> Option<Point2> {
    let (bx, by, cx, cy) = (b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]);
    let (left, right) = (bx * cy, by * cx);
    let (area, size) = (left - right, left.abs() + right.abs());
    let (bb, cc) = (bx * bx + by * by, cx * cx + cy * cy);
    let (x, y) = (cy * bb - by * cc, bx * cc - cx * bb);
    let terms_x = cy.abs() * bb + by.abs() * cc + TERMS_FLOOR;
    let terms_y = cx.abs() * bb + bx.abs() * cc + TERMS_FLOOR;
    let (half, whole) = (0.5 / area, 1.0 / area.abs());
    let (x, y) = (x * half, y * half);
    let off = |terms: f64, offset: f64| {
        U * (whole * (TERMS_BOUND * terms + AREA_BOUND * offset * size) + 3.0 * offset)
    };
    let squares = LEAST_SQUARE..LARGEST_SQUARE;
    // Without branches up to here, because nothing predicts them.
    if squares.contains(&bb)
        && squares.contains(&cc)
        && size > LEAST_PRODUCTS
        && area.abs() > size * LEAST_SHARE
        && let Some(x) = Ball::around_sum(a[0], x, off(terms_x, x.abs())).nearest()
        && let Some(y) = Ball::around_sum(a[1], y, off(terms_y, y.abs())).nearest()
    {
        return Some([x, y]);
    }
    None
}

/// Two points at one height have the center above their middle, which is often half way between two numbers; a right angle has it
/// in the middle of the side across. No precision would settle these.
#[inline(never)]
fn slowly(points: [Point2; 3]) -> Option<Point2> {
    let [a, b, c] = points;
    if a == b || b == c || c == a {
        return None;
    }
    let sides = [(a, b), (b, c), (c, a)].map(|(p, q)| Line::Bisector(p, q));
    let known = [0, 1].map(|axis| sides.iter().find_map(|side| side.fixed(axis)));
    rounded::meeting(&Line::Bisector(a, b), &Line::Bisector(a, c), known)
        .or_else(|| of_right_angle(points))
        .or_else(|| exact::circumcenter(a, b, c).filter(|center| center.iter().all(|x| x.is_finite())))
}

/// The middle of the longest side, if the angle across is exactly a right one, as far as products of two `f64`s tell.
fn of_right_angle([a, b, c]: [Point2; 3]) -> Option<Point2> {
    let right = |&(o, p, q): &(Point2, Point2, Point2)| {
        let differences =
            [(p[0], o[0]), (q[0], o[0]), (p[1], o[1]), (q[1], o[1])].map(|(x, y)| two_sum(x, -y));
        let [x, z, y, w] = differences.map(|difference| difference.0);
        let (m, n) = (two_product(x, z), two_product(y, w));
        let in_range = |p: f64| (LEAST_PRODUCTS..LARGEST_PRODUCTS).contains(&p.abs());
        let is_exact = differences.iter().all(|difference| difference.1 == 0.0) && in_range(m.0);
        is_exact && m.0 == -n.0 && m.1 == -n.1
    };
    let (_, p, q) = [(a, b, c), (b, c, a), (c, a, b)].into_iter().find(right)?;
    Some([middle(p[0], q[0])?, middle(p[1], q[1])?])
}

/// The point that has the same power to three sites whose points are not collinear: the Voronoi vertex of power diagrams. In
/// coordinate units, correctly rounded, so the same bits for every order of the sites.
///
/// `None` if it is too far away for an `f64`, and for collinear points. O(1).
///
/// ```
/// use delone_predicates::power_center;
/// let (a, b, c) = (([0.0, 0.0], 0.0), ([2.0, 0.0], 0.0), ([0.0, 2.0], 0.0));
/// assert_eq!(power_center(a, b, c), Some([1.0, 1.0]));
/// assert_eq!(power_center(a, ([2.0, 0.0], 2.0), c), Some([0.5, 1.0])); // further from the heavy one
/// ```
pub fn power_center(a: Site<2>, b: Site<2>, c: Site<2>) -> Option<Point2> {
    if a.1 == b.1 && b.1 == c.1 {
        return circumcenter(a.0, b.0, c.0);
    }
    if a.0 == b.0 || b.0 == c.0 || c.0 == a.0 {
        return None;
    }
    let sides = [(a, b), (b, c), (c, a)].map(|(p, q)| Line::Radical(p, q));
    let known = [0, 1].map(|axis| sides.iter().find_map(|side| side.fixed(axis)));
    rounded::meeting(&Line::Radical(a, b), &Line::Radical(a, c), known)
        .or_else(|| exact::power::power_center(a, b, c).filter(|center| center.iter().all(|x| x.is_finite())))
}

#[cfg(test)]
mod tests {
    use super::{circumcenter, in_floating_point, of_right_angle};
    use crate::exact;
    use delone_generators::Kind;

    #[test]
    fn a_center_too_far_away_is_none() {
        let [a, b, c] =
            [[9e-310, 0.0], [0.0, -9.006_755_220_184_234e30], [3e-310, -1.801_351_044_036_846_7e31]];
        assert_eq!(circumcenter(a, b, c), None);
    }

    #[test]
    fn every_way_gives_the_exact_center_rounded() {
        let (mut all, mut fast) = (0, 0);
        for &kind in Kind::ALL {
            let points = kind.points(3000, 1);
            // As they are, and moved to where they are small beside their coordinates.
            let far = points.iter().map(|p| p.map(|x| x / 64.0 + 1.0));
            let all_points: Vec<[f64; 2]> = points.iter().copied().chain(far).collect();
            for p in all_points.chunks_exact(3) {
                let exact = exact::circumcenter(p[0], p[1], p[2]);
                let expected = exact.filter(|center| center.iter().all(|x| x.is_finite()));
                assert_eq!(circumcenter(p[0], p[1], p[2]), expected, "{kind:?} {p:?}");
                if let Some(found) = in_floating_point(p[0], p[1], p[2]) {
                    assert_eq!(Some(found), expected, "{kind:?} {p:?}");
                    fast += 1;
                }
                all += 1;
            }
        }
        assert!(fast > all / 6, "only {fast} of {all} centers came from floating point");
    }

    #[test]
    fn the_fast_way_is_taken_where_nothing_cancels() {
        // Of places about 100 times as far away as the triangle is large.
        let triangle = |size: f64| {
            [[101.0, 99.0], [103.0, 99.5], [101.5, 101.125]].map(|p: [f64; 2]| p.map(|x| x * size))
        };
        for exponent in [0, -100, 100] {
            let [a, b, c] = triangle(2f64.powi(exponent));
            assert!(in_floating_point(a, b, c).is_some(), "{exponent}");
            // A five thousandth of the products is not enough.
            let flat = [102.75, 99.4377].map(|x| x * 2f64.powi(exponent));
            assert_eq!(in_floating_point(a, b, flat), None, "{exponent}");
            // Nor is a place where numbers are as dense as errors are large.
            let near = [a, b, c].map(|p| [p[0] - a[0], p[1] - a[1]]);
            assert_eq!(in_floating_point(near[0], near[1], near[2]), None, "{exponent}");
        }
        for exponent in [-120, 120] {
            let [a, b, c] = triangle(2f64.powi(exponent));
            assert_eq!(in_floating_point(a, b, c), None);
        }
    }

    #[test]
    fn right_angles_are_seen_where_products_tell() {
        let from = 1.0 + f64::EPSILON;
        let (o, p, q) = ([from, 1.0], [from + 0.75, 2.25], [from - 1.25, 1.75]);
        for [a, b, c] in [[o, p, q], [q, o, p], [p, q, o]] {
            assert_eq!(of_right_angle([a, b, c]), Some([from - 0.25, 2.0]));
        }
        assert_eq!(of_right_angle([[0.0, 0.0], [3.0, 4.0], [-8.0, 6.0]]), Some([-2.5, 5.0]));
        assert_eq!(of_right_angle([[0.0, 0.0], [3.0, 4.0], [-8.0, 6.0_f64.next_up()]]), None);
        assert_eq!(of_right_angle([[0.0, 0.0], [3e-200, 4e-200], [-8e-200, 6e-200]]), None);
    }

    #[test]
    fn centers_beyond_the_range_are_none() {
        assert_eq!(circumcenter([-1e200, 0.0], [1e200, 0.0], [0.0, 1e-20]), None);
        assert_eq!(circumcenter([-1e-200, 0.0], [1e-200, 0.0], [0.0, 1e-200]), Some([0.0, 0.0]));
        // Differences that are subnormal: their products lose bits, or all of them.
        let [near, far] = [1.25e-309, 1.981_116_490_576_4e-310];
        let center = circumcenter([near, 1e-4], [near, -1e-4], [far, 3.981_071_705_534_969_5e-5]);
        assert_eq!(center, Some([4.000_000_000_000_001e300, 0.0]));
        assert_eq!(circumcenter([1e300, 0.0], [0.0, 1e300], [0.0, 0.0]), Some([5e299, 5e299]));
        // A middle whose sum is too large for a number.
        let far = 1.7e308;
        let middle = far / 2.0 + 1.6e308 / 2.0;
        assert_eq!(circumcenter([far, 0.0], [far, 2.0], [1.6e308, 0.0]), Some([middle, 1.0]));
    }
}
