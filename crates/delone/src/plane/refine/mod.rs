//! Refinement: new vertices until all triangles are as they are to be, or a reason is known why one is not.
//!
//! Delaunay refinement puts a new vertex into the circumcenter of a bad triangle, or nearer to its shortest edge (`shape`); where
//! a constraint is in the way that is split instead (`split`). What is bad is in a queue whose order is one of geometry
//! (`queue`), so the mesh is a function of the input.
//!
//! *Angles.* Proven for input angles of at least 60 degrees: 20.7 degrees (Ruppert, J. Algorithms 1995), 26.45 (Miller, Pav &
//! Walkington, IMR 2003), 28.6 (Chew's second algorithm; Rand, CCCG 2011). In practice 33 degrees nearly always work. Whatever is
//! asked, it ends (`mesher`), and [`RefinementReport2`] says what is left and why.
//!
//! *Exactness.* New vertices are rounded. So each is checked exactly before anything changes: nothing is ever inverted, lost or
//! inserted twice, and what comes out is the constrained Delaunay triangulation of its vertices and constraints.
//!
//! Cost: O(log n) expected for each new vertex; some 250 nanoseconds a triangle.

mod free;
mod frontal;
mod layers;
mod mesher;
mod queue;
mod report;
mod rules;
mod shape;
mod shapes;
mod smooth;
mod split;
mod survey;

pub use layers::Layers2;
pub use report::{LayerReport2, Reason, RefinementReport2, Unrefined2};
pub use shapes::Shapes2;

use super::constrained::{Constrained2, Domains2, Fill, Origin};
use crate::error::Error;
use crate::ids::{MAX_POINTS, VertexId};
use crate::points::survey as bounds;
use frontal::Frontal;
use mesher::{Done, Known, Mesher};
use queue::{Queue, STEEP_ANGLE};
use rules::{Field, Rules};

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
    min_angle: f64,
    max_area: Option<f64>,
    max_edge: Option<f64>,
    area_at: Option<Field<'a>>,
    size_at: Option<Field<'a>>,
    edge: Option<f64>,
    edge_at: Option<Field<'a>>,
    growth: f64,
    max_vertices: Option<usize>,
    keep: Keep,
    conforming: bool,
    smoothing: usize,
    layers: Option<&'a Layers2>,
    stop: Option<&'a dyn Fn() -> bool>,
    watch: Option<&'a dyn Fn(usize)>,
    fill: Fill<'a>,
}

/// A mesh that was refined.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Refined2 {
    /// The parts of the triangulation, and which are inside; valid as long as nothing changes. Where a border was rounded
    /// inwards, what is between it and its old line, thinner than a unit in the last place, is in no part; asked anew by another
    /// rule, [`Constrained2::domains`] knows nothing of that. So a mesh that is refined again is filled by [`Fill::Parts`].
    pub domains: Domains2,
    /// Counts of what was done, and what could not be done.
    pub report: RefinementReport2,
}

impl std::fmt::Debug for Refinement<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Refinement")
            .field("min_angle", &self.min_angle)
            .field("max_area", &self.max_area)
            .field("max_edge", &self.max_edge)
            .field("edge", &self.edge)
            .field("growth", &self.growth)
            .field("max_vertices", &self.max_vertices)
            .field("keep", &self.keep)
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

/// The origin of each vertex, for the next refinement.
fn origins(c: &Constrained2, done: &Done) -> Vec<Origin> {
    let mesh = c.mesh();
    let unknown = Known::free(0.0).origin(mesh);
    let of = |i: usize| mesh.place(VertexId::new(i)).map_or(unknown, |p| done.known[p.index()].origin(mesh));
    (0..c.points().len()).map(of).collect()
}

/// The default of [`Refinement::growth`]. On the twenty geometries of `compare/with_gmsh.py` 1.1 makes 1.55 times as many triangles in all,
/// 1.3 0.87 times, 1.5 0.74 times; the largest steps there are 1.35, 1.5, 1.7 and 2.1 from one triangle to the next.
const GROWTH: f64 = 1.2;

/// Degrees, up to which refinement ends by itself in practice. At 34 meshes have some 1.2 times as many triangles as at 30; from 35 on
/// there are inputs on which new vertices make new faults without end.
const STEEPEST_THAT_ENDS: f64 = 34.0;

