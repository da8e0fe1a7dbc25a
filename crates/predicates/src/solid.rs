//! Half-spaces, where three of their planes meet, and on which side of a fourth one that is: filter, exact, perturb.
//!
//! The corners of a clipped Voronoi cell of space are such meetings: of bisectors, and of sides of the region. They stay what they are, and
//! only what comes out at the end is rounded.
//!
//! A half-space is where n x <= c. Three planes meet at x / d, where d is the determinant of their normals and x is the sum of their c times
//! the vector products of the other two normals. So n x - c d of a fourth plane is a determinant of four rows, and its sign times that of d
//! is the answer.
//!
//! Nothing is on a plane: ties are broken by the canonical rule. Sites are raised by infinitesimals, the lexicographically largest by the
//! most (`perturb.rs`). That moves the bisector of two sites. So four bisectors of one site decide as the in-sphere test does. The other
//! planes are moved before all of them, each inwards, by much less than the one before. So what only touches a side of the region from outside
//! is outside. All cells are then simple: three faces meet at each corner.
//!
//! The filter. Each number of an equation is off by at most 8u of its size: a bisector has one rounding in the normal and at most seven in
//! c; a plane through three points has four in the normal and eight in c. The determinant multiplies four of them; each term has nine
//! roundings more. That is 41u of the permanent, and 64u leave room for those of the permanent itself. The determinant of three normals has
//! fewer.

mod exact;
#[cfg(test)]
mod tests;

use crate::ball::{Ball, Number, U};
use crate::line::middle;
use crate::{Point3, Sign, Site};

/// One side of a plane, and the plane itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HalfSpace {
    /// Places as near to a point as to another one, or nearer.
    Bisector(Point3, Point3),
    /// Places with no more power to a site than to another one.
    Radical(Site<3>, Site<3>),
    /// Where a coordinate (0, 1, 2) is a number or more.
    Above(usize, f64),
    /// Where a coordinate (0, 1, 2) is a number or less.
    Below(usize, f64),
    /// From where three points, which are not on a line, are seen counter-clockwise.
    Through(Point3, Point3, Point3),
}

/// Some half-spaces, seen from one point: what is computed of each is computed once.
///
/// ```
/// use delone_predicates::{HalfSpace, HalfSpaces};
/// // The cell of the origin beside two other points, cut at z = 1.
/// let origin = [0.0; 3];
/// let mut all = HalfSpaces::new(origin);
/// let x = all.push(HalfSpace::Bisector(origin, [2.0, 0.0, 0.0]));
/// let y = all.push(HalfSpace::Bisector(origin, [0.0, 2.0, 0.0]));
/// let z = all.push(HalfSpace::Below(2, 1.0));
/// let corner = all.corner([x, y, z]).expect("they meet");
/// assert_eq!(all.rounded(&corner), [1.0; 3]);
/// let beyond = all.push(HalfSpace::Bisector(origin, [2.0, 2.0, 1.9]));
/// assert!(!all.holds(&corner, beyond));
/// ```
#[derive(Clone, Debug)]
pub struct HalfSpaces {
    from: Point3,
    all: Vec<(HalfSpace, Equation)>,
}

/// Where three planes meet.
#[derive(Clone, Copy, Debug)]
pub struct Corner3 {
    planes: [u32; 3],
    /// About the place times d.
    x: Point3,
    d: f64,
    /// The sizes of their terms.
    sizes: Point3,
    size: f64,
}

/// n x <= c about, seen from some point: see the module.
#[derive(Clone, Copy, Debug)]
struct Equation {
    n: Point3,
    c: f64,
    /// Each number is off by at most 8u of its size.
    sizes: Point3,
    size: f64,
}

const BOUND: f64 = 64.0 * U;
/// The largest size of a normal for which [`FLOOR`] is valid, 2^100; that of c is its square.
const CEILING: f64 = f64::from_bits((1023 + 100) << 52);
/// All errors by underflow: each of fewer than 2^8 roundings is off by at most 2^-1075, times at most 2^400.
const FLOOR: f64 = f64::from_bits((1023 - 667) << 52);

impl HalfSpaces {
    /// None yet. The point is best near to where they will meet.
    pub fn new(from: Point3) -> Self {
        Self { from, all: Vec::new() }
    }

    /// Forgets all, to begin anew from another point.
    pub fn restart(&mut self, from: Point3) {
        self.from = from;
        self.all.clear();
    }

