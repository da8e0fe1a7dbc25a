//! The summary: points and time of each engine beside Triangle's and CGAL's, over all inputs and angles.

use super::engines::TRIANGLE;

/// An engine on an input at an angle.
pub struct Row {
    pub engine: &'static str,
    /// Input and angle.
    pub case: String,
    pub steiner: usize,
    pub seconds: f64,
}

/// All rows.
#[derive(Default)]
pub struct Summary {
    rows: Vec<Row>,
}

impl Summary {
    pub fn add(&mut self, row: Row) {
        self.rows.push(row);
    }

    /// Of each engine, the cases that it and the other have.
    pub fn print(&self) {
        let mut engines: Vec<&str> = Vec::new();
        for row in &self.rows {
            if !engines.contains(&row.engine) {
                engines.push(row.engine);
            }
        }
        println!("\nall inputs and angles");
        println!(
            "  points are Steiner points, their sums over the cases that both have; times are medians of ratios, and their range"
        );
        for engine in engines {
            let mut said = Vec::new();
            if let Some(points) = self.points(engine) {
                said.push(points);
            }
            said.extend([TRIANGLE, "cgal"].iter().filter_map(|other| self.speed(engine, other)));
            if !said.is_empty() {
                println!("  {engine:9} {}", said.join("; "));
            }
        }
    }

    /// The cases that both engines have.
    fn pairs<'a>(&'a self, engine: &'a str, other: &'a str) -> impl Iterator<Item = (&'a Row, &'a Row)> {
        let ours = self.rows.iter().filter(move |row| row.engine == engine && engine != other);
        ours.filter_map(move |row| {
            let is_same = |them: &&Row| them.engine == other && them.case == row.case;
            Some((row, self.rows.iter().find(is_same)?))
        })
    }

    fn points(&self, engine: &str) -> Option<String> {
        let ratio = |(row, other): &(&Row, &Row)| row.steiner as f64 / other.steiner as f64;
        let pairs: Vec<_> = self.pairs(engine, TRIANGLE).collect();
        let most = pairs.iter().max_by(|a, b| ratio(a).total_cmp(&ratio(b)))?;
        let sum = |pick: fn(&(&Row, &Row)) -> usize| pairs.iter().map(pick).sum::<usize>() as f64;
        Some(format!(
            "{:.3} of triangle's points in {} cases, at most {:.3} ({})",
            sum(|pair| pair.0.steiner) / sum(|pair| pair.1.steiner),
            pairs.len(),
            ratio(most),
            most.0.case
        ))
    }

    fn speed(&self, engine: &str, other: &str) -> Option<String> {
        let mut ratios: Vec<f64> =
            self.pairs(engine, other).map(|(row, them)| them.seconds / row.seconds).collect();
        ratios.sort_by(f64::total_cmp);
        let (least, most) = (ratios.first()?, ratios.last()?);
        let median = ratios.get(ratios.len() / 2)?;
        Some(format!("{median:.2} times as fast as {other} ({least:.2} to {most:.2})"))
    }
}
