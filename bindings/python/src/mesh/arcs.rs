//! Segments that are chords of arcs: divided before there is a mesh, and known while it is refined.

use delone::{Arc2, ArcProblem, Error, SegmentId, arcs_over_shared_chords};
use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use super::Table;
use crate::constrained::{index, pairs};
use crate::errors::python_error;
use crate::state::table;
use crate::triangulation::coordinates;

/// Arcs by their segments, with centers.
pub(super) type Arcs = Vec<(SegmentId, [f64; 2])>;

/// Rows of segments, and centers.
pub(super) type ArcWish<'py> = (PyReadonlyArray1<'py, i64>, PyReadonlyArray2<'py, f64>);

/// Points, segments, the given segment of each, the segments that are chords, and the centers of these.
type Divided<'py> =
    (Table<'py, f64>, Table<'py, i64>, Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>, Table<'py, f64>);

/// The arcs that are wished.
pub(super) fn arcs_of(wish: Option<&ArcWish>) -> PyResult<Arcs> {
    let Some((rows, centers)) = wish else { return Ok(Vec::new()) };
    let centers: Vec<[f64; 2]> = coordinates(centers)?;
    Ok(rows.as_slice()?.iter().map(|&row| SegmentId::new(index(row))).zip(centers).collect())
}

/// Divides arcs into chords of at most 11.25 degrees. Centers of straight segments are NaN. New points follow the given ones.
#[pyfunction]
pub fn divide_arcs<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    segments: PyReadonlyArray2<'py, i64>,
    centers: PyReadonlyArray2<'py, f64>,
) -> PyResult<Divided<'py>> {
    let mut points: Vec<[f64; 2]> = coordinates(&points)?;
    let centers: Vec<[f64; 2]> = coordinates(&centers)?;
    let ends: Vec<[usize; 2]> = pairs(&segments)?.iter().map(|ends| ends.map(index)).collect();
    let curved = centers.iter().enumerate().filter(|(_, center)| center.iter().all(|x| x.is_finite()));
    let curved: Vec<(usize, [f64; 2])> = curved
        .take_while(|(segment, _)| *segment < ends.len())
        .map(|(segment, center)| (segment, *center))
        .collect();
    let shared = arcs_over_shared_chords(&points, &ends, &curved);
    let mut is_shared = vec![false; ends.len()];
    for k in shared {
        is_shared[curved[k].0] = true;
    }
    let (mut pieces, mut origins, mut rows, mut known) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (segment, ([a, b], center)) in ends.into_iter().zip(centers).enumerate() {
        if center.iter().all(|x| x.is_nan()) {
            origins.push(segment as i64);
            pieces.extend([a, b]);
            continue;
        }
        let arc = Arc2::new([points[a], points[b]], center).map_err(|error| match error {
            Error::Arc { problem, .. } => python_error(Error::Arc { segment, problem }),
            _ => python_error(Error::Arc { segment, problem: ArcProblem::NotFinite }),
        })?;
        let mut at = a;
        let inner = arc.inner_points();
        let middle = Some(arc.middle()).filter(|_| is_shared[segment] && inner.is_empty());
        for point in inner.into_iter().chain(middle) {
            pieces.extend([at, points.len()]);
            at = points.len();
            points.push(point);
        }
        pieces.extend([at, b]);
        let count = pieces.len() / 2;
        for row in origins.len()..count {
            rows.push(row as i64);
            known.extend(center);
        }
        origins.resize(count, segment as i64);
    }
    let pieces = pieces.into_iter().map(|i| i as i64).collect();
    let rows = PyArray1::from_vec(py, rows);
    let origins = PyArray1::from_vec(py, origins);
    Ok((
        table(py, 2, points.into_iter().flatten().collect())?,
        table(py, 2, pieces)?,
        origins,
        rows,
        table(py, 2, known)?,
    ))
}
