//! Voronoi cells clipped to a region of the plane, vertices that are merged, triangles of furthest sites.

use delone::{Coordinates, Region2, VertexId};
use delone_predicates::circumcenter;
use numpy::{PyArray1, PyArray2, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::interruptible;
use crate::state::table;
use crate::triangulation::{Core, Triangulation, coordinates};

/// Corners, the starts of rings among them, and the starts of points among the rings.
type Polygons<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>);

/// The cells of so many points, clipped to a polygon with holes; empty for what is no vertex. Sides up to a length are contracted, if one is
/// given.
#[pyfunction]
pub fn clipped_cells<'py>(
    py: Python<'py>,
    triangulation: PyRef<'py, Triangulation>,
    points: usize,
    rings: Vec<PyReadonlyArray2<'py, f64>>,
    merge: Option<f64>,
) -> PyResult<Polygons<'py>> {
    let Core::Plane(held) = &triangulation.core else {
        return Err(PyValueError::new_err("cells are clipped in the plane"));
    };
    let rings = rings.iter().map(coordinates).collect::<PyResult<Vec<Vec<[f64; 2]>>>>()?;
    // Each side of the region may cut each cell.
    let sides: usize = rings.iter().map(Vec::len).sum();
    let (corners, ring_starts, starts) = held.ask(
        py,
        |state| state.size().saturating_mul(sides.max(1)),
        move |state| {
            let region = Region2::polygon(&rings).map_err(python_error)?;
            let mut cells = state.triangulation.voronoi().clip(&region);
            if let Some(length) = merge {
                cells = cells.merged(length, &region).map_err(python_error)?;
            }
            let (mut corners, mut ring_starts, mut starts) = (Vec::<[f64; 2]>::new(), vec![0], vec![0]);
            for v in (0..points).map(VertexId::new) {
                for ring in cells.rings(v) {
                    corners.extend(ring.points());
                    ring_starts.push(corners.len() as i64);
                }
                starts.push(ring_starts.len() as i64 - 1);
            }
            Ok::<_, PyErr>((corners.into_flattened(), ring_starts, starts))
        },
    )??;
    Ok((table(py, 2, corners)?, PyArray1::from_vec(py, ring_starts), PyArray1::from_vec(py, starts)))
}

/// Which of the places each becomes if sides up to a length are contracted; equal ones become one.
#[pyfunction]
pub fn merged_vertices<'py>(
    py: Python<'py>,
    places: PyReadonlyArray2<'py, f64>,
    sides: PyReadonlyArray2<'py, i64>,
    length: f64,
) -> PyResult<Bound<'py, PyArray1<i64>>> {
    let (ends, _) = sides.as_slice()?.as_chunks::<2>();
    let sides: Vec<[u32; 2]> = ends.iter().map(|ends| ends.map(|i| i as u32)).collect();
    let merged = if places.shape()[1] == 2 {
        merged_places::<[f64; 2]>(py, coordinates(&places)?, sides, length)
    } else {
        merged_places::<[f64; 3]>(py, coordinates(&places)?, sides, length)
    }?;
    Ok(PyArray1::from_vec(py, merged.into_iter().map(i64::from).collect()))
}

fn merged_places<P: Coordinates + Send + 'static>(
    py: Python<'_>,
    places: Vec<P>,
    sides: Vec<[u32; 2]>,
    length: f64,
) -> PyResult<Vec<u32>> {
    let merged = interruptible(py, places.len(), move || delone::merged_vertices(&places, &sides, length))?;
    merged.map_err(python_error)
}

/// Triangles, and the circumcenter of each.
type Triangles<'py> = (Bound<'py, PyArray2<i32>>, Bound<'py, PyArray2<f64>>);

/// The triangles of furthest sites, counter-clockwise, and the circumcenter of each, the nearest number to the exact one.
#[pyfunction]
pub fn furthest<'py>(py: Python<'py>, triangulation: PyRef<'py, Triangulation>) -> PyResult<Triangles<'py>> {
    let Core::Plane(held) = &triangulation.core else {
        return Err(PyValueError::new_err("furthest sites are for the plane"));
    };
    let (corners, centers) = held.read(py)?.make(py, |state| {
        let d = &state.triangulation;
        let triangles: Vec<[VertexId; 3]> = d.furthest().triangles().collect();
        let corners: Vec<i32> = triangles.iter().flatten().map(|v| v.index() as i32).collect();
        let center = |[a, b, c]: [[f64; 2]; 3]| circumcenter(a, b, c).unwrap_or([f64::INFINITY; 2]);
        let centers = triangles.iter().flat_map(|triangle| center(triangle.map(|v| d.point(v))));
        (corners, centers.collect::<Vec<f64>>())
    })?;
    Ok((table(py, 3, corners)?, table(py, 2, centers)?))
}
