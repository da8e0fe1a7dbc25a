//! Pictures of Voronoi cells, colored by size.

use std::io::Write;

use delone::Ring;

use super::color::{DENSITY, Density, EDGE, PAPER, POINT, Rgb};
use super::legend::Legend;
use super::png::Canvas;
use super::raster::Raster;
use super::svg::hex;
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
    let outline = if style.outlines() { hex(EDGE) } else { "none".to_owned() };
    writeln!(
        out,
        r#"<g stroke="{outline}" stroke-width="{:.2}" stroke-linejoin="round" fill-rule="evenodd">"#,
        style.line_width()
    )?;
    for v in diagram.present() {
        let area = diagram.area(v);
        write!(out, r#"<path fill="{}" d=""#, hex(style.color(area)))?;
        for ring in diagram.rings(v) {
            for (i, p) in ring.points().enumerate() {
                let [x, y] = view.place(p);
                write!(out, "{}{x:.2} {y:.2}", if i == 0 { 'M' } else { 'L' })?;
            }
            write!(out, "Z")?;
        }
        writeln!(out, r#""><title>{}</title></path>"#, diagram.title(v))?;
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
