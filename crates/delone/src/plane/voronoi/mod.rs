//! Voronoi diagrams, as a view of the triangulation.
//!
//! The cell of a site is what is at least as near to it as to every other vertex. Cells are dual to vertices, Voronoi
//! edges to Delaunay edges, Voronoi vertices (circumcenters) to triangles, so the diagram takes no memory and is always that of the
//! triangulation as it is: after insertions, removals and motions too.
//!
//! A cell inside of its region is a list of circumcenters; any other cell is cut out of the region by bisectors (`clip`). Until the end,
//! a corner is a point of the input or the exact meeting of two lines, so that cells tile. Each coordinate is rounded once. Rounding
//! keeps order, so a short side may vanish but seldom turns over. Each ring is tested for simplicity (`region/rings.rs`); where one
//! fails, corners that nearly coincide become one in all cells (`contract`).
//!
//! Combinatorics are exact. Coordinates are correctly rounded: see [`delone_predicates::circumcenter`].
//!
//! Cost: O(1) for a vertex or an edge, O(d) for a cell with d neighbors.

mod areas;
mod borders;
pub(in crate::plane) mod build;
pub(in crate::plane) mod cells;
pub(in crate::plane) mod centers;
pub(in crate::plane) mod clip;
mod contract;
mod crossed;
mod discs;
mod joined;
mod lines;
mod medial;
mod merge;
mod relax;
mod single;

pub use cells::{Cell2, Cells2, Ring};
pub use lines::LineCells2;
pub use medial::MedialAxis2;
pub use relax::Relaxation2;

use delone_predicates::in_circle_with_ties;

use super::Delaunay2;
use crate::ids::{EdgeId, TriangleId, VertexId};

/// The Voronoi diagram of the vertices of a triangulation.
///
/// ```
/// use delone::{Delaunay2, Region2, VoronoiEdge2};
///
/// let d = Delaunay2::from_points(&[[0.0, 0.0], [2.0, 0.0], [0.0, 2.0], [-2.0, 0.0], [0.0, -2.0]])?;
/// let voronoi = d.voronoi();
/// let center = d.vertices().next().unwrap();
/// assert!(voronoi.is_bounded(center));
/// assert_eq!(voronoi.corners(center).count(), 4);
/// let rays = voronoi.edges().filter(|e| matches!(e, VoronoiEdge2::Ray { .. })).count();
/// assert_eq!(rays, 4);
///
/// let cells = voronoi.clip(&Region2::rectangle([-2.0, -2.0], [2.0, 2.0])?);
/// assert_eq!(cells.area(center), 4.0);
/// assert_eq!(d.vertices().map(|v| cells.area(v)).sum::<f64>(), 16.0);
/// # Ok::<(), delone::Error>(())
/// ```
#[doc(alias = "Voronoi_diagram_2")]
#[derive(Clone, Copy, Debug)]
pub struct Voronoi2<'a> {
    triangulation: &'a Delaunay2,
}

/// An edge of the diagram: the points as near to two sites as to any other. It is bounded on two sides, on one or on
/// none, so a match may name them all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VoronoiEdge2 {
    /// From the center of the triangle on the left of the Delaunay edge to the one on its right.
    Segment([[f64; 2]; 2]),
    /// Unbounded on one side.
    Ray {
        /// Where it starts.
        from: [f64; 2],
        /// Where it goes; of any length.
        direction: [f64; 2],
    },
    /// Unbounded on both sides: all sites are on one line, or both ends are too far away for `f64`.
    Line {
        /// A point on it.
        through: [f64; 2],
        /// Where it goes; of any length.
        direction: [f64; 2],
    },
}

impl Delaunay2 {
    /// The Voronoi diagram of the vertices.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [0, 2]])?;
    /// assert_eq!(d.voronoi().vertices().collect::<Vec<_>>(), [Some([2.0, 1.0])]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn voronoi(&self) -> Voronoi2<'_> {
        Voronoi2 { triangulation: self }
    }
}

