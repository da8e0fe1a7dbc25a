//! Pictures of triangulations: readable at twenty points and at a million.
//!
//! What is drawn follows from the room there is: edges while they are a few pixels long, vertices while they
//! do not touch, and otherwise the triangles alone, coloured by height with shading (a relief) or, without
//! heights, by how dense the points are.

mod cells;
mod colour;
mod png;
mod raster;
mod relief;
mod solid;
mod svg;
mod view;

pub(crate) use cells::write as write_cells;
pub use solid::Camera;
pub(crate) use solid::write as write_solid;

use std::io::Write;

use crate::{Error, Format, Surface};
use view::View;

/// What to draw. `None` leaves a choice to the room there is.
#[derive(Clone, Debug)]
pub struct Options {
    /// The longer side in pixels.
    pub size: u32,
    /// Draw edges.
    pub edges: Option<bool>,
    /// Draw vertices.
    pub points: Option<bool>,
    /// Fill triangles with colour.
    pub fill: Option<bool>,
}

impl Default for Options {
    fn default() -> Self {
        Self { size: 1600, edges: None, points: None, fill: None }
    }
}

/// The choices made.
#[derive(Clone, Copy, Debug)]
struct Layers {
    fill: bool,
    edges: bool,
    points: bool,
    /// Typical distance of neighbours in pixels.
    spacing: f64,
}

impl Layers {
    fn choose(surface: &Surface, view: &View, options: &Options) -> Self {
        let n = surface.triangulation.vertex_count().max(1);
        let spacing = (f64::from(view.width) * f64::from(view.height) / n as f64).sqrt();
        let relief = surface.heights.is_some();
        Self {
            fill: options.fill.unwrap_or(relief || spacing < 60.0),
            edges: options.edges.unwrap_or(spacing > if relief { 14.0 } else { 5.0 }),
            points: options.points.unwrap_or(spacing > if relief { 40.0 } else { 12.0 }),
            spacing,
        }
    }

    /// A width that looks right for the spacing: of edges in pixels.
    fn line_width(&self) -> f64 {
        (self.spacing / 40.0).clamp(0.4, 1.6)
    }

    fn point_radius(&self) -> f64 {
        (self.spacing / 8.0).clamp(1.2, 4.5)
    }
}

/// Draws a triangulation.
pub fn write(out: &mut dyn Write, format: Format, surface: &Surface, options: &Options) -> Result<(), Error> {
    check_size(options.size)?;
    let view = View::of(surface, options.size);
    let layers = Layers::choose(surface, &view, options);
    match format {
        Format::Svg => Ok(svg::write(out, surface, &view, layers)?),
        _ => png::write(out, surface, &view, layers),
    }
}

fn check_size(size: u32) -> Result<(), Error> {
    if (16..=20_000).contains(&size) {
        return Ok(());
    }
    Err(Error::content(format!("a picture of {size} pixels: from 16 to 20000 are possible")))
}
