//! Construction by splits and flips in random order, located by conflict lists (see `locate::conflict_lists`).
//!
//! Cost: O(n log n) expected; 32 bytes a triangle and 12 a point beside the result.

use delone_predicates::lexicographic;

use crate::duplicates::settle;
use crate::ids::{Duplicate, Place, TriangleId, VertexId};
use crate::locate::conflict_lists::ConflictLists;
use crate::mesh::Mesh2;
use crate::order::random::SplitMix;
use crate::plane::flips::{DUMMIES, Flips};
use crate::tally::Work;

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
    settle(&mut duplicates);
    let moved = lists.moved;
    drop(lists);
    let place = |p: Place| match p.index() {
        0..DUMMIES => Place::GHOST,
        i => Place::new(index[i - DUMMIES] as usize),
    };
    let mut mesh = Mesh2::closed(points.len(), &flips.mesh, place).unwrap_or_else(|| {
        let mut chain: Vec<Place> =
            vertices.iter().map(|&i| Place::new(index[i as usize] as usize)).collect();
        chain.sort_unstable_by(|a, b| lexicographic(points[a.index()], points[b.index()]));
        let mut mesh = Mesh2::empty(points.len());
        mesh.build_line(chain.into_iter().map(|v| (v, false)));
        mesh
    });
    mesh.vertex_count = vertices.len();
    (mesh, duplicates, work, moved)
}
