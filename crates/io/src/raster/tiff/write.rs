//! Writes a GeoTIFF: strips of 64 rows as they fill, compressed by as many threads as there are, and the directory in the end.
//!
//! Deflate with the predictor of floating point numbers (Adobe Photoshop TIFF Technical Note 3, 2005): bytes of equal weight of a row are
//! put together and replaced by their differences, which of terrain takes a third of the room. BigTIFF where the values could pass
//! four gigabytes. Costs memory for a strip a thread.

use std::io::{Seek, SeekFrom, Write};

use flate2::Compression;
use flate2::write::ZlibEncoder;
use rayon::prelude::*;

use super::{place, tag};
use crate::crs::keys::encode;
use crate::raster::{RasterInfo, Sample};
use crate::{Error, Format};

/// Rows of a strip, fewer where they would be more bytes than this.
const ROWS: usize = 64;
const STRIP: usize = 1 << 24;

/// What a small file may have at most: offsets have 32 bits.
const SMALL: f64 = 4.0e9;

/// Types of numbers in tags.
const TEXT: u16 = 2;
const SHORT: u16 = 3;
const LONG: u16 = 4;
const DOUBLE: u16 = 12;
const LONG8: u16 = 16;

/// Writes rows as they come.
#[derive(Debug)]
pub(in crate::raster) struct Writer<W> {
    out: W,
    columns: usize,
    rows: usize,
    strip_rows: usize,
    sample: Sample,
    nodata: f64,
    is_big: bool,
    tags: Vec<Tag>,
    /// Numbers of rows that are not compressed yet, as they are in memory.
    waiting: Vec<u8>,
    /// Strips that are compressed at once.
    at_once: usize,
    /// Where the next strip goes, and where those before it are, with their bytes.
    position: u64,
    strips: Vec<(u64, u64)>,
}

/// What the directory says of one thing.
#[derive(Debug)]
struct Tag {
    number: u16,
    kind: u16,
    count: u64,
    bytes: Vec<u8>,
}

impl Tag {
    fn shorts(number: u16, values: &[u16]) -> Self {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        Self { number, kind: SHORT, count: values.len() as u64, bytes }
    }

    fn long(number: u16, value: u32) -> Self {
        Self { number, kind: LONG, count: 1, bytes: value.to_le_bytes().to_vec() }
    }

    fn doubles(number: u16, values: &[f64]) -> Self {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        Self { number, kind: DOUBLE, count: values.len() as u64, bytes }
    }

    fn text(number: u16, text: &str) -> Self {
        let bytes = [text.as_bytes(), &[0]].concat();
        Self { number, kind: TEXT, count: bytes.len() as u64, bytes }
    }

    /// Places in the file, or numbers of bytes.
    fn places(number: u16, values: impl Iterator<Item = u64>, is_big: bool) -> Self {
        let mut bytes = Vec::new();
        let mut count = 0;
        for value in values {
            bytes.extend_from_slice(&value.to_le_bytes()[..if is_big { 8 } else { 4 }]);
            count += 1;
        }
        Self { number, kind: if is_big { LONG8 } else { LONG }, count, bytes }
    }
}

impl<W: Write + Seek> Writer<W> {
    pub(in crate::raster) fn create(out: W, info: &RasterInfo) -> Result<Self, Error> {
        Self::create_above(SMALL, out, info)
    }

