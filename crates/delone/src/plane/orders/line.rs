//! Sites on one line, or all sites at once: what is nearest is a run of them.
//!
//! Between two runs is one line, with a half-plane at either end and no circle.
//!
//! Cost: O(k n).

use super::OrderK2;
use super::canonical::Loose;
use super::circle::Circle;
use super::grow::NO_REGION;
use crate::ids::VertexId;
use crate::mesh::Dimension;
use crate::plane::Delaunay2;

/// The runs of k vertices along the line; for k = n there is one, wherever they are.
pub(super) fn windows(triangulation: &Delaunay2, order: usize) -> OrderK2<'_> {
    let along: Vec<VertexId> = match triangulation.dimension() {
        Dimension::Plane => triangulation.vertices().collect(),
        _ => triangulation.hull_vertices().collect(),
    };
    let sites = along.windows(order).flatten().copied().collect();
    let count = along.len() + 1 - order;
    let mut circles = Vec::with_capacity(2 * count);
    for (j, (&a, &b)) in (0..).zip(along.iter().zip(along.iter().skip(order))) {
        // The half-planes at both ends of the line between run j and the next one.
        let ends = [([a, b], [j, j + 1]), ([b, a], [j + 1, j])];
        circles.extend(ends.map(|([a, b], [r, s])| Circle {
            on: [a, b, VertexId::GHOST],
            regions: [r, s, NO_REGION],
            is_old: false,
        }));
    }
    let (mut starts, mut corners) = (vec![0], Vec::with_capacity(4 * count));
    for j in 0..count as u32 {
        // Around the run: the line to the next one, and back along the line to the one before.
        if (j as usize) + 1 < count {
            corners.extend([3 * (2 * j + 1) + 1, 3 * (2 * j)]);
        }
        if j > 0 {
            corners.extend([3 * (2 * j - 2) + 1, 3 * (2 * j - 1)]);
        }
        starts.push(corners.len() as u32);
    }
    Loose { order, sites, circles, starts, corners }.settle(triangulation)
}
