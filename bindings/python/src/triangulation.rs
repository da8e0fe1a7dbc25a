//! A triangulation of the plane or of space, by its arrays and its queries.
//!
//! Whoever asks borrows it, and only changes borrow it alone: several threads of Python may ask at once.

use std::convert::Infallible;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use delone::{
    Ask, Change, Coordinates, Corners, Delaunay2, Delaunay3, Error, Triangulation as Triangular, VertexId,
};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyIndexError, PyMemoryError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::{in_pieces, interruptible};
use crate::memory::{TRIANGULATION, room_for_neighbors};
use crate::pool::{FEW, detached, generation, is_many, shared};
use crate::shared::Shared;

/// Queries that one task answers.
const QUERIES: usize = 1024;
/// Simplices whose centres one task finds.
const CENTRES: usize = FEW / 2;
/// Of so many points a sample, which a question may ask for at any time, is large enough for threads.
const MANY: usize = 500_000;

/// Rows of indices.
pub type Rows<'py> = Bound<'py, PyArray2<i32>>;

/// A triangulation and the rows of its simplices.
pub struct State<T> {
    pub triangulation: T,
    /// For each number of a simplex its row, once it was asked for; -1 for what is not finite.
    rows: OnceLock<Vec<i32>>,
    /// Whether it has all that it makes for its first question.
    is_asked: AtomicBool,
    /// One more than the generation of the process that asks this; 0 if none does.
    first_asked_by: AtomicUsize,
}

pub enum Core {
    Plane(State<Delaunay2>),
    Space(State<Delaunay3>),
}

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", frozen)]
pub struct Triangulation {
    pub core: Shared<Core>,
}

/// The same for either dimension.
macro_rules! either {
    ($core:expr, $state:ident => $body:expr) => {
        match $core {
            Core::Plane($state) => $body,
            Core::Space($state) => $body,
        }
    };
}

#[pymethods]
impl Triangulation {
    #[new]
    fn new(py: Python<'_>, points: PyReadonlyArray2<'_, f64>) -> PyResult<Self> {
        let core = match points.shape()[1] {
            2 => Core::Plane(State::build(py, coordinates(&points)?)?),
            3 => Core::Space(State::build(py, coordinates(&points)?)?),
            columns => return Err(PyValueError::new_err(format!("points of {columns} coordinates"))),
        };
        Ok(Self { core: Shared::new(core) })
    }

    /// Corners and neighbours of the finite simplices.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<(Rows<'py>, Rows<'py>)> {
        either!(&*self.core.read(py)?, state => state.arrays(py))
    }

    /// The circumcentres of the finite simplices, each the nearest number to the exact one; infinite where that is too large.
    fn centres<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        fn rows<I: Sync, const D: usize>(
            py: Python<'_>,
            simplices: impl Iterator<Item = I> + Send,
            centre: impl Fn(&I) -> Option<[f64; D]> + Sync + Send,
        ) -> PyResult<Bound<'_, PyArray2<f64>>> {
            let simplices: Vec<I> = simplices.collect();
            let centre = |simplex: &I| Ok::<_, Infallible>(centre(simplex).unwrap_or([f64::INFINITY; D]));
            let Ok(centres) =
                detached(py, is_many(&simplices, CENTRES), || shared(&simplices, CENTRES, centre));
            PyArray1::from_vec(py, centres.into_flattened()).reshape([simplices.len(), D])
        }
        match &*self.core.read(py)? {
            Core::Plane(State { triangulation: d, .. }) => {
                rows(py, d.mesh().triangles(), |&t| d.circumcentre(t))
            }
            Core::Space(State { triangulation: d, .. }) => {
                rows(py, d.tetrahedron_ids(), |&t| d.circumcentre(t))
            }
        }
    }

    fn hull<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        either!(&*self.core.read(py)?, state => state.hull(py))
    }

    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        either!(&*self.core.read(py)?, state => state.edges(py))
    }

    /// Points that are no vertices because they equal one, each with this.
    fn duplicates<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        either!(&*self.core.read(py)?, state => state.duplicates(py))
    }

    #[getter]
    fn vertex_count(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(either!(&*self.core.read(py)?, state => state.vertex_count()))
    }

    #[getter]
    fn span(&self, py: Python<'_>) -> PyResult<i32> {
        Ok(either!(&*self.core.read(py)?, state => state.span()))
    }

    fn extend(&self, py: Python<'_>, points: PyReadonlyArray2<'_, f64>) -> PyResult<()> {
        either!(&mut *self.core.write(py)?, state => state.extend(py, coordinates(&points)?))
    }

    fn remove(&self, py: Python<'_>, vertices: Vec<i64>) -> PyResult<()> {
        either!(&mut *self.core.write(py)?, state => state.remove(py, &vertices))
    }

    fn is_vertex(&self, py: Python<'_>, index: usize) -> PyResult<bool> {
        Ok(either!(&*self.core.read(py)?, state => state.is_vertex(VertexId::new(index))))
    }

    /// The rows of simplices that hold points; -1 outside.
    fn find<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i32>>> {
        either!(&*self.core.read(py)?, state => state.find(py, coordinates(&queries)?))
    }

    /// The nearest vertices; -1 if there is none.
    fn nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let found = either!(&*self.core.read(py)?, state => state.nearest(py, coordinates(&queries)?))?;
        Ok(PyArray1::from_vec(py, found))
    }

    /// The k nearest vertices, nearest first; -1 where there are not so many.
    fn k_nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
        k: usize,
    ) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let count = queries.shape()[0];
        let found = either!(&*self.core.read(py)?, state => state.k_nearest(py, coordinates(&queries)?, k))?;
        PyArray1::from_vec(py, found).reshape([count, k])
    }

    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        let core = match &*self.core.read(py)? {
            Core::Plane(state) => Core::Plane(State::of(state.triangulation.clone())),
            Core::Space(state) => Core::Space(State::of(state.triangulation.clone())),
        };
        Ok(Self { core: Shared::new(core) })
    }
}

