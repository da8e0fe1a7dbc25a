//! The compressed points of LAZ files: chunks that do not depend on each other, decoded on all cores.
//!
//! A table at the end says how long each chunk is. Files whose writer was interrupted have none; their chunks are
//! found one after the other, or decoded in one go.

use std::io::{Cursor, Read, Seek, SeekFrom};

use las::PointData;
use laz::laszip::{ChunkTable, CompressorType, LazVlr};
use laz::record::{LayeredPointRecordDecompressor, RecordDecompressor, SequentialPointRecordDecompressor};
use laz::{DecompressionSelection, LazItem, LazItemType};
use rayon::prelude::*;

use super::{CHUNK, Kept, Tile, Wanted, broken, copc};
use crate::chunks::Chunks;
use crate::{Error, guard};

/// Bytes before the first chunk: where the table is.
const OFFSET: u64 = ChunkTable::OFFSET_SIZE as u64;

/// Points decoded at a time: so few that they are still in the cache when their coordinates are taken.
const BLOCK: u64 = 1 << 10;

/// Bytes of chunks that are read before they are decoded; a quarter of it where points are handed on in pieces.
const READ_AHEAD_BYTES: u64 = 1 << 24;

/// One chunk: where it is and how many points it has.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Chunk {
    pub(super) start: u64,
    pub(super) length: u64,
    pub(super) points: u64,
}

/// Reads all points of a compressed file.
pub(super) fn read(
    tile: &mut Tile,
    wanted: &Wanted,
    kept: &mut Kept,
    takers: &mut Chunks,
) -> Result<(), Error> {
    let compressed = laszip_record(tile)?;
    let vlr = LazVlr::from_buffer(&compressed).map_err(broken)?;
    // The kind is the record's first number; the crate does not tell it.
    let kind = u16::from_le_bytes([compressed[0], compressed[1]]);
    let layered = kind == CompressorType::LayeredChunked as u16;
    let version = if layered { 3..=4 } else { 1..=2 };
    let items = vlr.items();
    let size: usize = items.iter().map(|item| usize::from(item.size())).sum();
    if items.is_empty() || size != tile.record || !items.iter().all(|item| version.contains(&item.version()))
    {
        return Err(broken("its compressed fields are not those of its points"));
    }
    if kind == CompressorType::PointWise as u16 {
        return decode_on(tile, items, (tile.start, u64::MAX), wanted, kept, takers);
    }
    if kind != CompressorType::PointWiseChunked as u16 && !layered {
        return Err(broken(format!("compression of kind {kind} is not known")));
    }
    let chunks = match table(tile, &vlr)? {
        Some(chunks) => chunks,
        None if layered => walk(tile, items)?,
        None if vlr.uses_variable_size_chunks() => {
            return Err(broken("it has no table of chunks, which its variable chunks need"));
        }
        None => {
            let from = (tile.start + OFFSET, vlr.chunk_size().into());
            return decode_on(tile, items, from, wanted, kept, takers);
        }
    };
    let Some(chosen) = copc::select(tile, &chunks, wanted.filter.within)? else {
        let total = tile.total;
        return decode_all(tile, (items, layered), &chunks, total, wanted, kept, takers);
    };
    let bytes = |chunks: &[Chunk]| chunks.iter().map(|chunk| chunk.length).sum::<u64>();
    kept.cloud.remarks.push(format!(
        "{} of {} nodes are read, with {} of {} bytes of points",
        chosen.len(),
        chunks.iter().filter(|chunk| chunk.points > 0).count(),
        bytes(&chosen),
        bytes(&chunks)
    ));
    let total = chosen.iter().fold(0, |sum: u64, chunk| sum.saturating_add(chunk.points)).min(tile.total);
    decode_all(tile, (items, layered), &chosen, total, wanted, kept, takers)
}

/// The record about compression.
fn laszip_record(tile: &Tile) -> Result<Vec<u8>, Error> {
    let mut records = tile.about.vlrs.iter();
    let record = records.find(|r| r.user_id == LazVlr::USER_ID && r.record_id == LazVlr::RECORD_ID);
    record
        .map(|record| record.data.clone())
        .filter(|data| data.len() >= 2)
        .ok_or_else(|| broken("it is compressed, but its record about compression is missing"))
}

