//! Triangulations with segments, holes and regions, and meshes.

use delone::{
    Constrained2, Crossings, EdgeId, Fill, Location2, Reason, Refined2, Refinement, RegionSeed2, Seeds2,
};
use delone::{TriangleId, VertexId};
use delone_predicates::lexicographic;

use crate::again::{Again, VERTICES_FOR_AREAS};
use crate::built::{Built, Segment, Triangulated};
use crate::fault::{Fault, Status};
use crate::input::Input;
use crate::switches::Switches;
use crate::values;

/// Memory of refinement for a triangle, in bytes.
const BYTES_PER_TRIANGLE: usize = 100;

/// Whether a triangle is to be refined, as the caller says.
pub(crate) type Ask<'a> = &'a dyn Fn([[f64; 2]; 3], f64) -> bool;

/// Triangulates, with the switches p, r and those of quality.
pub(crate) fn build(input: &mut Input, s: &Switches, test: Option<Ask>) -> Result<Built, Fault> {
    let again = match input.given.take() {
        Some(given) => Some(Again::new(input, given, s)?),
        None => None,
    };
    let mut c = match &again {
        Some(again) => again.graph(&input.points)?,
        None => Constrained2::with_crossings(&input.points, &input.segments, Crossings::Split)?,
    };
    let (seeds, attributes) = seeds(&c, input, s)?;
    let fill = match (&again, s.poly) {
        (Some(_), _) => Fill::EvenOdd,
        (None, true) => Fill::Seeds(&seeds),
        (None, false) => Fill::All,
    };
    check_room(&c, &fill, s)?;
    let before = (input.attribute_count > 0 && again.is_none()).then(|| c.clone());
    let area_at = |at: [f64; 2]| again.as_ref().map_or(f64::INFINITY, |again| again.area_at(at));
    let has_areas = again.as_ref().is_some_and(Again::has_areas);
    let kept: &[[VertexId; 3]] = again.as_ref().map_or(&[], |again| &again.triangles);
    let mut how = Refinement::new()
        .min_angle(s.min_angle)
        .conforming(s.conforming)
        .fill(fill)
        .keep(s.keep)
        .triangles(kept);
    if let Some(area) = s.max_area {
        how = how.max_area(area);
    }
    if has_areas {
        how = how.max_area_at(&area_at).max_vertices(VERTICES_FOR_AREAS);
    }
    if let Some(test) = test {
        how = how.refine_if(test);
    }
    if let Some(most) = s.max_vertices {
        how = how.max_vertices(most);
    }
    let made = how.run(&mut c)?;
    let is_asked = has_areas || test.is_some();
    if is_asked && s.max_vertices.is_none() && made.report.left_for(Reason::Budget) > 0 {
        let count = made.report.inside + made.report.on_constraints;
        let words = format!(
            "{count} new vertices were not enough; switch S sets another bound, and takes what is made"
        );
        return Err(Fault::new(Status::TooMany, words));
    }
    let origin = |row: usize| again.as_ref().map_or(Some(row), |again| again.origin(row));
    let given = again.as_ref().map_or(input.segments.len(), Again::segment_count);
    let (segments, outside) = pieces(&c, &made, given, origin);
    let region_values = |t: TriangleId| made.domains.region(t).map_or(0.0, |region| attributes[region]);
    let old = again.as_ref().map(|again| &again.before).or(before.as_ref());
    let point_values = values::of_points(input, old, c.points())?;
    let mut built = Built::new(Triangulated::Graph(Box::new(c)), |t| made.domains.is_inside(t));
    (built.segments, built.outside, built.values) = (segments, outside, point_values);
    match &again {
        Some(again) => {
            built.triangle_value_count = again.attribute_count;
            built.triangle_values = again.values(&built)?;
        }
        None if s.attributes && !input.regions.is_empty() => {
            built.triangle_value_count = 1;
            built.triangle_values = built.triangles.iter().map(|&t| region_values(t)).collect();
        }
        None => {}
    }
    Ok(built)
}

