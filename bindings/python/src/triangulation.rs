//! A triangulation of the plane or of space, by its arrays and its queries.
//!
//! Whoever asks borrows it, and only changes borrow it alone: several threads of Python may ask at once.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use delone::{Delaunay2, Delaunay3, Error, VertexId};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyIndexError, PyMemoryError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::engine::Engine;
use crate::interrupt::interruptible;
use crate::memory::TRIANGULATION;
use crate::pool::{FEW, detached, generation};
use crate::value_error;

/// Queries that one task answers.
const QUERIES: usize = 1024;
/// Of so many points a sample, which a question may ask for at any time, is large enough for threads.
const MANY: usize = 500_000;

type Rows<'py> = Bound<'py, PyArray2<i32>>;

/// An engine and the rows of its simplices.
pub struct State<E, const D: usize, const C: usize> {
    pub engine: E,
    /// For each number of a simplex its row, once it was asked for; -1 for what is not finite.
    rows: OnceLock<Vec<i32>>,
    /// Whether the engine has all that it makes for its first question.
    is_asked: AtomicBool,
    /// One more than the generation of the process that asks this; 0 if none does.
    first_asked_by: AtomicUsize,
}

pub enum Core {
    Plane(State<Delaunay2, 2, 3>),
    Space(State<Delaunay3, 3, 4>),
}

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone")]
pub struct Triangulation {
    pub core: Core,
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
        Ok(Self { core })
    }

    /// Corners and neighbours of the finite simplices.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<(Rows<'py>, Rows<'py>)> {
        either!(&self.core, state => state.arrays(py))
    }

    /// The circumcentres of the finite triangles of the plane, each the nearest number to the exact one.
    fn centres<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let Core::Plane(state) = &self.core else {
            return Err(PyValueError::new_err("exact circumcentres are for the plane"));
        };
        let d = &state.engine;
        let centre = |t| d.circumcentre(t).unwrap_or([f64::INFINITY; 2]);
        let centres: Vec<[f64; 2]> = py.detach(|| d.mesh().triangles().map(centre).collect());
        let count = centres.len();
        PyArray1::from_vec(py, centres.into_flattened()).reshape([count, 2])
    }

    fn hull<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        either!(&self.core, state => state.hull(py))
    }

    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        either!(&self.core, state => state.edges(py))
    }

    /// Points that are no vertices because they equal one, each with this.
    fn duplicates<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        either!(&self.core, state => state.duplicates(py))
    }

    #[getter]
    fn vertex_count(&self) -> usize {
        either!(&self.core, state => state.vertex_count())
    }

    #[getter]
    fn span(&self) -> i32 {
        either!(&self.core, state => state.span())
    }

    fn extend(&mut self, py: Python<'_>, points: PyReadonlyArray2<'_, f64>) -> PyResult<()> {
        either!(&mut self.core, state => state.extend(py, coordinates(&points)?))
    }

    fn remove(&mut self, py: Python<'_>, vertices: Vec<i64>) -> PyResult<()> {
        either!(&mut self.core, state => state.remove(py, &vertices))
    }

    fn is_vertex(&self, index: usize) -> bool {
        // Ids are below 2^29.
        index < 1 << 29 && either!(&self.core, state => state.is_vertex(VertexId::new(index)))
    }

    /// The rows of simplices that hold points; -1 outside.
    fn find<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i32>>> {
        either!(&self.core, state => state.find(py, coordinates(&queries)?))
    }

    /// The nearest vertices; -1 if there is none.
    fn nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let found = either!(&self.core, state => state.nearest(py, coordinates(&queries)?))?;
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
        let found = either!(&self.core, state => state.k_nearest(py, coordinates(&queries)?, k))?;
        PyArray1::from_vec(py, found).reshape([count, k])
    }

    fn copy(&self) -> Self {
        let core = match &self.core {
            Core::Plane(state) => Core::Plane(State::of(state.engine.clone())),
            Core::Space(state) => Core::Space(State::of(state.engine.clone())),
        };
        Self { core }
    }
}

impl<E: Engine<D, C>, const D: usize, const C: usize> State<E, D, C> {
    pub fn of(engine: E) -> Self {
        let (is_asked, first_asked_by) = (AtomicBool::new(false), AtomicUsize::new(0));
        Self { engine, rows: OnceLock::new(), is_asked, first_asked_by }
    }

    fn build(py: Python<'_>, points: Vec<[f64; D]>) -> PyResult<Self> {
        TRIANGULATION.check::<D>(points.len())?;
        let built = interruptible(py, points.len(), move || E::build(points))?;
        Ok(Self::of(built.map_err(value_error)?))
    }

    /// For each number of a simplex its row.
    fn rows(&self) -> &[i32] {
        if let Some(rows) = self.rows.get() {
            return rows;
        }
        // Two may make them at once. Were it one while others wait, a process that is forked meanwhile would wait for ever.
        let (mut rows, mut row) = (vec![-1; self.engine.slots()], 0);
        self.engine.visit(|simplex, _, _| {
            rows[simplex] = row;
            row += 1;
        });
        self.rows.get_or_init(|| rows)
    }

    /// The answers to queries, in their order. The first error that any query has.
    fn answers<A: Send>(
        &self,
        py: Python<'_>,
        queries: &[[f64; D]],
        answer: impl Fn([f64; D]) -> Result<A, Error> + Sync,
    ) -> PyResult<Vec<A>> {
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
        let is_many = queries.len() >= 2 * QUERIES;
        // The first question makes what finds answers, which is worth threads, and others may have to make it better.
        let few = if is_first { FEW } else { MANY };
        let found = detached(py, is_many || self.engine.vertex_count() >= few, || {
            if is_many {
                queries.par_iter().with_min_len(QUERIES).map(|&q| answer(q)).collect()
            } else {
                queries.iter().map(|&q| answer(q)).collect::<Result<Vec<A>, Error>>()
            }
        })?;
        self.is_asked.fetch_or(!queries.is_empty(), Ordering::Release);
        found.map_err(value_error)
    }

