//! Tables, for people and for programs.

use std::fmt;

/// Rows of text under a title.
pub(super) struct Table {
    /// The name of its file.
    pub(super) name: String,
    title: String,
    heads: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    pub(super) fn new(name: &str, title: &str, heads: &[&str]) -> Self {
        let heads = heads.iter().map(ToString::to_string).collect();
        Self { name: name.to_owned(), title: title.to_owned(), heads, rows: Vec::new() }
    }

    pub(super) fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }

    /// The same, separated by commas.
    pub(super) fn csv(&self) -> String {
        let lines = std::iter::once(&self.heads).chain(&self.rows);
        lines.map(|cells| cells.join(",") + "\n").collect()
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}\n", self.title)?;
        let lines: Vec<_> = std::iter::once(&self.heads).chain(&self.rows).collect();
        let width = |k: usize| lines.iter().filter_map(|cells| cells.get(k)).map(String::len).max();
        let widths: Vec<usize> = (0..self.heads.len()).map(|k| width(k).unwrap_or(0)).collect();
        for cells in lines {
            let padded: Vec<_> =
                cells.iter().zip(&widths).map(|(cell, &width)| format!("{cell:>width$}")).collect();
            writeln!(f, "  {}", padded.join("  "))?;
        }
        Ok(())
    }
}

/// A number with three significant digits.
pub(super) fn short(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        x if x >= 100.0 => format!("{value:.0}"),
        x if x >= 10.0 => format!("{value:.1}"),
        x if x >= 1.0 => format!("{value:.2}"),
        x if x >= 0.1 => format!("{value:.3}"),
        _ => format!("{value:.4}"),
    }
}