impl<T: Triangular> State<T> {
    /// Corners of a simplex.
    const WIDTH: usize = T::Point::COUNT + 1;

    pub fn of(triangulation: T) -> Self {
        let (is_asked, first_asked_by) = (AtomicBool::new(false), AtomicUsize::new(0));
        Self { triangulation, rows: OnceLock::new(), is_asked, first_asked_by }
    }

    /// For each number of a simplex its row.
    pub fn rows(&self) -> &[i32] {
        if let Some(rows) = self.rows.get() {
            return rows;
        }
        // Two may make them at once. Were it one while others wait, a process that is forked meanwhile would wait for ever.
        let mut rows = vec![-1; self.triangulation.slot_count()];
        for (row, simplex) in (0..).zip(self.triangulation.simplices()) {
            rows[self.triangulation.index(simplex)] = row;
        }
        self.rows.get_or_init(|| rows)
    }

    /// The row of a simplex; -1 for none.
    pub fn row(&self, rows: &[i32], simplex: Option<T::Simplex>) -> i32 {
        simplex.map_or(-1, |simplex| rows[self.triangulation.index(simplex)])
    }

    /// Forgets what is not so any more after a change, and says whether changes by so many points are worth threads.
    pub fn change(&mut self, points: usize) -> bool {
        self.rows.take();
        (*self.is_asked.get_mut(), *self.first_asked_by.get_mut()) = (false, 0);
        points + self.triangulation.vertex_count() >= FEW
    }

    pub fn arrays<'py>(&self, py: Python<'py>) -> PyResult<(Rows<'py>, Rows<'py>)> {
        let (corners, neighbors) = py.detach(|| {
            let rows = self.rows();
            let (mut corners, mut neighbors): (Vec<i32>, Vec<i32>) = (Vec::new(), Vec::new());
            for simplex in self.triangulation.simplices() {
                corners.extend(self.triangulation.corners(simplex).indices().map(|i| i as i32));
                let across = (0..Self::WIDTH).map(|k| self.triangulation.across(simplex, k));
                neighbors.extend(across.map(|next| self.row(rows, next)));
            }
            (corners, neighbors)
        });
        let count = corners.len() / Self::WIDTH;
        let array = |values: Vec<i32>| PyArray1::from_vec(py, values).reshape([count, Self::WIDTH]);
        Ok((array(corners)?, array(neighbors)?))
    }

    pub fn hull<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        // Coplanar points have facets, but no hull that is a body.
        let is_spanned = self.span() as usize == T::Point::COUNT;
        let facets = self.triangulation.hull_facets().filter(|_| is_spanned);
        table(py, T::Point::COUNT, facets)
    }

    pub fn edges<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        let edges: Vec<[VertexId; 2]> = py.detach(|| self.triangulation.edges().collect());
        table(py, 2, edges.into_iter())
    }

    pub fn duplicates<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        let duplicates = self.triangulation.duplicates().map(|d| [VertexId::new(d.point), d.vertex]);
        table(py, 2, duplicates)
    }

    pub fn vertex_count(&self) -> usize {
        self.triangulation.vertex_count()
    }

    pub fn span(&self) -> i32 {
        // Nothing is -1, a point 0.
        self.triangulation.dimension() as i32 - 1
    }

    pub fn is_vertex(&self, v: VertexId) -> bool {
        self.triangulation.position(v).is_some()
    }
}

impl<T: Ask> State<T> {
    /// The answers to queries, in their order. The first error that any query has.
    pub fn answers<A: Send>(
        &self,
        py: Python<'_>,
        queries: &[T::Point],
        answer: impl Fn(T::Point) -> Result<A, Error> + Sync,
    ) -> PyResult<Vec<A>> {
        in_pieces(py, queries, |piece| {
            self.asking(py, is_many(piece, QUERIES), piece.is_empty(), || {
                shared(piece, QUERIES, |&q| answer(q))
            })
        })
    }

    /// The answer of the library to so many questions at once.
    pub fn asked<A: Send>(
        &self,
        py: Python<'_>,
        count: usize,
        answer: impl FnOnce() -> Result<A, Error> + Send,
    ) -> PyResult<A> {
        self.asking(py, count >= FEW, count == 0, answer)
    }

