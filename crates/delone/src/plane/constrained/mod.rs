//! Constrained Delaunay triangulations: segments are edges, and everything else is as near to Delaunay as that allows.
//!
//! The triangulation is a function of the set of points and of the union of the segments: among those that have all points for
//! vertices and all constraints for edges, exactly one has the far corner across every other edge outside of the circle under
//! the canonical rule. (Whatever order flips are made in, they end there; and two such triangulations would agree, because the
//! circles along a line of sight grow towards a vertex that is seen.) So the order, direction and repetition of the input, the
//! algorithm and the threads do not show; adding a constraint and taking it away changes nothing; and what is inside of a closed
//! chain of constraints does not depend on what is outside.
//!
//! `trace` follows a segment from both ends, `force` makes it an edge, `patch` triangulates large sides of a crossed channel. `build`
//! inserts many segments in Morton order, and `overlaps` skips shared parts. `passes`, `crossings`, `cells` and `split` serve segments
//! that cross. `segments` tells which segments cover an edge. `domains` tells inside from outside; `visibility` answers lines of sight.
//!
//! Sources: Lee & Lin, "Generalized Delaunay triangulation for planar graphs", DCG 1986; Chew, "Constrained Delaunay
//! triangulations", Algorithmica 1989; Shewchuk & Brown, CGTA 2015.
//!
//! It is a type of its own, because half of what [`Delaunay2`] promises is not true of it: visibility walks may run in circles,
//! the nearest vertex is not at the end of a descent, there is no Voronoi diagram. Inside it is a `Delaunay2` whose mesh has
//! fixed edges: names, places, layouts of memory, hints and removal are the same code, and only insertion and walks look for
//! fixed edges, where there are any.

mod build;
mod carried;
mod cells;
mod change;
mod check;
mod crossings;
mod domains;
mod flips;
mod force;
mod gap;
mod kept;
mod layered;
mod locate;
mod members;
mod nearest;
mod overlaps;
mod passes;
mod patch;
mod polygons;
mod refined;
mod segments;
mod shells;
mod split;
mod trace;
mod triangulation;
mod visibility;

use std::sync::OnceLock;

pub use build::Crossings;
pub use change::SegmentEnds;
pub use check::ConstrainedFlaw2;
pub use domains::{Domains2, Fill, Part2, RegionSeed2, Seeds2};
pub use gap::Gap2;
pub(in crate::plane) use kept::sorted;
pub use members::{Membership2, Overlaps2, PolygonRegion2};
pub use polygons::{PolygonTriangles2, Polygons2, RingFill};
pub(in crate::plane) use refined::{Before, Origin};
pub use segments::{Covering2, SegmentId};

use super::Delaunay2;
use crate::ids::{Duplicate, EdgeId, Place, TriangleId, VertexId};
use crate::mesh::triangles::channel::Channel;
use crate::mesh::{Dimension, Mesh2};
use segments::{Cover, Segments};
use trace::Ground;

/// A constrained Delaunay triangulation of points and segments in the plane.
///
/// Segments may pass through vertices, overlap, repeat each other and have no length. Where two of them cross it is an error,
/// or both are split, as [`Crossings`] says. Vertices and segments can be inserted and removed at any time, and what is left is
/// the triangulation of what is left.
///
/// ```
/// use delone::{Constrained2, Fill};
///
/// // A square with a triangular hole.
/// let points = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [2, 3]];
/// let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]];
/// let c = Constrained2::from_parts(&points, &segments)?;
/// assert_eq!(c.constraints().count(), 7);
/// let domains = c.domains(&Fill::EvenOdd)?;
/// let inside: f64 = c.triangle_ids().filter(|&t| domains.is_inside(t)).map(|t| c.area(t)).sum();
/// assert_eq!(inside, 14.0);
/// # Ok::<(), delone::Error>(())
/// ```
#[doc(alias("ConstrainedDelaunayTriangulation", "Constrained_Delaunay_triangulation_2"))]
#[derive(Clone, Debug, Default)]
pub struct Constrained2 {
    /// A triangulation with fixed edges: Delaunay but for these.
    graph: Delaunay2,
    segments: Segments,
    /// Made at the first need.
    cover: OnceLock<Cover>,
    report: ConstraintReport2,
    channel: Channel,
    /// Whether a segment may be a chain of several edges; if not, none is.
    has_chains: bool,
}

