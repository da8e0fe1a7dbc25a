//! An image of a TIFF file: its layout, and the bytes of its strips or tiles.

use std::io::SeekFrom;

use tiff::Directory;
use tiff::decoder::{Decoder, IfdDecoder};
use tiff::tags::{ByteOrder, Tag};

use super::read::broken;
use super::{compression, tag};
use crate::input::most_inflated;
use crate::{Error, Source};

/// Meanings of cells: shades, of which 0 may be the lightest or the darkest, colors, masks.
const SHADES: [u16; 2] = [0, 1];
const COLOURS: u16 = 2;
const MASK: u16 = 4;

/// The layout of an image.
#[derive(Debug)]
pub(super) struct Page {
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// Numbers of a cell.
    pub(super) samples: usize,
    /// Numbers of a cell that are together.
    pub(super) bands: usize,
    pub(super) bits: u16,
    pub(super) sample_format: u16,
    pub(super) compression: u16,
    pub(super) predictor: u16,
    /// Whether 0 is the lightest shade.
    pub(super) meaning: u16,
    pub(super) order: ByteOrder,
    pub(super) is_tiled: bool,
    /// Columns and rows of a strip or tile.
    pub(super) width: usize,
    pub(super) height: usize,
    /// Where strips or tiles begin in the file, and their bytes.
    places: Vec<u64>,
    sizes: Vec<u64>,
}

impl Page {
    /// Reads the layout from a directory.
    pub(super) fn of(
        decoder: &mut Decoder<Box<dyn Source>>,
        directory: &Directory,
        is_mask: bool,
    ) -> Result<Self, Error> {
        let order = decoder.byte_order();
        let mut tags = decoder.read_directory_tags(directory);
        let meaning = number(&mut tags, tag::MEANING, SHADES[1])?;
        let is_known =
            if is_mask { meaning == MASK } else { SHADES.contains(&meaning) || meaning == COLOURS };
        if !is_known {
            return Err(Error::content(format!("TIFF: cells of the kind {meaning} are no heights")));
        }
        let bits = number(&mut tags, tag::BITS, 1_u16)?;
        if !(matches!(bits, 8 | 16 | 32 | 64) || is_mask && bits == 1) {
            return Err(Error::content(format!("TIFF: numbers of {bits} bits are not read here")));
        }
        let [columns, rows] = [tag::WIDTH, tag::LENGTH].map(|tag| size(&mut tags, tag, None));
        let (columns, rows) = (columns?, rows?);
        let is_tiled = tags.find_entry(Tag::from_u16_exhaustive(tag::TILES)).is_some();
        let (width, height, places, sizes) = if is_tiled {
            (
                size(&mut tags, tag::TILE_WIDTH, None)?,
                size(&mut tags, tag::TILE_LENGTH, None)?,
                tag::TILES,
                tag::TILE_SIZES,
            )
        } else {
            let height = size(&mut tags, tag::STRIP_ROWS, Some(rows))?;
            (columns, height.min(rows), tag::STRIPS, tag::STRIP_SIZES)
        };
        let is_planar = number(&mut tags, tag::PLANES, 1_u16)? == 2;
        let samples = size(&mut tags, tag::SAMPLES, Some(1))?;
        let page = Self {
            columns,
            rows,
            samples,
            bands: if is_planar { 1 } else { samples },
            bits,
            sample_format: number(&mut tags, tag::SAMPLE_FORMAT, 1)?,
            compression: number(&mut tags, tag::COMPRESSION, 1)?,
            predictor: number(&mut tags, tag::PREDICTOR, 1)?,
            meaning: meaning.min(1),
            order,
            is_tiled,
            width,
            height,
            places: numbers(&mut tags, places)?,
            sizes: numbers(&mut tags, sizes)?,
        };
        compression::check(page.compression)?;
        let parts = page.across() as f64 * rows.div_ceil(height) as f64;
        if (page.places.len() as f64) < parts || page.sizes.len() != page.places.len() {
            return Err(Error::content("TIFF: the directory has too few places of strips or tiles"));
        }
        Ok(page)
    }

    /// Strips or tiles beside each other.
    pub(super) fn across(&self) -> usize {
        self.columns.div_ceil(self.width)
    }

    /// The bytes of so many cells without compression.
    pub(super) fn bytes(&self, columns: usize, rows: usize) -> u64 {
        let bits = (columns as u64).saturating_mul(self.bands as u64).saturating_mul(self.bits.into());
        bits.div_ceil(8).saturating_mul(rows as u64)
    }

    /// The bytes of a strip or tile as they are in a file of so many bytes; none of one that the file leaves out.
    pub(super) fn part(
        &self,
        source: &mut dyn Source,
        length: u64,
        number: usize,
        rows: usize,
    ) -> Result<Option<Vec<u8>>, Error> {
        let (place, size) = (self.places[number], self.sizes[number]);
        if place == 0 || size == 0 {
            return Ok(None);
        }
        if place.checked_add(size).is_none_or(|end| end > length) {
            return Err(Error::Truncated(format!("inside part {number} of the raster")));
        }
        if self.bytes(self.width, rows) > most_inflated(size) {
            return Err(Error::Expands);
        }
        source.seek(SeekFrom::Start(place))?;
        let mut bytes = vec![0; size as usize];
        source.read_exact(&mut bytes)?;
        Ok(Some(bytes))
    }
}

/// The number of a tag, the first of several.
fn number<T: TryFrom<u64>>(tags: &mut IfdDecoder<'_>, tag: u16, default: T) -> Result<T, Error> {
    let Some(number) = numbers(tags, tag)?.first().copied() else { return Ok(default) };
    number
        .try_into()
        .map_err(|_| Error::content(format!("TIFF: the number {number} of tag {tag} is too large")))
}

/// A number of cells.
fn size(tags: &mut IfdDecoder<'_>, tag: u16, default: Option<usize>) -> Result<usize, Error> {
    let found = number(tags, tag, default.unwrap_or(0) as u32)?;
    if found == 0 {
        Err(Error::content(format!("TIFF: the number of tag {tag} is 0")))
    } else {
        Ok(found as usize)
    }
}

fn numbers(tags: &mut IfdDecoder<'_>, tag: u16) -> Result<Vec<u64>, Error> {
    Ok(tags.find_tag_unsigned_vec(Tag::from_u16_exhaustive(tag)).map_err(broken)?.unwrap_or_default())
}
