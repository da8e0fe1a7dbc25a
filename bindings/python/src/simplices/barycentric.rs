//! Maps to barycentric coordinates, where they are proved to be right.
//!
//! A map is NaN unless coordinates are right to a 50th for all points of the simplex. The determinant and its minors are sums of
//! products. Rounding changes a minor by less than 2.5 eps, the determinant by less than 4 eps of the sum of the sizes of these; the
//! first ones together are below the second one, divided by the sides. With [`MAX_SHIFT`] for eps times these sizes times the largest
//! coordinates, of which sides are at most twice, that is 2 * 2.5 + 2 * 4 thousandths, and four more for the rounding of what is
//! done with a map.

use crate::powers::{exponent, largest, times_power};

/// The largest shift of a barycentric coordinate that a change of a point in its last place may cause. A map that allows more is NaN.
const MAX_SHIFT: f64 = 1.0 / 1000.0;

/// A map, and the corner that it is from.
type Map<const D: usize, const W: usize> = [[f64; D]; W];

/// The minors of the rows of a matrix, and the sums of the sizes of the products that they are of.
type Minors<const D: usize> = fn(&[[f64; D]; D]) -> [[[f64; D]; D]; 2];

/// The map of a triangle.
pub fn in_plane(corners: [[f64; 2]; 3]) -> Map<2, 3> {
    map(&corners, |[[ax, ay], [bx, by]]| {
        let minors = [[*by, -bx], [-ay, *ax]];
        [minors, minors.map(|row| row.map(f64::abs))]
    })
}

/// The map of a tetrahedron.
pub fn in_space(corners: [[f64; 3]; 4]) -> Map<3, 4> {
    map(&corners, |[a, b, c]| {
        let minors = |minor: fn(f64, f64) -> f64| {
            [[b, c], [c, a], [a, b]]
                .map(|[p, q]| [[1, 2], [2, 0], [0, 1]].map(|[i, j]| minor(p[i] * q[j], p[j] * q[i])))
        };
        [minors(|one, other| one - other), minors(|one, other| one.abs() + other.abs())]
    })
}

fn map<const D: usize, const W: usize>(corners: &[[f64; D]; W], minors: Minors<D>) -> Map<D, W> {
    let last = corners[D];
    let mut sides: [[f64; D]; D] = std::array::from_fn(|k| std::array::from_fn(|i| corners[k][i] - last[i]));
    // By powers of two, which is exact: all axes and then all sides to one size, so that products stay in range.
    let by_axis: [i32; D] = std::array::from_fn(|i| exponent(largest(sides.map(|side| side[i]))));
    sides = sides.map(|side| std::array::from_fn(|i| times_power(side[i], -by_axis[i])));
    let by_side = sides.map(|side| exponent(largest(side)));
    sides = std::array::from_fn(|k| sides[k].map(|x| times_power(x, -by_side[k])));
    let [minors, sums] = minors(&sides);
    let determinant: f64 = (0..D).map(|i| sides[0][i] * minors[0][i]).sum();
    let back = |table: [[f64; D]; D]| -> [[f64; D]; D] {
        std::array::from_fn(|k| {
            std::array::from_fn(|i| times_power(table[k][i] / determinant, -by_side[k] - by_axis[i]))
        })
    };
    let (maps, sums) = (back(minors), back(sums));
    let last_place: [f64; D] =
        std::array::from_fn(|i| f64::EPSILON * largest(corners.map(|corner| corner[i])));
    let moved = |row: &[f64; D]| (0..D).map(|i| row[i].abs() * last_place[i]).sum::<f64>();
    // Products that have underflowed are not known to the last bit.
    let is_sound = sums.iter().all(|row| moved(row) < MAX_SHIFT)
        && determinant.abs() > 1e-250
        && maps.as_flattened().iter().all(|x| x.is_finite());
    if !is_sound {
        return [[f64::NAN; D]; W];
    }
    std::array::from_fn(|k| if k < D { maps[k] } else { last })
}
