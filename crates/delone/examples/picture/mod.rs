//! Just enough SVG for the examples to leave a picture.

use std::fmt::Write;

/// A picture of a box, 800 pixels wide.
pub(crate) struct Picture {
    body: String,
    low: [f64; 2],
    scale: f64,
    height: f64,
}

impl Picture {
    /// Shows what is between two corners.
    pub(crate) fn new(low: [f64; 2], high: [f64; 2]) -> Self {
        let scale = 800.0 / (high[0] - low[0]);
        Self { body: String::new(), low, scale, height: (high[1] - low[1]) * scale }
    }

    /// Fills a polygon; shades go from 0, dark, to 1.
    pub(crate) fn polygon(&mut self, corners: &[[f64; 2]], shade: f64) {
        let points: Vec<String> = corners
            .iter()
            .map(|p| {
                let [x, y] = [0, 1].map(|k| (p[k] - self.low[k]) * self.scale);
                format!("{x:.1},{:.1}", self.height - y)
            })
            .collect();
        let [red, green, blue] = [40.0 + 200.0 * shade, 90.0 + 140.0 * shade, 160.0 - 20.0 * shade];
        _ = writeln!(
            self.body,
            "<polygon points=\"{}\" fill=\"rgb({red:.0},{green:.0},{blue:.0})\" stroke=\"white\" stroke-width=\"0.7\"/>",
            points.join(" ")
        );
    }

    /// Writes the file, and says so.
    pub(crate) fn save(self, path: &str) -> std::io::Result<()> {
        let Self { body, height, .. } = self;
        let head = format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 800 {height:.0}\">");
        std::fs::write(path, format!("{head}\n{body}</svg>\n"))?;
        println!("{path}");
        Ok(())
    }
}