/// Counts of the segments that a triangulation was built from. Where crossings were split, their pieces are counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct ConstraintReport2 {
    /// Segments of no length: they are no constraints.
    pub zero_length: usize,
    /// Segments that repeat another one, in either direction.
    pub repeated: usize,
    /// Segments that share a part of their length with another one, repetitions apart.
    pub overlapping: usize,
    /// Segments with vertices strictly inside of them.
    pub through_vertices: usize,
    /// Pairs of segments that crossed and were split.
    pub crossings: usize,
    /// Vertices that were added where segments crossed.
    pub added_points: usize,
    /// Rounds of splitting that changed something.
    pub rounds: usize,
}

impl Constrained2 {
    /// The topology: vertices, edges, triangles, stars, hull. [`Mesh2::is_fixed`] tells constraints.
    pub fn mesh(&self) -> &Mesh2 {
        self.graph.mesh()
    }

    /// The coordinates of all points ever given, by id: those of the input, those added where segments crossed, and insertions;
    /// duplicates, and those since removed, too.
    pub fn points(&self) -> &[[f64; 2]] {
        self.graph.points()
    }

    /// Gives the points away.
    fn into_points(self) -> Vec<[f64; 2]> {
        self.graph.named.unwrap_or(self.graph.base.points)
    }

    /// Gives the topology and the points away: those of a construction, each vertex at the place of its id.
    pub(crate) fn into_parts(self) -> (Mesh2, Vec<[f64; 2]>) {
        debug_assert!(self.graph.named.is_none(), "nothing has changed since");
        (self.graph.base.mesh, self.graph.base.points)
    }

