//! Measures of all triangles after a refinement.
//!
//! Cost: O(1) a triangle.

use std::collections::{BTreeMap, BTreeSet};

use delone_predicates::angle;

use super::mesher::Done;
use super::report::{BIN, Reason, RefinementReport2, Unrefined2};
use super::rules::Rules;
use super::shape::Shape;
use crate::ids::{EdgeId, Place, TriangleId};
use crate::plane::constrained::sorted;
use crate::plane::layer::Layer;

/// Measures what is inside.
pub(super) fn report(
    layer: &Layer,
    rules: &Rules,
    [inside, on_constraints]: [usize; 2],
    done: &Done,
) -> RefinementReport2 {
    let Done { left, refused, kept, .. } = done;
    let mut report = RefinementReport2 { inside, on_constraints, ..RefinementReport2::default() };
    let why: BTreeMap<[Place; 3], Reason> = left.iter().copied().collect();
    // Cotangents fall as angles grow: so these are bounds, and the smallest angle has the largest.
    let bounds: Vec<f64> = (1..180 / BIN).map(|k| 1.0 / libm::tan(((BIN * k) as f64).to_radians())).collect();
    let bin = |cotangent: f64| bounds.partition_point(|&bound| cotangent <= bound);
    let (mut largest, mut smallest) = (f64::NEG_INFINITY, f64::INFINITY);
    for t in layer.mesh.triangles() {
        let domain = layer.mesh.domain(t);
        report.layers.triangles += usize::from(rules.is_layer(domain));
        if !rules.is_inside(domain) {
            continue;
        }
        report.triangles += 1;
        let Some(shape) = Shape::of(layer, t) else {
            report.left.push(Unrefined2 { triangle: t, reason: Reason::Precision });
            continue;
        };
        let cotangents = shape.cotangents();
        for cotangent in cotangents {
            report.angles[bin(cotangent)] += 1;
            largest = largest.max(cotangent);
            smallest = smallest.min(cotangent);
        }
        let sharpest = cotangents.into_iter().fold(f64::NEG_INFINITY, f64::max);
        report.smallest_angles[bin(sharpest).min(60 / BIN - 1)] += 1;
        let is_sharp = shape.is_sharp(rules.squared_cosine);
        if is_sharp || rules.is_large(&shape, domain) {
            let e = shape.shortest;
            let corners = [layer.mesh.tail(e), layer.mesh.head(e), layer.mesh.tip(e)];
            let reason = why.get(&corners).copied().unwrap_or(Reason::InputAngle);
            report.left.push(Unrefined2 { triangle: t, reason });
        } else if let Some(ends) = encroached(layer, t, kept).filter(|_| rules.conforming) {
            let [v, w] = ends;
            let reason = refused.get(&[v, w]).or_else(|| refused.get(&[w, v]));
            report.left.push(Unrefined2 { triangle: t, reason: reason.copied().unwrap_or(Reason::Kept) });
        }
    }
    report.triangles += report.layers.triangles;
    if largest > f64::NEG_INFINITY {
        let degrees = |cotangent: f64| libm::atan2(1.0, cotangent).to_degrees();
        (report.smallest_angle, report.largest_angle) = (degrees(largest), degrees(smallest));
    }
    report
}

/// The ends of a constraint of a triangle whose diametral circle the third corner is in.
fn encroached(layer: &Layer, t: TriangleId, kept: &BTreeSet<[Place; 2]>) -> Option<[Place; 2]> {
    let mesh = &layer.mesh;
    let is_near = |e: &EdgeId| {
        let [o, a, b] = [mesh.tip(*e), mesh.tail(*e), mesh.head(*e)].map(|v| layer.points[v.index()]);
        let is_constraint = mesh.is_fixed(*e) && !kept.contains(&sorted([mesh.tail(*e), mesh.head(*e)]));
        is_constraint && angle(o, a, b).is_negative()
    };
    let near = [0, 1, 2].map(|k| t.edge(k)).into_iter().find(is_near);
    near.map(|e| [mesh.tail(e), mesh.head(e)])
}