impl<'a> Voronoi2<'a> {
    /// The triangulation that it is a view of.
    pub fn triangulation(self) -> &'a Delaunay2 {
        self.triangulation
    }

    /// The Voronoi vertex of a triangle: the center of its circle. `None` for a ghost, and if it is too far away for
    /// `f64`.
    pub fn vertex(self, t: TriangleId) -> Option<[f64; 2]> {
        self.triangulation.circumcenter(t)
    }

    /// The Voronoi vertices, one for each finite triangle, in the order of [`crate::Mesh2::triangles`]; those of
    /// triangles on one circle coincide up to rounding.
    pub fn vertices(self) -> impl Iterator<Item = Option<[f64; 2]>> + 'a {
        self.triangulation.mesh().triangles().map(move |t| self.vertex(t))
    }

    /// The Voronoi edge between the sites of a finite Delaunay edge.
    ///
    /// ```
    /// use delone::{Delaunay2, VoronoiEdge2};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [0, 2]])?;
    /// let edges: Vec<_> = d.mesh().undirected_edges().map(|e| d.voronoi().edge(e)).collect();
    /// assert_eq!(edges.len(), 3);
    /// assert!(edges.iter().all(|edge| matches!(edge, VoronoiEdge2::Ray { from: [2.0, 1.0], .. })));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn edge(self, e: EdgeId) -> VoronoiEdge2 {
        let mesh = self.triangulation.mesh();
        let [a, b] = self.triangulation.segment(e);
        // To the right of the Delaunay edge, halved for the range of f64.
        let right = [b[1] / 2.0 - a[1] / 2.0, a[0] / 2.0 - b[0] / 2.0];
        let left = right.map(|x| 0.0 - x);
        match (self.vertex(e.triangle()), self.vertex(mesh.twin(e).triangle())) {
            (Some(from), Some(to)) => VoronoiEdge2::Segment([from, to]),
            (Some(from), None) => VoronoiEdge2::Ray { from, direction: right },
            (None, Some(from)) => VoronoiEdge2::Ray { from, direction: left },
            (None, None) => {
                let through = [0, 1].map(|axis| a[axis] / 2.0 + b[axis] / 2.0);
                VoronoiEdge2::Line { through, direction: right }
            }
        }
    }

    /// The Voronoi edges, one for each finite Delaunay edge, in the order of [`crate::Mesh2::undirected_edges`].
    #[doc(alias("undirected_voronoi_edges", "ridge_vertices"))]
    pub fn edges(self) -> impl Iterator<Item = VoronoiEdge2> + 'a {
        self.triangulation.mesh().undirected_edges().map(move |e| self.edge(e))
    }

    /// Whether the Voronoi edge of a finite Delaunay edge is more than a point: it is a point where four sites are on
    /// one circle. Exact.
    pub fn has_length(self, e: EdgeId) -> bool {
        let mesh = self.triangulation.mesh();
        let twin = mesh.twin(e);
        let corners = [mesh.origin(e), mesh.destination(e), mesh.apex(e), mesh.apex(twin)];
        if corners.iter().any(|v| v.is_ghost()) {
            return true;
        }
        let [a, b, c, d] = corners.map(|v| self.triangulation.point(v));
        !in_circle_with_ties(a, b, c, d).is_zero()
    }

    /// Whether the cell of a vertex is bounded: it is for vertices that are not on the hull.
    ///
    /// ```
    /// use delone::{Delaunay2, VertexId};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4], [2, 2]])?;
    /// assert!(d.voronoi().is_bounded(VertexId::new(4)) && !d.voronoi().is_bounded(VertexId::new(0)));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn is_bounded(self, site: VertexId) -> bool {
        let mesh = self.triangulation.mesh();
        let mut star = mesh.star(site).peekable();
        star.peek().is_some() && star.all(|e| !mesh.destination(e).is_ghost())
    }

    /// The corners of a cell, counter-clockwise; those of an unbounded cell from ray to ray, and without those too
    /// far away for `f64`. Corners that coincide because sites are on one circle appear once.
    ///
    /// ```
    /// use delone::{Delaunay2, VertexId};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4], [2, 2]])?;
    /// let mut corners: Vec<_> = d.voronoi().corners(VertexId::new(4)).collect();
    /// corners.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    /// assert_eq!(corners, [[0.0, 2.0], [2.0, 0.0], [2.0, 4.0], [4.0, 2.0]]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("voronoi_face", "point_region"))]
    pub fn corners(self, site: VertexId) -> impl Iterator<Item = [f64; 2]> + 'a {
        let mesh = self.triangulation.mesh();
        // From the hull edge on, if there is one: the ghost is on its right.
        let first = mesh.star(site).find(|&e| mesh.is_ghost(mesh.twin(e).triangle()));
        let star = first.map_or_else(|| mesh.star(site), |e| mesh.star_from(e));
        let finite = star.filter(|&e| !mesh.destination(e).is_ghost());
        finite.filter(move |&e| self.has_length(e)).filter_map(move |e| self.vertex(e.triangle()))
    }

    /// The sites whose cells share more than a point with a cell, counter-clockwise.
    ///
    /// ```
    /// use delone::{Delaunay2, VertexId};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4]])?; // four cells meet in a point
    /// assert!((0..4).all(|k| d.voronoi().neighbors(VertexId::new(k)).count() == 2));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("neighbours", "ridge_points"))]
    pub fn neighbors(self, site: VertexId) -> impl Iterator<Item = VertexId> + 'a {
        let mesh = self.triangulation.mesh();
        let finite = mesh.star(site).filter(|&e| !mesh.destination(e).is_ghost());
        finite.filter(move |&e| self.has_length(e)).map(|e| mesh.destination(e))
    }
}
