//! Sizes that differ from place to place: longest edges from points with values, largest areas from the triangles of a mesh.

use std::path::Path;

use delone::{Constrained2, Delaunay2, Location2, TriangleId, VertexId};
use delone_io::ReadOptions;
use delone_terrain::values::{along, clamped, least};

use crate::files;
use crate::message::Failure;

/// Values at points, linear between them and those of the nearest around.
pub(super) struct Sizes {
    triangulation: Delaunay2,
    values: Vec<f64>,
}

impl Sizes {
    /// Reads points with positive values.
    pub(super) fn read(path: &Path, columns: &[String], quiet: bool) -> Result<Self, Failure> {
        let options = ReadOptions::default().columns(columns.to_vec()).dimension(3);
        let cloud = files::cloud(path, &options, quiet)?;
        let Some(values) = cloud.z.filter(|_| !cloud.xy.is_empty()) else {
            return Err(Failure::new(
                format!("{}: there are no points with values", path.display()),
                "give points with a third number: the longest edge that is wanted there",
            ));
        };
        if let Some((i, value)) =
            values.iter().enumerate().find(|(_, value)| value.is_nan() || **value <= 0.0)
        {
            return Err(Failure::new(
                format!("{}: the size at point {i} is {value}", path.display()),
                "sizes are positive: the longest edge that is wanted there",
            ));
        }
        let triangulation =
            Delaunay2::from_points(&cloud.xy).map_err(|error| Failure::points(path, &error))?;
        Ok(Self { triangulation, values })
    }

    /// The size wanted at a place.
    pub(super) fn at(&self, p: [f64; 2]) -> f64 {
        let d = &self.triangulation;
        let value = |v: VertexId| self.values[v.index()];
        let nearest = || d.nearest(p).ok().flatten().map_or(f64::INFINITY, value);
        match d.locate(p) {
            Ok(Location2::Triangle(t)) => {
                let corners = d.mesh().corners(t);
                between(p, corners.map(|v| d.point(v)), corners.map(value))
            }
            Ok(Location2::Edge(e)) => {
                let mesh = d.mesh();
                let ends = [mesh.origin(e), mesh.destination(e)];
                along(p, ends.map(|v| d.point(v)), ends.map(value))
            }
            Ok(Location2::Vertex(v)) => value(v),
            _ => nearest(),
        }
    }
}

/// The linear function with these values at the corners of a triangle, at a point inside; never beyond them. The same bits whichever corner
/// is first.
pub(super) fn between(p: [f64; 2], corners: [[f64; 2]; 3], values: [f64; 3]) -> f64 {
    let first = least(&corners);
    let [(a, of_a), (b, of_b), (c, of_c)] =
        [0, 1, 2].map(|k| (first + k) % 3).map(|k| (corners[k], values[k]));
    let values = [of_a, of_b, of_c];
    let cross =
        |o: [f64; 2], u: [f64; 2], v: [f64; 2]| (u[0] - o[0]) * (v[1] - o[1]) - (u[1] - o[1]) * (v[0] - o[0]);
    let parts = [cross(p, b, c), cross(p, c, a), cross(p, a, b)].map(|part| part.max(0.0));
    let whole: f64 = parts.iter().sum();
    let mean = parts.iter().zip(values).map(|(part, value)| part / whole * value).sum::<f64>();
    clamped(mean, &values)
}

/// The triangles of a mesh that is refined again, to find which of them a place is in.
pub(super) struct Elements {
    triangulation: Constrained2,
    /// For each triangle its row in the file.
    rows: Vec<Option<u32>>,
    /// The corners of each row; of equal points the first.
    corners: Vec<[VertexId; 3]>,
}

impl Elements {
    /// Of triangles of points: all of their edges are constraints, so that they are the triangles.
    pub(super) fn of(path: &Path, points: &[[f64; 2]], triangles: &[[usize; 3]]) -> Result<Self, Failure> {
        let sides: Vec<[usize; 2]> =
            triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        let refused = |error: delone::Error| {
            Failure::new(
                format!("{}: these triangles are no mesh: {error}", path.display()),
                "triangles of a mesh share corners and sides, and no more",
            )
        };
        let c = Constrained2::from_parts(points, &sides).map_err(refused)?;
        let mut vertex: Vec<usize> = (0..points.len()).collect();
        c.duplicates().for_each(|duplicate| vertex[duplicate.point] = duplicate.vertex.index());
        let sorted = |mut corners: [usize; 3]| {
            corners.sort_unstable();
            corners
        };
        let corners: Vec<[usize; 3]> = triangles.iter().map(|corners| corners.map(|i| vertex[i])).collect();
        let mut known: Vec<([usize; 3], u32)> =
            corners.iter().zip(0..).map(|(&corners, row)| (sorted(corners), row)).collect();
        known.sort_unstable();
        let mut rows = vec![None; c.mesh().slot_count()];
        let mut found = 0;
        for t in c.triangle_ids() {
            let corners = sorted(c.mesh().corners(t).map(VertexId::index));
            if let Ok(at) = known.binary_search_by(|row| row.0.cmp(&corners)) {
                rows[t.index()] = Some(known[at].1);
                found += 1;
            }
        }
        if found < triangles.len() {
            let what =
                format!("{} of {} overlap others or have no area", triangles.len() - found, triangles.len());
            return Err(Failure::new(
                format!("{}: these triangles are no mesh: {what}", path.display()),
                "triangles of a mesh share corners and sides, and no more",
            ));
        }
        let corners = corners.into_iter().map(|corners| corners.map(VertexId::new)).collect();
        Ok(Self { triangulation: c, rows, corners })
    }

    /// The corners of all of them.
    pub(super) fn corners(&self) -> &[[VertexId; 3]] {
        &self.corners
    }

    /// The rows of the triangles that a place is in, or between.
    pub(super) fn at(&self, p: [f64; 2]) -> impl Iterator<Item = usize> + '_ {
        let mesh = self.triangulation.mesh();
        let around: Vec<TriangleId> = match self.triangulation.locate(p) {
            Ok(Location2::Triangle(t)) => vec![t],
            Ok(Location2::Edge(e)) => [e, mesh.twin(e)].map(|e| e.triangle()).to_vec(),
            Ok(Location2::Vertex(v)) => mesh.star(v).map(|e| e.triangle()).collect(),
            _ => Vec::new(),
        };
        around.into_iter().filter_map(|t| self.rows.get(t.index()).copied().flatten()).map(|row| row as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::{along, between};

    #[test]
    fn values_are_linear_and_stay_between() {
        let corners = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]];
        assert_eq!(between([1.0, 1.0], corners, [8.0, 12.0, 4.0]), 8.0);
        assert_eq!(between([0.0, 2.0], corners, [8.0, 1.0, 4.0]), 6.0);
        assert_eq!(along([1.0, 0.0], [[0.0, 0.0], [4.0, 0.0]], [8.0, 4.0]), 7.0);
        // Beyond the numbers there are.
        let far = [[0.0, 0.0], [1e300, 0.0], [0.0, 1e300]];
        assert!((1.0..=3.0).contains(&between([1e299, 1e299], far, [1.0, 2.0, 3.0])));
        let inf = f64::INFINITY;
        assert!(between([1.0, 1.0], corners, [inf, inf, inf]) == inf);
        assert!(between([1.0, 1.0], corners, [1.0, inf, 2.0]) >= 1.0);
    }
}
