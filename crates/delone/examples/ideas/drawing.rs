//! Lines, circles and areas as SVG.

use std::fmt::Write;

/// Colors that everyone tells apart (Okabe and Ito).
pub(crate) const BLUE: &str = "#0072b2";
pub(crate) const ORANGE: &str = "#d55e00";
pub(crate) const GREEN: &str = "#009e73";
pub(crate) const GREY: &str = "#b8b8b8";

/// The width of a picture in pixels.
const WIDTH: f64 = 640.0;

/// A picture of a box.
pub(crate) struct Drawing {
    body: String,
    low: [f64; 2],
    scale: f64,
    height: f64,
}

impl Drawing {
    /// Shows the box between two corners.
    pub(crate) fn new(low: [f64; 2], high: [f64; 2]) -> Self {
        let scale = WIDTH / (high[0] - low[0]);
        Self { body: String::new(), low, scale, height: (high[1] - low[1]) * scale }
    }

    fn place(&self, p: [f64; 2]) -> String {
        let [x, y] = [0, 1].map(|k| (p[k] - self.low[k]) * self.scale);
        format!("{x:.1},{:.1}", self.height - y)
    }

    /// Fills a polygon; opacity is from 0 to 1.
    pub(crate) fn area(&mut self, corners: &[[f64; 2]], color: &str, opacity: f64) {
        let points: Vec<String> = corners.iter().map(|&p| self.place(p)).collect();
        let points = points.join(" ");
        _ = writeln!(self.body, "<polygon points=\"{points}\" fill=\"{color}\" fill-opacity=\"{opacity}\"/>");
    }

    /// Draws lines from corner to corner, in pixels of width, and back to the first if they are closed.
    pub(crate) fn lines(&mut self, corners: &[[f64; 2]], is_closed: bool, color: &str, width: f64) {
        let points: Vec<String> = corners.iter().map(|&p| self.place(p)).collect();
        let (points, name) = (points.join(" "), if is_closed { "polygon" } else { "polyline" });
        _ = writeln!(
            self.body,
            "<{name} points=\"{points}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"/>"
        );
    }

    /// Draws a circle.
    pub(crate) fn circle(&mut self, center: [f64; 2], radius: f64, color: &str) {
        self.round(center, radius * self.scale, "none", color);
    }

    /// Draws a point.
    pub(crate) fn dot(&mut self, p: [f64; 2], color: &str) {
        self.round(p, 4.5, color, "white");
    }

    fn round(&mut self, p: [f64; 2], radius: f64, fill: &str, stroke: &str) {
        let place = self.place(p);
        let (x, y) = place.split_once(',').expect("two numbers");
        _ = writeln!(
            self.body,
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius:.1}\" fill=\"{fill}\" stroke=\"{stroke}\" stroke-width=\"1.5\"/>"
        );
    }

    /// Writes the file, and says so.
    pub(crate) fn save(self, path: &str) -> std::io::Result<()> {
        let Self { body, height, .. } = self;
        let head = format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height:.0}\">");
        let back = "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>";
        std::fs::write(path, format!("{head}\n{back}\n{body}</svg>\n"))?;
        println!("{path}");
        Ok(())
    }
}