    /// Begins a BigTIFF where there could be more bytes than `small`.
    fn create_above(small: f64, mut out: W, info: &RasterInfo) -> Result<Self, Error> {
        let (columns, rows) = (info.grid.columns(), info.grid.rows());
        let extent = || Error::Extent { format: Format::Tiff, columns, rows };
        let [width, length] =
            [columns, rows].map(|n| u32::try_from(n).ok().filter(|&n| n > 0 && n < u32::MAX));
        let (width, length) = width.zip(length).ok_or_else(extent)?;
        if out.seek(SeekFrom::Start(0)).is_err() {
            return Err(Error::NeedsAFile(Format::Tiff));
        }
        let size = info.sample.size();
        let strip_rows = (STRIP / (columns * size)).clamp(1, ROWS).min(rows);
        // What is not compressible grows a little.
        let is_big = info.grid.cells() * (size as f64) * 1.01 + 64.0 * (rows / strip_rows + 1) as f64 > small;
        let nodata = info.nodata.unwrap_or(f64::NAN);
        let nodata = match info.sample {
            Sample::F32 => f64::from(nodata as f32),
            Sample::F64 => nodata,
            Sample::U8 => nodata.round().clamp(0.0, 255.0),
        };
        let predictor = if info.sample == Sample::U8 { 2 } else { 3 };
        let mut tags = vec![
            Tag::long(tag::WIDTH, width),
            Tag::long(tag::LENGTH, length),
            Tag::shorts(tag::BITS, &[8 * size as u16]),
            Tag::shorts(tag::COMPRESSION, &[8]),
            Tag::shorts(tag::MEANING, &[1]),
            Tag::shorts(tag::SAMPLES, &[1]),
            Tag::long(tag::STRIP_ROWS, strip_rows as u32),
            Tag::shorts(tag::PLANES, &[1]),
            Tag::shorts(tag::PREDICTOR, &[predictor]),
            Tag::shorts(tag::SAMPLE_FORMAT, &[if info.sample == Sample::U8 { 1 } else { 3 }]),
        ];
        tags.extend(
            place::tags(&info.grid).into_iter().map(|(number, values)| Tag::doubles(number, &values)),
        );
        let keys = encode(info.crs.as_ref());
        if !keys.numbers.is_empty() {
            tags.push(Tag::shorts(tag::KEYS, &keys.numbers));
        }
        if !keys.doubles.is_empty() {
            tags.push(Tag::doubles(tag::DOUBLES, &keys.doubles));
        }
        if !keys.texts.is_empty() {
            tags.push(Tag::text(tag::TEXTS, &keys.texts));
        }
        match info.nodata {
            None if info.sample == Sample::U8 => {}
            _ if nodata.is_nan() => tags.push(Tag::text(tag::NO_DATA, "nan")),
            _ => tags.push(Tag::text(tag::NO_DATA, &format!("{nodata:?}"))),
        }
        // Where the directory is, is known in the end.
        let head: &[u8] = if is_big { b"II\x2b\0\x08\0\0\0\0\0\0\0\0\0\0\0" } else { b"II\x2a\0\0\0\0\0" };
        out.write_all(head)?;
        Ok(Self {
            out,
            columns,
            rows,
            strip_rows,
            sample: info.sample,
            nodata,
            is_big,
            tags,
            waiting: Vec::new(),
            at_once: rayon::current_num_threads().max(1),
            position: head.len() as u64,
            strips: Vec::new(),
        })
    }

    /// Takes whole rows, the first of which is row `first`.
    pub(in crate::raster) fn write_rows(&mut self, values: &[f64], first: usize) -> Result<(), Error> {
        let full = self.strip_rows * self.columns * self.sample.size() * self.at_once;
        for (i, row) in values.chunks_exact(self.columns).enumerate() {
            self.take(row, first + i)?;
            if self.waiting.len() >= full {
                self.flush()?;
            }
        }
        Ok(())
    }

    /// Takes a row.
    fn take(&mut self, row: &[f64], number: usize) -> Result<(), Error> {
        for (column, &value) in row.iter().enumerate() {
            let value = if value.is_nan() { self.nodata } else { value };
            match self.sample {
                Sample::F64 => self.waiting.extend_from_slice(&value.to_le_bytes()),
                Sample::F32 => {
                    let near = value as f32;
                    if near.is_infinite() && value.is_finite() {
                        return Err(Error::Beyond { column, row: number, value });
                    }
                    self.waiting.extend_from_slice(&near.to_le_bytes());
                }
                Sample::U8 => self.waiting.push(value.round().clamp(0.0, 255.0) as u8),
            }
        }
        Ok(())
    }

    /// Compresses and writes what is waiting.
    fn flush(&mut self) -> Result<(), Error> {
        let (size, width) = (self.sample.size(), self.columns * self.sample.size());
        let compressed: Vec<std::io::Result<Vec<u8>>> = self
            .waiting
            .par_chunks_mut(self.strip_rows * width)
            .map(|strip| {
                let mut row = vec![0; width];
                for numbers in strip.chunks_exact_mut(width) {
                    predict(numbers, &mut row, size);
                }
                let mut encoder =
                    ZlibEncoder::new(Vec::with_capacity(strip.len() / 2), Compression::default());
                encoder.write_all(strip)?;
                encoder.finish()
            })
            .collect();
        self.waiting.clear();
        for strip in compressed {
            let strip = strip?;
            self.out.write_all(&strip)?;
            self.strips.push((self.position, strip.len() as u64));
            self.position += strip.len() as u64;
        }
        Ok(())
    }

