//! A triangulation of the plane to be written, whole or without the long triangles at its border.

use std::collections::VecDeque;

use delone::{Delaunay2, EdgeId, TriangleId, VertexId};

use crate::{Crs, Shape};

/// A triangulation to be written, with what lies beside it.
#[derive(Clone, Copy, Debug)]
pub struct Surface<'a> {
    /// The triangulation of x and y.
    pub triangulation: &'a Delaunay2,
    /// The height of each input point.
    pub heights: Option<&'a [f64]>,
    /// What the coordinates mean; formats that can say it do.
    pub crs: Option<&'a Crs>,
    /// What the first point is called in Triangle's formats, 0 or 1.
    pub base: usize,
    /// What is left out.
    pub trim: Option<&'a Trim>,
}

impl<'a> Surface<'a> {
    /// All of a triangulation.
    pub fn new(triangulation: &'a Delaunay2) -> Self {
        Self { triangulation, heights: None, crs: None, base: 0, trim: None }
    }

    fn keeps(&self, t: TriangleId) -> bool {
        self.trim.is_none_or(|trim| !trim.left_out[t.index()])
    }

    /// The finite triangles that are not left out.
    pub(crate) fn cells(&self) -> impl Iterator<Item = TriangleId> + Send + Clone + 'a {
        let surface = *self;
        surface.triangulation.mesh().triangles().filter(move |&t| surface.keeps(t))
    }

    /// How many there are.
    pub fn triangle_count(&self) -> usize {
        self.triangulation.triangle_count() - self.trim.map_or(0, Trim::count)
    }

    /// The edges of what is not left out; of a line all.
    pub(crate) fn edges(&self) -> impl Iterator<Item = EdgeId> + 'a {
        let surface = *self;
        let mesh = surface.triangulation.mesh();
        let stays = move |&e: &EdgeId| {
            surface.trim.is_none() || [e, mesh.twin(e)].iter().any(|e| surface.has(e.triangle()))
        };
        mesh.undirected_edges().filter(stays)
    }

    /// Whether a triangle is finite and not left out.
    fn has(&self, t: TriangleId) -> bool {
        !self.triangulation.mesh().is_ghost(t) && self.keeps(t)
    }

    /// Whether an edge is on the border of what is not left out.
    pub(crate) fn is_border(&self, e: EdgeId) -> bool {
        let twin = self.triangulation.mesh().twin(e);
        !(self.has(e.triangle()) && self.has(twin.triangle()))
    }

    /// The ends of an edge.
    pub(crate) fn ends(&self, e: EdgeId) -> [VertexId; 2] {
        let mesh = self.triangulation.mesh();
        [mesh.origin(e), mesh.destination(e)]
    }
}

impl Shape for Surface<'_> {
    fn positions(&self) -> impl Iterator<Item = [f64; 3]> {
        let heights = self.heights.unwrap_or_default();
        let z = |i: usize| heights.get(i).copied().unwrap_or_default();
        self.triangulation.points().iter().enumerate().map(move |(i, &[x, y])| [x, y, z(i)])
    }

    fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + Send {
        let mesh = self.triangulation.mesh();
        self.cells().map(|t| mesh.corners(t).map(VertexId::index))
    }

    fn heights(&self) -> Option<&[f64]> {
        self.heights
    }

    fn crs(&self) -> Option<&Crs> {
        self.crs
    }
}

/// Triangles that are left out.
#[derive(Clone, Debug)]
pub struct Trim {
    /// By the number of the triangle.
    left_out: Vec<bool>,
    count: usize,
}

impl Trim {
    /// Leaves out triangles with an edge longer than `longest`, from the hull inwards: as long as they are next to
    /// nothing or to one that is left out. Long triangles in the middle stay. Lengths are rounded. O(n).
    pub fn long_edges(d: &Delaunay2, longest: f64) -> Self {
        let mesh = d.mesh();
        let is_long = |t: TriangleId| {
            let [a, b, c] = mesh.corners(t).map(|v| d.point(v));
            [(a, b), (b, c), (c, a)].iter().any(|(p, q)| (p[0] - q[0]).hypot(p[1] - q[1]) > longest)
        };
        let mut left_out = vec![false; mesh.slot_count()];
        let at_border = |t: &TriangleId| mesh.adjacent(*t).iter().any(|&next| mesh.is_ghost(next));
        let mut waiting: VecDeque<TriangleId> = mesh.triangles().filter(at_border).collect();
        let mut count = 0;
        while let Some(t) = waiting.pop_front() {
            if left_out[t.index()] || !is_long(t) {
                continue;
            }
            left_out[t.index()] = true;
            count += 1;
            waiting.extend(mesh.adjacent(t).iter().filter(|&&next| !mesh.is_ghost(next)));
        }
        Self { left_out, count }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.count
    }
}

#[cfg(test)]
mod tests {
    use super::{Surface, Trim};
    use crate::Shape;
    use delone::Delaunay2;

    #[test]
    fn long_triangles_go_from_the_border_inwards() {
        // A strip of unit squares, one of which lacks its neighbours, and a point far away.
        let mut points: Vec<[f64; 2]> = (0..12).map(|i| [f64::from(i % 6), f64::from(i / 6)]).collect();
        points.push([3.0, 50.0]);
        let d = Delaunay2::from_points(&points).expect("finite");
        let trim = Trim::long_edges(&d, 2.0);
        let surface = Surface { trim: Some(&trim), ..Surface::new(&d) };
        assert_eq!((surface.triangle_count(), surface.triangles().count()), (10, 10));
        assert!(surface.triangles().flatten().all(|i| i < 12));
        assert_eq!(surface.edges().count(), 21);
        assert_eq!(surface.edges().filter(|&e| surface.is_border(e)).count(), 12);
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
}
