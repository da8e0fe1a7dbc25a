//! Pictures of triangulations: readable at twenty points and at a million.
//!
//! A drawing shows as much as there is room for: edges while they are a few pixels long, vertices while they
//! do not touch, and otherwise the triangles alone, colored by height with shading (a relief) or, without
//! heights, by how dense the points are.
//!
//! Constraints are heavier lines, regions have soft colors of their own.
//!
//! A series of pictures with one window is a motion: see [`Animation`].

mod animation;
mod cells;
mod color;
mod contours;
mod indexed;
mod legend;
mod palette;
mod png;
mod raster;
mod relief;
mod ruler;
mod sketch;
mod solid;
mod svg;
mod view;

pub use animation::Animation;
pub(crate) use cells::write as write_cells;
pub(crate) use contours::write_contours;
pub use sketch::{Mark, Sketch, Tone, write_sketch};
pub use solid::Camera;
pub(crate) use solid::write as write_solid;

use std::io::Write;

use delone::Triangulation;

use crate::{Crs, Error, Format, Mesh};
use legend::Legend;
use relief::Paint;
use view::{Frame, View};

/// Options of a drawing. `None` leaves a choice to the room there is.
///
/// Fields may be added: a literal ends with `..` and a value to take the rest from.
#[derive(Clone, Debug)]
pub struct Options {
    /// The longer side in pixels, with the scale and the legend below.
    pub size: u32,
    /// In space, where it is seen from.
    pub camera: Camera,
    /// In the plane, draw edges.
    pub edges: Option<bool>,
    /// In the plane, draw vertices.
    pub points: Option<bool>,
    /// In the plane, fill triangles with color.
    pub fill: Option<bool>,
    /// In the plane, draw a disk of this radius, in coordinate units, around each vertex.
    pub disks: Option<f64>,
    /// In the plane, lines to draw, such as those from points to their hints.
    pub links: Vec<[[f64; 2]; 2]>,
    /// In the plane, lines to draw faintly below all others.
    pub faint: Vec<[[f64; 2]; 2]>,
    /// In the plane, draw the edges of what is left out faintly.
    pub outside: bool,
    /// In the plane, color triangles by their smallest angle, whatever regions and heights there are.
    pub angles: bool,
    /// In the plane, the corners of the box that is shown, if it is not that of the points.
    pub window: Option<[[f64; 2]; 2]>,
    /// Below the drawing, the value or the name of each region beside its color.
    pub legend: bool,
    /// The system of coordinates, if the mesh has none: longitude and latitude are drawn in the shape that they have on the ground.
    pub crs: Option<Crs>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            size: 1600,
            camera: Camera::default(),
            edges: None,
            points: None,
            fill: None,
            disks: None,
            links: Vec::new(),
            faint: Vec::new(),
            outside: false,
            angles: false,
            window: None,
            legend: true,
            crs: None,
        }
    }
}

/// The choices made.
#[derive(Clone, Copy, Debug)]
struct Layers {
    fill: bool,
    edges: bool,
    points: bool,
    /// Typical distance of neighbors in pixels.
    spacing: f64,
}

impl Layers {
    fn choose(mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>, view: &View, options: &Options) -> Self {
        let n = mesh.triangulation.vertex_count().max(1);
        let spacing = (f64::from(view.width) * f64::from(view.height) / n as f64).sqrt();
        let relief = mesh.heights.is_some();
        let is_colored = relief || options.angles;
        Self {
            fill: options.fill.unwrap_or(
                is_colored || mesh.regions.is_some() || (spacing < 60.0 && options.disks.is_none()),
            ),
            edges: options.edges.unwrap_or(spacing > if relief { 14.0 } else { 5.0 }),
            points: options.points.unwrap_or(spacing > if relief { 40.0 } else { 12.0 }),
            spacing,
        }
    }

    /// A width that looks right for the spacing: of edges in pixels.
    fn line_width(&self) -> f64 {
        (self.spacing / 40.0).clamp(0.4, 1.6)
    }

    /// Constraints stand out, also where no other edges are drawn.
    fn constraint_width(&self) -> f64 {
        (2.5 * self.line_width()).max(1.4)
    }

    fn point_radius(&self) -> f64 {
        (self.spacing / 8.0).clamp(1.2, 4.5)
    }
}

/// How a triangulation is drawn.
struct Look<'a> {
    view: &'a View,
    layers: Layers,
    options: &'a Options,
    paint: &'a Paint<'a>,
    legend: &'a Legend,
}

/// Draws a triangulation of the plane.
pub(crate) fn write(
    out: &mut dyn Write,
    format: Format,
    mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>,
    options: &Options,
) -> Result<(), Error> {
    check_size(options.size)?;
    let paint = Paint::of(mesh, options.angles);
    let legend = Legend::of(mesh, &paint, options);
    let frame = Frame::new(options.size, mesh.crs.or(options.crs.as_ref()));
    let view = legend.fit(frame, |frame| View::of(mesh, options, frame));
    let layers = Layers::choose(mesh, &view, options);
    let legend = if layers.fill { legend } else { Legend::None };
    let look = Look { view: &view, layers, options, paint: &paint, legend: &legend };
    match format {
        Format::Svg => Ok(svg::write(out, mesh, &look)?),
        _ => png::draw(mesh, &look)?.encode(out),
    }
}

fn check_size(size: u32) -> Result<(), Error> {
    if (16..=20_000).contains(&size) {
        return Ok(());
    }
    Err(Error::content(format!("a picture of {size} pixels: from 16 to 20000 are possible")))
}
