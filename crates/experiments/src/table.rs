//! Tables, for people and for programs.

use std::fmt;
use std::sync::Arc;

/// Who keeps what an experiment has found while it runs.
pub trait Watch: fmt::Debug + Send + Sync {
    /// A line of the table of that name, its heads first, as it stands in a file of comma-separated values.
    fn line(&self, table: &str, line: &str);
}

/// Rows of text under a title.
#[derive(Clone, Debug)]
pub struct Table {
    /// The name of its file, without an extension.
    pub name: String,
    title: String,
    heads: Vec<String>,
    rows: Vec<Vec<String>>,
    watch: Option<Arc<dyn Watch>>,
}

impl Table {
    pub(crate) fn new(name: &str, title: &str, heads: &[&str], watch: Option<Arc<dyn Watch>>) -> Self {
        let heads: Vec<String> = heads.iter().map(ToString::to_string).collect();
        if let Some(watch) = &watch {
            watch.line(name, &line(&heads));
        }
        Self { name: name.to_owned(), title: title.to_owned(), heads, rows: Vec::new(), watch }
    }

    pub(crate) fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        let cells: Vec<String> = cells.into_iter().collect();
        if let Some(watch) = &self.watch {
            watch.line(&self.name, &line(&cells));
        }
        self.rows.push(cells);
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The same, separated by commas: a line of heads, then the rows.
    pub fn csv(&self) -> String {
        std::iter::once(&self.heads).chain(&self.rows).map(|cells| line(cells)).collect()
    }
}

/// A line of a file of comma-separated values.
fn line(cells: &[String]) -> String {
    cells.iter().map(|cell| quoted(cell)).collect::<Vec<_>>().join(",") + "\n"
}

/// A field of a file of comma-separated values.
fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}\n", self.title)?;
        let lines: Vec<_> = std::iter::once(&self.heads).chain(&self.rows).collect();
        let length = |cell: &String| cell.chars().count();
        let width = |k: usize| lines.iter().filter_map(|cells| cells.get(k)).map(length).max();
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
pub(crate) fn short(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        x if x.is_nan() => "-".to_owned(),
        x if x >= 100.0 => format!("{value:.0}"),
        x if x >= 10.0 => format!("{value:.1}"),
        x if x >= 1.0 => format!("{value:.2}"),
        x if x >= 0.1 => format!("{value:.3}"),
        x if x >= 0.001 => format!("{value:.4}"),
        _ => format!("{value:.2e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::Table;

    #[test]
    fn commas_in_cells_are_quoted() {
        let mut table = Table::new("t", "title", &["points", "hints, random order"], None);
        table.row(["10".to_owned(), "3 \"or\" 4".to_owned()]);
        assert_eq!(table.csv(), "points,\"hints, random order\"\n10,\"3 \"\"or\"\" 4\"\n");
    }
}
