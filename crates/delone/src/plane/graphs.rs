//! Proximity graphs of the plane; what they are and how they are found is told in `graphs/`.

use std::ops::Range;

use delone_predicates::in_diametral_ball;

use super::Delaunay2;
use super::layer::Layer;
use crate::error::Error;
use crate::graphs::{self, Graph, Net, Sites};
use crate::ids::{EdgeId, Place, TriangleId, VertexId};
use crate::parallel;
use crate::prefetch::prefetch;

impl Sites<2> for Layer {
    fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// As triangles come to them, which lie along a curve where vertices need not.
    fn along_curve(&self) -> Vec<Place> {
        let mesh = &self.mesh;
        let slots = (0..mesh.slot_count()).map(TriangleId::new);
        let edges = slots.flat_map(|t| [0, 1, 2].map(|k| t.edge(k)));
        let first = edges.filter(|&e| mesh.incident.get(mesh.tail(e).index()) == Some(&e));
        mesh.lone.into_iter().chain(first.map(|e| mesh.tail(e))).collect()
    }

    /// Of all vertices the corners across an edge are seen from at the widest angles, so none is in the closed disk if these are
    /// not. The angles of a triangle are asked at once, because its corners are at hand.
    fn gabriel<'a>(&self, _: &dyn Fn() -> &'a Net<2>) -> Vec<[Place; 2]> {
        let mesh = &self.mesh;
        let clear = parallel::collect(mesh.slot_count(), |t| self.clear_sides(t));
        let bit = |e: EdgeId| clear.get(e.triangle().index()).map_or(0, |sides| sides >> (e.index() % 4) & 1);
        let part = |triangles: Range<usize>| {
            let mut edges = Vec::with_capacity(triangles.len());
            // Whether an edge is in is as good as random: all are written to a short list, and it is kept how many count.
            let mut some = [[Place::GHOST; 2]; 3 * 64];
            for from in triangles.clone().step_by(64) {
                let mut count = 0;
                for t in (from..triangles.end.min(from + 64)).map(TriangleId::new) {
                    let places = mesh.places(t);
                    for k in 0..3 {
                        let (e, twin) = (t.edge(k), mesh.twin(t.edge(k)));
                        some[count] = [places[k], places[(k + 1) % 3]];
                        count += usize::from(bit(e) & bit(twin) & u8::from(e < twin));
                    }
                }
                edges.extend_from_slice(&some[..count]);
            }
            edges
        };
        parallel::map(parallel::ranges(mesh.slot_count()), part).concat()
    }
}

impl Layer {
    /// For each edge of a slot a bit: whether it is a finite edge in whose closed disk the corner across is not. A triangle far
    /// ahead is asked for, as corners may be anywhere in memory.
    #[inline]
    fn clear_sides(&self, t: usize) -> u8 {
        /// Triangles between the one that is tested and the one that is prefetched.
        const PREFETCH_DISTANCE: usize = 24;
        let mesh = &self.mesh;
        if let Some(record) = mesh.edges.get(4 * (t + PREFETCH_DISTANCE)..4 * (t + PREFETCH_DISTANCE) + 3) {
            record.iter().for_each(|edge| prefetch(&self.points, edge.origin.index()));
        }
        let t = TriangleId::new(t);
        if !mesh.is_triangle(t) {
            return 0;
        }
        let places = mesh.places(t);
        if let Some(k) = places.iter().position(|v| v.is_ghost()) {
            return 1 << ((k + 1) % 3);
        }
        let [a, b, c] = places.map(|v| self.points[v.index()]);
        let is_clear = |a, b, c| u8::from(!in_diametral_ball(a, b, c));
        is_clear(a, b, c) | is_clear(b, c, a) << 1 | is_clear(c, a, b) << 2
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
        Ok(graphs::named(graphs::edges(&self.base, graph)?, self.points().len(), |v| self.mesh().name(v)))
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::Kind;

    use super::*;
    use crate::graphs::looks;

    fn looks_of(points: &[[f64; 2]], beta: f64) -> (usize, usize) {
        let d = Delaunay2::from_points(points).expect("finite");
        let net = Net::of(&d.base);
        looks(&net, &d.base.gabriel(&|| unreachable!("the plane needs none")), beta)
    }

    /// Across there are as many edges as along; around each all vertices of both rows are in the smallest ball.
    #[test]
    fn lunes_between_rows_that_are_far_apart_take_few_looks() {
        let n = 2000;
        let rows = |slope: f64, apart: f64| -> Vec<[f64; 2]> {
            let row = |x: f64| [[x, x * slope], [x - apart * slope, x * slope + apart]];
            (0..n).flat_map(|i| row(f64::from(i))).collect()
        };
        for (slope, apart, most) in [(0.0, 1e6, 150), (0.5, 2000.0, 400)] {
            let (looked, found) = looks_of(&rows(slope, apart), 2.0);
            assert_eq!(found as i32, 3 * n - 2, "{slope}");
            assert!(looked < most * found, "{looked} looks for {found} edges, slope {slope}");
        }
    }

    /// Beyond the range of squares too.
    #[test]
    fn lunes_of_any_scale_take_the_same_looks() {
        for points in [Kind::Uniform.points(2000, 1), Kind::Clusters.points(2000, 1)] {
            for beta in [1.2, 2.0] {
                let usual = looks_of(&points, beta);
                for exponent in [-900, -520, 520, 900] {
                    let scale = 2f64.powi(exponent);
                    let scaled: Vec<_> = points.iter().map(|p| p.map(|x| x * scale)).collect();
                    assert_eq!(looks_of(&scaled, beta), usual, "2^{exponent}");
                }
            }
        }
        // Two scales at once.
        let both = Kind::Uniform.points(2000, 1).into_iter().zip([1.0, 1e-200].into_iter().cycle());
        let both: Vec<_> = both.map(|(p, scale)| p.map(|x| x * scale)).collect();
        let (looked, found) = looks_of(&both, 2.0);
        assert!(looked < 60 * found, "{looked} looks for {found} edges");
    }

    #[test]
    fn boxes_and_neighbors_agree() {
        for &kind in Kind::ALL {
            for beta in [1.1, 2.0, 5.0] {
                let points = kind.points(700, 1);
                let (looked, _) = looks_of(&points, beta);
                if kind == Kind::Uniform && beta <= 2.0 {
                    assert!(looked < 30 * points.len(), "{looked} looks");
                }
            }
        }
    }
}