    /// Adds one, and returns its index.
    pub fn push(&mut self, half_space: HalfSpace) -> usize {
        self.all.push((half_space, half_space.equation(self.from)));
        self.all.len() - 1
    }

    /// Forgets the last one.
    pub fn pop(&mut self) {
        self.all.pop();
    }

    /// Where three planes meet; `None` if they do not meet in one point. O(1).
    pub fn corner(&self, planes: [usize; 3]) -> Option<Corner3> {
        let [e, f, g] = planes.map(|i| &self.all[i].1);
        let parts = [(e, cross(f.n, g.n)), (f, cross(g.n, e.n)), (g, cross(e.n, f.n))];
        let sizes = [(e, sizes(f, g)), (f, sizes(g, e)), (g, sizes(e, f))];
        let x = [0, 1, 2].map(|k| parts.iter().map(|(e, n)| e.c * n[k]).sum());
        let x_sizes = [0, 1, 2].map(|k| sizes.iter().map(|(e, n)| e.size * n[k]).sum());
        let (d, size) = (dot(e.n, parts[0].1), dot(e.sizes, sizes[0].1));
        let corner = Corner3 { planes: planes.map(|i| i as u32), x, d, sizes: x_sizes, size };
        let turn =
            outside_of(d, size).unwrap_or_else(|| exact::turn(self.from, &planes.map(|i| self.all[i].0)));
        match turn {
            Sign::Positive => Some(corner),
            Sign::Zero => None,
            Sign::Negative => {
                let [i, j, k] = corner.planes;
                Some(Corner3 { planes: [i, k, j], x: x.map(|x| -x), d: -d, ..corner })
            }
        }
    }

    /// Whether a corner is strictly inside of a half-space, under the rule for ties.
    ///
    /// Exact for every finite input; false for a plane of the corner. O(1).
    #[inline]
    pub fn holds(&self, corner: &Corner3, index: usize) -> bool {
        self.filtered(corner, index)
            .unwrap_or_else(|| exact::side(self.from, &self.four(corner, index), true))
            == Sign::Positive
    }

    /// On which side of a plane a corner is: positive inside, zero on the plane. Exact. O(1).
    pub fn side_with_ties(&self, corner: &Corner3, index: usize) -> Sign {
        self.filtered(corner, index)
            .unwrap_or_else(|| exact::side(self.from, &self.four(corner, index), false))
    }

    #[inline]
    fn filtered(&self, corner: &Corner3, index: usize) -> Option<Sign> {
        let Equation { n, c, sizes, size } = &self.all[index].1;
        let value = dot(*n, corner.x) - c * corner.d;
        outside_of(-value, dot(*sizes, corner.sizes) + size * corner.size)
    }

    fn four(&self, corner: &Corner3, index: usize) -> [HalfSpace; 4] {
        let [i, j, k] = corner.planes().map(|i| self.all[i].0);
        [i, j, k, self.all[index].0]
    }

    /// The place of a corner in coordinate units, correctly rounded: the same bits whichever planes through it are given, and from
    /// wherever they are seen. Infinite if it is too far away for an `f64`.
    ///
    /// O(1): some 300 nanoseconds, ten microseconds for a place half way between two numbers.
    pub fn rounded(&self, corner: &Corner3) -> Point3 {
        let planes = corner.planes().map(|i| self.all[i].0);
        let known = [0, 1, 2].map(|axis| planes.iter().find_map(|plane| plane.fixed(axis)));
        if let [Some(x), Some(y), Some(z)] = known {
            return [x, y, z];
        }
        in_balls(self.from, &planes, known).unwrap_or_else(|| exact::place(self.from, &planes))
    }
}

impl Corner3 {
    /// The planes, by index. Seen from outside of all three their outward normals turn counter-clockwise.
    #[inline]
    pub fn planes(&self) -> [usize; 3] {
        self.planes.map(|i| i as usize)
    }
}

