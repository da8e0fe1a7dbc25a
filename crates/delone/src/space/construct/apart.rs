//! Parts triangulated apart, each by whoever has time, and joined by the triangulation of the points near the cuts.
//!
//! Source: Funke & Sanders, "Parallel d-d Delaunay triangulations in shared and distributed memory", ALENEX 2017. The sure
//! tetrahedra of the parts ([`super::part`]) stay. What they leave open is a hole, and every tetrahedron that all points
//! have there has its corners at the border: its vertices of one part are also corners of something of the part that
//! is not sure. It is one of the triangulation of the border's vertices, which by the canonical rule is unique and
//! fits; and to fill it in is what removal does in the small ([`super::super::layer::hole`]).
//!
//! How the points are cut depends on them alone, and the parts own their memory, so the result is the same bits for any
//! number of threads. Cost: that of [`super::build`], divided by the threads, and once more for the points near the
//! cuts, a tenth at most as far as samples can tell.

use super::super::layer::Layer;
use super::super::layer::hole::turned;
use super::cut::{cut, uncut};
use super::part::{Done, Part};
use super::{note_equal, room, triangulate_runs};
use crate::ids::{Duplicate, FacetId, Place, TetrahedronId, VertexId};
use crate::mesh::Dimension;
use crate::mesh::tetrahedra::{Mesh3, Tetrahedron};
use crate::parallel;
use crate::points::Bounds;
use crate::tally::Tally;

/// A bit of the marks of tetrahedra that fill the hole; the lower four tell which facets are at its border.
const FILLS: u8 = 16;

/// Triangulates the points of a layer, where one run is kept after the other: their lengths, and boxes around all points
/// of the others. `None` if they are not such that it can be done.
pub(super) fn triangulate<T: Tally + Default + Send>(
    layer: &mut Layer,
    runs: &[(usize, Vec<Bounds<3>>)],
    seed: u64,
    duplicates: &mut Vec<Duplicate>,
    tally: &mut T,
) -> Option<()> {
    let parts = build_parts(layer, runs, seed, tally)?;
    join(layer, &parts, seed, tally)?;
    parts.iter().for_each(|part| note_equal(layer, &part.equal, duplicates));
    layer.mesh.vertex_count = layer.points.len() - duplicates.len();
    Some(())
}

/// Triangulates each run in its part of the layer's memory.
fn build_parts<T: Tally + Default + Send>(
    layer: &mut Layer,
    runs: &[(usize, Vec<Bounds<3>>)],
    seed: u64,
    tally: &mut T,
) -> Option<Vec<Done>> {
    let mesh = &mut layer.mesh;
    let sums = |length: &dyn Fn(usize) -> usize| -> Vec<usize> {
        let sum = |end: &mut usize, run: &(usize, Vec<Bounds<3>>)| {
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
            (k, Part::new(&layer.points[starts[k].0..ends[k]], cells, marks, incident))
        });
    let build = |(k, mut part): (usize, Part<'_>)| {
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

/// Fills what the borders of the parts leave open. `None` if the vertices there do not span space.
fn join<T: Tally + Default + Send>(
    layer: &mut Layer,
    parts: &[Done],
    seed: u64,
    tally: &mut T,
) -> Option<()> {
    // Memory for what fills the hole.
    layer.mesh.marks = Vec::new();
    let vertices: Vec<Place> = parts.iter().flat_map(|part| part.vertices.iter().copied()).collect();
    let at: Vec<[f64; 3]> = vertices.iter().map(|p| layer.points[p.index()]).collect();
    // Cut again only if they are fewer by half, so that this has an end whatever samples foretold.
    let runs = if 2 * at.len() < layer.points.len() { cut(&at) } else { uncut(&at) };
    let (mut fill, _) = triangulate_runs(at, runs, seed, tally)?;
    if fill.dimension() != Dimension::Space {
        return None;
    }
    let walls = find_walls(&mut fill.mesh, &vertices, parts)?;
    let inside = find_inside(&mut fill.mesh, &walls);

    let border = parts.iter().flat_map(|part| &part.border);
    let mut slots: Vec<TetrahedronId> =
        parts.iter().flat_map(|part| &part.free).chain(border).copied().collect();
    let mesh = &mut layer.mesh;
    slots.iter().for_each(|t| mesh.cells[t.index()] = Tetrahedron::FREE);
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
        mesh.cells[to.index()] = Tetrahedron { corners: cell.corners.map(place), across };
        let corners = mesh.cells[to.index()].corners;
        corners.into_iter().filter(|p| !p.is_ghost()).for_each(|p| mesh.incident[p.index()] = to);
    }
    for &(f, outside) in &walls {
        mesh.link(becomes[f.tetrahedron().index()].facet(f.corner()), outside);
    }
    let left = &mut slots[inside.len()..];
    left.sort_unstable();
    mesh.pack(left);
    mesh.marks = vec![0; mesh.cells.len()];
    Some(())
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
    let mut walls = Vec::with_capacity(count);
    for t in 0..fill.cells.len() {
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
mod tests {
    use super::super::cut::divide;
    use super::super::triangulate_whole;
    use super::triangulate;
    use crate::duplicates::{Duplicates, settle};
    use crate::mesh::Names;
    use crate::space::Delaunay3;
    use crate::space::layer::Layer;
    use delone_generators::Kind3;

    /// All tetrahedra, ghosts included, as sorted corners.
    fn cells(d: &Delaunay3) -> Vec<[usize; 4]> {
        let mesh = d.mesh();
        let corners = |t| {
            let mut corners = mesh.corners(t).map(crate::VertexId::index);
            corners.sort_unstable();
            corners
        };
        let mut cells: Vec<[usize; 4]> = mesh.cells().map(corners).collect();
        cells.sort_unstable();
        cells
    }

    #[test]
    fn parts_are_joined_to_the_one_triangulation() {
        let mut joined = 0;
        for &kind in Kind3::ALL {
            for (count, cuts) in [(40, 1), (300, 1), (700, 3), (1500, 2)] {
                let points = kind.points(count, 7);
                let all = (0..points.len() as u32).collect();
                let runs = divide(&points, all, cuts, Vec::new());
                if runs.len() == 1 {
                    continue;
                }
                let order: Vec<u32> = runs.iter().flat_map(|run| run.order.iter().copied()).collect();
                let mut layer = Layer::new(order.iter().map(|&i| points[i as usize]).collect());
                layer.mesh.names = Names::along(&order);
                let (mut whole, mut duplicates) = (layer.clone(), Vec::new());
                let runs: Vec<_> = runs.into_iter().map(|run| (run.order.len(), run.others)).collect();
                if triangulate(&mut layer, &runs, 0, &mut duplicates, &mut ()).is_none() {
                    continue;
                }
                joined += 1;
                settle(&mut duplicates);
                let apart = Delaunay3 {
                    base: layer,
                    duplicates: Duplicates::new(duplicates),
                    ..Delaunay3::default()
                };
                apart.check().unwrap_or_else(|flaw| panic!("{} {count}: {flaw}", kind.name()));
                let mut duplicates = Vec::new();
                triangulate_whole(&mut whole, 0, &mut duplicates, &mut ());
                settle(&mut duplicates);
                let whole = Delaunay3 {
                    base: whole,
                    duplicates: Duplicates::new(duplicates),
                    ..Delaunay3::default()
                };
                assert_eq!(cells(&apart), cells(&whole), "{} {count}", kind.name());
                assert!(apart.duplicates().eq(whole.duplicates()), "{} {count}", kind.name());
            }
        }
        assert!(joined > 40, "{joined}");
    }
}
