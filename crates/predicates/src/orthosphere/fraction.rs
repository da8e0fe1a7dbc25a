//! The squared distance of the center of the smallest orthogonal sphere from a corner, as a fraction: one formula for all kinds of
//! numbers.

use crate::ball::Number;

/// `numerator / (4 denominator)` is the squared distance of the center from the last corner.
pub(super) struct Fraction<T> {
    pub(super) numerator: T,
    pub(super) denominator: T,
}

/// The fraction of a simplex of two, three or four corners: `difference(i, axis)` is a coordinate of corner i less that of the last
/// one; `lift(i, square)` gives the squared distance of corner i from the last one less the difference of their weights.
///
/// Degree 4/2 for an edge, 6/4 for a triangle, 8/6 for a tetrahedron.
#[inline]
pub(super) fn smallest<T: Number, const D: usize, const N: usize>(
    difference: impl Fn(usize, usize) -> T,
    lift: impl Fn(usize, T) -> T,
) -> Fraction<T> {
    let row = |i: usize| -> [T; D] { std::array::from_fn(|axis| difference(i, axis)) };
    let u = row(0);
    let uu = length(&u);
    let h = lift(0, uu.clone());
    if N == 2 {
        return Fraction { numerator: h.square(), denominator: uu };
    }
    let v = row(1);
    let k = lift(1, length(&v));
    if N == 3 {
        // |h v - k u|^2 over the squared length of the normal.
        let t: [T; D] = std::array::from_fn(|axis| h.times(&v[axis]).minus(&k.times(&u[axis])));
        let area = match D {
            2 => minor(&u, &v, 0, 1).square(),
            _ => length(&normal(&u, &v)),
        };
        return Fraction { numerator: length(&t), denominator: area };
    }
    let w = row(2);
    let l = lift(2, length(&w));
    // The center is at (h v x w + k w x u + l u x v) / (2 u . v x w).
    let (vw, wu, uv) = (normal(&v, &w), normal(&w, &u), normal(&u, &v));
    let center: [T; 3] =
        std::array::from_fn(|axis| h.times(&vw[axis]).plus(&k.times(&wu[axis])).plus(&l.times(&uv[axis])));
    let volume = u[0].times(&vw[0]).plus(&u[1].times(&vw[1])).plus(&u[2].times(&vw[2]));
    Fraction { numerator: length(&center), denominator: volume.square() }
}

/// The squared length.
#[inline]
pub(crate) fn length<T: Number>(u: &[T]) -> T {
    let first = u[0].square();
    u[1..].iter().fold(first, |sum, x| sum.plus(&x.square()))
}

#[inline]
pub(super) fn minor<T: Number>(u: &[T], v: &[T], i: usize, j: usize) -> T {
    u[i].times(&v[j]).minus(&u[j].times(&v[i]))
}

/// The vector product.
#[inline]
pub(crate) fn normal<T: Number>(u: &[T], v: &[T]) -> [T; 3] {
    [minor(u, v, 1, 2), minor(u, v, 2, 0), minor(u, v, 0, 1)]
}
