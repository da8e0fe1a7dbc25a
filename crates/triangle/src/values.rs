//! Attributes of new points: linear on the triangles and segments of the input, as they were before refinement.

use delone::{Constrained2, Location2, TriangleId};

use crate::fault::Fault;
use crate::input::Input;

/// The weights of corners at a place in the plane of a triangle; where it has no area, a third each.
pub(crate) fn weights(corners: [[f64; 2]; 3], at: [f64; 2]) -> [f64; 3] {
    let from = corners.map(|p| [p[0] - at[0], p[1] - at[1]]);
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let weights = [cross(from[1], from[2]), cross(from[2], from[0]), cross(from[0], from[1])];
    let sum: f64 = weights.iter().sum();
    if sum == 0.0 || !sum.is_finite() { [1.0 / 3.0; 3] } else { weights.map(|x| x / sum) }
}

/// The weights at a place inside, none of them negative.
fn weights_inside(corners: [[f64; 2]; 3], at: [f64; 2]) -> [f64; 3] {
    let positive = weights(corners, at).map(|x| x.max(0.0));
    let sum: f64 = positive.iter().sum();
    positive.map(|x| x / sum)
}

/// Attributes of all points: those of the input, then of new ones on the triangulation as it was.
pub(crate) fn of_points(
    input: &mut Input,
    before: Option<&Constrained2>,
    points: &[[f64; 2]],
) -> Result<Vec<f64>, Fault> {
    let (count, given) = (input.attribute_count, input.points.len());
    let mut values = std::mem::take(&mut input.attributes);
    let Some(before) = before.filter(|_| count > 0 && points.len() > given) else { return Ok(values) };
    let known = on_crossings(before, &values, count, given);
    values.try_reserve_exact((points.len() - given).saturating_mul(count))?;
    for &p in &points[given..] {
        match before.locate(p)? {
            Location2::Vertex(v) => values.extend_from_slice(&known[v.index() * count..][..count]),
            Location2::Triangle(t) => extend(&mut values, before, t, p, &known, count),
            // A border that bent by a rounding may be outside.
            Location2::Edge(e) | Location2::Outside(e) => {
                let sides = [e.triangle(), before.mesh().twin(e).triangle()];
                let finite = sides.into_iter().find(|&t| !before.mesh().is_ghost(t)).unwrap_or(sides[0]);
                extend(&mut values, before, finite, p, &known, count);
            }
            Location2::LowerDimensional(_) => values.extend(std::iter::repeat_n(0.0, count)),
        }
    }
    Ok(values)
}

/// Adds the values at a place in a triangle.
fn extend(values: &mut Vec<f64>, c: &Constrained2, t: TriangleId, at: [f64; 2], known: &[f64], count: usize) {
    let corners = c.mesh().corners(t);
    let weights = weights_inside(corners.map(|v| c.point(v)), at);
    let value = |k: usize| (0..3).map(|j| weights[j] * known[corners[j].index() * count + k]).sum::<f64>();
    values.extend((0..count).map(value));
}

/// Values of the points before refinement, those where segments cross included: linear on the first segment.
fn on_crossings(c: &Constrained2, values: &[f64], count: usize, given: usize) -> Vec<f64> {
    let mut known = values.to_vec();
    known.resize(c.points().len() * count, 0.0);
    let mut is_known: Vec<bool> = (0..c.points().len()).map(|i| i < given).collect();
    if c.points().len() == given {
        return known;
    }
    for (segment, [a, b]) in c.segments() {
        for v in c.chain(segment).unwrap_or_default() {
            if std::mem::replace(&mut is_known[v.index()], true) {
                continue;
            }
            let [p, q, r] = [a, b, v].map(|v| c.points()[v.index()]);
            let along = [q[0] - p[0], q[1] - p[1]];
            let square = along[0] * along[0] + along[1] * along[1];
            let part = ((r[0] - p[0]) * along[0] + (r[1] - p[1]) * along[1]) / square;
            for k in 0..count {
                let [from, to] = [a, b].map(|v| values.get(v.index() * count + k).copied().unwrap_or(0.0));
                known[v.index() * count + k] = from * (1.0 - part) + to * part;
            }
        }
    }
    known
}
