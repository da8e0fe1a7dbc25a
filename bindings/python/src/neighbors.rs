//! A tree of points that is asked for those near others.

use delone_predicates::hypotenuse;
use std::sync::{Arc, OnceLock};

use delone::{Coordinates, Error, Neighbors2, Neighbors3};
use numpy::{PyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::{in_pieces, interruptible, size_of_queries, while_wanted};
use crate::memory::{NEIGHBORS, room, room_for_neighbors};
use crate::triangulation::coordinates;

/// Queries that one task answers.
const QUERIES: usize = 512;

enum Tree {
    Plane(Arc<Neighbors2>),
    Space(Arc<Neighbors3>),
}

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", frozen)]
pub struct Neighbors {
    tree: Tree,
    /// The coordinates of the points, once distances were asked for.
    points: OnceLock<Arc<[f64]>>,
}

/// Arrays of the answers to queries, of at most `k` neighbors each, for either dimension.
macro_rules! answers {
    ($self:ident, $py:ident, $queries:ident, $each:expr, $tree:ident, $q:ident => $answer:expr, $make:expr) => {
        match &$self.tree {
            Tree::Plane(tree) => {
                let ($tree, queries) = (Arc::clone(tree), coordinates::<[f64; 2]>(&$queries)?);
                answers($py, queries, $each, move |$q| $answer, $make)
            }
            Tree::Space(tree) => {
                let ($tree, queries) = (Arc::clone(tree), coordinates::<[f64; 3]>(&$queries)?);
                answers($py, queries, $each, move |$q| $answer, $make)
            }
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
            let tree = interruptible(py, count, move || Neighbors2::from_points(&points))?;
            Tree::Plane(Arc::new(tree.map_err(python_error)?))
        } else {
            let points: Vec<[f64; 3]> = coordinates(&points)?;
            let tree = interruptible(py, count, move || Neighbors3::from_points(&points))?;
            Tree::Space(Arc::new(tree.map_err(python_error)?))
        };
        Ok(Self { tree, points: OnceLock::new() })
    }

    /// The nearest points; -1 if there are none.
    fn nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let index = |i: Option<usize>| i.map_or(-1, |i| i as i64);
        let found = answers!(self, py, queries, 1, tree, q => tree.nearest(q).map(index), |found| found)?;
        Ok(PyArray1::from_vec(py, found))
    }

    /// The k nearest points, nearest first; -1 where there are not so many.
    fn k_nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
        k: usize,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let mut padded = room_for_neighbors::<i64>(queries.shape()[0], k)?;
        let found = answers!(self, py, queries, k, tree, q => tree.k_nearest(q, k), move |all| {
            for found in all {
                let missing = k - found.len();
                padded.extend(found.into_iter().map(|i| i as i64));
                padded.extend(std::iter::repeat_n(-1, missing));
            }
            padded
        })?;
        Ok(PyArray1::from_vec(py, found))
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
        if self.points.get().is_none() {
            room(points.len().saturating_mul(8), "copies of so many points")?;
        }
        let points = points.as_slice()?;
        let points = Arc::clone(self.points.get_or_init(|| points.into()));
        let distance = move |i: usize, q: &[f64]| {
            let p = &points[i * columns..][..columns];
            p.iter().zip(q).map(|(p, q)| p - q).fold(0.0, hypotenuse)
        };
        let make = move |all: Vec<Vec<(f64, i64)>>| {
            for found in all {
                let missing = k - found.len();
                distances.extend(found.iter().map(|found| found.0));
                distances.extend(std::iter::repeat_n(f64::INFINITY, missing));
                indices.extend(found.iter().map(|found| found.1));
                indices.extend(std::iter::repeat_n(count as i64, missing));
            }
            (distances, indices)
        };
        let (distances, indices) = answers!(self, py, queries, k, tree, q => {
            let found = tree.k_nearest(q, k)?;
            Ok(found.into_iter().map(|i| (distance(i, &q), i as i64)).collect())
        }, make)?;
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
        let most = match &self.tree {
            Tree::Plane(tree) => tree.len(),
            Tree::Space(tree) => tree.len(),
        };
        let make = |all: Vec<Vec<usize>>| {
            let mut end = 0;
            let ends = all.iter().map(|found| {
                end += found.len() as i64;
                end
            });
            let ends: Vec<i64> = ends.collect();
            (all.into_iter().flatten().map(|i| i as i64).collect(), ends)
        };
        let (found, ends) = answers!(self, py, queries, most, tree, q => tree.within(q, radius), make)?;
        Ok((PyArray1::from_vec(py, found), PyArray1::from_vec(py, ends)))
    }
}

/// Collects the answers to queries in their order, or the first error of any query.
fn answers<Q: Coordinates + Send + Sync + 'static, A: Send, B: Send + 'static>(
    py: Python<'_>,
    queries: Vec<Q>,
    each: usize,
    answer: impl Fn(Q) -> Result<A, Error> + Sync + Send + 'static,
    make: impl FnOnce(Vec<A>) -> B + Send + 'static,
) -> PyResult<B> {
    let result = while_wanted(py, size_of_queries(queries.len(), each), move |wanted| {
        in_pieces(wanted, &queries, QUERIES, |&q| answer(q)).map(make)
    })?;
    result.map_err(python_error)
}
