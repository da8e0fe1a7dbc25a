//! Proximity graphs of space; what they are and how they are found is told in `graphs/`.

use super::Delaunay3;
use super::layer::Layer;
use crate::error::Error;
use crate::graphs::{self, Graph, Sites};
use crate::ids::VertexId;
use crate::triangulation::Triangulation;

impl Sites<3> for Layer {
    fn points(&self) -> &[[f64; 3]] {
        &self.points
    }
}

impl Delaunay3 {
    /// The edges of a proximity graph of the vertices, each from the smaller id to the larger, sorted; a function of the set
    /// alone. A vertex stands for all points equal to it.
    ///
    /// Cost: see [`Graph`]; on all threads of rayon's pool where that pays.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a beta that is below 1, infinite or NaN.
    ///
    /// ```
    /// use delone::{Delaunay3, Graph};
    ///
    /// let cube: Vec<[i32; 3]> = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2]).collect();
    /// let d = Delaunay3::from_points(&cube)?;
    /// assert_eq!(d.graph(Graph::Gabriel)?.len(), 12); // its edges alone
    /// assert_eq!(d.graph(Graph::SpanningTree)?.len(), 7);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn graph(&self, graph: Graph) -> Result<Vec<[VertexId; 2]>, Error> {
        Ok(graphs::named(graphs::edges(&self.base, graph)?, self.ids_given(), |v| self.mesh().name(v)))
    }
}
