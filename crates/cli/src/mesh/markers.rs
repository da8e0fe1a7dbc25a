//! Markers of what was added: constraints have those of their segments, points on these too.

use delone::{Constrained2, Domains2};
use delone_io::Graph;

/// The markers of constraint edges in their order, and those of all points.
pub(super) struct Markers {
    pub(super) edges: Vec<i64>,
    pub(super) points: Vec<i64>,
}

/// Where several segments cover an edge or a point, the first that has a marker other than zero counts. What has none is 1 on
/// the border of the mesh and 0 elsewhere, and so Triangle does it.
pub(super) fn of(c: &Constrained2, graph: &Graph, domains: &Domains2) -> Markers {
    let given = graph.markers.as_deref().unwrap_or_default();
    let of_segment = |s: usize| given.get(s).copied().unwrap_or_default();
    let mut points = graph.point_markers.clone().unwrap_or_default();
    points.resize(c.points().len(), 0);
    for (s, _) in c.segments() {
        let marker = of_segment(s.index());
        let chain = if marker == 0 { None } else { c.chain(s) };
        for v in chain.unwrap_or_default() {
            if points[v.index()] == 0 {
                points[v.index()] = marker;
            }
        }
    }
    let mut edges = Vec::new();
    for e in c.constraint_edges() {
        let covering = c.covering(e);
        let marker = covering.iter().map(|one| of_segment(one.segment.index())).find(|&marker| marker != 0);
        let twin = c.mesh().twin(e);
        let is_border = domains.is_inside(e.triangle()) != domains.is_inside(twin.triangle());
        edges.push(marker.unwrap_or(i64::from(is_border)));
        if is_border {
            for v in [c.mesh().origin(e), c.mesh().destination(e)] {
                let marker = &mut points[v.index()];
                if *marker == 0 {
                    *marker = 1;
                }
            }
        }
    }
    Markers { edges, points }
}
