//! Every constant of the filters, derived again by running the formulas on bounds instead of numbers.

use super::power::{POWER_CIRCLE_BOUND, POWER_SPHERE_BOUND};
use super::space::{
    Filter3, IN_SPHERE_BOUND, ORIENT3D_BOUND, ORIENT3D_CEILING, ORIENT3D_FLOOR, SPHERE_CEILING, SPHERE_FLOOR,
};
use super::{
    Filter, Grid, IN_CIRCLE_BOUND, IN_CIRCLE_BOUND_OF_LENGTHS, ORIENT_BOUND, ORIENT_BOUND_OF_LENGTHS, U,
};

/// A computed quantity: a bound on its magnitude and a bound on its error.
#[derive(Clone, Copy)]
struct Bounded {
    max: f64,
    error: f64,
}

impl Bounded {
    /// The difference of two coordinates at most `side` apart: one rounding.
    fn difference(side: f64) -> Self {
        Self { max: side, error: U * side }
    }

    fn times(self, other: Self) -> Self {
        let max = self.max * other.max;
        let inherited = self.max * other.error + other.max * self.error + self.error * other.error;
        Self { max, error: inherited + U * (max + inherited) }
    }

    fn plus(self, other: Self) -> Self {
        self.plus_at_most(other, self.max + other.max)
    }

    /// A sum (or difference) that geometry bounds better than the sum of the parts.
    fn plus_at_most(self, other: Self, max: f64) -> Self {
        let inherited = self.error + other.error;
        Self { max, error: inherited + U * (max + inherited) }
    }
}

#[test]
fn box_bounds_cover_the_pencil_formulas() {
    for (w, h) in [(1.0, 1.0), (1.0, 1e-9), (1e-9, 1.0), (3e70, 2e-70), (0.3, 0.7)] {
        let (dx, dy) = (Bounded::difference(w), Bounded::difference(h));
        // Twice the area of a triangle in the box is at most w h; |(q-l).(q-r)| is at most w^2 + h^2.
        let cross = dx.times(dy).plus_at_most(dx.times(dy), w * h);
        let dot = dx.times(dx).plus_at_most(dy.times(dy), w * w + h * h);
        let det = dot.times(cross).plus(dot.times(cross));
        let filter = Filter::for_box(w, h, None);
        assert!(cross.error <= 8.0 * U * w * h * (1.0 + 1e-9), "{w} {h}");
        assert!(det.error <= 28.0 * U * w * h * (w * w + h * h) * (1.0 + 1e-9), "{w} {h}");
        assert!(cross.error < filter.orient && filter.orient < cross.error * 1.5 + 1e-300);
        assert!(det.error < filter.circle && filter.circle < det.error * 1.5 + 1e-160);
    }
}

/// The bounds taken from the operands are relative to a sum of absolute values that is itself computed, so
/// the analysis runs on one term of magnitude 1: differences with relative error u each.
#[test]
fn operand_bounds_cover_their_formulas() {
    let difference = Bounded { max: 1.0, error: U };
    let product = difference.times(difference); // 3u, relative to the exact product
    // Orientation: two products and one subtraction; the rounding of the subtraction is relative to the
    // result, so it moves only the point of comparison: 3u (1 + a few u) of the computed sum.
    let orient = product.error * (1.0 + 4.0 * U);
    assert!(orient <= ORIENT_BOUND * (1.0 - 2.0 * U) + 8.0 * U * U, "{orient:e}");
    // In-circle: lift (3u + u) times cross (3u + u), one product (u), two additions (2u): 10u where the last
    // rounding is relative to the result again.
    let lift = product.error + U * (1.0 + product.error);
    let cross = lift;
    let term = lift + cross + lift * cross + U;
    let sum = term + U * (1.0 + term);
    assert!(sum <= IN_CIRCLE_BOUND * (1.0 + 8.0 * U), "{} u", sum / U);
    // What bounds the permanents of lengths may be computed too small: squares by 2u (each of their products by u, the sum by u), of two
    // squares half the sum by u more, of three the sum of their products by 4u for the squares, u for the products, 2u for the sums.
    assert!(orient / 2.0 <= ORIENT_BOUND_OF_LENGTHS * (1.0 - 3.0 * U) - 8.0 * U * U);
    assert!(sum <= IN_CIRCLE_BOUND_OF_LENGTHS * (1.0 - 7.0 * U) - 64.0 * U * U);
    // With weights: a difference of weights has less error than the squares, and is subtracted: u once more.
    let lift = lift + U * (1.0 + lift);
    let term = lift + cross + lift * cross + U;
    let sum = term + U * (1.0 + term);
    assert!(sum <= POWER_CIRCLE_BOUND * (1.0 + 8.0 * U), "{} u", sum / U);
    assert!(sum >= POWER_CIRCLE_BOUND * 0.95, "the bound is far too large: {} u", sum / U);
}

