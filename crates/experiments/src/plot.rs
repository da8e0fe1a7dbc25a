//! Plots on doubly logarithmic axes.

use std::ops::Range;

use plotters::prelude::*;

/// Told apart by everyone, also in grey (Okabe and Ito's palette).
const COLOURS: [RGBColor; 8] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(90, 90, 90),
    RGBColor(0, 0, 0),
];

/// Curves through measured values.
#[derive(Clone, Debug)]
pub struct Plot {
    /// The name of its file.
    pub name: String,
    title: String,
    axes: [String; 2],
    curves: Vec<(String, Vec<(f64, f64)>)>,
}

impl Plot {
    pub(crate) fn new(name: &str, title: &str, axes: [&str; 2]) -> Self {
        Self {
            name: name.to_owned(),
            title: title.to_owned(),
            axes: axes.map(str::to_owned),
            curves: Vec::new(),
        }
    }

    /// Adds a curve; values that have no logarithm are left out.
    pub(crate) fn curve(&mut self, name: &str, points: impl IntoIterator<Item = (f64, f64)>) {
        let points = points.into_iter().filter(|&(x, y)| x > 0.0 && y > 0.0 && y.is_finite()).collect();
        self.curves.push((name.to_owned(), points));
    }

    /// The picture.
    ///
    /// # Errors
    /// What the drawing library says.
    pub fn svg(&self) -> Result<String, String> {
        let mut svg = String::new();
        self.draw(&mut svg).map_err(|error| format!("cannot draw {}: {error}", self.name))?;
        Ok(svg)
    }

    fn draw(&self, svg: &mut String) -> Result<(), Box<dyn std::error::Error>> {
        let all = || self.curves.iter().flat_map(|(_, points)| points);
        let range = |of: fn(&(f64, f64)) -> f64| {
            let low = all().map(of).fold(f64::INFINITY, f64::min);
            let high = all().map(of).fold(0.0, f64::max);
            match low.is_finite() {
                true if high / low < 4.0 => low / 2.0..high * 2.0,
                true => low / 1.2..high * 1.2,
                false => 0.5..2.0,
            }
        };
        let area = SVGBackend::with_string(svg, (900, 620)).into_drawing_area();
        area.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(&area)
            .caption(&self.title, ("sans-serif", 20))
            .margin(12)
            .margin_right(30)
            .x_label_area_size(46)
            .y_label_area_size(70)
            .build_cartesian_2d(range(|p| p.0).log_scale(), range(|p| p.1).log_scale())?;
        chart
            .configure_mesh()
            .x_desc(&self.axes[0])
            .y_desc(&self.axes[1])
            .x_label_formatter(&|&x| if x < 1e5 { format!("{x}") } else { format!("{x:e}") })
            .y_label_formatter(&|y| format!("{y}"))
            .light_line_style(WHITE)
            .label_style(("sans-serif", 14))
            .draw()?;
        for (i, (name, points)) in self.curves.iter().enumerate() {
            let color = COLOURS[i % COLOURS.len()];
            chart
                .draw_series(LineSeries::new(points.iter().copied(), color.stroke_width(2)).point_size(3))?
                .label(name)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], color.stroke_width(2)));
        }
        chart
            .configure_series_labels()
            .position(self.free_place(&range(|p| p.0), &range(|p| p.1)))
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.3))
            .label_font(("sans-serif", 14))
            .draw()?;
        drop(chart);
        area.present()?;
        Ok(())
    }

    /// Where the legend hides the fewest points: left or right, from top to bottom.
    fn free_place(&self, across: &Range<f64>, up: &Range<f64>) -> SeriesLabelPosition {
        use SeriesLabelPosition::{LowerLeft, LowerRight, MiddleLeft, MiddleRight, UpperLeft, UpperRight};
        let share = |x: f64, range: &Range<f64>| (x / range.start).ln() / (range.end / range.start).ln();
        let points = || self.curves.iter().flat_map(|(_, points)| points);
        let hidden = |is_left: bool, third: f64| {
            let is_hidden = |&&(x, y): &&(f64, f64)| {
                let (x, y) = (share(x, across), share(y, up));
                (if is_left { x < 0.4 } else { x > 0.6 }) && (0.0..1.0).contains(&(3.0 * y - third))
            };
            points().filter(is_hidden).count()
        };
        let places = [
            (UpperLeft, true, 2.0),
            (UpperRight, false, 2.0),
            (MiddleLeft, true, 1.0),
            (MiddleRight, false, 1.0),
            (LowerLeft, true, 0.0),
            (LowerRight, false, 0.0),
        ];
        let freest = places.into_iter().min_by_key(|&(_, is_left, third)| hidden(is_left, third));
        freest.map_or(UpperLeft, |(place, ..)| place)
    }
}
