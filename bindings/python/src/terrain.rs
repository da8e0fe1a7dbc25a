//! Heights at points of the plane: rasters, contours, and fewer points.

use std::collections::HashMap;

use delone::surface::{Border, Contours, Duplicates, Grid, Levels, Thinned, Thinning, Trim, rasterize};
use delone::{Ask, Bounds, Constrained2, Crossings, Error, Triangulation as Triangular, VertexId};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::constrained::{Constrained, SEGMENT, index, pairs};
use crate::errors::python_error;
use crate::interrupt::{interruptible, size_of_queries};
use crate::memory::{TRIANGULATION, room};
use crate::shared::Shared;
use crate::state::{State, table};
use crate::surface::interpolator;
use crate::triangulation::{Core, Given, Triangulation, coordinates};

/// Triangles of the plane of either kind.
#[derive(FromPyObject)]
pub enum Sheet<'py> {
    Delaunay(PyRef<'py, Triangulation>),
    Constrained(PyRef<'py, Constrained>),
}

type Column<'py, T> = Bound<'py, PyArray1<T>>;
type Points<'py> = Bound<'py, PyArray2<f64>>;
/// Values row by row; the centers of columns and of rows; the corner of the first cell and the steps.
type Painted<'py> = (Points<'py>, Column<'py, f64>, Column<'py, f64>, [f64; 2], [f64; 2]);
/// Levels, points of all lines, where each line begins and the last one ends, and whether they are closed.
type Lines<'py> = (Column<'py, f64>, Points<'py>, Column<'py, i64>, Column<'py, bool>);
/// Lower and upper levels; points of all rings; where rings begin among points, polygons among rings, bands among polygons.
type Bands<'py> = (Points<'py>, Points<'py>, Column<'py, i64>, Column<'py, i64>, Column<'py, i64>);

/// The longest edge that triangles may have, and whether longer ones go wherever they are, not from the hull inwards alone.
type Longest = Option<(f64, bool)>;

/// Which triangles count: those that a mask by row has, without long ones.
struct Keep<'a> {
    rows: &'a [i32],
    mask: Option<&'a [bool]>,
    trim: Option<Trim>,
}

impl<'a> Keep<'a> {
    fn of<T: Triangular>(d: &T, rows: &'a [i32], mask: Option<&'a [bool]>, longest: Longest) -> Self {
        let trim = longest.map(|(longest, is_anywhere)| {
            let border = Border::long_edges(Some(longest)).anywhere(is_anywhere);
            Trim::along_border(d, &border, |_| true)
        });
        Self { rows, mask, trim }
    }

    fn has<T: Triangular>(&self, d: &T, s: T::Simplex) -> bool {
        let index = d.index(s);
        let row = || usize::try_from(self.rows[index]).ok();
        let is_in = |mask: &[bool]| row().and_then(|row| mask.get(row).copied()).unwrap_or(false);
        self.mask.is_none_or(is_in) && self.trim.as_ref().is_none_or(|trim| trim.keeps(index))
    }
}

/// A raster of heights. `place` is the corner of the first cell and the steps, or with `cell`, for cells aligned to multiples of it, the
/// least and the largest coordinates; `size` is the number of columns and of rows then.
#[pyfunction]
#[pyo3(signature = (sheet, method, heights, place, size, cell=None, mask=None, longest=None))]
#[expect(clippy::too_many_arguments)]
pub fn paint<'py>(
    py: Python<'py>,
    sheet: Sheet<'py>,
    method: &str,
    heights: PyReadonlyArray1<'py, f64>,
    place: [f64; 4],
    size: [usize; 2],
    cell: Option<f64>,
    mask: Option<PyReadonlyArray1<'py, bool>>,
    longest: Longest,
) -> PyResult<Painted<'py>> {
    let [x0, y0, x1, y1] = place;
    let grid = match cell {
        Some(cell) => Grid::aligned(&Bounds { low: [x0, y0], high: [x1, y1] }, cell),
        None => Grid::new([x0, y0], [x1, y1], size[0], size[1]),
    };
    let grid = grid.map_err(python_error)?;
    let (columns, rows) = (grid.columns(), grid.rows());
    let numbers = columns.saturating_mul(rows).saturating_mul(2).saturating_add(heights.len());
    room(numbers.saturating_mul(8), "a raster of so many cells")?;
    let size = size_of_queries(columns * rows + heights.len(), 1);
    let (heights, mask) = (heights.to_vec()?, mask.map(|mask| mask.to_vec()).transpose()?);
    let values = match &sheet {
        Sheet::Delaunay(triangulation) => {
            let method = method.to_owned();
            State::asked(plane(triangulation)?, py, size, move |state, _| {
                let mut values = linear(state, &heights, &grid, mask.as_deref(), longest)?;
                if method != "linear" {
                    let f = interpolator(&state.triangulation, &method, "fill")?;
                    f.fill(&grid, &heights, &mut values).map_err(python_error)?;
                }
                Ok(values)
            })?
        }
        Sheet::Constrained(triangulation) => {
            State::asked(triangulation.shared(), py, size, move |state, _| {
                linear(state, &heights, &grid, mask.as_deref(), longest)
            })?
        }
    };
    let xs = PyArray1::from_iter(py, (0..columns).map(|k| grid.x(k)));
    let ys = PyArray1::from_iter(py, (0..rows).map(|k| grid.y(k)));
    let values = PyArray1::from_vec(py, values).reshape([rows, columns])?;
    Ok((values, xs, ys, grid.corner(), grid.step()))
}

