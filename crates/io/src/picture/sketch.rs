//! Sketches: areas, lines, dots and a caption, for pictures of what an algorithm does.

use std::io::Write;

use super::color::{EDGE, INK, LINK, POINT, Rgb};
use super::legend::Legend;
use super::palette::region_color;
use super::png::Canvas;
use super::raster::Raster;
use super::svg::{Pen, escaped, hex, open, open_parts, strip};
use super::view::{Frame, View};
use super::{check_size, color};
use crate::{Crs, Error, Format};

/// The role of something in a sketch, which decides its color.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Tone {
    /// There, and of no interest now.
    Faint,
    /// There.
    Plain,
    /// Looked at.
    Seen,
    /// About to go.
    Old,
    /// Just made.
    New,
    /// The goal of the sketch.
    Goal,
}

impl Tone {
    /// Told apart by everyone (Okabe and Ito's palette).
    pub(super) fn color(self) -> Rgb {
        match self {
            Self::Faint => [205, 214, 219],
            Self::Plain => EDGE,
            Self::Seen => [240, 228, 66],
            Self::Old => [230, 159, 0],
            Self::New => [86, 180, 233],
            Self::Goal => [213, 94, 0],
        }
    }
}

/// Something drawn.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Mark {
    /// A filled polygon.
    Area(Vec<[f64; 2]>, Tone),
    /// A polygon in a color of its own, by a number.
    Patch(Vec<[f64; 2]>, usize),
    /// A segment.
    Line([[f64; 2]; 2], Tone),
    /// A point.
    Dot([f64; 2], Tone),
    /// A point in a color of its own, by a number.
    Spot([f64; 2], usize),
    /// A circle around a point.
    Ring([f64; 2], f64, Tone),
}

impl Mark {
    /// Whether both are one path in a vector picture.
    fn is_drawn_with(&self, next: &Self) -> bool {
        match (self, next) {
            (Self::Patch(_, k), Self::Patch(_, l)) => k == l,
            (Self::Line(_, tone), Self::Line(_, other)) => tone == other,
            _ => false,
        }
    }
}

/// The drawn things, from the bottom to the top.
#[derive(Clone, Debug, Default)]
pub struct Sketch {
    /// The marks.
    pub marks: Vec<Mark>,
    /// A line below; without it there is a scale bar.
    pub caption: String,
    /// The system of coordinates, in which longitude and latitude are drawn in the shape that they have on the ground.
    pub crs: Option<Crs>,
}

/// Widths in pixels, of a picture 600 pixels wide.
const LINE: f64 = 1.2;
const DOT: f64 = 3.0;

/// The color of a dot that has that of an area.
pub(super) fn dark(color: Rgb) -> Rgb {
    color::shade(color, 0.6)
}

impl Sketch {
    /// Adds a mark.
    pub fn add(&mut self, mark: Mark) {
        self.marks.push(mark);
    }

    pub(super) fn draw(&self, view: &View) -> Result<Canvas, Error> {
        let mut canvas = Canvas::from(&Raster::new(view.width, view.height, color::PAPER))?;
        let scale = f64::from(view.width.max(view.height)) / 600.0;
        let ring = |corners: &[[f64; 2]]| vec![corners.iter().map(|&p| view.place(p)).collect::<Vec<_>>()];
        for mark in &self.marks {
            match mark {
                Mark::Area(corners, tone) => {
                    canvas.fill(&ring(corners), color::mix(tone.color(), color::PAPER, 0.35));
                }
                Mark::Patch(corners, k) => canvas.fill(&ring(corners), region_color(*k)),
                Mark::Line(ends, tone) => {
                    let width = if *tone == Tone::Goal { 2.0 * LINE } else { LINE };
                    let line = ends.map(|p| view.place(p));
                    canvas.lines(std::iter::once(line), line_color(*tone), 255, width * scale);
                }
                Mark::Dot(p, tone) => {
                    let radius = if *tone == Tone::Goal { 1.6 * DOT } else { DOT };
                    canvas.dots(std::iter::once(view.place(*p)), radius * scale, dot_color(*tone), 255);
                }
                Mark::Spot(p, k) => {
                    canvas.dots(std::iter::once(view.place(*p)), DOT * scale, dark(region_color(*k)), 255);
                }
                Mark::Ring(p, radius, tone) => {
                    let circle = polygon(*p, *radius).map(|p| view.place(p));
                    let sides = (0..circle.len()).map(|k| [circle[k], circle[(k + 1) % circle.len()]]);
                    canvas.lines(sides, line_color(*tone), 255, LINE * scale);
                }
            }
        }
        if self.caption.is_empty() {
            canvas.strip(&Legend::None.pieces(view));
        } else if let Some(top) = view.strip() {
            canvas.text([24.0, top + 14.0], &self.caption);
        }
        Ok(canvas)
    }

