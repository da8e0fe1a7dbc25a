//! From coordinates to pixels: lengths alike in both directions, y upwards, a margin around.

use delone::{Bounds, Triangulation, VertexId};

use super::Options;
use super::ruler::Ruler;
use crate::{Crs, Mesh};

/// Pixels left free around the drawing.
const MARGIN: f64 = 24.0;
/// Pixels of the strip below, for scale and legend.
pub(super) const STRIP: f64 = 56.0;
/// Pixels of a row of a legend above it.
pub(super) const LEGEND_ROW: f64 = 26.0;

/// How large a picture is, which system its coordinates have, and how many rows its legend.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame<'a> {
    size: u32,
    crs: Option<&'a Crs>,
    pub(super) rows: usize,
}

impl<'a> Frame<'a> {
    pub(super) fn new(size: u32, crs: Option<&'a Crs>) -> Self {
        Self { size, crs, rows: 0 }
    }

    /// The rows that a legend may have at most.
    pub(super) fn most_rows(&self) -> usize {
        if self.has_strip() { (f64::from(self.size) / 4.0 / LEGEND_ROW) as usize } else { 0 }
    }

    fn has_strip(&self) -> bool {
        f64::from(self.size) > 8.0 * STRIP
    }
}

/// A window on the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) width: u32,
    pub(super) height: u32,
    low: [f64; 2],
    /// Halves coordinates whose extent overflows.
    half: f64,
    /// Pixels per (halved) unit of x and of y.
    scale: [f64; 2],
    offset: [f64; 2],
    /// Where the strip starts, if there is one.
    strip: Option<f64>,
    ruler: Ruler,
}

impl View {
    /// Shows all points with their disks, or a window.
    pub(super) fn of(
        mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>,
        options: &Options,
        frame: &Frame,
    ) -> Self {
        let r = options.disks.unwrap_or(0.0);
        let around = |v: VertexId| {
            let [x, y] = mesh.point(v);
            [[x - r, y - r], [x + r, y + r]]
        };
        match options.window {
            Some(corners) => Self::around(corners.into_iter(), frame),
            None => Self::around(mesh.triangulation.vertices().flat_map(around), frame),
        }
    }

    /// Shows some points: the longer side as long as the frame says, with the strip; the shorter at least a third of it.
    pub(super) fn around(points: impl Iterator<Item = [f64; 2]>, frame: &Frame) -> Self {
        let bounds = Bounds::of(points);
        let half = if bounds.extent().contains(&f64::INFINITY) { 0.5 } else { 1.0 };
        let Bounds { low, high } = bounds;
        let ruler = Ruler::of(frame.crs).within(low, high);
        let squeeze = [ruler.squeeze(low, high), 1.0];
        let extent = [0, 1].map(|k| (high[k] * half - low[k] * half).max(0.0) * squeeze[k]);
        let size = f64::from(frame.size);
        let margin = MARGIN.min(size / 16.0);
        let strip = if frame.has_strip() { STRIP + LEGEND_ROW * frame.rows as f64 } else { 0.0 };
        // What is below the drawing belongs to the picture.
        let below = [0.0, strip];
        let room = below.map(|taken| size - 2.0 * margin - taken);
        let fit = |k: usize| if extent[k] > 0.0 { room[k] / extent[k] } else { f64::INFINITY };
        let longer = usize::from(fit(0) > fit(1));
        let scale = if fit(longer).is_finite() { fit(longer) } else { room[1] };
        let drawn = extent.map(|side| side * scale);
        let pixels = [0, 1].map(|k| {
            let least = size / 3.0 + below[k];
            let wanted = if k == longer { size } else { drawn[k] + 2.0 * margin + below[k] };
            wanted.max(least).min(size).ceil()
        });
        let centered = [0, 1].map(|k| (pixels[k] - below[k] - drawn[k]) / 2.0);
        Self {
            width: pixels[0] as u32,
            height: pixels[1] as u32,
            low: low.map(|x| if x.is_finite() { x * half } else { 0.0 }),
            half,
            scale: squeeze.map(|part| part * scale),
            offset: [centered[0], pixels[1] - strip - centered[1]],
            strip: frame.has_strip().then_some(pixels[1] - strip),
            ruler,
        }
    }

    /// The pixel position of a point.
    pub(super) fn place(&self, p: [f64; 2]) -> [f64; 2] {
        let along = |k: usize| (p[k] * self.half - self.low[k]) * self.scale[k];
        [self.offset[0] + along(0), self.offset[1] - along(1)]
    }

    /// The pixels of a length along x and along y.
    pub(super) fn length(&self, length: f64) -> [f64; 2] {
        self.scale.map(|scale| length * self.half * scale)
    }

    /// Whether there is a strip below the drawing, and where it starts.
    pub(super) fn strip(&self) -> Option<f64> {
        self.strip
    }

    /// A round length (1, 2 or 5 times a power of ten) of at most a fifth of the width, its pixels, and whether it is in metres.
    pub(super) fn scale_bar(&self) -> Option<(f64, f64, bool)> {
        let metres = self.ruler.metres();
        let pixels_per_unit = self.scale[1] * self.half / metres.unwrap_or(1.0);
        let most = f64::from(self.width) / 5.0 / pixels_per_unit;
        let power = libm::pow(10.0, libm::log10(most).floor());
        let round = [5.0, 2.0, 1.0].map(|digit| digit * power).into_iter().find(|&length| length <= most)?;
        let pixels = round * pixels_per_unit;
        let is_number = round.is_finite() && pixels.is_finite() && pixels > 0.0;
        is_number.then_some((round, pixels, metres.is_some()))
    }
}
