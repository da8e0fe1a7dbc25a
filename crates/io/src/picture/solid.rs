//! Pictures of closed surfaces: seen from far away, lit from above, the far faces painted first.

use std::io::Write;

use super::Options;
use super::color::{PAPER, POINT, Rgb, shade};
use super::legend::Legend;
use super::png::Canvas;
use super::raster::Raster;
use super::svg::hex;
use super::view::{Frame, View};
use crate::{Error, Format, Solid};

/// The color of a face in full light, and of one that a cut has laid open.
const FACE: Rgb = [126, 178, 214];
const INSIDE: Rgb = [240, 196, 128];
/// Light from everywhere, and from the lamp.
const AMBIENT: f64 = 0.35;
const LAMP: f64 = 0.75;

/// Where a solid is seen from, by parallel rays.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// Degrees counter-clockwise from the x axis.
    pub azimuth: f64,
    /// Degrees above the plane of x and y.
    pub elevation: f64,
    /// Draw edges alone, those behind too.
    pub wireframe: bool,
}

impl Default for Camera {
    fn default() -> Self {
        Self { azimuth: -60.0, elevation: 25.0, wireframe: false }
    }
}

/// The axes of a picture: to the right, upwards, and to the viewer.
struct Axes([[f64; 3]; 3]);

impl Axes {
    fn of(camera: &Camera) -> Self {
        let (sin_a, cos_a) = libm::sincos(camera.azimuth.to_radians());
        let (sin_e, cos_e) = libm::sincos(camera.elevation.to_radians());
        Self([
            [-sin_a, cos_a, 0.0],
            [-sin_e * cos_a, -sin_e * sin_a, cos_e],
            [cos_e * cos_a, cos_e * sin_a, sin_e],
        ])
    }

    fn turn(&self, p: [f64; 3]) -> [f64; 3] {
        self.0.map(|axis| (0..3).map(|k| axis[k] * p[k]).sum())
    }
}

/// How to draw.
struct Style {
    /// The width of edges, if they are drawn.
    outline: Option<f64>,
    fill: bool,
    /// Whether lengths are known.
    to_scale: bool,
}

/// A face that is turned to the viewer.
struct Visible {
    /// Its mean depth, towards the viewer.
    depth: f64,
    corners: Vec<[f64; 2]>,
    color: Rgb,
}

/// Draws a closed surface; the points of one without faces.
pub(crate) fn write(
    out: &mut dyn Write,
    format: Format,
    solid: &Solid,
    options: &Options,
) -> Result<(), Error> {
    super::check_size(options.size)?;
    let camera = &options.camera;
    let axes = Axes::of(camera);
    let largest = solid.points.as_flattened().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    // Sums of coordinates must not overflow.
    let half = if largest > f64::MAX / 8.0 { 0.125 } else { 1.0 };
    let turned: Vec<[f64; 3]> = solid.points.iter().map(|p| axes.turn(p.map(|x| x * half))).collect();
    let view = View::around(turned.iter().map(|&[x, y, _]| [x, y]), &Frame::new(options.size, None));
    let mut faces: Vec<Visible> =
        (0..solid.faces.len()).filter_map(|i| Visible::of(solid, i, &turned, &view, camera)).collect();
    faces.sort_by(|f, g| f.depth.total_cmp(&g.depth));
    let room = f64::from(view.width) * f64::from(view.height);
    let spacing = (room / faces.len().max(1) as f64).sqrt();
    let outline = (spacing > 5.0 || camera.wireframe).then(|| (spacing / 40.0).clamp(0.4, 1.4));
    let style = Style { outline, fill: !camera.wireframe, to_scale: half == 1.0 };
    let points = if solid.faces.is_empty() { &turned[..] } else { &[] };
    let dots: Vec<[f64; 2]> = points.iter().map(|&[x, y, _]| view.place([x, y])).collect();
    match format {
        Format::Svg => Ok(svg(out, (&faces, &dots), &view, &style)?),
        _ => png(out, (&faces, &dots), &view, &style),
    }
}