    fn asking<A: Send>(
        &self,
        py: Python<'_>,
        is_many: bool,
        is_nothing: bool,
        answer: impl FnOnce() -> Result<A, Error> + Send,
    ) -> PyResult<A> {
        let is_first = !self.is_asked.load(Ordering::Acquire);
        if is_first {
            let here = generation() + 1;
            let asking = self.first_asked_by.compare_exchange(0, here, Ordering::AcqRel, Ordering::Acquire);
            // Others wait for the one who makes what finds answers. A child waits for ever if that was a thread of its parent.
            if asking.is_err_and(|other| other != here) {
                let message =
                    "forked while another thread asked this triangulation for the first time; ask its copy()";
                return Err(PyRuntimeError::new_err(message));
            }
        }
        // The first question makes what finds answers, which is worth threads, and others may have to make it better.
        let few = if is_first { FEW } else { MANY };
        let found = detached(py, is_many || self.triangulation.vertex_count() >= few, answer);
        self.is_asked.fetch_or(!is_nothing, Ordering::Release);
        found.map_err(python_error)
    }

    fn find<'py>(&self, py: Python<'py>, queries: Vec<T::Point>) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let rows = py.detach(|| self.rows());
        let row = |q| self.triangulation.find(q).map(|found| self.row(rows, found.simplex));
        Ok(PyArray1::from_vec(py, self.answers(py, &queries, row)?))
    }

    pub fn nearest(&self, py: Python<'_>, queries: Vec<T::Point>) -> PyResult<Vec<i64>> {
        let vertex =
            |q| self.triangulation.nearest_observed(q, &mut ()).map(|v| v.map_or(-1, |v| v.index() as i64));
        self.answers(py, &queries, vertex)
    }

    pub fn k_nearest(&self, py: Python<'_>, queries: Vec<T::Point>, k: usize) -> PyResult<Vec<i64>> {
        let mut padded = room_for_neighbors(queries.len(), k)?;
        let most = k.min(self.triangulation.vertex_count());
        let found = self.answers(py, &queries, |q| self.triangulation.k_nearest(q, most))?;
        for found in found {
            let missing = k - found.len();
            padded.extend(found.into_iter().map(|v| v.index() as i64));
            padded.extend(std::iter::repeat_n(-1, missing));
        }
        Ok(padded)
    }
}

impl<T: Change + 'static> State<T> {
    fn build(py: Python<'_>, points: Vec<T::Point>) -> PyResult<Self> {
        TRIANGULATION.check(T::Point::COUNT, points.len())?;
        let built = interruptible(py, points.len(), move || T::from_vec(points))?;
        Ok(Self::of(built.map_err(python_error)?))
    }

    fn extend(&mut self, py: Python<'_>, points: Vec<T::Point>) -> PyResult<()> {
        TRIANGULATION.check(T::Point::COUNT, points.len())?;
        let is_long = self.change(points.len());
        detached(py, is_long, || self.triangulation.extend(&points, 0)).map(drop).map_err(python_error)
    }

    /// All or none.
    fn remove(&mut self, py: Python<'_>, vertices: &[i64]) -> PyResult<()> {
        let mut wanted = Vec::with_capacity(vertices.len());
        for &index in vertices {
            let v = usize::try_from(index).ok().map(VertexId::new);
            match v.filter(|&v| self.is_vertex(v)) {
                Some(v) => wanted.push(v),
                None => return Err(PyIndexError::new_err(format!("point {index} is no vertex"))),
            }
        }
        wanted.sort_unstable();
        if let Some(twice) = wanted.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(PyValueError::new_err(format!("point {} is to be removed twice", twice[0].index())));
        }
        let is_long = self.change(wanted.len());
        detached(py, is_long, || {
            wanted.into_iter().try_for_each(|v| self.triangulation.remove_observed(v, &mut ()))
        })
        .map_err(python_error)
    }
}

/// The points of an array that has a column for each coordinate.
pub fn coordinates<P: Coordinates>(points: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<P>> {
    if points.shape()[1] != P::COUNT {
        let (columns, expected) = (points.shape()[1], P::COUNT);
        return Err(PyValueError::new_err(format!(
            "points of {columns} coordinates where there must be {expected}"
        )));
    }
    let rows = points.as_slice()?.chunks_exact(P::COUNT);
    let mut copy = Vec::new();
    if copy.try_reserve_exact(rows.len()).is_err() {
        return Err(PyMemoryError::new_err(format!("a copy of {} points", rows.len())));
    }
    copy.extend(rows.map(|row| {
        let mut point = P::default();
        point.as_mut().copy_from_slice(row);
        point
    }));
    Ok(copy)
}

/// Vertices as rows of so many numbers.
pub fn table<C: Corners>(
    py: Python<'_>,
    columns: usize,
    rows: impl Iterator<Item = C>,
) -> PyResult<Rows<'_>> {
    let values: Vec<i32> = rows.flat_map(Corners::indices).map(|i| i as i32).collect();
    let count = values.len() / columns;
    PyArray1::from_vec(py, values).reshape([count, columns])
}