    /// Counts of the segments of the construction.
    ///
    /// ```
    /// use delone::Constrained2;
    ///
    /// let c = Constrained2::from_parts(&[[0, 0], [4, 0], [0, 4]], &[[0, 1], [1, 0], [2, 2]])?;
    /// assert_eq!((c.report().repeated, c.report().zero_length), (1, 1));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn report(&self) -> &ConstraintReport2 {
        &self.report
    }

    /// Whether an edge is a constraint.
    ///
    /// ```
    /// use delone::Constrained2;
    ///
    /// let c = Constrained2::from_parts(&[[0, 0], [4, 0], [0, 4]], &[[0, 1]])?;
    /// assert_eq!(c.mesh().undirected_edges().filter(|&e| c.is_constraint(e)).count(), 1);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("is_constrained", "is_constraint_edge"))]
    pub fn is_constraint(&self, e: EdgeId) -> bool {
        self.mesh().is_fixed(e)
    }

    /// The constraint edges, each once, the lesser end first.
    ///
    /// ```
    /// use delone::Constrained2;
    ///
    /// let c = Constrained2::from_parts(&[[0, 0], [2, 0], [4, 0], [1, 3]], &[[0, 2]])?;
    /// assert_eq!(c.constraints().count(), 2); // the segment passes through the second point
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "constrained_edges")]
    pub fn constraints(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.constraint_edges().map(|e| {
            let ends = [self.mesh().origin(e), self.mesh().destination(e)];
            [ends[0].min(ends[1]), ends[0].max(ends[1])]
        })
    }

    /// The constraint edges by id, each in one of its directions.
    pub fn constraint_edges(&self) -> impl Iterator<Item = EdgeId> + '_ {
        self.mesh().fixed_edges()
    }

    /// The segments that there are, with their ends, by increasing id; none of no length.
    pub fn segments(&self) -> impl Iterator<Item = (SegmentId, [VertexId; 2])> + '_ {
        self.segments.iter()
    }

    /// The vertices along a segment, from its first end to its second; `None` for one that is not there.
    ///
    /// Cost: O(1) for each vertex of usual degree on it.
    ///
    /// ```
    /// use delone::Constrained2;
    ///
    /// let c = Constrained2::from_parts(&[[0, 0], [2, 0], [4, 0], [1, 3]], &[[0, 2]])?;
    /// let (segment, _) = c.segments().next().expect("one");
    /// let vertices = c.chain(segment).expect("it is there");
    /// assert_eq!(vertices.iter().map(|v| v.index()).collect::<Vec<_>>(), [0, 1, 2]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn chain(&self, s: SegmentId) -> Option<Vec<VertexId>> {
        let ends = self.segments.ends(s)?;
        let mut vertices = vec![ends[0]];
        let mesh = self.mesh();
        self.edges_of(s, |_, e| vertices.push(mesh.destination(e)));
        Some(vertices)
    }

    /// The segments that cover an edge, by increasing id; none of one that is no constraint.
    ///
    /// The first call makes a table, O(m log m) for m constraint edges; O(log m) then.
    pub fn covering(&self, e: EdgeId) -> Vec<Covering2> {
        self.cover().of([self.mesh().origin(e), self.mesh().destination(e)])
    }

    /// The straight pieces of a segment, each between two vertices.
    fn places_of(&self, s: SegmentId) -> impl Iterator<Item = [Place; 2]> + '_ {
        let place = |v| self.mesh().place(v);
        self.segments.pieces(s).filter_map(move |[v, w]| Some([place(v)?, place(w)?]))
    }

    /// Tells each edge of a segment, in its direction.
    fn edges_of(&self, s: SegmentId, mut each: impl FnMut(SegmentId, EdgeId)) {
        let ground = self.ground();
        self.places_of(s).for_each(|piece| ground.chain(piece).into_iter().for_each(|e| each(s, e)));
    }

    fn ground(&self) -> Ground<'_> {
        Ground { mesh: &self.graph.base.mesh, points: &self.graph.base.points }
    }

    /// Which segments cover which edge.
    fn cover(&self) -> &Cover {
        self.cover.get_or_init(|| {
            let mut cover = Cover::default();
            let mesh = self.mesh();
            for (s, _) in self.segments.iter() {
                self.edges_of(s, |s, e| cover.add(s, [mesh.origin(e), mesh.destination(e)]));
            }
            cover
        })
    }

    /// The points that equal an earlier one which is a vertex, by increasing index.
    pub fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_ {
        self.graph.duplicates()
    }

    /// The dimension of the span of the points.
    pub fn dimension(&self) -> Dimension {
        self.graph.dimension()
    }

    /// The number of vertices: points without duplicates.
    pub fn vertex_count(&self) -> usize {
        self.graph.vertex_count()
    }

    /// The vertices, by increasing index.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.graph.vertices()
    }

    /// The finite triangles as corners in counter-clockwise order.
    #[doc(alias("simplices", "finite_faces", "inner_faces"))]
    pub fn triangles(&self) -> impl Iterator<Item = [VertexId; 3]> + '_ {
        self.graph.triangles()
    }

    /// The finite triangles, by id.
    pub fn triangle_ids(&self) -> impl Iterator<Item = TriangleId> + '_ {
        self.graph.triangle_ids()
    }

    /// The number of finite triangles. O(h) for a hull of h vertices.
    pub fn triangle_count(&self) -> usize {
        self.graph.triangle_count()
    }

    /// The finite edges, each once, constraints among them.
    pub fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.graph.edges()
    }

    /// The vertices joined to a vertex by an edge, counter-clockwise; none for an id that is no vertex.
    #[doc(alias("neighbours", "incident_vertices"))]
    pub fn neighbors(&self, v: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        self.graph.neighbors(v)
    }

    /// The vertices of the hull, counter-clockwise; see [`Mesh2::hull`].
    #[doc(alias = "convex_hull")]
    pub fn hull_vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.graph.hull_vertices()
    }

    /// The edges of the hull, counter-clockwise; none below the plane.
    #[doc(alias("convex_hull", "hull_edges"))]
    pub fn hull_facets(&self) -> impl Iterator<Item = [VertexId; 2]> + Send + '_ {
        self.graph.hull_facets()
    }

    /// The coordinates of a vertex.
    ///
    /// # Panics
    /// For an id that is no vertex.
    pub fn point(&self, v: VertexId) -> [f64; 2] {
        self.graph.point(v)
    }

    /// The coordinates of the ends of a finite edge.
    pub fn segment(&self, e: EdgeId) -> [[f64; 2]; 2] {
        self.graph.segment(e)
    }

    /// The area of a finite triangle, as [`Delaunay2::area`].
    pub fn area(&self, t: TriangleId) -> f64 {
        self.graph.area(t)
    }
}
