//! Half-spaces of space by rational arithmetic over big integers: where three planes meet, and what is inside of all.

use std::cmp::Ordering;

use num_bigint::BigInt;

use crate::exact::{Point3, sign};

/// One side of a plane.
#[derive(Clone, Copy, Debug)]
pub enum HalfSpace {
    /// No more power to the first site than to the second; a site is a point and a weight.
    Nearer((Point3, f64), (Point3, f64)),
    /// A coordinate at most a number; or at least, for `false`.
    Axis(usize, f64, bool),
    /// Where three points are seen counter-clockwise.
    Through(Point3, Point3, Point3),
}

/// n x <= c.
#[derive(Clone, Debug)]
pub struct Row {
    n: [BigInt; 3],
    c: BigInt,
}

/// A fraction, not reduced; the denominator is positive.
#[derive(Clone, Debug)]
pub struct Fraction {
    /// Above the line.
    pub numerator: BigInt,
    /// Below it.
    pub denominator: BigInt,
}

/// A convex polyhedron.
#[derive(Clone, Debug)]
pub struct Polyhedron {
    /// In the cube of the unit of the rows.
    pub volume: Fraction,
    /// The half-spaces whose planes have a face with an area, by index.
    pub faces: Vec<usize>,
}

/// A place, to be divided by the last number, which is positive.
type Place = ([BigInt; 3], BigInt);

fn exponent(x: f64) -> i32 {
    ((x.to_bits() >> 52) & 0x7ff).max(1) as i32 - 1075
}

fn whole(x: f64, unit: i32) -> BigInt {
    let normal = (x.to_bits() >> 52) & 0x7ff != 0;
    let digits = (x.to_bits() & 0x000f_ffff_ffff_ffff) + if normal { 1 << 52 } else { 0 };
    if digits == 0 {
        return BigInt::ZERO;
    }
    let magnitude = BigInt::from(digits) << u32::try_from(exponent(x) - unit).expect("a unit of all");
    if x < 0.0 { -magnitude } else { magnitude }
}

fn numbers(half_space: &HalfSpace) -> (Vec<f64>, [f64; 2]) {
    match *half_space {
        HalfSpace::Nearer((p, w), (q, v)) => ([p, q].concat(), [w, v]),
        HalfSpace::Axis(_, at, _) => (vec![at], [0.0; 2]),
        HalfSpace::Through(p, q, r) => ([p, q, r].concat(), [0.0; 2]),
    }
}

/// A binary exponent of which all coordinates are multiples, and of whose square all weights.
pub fn unit_of(all: &[HalfSpace]) -> i32 {
    let mut unit = i32::MAX;
    for half_space in all {
        let (coordinates, weights) = numbers(half_space);
        let least = |numbers: &[f64]| numbers.iter().filter(|x| **x != 0.0).map(|&x| exponent(x)).min();
        unit = unit.min(least(&coordinates).unwrap_or(i32::MAX));
        unit = unit.min(least(&weights).map_or(i32::MAX, |w| w.div_euclid(2)));
    }
    if unit == i32::MAX { 0 } else { unit }
}

/// Half-spaces in integers of a unit.
pub fn rows(all: &[HalfSpace], unit: i32) -> Vec<Row> {
    let point = |p: Point3| p.map(|x| whole(x, unit));
    let row = |half_space: &HalfSpace| match *half_space {
        HalfSpace::Nearer((p, w), (q, v)) => {
            let (p, q, weight) = (point(p), point(q), whole(v, 2 * unit) - whole(w, 2 * unit));
            let squares = (0..3).map(|k| q[k].pow(2) - p[k].pow(2)).sum::<BigInt>();
            Row { n: [0, 1, 2].map(|k| 2 * (&q[k] - &p[k])), c: squares - weight }
        }
        HalfSpace::Axis(axis, at, below) => {
            let sign = if below { 1 } else { -1 };
            let n = [0, 1, 2].map(|k| BigInt::from(if k == axis { sign } else { 0 }));
            Row { n, c: whole(at, unit) * sign }
        }
        HalfSpace::Through(p, q, r) => {
            let [p, q, r] = [p, q, r].map(point);
            let less = |s: &[BigInt; 3]| [0, 1, 2].map(|k| &s[k] - &p[k]);
            // Outwards, where they are seen clockwise.
            let n = cross(&less(&r), &less(&q));
            let c = dot(&n, &p);
            Row { n, c }
        }
    };
    all.iter().map(row).collect()
}