impl HalfSpace {
    /// Whether a place is strictly inside, by its correctly rounded coordinates; false where these cannot tell.
    ///
    /// ```
    /// use delone_predicates::HalfSpace;
    /// let half_space = HalfSpace::Through([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0]);
    /// assert!(half_space.surely_holds([0.5, 0.25, 0.3]) && !half_space.surely_holds([0.5, 0.25, 0.25]));
    /// ```
    pub fn surely_holds(&self, rounded: Point3) -> bool {
        // Rounding keeps order: what is rounded below a number is below it.
        match *self {
            Self::Above(axis, at) => rounded[axis] > at,
            Self::Below(axis, at) => rounded[axis] < at,
            Self::Bisector(from, _) | Self::Radical((from, _), _) | Self::Through(from, ..) => {
                let Equation { n, c, sizes, size } = self.equation(from);
                let seen = [0, 1, 2].map(|k| rounded[k] - from[k]);
                let moved = dot(sizes, rounded.map(|x| 2.0 * U * x.abs()));
                let permanent = dot(sizes, seen.map(f64::abs)) + size;
                dot(n, seen) - c < -(BOUND * permanent + moved + FLOOR)
            }
        }
    }

    /// The points that it is given by, a number as a point with that in all coordinates.
    fn points(&self) -> [Point3; 3] {
        match *self {
            Self::Bisector(p, q) | Self::Radical((p, _), (q, _)) => [p, q, p],
            Self::Above(_, at) | Self::Below(_, at) => [[at; 3]; 3],
            Self::Through(p, q, r) => [p, q, r],
        }
    }

    /// The weights of its points; zero if there are none.
    fn weights(&self) -> [f64; 2] {
        match *self {
            Self::Radical((_, w), (_, v)) => [w, v],
            _ => [0.0; 2],
        }
    }

    /// The coordinate of all its points on an axis, correctly rounded, where it is that alone.
    fn fixed(&self, axis: usize) -> Option<f64> {
        match *self {
            Self::Above(k, at) | Self::Below(k, at) => (k == axis).then_some(at + 0.0),
            Self::Radical((_, w), (_, v)) if w != v => None,
            Self::Bisector(p, q) | Self::Radical((p, _), (q, _)) => {
                let others = (0..3).all(|k| (p[k] == q[k]) == (k != axis));
                others.then(|| middle(p[axis], q[axis])).flatten()
            }
            Self::Through(p, q, r) => (p[axis] == q[axis] && q[axis] == r[axis]).then_some(p[axis] + 0.0),
        }
    }

    fn equation(&self, from: Point3) -> Equation {
        let seen = |p: Point3| [0, 1, 2].map(|k| p[k] - from[k]);
        let found = match *self {
            Self::Bisector(p, q) => bisector(seen(p), seen(q), [0, 1, 2].map(|k| q[k] - p[k])),
            Self::Radical((p, w), (q, v)) => {
                let plain = bisector(seen(p), seen(q), [0, 1, 2].map(|k| q[k] - p[k]));
                let weight = v - w;
                Equation { c: plain.c - weight, size: plain.size + weight.abs(), ..plain }
            }
            Self::Above(axis, at) | Self::Below(axis, at) => {
                let sign = if matches!(self, Self::Below(..)) { 1.0 } else { -1.0 };
                let mut n = [0.0; 3];
                n[axis] = sign;
                let c = sign * (at - from[axis]);
                Equation { n, c, sizes: n.map(f64::abs), size: c.abs() }
            }
            Self::Through(p, q, r) => {
                let [u, v] = [r, q].map(|s| [0, 1, 2].map(|k| s[k] - p[k]));
                let (n, p) = (cross(u, v), seen(p));
                let sizes = magnitudes(u, v);
                Equation { n, c: dot(n, p), sizes, size: dot(sizes, p.map(f64::abs)) }
            }
        };
        let fits = found.sizes.iter().all(|&n| n <= CEILING) && found.size <= CEILING * CEILING;
        // With infinite sizes nothing is told.
        if fits { found } else { Equation { sizes: [f64::INFINITY; 3], size: f64::INFINITY, ..found } }
    }
}

fn bisector(p: Point3, q: Point3, u: Point3) -> Equation {
    let n = u.map(|u| 2.0 * u);
    let terms = [0, 1, 2].map(|k| u[k] * (p[k] + q[k]));
    let sizes = [0, 1, 2].map(|k| u[k].abs() * (p[k].abs() + q[k].abs()));
    Equation {
        n,
        c: terms[0] + terms[1] + terms[2],
        sizes: n.map(f64::abs),
        size: sizes[0] + sizes[1] + sizes[2],
    }
}

#[inline]
fn dot(u: Point3, v: Point3) -> f64 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

