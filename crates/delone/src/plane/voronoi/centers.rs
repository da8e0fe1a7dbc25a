//! The centers of the circles of all triangles, each computed once, and which of them are surely inside of a box.
//!
//! A cell whose corners all are is whole, because a box has no dents: what is asked of each center once need not be asked of each cell
//! that has it. Elsewhere a cell is asked about by the box around it (`cells.rs`).
//!
//! Cost: O(n).

use super::clip::{Cellular, PREFETCH_DISTANCE};
use crate::ids::Place;
use crate::mesh::triangles::HalfEdge;
use crate::plane::layer::Layer;
use crate::plane::layer::kernel::Site;
use crate::prefetch::{self, prefetch};

/// By the index of the triangle.
pub(in crate::plane) struct Centers {
    /// Infinite where there is none.
    pub(in crate::plane) points: Vec<[f64; 2]>,
    /// Whether the exact center is surely inside of the box; nothing if there is no box.
    pub(in crate::plane) inside: Vec<bool>,
}

impl Centers {
    /// Of all triangles of a layer.
    pub(in crate::plane) fn of<K: Cellular>(layer: &Layer<K>, within: Option<[[f64; 2]; 2]>) -> Self {
        let slots = layer.mesh.edges.len() / 4;
        let mut points = Vec::with_capacity(slots);
        let mut inside = Vec::with_capacity(if within.is_some() { slots } else { 0 });
        let triangles = layer.mesh.edges.chunks_exact(4);
        let ahead =
            layer.mesh.edges.chunks_exact(4).skip(PREFETCH_DISTANCE).map(Some).chain(std::iter::repeat(None));
        for (corners, ahead) in triangles.zip(ahead) {
            // Corners lie wherever they lay in the input.
            for corner in ahead.filter(|_| prefetch::HELPS).into_iter().flatten() {
                prefetch(&layer.points, corner.origin.index());
            }
            let sites = sites(layer, corners);
            let center = sites.and_then(|[a, b, c]| K::center(a, b, c));
            points.push(center.unwrap_or([f64::INFINITY; 2]));
            if let Some(within) = within {
                inside.push(center.is_some_and(|center| is_inside(center, within)));
            }
        }
        Self { points, inside }
    }
}

/// The corners of a triangle, if it is none of the ghosts and no free slot.
#[inline]
fn sites<K: Cellular>(layer: &Layer<K>, corners: &[HalfEdge]) -> Option<[Site<K>; 3]> {
    let site = |p: Place| (p.index() < layer.points.len()).then(|| layer.site(p));
    let [a, b, c] = [0, 1, 2].map(|k| site(corners[k].origin));
    a.zip(b).zip(c).map(|((a, b), c)| [a, b, c])
}

/// Whether the exact center is inside of a box, from the rounded one. Rounding keeps order: what is not beyond a number is not rounded
/// beyond it, so what is rounded beyond it is.
#[inline]
fn is_inside([x, y]: [f64; 2], [low, high]: [[f64; 2]; 2]) -> bool {
    low[0] < x && x < high[0] && low[1] < y && y < high[1]
}
