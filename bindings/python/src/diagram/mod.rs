//! The arrays of a Voronoi diagram, made from those of its triangulation: vertices, ridges, regions.
//!
//! Vertices are circumcenters, rounded. Those of cocircular points are equal, and one vertex here; it is -1 where a ridge or a
//! region is open. Ridges and regions are rows of several lengths, so each is a pair of arrays: where rows start, and what is in them.

mod distinct;
mod plane;
mod space;

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{indices, rows};
use crate::interrupt::interruptible;

/// Rows of several lengths.
struct Ragged {
    /// Where each starts, and where the last one ends.
    starts: Vec<i64>,
    items: Vec<i64>,
}

impl Ragged {
    fn new() -> Self {
        Self { starts: vec![0], items: Vec::new() }
    }

    /// The entries of the row that is not ended yet.
    fn row(&self) -> &[i64] {
        let start = self.starts.last().map_or(0, |&start| start as usize);
        &self.items[start..]
    }

    /// Goes on with the row that is not ended yet, but not with what it ends with.
    fn push_new(&mut self, item: i64) {
        if self.row().last() != Some(&item) {
            self.items.push(item);
        }
    }

    /// Makes the row that is not ended yet one that goes around: it does not end with what it begins with.
    fn close(&mut self) {
        while self.row().len() > 1 && self.row().first() == self.row().last() {
            self.items.pop();
        }
    }

    fn end_row(&mut self) {
        self.starts.push(self.items.len() as i64);
    }

    /// More rows after these.
    fn extend(&mut self, more: &Self) {
        let end = self.items.len() as i64;
        self.starts.extend(more.starts[1..].iter().map(|start| end + start));
        self.items.extend(&more.items);
    }
}

/// Pairs of points, and the vertices between them.
struct Ridges {
    pairs: Vec<[i32; 2]>,
    vertices: Ragged,
}

type Array<'py, T> = Bound<'py, PyArray1<T>>;
type Table<'py, T> = Bound<'py, PyArray2<T>>;

/// The vertices, for each simplex which of them its center is, and ridges: their pairs of points, starts and vertices. Without a
/// mask all simplices have a vertex; others are infinitely far away.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "five arrays")]
pub fn voronoi_ridges<'py>(
    py: Python<'py>,
    simplices: PyReadonlyArray2<'py, i32>,
    neighbors: PyReadonlyArray2<'py, i32>,
    centers: PyReadonlyArray2<'py, f64>,
    kept: Option<PyReadonlyArray1<'py, bool>>,
) -> PyResult<(Table<'py, f64>, Array<'py, i32>, Table<'py, i32>, Array<'py, i64>, Array<'py, i64>)> {
    let count = simplices.shape()[0];
    let kept = kept.map(|kept| kept.to_vec()).transpose()?;
    if centers.shape()[0] != count || kept.as_ref().is_some_and(|kept| kept.len() != count) {
        return Err(PyValueError::new_err("a center for each simplex"));
    }
    let (vertices, columns, which, ridges) = if centers.shape()[1] == 2 {
        let corners = indices::<3>(&simplices, 0, usize::MAX)?.to_vec();
        let across = indices::<3>(&neighbors, -1, count)?.to_vec();
        let centers = rows::<_, 2>(&centers)?.to_vec();
        let (vertices, which, ridges) = interruptible(py, count, move || {
            let (vertices, which) = distinct::distinct(&centers, kept.as_deref());
            let ridges = plane::ridges(&corners, &across, &which);
            (vertices, which, ridges)
        })?;
        (vertices.into_flattened(), 2, which, ridges)
    } else {
        let corners = indices::<4>(&simplices, 0, usize::MAX)?.to_vec();
        let across = indices::<4>(&neighbors, -1, count)?.to_vec();
        let centers = rows::<_, 3>(&centers)?.to_vec();
        let (vertices, which, ridges) = interruptible(py, count, move || {
            let (vertices, which) = distinct::distinct(&centers, kept.as_deref());
            let ridges = space::ridges(&corners, &across, &which);
            (vertices, which, ridges)
        })?;
        (vertices.into_flattened(), 3, which, ridges)
    };
    let (vertex_count, pair_count) = (vertices.len() / columns, ridges.pairs.len());
    Ok((
        PyArray1::from_vec(py, vertices).reshape([vertex_count, columns])?,
        PyArray1::from_vec(py, which),
        PyArray1::from_vec(py, ridges.pairs.into_flattened()).reshape([pair_count, 2])?,
        PyArray1::from_vec(py, ridges.vertices.starts),
        PyArray1::from_vec(py, ridges.vertices.items),
    ))
}

/// The regions of so many points: their starts and vertices, in the plane in turn, in space increasing. Points that have no region
/// have an empty row, and so has what comes first if that is wanted.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "arrays of the triangulation and of ridges")]
pub fn voronoi_regions<'py>(
    py: Python<'py>,
    points: usize,
    has_empty: bool,
    simplices: PyReadonlyArray2<'py, i32>,
    neighbors: PyReadonlyArray2<'py, i32>,
    which: PyReadonlyArray1<'py, i32>,
    pairs: PyReadonlyArray2<'py, i32>,
    starts: PyReadonlyArray1<'py, i64>,
    vertices: PyReadonlyArray1<'py, i64>,
) -> PyResult<(Array<'py, i64>, Array<'py, i64>)> {
    let count = simplices.shape()[0];
    let pairs = indices::<2>(&pairs, 0, points)?;
    let (which, starts, vertices) = (which.as_slice()?, starts.as_slice()?, vertices.as_slice()?);
    let mut regions = Ragged::new();
    if has_empty {
        regions.end_row();
    }
    if pairs.is_empty() {
        regions.starts.resize(regions.starts.len() + points, 0);
    } else if simplices.shape()[1] == 3 {
        let corners = indices::<3>(&simplices, 0, points)?;
        let across = indices::<3>(&neighbors, -1, count)?;
        if which.len() != count {
            return Err(PyValueError::new_err("a vertex for each simplex"));
        }
        let (corners, across, which) = (corners.to_vec(), across.to_vec(), which.to_vec());
        regions = interruptible(py, count, move || {
            plane::regions(points, &corners, &across, &which, &mut regions);
            regions
        })?;
    } else {
        let most = i64::from(which.iter().copied().max().unwrap_or(-1));
        let is_sound = starts.is_sorted() && starts.len() == pairs.len() + 1;
        let fits = starts.first() == Some(&0) && starts.last() == Some(&(vertices.len() as i64));
        if !(is_sound && fits && vertices.iter().all(|v| (-1..=most).contains(v))) {
            return Err(PyValueError::new_err("ridges whose starts or vertices are none"));
        }
        let (pairs, starts, vertices) = (pairs.to_vec(), starts.to_vec(), vertices.to_vec());
        regions = interruptible(py, count, move || {
            space::regions(points, &pairs, &starts, &vertices, &mut regions);
            regions
        })?;
    }
    Ok((PyArray1::from_vec(py, regions.starts), PyArray1::from_vec(py, regions.items)))
}
