//! Pictures of Voronoi cells, colored by size.

use std::io::Write;

use delone::Ring;

use super::color::{DENSITY, Density, EDGE, PAPER, POINT, Rgb};
use super::legend::Legend;
use super::png::Canvas;
use super::raster::Raster;
use super::svg::{Pen, RAMP_STEPS, SEAM_WIDTH, hex, open_parts};
use super::view::{Frame, View};
use crate::diagram::Tiles;
use crate::{Error, Format};

/// The style of a drawing.
struct Style {
    view: View,
    density: Density,
    /// Typical distance of neighbors in pixels.
    spacing: f64,
}

/// Draws clipped cells: filled by their area, outlined while there is room, with their sites.
pub(crate) fn write(
    out: &mut dyn Write,
    format: Format,
    diagram: &impl Tiles,
    size: u32,
) -> Result<(), Error> {
    super::check_size(size)?;
    let style = Style::of(diagram, size);
    match format {
        Format::Svg => Ok(svg(out, diagram, &style)?),
        _ => png(out, diagram, &style),
    }
}

impl Style {
    fn of(diagram: &impl Tiles, size: u32) -> Self {
        let view = View::around(diagram.corners(), &Frame::new(size, diagram.crs()));
        let mut areas: Vec<f64> = diagram.present().map(|v| diagram.area(v)).collect();
        areas.sort_by(f64::total_cmp);
        // A few outliers must not take all of the colors.
        let at = |share: f64| areas.get((areas.len() as f64 * share) as usize).copied().unwrap_or_default();
        let pixels = f64::from(view.width) * f64::from(view.height);
        let spacing = (pixels / areas.len().max(1) as f64).sqrt();
        Self { view, density: Density::between(at(0.02), at(0.98)), spacing }
    }

    fn color(&self, area: f64) -> Rgb {
        // Small cells are dense.
        DENSITY.at(self.density.of(area))
    }

    fn outlines(&self) -> bool {
        self.spacing > 5.0
    }

    fn line_width(&self) -> f64 {
        (self.spacing / 40.0).clamp(0.4, 1.6)
    }

    fn dot_radius(&self) -> Option<f64> {
        (self.spacing > 12.0).then(|| (self.spacing / 12.0).clamp(1.0, 3.5))
    }
}

fn legend() -> Legend {
    Legend::words(&DENSITY, ["large cells", "", "small"])
}

/// The sites that are on what is drawn.
fn dots<T: Tiles>(diagram: &T) -> impl Iterator<Item = (T::Tile, [f64; 2])> {
    diagram.sites().filter(|(tile, _)| diagram.rings(*tile).next().is_some())
}

/// Dark sites on light cells, light ones on dark cells.
fn dot_color(cell: Rgb) -> Rgb {
    if cell.iter().map(|&part| u32::from(part)).sum::<u32>() > 330 { POINT } else { PAPER }
}

fn png(out: &mut dyn Write, diagram: &impl Tiles, style: &Style) -> Result<(), Error> {
    let view = &style.view;
    let mut canvas = Canvas::from(&Raster::new(view.width, view.height, PAPER))?;
    let place = |ring: Ring| ring.points().map(|p| view.place(p)).collect::<Vec<_>>();
    for v in diagram.present() {
        let rings: Vec<_> = diagram.rings(v).map(place).collect();
        canvas.fill(&rings, style.color(diagram.area(v)));
    }
    if style.outlines() {
        let sides = diagram.present().flat_map(|v| diagram.rings(v)).flat_map(Ring::sides);
        let sides = sides.map(|side| side.map(|p| view.place(p)));
        canvas.lines(sides, EDGE, 255, style.line_width());
    }
    if let Some(radius) = style.dot_radius() {
        for color in [POINT, PAPER] {
            let wanted = |tile| dot_color(style.color(diagram.area(tile))) == color;
            let positions = dots(diagram).filter(|(tile, _)| wanted(*tile)).map(|(_, p)| view.place(p));
            canvas.dots(positions, radius, color, 255);
        }
    }
    canvas.strip(&legend().pieces(view));
    canvas.encode(out)
}

fn svg(out: &mut dyn Write, diagram: &impl Tiles, style: &Style) -> std::io::Result<()> {
    let view = &style.view;
    super::svg::open(out, view)?;
    let draw = |out: &mut dyn Write, pen: &mut Pen, tile| {
        diagram.rings(tile).try_for_each(|ring| pen.ring(out, ring.points().map(|p| view.place(p))))
    };
    if style.outlines() {
        open_parts(out, style.line_width())?;
        writeln!(out, r#" stroke="{}" fill-rule="evenodd">"#, hex(EDGE))?;
        for tile in diagram.present() {
            write!(out, r#"<path fill="{}" d=""#, hex(style.color(diagram.area(tile))))?;
            draw(out, &mut Pen::default(), tile)?;
            writeln!(out, r#""><title>{}</title></path>"#, diagram.title(tile))?;
        }
    } else {
        // Too many to be pointed at: those of one color together.
        let shade = |tile| (style.density.of(diagram.area(tile)) * RAMP_STEPS).round() as u32;
        let mut tiles: Vec<(u32, usize, _)> =
            diagram.present().enumerate().map(|(i, tile)| (shade(tile), i, tile)).collect();
        tiles.sort_unstable_by_key(|&(shade, i, _)| (shade, i));
        open_parts(out, SEAM_WIDTH)?;
        writeln!(out, r#" fill-rule="evenodd">"#)?;
        for alike in tiles.chunk_by(|a, b| a.0 == b.0) {
            let color = hex(DENSITY.at(f64::from(alike[0].0) / RAMP_STEPS));
            write!(out, r#"<path fill="{color}" stroke="{color}" d=""#)?;
            let mut pen = Pen::default();
            alike.iter().try_for_each(|&(.., tile)| draw(out, &mut pen, tile))?;
            writeln!(out, r#""/>"#)?;
        }
    }
    writeln!(out, "</g>")?;
    if let Some(radius) = style.dot_radius() {
        for (tile, p) in dots(diagram) {
            let [x, y] = view.place(p);
            let color = hex(dot_color(style.color(diagram.area(tile))));
            writeln!(out, r#"<circle cx="{x:.2}" cy="{y:.2}" r="{radius:.2}" fill="{color}"/>"#)?;
        }
    }
    super::svg::strip(out, &legend().pieces(view))?;
    writeln!(out, "</svg>")
}
