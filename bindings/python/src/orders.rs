//! Voronoi diagrams of higher order in the plane.
//!
//! A diagram borrows its triangulation, so this keeps the triangulation and gives the diagram away as arrays; who wants clipped
//! regions has it made again.

use delone::{Delaunay2, Error, OrderK2, OrderRegion2, Region2, VertexId};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::interruptible;
use crate::memory::{ORDER, ORDER_SITES, TRIANGULATION};
use crate::shared::Shared;
use crate::state::{Rows, State, table};
use crate::triangulation::coordinates;

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", frozen)]
pub struct Orders(Shared<State<Delaunay2, Regions>>);

/// The regions of a diagram, by their sites.
struct Regions {
    order: usize,
    /// For each region its sites, sorted; regions are sorted by them.
    sites: Vec<i32>,
}

/// A diagram without its triangulation.
struct Arrays {
    sites: Vec<i32>,
    bounded: Vec<bool>,
    on: Vec<i32>,
    inside: Vec<i32>,
    around: Vec<i32>,
    centers: Vec<f64>,
}

/// The sites of regions; whether these are bounded; the sites on circles, those inside with -1 where there is one less, the
/// regions around; and centers.
type Diagram<'py> =
    (Rows<'py>, Bound<'py, PyArray1<bool>>, Rows<'py>, Rows<'py>, Rows<'py>, Bound<'py, PyArray2<f64>>);

/// Corners, the starts of rings among them, and the starts of regions among the rings.
type Polygons<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>);

#[pymethods]
impl Orders {
    /// The diagram of an order, its arrays and what answers questions about it.
    #[staticmethod]
    fn of<'py>(
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
        order: usize,
    ) -> PyResult<(Self, Diagram<'py>)> {
        let count = points.shape()[0];
        let more = ORDER.saturating_add(ORDER_SITES.saturating_mul(order)).saturating_mul(order);
        TRIANGULATION.check_with(2, count, count.saturating_mul(more))?;
        let points: Vec<[f64; 2]> = coordinates(&points)?;
        let made = interruptible(py, work(count, order), move || {
            let d = Delaunay2::from_vec(points)?;
            let arrays = Arrays::of(&d.order(order)?);
            Ok::<_, Error>((d, arrays))
        })?;
        let (d, arrays) = made.map_err(python_error)?;
        let Arrays { sites, bounded, on, inside, around, centers } = arrays;
        let (regions, circles) = (bounded.len(), on.len() / 3);
        let diagram = (
            PyArray1::from_slice(py, &sites).reshape([regions, order])?,
            PyArray1::from_vec(py, bounded),
            PyArray1::from_vec(py, on).reshape([circles, 3])?,
            PyArray1::from_vec(py, inside).reshape([circles, order - 1])?,
            PyArray1::from_vec(py, around).reshape([circles, 3])?,
            PyArray1::from_vec(py, centers).reshape([circles, 2])?,
        );
        Ok((Self(Shared::new(State::of(d, Regions { order, sites }))), diagram))
    }

    /// Points that are no sites because they equal one, each with this.
    fn duplicates<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        self.0.read(py)?.duplicates(py, |_, _| true)
    }

    /// The regions that points are in.
    fn locate<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let queries: Vec<[f64; 2]> = coordinates(&queries)?;
        let found = State::answers(&self.0, py, queries, |state, q| {
            let regions = &state.record;
            let mut nearest: Vec<i32> = indices(state.triangulation.k_nearest(q, regions.order)?).collect();
            nearest.sort_unstable();
            Ok(regions.find(&nearest))
        })?;
        Ok(PyArray1::from_vec(py, found))
    }

    /// The regions, clipped to a polygon with holes.
    fn cells<'py>(
        &self,
        py: Python<'py>,
        rings: Vec<PyReadonlyArray2<'py, f64>>,
        merge: Option<f64>,
    ) -> PyResult<Polygons<'py>> {
        let (corners, ring_starts, starts) = self.clipped(py, &rings, move |order, region| {
            let mut cells = order.cells(region);
            if let Some(length) = merge {
                cells = cells.merged(length, region)?;
            }
            let (mut corners, mut ring_starts, mut starts) = (Vec::<[f64; 2]>::new(), vec![0], vec![0]);
            for own in order.regions() {
                for ring in cells.rings(own) {
                    corners.extend(ring.points());
                    ring_starts.push(corners.len() as i64);
                }
                starts.push(ring_starts.len() as i64 - 1);
            }
            Ok((corners.into_flattened(), ring_starts, starts))
        })?;
        Ok((table(py, 2, corners)?, PyArray1::from_vec(py, ring_starts), PyArray1::from_vec(py, starts)))
    }

    /// The areas of the clipped regions.
    fn areas<'py>(
        &self,
        py: Python<'py>,
        rings: Vec<PyReadonlyArray2<'py, f64>>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let areas: Vec<f64> = self.clipped(py, &rings, |order, region| {
            let cells = order.cells(region);
            Ok(order.regions().map(|own| cells.area(own)).collect())
        })?;
        Ok(PyArray1::from_vec(py, areas))
    }
}

