//! Filling triangles pixel by pixel: each pixel center belongs to one triangle, so nothing shines through
//! between neighbors.

use super::color::Rgb;

/// A picture being filled.
pub(super) struct Raster {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) pixels: Vec<Rgb>,
}

impl Raster {
    pub(super) fn new(width: u32, height: u32, paper: Rgb) -> Self {
        let (width, height) = (width as usize, height as usize);
        Self { width, height, pixels: vec![paper; width * height] }
    }

    /// Fills the pixels whose centers are in a triangle, interpolating two values between its corners.
    pub(super) fn triangle(
        &mut self,
        corners: [[f64; 2]; 3],
        values: [[f64; 2]; 3],
        color: impl Fn([f64; 2], [usize; 2]) -> Rgb,
    ) {
        let [a, b, c] = corners;
        let cross = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        let area = cross(a, b, c);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let span = |k: usize, limit: usize| {
            let low = a[k].min(b[k]).min(c[k]) - 0.5;
            let high = a[k].max(b[k]).max(c[k]) - 0.5;
            (low.ceil().max(0.0) as usize, (high.floor() + 1.0).clamp(0.0, limit as f64) as usize)
        };
        let (columns, rows) = (span(0, self.width), span(1, self.height));
        for y in rows.0..rows.1 {
            for x in columns.0..columns.1 {
                let p = [x as f64 + 0.5, y as f64 + 0.5];
                let weights = [cross(b, c, p) / area, cross(c, a, p) / area, cross(a, b, p) / area];
                if weights.iter().all(|&w| w >= 0.0) {
                    let value = [0, 1].map(|k| (0..3).map(|i| weights[i] * values[i][k]).sum());
                    self.pixels[y * self.width + x] = color(value, [x, y]);
                }
            }
        }
    }

    /// Colors the pixel that holds a position: triangles smaller than a pixel still show.
    pub(super) fn dot(&mut self, at: [f64; 2], color: Rgb) {
        let (x, y) = (at[0] as usize, at[1] as usize);
        if x < self.width && y < self.height {
            self.pixels[y * self.width + x] = color;
        }
    }
}
