//! Parts triangulated apart, each by whoever has time, and joined by the triangulation of the points near the cuts.
//!
//! Source: Funke & Sanders, "Parallel d-d Delaunay triangulations in shared and distributed memory", ALENEX 2017. The sure
//! tetrahedra of the parts ([`super::part`]) stay. What they leave open is a hole, and every tetrahedron that all points
//! have there has its corners at the border: its vertices of one part are also corners of something of the part that
//! is not sure. It is one of the triangulation of the border's vertices, which by the canonical rule is unique and
//! fits; and to fill it in is what removal does in the small ([`super::super::layer::hole`]).
//!
//! How the points are cut depends on them alone, and the parts own their memory, so the result is the same bits for any
//! number of threads. With weights a vertex of a part may be hidden by sites of another one: then it is at the border, and
//! inside of the hole, and the triangulation of the border's vertices hides it too. Cost: that of [`super::build`], divided by the threads, and once more for the points near the
//! cuts, a tenth at most as far as samples can tell.

use super::super::layer::Layer;
use super::super::layer::kernel::{Lift, Region};
use super::cut::{Sites, cut, uncut};
use super::part::{Done, Part};
use super::{Rest, room, triangulate_runs};
use crate::ids::{FacetId, Place, TetrahedronId, VertexId};
use crate::mesh::Dimension;
use crate::mesh::tetrahedra::surgery::turned;
use crate::mesh::tetrahedra::{Mesh3, Tetrahedron};
use crate::parallel;
use crate::tally::Tally;

/// A bit of the marks of tetrahedra that fill the hole; the lower four tell which facets are at its border.
const FILLS: u8 = 16;

/// Triangulates the sites of a layer, where one run is kept after the other: their lengths, and regions of all sites of the
/// others. Says which are no vertices. `None` if they are not such that it can be done.
pub(super) fn triangulate<W: Lift, T: Tally + Default + Send>(
    layer: &mut Layer<W>,
    runs: &[(usize, Vec<Region<W>>)],
    seed: u64,
    tally: &mut T,
) -> Option<Rest> {
    let parts = build_parts(layer, runs, seed, tally)?;
    let mut rest = Rest { hidden: join(layer, &parts, seed, tally)?, ..Rest::default() };
    for part in parts {
        rest.equal.extend(part.rest.equal);
        rest.hidden.extend(part.rest.hidden);
    }
    layer.mesh.vertex_count = layer.points.len() - rest.equal.len() - rest.hidden.len();
    Some(rest)
}

/// Triangulates each run in its part of the layer's memory.
fn build_parts<W: Lift, T: Tally + Default + Send>(
    layer: &mut Layer<W>,
    runs: &[(usize, Vec<Region<W>>)],
    seed: u64,
    tally: &mut T,
) -> Option<Vec<Done>> {
    let mesh = &mut layer.mesh;
    let sums = |length: &dyn Fn(usize) -> usize| -> Vec<usize> {
        let sum = |end: &mut usize, run: &(usize, Vec<Region<W>>)| {
            *end += length(run.0);
            Some(*end)
        };
        runs.iter().scan(0, sum).collect()
    };
    let (ends, rooms) = (sums(&|points| points), sums(&room));
    let slots = rooms.last().copied().unwrap_or(0);
    mesh.cells = parallel::filled_in_small_pages(Tetrahedron::FREE, slots);
    mesh.marks = vec![0; slots];
    let cells = parallel::split_at(&mut mesh.cells, &rooms);
    let marks = parallel::split_at(&mut mesh.marks, &rooms);
    let incident = parallel::split_at(&mut mesh.incident, &ends);
    let starts: Vec<(usize, usize)> =
        std::iter::once((0, 0)).chain(ends.iter().copied().zip(rooms.iter().copied())).collect();
    let tasks =
        cells.into_iter().zip(marks).zip(incident).enumerate().map(|(k, ((cells, marks), incident))| {
            let places = starts[k].0..ends[k];
            let sites = (&layer.points[places.clone()], &layer.weights[places]);
            (k, Part::new(sites, cells, marks, incident))
        });
    let build = |(k, mut part): (usize, Part<'_, W>)| {
        let mut tally = T::default();
        part.build(seed, &mut tally)?;
        Some((part.settle(&runs[k].1, starts[k].0, starts[k].1), tally))
    };
    let parts: Option<Vec<(Done, T)>> = parallel::map(tasks.collect(), build).into_iter().collect();
    let parts = parts?.into_iter().map(|(part, of_part)| {
        tally.add(&of_part);
        part
    });
    Some(parts.collect())
}

