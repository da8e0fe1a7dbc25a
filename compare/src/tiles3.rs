//! Triangulation in tiles of space beside that in memory: processor time of all threads, peak memory above the points, and the same set
//! of tetrahedra. Borders grow with the surface of tiles, so joins are much of both.

use std::collections::BTreeMap;

use delone::Delaunay3;
use delone::tiles::{Border3, Cuts, Fingerprint, Node, Tile3, join3};
use delone_generators::Kind3;

use crate::memory::{forget, most, resident};
use crate::tiles::processor;

const TILES: usize = 64;
/// Every so many points are the sample, in a hashed order.
const SAMPLE: usize = 64;
/// Levels of cuts that one join goes over.
const LEVELS: u32 = 3;

/// The result of a run.
struct Found {
    seconds: f64,
    bytes: f64,
    fingerprint: Fingerprint,
    /// Points of the borders of all tiles.
    border: usize,
    /// Points of the borders of the largest join, and bytes that each took.
    join: (usize, f64),
}

/// Prints the minimum over the runs of both ways; whether the tetrahedra are the same.
pub fn run(name: &str, size: usize, runs: usize) -> bool {
    let Some(kind) = Kind3::named(name) else {
        println!("there is no set in space named {name}");
        return false;
    };
    let points = kind.points(size, 1);
    let mut best: [Option<Found>; 2] = [None, None];
    let mut is_right = true;
    for _ in 0..runs {
        let (Some(memory), Some(tiles)) = (in_memory(&points), in_tiles(&points)) else { return false };
        is_right &= memory.fingerprint == tiles.fingerprint;
        for (best, found) in best.iter_mut().zip([memory, tiles]) {
            if best.as_ref().is_none_or(|best| found.seconds < best.seconds) {
                *best = Some(found);
            }
        }
    }
    let [Some(memory), Some(tiles)] = best else { return false };
    let each = |found: &Found| (found.seconds * 1e9 / size as f64, found.bytes / size as f64);
    let ((time, bytes), (time_of_tiles, bytes_of_tiles)) = (each(&memory), each(&tiles));
    println!(
        "  {name:12} {size:>10} {time:>7.0} {time_of_tiles:>7.0} ns of processor a point, {:.2} x; {bytes:.0} {bytes_of_tiles:.0} bytes a \
         point; borders {:.2} %, the largest join {} points, {:.0} bytes each; {} tetrahedra, fingerprint {}{}",
        time_of_tiles / time,
        100.0 * tiles.border as f64 / size as f64,
        tiles.join.0,
        tiles.join.1,
        tiles.fingerprint.count(),
        tiles.fingerprint,
        if is_right { "" } else { ", WRONG: not the same" }
    );
    is_right
}

fn in_memory(points: &[[f64; 3]]) -> Option<Found> {
    let (start, before) = (processor()?, resident()?);
    forget()?;
    let fingerprint = Fingerprint::of(&Delaunay3::from_points(points).ok()?);
    let (seconds, bytes) = (processor()? - start, most()? - before);
    Some(Found { seconds, bytes, fingerprint, border: 0, join: (0, 0.0) })
}

fn in_tiles(points: &[[f64; 3]]) -> Option<Found> {
    let (start, before) = (processor()?, resident()?);
    forget()?;
    let is_taken = |i: &usize| i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32 & (SAMPLE - 1) == 0;
    let sample: Vec<[f64; 3]> = (0..points.len()).filter(is_taken).map(|i| points[i]).collect();
    let cuts = Cuts::<3>::from_sample(&sample, TILES).ok()?;
    let mut buckets: BTreeMap<Node, Vec<[f64; 3]>> =
        cuts.tiles().into_iter().map(|node| (node, Vec::new())).collect();
    for &p in points {
        buckets.get_mut(&cuts.tile_of(p))?.push(p);
    }
    let (borders, fingerprint) = (BTreeMap::new(), Fingerprint::default());
    let mut joins = Joins { cuts: &cuts, borders, fingerprint, most: 0.0, largest: (0, 0.0) };
    let mut border = 0;
    for (node, bucket) in buckets {
        let tile = Tile3::new(&bucket, &cuts.region(node)).ok()?;
        joins.fingerprint += tile.fingerprint();
        let its = tile.border(|v| node.id(v));
        border += its.points.len();
        joins.borders.insert(node, its);
    }
    joins.most = most()?;
    joins.settle(Node::ROOT)?;
    let (seconds, bytes) = (processor()? - start, joins.most - before);
    Some(Found { seconds, bytes, fingerprint: joins.fingerprint, border, join: joins.largest })
}

struct Joins<'a> {
    cuts: &'a Cuts<3>,
    borders: BTreeMap<Node, Border3>,
    fingerprint: Fingerprint,
    /// Bytes at the peak so far.
    most: f64,
    largest: (usize, f64),
}

impl Joins<'_> {
    /// The border of a node, of those below it.
    fn settle(&mut self, node: Node) -> Option<Border3> {
        if let Some(border) = self.borders.remove(&node) {
            return Some(border);
        }
        let parts = self.cuts.parts(node, LEVELS).into_iter().map(|part| self.settle(part));
        let parts = parts.collect::<Option<Vec<_>>>()?;
        let points = parts.iter().map(|part| part.points.len()).sum();
        forget()?;
        let before = resident()?;
        let seam = join3(&parts, &self.cuts.region(node)).ok()?;
        let peak = most()?;
        self.most = self.most.max(peak);
        if points > self.largest.0 {
            self.largest = (points, (peak - before) / points as f64);
        }
        self.fingerprint += seam.fingerprint;
        Some(seam.border)
    }
}