#[test]
fn grids_are_found() {
    let grid = |x: &[f64]| Grid::of(x).map(|g| g.step);
    assert_eq!(grid(&[3.0, 5.0, -8.0]), Some(1.0));
    assert_eq!(grid(&[4.0, 12.0, 0.0]), Some(4.0));
    assert_eq!(grid(&[0.25, 7.0]), Some(0.25));
    assert_eq!(grid(&[0.1, 7.0]), None);
    assert_eq!(grid(&[1e300, 1e300]), None);
    assert_eq!(grid(&[0.0]), Some(2f64.powi(200)));
    assert_eq!(grid(&[f64::from_bits(1)]), None);
    assert_eq!(grid(&[9_007_199_254_740_992.0, 1.0]), Some(1.0));
    assert_eq!(grid(&[9_007_199_254_740_994.0, 1.0]), None);
}

#[test]
fn what_comes_late_is_noticed() {
    let integers: Vec<f64> = (0..3000).map(|i| f64::from(i % 17) - 8.0).collect();
    assert_eq!(Grid::of(&integers).map(|g| g.step), Some(1.0));
    for at in [0, 511, 512, 1700, 2999] {
        let largest = 9_007_199_254_740_992.0;
        for (late, step) in [
            (0.5, Some(0.5)),
            (-7.25, Some(0.25)),
            (0.1, None),
            (2f64.powi(-50), Some(2f64.powi(-50))),
            (-largest, Some(1.0)),
            (largest + 2.0, None),
            (largest / 4.0 + 0.5, Some(0.5)),
            (f64::from_bits(1), None),
        ] {
            let mut coordinates = integers.clone();
            coordinates[at] = late;
            assert_eq!(Grid::of(&coordinates).map(|g| g.step), step, "{late} at {at}");
            let holds = Grid::of(&[1.0]).is_some_and(|grid| grid.holds_all(&coordinates));
            assert_eq!(holds, step == Some(1.0), "{late} at {at}");
        }
    }
}

/// All exponents with all kinds of mantissas, against the definition: a number is m 2^e with m odd, and on a lattice of
/// step 2^s up to 2^53 steps if e >= s and |x| <= 2^(s + 53).
#[test]
fn a_grid_holds_its_own_points_and_no_others() {
    let mantissas =
        (0..=52).map(|k| 1_u64 << k >> 1).flat_map(|bit| [bit, bit | 1 << 51, bit | 1, !0 << 12 >> 12]);
    let mantissas: Vec<u64> = mantissas.collect();
    let all = (0..0x7ff_u64).flat_map(|e| mantissas.iter().map(move |m| f64::from_bits(e << 52 | m)));
    let odd_exponent = |x: f64| {
        let (biased, fraction) = ((x.to_bits() >> 52) as i32, x.to_bits() & ((1 << 52) - 1));
        let mantissa = if biased == 0 { fraction } else { fraction | 1 << 52 };
        biased.max(1) - 1075 + mantissa.trailing_zeros() as i32
    };
    let steps: Vec<i32> = (-200..=200).step_by(25).chain([-199, -1, 1, 199]).collect();
    for x in all {
        for &s in &steps {
            let grid = Grid { step: super::power_of_two(s) };
            let on = x == 0.0 || (odd_exponent(x) >= s && x <= super::power_of_two(s + 53));
            for x in [x, -x] {
                assert_eq!(grid.holds(x), on, "{x:e} on 2^{s}");
                assert_eq!(grid.holds_all(&[x, 0.0, grid.step]), on, "{x:e} on 2^{s}");
            }
            // The lattice of the number itself and the step.
            let exponent = odd_exponent(x).min(s);
            let fits = exponent >= -200 && x.max(grid.step) <= super::power_of_two(exponent.max(-200) + 53);
            let expected = if x == 0.0 { Some(s) } else { fits.then_some(exponent) };
            assert_eq!(
                Grid::of(&[x, grid.step]).map(|g| g.step),
                expected.map(super::power_of_two),
                "{x:e} 2^{s}"
            );
        }
    }
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(!Grid { step: 1.0 }.holds(x) && !Grid { step: 1.0 }.holds_all(&[x]));
    }
}

