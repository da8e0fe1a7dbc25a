//! The criteria of a mesh, and how it is made.

use super::layers::Layers2;
use super::rules::{Field, Test};
use crate::ids::VertexId;
use crate::plane::constrained::{Fill, SegmentId};

/// The default of [`Refinement::growth`]. On the twenty geometries of `compare/with_gmsh.py` 1.1 makes 1.55 times as many triangles in all,
/// 1.3 0.87 times, 1.5 0.74 times; the largest steps there are 1.35, 1.5, 1.7 and 2.1 from one triangle to the next.
const GROWTH: f64 = 1.2;

/// Which constraints may not be split.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Keep {
    /// All may.
    #[default]
    Nothing,
    /// Constraints with the mesh on one side only.
    Border,
    /// All.
    Constraints,
}

/// Where a new vertex goes for the sake of an angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Placement {
    /// On the bisector of the shortest side, no farther than the angle asks for (Ungor, LATIN 2004): fewer triangles.
    #[default]
    OffCenter,
    /// In the circumcenter (Ruppert, J. Algorithms 1995; Chew, SoCG 1993).
    Circumcenter,
}

/// The criteria of a mesh, and how it is made.
///
/// ```
/// use delone::{Constrained2, Fill, Refinement};
///
/// // A square with a triangular hole.
/// let points = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [2, 3]];
/// let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]];
/// let mut c = Constrained2::from_parts(&points, &segments)?;
/// let refined = Refinement::new().min_angle(30.0).max_area(0.1).fill(Fill::EvenOdd).run(&mut c)?;
/// assert!(refined.report.left.is_empty() && refined.report.smallest_angle >= 30.0);
/// let area: f64 = c.triangle_ids().filter(|&t| refined.domains.is_inside(t)).map(|t| c.area(t)).sum();
/// assert!((area - 14.0).abs() < 1e-12);
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Refinement<'a> {
    pub(super) min_angle: f64,
    pub(super) max_area: Option<f64>,
    pub(super) max_edge: Option<f64>,
    pub(super) min_edge: f64,
    pub(super) area_at: Option<Field<'a>>,
    pub(super) size_at: Option<Field<'a>>,
    pub(super) refine_if: Option<Test<'a>>,
    pub(super) edge: Option<f64>,
    pub(super) edge_at: Option<Field<'a>>,
    pub(super) growth: f64,
    pub(super) max_vertices: Option<usize>,
    pub(super) keep: Keep,
    pub(super) placement: Placement,
    pub(super) conforming: bool,
    pub(super) smoothing: usize,
    pub(super) layers: Option<&'a Layers2>,
    pub(super) stop: Option<&'a dyn Fn() -> bool>,
    pub(super) watch: Option<&'a dyn Fn(usize)>,
    pub(super) fill: Fill<'a>,
    pub(super) triangles: &'a [[VertexId; 3]],
    pub(super) arcs: &'a [(SegmentId, [f64; 2])],
}

impl std::fmt::Debug for Refinement<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Refinement")
            .field("min_angle", &self.min_angle)
            .field("max_area", &self.max_area)
            .field("max_edge", &self.max_edge)
            .field("min_edge", &self.min_edge)
            .field("edge", &self.edge)
            .field("growth", &self.growth)
            .field("max_vertices", &self.max_vertices)
            .field("keep", &self.keep)
            .field("placement", &self.placement)
            .field("conforming", &self.conforming)
            .field("smoothing", &self.smoothing)
            .field("layers", &self.layers)
            .field("fill", &self.fill)
            .finish_non_exhaustive()
    }
}

impl Default for Refinement<'_> {
    fn default() -> Self {
        Self::new()
    }
}

impl<'a> Refinement<'a> {
    /// All angles at least 20 degrees, in all of the hull.
    pub fn new() -> Self {
        Self {
            min_angle: 20.0,
            max_area: None,
            max_edge: None,
            min_edge: 0.0,
            area_at: None,
            size_at: None,
            refine_if: None,
            edge: None,
            edge_at: None,
            growth: GROWTH,
            max_vertices: None,
            keep: Keep::Nothing,
            placement: Placement::OffCenter,
            conforming: false,
            smoothing: 0,
            layers: None,
            stop: None,
            watch: None,
            fill: Fill::All,
            triangles: &[],
            arcs: &[],
        }
    }

