//! Vector pictures.

use std::io::{self, Write};

use delone::Triangulation;

use super::color::{CONSTRAINT, DISK, EDGE, FAINT, HULL, LINK, POINT, Rgb};
use super::relief::{Paint, area};
use super::view::View;
use super::{Layers, Options};
use crate::{Mesh, Shape};

pub(super) fn write(
    out: &mut dyn Write,
    mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>,
    view: &View,
    layers: Layers,
    options: &Options,
) -> io::Result<()> {
    let d = mesh.triangulation;
    open(out, view)?;
    if layers.fill {
        let paint = Paint::of(mesh, options.angles);
        writeln!(out, r#"<g stroke-width="0.6" stroke-linejoin="round">"#)?;
        for (i, triangle) in mesh.triangles().enumerate() {
            let corners = triangle.map(|i| mesh.points[i]);
            let values = paint.corners(i, triangle, area(corners));
            let mean = [0, 1].map(|k| values.iter().map(|value| value[k]).sum::<f64>() / 3.0);
            let color = hex(paint.color(mean));
            let [a, b, c] = corners.map(|p| place(view, p));
            writeln!(out, r#"<path fill="{color}" stroke="{color}" d="M{a}L{b}L{c}Z"/>"#)?;
        }
        writeln!(out, "</g>")?;
    }
    if let Some(radius) = options.disks {
        writeln!(out, r#"<g fill="{}" fill-opacity="0.7">"#, hex(DISK))?;
        circles(out, view, d.vertices().map(|v| (mesh.point(v), v.index())), view.length(radius))?;
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
        circles(out, view, d.vertices().map(|v| (mesh.point(v), v.index())), layers.point_radius())?;
    }
    scale(out, view)?;
    writeln!(out, "</svg>")
}

/// Lines of one color.
fn segments(
    out: &mut dyn Write,
    view: &View,
    lines: impl Iterator<Item = [[f64; 2]; 2]>,
    color: Rgb,
    width: f64,
) -> io::Result<()> {
    write!(out, r#"<path fill="none" stroke="{}" stroke-width="{width:.2}" d=""#, hex(color))?;
    for [a, b] in lines {
        write!(out, "M{}L{}", place(view, a), place(view, b))?;
    }
    writeln!(out, r#""/>"#)
}

/// Circles that tell the index of their point, and the end of their group.
fn circles(
    out: &mut dyn Write,
    view: &View,
    points: impl Iterator<Item = ([f64; 2], usize)>,
    radius: f64,
) -> io::Result<()> {
    for (p, index) in points {
        let [x, y] = view.place(p);
        writeln!(out, r#"<circle cx="{x:.2}" cy="{y:.2}" r="{radius:.2}"><title>{index}</title></circle>"#)?;
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

/// How long things are, below the drawing.
pub(super) fn scale(out: &mut dyn Write, view: &View) -> io::Result<()> {
    if let (Some(top), Some((length, pixels))) = (view.strip(), view.scale_bar()) {
        let right = f64::from(view.width) - 24.0;
        let (left, y) = (right - pixels, top + 14.0);
        writeln!(
            out,
            r#"<path fill="none" stroke="black" stroke-width="2" d="M{left:.1} {y:.1}v10m0-5H{right:.1}m0-5v10"/>"#
        )?;
        writeln!(
            out,
            r#"<text x="{:.1}" y="{:.1}" font-family="sans-serif" font-size="16" text-anchor="middle">{length}</text>"#,
            f64::midpoint(left, right),
            y + 28.0
        )?;
    }
    Ok(())
}

fn place(view: &View, p: [f64; 2]) -> String {
    let [x, y] = view.place(p);
    format!("{x:.2} {y:.2}")
}

pub(super) fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
