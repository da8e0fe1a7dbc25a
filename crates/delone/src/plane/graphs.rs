//! Proximity graphs of the plane; what they are and how they are found is told in `graphs/`.

use delone_predicates::in_diametral_ball;

use super::Delaunay2;
use super::layer::Layer;
use crate::error::Error;
use crate::graphs::{self, Graph, Sites};
use crate::ids::{Place, TriangleId, VertexId};
use crate::parallel;

impl Sites<2> for Layer {
    fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Of all vertices the corners across an edge are seen from at the widest angles, so none is in the closed disk if these are
    /// not.
    fn gabriel(&self) -> Vec<[Place; 2]> {
        let mesh = &self.mesh;
        let point = |v: Place| self.points[v.index()];
        let part = |[from, to]: [usize; 2]| {
            let mut edges = Vec::new();
            for t in (from..to).map(TriangleId::new).filter(|&t| mesh.is_triangle(t)) {
                for e in [0, 1, 2].map(|k| t.edge(k)) {
                    let (twin, ends) = (mesh.twin(e), [mesh.tail(e), mesh.head(e)]);
                    if e > twin || ends.contains(&Place::GHOST) {
                        continue;
                    }
                    let [a, b] = ends.map(point);
                    let is_clear = |v: Place| v.is_ghost() || !in_diametral_ball(a, b, point(v));
                    if is_clear(mesh.tip(e)) && is_clear(mesh.tip(twin)) {
                        edges.push(ends);
                    }
                }
            }
            edges
        };
        let ends = parallel::even_ends(mesh.slot_count(), parallel::parts(mesh.slot_count()));
        let starts = std::iter::once(0).chain(ends.iter().copied());
        let ranges = starts.zip(&ends).map(|(from, &to)| [from, to]).collect();
        parallel::map(ranges, part).concat()
    }
}

impl Delaunay2 {
    /// The edges of a proximity graph of the vertices, each from the smaller id to the larger, sorted; a function of the set
    /// alone. A vertex stands for all points equal to it.
    ///
    /// Cost: see [`Graph`]; on all threads of rayon's pool where that pays.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a beta that is below 1, infinite or NaN.
    ///
    /// ```
    /// use delone::{Delaunay2, Graph};
    ///
    /// let d = Delaunay2::from_points(&[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]])?;
    /// let edges = |graph| Ok::<_, delone::Error>(d.graph(graph)?.into_iter().map(|edge| edge.map(|v| v.index())).collect::<Vec<_>>());
    /// assert_eq!(edges(Graph::Gabriel)?, [[0, 1], [0, 3], [1, 2], [2, 3]]); // a diagonal has corners on its circle
    /// assert_eq!(edges(Graph::SpanningTree)?, [[0, 1], [0, 3], [1, 2]]); // of two long sides the lexicographically smaller
    /// assert_eq!(edges(Graph::Nearest(1))?, [[0, 3], [1, 2]]);
    /// assert!(d.graph(Graph::Beta(0.5)).is_err());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn graph(&self, graph: Graph) -> Result<Vec<[VertexId; 2]>, Error> {
        Ok(graphs::named(graphs::edges(&self.base, graph)?, |v| self.mesh().name(v)))
    }
}
