//! A triangulation of any kind with what Python knows of it, the rows of its simplices, and questions.
//!
//! Methods on a share take it along, so that nobody else holds it while they wait.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

use delone::{Ask, Coordinates, Corners, Error, Triangulation as Triangular, VertexId};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::{LONG, Wanted, in_pieces, interruptible, size_of_queries, while_wanted};
use crate::memory::room_for_neighbors;
use crate::pool::{SERIAL_ITEMS, generation};
use crate::shared::Shared;

/// Queries that one task answers.
pub const QUERIES: usize = 1024;
/// Vertices, from which on a question after the first counts as long: it may have to improve the sample, with threads.
const PARALLEL_SAMPLE_POINTS: usize = 500_000;

/// Rows of indices.
pub type Rows<'py> = Bound<'py, PyArray2<i32>>;

/// Versions given so far, of all triangulations.
static VERSIONS: AtomicUsize = AtomicUsize::new(0);

/// A triangulation, the rows of its simplices, and what else changes with it.
pub struct State<T, R = ()> {
    pub triangulation: T,
    pub record: R,
    /// Another number after each change: what was made of another version is not so any more.
    version: usize,
    /// For each number of a simplex its row, once it was asked for; -1 for what is not finite.
    rows: OnceLock<Vec<i32>>,
    /// Whether it has what finds answers.
    is_ready: AtomicBool,
    /// Whether its first question was answered.
    is_asked: AtomicBool,
    /// One more than the generation of the process that asks this; 0 if none does.
    first_asked_by: AtomicUsize,
}

impl<T: Triangular + 'static, R: Send + Sync + 'static> State<T, R> {
    /// Corners of a simplex.
    const WIDTH: usize = T::Point::COUNT + 1;

    pub fn of(triangulation: T, record: R) -> Self {
        let (is_ready, is_asked, first_asked_by) = Default::default();
        let version = VERSIONS.fetch_add(1, Ordering::Relaxed);
        Self { triangulation, record, version, rows: OnceLock::new(), is_ready, is_asked, first_asked_by }
    }

    pub fn version(&self) -> usize {
        self.version
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

    /// Forgets what is not so any more after a change.
    pub fn forget(&mut self) {
        self.rows.take();
        self.version = VERSIONS.fetch_add(1, Ordering::Relaxed);
        (*self.is_ready.get_mut(), *self.is_asked.get_mut(), *self.first_asked_by.get_mut()) =
            (false, false, 0);
    }

    /// How large work is that comes by all of it.
    pub fn size(&self) -> usize {
        // In space there may be many more simplices than points.
        self.triangulation.ids_given().max(self.triangulation.slot_count() / 7)
    }

    /// Runs work on all of it.
    pub fn make<A: Send + 'static>(
        self: Arc<Self>,
        py: Python<'_>,
        make: impl FnOnce(&Self) -> A + Send + 'static,
    ) -> PyResult<A> {
        interruptible(py, self.size(), move || make(&self))
    }

    pub fn arrays(self: Arc<Self>, py: Python<'_>) -> PyResult<(Rows<'_>, Rows<'_>)> {
        let (corners, neighbors) = self.make(py, |this| {
            let rows = this.rows();
            let (mut corners, mut neighbors): (Vec<i32>, Vec<i32>) = (Vec::new(), Vec::new());
            for simplex in this.triangulation.simplices() {
                corners.extend(this.triangulation.corners(simplex).indices().map(|i| i as i32));
                let across = (0..Self::WIDTH).map(|k| this.triangulation.across(simplex, k));
                neighbors.extend(across.map(|next| this.row(rows, next)));
            }
            (corners, neighbors)
        })?;
        Ok((table(py, Self::WIDTH, corners)?, table(py, Self::WIDTH, neighbors)?))
    }

