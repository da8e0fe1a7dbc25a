//! Folders of tiles: built, resumed, opened, proved and read, as the program does it.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use delone::tiles::{Node, Region};
use delone::{Delaunay2, Triangulation as _, VertexId};
use delone_io::Cloud;
use delone_store::{Build, Error, Files, Part, Store, Summary, Watch};
use numpy::{PyArray2, PyReadonlyArray2};
use pyo3::exceptions::{PyFileNotFoundError, PyOSError, PyPermissionError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::{LONG, Wanted, while_wanted};
use crate::state::table;
use crate::tiles::{PyCuts, PyFingerprint, Sides, node, region};
use crate::triangulation::coordinates;

/// A run, as `tiles.py` has it.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Plan {
    paths: Vec<PathBuf>,
    folder: PathBuf,
    memory: u64,
    tile: Option<usize>,
    workers: Option<usize>,
    heights: bool,
    neighbors: bool,
    resume: bool,
    classes: Vec<u8>,
    columns: Vec<String>,
}

/// Points with their heights or without, and triangles as rows of them.
type Shown<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<i64>>);

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", name = "Store", frozen)]
pub struct PyStore(Arc<Store>);

/// Ends work when nobody waits for it, and keeps what files tell.
pub struct Waiting<'a> {
    wanted: &'a Wanted,
    losses: Mutex<Vec<String>>,
}

impl<'a> Waiting<'a> {
    pub fn new(wanted: &'a Wanted) -> Self {
        Self { wanted, losses: Mutex::default() }
    }

    /// Contents of the files that tiles lack.
    pub fn losses(self) -> Vec<String> {
        self.losses.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Watch for Waiting<'_> {
    fn goes_on(&self) -> bool {
        self.wanted.is()
    }

    fn heed(&self, path: &Path, about: &mut Cloud) -> Result<(), Error> {
        let mut losses = self.losses.lock().unwrap_or_else(PoisonError::into_inner);
        losses.extend(about.losses.drain(..).map(|loss| format!("{}: {loss}", path.display())));
        Ok(())
    }
}

#[pymethods]
impl PyStore {
    /// Makes a folder, or goes on with one; gives remarks too.
    #[staticmethod]
    fn build(py: Python<'_>, plan: Plan) -> PyResult<(Self, Vec<String>)> {
        let made = while_wanted(py, LONG, move |wanted| {
            let watch = Waiting::new(wanted);
            let mut files = Files::new(plan.paths)?.classes(plan.classes);
            files.options.columns = plan.columns;
            let build = Build::new()
                .memory(plan.memory)
                .tile(plan.tile)
                .workers(plan.workers)
                .heights(plan.heights)
                .neighbors(plan.neighbors)
                .resume(plan.resume);
            let (store, _) = build.run(&files, &plan.folder, &watch)?;
            Ok((store, watch.losses()))
        })?;
        let (store, losses) = made.map_err(error_of)?;
        Ok((Self(Arc::new(store)), losses))
    }

    #[staticmethod]
    fn open(py: Python<'_>, folder: PathBuf) -> PyResult<Self> {
        let store = py.detach(|| Store::open(folder)).map_err(error_of)?;
        Ok(Self(Arc::new(store)))
    }

    #[getter]
    fn folder(&self) -> PathBuf {
        self.0.folder().to_owned()
    }

    #[getter]
    fn heights(&self) -> bool {
        self.0.has_heights()
    }

    /// Points, duplicates, vertices, triangles, those of seams, vertices of the hull, and points of borders.
    fn counts(&self) -> [u64; 7] {
        let Summary { points, duplicates, vertices, triangles, of_seams, hull, border, .. } =
            self.0.summary();
        [points, duplicates, vertices, triangles, of_seams, hull, border]
    }

    fn fingerprint(&self) -> PyFingerprint {
        PyFingerprint(self.0.summary().fingerprint)
    }

    fn cuts(&self) -> PyCuts {
        PyCuts(Arc::new(self.0.cuts().clone()))
    }

