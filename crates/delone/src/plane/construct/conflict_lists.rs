//! Construction by splits and flips in random order, located by conflict lists (see `locate::conflict_lists`).
//!
//! Cost: O(n log n) expected; 32 bytes a triangle and 12 a point beside the result.

use delone_predicates::lexicographic;

use crate::ids::{Duplicate, EdgeId, Place, TriangleId, VertexId};
use crate::locate::conflict_lists::ConflictLists;
use crate::mesh::Mesh2;
use crate::order::random::SplitMix;
use crate::tally::Work;

use crate::plane::flips::{DUMMIES, Flips};
use crate::plane::layer::line;

/// Triangulates points; returns also the work and how often a point was put into a list.
pub(super) fn triangulate(points: &[[f64; 2]], seed: u64) -> (Mesh2, Vec<Duplicate>, Work, u64) {
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    SplitMix(seed).shuffle(&mut order);
    let mut flips = Flips::new();
    flips.points.extend(points);
    let mut lists = ConflictLists::new(points.len(), TriangleId::new(0));
    let mut work = Work::default();
    // For each point the index that stands for it, if it was inserted.
    let mut index: Vec<u32> = (0..points.len() as u32).collect();
    let mut duplicates = Vec::new();
    let mut vertices = Vec::with_capacity(points.len());
    for i in order {
        let t = lists.home(i);
        lists.remove(i);
        if let Some(equal) = flips.equal(t, points[i as usize]) {
            // The first of equal points given is their vertex.
            let stands = &mut index[equal.index() - DUMMIES];
            let (first, later) = (i.min(*stands), i.max(*stands));
            *stands = first;
            let vertex = VertexId::new(first as usize);
            duplicates.push(Duplicate { point: later as usize, vertex });
        } else {
            flips.insert(Place::new(DUMMIES + i as usize), t, &mut lists, &mut work);
            vertices.push(i);
        }
    }
    Duplicate::settle(&mut duplicates);
    let moved = lists.moved;
    drop(lists);
    let place = |p: Place| match p.index() {
        0..DUMMIES => Place::GHOST,
        i => Place::new(index[i - DUMMIES] as usize),
    };
    let mut mesh = Mesh2::empty(points.len());
    mesh.vertex_count = vertices.len();
    if !close(&flips, &mut mesh, place) {
        let mut chain: Vec<Place> =
            vertices.iter().map(|&i| Place::new(index[i as usize] as usize)).collect();
        chain.sort_unstable_by(|a, b| lexicographic(points[a.index()], points[b.index()]));
        line::build(&mut mesh, chain);
    }
    (mesh, duplicates, work, moved)
}

/// Copies the finite triangles and closes them with ghosts. False if there are none.
fn close(flips: &Flips, mesh: &mut Mesh2, place: impl Fn(Place) -> Place) -> bool {
    let count = flips.edges.len() / 4;
    let corners = |t: usize| flips.corners(TriangleId::new(t)).map(&place);
    let mut image = vec![None; count];
    for (t, image) in image.iter_mut().enumerate() {
        let corners = corners(t);
        if !corners.contains(&Place::GHOST) {
            let new = mesh.new_triangle(TriangleId::new(0));
            mesh.set_corners(new, corners);
            *image = Some(new);
        }
    }
    // For each vertex of the hull the ghost of the hull edge that leaves it.
    let mut leaving = vec![None; mesh.incident.len()];
    for t in 0..count {
        let Some(new) = image[t] else { continue };
        for k in 0..3 {
            let twin = flips.edges[4 * t + k].twin;
            let across = if twin == EdgeId::NONE { None } else { image[twin.triangle().index()] };
            let e = new.edge(k);
            if let Some(across) = across {
                mesh.link(e, across.edge(twin.corner()));
            } else {
                let (u, v) = (mesh.tail(e), mesh.head(e));
                let ghost = mesh.new_triangle(TriangleId::new(0));
                mesh.set_corners(ghost, [v, u, Place::GHOST]);
                mesh.link(ghost.edge(0), e);
                leaving[u.index()] = Some(ghost);
            }
            mesh.remember(e);
        }
    }
    for ghost in leaving.iter().flatten() {
        let v = mesh.tail(ghost.edge(0));
        let next: TriangleId = leaving[v.index()].expect("the hull is closed");
        mesh.link(ghost.edge(2), next.edge(1));
        mesh.remember(ghost.edge(2));
    }
    mesh.slot_count() > 0
}
