//! The canonical constrained Delaunay triangulation by trying everything: all triples against all points and all
//! constraints, O(n^4 m).
//!
//! A counter-clockwise triangle belongs to it if it has no vertex in it or on it but its corners, no constraint enters
//! it, and no vertex that it sees is inside of its circle. A triangle sees what one of its inner points sees, and it
//! does not matter which one that is, so here it is the centroid, which is an integer point after scaling by three.
//!
//! Why one inner point q is enough: let T be a constrained triangulation in which the far corner across every edge that is no
//! constraint is outside of the circle, and t' its triangle that q is in. q sees the corners of t', so by the definition
//! the lifted plane of t' is nowhere below that of t at q; and walks from q to the corners of t, which it sees as well,
//! show the reverse. So the two are equal.

use num_bigint::BigInt;

use crate::brute::normalized;
use crate::exact::{Point2, in_circle, integers, sign};

/// The largest number of points for which the definition is tried.
pub const MAX_POINTS: usize = 40;

/// The distinct points in lexicographic order, with the side of each from the line through each two others.
struct Vertices {
    points: Vec<Point2>,
    /// Coordinates times three, as integers.
    exact: Vec<[BigInt; 2]>,
    sides: Vec<i8>,
}

pub(crate) fn side(a: &[BigInt; 2], b: &[BigInt; 2], c: &[BigInt; 2]) -> i8 {
    sign(&((&b[0] - &a[0]) * (&c[1] - &a[1]) - (&b[1] - &a[1]) * (&c[0] - &a[0])))
}

/// Whether a point on the line through two others is strictly between them.
pub(crate) fn is_between(a: &[BigInt; 2], b: &[BigInt; 2], p: &[BigInt; 2]) -> bool {
    let ahead = (&b[0] - &p[0]) * (&a[0] - &p[0]) + (&b[1] - &p[1]) * (&a[1] - &p[1]);
    sign(&ahead) < 0
}

impl Vertices {
    fn new(points: &[Point2]) -> Self {
        let mut points: Vec<Point2> = points.iter().map(|p| p.map(|x| x + 0.0)).collect();
        points.sort_by(|p, q| p.partial_cmp(q).expect("finite"));
        points.dedup();
        let n = points.len();
        assert!(n <= MAX_POINTS, "the definition is tried on at most {MAX_POINTS} points, not {n}");
        let exact: Vec<[BigInt; 2]> = integers(&points).into_iter().map(|p| p.map(|x| x * 3)).collect();
        let mut sides = vec![0; n * n * n];
        for i in 0..n {
            for j in i + 1..n {
                for k in j + 1..n {
                    let value = side(&exact[i], &exact[j], &exact[k]);
                    for [a, b, c] in [[i, j, k], [j, k, i], [k, i, j]] {
                        sides[(a * n + b) * n + c] = value;
                        sides[(b * n + a) * n + c] = -value;
                    }
                }
            }
        }
        Self { points, exact, sides }
    }

    fn side(&self, a: usize, b: usize, c: usize) -> i8 {
        let n = self.points.len();
        self.sides[(a * n + b) * n + c]
    }

    fn index(&self, p: Point2) -> usize {
        let found = self.points.binary_search_by(|q| q.partial_cmp(&p).expect("finite"));
        found.expect("a point of the set")
    }

    /// The segments cut at all vertices on them: each piece once, with its lesser end first.
    fn pieces(&self, points: &[Point2], segments: &[[usize; 2]]) -> Vec<[usize; 2]> {
        let mut pieces = Vec::new();
        for segment in segments {
            let mut ends = segment.map(|i| self.index(points[i].map(|x| x + 0.0)));
            // Along a line the lexicographic order is the order, or its reverse.
            ends.sort_unstable();
            let [a, b] = ends;
            let inside = |&v: &usize| {
                self.side(a, b, v) == 0 && is_between(&self.exact[a], &self.exact[b], &self.exact[v])
            };
            let chain: Vec<usize> =
                [a].into_iter().chain((0..self.points.len()).filter(inside)).chain([b]).collect();
            pieces.extend(chain.windows(2).filter(|link| link[0] != link[1]).map(|link| [link[0], link[1]]));
        }
        pieces.sort_unstable();
        pieces.dedup();
        pieces
    }