    fn points<'py>(&self, py: Python<'py>, tile: u32) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (store, tile) = (&self.0, self.tile(tile)?);
        let corners = py.detach(|| store.points(tile)).map_err(error_of)?;
        self.rows(py, corners)
    }

    fn triangles<'py>(&self, py: Python<'py>, tile: u32) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let (store, tile) = (&self.0, self.tile(tile)?);
        let triangles = py.detach(|| store.triangles(tile)).map_err(error_of)?;
        table(py, 3, triangles.into_iter().flatten().map(|v| v as i64).collect())
    }

    fn verify(&self, py: Python<'_>) -> PyResult<()> {
        let store = Arc::clone(&self.0);
        while_wanted(py, LONG, move |wanted| store.verify(&Waiting::new(wanted)))?.map_err(error_of)
    }

    /// The triangles that may meet a box.
    fn window<'py>(&self, py: Python<'py>, sides: Sides) -> PyResult<Shown<'py>> {
        let store = Arc::clone(&self.0);
        let shown = while_wanted(py, LONG, move |wanted| {
            let part = store.window(&region(sides), &Waiting::new(wanted)).map_err(error_of)?;
            let triangles = triangles(&part).map_err(python_error)?;
            Ok::<_, PyErr>((part, triangles))
        })?;
        let (part, triangles) = shown?;
        let corners = part.points().into_iter().zip(part.heights()).collect();
        Ok((self.rows(py, corners)?, table(py, 3, triangles)?))
    }

    /// The triangle that each place is in, by the names of its corners; none is `u64::MAX`.
    fn locate<'py>(
        &self,
        py: Python<'py>,
        places: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<u64>>> {
        let (store, places): (_, Vec<[f64; 2]>) = (Arc::clone(&self.0), coordinates(&places)?);
        let found = while_wanted(py, LONG, move |wanted| store.locate(&places, &Waiting::new(wanted)))?;
        let found = found.map_err(error_of)?;
        table(py, 3, found.into_iter().flat_map(|names| names.unwrap_or([u64::MAX; 3])).collect())
    }

    /// About so many of the points, at equal steps along the curve of each tile.
    fn overview<'py>(&self, py: Python<'py>, count: u64) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let store = Arc::clone(&self.0);
        let step = (store.summary().vertices / count.max(1)).max(1) as usize;
        let part =
            while_wanted(py, LONG, move |wanted| store.overview(&Region::ALL, step, &Waiting::new(wanted)))?;
        let part = part.map_err(error_of)?;
        self.rows(py, part.points().into_iter().zip(part.heights()).collect())
    }
}

impl PyStore {
    /// A node that is a tile.
    fn tile(&self, number: u32) -> PyResult<Node> {
        let node = node(number)?;
        if self.0.cuts().is_tile(node) {
            return Ok(node);
        }
        Err(PyValueError::new_err(format!("node {number} is no tile")))
    }

    /// Points as rows, with their heights if they have some.
    fn rows<'py>(
        &self,
        py: Python<'py>,
        corners: Vec<([f64; 2], f64)>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        if self.0.has_heights() {
            return table(py, 3, corners.into_iter().flat_map(|([x, y], z)| [x, y, z]).collect());
        }
        table(py, 2, corners.into_iter().flat_map(|corner| corner.0).collect())
    }
}

/// The triangles of a part, as rows of its points: the triangulation of the points has all of them.
fn triangles(part: &Part) -> Result<Vec<i64>, delone::Error> {
    let names = part.names();
    let d = Delaunay2::from_points(&part.points())?;
    let mut rows = Vec::with_capacity(3 * part.triangle_count());
    for t in d.triangle_ids() {
        let corners = d.corners(t).map(VertexId::index);
        if part.tile_of(corners.map(|v| names[v])).is_some() {
            rows.extend(corners.map(|v| v as i64));
        }
    }
    Ok(rows)
}

/// The exception of an error: that of the system, or a `ValueError`.
pub fn error_of(error: Error) -> PyErr {
    let words = error.to_string();
    let kind = match &error {
        Error::Read { error: delone_io::Error::Io(error), .. }
        | Error::Write { error: delone_io::Error::Io(error), .. }
        | Error::Folder { error, .. }
        | Error::WriteBucket { error, .. } => Some(error.kind()),
        _ => None,
    };
    match (kind, error) {
        (Some(ErrorKind::NotFound), _) | (_, Error::NoTiles { .. }) => PyFileNotFoundError::new_err(words),
        (Some(ErrorKind::PermissionDenied), _) => PyPermissionError::new_err(words),
        (Some(_), _) => PyOSError::new_err(words),
        (_, Error::Stopped) => PyRuntimeError::new_err(words),
        _ => PyValueError::new_err(words),
    }
}
