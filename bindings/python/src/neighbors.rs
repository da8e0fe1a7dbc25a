//! A tree of points that is asked for those near others.

use delone::{Error, Neighbors2, Neighbors3};
use numpy::{PyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::{in_pieces, interruptible};
use crate::memory::{NEIGHBORS, room_for_neighbors};
use crate::pool::{detached, is_many, shared};
use crate::triangulation::coordinates;

/// Queries that one task answers.
const QUERIES: usize = 512;

enum Tree {
    Plane(Neighbors2),
    Space(Neighbors3),
}

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", frozen)]
pub struct Neighbors(Tree);

/// The same for either dimension.
macro_rules! answers {
    ($self:ident, $py:ident, $queries:ident, $tree:ident, $q:ident => $answer:expr) => {
        match &$self.0 {
            Tree::Plane($tree) => answers($py, &coordinates::<[f64; 2]>(&$queries)?, |$q| $answer),
            Tree::Space($tree) => answers($py, &coordinates::<[f64; 3]>(&$queries)?, |$q| $answer),
        }
    };
}

#[pymethods]
impl Neighbors {
    #[new]
    fn new(py: Python<'_>, points: PyReadonlyArray2<'_, f64>) -> PyResult<Self> {
        let [count, columns] = [points.shape()[0], points.shape()[1]];
        NEIGHBORS.check(columns, count)?;
        let tree = if columns == 2 {
            let points: Vec<[f64; 2]> = coordinates(&points)?;
            interruptible(py, count, move || Neighbors2::from_points(&points).map(Tree::Plane))?
        } else {
            let points: Vec<[f64; 3]> = coordinates(&points)?;
            interruptible(py, count, move || Neighbors3::from_points(&points).map(Tree::Space))?
        };
        tree.map(Self).map_err(python_error)
    }

    /// The nearest points; -1 if there are none.
    fn nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let found = answers!(self, py, queries, tree, q => tree.nearest(q))?;
        Ok(PyArray1::from_iter(py, found.into_iter().map(|i| i.map_or(-1, |i| i as i64))))
    }

    /// The k nearest points, nearest first; -1 where there are not so many.
    fn k_nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
        k: usize,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let mut padded = room_for_neighbors::<i64>(queries.shape()[0], k)?;
        for found in answers!(self, py, queries, tree, q => tree.k_nearest(q, k))? {
            let missing = k - found.len();
            padded.extend(found.into_iter().map(|i| i as i64));
            padded.extend(std::iter::repeat_n(-1, missing));
        }
        Ok(PyArray1::from_vec(py, padded))
    }

    /// Their distances and indices; infinite and the number of points where there are not so many. `points` are those of the tree.
    #[expect(clippy::type_complexity, reason = "two arrays")]
    fn query<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
        queries: PyReadonlyArray2<'py, f64>,
        k: usize,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<i64>>)> {
        let [count, columns] = [points.shape()[0], points.shape()[1]];
        let (mut distances, mut indices) = (
            room_for_neighbors::<f64>(queries.shape()[0], k)?,
            room_for_neighbors::<i64>(queries.shape()[0], k)?,
        );
        let points = points.as_slice()?;
        let distance = |i: usize, q: &[f64]| {
            let p = &points[i * columns..][..columns];
            p.iter().zip(q).map(|(p, q)| p - q).fold(0.0, f64::hypot)
        };
        let found = answers!(self, py, queries, tree, q => {
            let found = tree.k_nearest(q, k)?;
            Ok(found.into_iter().map(|i| (distance(i, &q), i as i64)).collect::<Vec<_>>())
        })?;
        for found in found {
            let missing = k - found.len();
            distances.extend(found.iter().map(|found| found.0));
            distances.extend(std::iter::repeat_n(f64::INFINITY, missing));
            indices.extend(found.iter().map(|found| found.1));
            indices.extend(std::iter::repeat_n(count as i64, missing));
        }
        Ok((PyArray1::from_vec(py, distances), PyArray1::from_vec(py, indices)))
    }

    /// The points within a radius, increasing, one query after the other, and where those of each end.
    #[expect(clippy::type_complexity, reason = "two arrays")]
    fn within<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
        radius: f64,
    ) -> PyResult<(Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>)> {
        let found = answers!(self, py, queries, tree, q => tree.within(q, radius))?;
        let mut end = 0;
        let ends: Vec<i64> = found
            .iter()
            .map(|found| {
                end += found.len() as i64;
                end
            })
            .collect();
        let found = PyArray1::from_iter(py, found.into_iter().flatten().map(|i| i as i64));
        Ok((found, PyArray1::from_vec(py, ends)))
    }
}

/// The answers to queries, in their order, on all threads if they are many. The first error that any query has.
fn answers<Q: Copy + Sync, A: Send>(
    py: Python<'_>,
    queries: &[Q],
    answer: impl Fn(Q) -> Result<A, Error> + Sync + Send,
) -> PyResult<Vec<A>> {
    in_pieces(py, queries, |piece| {
        detached(py, is_many(piece, QUERIES), || shared(piece, QUERIES, |&q| answer(q))).map_err(python_error)
    })
}
