//! A proof of the result that shares nothing with the refinement: structure and orientations exactly, angles and sizes measured
//! again with a bound of the error.
//!
//! O(n).

use std::collections::BTreeSet;

use delone::{Constrained2, Refined2, Seeds2, TriangleId};
use delone_predicates::{hypotenuse, orient2d};

use super::plan::Plan;

/// Radians by which an angle may be off that is measured here: coordinates are subtracted with an error of one half of the last
/// place, so products and their sums have one below four of it, relative to the product of the two lengths.
const ANGLE_ERROR: f64 = 8.0 * f64::EPSILON;

/// The first flaw of a mesh, if any.
pub(super) fn flaw(c: &Constrained2, refined: &Refined2, seeds: &Seeds2, plan: &Plan) -> Option<String> {
    if let Err(flaw) = c.check() {
        return Some(flaw.to_string());
    }
    let left: BTreeSet<TriangleId> = refined.report.left.iter().map(|left| left.triangle).collect();
    let bound = plan.min_angle.to_radians() - ANGLE_ERROR;
    let mut inside = 0;
    for t in c.triangle_ids().filter(|&t| refined.domains.is_inside(t)) {
        inside += 1;
        let corners = c.mesh().corners(t);
        let [p, q, r] = corners.map(|v| c.point(v));
        let name =
            || format!("triangle {}, {}, {}", corners[0].index(), corners[1].index(), corners[2].index());
        if !orient2d(p, q, r).is_positive() {
            return Some(format!("{} is not counter-clockwise", name()));
        }
        if left.contains(&t) || refined.domains.is_layer(t) {
            continue;
        }
        let smallest = [[p, q, r], [q, r, p], [r, p, q]].map(angle).into_iter().fold(f64::INFINITY, f64::min);
        if smallest < bound {
            return Some(format!("{} has an angle of {} degrees", name(), smallest.to_degrees()));
        }
        let longest = [[p, q], [q, r], [r, p]].map(length).into_iter().fold(0.0, f64::max);
        let seed = refined.domains.region(t).and_then(|region| seeds.regions.get(region));
        let own = seed.and_then(|seed| seed.max_area);
        // What a product is off by is small beside the sides, not beside the area.
        let is_larger = |most: &f64| c.area(t) > most + ANGLE_ERROR * longest * longest;
        if let Some(most) = plan.max_area.into_iter().chain(own).find(is_larger) {
            return Some(format!("{} is larger than {most}", name()));
        }
        if let Some(most) = plan.max_edge.filter(|most| longest > most * (1.0 + ANGLE_ERROR)) {
            return Some(format!("{} has an edge longer than {most}", name()));
        }
    }
    (inside != refined.report.triangles)
        .then(|| format!("{inside} triangles are inside, and {} were counted", refined.report.triangles))
}

/// The angle at the first corner; right where lengths are so large or small that products of them are no numbers.
fn angle([p, q, r]: [[f64; 2]; 3]) -> f64 {
    let (u, v) = ([q[0] - p[0], q[1] - p[1]], [r[0] - p[0], r[1] - p[1]]);
    let (cross, dot) = (u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]);
    let is_normal = cross.is_finite() && dot.is_finite() && cross.abs().max(dot.abs()) > 1e-290;
    if is_normal { libm::atan2(cross, dot) } else { std::f64::consts::FRAC_PI_2 }
}

fn length([p, q]: [[f64; 2]; 2]) -> f64 {
    hypotenuse(q[0] - p[0], q[1] - p[1])
}
