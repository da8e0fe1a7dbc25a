//! Terrain models of arrays and of files, with lines and polygons beside, as arrays or as files: the library of the program.

use std::io::{Cursor, ErrorKind};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use delone::Bounds;
use delone::surface::Border;
use delone_io::{Cloud, Compression, Crs, Format, Graph, ReadOptions, TemporaryFolder, read_graph};
use delone_store::Build;
use delone_terrain::{
    Cells, Clip, Error, Files, Lines, Method, Options, Product, Remark, Terrain, Tiled, read_clip,
    read_lines, read_place, read_polygons,
};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyFileNotFoundError, PyOSError, PyPermissionError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::{LONG, Wanted, while_wanted};
use crate::memory::{TRIANGULATION, room};
use crate::store::{self, Waiting};
use crate::terrain::rule_of;
use crate::triangulation::coordinates;

/// Lines or polygons: the name of a file, or text of GeoJSON.
type Shapes = (bool, String);

/// How a model is made, as `_dtm.py` has it.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Wishes {
    cell: Option<f64>,
    extent: Option<[f64; 4]>,
    origin: [f64; 2],
    like: Option<PathBuf>,
    method: String,
    duplicates: String,
    max_edge: Option<(f64, bool)>,
    breaklines: Vec<Shapes>,
    flat: Vec<Shapes>,
    clip: Vec<Shapes>,
    classes: Vec<u8>,
    all_classes: bool,
    columns: Vec<String>,
    output: Vec<PathBuf>,
    nodata: Option<f64>,
    compress: String,
    interval: Option<f64>,
    epsg: Option<u32>,
    memory: Option<u64>,
}

/// Heights, unless they are in files; the corner of the first cell and the steps; remarks.
type Made<'py> = (Option<Bound<'py, PyArray2<f64>>>, [f64; 2], [f64; 2], Vec<String>);

/// Makes a model of points with heights, or of files.
#[pyfunction]
pub fn dtm<'py>(
    py: Python<'py>,
    points: Option<(PyReadonlyArray2<'py, f64>, PyReadonlyArray1<'py, f64>)>,
    paths: Vec<PathBuf>,
    wishes: Wishes,
) -> PyResult<Made<'py>> {
    let given = match &points {
        None => None,
        Some((xy, z)) => {
            TRIANGULATION.check_with(2, xy.shape()[0], 0)?;
            Some(Cloud { xy: coordinates(xy)?, z: Some(z.to_vec()?), ..Cloud::default() })
        }
    };
    // Few points may have many cells.
    let made = while_wanted(py, LONG, move |wanted| made(given, paths, &wishes, wanted))?;
    let Model { values, columns, rows, corner, step, remarks } = made?;
    let values = match values {
        Some(values) => Some(PyArray1::from_vec(py, values).reshape([rows, columns])?),
        None => None,
    };
    Ok((values, corner, step, remarks))
}

/// A model, without Python's objects.
struct Model {
    values: Option<Vec<f64>>,
    columns: usize,
    rows: usize,
    corner: [f64; 2],
    step: [f64; 2],
    remarks: Vec<String>,
}

