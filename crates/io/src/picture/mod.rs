//! Pictures of triangulations: readable at twenty points and at a million.
//!
//! What is drawn follows from the room there is: edges while they are a few pixels long, vertices while they
//! do not touch, and otherwise the triangles alone, coloured by height with shading (a relief) or, without
//! heights, by how dense the points are.
//!
//! A series of pictures with one window is a motion: see [`Animation`].

mod animation;
mod cells;
mod colour;
mod png;
mod raster;
mod relief;
mod solid;
mod svg;
mod view;

pub use animation::Animation;
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
    /// Draw a disk of this radius, in coordinate units, around each vertex.
    pub disks: Option<f64>,
    /// Lines to draw, such as those from points to their hints.
    pub links: Vec<[[f64; 2]; 2]>,
    /// The corners of the box that is shown, if it is not that of the points.
    pub window: Option<[[f64; 2]; 2]>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            size: 1600,
            edges: None,
            points: None,
            fill: None,
            disks: None,
            links: Vec::new(),
            window: None,
        }
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
            fill: options.fill.unwrap_or(relief || (spacing < 60.0 && options.disks.is_none())),
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
    let view = View::of(surface, options);
    let layers = Layers::choose(surface, &view, options);
    match format {
        Format::Svg => Ok(svg::write(out, surface, &view, layers, options)?),
        _ => png::draw(surface, &view, layers, options)?.encode(out),
    }
}

fn check_size(size: u32) -> Result<(), Error> {
    if (16..=20_000).contains(&size) {
        return Ok(());
    }
    Err(Error::content(format!("a picture of {size} pixels: from 16 to 20000 are possible")))
}
