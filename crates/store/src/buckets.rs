//! Points on their way to tiles: a file for each tile, with the points as they came and their indices.
//!
//! A record is x, y, perhaps z, as f64, and the index as u64, all with the least byte first. Records of a bucket are in the order of the
//! input, so of equal points the first is met first. No file stays open: there may be more tiles than files may be.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::hash::Hasher;
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use delone::surface::{Duplicates, Several};
use delone::tiles::{Cuts, Node};
use delone_io::sync_file;
use rayon::prelude::*;
use twox_hash::XxHash3_64;

use crate::error::Error;
use crate::input::hashed;
use crate::own;
use crate::places::place;

/// Where the bucket of a tile is.
pub(crate) fn bucket(folder: &Path, node: Node) -> PathBuf {
    place(folder, "bucket", node, "bin")
}

/// The content of a bucket: the number of its points, and the hash of their bytes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Filled {
    pub(crate) points: u64,
    pub(crate) sum: u64,
}

/// The points of a bucket.
#[derive(Default)]
pub(crate) struct Content {
    pub(crate) points: Vec<[f64; 2]>,
    /// As many, or none where heights are not kept.
    pub(crate) heights: Vec<f64>,
    pub(crate) ids: Vec<u64>,
}

/// Bytes of a record.
pub(crate) fn width(has_heights: bool) -> usize {
    if has_heights { 32 } else { 24 }
}

/// Where in a record its height is.
const HEIGHT: u64 = 16;

/// Buckets that are being filled.
pub(crate) struct Buckets<'a> {
    folder: &'a Path,
    cuts: &'a Cuts,
    has_heights: bool,
    /// Bytes that a bucket gathers.
    buffer: usize,
    tiles: Vec<Node>,
    waiting: Vec<Vec<u8>>,
    counts: Vec<u64>,
    hashers: Vec<XxHash3_64>,
}

impl<'a> Buckets<'a> {
    /// Empty ones, for the tiles at a node and below.
    pub(crate) fn new(
        folder: &'a Path,
        cuts: &'a Cuts,
        below: Node,
        has_heights: bool,
        buffer: usize,
    ) -> Result<Self, Error> {
        let mut tiles = cuts.parts(below, u32::BITS);
        if tiles.is_empty() {
            tiles.push(below);
        }
        tiles.sort_unstable();
        for &tile in &tiles {
            let path = bucket(folder, tile);
            match fs::remove_file(&path) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => {
                    return Err(unwritten(&path, error));
                }
                _ => {}
            }
        }
        let count = tiles.len();
        Ok(Self {
            folder,
            cuts,
            has_heights,
            buffer,
            tiles,
            waiting: vec![Vec::new(); count],
            counts: vec![0; count],
            hashers: vec![XxHash3_64::new(); count],
        })
    }

    /// Takes points whose indices are consecutive.
    pub(crate) fn take(
        &mut self,
        first: u64,
        points: &[[f64; 2]],
        heights: Option<&[f64]>,
    ) -> Result<(), Error> {
        let ids: Vec<u64> = (first..first + points.len() as u64).collect();
        self.put(points, heights.unwrap_or_default(), &ids)
    }

    fn put(&mut self, points: &[[f64; 2]], heights: &[f64], ids: &[u64]) -> Result<(), Error> {
        let tile_of = |&p: &[f64; 2]| {
            let own = self.cuts.tile_of(p);
            self.tiles.partition_point(|&tile| tile < own) as u32
        };
        let found: Vec<u32> = points.par_iter().with_min_len(1 << 12).map(tile_of).collect();
        for (k, tile) in found.into_iter().enumerate() {
            let tile = tile as usize;
            let waiting = &mut self.waiting[tile];
            points[k].iter().for_each(|x| waiting.extend_from_slice(&x.to_le_bytes()));
            if self.has_heights {
                waiting.extend_from_slice(&heights[k].to_le_bytes());
            }
            waiting.extend_from_slice(&ids[k].to_le_bytes());
            self.counts[tile] += 1;
            if waiting.len() >= self.buffer {
                self.write(tile)?;
            }
        }
        Ok(())
    }

    fn write(&mut self, tile: usize) -> Result<(), Error> {
        let path = bucket(self.folder, self.tiles[tile]);
        let append = || own::append(&path)?.write_all(&self.waiting[tile]);
        append().map_err(|error| unwritten(&path, error))?;
        self.hashers[tile].write(&self.waiting[tile]);
        self.waiting[tile].clear();
        Ok(())
    }

    /// Writes what is left, to the disk, and tells what each tile has.
    pub(crate) fn finish(mut self) -> Result<BTreeMap<Node, Filled>, Error> {
        for tile in 0..self.tiles.len() {
            self.write(tile)?;
            let path = bucket(self.folder, self.tiles[tile]);
            sync_file(&path).map_err(|error| unwritten(&path, error))?;
        }
        let filled = self.counts.into_iter().zip(self.hashers);
        let filled = filled.map(|(points, hasher)| Filled { points, sum: hasher.finish() });
        Ok(self.tiles.into_iter().zip(filled).collect())
    }
}

