//! Cloud Optimized Point Clouds: LAZ files whose chunks are the nodes of an octree, so that a part is read without the rest.
//!
//! Source: the COPC specification 1.0. A record has the cube and the place of the first page of the hierarchy; a page lists nodes, each a
//! chunk or another page.

use std::collections::HashSet;
use std::io::{Read, Seek, SeekFrom};

use super::chunks::Chunk;
use super::cubes::{Cubes, Key};
use super::{Tile, broken};
use crate::Error;

const OWNER: &str = "copc";
const INFO: u16 = 1;

/// Bytes of an entry of a page.
const ENTRY: usize = 32;

/// The chunks of the nodes whose cubes may have points that are wanted, in their order in the file; nothing if all are to be read.
pub(super) fn select(
    tile: &mut Tile,
    chunks: &[Chunk],
    within: Option<[f64; 4]>,
) -> Result<Option<Vec<Chunk>>, Error> {
    let mut records = tile.about.vlrs.iter();
    let info = records.find(|record| record.user_id == OWNER && record.record_id == INFO);
    let Some(info) = info.filter(|info| info.data.len() >= 56 && within.is_some()) else {
        return Ok(None);
    };
    let words: Vec<[u8; 8]> = info.data.as_chunks().0.to_vec();
    let [x, y, half] = [0, 1, 3].map(|k| f64::from_le_bytes(words[k]));
    let transforms = tile.about.transforms;
    let cubes = Cubes {
        low: [x - half, y - half],
        width: [2.0 * half; 2],
        step: [transforms.x.scale, transforms.y.scale],
    };
    // Chunks of nothing begin where others do.
    let chunks: Vec<Chunk> = chunks.iter().copied().filter(|chunk| chunk.length > 0).collect();
    let mut pages = vec![(u64::from_le_bytes(words[5]), u64::from_le_bytes(words[6]))];
    let mut seen = HashSet::new();
    let (mut places, mut read) = (Vec::new(), 0_u64);
    while let Some((start, size)) = pages.pop() {
        let wrong = |what: &str| broken(format!("the page of its hierarchy at byte {start} {what}"));
        if !seen.insert(start) {
            return Err(wrong("is in it twice"));
        }
        if start.checked_add(size).is_none_or(|end| end > tile.length) {
            return Err(wrong("reaches beyond the file"));
        }
        read = read.saturating_add(size);
        // Pages do not overlap.
        if size % ENTRY as u64 != 0 || read > tile.length {
            return Err(wrong("has another length than its entries"));
        }
        let mut bytes = vec![0; size as usize];
        tile.source.seek(SeekFrom::Start(start))?;
        tile.source.read_exact(&mut bytes)?;
        for entry in bytes.as_chunks::<ENTRY>().0 {
            let words: Vec<i32> = entry.as_chunks().0.iter().map(|&word| i32::from_le_bytes(word)).collect();
            let [depth, x, y, z, low, high, size, points] = words[..] else { continue };
            let key = Key::of(depth, [x, y, z]).ok_or_else(|| wrong("has a node that is none"))?;
            let place = u64::from(high as u32) << 32 | u64::from(low as u32);
            match (u64::try_from(points), u64::try_from(size)) {
                _ if !cubes.meet(key, within) => {}
                (Ok(0), _) => {}
                (Err(_), Ok(size)) if points == -1 => pages.push((place, size)),
                (Ok(points), Ok(length)) => {
                    let chunk = Chunk { start: place, length, points };
                    let at = chunks.binary_search_by_key(&place, |known| known.start);
                    let is_one = at.is_ok_and(|at| chunks[at] == chunk);
                    if !is_one {
                        return Err(broken(format!("node {key} of its hierarchy is none of its chunks")));
                    }
                    places.extend(at);
                }
                _ => return Err(wrong("has a length or a number of points that is none")),
            }
        }
    }
    places.sort_unstable();
    if !places.is_sorted_by(|one, other| one < other) {
        return Err(broken("two nodes of its hierarchy are one chunk"));
    }
    let chosen: Vec<Chunk> = places.into_iter().map(|at| chunks[at]).collect();
    Ok(Some(chosen))
}
