//! Reads a GeoTIFF: strips or tiles of any numbers, the first band of several, without the cells of an internal mask.
//!
//! The `tiff` crate reads directories and decodes parts, behind the fence. What a header claims is compared with the bytes that are
//! there before anything is decoded ([`most_inflated`]).

use std::collections::BTreeSet;
use std::io::SeekFrom;

use delone::surface::Grid;
use tiff::decoder::{Decoder, DecodingResult, IfdDecoder};
use tiff::tags::Tag;
use tiff::{Directory, TiffError};

use super::cells::Cells;
use super::meaning::Meaning;
use super::page::Page;
use super::{part, place, tag};
use crate::crs::keys::{decode, is_point};
use crate::input::most_inflated;
use crate::raster::Raster;
use crate::{Crs, Error, Source, guard};

pub(crate) fn read(source: Box<dyn Source>) -> Result<Raster, Error> {
    guard::decode("TIFF", || File::open(source)?.read())
}

/// Where the cells are, and their system.
pub(crate) fn read_place(source: Box<dyn Source>) -> Result<(Grid, Option<Crs>), Error> {
    guard::decode("TIFF", || {
        let mut file = File::open(source)?;
        let page = Page::of(&mut file.decoder, &file.image, false)?;
        file.place(&page)
    })
}

/// Turns an error of the crate into ours.
pub(super) fn broken(error: TiffError) -> Error {
    match error {
        TiffError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            Error::Truncated("inside the raster".to_owned())
        }
        TiffError::IoError(error) if error.kind() != std::io::ErrorKind::InvalidData => error.into(),
        other => Error::content(format!("TIFF: {other}")),
    }
}

/// A file whose directories are read.
struct File {
    decoder: Decoder<Box<dyn Source>>,
    /// Bytes of the file.
    length: u64,
    /// The image of heights, and the mask of it.
    image: Directory,
    mask: Option<Directory>,
    losses: Vec<String>,
}

impl File {
    /// Looks for the first image that is no smaller copy and no mask, and for a mask of its size.
    fn open(mut source: Box<dyn Source>) -> Result<Self, Error> {
        let length = source.seek(SeekFrom::End(0))?;
        source.rewind()?;
        let mut decoder = Decoder::new(source).map_err(broken)?;
        let mut seen = BTreeSet::new();
        let (mut images, mut first, mut masks) = (0, None, Vec::new());
        let mut next = decoder.ifd_pointer();
        while let Some(pointer) = next {
            if !seen.insert(pointer.0) {
                return Err(Error::content("TIFF: the directories go around in a circle"));
            }
            let directory = decoder.read_directory(pointer).map_err(broken)?;
            next = directory.next();
            let kind = decoder
                .read_directory_tags(&directory)
                .find_tag_unsigned(Tag::from_u16_exhaustive(tag::KIND))
                .map_err(broken)?;
            match kind.unwrap_or(0_u32) {
                kind if kind & tag::REDUCED != 0 => {}
                kind if kind & tag::MASK != 0 => masks.push(directory),
                _ => {
                    images += 1;
                    first.get_or_insert(directory);
                }
            }
        }
        let image = first.ok_or_else(|| Error::content("TIFF: there are smaller copies and masks alone"))?;
        let mut size = |directory: &Directory| {
            let mut tags = decoder.read_directory_tags(directory);
            [tag::WIDTH, tag::LENGTH]
                .map(|tag| tags.find_tag_unsigned::<u32>(Tag::from_u16_exhaustive(tag)).ok())
        };
        let all = size(&image);
        let mask = masks.into_iter().find(|mask| size(mask) == all);
        let losses =
            if images > 1 { vec![format!("of {images} pages the first is read")] } else { Vec::new() };
        Ok(Self { decoder, length, image, mask, losses })
    }

    fn read(mut self) -> Result<Raster, Error> {
        let page = Page::of(&mut self.decoder, &self.image, false)?;
        let (grid, crs) = self.place(&page)?;
        let meaning = Meaning::of(&self.text(tag::NO_DATA), &self.text(tag::ABOUT))?;
        let mask = self.mask.as_ref().map(|mask| Page::of(&mut self.decoder, mask, true)).transpose()?;
        let mut values = Vec::new();
        self.parts(&page, |cells, decoded| {
            values.resize((cells.top + cells.rows) * page.columns, f64::NAN);
            match decoded {
                Some(decoded) => cells.fill(&mut values, &decoded, &meaning)?,
                None => cells.fill_with(&mut values, meaning.absent()),
            }
            Ok(())
        })?;
        if let Some(mask) = mask {
            self.parts(&mask, |cells, decoded| {
                match decoded {
                    Some(DecodingResult::U8(numbers)) => cells.mask(&mut values, &numbers, mask.bits)?,
                    Some(_) => return Err(Error::content("TIFF: the numbers of a mask have 1 or 8 bits")),
                    None => cells.fill_with(&mut values, f64::NAN),
                }
                Ok(())
            })?;
        }
        if page.samples > 1 {
            self.losses.push(format!("of {} bands the first is read", page.samples));
        }
        Ok(Raster { grid, crs, values, losses: self.losses })
    }

    /// Where the cells are, and their system.
    fn place(&mut self, page: &Page) -> Result<(Grid, Option<Crs>), Error> {
        let numbers = self.shorts(tag::KEYS);
        let crs = decode(&numbers, &self.doubles(tag::DOUBLES), self.text(tag::TEXTS).as_bytes());
        let [scale, tie, matrix] = [tag::SCALE, tag::TIE, tag::TRANSFORM].map(|number| self.doubles(number));
        let grid = place::grid(&scale, &tie, &matrix, is_point(&numbers), [page.columns, page.rows])?;
        Ok((grid, crs))
    }

    /// Decodes the strips or tiles of an image in their order; there is nothing of those that the file leaves out.
    fn parts(
        &mut self,
        page: &Page,
        mut take: impl FnMut(Cells, Option<DecodingResult>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        if page.bytes(page.columns, page.rows) > most_inflated(self.length) {
            return Err(Error::Expands);
        }
        let across = page.across();
        for (number, top) in (0..page.rows).step_by(page.height).enumerate() {
            let rows = page.height.min(page.rows - top);
            let held = if page.is_tiled { page.height } else { rows };
            for k in 0..across {
                let bytes = page.part(self.decoder.inner(), self.length, number * across + k, held)?;
                let decoded = bytes.map(|bytes| part::decode(page, &bytes, held)).transpose()?;
                let left = k * page.width;
                let columns = page.width.min(page.columns - left);
                let (width, all, bands) = (page.width, page.columns, page.bands);
                take(Cells { left, top, columns, rows, width, all, bands }, decoded)?;
            }
        }
        Ok(())
    }
    fn shorts(&mut self, number: u16) -> Vec<u16> {
        self.tags().find_tag_unsigned_vec(Tag::from_u16_exhaustive(number)).ok().flatten().unwrap_or_default()
    }

    fn doubles(&mut self, number: u16) -> Vec<f64> {
        self.tags().get_tag_f64_vec(Tag::from_u16_exhaustive(number)).unwrap_or_default()
    }

    fn text(&mut self, number: u16) -> String {
        self.tags().get_tag_ascii_string(Tag::from_u16_exhaustive(number)).unwrap_or_default()
    }

    fn tags(&mut self) -> IfdDecoder<'_> {
        self.decoder.read_directory_tags(&self.image)
    }
}
