//! Tiles: cuts, the two functions that triangulate a tile and join borders, and what travels between processes.

use std::sync::Arc;

use delone::Duplicate;
use delone::tiles::{Border, Cut, Cuts, Fingerprint, Node, Region, Tile, join};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyType};

use crate::errors::python_error;
use crate::interrupt::{LONG, interruptible};
use crate::memory::TRIANGULATION;
use crate::state::table;
use crate::triangulation::coordinates;

type Table<'py, T> = Bound<'py, PyArray2<T>>;
type List<'py, T> = Bound<'py, PyArray1<T>>;
/// The least and the greatest corner of a box.
pub type Sides = [[f64; 2]; 2];

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", name = "Cuts", frozen)]
pub struct PyCuts(pub Arc<Cuts>);

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", name = "Border", frozen)]
pub struct PyBorder(Border);

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", name = "Fingerprint", frozen, eq, hash)]
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct PyFingerprint(pub Fingerprint);

pub fn region([low, high]: Sides) -> Region {
    Region { low, high }
}

/// A node that is one.
pub fn node(number: u32) -> PyResult<Node> {
    Node::new(number).ok_or_else(|| PyValueError::new_err("nodes are numbered from 1, the root"))
}

#[pymethods]
impl PyCuts {
    #[staticmethod]
    fn from_sample(py: Python<'_>, sample: PyReadonlyArray2<'_, f64>, tiles: usize) -> PyResult<Self> {
        let sample: Vec<[f64; 2]> = coordinates(&sample)?;
        let cuts = interruptible(py, sample.len(), move || Cuts::from_sample(&sample, tiles))?;
        cuts.map(|cuts| Self(Arc::new(cuts))).map_err(python_error)
    }

    #[staticmethod]
    fn from_cuts(cuts: Vec<(u32, usize, f64)>) -> PyResult<Self> {
        let cuts = cuts.into_iter().map(|(number, axis, at)| Ok((node(number)?, Cut { axis, at })));
        let cuts = Cuts::from_cuts(cuts.collect::<PyResult<Vec<_>>>()?);
        cuts.map(|cuts| Self(Arc::new(cuts))).map_err(python_error)
    }

    fn cuts(&self) -> Vec<(u32, usize, f64)> {
        self.0.cuts().into_iter().map(|(node, cut)| (node.number(), cut.axis, cut.at)).collect()
    }

    fn tile_of<'py>(&self, py: Python<'py>, points: PyReadonlyArray2<'_, f64>) -> PyResult<List<'py, u32>> {
        let points: Vec<[f64; 2]> = coordinates(&points)?;
        let cuts = Arc::clone(&self.0);
        let tiles = interruptible(py, points.len(), move || {
            points.iter().map(|&p| cuts.tile_of(p).number()).collect()
        })?;
        Ok(PyArray1::from_vec(py, tiles))
    }

    fn region(&self, number: u32) -> PyResult<Sides> {
        let Region { low, high } = self.0.region(node(number)?);
        Ok([low, high])
    }

    fn tiles(&self) -> Vec<u32> {
        self.0.tiles().into_iter().map(Node::number).collect()
    }

    fn parts(&self, number: u32, levels: u32) -> PyResult<Vec<u32>> {
        Ok(self.0.parts(node(number)?, levels).into_iter().map(Node::number).collect())
    }
}

#[pymethods]
impl PyBorder {
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Table<'py, f64>> {
        table(py, 2, self.0.points.as_flattened().to_vec())
    }

    #[getter]
    fn ids<'py>(&self, py: Python<'py>) -> List<'py, u64> {
        PyArray1::from_slice(py, &self.0.ids)
    }

    #[getter]
    fn open<'py>(&self, py: Python<'py>) -> PyResult<Table<'py, u32>> {
        table(py, 3, self.0.open.as_flattened().to_vec())
    }

    fn to_bytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.0.to_bytes())
    }

    #[staticmethod]
    fn from_bytes(data: &[u8]) -> PyResult<Self> {
        Border::from_bytes(data).map(Self).map_err(|problem| PyValueError::new_err(problem.to_string()))
    }

    fn open_in(&self, of: Sides, window: Sides) -> Vec<Sides> {
        let boxes = self.0.open_in(&region(of), &region(window));
        boxes.into_iter().map(|Region { low, high }| [low, high]).collect()
    }

    fn __len__(&self) -> usize {
        self.0.points.len()
    }

    fn __repr__(&self) -> String {
        format!("<Border of {} points, {} triangles open>", self.0.points.len(), self.0.open.len())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let make = slf.get_type().getattr("from_bytes")?;
        Ok((make, (slf.get().to_bytes(slf.py()),)))
    }
}

#[pymethods]
impl PyFingerprint {
    #[new]
    #[pyo3(signature = (text = None))]
    fn new(text: Option<&str>) -> PyResult<Self> {
        let Some(text) = text else { return Ok(Self(Fingerprint::default())) };
        text.parse()
            .map(Self)
            .map_err(|error: delone::tiles::NoFingerprint| PyValueError::new_err(error.to_string()))
    }

