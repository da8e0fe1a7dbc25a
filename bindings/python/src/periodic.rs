//! Periodic triangulations, and their cells, as arrays.

use std::sync::Arc;

use delone::{
    AcrossPeriodic, CellularKind, DecimalGrid, Error, Grid, Lattice, Periodic, Periodic2, Periodic3,
    PeriodicCell, PeriodicFace, PeriodicKind, PeriodicRegular2, PeriodicRegular3, VertexId,
};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyNotImplementedError, PyValueError};
use pyo3::prelude::*;

use crate::arrays::rows;
use crate::errors::python_error;
use crate::interrupt::interruptible;
use crate::memory::TRIANGULATION;
use crate::state::table;
use crate::triangulation::coordinates;

enum Kind {
    Plane(Arc<Periodic2>),
    Space(Arc<Periodic3>),
    WeightedPlane(Arc<PeriodicRegular2>),
    WeightedSpace(Arc<PeriodicRegular3>),
}

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", name = "Periodic", frozen)]
pub struct PyPeriodic(Kind);

/// Runs an expression for any kind.
macro_rules! each_kind {
    ($kind:expr, $t:ident => $body:expr) => {
        match &$kind {
            Kind::Plane($t) => $body,
            Kind::Space($t) => $body,
            Kind::WeightedPlane($t) => $body,
            Kind::WeightedSpace($t) => $body,
        }
    };
}

type Row<'py, T> = Bound<'py, PyArray1<T>>;
type Table<'py, T> = Bound<'py, PyArray2<T>>;

/// Corners, their offsets, neighbors, their offsets.
type Arrays<'py> = (Table<'py, i32>, Table<'py, i64>, Table<'py, i32>, Table<'py, i64>);

/// Volumes, areas, centroids; starts of sites among faces; of faces the sites beyond, offsets, areas and vectors. In the plane areas are
/// in the place of volumes, and lengths in that of areas.
type Cells<'py> = (
    (Row<'py, f64>, Row<'py, f64>, Table<'py, f64>),
    Row<'py, i64>,
    (Row<'py, i32>, Table<'py, i64>, Row<'py, f64>, Table<'py, f64>),
);

/// Corners, the ends of rings among them, and where rings of sites start.
type Polygons<'py> = (Table<'py, f64>, Row<'py, i64>, Row<'py, i64>);

/// Starts of sites among corners, and corners; starts of faces among the numbers of their corners, and these.
type Polyhedra<'py> = (Row<'py, i64>, Table<'py, f64>, Row<'py, i64>, Row<'py, i64>);

/// Decimals for zero, and a step for what is positive.
fn grid_of(step: Option<f64>) -> Result<Grid, Error> {
    Ok(match step {
        None => Grid::Binary,
        Some(0.0) => Grid::Auto,
        Some(step) => Grid::Decimal(DecimalGrid::with_step(step)?),
    })
}

fn lattice_of<const D: usize>(
    axes: &PyReadonlyArray2<'_, f64>,
    periodic: &[bool],
    origin: &[f64],
    step: Option<f64>,
) -> PyResult<Lattice<D>> {
    let axes: [[f64; D]; D] =
        rows::<_, D>(axes)?.try_into().map_err(|_| PyValueError::new_err("a square matrix"))?;
    let periodic = periodic.try_into().map_err(|_| PyValueError::new_err("a truth for each axis"))?;
    let origin = origin.try_into().map_err(|_| PyValueError::new_err("a coordinate for each axis"))?;
    let lattice = Lattice::with_axes(axes).map_err(python_error)?;
    Ok(lattice.periodic(periodic).origin(origin).grid(grid_of(step).map_err(python_error)?))
}

