//! Hillshades: rasters of heights as pictures, lit from one side.
//!
//! Source: Horn, "Hill shading and the reflectance map", Proc. IEEE 1981, for the slopes: weighted differences of the eight cells
//! around. Beside no data the cell itself stands for its neighbour. What has no data is transparent.
//!
//! Memory: three rows. Cost: O(cells).

use std::io::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};

use delone::surface::Grid;
use png::{BitDepth, ColorType, Encoder, StreamWriter};

use crate::Error;

/// Where the light is, in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Clockwise from north.
    pub azimuth: f64,
    /// Above the horizon.
    pub altitude: f64,
}

impl Default for Light {
    /// In the north-west, as is usual on maps.
    fn default() -> Self {
        Self { azimuth: 315.0, altitude: 45.0 }
    }
}

/// Writes a hillshade as PNG, row by row.
pub struct ShadeWriter<W: Write + 'static> {
    stream: StreamWriter<'static, Shared<W>>,
    /// Where it goes, which the stream would not give back.
    out: Arc<Mutex<W>>,
    light: [f64; 3],
    step: [f64; 2],
    columns: usize,
    /// The row that is to be shaded, and those around it.
    above: Option<Vec<f64>>,
    row: Option<Vec<f64>>,
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
    /// Begins a picture with a pixel for each cell.
    ///
    /// # Errors
    /// For more than 2^31 - 1 columns or rows, and none; and those of the output.
    pub fn create(out: W, grid: &Grid, light: Light) -> Result<Self, Error> {
        let size = |n: usize| u32::try_from(n).ok().filter(|&n| n > 0 && n <= i32::MAX as u32);
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
        let [azimuth, altitude] = [light.azimuth, light.altitude].map(f64::to_radians);
        let light = [azimuth.sin() * altitude.cos(), azimuth.cos() * altitude.cos(), altitude.sin()];
        Ok(Self { stream, out, light, step: grid.step(), columns: grid.columns(), above: None, row: None })
    }

    /// Takes the next rows.
    ///
    /// # Errors
    /// Those of the output.
    pub fn write_rows(&mut self, values: &[f64]) -> Result<(), Error> {
        for next in values.chunks_exact(self.columns) {
            let row = self.row.replace(next.to_vec());
            if let Some(row) = row {
                self.shade(&row, next)?;
                self.above = Some(row);
            }
        }
        Ok(())
    }

    /// Writes the last row, and gives the output back, which is then to be committed.
    ///
    /// # Errors
    /// Those of the output.
    pub fn finish(mut self) -> Result<W, Error> {
        if let Some(row) = self.row.take() {
            self.shade(&row, &row)?;
        }
        self.stream.finish().map_err(failed)?;
        let lost = || Error::content("the picture is still being written");
        Ok(Arc::into_inner(self.out).ok_or_else(lost)?.into_inner().unwrap_or_else(PoisonError::into_inner))
    }

    fn shade(&mut self, row: &[f64], below: &[f64]) -> Result<(), Error> {
        let above = self.above.as_deref().unwrap_or(row);
        let mut pixels = Vec::with_capacity(2 * row.len());
        let last = row.len() - 1;
        for (k, &height) in row.iter().enumerate() {
            if height.is_nan() {
                pixels.extend([0, 0]);
                continue;
            }
            let around = [k.saturating_sub(1), k, (k + 1).min(last)];
            let [north, level, south] =
                [above, row, below].map(|row| around.map(|k| if row[k].is_nan() { height } else { row[k] }));
            let east = (north[2] + 2.0 * level[2] + south[2]) - (north[0] + 2.0 * level[0] + south[0]);
            let down = (south[0] + 2.0 * south[1] + south[2]) - (north[0] + 2.0 * north[1] + north[2]);
            let slope = [east / (8.0 * self.step[0]), down / (8.0 * self.step[1])];
            let normal = [-slope[0], -slope[1], 1.0];
            let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
            let bright: f64 = normal.iter().zip(self.light).map(|(a, b)| a * b).sum::<f64>() / length;
            pixels.extend([(1.0 + 254.0 * bright.clamp(0.0, 1.0)) as u8, 255]);
        }
        Ok(self.stream.write_all(&pixels)?)
    }
}
