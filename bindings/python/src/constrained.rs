//! A constrained triangulation, by its arrays, its changes and its queries.

use std::sync::RwLockReadGuard;

use delone::{
    Ask, Constrained2, Crossings, Fill, Inserted, RegionSeed2, Seeds2, SegmentEnds, SegmentId, TriangleId,
    Triangulation as _, VertexId,
};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyIndexError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::interruptible;
use crate::memory::TRIANGULATION;
use crate::pool::{FEW, detached, is_many, shared};
use crate::shared::Shared;
use crate::triangulation::{Rows, State, coordinates, table};

/// Bytes that a segment takes, the input apart.
pub const SEGMENT: usize = 60;
/// Lines of sight that one task follows.
const SIGHTS: usize = 256;

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", frozen)]
pub struct Constrained(Shared<Made>);

/// What is shared.
pub struct Made {
    pub state: State<Constrained2>,
    /// Segment ids given so far.
    segment_ids: usize,
}

/// What was counted as the segments were made constraints, by name.
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
        Ok(Self(Shared::new(Made { state: State::of(built.map_err(python_error)?), segment_ids })))
    }

    /// The coordinates of the points from an index on.
    fn points_from<'py>(&self, py: Python<'py>, first: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let this = self.0.read(py)?;
        let points = this.made().points().get(first..).unwrap_or_default();
        PyArray1::from_slice(py, points.as_flattened()).reshape([points.len(), 2])
    }

    #[getter]
    fn point_count(&self, py: Python<'_>) -> PyResult<usize> {
        let this = self.0.read(py)?;
        Ok(this.made().points().len())
    }

    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<(Rows<'py>, Rows<'py>)> {
        let this = self.0.read(py)?;
        this.state.arrays(py)
    }

    /// Whether the edge across from each corner is a constraint, a row for each triangle.
    fn sides<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<bool>>> {
        let this = self.0.read(py)?;
        let c = this.made();
        let of = |t: TriangleId| [1, 2, 0].map(|k| c.is_constraint(t.edge(k)));
        let sides: Vec<bool> = py.detach(|| c.triangle_ids().flat_map(of).collect());
        let count = sides.len() / 3;
        PyArray1::from_vec(py, sides).reshape([count, 3])
    }

    fn hull<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        let this = self.0.read(py)?;
        this.state.hull(py)
    }

    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        let this = self.0.read(py)?;
        this.state.edges(py)
    }

    fn duplicates<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        let this = self.0.read(py)?;
        this.state.duplicates(py)
    }

    #[getter]
    fn vertex_count(&self, py: Python<'_>) -> PyResult<usize> {
        let this = self.0.read(py)?;
        Ok(this.state.vertex_count())
    }

    #[getter]
    fn span(&self, py: Python<'_>) -> PyResult<i32> {
        let this = self.0.read(py)?;
        Ok(this.state.span())
    }

    /// The constraint edges, the lesser end first.
    fn constraints<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        let this = self.0.read(py)?;
        let edges: Vec<[VertexId; 2]> = py.detach(|| this.made().constraints().collect());
        table(py, 2, edges.into_iter())
    }

    /// The ends of all segments ever given, by id; -1 for those that are not there.
    fn segments<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        let this = self.0.read(py)?;
        let mut ends = vec![[-1; 2]; this.segment_ids];
        for (s, both) in this.made().segments() {
            ends[s.index()] = both.map(|v| v.index() as i32);
        }
        PyArray1::from_vec(py, ends.into_flattened()).reshape([this.segment_ids, 2])
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
        let this = self.0.read(py)?;
        let found = this.made().chain(SegmentId::new(segment));
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
        let this = self.0.read(py)?;
        let (holes, regions): (Vec<[f64; 2]>, Vec<[f64; 2]>) = (coordinates(&holes)?, coordinates(&regions)?);
        let c = this.made();
        let (of, domains) = py.detach(|| {
            let seed = |at| RegionSeed2 { at, attribute: 0.0, max_area: None };
            let regions = regions.into_iter().map(seed).collect();
            let seeds = Seeds2 { holes, regions, keep_concavities };
            let fill = match fill {
                "all" => Fill::All,
                "even-odd" => Fill::EvenOdd,
                "nonzero" => Fill::NonZero,
                "seeds" => Fill::Seeds(&seeds),
                other => return Err(PyValueError::new_err(format!("no such fill: {other}"))),
            };
            let domains = c.domains(&fill).map_err(python_error)?;
            let part = |t| domains.part(t).map_or(-1, |part| part as i32);
            Ok((c.triangle_ids().map(part).collect::<Vec<i32>>(), domains))
        })?;
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
        let this = self.0.read(py)?;
        let (queries, names): (Vec<[f64; 2]>, _) = (coordinates(&queries)?, names.as_slice()?);
        let c = this.made();
        let rows = py.detach(|| this.state.rows());
        let name =
            |t: TriangleId| usize::try_from(rows[t.index()]).ok().and_then(|row| names.get(row).copied());
        let counts = |t: TriangleId| name(t).filter(|&name| name >= 0);
        let answer = |q: [f64; 2]| {
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
        Ok(PyArray1::from_vec(py, this.state.answers(py, &queries, answer)?))
    }

    fn nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let this = self.0.read(py)?;
        Ok(PyArray1::from_vec(py, this.state.nearest(py, coordinates(&queries)?)?))
    }

    fn k_nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
        k: usize,
    ) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let this = self.0.read(py)?;
        let count = queries.shape()[0];
        PyArray1::from_vec(py, this.state.k_nearest(py, coordinates(&queries)?, k)?).reshape([count, k])
    }

    /// For each pair of vertices the first constraint between them; -1 for none.
    fn first_constraints<'py>(
        &self,
        py: Python<'py>,
        lines: PyReadonlyArray2<'py, i64>,
    ) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let this = self.0.read(py)?;
        let lines = pairs(&lines)?;
        let c = this.made();
        let first = |&[a, b]: &[i64; 2]| {
            let met = c.first_constraint(vertex(a)?, vertex(b)?).map_err(python_error)?;
            let ends = met.map(|e| [c.mesh().origin(e), c.mesh().destination(e)]);
            Ok(ends.map_or([-1; 2], |ends| ends.map(|v| v.index() as i64)))
        };
        let found: PyResult<Vec<[i64; 2]>> =
            detached(py, is_many(lines, SIGHTS), || shared(lines, SIGHTS, first));
        PyArray1::from_vec(py, found?.into_flattened()).reshape([lines.len(), 2])
    }

    /// Inserts points one after the other, all or none; the vertex of each.
    fn insert<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let mut this = self.0.write(py)?;
        let points: Vec<[f64; 2]> = coordinates(&points)?;
        TRIANGULATION.check(2, points.len())?;
        let (count, most) = (this.made().points().len() + points.len(), delone::MAX_POINTS);
        if count > most {
            return Err(python_error(delone::Error::TooManyPoints { count, most }));
        }
        let is_long = this.state.change(points.len());
        let c = &mut this.state.triangulation;
        let insert = |p| match c.insert(p)? {
            Inserted::New(v) | Inserted::Existing(v) => Ok(v.index() as i64),
        };
        let vertices =
            detached(py, is_long, || points.into_iter().map(insert).collect::<Result<Vec<_>, _>>());
        Ok(PyArray1::from_vec(py, vertices.map_err(python_error)?))
    }

    fn remove(&self, py: Python<'_>, point: i64, ends: &str) -> PyResult<()> {
        let mut this = self.0.write(py)?;
        let ends = match ends {
            "refuse" => SegmentEnds::Refuse,
            "join" => SegmentEnds::Join,
            "drop" => SegmentEnds::Drop,
            other => return Err(PyValueError::new_err(format!("no such choice of ends: {other}"))),
        };
        let v = vertex(point)?;
        this.changed(py, |c| c.remove_with(v, ends))
    }

    fn insert_segment(&self, py: Python<'_>, a: i64, b: i64) -> PyResult<usize> {
        let mut this = self.0.write(py)?;
        let (a, b) = (vertex(a)?, vertex(b)?);
        let id = this.changed(py, |c| c.insert_segment(a, b))?.index();
        this.segment_ids = this.segment_ids.max(id + 1);
        Ok(id)
    }

    fn remove_segment(&self, py: Python<'_>, segment: usize) -> PyResult<()> {
        let mut this = self.0.write(py)?;
        this.changed(py, |c| c.remove_segment(SegmentId::new(segment)))
    }

    fn check(&self, py: Python<'_>) -> PyResult<()> {
        let this = self.0.read(py)?;
        let checked = detached(py, this.made().vertex_count() >= FEW / 2, || this.made().check());
        checked.map_err(|flaw| PyRuntimeError::new_err(flaw.to_string()))
    }

    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        let this = self.0.read(py)?;
        let copied = Made { state: State::of(this.made().clone()), segment_ids: this.segment_ids };
        Ok(Self(Shared::new(copied)))
    }
}

impl Constrained {
    pub fn read(&self, py: Python<'_>) -> PyResult<RwLockReadGuard<'_, Made>> {
        self.0.read(py)
    }
}

impl Made {
    pub fn made(&self) -> &Constrained2 {
        &self.state.triangulation
    }

    /// Changes it, if it is large on the threads there are.
    fn changed<A: Send>(
        &mut self,
        py: Python<'_>,
        change: impl FnOnce(&mut Constrained2) -> Result<A, delone::Error> + Send,
    ) -> PyResult<A> {
        let is_long = self.state.change(1);
        detached(py, is_long, || change(&mut self.state.triangulation)).map_err(python_error)
    }
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
