//! Decodes a strip or tile by itself, as the only strip of a small TIFF file in memory.
//!
//! So the `tiff` crate undoes compressions, predictors and byte orders, also of what it does not take as a whole: masks, parts that
//! the file leaves out, and Zstandard, which is decompressed before.

use std::borrow::Cow;
use std::io::Cursor;

use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::ByteOrder;

use super::compression::{self, unzstd};
use super::directory::{LONG, SHORT};
use super::page::Page;
use super::read::broken;
use super::tag;
use crate::Error;

/// The numbers of a strip or tile with so many rows, row by row.
pub(super) fn decode(page: &Page, bytes: &[u8], rows: usize) -> Result<DecodingResult, Error> {
    let (compression, bytes) = if page.compression == compression::ZSTD {
        (compression::NONE, Cow::Owned(unzstd(bytes, page.bytes(page.width, rows))?))
    } else {
        (page.compression, Cow::Borrowed(bytes))
    };
    let size = u32::try_from(bytes.len())
        .map_err(|_| Error::content("TIFF: a part has more than four gigabytes"))?;
    let entries = [
        (tag::WIDTH, LONG, page.width as u32),
        (tag::LENGTH, LONG, rows as u32),
        (tag::BITS, SHORT, page.bits.into()),
        (tag::COMPRESSION, SHORT, compression.into()),
        (tag::MEANING, SHORT, page.meaning.into()),
        (tag::STRIPS, LONG, HEAD as u32),
        (tag::SAMPLES, SHORT, page.bands as u32),
        (tag::STRIP_ROWS, LONG, rows as u32),
        (tag::STRIP_SIZES, LONG, size),
        (tag::PREDICTOR, SHORT, page.predictor.into()),
        (tag::SAMPLE_FORMAT, SHORT, page.sample_format.into()),
    ];
    let mut file = head(page.order, entries);
    file.extend_from_slice(&bytes);
    let decoder = Decoder::new(Cursor::new(file)).map_err(broken)?;
    // What is claimed has been compared with the bytes that are there.
    decoder.with_limits(Limits::unlimited()).read_image().map_err(broken)
}

/// The entries of the directory, and the bytes before the strip.
const ENTRIES: usize = 11;
const HEAD: usize = 8 + 2 + 12 * ENTRIES + 4;

/// A header and a directory.
fn head(order: ByteOrder, entries: [(u16, u16, u32); ENTRIES]) -> Vec<u8> {
    let is_little = matches!(order, ByteOrder::LittleEndian);
    let short = |number: u16| if is_little { number.to_le_bytes() } else { number.to_be_bytes() };
    let long = |number: u32| if is_little { number.to_le_bytes() } else { number.to_be_bytes() };
    let mut head = if is_little { b"II".to_vec() } else { b"MM".to_vec() };
    head.extend(short(42));
    head.extend(long(8));
    head.extend(short(ENTRIES as u16));
    for (tag, kind, value) in entries {
        head.extend(short(tag));
        head.extend(short(kind));
        head.extend(long(1));
        if kind == SHORT {
            head.extend(short(value as u16));
            head.extend([0; 2]);
        } else {
            head.extend(long(value));
        }
    }
    head.extend(long(0));
    head
}
