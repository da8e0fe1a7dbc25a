//! Switch r: a mesh that is read, and refined.
//!
//! Its triangles stay until a new vertex comes into the circle of one, so what is good enough is not made anew. Edges with one triangle are the
//! border. Bounds of areas hold for places: a new triangle has the bound of the old triangle that its centroid is in.

use delone::{Constrained2, Crossings, Location2, TriangleId, Triangulation, VertexId};
use delone_predicates::orient2d;

use crate::built::Built;
use crate::fault::{Fault, Status};
use crate::input::{Given, Input};
use crate::switches::Switches;

/// New vertices for the sake of areas of triangles, at most, if switch S says nothing: some ten seconds.
pub(crate) const VERTICES_FOR_AREAS: usize = 1 << 21;
/// Triangles that areas may ask for, at most, by the same. Meshes have some 1.5 times as many, and half as many vertices as triangles.
const TRIANGLES_FOR_AREAS: f64 = VERTICES_FOR_AREAS as f64;

/// See the module.
#[derive(Debug)]
pub(crate) struct Again {
    /// The triangles, counter-clockwise.
    pub(crate) triangles: Vec<[VertexId; 3]>,
    /// The mesh that was read.
    pub(crate) before: Constrained2,
    /// By slot of that mesh, the row of its triangle; [`NO_ROW`] outside.
    rows: Vec<usize>,
    /// The segments of the new mesh: those of the input, and sides that it leaves out; and the rows of the former.
    segments: Vec<[usize; 2]>,
    origins: Vec<Option<usize>>,
    attributes: Vec<f64>,
    pub(crate) attribute_count: usize,
    areas: Vec<f64>,
}

const NO_ROW: usize = usize::MAX;

