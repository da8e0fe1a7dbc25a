//! A constrained triangulation, by its arrays, its changes and its queries.

use delone::{
    Ask, Constrained2, Crossings, Fill, Inserted, RegionSeed2, Seeds2, SegmentEnds, SegmentId, TriangleId,
    Triangulation as _, VertexId,
};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::BoundObject;
use pyo3::exceptions::{PyIndexError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::{in_pieces, interruptible, size_of_queries, while_wanted};
use crate::memory::TRIANGULATION;
use crate::shared::Shared;
use crate::state::{QUERIES, Rows, State, indices, table};
use crate::triangulation::coordinates;

/// Bytes that a segment takes, the input apart.
pub const SEGMENT: usize = 60;
/// Lines of sight that one task follows.
const SIGHTS: usize = 256;

/// The data that change with a triangulation.
pub struct Record {
    /// Segment ids given so far.
    segment_ids: usize,
    /// The names and arguments of all changes, in order.
    changes: Vec<Py<PyAny>>,
}

pub type Made = State<Constrained2, Record>;

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", frozen)]
pub struct Constrained(Shared<Made>);

/// Counts from when segments became constraints, by name.
type Report = Vec<(&'static str, usize)>;
/// For each triangle its part; for each part whether it is inside, its winding number, and its region or -1; and pairs of
/// regions in one part.
type Parts<'py> = (
    Bound<'py, PyArray1<i32>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<i32>>,
    Bound<'py, PyArray1<i32>>,
    Bound<'py, PyArray2<i64>>,
);

#[pymethods]
impl Constrained {
    #[new]
    fn new(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        segments: PyReadonlyArray2<'_, i64>,
        split: bool,
    ) -> PyResult<Self> {
        let points: Vec<[f64; 2]> = coordinates(&points)?;
        let segments: Vec<[usize; 2]> = pairs(&segments)?.iter().map(|ends| ends.map(index)).collect();
        let segment_ids = segments.len();
        TRIANGULATION.check_with(2, points.len(), segments.len().saturating_mul(SEGMENT))?;
        let size = work(points.len(), segments.len(), split);
        let how = if split { Crossings::Split } else { Crossings::Refuse };
        let built = interruptible(py, size, move || Constrained2::with_crossings(&points, &segments, how))?;
        let record = Record { segment_ids, changes: Vec::new() };
        Ok(Self(Shared::new(State::of(built.map_err(python_error)?, record))))
    }

    /// Another number after each change.
    #[getter]
    fn version(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.0.read(py)?.version())
    }

    /// All changes, each with its name and what it was given.
    fn changes(&self, py: Python<'_>) -> PyResult<Vec<Py<PyAny>>> {
        let changes = &self.0.read(py)?.record.changes;
        Ok(changes.iter().map(|change| change.clone_ref(py)).collect())
    }

    /// The coordinates of the points from an index on.
    fn points_from<'py>(&self, py: Python<'py>, first: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let points = self.0.read(py)?.make(py, move |this| {
            this.made().points().get(first..).unwrap_or_default().as_flattened().to_vec()
        })?;
        table(py, 2, points)
    }

    #[getter]
    fn point_count(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.0.read(py)?.made().points().len())
    }

    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<(Rows<'py>, Rows<'py>)> {
        self.0.read(py)?.arrays(py)
    }

    /// Whether the edge across from each corner is a constraint, a row for each triangle.
    fn sides<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<bool>>> {
        let sides = self.0.read(py)?.make(py, |this| {
            let c = this.made();
            let of = |t: TriangleId| [1, 2, 0].map(|k| c.is_constraint(t.edge(k)));
            c.triangle_ids().flat_map(of).collect()
        })?;
        table(py, 3, sides)
    }

    fn hull<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        self.0.read(py)?.hull(py)
    }

    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        self.0.read(py)?.edges(py)
    }

    fn duplicates<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        self.0.read(py)?.duplicates(py, |_, _| true)
    }

    #[getter]
    fn vertex_count(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.0.read(py)?.vertex_count())
    }

    #[getter]
    fn span(&self, py: Python<'_>) -> PyResult<i32> {
        Ok(self.0.read(py)?.span())
    }

    /// The constraint edges, the lesser end first.
    fn constraints<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        let edges = self.0.read(py)?.make(py, |this| indices(this.made().constraints()))?;
        table(py, 2, edges)
    }

    /// The ends of all segments ever given, by id; -1 for those that are not there.
    fn segments<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        let ends = self.0.read(py)?.make(py, |this| {
            let mut ends = vec![[-1; 2]; this.record.segment_ids];
            for (s, both) in this.made().segments() {
                ends[s.index()] = both.map(|v| v.index() as i32);
            }
            ends.into_flattened()
        })?;
        table(py, 2, ends)
    }

    fn report(&self, py: Python<'_>) -> PyResult<Report> {
        let this = self.0.read(py)?;
        let report = this.made().report();
        Ok(vec![
            ("zero_length", report.zero_length),
            ("repeated", report.repeated),
            ("overlapping", report.overlapping),
            ("through_vertices", report.through_vertices),
            ("crossings", report.crossings),
            ("added_points", report.added_points),
            ("rounds", report.rounds),
        ])
    }

    /// The vertices along a segment.
    fn chain<'py>(&self, py: Python<'py>, segment: usize) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let found = self.0.read(py)?.make(py, move |this| this.made().chain(SegmentId::new(segment)))?;
        let found = found.ok_or_else(|| python_error(delone::Error::NoSuchSegment { segment }))?;
        Ok(PyArray1::from_iter(py, found.into_iter().map(|v| v.index() as i64)))
    }

    /// The parts that constraints bound, and which are inside.
    fn parts<'py>(
        &self,
        py: Python<'py>,
        fill: &str,
        holes: PyReadonlyArray2<'py, f64>,
        regions: PyReadonlyArray2<'py, f64>,
        keep_concavities: bool,
    ) -> PyResult<Parts<'py>> {
        let (holes, regions): (Vec<[f64; 2]>, Vec<[f64; 2]>) = (coordinates(&holes)?, coordinates(&regions)?);
        let seed = RegionSeed2::new;
        let seeds = Seeds2::default()
            .holes(holes)
            .regions(regions.into_iter().map(seed).collect())
            .keep_concavities(keep_concavities);
        let fill = fill.to_owned();
        let (of, domains) = self.0.read(py)?.make(py, move |this| {
            let fill = match fill.as_str() {
                "all" => Fill::All,
                "even-odd" => Fill::EvenOdd,
                "nonzero" => Fill::NonZero,
                "positive" => Fill::Positive,
                "negative" => Fill::Negative,
                "seeds" => Fill::Seeds(&seeds),
                other => return Err(PyValueError::new_err(format!("no such fill: {other}"))),
            };
            let domains = this.made().domains(&fill).map_err(python_error)?;
            let part = |t| domains.part(t).map_or(-1, |part| part as i32);
            Ok((this.made().triangle_ids().map(part).collect::<Vec<i32>>(), domains))
        })??;
        let parts = domains.parts();
        let regions = parts.iter().map(|part| part.region.map_or(-1, |region| region as i32));
        let rivals: Vec<i64> = domains.rivals().iter().flatten().map(|&region| region as i64).collect();
        let count = rivals.len() / 2;
        Ok((
            PyArray1::from_vec(py, of),
            PyArray1::from_iter(py, parts.iter().map(|part| part.is_inside)),
            PyArray1::from_iter(py, parts.iter().map(|part| part.winding)),
            PyArray1::from_iter(py, regions),
            PyArray1::from_vec(py, rivals).reshape([count, 2])?,
        ))
    }

    /// The triangles that hold points, by names that all have, -1 for those that do not count. On a border between two that
    /// which counts.
    fn find<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
        names: PyReadonlyArray1<'py, i32>,
    ) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let (queries, names): (Vec<[f64; 2]>, _) = (coordinates(&queries)?, names.to_vec()?);
        let size = size_of_queries(queries.len(), 1);
        let found = State::asked(&self.0, py, size, move |this, wanted| {
            let (c, rows) = (this.made(), this.rows());
            let name =
                |t: TriangleId| usize::try_from(rows[t.index()]).ok().and_then(|row| names.get(row).copied());
            let counts = |t: TriangleId| name(t).filter(|&name| name >= 0);
            let answer = |&q: &[f64; 2]| {
                let found = c.find(q)?;
                let Some(t) = found.simplex else { return Ok(-1) };
                let beside = || match *found.face() {
                    [v] => c.simplices_at(v).into_iter().find_map(counts),
                    [v, w] => {
                        let other = c.corners(t).iter().position(|&corner| corner != v && corner != w);
                        other.and_then(|k| c.across(t, k)).and_then(counts)
                    }
                    _ => None,
                };
                Ok(counts(t).or_else(beside).unwrap_or(-1))
            };
            in_pieces(wanted, &queries, QUERIES, answer).map_err(python_error)
        })?;
        Ok(PyArray1::from_vec(py, found))
    }

    fn nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        Ok(PyArray1::from_vec(py, State::nearest(&self.0, py, coordinates(&queries)?)?))
    }

    fn k_nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
        k: usize,
    ) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let count = queries.shape()[0];
        PyArray1::from_vec(py, State::k_nearest(&self.0, py, coordinates(&queries)?, k)?).reshape([count, k])
    }

    /// For each pair of vertices the first constraint between them; -1 for none.
    fn first_constraints<'py>(
        &self,
        py: Python<'py>,
        lines: PyReadonlyArray2<'py, i64>,
    ) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let (this, lines) = (self.0.read(py)?, pairs(&lines)?.to_vec());
        // A line may come by many triangles, but not by all.
        let size = size_of_queries(lines.len(), this.size().isqrt());
        let found = while_wanted(py, size, move |wanted| {
            let c = this.made();
            let first = |&[a, b]: &[i64; 2]| {
                let met = c.first_constraint(vertex(a)?, vertex(b)?).map_err(python_error)?;
                let ends = met.map(|e| [c.mesh().origin(e), c.mesh().destination(e)]);
                Ok::<_, PyErr>(ends.map_or([-1; 2], |ends| ends.map(|v| v.index() as i64)))
            };
            in_pieces(wanted, &lines, SIGHTS, first)
        })??;
        table(py, 2, found.into_flattened())
    }

    /// Inserts points one after the other, all or none; the vertex of each.
    fn insert<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let note = note(py, ("insert", points.as_any()))?;
        let points: Vec<[f64; 2]> = coordinates(&points)?;
        TRIANGULATION.check(2, points.len())?;
        let more = points.len();
        let vertices = self.0.change(
            py,
            |this| this.size() + more,
            move |this| {
                let (count, most) = (this.made().points().len() + more, delone::MAX_POINTS);
                if count > most {
                    return Err(delone::Error::TooManyPoints { count, most });
                }
                this.changed(note, |c| {
                    let insert = |p| match c.insert(p)? {
                        Inserted::New(v) | Inserted::Existing(v) => Ok(v.index() as i64),
                    };
                    points.into_iter().map(insert).collect::<Result<Vec<_>, _>>()
                })
            },
        )?;
        Ok(PyArray1::from_vec(py, vertices.map_err(python_error)?))
    }

    fn remove(&self, py: Python<'_>, point: i64, ends: &str) -> PyResult<()> {
        let note = note(py, ("remove", point, ends))?;
        let ends = match ends {
            "refuse" => SegmentEnds::Refuse,
            "join" => SegmentEnds::Join,
            "drop" => SegmentEnds::Drop,
            other => return Err(PyValueError::new_err(format!("no such choice of ends: {other}"))),
        };
        let v = vertex(point)?;
        self.changed(py, move |this| this.changed(note, |c| c.remove_with(v, ends)))
    }

    fn insert_segment(&self, py: Python<'_>, a: i64, b: i64) -> PyResult<usize> {
        let note = note(py, ("insert_segment", a, b))?;
        let (a, b) = (vertex(a)?, vertex(b)?);
        self.changed(py, move |this| {
            let id = this.changed(note, |c| c.insert_segment(a, b))?.index();
            this.record.segment_ids = this.record.segment_ids.max(id + 1);
            Ok(id)
        })
    }

    fn remove_segment(&self, py: Python<'_>, segment: usize) -> PyResult<()> {
        let note = note(py, ("remove_segment", segment))?;
        self.changed(py, move |this| this.changed(note, |c| c.remove_segment(SegmentId::new(segment))))
    }

    fn check(&self, py: Python<'_>) -> PyResult<()> {
        let this = self.0.read(py)?;
        let checked = interruptible(py, 2 * this.size(), move || this.made().check())?;
        checked.map_err(|flaw| PyRuntimeError::new_err(flaw.to_string()))
    }

    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        let this = self.0.read(py)?;
        let Record { segment_ids, changes } = &this.record;
        let changes = changes.iter().map(|change| change.clone_ref(py)).collect();
        let record = Record { segment_ids: *segment_ids, changes };
        Ok(Self(Shared::new(State::of(this.make(py, |this| this.made().clone())?, record))))
    }
}

