//! Planes of simplices that are lifted to the paraboloid: normals of length 1, and offsets. In floating point, for those who look at
//! them; no decision is made by them.

/// A corner with the square of its distance from the origin.
fn lift<const D: usize, const W: usize>(corner: [f64; D]) -> [f64; W] {
    let square = corner.iter().map(|x| x * x).sum();
    std::array::from_fn(|k| if k < D { corner[k] } else { square })
}

/// The plane of a triangle.
pub fn in_plane(corners: [[f64; 2]; 3], is_up: bool) -> [f64; 4] {
    let [first, others @ ..] = corners.map(lift::<2, 3>);
    let [p, q] = others.map(|corner| difference(corner, first));
    plane([minor(p, q, [1, 2]), -minor(p, q, [0, 2]), minor(p, q, [0, 1])], first, is_up)
}

/// The plane of a tetrahedron.
pub fn in_space(corners: [[f64; 3]; 4], is_up: bool) -> [f64; 5] {
    let [first, others @ ..] = corners.map(lift::<3, 4>);
    let [p, q, r] = others.map(|corner| difference(corner, first));
    let determinant = |[x, y, z]: [usize; 3]| {
        p[x] * minor(q, r, [y, z]) - p[y] * minor(q, r, [x, z]) + p[z] * minor(q, r, [x, y])
    };
    let normal = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]].map(determinant);
    plane([normal[0], -normal[1], normal[2], -normal[3]], first, is_up)
}

fn difference<const W: usize>(a: [f64; W], b: [f64; W]) -> [f64; W] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn minor<const W: usize>(p: [f64; W], q: [f64; W], [i, j]: [usize; 2]) -> f64 {
    p[i] * q[j] - p[j] * q[i]
}

/// The plane with a normal through a point; NaN where the normal is level.
fn plane<const W: usize, const N: usize>(normal: [f64; W], through: [f64; W], is_up: bool) -> [f64; N] {
    let upright = normal[W - 1];
    let sign = if upright == 0.0 { 0.0 } else { upright.signum() } * if is_up { 1.0 } else { -1.0 };
    let directed = normal.map(|x| x * sign);
    let length = directed.iter().map(|x| x * x).sum::<f64>().sqrt();
    let unit = directed.map(|x| x / length);
    let offset = -unit.iter().zip(through).map(|(n, x)| n * x).sum::<f64>();
    std::array::from_fn(|k| if k < W { unit[k] } else { offset })
}