#[pymethods]
impl PyPeriodic {
    #[new]
    fn new(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        weights: Option<PyReadonlyArray1<'_, f64>>,
        axes: PyReadonlyArray2<'_, f64>,
        periodic: Vec<bool>,
        origin: Vec<f64>,
        step: Option<f64>,
    ) -> PyResult<Self> {
        let (count, columns) = (points.shape()[0], points.shape()[1]);
        TRIANGULATION.check(columns, count)?;
        let weights = weights.map(|weights| weights.to_vec()).transpose()?;
        Ok(Self(if columns == 2 {
            let (points, lattice) =
                (coordinates::<[f64; 2]>(&points)?, lattice_of(&axes, &periodic, &origin, step)?);
            match weights {
                None => Kind::Plane(built(py, count, move || Periodic2::from_points(&points, &lattice))?),
                Some(weights) => Kind::WeightedPlane(built(py, count, move || {
                    PeriodicRegular2::from_parts(&points, &weights, &lattice)
                })?),
            }
        } else {
            let (points, lattice) =
                (coordinates::<[f64; 3]>(&points)?, lattice_of(&axes, &periodic, &origin, step)?);
            match weights {
                None => Kind::Space(built(py, count, move || Periodic3::from_points(&points, &lattice))?),
                Some(weights) => Kind::WeightedSpace(built(py, count, move || {
                    PeriodicRegular3::from_parts(&points, &weights, &lattice)
                })?),
            }
        }))
    }

    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Arrays<'py>> {
        each_kind!(self.0, t => arrays(py, t))
    }

    fn edges<'py>(&self, py: Python<'py>) -> PyResult<(Table<'py, i32>, Table<'py, i64>)> {
        each_kind!(self.0, t => edges(py, t))
    }

    fn is_simplicial(&self, py: Python<'_>) -> PyResult<bool> {
        each_kind!(self.0, t => {
            let t = Arc::clone(t);
            interruptible(py, t.ids_given(), move || t.is_simplicial())
        })
    }

    /// Sites that equal a copy, the site of that, and its offset.
    fn duplicates<'py>(&self, py: Python<'py>) -> PyResult<(Table<'py, i32>, Table<'py, i64>)> {
        each_kind!(self.0, t => {
            let all = t.duplicates();
            let (pairs, offsets): (Vec<_>, Vec<_>) = all.map(|(v, (w, offset))| ([v, w].map(index), offset)).unzip();
            Ok((table(py, 2, pairs.into_flattened())?, offset_table(py, offsets)?))
        })
    }

    fn hidden<'py>(&self, py: Python<'py>) -> Row<'py, i32> {
        PyArray1::from_vec(py, each_kind!(self.0, t => t.hidden().map(index).collect()))
    }

    /// The largest rounding, the step of the decimal grid if there is one, and the dimension of the span.
    fn facts(&self) -> (f64, Option<f64>, i32) {
        each_kind!(self.0, t => (t.rounding(), t.decimal_step(), t.dimension() as i32 - 1))
    }

    #[expect(clippy::redundant_closure_for_method_calls, reason = "a method is for one lifetime")]
    fn cells<'py>(&self, py: Python<'py>) -> PyResult<Cells<'py>> {
        match &self.0 {
            Kind::Plane(t) => cells(py, t, |cell| cell.area(), |side| side.length()),
            Kind::WeightedPlane(t) => cells(py, t, |cell| cell.area(), |side| side.length()),
            Kind::Space(t) => cells(py, t, |cell| cell.volume(), |face| face.area()),
            Kind::WeightedSpace(t) => cells(py, t, |cell| cell.volume(), |face| face.area()),
        }
    }

    fn polyhedra<'py>(&self, py: Python<'py>) -> PyResult<Polyhedra<'py>> {
        match &self.0 {
            Kind::Space(t) => polyhedra(py, t),
            Kind::WeightedSpace(t) => polyhedra(py, t),
            Kind::Plane(_) | Kind::WeightedPlane(_) => {
                Err(PyNotImplementedError::new_err("polyhedra are cells of space: see polygons()"))
            }
        }
    }

    fn polygons<'py>(&self, py: Python<'py>) -> PyResult<Polygons<'py>> {
        match &self.0 {
            Kind::Plane(t) => polygons(py, t),
            Kind::WeightedPlane(t) => polygons(py, t),
            Kind::Space(_) | Kind::WeightedSpace(_) => {
                Err(PyNotImplementedError::new_err("polygons are cells of the plane: see polyhedra()"))
            }
        }
    }
}

fn offset_table<const D: usize>(py: Python<'_>, offsets: Vec<[i64; D]>) -> PyResult<Table<'_, i64>> {
    table(py, D, offsets.into_flattened())
}

fn index(v: VertexId) -> i32 {
    v.index() as i32
}

fn built<T: Send + Sync + 'static>(
    py: Python<'_>,
    count: usize,
    build: impl FnOnce() -> Result<T, Error> + Send + 'static,
) -> PyResult<Arc<T>> {
    Ok(Arc::new(interruptible(py, count, build)?.map_err(python_error)?))
}

fn arrays<'py, T: PeriodicKind<D, N> + 'static, const D: usize, const N: usize>(
    py: Python<'py>,
    t: &Arc<Periodic<T, D, N>>,
) -> PyResult<Arrays<'py>> {
    let t = Arc::clone(t);
    let (corners, offsets, neighbors, across) = interruptible(py, t.ids_given(), move || {
        let (mut corners, mut offsets, mut neighbors, mut across) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for number in 0..t.simplex_count() {
            for (site, offset) in t.simplex(number) {
                corners.push(index(site));
                offsets.extend(offset);
            }
            for neighbor in t.neighbors(number) {
                let (other, offset) = neighbor.map_or((-1, [0; D]), |(other, offset)| (other as i32, offset));
                neighbors.push(other);
                across.extend(offset);
            }
        }
        (corners, offsets, neighbors, across)
    })?;
    Ok((
        table(py, N, corners)?,
        table(py, N * D, offsets)?,
        table(py, N, neighbors)?,
        table(py, N * D, across)?,
    ))
}

fn edges<'py, T: PeriodicKind<D, N> + 'static, const D: usize, const N: usize>(
    py: Python<'py>,
    t: &Arc<Periodic<T, D, N>>,
) -> PyResult<(Table<'py, i32>, Table<'py, i64>)> {
    let t = Arc::clone(t);
    let (pairs, offsets): (Vec<[i32; 2]>, Vec<[i64; D]>) = interruptible(py, t.ids_given(), move || {
        t.edges().map(|(site, (other, offset))| ([site, other].map(index), offset)).unzip()
    })?;
    Ok((table(py, 2, pairs.into_flattened())?, table(py, D, offsets.into_flattened())?))
}