    /// Whether two edges cross inside of both.
    fn cross(&self, [a, b]: [usize; 2], [c, d]: [usize; 2]) -> bool {
        self.side(a, b, c) * self.side(a, b, d) < 0 && self.side(c, d, a) * self.side(c, d, b) < 0
    }

    /// Whether the open segment from an inner point of a triangle, which no constraint enters, to a vertex meets a constraint.
    fn hides(&self, inner: &[BigInt; 2], v: usize, [a, b]: [usize; 2]) -> bool {
        let (v, a, b) = (&self.exact[v], &self.exact[a], &self.exact[b]);
        let sides = [a, b].map(|end| side(inner, v, end));
        let meets_end = |end, side| side == 0 && is_between(inner, v, end);
        meets_end(a, sides[0])
            || meets_end(b, sides[1])
            || sides[0] * sides[1] < 0 && side(a, b, inner) * side(a, b, v) < 0
    }

    /// Whether a triangle belongs to the canonical triangulation.
    fn has(&self, corners: [usize; 3], constraints: &[[usize; 2]]) -> bool {
        let [a, b, c] = corners;
        let edges = [[a, b], [b, c], [c, a]];
        let others = || (0..self.points.len()).filter(|v| !corners.contains(v));
        if others().any(|v| edges.iter().all(|&[p, q]| self.side(p, q, v) >= 0)) {
            return false;
        }
        if constraints.iter().any(|&constraint| edges.iter().any(|&edge| self.cross(constraint, edge))) {
            return false;
        }
        let inner = [0, 1].map(|k| corners.iter().map(|&v| &self.exact[v][k]).sum::<BigInt>() / 3);
        let p = |v: usize| self.points[v];
        let sees = |v: usize| !constraints.iter().any(|&constraint| self.hides(&inner, v, constraint));
        !others().any(|v| in_circle(p(a), p(b), p(c), p(v)) > 0 && sees(v))
    }
}

/// The constraints that segments between points make: segments cut at all vertices on them, each piece once. Pieces as
/// coordinates, the lesser end first, sorted.
///
/// # Panics
/// With more than [`MAX_POINTS`] distinct points.
pub fn constraints(points: &[Point2], segments: &[[usize; 2]]) -> Vec<[Point2; 2]> {
    let vertices = Vertices::new(points);
    vertices.pieces(points, segments).into_iter().map(|piece| piece.map(|v| vertices.points[v])).collect()
}

/// The canonical constrained triangulation of points, which may be equal, with segments between them, which may overlap, repeat,
/// go through points and have no length. Triangles in the form of [`crate::brute::normalized`].
///
/// # Panics
/// With more than [`MAX_POINTS`] distinct points, and if two of the pieces of the segments cross.
pub fn triangulation(points: &[Point2], segments: &[[usize; 2]]) -> Vec<[Point2; 3]> {
    let vertices = Vertices::new(points);
    let constraints = vertices.pieces(points, segments);
    for (i, &first) in constraints.iter().enumerate() {
        let crossed = constraints[..i].iter().find(|second| vertices.cross(first, **second));
        assert!(crossed.is_none(), "constraints cross");
    }
    let n = vertices.points.len();
    let mut triangles = Vec::new();
    for i in 0..n {
        for j in i + 1..n {
            for k in j + 1..n {
                let corners = match vertices.side(i, j, k) {
                    1 => [i, j, k],
                    -1 => [i, k, j],
                    _ => continue,
                };
                if vertices.has(corners, &constraints) {
                    triangles.push(corners.map(|v| vertices.points[v]));
                }
            }
        }
    }
    normalized(triangles)
}

#[cfg(test)]
mod tests {
    use super::{constraints, triangulation};
    use crate::brute::delaunay;
    use crate::exact::{Point2, orient2d};
    use crate::samples::{Numbers, on_lattice};

