//! Vector pictures.
//!
//! Lines and triangles of one color are one path, in hundredths of pixels from corner to corner: most numbers have two or three
//! digits then, which makes files of a million points a quarter as long as with a path each.

use std::io::{self, Write};

use delone::Triangulation;

use super::Look;
use super::color::{CONSTRAINT, DISK, EDGE, FAINT, HULL, LINK, POINT, Rgb};
use super::legend::{Anchor, Piece};
use super::palette::{HATCH_STEP, HATCH_WIDTH, hatch_color, hatching, region_color};
use super::relief::{Paint, area};
use super::view::View;
use crate::{Mesh, Shape};

/// Parts of a pixel that are told apart.
const PARTS: f64 = 100.0;
/// Corners further away are drawn as if they were here: so that differences are numbers.
const FAR_PARTS: f64 = 1e9;
/// The lines around areas that close the seams between them, in pixels.
pub(super) const SEAM_WIDTH: f64 = 0.6;
/// Shades of a ramp, and of light from 0 to 1, that are told apart.
pub(super) const RAMP_STEPS: f64 = 96.0;
const LIGHT_STEPS: f64 = 24.0;

pub(super) fn write(
    out: &mut dyn Write,
    mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>,
    look: &Look<'_>,
) -> io::Result<()> {
    let &Look { view, layers, options, paint, legend } = look;
    let d = mesh.triangulation;
    let pieces = legend.pieces(view);
    open(out, view)?;
    if layers.fill {
        fill(out, mesh, view, paint)?;
    }
    let vertices = || d.vertices().map(|v| (mesh.point(v), v.index()));
    if let Some(radius) = options.disks {
        writeln!(out, r#"<g fill="{}" fill-opacity="0.7">"#, hex(DISK))?;
        circles(out, view, vertices(), view.length(radius))?;
    }
    if !options.faint.is_empty() {
        segments(out, view, options.faint.iter().copied(), FAINT, layers.line_width())?;
    }
    if options.outside {
        let outside = mesh.edges_left_out().map(|ends| ends.map(|v| mesh.point(v)));
        segments(out, view, outside, FAINT, layers.line_width())?;
    }
    if layers.edges {
        let edges = mesh.edges().map(|(ends, _)| ends.map(|v| mesh.point(v)));
        segments(out, view, edges, EDGE, layers.line_width())?;
    }
    if !options.links.is_empty() {
        segments(out, view, options.links.iter().copied(), LINK, 2.0 * layers.line_width())?;
    }
    let border = mesh.edges().filter(|edge| edge.1);
    let sides = border.map(|(ends, _)| ends.map(|v| mesh.point(v)));
    segments(out, view, sides, HULL, 1.5 * layers.line_width())?;
    if mesh.constraints.is_some() {
        let constraints = mesh.constraint_edges().into_iter().map(|ends| ends.map(|v| mesh.point(v)));
        writeln!(out, r#"<g stroke-linecap="round">"#)?;
        segments(out, view, constraints, CONSTRAINT, layers.constraint_width())?;
        writeln!(out, "</g>")?;
    }
    if layers.points || d.vertex_count() < 3 {
        writeln!(out, r#"<g fill="{}">"#, hex(POINT))?;
        circles(out, view, vertices(), [layers.point_radius(); 2])?;
    }
    strip(out, &pieces)?;
    writeln!(out, "</svg>")
}

/// The beginning of a group whose coordinates are parts of pixels, with lines of a width in pixels.
pub(super) fn open_parts(out: &mut dyn Write, width: f64) -> io::Result<()> {
    let (scale, width) = (1.0 / PARTS, width * PARTS);
    write!(out, r#"<g transform="scale({scale})" stroke-width="{width:.0}" stroke-linejoin="round""#)
}

/// The triangles, those of one color together.
fn fill(
    out: &mut dyn Write,
    mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>,
    view: &View,
    paint: &Paint,
) -> io::Result<()> {
    let look = |(i, triangle): (usize, [usize; 3])| {
        let values = paint.corners(i, triangle, area(triangle.map(|i| mesh.points[i])));
        let [value, light] = [0, 1].map(|k| values.iter().map(|value| value[k]).sum::<f64>() / 3.0);
        match paint.region(value) {
            Some(number) => [number as u32, 0],
            None => [(value * RAMP_STEPS).round() as u32, (light * LIGHT_STEPS).round() as u32],
        }
    };
    let triangles: Vec<[usize; 3]> = mesh.triangles().collect();
    let mut looks: Vec<([u32; 2], usize)> =
        triangles.iter().copied().enumerate().map(|(i, triangle)| (look((i, triangle)), i)).collect();
    looks.sort_unstable();
    open_parts(out, SEAM_WIDTH)?;
    writeln!(out, ">")?;
    for alike in looks.chunk_by(|a, b| a.0 == b.0) {
        let [value, light] = alike[0].0.map(f64::from);
        let (color, fill) = if let Some(number) = paint.region(value) {
            (hex(region_color(number)), pattern(out, number, PARTS)?)
        } else {
            let color = hex(paint.color([value / RAMP_STEPS, light / LIGHT_STEPS]));
            (color.clone(), color)
        };
        write!(out, r#"<path fill="{fill}" stroke="{color}" d=""#)?;
        let mut pen = Pen::default();
        for &(_, i) in alike {
            pen.ring(out, triangles[i].map(|i| view.place(mesh.points[i])).into_iter())?;
        }
        writeln!(out, r#""/>"#)?;
    }
    writeln!(out, "</g>")
}

/// The filling of a region, in units of so many a pixel: a color, or a pattern that is defined first.
fn pattern(out: &mut dyn Write, number: usize, unit: f64) -> io::Result<String> {
    let lines = hatching(number);
    if lines == [false; 2] {
        return Ok(hex(region_color(number)));
    }
    let name = format!("region-{number}-{unit}");
    let (step, width) = (f64::from(HATCH_STEP) * unit, f64::from(HATCH_WIDTH) * unit / 2f64.sqrt());
    let (half, more) = (step / 2.0, step * 1.5);
    writeln!(
        out,
        r#"<pattern id="{name}" width="{step}" height="{step}" patternUnits="userSpaceOnUse"><rect width="{step}" height="{step}" fill="{}"/>"#,
        hex(region_color(number))
    )?;
    let color = hex(hatch_color(number));
    write!(out, r#"<path stroke="{color}" stroke-width="{width}" d=""#)?;
    if lines[0] {
        write!(
            out,
            "M-{half} {half}L{half}-{half}M-{half} {more}L{more}-{half}M{half} {more}L{more} {half}"
        )?;
    }
    if lines[1] {
        write!(
            out,
            "M{half}-{half}L{more} {half}M-{half}-{half}L{more} {more}M-{half} {half}L{half} {more}"
        )?;
    }
    writeln!(out, r#""/></pattern>"#)?;
    Ok(format!("url(#{name})"))
}

/// Writes paths as steps from where it is.
#[derive(Default)]
pub(super) struct Pen {
    at: [i64; 2],
}

impl Pen {
    /// A step in the shortest form: a sign separates as well as a space.
    fn step(&mut self, out: &mut dyn Write, to: [f64; 2], is_first: bool) -> io::Result<()> {
        let to = to.map(|x| (x * PARTS).clamp(-FAR_PARTS, FAR_PARTS).round() as i64);
        let [x, y] = [0, 1].map(|k| to[k] - self.at[k]);
        self.at = to;
        let gap = |n: i64, is_needed: bool| if n < 0 || !is_needed { "" } else { " " };
        write!(out, "{}{x}{}{y}", gap(x, !is_first), gap(y, true))
    }

    /// A line through some positions.
    pub(super) fn line(
        &mut self,
        out: &mut dyn Write,
        positions: impl Iterator<Item = [f64; 2]>,
    ) -> io::Result<()> {
        for (i, position) in positions.enumerate() {
            if i == 0 {
                write!(out, "m")?;
            }
            self.step(out, position, i == 0)?;
        }
        Ok(())
    }

    /// A closed line.
    pub(super) fn ring(
        &mut self,
        out: &mut dyn Write,
        mut positions: impl Iterator<Item = [f64; 2]>,
    ) -> io::Result<()> {
        let Some(first) = positions.next() else { return Ok(()) };
        self.line(out, std::iter::once(first))?;
        let start = self.at;
        positions.try_for_each(|position| self.step(out, position, false))?;
        self.at = start;
        write!(out, "z")
    }
}

/// Lines of one color.
fn segments(
    out: &mut dyn Write,
    view: &View,
    lines: impl Iterator<Item = [[f64; 2]; 2]>,
    color: Rgb,
    width: f64,
) -> io::Result<()> {
    let (color, scale) = (hex(color), 1.0 / PARTS);
    write!(
        out,
        r#"<path fill="none" stroke="{color}" stroke-width="{:.0}" transform="scale({scale})" d=""#,
        width * PARTS
    )?;
    let mut pen = Pen::default();
    for line in lines {
        pen.line(out, line.map(|p| view.place(p)).into_iter())?;
    }
    writeln!(out, r#""/>"#)
}

/// Circles or ellipses that tell the index of their point, and the end of their group.
fn circles(
    out: &mut dyn Write,
    view: &View,
    points: impl Iterator<Item = ([f64; 2], usize)>,
    [across, down]: [f64; 2],
) -> io::Result<()> {
    for (p, index) in points {
        let [x, y] = view.place(p);
        if across == down {
            write!(out, r#"<circle cx="{x:.2}" cy="{y:.2}" r="{across:.2}">"#)?;
        } else {
            write!(out, r#"<ellipse cx="{x:.2}" cy="{y:.2}" rx="{across:.2}" ry="{down:.2}">"#)?;
        }
        writeln!(out, "<title>{index}</title></{}>", if across == down { "circle" } else { "ellipse" })?;
    }
    writeln!(out, "</g>")
}

/// The start of a picture: white paper.
pub(super) fn open(out: &mut dyn Write, view: &View) -> io::Result<()> {
    let (width, height) = (view.width, view.height);
    writeln!(
        out,
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}">"#
    )?;
    writeln!(out, r#"<rect width="100%" height="100%" fill="white"/>"#)
}

/// The strip below the drawing.
pub(super) fn strip(out: &mut dyn Write, pieces: &[Piece]) -> io::Result<()> {
    for piece in pieces {
        match piece {
            Piece::Rectangle { at, size, color } => rectangle(out, *at, *size, &hex(*color))?,
            Piece::Region { at, size, number } => {
                let fill = pattern(out, *number, 1.0)?;
                rectangle(out, *at, *size, &fill)?;
            }
            Piece::Ramp { at, size, ramp } => {
                let colors = ramp.colors();
                // Pictures in one page share names: equal ones are to mean the same.
                let name: String =
                    colors.iter().map(|&color| hex(color)).collect::<String>().replace('#', "");
                write!(out, r#"<linearGradient id="{name}">"#)?;
                for (k, &color) in colors.iter().enumerate() {
                    let offset = k as f64 / (colors.len() - 1) as f64;
                    write!(out, r#"<stop offset="{offset:.3}" stop-color="{}"/>"#, hex(color))?;
                }
                writeln!(out, "</linearGradient>")?;
                rectangle(out, *at, *size, &format!("url(#{name})"))?;
            }
            Piece::Text { at: [x, y], anchor, text } => {
                let anchor = match anchor {
                    Anchor::Start => "start",
                    Anchor::Middle => "middle",
                    Anchor::End => "end",
                };
                writeln!(
                    out,
                    r#"<text x="{x:.1}" y="{:.1}" font-family="sans-serif" font-size="16" text-anchor="{anchor}">{}</text>"#,
                    y + BASELINE,
                    escaped(text)
                )?;
            }
        }
    }
    Ok(())
}

/// From the upper side of a line of text to what its letters stand on.
const BASELINE: f64 = 16.0;

fn rectangle(out: &mut dyn Write, [x, y]: [f64; 2], [wide, high]: [f64; 2], fill: &str) -> io::Result<()> {
    writeln!(out, r#"<rect x="{x:.1}" y="{y:.1}" width="{wide:.1}" height="{high:.1}" fill="{fill}"/>"#)
}

/// A text as XML has it.
pub(super) fn escaped(text: &str) -> String {
    let text: String = text.chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect();
    text.replace('&', "&amp;").replace('<', "&lt;")
}

pub(super) fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
