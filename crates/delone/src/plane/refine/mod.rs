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

mod all_quads;
mod arcs;
mod coarsen;
mod criteria;
mod free;
mod frontal;
mod kept;
mod layers;
mod mesher;
mod middles;
mod quads;
mod queue;
mod report;
mod rules;
mod shape;
mod shapes;
mod smooth;
mod smooth_quads;
mod split;
mod survey;

pub use all_quads::AllQuads2;
pub use criteria::{Keep, Placement, Refinement};
pub use layers::Layers2;
pub use middles::Middle2;
pub use quads::Quads2;
pub use report::{LayerReport2, Reason, RefinementReport2, Unrefined2};
pub use shapes::Shapes2;

use super::constrained::{Constrained2, Domains2, Fill, Origin, SegmentId};
use crate::error::Error;
use crate::ids::{MAX_POINTS, VertexId};
use crate::points::survey as bounds;
use frontal::Frontal;
use mesher::{Done, Known, Mesher};
use queue::{Queue, STEEP_ANGLE};
use rules::Rules;

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
    /// The segments that are there only because triangles were given and stay ([`Refinement::triangles`]), and those of boundary layers: they are
    /// no borders. A mesh that is refined again, filled by [`Fill::Parts`], knows them.
    pub kept: Vec<SegmentId>,
}

/// The origin of each vertex, for the next refinement.
fn origins(c: &Constrained2, done: &Done) -> Vec<Origin> {
    let mesh = c.mesh();
    let unknown = Known::free(0.0).origin(mesh);
    let of = |i: usize| mesh.place(VertexId::new(i)).map_or(unknown, |p| done.known[p.index()].origin(mesh));
    (0..c.points().len()).map(of).collect()
}

/// Degrees, up to which refinement ends by itself in practice. At 34 meshes have some 1.2 times as many triangles as at 30; from 35 on
/// there are inputs on which new vertices make new faults without end.
const STEEPEST_THAT_ENDS: f64 = 34.0;

impl Refinement<'_> {
    /// Refines a triangulation. New vertices have the next ids, in the order in which they came; segments are split, and bend by
    /// a unit in the last place where a new vertex is not exactly on them, which is much for what is hardly wider than that.
    ///
    /// Cost: see the module.
    ///
    /// # Errors
    /// [`Error::Parameter`] for bounds that are out of range, or ask for more triangles than there can be, [`Error::Seed`] and
    /// [`Error::Parts`] as [`Constrained2::domains`]; nothing has changed then. [`Error::Size`] if a bound that is asked for a place
    /// is not positive, [`Error::Stopped`]: the triangulation is a valid one then, refined in part. [`Error::KeptTriangle`] and
    /// [`Error::NoSuchVertex`] for triangles that cannot be kept, [`Error::Arc`] for arcs that are none; nothing has changed.
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
        let steeper = Refinement { edge, edge_at, max_vertices, fill, triangles: &[], ..*self };
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
        let (layers, triangles, fill) = (None, &[][..], Fill::Parts(&grown.domains));
        let rest = Refinement { max_vertices, layers, fill, triangles, ..*self };
        let mut refined = rest.run(c)?;
        let report = &mut refined.report;
        report.inside += grown.inside;
        report.on_constraints += grown.on_constraints;
        report.layers = LayerReport2 { triangles: report.layers.triangles, ..grown.report };
        let LayerReport2 { vertices, rows, places, shortened, .. } = report.layers;
        refined.domains.layer_counts = [vertices, rows, places, shortened];
        Ok(refined)
    }

    fn run_to_the_end(&self, c: &mut Constrained2) -> Result<Refined2, Error> {
        let mut domains = c.domains(&self.fill)?;
        self.check_count(c, &domains)?;
        let is_frontal = self.edge.is_some() || self.edge_at.is_some();
        let triangles = if is_frontal { &[] } else { self.triangles };
        let chords = arcs::chords(c, self.arcs, &domains.origins)?;
        let original = (!triangles.is_empty()).then(|| c.clone());
        c.close(&domains)?;
        let known = c.take_kept(&domains.kept);
        let before = c.begin_refinement(&mut domains);
        let kept = match c.keep_triangles(triangles, known, is_frontal) {
            Ok(kept) => kept,
            Err(error) => {
                original.into_iter().for_each(|original| *c = original);
                return Err(error);
            }
        };
        drop(original);
        let rules = Rules::new(self, &domains, &before);
        let layer = c.layer();
        let bounds = bounds(&layer.points).0;
        let queue = Queue::new(&bounds, self.min_angle > STEEP_ANGLE);
        let mut mesher = Mesher::new(layer, &rules, queue, &domains.origins).keeping(kept).along(&chords);
        let mut ran =
            if is_frontal { Frontal::new(&mut mesher, &bounds, self.growth).run() } else { mesher.run() };
        if self.smoothing > 0 && ran.is_ok() {
            (0..self.smoothing).for_each(|_| mesher.smooth());
            ran = mesher.run();
        }
        ran = ran.and_then(|()| mesher.flatten_arcs());
        let done = mesher.finish();
        let added = c.end_refinement(&before, &done.new)?;
        let mut report = survey::report(c.layer(), &rules, added, &done);
        let [vertices, rows, places, shortened] = domains.layer_counts;
        report.layers = LayerReport2 { vertices, rows, places, shortened, ..report.layers };
        let mut domains = c.domains_of_tags(&before, domains);
        c.note_kept(&mut domains, &done.kept)?;
        ran?;
        domains.origins = origins(c, &done);
        let mut kept = [&domains.kept[..], &domains.layered].concat();
        kept.sort_unstable();
        Ok(Refined2 { domains, report, kept })
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
        let mut areas = vec![0.0; domains.regions.len()];
        for t in c.triangle_ids().filter(|&t| domains.is_inside(t)) {
            domains.region(t).into_iter().for_each(|region| areas[region] += c.area(t));
        }
        for (known, area) in domains.regions.iter().zip(areas) {
            let bounds = [
                ("max_area of a region", known.max_area, known.max_area),
                ("max_edge of a region", known.max_edge, known.max_edge.map(equilateral)),
            ];
            for (name, value, largest) in bounds {
                let (Some(value), Some(largest)) = (value, largest) else { continue };
                if value.is_nan() || value <= 0.0 {
                    return Err(Error::Parameter { name, value, range: "positive" });
                }
                if self.max_vertices.is_none() && area > largest * (2 * MAX_POINTS) as f64 {
                    return Err(Error::Parameter { name, value, range });
                }
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
            None if self.min_edge >= 0.0 => Ok(()),
            None => Err(Error::Parameter { name: "min_edge", value: self.min_edge, range: "at least 0" }),
        }
    }
}