impl Regions {
    /// The region with these sites, which are sorted; -1 if there is none.
    fn find(&self, sites: &[i32]) -> i32 {
        let row = |i: usize| &self.sites[i * self.order..][..self.order];
        let count = self.sites.len() / self.order;
        let (mut low, mut high) = (0, count);
        while low < high {
            let middle = usize::midpoint(low, high);
            if row(middle) < sites { low = middle + 1 } else { high = middle }
        }
        if low < count && row(low) == sites { low as i32 } else { -1 }
    }
}

impl Orders {
    /// Makes the diagram again, and something of it and a polygon.
    fn clipped<T: Send + 'static>(
        &self,
        py: Python<'_>,
        rings: &[PyReadonlyArray2<'_, f64>],
        make: impl FnOnce(&OrderK2, &Region2) -> Result<T, Error> + Send + 'static,
    ) -> PyResult<T> {
        let rings = rings.iter().map(coordinates).collect::<PyResult<Vec<Vec<[f64; 2]>>>>()?;
        let sides: usize = rings.iter().map(Vec::len).sum();
        let clipped = self.0.ask(
            py,
            |state| work(state.size(), state.record.order).saturating_mul(sides.max(1)),
            move |state| {
                let region = Region2::polygon(&rings)?;
                make(&state.triangulation.order(state.record.order)?, &region)
            },
        )?;
        clipped.map_err(python_error)
    }
}

/// How much work a diagram is, for those who count points.
fn work(points: usize, order: usize) -> usize {
    points.saturating_mul(order).saturating_mul(order)
}

impl Arrays {
    fn of(order: &OrderK2) -> Self {
        let k = order.order();
        let mut arrays = Self {
            sites: Vec::with_capacity(k * order.region_count()),
            bounded: order.regions().map(OrderRegion2::is_bounded).collect(),
            on: Vec::new(),
            inside: Vec::new(),
            around: Vec::new(),
            centers: Vec::new(),
        };
        for region in order.regions() {
            arrays.sites.extend(indices(region.sites().iter().copied()));
        }
        for (i, circle) in (1..).zip(order.circles()) {
            arrays.on.extend(indices(circle.on()));
            arrays.inside.extend(indices(circle.inside()));
            arrays.inside.resize(i * (k - 1), -1);
            arrays.around.extend(circle.regions().map(|region| region.index() as i32));
            arrays.centers.extend(circle.center().unwrap_or([f64::INFINITY; 2]));
        }
        arrays
    }
}

fn indices(vertices: impl IntoIterator<Item = VertexId>) -> impl Iterator<Item = i32> {
    vertices.into_iter().map(|v| v.index() as i32)
}
