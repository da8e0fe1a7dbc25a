//! Pixel pictures.

use std::io::Write;

use delone::Triangulation;
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};
use tiny_skia::{
    Color, LineCap, LineJoin, Paint as Brush, PathBuilder, Pixmap, PremultipliedColorU8, Rect, Stroke,
    Transform,
};

use super::color::{CONSTRAINT, DISK, EDGE, FAINT, HULL, INK, LINK, PAPER, POINT, Ramp, Rgb};
use super::raster::Raster;
use super::relief::{Paint, area};
use super::view::View;
use super::{Layers, Options};
use crate::{Error, Mesh, Shape};

/// Draws a triangulation.
pub(super) fn draw(
    mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>,
    view: &View,
    layers: Layers,
    options: &Options,
) -> Result<Canvas, Error> {
    let d = mesh.triangulation;
    let paint = Paint::of(mesh, options.angles);
    let mut raster = Raster::new(view.width, view.height, PAPER);
    if layers.fill {
        fill(&mut raster, mesh, view, &paint);
    }
    let mut canvas = Canvas::from(&raster)?;
    drop(raster);
    let vertices = || d.vertices().map(|v| view.place(mesh.point(v)));
    if let Some(radius) = options.disks {
        canvas.dots(vertices(), view.length(radius), DISK, 180);
    }
    let faint = options.faint.iter().map(|line| line.map(|p| view.place(p)));
    canvas.lines(faint, FAINT, 255, layers.line_width());
    if options.outside {
        let outside = mesh.edges_left_out().map(|ends| ends.map(|v| view.place(mesh.point(v))));
        canvas.lines(outside, FAINT, 255, layers.line_width());
    }
    if layers.edges {
        let alpha = if mesh.heights.is_some() { 90 } else { 255 };
        canvas.edges(mesh, view, layers.line_width(), alpha);
    }
    let links = options.links.iter().map(|link| link.map(|p| view.place(p)));
    canvas.lines(links, LINK, 255, 2.0 * layers.line_width());
    canvas.border(mesh, view, layers.line_width() * 1.5);
    let constraints = mesh.constraint_edges().into_iter().map(|ends| ends.map(|v| view.place(mesh.point(v))));
    canvas.lines(constraints, CONSTRAINT, 255, layers.constraint_width());
    if layers.points || d.vertex_count() < 3 {
        canvas.dots(vertices(), layers.point_radius(), POINT, 255);
    }
    canvas.strip(view, &paint, layers.fill);
    Ok(canvas)
}

fn fill(raster: &mut Raster, mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>, view: &View, paint: &Paint) {
    for (i, triangle) in mesh.triangles().enumerate() {
        let points = triangle.map(|i| mesh.points[i]);
        let corners = points.map(|p| view.place(p));
        let values = paint.corners(i, triangle, area(points));
        raster.dot(corners[0], paint.color(values[0]));
        raster.triangle(corners, values, |value| paint.color(value));
    }
}

/// The picture in tiny-skia's hands.
pub(super) struct Canvas(Pixmap);

fn brush([r, g, b]: Rgb, alpha: u8) -> Brush<'static> {
    let mut brush = Brush { anti_alias: true, ..Brush::default() };
    brush.set_color(Color::from_rgba8(r, g, b, alpha));
    brush
}

impl Canvas {
    pub(super) fn from(raster: &Raster) -> Result<Self, Error> {
        let mut pixmap = Pixmap::new(raster.width as u32, raster.height as u32)
            .ok_or_else(|| Error::content("the picture is too large"))?;
        for (to, &[r, g, b]) in pixmap.pixels_mut().iter_mut().zip(&raster.pixels) {
            if let Some(opaque) = PremultipliedColorU8::from_rgba(r, g, b, 255) {
                *to = opaque;
            }
        }
        Ok(Self(pixmap))
    }

