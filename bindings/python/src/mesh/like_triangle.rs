//! The arrays of a mesh under the keys of the package `triangle`: markers, edges, and vertices in the middles of edges.
//!
//! Cost: linear in the mesh, apart from the order of its edges.

use std::collections::BTreeMap;

use delone::{EdgeId, Triangulation as _, VertexId};
use numpy::{PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::{Content, Side};
use crate::constrained::{index, pairs};
use crate::state::table;

/// The switches that say which arrays there are: fields of Python's `Switches`.
#[derive(FromPyObject)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch")]
pub struct Switches {
    poly: bool,
    convex: bool,
    jettison: bool,
    second_order: bool,
    edges: bool,
    neighbors: bool,
    no_markers: bool,
    no_vertices: bool,
    no_triangles: bool,
    no_segments: bool,
}

/// The origin of a segment that nobody gave, between triangles of other attributes; `BETWEEN` of `_sides.py`.
const BETWEEN: i64 = -2;

/// What was given, and what Python made of it.
pub struct Given {
    vertex_markers: Vec<i32>,
    segments: Vec<[usize; 2]>,
    /// For each segment the first marker other than 0 of all that have its ends.
    segment_markers: Vec<i32>,
    /// For each segment of the mesh's input the segment that was given, or -1 or [`BETWEEN`]; `None` if they are the same.
    origins: Option<Vec<i64>>,
    /// Attributes of all vertices of the mesh, and how many each has.
    attributes: (Vec<f64>, usize),
}

impl Given {
    /// Of a mesh of so many points.
    pub fn new(
        points: usize,
        vertex_markers: &PyReadonlyArray1<'_, i64>,
        segments: &PyReadonlyArray2<'_, i64>,
        segment_markers: &PyReadonlyArray1<'_, i64>,
        origins: Option<PyReadonlyArray1<'_, i64>>,
        attributes: Option<PyReadonlyArray2<'_, f64>>,
    ) -> PyResult<Self> {
        let numbers = |of: &[i64]| of.iter().map(|&i| i as i32).collect::<Vec<i32>>();
        let segments: Vec<[usize; 2]> = pairs(segments)?.iter().map(|ends| ends.map(index)).collect();
        let mut segment_markers = numbers(segment_markers.as_slice()?);
        let sorted = |ends: [usize; 2]| [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let mut first = BTreeMap::new();
        for (&ends, &marker) in segments.iter().zip(&segment_markers).filter(|of| *of.1 != 0) {
            first.entry(sorted(ends)).or_insert(marker);
        }
        for (&ends, marker) in segments.iter().zip(&mut segment_markers) {
            *marker = first.get(&sorted(ends)).copied().unwrap_or(0);
        }
        let attributes = match attributes {
            Some(array) => (array.to_vec()?, array.shape()[1]),
            None => (Vec::new(), 0),
        };
        let is_none = |&v: &usize| v >= points;
        if attributes.0.len() != points * attributes.1 || segments.as_flattened().iter().any(is_none) {
            return Err(PyValueError::new_err("attributes or segments of another mesh"));
        }
        Ok(Self {
            vertex_markers: numbers(vertex_markers.as_slice()?),
            segments,
            segment_markers,
            origins: origins.map(|of| of.to_vec()).transpose()?,
            attributes,
        })
    }

    /// The segment that was given, or a number below 0.
    fn origin(&self, side: &Side) -> i64 {
        let of = |origins: &Vec<i64>| origins.get(index(side.origin)).copied().unwrap_or(-1);
        self.origins.as_ref().map_or(side.origin, of)
    }

    /// The marker of a segment of the mesh that was given; 0 of others.
    fn marker(&self, origin: i64) -> i32 {
        self.segment_markers.get(index(origin)).copied().unwrap_or(0)
    }

    /// The marker of a segment of the mesh: of one that has none 1 on the border.
    fn marker_or_border(&self, side: &Side) -> i32 {
        match self.marker(self.origin(side)) {
            0 => i32::from(side.is_border()),
            marker => marker,
        }
    }

    /// The markers of vertices: of those that have none that of the first segment there that has one.
    fn markers(&self, count: usize, sides: &[Side]) -> Vec<i32> {
        let mut markers = self.vertex_markers.clone();
        markers.resize(count, 0);
        let mut first = vec![i64::MAX; count];
        for side in sides {
            let origin = self.origin(side);
            if self.marker(origin) != 0 {
                side.ends.iter().for_each(|&v| first[v] = first[v].min(origin));
            }
        }
        let mut set = |v: usize, marker: i32| {
            if markers[v] == 0 {
                markers[v] = marker;
            }
        };
        first.iter().enumerate().for_each(|(v, &origin)| set(v, self.marker(origin)));
        let border = sides.iter().filter(|side| side.is_border());
        border.flat_map(|side| side.ends).for_each(|v| set(v, 1));
        // In holes the mesh has no segments.
        for (&[a, b], &marker) in self.segments.iter().zip(&self.segment_markers) {
            set(a, marker);
            set(b, marker);
        }
        markers
    }
}

/// Numbers of a table.
pub enum Numbers {
    Ints(Vec<i32>),
    Floats(Vec<f64>),
}

fn ints(all: impl Iterator<Item = i32>) -> Numbers {
    Numbers::Ints(all.collect())
}

/// A key, the columns of its table, and its numbers.
pub type Named = (&'static str, usize, Numbers);

/// The tables that switches want, empty ones too.
pub fn tables(this: &Content, given: &Given, s: &Switches) -> Vec<Named> {
    let (c, points) = (&this.made, this.made.points());
    let corners = || this.inside.iter().map(|&t| c.corners(t).map(VertexId::index));
    let sides: Vec<Side> = this.sides().collect();
    let edges = if s.edges || s.second_order { edges_of(this) } else { Vec::new() };
    let edge_ends =
        || edges.iter().map(|&e| [c.mesh().origin(e), c.mesh().destination(e)].map(VertexId::index));
    let edge_markers = || edges.iter().map(|&e| this.side(e).map_or(0, |side| given.marker_or_border(&side)));
    // Vertices that stay, and their names.
    let mut is_kept = vec![!s.jettison; points.len()];
    corners().flatten().for_each(|v| is_kept[v] = true);
    let kept: Vec<usize> = (0..points.len()).filter(|&v| is_kept[v]).collect();
    let mut names = vec![-1; points.len()];
    kept.iter().zip(0..).for_each(|(&v, name)| names[v] = name);
    let name = |v: usize| names[v];
    // The rows of vertices, then those of the middles of edges.
    let rows = |values: &[f64], width: usize| {
        let mut all: Vec<f64> =
            kept.iter().flat_map(|&v| &values[v * width..(v + 1) * width]).copied().collect();
        for [a, b] in edge_ends().filter(|_| s.second_order) {
            all.extend((0..width).map(|k| values[a * width + k] / 2.0 + values[b * width + k] / 2.0));
        }
        Numbers::Floats(all)
    };
    let mut found = Vec::new();
    if !s.no_vertices {
        let (attributes, width) = &given.attributes;
        found.push(("vertices", 2, rows(points.as_flattened(), 2)));
        found.push(("vertex_attributes", *width, rows(attributes, *width)));
        let markers = given.markers(points.len(), &sides);
        let of_middles = edge_markers().filter(|_| s.second_order);
        found.push(("vertex_markers", 1, ints(kept.iter().map(|&v| markers[v]).chain(of_middles))));
    }
    if !s.no_triangles {
        let rows = corners().map(|three| three.map(name));
        found.push(if s.second_order {
            let middles = middles(this, &edges, kept.len());
            ("triangles", 6, ints(rows.zip(middles).flat_map(|(a, b)| [a, b]).flatten()))
        } else {
            ("triangles", 3, ints(rows.flatten()))
        });
    }
    if s.neighbors {
        found.push(("neighbors", 3, ints(this.neighbors().flatten().map(|row| row as i32))));
    }
    if (s.poly || s.convex) && !s.no_segments {
        let shown = || sides.iter().filter(|side| given.origin(side) != BETWEEN);
        found.push(("segments", 2, ints(shown().flat_map(|side| side.with_mesh_on_right().map(name)))));
        found.push(("segment_markers", 1, ints(shown().map(|side| given.marker_or_border(side)))));
    }
    if s.edges {
        found.push(("edges", 2, ints(edge_ends().flat_map(|ends| ends.map(name)))));
        found.push(("edge_markers", 1, ints(edge_markers())));
    }
    found
}

/// Tables by their keys, without those that are empty.
pub fn dictionary<'py>(py: Python<'py>, tables: Vec<Named>, s: &Switches) -> PyResult<Bound<'py, PyDict>> {
    let made = PyDict::new(py);
    for (key, columns, numbers) in tables {
        if s.no_markers && key.ends_with("markers") {
            continue;
        }
        match numbers {
            Numbers::Ints(rows) if !rows.is_empty() => made.set_item(key, table(py, columns, rows)?)?,
            Numbers::Floats(rows) if !rows.is_empty() => made.set_item(key, table(py, columns, rows)?)?,
            _ => {}
        }
    }
    Ok(made)
}

/// The edges of triangles inside, counter-clockwise in the first of these, by their lesser and larger ends.
fn edges_of(this: &Content) -> Vec<EdgeId> {
    let mesh = this.made.mesh();
    let all = this.inside.iter().flat_map(|t| [0, 1, 2].map(|k| t.edge(k)));
    let is_first = |e: &EdgeId| {
        let beside = this.rows[mesh.twin(*e).triangle().index()];
        beside < 0 || this.rows[e.triangle().index()] < beside
    };
    let mut edges: Vec<EdgeId> = all.filter(is_first).collect();
    edges.sort_by_cached_key(|&e| {
        let (a, b) = (mesh.origin(e), mesh.destination(e));
        (a.min(b), a.max(b))
    });
    edges
}

/// For each triangle the vertices in the middles of the edges across from its corners, which follow so many others.
fn middles(this: &Content, edges: &[EdgeId], others: usize) -> Vec<[i32; 3]> {
    let mut middles = vec![[-1; 3]; this.inside.len()];
    for (&e, middle) in edges.iter().zip(others as i32..) {
        for e in [e, this.made.mesh().twin(e)] {
            if let Ok(row) = usize::try_from(this.rows[e.triangle().index()]) {
                middles[row][(e.corner() + 2) % 3] = middle;
            }
        }
    }
    middles
}
