//! Tiles of a GeoTIFF: cut out of a band of rows, predicted and compressed.
//!
//! The predictor of floating point numbers (Adobe Photoshop TIFF Technical Note 3, 2005) puts bytes of equal weight of a row together and
//! replaces them by their differences, which of terrain takes a third of the room.

use std::io::{self, Write};

use flate2::write::ZlibEncoder;

use crate::raster::{Compression, Sample};

/// Cells along the side of a tile.
const SIDE: usize = 512;
/// The bytes of a band of rows at most, where tiles can be smaller.
const BAND: usize = 1 << 25;
/// Sides of tiles are multiples of this (TIFF 6.0).
const UNIT: usize = 16;

/// How the tiles of a file are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) sample: Sample,
    pub(super) compression: Compression,
}

impl Shape {
    /// Tiles of 512 x 512 cells. Of wide rasters they are smaller, so that a row of tiles has a bounded size, and no longer than the raster.
    pub(super) fn of(columns: usize, rows: usize, sample: Sample, compression: Compression) -> Self {
        let mut side = SIDE;
        while side > UNIT && side * columns * sample.size() > BAND {
            side /= 2;
        }
        let [width, height] = [columns, rows].map(|n| side.min(n.next_multiple_of(UNIT)));
        Self { width, height, sample, compression }
    }

    /// The number that a file has for the compression.
    pub(super) fn number(&self) -> u16 {
        match self.compression {
            Compression::None => 1,
            Compression::Lzw => 5,
            Compression::Deflate => 8,
        }
    }

    /// The number that a file has for the predictor.
    pub(super) fn predictor(&self) -> u16 {
        match (self.compression, self.sample) {
            (Compression::None, _) => 1,
            (_, Sample::U8) => 2,
            _ => 3,
        }
    }

    /// Tiles beside each other.
    pub(super) fn across(&self, columns: usize) -> usize {
        columns.div_ceil(self.width)
    }

    /// The tile with a number in a band of whole rows. Beyond the raster there are zeros.
    pub(super) fn pack(&self, band: &[u8], columns: usize, number: usize) -> io::Result<Vec<u8>> {
        let size = self.sample.size();
        let (left, all) = (number * self.width, self.width * size);
        let right = columns.min(left + self.width);
        let mut tile = vec![0; all * self.height];
        let mut row = vec![0; all];
        for (numbers, whole) in tile.chunks_exact_mut(all).zip(band.chunks_exact(columns * size)) {
            let part = &whole[left * size..right * size];
            numbers[..part.len()].copy_from_slice(part);
            if self.predictor() != 1 {
                predict(numbers, &mut row, size);
            }
        }
        match self.compression {
            Compression::None => Ok(tile),
            Compression::Lzw => weezl::encode::Encoder::with_tiff_size_switch(weezl::BitOrder::Msb, 8)
                .encode(&tile)
                .map_err(io::Error::other),
            Compression::Deflate => {
                let room = Vec::with_capacity(tile.len() / 2);
                let mut encoder = ZlibEncoder::new(room, flate2::Compression::default());
                encoder.write_all(&tile)?;
                encoder.finish()
            }
        }
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
