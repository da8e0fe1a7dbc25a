//! A refined mesh: what is wanted of it, its arrays, and its refinement again.

use std::sync::Arc;

use delone::{
    Ask as _, Constrained2, Crossings, Domains2, Error, Fill, Keep, Layers2, Reason, Refined2, Refinement,
    RegionSeed2, Seeds2, SegmentId, Shapes2, TriangleId, Triangulation as _,
};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyMemoryError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use crate::constrained::{Constrained, SEGMENT, index, pairs, work};
use crate::errors::python_error;
use crate::interrupt::{LONG, interruptible, while_wanted};
use crate::memory::TRIANGULATION;
use crate::sizes::{Asked, Field};
use crate::state::table;
use crate::triangulation::coordinates;

/// Coordinates or indices, a row each.
type Table<'py, T> = Bound<'py, PyArray2<T>>;

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
}

/// Boundary layers: the first height, the number of rows, growth, thickness, and segments by index.
type LayerWish = (f64, usize, f64, Option<f64>, Option<Vec<usize>>);

/// The rule for the inside, and the criteria of the mesh.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Wishes<'py> {
    fill: String,
    holes: PyReadonlyArray2<'py, f64>,
    /// Places and largest areas, which may be infinite.
    regions: PyReadonlyArray2<'py, f64>,
    keep_concavities: bool,
    min_angle: f64,
    max_area: Option<f64>,
    max_edge: Option<f64>,
    edge: Option<f64>,
    growth: f64,
    max_vertices: Option<usize>,
    keep: String,
    conforming: bool,
    smooth: usize,
    /// A function, or a length for each point.
    size: Option<Bound<'py, PyAny>>,
    /// An area for each triangle of a mesh: of the one that is refined again, or else of this one.
    max_areas: Option<PyReadonlyArray1<'py, f64>>,
    layers: Option<LayerWish>,
    of: Option<Bound<'py, Constrained>>,
}

/// The plan without Python objects.
#[derive(Clone)]
struct Plan {
    fill: String,
    seeds: Seeds2,
    min_angle: f64,
    max_area: Option<f64>,
    max_edge: Option<f64>,
    edge: Option<f64>,
    growth: f64,
    max_vertices: Option<usize>,
    keep: Keep,
    conforming: bool,
    smooth: usize,
    layers: Option<Layers2>,
}

/// Why there is no mesh.
enum Failed {
    Error(Error),
    /// It would have so many vertices at least.
    Memory(usize),
}

impl From<Error> for Failed {
    fn from(error: Error) -> Self {
        Self::Error(error)
    }
}