fn linear<T: Ask<Point = [f64; 2]> + 'static, R: Send + Sync + 'static>(
    state: &State<T, R>,
    heights: &[f64],
    grid: &Grid,
    mask: Option<&[bool]>,
    longest: Longest,
) -> PyResult<Vec<f64>> {
    let d = &state.triangulation;
    let keep = Keep::of(d, state.rows(), mask, longest);
    rasterize(d, heights, grid, |s| keep.has(d, s)).map_err(python_error)
}

fn plane(triangulation: &Triangulation) -> PyResult<&Shared<State<delone::Delaunay2, Given>>> {
    match &triangulation.core {
        Core::Plane(held) => Ok(held),
        Core::Space(_) => Err(PyValueError::new_err("heights are at points of the plane, not of space")),
    }
}

/// The source of contours, and their levels.
#[derive(FromPyObject)]
pub struct Wanted {
    #[pyo3(item(0))]
    levels: Option<Vec<f64>>,
    #[pyo3(item(1))]
    interval: f64,
    #[pyo3(item(2))]
    base: f64,
    #[pyo3(item(3))]
    longest: Longest,
}

impl Wanted {
    /// How many levels there are, nearly.
    fn count(&self, heights: &[f64]) -> usize {
        let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        self.levels.as_ref().map_or(((high - low) / self.interval) as usize, Vec::len)
    }
}

/// Makes something of contours.
fn traced<R: Send + 'static>(
    py: Python<'_>,
    sheet: &Sheet<'_>,
    heights: &PyReadonlyArray1<'_, f64>,
    mask: Option<PyReadonlyArray1<'_, bool>>,
    wanted: Wanted,
    make: impl FnOnce(&Contours, &Levels) -> Result<R, Error> + Send + 'static,
) -> PyResult<R> {
    let (heights, mask) = (heights.to_vec()?, mask.map(|mask| mask.to_vec()).transpose()?);
    let size = size_of_queries(heights.len(), wanted.count(&heights).saturating_add(1));
    match sheet {
        Sheet::Delaunay(triangulation) => State::asked(plane(triangulation)?, py, size, move |state, _| {
            traced_of(state, &heights, mask.as_deref(), &wanted, make)
        }),
        Sheet::Constrained(triangulation) => {
            State::asked(triangulation.shared(), py, size, move |state, _| {
                traced_of(state, &heights, mask.as_deref(), &wanted, make)
            })
        }
    }
}

fn traced_of<T: Ask<Point = [f64; 2], Corners = [VertexId; 3]> + 'static, S: Send + Sync + 'static, R>(
    state: &State<T, S>,
    heights: &[f64],
    mask: Option<&[bool]>,
    wanted: &Wanted,
    make: impl FnOnce(&Contours, &Levels) -> Result<R, Error>,
) -> PyResult<R> {
    let d = &state.triangulation;
    let keep = Keep::of(d, state.rows(), mask, wanted.longest);
    let surface = Contours::of_triangles(d, heights, |s| keep.has(d, s)).map_err(python_error)?;
    let levels = match &wanted.levels {
        Some(levels) => Levels::given(levels),
        None => Levels::every(wanted.interval, wanted.base, surface.range().unwrap_or([wanted.base; 2])),
    };
    make(&surface, &levels.map_err(python_error)?).map_err(python_error)
}

#[pyfunction]
#[pyo3(signature = (sheet, heights, wanted, mask=None))]
pub fn contour_lines<'py>(
    py: Python<'py>,
    sheet: Sheet<'py>,
    heights: PyReadonlyArray1<'py, f64>,
    wanted: Wanted,
    mask: Option<PyReadonlyArray1<'py, bool>>,
) -> PyResult<Lines<'py>> {
    let (levels, points, starts, closed) = traced(py, &sheet, &heights, mask, wanted, |surface, levels| {
        let lines = surface.lines(levels)?;
        let (mut points, mut starts) = (Vec::new(), vec![0]);
        for line in &lines {
            points.extend_from_slice(&line.points);
            starts.push(points.len() as i64);
        }
        let levels = lines.iter().map(|line| line.level).collect();
        let closed = lines.iter().map(|line| line.is_closed).collect();
        Ok((levels, points.into_flattened(), starts, closed))
    })?;
    Ok((
        PyArray1::from_vec(py, levels),
        table(py, 2, points)?,
        PyArray1::from_vec(py, starts),
        PyArray1::from_vec(py, closed),
    ))
}