fn made(given: Option<Cloud>, paths: Vec<PathBuf>, wishes: &Wishes, wanted: &Wanted) -> PyResult<Model> {
    let mut remarks = Vec::new();
    let method: Method = wishes.method.parse().map_err(PyValueError::new_err)?;
    let border = Border::long_edges(wishes.max_edge.map(|edge| edge.0))
        .anywhere(wishes.max_edge.is_some_and(|edge| edge.1));
    let duplicates = rule_of(&wishes.duplicates)?;
    let options = Options::new().method(method).duplicates(duplicates).border(border);
    let (cells, like) = cells(wishes).map_err(error_of)?;
    // The tiles of a model go after it.
    let (_folder, terrain) = if let Some(memory) = wishes.memory {
        let (folder, terrain) = tiled(paths, wishes, memory, (&cells, &options), wanted, &mut remarks)?;
        (Some(folder), terrain)
    } else {
        let cloud = match given {
            Some(cloud) => cloud,
            None => files(paths, wishes).read().map_err(error_of)?,
        };
        (None, in_memory(cloud, wishes, &cells, &options, &mut remarks).map_err(error_of)?)
    };
    let crs = terrain.crs().cloned().or(like);
    let mut terrain = terrain.with_crs(crs);
    remarks.extend(terrain.remarks().iter().filter(|remark| remark.is_warning()).map(Remark::to_string));
    if let Some(clip) = clip(wishes, &mut remarks).map_err(error_of)? {
        terrain = terrain.clipped(clip).map_err(error_of)?;
    }
    let grid = *terrain.grid();
    let (columns, rows, corner, step) = (grid.columns(), grid.rows(), grid.corner(), grid.step());
    let values = if wishes.output.is_empty() {
        Some(values(&terrain, wanted)?)
    } else {
        write(&terrain, wishes, wanted, &mut remarks)?;
        None
    };
    Ok(Model { values, columns, rows, corner, step, remarks })
}

fn in_memory(
    mut cloud: Cloud,
    wishes: &Wishes,
    cells: &Cells,
    options: &Options,
    remarks: &mut Vec<String>,
) -> Result<Terrain, Error> {
    remarks.append(&mut cloud.losses);
    if let Some(number) = wishes.epsg {
        cloud.crs = Some(Crs::of_epsg(number));
    }
    Terrain::new(&cloud, lines(wishes, remarks)?, cells, options)
}

/// A model of tiles on disk, in a folder that goes when it is dropped.
fn tiled(
    paths: Vec<PathBuf>,
    wishes: &Wishes,
    memory: u64,
    (cells, options): (&Cells, &Options),
    wanted: &Wanted,
    remarks: &mut Vec<String>,
) -> PyResult<(TemporaryFolder, Terrain)> {
    let beside = wishes.output.first().and_then(|path| path.parent()).map(Path::to_owned);
    let beside = beside.filter(|folder| !folder.as_os_str().is_empty()).unwrap_or_else(std::env::temp_dir);
    let failed = |error: std::io::Error| error_of(Error::File(error.into()).at(&beside));
    let folder = TemporaryFolder::create(&beside).map_err(failed)?;
    let watch = Waiting::new(wanted);
    let files = files(paths, wishes);
    let work = || -> Result<(Terrain, Option<Crs>), Error> {
        let points = delone_store::Files::new(&files.paths)?.options(files.resolved());
        let build = Build::new().memory(memory).heights(true).duplicates(options.duplicates);
        let (store, about) = build.run(&points, &folder.path().join("tiles"), &watch)?;
        let tiles = Tiled::new(store, memory, options, &watch)?;
        Ok((Terrain::of_tiles(tiles, cells)?, about.crs))
    };
    let (terrain, crs) = work().map_err(error_of)?;
    remarks.append(&mut watch.losses());
    let terrain = terrain.with_crs(wishes.epsg.map(Crs::of_epsg).or(crs));
    Ok((folder, terrain))
}

fn files(paths: Vec<PathBuf>, wishes: &Wishes) -> Files {
    let mut files = Files::new(paths).classes(wishes.classes.clone()).all_classes(wishes.all_classes);
    files.options.columns.clone_from(&wishes.columns);
    files
}

/// The cells, and the system of the raster that they are those of.
fn cells(wishes: &Wishes) -> Result<(Cells, Option<Crs>), Error> {
    let extent = wishes.extent.map(|[x0, y0, x1, y1]| Bounds { low: [x0, y0], high: [x1, y1] });
    let cells = Cells::new().size(wishes.cell).extent(extent).origin(wishes.origin);
    match &wishes.like {
        None => Ok((cells, None)),
        Some(path) => {
            let (grid, crs) = read_place(path)?;
            Ok((cells.like(grid).map_err(|error| error.at(path))?, crs))
        }
    }
}

