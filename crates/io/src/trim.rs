//! What is left out of a triangulation that is written.

use std::collections::VecDeque;

use delone::{Coordinates, Triangulation};

/// Simplices that are left out.
#[derive(Clone, Debug)]
pub struct Trim {
    /// By the index of the simplex.
    left_out: Vec<bool>,
    count: usize,
}

/// A plane that takes away the simplices whose middle is beyond it.
#[derive(Clone, Copy, Debug)]
pub struct Cut {
    /// The side that is taken away.
    pub normal: [f64; 3],
    /// What the scalar product of the normal and a point of the plane is.
    pub offset: f64,
}

impl Trim {
    /// Leaves out simplices with an edge longer than `longest`, from the hull inwards: as long as they are next to
    /// nothing or to one that is left out. Long ones in the middle stay. Lengths are rounded. O(n).
    pub fn long_edges<T: Triangulation>(t: &T, longest: f64) -> Self {
        let facets = 0..=T::Point::COUNT;
        let is_long = |s: T::Simplex| {
            let corners = t.corners(s);
            let ends: Vec<T::Point> = corners.as_ref().iter().filter_map(|&v| t.position(v)).collect();
            let pairs = ends.iter().enumerate().flat_map(|(i, p)| ends[..i].iter().map(move |q| (p, q)));
            pairs.into_iter().any(|(p, q)| distance(*p, *q) > longest)
        };
        let at_border = |s: &T::Simplex| facets.clone().any(|k| t.across(*s, k).is_none());
        let mut waiting: VecDeque<T::Simplex> = t.simplices().filter(at_border).collect();
        let mut trim = Self { left_out: vec![false; t.slot_count()], count: 0 };
        while let Some(s) = waiting.pop_front() {
            if trim.keeps(t.index(s)) && is_long(s) {
                trim.leave_out(t.index(s));
                waiting.extend(facets.clone().filter_map(|k| t.across(s, k)));
            }
        }
        trim
    }

    /// Leaves out what is beyond a plane.
    pub fn beyond<T: Triangulation>(t: &T, cut: &Cut) -> Self {
        let count = (T::Point::COUNT + 1) as f64;
        let mut trim = Self { left_out: vec![false; t.slot_count()], count: 0 };
        let along =
            |p: T::Point| -> f64 { cut.normal.iter().zip(p.as_ref()).map(|(n, x)| n * x / count).sum() };
        for s in t.simplices() {
            let corners = t.corners(s);
            let middle: f64 = corners.as_ref().iter().filter_map(|&v| t.position(v)).map(along).sum();
            let stays = middle <= cut.offset;
            if !stays {
                trim.leave_out(t.index(s));
            }
        }
        trim
    }

    /// Leaves out the simplices that are not to stay, such as those outside of a domain.
    pub fn keeping<T: Triangulation>(t: &T, stays: impl Fn(T::Simplex) -> bool) -> Self {
        let mut trim = Self { left_out: vec![false; t.slot_count()], count: 0 };
        t.simplices().filter(|&s| !stays(s)).for_each(|s| trim.leave_out(t.index(s)));
        trim
    }

    fn leave_out(&mut self, index: usize) {
        self.left_out[index] = true;
        self.count += 1;
    }

    /// Whether the simplex of an index stays.
    pub fn keeps(&self, index: usize) -> bool {
        !self.left_out[index]
    }

    /// How many are left out.
    pub fn count(&self) -> usize {
        self.count
    }
}

/// The distance of two points, rounded.
fn distance<P: Coordinates>(p: P, q: P) -> f64 {
    let differences = p.as_ref().iter().zip(q.as_ref()).map(|(x, y)| x - y);
    differences.fold(0.0, f64::hypot)
}

#[cfg(test)]
mod tests {
    use super::{Cut, Trim};
    use crate::{Mesh, Shape};
    use delone::{Delaunay2, Delaunay3};

    #[test]
    fn long_triangles_go_from_the_border_inwards() {
        // A strip of unit squares, one of which lacks its neighbours, and a point far away.
        let mut points: Vec<[f64; 2]> = (0..12).map(|i| [f64::from(i % 6), f64::from(i / 6)]).collect();
        points.push([3.0, 50.0]);
        let d = Delaunay2::from_points(&points).expect("finite");
        let trim = Trim::long_edges(&d, 2.0);
        let mesh = Mesh { trim: Some(&trim), ..Mesh::new(&d, &points) };
        assert_eq!((mesh.simplex_count(), mesh.triangles().count()), (10, 10));
        assert!(mesh.triangles().flatten().all(|i| i < 12));
        assert_eq!(mesh.edges().count(), 21);
        assert_eq!(mesh.edges().filter(|edge| edge.1).count(), 12);
        // Nothing is long; everything is.
        assert_eq!(Trim::long_edges(&d, 100.0).count(), 0);
        assert_eq!(Trim::long_edges(&d, 0.5).count(), d.triangle_count());
        // A hole in the middle, with long edges around it, stays.
        let ring: Vec<[f64; 2]> = (0..100)
            .map(|i| [f64::from(i % 10), f64::from(i / 10)])
            .filter(|&[x, y]| !(3.0..7.0).contains(&x) || !(3.0..7.0).contains(&y))
            .collect();
        let d = Delaunay2::from_points(&ring).expect("finite");
        assert_eq!(Trim::long_edges(&d, 2.0).count(), 0);
    }

    #[test]
    fn bodies_are_trimmed_and_cut() {
        // A cube, and a point far above.
        let mut points: Vec<[f64; 3]> = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from)).collect();
        points.push([0.5, 0.5, 9.0]);
        let d = Delaunay3::from_points(&points).expect("finite");
        let trim = Trim::long_edges(&d, 2.0);
        let mesh = Mesh { trim: Some(&trim), ..Mesh::new(&d, &points) };
        // The top is laid open.
        let solid = mesh.solid();
        assert_eq!((solid.faces.len(), solid.laid_open.iter().filter(|&&open| open).count()), (12, 2));
        assert_eq!(mesh.edges().filter(|edge| edge.1).count(), 18);
        let cut = Cut { normal: [0.0, 0.0, 1.0], offset: 1.0 };
        assert_eq!(Trim::beyond(&d, &cut).count(), trim.count());
        assert_eq!(Trim::beyond(&d, &Cut { offset: -1.0, ..cut }).count(), d.tetrahedron_count());
    }
}