#[test]
fn small_boxes_of_a_grid_are_exact() {
    let grid = Grid::of(&[1.0, 2.0]);
    assert!(Filter::for_box(4000.0, 4000.0, grid).exact);
    assert!(!Filter::for_box(8000.0, 8000.0, grid).exact);
    assert!(!Filter::for_box(f64::INFINITY, 1.0, grid).exact);
}

#[test]
fn no_grid_is_missed_that_would_make_a_box_exact() {
    for step in [1.0, 0.125, 1024.0] {
        for (w, h) in [(1.0, 1.0), (3000.0, 5000.0), (6688.0, 6688.0), (1e6, 200.0), (1e9, 0.5), (1e9, 0.0)] {
            let (w, h) = (w * step, h * step);
            let grid = Grid::of(&[step, 3.0 * step]);
            let coarse = Grid::coarser_than(Filter::finest_step(w, h), &[step, 3.0 * step]);
            assert_eq!(Filter::for_box(w, h, grid), Filter::for_box(w, h, coarse), "{step} {w} {h}");
        }
    }
    assert_eq!(Grid::coarser_than(0.5, &[1.0, 0.25]), None);
    assert_eq!(Grid::coarser_than(0.5, &[1.0, 0.5]), Grid::of(&[0.5]));
    assert_eq!(Grid::coarser_than(f64::INFINITY, &[0.0]), Grid::of(&[0.0]));
}

#[test]
fn a_filter_without_room_decides_nothing() {
    let filter = Filter::for_box(1e300, 1e300, None);
    assert_eq!(filter.circle(f64::MAX), None);
    assert_eq!(filter.circle(f64::NAN), None);
    let tiny = Filter::for_box(1e-200, 1e-200, None);
    assert_eq!(tiny.circle(0.0), None);
    assert_eq!(tiny.orient(f64::MIN_POSITIVE / 2.0), None);
}

#[test]
fn the_orientation_bound_in_space_covers_its_formula() {
    // In units of the largest difference; the permanent of differences of at most 1 is at most 6.
    let d = Bounded::difference(1.0);
    let term = d.times(d.times(d).plus(d.times(d)));
    // The rounding of the last sum does not change its sign.
    let error = term.plus(term).error + term.error;
    // The computed permanent may be smaller than the true one by its own relative error.
    assert!(error <= ORIENT3D_BOUND * 6.0 * (1.0 - 8.0 * U), "{:e}", error / U / 6.0);
    assert!(error >= ORIENT3D_BOUND * 6.0 * 0.9, "the bound is far too large");
}

#[test]
fn the_in_sphere_bound_covers_its_formula() {
    // As above: minors of two and of three columns, squared lengths, four products.
    let d = Bounded::difference(1.0);
    let minor = d.times(d).plus(d.times(d));
    let three = d.times(minor).plus(d.times(minor)).plus(d.times(minor));
    let lift = d.times(d).plus(d.times(d)).plus(d.times(d));
    let term = lift.times(three);
    let error = 2.0 * term.plus(term).error;
    assert!(error <= IN_SPHERE_BOUND * 72.0 * (1.0 - 16.0 * U), "{} u", error / U / 72.0);
    assert!(error >= IN_SPHERE_BOUND * 72.0 * 0.7, "the bound is far too large: {} u", error / U / 72.0);
    // With weights, which have less error than the squares.
    for weights in [0.0, 0.5, 3.0, 100.0] {
        let term = lift.plus(Bounded::difference(weights)).times(three);
        let (error, permanent) = (2.0 * term.plus(term).error, 24.0 * (3.0 + weights));
        assert!(error <= POWER_SPHERE_BOUND * permanent * (1.0 - 16.0 * U), "{} u", error / U / permanent);
        assert!(weights > 0.0 || error >= POWER_SPHERE_BOUND * permanent * 0.7, "the bound is far too large");
    }
}