    #[staticmethod]
    fn of(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        triangles: PyReadonlyArray2<'_, i64>,
    ) -> PyResult<Self> {
        let points: Vec<[f64; 2]> = coordinates(&points)?;
        let triangles: Vec<i64> = triangles.as_array().iter().copied().collect();
        let all = interruptible(py, triangles.len(), move || {
            let mut all = Fingerprint::default();
            let is_whole = triangles.chunks_exact(3).all(|t| {
                let corners = t.iter().map(|&v| usize::try_from(v).ok().and_then(|v| points.get(v)));
                let Some(corners) = corners.collect::<Option<Vec<&[f64; 2]>>>() else { return false };
                all.add(corners.into_iter().copied());
                true
            });
            is_whole.then_some(all)
        })?;
        let refused = || PyValueError::new_err("triangles have corners that are no points");
        all.map(Self).ok_or_else(refused)
    }

    #[getter]
    fn count(&self) -> u64 {
        self.0.count()
    }

    fn __add__(&self, other: &Self) -> Self {
        Self([self.0, other.0].into_iter().sum())
    }

    fn __str__(&self) -> String {
        self.0.to_string()
    }

    fn __repr__(&self) -> String {
        format!("Fingerprint('{}')", self.0)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyType>, (String,)) {
        (slf.get_type(), (slf.get().0.to_string(),))
    }
}

/// The result of [`triangulate_tile`]: vertices, their rows in the input, final triangles, rows of duplicates with those that they equal,
/// the fingerprint of the final triangles, the border.
type Made<'py> = (Table<'py, f64>, List<'py, i64>, Table<'py, u32>, Table<'py, i64>, PyFingerprint, PyBorder);

/// How the vertices of a border are named.
#[derive(FromPyObject)]
pub enum Names<'py> {
    /// By node, and their number in its tile.
    Node(u32),
    /// Each point of the input has a name.
    Ids(PyReadonlyArray1<'py, u64>),
}

/// The name of a vertex of a tile.
type Id = Box<dyn Fn(&Tile, u32) -> u64 + Send>;

/// See `_delone.pyi`.
#[pyfunction]
pub fn triangulate_tile<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'_, f64>,
    sides: Sides,
    names: Names<'_>,
) -> PyResult<Made<'py>> {
    let count = points.shape()[0];
    TRIANGULATION.check(2, count)?;
    let points: Vec<[f64; 2]> = coordinates(&points)?;
    let id: Id = match names {
        Names::Node(number) => {
            let node = node(number)?;
            Box::new(move |_, v| node.id(v))
        }
        Names::Ids(ids) if ids.len() == count => {
            let ids = ids.to_vec()?;
            Box::new(move |tile, v| ids[tile.order()[v as usize] as usize])
        }
        Names::Ids(ids) => {
            return Err(PyValueError::new_err(format!("{} ids for {count} points", ids.len())));
        }
    };
    let made = interruptible(py, count, move || {
        let tile = Tile::new(&points, &region(sides))?;
        let finals: Vec<u32> = tile.finals().flatten().collect();
        let order: Vec<i64> = tile.order().iter().map(|&row| i64::from(row)).collect();
        let border = tile.border(|v| id(&tile, v));
        let twins = tile.duplicates().iter();
        let duplicates: Vec<i64> = twins
            .flat_map(|&Duplicate { point, vertex, .. }| [point, vertex.index()])
            .map(|row| row as i64)
            .collect();
        let points = tile.points().as_flattened().to_vec();
        Ok((points, order, finals, duplicates, tile.fingerprint(), border))
    })?;
    let (points, order, finals, duplicates, fingerprint, border) = made.map_err(python_error)?;
    Ok((
        table(py, 2, points)?,
        PyArray1::from_vec(py, order),
        table(py, 3, finals)?,
        table(py, 2, duplicates)?,
        PyFingerprint(fingerprint),
        PyBorder(border),
    ))
}

/// See `_delone.pyi`.
#[pyfunction]
pub fn join_borders(
    py: Python<'_>,
    borders: Vec<Py<PyBorder>>,
    sides: Sides,
) -> PyResult<(Table<'_, u64>, PyFingerprint, PyBorder)> {
    let borders: Vec<Border> = borders.iter().map(|border| border.get().0.clone()).collect();
    let count = borders.iter().map(|border| border.points.len()).sum();
    TRIANGULATION.check(2, count)?;
    let made = interruptible(py, LONG, move || join(&borders, &region(sides)))?;
    let seam = made.map_err(python_error)?;
    let triangles = table(py, 3, seam.triangles.as_flattened().to_vec())?;
    Ok((triangles, PyFingerprint(seam.fingerprint), PyBorder(seam.border)))
}
