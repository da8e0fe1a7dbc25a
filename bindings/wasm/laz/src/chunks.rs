//! Where the chunks of compressed points are: every length is compared with the file before the decoder sees it, because the decoder takes
//! what memory it is told.

use std::io::Cursor;

use laz::laszip::{ChunkTable, CompressorType};
use laz::{LazItem, LazItemType, LazVlr};

use crate::Fault;
use crate::header::{Header, bytes};

/// The place of the table, before the first chunk.
const OFFSET: usize = 8;

/// Bytes that are decoded by themselves, and how many points they are.
pub struct Chunk<'a> {
    pub bytes: &'a [u8],
    pub points: u64,
}

/// The chunks of a file.
pub fn chunks<'a>(
    file: &'a [u8],
    header: &Header,
    vlr: &LazVlr,
    kind: CompressorType,
) -> Result<Vec<Chunk<'a>>, Fault> {
    if kind == CompressorType::PointWise {
        return Ok(vec![Chunk { bytes: &file[header.start..], points: header.total }]);
    }
    let data = header.start + OFFSET;
    let number = |at: usize| Ok::<_, Fault>(u64::from_le_bytes(bytes(file, at)?));
    let mut place = number(header.start)?;
    if (place as i64) < data as i64 {
        // A writer that could not go back notes the place at the end.
        place = number(file.len().saturating_sub(8))?;
    }
    let place = usize::try_from(place).ok().filter(|&place| place >= data).ok_or(Fault::Truncated)?;
    // After a version of four bytes. Each chunk begins with a point as it is.
    let count = (number(place)? >> 32) as usize;
    if count > (place - data) / header.record {
        return Err(Fault::Damaged);
    }
    let variable = vlr.uses_variable_size_chunks();
    let table = ChunkTable::read(&mut Cursor::new(&file[place..]), variable).map_err(|_| Fault::Damaged)?;
    let mut rest = &file[data..place];
    let mut chunks = Vec::with_capacity(count);
    for entry in &table {
        let points = if variable { entry.point_count } else { vlr.chunk_size().into() };
        let length = usize::try_from(entry.byte_count).ok().filter(|&length| length <= rest.len());
        let (bytes, others) = rest.split_at(length.ok_or(Fault::Damaged)?);
        if kind == CompressorType::LayeredChunked && points > 0 {
            check_layers(bytes, header.record, vlr.items())?;
        }
        chunks.push(Chunk { bytes, points });
        rest = others;
    }
    Ok(chunks)
}

/// The layers of a chunk are inside of it: a point, the number of points, the lengths of layers, the layers.
fn check_layers(chunk: &[u8], record: usize, items: &[LazItem]) -> Result<(), Fault> {
    let layers = |item: &LazItem| match item.item_type() {
        LazItemType::Point14 => 9,
        LazItemType::RGBNIR14 => 2,
        LazItemType::Byte14(count) => usize::from(count),
        _ => 1,
    };
    let head = record + 4 + 4 * items.iter().map(layers).sum::<usize>();
    let lengths = chunk.get(record + 4..head).ok_or(Fault::Damaged)?;
    let lengths = lengths.as_chunks().0.iter().map(|&bytes| u64::from(u32::from_le_bytes(bytes)));
    if lengths.sum::<u64>() > (chunk.len() - head) as u64 { Err(Fault::Damaged) } else { Ok(()) }
}
