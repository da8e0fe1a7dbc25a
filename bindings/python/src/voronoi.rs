//! Voronoi cells clipped to a region of the plane, and ridges in space.

use delone::{Coordinates, Region2, VertexId};
use delone_predicates::circumcentre;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::interruptible;
use crate::memory::room;
use crate::state::table;
use crate::triangulation::{Core, Triangulation, coordinates};

/// Corners, the starts of rings among them, and the starts of points among the rings.
type Polygons<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>);

/// The cells of so many points, clipped to a polygon with holes; empty for what is no vertex. Sides up to a length are contracted, if one is
/// given.
#[pyfunction]
pub fn clipped_cells<'py>(
    py: Python<'py>,
    triangulation: PyRef<'py, Triangulation>,
    points: usize,
    rings: Vec<PyReadonlyArray2<'py, f64>>,
    merge: Option<f64>,
) -> PyResult<Polygons<'py>> {
    let Core::Plane(held) = &triangulation.core else {
        return Err(PyValueError::new_err("cells are clipped in the plane"));
    };
    let rings = rings.iter().map(coordinates).collect::<PyResult<Vec<Vec<[f64; 2]>>>>()?;
    // Each side of the region may cut each cell.
    let sides: usize = rings.iter().map(Vec::len).sum();
    let (corners, ring_starts, starts) = held.ask(
        py,
        |state| state.size().saturating_mul(sides.max(1)),
        move |state| {
            let region = Region2::polygon(&rings).map_err(python_error)?;
            let mut cells = state.triangulation.voronoi().clip(&region);
            if let Some(length) = merge {
                cells = cells.merged(length, &region).map_err(python_error)?;
            }
            let (mut corners, mut ring_starts, mut starts) = (Vec::<[f64; 2]>::new(), vec![0], vec![0]);
            for v in (0..points).map(VertexId::new) {
                for ring in cells.rings(v) {
                    corners.extend(ring.points());
                    ring_starts.push(corners.len() as i64);
                }
                starts.push(ring_starts.len() as i64 - 1);
            }
            Ok::<_, PyErr>((corners.into_flattened(), ring_starts, starts))
        },
    )??;
    Ok((table(py, 2, corners)?, PyArray1::from_vec(py, ring_starts), PyArray1::from_vec(py, starts)))
}

/// Which of the places each becomes if sides up to a length are contracted; equal ones become one.
#[pyfunction]
pub fn merged_vertices<'py>(
    py: Python<'py>,
    places: PyReadonlyArray2<'py, f64>,
    sides: PyReadonlyArray2<'py, i64>,
    length: f64,
) -> PyResult<Bound<'py, PyArray1<i64>>> {
    let (ends, _) = sides.as_slice()?.as_chunks::<2>();
    let sides: Vec<[u32; 2]> = ends.iter().map(|ends| ends.map(|i| i as u32)).collect();
    let merged = if places.shape()[1] == 2 {
        merged_places::<[f64; 2]>(py, coordinates(&places)?, sides, length)
    } else {
        merged_places::<[f64; 3]>(py, coordinates(&places)?, sides, length)
    }?;
    Ok(PyArray1::from_vec(py, merged.into_iter().map(i64::from).collect()))
}

fn merged_places<P: Coordinates + Send + 'static>(
    py: Python<'_>,
    places: Vec<P>,
    sides: Vec<[u32; 2]>,
    length: f64,
) -> PyResult<Vec<u32>> {
    let merged = interruptible(py, places.len(), move || delone::merged_vertices(&places, &sides, length))?;
    merged.map_err(python_error)
}

/// Triangles, and the circumcentre of each.
type Triangles<'py> = (Bound<'py, PyArray2<i32>>, Bound<'py, PyArray2<f64>>);

/// The triangles of furthest sites, counter-clockwise, and the circumcentre of each, the nearest number to the exact one.
#[pyfunction]
pub fn furthest<'py>(py: Python<'py>, triangulation: PyRef<'py, Triangulation>) -> PyResult<Triangles<'py>> {
    let Core::Plane(held) = &triangulation.core else {
        return Err(PyValueError::new_err("furthest sites are for the plane"));
    };
    let (corners, centres) = held.read(py)?.make(py, |state| {
        let d = &state.triangulation;
        let triangles: Vec<[VertexId; 3]> = d.furthest().triangles().collect();
        let corners: Vec<i32> = triangles.iter().flatten().map(|v| v.index() as i32).collect();
        let centre = |[a, b, c]: [[f64; 2]; 3]| circumcentre(a, b, c).unwrap_or([f64::INFINITY; 2]);
        let centres = triangles.iter().flat_map(|triangle| centre(triangle.map(|v| d.point(v))));
        (corners, centres.collect::<Vec<f64>>())
    })?;
    Ok((table(py, 3, corners)?, table(py, 2, centres)?))
}

