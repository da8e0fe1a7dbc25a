//! A refined mesh: what is wanted of it, its arrays, and its refinement again.

pub mod arcs;
mod like_triangle;
mod plan;

use std::sync::Arc;

use delone::{
    AllQuads2, Ask as _, Constrained2, Crossings, Domains2, EdgeId, Gap2, Quads2, Reason, Refined2,
    SegmentId, Shapes2, TriangleId, Triangulation as _, VertexId,
};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::constrained::{SEGMENT, index, pairs, work};
use crate::errors::python_error;
use crate::interrupt::{LONG, interruptible, while_wanted};
use crate::memory::TRIANGULATION;
use crate::sizes::{Asked, Field};
use crate::state::table;
use crate::triangulation::coordinates;
use arcs::{Arcs, arcs_of};
use like_triangle::{Given, Switches};
use plan::{Said, Wishes};

/// Coordinates or indices, a row each.
type Table<'py, T> = Bound<'py, PyArray2<T>>;

/// Two tables and a list.
type Quads<'py> = (Table<'py, i64>, Table<'py, i64>, Bound<'py, PyArray1<i64>>);

/// Points, corners, rows of triangles, the ends of the edge of each middle, the number of the first middle, and what is not convex.
type AllQuads<'py> = (
    Table<'py, f64>,
    Table<'py, i64>,
    Bound<'py, PyArray1<i64>>,
    Table<'py, i64>,
    usize,
    Bound<'py, PyArray1<i64>>,
);

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", frozen)]
pub struct Mesh(Arc<Content>);

/// The content, shared with work in the background.
struct Content {
    made: Constrained2,
    refined: Refined2,
    /// The rows of triangles: those inside, by their slots; -1 for all else.
    rows: Vec<i64>,
    inside: Vec<TriangleId>,
    /// Segments that were given; the border of a hull gets ids beyond.
    given: usize,
    arcs: Arcs,
    /// A gap of the input that is too narrow to be meant.
    gap: Option<Gap2>,
}

#[pymethods]
impl Mesh {
    /// Of points and segments.
    #[new]
    fn new(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        segments: PyReadonlyArray2<'_, i64>,
        split: bool,
        wishes: Wishes<'_>,
    ) -> PyResult<Self> {
        let points: Vec<[f64; 2]> = coordinates(&points)?;
        let segments: Vec<[usize; 2]> = pairs(&segments)?.iter().map(|ends| ends.map(index)).collect();
        let given = segments.len();
        TRIANGULATION.check_with(2, points.len(), given.saturating_mul(SEGMENT))?;
        let size = work(points.len(), given, split);
        let how = if split { Crossings::Split } else { Crossings::Refuse };
        let built = interruptible(py, size, move || Constrained2::with_crossings(&points, &segments, how))?;
        let built = built.map_err(python_error)?;
        let areas = match &wishes.of {
            Some(old) => {
                let old = old.get().shared().read(py)?;
                wishes.areas(py, move || {
                    let triangles = old.made().triangle_ids().collect();
                    (old.made().clone(), triangles)
                })?
            }
            None => None,
        };
        let arcs = arcs_of(wishes.arcs.as_ref())?;
        Self::refined(py, (built, None), (given, arcs), areas, wishes)
    }

    /// Refines what is inside again; a new one.
    fn again(&self, py: Python<'_>, wishes: Wishes<'_>) -> PyResult<Self> {
        let this = Arc::clone(&self.0);
        let areas = wishes.areas(py, move || (this.made.clone(), this.inside.clone()))?;
        let made = self.of(py, |this| (this.made.clone(), Some(this.refined.domains.clone())))?;
        Self::refined(py, made, (self.0.given, self.0.arcs.clone()), areas, wishes)
    }

    /// Takes vertices away where all triangles around are marked; a new one.
    fn coarser(&self, py: Python<'_>, marked: PyReadonlyArray1<'_, bool>, min_angle: f64) -> PyResult<Self> {
        let marked = marked.to_vec()?;
        let made = self.of(py, move |this| {
            let is_marked = |t: TriangleId| {
                usize::try_from(this.rows[t.index()])
                    .is_ok_and(|row| marked.get(row).copied().unwrap_or(false))
            };
            let mut made = this.made.clone();
            let refined = this.refined.coarsen(&mut made, &is_marked, min_angle)?;
            Ok(Self::content(made, refined, (this.given, this.arcs.clone()), None))
        })?;
        made.map_err(python_error)
    }

