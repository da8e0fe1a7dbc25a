//! Corners of half-spaces: integers of a few words where coordinates fit 60 bits and weights the square of that and no plane is through three
//! points, big integers otherwise.
//!
//! On the common scale points are at most 2^61 away, and normals at most 2^62; c takes 125 bits, the determinants of three normals 189 and their
//! sums 191, the whole 316.

use std::cmp::Ordering;

use super::{HalfSpace, coefficients, meeting};
use crate::ball::Number;
use crate::exact::big;
use crate::exact::big_int::BigInt;
use crate::exact::power::{Rows, big_rows_and_last, rows};
use crate::exact::wide::Wide;
use crate::{Point3, Sign, Site, lexicographic3};

/// A number that signs are asked of.
trait Coefficient: Clone {
    fn plus(self, other: Self) -> Self;
    fn negative(self) -> Self;
    fn sign(&self) -> Sign;
}

impl Coefficient for Wide<3> {
    fn plus(self, other: Self) -> Self {
        Self::plus(self, other)
    }

    fn negative(self) -> Self {
        self.minus(self).minus(self)
    }

    fn sign(&self) -> Sign {
        Self::sign(*self)
    }
}

impl Coefficient for BigInt {
    fn plus(self, other: Self) -> Self {
        self + other
    }

    fn negative(self) -> Self {
        -self
    }

    fn sign(&self) -> Sign {
        Self::sign(self)
    }
}

/// The points of half-spaces with their weights, three each, and where they are seen from.
fn sites<const N: usize, const S: usize>(from: Point3, planes: &[HalfSpace; N]) -> [Site<3>; S] {
    const { assert!(S == 3 * N + 1) };
    let mut sites = [(from, 0.0); S];
    for (three, plane) in sites.chunks_mut(3).zip(planes) {
        let (points, [w, v]) = (plane.points(), plane.weights());
        three.iter_mut().zip(points.into_iter().zip([w, v, w])).for_each(|(site, of_plane)| *site = of_plane);
    }
    sites
}

/// n and c in integers, if they fit.
fn small<const N: usize, const S: usize, const R: usize>(
    from: Point3,
    planes: &[HalfSpace; N],
) -> Option<[([i64; 3], i128); N]> {
    if planes.iter().any(|plane| matches!(plane, HalfSpace::Through(..))) {
        return None;
    }
    let (points, lifts) = rows::<3, S, R>(&sites::<N, S>(from, planes))?;
    let mut all = [([0; 3], 0); N];
    for (i, (plane, found)) in planes.iter().zip(&mut all).enumerate() {
        *found = match *plane {
            HalfSpace::Above(axis, _) | HalfSpace::Below(axis, _) => {
                let sign = if matches!(plane, HalfSpace::Below(..)) { 1 } else { -1 };
                let mut n = [0; 3];
                n[axis] = sign;
                (n, i128::from(sign * points[3 * i][axis]))
            }
            _ => {
                let n = [0, 1, 2].map(|k| 2 * (points[3 * i + 1][k] - points[3 * i][k]));
                (n, lifts[3 * i + 1] - lifts[3 * i])
            }
        };
    }
    Some(all)
}

/// n and c, the point that they are seen from, and the binary exponent of the scale of that.
type Large<const N: usize> = ([([BigInt; 3], BigInt); N], Vec<BigInt>, i32);

fn large<const N: usize, const S: usize>(from: Point3, planes: &[HalfSpace; N]) -> Large<N> {
    let (Rows { differences, scale, lifts, .. }, last) = big_rows_and_last::<3>(&sites::<N, S>(from, planes));
    let one = BigInt::from(1);
    let mut index = 0;
    let all = planes.each_ref().map(|plane| {
        let points = [0, 1, 2].map(|k| differences[index + k].as_slice());
        // A lift is the square less the weight.
        let weight =
            |k: usize| differences[index + k].iter().map(|x| x * x).sum::<BigInt>() - &lifts[index + k];
        let weight = matches!(plane, HalfSpace::Radical(..)).then(|| weight(1) - weight(0));
        index += 3;
        coefficients(plane, points, weight, &one)
    });
    (all, last, scale)
}

fn three(u: &[i64; 3], v: &[i64; 3], w: &[i64; 3]) -> Wide<3> {
    let minor =
        |i: usize, j: usize| i128::from(v[i]) * i128::from(w[j]) - i128::from(v[j]) * i128::from(w[i]);
    let term = |k: usize, minor: i128| -> Wide<3> { Wide::from(u[k]).times(Wide::from(minor)) };
    term(0, minor(1, 2)).plus(term(1, minor(2, 0))).plus(term(2, minor(0, 1)))
}

