//! Reads a GeoTIFF: strips or tiles of any numbers, the first band of several.
//!
//! The `tiff` crate decodes, behind the fence. What a header claims is compared with the bytes that are there before anything is decoded:
//! no compression makes more of a byte than [`BYTES_A_BYTE`].

use std::io::SeekFrom;

use tiff::decoder::{ChunkType, Decoder, DecodingResult};
use tiff::tags::Tag;
use tiff::{ColorType, TiffError};

use super::{place, tag};
use crate::crs::keys::{decode, is_point};
use crate::error::excerpt;
use crate::raster::Raster;
use crate::{Error, Source, guard, xml};

/// What a byte of LZW, the best of the compressions, can stand for at most.
const BYTES_A_BYTE: u64 = 2048;

pub(crate) fn read(source: Box<dyn Source>) -> Result<Raster, Error> {
    guard::decode("TIFF", || File::open(source)?.read())
}

fn broken(error: TiffError) -> Error {
    match error {
        TiffError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            Error::Truncated("inside the raster".to_owned())
        }
        TiffError::IoError(error) if error.kind() != std::io::ErrorKind::InvalidData => error.into(),
        other => Error::content(format!("TIFF: {other}")),
    }
}

/// A file whose directory is read.
struct File {
    decoder: Decoder<Box<dyn Source>>,
    /// Bytes of the file.
    length: u64,
    columns: usize,
    rows: usize,
    /// Numbers of a cell that are together, of which the first is taken.
    bands: usize,
    bits: u64,
}

impl File {
    fn open(mut source: Box<dyn Source>) -> Result<Self, Error> {
        let length = source.seek(SeekFrom::End(0))?;
        source.rewind()?;
        let mut decoder = Decoder::new(source).map_err(broken)?;
        let (columns, rows) = decoder.dimensions().map_err(broken)?;
        let (bits, all) = match decoder.colortype().map_err(broken)? {
            ColorType::Gray(bits) => (bits, 1),
            ColorType::GrayA(bits) => (bits, 2),
            ColorType::RGB(bits) => (bits, 3),
            ColorType::RGBA(bits) => (bits, 4),
            ColorType::Multiband { bit_depth, num_samples } => (bit_depth, usize::from(num_samples)),
            other => return Err(Error::content(format!("TIFF: cells of {other:?} are no heights"))),
        };
        if !matches!(bits, 8 | 16 | 32 | 64) {
            return Err(Error::content(format!("TIFF: numbers of {bits} bits are not read here")));
        }
        let planes = Tag::from_u16_exhaustive(tag::PLANES);
        let is_planar = decoder.find_tag_unsigned::<u16>(planes).map_err(broken)? == Some(2);
        let bands = if is_planar { 1 } else { all };
        Ok(Self { decoder, length, columns: columns as usize, rows: rows as usize, bands, bits: bits.into() })
    }

    fn read(mut self) -> Result<Raster, Error> {
        let room = self.length.saturating_mul(BYTES_A_BYTE);
        let claim = |cells: u64, bands: usize, bits: u64| cells.saturating_mul(bands as u64 * bits / 8);
        if claim(self.columns as u64 * self.rows as u64, self.bands, self.bits) > room {
            return Err(Error::Truncated(format!(
                "too early for {} columns and {} rows of numbers",
                self.columns, self.rows
            )));
        }
        let numbers = self.shorts(tag::KEYS);
        let crs = decode(&numbers, &self.doubles(tag::DOUBLES), self.text(tag::TEXTS).as_bytes());
        let [scale, tie, matrix] = [tag::SCALE, tag::TIE, tag::TRANSFORM].map(|number| self.doubles(number));
        let grid = place::grid(&scale, &tie, &matrix, is_point(&numbers), [self.columns, self.rows])?;
        let meaning = Meaning::of(&self.text(tag::NO_DATA), &self.text(tag::ABOUT))?;
        let is_tiled = self.decoder.get_chunk_type() == ChunkType::Tile;
        let sizes = Tag::from_u16_exhaustive(if is_tiled { tag::TILE_SIZES } else { tag::STRIP_SIZES });
        let sizes = self.decoder.find_tag_unsigned_vec::<u64>(sizes).map_err(broken)?.unwrap_or_default();
        let (width, height) = self.decoder.chunk_dimensions();
        let (width, height) =
            ((width as usize).min(self.columns).max(1), (height as usize).min(self.rows).max(1));
        let (full_width, full_height) = self.decoder.chunk_dimensions();
        let full = claim(
            u64::from(full_width) * u64::from(full_height.min(self.rows as u32)),
            self.bands,
            self.bits,
        );
        let across = if is_tiled { self.columns.div_ceil(full_width.max(1) as usize) } else { 1 };
        let mut values = Vec::new();
        for (number, top) in (0..self.rows).step_by(height).enumerate() {
            let bottom = (top + height).min(self.rows);
            values.resize(bottom * self.columns, f64::NAN);
            for k in 0..across {
                let chunk = number * across + k;
                match sizes.get(chunk) {
                    // A part that is not there is one without data.
                    Some(0) => continue,
                    Some(&size) if full > size.min(self.length).saturating_mul(BYTES_A_BYTE) => {
                        return Err(Error::Truncated(format!("inside part {chunk} of the raster")));
                    }
                    _ => {}
                }
                let (columns, rows) = self.decoder.chunk_data_dimensions(chunk as u32);
                let decoded = self.decoder.read_chunk(chunk as u32).map_err(broken)?;
                let left = k * width;
                let (columns, rows) =
                    ((columns as usize).min(self.columns - left), (rows as usize).min(bottom - top));
                let part = Part {
                    values: &mut values,
                    left,
                    top,
                    columns,
                    rows,
                    all: self.columns,
                    bands: self.bands,
                };
                part.fill(&decoded, &meaning)?;
            }
        }
        Ok(Raster { grid, crs, values })
    }