    /// The coordinates of all points.
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Table<'py, f64>> {
        table(py, 2, self.of(py, |this| this.made.points().as_flattened().to_vec())?)
    }

    /// The corners and neighbors of the triangles inside.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<(Table<'py, i64>, Table<'py, i64>)> {
        let (corners, neighbors) = self.of(py, |this| {
            let c = &this.made;
            let of = |t: TriangleId| c.corners(t).map(|v| v.index() as i64);
            let corners: Vec<i64> = this.inside.iter().flat_map(|&t| of(t)).collect();
            (corners, this.neighbors().flatten().collect::<Vec<i64>>())
        })?;
        Ok((table(py, 3, corners)?, table(py, 3, neighbors)?))
    }

    /// The rows of the triangles inside that hold places, or -1.
    fn rows_at<'py>(
        &self,
        py: Python<'py>,
        places: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let places: Vec<[f64; 2]> = coordinates(&places)?;
        let rows = self.of(py, move |this| {
            let holding = |&at: &[f64; 2]| this.made.find(at).ok().and_then(|found| found.simplex);
            let row = |t: TriangleId| this.rows.get(t.index()).copied();
            places.iter().map(|at| holding(at).and_then(row).unwrap_or(-1)).collect::<Vec<i64>>()
        })?;
        Ok(PyArray1::from_vec(py, rows))
    }

    /// The region of each triangle inside, or -1.
    fn regions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let regions = self.of(py, |this| {
            let of = |&t: &TriangleId| this.refined.domains.region(t).map_or(-1, |region| region as i64);
            this.inside.iter().map(of).collect()
        })?;
        Ok(PyArray1::from_vec(py, regions))
    }

    /// Constraint edges beside triangles inside: their ends, and the first segment on each or -1.
    fn segments<'py>(&self, py: Python<'py>) -> PyResult<(Table<'py, i64>, Bound<'py, PyArray1<i64>>)> {
        let (ends, origins) = self.of(py, |this| {
            let (mut ends, mut origins) = (Vec::new(), Vec::new());
            for side in this.sides() {
                ends.extend(side.ends.map(|v| v as i64));
                origins.push(side.origin);
            }
            (ends, origins)
        })?;
        Ok((table(py, 2, ends)?, PyArray1::from_vec(py, origins)))
    }

    /// The arrays that switches of the package `triangle` want, by its keys: of markers of vertices and segments that were given,
    /// the segments that those of this mesh were, and attributes of its vertices.
    #[pyo3(signature = (switches, vertex_markers, segments, segment_markers, origins, attributes))]
    #[expect(clippy::too_many_arguments, reason = "each is an array")]
    fn like_triangle<'py>(
        &self,
        py: Python<'py>,
        switches: Switches,
        vertex_markers: PyReadonlyArray1<'_, i64>,
        segments: PyReadonlyArray2<'_, i64>,
        segment_markers: PyReadonlyArray1<'_, i64>,
        origins: Option<PyReadonlyArray1<'_, i64>>,
        attributes: Option<PyReadonlyArray2<'_, f64>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let given = Given::new(
            self.0.made.points().len(),
            &vertex_markers,
            &segments,
            &segment_markers,
            origins,
            attributes,
        )?;
        let (tables, switches) =
            self.of(py, move |this| (like_triangle::tables(this, &given, &switches), switches))?;
        like_triangle::dictionary(py, tables, &switches)
    }

    /// Whether each triangle inside is of a boundary layer.
    fn layers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let flags =
            self.of(py, |this| this.inside.iter().map(|&t| this.refined.domains.is_layer(t)).collect())?;
        Ok(PyArray1::from_vec(py, flags))
    }

    /// Triangles and vertices of boundary layers, the most rows, places on segments, and those with fewer rows.
    #[getter]
    fn layer_counts(&self) -> [usize; 5] {
        let layers = &self.0.refined.report.layers;
        [layers.triangles, layers.vertices, layers.rows, layers.places, layers.shortened]
    }

    /// Vertices added inside and on constraints.
    #[getter]
    fn added(&self) -> (usize, usize) {
        let report = &self.0.refined.report;
        (report.inside, report.on_constraints)
    }

    /// The smallest and the largest angle, and how many triangles have a smallest angle, and how many angles there are, every
    /// ten degrees.
    #[getter]
    fn angles(&self) -> (f64, f64, Vec<usize>, Vec<usize>) {
        let report = &self.0.refined.report;
        (report.smallest_angle, report.largest_angle, report.smallest_angles.into(), report.angles.into())
    }

    /// The mean quality of triangles, the quality that 5 percent do not reach, and the step of areas that 5 percent exceed.
    fn shapes(&self, py: Python<'_>) -> PyResult<(f64, f64, f64)> {
        let shapes = self.of(py, |this| Shapes2::of(&this.made, &this.refined.domains))?;
        Ok((shapes.quality_mean, shapes.quality_p5, shapes.step_p95))
    }

    /// Corners of quadrilaterals, the rows of the two triangles of each, and the rows of those that are left.
    fn quads<'py>(&self, py: Python<'py>) -> PyResult<Quads<'py>> {
        let (corners, pairs, left) = self.of(py, |this| {
            let quads = Quads2::of(&this.made, &this.refined);
            let row = |t: &TriangleId| this.rows[t.index()];
            let corners: Vec<i64> = quads.corners.iter().flatten().map(|v| v.index() as i64).collect();
            let pairs: Vec<i64> = quads.pairs.iter().flatten().map(row).collect();
            (corners, pairs, quads.triangles.iter().map(row).collect())
        })?;
        Ok((table(py, 4, corners)?, table(py, 2, pairs)?, PyArray1::from_vec(py, left)))
    }

    /// The middles of arcs as nodes of elements of second order: the ends of edges, and places.
    fn arc_middles<'py>(&self, py: Python<'py>) -> PyResult<(Table<'py, i64>, Table<'py, f64>)> {
        let middles = self.of(py, |this| this.refined.arc_middles(&this.made, &this.arcs))?;
        let middles = middles.map_err(python_error)?;
        let ends = middles.iter().flat_map(|middle| middle.0).map(|v| v.index() as i64).collect();
        Ok((table(py, 2, ends)?, table(py, 2, middles.into_iter().flat_map(|middle| middle.1).collect())?))
    }

    /// Quadrilaterals alone, smoothed in rounds.
    fn all_quads<'py>(&self, py: Python<'py>, rounds: usize) -> PyResult<AllQuads<'py>> {
        let made = self.of(py, move |this| {
            let mut all = AllQuads2::of(&this.made, &Quads2::of(&this.made, &this.refined));
            all.bend(&this.refined.arc_middles(&this.made, &this.arcs)?);
            all.smooth(&this.made, &this.refined, rounds);
            let rows: Vec<i64> = all.triangles.iter().map(|t| this.rows[t.index()]).collect();
            Ok((all, rows))
        })?;
        let (all, rows) = made.map_err(python_error)?;
        let corners: Vec<i64> = all.corners.iter().flatten().map(|&i| i as i64).collect();
        let middles: Vec<i64> = all.middles.iter().flatten().map(|v| v.index() as i64).collect();
        let left: Vec<i64> = all.left.iter().map(|&row| row as i64).collect();
        Ok((
            table(py, 2, all.points.into_flattened())?,
            table(py, 4, corners)?,
            PyArray1::from_vec(py, rows),
            table(py, 2, middles)?,
            all.first,
            PyArray1::from_vec(py, left),
        ))
    }

    /// A gap that is too narrow to be meant: its width, a place, the segments on both sides, and the exponent of a tolerance.
    #[getter]
    fn gap(&self) -> Option<(f64, [f64; 2], [usize; 2], i32)> {
        let gap = self.0.gap?;
        Some((gap.width, gap.at, gap.segments.map(SegmentId::index), gap.exponent()))
    }

    /// The rows of triangles that are not as they were to be, and why.
    #[getter]
    fn left(&self) -> Vec<(i64, &'static str)> {
        let left = self.0.refined.report.left.iter();
        left.map(|left| (self.0.rows[left.triangle.index()], word(left.reason))).collect()
    }

    /// Proves that it is the canonical triangulation of its points and constraints.
    fn check(&self, py: Python<'_>) -> PyResult<()> {
        let checked = self.of(py, |this| this.made.check())?;
        checked.map_err(|flaw| PyRuntimeError::new_err(flaw.to_string()))
    }
}

