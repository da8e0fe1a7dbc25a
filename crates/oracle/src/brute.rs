//! The canonical Delaunay triangulation by trying everything: all triples against all points, O(n^4).

use crate::exact::{Point2, Point3, in_circle, in_sphere, orient2d, orient3d};

/// All counter-clockwise triangles of up to 64 distinct points, each with the points inside its circle.
/// Built once, it answers for every subset.
pub struct Table {
    points: Vec<Point2>,
    triangles: Vec<([u8; 3], u64)>,
}

impl Table {
    /// Tries all triples against all points.
    ///
    /// # Panics
    /// With more than 64 points.
    pub fn new(points: &[Point2]) -> Self {
        let n = points.len();
        assert!(n <= 64, "the table holds at most 64 points, not {n}");
        let mut triangles = Vec::new();
        for i in 0..n {
            for j in i + 1..n {
                for k in j + 1..n {
                    let (j, k) = match orient2d(points[i], points[j], points[k]) {
                        1 => (j, k),
                        -1 => (k, j),
                        _ => continue,
                    };
                    let inside = |&q: &usize| {
                        ![i, j, k].contains(&q) && in_circle(points[i], points[j], points[k], points[q]) > 0
                    };
                    let conflicts = (0..n).filter(inside).fold(0, |mask, q| mask | 1 << q);
                    triangles.push(([i as u8, j as u8, k as u8], conflicts));
                }
            }
        }
        Self { points: points.to_vec(), triangles }
    }

    /// The canonical triangulation of the points whose bits are set, as sorted triples of coordinates
    /// (see [`normalized`]).
    pub fn delaunay(&self, subset: u64) -> Vec<[Point2; 3]> {
        let chosen = self.triangles.iter().filter(|(corners, conflicts)| {
            corners.iter().all(|&v| subset >> v & 1 == 1) && conflicts & subset == 0
        });
        let coordinates = |corners: &[u8; 3]| corners.map(|v| self.points[usize::from(v)]);
        normalized(chosen.map(|(corners, _)| coordinates(corners)))
    }
}

/// The canonical triangulation of `points` (duplicates allowed, at most 64 distinct).
pub fn delaunay(points: &[Point2]) -> Vec<[Point2; 3]> {
    let mut distinct: Vec<Point2> = points.to_vec();
    distinct.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
    distinct.dedup();
    Table::new(&distinct).delaunay(u64::MAX)
}

/// A set of triangles in a form that can be compared: each starts at its lexicographically smallest corner,
/// orientation kept; all sorted; negative zero made zero.
pub fn normalized(triangles: impl IntoIterator<Item = [Point2; 3]>) -> Vec<[Point2; 3]> {
    let rotate = |triangle: [Point2; 3]| {
        let [a, b, c] = triangle.map(|p| p.map(|x| x + 0.0));
        if a < b && a < c {
            [a, b, c]
        } else if b < a && b < c {
            [b, c, a]
        } else {
            [c, a, b]
        }
    };
    let mut sorted: Vec<_> = triangles.into_iter().map(rotate).collect();
    sorted.sort_by(|s, t| s.partial_cmp(t).expect("finite"));
    sorted
}

/// The canonical triangulation of points in space (duplicates allowed): all quadruples against all points, O(n^5).
/// Tetrahedra as sorted quadruples of coordinates, sorted.
pub fn delaunay3(points: &[Point3]) -> Vec<[Point3; 4]> {
    let mut distinct: Vec<Point3> = points.iter().map(|p| p.map(|x| x + 0.0)).collect();
    distinct.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
    distinct.dedup();
    let (n, p) = (distinct.len(), &distinct);
    let mut tetrahedra = Vec::new();
    for i in 0..n {
        for j in i + 1..n {
            for k in j + 1..n {
                for l in k + 1..n {
                    let side = orient3d(p[i], p[j], p[k], p[l]);
                    let inside = |q: usize| in_sphere(p[i], p[j], p[k], p[l], p[q]) * side > 0;
                    if side != 0 && !(0..n).any(|q| ![i, j, k, l].contains(&q) && inside(q)) {
                        tetrahedra.push([p[i], p[j], p[k], p[l]]);
                    }
                }
            }
        }
    }
    tetrahedra
}

/// The canonical triangulation of coplanar points in space: those triangles that a point off the plane sees in their
/// own circles, by the same definition one dimension down. Triangles as sorted triples of coordinates, sorted.
pub fn delaunay_of_plane(points: &[Point3], apex: Point3) -> Vec<[Point3; 3]> {
    let mut distinct: Vec<Point3> = points.iter().map(|p| p.map(|x| x + 0.0)).collect();
    distinct.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
    distinct.dedup();
    let (n, p) = (distinct.len(), &distinct);
    let mut triangles = Vec::new();
    for i in 0..n {
        for j in i + 1..n {
            for k in j + 1..n {
                let side = orient3d(p[i], p[j], p[k], apex);
                let inside = |q: usize| in_sphere(p[i], p[j], p[k], apex, p[q]) * side > 0;
                if side != 0 && !(0..n).any(|q| ![i, j, k].contains(&q) && inside(q)) {
                    triangles.push([p[i], p[j], p[k]]);
                }
            }
        }
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::delaunay;

    #[test]
    fn a_square_has_its_canonical_diagonal() {
        let square = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        // (1, 1) is raised, so the other three keep their triangle.
        let expected = [[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], [[0.0, 1.0], [1.0, 0.0], [1.0, 1.0]]];
        assert_eq!(delaunay(&square), expected);
    }

    #[test]
    fn degenerate_sets_have_no_triangle() {
        assert!(delaunay(&[]).is_empty());
        assert!(delaunay(&[[1.0, 2.0]; 5]).is_empty());
        assert!(delaunay(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [-5.0, -5.0]]).is_empty());
    }
}