    fn shorts(&mut self, number: u16) -> Vec<u16> {
        let tag = Tag::from_u16_exhaustive(number);
        self.decoder.find_tag_unsigned_vec(tag).ok().flatten().unwrap_or_default()
    }

    fn doubles(&mut self, number: u16) -> Vec<f64> {
        self.decoder.get_tag_f64_vec(Tag::from_u16_exhaustive(number)).unwrap_or_default()
    }

    fn text(&mut self, number: u16) -> String {
        self.decoder.get_tag_ascii_string(Tag::from_u16_exhaustive(number)).unwrap_or_default()
    }
}

/// What numbers of a file stand for.
struct Meaning {
    nodata: Option<f64>,
    scale: f64,
    offset: f64,
}

impl Meaning {
    fn of(nodata: &str, about: &str) -> Result<Self, Error> {
        let text = nodata.trim_matches(|c: char| c == '\0' || c.is_whitespace());
        let number = || {
            text.parse::<f64>().map_err(|_| {
                Error::content(format!("TIFF: what stands for no data is no number: {:?}", excerpt(text)))
            })
        };
        let nodata = if text.is_empty() { None } else { Some(number()?) };
        let mut meaning = Self { nodata, scale: 1.0, offset: 0.0 };
        let Ok(document) = xml::parse(about.trim_matches('\0')) else { return Ok(meaning) };
        for item in document.descendants().filter(|node| node.has_tag_name("Item")) {
            let is_first = item.attribute("sample").is_none_or(|sample| sample == "0");
            let value =
                item.text().and_then(|text| text.trim().parse::<f64>().ok()).filter(|x| x.is_finite());
            match (item.attribute("role"), value) {
                (Some("scale"), Some(value)) if is_first => meaning.scale = value,
                (Some("offset"), Some(value)) if is_first => meaning.offset = value,
                _ => {}
            }
        }
        Ok(meaning)
    }

    fn value(&self, stored: f64, nodata: Option<f64>) -> f64 {
        if Some(stored) == nodata {
            return f64::NAN;
        }
        if self.scale == 1.0 && self.offset == 0.0 { stored } else { stored * self.scale + self.offset }
    }
}

/// A part of the raster that a strip or a tile fills.
struct Part<'a> {
    values: &'a mut [f64],
    left: usize,
    top: usize,
    columns: usize,
    rows: usize,
    /// Columns of the raster.
    all: usize,
    bands: usize,
}

impl Part<'_> {
    fn fill(self, decoded: &DecodingResult, meaning: &Meaning) -> Result<(), Error> {
        let nodata = meaning.nodata;
        match decoded {
            DecodingResult::U8(numbers) => self.put(numbers, |&x| meaning.value(x.into(), nodata)),
            DecodingResult::I8(numbers) => self.put(numbers, |&x| meaning.value(x.into(), nodata)),
            DecodingResult::U16(numbers) => self.put(numbers, |&x| meaning.value(x.into(), nodata)),
            DecodingResult::I16(numbers) => self.put(numbers, |&x| meaning.value(x.into(), nodata)),
            DecodingResult::U32(numbers) => self.put(numbers, |&x| meaning.value(x.into(), nodata)),
            DecodingResult::I32(numbers) => self.put(numbers, |&x| meaning.value(x.into(), nodata)),
            // Heights have no more digits than float64; a nodata of many digits is compared as it was written.
            DecodingResult::U64(numbers) => self.put(numbers, |&x| meaning.value(x as f64, nodata)),
            DecodingResult::I64(numbers) => self.put(numbers, |&x| meaning.value(x as f64, nodata)),
            DecodingResult::F16(numbers) => self.put(numbers, |&x| meaning.value(x.into(), nodata)),
            DecodingResult::F32(numbers) => {
                // Written with few digits or many: as the file's numbers have it.
                let nodata = nodata.map(|x| f64::from(x as f32));
                self.put(numbers, |&x| meaning.value(x.into(), nodata))
            }
            DecodingResult::F64(numbers) => self.put(numbers, |&x| meaning.value(x, nodata)),
        }
    }

    fn put<T>(self, numbers: &[T], value: impl Fn(&T) -> f64) -> Result<(), Error> {
        let width = self.columns * self.bands;
        if numbers.len() < self.rows * width {
            return Err(Error::Truncated("inside a part of the raster".to_owned()));
        }
        for (i, row) in numbers.chunks_exact(width).take(self.rows).enumerate() {
            let start = (self.top + i) * self.all + self.left;
            let cells = &mut self.values[start..start + self.columns];
            for (cell, number) in cells.iter_mut().zip(row.iter().step_by(self.bands)) {
                *cell = value(number);
            }
        }
        Ok(())
    }
}