/// Cells by what is measured of them: their sizes, and those of their faces.
fn cells<'py, T: CellularKind<D, N> + 'static, const D: usize, const N: usize>(
    py: Python<'py>,
    t: &Arc<Periodic<T, D, N>>,
    size: fn(PeriodicCell<'_, T, D, N>) -> f64,
    face_size: fn(PeriodicFace<'_, T, D, N>) -> f64,
) -> PyResult<Cells<'py>> {
    struct Found<const D: usize> {
        sizes: Vec<f64>,
        surfaces: Vec<f64>,
        centroids: Vec<[f64; D]>,
        starts: Vec<i64>,
        beyond: Vec<i32>,
        offsets: Vec<[i64; D]>,
        face_sizes: Vec<f64>,
        vectors: Vec<[f64; D]>,
    }
    let t = Arc::clone(t);
    let found = interruptible(py, t.ids_given(), move || {
        let cells = t.cells()?;
        let mut found = Found {
            sizes: Vec::new(),
            surfaces: Vec::new(),
            centroids: Vec::new(),
            starts: vec![0],
            beyond: Vec::new(),
            offsets: Vec::new(),
            face_sizes: Vec::new(),
            vectors: Vec::new(),
        };
        for site in (0..t.ids_given()).map(VertexId::new) {
            let cell = cells.cell(site);
            let mut sum = 0.0;
            for face in cell.faces() {
                let size = face_size(face);
                sum += size;
                // Of some rounding has left nothing.
                if size > 0.0 {
                    let (beyond, offset) = match face.across() {
                        AcrossPeriodic::Site((other, offset)) => (index(other), offset),
                        // From -1 on: the beginning of the first axis, its end, and so on.
                        AcrossPeriodic::Wall { axis, is_end } => {
                            (-1 - 2 * axis as i32 - i32::from(is_end), [0; D])
                        }
                    };
                    found.beyond.push(beyond);
                    found.offsets.push(offset);
                    found.face_sizes.push(size);
                    found.vectors.push(face.vector().unwrap_or([f64::NAN; D]));
                }
            }
            found.surfaces.push(sum);
            found.sizes.push(size(cell));
            found.centroids.push(cell.centroid().unwrap_or([f64::NAN; D]));
            found.starts.push(found.beyond.len() as i64);
        }
        Ok(found)
    })?
    .map_err(python_error)?;
    let row = |values| PyArray1::from_vec(py, values);
    Ok((
        (row(found.sizes), row(found.surfaces), table(py, D, found.centroids.into_flattened())?),
        PyArray1::from_vec(py, found.starts),
        (
            PyArray1::from_vec(py, found.beyond),
            offset_table(py, found.offsets)?,
            row(found.face_sizes),
            table(py, D, found.vectors.into_flattened())?,
        ),
    ))
}

fn polygons<'py, T: CellularKind<2, 3> + 'static>(
    py: Python<'py>,
    t: &Arc<Periodic<T, 2, 3>>,
) -> PyResult<Polygons<'py>> {
    let t = Arc::clone(t);
    let (starts, ends, corners) = interruptible(py, t.ids_given(), move || {
        let cells = t.cells()?;
        let (mut starts, mut ends, mut corners) = (vec![0], vec![0], Vec::new());
        for site in (0..t.ids_given()).map(VertexId::new) {
            for ring in cells.cell(site).rings() {
                corners.extend(ring);
                ends.push(corners.len() as i64);
            }
            starts.push(ends.len() as i64 - 1);
        }
        Ok((starts, ends, corners))
    })?
    .map_err(python_error)?;
    let row = |values| PyArray1::from_vec(py, values);
    Ok((table(py, 2, corners.into_flattened())?, row(ends), row(starts)))
}

fn polyhedra<'py, T: CellularKind<3, 4> + 'static>(
    py: Python<'py>,
    t: &Arc<Periodic<T, 3, 4>>,
) -> PyResult<Polyhedra<'py>> {
    let t = Arc::clone(t);
    let (starts, corners, ends, numbers) = interruptible(py, t.ids_given(), move || {
        let cells = t.cells()?;
        let (mut starts, mut corners, mut ends, mut numbers) = (vec![0], Vec::new(), vec![0], Vec::new());
        for site in (0..t.ids_given()).map(VertexId::new) {
            let cell = cells.cell(site);
            corners.extend(cell.corners());
            starts.push(corners.len() as i64);
            for (ring, face) in cell.rings().iter().zip(cell.faces()) {
                if face.area() > 0.0 {
                    numbers.extend(ring.iter().map(|&i| i as i64));
                    ends.push(numbers.len() as i64);
                }
            }
        }
        Ok((starts, corners, ends, numbers))
    })?
    .map_err(python_error)?;
    let row = |values| PyArray1::from_vec(py, values);
    Ok((row(starts), table(py, 3, corners.into_flattened())?, row(ends), row(numbers)))
}
