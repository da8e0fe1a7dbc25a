//! What is outside of a mesh, told by points: files of Triangle know no other way, and with it regions keep their attributes.

use std::path::Path;

use delone::{Constrained2, Domains2, Fill, Location2, RegionSeed2, Seeds2};
use delone_predicates::orient2d;

use super::centroid;
use crate::args::FillName;
use crate::message::{Failure, note};

/// Points that tell what is outside, and the rule itself where they cannot.
pub(super) struct Outside {
    pub(super) seeds: Seeds2,
    rule: Option<Fill<'static>>,
}

impl Outside {
    /// By the seeds of the input.
    pub(super) fn of_seeds(seeds: Seeds2) -> Self {
        Self { seeds, rule: None }
    }

    /// By what a rule says: a point in each part outside.
    ///
    /// Bays of the hull that no constraint closes need none. A hole may be so narrow that no number is in it; then the rule fills
    /// the mesh, which has no regions.
    pub(super) fn of_rule(
        c: &Constrained2,
        inside: &Domains2,
        (name, regions): (FillName, Vec<RegionSeed2>),
        label: &Path,
        quiet: bool,
    ) -> Result<Self, Failure> {
        let refused = |error| Failure::graph(label, &error);
        let points = points(c, inside);
        let is_open = c.domains(&Fill::Seeds(&Seeds2::default())).map_err(refused)?;
        let parts = || inside.parts().iter().enumerate().filter(|(_, part)| !part.is_inside);
        let narrow: Vec<usize> = parts()
            .map(|(i, _)| i)
            .filter(|&i| points[i].is_none() && is_open.parts()[i].is_inside)
            .collect();
        let holes = parts().filter_map(|(i, _)| points[i]).collect();
        // Where everything is inside, so are bays.
        let keep_concavities = name == FillName::All;
        let has_regions = !regions.is_empty();
        let seeds = Seeds2 { holes, regions, keep_concavities };
        if narrow.is_empty() {
            return Ok(Self::of_seeds(seeds));
        }
        let rule = if name == FillName::Nonzero { Fill::NonZero } else { Fill::EvenOdd };
        let by_rule = c.domains(&rule).map_err(refused)?;
        let is_same = by_rule.parts().iter().zip(inside.parts()).all(|(a, b)| a.is_inside == b.is_inside);
        if has_regions || !is_same {
            let (holes, triangles) = (narrow.len(), inside.parts()[narrow[0]].triangles);
            return Err(Failure::new(
                format!(
                    "{}: {holes} of the parts outside, one of {triangles} triangles, are so narrow that no point is in them",
                    label.display()
                ),
                "leave regions and lines that are no borders out, or join the points there that are so near each other",
            ));
        }
        let text = "holes so narrow that no point is in them, which .poly files do not tell of";
        note(quiet, format_args!("{text}: {}", narrow.len()));
        Ok(Self { seeds, rule: Some(rule) })
    }

    /// What says what is inside.
    pub(super) fn fill(&self) -> Fill<'_> {
        self.rule.unwrap_or(Fill::Seeds(&self.seeds))
    }
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
