//! Hillshades as pictures. What has no data is transparent.

use std::io::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};

use delone::surface::Grid;
use png::{BitDepth, ColorType, Encoder, StreamWriter};

use super::{Relief, ReliefRows};
use crate::{Crs, Error};

/// Writes a hillshade as PNG, row by row.
pub struct ShadeWriter<W: Write + 'static> {
    stream: StreamWriter<'static, Shared<W>>,
    /// Where it goes, which the stream would not give back.
    out: Arc<Mutex<W>>,
    shades: ReliefRows,
    columns: usize,
}

impl<W: Write> std::fmt::Debug for ShadeWriter<W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ShadeWriter").field("columns", &self.columns).finish_non_exhaustive()
    }
}

/// An output that a stream and its owner have.
struct Shared<W>(Arc<Mutex<W>>);

impl<W: Write> Write for Shared<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).flush()
    }
}

fn failed(error: png::EncodingError) -> Error {
    match error {
        png::EncodingError::IoError(error) => Error::Io(error),
        other => Error::content(other.to_string()),
    }
}

impl<W: Write + 'static> ShadeWriter<W> {
    /// Begins a picture with a pixel for each cell, of shades from 1 to 255 ([`ReliefKind::Hillshade`](super::ReliefKind)).
    ///
    /// # Errors
    /// For more than 2^31 - 1 columns or rows, and none; and those of the output.
    pub fn create(out: W, grid: &Grid, crs: Option<&Crs>, relief: Relief) -> Result<Self, Error> {
        let size = |n: usize| u32::try_from(n).ok().filter(|&n| n > 0 && i32::try_from(n).is_ok());
        let (Some(width), Some(height)) = (size(grid.columns()), size(grid.rows())) else {
            return Err(Error::content(format!(
                "a picture of {} x {} cells cannot be",
                grid.columns(),
                grid.rows()
            )));
        };
        let out = Arc::new(Mutex::new(out));
        let mut encoder = Encoder::new(Shared(Arc::clone(&out)), width, height);
        encoder.set_color(ColorType::GrayscaleAlpha);
        encoder.set_depth(BitDepth::Eight);
        let stream = encoder.write_header().and_then(png::Writer::into_stream_writer).map_err(failed)?;
        Ok(Self { stream, out, shades: relief.rows(grid, crs), columns: grid.columns() })
    }

    /// Takes the next rows.
    ///
    /// # Errors
    /// Those of the output.
    pub fn write_rows(&mut self, values: &[f64]) -> Result<(), Error> {
        for row in values.chunks_exact(self.columns) {
            if let Some(shades) = self.shades.next(row) {
                self.write(&shades)?;
            }
        }
        Ok(())
    }

    /// Writes the last row, and gives the output back, which is then to be committed.
    ///
    /// # Errors
    /// Those of the output.
    pub fn finish(mut self) -> Result<W, Error> {
        if let Some(shades) = self.shades.last() {
            self.write(&shades)?;
        }
        self.stream.finish().map_err(failed)?;
        let lost = || Error::content("the picture is still being written");
        Ok(Arc::into_inner(self.out).ok_or_else(lost)?.into_inner().unwrap_or_else(PoisonError::into_inner))
    }

    fn write(&mut self, shades: &[f64]) -> Result<(), Error> {
        let pixel = |shade: &f64| if shade.is_nan() { [0, 0] } else { [shade.round() as u8, 255] };
        let pixels: Vec<u8> = shades.iter().flat_map(pixel).collect();
        Ok(self.stream.write_all(&pixels)?)
    }
}