impl From<Failed> for PyErr {
    fn from(failed: Failed) -> Self {
        match failed {
            Failed::Error(error) => python_error(error),
            Failed::Memory(vertices) => PyMemoryError::new_err(format!(
                "the areas and lengths that are wanted need at least {vertices} vertices, and there is no room for them"
            )),
        }
    }
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
        Self::refined(py, (built, None), given, areas, wishes)
    }

    /// Refines what is inside again; a new one.
    fn again(&self, py: Python<'_>, wishes: Wishes<'_>) -> PyResult<Self> {
        let this = Arc::clone(&self.0);
        let areas = wishes.areas(py, move || (this.made.clone(), this.inside.clone()))?;
        let made = self.of(py, |this| (this.made.clone(), Some(this.refined.domains.clone())))?;
        Self::refined(py, made, self.0.given, areas, wishes)
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
            let row = |next: Option<TriangleId>| next.map_or(-1, |t| this.rows[t.index()]);
            let corners: Vec<i64> = this.inside.iter().flat_map(|&t| of(t)).collect();
            let beside = |&t: &TriangleId| [0, 1, 2].map(|k| row(c.across(t, k)));
            (corners, this.inside.iter().flat_map(beside).collect::<Vec<i64>>())
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
            let c = &this.made;
            let inside = |t: TriangleId| this.rows.get(t.index()).is_some_and(|&row| row >= 0);
            let (mut ends, mut origins) = (Vec::new(), Vec::new());
            for e in c.constraint_edges() {
                let sides = [e, c.mesh().twin(e)].map(|e| e.triangle());
                if !sides.iter().any(|&t| inside(t)) {
                    continue;
                }
                let first = c.covering(e).into_iter().min().filter(|on| on.segment.index() < this.given);
                // Lines and ribs of boundary layers are segments of their own.
                let is_of_layers = sides.iter().any(|&t| this.refined.domains.is_layer(t));
                if first.is_none() && is_of_layers && sides.iter().all(|&t| inside(t)) {
                    continue;
                }
                let mut pair = [c.mesh().origin(e), c.mesh().destination(e)].map(|v| v.index() as i64);
                if first.is_some_and(|on| !on.is_forward) {
                    pair.reverse();
                }
                ends.extend(pair);
                origins.push(first.map_or(-1, |on| on.segment.index() as i64));
            }
            (ends, origins)
        })?;
        Ok((table(py, 2, ends)?, PyArray1::from_vec(py, origins)))
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

    /// Refines what was built, under Python's lock only where Python is asked. What is inside is known, or wished.
    fn refined(
        py: Python<'_>,
        from: (Constrained2, Option<Domains2>),
        given: usize,
        areas: Option<Field>,
        wishes: Wishes<'_>,
    ) -> PyResult<Self> {
        let (plan, size) = wishes.plan()?;
        let values = match size {
            Some(function) if function.is_callable() => {
                let asked = Asked::new(function);
                let areas = areas.unwrap_or(Field::Everywhere);
                let at = |at| asked.length(at);
                let done = plan.refine(from, given, Some(&at), &areas, &|| asked.has_failed());
                asked.end()?;
                return Ok(done?);
            }
            Some(values) => Some(values.extract::<PyReadonlyArray1<f64>>()?.as_slice()?.to_vec()),
            None => None,
        };
        let done = while_wanted(py, LONG, move |wanted| {
            let lengths = match values {
                Some(values) => Field::lengths(from.0.points()[..values.len()].to_vec(), values)?,
                None => Field::Everywhere,
            };
            let areas = areas.unwrap_or(Field::Everywhere);
            let length = |at| lengths.length(at);
            plan.refine(from, given, lengths.is_asked().then_some(&length as _), &areas, &|| !wanted.is())
        });
        Ok(done??)
    }
}

impl<'py> Wishes<'py> {
    /// Areas of triangles, by a mesh and the triangles of it that they are in order.
    fn areas(
        &self,
        py: Python<'_>,
        mesh: impl FnOnce() -> (Constrained2, Vec<TriangleId>) + Send + 'static,
    ) -> PyResult<Option<Field>> {
        let Some(areas) = &self.max_areas else { return Ok(None) };
        let areas = areas.to_vec()?;
        interruptible(py, areas.len(), move || {
            let (mesh, triangles) = mesh();
            if areas.len() != triangles.len() {
                let (areas, count) = (areas.len(), triangles.len());
                return Err(PyValueError::new_err(format!("{areas} areas for {count} triangles")));
            }
            let mut by_slot = vec![f64::INFINITY; mesh.slot_count()];
            triangles.iter().zip(areas).for_each(|(t, area)| by_slot[t.index()] = area);
            Ok(Some(Field::areas(mesh, by_slot)))
        })?
    }

