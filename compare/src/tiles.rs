//! Triangulation in tiles beside that in memory: processor time of all threads, everything in memory, and the same set of triangles.
//! What goes through a disk is measured by `docs/tiles.sh`.

use std::collections::BTreeMap;
use std::fs;

use delone::Delaunay2;
use delone::tiles::{Border, Cuts, Fingerprint, Node, Tile, join};
use delone_generators::Kind;

/// Points of a tile, about.
const TILE: usize = 400_000;
/// Every so many points are the sample, in a hashed order.
const SAMPLE: usize = 64;
/// Levels of cuts that one join goes over.
const LEVELS: u32 = 4;
/// Ticks of the system's clock in a second, as Linux tells them.
const TICKS: f64 = 100.0;

/// The result of a run.
struct Found {
    seconds: f64,
    fingerprint: Fingerprint,
    border: usize,
}

/// Prints the minimum over the runs of both ways; whether the triangles are the same.
pub fn run(kind: Kind, size: usize, runs: usize) -> bool {
    let points = kind.points(size, 1);
    let (mut memory, mut tiles) = (f64::INFINITY, f64::INFINITY);
    let (mut is_right, mut border, mut count) = (true, 0, 0);
    for _ in 0..runs {
        let (Some(one), Some(other)) = (in_memory(&points), in_tiles(&points)) else { return false };
        (memory, tiles) = (memory.min(one.seconds), tiles.min(other.seconds));
        is_right &= one.fingerprint == other.fingerprint;
        (border, count) = (other.border, one.fingerprint.count());
    }
    println!(
        "  {:12} {size:>10} {:>7.0} {:>7.0} ns of processor a point, {:.2} x; borders {:.2} %, {count} triangles{}",
        kind.name(),
        memory * 1e9 / size as f64,
        tiles * 1e9 / size as f64,
        tiles / memory,
        100.0 * border as f64 / size as f64,
        if is_right { "" } else { ", WRONG: not the same" }
    );
    is_right
}

fn in_memory(points: &[[f64; 2]]) -> Option<Found> {
    let start = processor()?;
    let fingerprint = Fingerprint::of(&Delaunay2::from_points(points).ok()?);
    Some(Found { seconds: processor()? - start, fingerprint, border: 0 })
}

fn in_tiles(points: &[[f64; 2]]) -> Option<Found> {
    let start = processor()?;
    let is_taken = |i: &usize| i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32 & (SAMPLE - 1) == 0;
    let sample: Vec<[f64; 2]> = (0..points.len()).filter(is_taken).map(|i| points[i]).collect();
    let cuts = Cuts::from_sample(&sample, points.len().div_ceil(TILE)).ok()?;
    let mut buckets: BTreeMap<Node, Vec<[f64; 2]>> =
        cuts.tiles().into_iter().map(|node| (node, Vec::new())).collect();
    for &p in points {
        buckets.get_mut(&cuts.tile_of(p))?.push(p);
    }
    let mut found = Found { seconds: 0.0, fingerprint: Fingerprint::default(), border: 0 };
    let mut borders: BTreeMap<Node, Border> = BTreeMap::new();
    for (node, bucket) in buckets {
        let tile = Tile::new(&bucket, &cuts.region(node)).ok()?;
        found.fingerprint += tile.fingerprint();
        let border = tile.border(|v| node.id(v));
        found.border += border.points.len();
        borders.insert(node, border);
    }
    settle(&cuts, Node::ROOT, &mut borders, &mut found.fingerprint)?;
    found.seconds = processor()? - start;
    Some(found)
}

/// The border of a node, of those below it.
fn settle(
    cuts: &Cuts,
    node: Node,
    borders: &mut BTreeMap<Node, Border>,
    fingerprint: &mut Fingerprint,
) -> Option<Border> {
    if let Some(border) = borders.remove(&node) {
        return Some(border);
    }
    let parts = cuts.parts(node, LEVELS).into_iter().map(|part| settle(cuts, part, borders, fingerprint));
    let seam = join(&parts.collect::<Option<Vec<_>>>()?, &cuts.region(node)).ok()?;
    *fingerprint += seam.fingerprint;
    Some(seam.border)
}

/// Seconds that all threads of this process have had (Linux).
pub fn processor() -> Option<f64> {
    let text = fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = text.rsplit(')').next()?.split_whitespace().collect();
    let ticks = |k: usize| fields.get(k)?.parse::<f64>().ok();
    Some((ticks(11)? + ticks(12)?) / TICKS)
}