    pub fn hull(self: Arc<Self>, py: Python<'_>) -> PyResult<Rows<'_>> {
        let facets = self.make(py, |this| {
            // Coplanar points have facets, but no hull that is a body.
            let is_spanned = this.span() as usize == T::Point::COUNT;
            indices(this.triangulation.hull_facets().filter(|_| is_spanned))
        })?;
        table(py, T::Point::COUNT, facets)
    }

    pub fn edges(self: Arc<Self>, py: Python<'_>) -> PyResult<Rows<'_>> {
        let edges = self.make(py, |this| indices(this.triangulation.edges()))?;
        table(py, 2, edges)
    }

    /// Points that are no vertices because they equal one, each with this, if they are wanted.
    pub fn duplicates(
        self: Arc<Self>,
        py: Python<'_>,
        is_wanted: impl Fn(&R, usize) -> bool + Send + 'static,
    ) -> PyResult<Rows<'_>> {
        let pairs = self.make(py, move |this| {
            let all = this.triangulation.duplicates().filter(|d| is_wanted(&this.record, d.point));
            indices(all.map(|d| [VertexId::new(d.point), d.vertex]))
        })?;
        table(py, 2, pairs)
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

    /// A share to ask; none yet while another thread asks for the first time, and makes what finds answers.
    fn asking(self: &Arc<Self>) -> PyResult<Option<Asking<T, R>>> {
        let is_first = if self.is_asked.load(Ordering::Acquire) {
            false
        } else {
            let here = generation() + 1;
            match self.first_asked_by.compare_exchange(0, here, Ordering::AcqRel, Ordering::Acquire) {
                Ok(_) => true,
                Err(other) if other != here => {
                    // A child waits for ever if that was a thread of its parent.
                    let message = "forked while another thread asked this triangulation for the first time; ask its copy()";
                    return Err(PyRuntimeError::new_err(message));
                }
                Err(_) if self.is_ready.load(Ordering::Acquire) => false,
                Err(_) => return Ok(None),
            }
        };
        Ok(Some(Asking { state: Arc::clone(self), is_first }))
    }

    /// The answer to a question of a size. The first one gets ready before: others would wait for what it makes, and if they are
    /// on threads that help to make it, for themselves.
    pub fn asked_after<A: Send + 'static>(
        shared: &Shared<Self>,
        py: Python<'_>,
        size: usize,
        get_ready: impl Fn(&T) + Send + 'static,
        question: impl FnOnce(&Self, &Wanted) -> PyResult<A> + Send + 'static,
    ) -> PyResult<A> {
        let asking = shared.read_when(py, Self::asking)?;
        // What finds answers is worth threads, and any question may have to make it better.
        let few = if asking.is_first { SERIAL_ITEMS } else { PARALLEL_SAMPLE_POINTS };
        let size = if asking.state.vertex_count() >= few { LONG } else { size };
        while_wanted(py, size, move |wanted| {
            if asking.is_first {
                get_ready(&asking.state.triangulation);
                asking.state.is_ready.store(true, Ordering::Release);
            }
            question(&asking.state, wanted)
        })?
    }
}

/// A share of a state that is asked, for the first time or not.
struct Asking<T, R> {
    state: Arc<State<T, R>>,
    is_first: bool,
}

impl<T, R> Drop for Asking<T, R> {
    fn drop(&mut self) {
        if !self.is_first {
            return;
        }
        if self.state.is_ready.load(Ordering::Acquire) {
            self.state.is_asked.store(true, Ordering::Release);
        } else {
            self.state.first_asked_by.store(0, Ordering::Release);
        }
    }
}

impl<T: Ask + 'static, R: Send + Sync + 'static> State<T, R> {
    /// The answer to a question of a size.
    pub fn asked<A: Send + 'static>(
        shared: &Shared<Self>,
        py: Python<'_>,
        size: usize,
        question: impl FnOnce(&Self, &Wanted) -> PyResult<A> + Send + 'static,
    ) -> PyResult<A> {
        // Any place does.
        Self::asked_after(shared, py, size, |d| _ = d.find(T::Point::default()), question)
    }

    /// The answers to queries, in their order, by what answers one. The first error that any query has.
    pub fn answers<A: Send + 'static>(
        shared: &Shared<Self>,
        py: Python<'_>,
        queries: Vec<T::Point>,
        answer: impl Fn(&Self, T::Point) -> Result<A, Error> + Send + Sync + 'static,
    ) -> PyResult<Vec<A>> {
        Self::asked(shared, py, size_of_queries(queries.len(), 1), move |this, wanted| {
            in_pieces(wanted, &queries, QUERIES, |&q| answer(this, q)).map_err(python_error)
        })
    }

    pub fn find(shared: &Shared<Self>, py: Python<'_>, queries: Vec<T::Point>) -> PyResult<Vec<i32>> {
        Self::asked(shared, py, size_of_queries(queries.len(), 1), move |this, wanted| {
            let rows = this.rows();
            let row = |&q: &T::Point| this.triangulation.find(q).map(|found| this.row(rows, found.simplex));
            in_pieces(wanted, &queries, QUERIES, row).map_err(python_error)
        })
    }

    pub fn nearest(shared: &Shared<Self>, py: Python<'_>, queries: Vec<T::Point>) -> PyResult<Vec<i64>> {
        Self::answers(shared, py, queries, |this, q| {
            let nearest = this.triangulation.nearest_observed(q, &mut ())?;
            Ok(nearest.map_or(-1, |v| v.index() as i64))
        })
    }

    pub fn k_nearest(
        shared: &Shared<Self>,
        py: Python<'_>,
        queries: Vec<T::Point>,
        k: usize,
    ) -> PyResult<Vec<i64>> {
        let mut padded = room_for_neighbors(queries.len(), k)?;
        let size = size_of_queries(queries.len(), k);
        Self::asked(shared, py, size, move |this, wanted| {
            let most = k.min(this.vertex_count());
            let found = in_pieces(wanted, &queries, QUERIES, |&q| this.triangulation.k_nearest(q, most));
            for found in found.map_err(python_error)? {
                let missing = k - found.len();
                padded.extend(found.into_iter().map(|v| v.index() as i64));
                padded.extend(std::iter::repeat_n(-1, missing));
            }
            Ok(padded)
        })
    }
}

/// The indices of vertices, row by row.
pub fn indices<C: Corners>(rows: impl Iterator<Item = C>) -> Vec<i32> {
    rows.flat_map(Corners::indices).map(|i| i as i32).collect()
}

/// Rows of so many numbers.
pub fn table<T: numpy::Element>(
    py: Python<'_>,
    columns: usize,
    values: Vec<T>,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let rows = values.len() / columns;
    PyArray1::from_vec(py, values).reshape([rows, columns])
}
