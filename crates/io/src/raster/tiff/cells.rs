//! The cells of a raster that a strip or a tile fills.

use tiff::decoder::DecodingResult;

use super::meaning::Meaning;
use crate::Error;

/// Where the cells of a strip or tile are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells {
    pub(super) left: usize,
    pub(super) top: usize,
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// Columns of the strip or tile with what is beyond the raster.
    pub(super) width: usize,
    /// Columns of the raster.
    pub(super) all: usize,
    pub(super) bands: usize,
}

impl Cells {
    /// Fills cells with the first band of decoded numbers.
    pub(super) fn fill(
        &self,
        values: &mut [f64],
        decoded: &DecodingResult,
        meaning: &Meaning,
    ) -> Result<(), Error> {
        let nodata = meaning.nodata;
        match decoded {
            DecodingResult::U8(numbers) => self.put(values, numbers, |&x| meaning.value(x.into(), nodata)),
            DecodingResult::I8(numbers) => self.put(values, numbers, |&x| meaning.value(x.into(), nodata)),
            DecodingResult::U16(numbers) => self.put(values, numbers, |&x| meaning.value(x.into(), nodata)),
            DecodingResult::I16(numbers) => self.put(values, numbers, |&x| meaning.value(x.into(), nodata)),
            DecodingResult::U32(numbers) => self.put(values, numbers, |&x| meaning.value(x.into(), nodata)),
            DecodingResult::I32(numbers) => self.put(values, numbers, |&x| meaning.value(x.into(), nodata)),
            // Heights have no more digits than float64; a nodata of many digits is compared as it was written.
            DecodingResult::U64(numbers) => self.put(values, numbers, |&x| meaning.value(x as f64, nodata)),
            DecodingResult::I64(numbers) => self.put(values, numbers, |&x| meaning.value(x as f64, nodata)),
            DecodingResult::F16(numbers) => self.put(values, numbers, |&x| meaning.value(x.into(), nodata)),
            DecodingResult::F32(numbers) => {
                // Written with few digits or many: as the file's numbers have it.
                let nodata = nodata.map(|x| f64::from(x as f32));
                self.put(values, numbers, |&x| meaning.value(x.into(), nodata))
            }
            DecodingResult::F64(numbers) => self.put(values, numbers, |&x| meaning.value(x, nodata)),
        }
    }

    fn put<T>(&self, values: &mut [f64], numbers: &[T], value: impl Fn(&T) -> f64) -> Result<(), Error> {
        let width = self.width * self.bands;
        if numbers.len() < self.rows * width {
            return Err(Error::Truncated("inside a part of the raster".to_owned()));
        }
        for (cells, row) in self.of(values).zip(numbers.chunks_exact(width)) {
            for (cell, number) in cells.iter_mut().zip(row.iter().step_by(self.bands)) {
                *cell = value(number);
            }
        }
        Ok(())
    }

    /// Fills all cells with one value.
    pub(super) fn fill_with(&self, values: &mut [f64], value: f64) {
        self.of(values).for_each(|cells| cells.fill(value));
    }

    /// Takes the values of cells whose number in a mask is 0, of 1 bit or 8.
    pub(super) fn mask(&self, values: &mut [f64], numbers: &[u8], bits: u16) -> Result<(), Error> {
        let bytes = if bits == 1 { self.width.div_ceil(8) } else { self.width * self.bands };
        if numbers.len() < self.rows * bytes {
            return Err(Error::Truncated("inside a part of the mask".to_owned()));
        }
        for (cells, row) in self.of(values).zip(numbers.chunks_exact(bytes)) {
            for (k, cell) in cells.iter_mut().enumerate() {
                let is_valid = if bits == 1 { row[k / 8] >> (7 - k % 8) & 1 } else { row[k * self.bands] };
                if is_valid == 0 {
                    *cell = f64::NAN;
                }
            }
        }
        Ok(())
    }

    /// The cells, row by row.
    fn of<'a>(&self, values: &'a mut [f64]) -> impl Iterator<Item = &'a mut [f64]> + use<'a> {
        let (left, right) = (self.left, self.left + self.columns);
        values.chunks_exact_mut(self.all).skip(self.top).take(self.rows).map(move |row| &mut row[left..right])
    }
}
