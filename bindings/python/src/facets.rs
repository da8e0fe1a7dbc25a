//! Normals and sizes of the facets of a hull that is a body, in floating point. Corners are scaled by powers of two, so that no product
//! leaves the range.

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::powers::{exponent, largest, times_power};
use crate::simplices::of_corners;

/// Normals of length 1 that point outside, and offsets: (n, ndim + 1). In space facets may be parts of faces, given by the index of that of
/// each: all parts of a face have one plane, whose normal is their mean by area, and which has none of their corners outside.
#[pyfunction]
#[pyo3(signature = (points, parts, faces=None))]
pub fn facet_equations<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    parts: PyReadonlyArray2<'py, i32>,
    faces: Option<PyReadonlyArray1<'py, i32>>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let count = parts.shape()[0];
    if points.shape()[1] == 2 {
        let plane = |[a, b]: [[f64; 2]; 2]| {
            let [x, y] = unit(between(a, b));
            with_offset([y, -x], a)
        };
        let equations: Vec<[f64; 3]> = of_corners(py, &points, &parts, plane)?;
        return PyArray1::from_vec(py, equations.into_flattened()).reshape([count, 3]);
    }
    let mut equations: Vec<[f64; 4]> = of_corners(py, &points, &parts, plane_of)?;
    if let Some(faces) = faces {
        let faces = faces.as_slice()?;
        if faces.len() != count || faces.iter().any(|&face| face < 0) {
            return Err(PyValueError::new_err("a face for each part"));
        }
        let corners: Vec<[[f64; 3]; 3]> = of_corners(py, &points, &parts, |corners| corners)?;
        join(&mut equations, &corners, faces);
    }
    PyArray1::from_vec(py, equations.into_flattened()).reshape([count, 4])
}

/// The part of products with twice the digits, 2^-104 of which is rounding, below which a difference of them is made exactly: 2^-40, so that 2^-64
/// of it is.
const CANCELLED: f64 = 9.094_947_017_729_282e-13;

/// The plane of a triangle. Its normal comes of products with twice the digits: the sides of a needle are nearly parallel, and ordinary ones
/// would leave nothing but rounding. The offset is that of the corner nearest to the origin, which is rounded least.
fn plane_of(corners: [[f64; 3]; 3]) -> [f64; 4] {
    let power = corners.iter().fold(0.0, |most, &corner| largest(corner).max(most));
    let [first, second, third] = corners.map(|corner| corner.map(|x| times_power(x, -exponent(power))));
    let side = |to: [f64; 3]| {
        let parts: [[f64; 2]; 3] = std::array::from_fn(|k| two_sum(to[k], -first[k]));
        let power = exponent(largest(parts.map(|part| part[0])));
        parts.map(|part| part.map(|x| times_power(x, -power)))
    };
    let (one, other) = (side(second), side(third));
    let normal = std::array::from_fn(|k| {
        let [i, j] = [(k + 1) % 3, (k + 2) % 3];
        let ([p, p_rest], [q, q_rest]) = (product(one[i], other[j]), product(one[j], other[i]));
        let [sum, rest] = two_sum(p, -q);
        let found = sum + (rest + (p_rest - q_rest));
        if found.abs() > CANCELLED * p.abs() { found } else { exact(one[i], other[j], one[j], other[i]) }
    });
    let near = corners.into_iter().min_by(|&p, &q| largest(p).total_cmp(&largest(q)));
    with_offset(unit(normal), near.unwrap_or(corners[0]))
}

/// A sum, and what rounding has taken from it.
///
/// Source: Knuth, "The art of computer programming" 2, section 4.2.2, theorem B.
fn two_sum(a: f64, b: f64) -> [f64; 2] {
    let sum = a + b;
    let from_b = sum - a;
    [sum, (a - (sum - from_b)) + (b - from_b)]
}