#[inline]
fn cross(u: Point3, v: Point3) -> Point3 {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// The sizes of the terms of a vector product.
#[inline]
fn magnitudes(u: Point3, v: Point3) -> Point3 {
    let [u, v] = [u, v].map(|w| w.map(f64::abs));
    [u[1] * v[2] + u[2] * v[1], u[2] * v[0] + u[0] * v[2], u[0] * v[1] + u[1] * v[0]]
}

#[inline]
fn sizes(e: &Equation, f: &Equation) -> Point3 {
    magnitudes(e.sizes, f.sizes)
}

/// The sign of a determinant with a permanent, if it is sure.
#[inline]
fn outside_of(value: f64, permanent: f64) -> Option<Sign> {
    crate::filter::outside_of(value, BOUND * permanent + FLOOR)
}

/// n and c of a half-space from the points that it is given by, as seen from somewhere, and from the difference of its weights.
fn coefficients<T: Number>(
    half_space: &HalfSpace,
    [p, q, r]: [&[T]; 3],
    weight: Option<T>,
    one: &T,
) -> ([T; 3], T) {
    let zero = one.minus(one);
    let inner = |u: &[T; 3], v: &[T; 3]| u[0].times(&v[0]).plus(&u[1].times(&v[1])).plus(&u[2].times(&v[2]));
    let less = |p: &[T], q: &[T]| [0, 1, 2].map(|k| p[k].minus(&q[k]));
    match *half_space {
        HalfSpace::Bisector(..) | HalfSpace::Radical(..) => {
            let u = less(q, p);
            let c = inner(&u, &[0, 1, 2].map(|k| p[k].plus(&q[k])));
            (u.map(|u| u.plus(&u)), weight.map_or(c.clone(), |weight| c.minus(&weight)))
        }
        HalfSpace::Above(axis, _) | HalfSpace::Below(axis, _) => {
            let is_below = matches!(half_space, HalfSpace::Below(..));
            let signed = |x: &T| if is_below { x.clone() } else { zero.minus(x) };
            let n = [0, 1, 2].map(|k| if k == axis { signed(one) } else { zero.clone() });
            (n, signed(&p[axis]))
        }
        HalfSpace::Through(..) => {
            let (u, v) = (less(r, p), less(q, p));
            let minor = |i: usize, j: usize| u[i].times(&v[j]).minus(&u[j].times(&v[i]));
            let n = [minor(1, 2), minor(2, 0), minor(0, 1)];
            let c = inner(&n, &[0, 1, 2].map(|k| p[k].clone()));
            (n, c)
        }
    }
}

/// Numerators and denominator of the place where three planes meet, as seen from where the equations are.
fn meeting<T: Number>([(e, a), (f, b), (g, c)]: &[([T; 3], T); 3]) -> ([T; 3], T) {
    use crate::orthosphere::fraction::normal;
    let (fg, ge, ef) = (normal(f, g), normal(g, e), normal(e, f));
    let x = [0, 1, 2].map(|k| a.times(&fg[k]).plus(&b.times(&ge[k])).plus(&c.times(&ef[k])));
    (x, e[0].times(&fg[0]).plus(&e[1].times(&fg[1])).plus(&e[2].times(&fg[2])))
}

/// By balls; coordinates that are known are not computed. `None` where this is not enough to tell.
fn in_balls(from: Point3, planes: &[HalfSpace; 3], known: [Option<f64>; 3]) -> Option<Point3> {
    let equations = planes.each_ref().map(|plane| {
        let points = plane.points().map(|p| [0, 1, 2].map(|k| Ball::difference(p[k], from[k])));
        let [w, v] = plane.weights();
        let weight = (w != v).then(|| Ball::difference(v, w));
        coefficients(plane, points.each_ref().map(|p| &p[..]), weight, &Ball::exactly(1.0))
    });
    let (x, d) = meeting(&equations);
    // A quotient is by a number that is not negative.
    let is_negative = d.high < 0.0;
    let less = |x: Ball<f64>| if is_negative { Ball::exactly(0.0).minus(&x) } else { x };
    let d = less(d);
    if d.bounds()[0].is_nan() || d.bounds()[0] <= 0.0 {
        return None;
    }
    let mut place = [0.0; 3];
    for axis in 0..3 {
        let sum = || Ball::exactly(from[axis]).plus(&less(x[axis]).over(&d)).nearest();
        place[axis] = known[axis].or_else(sum)?;
    }
    Some(place)
}
