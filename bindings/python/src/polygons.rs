//! Many polygons to triangles at once.

use delone::{Crossings, Error, PolygonTriangles2, Polygons2, RingFill};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::constrained::work;
use crate::errors::error_in;
use crate::interrupt::interruptible;
use crate::memory::TRIANGULATION;
use crate::pool::SERIAL_ITEMS;
use crate::triangulation::coordinates;

/// Points, triangles by the indices of points of their polygon, and where both begin for each polygon.
type Ragged<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<i32>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<i64>>,
);

/// The triangles inside of polygons, each alone: their corners, where each ring begins and where all end, where each part begins among
/// the rings, and where each polygon begins among the parts. An error names its polygon unless there is but one.
#[pyfunction]
pub fn triangulate_polygons<'py>(
    py: Python<'py>,
    corners: PyReadonlyArray2<'py, f64>,
    starts: (PyReadonlyArray1<'py, i64>, PyReadonlyArray1<'py, i64>, PyReadonlyArray1<'py, i64>),
    fill: &str,
    split: bool,
    is_one: bool,
) -> PyResult<Ragged<'py>> {
    let corners: Vec<[f64; 2]> = coordinates(&corners)?;
    let (rings, parts, polygons) = starts;
    let rings = offsets(&rings, corners.len())?;
    let parts = offsets(&parts, rings.len() - 1)?;
    let polygons = offsets(&polygons, parts.len() - 1)?;
    TRIANGULATION.check_with(2, 0, corners.len().saturating_mul(40))?;
    let size = work(corners.len(), corners.len(), split);
    let fill = match fill {
        "even-odd" => RingFill::EvenOdd,
        "nonzero" => RingFill::NonZero,
        "positive" => RingFill::Positive,
        "negative" => RingFill::Negative,
        "shells-minus-holes" => RingFill::ShellMinusHoles,
        other => return Err(PyValueError::new_err(format!("no such fill: {other}"))),
    };
    let how = Polygons2::default().with_fill(fill);
    let how = how.with_crossings(if split { Crossings::Split } else { Crossings::Refuse });
    let done = interruptible(py, size, move || {
        let ring = |pair: &[usize]| &corners[pair[0]..pair[1]];
        let part = |pair: &[usize]| rings[pair[0]..=pair[1]].windows(2).map(ring).collect::<Vec<_>>();
        let of_one = |pair: &[usize]| parts[pair[0]..=pair[1]].windows(2).map(part).collect::<Vec<_>>();
        let given: Vec<Vec<Vec<&[[f64; 2]]>>> = polygons.windows(2).map(of_one).collect();
        let done = if size < SERIAL_ITEMS {
            given.iter().map(|parts| how.triangulate_parts(parts)).collect()
        } else {
            how.triangulate_all_parts(&given)
        };
        Flat::of(done)
    })?;
    let flat = done.map_err(|(polygon, error)| error_in((!is_one).then_some(polygon), error))?;
    let (points, triangles) = (flat.points.len(), flat.triangles.len());
    Ok((
        PyArray1::from_vec(py, flat.points.into_flattened()).reshape([points, 2])?,
        PyArray1::from_vec(py, flat.triangles.into_flattened()).reshape([triangles, 3])?,
        PyArray1::from_vec(py, flat.point_starts),
        PyArray1::from_vec(py, flat.triangle_starts),
    ))
}

/// One after the other in memory.
struct Flat {
    points: Vec<[f64; 2]>,
    triangles: Vec<[i32; 3]>,
    point_starts: Vec<i64>,
    triangle_starts: Vec<i64>,
}

impl Flat {
    /// Or the first error, with the polygon that has it.
    fn of(done: Vec<Result<PolygonTriangles2, Error>>) -> Result<Self, (usize, Error)> {
        let starts = || vec![0];
        let mut flat = Self {
            points: Vec::new(),
            triangles: Vec::new(),
            point_starts: starts(),
            triangle_starts: starts(),
        };
        for (polygon, one) in done.into_iter().enumerate() {
            let one = one.map_err(|error| (polygon, error))?;
            flat.points.extend(one.points);
            flat.triangles.extend(one.triangles.iter().map(|t| t.map(|i| i as i32)));
            flat.point_starts.push(flat.points.len() as i64);
            flat.triangle_starts.push(flat.triangles.len() as i64);
        }
        Ok(flat)
    }
}

/// Where parts of so many begin and the last one ends, checked.
fn offsets(given: &PyReadonlyArray1<'_, i64>, count: usize) -> PyResult<Vec<usize>> {
    let given = given.as_slice()?;
    let is_sound =
        given.first() == Some(&0) && given.last().copied() == i64::try_from(count).ok() && given.is_sorted();
    if !is_sound {
        return Err(PyValueError::new_err(format!("offsets must increase from 0 to {count}")));
    }
    Ok(given.iter().map(|&offset| offset as usize).collect())
}
