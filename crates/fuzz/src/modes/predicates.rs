//! Predicates and filters on tuples whose products underflow or overflow in part, against big integers.

use delone_generators::Random;
use delone_predicates::{
    Filter, Filter3, Grid, Pencil, Plane, Sign, angle, are_collinear3, center_direction, center_side,
    circumcenter, circumcenter3, compare_distances, compare_distances3, compare_with_radius,
    compare_with_radius3, in_circle, in_circle_with_ties, in_sphere, in_sphere_with_ties, keeps_clear,
    lexicographic, lexicographic3, orient2d, orient3d, orient3d_moved, strictly_between,
};
use num_bigint::BigInt;

use super::spheres;
use crate::attack::{Attack, Judgement};
use crate::nasty::{self, any_bits, integer as small, nudged, once_in, pick, power};
use crate::oracle::delaunay::lifted_side;
use crate::oracle::exact::{
    Vector, dot, integer, integers, is_inside, minus, orientation, scale, sign, squared,
};

/// Tuples in a case.
const TUPLES: usize = 200;

/// See the module.
pub(crate) struct Predicates;

/// Five points and a radius.
#[derive(Clone, Debug)]
pub(crate) struct Tuple {
    points: [[f64; 3]; 5],
    radius: f64,
}

/// A number that is trouble in products.
fn operand(random: &mut Random) -> f64 {
    let magnitude = match random.below(8) {
        0 => power(random, -1074, 1023),
        1 => power(random, -560, -500),
        2 => power(random, -1074, -1000),
        3 => power(random, 480, 520),
        4 => pick(random, &[0.0, 5e-324, 1e-310, 2.3e-308, f64::MAX]),
        5 => return any_bits(random),
        _ => 1.0,
    };
    let factor = pick(random, &[1.0, 1.0, 3.0, 1.5, 0.1]);
    let x = magnitude * factor * if once_in(random, 2) { -1.0 } else { 1.0 };
    if x.is_finite() { x } else { magnitude }
}

impl Tuple {
    fn new(random: &mut Random) -> Self {
        let base = nasty::points::<3>(random, 10);
        let any = |r: &mut Random| if base.is_empty() { [0.0; 3] } else { base[r.below(base.len())] };
        let scale = if once_in(random, 2) { 1.0 } else { power(random, -520, 500) };
        let sizes = [(); 3].map(|()| operand(random));
        let mut points = match random.below(4) {
            0 => [(); 5].map(|()| any(random)),
            1 => [(); 5].map(|()| [(); 3].map(|()| operand(random))),
            // A lattice, scaled differently along each axis.
            2 => [(); 5].map(|()| sizes.map(|size| size * small(random, 3))),
            _ => [(); 5].map(|()| [(); 3].map(|()| small(random, 4) * scale)),
        };
        if once_in(random, 3) {
            points[random.below(5)] = [(); 3].map(|()| operand(random));
        }
        if once_in(random, 3) {
            let which = random.below(5);
            points[which] = points[which].map(|x| nudged(random, x));
        }
        for x in points.as_flattened_mut() {
            *x = if x.is_finite() { *x } else { 1e308 };
        }
        let reach = points[0][0] - points[1][0];
        let radius = if once_in(random, 2) && reach.is_finite() { reach } else { operand(random) };
        Self { points, radius }
    }
}

/// Collects what differs.
pub(crate) struct Judge(Vec<String>);

impl Judge {
    pub(crate) fn sign(&mut self, name: &str, found: Sign, expected: i8) {
        self.equal(name, found, Sign::of(&expected, &0));
    }

    pub(crate) fn equal<T: PartialEq + std::fmt::Debug>(&mut self, name: &str, found: T, expected: T) {
        if found != expected {
            self.0.push(format!("{name}: {found:?} instead of {expected:?}"));
        }
    }
}

impl Attack for Predicates {
    type Item = Tuple;

    fn make(random: &mut Random) -> Vec<Tuple> {
        (0..TUPLES).map(|_| Tuple::new(random)).collect()
    }

    fn judge(tuples: &[Tuple], _: u64) -> Judgement {
        let mut judge = Judge(Vec::new());
        for tuple in tuples {
            let [a, b, c, d, e] = tuple.points;
            in_plane([a, b, c, d].map(|[x, y, _]| [x, y]), tuple.radius, &mut judge);
            in_plane([a, c, e, b].map(|[_, y, z]| [z, y]), tuple.radius, &mut judge);
            in_space(tuple.points, tuple.radius, &mut judge);
            grids(&tuple.points, &mut judge);
            if let Some(first) = judge.0.first() {
                return Err(format!("{tuple:?}: {first}"));
            }
        }
        Ok(())
    }
}