    /// No angle is to be smaller than so many degrees: 0, which asks for nothing, to less than 60. Up to 34 are reached wherever the
    /// input lets them. More are tried: first 34, then what is asked for with at most as many new vertices as there are vertices by then,
    /// if [`Self::max_vertices`] says nothing else. The report tells what is left.
    ///
    /// ```
    /// use delone::{Constrained2, Refinement};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [9, 0], [9, 1], [0, 1]], &[])?;
    /// let made = Refinement::new().min_angle(30.0).run(&mut c)?;
    /// assert!(made.report.smallest_angle >= 30.0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn min_angle(self, degrees: f64) -> Self {
        Self { min_angle: degrees, ..self }
    }

    /// No triangle is to be larger. Regions may have smaller bounds of their own, see [`crate::RegionSeed2::max_area`].
    ///
    /// ```
    /// use delone::{Constrained2, Refinement};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [4, 0], [4, 4], [0, 4]], &[])?;
    /// Refinement::new().max_area(0.5).run(&mut c)?;
    /// assert!(c.triangle_ids().all(|t| c.area(t) <= 0.5));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn max_area(self, area: f64) -> Self {
        Self { max_area: Some(area), ..self }
    }

    /// No triangle is to be larger than what is said for its centroid.
    #[must_use]
    pub fn max_area_at(self, area: &'a dyn Fn([f64; 2]) -> f64) -> Self {
        Self { area_at: Some(area), ..self }
    }

    /// No edge is to be longer, constraints included.
    ///
    /// ```
    /// use delone::{Constrained2, Refinement};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [4, 0], [4, 4], [0, 4]], &[])?;
    /// Refinement::new().max_edge(1.0).run(&mut c)?;
    /// let length = |[a, b]: [[f64; 2]; 2]| (b[0] - a[0]).hypot(b[1] - a[1]);
    /// assert!(c.mesh().undirected_edges().all(|e| length(c.segment(e)) <= 1.0));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn max_edge(self, length: f64) -> Self {
        Self { max_edge: Some(length), ..self }
    }

    /// No edge with a new vertex is to be shorter, up to rounding: where angles and sizes ask for more, triangles are left, for
    /// [`super::Reason::Short`]. For meshes whose smallest element is what a time step allows, of outlines with gaps that are narrower
    /// (where these may be closed, see [`crate::Weld2`]). Not for boundary layers.
    ///
    /// ```
    /// use delone::{Constrained2, Reason, Refinement};
    ///
    /// // A notch that is a thousand times narrower than the plate.
    /// let plate = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.501, 1.0], [0.5, 0.5], [0.5, 1.0], [0.0, 1.0]];
    /// let mut c = Constrained2::from_parts(&plate, &[])?;
    /// let made = Refinement::new().min_edge(0.05).run(&mut c)?;
    /// assert!(made.report.left_for(Reason::Short) > 0);
    /// let length = |[a, b]: [[f64; 2]; 2]| (b[0] - a[0]).hypot(b[1] - a[1]);
    /// let short = c.mesh().undirected_edges().filter(|&e| length(c.segment(e)) < 0.05).count();
    /// assert_eq!(short, 1); // that of the input
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn min_edge(self, length: f64) -> Self {
        Self { min_edge: length, ..self }
    }

    /// No edge of a triangle is to be longer than what is said for its centroid. Infinite is no bound.
    ///
    /// ```
    /// use delone::{Constrained2, Refinement};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [4, 0], [4, 4], [0, 4]], &[])?;
    /// let graded = |[x, _]: [f64; 2]| 0.2 + 0.5 * x; // short edges on the left
    /// Refinement::new().size(&graded).run(&mut c)?;
    /// let left = c.vertices().filter(|&v| c.point(v)[0] < 2.0).count();
    /// assert!(left > c.vertex_count() / 2);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn size(self, length: &'a dyn Fn([f64; 2]) -> f64) -> Self {
        Self { size_at: Some(length), ..self }
    }

    /// Triangles are refined as long as this says so, of the corners, counter-clockwise from the shortest side on, and of the area. If
    /// [`Self::max_vertices`] says nothing, it ends at the larger of 2^21 new vertices and 64 a point; [`super::Reason::Budget`] tells.
    ///
    /// ```
    /// use delone::{Constrained2, Refinement};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [4, 0], [4, 4], [0, 4]], &[])?;
    /// let near = |[x, y]: [f64; 2]| x.hypot(y) < 1.0;
    /// let refused = |corners: [[f64; 2]; 3], area: f64| area > 0.01 && corners.into_iter().any(near);
    /// Refinement::new().refine_if(&refused).run(&mut c)?;
    /// let corners = |t| c.mesh().corners(t).map(|v| c.point(v));
    /// assert!(c.triangle_ids().all(|t| !refused(corners(t), c.area(t))));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn refine_if(self, is_to_be_refined: Test<'a>) -> Self {
        Self { refine_if: Some(is_to_be_refined), ..self }
    }

    /// Edges are to have this length: triangles become nearly equilateral, and grow smoothly from where the input asks for short edges
    /// to where it does not. The length is what is wanted and no bound: most edges have from 0.9 to 1.15 times it, fewer where constraints
    /// are near. Bounds of angles, areas and edges hold as without it; where they ask for less, edges are shorter.
    ///
    /// ```
    /// use delone::{Constrained2, Refinement, Shapes2};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [4, 0], [4, 4], [0, 4]], &[])?;
    /// let made = Refinement::new().edge(0.5).min_angle(30.0).run(&mut c)?;
    /// let shapes = Shapes2::of(&c, &made.domains);
    /// assert!(shapes.quality_mean > 0.97 && made.report.smallest_angle > 30.0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn edge(self, length: f64) -> Self {
        Self { edge: Some(length), ..self }
    }

    /// Edges are to have the length that is said for a place, which is asked wherever an edge may be. With [`Self::edge`] the lesser one
    /// counts; infinite is no wish.
    ///
    /// ```
    /// use delone::{Constrained2, Refinement};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [4, 0], [4, 4], [0, 4]], &[])?;
    /// let wanted = |[x, _]: [f64; 2]| 0.1 + 0.2 * x; // short edges on the left
    /// Refinement::new().edge_at(&wanted).growth(1.3).run(&mut c)?;
    /// assert!(c.vertices().filter(|&v| c.point(v)[0] < 1.0).count() > c.vertex_count() / 3);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn edge_at(self, length: &'a dyn Fn([f64; 2]) -> f64) -> Self {
        Self { edge_at: Some(length), ..self }
    }

    /// For meshes with a wanted length of edges: lengths grow by at most this factor from one edge to the next, from more than 1 on.
    /// 1.2, if nothing is said: less makes more triangles that are better; more, fewer.
    #[must_use]
    pub fn growth(self, factor: f64) -> Self {
        Self { growth: factor, ..self }
    }

    /// Sets the largest number of new vertices.
    ///
    /// ```
    /// use delone::{Constrained2, Refinement};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [4, 0], [4, 4], [0, 4]], &[])?;
    /// let made = Refinement::new().max_area(0.001).max_vertices(10).run(&mut c)?;
    /// assert_eq!(c.vertex_count(), 14);
    /// assert!(!made.report.left.is_empty()); // what is not as it was to be
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn max_vertices(self, count: usize) -> Self {
        Self { max_vertices: Some(count), ..self }
    }

    /// Constraints that may not be split.
    ///
    /// ```
    /// use delone::{Constrained2, Keep, Refinement};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [4, 0], [4, 4], [0, 4]], &[])?;
    /// Refinement::new().max_area(0.5).keep(Keep::Border).run(&mut c)?;
    /// assert_eq!(c.hull_vertices().count(), 4); // no side was split
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn keep(self, keep: Keep) -> Self {
        Self { keep, ..self }
    }

    /// Where new vertices go for the sake of angles.
    ///
    /// ```
    /// use delone::{Constrained2, Placement, Refinement};
    ///
    /// let plate = [[0, 0], [100, 0], [100, 30], [50, 2], [0, 30]];
    /// let count = |placement| {
    ///     let mut c = Constrained2::from_parts(&plate, &[]).expect("points");
    ///     let made = Refinement::new().min_angle(30.0).placement(placement).run(&mut c).expect("a mesh");
    ///     assert!(made.report.smallest_angle >= 30.0);
    ///     made.report.triangles
    /// };
    /// assert!(count(Placement::OffCenter) <= count(Placement::Circumcenter));
    /// ```
    #[must_use]
    pub fn placement(self, placement: Placement) -> Self {
        Self { placement, ..self }
    }

    /// No vertex inside of the diametral circle of a constraint, so that what is inside is a Delaunay triangulation (Ruppert).
    #[must_use]
    pub fn conforming(self, conforming: bool) -> Self {
        Self { conforming, ..self }
    }

    /// Sets the number of rounds of smoothing afterwards (see `smooth` in the source). Angles become larger, and the criteria still
    /// hold, because triangles that smoothing made too large are refined once more.
    #[must_use]
    pub fn smooth(self, rounds: usize) -> Self {
        Self { smoothing: rounds, ..self }
    }

    /// Rows of thin triangles along the border, or along segments that are chosen; the rest is as without them, and the last line of the rows
    /// is a border that is not split. See [`Layers2`].
    #[must_use]
    pub fn layers(self, layers: &'a Layers2) -> Self {
        Self { layers: Some(layers), ..self }
    }

    /// Ends with [`crate::Error::Stopped`] soon after this says so; it is asked now and then.
    #[must_use]
    pub fn stop_if(self, stop: &'a dyn Fn() -> bool) -> Self {
        Self { stop: Some(stop), ..self }
    }

    /// Is told how many new vertices there are, as often as [`Self::stop_if`] is asked; where constraints are split it may be fewer
    /// than before.
    #[must_use]
    pub fn watch(self, watch: &'a dyn Fn(usize)) -> Self {
        Self { watch: Some(watch), ..self }
    }

    /// Sets the rule for what is inside. Where the hull is the border, it becomes a constraint.
    ///
    /// ```
    /// use delone::{Constrained2, Fill, Refinement};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [4, 0], [4, 4], [0, 4]], &[[0, 1], [1, 2], [2, 0]])?;
    /// let made = Refinement::new().max_area(0.5).fill(Fill::EvenOdd).run(&mut c)?;
    /// let inside = c.triangle_ids().filter(|&t| made.domains.is_inside(t));
    /// assert!((inside.map(|t| c.area(t)).sum::<f64>() - 8.0).abs() < 1e-9); // the half that segments bound
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn fill(self, fill: Fill<'a>) -> Self {
        Self { fill, ..self }
    }

    /// Triangles that are there first, whether they are Delaunay or not, and stay until a new vertex is to come into the circle of one: a
    /// mesh from elsewhere is refined where it has to be, and is itself anywhere else. Edges that only keep triangles are in
    /// [`super::Refined2::kept`]. Where lengths of edges are wanted ([`Self::edge`]), or layers, no triangles
    /// are kept.
    ///
    /// ```
    /// use delone::{Constrained2, Refinement, VertexId};
    ///
    /// // Two triangles of a flat quadrilateral: the diagonal is the longer one.
    /// let mut c = Constrained2::from_parts(&[[0, 0], [4, -3], [8, 0], [4, 3]], &[])?;
    /// let given = [[0, 1, 2], [0, 2, 3]].map(|corners| corners.map(VertexId::new));
    /// let made = Refinement::new().triangles(&given).run(&mut c)?;
    /// assert_eq!((c.triangle_count(), made.kept.len()), (2, 1));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn triangles(self, triangles: &'a [[VertexId; 3]]) -> Self {
        Self { triangles, ..self }
    }

    /// Segments that are chords of arcs, with the centers of their circles ([`crate::Arc2`]): new vertices on them are on the arcs, which may be any of
    /// less than half a turn. Beside an arc of more than 11 degrees other vertices may be in the way: divide it before
    /// ([`crate::Arc2::inner_points`]).
    ///
    /// ```
    /// use delone::{Arc2, Constrained2, Refinement, SegmentId};
    ///
    /// let corners = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
    /// let mut c = Constrained2::from_parts(&corners, &[[0, 1], [1, 2], [2, 3], [3, 0]])?;
    /// let arcs: Vec<_> = (0..4).map(|s| (SegmentId::new(s), [0.0, 0.0])).collect();
    /// let made = Refinement::new().edge(0.1).arcs(&arcs).run(&mut c)?;
    /// let inside = c.triangle_ids().filter(|&t| made.domains.is_inside(t));
    /// let area: f64 = inside.map(|t| c.area(t)).sum();
    /// assert!((3.13..std::f64::consts::PI).contains(&area)); // a disk
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn arcs(self, arcs: &'a [(SegmentId, [f64; 2])]) -> Self {
        Self { arcs, ..self }
    }
}
