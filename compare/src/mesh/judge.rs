//! The verdict on a mesh, from its coordinates alone: which triangles have an angle that is too small, in floating point where
//! that is far from wrong and in big integers where it is not.

use delone_oracle::exact::orient2d;
use num_bigint::BigInt;

use super::chains::lost;
use super::input::Input;
use super::wedges::Wedges;

/// Points, and triangles of them.
#[derive(Default)]
pub struct Mesh {
    pub points: Vec<[f64; 2]>,
    pub triangles: Vec<[usize; 3]>,
}

/// The measures of a mesh.
#[derive(Clone, Default)]
pub struct Verdict {
    /// Triangles that have an angle below the bound.
    pub below: usize,
    /// Bad triangles at a small angle of the input, which nobody can avoid.
    pub excused: usize,
    /// The smallest angle of all: degrees.
    pub smallest: f64,
    /// Its fault as a mesh of the inside.
    pub wrong: Option<String>,
}

/// The square of the sine of an angle, less four units in the last place: nobody is judged by how the sine is rounded.
pub fn least_square_of_sine(degrees: f64) -> f64 {
    degrees.to_radians().sin().powi(2) * (1.0 - 4.0 * f64::EPSILON)
}

/// Judges all triangles, O(n log n). `left` is how many the engine says it could not refine.
pub fn judge(input: &Input, wedges: &Wedges, mesh: &Mesh, angle: f64, left: Option<usize>) -> Verdict {
    let bound = least_square_of_sine(angle);
    let mut verdict =
        Verdict { smallest: 180.0, wrong: not_a_mesh_of(input, mesh).err(), ..Verdict::default() };
    if verdict.wrong.is_some() {
        return verdict;
    }
    for t in &mesh.triangles {
        let corners = t.map(|i| mesh.points[i]);
        let (degrees, shortest) = smallest_angle(corners);
        verdict.smallest = verdict.smallest.min(degrees);
        if is_below(corners, bound) {
            verdict.below += 1;
            verdict.excused += usize::from(wedges.join(shortest));
        }
    }
    if let Some(left) = left.filter(|&left| left < verdict.below) {
        verdict.wrong = Some(format!("{} angles are too small, of which it says {left}", verdict.below));
    }
    verdict
}

/// Whether all input points are there, triangles turn left, no edge has two triangles on one side, the areas add up, and all
/// segments are there.
fn not_a_mesh_of(input: &Input, mesh: &Mesh) -> Result<(), String> {
    let n = mesh.points.len();
    if mesh.triangles.is_empty() || mesh.triangles.iter().flatten().any(|&i| i >= n) {
        return Err("has no triangles, or of no points".to_owned());
    }
    let order = |p: &[f64; 2], q: &[f64; 2]| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1]));
    let mut there = mesh.points.clone();
    there.sort_by(order);
    if input.points.iter().any(|p| there.binary_search_by(|q| order(q, p)).is_err()) {
        return Err("loses points".to_owned());
    }
    if let Some(t) = mesh.triangles.iter().position(|t| !turns_left(t.map(|i| mesh.points[i]))) {
        return Err(format!("triangle {t} does not turn left"));
    }
    let mut edges: Vec<[usize; 2]> =
        mesh.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    edges.sort_unstable();
    if edges.array_windows().any(|[e, f]| e == f) {
        return Err("triangles overlap".to_owned());
    }
    let area: f64 = mesh.triangles.iter().map(|t| cross(t.map(|i| mesh.points[i])).0 / 2.0).sum();
    if (area - input.area).abs() > 1e-6 * input.area {
        return Err(format!("has {:.4} of the area", area / input.area));
    }
    lost(input, mesh).map_or(Ok(()), |k| Err(format!("loses segment {k}")))
}

/// The vectors from the first corner to the others.
fn legs([o, p, q]: [[f64; 2]; 3]) -> [[f64; 2]; 2] {
    [[p[0] - o[0], p[1] - o[1]], [q[0] - o[0], q[1] - o[1]]]
}

/// Twice the area, and a number that its rounding error is less than 1e-15 times.
fn cross(corners: [[f64; 2]; 3]) -> (f64, f64) {
    let [u, v] = legs(corners);
    let (left, right) = (u[0] * v[1], u[1] * v[0]);
    (left - right, left.abs() + right.abs())
}

