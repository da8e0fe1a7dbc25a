//! Tiles: each bucket is triangulated by itself, and what is final written.

use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use delone::surface::Duplicates;
use delone::tiles::{Cuts, Node, Tile};
use delone_io::write_array;
use rayon::ThreadPool;

use crate::buckets::{self, Content, Filled};
use crate::error::Error;
use crate::node::Done;
use crate::places::place;
use crate::sums::Sums;
use crate::watch::{Phase, Watch};

/// Triangulates the tiles that are not done, so many at once, each on its share of the threads.
pub(crate) fn all(
    folder: &Path,
    cuts: &Cuts,
    open: &[(Node, Filled)],
    (has_heights, rule): (bool, Duplicates),
    workers: usize,
    watch: &dyn Watch,
) -> Result<(), Error> {
    let phase = Phase::count(watch, "triangulating tiles", open.len() as u64);
    let (next, stop, failure) = (AtomicUsize::new(0), AtomicBool::new(false), Mutex::new(None));
    let work = || {
        while let Some(&(node, filled)) = open.get(next.fetch_add(1, Ordering::Relaxed)) {
            if stop.load(Ordering::Relaxed) {
                return;
            }
            let done = one(folder, cuts, (node, filled), (has_heights, rule)).and_then(|()| phase.advance());
            if let Err(error) = done {
                stop.store(true, Ordering::Relaxed);
                if let Ok(mut first) = failure.lock() {
                    first.get_or_insert(error);
                }
            }
        }
    };
    let workers = workers.min(open.len());
    let share = (rayon::current_num_threads() / workers.max(1)).max(1);
    // Work of one pool would be taken over by those who wait in another tile: each worker has a pool of its own.
    let pool = |_| rayon::ThreadPoolBuilder::new().num_threads(share).build().ok();
    let pools: Vec<ThreadPool> =
        if workers > 1 { (0..workers).map_while(pool).collect() } else { Vec::new() };
    on_each(&pools, &work);
    // Where there are no such threads, this one works.
    work();
    failure.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner).map_or(Ok(()), Err)
}

/// Does the same work in all of these pools at once, and waits for its end.
fn on_each(pools: &[ThreadPool], work: &(impl Fn() + Sync)) {
    if let Some((first, others)) = pools.split_first() {
        first.in_place_scope(|scope| {
            scope.spawn(|_| work());
            on_each(others, work);
        });
    }
}

/// Triangulates one tile, and removes its bucket in the end.
fn one(
    folder: &Path,
    cuts: &Cuts,
    (node, filled): (Node, Filled),
    (has_heights, rule): (bool, Duplicates),
) -> Result<(), Error> {
    let Content { points, mut heights, ids } = buckets::read(folder, node, filled, has_heights)?;
    let bucket = buckets::bucket(folder, node);
    let tile = Tile::new(&points, &cuts.region(node)).map_err(|error| Error::points(&bucket, error))?;
    drop(points);
    if has_heights {
        let pairs = tile.duplicates().iter().map(|pair| (pair.point, pair.vertex.index()));
        rule.settle(&mut heights, pairs);
    }
    let (vertices, order) = (tile.points(), tile.order());
    let mut sums = Sums::default();
    sums.write(&place(folder, "points", node, "npy"), |out| {
        if has_heights {
            let rows = vertices.iter().zip(order).flat_map(|(p, &i)| [p[0], p[1], heights[i as usize]]);
            return Ok(write_array(out, &[vertices.len(), 3], rows)?);
        }
        Ok(write_array(out, &[vertices.len(), 2], vertices.as_flattened().iter().copied())?)
    })?;
    drop(heights);
    sums.write(&place(folder, "ids", node, "npy"), |out| {
        Ok(write_array(out, &[vertices.len()], order.iter().map(|&i| ids[i as usize]))?)
    })?;
    drop(ids);
    let fingerprint = tile.fingerprint();
    sums.write(&place(folder, "triangles", node, "npy"), |out| {
        Ok(write_array(out, &[fingerprint.count() as usize, 3], tile.finals().flatten())?)
    })?;
    let border = tile.border(|v| node.id(v));
    let done = Done {
        node,
        vertices: vertices.len() as u64,
        duplicates: tile.duplicates().len() as u64,
        fingerprint,
        border: border.points.len() as u64,
        sums,
    };
    done.write(folder, &border)?;
    _ = std::fs::remove_file(bucket);
    Ok(())
}