/// At least the size of the box around points, axis by axis.
fn extent<const D: usize>(points: &[[f64; D]]) -> [f64; D] {
    std::array::from_fn(|k| {
        let low = points.iter().fold(f64::INFINITY, |low, p| low.min(p[k]));
        let high = points.iter().fold(f64::NEG_INFINITY, |high, p| high.max(p[k]));
        if low == high { 0.0 } else { (high - low).next_up() }
    })
}

fn are_distinct<const D: usize>(points: &[[f64; D]]) -> bool {
    (0..points.len()).all(|i| (0..i).all(|j| points[i] != points[j]))
}

fn in_plane(points: [[f64; 2]; 4], radius: f64, judge: &mut Judge) {
    let [a, b, c, d] = points;
    let scale = scale(points.iter().flatten().chain([&radius]));
    let exact: Vec<Vector> = points.iter().map(|p| p.iter().map(|&x| integer(x, scale)).collect()).collect();
    let turn = orientation(&[&exact[0], &exact[1], &exact[2]]);
    judge.sign("orient2d", orient2d(a, b, c), turn);
    judge.equal("lexicographic", lexicographic(a, b), a.partial_cmp(&b).expect("finite"));
    let between = is_inside(&exact[..2], &exact[2]);
    if turn == 0 && a != b {
        judge.equal("strictly_between", strictly_between(a, b, c), between);
    }
    let tied = -lifted_side(&points, false);
    judge.sign("in_circle_with_ties", in_circle_with_ties(a, b, c, d), tied);
    let [x, y, z] = [0, 1, 2].map(|i| &exact[i]);
    judge.equal("compare_distances", compare_distances(a, b, c), squared(y, x).cmp(&squared(z, x)));
    let reach = integer(radius, scale);
    let expected =
        if radius < 0.0 { std::cmp::Ordering::Greater } else { squared(y, x).cmp(&(&reach * &reach)) };
    judge.equal("compare_with_radius", compare_with_radius(a, b, radius), expected);
    judge.sign("angle", angle(a, b, c), sign(&dot(&minus(y, x), &minus(z, x))));

    let grid = Grid::of(points.as_flattened());
    let size = extent(&points);
    let filters = [None, grid].map(|grid| Filter::for_box(size[0], size[1], grid));
    let canonical = (are_distinct(&points) && turn != 0).then(|| -lifted_side(&points, true));
    if let Some(expected) = canonical {
        judge.sign("in_circle", in_circle(a, b, c, d), expected);
    }
    for (filter, name) in filters.iter().zip(["", " on a grid"]) {
        judge.sign(&format!("Filter::orient2d{name}"), filter.orient2d(a, b, c), turn);
        let pencil = Pencil::new(a, b);
        let (p, q) = (pencil.member(c), pencil.member(d));
        judge.sign(&format!("Pencil::side{name}"), pencil.side(&p, filter), turn);
        if let Some(expected) = canonical {
            judge.sign(&format!("Filter::in_circle{name}"), filter.in_circle(a, b, c, d), expected);
            judge.sign(&format!("Pencil::in_circle{name}"), pencil.in_circle(&p, &q, filter), expected);
        }
    }
    // Counter-clockwise, as these want it.
    let (b, c, y, z) = if turn < 0 { (c, b, z, y) } else { (b, c, y, z) };
    if turn != 0 {
        let (u, v, w) = (minus(y, x), minus(z, x), minus(&exact[3], x));
        let (uu, vv) = (dot(&u, &u), dot(&v, &v));
        let side = &uu * dot(&v, &w) - &vv * dot(&u, &w);
        judge.sign("center_side", center_side(a, b, c, d), sign(&side));
        // From a.x = |a|^2 / 2 for both sides, by Cramer's rule.
        let center = [&uu * &v[1] - &vv * &u[1], &vv * &u[0] - &uu * &v[0]];
        let expected = center.map(|x| Sign::of(&sign(&x), &0));
        judge.equal("center_direction", center_direction(a, b, c), expected);
    }
    center([a, b, c], turn != 0, judge);
}

