//! Seeds: points that tell the outside of a mesh, because files of Triangle know no other way.

use delone::{Constrained2, Domains2, Fill, Location2, Seeds2};
use delone_predicates::orient2d;

use super::centroid;
use crate::message::note;

/// A point in each hole that has one.
///
/// Bays of the hull that no constraint closes need none. A hole may be so narrow that no number is in it.
pub(super) fn holes(c: &Constrained2, inside: &Domains2, quiet: bool) -> Vec<[f64; 2]> {
    let open = c.domains(&Fill::Seeds(&Seeds2::default())).expect("there are no seeds");
    let points = points(c, inside);
    let outside = || (0..points.len()).filter(|&part| !inside.parts()[part].is_inside);
    let narrow = outside().filter(|&part| points[part].is_none() && open.parts()[part].is_inside).count();
    if narrow > 0 {
        note(
            quiet,
            format_args!(
                "holes so narrow that no point is in them, which .poly files do not tell of: {narrow}"
            ),
        );
    }
    outside().filter_map(|part| points[part]).collect()
}

/// A point in each part outside, where there is one that is found: the middle of the largest triangle that has it strictly inside, or
/// else another middle, or a vertex, that is surely in the part.
fn points(c: &Constrained2, inside: &Domains2) -> Vec<Option<[f64; 2]>> {
    let mut best: Vec<Option<(f64, [f64; 2])>> = vec![None; inside.parts().len()];
    let outside = || c.triangle_ids().filter(|&t| !inside.is_inside(t));
    for t in outside() {
        let corners = c.mesh().corners(t).map(|v| c.point(v));
        let [p, q, r] = corners;
        let middle = centroid(corners);
        let is_in = [[p, q], [q, r], [r, p]].iter().all(|&[a, b]| orient2d(a, b, middle).is_positive());
        let Some(part) = inside.part(t).filter(|_| is_in) else { continue };
        let area = c.area(t);
        if best[part].is_none_or(|(known, _)| area > known) {
            best[part] = Some((area, middle));
        }
    }
    let mut points: Vec<Option<[f64; 2]>> = best.into_iter().map(|best| best.map(|(_, p)| p)).collect();
    for t in outside() {
        let Some(part) = inside.part(t).filter(|&part| points[part].is_none()) else { continue };
        let corners @ [p, q, r] = c.mesh().corners(t).map(|v| c.point(v));
        let middle = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| f64::midpoint(a[k], b[k]));
        let candidates = [centroid(corners), middle(p, q), middle(q, r), middle(r, p), p, q, r];
        points[part] = candidates.into_iter().find(|&at| part_of(c, inside, at) == Some(part));
    }
    points
}

/// The part that a point is in and on no border of.
fn part_of(c: &Constrained2, inside: &Domains2, at: [f64; 2]) -> Option<usize> {
    let mesh = c.mesh();
    match c.locate(at).ok()? {
        Location2::Triangle(t) => inside.part(t),
        Location2::Edge(e) if !c.is_constraint(e) => {
            [e, mesh.twin(e)].into_iter().find_map(|e| inside.part(e.triangle()))
        }
        Location2::Vertex(v) if !mesh.star(v).any(|e| c.is_constraint(e)) => {
            mesh.star(v).find_map(|e| inside.part(e.triangle()))
        }
        _ => None,
    }
}