/// Seeds as the library has them, and the attributes of regions. Seeds outside of the hull do not count; of two regions in one part
/// the last one does.
fn seeds(c: &Constrained2, input: &Input, s: &Switches) -> Result<(Seeds2, Vec<f64>), Fault> {
    let mut holes = Vec::new();
    for (index, &at) in input.holes.iter().enumerate() {
        holes.extend(settled(c, at, "hole", index)?);
    }
    let (mut regions, mut attributes) = (Vec::new(), Vec::new());
    for (index, region) in input.regions.iter().enumerate().rev() {
        if let Some(at) = settled(c, region.at, "region", index)? {
            attributes.push(region.attribute);
            let max_area = Some(region.max_area).filter(|&area| s.areas && area > 0.0);
            regions.push(RegionSeed2::new(at).attribute(region.attribute).max_area(max_area));
        }
    }
    Ok((Seeds2::default().holes(holes).regions(regions).keep_concavities(s.convex), attributes))
}

/// A place in the part that a seed is in; none outside of the hull. A seed on a segment takes the part of the triangle beside it that has the
/// lexicographically least centroid.
fn settled(c: &Constrained2, at: [f64; 2], what: &str, index: usize) -> Result<Option<[f64; 2]>, Fault> {
    let mesh = c.mesh();
    let beside: Vec<TriangleId> = match c.locate(at)? {
        Location2::Outside(_) | Location2::LowerDimensional(_) => return Ok(None),
        Location2::Edge(e) if c.is_constraint(e) => vec![e.triangle(), mesh.twin(e).triangle()],
        Location2::Vertex(v) if mesh.star(v).any(|e| c.is_constraint(e)) => {
            mesh.star(v).map(|e| e.triangle()).collect()
        }
        _ => return Ok(Some(at)),
    };
    let mut centroids = Vec::new();
    for t in beside.into_iter().filter(|&t| !mesh.is_ghost(t)) {
        let [p, q, r] = mesh.corners(t).map(|v| c.point(v));
        let centroid = [0, 1].map(|k| p[k] / 3.0 + q[k] / 3.0 + r[k] / 3.0);
        // Of a triangle that is too thin it may be rounded to somewhere else.
        if c.locate(centroid)? == Location2::Triangle(t) {
            centroids.push(centroid);
        }
    }
    let least = centroids.into_iter().min_by(|&p, &q| lexicographic(p, q));
    let words = || {
        format!("{what} {index} at ({}, {}) is on a segment, in triangles too thin for a seed", at[0], at[1])
    };
    Ok(Some(least.ok_or_else(|| Fault::at(Status::Argument, index, words()))?))
}

/// Refuses a largest area for which there is no memory.
fn check_room(c: &Constrained2, fill: &Fill, s: &Switches) -> Result<(), Fault> {
    let Some(largest) = s.max_area.filter(|_| s.max_vertices.is_none()) else { return Ok(()) };
    let domains = c.domains(fill)?;
    let area: f64 = c.triangle_ids().filter(|&t| domains.is_inside(t)).map(|t| c.area(t)).sum();
    let bytes = (area / largest).min(usize::MAX as f64) as usize;
    let bytes = bytes.saturating_mul(BYTES_PER_TRIANGLE);
    if !delone_pool::has_room(bytes) {
        return Err(Fault::memory(bytes, "as many triangles as switch a asks for"));
    }
    Ok(())
}

/// The edges that are segments, beside the mesh and elsewhere. Of the rows of segments the first `given` are those of the input.
fn pieces(
    c: &Constrained2,
    made: &Refined2,
    given: usize,
    origin: impl Fn(usize) -> Option<usize>,
) -> (Vec<Segment>, Vec<Segment>) {
    let piece = |edge: EdgeId| {
        let first = c.covering(edge).into_iter().map(|on| (on.segment.index(), on.is_forward)).min();
        let first = first.filter(|&(segment, _)| segment < given);
        let mut ends = [c.mesh().origin(edge), c.mesh().destination(edge)];
        if first.is_some_and(|(_, is_forward)| !is_forward) {
            ends.reverse();
        }
        Segment { ends, edge, origin: first.and_then(|(segment, _)| origin(segment)) }
    };
    let is_inside = |e: EdgeId| made.domains.is_inside(e.triangle());
    let edges = c.constraint_edges().filter(|&e| !made.only_keeps(c, e));
    edges.map(piece).partition(|segment| is_inside(segment.edge) || is_inside(c.mesh().twin(segment.edge)))
}
