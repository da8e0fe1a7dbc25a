//! Determinants by definition, over big integers.

use std::cmp::Ordering;

use num_bigint::BigInt;

/// A point of the plane.
pub type Point2 = [f64; 2];

/// A point of space.
pub type Point3 = [f64; 3];

/// The exponent that [`integers`] takes out of every number: the least one. That of 2^-1074, of which all are multiples, is 1.
pub(crate) fn common_exponent<const D: usize>(points: &[[f64; D]]) -> i64 {
    points.iter().flatten().filter(|x| **x != 0.0).map(|x| exponent(*x)).min().unwrap_or(0)
}

fn exponent(x: f64) -> i64 {
    ((x.to_bits() >> 52) & 0x7ff).max(1) as i64
}

/// Coordinates as integers: every `f64` of the tuple divided by one common power of two.
pub(crate) fn integers<const D: usize>(points: &[[f64; D]]) -> Vec<[BigInt; D]> {
    let scale = common_exponent(points);
    let integer = |x: f64| {
        assert!(x.is_finite(), "the oracle was given {x}");
        let normal = (x.to_bits() >> 52) & 0x7ff != 0;
        let digits = (x.to_bits() & 0x000f_ffff_ffff_ffff) + if normal { 1 << 52 } else { 0 };
        let magnitude = BigInt::from(digits) << (exponent(x) - scale).max(0);
        if x < 0.0 { -magnitude } else { magnitude }
    };
    points.iter().map(|p| p.map(integer)).collect()
}

/// The determinant of a square matrix of at most five rows by expansion along its first column.
fn determinant(rows: &[Vec<BigInt>]) -> BigInt {
    expansion(&rows.iter().map(Vec::as_slice).collect::<Vec<_>>())
}

/// The determinant of borrowed rows, because nearly all of a test's time is spent here.
fn expansion(rows: &[&[BigInt]]) -> BigInt {
    match rows {
        [row] => row[0].clone(),
        [p, q] => &p[0] * &q[1] - &q[0] * &p[1],
        _ => {
            let mut others: [&[BigInt]; 4] = [&[]; 4];
            let others = &mut others[..rows.len() - 1];
            others.iter_mut().zip(&rows[1..]).for_each(|(other, row)| *other = &row[1..]);
            let mut sum = BigInt::ZERO;
            for (i, row) in rows.iter().enumerate() {
                let term = &row[0] * expansion(others);
                sum = if i % 2 == 0 { sum + term } else { sum - term };
                // From here on all rows but the next one.
                if let Some(other) = others.get_mut(i) {
                    *other = &row[1..];
                }
            }
            sum
        }
    }
}

/// The matrix without one row and one column.
fn minor(rows: &[Vec<BigInt>], row: usize, column: usize) -> Vec<Vec<BigInt>> {
    let keep = |r: &Vec<BigInt>| {
        r.iter().enumerate().filter(|(j, _)| *j != column).map(|(_, x)| x.clone()).collect()
    };
    rows.iter().enumerate().filter(|(i, _)| *i != row).map(|(_, r)| keep(r)).collect()
}

pub(crate) fn sign(value: &BigInt) -> i8 {
    match value.cmp(&BigInt::ZERO) {
        Ordering::Less => -1,
        Ordering::Equal => 0,
        Ordering::Greater => 1,
    }
}

/// The sign of the determinant with rows (x, y, 1): 1 when a, b, c turn left.
pub fn orient2d(a: Point2, b: Point2, c: Point2) -> i8 {
    let rows: Vec<_> = integers(&[a, b, c]).into_iter().map(|[x, y]| vec![x, y, BigInt::from(1)]).collect();
    sign(&determinant(&rows))
}

/// The sign of the determinant of b - a, c - a, d - a: 1 when a, b, c are seen counter-clockwise from d.
pub fn orient3d(a: Point3, b: Point3, c: Point3, d: Point3) -> i8 {
    let rows: Vec<_> =
        integers(&[a, b, c, d]).into_iter().map(|[x, y, z]| vec![x, y, z, BigInt::from(1)]).collect();
    -sign(&determinant(&rows))
}

fn lifted(points: &[Point2; 4]) -> Vec<Vec<BigInt>> {
    let lift = |[x, y]: [BigInt; 2]| {
        let z = &x * &x + &y * &y;
        vec![x, y, z, BigInt::from(1)]
    };
    integers(points).into_iter().map(lift).collect()
}

/// The sign of the determinant with rows (x, y, x^2 + y^2, 1): 1 when d is inside the circle through a, b, c
/// in counter-clockwise order. Zero on ties.
pub fn in_circle_unperturbed(a: Point2, b: Point2, c: Point2, d: Point2) -> i8 {
    sign(&determinant(&lifted(&[a, b, c, d])))
}