    fn svg(&self, out: &mut dyn Write, view: &View) -> std::io::Result<()> {
        open(out, view)?;
        let scale = f64::from(view.width.max(view.height)) / 600.0;
        for alike in self.marks.chunk_by(Mark::is_drawn_with) {
            match &alike[0] {
                Mark::Area(corners, tone) => area(out, view, corners, tone.color(), 0.65)?,
                Mark::Patch(_, k) => {
                    open_parts(out, 0.0)?;
                    write!(out, r#"><path fill="{}" d=""#, hex(region_color(*k)))?;
                    let mut pen = Pen::default();
                    for mark in alike {
                        let Mark::Patch(corners, _) = mark else { continue };
                        pen.ring(out, corners.iter().map(|&p| view.place(p)))?;
                    }
                    writeln!(out, r#""/></g>"#)?;
                }
                Mark::Line(_, tone) => {
                    let width = if *tone == Tone::Goal { 2.0 * LINE } else { LINE } * scale;
                    open_parts(out, width)?;
                    let color = hex(line_color(*tone));
                    write!(out, r#"><path fill="none" stroke="{color}" stroke-linecap="round" d=""#)?;
                    let mut pen = Pen::default();
                    for mark in alike {
                        let Mark::Line(ends, _) = mark else { continue };
                        pen.line(out, ends.iter().map(|&p| view.place(p)))?;
                    }
                    writeln!(out, r#""/></g>"#)?;
                }
                Mark::Dot(p, tone) => {
                    let radius = if *tone == Tone::Goal { 1.6 * DOT } else { DOT } * scale;
                    dot(out, view, *p, radius, dot_color(*tone))?;
                }
                Mark::Spot(p, k) => dot(out, view, *p, DOT * scale, dark(region_color(*k)))?,
                Mark::Ring(p, radius, tone) => {
                    let [x, y] = view.place(*p);
                    let ([r, _], color) = (view.length(*radius), hex(line_color(*tone)));
                    writeln!(
                        out,
                        r#"<circle cx="{x:.2}" cy="{y:.2}" r="{r:.2}" fill="none" stroke="{color}" stroke-width="{:.2}"/>"#,
                        LINE * scale
                    )?;
                }
            }
        }
        if self.caption.is_empty() {
            strip(out, &Legend::None.pieces(view))?;
        } else if let Some(top) = view.strip() {
            writeln!(
                out,
                r#"<text x="24" y="{:.1}" font-family="sans-serif" font-size="18">{}</text>"#,
                top + 30.0,
                escaped(&self.caption)
            )?;
        }
        writeln!(out, "</svg>")
    }
}

/// The corners of a circle that looks round.
fn polygon(center: [f64; 2], radius: f64) -> [[f64; 2]; 64] {
    std::array::from_fn(|k| {
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * k as f64 / 64.0);
        [center[0] + radius * cos, center[1] + radius * sin]
    })
}

fn line_color(tone: Tone) -> Rgb {
    match tone {
        Tone::Seen => LINK,
        other => other.color(),
    }
}

fn dot_color(tone: Tone) -> Rgb {
    match tone {
        Tone::Plain => POINT,
        Tone::Seen => LINK,
        Tone::New => INK,
        other => other.color(),
    }
}

fn area(
    out: &mut dyn Write,
    view: &View,
    corners: &[[f64; 2]],
    color: Rgb,
    opacity: f64,
) -> std::io::Result<()> {
    let path: Vec<String> =
        corners.iter().map(|&p| view.place(p)).map(|[x, y]| format!("{x:.2} {y:.2}")).collect();
    let fill = hex(color);
    writeln!(out, r#"<path fill="{fill}" fill-opacity="{opacity}" d="M{}Z"/>"#, path.join("L"))
}

fn dot(out: &mut dyn Write, view: &View, p: [f64; 2], radius: f64, color: Rgb) -> std::io::Result<()> {
    let [x, y] = view.place(p);
    writeln!(out, r#"<circle cx="{x:.2}" cy="{y:.2}" r="{radius:.2}" fill="{}"/>"#, hex(color))
}

/// Writes a sketch of a window as a picture: SVG or PNG.
///
/// # Errors
/// For a size that no picture can have, and when writing fails.
pub fn write_sketch(
    out: &mut dyn Write,
    format: Format,
    sketch: &Sketch,
    window: [[f64; 2]; 2],
    size: u32,
) -> Result<(), Error> {
    check_size(size)?;
    let view = View::around(window.into_iter(), &Frame::new(size, sketch.crs.as_ref()));
    match format {
        Format::Svg => Ok(sketch.svg(out, &view)?),
        _ => sketch.draw(&view)?.encode(out),
    }
}
