//! Quadrilaterals alone, as a triangulation for the writers: each is two triangles, which are partners.

use delone::{AllQuads2, Dimension, Duplicate, Triangulation, VertexId};
use delone_predicates::mean;

use super::kept::Kept;

/// No triangle is across a side of the border.
const OUTSIDE: usize = usize::MAX;

/// The parts of the cells of a mesh. Triangles `2 q` and `2 q + 1` are those of quadrilateral `q`.
#[derive(Debug)]
pub(super) struct Parts<'a> {
    kept: &'a Kept<'a>,
    quads: &'a AllQuads2,
    /// The points that are kept, then the new ones.
    pub(super) points: Vec<[f64; 2]>,
    corners: Vec<[VertexId; 4]>,
    /// The quadrilateral across each side, from one corner to the next.
    across: Vec<[usize; 4]>,
    /// The corners whose mean each new point is, as they are numbered here: two, three or four.
    origins: Vec<Vec<VertexId>>,
}

impl<'a> Parts<'a> {
    pub(super) fn of(kept: &'a Kept<'a>, quads: &'a AllQuads2) -> Self {
        let before = kept.points.len();
        let name = |i: usize| match i.checked_sub(quads.first) {
            Some(new) => VertexId::new(before + new),
            None => kept.name(VertexId::new(i)).unwrap_or(VertexId::new(i)),
        };
        let mut points: Vec<[f64; 2]> =
            kept.points.iter().chain(&quads.points[quads.first..]).copied().collect();
        let corners: Vec<[VertexId; 4]> = quads.corners.iter().map(|corners| corners.map(name)).collect();
        // Smoothing moves vertices too.
        for (places, names) in quads.corners.iter().zip(&corners) {
            points[names[0].index()] = quads.points[places[0]];
        }
        let mut origins: Vec<Vec<VertexId>> =
            quads.middles.iter().map(|ends| ends.map(|v| name(v.index())).to_vec()).collect();
        origins.resize(quads.points.len() - quads.first, Vec::new());
        corners.iter().for_each(|[corner, _, center, _]| origins[center.index() - before].push(*corner));
        let mut sides: Vec<([VertexId; 2], usize, usize)> = Vec::with_capacity(4 * corners.len());
        for (q, corners) in corners.iter().enumerate() {
            for k in 0..4 {
                let (v, w) = (corners[k], corners[(k + 1) % 4]);
                sides.push(([v.min(w), v.max(w)], q, k));
            }
        }
        sides.sort_unstable();
        let mut across = vec![[OUTSIDE; 4]; corners.len()];
        for pair in sides.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            let [(_, q, k), (_, r, j)] = [pair[0], pair[1]];
            (across[q][k], across[r][j]) = (r, q);
        }
        Self { kept, quads, points, corners, across, origins }
    }

    /// For each triangle the other one of its quadrilateral.
    pub(super) fn partners(&self) -> Vec<Option<usize>> {
        (0..self.slot_count()).map(|t| Some(t ^ 1)).collect()
    }

    /// Values of triangles from those of the cells that they are parts of.
    pub(super) fn of_cells<V: Copy>(&self, values: &[V]) -> Vec<V> {
        self.quads.triangles.iter().flat_map(|t| [values[t.index()]; 2]).collect()
    }

    /// Values of the points, and means of these for the new ones; those that smoothing has moved are asked for by their places.
    pub(super) fn means(&self, values: &[f64], of_moved: impl Fn([f64; 2]) -> f64) -> Vec<f64> {
        let (count, before) = (self.kept.points.len(), &self.kept.points);
        let value = |i: usize| {
            let mean_of = |origins: &[VertexId], of: &dyn Fn(VertexId) -> f64| match *origins {
                [a, b] => mean([a, b].map(of)),
                [a, b, c] => mean([a, b, c].map(of)),
                [a, b, c, d] => mean([a, b, c, d].map(of)),
                _ => 0.0,
            };
            let own = [VertexId::new(i); 2];
            let origins = i.checked_sub(count).map_or(&own[..], |new| &self.origins[new]);
            let place = [0, 1].map(|k| mean_of(origins, &|v| before[v.index()][k]));
            if place == self.points[i] {
                mean_of(origins, &|v| values[v.index()])
            } else {
                of_moved(self.points[i])
            }
        };
        (0..self.points.len()).map(value).collect()
    }

    /// The new point in the middle of an edge.
    pub(super) fn middle(&self, [v, w]: [VertexId; 2]) -> Option<VertexId> {
        // In the order of the names that all points have.
        let [v, w] = [v, w].map(|v| VertexId::new(self.kept.old[v.index()]));
        let at = self.quads.middles.binary_search(&[v.min(w), v.max(w)]).ok()?;
        Some(VertexId::new(self.kept.points.len() + at))
    }

    /// The halves of an edge, in its direction. An edge of no cell stays as it is.
    pub(super) fn halves(&self, ends: [VertexId; 2]) -> Vec<[VertexId; 2]> {
        match self.middle(ends) {
            Some(middle) => vec![[ends[0], middle], [middle, ends[1]]],
            None => vec![ends],
        }
    }

    /// The side of a quadrilateral opposite to corner `k` of a triangle; nothing for the diagonal.
    fn side(t: usize, k: usize) -> Option<usize> {
        [[None, Some(3), Some(0)], [None, Some(1), Some(2)]][t % 2][k]
    }
}