/// The in-circle test with heights x^2 + y^2 + e_i, where e_i is infinitesimal and infinitely larger for
/// lexicographically larger points: the sign of the first non-zero term of the expansion in the e_i.
pub fn in_circle(a: Point2, b: Point2, c: Point2, d: Point2) -> i8 {
    let points = [a, b, c, d];
    let rows = lifted(&points);
    let constant = sign(&determinant(&rows));
    if constant != 0 {
        return constant;
    }
    let mut largest_first = [0, 1, 2, 3];
    largest_first.sort_by(|&i, &j| points[j].partial_cmp(&points[i]).expect("finite"));
    for i in largest_first {
        let cofactor = sign(&determinant(&minor(&rows, i, 2)));
        if cofactor != 0 {
            return if i % 2 == 0 { cofactor } else { -cofactor };
        }
    }
    0
}

fn lifted3(points: &[Point3; 5]) -> Vec<Vec<BigInt>> {
    let lift = |[x, y, z]: [BigInt; 3]| {
        let w = &x * &x + &y * &y + &z * &z;
        vec![x, y, z, w, BigInt::from(1)]
    };
    integers(points).into_iter().map(lift).collect()
}

/// 1 when e is inside the sphere through a, b, c, d, which are seen counter-clockwise from d. Zero on ties.
pub fn in_sphere_unperturbed(a: Point3, b: Point3, c: Point3, d: Point3, e: Point3) -> i8 {
    -sign(&determinant(&lifted3(&[a, b, c, d, e])))
}

/// The in-sphere test with infinitesimal heights, as in [`in_circle`].
pub fn in_sphere(a: Point3, b: Point3, c: Point3, d: Point3, e: Point3) -> i8 {
    let points = [a, b, c, d, e];
    let rows = lifted3(&points);
    let constant = sign(&determinant(&rows));
    if constant != 0 {
        return -constant;
    }
    let mut largest_first = [0, 1, 2, 3, 4];
    largest_first.sort_by(|&i, &j| points[j].partial_cmp(&points[i]).expect("finite"));
    for i in largest_first {
        let cofactor = sign(&determinant(&minor(&rows, i, 3)));
        if cofactor != 0 {
            // The sign of the place in column 3, and that of the whole.
            return if i % 2 == 0 { cofactor } else { -cofactor };
        }
    }
    0
}

/// The sign of |a - q|^2 - |b - q|^2.
pub fn compare_distances(q: Point2, a: Point2, b: Point2) -> i8 {
    let p = integers(&[q, a, b]);
    let squared = |i: usize| (0..2).map(|k| (&p[i][k] - &p[0][k]).pow(2)).sum::<BigInt>();
    sign(&(squared(1) - squared(2)))
}

/// The sign of |a - q|^2 - radius^2.
pub fn compare_with_radius(q: Point2, a: Point2, radius: f64) -> i8 {
    let p = integers(&[q, a, [radius, radius]]);
    let squared = (0..2).map(|k| (&p[1][k] - &p[0][k]).pow(2)).sum::<BigInt>();
    sign(&(squared - p[2][0].pow(2)))
}

/// The circumcenter of o, a, b relative to o, times a positive number, for o, a, b counter-clockwise.
fn center(o: &[BigInt], a: &[BigInt], b: &[BigInt]) -> [BigInt; 2] {
    // It is where c.u = |u|^2 / 2 and c.v = |v|^2 / 2, by Cramer's rule.
    let u = [&a[0] - &o[0], &a[1] - &o[1]];
    let v = [&b[0] - &o[0], &b[1] - &o[1]];
    let (uu, vv) = (u[0].pow(2) + u[1].pow(2), v[0].pow(2) + v[1].pow(2));
    [&uu * &v[1] - &u[1] * &vv, &u[0] * &vv - &uu * &v[0]]
}

/// On which side of the line from o through the circumcenter of o, a, b a point is.
pub fn center_side(o: Point2, a: Point2, b: Point2, q: Point2) -> i8 {
    let p = integers(&[o, a, b, q]);
    let [x, y] = center(&p[0], &p[1], &p[2]);
    sign(&(x * (&p[3][1] - &p[0][1]) - y * (&p[3][0] - &p[0][0])))
}

/// The signs of the circumcenter of o, a, b relative to o.
pub fn center_direction(o: Point2, a: Point2, b: Point2) -> [i8; 2] {
    let p = integers(&[o, a, b]);
    center(&p[0], &p[1], &p[2]).map(|x| sign(&x))
}

