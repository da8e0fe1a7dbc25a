//! Pixel pictures.

use std::io::Write;

use delone::Triangulation;
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};
use tiny_skia::{
    Color, LineCap, LineJoin, Paint as Brush, PathBuilder, Pixmap, PremultipliedColorU8, Rect, Stroke,
    Transform,
};

use super::Look;
use super::color::{CONSTRAINT, DISK, EDGE, FAINT, HULL, INK, LINK, PAPER, POINT, Rgb};
use super::legend::{Anchor, Piece};
use super::palette::region_pixel;
use super::raster::Raster;
use super::relief::{Paint, area};
use super::view::View;
use crate::{Error, Mesh, Shape};

/// Draws a triangulation.
pub(super) fn draw(
    mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>,
    look: &Look<'_>,
) -> Result<Canvas, Error> {
    let &Look { view, layers, options, paint, legend } = look;
    let d = mesh.triangulation;
    let mut raster = Raster::new(view.width, view.height, PAPER);
    if layers.fill {
        fill(&mut raster, mesh, view, paint);
    }
    let mut canvas = Canvas::from(&raster)?;
    drop(raster);
    let vertices = || d.vertices().map(|v| view.place(mesh.point(v)));
    if let Some(radius) = options.disks {
        canvas.ovals(vertices(), view.length(radius), DISK, 180);
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
    canvas.strip(&legend.pieces(view));
    Ok(canvas)
}

fn fill(raster: &mut Raster, mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>, view: &View, paint: &Paint) {
    for (i, triangle) in mesh.triangles().enumerate() {
        let points = triangle.map(|i| mesh.points[i]);
        let corners = points.map(|p| view.place(p));
        let values = paint.corners(i, triangle, area(points));
        raster.dot(corners[0], paint.color(values[0]));
        raster.triangle(corners, values, |value, pixel| paint.pixel(value, pixel));
    }
}

/// How letters look.
const WEIGHT: FontWeight = FontWeight::Regular;
const HEIGHT: RasterHeight = RasterHeight::Size20;

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
        self.ovals(positions, [radius; 2], color, alpha);
    }

    /// An ellipse around each position.
    fn ovals(
        &mut self,
        positions: impl Iterator<Item = [f64; 2]>,
        [across, down]: [f64; 2],
        color: Rgb,
        alpha: u8,
    ) {
        for [x, y] in positions {
            let mut path = PathBuilder::new();
            if across == down {
                path.push_circle(x as f32, y as f32, across as f32);
            } else if let Some(around) = Rect::from_ltrb(
                (x - across) as f32,
                (y - down) as f32,
                (x + across) as f32,
                (y + down) as f32,
            ) {
                path.push_oval(around);
            }
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

    /// The strip below the drawing.
    pub(super) fn strip(&mut self, pieces: &[Piece]) {
        for piece in pieces {
            match piece {
                Piece::Rectangle { at, size, color } => self.rectangle(*at, *size, *color),
                Piece::Ramp { at, size, ramp } => {
                    for i in 0..size[0] as u32 {
                        let color = ramp.at(f64::from(i) / size[0]);
                        self.rectangle([at[0] + f64::from(i), at[1]], [1.0, size[1]], color);
                    }
                }
                Piece::Region { at, size, number } => {
                    let [left, top] = at.map(|x| x as usize);
                    for y in top..top + size[1] as usize {
                        for x in left..left + size[0] as usize {
                            self.pixel([x, y], region_pixel(*number, [x, y]));
                        }
                    }
                }
                Piece::Text { at, anchor, text } => {
                    let back = match anchor {
                        Anchor::Start => 0.0,
                        Anchor::Middle => text_width(text) / 2.0,
                        Anchor::End => text_width(text),
                    };
                    self.text([at[0] - back, at[1]], text);
                }
            }
        }
    }

    /// Colors a pixel, if it is there.
    fn pixel(&mut self, [x, y]: [usize; 2], [r, g, b]: Rgb) {
        let (width, height) = (self.0.width() as usize, self.0.height() as usize);
        if x < width
            && y < height
            && let Some(color) = PremultipliedColorU8::from_rgba(r, g, b, 255)
        {
            self.0.pixels_mut()[y * width + x] = color;
        }
    }

    fn rectangle(&mut self, [x, y]: [f64; 2], [width, height]: [f64; 2], color: Rgb) {
        if let Some(rectangle) = Rect::from_xywh(x as f32, y as f32, width as f32, height as f32) {
            self.0.fill_rect(rectangle, &brush(color, 255), Transform::identity(), None);
        }
    }

    /// A line of text.
    pub(super) fn text(&mut self, [x, y]: [f64; 2], text: &str) {
        let mut left = x.max(0.0) as usize;
        for character in text.chars() {
            // Nothing is left out in silence.
            let known = [character, '?'].into_iter().find_map(|c| get_raster(c, WEIGHT, HEIGHT));
            let Some(glyph) = known else { continue };
            for (row, line) in glyph.rows().enumerate() {
                for (column, &coverage) in line.iter().enumerate().filter(|(_, coverage)| **coverage > 0) {
                    let mixed = super::color::mix(PAPER, INK, f64::from(coverage) / 255.0);
                    self.pixel([left + column, y as usize + row], mixed);
                }
            }
            left += glyph.width();
        }
    }
}

/// The pixels that a text takes.
pub(super) fn text_width(text: &str) -> f64 {
    (text.chars().count() * get_raster_width(WEIGHT, HEIGHT)) as f64
}