/// Minors of two rows, those with what a third row gives, and four products: the same bounds.
#[test]
fn the_bounds_in_space_cover_the_bundle_formulas() {
    let d = Bounded::difference(1.0);
    for weights in [None, Some(0.0), Some(0.5), Some(3.0), Some(100.0)] {
        let square = d.times(d).plus(d.times(d)).plus(d.times(d));
        let lift = weights.map_or(square, |most| square.plus(Bounded::difference(most)));
        let minor = d.times(d).plus(d.times(d));
        let lifted = d.times(lift).plus(lift.times(d));
        // The last sum's rounding does not change the sign, and its second operand is a product.
        let volume = minor.times(d).plus(minor.times(d));
        let orientation = volume.error + minor.times(d).error;
        assert!(orientation <= ORIENT3D_BOUND * 6.0 * (1.0 - 8.0 * U), "{} u", orientation / U / 6.0);
        let volume = volume.plus(minor.times(d));
        let factor = minor.times(lift).plus(lifted.times(d)).plus(lifted.times(d));
        let pair = factor.times(d).plus(factor.times(d));
        let other = factor.times(d).plus(volume.times(lift));
        // The rounding of the last sum does not change its sign.
        let (error, permanent) = (pair.error + other.error, 24.0 * lift.max);
        let bound = if weights.is_some() { POWER_SPHERE_BOUND } else { IN_SPHERE_BOUND };
        assert!(error <= bound * permanent * (1.0 - 16.0 * U), "{} u", error / U / permanent);
        let is_near = weights > Some(0.0) || error >= 0.7 * bound * permanent;
        assert!(is_near, "the bound is far too large: {} u", error / U / permanent);
    }
}

#[test]
fn small_boxes_of_a_grid_in_space_are_exact() {
    let grid = Grid::of(&[1.0, 2.0]);
    let exact = |x: f64| Filter3::for_box([x, x, x], grid) == Filter3::for_box([1.0; 3], grid);
    assert!(exact(500.0));
    assert!(!exact(1000.0));
    assert!(!exact(f64::INFINITY));
    // 24 x y z (x^2 + y^2 + z^2) below 4e15 steps, in boxes of any shape.
    for step in [0.25, 1.0, 8.0] {
        let grid = Grid::of(&[step]);
        let exact = |sides: [f64; 3]| {
            Filter3::for_box(sides.map(|x| x * step), grid) == Filter3::for_box([step; 3], grid)
        };
        assert!(exact([550.0; 3]) && !exact([570.0; 3]), "{step}");
        for k in 0..3 {
            let long = |x: f64, other: f64| std::array::from_fn(|i| if i == k { x } else { other });
            for thin in [0.0, 1.0] {
                assert!(exact(long(55_000.0, thin)) && !exact(long(55_100.0, thin)), "{step} {k} {thin}");
            }
            assert!(exact(long(1.0, 2800.0)) && !exact(long(1.0, 3100.0)), "{step} {k}");
        }
    }
}

/// The bounds above are relative to the unit roundoff, which is told here, with the powers of two in the comments.
#[test]
fn constants_are_what_they_are_said_to_be() {
    let u = 2f64.powi(-53);
    assert_eq!(U, u);
    assert_eq!((ORIENT_BOUND, IN_CIRCLE_BOUND), (3.0 * u + 16.0 * u * u, 10.0 * u + 96.0 * u * u));
    assert_eq!(ORIENT_BOUND_OF_LENGTHS, 1.5 * u + 32.0 * u * u);
    assert_eq!(IN_CIRCLE_BOUND_OF_LENGTHS, 10.0 * u + 192.0 * u * u);
    assert_eq!((ORIENT3D_BOUND, IN_SPHERE_BOUND), (7.0 * u + 56.0 * u * u, 16.0 * u + 224.0 * u * u));
    assert_eq!(
        (POWER_CIRCLE_BOUND, POWER_SPHERE_BOUND),
        (11.0 * u + 112.0 * u * u, 17.0 * u + 256.0 * u * u)
    );
    assert_eq!((super::CIRCLE_CEILING, super::CIRCLE_FLOOR), (2f64.powi(500), 2f64.powi(-560)));
    assert_eq!((ORIENT3D_CEILING, ORIENT3D_FLOOR), (2f64.powi(500), 2f64.powi(-569)));
    assert_eq!((SPHERE_CEILING, SPHERE_FLOOR), (2f64.powi(200), 2f64.powi(-760)));
    assert_eq!(super::scaled::FLOOR, 2f64.powi(-960));
}