/// Removes all buckets of a folder.
pub(crate) fn remove_all(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        if entry.file_name().to_string_lossy().starts_with("bucket-") {
            _ = fs::remove_file(entry.path());
        }
    }
}

fn unwritten(path: &Path, error: io::Error) -> Error {
    Error::WriteBucket { path: path.to_owned(), error }
}

/// Whether a bucket is there and as long as so many points are.
pub(crate) fn check(folder: &Path, node: Node, count: u64, has_heights: bool) -> Result<(), Error> {
    open(folder, node, count, has_heights).map(|_| ())
}

/// A bucket that should have so many points.
fn open(folder: &Path, node: Node, count: u64, has_heights: bool) -> Result<File, Error> {
    let path = bucket(folder, node);
    let file = own::open(&path)
        .map_err(|error| lost(&path, format_args!("the bucket of a tile cannot be read: {error}")))?;
    let length = file.metadata().map_err(|error| lost(&path, error))?.len();
    let expected = count.saturating_mul(width(has_heights) as u64);
    if length != expected {
        let what =
            format!("the bucket has {length} bytes, and the {count} points of tiles.json are {expected}");
        return Err(lost(&path, what));
    }
    Ok(file)
}

fn lost(path: &Path, what: impl std::fmt::Display) -> Error {
    Error::Bucket { path: path.to_owned(), what: what.to_string() }
}

/// Reads a bucket that should have so many points.
pub(crate) fn read(folder: &Path, node: Node, filled: Filled, has_heights: bool) -> Result<Content, Error> {
    let (mut content, count) = (Content::default(), filled.points);
    each(folder, node, filled, has_heights, &mut |mut part| {
        if content.points.is_empty() {
            // It is as long, but a file may have a length that nobody wrote.
            let heights = if has_heights { count as usize } else { 0 };
            let room = content.points.try_reserve_exact(count as usize);
            room.and_then(|()| content.ids.try_reserve_exact(count as usize))
                .and_then(|()| content.heights.try_reserve_exact(heights))
                .map_err(|_| {
                    lost(&bucket(folder, node), format_args!("{count} points are more than memory holds"))
                })?;
        }
        content.points.append(&mut part.points);
        content.ids.append(&mut part.ids);
        content.heights.append(&mut part.heights);
        Ok(())
    })?;
    Ok(content)
}

/// Reads a bucket piece by piece.
///
/// # Errors
/// It is not what was written; all of it was taken by then.
fn each(
    folder: &Path,
    node: Node,
    filled: Filled,
    has_heights: bool,
    take: &mut dyn FnMut(Content) -> Result<(), Error>,
) -> Result<(), Error> {
    let width = width(has_heights);
    let mut source = BufReader::with_capacity(1 << 16, open(folder, node, filled.points, has_heights)?);
    let mut hasher = XxHash3_64::new();
    let mut bytes = vec![0; width << 14];
    let mut rest = filled.points as usize;
    while rest > 0 {
        let now = rest.min(1 << 14);
        let bytes = &mut bytes[..now * width];
        source.read_exact(bytes).map_err(|error| lost(&bucket(folder, node), error))?;
        hasher.write(bytes);
        let mut part = Content::default();
        for record in bytes.chunks_exact(width) {
            let (words, _) = record.as_chunks::<8>();
            let number = |k: usize| f64::from_le_bytes(words[k]);
            part.points.push([number(0), number(1)]);
            if has_heights {
                part.heights.push(number(2));
            }
            part.ids.push(u64::from_le_bytes(words[words.len() - 1]));
        }
        take(part)?;
        rest -= now;
    }
    if hasher.finish() != filled.sum {
        return Err(lost(&bucket(folder, node), "it is not what was written"));
    }
    Ok(())
}