/// Whether the closed disk through o, a, b, which are not collinear, is in the inside of a box. Sides may be infinite.
pub fn circle_is_within([o, a, b]: [Point2; 3], low: Point2, high: Point2) -> bool {
    let (a, b) = if orient2d(o, a, b) > 0 { (a, b) } else { (b, a) };
    (0..2).all(|k| {
        [(low[k], -1), (high[k], 1)].into_iter().all(|(side, outward)| {
            if side == f64::INFINITY * f64::from(outward) {
                return true;
            }
            let p = integers(&[o, a, b, [side, side]]);
            let from_o = |i: usize| [&p[i][0] - &p[0][0], &p[i][1] - &p[0][1]];
            let (u, v) = (from_o(1), from_o(2));
            // The center is c / d, and the square of the radius |c|^2 / d^2.
            let d = (&u[0] * &v[1] - &u[1] * &v[0]) * 2;
            let c = center(&p[0], &p[1], &p[2]);
            let apart: BigInt = ((&p[3][k] - &p[0][k]) * d - &c[k]) * outward;
            apart > BigInt::ZERO && apart.pow(2) > c[0].pow(2) + c[1].pow(2)
        })
    })
}

/// Whether the closed ball of the sphere through o, a, b, c, which are not coplanar, is in the inside of a box. Sides may be
/// infinite.
pub fn sphere_is_within([o, a, b, c]: [Point3; 4], low: Point3, high: Point3) -> bool {
    (0..3).all(|k| {
        [(low[k], -1), (high[k], 1)].into_iter().all(|(side, outward)| {
            if side == f64::INFINITY * f64::from(outward) {
                return true;
            }
            let p = integers(&[o, a, b, c, [side; 3]]);
            let from_o = |i: usize| (0..3).map(|k| &p[i][k] - &p[0][k]).collect::<Vec<BigInt>>();
            let rows = [1, 2, 3].map(from_o);
            // The center is x / d, where x.u = d |u|^2 / 2 for each row u, by Cramer's rule; the square of the radius |x|^2 / d^2.
            let squares = [0, 1, 2].map(|i| rows[i].iter().map(|u| u.pow(2)).sum::<BigInt>());
            let with_squares = |k: usize| {
                let mut rows = rows.clone();
                rows.iter_mut().zip(&squares).for_each(|(row, square)| row[k] = square.clone());
                determinant(&rows)
            };
            let (mut d, mut x): (BigInt, _) = (determinant(&rows) * 2, [0, 1, 2].map(with_squares));
            if d < BigInt::ZERO {
                (d, x) = (-d, x.map(|x| -x));
            }
            let apart: BigInt = ((&p[4][k] - &p[0][k]) * d - &x[k]) * outward;
            apart > BigInt::ZERO && apart.pow(2) > x.iter().map(|x| x.pow(2)).sum::<BigInt>()
        })
    })
}

/// The sign of the scalar product (a - o) . (b - o).
pub fn angle(o: Point2, a: Point2, b: Point2) -> i8 {
    let p = integers(&[o, a, b]);
    sign(&(0..2).map(|k| (&p[1][k] - &p[0][k]) * (&p[2][k] - &p[0][k])).sum())
}

/// The sign of |a - q|^2 - |b - q|^2 in space.
pub fn compare_distances3(q: Point3, a: Point3, b: Point3) -> i8 {
    let p = integers(&[q, a, b]);
    let squared = |i: usize| (0..3).map(|k| (&p[i][k] - &p[0][k]).pow(2)).sum::<BigInt>();
    sign(&(squared(1) - squared(2)))
}

/// The sign of |a - q|^2 - radius^2 in space.
pub fn compare_with_radius3(q: Point3, a: Point3, radius: f64) -> i8 {
    let p = integers(&[q, a, [radius; 3]]);
    let squared = (0..3).map(|k| (&p[1][k] - &p[0][k]).pow(2)).sum::<BigInt>();
    sign(&(squared - p[2][0].pow(2)))
}

/// The sign of |b - a|^2 - |d - c|^2.
pub fn compare_lengths<const D: usize>([a, b]: [[f64; D]; 2], [c, d]: [[f64; D]; 2]) -> i8 {
    let p = integers(&[a, b, c, d]);
    let squared = |i: usize, j: usize| (0..D).map(|k| (&p[j][k] - &p[i][k]).pow(2)).sum::<BigInt>();
    sign(&(squared(0, 1) - squared(2, 3)))
}

/// Whether the angle at `o` between `a` and `b` is at least an acute one whose squared cosine is given.
pub fn is_angle_at_least(o: Point2, a: Point2, b: Point2, squared_cosine: f64) -> bool {
    let p = integers(&[o, a, b]);
    let product =
        |i: usize, j: usize| (0..2).map(|k| (&p[i][k] - &p[0][k]) * (&p[j][k] - &p[0][k])).sum::<BigInt>();
    let dot = product(1, 2);
    // One and the bound in the same unit.
    let bound = integers(&[[1.0, squared_cosine]]);
    dot <= BigInt::ZERO || dot.pow(2) * &bound[0][0] <= product(1, 1) * product(2, 2) * &bound[0][1]
}
