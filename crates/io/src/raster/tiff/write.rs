//! Writes a Cloud Optimized GeoTIFF: all directories first, then the tiles of overviews, the smallest first, then those of the raster.
//!
//! Source: OGC 21-026 (Cloud Optimized GeoTIFF 1.0). Rows come from north to south, and a row of tiles is compressed by as many threads as
//! there are, as soon as it is full. Overviews grow at the same time. Tiles wait in a temporary file, because overviews stand before the
//! raster; small files wait in memory. BigTIFF where offsets need more than 32 bits.
//!
//! Costs memory for a row of tiles of each level (64 MiB where a raster has up to a million columns), and disk for the file twice.

use std::io::{self, Read, Seek, SeekFrom, Write};

use rayon::prelude::*;
use tempfile::SpooledTempFile;

use super::directory::{Tag, directory, header};
use super::halves::{half, halved};
use super::tile::Shape;
use super::{place, tag};
use crate::crs::keys::encode;
use crate::limit::Counted;
use crate::raster::{Overviews, RasterInfo, Sample};
use crate::{Error, Format};

/// Bytes, above which a file is BigTIFF: offsets of a small file have 32 bits.
const BIG_TIFF_BYTES: u64 = 4_000_000_000;
/// Tiles of so many bytes wait in memory.
const IN_MEMORY: usize = 1 << 24;

/// Writes rows as they come.
#[derive(Debug)]
pub(in crate::raster) struct Writer<W> {
    out: W,
    shape: Shape,
    overviews: Overviews,
    nodata: f64,
    /// Tags of the directories of all levels, and of the raster's own.
    common: Vec<Tag>,
    own: Vec<Tag>,
    /// The raster and its overviews.
    levels: Vec<Level>,
    /// Compressed tiles in the order in which they were made, and their bytes.
    waiting: Counted<SpooledTempFile>,
    length: u64,
    /// Tiles that are compressed at once.
    at_once: usize,
    small: u64,
}

/// The raster, or an overview.
#[derive(Debug)]
struct Level {
    columns: usize,
    rows: usize,
    /// Numbers of rows that are not compressed yet, as they are in memory.
    band: Vec<u8>,
    /// A row that awaits the next one to be halved with.
    upper: Option<Vec<f64>>,
    /// Where tiles wait, and their bytes.
    tiles: Vec<(u64, u64)>,
}

impl<W: Write> Writer<W> {
    pub(in crate::raster) fn create(out: W, info: &RasterInfo) -> Result<Self, Error> {
        let (columns, rows) = (info.grid.columns(), info.grid.rows());
        let extent = || Error::Extent { format: Format::Tiff, columns, rows };
        let is_size = |n: usize| u32::try_from(n).is_ok_and(|n| n > 0 && n < u32::MAX);
        if !is_size(columns) || !is_size(rows) {
            return Err(extent());
        }
        let shape = Shape::of(columns, rows, info.sample, info.compression);
        let mut levels = vec![Level::new(columns, rows)];
        while let Some(last) =
            levels.last().filter(|last| last.columns > shape.width || last.rows > shape.height)
        {
            levels.push(Level::new(half(last.columns), half(last.rows)));
        }
        let nodata = info.nodata.unwrap_or(f64::NAN);
        let nodata = match info.sample {
            Sample::F32 => f64::from(nodata as f32),
            Sample::F64 => nodata,
            Sample::U8 => nodata.round().clamp(0.0, 255.0),
        };
        let mut common = vec![
            Tag::shorts(tag::BITS, &[8 * info.sample.size() as u16]),
            Tag::shorts(tag::COMPRESSION, &[shape.number()]),
            Tag::shorts(tag::MEANING, &[1]),
            Tag::shorts(tag::SAMPLES, &[1]),
            Tag::shorts(tag::PLANES, &[1]),
            Tag::shorts(tag::PREDICTOR, &[shape.predictor()]),
            Tag::long(tag::TILE_WIDTH, shape.width as u32),
            Tag::long(tag::TILE_LENGTH, shape.height as u32),
            Tag::shorts(tag::SAMPLE_FORMAT, &[if info.sample == Sample::U8 { 1 } else { 3 }]),
        ];
        match info.nodata {
            None if info.sample == Sample::U8 => {}
            _ if nodata.is_nan() => common.push(Tag::text(tag::NO_DATA, "nan")),
            _ => common.push(Tag::text(tag::NO_DATA, &format!("{nodata:?}"))),
        }
        let places = place::tags(&info.grid).into_iter();
        let mut own: Vec<Tag> = places.map(|(number, values)| Tag::doubles(number, &values)).collect();
        let keys = encode(info.crs.as_ref());
        if !keys.numbers.is_empty() {
            own.push(Tag::shorts(tag::KEYS, &keys.numbers));
        }
        if !keys.doubles.is_empty() {
            own.push(Tag::doubles(tag::DOUBLES, &keys.doubles));
        }
        if !keys.texts.is_empty() {
            own.push(Tag::text(tag::TEXTS, &keys.texts));
        }
        let waiting = Counted(match &info.scratch {
            Some(folder) => tempfile::spooled_tempfile_in(IN_MEMORY, folder),
            None => tempfile::spooled_tempfile(IN_MEMORY),
        });
        let at_once = 4 * rayon::current_num_threads().max(1);
        let overviews = info.overviews;
        Ok(Self {
            out,
            shape,
            overviews,
            nodata,
            common,
            own,
            levels,
            waiting,
            length: 0,
            at_once,
            small: BIG_TIFF_BYTES,
        })
    }

