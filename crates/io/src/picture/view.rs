//! From coordinates to pixels: the same scale in both directions, y upwards, a margin around.

use delone::{Bounds, Triangulation, VertexId};

use super::Options;
use crate::Mesh;

/// Pixels left free around the drawing.
const MARGIN: f64 = 24.0;
/// Pixels of the strip below, for scale and legend.
const STRIP: f64 = 56.0;

/// A window on the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) width: u32,
    pub(super) height: u32,
    low: [f64; 2],
    /// Halves coordinates whose extent overflows.
    half: f64,
    /// Pixels per (halved) unit.
    scale: f64,
    offset: [f64; 2],
}

impl View {
    /// Shows all points with their disks, or a window, the longer side `size` pixels long and the shorter at least a
    /// third of it.
    pub(super) fn of(mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>, options: &Options) -> Self {
        let r = options.disks.unwrap_or(0.0);
        let around = |v: VertexId| {
            let [x, y] = mesh.point(v);
            [[x - r, y - r], [x + r, y + r]]
        };
        match options.window {
            Some(corners) => Self::around(corners.into_iter(), options.size),
            None => Self::around(mesh.triangulation.vertices().flat_map(around), options.size),
        }
    }

    /// Shows some points.
    pub(super) fn around(points: impl Iterator<Item = [f64; 2]>, size: u32) -> Self {
        let bounds = Bounds::of(points);
        let half = if bounds.extent().contains(&f64::INFINITY) { 0.5 } else { 1.0 };
        let Bounds { low, high } = bounds;
        let extent = [0, 1].map(|k| (high[k] * half - low[k] * half).max(0.0));
        let longer = extent[0].max(extent[1]);
        let size = f64::from(size);
        let margin = MARGIN.min(size / 16.0);
        let room = size - 2.0 * margin;
        let longer = if longer > 0.0 { longer } else { 1.0 };
        let drawn = extent.map(|side| side / longer * room);
        let pixels = drawn.map(|side| (side + 2.0 * margin).max(size / 3.0).ceil());
        let centered = [0, 1].map(|k| (pixels[k] - drawn[k]) / 2.0);
        let strip = if size > 8.0 * STRIP { STRIP } else { 0.0 };
        Self {
            width: pixels[0] as u32,
            height: (pixels[1] + strip) as u32,
            low: low.map(|x| if x.is_finite() { x * half } else { 0.0 }),
            half,
            scale: room / longer,
            offset: [centered[0], pixels[1] - centered[1]],
        }
    }

    /// The pixel position of a point.
    pub(super) fn place(&self, p: [f64; 2]) -> [f64; 2] {
        let along = |k: usize| (p[k] * self.half - self.low[k]) * self.scale;
        [self.offset[0] + along(0), self.offset[1] - along(1)]
    }

    /// The pixels of a length.
    pub(super) fn length(&self, length: f64) -> f64 {
        length * self.half * self.scale
    }

    /// Whether there is a strip below the drawing, and where it starts.
    pub(super) fn strip(&self) -> Option<f64> {
        let top = f64::from(self.height) - STRIP;
        (f64::from(self.width.max(self.height)) > 8.0 * STRIP).then_some(top)
    }

    /// A round length (1, 2 or 5 times a power of ten) of at most a fifth of the width, and its pixels.
    pub(super) fn scale_bar(&self) -> Option<(f64, f64)> {
        let pixels_per_unit = self.scale * self.half;
        let most = f64::from(self.width) / 5.0 / pixels_per_unit;
        let power = 10f64.powf(most.log10().floor());
        let round = [5.0, 2.0, 1.0].map(|digit| digit * power).into_iter().find(|&length| length <= most)?;
        let pixels = round * pixels_per_unit;
        (round.is_finite() && pixels.is_finite() && pixels > 0.0).then_some((round, pixels))
    }
}
