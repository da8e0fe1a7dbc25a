//! Construction by splits and flips in random order: one mesh, which is closed with ghosts in the end.
//!
//! Where the next point is, conflict lists know beforehand (`conflict_lists.rs`), or the history is traced, once a
//! point (`history.rs`): the algorithm of Guibas, Knuth & Sharir, Algorithmica 1992, §3.
//!
//! Cost: O(n log n) expected. Beside the result lists take 32 bytes a triangle and 12 a point; a history stays with the result.

use delone_predicates::lexicographic;

use super::conflict_lists::ConflictLists;
use super::flips::{DUMMIES, Flips};
use super::history::Observer;
use super::versions::Versions;
use crate::duplicates::settle;
use crate::ids::{Duplicate, Place, TriangleId, VertexId};
use crate::mesh::Mesh2;
use crate::order::random::SplitMix;
use crate::sorting;
use crate::tally::Work;

/// Triangulates points by conflict lists; returns also the work and how often a point was put into a list.
pub(super) fn by_lists(points: &[[f64; 2]], seed: u64) -> (Mesh2, Vec<Duplicate>, Work, u64) {
    let mut flips = Flips::new();
    flips.points.extend(points);
    let mut lists = ConflictLists::new(points.len(), TriangleId::new(0));
    let mut build = Build::new(points.len());
    for i in random_order(points.len(), seed) {
        let t = lists.home(i);
        lists.remove(i);
        build.insert(&mut flips, i, t, &mut lists);
    }
    let moved = lists.moved;
    drop(lists);
    let mesh = build.close(&flips, |_| true);
    (mesh, build.duplicates, build.work, moved)
}

/// Triangulates points by their history, which can be gone on with.
pub(super) fn by_history(points: &[[f64; 2]], seed: u64) -> (Mesh2, Vec<Duplicate>, Work, Versions) {
    let mut versions = Versions::new();
    versions.flips.points.extend(points);
    let mut build = Build::new(points.len());
    for i in random_order(points.len(), seed) {
        let t = versions.trace(points[i as usize], &mut build.work);
        build.insert(&mut versions.flips, i, t, &mut versions.history);
    }
    let mesh = build.close(&versions.flips, |t| versions.history.fork(t).is_none());
    versions.places = build.stands.into_iter().map(|i| Place::new(i as usize)).collect();
    (mesh, build.duplicates, build.work, versions)
}

fn random_order(count: usize, seed: u64) -> Vec<u32> {
    let mut order: Vec<u32> = (0..count as u32).collect();
    SplitMix(seed).shuffle(&mut order);
    order
}

/// The points while they are inserted. Point i is at place i + [`DUMMIES`].
struct Build {
    /// For each point the index that stands for it, if it was inserted: the first of equal points given is their vertex.
    stands: Vec<u32>,
    vertices: Vec<u32>,
    duplicates: Vec<Duplicate>,
    work: Work,
}

impl Build {
    fn new(count: usize) -> Self {
        Self {
            stands: (0..count as u32).collect(),
            vertices: Vec::with_capacity(count),
            duplicates: Vec::new(),
            work: Work::default(),
        }
    }

    /// Makes a point in a present triangle a vertex, or finds that it is one.
    fn insert<O: Observer<Flips>>(&mut self, flips: &mut Flips, i: u32, t: TriangleId, observer: &mut O) {
        let p = Place::new(DUMMIES + i as usize);
        if let Some(equal) = flips.equal(t, flips.points[p.index()]) {
            let stands = &mut self.stands[equal.index() - DUMMIES];
            let (first, later) = (i.min(*stands), i.max(*stands));
            *stands = first;
            let vertex = VertexId::new(first as usize);
            self.duplicates.push(Duplicate { point: later as usize, vertex });
        } else {
            flips.insert(p, t, observer, &mut self.work);
            self.vertices.push(i);
        }
    }

    /// The present triangles without dummies, closed with ghosts.
    fn close(&mut self, flips: &Flips, is_present: impl Fn(TriangleId) -> bool) -> Mesh2 {
        settle(&mut self.duplicates);
        let count = self.stands.len();
        let stands = |i: usize| Place::new(self.stands[i] as usize);
        let place = |p: Place| p.index().checked_sub(DUMMIES).map_or(Place::GHOST, stands);
        let mut mesh = Mesh2::closed(count, &flips.mesh, is_present, place).unwrap_or_else(|| {
            let mut chain: Vec<Place> = self.vertices.iter().map(|&i| stands(i as usize)).collect();
            let point = |v: &Place| flips.points[DUMMIES + v.index()];
            sorting::by(&mut chain, |a, b| lexicographic(point(a), point(b)));
            let mut mesh = Mesh2::empty(count);
            mesh.build_line(chain.into_iter().map(|v| (v, false)));
            mesh
        });
        mesh.vertex_count = self.vertices.len();
        mesh
    }
}