impl Triangulation for Parts<'_> {
    type Point = [f64; 2];
    type Simplex = usize;
    type Corners = [VertexId; 3];
    type Facet = [VertexId; 2];
    type Flaw = <Kept<'static> as Triangulation>::Flaw;

    fn dimension(&self) -> Dimension {
        self.kept.dimension()
    }

    fn ids_given(&self) -> usize {
        self.points.len()
    }

    fn vertex_count(&self) -> usize {
        self.vertices().count()
    }

    fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.kept.vertices().chain((self.kept.points.len()..self.points.len()).map(VertexId::new))
    }

    fn position(&self, v: VertexId) -> Option<[f64; 2]> {
        self.points.get(v.index()).copied()
    }

    fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_ {
        self.kept.duplicates()
    }

    fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.simplices().flat_map(move |t| {
            let corners = self.corners(t);
            let is_first = move |k: &usize| self.across(t, *k).is_none_or(|next| t < next);
            (0..3).filter(is_first).map(move |k| [corners[(k + 1) % 3], corners[(k + 2) % 3]])
        })
    }

    fn simplices(&self) -> impl Iterator<Item = usize> + Send + '_ {
        0..self.slot_count()
    }

    fn index(&self, t: usize) -> usize {
        t
    }

    fn slot_count(&self) -> usize {
        2 * self.corners.len()
    }

    /// The diagonal is between the middles, opposite to corner 0 of both.
    fn corners(&self, t: usize) -> [VertexId; 3] {
        let [a, b, c, d] = self.corners[t / 2];
        [[a, b, d], [c, d, b]][t % 2]
    }

    fn across(&self, t: usize, k: usize) -> Option<usize> {
        let Some(side) = Self::side(t, k) else { return Some(t ^ 1) };
        let next = Some(self.across[t / 2][side]).filter(|&next| next != OUTSIDE)?;
        // A side of corner 0 is of the first triangle: sides 0 and 3.
        let j = (0..4).find(|&j| {
            let [v, w] = [self.corners[next][j], self.corners[next][(j + 1) % 4]];
            [w, v] == [self.corners[t / 2][side], self.corners[t / 2][(side + 1) % 4]]
        })?;
        Some(2 * next + usize::from(j == 1 || j == 2))
    }

    fn simplices_at(&self, v: VertexId) -> Vec<usize> {
        self.simplices().filter(|&t| self.corners(t).contains(&v)).collect()
    }

    fn hull_facets(&self) -> impl Iterator<Item = [VertexId; 2]> + Send + '_ {
        self.simplices().flat_map(move |t| {
            let corners = self.corners(t);
            let open = (0..3).filter(move |&k| self.across(t, k).is_none());
            open.map(move |k| [corners[(k + 1) % 3], corners[(k + 2) % 3]])
        })
    }

    fn check(&self) -> Result<(), Self::Flaw> {
        self.kept.check()
    }
}