    /// Strokes a set of lines at once.
    pub(super) fn lines(
        &mut self,
        lines: impl Iterator<Item = [[f64; 2]; 2]>,
        color: Rgb,
        alpha: u8,
        width: f64,
    ) {
        let stroke = Stroke {
            width: width as f32,
            line_cap: LineCap::Round,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        let mut path = PathBuilder::new();
        for [[ax, ay], [bx, by]] in lines {
            path.move_to(ax as f32, ay as f32);
            path.line_to(bx as f32, by as f32);
            // Overlaps within one path do not add up, but very long paths are slow.
            if path.len() > 2000 {
                let part = std::mem::take(&mut path);
                self.stroke(part, color, alpha, &stroke);
            }
        }
        self.stroke(path, color, alpha, &stroke);
    }

    fn stroke(&mut self, path: PathBuilder, color: Rgb, alpha: u8, stroke: &Stroke) {
        if let Some(path) = path.finish() {
            self.0.stroke_path(&path, &brush(color, alpha), stroke, Transform::identity(), None);
        }
    }

    fn edges(
        &mut self,
        mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>,
        view: &View,
        width: f64,
        alpha: u8,
    ) {
        let ends = mesh.edges().map(|(ends, _)| ends.map(|v| view.place(mesh.point(v))));
        self.lines(ends, EDGE, alpha, width);
    }

    fn border(&mut self, mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>, view: &View, width: f64) {
        let border = mesh.edges().filter(|edge| edge.1);
        let sides = border.map(|(ends, _)| ends.map(|v| view.place(mesh.point(v))));
        self.lines(sides, HULL, 255, width);
    }

    /// A dot at each position.
    pub(super) fn dots(
        &mut self,
        positions: impl Iterator<Item = [f64; 2]>,
        radius: f64,
        color: Rgb,
        alpha: u8,
    ) {
        for [x, y] in positions {
            let mut path = PathBuilder::new();
            path.push_circle(x as f32, y as f32, radius as f32);
            if let Some(path) = path.finish() {
                self.0.fill_path(
                    &path,
                    &brush(color, alpha),
                    tiny_skia::FillRule::Winding,
                    Transform::identity(),
                    None,
                );
            }
        }
    }

    /// Red, green and blue of all pixels, row by row.
    pub(super) fn colors(&self) -> Vec<u8> {
        self.0.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect()
    }

    /// Writes the picture.
    pub(super) fn encode(&self, out: &mut dyn Write) -> Result<(), Error> {
        let png = self.0.encode_png().map_err(|error| Error::content(format!("PNG: {error}")))?;
        out.write_all(&png)?;
        Ok(())
    }

    /// Fills closed rings; where one is inside of another there is a hole.
    pub(super) fn fill(&mut self, rings: &[Vec<[f64; 2]>], color: Rgb) {
        let mut path = PathBuilder::new();
        for ring in rings {
            for (i, &[x, y]) in ring.iter().enumerate() {
                if i == 0 { path.move_to(x as f32, y as f32) } else { path.line_to(x as f32, y as f32) }
            }
            path.close();
        }
        if let Some(path) = path.finish() {
            // Without smoothing, so that nothing shines through between neighbors.
            let mut brush = brush(color, 255);
            brush.anti_alias = false;
            let rule = tiny_skia::FillRule::EvenOdd;
            self.0.fill_path(&path, &brush, rule, Transform::identity(), None);
        }
    }

    /// Legend and scale below the drawing.
    fn strip(&mut self, view: &View, paint: &Paint, filled: bool) {
        if let Some(ramp) = paint.ramp().filter(|_| filled) {
            let (low, high) = match paint {
                Paint::Relief(relief) => (Short(relief.low).to_string(), Short(relief.high).to_string()),
                Paint::Angles(_) => ("0".to_owned(), "60 degrees".to_owned()),
                _ => ("sparse".to_owned(), "dense".to_owned()),
            };
            self.legend(view, ramp, &low, &high);
        }
        self.scale(view);
    }

    /// The legend of the colors.
    pub(super) fn legend(&mut self, view: &View, ramp: &Ramp, low: &str, high: &str) {
        let Some(top) = view.strip() else { return };
        let (baseline, margin) = (top + 14.0, 24.0);
        let bar = (f64::from(view.width) / 4.0).min(360.0);
        for i in 0..bar as u32 {
            let color = ramp.at(f64::from(i) / bar);
            self.rectangle([margin + f64::from(i), baseline], [1.0, 12.0], color);
        }
        self.text([margin, baseline + 16.0], low);
        self.text([margin + bar - text_width(high), baseline + 16.0], high);
    }

    /// How long things are.
    pub(super) fn scale(&mut self, view: &View) {
        let Some(top) = view.strip() else { return };
        let (baseline, margin, width) = (top + 14.0, 24.0, f64::from(view.width));
        if let Some((length, pixels)) = view.scale_bar() {
            let left = width - margin - pixels;
            self.rectangle([left, baseline + 4.0], [pixels, 3.0], INK);
            for x in [left, left + pixels - 2.0] {
                self.rectangle([x, baseline], [2.0, 11.0], INK);
            }
            let label = format!("{}", Short(length));
            self.text([left + (pixels - text_width(&label)) / 2.0, baseline + 16.0], &label);
        }
    }

    fn rectangle(&mut self, [x, y]: [f64; 2], [width, height]: [f64; 2], color: Rgb) {
        if let Some(rectangle) = Rect::from_xywh(x as f32, y as f32, width as f32, height as f32) {
            self.0.fill_rect(rectangle, &brush(color, 255), Transform::identity(), None);
        }
    }

    pub(super) fn text(&mut self, [x, y]: [f64; 2], text: &str) {
        let (width, height) = (self.0.width() as usize, self.0.height() as usize);
        let mut left = x.max(0.0) as usize;
        for character in text.chars() {
            let Some(glyph) = get_raster(character, FontWeight::Regular, RasterHeight::Size20) else {
                continue;
            };
            for (row, line) in glyph.rows().enumerate() {
                for (column, &coverage) in line.iter().enumerate() {
                    let (px, py) = (left + column, y as usize + row);
                    if coverage == 0 || px >= width || py >= height {
                        continue;
                    }
                    let mixed = super::color::mix(PAPER, INK, f64::from(coverage) / 255.0);
                    if let Some(pixel) = PremultipliedColorU8::from_rgba(mixed[0], mixed[1], mixed[2], 255) {
                        self.0.pixels_mut()[py * width + px] = pixel;
                    }
                }
            }
            left += glyph.width();
        }
    }
}

fn text_width(text: &str) -> f64 {
    (text.len() * get_raster_width(FontWeight::Regular, RasterHeight::Size20)) as f64
}

/// A number for a label: few digits, an exponent only where it is needed.
struct Short(f64);

impl std::fmt::Display for Short {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let magnitude = self.0.abs();
        if magnitude != 0.0 && !(1e-3..1e6).contains(&magnitude) {
            return write!(
                f,
                "{:e}",
                (self.0 / 10f64.powf(magnitude.log10().floor())).round()
                    * 10f64.powf(magnitude.log10().floor())
            );
        }
        let digits = if magnitude >= 100.0 {
            0
        } else if magnitude >= 1.0 {
            1
        } else {
            4
        };
        let text = format!("{:.digits$}", self.0);
        f.write_str(if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text })
    }
}