#[pyfunction]
#[pyo3(signature = (sheet, heights, wanted, mask=None))]
pub fn contour_bands<'py>(
    py: Python<'py>,
    sheet: Sheet<'py>,
    heights: PyReadonlyArray1<'py, f64>,
    wanted: Wanted,
    mask: Option<PyReadonlyArray1<'py, bool>>,
) -> PyResult<Bands<'py>> {
    let (between, points, starts) = traced(py, &sheet, &heights, mask, wanted, |surface, levels| {
        let found = surface.bands(levels)?;
        let (mut points, mut rings, mut polygons, mut bands) = (Vec::new(), vec![0], vec![0], vec![0]);
        for band in &found {
            for polygon in &band.polygons {
                for ring in polygon {
                    points.extend_from_slice(ring);
                    rings.push(points.len() as i64);
                }
                polygons.push(rings.len() as i64 - 1);
            }
            bands.push(polygons.len() as i64 - 1);
        }
        let between = found.iter().flat_map(|band| [band.lower, band.upper]).collect();
        Ok((between, points.into_flattened(), [rings, polygons, bands]))
    })?;
    let [rings, polygons, bands] = starts.map(|starts| PyArray1::from_vec(py, starts));
    Ok((table(py, 2, between)?, table(py, 2, points)?, rings, polygons, bands))
}

/// The rule for places at which there are several points, by its name.
pub fn rule_of(name: &str) -> PyResult<Duplicates> {
    match name {
        "lowest" => Ok(Duplicates::Lowest),
        "first" => Ok(Duplicates::First),
        "highest" => Ok(Duplicates::Highest),
        "mean" => Ok(Duplicates::Mean),
        other => Err(PyValueError::new_err(format!("there is no rule {other:?}"))),
    }
}

/// Heights after a rule for places at which there are several points: pairs of a point and the vertex that it equals.
#[pyfunction]
pub fn settled<'py>(
    py: Python<'py>,
    heights: PyReadonlyArray1<'py, f64>,
    pairs: PyReadonlyArray2<'py, i32>,
    rule: &str,
) -> PyResult<Column<'py, f64>> {
    let rule = rule_of(rule)?;
    let mut heights = heights.to_vec()?;
    let pairs = pairs.to_vec()?;
    let index = |i: i32| usize::try_from(i).ok().filter(|&i| i < heights.len());
    let pairs: Option<Vec<(usize, usize)>> =
        pairs.as_chunks().0.iter().map(|&[point, vertex]| index(point).zip(index(vertex))).collect();
    let pairs = pairs.ok_or_else(|| PyValueError::new_err("pairs of points that there are not"))?;
    rule.settle(&mut heights, pairs);
    Ok(PyArray1::from_vec(py, heights))
}

/// The points that are left, their triangles by their rows, and the largest error.
type Thin<'py> = (Column<'py, i64>, Bound<'py, PyArray2<i32>>, f64);

#[pyfunction]
pub fn thin<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    heights: PyReadonlyArray1<'py, f64>,
    segments: PyReadonlyArray2<'py, i64>,
    max_error: f64,
    max_points: Option<usize>,
) -> PyResult<Thin<'py>> {
    let (points, heights): (Vec<[f64; 2]>, _) = (coordinates(&points)?, heights.to_vec()?);
    let segments: Vec<[usize; 2]> = pairs(&segments)?.iter().map(|ends| ends.map(index)).collect();
    TRIANGULATION.check_with(2, points.len(), segments.len().saturating_mul(SEGMENT))?;
    let thinning = Thinning::new().max_error(max_error).max_points(max_points.unwrap_or(usize::MAX));
    let done = interruptible(py, points.len(), move || {
        let thinned = thinning.points(&points, &heights, &segments)?;
        let triangles = triangles(&points, &segments, &thinned)?;
        Ok::<_, Error>((thinned, triangles))
    })?;
    let (thinned, triangles) = done.map_err(python_error)?;
    let vertices = PyArray1::from_iter(py, thinned.vertices.iter().map(|&i| i as i64));
    Ok((vertices, table(py, 3, triangles.into_flattened())?, thinned.error))
}

/// The canonical triangles of what is left, as the others were measured against.
fn triangles(
    points: &[[f64; 2]],
    segments: &[[usize; 2]],
    thinned: &Thinned,
) -> Result<Vec<[i32; 3]>, Error> {
    let left: Vec<[f64; 2]> = thinned.vertices.iter().map(|&i| points[i]).collect();
    // An end may equal the point that is left in its place. Zeros have no sign there.
    let name = |p: [f64; 2]| p.map(|x| (x + 0.0).to_bits());
    let mut rows = HashMap::new();
    for (row, &p) in left.iter().enumerate() {
        rows.entry(name(p)).or_insert(row);
    }
    let row = |i: usize| rows.get(&name(points[i])).copied().unwrap_or(usize::MAX);
    let segments: Vec<[usize; 2]> = segments.iter().map(|ends| ends.map(row)).collect();
    let c = Constrained2::with_crossings(&left, &segments, Crossings::Refuse)?;
    let number = |v: VertexId| v.index() as i32;
    Ok(c.triangle_ids().map(|t| c.mesh().corners(t).map(number)).collect())
}