/// Fills what the borders of the parts leave open, and says which of the vertices there it hides. `None` if they do not span
/// space.
fn join<W: Lift, T: Tally + Default + Send>(
    layer: &mut Layer<W>,
    parts: &[Done],
    seed: u64,
    tally: &mut T,
) -> Option<Vec<Place>> {
    // Memory for what fills the hole.
    layer.mesh.marks = Vec::new();
    let vertices: Vec<Place> = parts.iter().flat_map(|part| part.vertices.iter().copied()).collect();
    let at: Vec<[f64; 3]> = vertices.iter().map(|p| layer.points[p.index()]).collect();
    let weights: Vec<W> = vertices.iter().map(|p| layer.weights[p.index()]).collect();
    let sites = Sites { points: &at, weights: &weights };
    // Cut again only if they are fewer by half, so that this has an end whatever samples foretold.
    let runs = if 2 * at.len() < layer.points.len() { cut(sites) } else { uncut(sites) };
    let (mut fill, rest) = triangulate_runs(at, weights, runs, seed, tally)?;
    if fill.dimension() != Dimension::Space {
        return None;
    }
    let walls = find_walls(&mut fill.mesh, &vertices, parts)?;
    let inside = find_inside(&mut fill.mesh, &walls);

    let border = parts.iter().flat_map(|part| &part.border);
    let mut slots: Vec<TetrahedronId> =
        parts.iter().flat_map(|part| &part.free).chain(border).copied().collect();
    let mesh = &mut layer.mesh;
    slots.iter().for_each(|&t| mesh.records().clear(t));
    slots.extend(parts.iter().flat_map(|part| part.unused.clone()).map(TetrahedronId::new));
    if slots.len() < inside.len() {
        return None;
    }
    let mut becomes = vec![TetrahedronId::NONE; fill.mesh.cells.len()];
    inside.iter().zip(&slots).for_each(|(t, &to)| becomes[t.index()] = to);
    let place = |p: Place| if p.is_ghost() { p } else { vertices[fill.mesh.names.of(p).index()] };
    for (&t, &to) in inside.iter().zip(&slots) {
        let cell = fill.mesh.cells[t.index()];
        let across = cell.across.map(|f| match becomes[f.tetrahedron().index()] {
            TetrahedronId::NONE => FacetId::NONE,
            there => there.facet(f.corner()),
        });
        mesh.records().put(to, Tetrahedron { corners: cell.corners.map(place), across });
    }
    for &(f, outside) in &walls {
        mesh.records().link(becomes[f.tetrahedron().index()].facet(f.corner()), outside);
    }
    let left = &mut slots[inside.len()..];
    left.sort_unstable();
    mesh.pack(left);
    mesh.marks = vec![0; mesh.cells.len()];
    let hidden: Vec<Place> = rest.hidden.into_iter().map(place).collect();
    hidden.iter().for_each(|p| mesh.incident[p.index()] = TetrahedronId::NONE);
    Some(hidden)
}

/// Finds the facets of the border of the hole in the triangulation of its vertices, as it sees them from inside, with
/// their other sides, and marks them. `None` if some are not there.
fn find_walls(fill: &mut Mesh3, vertices: &[Place], parts: &[Done]) -> Option<Vec<(FacetId, FacetId)>> {
    let count = parts.iter().map(|part| part.seam.len()).sum();
    let mut seam: Vec<([Place; 3], FacetId)> = Vec::with_capacity(count);
    for &(corners, outside) in parts.iter().flat_map(|part| &part.seam) {
        let mut inside = [Place::GHOST; 3];
        for (to, p) in inside.iter_mut().zip(corners).filter(|(_, p)| !p.is_ghost()) {
            *to = fill.names.place(VertexId::new(vertices.binary_search(&p).ok()?))?;
        }
        // The ghost is the largest.
        seam.push((turned(inside), outside));
    }
    seam.sort_unstable();
    // For each place where those begin that have it for their smallest corner.
    let mut begin = vec![0; vertices.len() + 1];
    seam.iter().for_each(|(corners, _)| begin[corners[0].index() + 1] += 1);
    let mut sum = 0;
    for at in &mut begin {
        sum += *at;
        *at = sum;
    }
    let mut is_at_wall = vec![false; vertices.len()];
    let at_walls = seam.iter().flat_map(|(corners, _)| corners).filter(|p| !p.is_ghost());
    at_walls.for_each(|p| is_at_wall[p.index()] = true);
    let mut walls = Vec::with_capacity(count);
    for t in 0..fill.cells.len() {
        // Most have no three corners at one.
        let at_wall = |p: &&Place| p.is_ghost() || is_at_wall[p.index()];
        if fill.cells[t].corners.iter().filter(at_wall).count() < 3 {
            continue;
        }
        let t = TetrahedronId::new(t);
        for f in [0, 1, 2, 3].map(|k| t.facet(k)) {
            let corners = turned(fill.facet_places(f));
            if corners[0].is_ghost() {
                continue;
            }
            let at = corners[0].index();
            if let Some((_, outside)) = seam[begin[at]..begin[at + 1]].iter().find(|facet| facet.0 == corners)
            {
                fill.marks[t.index()] |= 1 << f.corner();
                walls.push((f, *outside));
            }
        }
    }
    (walls.len() == count).then_some(walls)
}

/// The tetrahedra inside of walls; all if there are none.
fn find_inside(fill: &mut Mesh3, walls: &[(FacetId, FacetId)]) -> Vec<TetrahedronId> {
    let any = fill.cells().next().filter(|_| walls.is_empty());
    let mut inside = Vec::new();
    for t in walls.iter().map(|(f, _)| f.tetrahedron()).chain(any) {
        if fill.marks[t.index()] & FILLS == 0 {
            fill.marks[t.index()] |= FILLS;
            inside.push(t);
        }
    }
    let mut done = 0;
    while let Some(&t) = inside.get(done) {
        done += 1;
        let walls = fill.marks[t.index()];
        for k in (0..4).filter(|k| walls >> k & 1 == 0) {
            let next = fill.twin(t.facet(k)).tetrahedron();
            if fill.marks[next.index()] & FILLS == 0 {
                fill.marks[next.index()] |= FILLS;
                inside.push(next);
            }
        }
    }
    inside
}

#[cfg(test)]
mod tests;