impl Constrained {
    pub fn shared(&self) -> &Shared<Made> {
        &self.0
    }

    fn changed<A: Send + 'static>(
        &self,
        py: Python<'_>,
        change: impl FnOnce(&mut Made) -> Result<A, delone::Error> + Send + 'static,
    ) -> PyResult<A> {
        self.0.change(py, |this| this.size() + 1, change)?.map_err(python_error)
    }
}

impl Made {
    pub fn made(&self) -> &Constrained2 {
        &self.triangulation
    }

    /// Changes it, and notes what was done.
    fn changed<A>(
        &mut self,
        note: Py<PyAny>,
        change: impl FnOnce(&mut Constrained2) -> Result<A, delone::Error>,
    ) -> Result<A, delone::Error> {
        self.forget();
        let answer = change(&mut self.triangulation)?;
        self.record.changes.push(note);
        Ok(answer)
    }
}

/// A change as Python knows it: its name and its arguments.
fn note<'py, N: IntoPyObject<'py>>(py: Python<'py>, change: N) -> PyResult<Py<PyAny>>
where
    N::Error: Into<PyErr>,
{
    Ok(change.into_pyobject(py).map_err(Into::into)?.into_any().unbind())
}

/// How much work points and segments are, for those who count items. The library counts triangles, two a point; and where
/// crossings are split, all segments may cross all, and then there are more points than were given.
pub fn work(points: usize, segments: usize, split: bool) -> usize {
    let crossings = if split { segments.saturating_mul(segments) / 2 } else { 0 };
    points.saturating_add(crossings).saturating_mul(2).saturating_add(segments)
}

/// The rows of an array of two columns.
pub fn pairs<'a>(array: &'a PyReadonlyArray2<'_, i64>) -> PyResult<&'a [[i64; 2]]> {
    match array.shape()[1] {
        2 => Ok(array.as_slice()?.as_chunks().0),
        columns => Err(PyValueError::new_err(format!("{columns} columns where there must be 2"))),
    }
}

/// An index that is none stays so.
pub fn index(of: i64) -> usize {
    usize::try_from(of).unwrap_or(usize::MAX)
}

fn vertex(of: i64) -> PyResult<VertexId> {
    let is_none = || PyIndexError::new_err(format!("{of} is no vertex of this triangulation"));
    usize::try_from(of).map(VertexId::new).map_err(|_| is_none())
}
