//! The canonical triangulation by definition: lower faces of points lifted to |p|^2 plus an infinitesimal, which is
//! infinitely larger for lexicographically larger points. All simplices are tried against all points.

use super::exact::{Form, Vector, along, axes, cofactors, determinant, dot, integers, minus, sign};

/// Simplices as points, each sorted, all sorted.
pub(crate) type Simplices<const D: usize> = Vec<Vec<[f64; D]>>;

/// Distinct points in lexicographic order; negative zero is zero.
pub(crate) fn distinct<const D: usize>(points: &[[f64; D]]) -> Vec<[f64; D]> {
    let mut sorted: Vec<[f64; D]> = points.iter().map(|p| p.map(|x| x + 0.0)).collect();
    sorted.sort_by(|p, q| p.partial_cmp(q).expect("finite"));
    sorted.dedup();
    sorted
}

/// The dimension of the span of points: nothing is -1, a point 0, a line 1.
pub(crate) fn span<const D: usize>(points: &[[f64; D]]) -> isize {
    if points.is_empty() { -1 } else { axes(&integers(points)).len() as isize }
}

/// The simplices of the canonical triangulation, of the dimension that the points span.
pub(crate) fn delaunay<const D: usize>(points: &[[f64; D]]) -> Simplices<D> {
    let points = distinct(points);
    let exact = integers(&points);
    let axes = axes(&exact);
    if axes.is_empty() {
        return Vec::new();
    }
    let flat: Vec<Vector> = exact.iter().map(|p| along(p, &axes)).collect();
    let mut found = Vec::new();
    let mut corners = Vec::new();
    combinations(points.len(), axes.len() + 1, &mut corners, &mut |corners| {
        if is_lower(&exact, &flat, corners) {
            found.push(corners.iter().map(|&i| points[i]).collect());
        }
    });
    found
}

/// Whether no other point is inside of the sphere of a simplex, and it is one.
fn is_lower(points: &[Vector], flat: &[Vector], corners: &[usize]) -> bool {
    let lifted = |i: usize| {
        let mut row = minus(&flat[i], &flat[corners[0]]);
        let v = minus(&points[i], &points[corners[0]]);
        row.push(dot(&v, &v));
        row
    };
    let rows: Vec<Vector> = corners[1..].iter().map(|&i| lifted(i)).collect();
    // The last of the cofactors is the orientation of the simplex itself.
    let cofactors = cofactors(&rows);
    let side = cofactors.last().map_or(0, sign);
    side != 0
        && (0..points.len()).filter(|q| !corners.contains(q)).all(|q| {
            let height = match sign(&dot(&cofactors, &lifted(q))) {
                0 => tie(flat, corners, q),
                sign => sign,
            };
            height * side > 0
        })
}

/// The sign of the lifted determinant where its real part is zero: what the infinitesimals leave of it. Points are in
/// lexicographic order, so their indices are the ranks.
fn tie(flat: &[Vector], corners: &[usize], q: usize) -> i8 {
    let all: Vec<usize> = corners[1..].iter().copied().chain([q]).collect();
    let rows: Vec<Vector> = all.iter().map(|&i| minus(&flat[i], &flat[corners[0]])).collect();
    let mut sum = Form::new(0.into());
    for (i, &rank) in all.iter().enumerate() {
        let minor: Vec<Vector> = (0..rows.len()).filter(|&j| j != i).map(|j| rows[j].clone()).collect();
        let mut height = Form::infinitesimal(rank);
        height += -Form::infinitesimal(corners[0]);
        let term = height * &determinant(&minor);
        // The place of the height is in row i of the last column.
        sum += if (i + rows.len() - 1).is_multiple_of(2) { term } else { -term };
    }
    sum.sign()
}

/// The sign of the lifted determinant of d + 2 distinct points with d coordinates, the first d + 1 a simplex.
pub(crate) fn lifted_side<const D: usize>(points: &[[f64; D]], perturbed: bool) -> i8 {
    let exact = integers(points);
    let rows: Vec<Vector> = exact[1..]
        .iter()
        .map(|p| {
            let mut row = minus(p, &exact[0]);
            row.push(dot(&row, &row));
            row
        })
        .collect();
    let real = sign(&determinant(&rows));
    if real != 0 || !perturbed {
        return real;
    }
    // Indices are ranks once the points are in order.
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&i, &j| points[i].partial_cmp(&points[j]).expect("finite"));
    let sorted: Vec<Vector> = order.iter().map(|&i| exact[i].clone()).collect();
    let rank = |i: usize| order.iter().position(|&j| i == j).unwrap_or(i);
    let corners: Vec<usize> = (0..=D).map(rank).collect();
    tie(&sorted, &corners, rank(D + 1))
}

/// All increasing lists of so many numbers below n.
pub(crate) fn combinations(n: usize, count: usize, chosen: &mut Vec<usize>, each: &mut impl FnMut(&[usize])) {
    if chosen.len() == count {
        each(chosen);
        return;
    }
    for i in chosen.last().map_or(0, |last| last + 1)..n {
        chosen.push(i);
        combinations(n, count, chosen, each);
        chosen.pop();
    }
}

#[cfg(test)]
mod tests {
    use super::{combinations, delaunay, lifted_side, span};

    #[test]
    fn a_square_has_the_diagonal_that_leaves_its_largest_corner_out() {
        let square = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        let expected =
            vec![vec![[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]], vec![[0.0, 1.0], [1.0, 0.0], [1.0, 1.0]]];
        assert_eq!(delaunay(&square), expected);
        // The largest is out of the circle of the others: above their plane, which is seen counter-clockwise.
        assert_eq!(lifted_side(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]], true), 1);
        assert_eq!(lifted_side(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]], false), 0);
        assert_eq!(lifted_side(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], true), -1);
        assert_eq!(lifted_side(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5]], true), -1);
    }

    #[test]
    fn a_point_inside_of_a_circle_takes_it_apart() {
        let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [1.0, 1.0], [1.0, 1.0]];
        assert_eq!(delaunay(&points).len(), 3);
    }

    #[test]
    fn lines_have_their_segments_and_planes_in_space_their_triangles() {
        assert_eq!(delaunay(&[[2.0, 2.0], [0.0, 0.0], [1.0, 1.0]]).len(), 2);
        let flat = [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 1.0, 1.0]];
        assert_eq!(delaunay(&flat).len(), 2);
        assert_eq!(span(&flat), 2);
        assert_eq!([span::<2>(&[]), span(&[[1.0, 1.0]; 3])], [-1, 0]);
        assert!(delaunay(&[[1.0, 1.0]; 3]).is_empty());
    }

    #[test]
    fn a_cube_is_filled() {
        let cube: Vec<[f64; 3]> = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from)).collect();
        let cells = delaunay(&cube);
        let volume = |t: &Vec<[f64; 3]>| {
            let [u, v, w] = [1, 2, 3].map(|i| [0, 1, 2].map(|k| t[i][k] - t[0][k]));
            let cross = |a: usize, b: usize| u[a] * v[b] - u[b] * v[a];
            (w[0] * cross(1, 2) + w[1] * cross(2, 0) + w[2] * cross(0, 1)).abs()
        };
        assert_eq!(cells.iter().map(volume).sum::<f64>(), 6.0);
        // (1, 1, 1) is raised most: its cell is the corner alone.
        assert_eq!(cells.iter().filter(|t| t.contains(&[1.0; 3])).count(), 1);
    }

    #[test]
    fn all_combinations() {
        let mut count = 0;
        combinations(6, 3, &mut Vec::new(), &mut |_| count += 1);
        assert_eq!(count, 20);
    }
}