fn big_three(u: &[BigInt; 3], v: &[BigInt; 3], w: &[BigInt; 3]) -> BigInt {
    let minor = |i: usize, j: usize| &v[i] * &w[j] - &v[j] * &w[i];
    &u[0] * minor(1, 2) + &u[1] * minor(2, 0) + &u[2] * minor(0, 1)
}

/// The sign of the determinant of three outward normals.
#[cold]
#[inline(never)]
pub(super) fn turn(from: Point3, planes: &[HalfSpace; 3]) -> Sign {
    if let Some([e, f, g]) = small::<3, 10, 9>(from, planes) {
        return three(&e.0, &f.0, &g.0).sign();
    }
    let ([e, f, g], ..) = large::<3, 10>(from, planes);
    big_three(&e.0, &f.0, &g.0).sign()
}

/// The side of the last plane that the meeting of the others is on, which have a positive determinant; with ties broken or not.
#[cold]
#[inline(never)]
pub(super) fn side(from: Point3, planes: &[HalfSpace; 4], broken: bool) -> Sign {
    if let Some([i, j, k, l]) = small::<4, 13, 12>(from, planes) {
        let d = three(&i.0, &j.0, &k.0);
        let cofactors = [
            three(&l.0, &j.0, &k.0),
            three(&i.0, &l.0, &k.0),
            three(&i.0, &j.0, &l.0),
            Coefficient::negative(d),
        ];
        let term = |c: i128, cofactor: Wide<3>| -> Wide<5> { Wide::from(c).times(cofactor) };
        let [a, b, c, e] = cofactors;
        let value = term(i.1, a).plus(term(j.1, b)).plus(term(k.1, c)).plus(term(l.1, e)).sign();
        return decided(-value, planes, cofactors, broken);
    }
    let ([i, j, k, l], ..) = large::<4, 13>(from, planes);
    let cofactors = [
        big_three(&l.0, &j.0, &k.0),
        big_three(&i.0, &l.0, &k.0),
        big_three(&i.0, &j.0, &l.0),
        -big_three(&i.0, &j.0, &k.0),
    ];
    let terms = [i.1, j.1, k.1, l.1].into_iter().zip(&cofactors);
    let value = terms.map(|(c, cofactor)| c.times(cofactor)).sum::<BigInt>().sign();
    decided(-value, planes, cofactors, broken)
}

/// The answer, ties broken: what does not depend on sites is moved inwards first, then sites are raised.
fn decided<T: Coefficient>(value: Sign, planes: &[HalfSpace; 4], cofactors: [T; 4], broken: bool) -> Sign {
    if !value.is_zero() || !broken {
        return value;
    }
    let mut walls: Vec<(&HalfSpace, Sign)> = Vec::new();
    let mut raised: Vec<(Point3, T)> = Vec::new();
    for (plane, cofactor) in planes.iter().zip(cofactors) {
        match *plane {
            // The cell of the first is smaller if that is raised, and larger if the second is.
            HalfSpace::Bisector(p, q) | HalfSpace::Radical((p, _), (q, _)) => {
                raised.push((p, cofactor.clone().negative()));
                raised.push((q, cofactor));
            }
            _ => walls.push((plane, cofactor.sign())),
        }
    }
    walls.sort_by(|p, q| order_of(p.0, q.0));
    // Inwards is less.
    if let Some((_, sign)) = walls.iter().find(|(_, sign)| !sign.is_zero()) {
        return *sign;
    }
    raised.sort_by(|p, q| lexicographic3(q.0, p.0));
    for equal in raised.chunk_by(|p, q| p.0 == q.0) {
        let all = equal[1..].iter().fold(equal[0].1.clone(), |sum, (_, more)| sum.plus(more.clone()));
        if !all.sign().is_zero() {
            return -all.sign();
        }
    }
    Sign::Zero
}

/// Some order of planes that do not depend on sites.
fn order_of(p: &HalfSpace, q: &HalfSpace) -> Ordering {
    let key = |plane: &HalfSpace| match *plane {
        HalfSpace::Above(axis, _) => axis,
        HalfSpace::Below(axis, _) => 3 + axis,
        _ => 6,
    };
    let points = p.points().into_iter().zip(q.points());
    key(p).cmp(&key(q)).then_with(|| {
        points.map(|(p, q)| lexicographic3(p, q)).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
    })
}

/// Where three planes meet that do meet, correctly rounded; a coordinate that no `f64` can hold is infinite.
#[cold]
#[inline(never)]
pub(super) fn place(from: Point3, planes: &[HalfSpace; 3]) -> Point3 {
    let (equations, from, scale) = large::<3, 10>(from, planes);
    let (x, d) = meeting(&equations);
    [0, 1, 2].map(|axis| big::quotient(&(&from[axis] * &d + &x[axis]), &d, scale))
}