/// Cuts buckets again that have more points than a tile may have: the sample did not see them. Of points that are all equal the first
/// is kept, with the height that a rule says; says how many were left out.
pub(crate) fn cut_again(
    folder: &Path,
    cuts: &mut Cuts,
    buckets: &mut BTreeMap<Node, Filled>,
    (has_heights, rule): (bool, Duplicates),
    most: u64,
    buffer: usize,
) -> Result<u64, Error> {
    let mut left_out = 0;
    while let Some((&node, &filled)) = buckets.iter().find(|&(_, filled)| filled.points > most) {
        let count = filled.points;
        let tiles = count.div_ceil((most * 4 / 5).max(1)) as usize;
        let sample = sample_of(folder, node, filled, has_heights)?;
        let is_cut = cuts.cut(node, &sample, tiles.max(2)).map_err(|error| Error::points(folder, error))?;
        let old = bucket(folder, node);
        buckets.remove(&node);
        if is_cut {
            let mut parts = Buckets::new(folder, cuts, node, has_heights, buffer)?;
            each(folder, node, filled, has_heights, &mut |part| {
                parts.put(&part.points, &part.heights, &part.ids)
            })?;
            buckets.extend(parts.finish()?);
            fs::remove_file(&old).map_err(|error| unwritten(&old, error))?;
        } else {
            let height = if has_heights {
                height_of_all(folder, node, filled, rule)?.map(Several::height)
            } else {
                None
            };
            let shorten = || {
                let mut file = own::change(&old)?;
                if let Some(height) = height {
                    file.seek(SeekFrom::Start(HEIGHT))?;
                    file.write_all(&height.to_le_bytes())?;
                }
                file.set_len(width(has_heights) as u64)?;
                sync_file(&old)?;
                let mut bytes = Vec::new();
                file.rewind()?;
                file.read_to_end(&mut bytes)?;
                Ok(XxHash3_64::oneshot(&bytes))
            };
            let sum = shorten().map_err(|error| unwritten(&old, error))?;
            buckets.insert(node, Filled { points: 1, sum });
            left_out += count - 1;
        }
    }
    Ok(left_out)
}

/// The height by a rule of a bucket whose points are all equal.
fn height_of_all(
    folder: &Path,
    node: Node,
    filled: Filled,
    rule: Duplicates,
) -> Result<Option<Several>, Error> {
    let mut all: Option<Several> = None;
    each(folder, node, filled, true, &mut |part| {
        for height in part.heights {
            match &mut all {
                Some(several) => several.add(height),
                None => all = Some(Several::new(rule, height)),
            }
        }
        Ok(())
    })?;
    Ok(all)
}

/// Some points of a bucket; two that differ among them, if there are any.
fn sample_of(folder: &Path, node: Node, filled: Filled, has_heights: bool) -> Result<Vec<[f64; 2]>, Error> {
    /// Enough to cut into a few tiles.
    const SOME: u64 = 1 << 14;
    let step = filled.points.div_ceil(SOME);
    let mut sample: Vec<[f64; 2]> = Vec::new();
    let mut other = None;
    each(folder, node, filled, has_heights, &mut |part| {
        for (&p, &id) in part.points.iter().zip(&part.ids) {
            let first = *sample.first().unwrap_or(&p);
            if sample.is_empty() || hashed(id).is_multiple_of(step) {
                sample.push(p);
            }
            if other.is_none() && p != first {
                other = Some(p);
            }
        }
        Ok(())
    })?;
    sample.extend(other);
    Ok(sample)
}