/// The chunks by their table, if the file has one.
fn table(tile: &mut Tile, vlr: &LazVlr) -> Result<Option<Vec<Chunk>>, Error> {
    let data = tile.start + OFFSET;
    let mut place = number(tile, tile.start)?;
    if (place as i64) < data as i64 {
        // A writer that could not go back notes the place at the end.
        place = number(tile, tile.length.saturating_sub(8))?;
    }
    if place < data || place.checked_add(8).is_none_or(|end| end > tile.length) {
        return Ok(None);
    }
    // After a version of four bytes.
    let count = number(tile, place)? >> 32;
    // Each chunk begins with a point as it is.
    if count > (place - data) / tile.record as u64 {
        return Ok(None);
    }
    let variable = vlr.uses_variable_size_chunks();
    tile.source.seek(SeekFrom::Start(place))?;
    let Ok(entries) = ChunkTable::read(&mut tile.source, variable) else { return Ok(None) };
    let mut chunks = Vec::with_capacity(entries.len());
    let mut start = data;
    for entry in &entries {
        let points = if variable { entry.point_count } else { vlr.chunk_size().into() };
        let end = start.checked_add(entry.byte_count).filter(|&end| end <= place);
        let Some(end) = end else {
            return Err(broken(format!("chunk {} reaches beyond the points", chunks.len())));
        };
        chunks.push(Chunk { start, length: entry.byte_count, points });
        start = end;
    }
    Ok(Some(chunks))
}

/// Eight bytes as a number; zero beyond the end.
fn number(tile: &mut Tile, at: u64) -> Result<u64, Error> {
    if at + 8 > tile.length {
        return Ok(0);
    }
    tile.source.seek(SeekFrom::Start(at))?;
    let mut bytes = [0; 8];
    tile.source.read_exact(&mut bytes)?;
    Ok(u64::from_le_bytes(bytes))
}

/// The chunks of a layered file without a table: each says how many points it has and how long its layers are.
fn walk(tile: &mut Tile, items: &[LazItem]) -> Result<Vec<Chunk>, Error> {
    let mut chunks = Vec::new();
    let mut start = tile.start + OFFSET;
    let mut found = 0;
    let head = tile.record + 4 + 4 * layers(items);
    let mut bytes = vec![0; head];
    while found < tile.total {
        let ends = || Error::Truncated(format!("after {found} of {} points", tile.total));
        if start + head as u64 > tile.length {
            return Err(ends());
        }
        tile.source.seek(SeekFrom::Start(start))?;
        tile.source.read_exact(&mut bytes)?;
        let (points, length) = head_of(&bytes[tile.record..]);
        if points == 0 {
            return Err(broken(format!("chunk {} has no points", chunks.len())));
        }
        let length = head as u64 + length;
        if start + length > tile.length {
            return Err(ends());
        }
        chunks.push(Chunk { start, length, points });
        start += length;
        found += points;
    }
    Ok(chunks)
}

/// The number of points of a layered chunk, and the bytes of all its layers.
fn head_of(bytes: &[u8]) -> (u64, u64) {
    let mut numbers = bytes.as_chunks().0.iter().map(|&word| u64::from(u32::from_le_bytes(word)));
    (numbers.next().unwrap_or(0), numbers.sum())
}

/// How many layers the fields of a point are stored in.
fn layers(items: &[LazItem]) -> usize {
    let of = |item: &LazItem| match item.item_type() {
        LazItemType::Point14 => 9,
        LazItemType::RGBNIR14 => 2,
        LazItemType::Byte14(count) => usize::from(count),
        _ => 1,
    };
    items.iter().map(of).sum()
}