    /// Separates the plain options from the rest.
    fn plan(self) -> PyResult<(Plan, Option<Bound<'py, PyAny>>)> {
        let region = |row: &[f64]| RegionSeed2::new([row[0], row[1]]).max_area(row[2]);
        if self.regions.shape()[1] != 3 {
            return Err(PyValueError::new_err("regions are rows of three numbers"));
        }
        let seeds = Seeds2::default()
            .holes(coordinates(&self.holes)?)
            .regions(self.regions.as_slice()?.chunks_exact(3).map(region).collect())
            .keep_concavities(self.keep_concavities);
        let keep = match self.keep.as_str() {
            "nothing" => Keep::Nothing,
            "border" => Keep::Border,
            "constraints" => Keep::Constraints,
            other => return Err(PyValueError::new_err(format!("nothing to keep is called {other}"))),
        };
        let Self { fill, min_angle, max_area, max_edge, edge, growth, max_vertices, .. } = self;
        let layers = self.layers.map(|(height, count, growth, thickness, segments)| {
            let mut layers = Layers2::new(height, count).growth(growth);
            layers.thickness = thickness;
            layers.segments = segments.map(|all| all.into_iter().map(SegmentId::new).collect());
            layers
        });
        let Self { conforming, smooth, .. } = self;
        let plan = Plan {
            fill,
            seeds,
            min_angle,
            max_area,
            max_edge,
            edge,
            growth,
            max_vertices,
            keep,
            conforming,
            smooth,
            layers,
        };
        Ok((plan, self.size))
    }
}

impl Plan {
    fn refine(
        &self,
        (mut made, known): (Constrained2, Option<Domains2>),
        given: usize,
        length: Option<&dyn Fn([f64; 2]) -> f64>,
        areas: &Field,
        stop: &dyn Fn() -> bool,
    ) -> Result<Mesh, Failed> {
        let fill = match (&known, self.fill.as_str()) {
            (Some(known), _) => Fill::Parts(known),
            (None, "even-odd") => Fill::EvenOdd,
            (None, "nonzero") => Fill::NonZero,
            (None, "seeds") => Fill::Seeds(&self.seeds),
            (None, _) => Fill::All,
        };
        self.make_room(&made, &fill)?;
        let area = |at| areas.area(at);
        let mut wanted = Refinement::new()
            .min_angle(self.min_angle)
            .keep(self.keep)
            .conforming(self.conforming)
            .fill(fill)
            .smooth(self.smooth)
            .stop_if(stop);
        if let Some(length) = length {
            wanted = if self.edge.is_some() { wanted.edge_at(length) } else { wanted.size(length) };
        }
        if areas.is_asked() {
            wanted = wanted.max_area_at(&area);
        }
        if let Some(area) = self.max_area {
            wanted = wanted.max_area(area);
        }
        if let Some(length) = self.max_edge {
            wanted = wanted.max_edge(length);
        }
        if let Some(length) = self.edge {
            wanted = wanted.edge(length).growth(self.growth);
        }
        if let Some(count) = self.max_vertices {
            wanted = wanted.max_vertices(count);
        }
        if let Some(layers) = &self.layers {
            wanted = wanted.layers(layers);
        }
        let refined = wanted.run(&mut made)?;
        let inside: Vec<TriangleId> = made.triangle_ids().filter(|&t| refined.domains.is_inside(t)).collect();
        let mut rows = vec![-1; made.slot_count()];
        inside.iter().zip(0..).for_each(|(t, row)| rows[t.index()] = row);
        Ok(Mesh(Arc::new(Content { made, refined, rows, inside, given })))
    }

    /// Whether there is memory for as many triangles as bounds for all places ask for at least.
    fn make_room(&self, made: &Constrained2, fill: &Fill) -> Result<(), Failed> {
        // Of triangles with short edges the equilateral one is largest.
        let length = [self.max_edge, self.edge].into_iter().flatten().fold(f64::INFINITY, f64::min);
        let of_edge = length * length * 0.75f64.sqrt() / 2.0;
        let largest = self.max_area.unwrap_or(f64::INFINITY).min(of_edge);
        if largest.is_infinite() {
            return Ok(());
        }
        let domains = made.domains(fill)?;
        let inside = made.triangle_ids().filter(|&t| domains.is_inside(t));
        let area: f64 = inside.map(|t| made.area(t)).fold(0.0, |sum, area| sum + area);
        if area == 0.0 {
            return Ok(());
        }
        let least = ((area / largest / 2.0) as usize).min(self.max_vertices.unwrap_or(usize::MAX));
        if least < delone::MAX_POINTS && TRIANGULATION.check(2, least).is_ok() {
            return Ok(());
        }
        Err(Failed::Memory(least))
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
        other => other.text(),
    }
}
