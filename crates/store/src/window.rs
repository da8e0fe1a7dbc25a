//! A part of a folder of tiles, or some of its points.
//!
//! Of a box: every triangle that may meet it, from the tiles whose region does and from all seams. The triangulation
//! of the corners contains all of them, because a circle that is empty of all points is empty of these. [`Part::tile_of`] tells them
//! from other triangles. Of an overview: points at equal steps along the curve of each tile.
//!
//! Cost: reading the tiles and seams concerned, one at a time.

use std::collections::BTreeMap;
use std::path::PathBuf;

use delone::tiles::{Node, Region};

use crate::error::Error;
use crate::places::place;
use crate::shards;
use crate::store::{Corner, Store};
use crate::sums::Sums;
use crate::watch::{Phase, Watch};

/// A name that is of no point.
const FOREIGN: &str = "a triangle has a corner that is no point";

/// Points of a folder, and triangles between them.
#[derive(Clone, Debug, Default)]
pub struct Part {
    corners: BTreeMap<u64, Corner>,
    /// By their sorted corners, with the tile that they are of, if it is one.
    triangles: BTreeMap<[u64; 3], Option<Node>>,
}

impl Part {
    /// The names of the points, ascending: the number of the tile times 2^32, and the index there.
    pub fn names(&self) -> Vec<u64> {
        self.corners.keys().copied().collect()
    }

    /// The points, by their names.
    pub fn points(&self) -> Vec<[f64; 2]> {
        self.corners.values().map(|corner| corner.0).collect()
    }

    /// The heights of the points, or zeros.
    pub fn heights(&self) -> Vec<f64> {
        self.corners.values().map(|corner| corner.1).collect()
    }

    /// The number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// The tile of the triangle with these corners: `Some(None)` for a triangle of a seam, `None` if the part has no such triangle.
    pub fn tile_of(&self, corners: [u64; 3]) -> Option<Option<Node>> {
        self.triangles.get(&sorted(corners)).copied()
    }
}

impl Store {
    /// All triangles that may meet a box, and their corners.
    ///
    /// # Errors
    /// [`Error::Changed`] if a file is not there or not as it was written; [`Error::Stopped`].
    pub fn window(&self, window: &Region, watch: &dyn Watch) -> Result<Part, Error> {
        let (nodes, reader) = self.reader(window, watch);
        reader.part(&nodes)
    }

    /// Of the points in a box one in so many, at equal steps along the curve of each tile; no triangles.
    ///
    /// # Errors
    /// As [`Self::window`].
    pub fn overview(&self, window: &Region, step: usize, watch: &dyn Watch) -> Result<Part, Error> {
        let (nodes, reader) = self.reader(window, watch);
        reader.overview(&nodes, step.max(1))
    }

    fn reader<'a>(&'a self, window: &Region, watch: &'a dyn Watch) -> (Vec<Node>, Reader<'a>) {
        let known: BTreeMap<Node, Sums> = self.nodes().map(|done| (done.node, done.sums)).collect();
        let nodes = self.nodes().map(|done| done.node).collect();
        (nodes, Reader { store: self, known, window: *window, watch })
    }
}

/// Whoever reads the tiles of a window.
struct Reader<'a> {
    store: &'a Store,
    /// The hashes of the files of each node.
    known: BTreeMap<Node, Sums>,
    window: Region,
    watch: &'a dyn Watch,
}

impl Reader<'_> {
    /// The triangles that may meet the window.
    fn part(&self, nodes: &[Node]) -> Result<Part, Error> {
        let mut part = Part::default();
        let mut seams: Vec<[u64; 3]> = Vec::new();
        let phase = Phase::count(self.watch, "reading", nodes.len() as u64);
        for &node in nodes.iter().filter(|&&node| self.store.plan.cuts.is_tile(node) && self.meets(node)) {
            let points = self.points(node)?;
            let path = self.checked("triangles", node)?;
            for t in shards::triangles(&path)? {
                let Some(corners) = corners(&points, t) else { return Err(Error::changed(&path, FOREIGN)) };
                if self.shows(corners.map(|corner| corner.0)) {
                    part.add(t.map(|v| node.id(v as u32)), corners, Some(node));
                }
            }
            phase.advance()?;
        }
        for &node in nodes.iter().filter(|&&node| !self.store.plan.cuts.is_tile(node)) {
            let path = self.checked("seam", node)?;
            seams.extend(shards::triangles(&path)?);
            phase.advance()?;
        }
        let known =
            shards::corners(&self.store.folder, &self.store.plan.cuts, &seams, |node| self.points(node))?;
        for t in seams {
            let corners = t.map(|id| known[&id]);
            if self.shows(corners.map(|corner| corner.0)) {
                part.add(t, corners, None);
            }
        }
        Ok(part)
    }

    /// Of the points in the window one in so many.
    fn overview(&self, nodes: &[Node], step: usize) -> Result<Part, Error> {
        let mut part = Part::default();
        let phase = Phase::count(self.watch, "reading", nodes.len() as u64);
        for &node in nodes.iter().filter(|&&node| self.store.plan.cuts.is_tile(node) && self.meets(node)) {
            let points = self.points(node)?;
            let chosen =
                points.iter().enumerate().step_by(step).filter(|(_, point)| self.window.contains(point.0));
            part.corners.extend(chosen.map(|(v, &point)| (node.id(v as u32), point)));
            phase.advance()?;
        }
        Ok(part)
    }

    /// The points of a tile, with heights or zeros.
    fn points(&self, node: Node) -> Result<Vec<Corner>, Error> {
        self.checked("points", node)?;
        self.store.points(node)
    }

    /// Where a file of a node is, if it is what was written.
    fn checked(&self, kind: &str, node: Node) -> Result<PathBuf, Error> {
        let path = place(&self.store.folder, kind, node, "npy");
        self.known.get(&node).map_or(Ok(()), |sums| sums.check_file(&path))?;
        Ok(path)
    }

    /// Whether the region of a node meets the window.
    fn meets(&self, node: Node) -> bool {
        let region = self.store.plan.cuts.region(node);
        (0..2).all(|k| region.low[k] <= self.window.high[k] && self.window.low[k] <= region.high[k])
    }

    /// Whether the box of a triangle meets the window.
    fn shows(&self, corners: [[f64; 2]; 3]) -> bool {
        (0..2).all(|k| {
            corners.iter().any(|p| p[k] >= self.window.low[k])
                && corners.iter().any(|p| p[k] <= self.window.high[k])
        })
    }
}

impl Part {
    fn add(&mut self, ids: [u64; 3], corners: [Corner; 3], tile: Option<Node>) {
        self.corners.extend(ids.into_iter().zip(corners));
        self.triangles.insert(sorted(ids), tile);
    }
}

/// The corners of a triangle of a tile, if they are points of it.
fn corners(points: &[Corner], t: [u64; 3]) -> Option<[Corner; 3]> {
    let [a, b, c] = t.map(|v| points.get(usize::try_from(v).ok()?).copied());
    Some([a?, b?, c?])
}

fn sorted(mut ids: [u64; 3]) -> [u64; 3] {
    ids.sort_unstable();
    ids
}