/// The circumcenter is the nearest point of numbers.
fn center([a, b, c]: [[f64; 2]; 3], is_triangle: bool, judge: &mut Judge) {
    let found = circumcenter(a, b, c);
    judge.equal("circumcenter in another order", circumcenter(c, a, b), found);
    let Some(found) = found.filter(|_| is_triangle) else {
        if !is_triangle {
            judge.equal("circumcenter of a line", found, None);
        }
        return;
    };
    let points = [a, b, c];
    let (exact, scale) = (integers(&points), scale(points.as_flattened()));
    let [u, v] = [1, 2].map(|i| minus(&exact[i], &exact[0]));
    let (uu, vv) = (dot(&u, &u), dot(&v, &v));
    // The center relative to a is this over twice the area.
    let center = [&uu * &v[1] - &vv * &u[1], &vv * &u[0] - &uu * &v[0]];
    let area: BigInt = (&u[0] * &v[1] - &u[1] * &v[0]) * 2;
    for k in 0..2 {
        let is_right = is_nearest(&exact[0][k] * &area + &center[k], area.clone(), scale, found[k]);
        judge.equal("circumcenter is the nearest", is_right, true);
    }
}

/// Whether a number is the nearest to a fraction in units of a power of two, of two at one distance the even one.
fn is_nearest(mut numerator: BigInt, mut denominator: BigInt, scale: i32, found: f64) -> bool {
    /// Half of the least number is one.
    const UNIT: i32 = -1075;
    if sign(&denominator) < 0 {
        (numerator, denominator) = (-numerator, -denominator);
    }
    if !found.is_finite() {
        return false;
    }
    let twice = (numerator << (scale - UNIT)) * 2_u32;
    let whole = |x: f64| integer(x.clamp(f64::MIN, f64::MAX), UNIT);
    let [least, most] =
        [found.next_down(), found.next_up()].map(|other| (whole(found) + whole(other)) * &denominator);
    let is_even = found.to_bits() & 1 == 0;
    let is_within = least < twice && twice < most;
    is_within || (is_even && (twice == least || twice == most)) || found.abs() == f64::MAX
}

/// The center of the sphere through the first four points is the nearest point of numbers.
fn center_in_space(points: &[[f64; 3]; 5], exact: &[Vector], scale: i32, judge: &mut Judge) {
    let [a, b, c, d, _] = *points;
    let found = circumcenter3(a, b, c, d);
    judge.equal("circumcenter3 in another order", circumcenter3(c, a, d, b), found);
    let [u, v, w] = [1, 2, 3].map(|i| minus(&exact[i], &exact[0]));
    let cross = |p: &Vector, q: &Vector| -> Vector {
        [(1, 2), (2, 0), (0, 1)].iter().map(|&(i, j)| &p[i] * &q[j] - &p[j] * &q[i]).collect()
    };
    let (vw, wu, uv) = (cross(&v, &w), cross(&w, &u), cross(&u, &v));
    let volume: BigInt = dot(&u, &vw) * 2;
    let Some(found) = found else { return };
    judge.equal("circumcenter3 of a plane", sign(&volume) != 0, true);
    for k in 0..3 {
        let offset = dot(&u, &u) * &vw[k] + dot(&v, &v) * &wu[k] + dot(&w, &w) * &uv[k];
        let is_right = is_nearest(&exact[0][k] * &volume + offset, volume.clone(), scale, found[k]);
        judge.equal("circumcenter3 is the nearest", is_right, true);
    }
}