/// Pairs of points, the starts of their ridges, and the vertices of these.
type Ridges<'py> = (Bound<'py, PyArray2<i32>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>);

/// The ridges of the Voronoi diagram in space, from the rows of tetrahedra and the vertex of each: around each edge the
/// vertices in turn, equal ones once, and -1 where the ring is open. Those of fewer than three are left out.
#[pyfunction]
pub fn ridges<'py>(
    py: Python<'py>,
    simplices: PyReadonlyArray2<'py, i32>,
    neighbors: PyReadonlyArray2<'py, i32>,
    vertices: PyReadonlyArray1<'py, i64>,
) -> PyResult<Ridges<'py>> {
    room(8 * (simplices.len() + vertices.len()), "copies of so many simplices")?;
    let (simplices, neighbors) = (simplices.as_slice()?.to_vec(), neighbors.as_slice()?.to_vec());
    let vertices = vertices.to_vec()?;
    let (pairs, starts, around) = interruptible(py, vertices.len(), move || {
        let mesh = Rows { corners: simplices.as_chunks().0, across: neighbors.as_chunks().0 };
        let (mut pairs, mut starts, mut around) = (Vec::<i32>::new(), vec![0], Vec::<i64>::new());
        let mut ring = Vec::new();
        for (t, corners) in mesh.corners.iter().enumerate() {
            for (i, j) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
                let start = around.len();
                let Some(is_open) = mesh.turn(t, [corners[i], corners[j]], &mut ring) else { continue };
                for vertex in ring.iter().map(|&t| vertices[t]).chain(is_open.then_some(-1)) {
                    if around[start..].last() != Some(&vertex) {
                        around.push(vertex);
                    }
                }
                while around.len() > start + 1 && around[start..].last() == around.get(start) {
                    around.pop();
                }
                if around.len() < start + 3 {
                    around.truncate(start);
                    continue;
                }
                pairs.extend([corners[i].min(corners[j]), corners[i].max(corners[j])]);
                starts.push(around.len() as i64);
            }
        }
        (pairs, starts, around)
    })?;
    Ok((table(py, 2, pairs)?, PyArray1::from_vec(py, starts), PyArray1::from_vec(py, around)))
}

/// Tetrahedra by rows.
struct Rows<'a> {
    corners: &'a [[i32; 4]],
    across: &'a [[i32; 4]],
}

impl Rows<'_> {
    /// The tetrahedra around an edge in turn, and whether both ends are on the hull. `None` unless the first given is the
    /// smallest of them, so that each edge is met once.
    fn turn(&self, first: usize, edge: [i32; 2], ring: &mut Vec<usize>) -> Option<bool> {
        ring.clear();
        ring.push(first);
        let mut others = (0..4).filter(|&k| !edge.contains(&self.corners[first][k]));
        let (a, b) = (others.next()?, others.next()?);
        let is_open = self.go(first, a, edge, ring)?;
        if is_open {
            // The other way round from the first.
            ring.reverse();
            self.go(first, b, edge, ring)?;
        }
        Some(is_open)
    }

    /// Goes on around an edge across from corner `k` of a tetrahedron, to its beginning or to the hull; says which.
    fn go(&self, first: usize, mut k: usize, edge: [i32; 2], ring: &mut Vec<usize>) -> Option<bool> {
        let mut t = first;
        loop {
            let next = self.across[t][k];
            let Ok(next) = usize::try_from(next) else { return Some(true) };
            if next == first {
                return Some(false);
            }
            if next < first {
                return None;
            }
            // It is entered across from its one corner that is new; it is left across from the other of the facet.
            let shared = (0..4).find(|&i| {
                let corner = self.corners[next][i];
                !edge.contains(&corner) && self.corners[t].contains(&corner)
            })?;
            (t, k) = (next, shared);
            ring.push(t);
        }
    }
}