impl Mesh {
    /// Runs work on all of it.
    fn of<A: Send + 'static>(
        &self,
        py: Python<'_>,
        make: impl FnOnce(&Content) -> A + Send + 'static,
    ) -> PyResult<A> {
        let this = Arc::clone(&self.0);
        interruptible(py, this.made.points().len(), move || make(&this))
    }

    /// With the rows of what is inside.
    fn content(
        made: Constrained2,
        refined: Refined2,
        (given, arcs): (usize, Arcs),
        gap: Option<Gap2>,
    ) -> Self {
        let inside: Vec<TriangleId> = made.triangle_ids().filter(|&t| refined.domains.is_inside(t)).collect();
        let mut rows = vec![-1; made.slot_count()];
        inside.iter().zip(0..).for_each(|(t, row)| rows[t.index()] = row);
        Self(Arc::new(Content { made, refined, rows, inside, given, arcs, gap }))
    }

    /// Refines what was built, under Python's lock only where Python is asked. What is inside is known, or wished.
    fn refined(
        py: Python<'_>,
        from: (Constrained2, Option<Domains2>),
        (given, arcs): (usize, Arcs),
        areas: Option<Field>,
        wishes: Wishes<'_>,
    ) -> PyResult<Self> {
        let (plan, size, refine_if) = wishes.plan()?;
        let areas = areas.unwrap_or(Field::Everywhere);
        let is_function = size.as_ref().is_some_and(Bound::is_callable);
        let values = match &size {
            Some(values) if !is_function => {
                Some(values.extract::<PyReadonlyArray1<f64>>()?.as_slice()?.to_vec())
            }
            _ => None,
        };
        let lengths = move |points: &[[f64; 2]]| match values {
            Some(values) => Field::lengths(points[..values.len()].to_vec(), values),
            None => Ok(Field::Everywhere),
        };
        if is_function || refine_if.is_some() {
            let asked = Asked::new(py);
            let lengths = lengths(from.0.points()).map_err(python_error)?;
            let length = |at| match &size {
                Some(function) if is_function => asked.length(function, at),
                _ => lengths.length(at),
            };
            let is_refused =
                |corners, area| refine_if.as_ref().is_some_and(|test| asked.test(test, corners, area));
            let said = Said {
                length: (is_function || lengths.is_asked()).then_some(&length),
                refine_if: refine_if.is_some().then_some(&is_refused),
                areas: &areas,
                stop: &|| asked.has_failed(),
            };
            let done = plan.refine(from, (given, arcs), &said);
            asked.end()?;
            return Ok(done?);
        }
        let is_short = plan.adds_nothing() && size.is_none() && !areas.is_asked();
        let items = if is_short { work(from.0.points().len(), given, false) } else { LONG };
        let done = while_wanted(py, items, move |wanted| {
            let lengths = lengths(from.0.points())?;
            let length = |at| lengths.length(at);
            let said = Said {
                length: lengths.is_asked().then_some(&length),
                refine_if: None,
                areas: &areas,
                stop: &|| !wanted.is(),
            };
            plan.refine(from, (given, arcs), &said)
        });
        Ok(done??)
    }
}