/// Decodes chunks on all cores, as many at a time as are read ahead, and takes their points in order.
fn decode_all(
    tile: &mut Tile,
    (items, layered): (&[LazItem], bool),
    chunks: &[Chunk],
    total: u64,
    wanted: &Wanted,
    kept: &mut Kept,
    takers: &mut Chunks,
) -> Result<(), Error> {
    let mut rest = total;
    // Whoever takes chunks has little memory.
    let (ahead, most) = if takers.is_whole() {
        (READ_AHEAD_BYTES, 16 * CHUNK)
    } else {
        (READ_AHEAD_BYTES / 4, CHUNK * 4.max(rayon::current_num_threads() as u64))
    };
    let mut waiting = chunks.iter().copied().filter(|chunk| chunk.points > 0).peekable();
    while rest > 0 {
        let mut batch = Vec::new();
        let (mut bytes, mut points) = (0, 0);
        while let Some(mut chunk) = waiting.next_if(|chunk| batch.is_empty() || bytes + chunk.length <= ahead)
        {
            chunk.points = chunk.points.min(rest);
            let mut compressed = vec![0; chunk.length as usize];
            tile.source.seek(SeekFrom::Start(chunk.start))?;
            tile.source.read_exact(&mut compressed)?;
            batch.push((chunk.points, compressed));
            bytes += chunk.length;
            points += chunk.points;
            rest -= chunk.points;
            if rest == 0 || points >= most {
                break;
            }
        }
        if batch.is_empty() {
            return Err(Error::Truncated(format!("after {} of {total} points", total - rest)));
        }
        let (record, buffer) = (tile.record, tile.buffer());
        let decoded: Vec<Result<Kept, Error>> = batch
            .into_par_iter()
            .map(|(points, bytes)| {
                guard::decode("LAS", || {
                    decode(bytes, points, (items, layered), record, buffer.clone(), wanted)
                })
            })
            .collect();
        kept.cloud.reserve(decoded.iter().flatten().map(|part| part.cloud.xy.len()).sum());
        for part in decoded {
            kept.append(part?);
        }
        takers.offer(&mut kept.cloud)?;
    }
    Ok(())
}

/// Decodes so many points of one chunk.
fn decode(
    bytes: Vec<u8>,
    points: u64,
    (items, layered): (&[LazItem], bool),
    record: usize,
    mut data: PointData,
    wanted: &Wanted,
) -> Result<Kept, Error> {
    let items = items.to_vec();
    let mut part = Kept::with_capacity(0, wanted.options);
    let mut decoder: Box<dyn RecordDecompressor<Cursor<Vec<u8>>>> = if layered {
        let head = record + 4 + 4 * layers(&items);
        let (_, length) =
            bytes.get(record..head).map(head_of).ok_or_else(|| broken("a chunk is too short"))?;
        if head as u64 + length > bytes.len() as u64 {
            return Err(broken("the layers of a chunk are longer than the chunk"));
        }
        Box::new(LayeredPointRecordDecompressor::new(Cursor::new(bytes)))
    } else {
        Box::new(SequentialPointRecordDecompressor::new(Cursor::new(bytes)))
    };
    decoder.set_fields_from(&items).map_err(broken)?;
    decoder.set_selection(if wanted.is_more() {
        DecompressionSelection::all()
    } else {
        DecompressionSelection::base().decompress_z().decompress_classification().decompress_flags()
    });
    let mut rest = points;
    while rest > 0 {
        let count = BLOCK.min(rest);
        for point in data.resize_for(count as usize).chunks_exact_mut(record) {
            decoder.decompress_next(point).map_err(early)?;
        }
        part.take(&data, wanted);
        rest -= count;
    }
    Ok(part)
}

/// Decodes from the source itself, from `start` on: chunks of so many points follow each other.
fn decode_on(
    tile: &mut Tile,
    items: &[LazItem],
    (start, size): (u64, u64),
    wanted: &Wanted,
    kept: &mut Kept,
    takers: &mut Chunks,
) -> Result<(), Error> {
    let (mut data, items) = (tile.buffer(), items.to_vec());
    tile.source.seek(SeekFrom::Start(start))?;
    let mut decoder = SequentialPointRecordDecompressor::new(&mut tile.source);
    let mut seen = 0;
    while seen < tile.total {
        let count = BLOCK.min(tile.total - seen);
        for point in data.resize_for(count as usize).chunks_exact_mut(tile.record) {
            if seen % size == 0 {
                decoder.reset();
                decoder.set_fields_from(&items).map_err(broken)?;
            }
            decoder.decompress_next(point).map_err(early)?;
            seen += 1;
        }
        kept.take(&data, wanted);
        takers.offer(&mut kept.cloud)?;
    }
    Ok(())
}

fn early(error: std::io::Error) -> Error {
    match error.kind() {
        std::io::ErrorKind::UnexpectedEof => {
            Error::Truncated("inside a chunk of compressed points".to_owned())
        }
        _ => error.into(),
    }
}