fn turns_left(corners: [[f64; 2]; 3]) -> bool {
    let (value, magnitude) = cross(corners);
    if value.abs() > 1e-14 * magnitude {
        value > 0.0
    } else {
        orient2d(corners[0], corners[1], corners[2]) > 0
    }
}

/// The corners, each of them first.
fn turned([a, b, c]: [[f64; 2]; 3]) -> [[[f64; 2]; 3]; 3] {
    [[a, b, c], [b, c, a], [c, a, b]]
}

/// In degrees, rounded; and the edge on the other side.
fn smallest_angle(corners: [[f64; 2]; 3]) -> (f64, [[f64; 2]; 2]) {
    let angles = turned(corners).map(|[o, p, q]| {
        let [u, v] = legs([o, p, q]);
        let dot = u[0] * v[0] + u[1] * v[1];
        (cross([o, p, q]).0.atan2(dot).to_degrees(), [p, q])
    });
    angles.into_iter().reduce(|a, b| if b.0 < a.0 { b } else { a }).unwrap_or(angles[0])
}

/// Whether the square of the sine of some angle is less, for a bound of at most 3/4: an angle near a straight one has two small
/// ones beside it.
fn is_below(corners: [[f64; 2]; 3], bound: f64) -> bool {
    turned(corners).into_iter().any(|corners| {
        let [u, v] = legs(corners);
        let (value, magnitude) = cross(corners);
        let lengths = (u[0] * u[0] + u[1] * u[1]) * (v[0] * v[0] + v[1] * v[1]);
        let square = value * value;
        // Twice the error of the square, ten times that of the lengths.
        let error = 2e-14 * value.abs() * magnitude + 1e-14 * bound * lengths;
        if (square - bound * lengths).abs() > error {
            square < bound * lengths
        } else {
            is_below_exactly(corners, bound)
        }
    })
}

fn is_below_exactly(corners: [[f64; 2]; 3], bound: f64) -> bool {
    let scale = corners.iter().flatten().map(|&x| parts(x).1).min().unwrap_or(0);
    let [o, p, q] = corners.map(|p| p.map(|x| integer(x, scale)));
    let [u, v] = [p, q].map(|p| [&p[0] - &o[0], &p[1] - &o[1]]);
    let cross = &u[0] * &v[1] - &u[1] * &v[0];
    let lengths = [u, v].map(|u| &u[0] * &u[0] + &u[1] * &u[1]);
    let (digits, exponent) = parts(bound);
    // The bound is less than one: its exponent is not positive.
    let square = (&cross * &cross) << exponent.unsigned_abs();
    square < BigInt::from(digits) * &lengths[0] * &lengths[1]
}

/// Digits and an exponent of 2.
fn parts(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let exponent = ((bits >> 52) & 0x7ff) as i32;
    let digits = (bits & 0x000f_ffff_ffff_ffff) as i64;
    let digits = if exponent == 0 { digits } else { digits | 1 << 52 };
    (if x < 0.0 { -digits } else { digits }, exponent.max(1) - 1075)
}

fn integer(x: f64, scale: i32) -> BigInt {
    let (digits, exponent) = parts(x);
    BigInt::from(digits) << (exponent - scale)
}

#[cfg(test)]
mod tests {
    use super::{
        Mesh, Wedges, is_below, is_below_exactly, judge, least_square_of_sine, parts, smallest_angle, turned,
    };
    use crate::mesh::input::Input;

    /// A triangle with an angle of 10 degrees at its first corner.
    fn wedge() -> Input {
        let end = [10_f64.to_radians().cos(), 10_f64.to_radians().sin()];
        Input {
            name: String::new(),
            points: vec![[0.0, 0.0], [1.0, 0.0], end],
            segments: vec![[0, 1], [1, 2], [2, 0]],
            holes: vec![],
            is_hull: true,
            area: end[1] / 2.0,
        }
    }