/// Sums over all permutations, with signs and without.
fn expanded<const N: usize>(rows: [[f64; N]; N]) -> (f64, f64) {
    fn sum(rows: &[Vec<f64>], used: &mut Vec<usize>) -> (f64, f64) {
        let (mut det, mut permanent) = (0.0, 0.0);
        if used.len() == rows.len() {
            return (1.0, 1.0);
        }
        for column in (0..rows.len()).filter(|c| !used.contains(c)).collect::<Vec<_>>() {
            let x = rows[used.len()][column];
            let sign = if used.iter().filter(|&&c| c > column).count() % 2 == 0 { 1.0 } else { -1.0 };
            used.push(column);
            let (inner, all) = sum(rows, used);
            used.pop();
            det += sign * x * inner;
            permanent += x.abs() * all;
        }
        (det, permanent)
    }
    sum(&rows.map(|row| row.to_vec()), &mut Vec::new())
}

/// On small integers and their quarters nothing rounds.
#[test]
fn determinants_come_with_their_permanents() {
    for scale in [1.0, 0.25] {
        let rows = [[2.0, -3.0, 5.0], [-7.0, 11.0, 13.0], [17.0, 19.0, -23.0], [29.0, -31.0, 37.0]];
        let rows = rows.map(|row| row.map(|x: f64| x * scale));
        let lifts = [41.0, 43.0, 47.0, 53.0].map(|x| x * scale);
        let flat = [0, 1, 2].map(|i| [rows[i][0], rows[i][1]]);
        assert_eq!(super::orient_terms(flat[0], flat[1]), expanded([flat[0], flat[1]]));
        let lifted = [0, 1, 2].map(|i| [flat[i][0], flat[i][1], lifts[i]]);
        assert_eq!(super::circle_terms(flat, [lifts[0], lifts[1], lifts[2]]), expanded(lifted));
        let three = [rows[0], rows[1], rows[2]];
        assert_eq!(super::space::orient3d_terms(three), expanded(three));
        let lifted = [0, 1, 2, 3].map(|i| [rows[i][0], rows[i][1], rows[i][2], lifts[i]]);
        assert_eq!(super::space::sphere_terms(rows, lifts), expanded(lifted));
    }
}

/// One difference that is too large for the floors, whichever it is, is enough to decide nothing.
#[test]
fn beyond_their_ceilings_filters_decide_nothing() {
    let large = |e: i32, f: i32, k: usize, i: usize| 2f64.powi(if i == k { e } else { f });
    for k in 0..3 {
        let points = [[1.0, 0.25], [-0.5, 1.0], [-0.25, -1.0]];
        let at = |i: usize| points[i].map(|x| x * large(251, -100, k, i));
        assert_eq!(super::in_circle_filter(at(0), at(1), at(2), [0.0, 0.0]), None, "{k}");
        let squares = [0, 1, 2].map(|i| at(i).iter().map(|x| x * x).sum());
        assert_eq!(super::in_circle_of_lengths(squares, [1.0; 3]), None, "{k}");
        let at = |i: usize| [points[i][0], points[i][1], large(501, -300, k, i)];
        assert_eq!(super::orient3d_filter(at(0), at(1), at(2), [0.0; 3]), None, "{k}");
        let below = |i: usize| [points[i][0], points[i][1], large(499, -300, k, i)];
        assert!(super::orient3d_filter(below(0), below(1), below(2), [0.0; 3]).is_some(), "{k}");
    }
    for k in 0..4 {
        let points = [[1.0, 0.25, 0.5], [-0.5, 1.0, 0.25], [-0.25, -1.0, 0.5], [0.125, 0.25, -1.0]];
        let at = |i: usize| points[i].map(|x| x * large(101, -40, k, i));
        assert_eq!(super::in_sphere_filter(at(0), at(1), at(2), at(3), [0.0; 3]), None, "{k}");
        let below = |i: usize| points[i].map(|x| x * large(98, -40, k, i));
        assert!(super::in_sphere_filter(below(0), below(1), below(2), below(3), [0.0; 3]).is_some(), "{k}");
    }
}

/// Most coordinates of a lattice need no look at their bits.
#[test]
fn the_lattice_test_knows_multiples() {
    for step in [1.0, 0.125, 1024.0] {
        let limit = super::ROUNDING / 3.0 * step;
        let multiples = [0.0, step, -step, 3.0 * step, -1001.0 * step, limit, -limit];
        assert!(super::on_lattice(step, limit, &multiples), "{step}");
        assert!(super::on_lattice(step, 5.0 * step, &[5.0 * step]), "{step}");
        assert!(!super::on_lattice(step, 5.0 * step, &[6.0 * step]), "{step}");
        assert!(!super::on_lattice(step, 2.0 * limit, &[step]), "{step}");
        for x in [step / 2.0, step / 1024.0, -1.5 * step, limit / 1024.0 - step / 4.0] {
            assert!(!super::on_lattice(step, limit, &[step, x, step]), "{step} {x}");
        }
    }
}

