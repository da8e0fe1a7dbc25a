//! Meetings of lines: integers if the coordinates fit 61 bits on a common scale and there are no weights, big integers
//! otherwise.
//!
//! On the common scale a and b of a line take 63 bits, c 126; minors 191; the determinant 256 and a sign.

use super::Line;
use crate::exact::big_int::BigInt;
use crate::exact::wide::Wide;
use crate::exact::{big, integers, power};
use crate::{Point2, Sign};

/// The coefficients of a line whose numbers are on a common scale; `one` is a 1 of their kind.
macro_rules! coefficients {
    ($line:expr, $numbers:expr, $one:expr) => {{
        let [x, y, z, w] = $numbers;
        let (zero, one) = ($one - $one, $one);
        match *$line {
            Line::Through(..) => {
                let (a, b) = (y.clone() - w, z - x.clone());
                let c = zero - (a.clone() * x + b.clone() * y);
                [a, b, c]
            }
            Line::Bisector(..) | Line::Radical(..) => {
                let (dx, dy) = (x.clone() - z.clone(), y.clone() - w.clone());
                let c = zero - (dx.clone() * (x + z) + dy.clone() * (y + w));
                [dx.clone() + dx, dy.clone() + dy, c]
            }
            Line::Above(0, _) => [one, zero.clone(), zero - x],
            Line::Above(..) => [zero.clone(), one, zero - x],
            Line::Below(0, _) => [zero.clone() - one, zero, x],
            Line::Below(..) => [zero.clone(), zero - one, x],
        }
    }};
}

fn small<const N: usize>(lines: [&Line; N]) -> Option<[[i128; 3]; N]> {
    if lines.iter().any(|line| line.weights().is_some()) {
        return None;
    }
    let mut numbers = [[0.0; 4]; N];
    for (numbers, line) in numbers.iter_mut().zip(lines) {
        *numbers = line.numbers();
    }
    let mut aligned = [[0; 4]; N];
    integers::align_into(numbers.as_flattened(), aligned.as_flattened_mut())?;
    let mut all = [[0; 3]; N];
    for ((coefficients, numbers), line) in all.iter_mut().zip(aligned).zip(lines) {
        *coefficients = coefficients!(line, numbers.map(i128::from), 1_i128);
    }
    Some(all)
}

/// The coefficients, and the binary exponent of the scale.
fn large<const N: usize>(lines: [&Line; N]) -> ([[BigInt; 3]; N], i32) {
    let numbers: Vec<f64> = lines.iter().flat_map(|line| line.numbers()).collect();
    let weights: Vec<f64> = lines.iter().filter_map(|line| line.weights()).flatten().collect();
    let scaled = power::on_one_scale(&numbers, &weights);
    let (mut numbers, mut weights) = (scaled.numbers.into_iter(), scaled.weights.into_iter());
    let all = lines.map(|line| {
        let four = [(); 4].map(|()| numbers.next().unwrap_or_default());
        let [a, b, c] = coefficients!(line, four, BigInt::from(1));
        let difference = line.weights().and_then(|_| Some(weights.next()? - weights.next()?));
        [a, b, c + difference.unwrap_or_default()]
    });
    (all, scaled.scale)
}

fn minor(e: &[Wide<2>; 3], f: &[Wide<2>; 3], i: usize, j: usize) -> Wide<4> {
    e[i].times::<2, 4>(f[j]).minus(e[j].times(f[i]))
}

fn big_minor(e: &[BigInt; 3], f: &[BigInt; 3], i: usize, j: usize) -> BigInt {
    &e[i] * &f[j] - &e[j] * &f[i]
}

#[cold]
#[inline(never)]
pub(super) fn turn(first: &Line, second: &Line) -> Sign {
    if let Some(lines) = small([first, second]) {
        let [e, f] = lines.map(|line| line.map(Wide::from));
        return minor(&e, &f, 0, 1).sign();
    }
    let ([e, f], _) = large([first, second]);
    big_minor(&e, &f, 0, 1).sign()
}

#[cold]
#[inline(never)]
pub(super) fn side_of_meeting(first: &Line, second: &Line, third: &Line) -> Sign {
    if let Some(lines) = small([first, second, third]) {
        let [e, f, g] = lines.map(|line| line.map(Wide::from));
        let turn = minor(&e, &f, 0, 1);
        let term = |k: usize, minor: Wide<4>| -> Wide<6> { g[k].times(minor) };
        let value = term(0, minor(&e, &f, 1, 2)).plus(term(1, minor(&e, &f, 2, 0))).plus(term(2, turn));
        return value.sign() * turn.sign();
    }
    let ([e, f, g], _) = large([first, second, third]);
    let turn = big_minor(&e, &f, 0, 1);
    let value = &g[0] * big_minor(&e, &f, 1, 2) + &g[1] * big_minor(&e, &f, 2, 0) + &g[2] * &turn;
    value.sign() * turn.sign()
}

/// Where two lines meet, correctly rounded; a coordinate that no `f64` can hold is infinite. None for parallel lines.
#[cold]
#[inline(never)]
pub(super) fn meeting(first: &Line, second: &Line) -> Option<Point2> {
    let ([e, f], scale) = large([first, second]);
    let denominator = big_minor(&e, &f, 0, 1);
    (denominator != BigInt::ZERO).then(|| {
        [big_minor(&e, &f, 1, 2), big_minor(&e, &f, 2, 0)]
            .map(|numerator| big::quotient(&numerator, &denominator, scale))
    })
}

#[cfg(test)]
mod tests {
    use super::small;
    use crate::Line;

    /// Numbers that fit 61 bits do not need big integers, and others are not cut off.
    #[test]
    fn lines_that_fit_are_small() {
        let (p, q) = ([1.0, 2.0], [0.25, 1e15]);
        let lines = [&Line::Through(p, q), &Line::Bisector(p, q), &Line::Below(1, 0.5)];
        let large = 4e15 as i128; // in quarters
        assert_eq!(
            small(lines).map(|all| all.map(|[a, b, _]| [a, b])),
            Some([[8 - large, -3], [6, 2 * (8 - large)], [0, -1],])
        );
        assert_eq!(small([&Line::Above(0, 1e300), &Line::Above(1, 1.0)]), None);
    }
}