    /// Writes the directory, and where it is.
    pub(in crate::raster) fn finish(mut self) -> Result<W, Error> {
        self.flush()?;
        debug_assert_eq!(self.strips.len(), self.rows.div_ceil(self.strip_rows));
        let is_big = self.is_big;
        let mut tags = std::mem::take(&mut self.tags);
        tags.push(Tag::places(tag::STRIPS, self.strips.iter().map(|strip| strip.0), is_big));
        tags.push(Tag::places(tag::STRIP_SIZES, self.strips.iter().map(|strip| strip.1), is_big));
        tags.sort_by_key(|tag| tag.number);
        // What does not fit into an entry stands before the directory; all of it at even places.
        let inline = if is_big { 8 } else { 4 };
        let mut before = vec![0; (self.position % 2) as usize];
        let mut entries = Vec::new();
        for tag in &tags {
            entries.extend(tag.number.to_le_bytes());
            entries.extend(tag.kind.to_le_bytes());
            entries.extend_from_slice(&tag.count.to_le_bytes()[..inline]);
            let mut field = [0; 8];
            if tag.bytes.len() <= inline {
                field[..tag.bytes.len()].copy_from_slice(&tag.bytes);
            } else {
                field = (self.position + before.len() as u64).to_le_bytes();
                before.extend_from_slice(&tag.bytes);
                before.resize(before.len().next_multiple_of(2), 0);
            }
            entries.extend_from_slice(&field[..inline]);
        }
        let directory = self.position + before.len() as u64;
        let count = (tags.len() as u64).to_le_bytes();
        self.out.write_all(&before)?;
        self.out.write_all(&count[..if is_big { 8 } else { 2 }])?;
        self.out.write_all(&entries)?;
        // No other directory follows.
        self.out.write_all(&[0; 8][..inline])?;
        self.out.seek(SeekFrom::Start(if is_big { 8 } else { 4 }))?;
        self.out.write_all(&directory.to_le_bytes()[..inline])?;
        self.out.seek(SeekFrom::End(0))?;
        self.out.flush()?;
        Ok(self.out)
    }
}

/// Replaces the numbers of a row by what compresses well: bytes of equal weight together, the highest first, each as the difference from
/// the one before.
fn predict(numbers: &mut [u8], row: &mut [u8], size: usize) {
    let count = numbers.len() / size;
    for (k, number) in numbers.chunks_exact(size).enumerate() {
        for (weight, &byte) in number.iter().rev().enumerate() {
            row[weight * count + k] = byte;
        }
    }
    numbers[0] = row[0];
    for k in 1..row.len() {
        numbers[k] = row[k].wrapping_sub(row[k - 1]);
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::Writer;
    use crate::raster::{RasterInfo, Sample, placed, tiff::read};

    #[test]
    fn large_files_are_read_as_small_ones() {
        let grid = placed([10.0, 20.0], [0.5, -0.5], 70, 150).expect("a raster");
        let values: Vec<f64> = (0..70 * 150).map(|i| f64::from(i).sqrt()).collect();
        for sample in [Sample::F64, Sample::F32, Sample::U8] {
            let info = RasterInfo { sample, ..RasterInfo::new(grid) };
            let [small, big] = [f64::INFINITY, 0.0].map(|most| {
                let mut writer = Writer::create_above(most, Cursor::new(Vec::new()), &info).expect("begun");
                writer.write_rows(&values, 0).expect("written");
                writer.finish().expect("finished").into_inner()
            });
            assert_eq!((small[2], big[2]), (42, 43));
            let [small, big] =
                [small, big].map(|bytes| read(Box::new(Cursor::new(bytes))).expect("a raster"));
            assert_eq!(small, big);
            assert_eq!(small.grid, grid);
            if sample == Sample::F64 {
                assert_eq!(small.values, values);
            }
        }
    }
}