/// Lines and polygons, by the function that reads files.
fn graph(
    (is_text, shapes): &Shapes,
    read: fn(&Path) -> Result<Graph, Error>,
    remarks: &mut Vec<String>,
) -> Result<Graph, Error> {
    if *is_text {
        let text = Box::new(Cursor::new(shapes.clone()));
        return Ok(read_graph(text, Format::GeoJson, &ReadOptions::default(), None)?);
    }
    let mut graph = read(shapes.as_ref())?;
    remarks.extend(graph.cloud.losses.drain(..).map(|loss| format!("{shapes}: {loss}")));
    Ok(graph)
}

fn lines(wishes: &Wishes, remarks: &mut Vec<String>) -> Result<Lines, Error> {
    let mut lines = Lines::new();
    let at = |shapes: &Shapes, error: Error| if shapes.0 { error } else { error.at(&shapes.1) };
    for shapes in &wishes.breaklines {
        lines.breaklines(&graph(shapes, read_lines, remarks)?).map_err(|error| at(shapes, error))?;
    }
    for shapes in &wishes.flat {
        let found =
            lines.level(&graph(shapes, read_polygons, remarks)?).map_err(|error| at(shapes, error))?;
        remarks.extend(found.iter().map(Remark::to_string));
    }
    Ok(lines)
}

/// All polygons to clip to, if there are some.
fn clip(wishes: &Wishes, remarks: &mut Vec<String>) -> Result<Option<Clip>, Error> {
    let mut all: Option<Clip> = None;
    for shapes in &wishes.clip {
        let one = if shapes.0 {
            Clip::of(&graph(shapes, read_polygons, remarks)?)?
        } else {
            read_clip(shapes.1.as_ref())?
        };
        all = Some(match all {
            Some(clip) => clip.with(one)?,
            None => one,
        });
    }
    Ok(all)
}

fn values(terrain: &Terrain, wanted: &Wanted) -> PyResult<Vec<f64>> {
    let grid = terrain.grid();
    let cells = grid.columns().saturating_mul(grid.rows());
    room(cells.saturating_mul(16), "a raster of so many cells")?;
    let mut values = Vec::with_capacity(cells);
    for band in terrain.bands().map_err(error_of)? {
        values.extend(terrain.rows(band).map_err(error_of)?);
        if !wanted.is() {
            return Err(error_of(Error::Stopped));
        }
    }
    Ok(values)
}

fn write(terrain: &Terrain, wishes: &Wishes, wanted: &Wanted, remarks: &mut Vec<String>) -> PyResult<()> {
    let compression = match &*wishes.compress {
        "deflate" => Compression::Deflate,
        "lzw" => Compression::Lzw,
        "none" => Compression::None,
        other => return Err(PyValueError::new_err(format!("there is no compression {other:?}"))),
    };
    let product = Product::new().nodata(wishes.nodata).compression(compression).interval(wishes.interval);
    let mut files = Vec::new();
    for path in &wishes.output {
        files.push((path.clone(), Format::of(path).map_err(|error| error_of(error.into()))?));
    }
    let go_on = |_| if wanted.is() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
    terrain.write(&files, &product, go_on).map_err(error_of)?;
    remarks.extend(terrain.losses(&files));
    Ok(())
}

/// The exception of an error: that of the system, or a `ValueError`.
fn error_of(error: Error) -> PyErr {
    let words = error.to_string();
    match innermost(error) {
        Error::Points(error) | Error::Lines(error) | Error::Levels(error) | Error::Cells(error) => {
            python_error(error)
        }
        Error::File(delone_io::Error::Io(error)) => match error.kind() {
            ErrorKind::NotFound => PyFileNotFoundError::new_err(words),
            ErrorKind::PermissionDenied => PyPermissionError::new_err(words),
            _ => PyOSError::new_err(words),
        },
        Error::Store(error) => store::error_of(error),
        Error::Stopped => PyRuntimeError::new_err(words),
        _ => PyValueError::new_err(words),
    }
}

/// An error without the file that it is about.
fn innermost(error: Error) -> Error {
    match error {
        Error::In { error, .. } => innermost(*error),
        other => other,
    }
}