impl<'a> Refinement<'a> {
    /// All angles at least 20 degrees, in all of the hull.
    pub fn new() -> Self {
        Self {
            min_angle: 20.0,
            max_area: None,
            max_edge: None,
            area_at: None,
            size_at: None,
            edge: None,
            edge_at: None,
            growth: GROWTH,
            max_vertices: None,
            keep: Keep::Nothing,
            conforming: false,
            smoothing: 0,
            layers: None,
            stop: None,
            watch: None,
            fill: Fill::All,
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

    /// Ends with [`Error::Stopped`] soon after this says so; it is asked now and then.
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

    /// Refines a triangulation. New vertices have the next ids, in the order in which they came; segments are split, and bend by
    /// a unit in the last place where a new vertex is not exactly on them, which is much for what is hardly wider than that.
    ///
    /// Cost: see the module.
    ///
    /// # Errors
    /// [`Error::Parameter`] for bounds that are out of range, or ask for more triangles than there can be, [`Error::Seed`] and
    /// [`Error::Parts`] as [`Constrained2::domains`]; nothing has changed then. [`Error::Size`] if a bound that is asked for a place
    /// is not positive, [`Error::Stopped`]: the triangulation is a valid one then, refined in part.
    ///
    /// ```
    /// use delone::{Constrained2, Refinement};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [4, 0], [4, 4], [0, 4]], &[])?;
    /// let made = Refinement::new().min_angle(25.0).max_area(1.0).run(&mut c)?;
    /// assert!(made.report.left.is_empty()); // all is as it was to be
    /// assert_eq!(made.report.triangles, c.triangle_count());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn run(&self, c: &mut Constrained2) -> Result<Refined2, Error> {
        self.check()?;
        if let Some(wanted) = self.layers {
            return self.run_around(wanted, c);
        }
        if self.min_angle <= STEEPEST_THAT_ENDS || self.max_vertices.is_some() {
            return self.run_to_the_end(c);
        }
        let first = Self { min_angle: STEEPEST_THAT_ENDS, smoothing: 0, ..*self }.run_to_the_end(c)?;
        // Lengths are as they were to be by now.
        let (edge, edge_at) = (None, None);
        let (max_vertices, fill) = (Some(c.vertex_count()), Fill::Parts(&first.domains));
        let steeper = Refinement { edge, edge_at, max_vertices, fill, ..*self };
        let mut refined = steeper.run_to_the_end(c)?;
        refined.report.inside += first.report.inside;
        refined.report.on_constraints += first.report.on_constraints;
        Ok(refined)
    }

    /// Makes boundary layers, and refines what is around them.
    fn run_around(&self, wanted: &Layers2, c: &mut Constrained2) -> Result<Refined2, Error> {
        let grown = layers::grow(self, wanted, c)?;
        let max_vertices =
            self.max_vertices.map(|most| most.saturating_sub(grown.inside + grown.on_constraints));
        let rest = Refinement { layers: None, max_vertices, fill: Fill::Parts(&grown.domains), ..*self };
        let mut refined = rest.run(c)?;
        let report = &mut refined.report;
        report.inside += grown.inside;
        report.on_constraints += grown.on_constraints;
        report.layers = LayerReport2 { triangles: report.layers.triangles, ..grown.report };
        Ok(refined)
    }

    fn run_to_the_end(&self, c: &mut Constrained2) -> Result<Refined2, Error> {
        let mut domains = c.domains(&self.fill)?;
        self.check_count(c, &domains)?;
        c.close(&domains)?;
        let before = c.begin_refinement(&mut domains);
        let rules = Rules::new(self, &domains, &before);
        let layer = c.layer();
        let bounds = bounds(&layer.points).0;
        let queue = Queue::new(&bounds, self.min_angle > STEEP_ANGLE);
        let mut mesher = Mesher::new(layer, &rules, queue, &domains.origins);
        let mut ran = if self.edge.is_some() || self.edge_at.is_some() {
            Frontal::new(&mut mesher, &bounds, self.growth).run()
        } else {
            mesher.run()
        };
        if self.smoothing > 0 && ran.is_ok() {
            (0..self.smoothing).for_each(|_| mesher.smooth());
            ran = mesher.run();
        }
        let done = mesher.finish();
        let added = c.end_refinement(&before, &done.new)?;
        let report = survey::report(c.layer(), &rules, added, &done);
        let mut domains = c.domains_of_tags(&before, domains);
        ran?;
        domains.origins = origins(c, &done);
        Ok(Refined2 { domains, report })
    }

    /// Whether there may be as many triangles as the sizes ask for, which are the same everywhere.
    fn check_count(&self, c: &Constrained2, domains: &Domains2) -> Result<(), Error> {
        let range = "large enough for at most 2^30 triangles, or with a largest number of new vertices";
        // The largest triangle with edges of some length is equilateral.
        let equilateral = |edge: f64| edge * edge * (0.75_f64.sqrt() / 2.0);
        let bounds = [
            ("max_area", self.max_area, self.max_area),
            ("max_edge", self.max_edge, self.max_edge.map(equilateral)),
            ("edge", self.edge, self.edge.map(equilateral)),
        ];
        for (name, value, largest) in bounds {
            let (Some(value), Some(largest), None) = (value, largest, self.max_vertices) else { continue };
            let inside = c.triangle_ids().filter(|&t| domains.is_inside(t));
            let area: f64 = inside.map(|t| c.area(t)).sum();
            if area > largest * (2 * MAX_POINTS) as f64 {
                return Err(Error::Parameter { name, value, range });
            }
        }
        Ok(())
    }

    fn check(&self) -> Result<(), Error> {
        if !(0.0..60.0).contains(&self.min_angle) {
            let range = "from 0 to less than 60 degrees";
            return Err(Error::Parameter { name: "min_angle", value: self.min_angle, range });
        }
        if self.growth.is_nan() || self.growth <= 1.0 {
            return Err(Error::Parameter { name: "growth", value: self.growth, range: "more than 1" });
        }
        if let Some(layers) = self.layers {
            layers.check()?;
        }
        let bounds = [("max_area", self.max_area), ("max_edge", self.max_edge), ("edge", self.edge)];
        match bounds
            .into_iter()
            .find_map(|(name, value)| Some((name, value.filter(|x| x.is_nan() || *x <= 0.0)?)))
        {
            Some((name, value)) => Err(Error::Parameter { name, value, range: "positive" }),
            None => Ok(()),
        }
    }
}