fn in_space(points: [[f64; 3]; 5], radius: f64, judge: &mut Judge) {
    let [a, b, c, d, e] = points;
    let scale = scale(points.iter().flatten().chain([&radius]));
    let exact: Vec<Vector> = points.iter().map(|p| p.iter().map(|&x| integer(x, scale)).collect()).collect();
    let side = |i: usize, j: usize, k: usize, l: usize| orientation(&[i, j, k, l].map(|i| &exact[i]));
    let turn = side(0, 1, 2, 3);
    center_in_space(&points, &exact, scale, judge);
    judge.sign("orient3d", orient3d(a, b, c, d), turn);
    judge.equal("lexicographic3", lexicographic3(a, b), a.partial_cmp(&b).expect("finite"));
    let line = crate::oracle::exact::axes(&exact[..3]).len() < 2;
    judge.equal("are_collinear3", are_collinear3(a, b, c), line);
    // Where it is zero, the determinant is what a step of any length makes of it.
    let step = |axis: usize| {
        let moved = (0..3).map(|k| &exact[3][k] + BigInt::from(i32::from(k == axis))).collect();
        orientation(&[&exact[0], &exact[1], &exact[2], &moved])
    };
    let moved = [turn, step(0), step(1), step(2)].into_iter().find(|&sign| sign != 0).unwrap_or(0);
    judge.sign("orient3d_moved", orient3d_moved(a, b, &[c], d), moved);
    let tied = -lifted_side(&points, false);
    judge.sign("in_sphere_with_ties", in_sphere_with_ties(a, b, c, d, e), tied);
    let [x, y, z] = [0, 1, 2].map(|i| &exact[i]);
    judge.equal("compare_distances3", compare_distances3(a, b, c), squared(y, x).cmp(&squared(z, x)));
    let reach = integer(radius, scale);
    let expected =
        if radius < 0.0 { std::cmp::Ordering::Greater } else { squared(y, x).cmp(&(&reach * &reach)) };
    judge.equal("compare_with_radius3", compare_with_radius3(a, b, radius), expected);
    let size = extent(&points);
    if size.iter().all(|x| x.is_finite())
        && let Some(found) = Plane::new(a, b, c, size).side(e)
    {
        judge.sign("Plane::side", found, side(0, 1, 2, 4));
    }
    let canonical = (are_distinct(&points) && turn != 0).then(|| -lifted_side(&points, true));
    if let Some(expected) = canonical {
        judge.sign("in_sphere", in_sphere(a, b, c, d, e), expected);
    }
    for (grid, name) in [(None, ""), (Grid::of(points.as_flattened()), " on a grid")] {
        let filter = Filter3::for_box(size, grid);
        judge.sign(&format!("Filter3::orient3d{name}"), filter.orient3d(a, b, c, d), turn);
        let Some(expected) = canonical else { continue };
        judge.sign(&format!("Filter3::in_sphere{name}"), filter.in_sphere(a, b, c, d, e), expected);
        let pair = filter.in_spheres([[&a, &b, &c, &d], [&b, &a, &c, &d]], &e);
        judge.sign(&format!("Filter3::in_spheres, first{name}"), pair[0], expected);
        judge.sign(&format!("Filter3::in_spheres, second{name}"), pair[1], -expected);
        // Positive, as walks have them.
        let (corners, order) =
            if turn > 0 { ([&a, &b, &c, &d], [0, 1, 2, 3]) } else { ([&b, &a, &c, &d], [1, 0, 2, 3]) };
        let beyond = |k: usize| {
            let mut replaced = order;
            replaced[k] = 4;
            side(replaced[0], replaced[1], replaced[2], replaced[3]) < 0
        };
        let right = match filter.facet_towards(corners, &e) {
            Some(k) => beyond(k),
            None => !(0..4).any(beyond),
        };
        judge.equal(&format!("Filter3::facet_towards{name} is right"), right, true);
    }
    if turn != 0 {
        let box_of = [d, e];
        let low = [0, 1, 2].map(|k| box_of[0][k].min(box_of[1][k]));
        let high = [0, 1, 2].map(|k| box_of[0][k].max(box_of[1][k]));
        if keeps_clear([a, b, c, d], low, high) {
            judge.equal("keeps_clear of a corner", true, false);
        }
        spheres::judge_clear([a, b, c, d], e, e, judge);
        spheres::judge_clear([a, b, c, d], e, e.map(|x| (x + radius.abs()).min(1e308).max(x)), judge);
    }
}

/// A grid holds what is a multiple of its step, and no more than 2^53 steps large.
fn grids(points: &[[f64; 3]; 5], judge: &mut Judge) {
    for first in 1..5 {
        let (own, others) = points.as_flattened().split_at(3 * first);
        let Some(grid) = Grid::of(own) else { continue };
        let step = if own.iter().all(|x| *x == 0.0) { 200 } else { scale(own).min(200) };
        let holds = |x: &f64| {
            *x == 0.0 || {
                let whole = scale([x]);
                whole >= step && integer(x.abs(), step.min(whole)) <= BigInt::from(1_u64 << 53)
            }
        };
        for x in others {
            judge.equal(&format!("Grid of {own:?} holds {x:e}"), grid.holds(*x), holds(x));
        }
        judge.equal("Grid::holds_all", grid.holds_all(others), others.iter().all(holds));
    }
}
