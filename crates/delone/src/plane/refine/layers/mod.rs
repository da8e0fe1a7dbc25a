//! Boundary layers: rows of thin triangles along chosen sides of a mesh, before the rest of it is made.
//!
//! `border` gives the chosen constraints the vertices that a mesh without layers would have there. `chains` tells which side follows which,
//! and `ribs` the directions at their vertices. `room` finds how many rows there is room for. `build` makes them, and proves that all are
//! there. Then the triangles of the layers are parts of their own, which refinement leaves alone, with constraints around them that it does
//! not split.
//!
//! *Exactness.* Ribs are rounded, and decide nothing. All cells are convex, and apart from each other and from what else there is, by exact
//! tests; and in the end each is found in the triangulation.
//!
//! Sources: the parameters are those of most programs for flows, such as gmsh's field `BoundaryLayer`; corners that lean over their neighbors,
//! outlines that keep apart, and rows that end one by one are ours.
//!
//! Cost: O(n log n) for n vertices of the layers, and a copy of the triangulation.

mod border;
mod build;
mod chains;
mod polygon;
mod ribs;
mod room;
mod wanted;

pub use wanted::Layers2;

use super::arcs::chords;
use super::mesher::Mesher;
use super::queue::Queue;
use super::report::LayerReport2;
use super::rules::Rules;
use super::{Refinement, origins};
use crate::error::Error;
use crate::ids::VertexId;
use crate::plane::constrained::{Constrained2, Domains2};
use crate::points::survey as bounds;
use chains::Chains;
use room::Plan;

/// Layers that are made.
pub(super) struct Grown {
    /// The parts, layers among them.
    pub(super) domains: Domains2,
    /// New vertices on no constraint of before, and on these.
    pub(super) inside: usize,
    pub(super) on_constraints: usize,
    pub(super) report: LayerReport2,
}

/// Makes layers.
pub(super) fn grow(wanted: &Refinement, layers: &Layers2, c: &mut Constrained2) -> Result<Grown, Error> {
    let mut domains = c.domains(&wanted.fill)?;
    wanted.check_count(c, &domains)?;
    let chords = chords(c, wanted.arcs, &domains.origins)?;
    let heights = layers.heights();
    let mut sides = border::chosen(c, &domains, layers)?;
    c.close(&domains)?;
    if layers.segments.is_none() {
        // Sides of the hull that are constraints only now.
        sides = border::chosen(c, &domains, layers)?;
    }
    let height = heights.last().copied().unwrap_or(0.0);
    border::divide_sides(wanted, c, (&domains, &chords), &mut sides, height)?;
    let known = c.take_kept(&domains.kept);
    domains.kept.clear();
    let before = c.begin_refinement(&mut domains);
    // No triangles are kept beside layers.
    c.keep_triangles(&[], known, true)?;
    let rules = Rules::new(wanted, &domains, &before);
    let layer = c.layer();
    let bounds = bounds(&layer.points).0;
    let queue = Queue::new(&bounds, false);
    let mut mesher = Mesher::new(layer, &rules, queue, &domains.origins).along(&chords);
    let pieces: Vec<_> = sides.iter().flat_map(|side| border::put_on(&mut mesher, side)).collect();
    let chains = Chains::of(&mesher, &pieces);
    let mut plan = Plan::new(chains, heights);
    let fitted = plan.fit(&mesher, rules.most().saturating_sub(mesher.count));
    let followed = build::follow(&mut plan, &mut mesher);
    let done = mesher.finish();
    let added = c.end_refinement(&before, &done.new)?;
    domains = c.domains_of_tags(&before, domains);
    domains.origins = origins(c, &done);
    fitted?;
    rules.go_on(done.new.len())?;
    let bases: Vec<Vec<VertexId>> = plan
        .chains
        .wedges
        .iter()
        .zip(&followed)
        .map(|(wedge, followed)| {
            let places = std::iter::once(&wedge.base).chain(followed);
            places.map(|p| c.mesh().name(*p)).collect()
        })
        .collect();
    let beside = c.parts_beside(&domains);
    let built = loop {
        let mut copy = c.clone();
        match build::build(&plan, &bases, &mut copy)? {
            Ok(built) => {
                *c = copy;
                break built;
            }
            Err(failed) => plan.take_from(&failed),
        }
    };
    c.spread_parts(&beside, &built.triangles, &mut domains);
    c.note_scales(&built.vertices, &mut domains);
    domains.layered.extend(&built.segments);
    let asked = plan.heights.len() - 1;
    let followed: usize = plan.rows.iter().zip(&followed).map(|(rows, along)| along.len().min(*rows)).sum();
    let report = LayerReport2 {
        triangles: built.triangles.len(),
        vertices: built.vertices.len() + followed,
        rows: plan.rows.iter().copied().max().unwrap_or(0),
        places: plan.rows.len(),
        shortened: plan.rows.iter().filter(|rows| **rows < asked).count(),
    };
    Ok(Grown { domains, inside: added[0] + built.vertices.len(), on_constraints: added[1], report })
}

/// The distance of two points.
fn length(p: [f64; 2], q: [f64; 2]) -> f64 {
    super::shape::squared(p, q).sqrt()
}

/// The direction from one point to another one.
fn unit(p: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    let length = length(p, q);
    [0, 1].map(|k| (q[k] - p[k]) / length)
}