/// The terms of the determinant of three lines, and of the coordinates of a meeting: coefficients a and b with one rounding,
/// c with five of its size, all of size 1.
#[test]
fn the_bounds_of_lines_cover_their_formulas() {
    use crate::line::rounded::MEETING_BOUND;
    use crate::line::{SIDE_BOUND, TURN_BOUND};
    let d = Bounded::difference(1.0);
    // A bisector: a difference times a sum of two differences, twice; of size 2 altogether.
    let half = Bounded::difference(0.5);
    let product = d.times(half.plus(half));
    let c = product.plus(product);
    assert!(c.error <= 5.0 * U * 2.0 * (1.0 + 8.0 * U), "{} u", c.error / U / 2.0);
    // With weights, of which a difference is added: six.
    let weighted = c.plus(Bounded::difference(1.0));
    assert!(weighted.error <= 6.0 * U * 3.0 * (1.0 + 8.0 * U), "{} u", weighted.error / U / 3.0);
    let c = Bounded { max: 1.0, error: 6.0 * U * (1.0 + 8.0 * U) };
    let turn = d.times(d).plus(d.times(d));
    assert!(turn.error <= TURN_BOUND * 2.0 * (1.0 - 8.0 * U), "{} u", turn.error / U / 2.0);
    let mixed = d.times(c).plus(d.times(c));
    assert!(mixed.error <= MEETING_BOUND * 2.0 * (1.0 - 8.0 * U), "{} u", mixed.error / U / 2.0);
    let value = d.times(mixed).plus(d.times(mixed)).plus(c.times(turn));
    assert!(value.error <= SIDE_BOUND * 6.0 * (1.0 - 16.0 * U), "{} u", value.error / U / 6.0);
    assert!(value.error >= SIDE_BOUND * 6.0 * 0.7, "the bound is far too large: {} u", value.error / U / 6.0);
}

/// The terms of a circumcenter: twice an area, and the offset from a corner times twice of that.
#[test]
fn the_bounds_of_circumcenters_cover_their_formulas() {
    use crate::line::centers::{AREA_BOUND, TERMS_BOUND};
    let d = Bounded::difference(1.0);
    let area = d.times(d).plus(d.times(d));
    let square = d.times(d).plus(d.times(d));
    let terms = d.times(square).plus(d.times(square));
    // The quotient is by twice the area, which halves the error of the terms, but not that of the area. Sizes and inverses are rounded
    // too, and the area itself may be smaller by its own error, 2^-39 of it.
    let room = 1.0 - 2f64.powi(-30);
    assert!(terms.error / 2.0 <= TERMS_BOUND * U * terms.max * room, "{} u", terms.error / U / terms.max);
    assert!(area.error <= AREA_BOUND * U * area.max * room, "{} u", area.error / U / area.max);
}

/// Lengths, diametral balls and lunes in three dimensions, relative to sums of magnitudes.
#[test]
fn lune_and_length_bounds_cover_their_formulas() {
    let difference = Bounded::difference(1.0);
    let product = difference.times(difference);
    let sum = product.plus(product).plus(product);
    assert!(sum.error <= 5.0 * U * sum.max, "{} u", sum.error / U / sum.max);
    // The factor is one more rounding; that of the last difference is relative to the result.
    let scaled = sum.error + U * (sum.max + sum.error);
    // The computed size may be smaller than the true one by its own relative error.
    let allowed = crate::distance::ERROR * (1.0 - 8.0 * U);
    assert!(scaled + sum.error <= allowed * 2.0 * sum.max);
    assert!(2.0 * sum.error <= allowed * 2.0 * sum.max);
    // Nearly as much in the sum of both balls of a lune, with one rounding of sizes that is relative to the result again.
    assert!(2.0 * (scaled + sum.error) + U * 4.0 * sum.max <= allowed * 4.0 * sum.max);
    // Six products that lose the least number, times beta, beside what is allowed of a size of beta times the smallest.
    assert!(6.0 * f64::from_bits(1) < 1e-16 * allowed * crate::lune::SMALLEST);
}
