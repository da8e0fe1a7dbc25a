//! A triangulation that keeps its vertices in the order of memory, for those who name them in their own way.
//!
//! Cost: that of [`super::triangulate`], and O(n) more where points are equal.

use super::triangulate;
use crate::error::Error;
use crate::ids::{Duplicate, MAX_TETRAHEDRA, Place};
use crate::mesh::{Dimension, Mesh3, Names};
use crate::space::layer::Layer;

/// The points that differ, along the curve, and the tetrahedra between them.
#[derive(Clone, Debug)]
pub(crate) struct InOrder3 {
    /// By places alone: without names, and without stars. Empty if the points span less than space.
    pub(crate) mesh: Mesh3,
    pub(crate) points: Vec<[f64; 3]>,
    /// For each place the index of its point, of equal ones the first.
    pub(crate) indices: Vec<u32>,
    /// By increasing index.
    pub(crate) duplicates: Vec<Duplicate>,
}

/// Triangulates finite points, at most [`crate::MAX_POINTS_IN_SPACE`] of them.
pub(crate) fn in_order(points: &[[f64; 3]]) -> Result<InOrder3, Error> {
    let built = triangulate(points, 0, &mut ()).ok_or(Error::TooManyTetrahedra { most: MAX_TETRAHEDRA })?;
    Ok(InOrder3::of(built))
}

impl InOrder3 {
    /// The result without the places of duplicates and of invented points.
    fn of((layer, duplicates): (Layer, Vec<Duplicate>)) -> Self {
        let spans = layer.dimension() == Dimension::Space;
        let Layer { mut mesh, mut points, .. } = layer;
        if !spans {
            mesh.cells = Vec::new();
        }
        let mut indices = Vec::with_capacity(mesh.vertex_count);
        let mut moved = vec![Place::GHOST; points.len()];
        for place in (0..points.len()).map(Place::new) {
            let name = mesh.names.of(place);
            if !name.is_ghost() {
                moved[place.index()] = Place::new(indices.len());
                points[indices.len()] = points[place.index()];
                indices.push(name.bits());
            }
        }
        points.truncate(indices.len());
        (mesh.names, mesh.incident, mesh.marks) = (Names::default(), Vec::new(), Vec::new());
        if indices.len() < moved.len() {
            mesh.records().renumber(|p| moved[p.index()], |t| t);
        }
        Self { mesh, points, indices, duplicates }
    }
}