    #[test]
    fn small_angles_of_the_input_are_excused_and_no_others() {
        let input = wedge();
        let wedges = Wedges::new(&input);
        let verdict = |mesh: &Mesh, left| judge(&input, &wedges, mesh, 20.0, left);
        let mesh = Mesh { points: input.points.clone(), triangles: vec![[0, 1, 2]] };
        let found = verdict(&mesh, Some(1));
        assert_eq!((found.below, found.excused, found.wrong), (1, 1, None));
        assert!((found.smallest - 10.0).abs() < 1e-9, "{}", found.smallest);
        assert!(verdict(&mesh, Some(0)).wrong.is_some(), "the report is not true");
        // From the corner to the middle of the other side: two halves, of which neither joins both sides.
        let middle = [0, 1].map(|k| (input.points[1][k] + input.points[2][k]) / 2.0);
        let points = input.points.iter().copied().chain([middle]).collect();
        let found = verdict(&Mesh { points, triangles: vec![[0, 1, 3], [0, 3, 2]] }, None);
        assert_eq!((found.below, found.excused, found.wrong), (2, 0, None));
    }

    #[test]
    fn what_is_no_mesh_of_the_inside_is_found() {
        let input = Input {
            points: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            segments: vec![[0, 1], [1, 2], [2, 3], [3, 0]],
            area: 1.0,
            ..wedge()
        };
        let wedges = Wedges::new(&input);
        let wrong = |points: &[[f64; 2]], triangles: &[[usize; 3]]| {
            let mesh = Mesh { points: points.to_vec(), triangles: triangles.to_vec() };
            judge(&input, &wedges, &mesh, 20.0, None).wrong
        };
        let points = input.points.as_slice();
        assert_eq!(wrong(points, &[[0, 1, 2], [0, 2, 3]]), None);
        type Case<'a> = (&'a [[f64; 2]], &'a [[usize; 3]], &'a str);
        let cases: [Case; 6] = [
            (points, &[], "has no triangles"),
            (points, &[[0, 1, 4]], "has no triangles"),
            (&points[..3], &[[0, 1, 2]], "loses points"),
            (points, &[[0, 1, 2], [0, 3, 2]], "triangle 1 does not turn left"),
            (points, &[[0, 1, 2], [0, 1, 3]], "triangles overlap"),
            (points, &[[0, 1, 2]], "has 0.5000 of the area"),
        ];
        for (points, triangles, why) in cases {
            let found = wrong(points, triangles).unwrap_or_default();
            assert!(found.starts_with(why), "{found} for {why}");
        }
    }

    #[test]
    fn digits_and_exponents_are_the_number() {
        for x in [0.0, 1.0, -3.25, 1e-310, f64::MAX, 0.1] {
            let (digits, exponent) = parts(x);
            let half = 2_f64.powi(exponent / 2);
            assert_eq!(digits as f64 * half * half * 2_f64.powi(exponent % 2), x);
        }
    }

    #[test]
    fn a_right_triangle_is_at_its_bound_and_one_step_away_it_is_not() {
        // The angle whose sine is 3/5: its square is no double, so the bounds are on both sides of it.
        let at = |x: f64| [[0.0, 0.0], [4.0, 0.0], [x, 3.0]];
        assert!(!is_below(at(4.0), 0.36_f64.next_down()));
        assert!(is_below(at(4.0), 0.36_f64.next_up()));
        // Half of a right angle, whose square is 1/2: less as the last corner goes right, more as it goes left.
        let half = |x: f64| [[0.0, 0.0], [1.0, 0.0], [x, 1.0]];
        assert!(!is_below(half(1.0), 0.5));
        assert!(is_below(half(1.0_f64.next_up()), 0.5));
        assert!(!is_below(half(1.0_f64.next_down()), 0.5));
    }

    #[test]
    fn the_quick_answer_is_the_exact_one() {
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 40) as f64 / 64.0 - 130_000.0
        };
        let mut below = 0;
        for _ in 0..2000 {
            let corners = [(); 3].map(|()| [next(), next()]);
            let (degrees, _) = smallest_angle(corners);
            for angle in [degrees - 1e-9, degrees + 1e-9, 20.0, 33.0] {
                let bound = least_square_of_sine(angle.clamp(0.0, 60.0));
                let exact = turned(corners).into_iter().any(|corners| is_below_exactly(corners, bound));
                assert_eq!(is_below(corners, bound), exact, "{corners:?} at {angle}");
                below += usize::from(exact);
            }
        }
        assert!((2000..6000).contains(&below), "{below}");
    }
}
