//! The criteria of a mesh, with Python's objects and without them.

use delone::{
    Constrained2, Domains2, Error, Fill, Keep, Layers2, Refinement, RegionSeed2, Seeds2, SegmentId,
    TriangleId, Triangulation as _, VertexId,
};
use numpy::{PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyMemoryError, PyValueError};
use pyo3::prelude::*;

use super::Mesh;
use super::arcs::{ArcWish, Arcs};
use crate::constrained::{Constrained, index};
use crate::errors::python_error;
use crate::interrupt::interruptible;
use crate::memory::TRIANGULATION;
use crate::sizes::Field;
use crate::triangulation::coordinates;

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
    min_edge: f64,
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
    pub(super) of: Option<Bound<'py, Constrained>>,
    /// Corners of triangles that stay until a vertex comes near.
    triangles: Option<PyReadonlyArray2<'py, i64>>,
    /// Segments that are chords of arcs, and the centers of these.
    pub(super) arcs: Option<ArcWish<'py>>,
    /// A function of corners and area.
    refine_if: Option<Bound<'py, PyAny>>,
}

/// A function of Python, or an array, where there is one.
type Asking<'py> = Option<Bound<'py, PyAny>>;

/// The plan without Python objects.
#[derive(Clone)]
pub(super) struct Plan {
    fill: String,
    seeds: Seeds2,
    min_angle: f64,
    max_area: Option<f64>,
    max_edge: Option<f64>,
    min_edge: f64,
    edge: Option<f64>,
    growth: f64,
    max_vertices: Option<usize>,
    keep: Keep,
    conforming: bool,
    smooth: usize,
    triangles: Vec<[usize; 3]>,
    layers: Option<Layers2>,
}

/// Answers of Python, or of a field of numbers, by place.
pub(super) struct Said<'a> {
    pub(super) length: Option<&'a dyn Fn([f64; 2]) -> f64>,
    pub(super) refine_if: Option<&'a dyn Fn([[f64; 2]; 3], f64) -> bool>,
    pub(super) areas: &'a Field,
    pub(super) stop: &'a dyn Fn() -> bool,
}

/// Why there is no mesh.
pub(super) enum Failed {
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

impl<'py> Wishes<'py> {
    /// Areas of triangles, by a mesh and the triangles of it that they are in order.
    pub(super) fn areas(
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
    pub(super) fn plan(self) -> PyResult<(Plan, Asking<'py>, Asking<'py>)> {
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
        let triangles = match &self.triangles {
            Some(rows) => triples(rows)?,
            None => Vec::new(),
        };
        let Self { fill, min_angle, max_area, max_edge, min_edge, edge, growth, max_vertices, .. } = self;
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
            min_edge,
            edge,
            growth,
            max_vertices,
            keep,
            conforming,
            smooth,
            triangles,
            layers,
        };
        Ok((plan, self.size, self.refine_if))
    }
}

impl Plan {
    /// Whether it asks for no new vertices, so that the work is as long as its input.
    pub(super) fn adds_nothing(&self) -> bool {
        let bounds = [self.max_area, self.max_edge, self.edge];
        let are_bounded = self.seeds.regions.iter().any(|seed| seed.max_area.is_some_and(f64::is_finite));
        let is_bounded = are_bounded || bounds.iter().any(Option::is_some);
        self.min_angle <= 0.0 && !is_bounded && !self.conforming && self.smooth == 0 && self.layers.is_none()
    }

    pub(super) fn refine(
        &self,
        (mut made, known): (Constrained2, Option<Domains2>),
        (given, arcs): (usize, Arcs),
        said: &Said,
    ) -> Result<Mesh, Failed> {
        let Said { length, refine_if, areas, stop } = *said;
        let fill = match (&known, self.fill.as_str()) {
            (Some(known), _) => Fill::Parts(known),
            (None, "even-odd") => Fill::EvenOdd,
            (None, "nonzero") => Fill::NonZero,
            (None, "positive") => Fill::Positive,
            (None, "negative") => Fill::Negative,
            (None, "seeds") => Fill::Seeds(&self.seeds),
            (None, _) => Fill::All,
        };
        self.make_room(&made, &fill)?;
        let area = |at| areas.area(at);
        let first = first_of_equals(&made);
        let corner = |i: usize| first.get(i).copied().unwrap_or(VertexId::new(i));
        let triangles: Vec<[VertexId; 3]> =
            self.triangles.iter().map(|corners| corners.map(corner)).collect();
        let mut wanted = Refinement::new()
            .min_angle(self.min_angle)
            .keep(self.keep)
            .conforming(self.conforming)
            .fill(fill)
            .smooth(self.smooth)
            .min_edge(self.min_edge)
            .triangles(&triangles)
            .arcs(&arcs)
            .stop_if(stop);
        if let Some(test) = refine_if {
            wanted = wanted.refine_if(test);
        }
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
        // What is refined again was looked at.
        let gap = if self.min_angle > 0.0 && known.is_none() && triangles.is_empty() {
            made.tiny_gap(&made.domains(&fill)?)
        } else {
            None
        };
        let refined = wanted.run(&mut made)?;
        Ok(Mesh::content(made, refined, (given, arcs), gap))
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

/// For each point the vertex that it is, or that it repeats.
fn first_of_equals(made: &Constrained2) -> Vec<VertexId> {
    let mut first: Vec<VertexId> = (0..made.points().len()).map(VertexId::new).collect();
    made.duplicates().for_each(|duplicate| first[duplicate.point] = duplicate.vertex);
    first
}

/// Rows of three indices.
fn triples(rows: &PyReadonlyArray2<'_, i64>) -> PyResult<Vec<[usize; 3]>> {
    if rows.shape()[1] != 3 {
        return Err(PyValueError::new_err("triangles are rows of three indices"));
    }
    let (corners, _) = rows.as_slice()?.as_chunks::<3>();
    Ok(corners.iter().map(|corners| corners.map(index)).collect())
}
