//! Rasters as NumPy arrays: float64 of shape (rows, columns), NaN where there is no data.

use std::io::Write;

use super::{Raster, RasterInfo};
use crate::formats::npy;
use crate::{Error, Format, Source};

/// Writes rows as they come.
#[derive(Debug)]
pub(super) struct Writer<W> {
    out: W,
    bytes: Vec<u8>,
}

impl<W: Write> Writer<W> {
    pub(super) fn create(mut out: W, info: &RasterInfo) -> Result<Self, Error> {
        let (columns, rows) = (info.grid.columns(), info.grid.rows());
        if columns.checked_mul(rows).is_none_or(|cells| cells > isize::MAX as usize / 8) {
            return Err(Error::Extent { format: Format::Npy, columns, rows });
        }
        npy::write_header(&mut out, &[rows, columns])?;
        Ok(Self { out, bytes: Vec::new() })
    }

    pub(super) fn write_rows(&mut self, values: &[f64]) -> std::io::Result<()> {
        for part in values.chunks(1 << 13) {
            self.bytes.resize(8 * part.len(), 0);
            let places = self.bytes.as_chunks_mut().0;
            places.iter_mut().zip(part).for_each(|(place, value)| *place = value.to_le_bytes());
            self.out.write_all(&self.bytes)?;
        }
        Ok(())
    }

    pub(super) fn finish(mut self) -> Result<W, Error> {
        self.out.flush()?;
        Ok(self.out)
    }
}

/// Reads an array.
pub(crate) fn read(source: Box<dyn Source>) -> Result<Raster, Error> {
    let (rows, columns, values) = npy::read_grid(source)?;
    Ok(Raster { grid: Raster::nowhere(columns, rows)?, crs: None, values, losses: Vec::new() })
}