/// A constraint edge beside triangles inside.
struct Side {
    /// In the direction of the first segment on it.
    ends: [usize; 2],
    /// This segment, or -1.
    origin: i64,
    /// Whether triangles on the left and on the right are inside.
    is_inside: [bool; 2],
}

impl Side {
    /// Whether the mesh is on one side.
    fn is_border(&self) -> bool {
        self.is_inside[0] != self.is_inside[1]
    }

    /// The ends, on the border with the mesh on the right.
    fn with_mesh_on_right(&self) -> [usize; 2] {
        let [a, b] = self.ends;
        if self.is_inside == [true, false] { [b, a] } else { [a, b] }
    }
}

impl Content {
    /// An edge, if it is a constraint beside triangles inside and not there for other triangles' sake.
    fn side(&self, e: EdgeId) -> Option<Side> {
        let c = &self.made;
        let mut is_inside =
            [e, c.mesh().twin(e)].map(|e| self.rows.get(e.triangle().index()).is_some_and(|&row| row >= 0));
        if !c.is_constraint(e) || is_inside == [false; 2] || self.refined.only_keeps(c, e) {
            return None;
        }
        let first = c.covering(e).into_iter().min().filter(|on| on.segment.index() < self.given);
        let mut ends = [c.mesh().origin(e), c.mesh().destination(e)].map(VertexId::index);
        if first.is_some_and(|on| !on.is_forward) {
            ends.reverse();
            is_inside.reverse();
        }
        Some(Side { ends, origin: first.map_or(-1, |on| on.segment.index() as i64), is_inside })
    }

    fn sides(&self) -> impl Iterator<Item = Side> + '_ {
        self.made.constraint_edges().filter_map(|e| self.side(e))
    }

    /// The rows across from the corners of each triangle inside; -1 where nothing inside is.
    fn neighbors(&self) -> impl Iterator<Item = [i64; 3]> + '_ {
        let row = |next: Option<TriangleId>| next.map_or(-1, |t| self.rows[t.index()]);
        self.inside.iter().map(move |&t| [0, 1, 2].map(|k| row(self.made.across(t, k))))
    }
}

/// The name of a reason.
fn word(reason: Reason) -> &'static str {
    match reason {
        Reason::InputAngle => "input angle",
        Reason::Precision => "precision",
        Reason::Cascade => "cascade",
        Reason::Budget => "budget",
        Reason::Kept => "kept",
        Reason::Short => "short",
        other => other.text(),
    }
}
