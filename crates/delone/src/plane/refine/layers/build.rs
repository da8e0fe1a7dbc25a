//! Layers become part of the triangulation: their vertices, then lines and ribs as segments, and a proof that all cells are there.
//!
//! Plans have room by exact tests, but places on ribs are rounded. So each cell is looked for in the triangulation. Where one is
//! missing, or a segment would cross another one, a row is taken and all is made anew.
//!
//! Cost: O(log n) for each vertex.

use std::collections::BTreeMap;

use crate::error::Error;
use crate::ids::{Inserted, TriangleId, VertexId};
use crate::plane::constrained::{Constrained2, SegmentId};

use super::super::mesher::Mesher;
use super::room::{Column, Plan};
use crate::ids::Place;

/// The vertices on each rib of each wedge, the base first.
pub(super) type Names = Vec<Vec<Vec<VertexId>>>;

/// Layers that are made.
#[derive(Debug, Default)]
pub(super) struct Built {
    /// Their triangles.
    pub(super) triangles: Vec<TriangleId>,
    /// Their new vertices, with the length of sides there.
    pub(super) vertices: Vec<(VertexId, f64)>,
    /// Their lines and ribs.
    pub(super) segments: Vec<SegmentId>,
}

/// Puts the vertices of ribs on constraints that these follow, from the border on. Where one has no place, rows end.
pub(super) fn follow(plan: &mut Plan, mesher: &mut Mesher) -> Vec<Vec<Place>> {
    let mut followed = vec![Vec::new(); plan.chains.wedges.len()];
    // Rows may come from both ends of a constraint: how far they came, by the end that they started at and the other one.
    let mut reached: BTreeMap<[Place; 2], Place> = BTreeMap::new();
    for (wedge, along) in followed.iter_mut().enumerate() {
        let own = &plan.chains.wedges[wedge];
        let Some(end) = own.beside.filter(|_| plan.ribs[wedge].follows) else { continue };
        let mut last = own.base;
        for row in 1..=plan.rows[wedge] {
            let at = plan.line_on((wedge, 0), row);
            let goal = reached.get(&[end, own.base]).copied().unwrap_or(end);
            let edge = mesher.layer.mesh.edge_between(last, goal);
            let Some(v) = edge.and_then(|e| mesher.divide(e, at)) else {
                plan.rows[wedge] = row - 1;
                break;
            };
            along.push(v);
            reached.insert([own.base, end], v);
            last = v;
        }
    }
    plan.even_out();
    followed
}

/// Makes all that is planned, or gives the columns that could not be made.
pub(super) fn build(
    plan: &Plan,
    bases: &[Vec<VertexId>],
    c: &mut Constrained2,
) -> Result<Result<Built, Vec<usize>>, Error> {
    let mut names = Names::new();
    let (mut built, mut is_lost) = (Built::default(), vec![false; plan.rows.len()]);
    for (wedge, ribs) in plan.ribs.iter().enumerate() {
        let rows = plan.rows[wedge];
        let mut of_wedge = Vec::new();
        for rib in 0..ribs.steps.len().max(1) {
            let mut along = bases[wedge].clone();
            along.truncate(rows + 1);
            for row in along.len()..=rows {
                match c.insert(plan.line_on((wedge, rib), row))? {
                    Inserted::New(v) => {
                        built.vertices.push((v, plan.chains.spacing(wedge)));
                        along.push(v);
                    }
                    Inserted::Existing(v) => {
                        is_lost[wedge] = true;
                        along.push(v);
                    }
                }
            }
            of_wedge.push(along);
        }
        names.push(of_wedge);
    }
    let of = |(wedge, rib): (usize, usize), row: usize| names[wedge][rib][row];
    let segments = &mut built.segments;
    let mut join = |c: &mut Constrained2, ends: [VertexId; 2]| {
        ends[0] == ends[1]
            || is_edge(c, ends)
            || c.insert_segment(ends[0], ends[1]).is_ok_and(|segment| {
                segments.push(segment);
                true
            })
    };
    for (wedge, ribs) in names.iter().enumerate() {
        for along in ribs {
            is_lost[wedge] |= !along.windows(2).all(|pair| join(c, [pair[0], pair[1]]));
        }
    }
    let mut failed = Vec::new();
    for (k, column) in plan.columns.iter().enumerate() {
        let [low, high] = plan.rows_between(column);
        let lines = (1..=low).map(|row| [of(column.tail, row), of(column.head, row)]);
        let top = [column.tail, column.head].map(|rib| of(rib, plan.rows[rib.0]));
        let last = (high > low).then_some(top);
        let missing = lines.chain(last).filter(|&ends| !join(c, ends)).count();
        if missing > 0 || is_lost[column.tail.0] || is_lost[column.head.0] {
            failed.push(k);
        }
    }
    for (k, column) in plan.columns.iter().enumerate() {
        let found = triangles(plan, column, c, of);
        if found.is_none() {
            failed.push(k);
        }
        built.triangles.extend(found.unwrap_or_default());
    }
    Ok(if failed.is_empty() { Ok(built) } else { Err(failed) })
}

/// Whether two vertices are joined by a constraint.
fn is_edge(c: &Constrained2, ends: [VertexId; 2]) -> bool {
    let places = ends.map(|v| c.mesh().place(v));
    let edge = places[0].zip(places[1]).and_then(|(p, q)| c.mesh().edge_between(p, q));
    edge.is_some_and(|e| c.is_constraint(e))
}

/// The triangles of a column, if all of its cells are there.
fn triangles(
    plan: &Plan,
    column: &Column,
    c: &Constrained2,
    of: impl Fn((usize, usize), usize) -> VertexId,
) -> Option<Vec<TriangleId>> {
    let [low, high] = plan.rows_between(column);
    let mut found = Vec::new();
    for row in 0..low {
        let [a, b] = [column.tail, column.head].map(|rib| of(rib, row));
        let [d, e] = [column.tail, column.head].map(|rib| of(rib, row + 1));
        if a == b {
            found.push(triangle(c, [a, e, d])?);
        } else {
            let whole =
                |corners: [[VertexId; 3]; 2]| Some([triangle(c, corners[0])?, triangle(c, corners[1])?]);
            found.extend(whole([[a, b, e], [a, e, d]]).or_else(|| whole([[a, b, d], [b, e, d]]))?);
        }
    }
    if high > low {
        let [a, b] = [column.tail, column.head].map(|rib| of(rib, low));
        let higher = if plan.rows[column.tail.0] > low { column.tail } else { column.head };
        found.push(triangle(c, [a, b, of(higher, high)])?);
    }
    Some(found)
}

/// The triangle with some corners.
fn triangle(c: &Constrained2, [a, b, d]: [VertexId; 3]) -> Option<TriangleId> {
    let mesh = c.mesh();
    let e = mesh.edge_between(mesh.place(a)?, mesh.place(b)?)?;
    (mesh.tip(e) == mesh.place(d)?).then(|| e.triangle())
}