fn cross(u: &[BigInt; 3], v: &[BigInt; 3]) -> [BigInt; 3] {
    let minor = |i: usize, j: usize| &u[i] * &v[j] - &u[j] * &v[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn dot(u: &[BigInt; 3], v: &[BigInt; 3]) -> BigInt {
    (0..3).map(|k| &u[k] * &v[k]).sum()
}

/// Where three planes meet, by Cramer's rule.
fn meeting(planes: [&Row; 3]) -> Option<Place> {
    let determinant = |columns: [&[BigInt; 3]; 3]| dot(columns[0], &cross(columns[1], columns[2]));
    let column = |k: usize| planes.map(|plane| plane.n[k].clone());
    let columns = [column(0), column(1), column(2)];
    let right = planes.map(|plane| plane.c.clone());
    let below = determinant(columns.each_ref());
    let place = [0, 1, 2].map(|k| {
        let mut all = columns.each_ref();
        all[k] = &right;
        determinant(all)
    });
    match sign(&below) {
        0 => None,
        1 => Some((place, below)),
        _ => Some((place.map(|x| -x), -below)),
    }
}

/// 1 inside, 0 on the plane, -1 beyond.
fn side_of(place: &Place, plane: &Row) -> i8 {
    sign(&(&plane.c * &place.1 - dot(&plane.n, &place.0)))
}

/// On which side of the fourth plane the others meet: 1 inside. `None` if they do not meet in one point.
pub fn side(four: &[HalfSpace; 4]) -> Option<i8> {
    let rows = rows(four, unit_of(four));
    Some(side_of(&meeting([&rows[0], &rows[1], &rows[2]])?, &rows[3]))
}

/// The side after small but real moves: planes that depend on no site inwards, in some order of them, then sites raised from the
/// lexicographically largest on, each by 2^-`bits` of the one before. Right if no number is within that.
pub fn side_of_moved(four: &[HalfSpace; 4], order: &[usize], bits: u32) -> Option<i8> {
    let mut rows = rows(four, unit_of(four));
    let mut sites: Vec<Point3> = Vec::new();
    for half_space in four {
        if let HalfSpace::Nearer(p, q) = half_space {
            sites.extend([p.0, q.0]);
        }
    }
    sites.sort_by(|p, q| q.partial_cmp(p).expect("finite"));
    sites.dedup();
    let levels = (order.len() + sites.len()) as u32;
    let move_of = |level: usize| BigInt::from(1) << (bits * (levels - level as u32));
    for (k, row) in rows.iter_mut().enumerate() {
        let scale = bits * (levels + 1);
        row.n = row.n.clone().map(|x| x << scale);
        row.c = row.c.clone() << scale;
        if let HalfSpace::Nearer(p, q) = &four[k] {
            let raised =
                |p: &Point3| move_of(order.len() + sites.iter().position(|s| s == p).expect("a site"));
            row.c += raised(&q.0) - raised(&p.0);
        } else {
            row.c -= move_of(order.iter().position(|&i| i == k).expect("in the order"));
        }
    }
    Some(side_of(&meeting([&rows[0], &rows[1], &rows[2]])?, &rows[3]))
}

/// Whether each coordinate of a point is the nearest `f64` of where three planes meet, of two at one distance the even one.
/// `None` if they do not meet in one point.
pub fn is_nearest(three: &[HalfSpace; 3], place: Point3) -> Option<[bool; 3]> {
    // One finer, for middles.
    let ends = place.map(|x| HalfSpace::Through([x; 3], [x.next_down(); 3], [x.next_up(); 3]));
    let all = [&three[..], &ends].concat();
    let unit = unit_of(&all) - 1;
    let rows = rows(three, unit);
    let (at, below) = meeting([&rows[0], &rows[1], &rows[2]])?;
    Some([0, 1, 2].map(|k| {
        let here = whole(place[k], unit);
        let middle = |x: f64| (&here + whole(x, unit)) / 2 * &below;
        let [least, most] = [place[k].next_down(), place[k].next_up()].map(middle);
        let is_even = place[k].to_bits() & 1 == 0;
        (at[k] > least || (is_even && at[k] == least)) && (at[k] < most || (is_even && at[k] == most))
    }))
}

impl Fraction {
    /// Nothing.
    pub fn zero() -> Self {
        Self { numerator: BigInt::ZERO, denominator: BigInt::from(1) }
    }

    /// The sum.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let numerator = &self.numerator * &other.denominator + &other.numerator * &self.denominator;
        let denominator = &self.denominator * &other.denominator;
        let (mut p, mut q) = (numerator.clone(), denominator.clone());
        while q != BigInt::ZERO {
            (p, q) = (q.clone(), p % q);
        }
        if p < BigInt::ZERO {
            p = -p;
        }
        Self { numerator: numerator / &p, denominator: denominator / p }
    }

    /// About the number.
    pub fn value(&self) -> f64 {
        // The quotient to some 60 bits.
        let bits = |x: &BigInt| i64::try_from(x.bits()).expect("few bits");
        let shift = 60 + bits(&self.denominator) - bits(&self.numerator);
        let quotient: BigInt = if shift > 0 {
            (&self.numerator << shift) / &self.denominator
        } else {
            &self.numerator / (&self.denominator << -shift)
        };
        let half = i32::try_from(-shift / 2).expect("few bits");
        let rest = i32::try_from(-shift).expect("few bits") - half;
        quotient.to_string().parse::<f64>().expect("digits") * 2f64.powi(half) * 2f64.powi(rest)
    }
}

/// The inside of all half-spaces, which must be bounded: corners by all triples of planes.
pub fn polyhedron(rows: &[Row]) -> Polyhedron {
    let mut corners: Vec<Place> = Vec::new();
    for i in 0..rows.len() {
        for j in 0..i {
            for k in 0..j {
                let Some(place) = meeting([&rows[i], &rows[j], &rows[k]]) else { continue };
                let is_equal =
                    |other: &Place| (0..3).all(|k| &other.0[k] * &place.1 == &place.0[k] * &other.1);
                if rows.iter().all(|row| side_of(&place, row) >= 0) && !corners.iter().any(is_equal) {
                    corners.push(place);
                }
            }
        }
    }
    let mut solid = Polyhedron { volume: Fraction::zero(), faces: Vec::new() };
    let Some(apex) = corners.first() else { return solid };
    let mut seen: Vec<&Row> = Vec::new();
    for (index, row) in rows.iter().enumerate() {
        let mut face: Vec<&Place> = corners.iter().filter(|corner| side_of(corner, row) == 0).collect();
        // Of equal planes the first has the face.
        let is_same = |other: &&Row| {
            cross(&other.n, &row.n).iter().all(|x| *x == BigInt::ZERO)
                && sign(&dot(&other.n, &row.n)) == 1
                && dot(&other.n, &other.n) * row.c.pow(2) == dot(&row.n, &row.n) * other.c.pow(2)
                && sign(&other.c) == sign(&row.c)
        };
        if face.len() < 3 || seen.iter().any(is_same) {
            continue;
        }
        let first = face[0];
        let turn = |p: &Place, q: &Place| sign(&dot(&row.n, &cross(&from(first, p), &from(first, q))));
        if !face.iter().any(|p| turn(face[1], p) != 0) {
            continue;
        }
        // Around the first corner, which is one of a convex polygon: all others are within a half turn of each other.
        face[1..].sort_by(|p, q| match turn(p, q) {
            1 => Ordering::Less,
            -1 => Ordering::Greater,
            _ => Ordering::Equal,
        });
        seen.push(row);
        solid.faces.push(index);
        for pair in face[1..].windows(2) {
            let sides = [first, pair[0], pair[1]].map(|corner| from(apex, corner));
            let scale = |corner: &Place| &corner.1 * &apex.1;
            let denominator = scale(first) * scale(pair[0]) * scale(pair[1]) * 6;
            let numerator = dot(&sides[0], &cross(&sides[1], &sides[2]));
            solid.volume = solid.volume.plus(&Fraction { numerator, denominator });
        }
    }
    solid
}

/// From one place to another, times both denominators.
fn from(p: &Place, q: &Place) -> [BigInt; 3] {
    [0, 1, 2].map(|k| &q.0[k] * &p.1 - &p.0[k] * &q.1)
}
