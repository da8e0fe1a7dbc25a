//! Neighbors: what is across each edge of each triangle, in tiles, in seams and between them.
//!
//! Inside of a tile it is a row of the same file. What has no triangle of its tile across waits for the seams: no edge is between
//! final triangles of two tiles, because these have no corner in common.
//!
//! Cost: O(n log n); memory for the largest tile, some 150 bytes a point, and for all edges between tiles, 80 bytes each.

use std::path::Path;

use delone::tiles::Node;
use delone_io::write_array;
use rayon::prelude::*;

use crate::error::Error;
use crate::manifest::{Manifest, Outcome};
use crate::node::Done;
use crate::places::place;
use crate::shards;
use crate::sums::Written;
use crate::watch::{Phase, Watch};

/// No triangle of this file is across: the edge is on the hull, or `across-NNNNN.npy` has its neighbor.
const NONE: u32 = u32::MAX;

/// An edge of a triangle, opposite to one of its corners.
#[derive(Clone, Copy)]
struct Side {
    /// The names of its ends, the lesser first.
    ends: [u64; 2],
    /// The number of the node times 2^32, and the row.
    triangle: u64,
    corner: u64,
}

/// Writes the neighbors of all nodes.
pub(crate) fn write(
    folder: &Path,
    plan: &Manifest,
    outcome: &Outcome,
    watch: &dyn Watch,
) -> Result<Written, Error> {
    let nodes: Vec<Done> = outcome.nodes.iter().filter_map(Done::parse).collect();
    let phase = Phase::count(watch, "finding neighbors", nodes.len() as u64);
    let (mut waiting, mut written) = (Vec::new(), Written::new());
    for done in &nodes {
        if plan.cuts.is_tile(done.node) {
            in_tile(folder, done, &mut waiting, &mut written)?;
        } else {
            in_seam(folder, done, &mut waiting)?;
        }
        phase.advance()?;
    }
    let across = pair(folder, waiting)?;
    let mut rest = &across[..];
    let mut of_node = |node: Node| {
        let count = rest.partition_point(|found| found[0] >> 32 <= u64::from(node.number()));
        let (own, others) = rest.split_at(count);
        rest = others;
        own
    };
    let mut sorted = nodes;
    sorted.sort_unstable_by_key(|done| done.node);
    for done in &sorted {
        let sums = written.entry(done.node).or_default();
        let found = of_node(done.node);
        let row = |triangle: u64| triangle & u64::from(u32::MAX);
        if plan.cuts.is_tile(done.node) {
            let rows = found.iter().flat_map(|&[triangle, corner, other]| [row(triangle), corner, other]);
            sums.write(&place(folder, "across", done.node, "npy"), |out| {
                Ok(write_array(out, &[found.len(), 3], rows.clone())?)
            })?;
        } else {
            let mut neighbors = vec![u64::MAX; 3 * done.fingerprint.count() as usize];
            for &[triangle, corner, other] in found {
                neighbors[(3 * row(triangle) + corner) as usize] = other;
            }
            sums.write(&place(folder, "neighbors", done.node, "npy"), |out| {
                Ok(write_array(out, &[neighbors.len() / 3, 3], neighbors.iter().copied())?)
            })?;
        }
    }
    Ok(written)
}

/// The neighbors inside of a tile; what has none there waits.
fn in_tile(folder: &Path, done: &Done, waiting: &mut Vec<Side>, written: &mut Written) -> Result<(), Error> {
    let node = done.node;
    let path = place(folder, "triangles", node, "npy");
    let triangles = triangles(&path, done)?;
    let count = triangles.len();
    if triangles.as_flattened().iter().any(|&v| v >= done.vertices) {
        return Err(Error::changed(&path, "a triangle has a corner that is no point"));
    }
    // Both ends, the lesser first, and three times the row with the corner.
    let mut edges: Vec<(u64, u32)> = Vec::with_capacity(3 * count);
    for (row, t) in triangles.into_iter().enumerate() {
        edges.extend((0..3).map(|k| {
            let [a, b] = ends(t, k);
            (a << 32 | b, (3 * row + k) as u32)
        }));
    }
    edges.par_sort_unstable();
    let mut neighbors = vec![NONE; 3 * count];
    for group in edges.chunk_by(|e, f| e.0 == f.0) {
        match *group {
            [(_, one), (_, other)] => {
                neighbors[one as usize] = other / 3;
                neighbors[other as usize] = one / 3;
            }
            [(key, slot)] => waiting.push(Side {
                ends: [key >> 32, key & u64::from(u32::MAX)].map(|v| node.id(v as u32)),
                triangle: node.id(slot / 3),
                corner: u64::from(slot % 3),
            }),
            _ => return Err(Error::changed(&path, "triangles overlap")),
        }
    }
    let sums = written.entry(node).or_default();
    sums.write(&place(folder, "neighbors", node, "npy"), |out| {
        Ok(write_array(out, &[count, 3], neighbors.iter().copied())?)
    })
}

/// All edges of a seam wait for each other and for those of tiles.
fn in_seam(folder: &Path, done: &Done, waiting: &mut Vec<Side>) -> Result<(), Error> {
    let node = done.node;
    for (row, t) in triangles(&place(folder, "seam", node, "npy"), done)?.into_iter().enumerate() {
        let side = |k: usize| Side { ends: ends(t, k), triangle: node.id(row as u32), corner: k as u64 };
        waiting.extend((0..3).map(side));
    }
    Ok(())
}

/// As many triangles as the node has.
fn triangles(path: &Path, done: &Done) -> Result<Vec<[u64; 3]>, Error> {
    let triangles = shards::triangles(path)?;
    if triangles.len() as u64 != done.fingerprint.count() {
        return Err(Error::changed(path, "the triangles are not those that tiles.json knows"));
    }
    Ok(triangles)
}

/// The ends of the edge of a triangle that is opposite to a corner, the lesser first.
fn ends(t: [u64; 3], corner: usize) -> [u64; 2] {
    let [a, b] = [t[(corner + 1) % 3], t[(corner + 2) % 3]];
    [a.min(b), a.max(b)]
}

/// Triangle, corner and what is across, for all that found another one, by triangle.
fn pair(folder: &Path, mut waiting: Vec<Side>) -> Result<Vec<[u64; 3]>, Error> {
    waiting.par_sort_unstable_by_key(|side| side.ends);
    let mut across = Vec::new();
    for group in waiting.chunk_by(|one, other| one.ends == other.ends) {
        match *group {
            [one, other] => {
                across.push([one.triangle, one.corner, other.triangle]);
                across.push([other.triangle, other.corner, one.triangle]);
            }
            [_] => {}
            _ => return Err(Error::changed(folder, "triangles overlap")),
        }
    }
    across.par_sort_unstable();
    Ok(across)
}
