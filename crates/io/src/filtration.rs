//! Filtrations: faces of all dimensions with their values.

use std::io::{BufWriter, Write};

use delone::{Alpha, VertexId};

use crate::formats::npy;
use crate::{Contents, Direction, Error, Format};

/// Names of the faces of a dimension, and of their values.
const NAMES: [[&str; 2]; 4] = [
    ["vertices", "vertex_values"],
    ["edges", "edge_values"],
    ["triangles", "triangle_values"],
    ["tetrahedra", "tetrahedron_values"],
];

/// Writes the faces of all dimensions with their values, squared radii.
///
/// A NumPy archive has for each dimension an array of corners, int64 of shape (count, corners), and one of values, float64, both in the order
/// of the filtration: `vertices` and `vertex_values`, `edges`, `edge_values`, `triangles`, `triangle_values`, and in space `tetrahedra`,
/// `tetrahedron_values`. Text has a face a line in the order of all: its value, then its corners.
pub fn write_filtration<const D: usize>(
    out: &mut dyn Write,
    format: Format,
    alpha: &Alpha<D>,
) -> Result<(), Error> {
    let all = alpha.all();
    match format {
        Format::Npz => {
            let corners: [Vec<i64>; 4] =
                [indices(all.vertices), indices(all.edges), indices(all.triangles), indices(all.tetrahedra)];
            let mut arrays = Vec::new();
            for (dimension, corners) in corners.iter().enumerate().take(D + 1) {
                let [of_corners, of_values] = NAMES[dimension];
                arrays.push((of_corners, npy::Array::Indices(dimension + 1, corners)));
                arrays.push((of_values, npy::Array::Numbers(alpha.values(dimension))));
            }
            npy::write_archive(out, &arrays)?;
        }
        Format::Text => {
            let mut out = BufWriter::new(out);
            for face in alpha.filtration() {
                write!(out, "{:?}", face.value)?;
                face.corners().iter().try_for_each(|v| write!(out, ",{}", v.index()))?;
                writeln!(out)?;
            }
            out.flush()?;
        }
        _ => return Err(format.without(Contents::Filtrations, Direction::Written)),
    }
    Ok(())
}

fn indices<const N: usize>(faces: &[[VertexId; N]]) -> Vec<i64> {
    faces.as_flattened().iter().map(|v| v.index() as i64).collect()
}