/// The difference of two products of numbers with twice the digits, rounded once or twice.
///
/// Source: Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997, section 2.4.
fn exact(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> f64 {
    let mut parts: Vec<f64> = Vec::with_capacity(16);
    let pairs = [(a, b, 1.0), (c, d, -1.0)];
    let factors =
        pairs.into_iter().flat_map(|(x, y, sign)| x.into_iter().flat_map(move |x| y.map(|y| (sign * x, y))));
    for term in factors.flat_map(|(x, y)| [x * y, x.mul_add(y, -(x * y))]) {
        let (mut carry, mut kept) = (term, 0);
        for k in 0..parts.len() {
            let [sum, rest] = two_sum(carry, parts[k]);
            if rest != 0.0 {
                parts[kept] = rest;
                kept += 1;
            }
            carry = sum;
        }
        parts.truncate(kept);
        parts.push(carry);
    }
    parts.iter().sum()
}

/// A product of two numbers with twice the digits, and what rounding has taken from it.
fn product([a, a_rest]: [f64; 2], [b, b_rest]: [f64; 2]) -> [f64; 2] {
    let whole = a * b;
    [whole, a.mul_add(b, -whole) + (a * b_rest + a_rest * b)]
}

/// Gives the parts of faces that have several one plane.
fn join(equations: &mut [[f64; 4]], corners: &[[[f64; 3]; 3]], faces: &[i32]) {
    let count = faces.iter().max().map_or(0, |&most| most as usize + 1);
    let (mut counts, mut sums) = (vec![0; count], vec![[0.0; 3]; count]);
    let scaled = scaled(corners.to_vec()).0;
    for ((&[a, b, c], equation), &face) in scaled.iter().zip(&*equations).zip(faces) {
        let area = length(cross(difference(b, a), difference(c, a)));
        let sum = &mut sums[face as usize];
        counts[face as usize] += 1;
        *sum = std::array::from_fn(|k| sum[k] + area * equation[k]);
    }
    let is_joined = |face: i32| counts[face as usize] > 1 && largest(sums[face as usize]) > 0.0;
    let normals: Vec<[f64; 3]> = sums.iter().map(|&sum| unit(sum)).collect();
    let mut offsets = vec![f64::INFINITY; count];
    for (corners, &face) in corners.iter().zip(faces) {
        let offset = &mut offsets[face as usize];
        *offset = corners.iter().fold(*offset, |least, &p| least.min(-dot(normals[face as usize], p)));
    }
    for (equation, &face) in equations.iter_mut().zip(faces).filter(|&(_, &face)| is_joined(face)) {
        let [x, y, z] = normals[face as usize];
        *equation = [x, y, z, offsets[face as usize]];
    }
}

/// The area of the surface and the volume inside; in the plane the length around and the area inside.
#[pyfunction]
pub fn facet_sizes(
    py: Python<'_>,
    points: PyReadonlyArray2<'_, f64>,
    facets: PyReadonlyArray2<'_, i32>,
) -> PyResult<(f64, f64)> {
    if points.shape()[1] == 2 {
        let corners: Vec<[[f64; 2]; 2]> = of_corners(py, &points, &facets, |corners| corners)?;
        let (corners, power) = scaled(corners);
        let around = sum(&corners, |&[a, b]| length(difference(b, a)));
        let twice = sum(&corners, |&[a, b]| a[0] * b[1] - a[1] * b[0]);
        Ok((times_power(around, power), times_power(twice / 2.0, 2 * power)))
    } else {
        let corners: Vec<[[f64; 3]; 3]> = of_corners(py, &points, &facets, |corners| corners)?;
        let (corners, power) = scaled(corners);
        let twice = sum(&corners, |&[a, b, c]| length(cross(difference(b, a), difference(c, a))));
        let six = sum(&corners, |&[a, b, c]| dot(a, cross(b, c)));
        Ok((times_power(twice / 2.0, 2 * power), times_power(six / 6.0, 3 * power)))
    }
}

/// Corners of facets seen from one of them, divided by a power of two, and this.
fn scaled<const D: usize>(facets: Vec<[[f64; D]; D]>) -> (Vec<[[f64; D]; D]>, i32) {
    let (facets, far) = shrunk(facets);
    let seen_from = facets.first().map_or([0.0; D], |facet| facet[0]);
    let (facets, near) =
        shrunk(facets.into_iter().map(|facet| facet.map(|corner| difference(corner, seen_from))).collect());
    (facets, far + near)
}

/// Numbers divided by the power of two that makes the largest about one, and this.
fn shrunk<const D: usize>(mut facets: Vec<[[f64; D]; D]>) -> (Vec<[[f64; D]; D]>, i32) {
    let most = facets.as_flattened().iter().fold(0.0, |most, &corner| largest(corner).max(most));
    let power = exponent(most);
    for x in facets.as_flattened_mut().as_flattened_mut() {
        *x = times_power(*x, -power);
    }
    (facets, power)
}

/// From one corner to another; half of it where the whole is out of range.
fn between<const D: usize>(from: [f64; D], to: [f64; D]) -> [f64; D] {
    let whole = difference(to, from);
    if whole.iter().all(|x| x.is_finite()) {
        return whole;
    }
    difference(to.map(|x| x / 2.0), from.map(|x| x / 2.0))
}

/// A vector of length 1; squares stay in range.
fn unit<const D: usize>(vector: [f64; D]) -> [f64; D] {
    let power = exponent(largest(vector));
    let vector = vector.map(|x| times_power(x, -power));
    let length = length(vector);
    vector.map(|x| x / length)
}

fn with_offset<const D: usize, const W: usize>(normal: [f64; D], corner: [f64; D]) -> [f64; W] {
    let offset = -dot(normal, corner);
    std::array::from_fn(|k| if k < D { normal[k] } else { offset })
}

fn difference<const D: usize>(a: [f64; D], b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn length<const D: usize>(vector: [f64; D]) -> f64 {
    dot(vector, vector).sqrt()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A sum of sums, which rounds less than one after the other.
fn sum<T>(items: &[T], term: impl Fn(&T) -> f64) -> f64 {
    items.chunks(128).map(|items| items.iter().map(&term).sum::<f64>()).fold(0.0, |sum, part| sum + part)
}
