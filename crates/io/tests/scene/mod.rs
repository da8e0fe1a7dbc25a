//! Meshes with all that can be said of one, and what must be said of them: told from the triangulation alone.

use std::collections::BTreeMap;
use std::io::Cursor;

use delone::{Constrained2, Crossings, Fill, Triangulation, VertexId};
use delone_generators::{Graph, Random};
use delone_io::{Attributes, Constraints, Format, Mesh, Source, Trim, picture, write_mesh};

pub(crate) fn source(content: &[u8]) -> Box<dyn Source> {
    Box::new(Cursor::new(content.to_vec()))
}

/// Markers and regions: those that are tags, and those that are none.
const MARKERS: [i64; 6] = [0, 1, 2, 7, -8, 1 << 40];
const REGIONS: [f64; 5] = [0.0, 1.0, 3.0, 2.5, -4.0];

/// A constrained triangulation, of which some is left out, in regions.
pub(crate) struct Scene {
    pub(crate) name: String,
    pub(crate) triangulation: Constrained2,
    pub(crate) points: Vec<[f64; 2]>,
    pub(crate) edges: Vec<[VertexId; 2]>,
    pub(crate) markers: Vec<i64>,
    pub(crate) regions: Vec<f64>,
    pub(crate) trim: Trim,
    pub(crate) attributes: Attributes,
    pub(crate) point_markers: Vec<i64>,
}

impl Scene {
    /// Scenes of all kinds of graphs.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        let sizes = [0, 3, 7, 60];
        Graph::ALL.iter().flat_map(move |&graph| sizes.map(|n| Self::new(graph, n)))
    }

    pub(crate) fn new(graph: Graph, n: usize) -> Self {
        let (points, segments) = graph.parts(n, 5);
        let triangulation =
            Constrained2::with_crossings(&points, &segments, Crossings::Split).expect("crossings are split");
        let mut random = Random::new(n as u64);
        let edges: Vec<[VertexId; 2]> = triangulation.constraints().collect();
        let markers = edges.iter().map(|_| MARKERS[random.below(MARKERS.len())]).collect();
        let mut regions = vec![0.0; triangulation.slot_count()];
        regions.iter_mut().for_each(|region| *region = REGIONS[random.below(REGIONS.len())]);
        let inside = triangulation.domains(&Fill::EvenOdd).expect("borders");
        // Polygons are filled; what has no inside has holes at random.
        let mut has_hole = vec![false; triangulation.slot_count()];
        has_hole.iter_mut().for_each(|hole| *hole = random.below(4) == 0);
        let stays = |t| {
            let index = triangulation.index(t);
            if graph.is_polygon() { inside.is_inside(t) } else { !has_hole[index] }
        };
        let trim = Trim::keeping(&triangulation, stays);
        let points = triangulation.points().to_vec();
        let values = points.iter().flat_map(|[x, y]| [2.0 * x - 3.0 * y + 1.0, random.unit()]).collect();
        let point_markers = points.iter().map(|_| MARKERS[random.below(MARKERS.len())]).collect();
        Self {
            name: format!("{} {n}", graph.name()),
            triangulation,
            points,
            edges,
            markers,
            regions,
            trim,
            attributes: Attributes { width: 2, values },
            point_markers,
        }
    }

    pub(crate) fn constraints(&self) -> Constraints<'_> {
        Constraints { edges: &self.edges, markers: Some(&self.markers), ..Constraints::default() }
    }

    /// All of it, of first or of second order.
    pub(crate) fn mesh<'a>(
        &'a self,
        constraints: &'a Constraints<'a>,
        second_order: bool,
    ) -> Mesh<'a, Constrained2> {
        Mesh {
            trim: Some(&self.trim),
            constraints: Some(constraints),
            regions: Some(&self.regions),
            attributes: Some(&self.attributes),
            point_markers: Some(&self.point_markers),
            second_order,
            ..Mesh::new(&self.triangulation, &self.points)
        }
    }

    pub(crate) fn written(&self, format: Format, second_order: bool) -> String {
        let constraints = self.constraints();
        String::from_utf8(written(format, &self.mesh(&constraints, second_order))).expect("text")
    }

    /// The triangles that stay, by the least corner first, and their regions.
    pub(crate) fn triangles(&self) -> Vec<([usize; 3], f64)> {
        let c = &self.triangulation;
        let stays = c.triangle_ids().filter(|&t| self.trim.keeps(c.index(t)));
        let corners = |t| c.corners(t).map(|v: VertexId| v.index());
        let mut all: Vec<_> = stays.map(|t| (least_first(corners(t)), self.regions[c.index(t)])).collect();
        all.sort_by_key(|triangle| triangle.0);
        all
    }

    /// The edges of these triangles by their ends in order: the marker of the constraint on it, 1 on the border if that is
    /// 0 or there is none, and whether it is a constraint or on the border.
    pub(crate) fn edge_markers(&self) -> BTreeMap<[usize; 2], (i64, bool)> {
        let mut counts: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        for ([a, b, c], _) in self.triangles() {
            [[a, b], [b, c], [c, a]]
                .into_iter()
                .for_each(|ends| *counts.entry(sorted(ends)).or_default() += 1);
        }
        let ends = self.edges.iter().map(|ends| sorted(ends.map(|v| v.index())));
        let constraints: BTreeMap<[usize; 2], i64> = ends.zip(self.markers.iter().copied()).collect();
        let judged = |(ends, count): ([usize; 2], usize)| {
            let (constraint, is_border) = (constraints.get(&ends), count == 1);
            let marker = match constraint {
                Some(&marker) if marker != 0 => marker,
                _ => i64::from(is_border),
            };
            (ends, (marker, is_border || constraint.is_some()))
        };
        counts.into_iter().map(judged).collect()
    }

    pub(crate) fn middle(&self, [i, j]: [usize; 2]) -> [f64; 2] {
        [0, 1].map(|k| f64::midpoint(self.points[i][k], self.points[j][k]))
    }
}

pub(crate) fn written<T: Triangulation<Point: delone_io::Drawable>>(
    format: Format,
    mesh: &Mesh<T>,
) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_mesh(&mut bytes, format, mesh, &picture::Options::default()).expect("memory takes it");
    bytes
}

pub(crate) fn sorted(mut ends: [usize; 2]) -> [usize; 2] {
    ends.sort_unstable();
    ends
}

pub(crate) fn least_first([a, b, c]: [usize; 3]) -> [usize; 3] {
    [[a, b, c], [b, c, a], [c, a, b]].into_iter().min().unwrap_or_default()
}