    /// Takes whole rows, the first of which is row `first`.
    pub(in crate::raster) fn write_rows(&mut self, values: &[f64], first: usize) -> Result<(), Error> {
        let rows = values.chunks_exact(self.levels[0].columns);
        rows.enumerate().try_for_each(|(i, row)| self.take(0, row, first + i))
    }

    /// Takes a row of a level, and halves two.
    fn take(&mut self, level: usize, row: &[f64], number: usize) -> Result<(), Error> {
        let full = self.shape.height * row.len() * self.shape.sample.size();
        self.push(level, row, number)?;
        if self.levels[level].band.len() >= full {
            self.flush(level)?;
        }
        if level + 1 == self.levels.len() {
            return Ok(());
        }
        match self.levels[level].upper.take() {
            None => {
                self.levels[level].upper = Some(row.to_vec());
                Ok(())
            }
            Some(upper) => self.take(level + 1, &halved(&upper, row, self.overviews), number / 2),
        }
    }

    /// Puts the numbers of a row into the band of its level.
    fn push(&mut self, level: usize, row: &[f64], number: usize) -> Result<(), Error> {
        let band = &mut self.levels[level].band;
        for (column, &value) in row.iter().enumerate() {
            let value = if value.is_nan() { self.nodata } else { value };
            match self.shape.sample {
                Sample::F64 => band.extend_from_slice(&value.to_le_bytes()),
                Sample::F32 => {
                    let near = value as f32;
                    if near.is_infinite() && value.is_finite() {
                        return Err(Error::Beyond { column, row: number, value });
                    }
                    band.extend_from_slice(&near.to_le_bytes());
                }
                Sample::U8 => band.push(value.round().clamp(0.0, 255.0) as u8),
            }
        }
        Ok(())
    }

    /// Compresses the band of a level.
    fn flush(&mut self, level: usize) -> Result<(), Error> {
        let (shape, level) = (self.shape, &mut self.levels[level]);
        let across = shape.across(level.columns);
        for first in (0..across).step_by(self.at_once) {
            let numbers = first..across.min(first + self.at_once);
            let pack = |number| shape.pack(&level.band, level.columns, number);
            let packed: Vec<io::Result<Vec<u8>>> = numbers.into_par_iter().map(pack).collect();
            for tile in packed {
                let tile = tile?;
                self.waiting.write_all(&tile)?;
                level.tiles.push((self.length, tile.len() as u64));
                self.length += tile.len() as u64;
            }
        }
        level.band.clear();
        Ok(())
    }

    /// Ends all levels, and writes the file.
    pub(in crate::raster) fn finish(mut self) -> Result<W, Error> {
        for level in 0..self.levels.len() {
            if !self.levels[level].band.is_empty() {
                self.flush(level)?;
            }
            if let Some(last) = self.levels[level].upper.take() {
                self.take(level + 1, &halved(&last, &last, self.overviews), 0)?;
            }
        }
        // Directories have as many bytes whatever places they name.
        let is_big = self.head(0, false).len() as u64 + self.length > self.small;
        let start = self.head(0, is_big).len() as u64;
        self.out.write_all(&self.head(start, is_big))?;
        for level in self.levels.iter().rev() {
            for &(place, length) in &level.tiles {
                self.waiting.seek(SeekFrom::Start(place))?;
                io::copy(&mut (&mut self.waiting.0).take(length), &mut self.out)?;
            }
        }
        self.out.flush()?;
        Ok(self.out)
    }

    /// The header and all directories of a file whose tiles begin at `start`.
    fn head(&self, start: u64, is_big: bool) -> Vec<u8> {
        // Levels are in the file from the smallest to the largest.
        let mut position = start;
        let mut starts: Vec<u64> =
            self.levels.iter().rev().map(|level| level.advance(&mut position)).collect();
        starts.reverse();
        let mut head = header(is_big).to_vec();
        for (k, (level, mut position)) in self.levels.iter().zip(starts).enumerate() {
            let places = level.tiles.iter().map(|tile| {
                position += tile.1;
                position - tile.1
            });
            let mut tags = self.common.clone();
            tags.push(Tag::places(tag::TILES, places, is_big));
            tags.push(Tag::places(tag::TILE_SIZES, level.tiles.iter().map(|tile| tile.1), is_big));
            tags.push(Tag::long(tag::WIDTH, level.columns as u32));
            tags.push(Tag::long(tag::LENGTH, level.rows as u32));
            if k == 0 {
                tags.extend_from_slice(&self.own);
            } else {
                tags.push(Tag::long(tag::KIND, tag::REDUCED));
            }
            head.extend(directory(tags, head.len() as u64, k + 1 < self.levels.len(), is_big));
        }
        head
    }
}

impl Level {
    fn new(columns: usize, rows: usize) -> Self {
        Self { columns, rows, band: Vec::new(), upper: None, tiles: Vec::new() }
    }

    /// Goes over the tiles in a file, and says where they begin.
    fn advance(&self, position: &mut u64) -> u64 {
        let start = *position;
        *position += self.tiles.iter().map(|tile| tile.1).sum::<u64>();
        start
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::{BIG_TIFF_BYTES, Writer};
    use crate::raster::{RasterInfo, Sample, placed, tiff::read};

    #[test]
    fn large_files_are_read_as_small_ones() {
        let grid = placed([10.0, 20.0], [0.5, -0.5], 700, 150).expect("a raster");
        let values: Vec<f64> = (0..700 * 150).map(|i| f64::from(i).sqrt()).collect();
        for sample in [Sample::F64, Sample::F32, Sample::U8] {
            let info = RasterInfo { sample, ..RasterInfo::new(grid) };
            let [small, big] = [BIG_TIFF_BYTES, 0].map(|most| {
                let mut writer = Writer::create(Cursor::new(Vec::new()), &info).expect("begun");
                writer.small = most;
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
