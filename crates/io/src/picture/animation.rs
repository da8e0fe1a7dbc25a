//! Moving pictures: animated PNG, which browsers and most viewers show, and others as the first picture.

use std::io::Write;

use delone::Triangulation;

use super::indexed::Indexed;
use super::legend::Legend;
use super::relief::Paint;
use super::view::{Frame, View};
use super::{Layers, Look, Options, Sketch, check_size, png};
use crate::{Error, Mesh};

/// An animated PNG being written, picture by picture.
pub struct Animation<W: Write> {
    writer: ::png::Writer<W>,
    options: Options,
    /// Made from the first picture and kept, so that nothing jumps.
    style: Option<(View, Layers)>,
    size: [u32; 2],
    indexed: Indexed,
    /// The numbers of the colors of the last picture.
    last: Vec<u8>,
}

fn failed(error: ::png::EncodingError) -> Error {
    match error {
        ::png::EncodingError::IoError(error) => Error::Io(error),
        other => Error::content(format!("PNG: {other}")),
    }
}

impl<W: Write> Animation<W> {
    /// Starts an animation of so many pictures of a window, each shown for some milliseconds, over and over.
    ///
    /// # Errors
    /// For a size or a number of pictures that no file can have, and when writing fails.
    pub fn start(
        out: W,
        window: [[f64; 2]; 2],
        pictures: u32,
        milliseconds: u16,
        options: Options,
    ) -> Result<Self, Error> {
        check_size(options.size)?;
        let view = View::around(window.into_iter(), &Frame::new(options.size, None));
        let mut encoder = ::png::Encoder::new(out, view.width, view.height);
        let indexed = Indexed::new();
        encoder.set_color(::png::ColorType::Indexed);
        encoder.set_palette(indexed.bytes());
        encoder.set_depth(::png::BitDepth::Eight);
        encoder.set_compression(::png::Compression::Balanced);
        // Lines on white paper repeat themselves best as they are.
        encoder.set_filter(::png::Filter::NoFilter);
        encoder.set_animated(pictures, 0).map_err(failed)?;
        encoder.set_frame_delay(milliseconds, 1000).map_err(failed)?;
        let writer = encoder.write_header().map_err(failed)?;
        let options = Options { window: Some(window), ..options };
        Ok(Self { writer, options, style: None, indexed, size: [view.width, view.height], last: Vec::new() })
    }

    /// Adds a picture.
    ///
    /// # Errors
    /// When there are more than were said, and when writing fails.
    pub fn add(&mut self, mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>) -> Result<(), Error> {
        let (view, layers) = *self.style.get_or_insert_with(|| {
            let view = View::of(mesh, &self.options, &Frame::new(self.options.size, None));
            (view, Layers::choose(mesh, &view, &self.options))
        });
        debug_assert_eq!([view.width, view.height], self.size);
        let paint = Paint::of(mesh, self.options.angles);
        let legend = if layers.fill { Legend::of(mesh, &paint, &self.options) } else { Legend::None };
        let look = Look { view: &view, layers, options: &self.options, paint: &paint, legend: &legend };
        let canvas = png::draw(mesh, &look)?;
        self.write(&canvas.colors())
    }

    /// Adds a sketch.
    ///
    /// # Errors
    /// As [`Self::add`].
    pub fn sketch(&mut self, sketch: &Sketch) -> Result<(), Error> {
        let window = self.options.window.into_iter().flatten();
        let canvas = sketch.draw(&View::around(window, &Frame::new(self.options.size, None)))?;
        self.write(&canvas.colors())
    }

    /// Writes what has changed since the last picture: the smallest box around it.
    fn write(&mut self, colors: &[u8]) -> Result<(), Error> {
        let width = self.size[0] as usize;
        let colors = self.indexed.numbers(colors);
        if self.last.is_empty() {
            self.writer.write_image_data(&colors).map_err(failed)?;
        } else {
            let changed = colors.iter().zip(&self.last).enumerate().filter(|(_, (new, old))| new != old);
            // A picture has a pixel at least.
            let (mut low, mut high) = ([width - 1, self.size[1] as usize - 1], [0, 0]);
            for (i, _) in changed {
                let at = [i % width, i / width];
                low = [low[0].min(at[0]), low[1].min(at[1])];
                high = [high[0].max(at[0]), high[1].max(at[1])];
            }
            let (low, high) = if low[0] > high[0] { ([0, 0], [0, 0]) } else { (low, high) };
            let [across, down] = [high[0] - low[0] + 1, high[1] - low[1] + 1];
            self.writer.set_frame_position(0, 0).map_err(failed)?;
            self.writer.set_frame_dimension(across as u32, down as u32).map_err(failed)?;
            self.writer.set_frame_position(low[0] as u32, low[1] as u32).map_err(failed)?;
            let rows = (low[1]..=high[1]).map(|y| y * width + low[0]..y * width + high[0] + 1);
            let part: Vec<u8> = rows.flat_map(|row| colors[row].iter().copied()).collect();
            self.writer.write_image_data(&part).map_err(failed)?;
        }
        self.last = colors;
        Ok(())
    }

    /// Ends the file.
    ///
    /// # Errors
    /// When there are fewer pictures than were said, and when writing fails.
    pub fn finish(self) -> Result<(), Error> {
        self.writer.finish().map_err(failed)
    }
}
