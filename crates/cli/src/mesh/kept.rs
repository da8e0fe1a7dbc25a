//! The triangles inside as a triangulation of their own, with all points or with those alone that they use.

use std::sync::OnceLock;

use delone::Dimension;
use delone::{Constrained2, Domains2, Duplicate, TriangleId, Triangulation, VertexId};

/// The inside of a triangulation.
#[derive(Debug)]
pub(super) struct Kept<'a> {
    all: &'a Constrained2,
    is_inside: Vec<bool>,
    triangles: usize,
    /// The points, as they are numbered here.
    pub(super) points: Vec<[f64; 2]>,
    /// The index in the input of each of them.
    pub(super) old: Vec<usize>,
    /// And the other way.
    new: Vec<Option<VertexId>>,
    /// The edges of the triangles, by their ends in order, once somebody wants them.
    edges: OnceLock<Vec<[VertexId; 2]>>,
}

impl<'a> Kept<'a> {
    /// Takes the inside of a triangulation. Points that no triangle uses may be dropped; the others keep their order.
    pub(super) fn of(all: &'a Constrained2, domains: &Domains2, drops: bool) -> Self {
        let mut is_inside = vec![false; all.mesh().slot_count()];
        let mut is_used = vec![!drops; all.points().len()];
        let mut triangles = 0;
        for t in all.triangle_ids().filter(|&t| domains.is_inside(t)) {
            is_inside[t.index()] = true;
            triangles += 1;
            all.mesh().corners(t).iter().for_each(|v| is_used[v.index()] = true);
        }
        let old: Vec<usize> = (0..is_used.len()).filter(|&i| is_used[i]).collect();
        let mut new = vec![None; is_used.len()];
        old.iter().enumerate().for_each(|(k, &i)| new[i] = Some(VertexId::new(k)));
        let points = old.iter().map(|&i| all.points()[i]).collect();
        Self { all, is_inside, triangles, points, old, new, edges: OnceLock::new() }
    }

    /// Puts points that no triangle has back to where they were.
    pub(super) fn put_back(&mut self, apart: &[(usize, [f64; 2])]) {
        for &(i, place) in apart {
            if let Some(v) = self.new[i] {
                self.points[v.index()] = place;
            }
        }
    }

    /// The name of a vertex here.
    pub(super) fn name(&self, v: VertexId) -> Option<VertexId> {
        self.new[v.index()]
    }

    /// Rows of values of the points that are left.
    pub(super) fn rows<T: Copy>(&self, width: usize, values: &[T]) -> Vec<T> {
        self.old.iter().flat_map(|&i| values[i * width..(i + 1) * width].iter().copied()).collect()
    }
}

impl Triangulation for Kept<'_> {
    type Point = [f64; 2];
    type Simplex = TriangleId;
    type Corners = [VertexId; 3];
    type Facet = [VertexId; 2];
    type Flaw = <Constrained2 as Triangulation>::Flaw;

    fn dimension(&self) -> Dimension {
        self.all.dimension()
    }

    fn ids_given(&self) -> usize {
        self.points.len()
    }

    fn vertex_count(&self) -> usize {
        self.vertices().count()
    }

    fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.all.vertices().filter_map(|v| self.name(v))
    }

    fn position(&self, v: VertexId) -> Option<[f64; 2]> {
        self.points.get(v.index()).copied()
    }

    fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_ {
        self.all.duplicates().filter_map(|duplicate| {
            let point = self.new[duplicate.point]?.index();
            Some(Duplicate { point, vertex: self.name(duplicate.vertex)? })
        })
    }

    fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        let sides = |t| {
            let [a, b, c] = self.corners(t);
            [[a, b], [b, c], [c, a]].map(|[v, w]: [VertexId; 2]| [v.min(w), v.max(w)])
        };
        let edges = self.edges.get_or_init(|| {
            let mut edges: Vec<[VertexId; 2]> = self.simplices().flat_map(sides).collect();
            edges.sort_unstable();
            edges.dedup();
            edges
        });
        edges.iter().copied()
    }

    fn simplices(&self) -> impl Iterator<Item = TriangleId> + Send + '_ {
        self.all.simplices().filter(|&t| self.is_inside[t.index()])
    }

    fn simplex_count(&self) -> usize {
        self.triangles
    }

    fn index(&self, t: TriangleId) -> usize {
        self.all.index(t)
    }

    fn slot_count(&self) -> usize {
        self.all.slot_count()
    }

    fn corners(&self, t: TriangleId) -> [VertexId; 3] {
        self.all.corners(t).map(|v| self.name(v).unwrap_or(v))
    }

    fn across(&self, t: TriangleId, k: usize) -> Option<TriangleId> {
        self.all.across(t, k).filter(|next| self.is_inside[next.index()])
    }

    fn simplices_at(&self, v: VertexId) -> Vec<TriangleId> {
        let old = self.old.get(v.index()).map_or(v, |&i| VertexId::new(i));
        let around = self.all.simplices_at(old).into_iter();
        around.filter(|t| self.is_inside[t.index()]).collect()
    }

    fn hull_facets(&self) -> impl Iterator<Item = [VertexId; 2]> + Send + '_ {
        self.simplices().flat_map(move |t| {
            let corners = self.corners(t);
            let open = (0..3).filter(move |&k| self.across(t, k).is_none());
            open.map(move |k| [corners[(k + 1) % 3], corners[(k + 2) % 3]])
        })
    }

    fn check(&self) -> Result<(), Self::Flaw> {
        self.all.check()
    }
}