impl Visible {
    fn of(solid: &Solid, i: usize, turned: &[[f64; 3]], view: &View, camera: &Camera) -> Option<Self> {
        let face = &solid.faces[i];
        let corners: Vec<[f64; 2]> = face.iter().map(|&i| view.place([turned[i][0], turned[i][1]])).collect();
        let depth = |i: usize| turned[i][2];
        // Depths in pixels, as positions are; pixels count downwards.
        let pixels = |i: usize| view.place([depth(i), 0.0])[0];
        let mut normal = [0.0; 3];
        let at = |k: usize| [corners[k][0], -corners[k][1], pixels(face[k])];
        for k in 2..face.len() {
            let [o, p, q] = [at(0), at(k - 1), at(k)];
            let (u, v) = ([0, 1, 2].map(|i| p[i] - o[i]), [0, 1, 2].map(|i| q[i] - o[i]));
            for i in 0..3 {
                normal[i] += u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
            }
        }
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        // From the upper left, behind the viewer.
        let lamp = [-0.42, 0.56, 0.714];
        let lit = (0..3).map(|k| lamp[k] * normal[k]).sum::<f64>() / length;
        let mean = face.iter().map(|&i| depth(i) / face.len() as f64).sum();
        let paint = if solid.laid_open.get(i) == Some(&true) { INSIDE } else { FACE };
        let color = shade(paint, AMBIENT + LAMP * lit.max(0.0));
        (normal[2] > 0.0 || camera.wireframe).then_some(Self { depth: mean, corners, color })
    }

    fn outline(&self) -> Rgb {
        shade(self.color, 0.65)
    }
}

/// The radius of a dot, in pixels.
const DOT: f64 = 3.0;

/// The drawn faces and dots.
type Drawn<'a> = (&'a [Visible], &'a [[f64; 2]]);

fn png(out: &mut dyn Write, (faces, dots): Drawn, view: &View, style: &Style) -> Result<(), Error> {
    let mut raster = Raster::new(view.width, view.height, PAPER);
    if style.outline.is_none() {
        for face in faces {
            raster.dot(face.corners[0], face.color);
            for side in face.corners[1..].windows(2) {
                raster.triangle([face.corners[0], side[0], side[1]], [[0.0; 2]; 3], |_, _| face.color);
            }
        }
    }
    let mut canvas = Canvas::from(&raster)?;
    if let Some(width) = style.outline {
        for face in faces {
            if style.fill {
                canvas.fill(std::slice::from_ref(&face.corners), face.color);
            }
            let next = face.corners.iter().cycle().skip(1);
            canvas.lines(face.corners.iter().zip(next).map(|(&a, &b)| [a, b]), face.outline(), 255, width);
        }
    }
    canvas.dots(dots.iter().copied(), DOT, POINT, 255);
    if style.to_scale {
        canvas.strip(&Legend::None.pieces(view));
    }
    canvas.encode(out)
}

fn svg(out: &mut dyn Write, (faces, dots): Drawn, view: &View, style: &Style) -> std::io::Result<()> {
    super::svg::open(out, view)?;
    writeln!(out, r#"<g stroke-width="{:.2}" stroke-linejoin="round">"#, style.outline.unwrap_or(0.6))?;
    for face in faces {
        let stroke = hex(if style.outline.is_some() { face.outline() } else { face.color });
        let fill = if style.fill { hex(face.color) } else { "none".to_owned() };
        write!(out, r#"<path fill="{fill}" stroke="{stroke}" d=""#)?;
        for (k, [x, y]) in face.corners.iter().enumerate() {
            write!(out, "{}{x:.2} {y:.2}", if k == 0 { 'M' } else { 'L' })?;
        }
        writeln!(out, r#"Z"/>"#)?;
    }
    for [x, y] in dots {
        writeln!(out, r#"<circle cx="{x:.2}" cy="{y:.2}" r="{DOT}" fill="{}"/>"#, hex(POINT))?;
    }
    writeln!(out, "</g>")?;
    if style.to_scale {
        super::svg::strip(out, &Legend::None.pieces(view))?;
    }
    writeln!(out, "</svg>")
}
