//! Pictures of contours: bands filled by their heights, lines above them.

use std::io::Write;

use delone::surface::{ContourBand, ContourLine};

use super::color::{EDGE, HEIGHT, INK, PAPER, Rgb};
use super::legend::Legend;
use super::png::Canvas;
use super::raster::Raster;
use super::svg::{hex, open, strip};
use super::view::{Frame, View};
use crate::{ContourMap, Error, Format};

/// The width of lines in pixels, and of each fifth level.
const WIDTHS: [f64; 2] = [0.8, 1.8];

/// Draws contours.
pub(crate) fn write_contours(
    out: &mut dyn Write,
    format: Format,
    map: &ContourMap<'_>,
    size: u32,
) -> Result<(), Error> {
    super::check_size(size)?;
    let view = View::around(map.points(), &Frame::new(size, map.crs));
    match format {
        Format::Svg => Ok(svg(out, map, &view)?),
        _ => png(out, map, &view),
    }
}

/// The color of a band: that of its middle, or of its only bound.
fn color(band: &ContourBand, [low, high]: [f64; 2]) -> Rgb {
    let [lower, upper] = [band.lower.max(low), band.upper.min(high)];
    HEIGHT.at((lower / 2.0 + upper / 2.0 - low) / (high - low))
}

/// The lines with their widths: each fifth level is wider.
fn lines<'a>(map: &ContourMap<'a>) -> Vec<(&'a ContourLine, f64)> {
    let mut levels: Vec<f64> = map.lines.iter().map(|line| line.level).collect();
    levels.dedup();
    let number = |level: f64| levels.partition_point(|&other| other < level);
    map.lines.iter().map(|line| (line, WIDTHS[usize::from(number(line.level).is_multiple_of(5))])).collect()
}

/// Lines alone have one color.
fn legend(map: &ContourMap<'_>) -> Legend {
    if map.bands.is_empty() { Legend::None } else { Legend::heights(&HEIGHT, map.range(), map.crs) }
}

fn ink(map: &ContourMap<'_>) -> Rgb {
    if map.bands.is_empty() { INK } else { EDGE }
}

fn sides(line: &ContourLine) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
    let n = line.points.len();
    let count = if line.is_closed { n } else { n.saturating_sub(1) };
    (0..count).map(move |i| [line.points[i], line.points[(i + 1) % n]])
}

fn png(out: &mut dyn Write, map: &ContourMap<'_>, view: &View) -> Result<(), Error> {
    let mut canvas = Canvas::from(&Raster::new(view.width, view.height, PAPER))?;
    let range = map.range();
    for band in map.bands {
        for polygon in &band.polygons {
            let rings: Vec<Vec<[f64; 2]>> =
                polygon.iter().map(|ring| ring.iter().map(|&p| view.place(p)).collect()).collect();
            canvas.fill(&rings, color(band, range));
        }
    }
    for (line, width) in lines(map) {
        canvas.lines(sides(line).map(|side| side.map(|p| view.place(p))), ink(map), 255, width);
    }
    canvas.strip(&legend(map).pieces(view));
    canvas.encode(out)
}

fn svg(out: &mut dyn Write, map: &ContourMap<'_>, view: &View) -> std::io::Result<()> {
    open(out, view)?;
    let path = |out: &mut dyn Write, points: &[[f64; 2]], is_closed: bool| {
        for (i, &p) in points.iter().enumerate() {
            let [x, y] = view.place(p);
            write!(out, "{}{x:.2} {y:.2}", if i == 0 { 'M' } else { 'L' })?;
        }
        write!(out, "{}", if is_closed { "Z" } else { "" })
    };
    let range = map.range();
    for band in map.bands {
        write!(out, r#"<path fill-rule="evenodd" fill="{}" d=""#, hex(color(band, range)))?;
        band.polygons.iter().flatten().try_for_each(|ring| path(out, ring, true))?;
        writeln!(out, r#""><title>{:?} to {:?}</title></path>"#, band.lower, band.upper)?;
    }
    writeln!(out, r#"<g fill="none" stroke="{}" stroke-linejoin="round">"#, hex(ink(map)))?;
    for (line, width) in lines(map) {
        write!(out, r#"<path stroke-width="{width}" d=""#)?;
        path(out, &line.points, line.is_closed)?;
        writeln!(out, r#""><title>{:?}</title></path>"#, line.level)?;
    }
    writeln!(out, "</g>")?;
    strip(out, &legend(map).pieces(view))?;
    writeln!(out, "</svg>")
}