    #[test]
    fn a_square_has_the_diagonal_that_is_asked_for() {
        let square = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        assert_eq!(triangulation(&square, &[]), delaunay(&square));
        assert_eq!(triangulation(&square, &[[2, 1]]), delaunay(&square));
        let other = [[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]]];
        assert_eq!(triangulation(&square, &[[3, 0]]), other);
    }

    #[test]
    fn a_wall_hides_what_is_behind_it() {
        // (2, 1) is inside of the circle of the lower three, but a wall stands before it.
        let points = [[0.0, 0.0], [4.0, 0.0], [2.0, -2.0], [2.0, 1.0], [2.0, 9.0]];
        let below = [[0.0, 0.0], [2.0, -2.0], [4.0, 0.0]];
        assert!(!triangulation(&points, &[]).contains(&below));
        assert!(triangulation(&points, &[[0, 1]]).contains(&below));
    }

    #[test]
    fn segments_are_cut_at_the_points_on_them() {
        let points = [[4.0, 0.0], [0.0, 0.0], [1.0, 0.0], [1.0, 3.0], [-0.0, 0.0]];
        let expected = [[[0.0, 0.0], [1.0, 0.0]], [[1.0, 0.0], [4.0, 0.0]]];
        assert_eq!(constraints(&points, &[[0, 1], [2, 4], [4, 1], [3, 3]]), expected);
    }

    #[test]
    fn flat_sets_have_constraints_and_no_triangles() {
        let points = [[0.0, 0.0], [3.0, 3.0], [1.0, 1.0]];
        assert!(triangulation(&points, &[[0, 1]]).is_empty());
        assert_eq!(constraints(&points, &[[0, 1]]).len(), 2);
        assert!(triangulation(&[], &[]).is_empty());
    }

    #[test]
    #[should_panic = "constraints cross"]
    fn crossings_are_refused() {
        triangulation(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]], &[[0, 1], [2, 3]]);
    }

    /// By the theorem the definition gives a triangulation, all constraints in it, and that of the points alone without any.
    #[test]
    fn the_hull_is_tiled_whatever_the_constraints() {
        let mut numbers = Numbers(1);
        for round in 0..300 {
            let (points, segments) = on_lattice(2 + round % 5, &mut numbers);
            let triangles = triangulation(&points, &segments);
            let edges: Vec<[Point2; 2]> =
                triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
            let is_border = |[a, b]: [Point2; 2]| !edges.contains(&[b, a]);
            let border: Vec<_> = edges.iter().copied().filter(|&edge| is_border(edge)).collect();
            let mut distinct = points.clone();
            distinct.sort_by(|p, q| p.partial_cmp(q).expect("finite"));
            distinct.dedup();
            if triangles.is_empty() {
                let flat =
                    distinct.iter().all(|&p| orient2d(distinct[0], distinct[distinct.len() - 1], p) == 0);
                assert!(flat, "{points:?} {segments:?}");
                continue;
            }
            assert_eq!(triangles.len() + 2 + border.len(), 2 * distinct.len(), "{points:?} {segments:?}");
            for &[a, b] in &border {
                assert!(distinct.iter().all(|&p| orient2d(a, b, p) >= 0), "{points:?} {segments:?}");
            }
            // Twice the area, exactly, by the triangles and by the border.
            let cross = |[[ax, ay], [bx, by]]: [Point2; 2]| ax * by - ay * bx;
            let area = |edges: &[[Point2; 2]]| edges.iter().map(|&edge| cross(edge)).sum::<f64>();
            assert_eq!(area(&edges), area(&border));
            for [a, b] in constraints(&points, &segments) {
                assert!(edges.contains(&[a, b]) || edges.contains(&[b, a]), "{points:?} {segments:?}");
            }
            assert_eq!(triangulation(&points, &[]), delaunay(&points));
            // Backwards, in another order, twice.
            let again: Vec<_> =
                segments.iter().rev().map(|&[a, b]| [b, a]).chain(segments.iter().copied()).collect();
            assert_eq!(triangulation(&points, &again), triangles);
        }
    }
}