/// An edge, whatever its direction.
fn key([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

impl Again {
    pub(crate) fn new(input: &Input, given: Given, s: &Switches) -> Result<Self, Fault> {
        let Given { mut triangles, attributes, attribute_count, areas } = given;
        for (row, corners) in triangles.iter_mut().enumerate() {
            let [a, b, c] = corners.map(|v| input.points[v]);
            let turn = orient2d(a, b, c);
            if turn.is_zero() {
                return Err(Fault::at(Status::Argument, row, format!("triangle {row} has no area")));
            }
            if turn.is_negative() {
                corners.swap(1, 2);
            }
        }
        check_sides(&triangles)?;
        let sides = |&[a, b, c]: &[usize; 3]| [[a, b], [b, c], [c, a]].map(key);
        let mut edges: Vec<[usize; 2]> = triangles.iter().flat_map(sides).collect();
        edges.sort_unstable();
        let runs = edges.chunk_by(|p, q| p == q);
        let border: Vec<[usize; 2]> = runs.filter(|run| run.len() % 2 == 1).map(|run| run[0]).collect();
        let (segments, origins) = segments(&input.segments, &border);
        edges.dedup();
        let before = Constrained2::with_crossings(&input.points, &edges, Crossings::Split)?;
        let rows = rows(&before, &triangles)?;
        let triangles = triangles.into_iter().map(|corners| corners.map(VertexId::new)).collect();
        let again = Self { triangles, before, rows, segments, origins, attributes, attribute_count, areas };
        if s.max_vertices.is_none() {
            again.check_areas()?;
        }
        Ok(again)
    }

    /// Refuses areas that ask for more triangles than there may be.
    fn check_areas(&self) -> Result<(), Fault> {
        let of = |t: TriangleId| self.before.area(t) / self.bound(t);
        let due: f64 = self.before.triangle_ids().map(of).sum();
        if due > TRIANGLES_FOR_AREAS {
            let words = format!(
                "trianglearealist asks for {due:.0} triangles and more; switch S sets a bound, and takes what is made"
            );
            return Err(Fault::new(Status::TooMany, words));
        }
        Ok(())
    }

    /// The triangulation that the mesh starts from.
    pub(crate) fn graph(&self, points: &[[f64; 2]]) -> Result<Constrained2, Fault> {
        Ok(Constrained2::with_crossings(points, &self.segments, Crossings::Split)?)
    }

    pub(crate) fn segment_count(&self) -> usize {
        self.segments.len()
    }

    /// The row of the input that a segment is; none of a side that it leaves out.
    pub(crate) fn origin(&self, segment: usize) -> Option<usize> {
        self.origins[segment]
    }

    pub(crate) fn has_areas(&self) -> bool {
        !self.areas.is_empty()
    }

    /// The largest area in a triangle of the old mesh.
    fn bound(&self, t: TriangleId) -> f64 {
        let area = self.areas.get(self.rows[t.index()]).copied();
        area.filter(|&area| area > 0.0).unwrap_or(f64::INFINITY)
    }

    /// The largest area at a place: on an edge, the lesser one.
    pub(crate) fn area_at(&self, at: [f64; 2]) -> f64 {
        self.around(at).into_iter().map(|t| self.bound(t)).fold(f64::INFINITY, f64::min)
    }

    /// The finite triangles of the old mesh that hold a place.
    fn around(&self, at: [f64; 2]) -> Vec<TriangleId> {
        let mesh = self.before.mesh();
        let found: Vec<TriangleId> = match self.before.locate(at) {
            Ok(Location2::Triangle(t)) => vec![t],
            Ok(Location2::Edge(e)) => vec![e.triangle(), mesh.twin(e).triangle()],
            Ok(Location2::Vertex(v)) => mesh.star(v).map(|e| e.triangle()).collect(),
            _ => Vec::new(),
        };
        found.into_iter().filter(|&t| !mesh.is_ghost(t)).collect()
    }

    /// Attributes of new triangles: those of the old triangles that their centroids are in.
    pub(crate) fn values(&self, built: &Built) -> Result<Vec<f64>, Fault> {
        let mut values = Vec::new();
        values.try_reserve_exact(built.triangles.len().saturating_mul(self.attribute_count))?;
        if self.attribute_count == 0 {
            return Ok(values);
        }
        for row in 0..built.triangles.len() {
            let [p, q, r] = built.places(row);
            let centroid = [0, 1].map(|k| p[k] / 3.0 + q[k] / 3.0 + r[k] / 3.0);
            let old = self.around(centroid).into_iter().map(|t| self.rows[t.index()]).min().unwrap_or(NO_ROW);
            let of =
                |k: usize| self.attributes.get(old.saturating_mul(self.attribute_count).saturating_add(k));
            values.extend((0..self.attribute_count).map(|k| of(k).copied().unwrap_or(0.0)));
        }
        Ok(values)
    }
}

/// Refuses triangles that are on the same side of an edge.
fn check_sides(triangles: &[[usize; 3]]) -> Result<(), Fault> {
    let sides = |(row, &[a, b, c]): (usize, &[usize; 3])| [([a, b], row), ([b, c], row), ([c, a], row)];
    let mut sides: Vec<([usize; 2], usize)> = triangles.iter().enumerate().flat_map(sides).collect();
    sides.sort_unstable();
    match sides.windows(2).filter(|pair| pair[0].0 == pair[1].0).map(|pair| (pair[1].1, pair[0].1)).min() {
        None => Ok(()),
        Some((row, other)) => {
            let words = format!("triangles {other} and {row} are on the same side of an edge");
            Err(Fault::at(Status::Argument, row, words))
        }
    }
}

/// The segments of the new mesh, and the row of each in the input. Even-odd parity tells what is inside: sides of the border are there
/// once, other segments twice.
fn segments(given: &[[usize; 2]], border: &[[usize; 2]]) -> (Vec<[usize; 2]>, Vec<Option<usize>>) {
    let mut is_there = vec![false; border.len()];
    let (mut once, mut twice) = (Vec::new(), Vec::new());
    for (row, &ends) in given.iter().enumerate() {
        match border.binary_search(&key(ends)) {
            Ok(at) if is_there[at] => {}
            Ok(at) => {
                is_there[at] = true;
                once.push((ends, Some(row)));
            }
            Err(_) => twice.push((ends, Some(row))),
        }
    }
    let missing =
        border.iter().zip(is_there).filter(|(_, is_there)| !is_there).map(|(&ends, _)| (ends, None));
    once.iter().chain(&twice).chain(&twice).copied().chain(missing).unzip()
}

/// The row of each triangle of a mesh, by slot.
fn rows(mesh: &Constrained2, triangles: &[[usize; 3]]) -> Result<Vec<usize>, Fault> {
    let sorted = |mut corners: [usize; 3]| {
        corners.sort_unstable();
        corners
    };
    let mut order: Vec<([usize; 3], usize)> =
        triangles.iter().zip(0..).map(|(&t, row)| (sorted(t), row)).collect();
    order.sort_unstable();
    let (mut rows, mut is_there) = (vec![NO_ROW; mesh.slot_count()], vec![false; triangles.len()]);
    for t in mesh.triangle_ids() {
        let corners = sorted(mesh.corners(t).map(|v| v.index()));
        let at = order.partition_point(|(other, _)| *other < corners);
        if let Some(&(_, row)) = order.get(at).filter(|(other, _)| *other == corners) {
            rows[t.index()] = row;
            is_there[row] = true;
        }
    }
    match is_there.iter().position(|is_there| !is_there) {
        None => Ok(rows),
        Some(row) => {
            let words = format!("triangle {row} has a point or a side of another one inside");
            Err(Fault::at(Status::Argument, row, words))
        }
    }
}