    /// Forgets what is not so any more after a change, and says whether changes by so many points are worth threads.
    fn change(&mut self, points: usize) -> bool {
        self.rows.take();
        (*self.is_asked.get_mut(), *self.first_asked_by.get_mut()) = (false, 0);
        points + self.engine.vertex_count() >= FEW
    }

    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<(Rows<'py>, Rows<'py>)> {
        let (corners, neighbors) = py.detach(|| {
            let rows = self.rows();
            let (mut corners, mut neighbors): (Vec<i32>, Vec<i32>) = (Vec::new(), Vec::new());
            self.engine.visit(|_, vertices, across| {
                corners.extend(vertices.map(|v| v.index() as i32));
                neighbors.extend(across.map(|simplex| rows[simplex]));
            });
            (corners, neighbors)
        });
        let count = corners.len() / C;
        let array = |values: Vec<i32>| PyArray1::from_vec(py, values).reshape([count, C]);
        Ok((array(corners)?, array(neighbors)?))
    }

    fn hull<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        table(py, &self.engine.hull())
    }

    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        table(py, &py.detach(|| self.engine.edges()))
    }

    fn duplicates<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        let duplicates = self.engine.duplicates().into_iter().map(|d| [VertexId::new(d.point), d.vertex]);
        table(py, &duplicates.collect::<Vec<_>>())
    }

    fn vertex_count(&self) -> usize {
        self.engine.vertex_count()
    }

    fn span(&self) -> i32 {
        self.engine.span()
    }

    fn is_vertex(&self, v: VertexId) -> bool {
        self.engine.is_vertex(v)
    }

    fn extend(&mut self, py: Python<'_>, points: Vec<[f64; D]>) -> PyResult<()> {
        TRIANGULATION.check::<D>(points.len())?;
        let is_long = self.change(points.len());
        detached(py, is_long, || self.engine.extend(&points))?.map_err(value_error)
    }

    /// All or none.
    fn remove(&mut self, py: Python<'_>, vertices: &[i64]) -> PyResult<()> {
        let mut wanted = Vec::with_capacity(vertices.len());
        for &index in vertices {
            let v = usize::try_from(index).ok().filter(|&index| index < 1 << 29).map(VertexId::new);
            match v.filter(|&v| self.engine.is_vertex(v)) {
                Some(v) => wanted.push(v),
                None => return Err(PyIndexError::new_err(format!("point {index} is no vertex"))),
            }
        }
        wanted.sort_unstable();
        if let Some(twice) = wanted.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(PyValueError::new_err(format!("point {} is to be removed twice", twice[0].index())));
        }
        let is_long = self.change(wanted.len());
        detached(py, is_long, || wanted.into_iter().try_for_each(|v| self.engine.remove(v)))?
            .map_err(value_error)
    }

    fn find<'py>(&self, py: Python<'py>, queries: Vec<[f64; D]>) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let rows = py.detach(|| self.rows());
        let row = |q| self.engine.find(q).map(|found| found.map_or(-1, |simplex| rows[simplex]));
        Ok(PyArray1::from_vec(py, self.answers(py, &queries, row)?))
    }

    fn nearest(&self, py: Python<'_>, queries: Vec<[f64; D]>) -> PyResult<Vec<i64>> {
        let vertex = |q| self.engine.nearest(q).map(|v| v.map_or(-1, |v| v.index() as i64));
        self.answers(py, &queries, vertex)
    }

    fn k_nearest(&self, py: Python<'_>, queries: Vec<[f64; D]>, k: usize) -> PyResult<Vec<i64>> {
        // The answer may be larger than memory.
        let mut padded = Vec::new();
        let size = queries.len().checked_mul(k);
        if size.is_none_or(|size| padded.try_reserve_exact(size).is_err()) {
            return Err(PyMemoryError::new_err(format!("{} times {k} neighbours", queries.len())));
        }
        let most = k.min(self.engine.vertex_count());
        let found = self.answers(py, &queries, |q| self.engine.k_nearest(q, most))?;
        for found in found {
            let missing = k - found.len();
            padded.extend(found.into_iter().map(|v| v.index() as i64));
            padded.extend(std::iter::repeat_n(-1, missing));
        }
        Ok(padded)
    }
}

/// The points of an array of `D` columns.
pub fn coordinates<const D: usize>(points: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<[f64; D]>> {
    if points.shape()[1] != D {
        let columns = points.shape()[1];
        return Err(PyValueError::new_err(format!(
            "points of {columns} coordinates where there must be {D}"
        )));
    }
    let (rows, _) = points.as_slice()?.as_chunks();
    let mut copy = Vec::new();
    if copy.try_reserve_exact(rows.len()).is_err() {
        return Err(PyMemoryError::new_err(format!("a copy of {} points", rows.len())));
    }
    copy.extend_from_slice(rows);
    Ok(copy)
}

/// Vertices as rows of numbers.
fn table<'py, const N: usize>(py: Python<'py>, rows: &[[VertexId; N]]) -> PyResult<Rows<'py>> {
    let values: Vec<i32> = rows.iter().flatten().map(|v| v.index() as i32).collect();
    PyArray1::from_vec(py, values).reshape([rows.len(), N])
}
