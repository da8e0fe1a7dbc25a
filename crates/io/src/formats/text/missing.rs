//! Rows whose coordinates are missing, as lists of places have them that were looked up: left out where that is asked for, and told.

/// Texts for a missing value: no names of columns.
pub(super) const MISSING: [&str; 8] = ["na", "n/a", "nan", "null", "none", "nil", "inf", "missing"];

/// Lines that a remark names at most.
const MAX_TOLD: usize = 10;

/// Whether a field says that its value is missing.
pub(super) fn is_missing(field: &str) -> bool {
    let field = field.trim().to_lowercase();
    field.is_empty() || MISSING.contains(&field.trim_start_matches(['-', '+']))
}

/// The rows that were left out.
#[derive(Default)]
pub(super) struct Missing {
    pub(super) count: usize,
    /// The lines of the first of them.
    lines: Vec<usize>,
}

impl Missing {
    pub(super) fn add(&mut self, line: usize) {
        self.count += 1;
        if self.lines.len() < MAX_TOLD {
            self.lines.push(line);
        }
    }

    /// How many there are and where, if there are any.
    pub(super) fn told(&self) -> Option<String> {
        let lines: Vec<String> = self.lines.iter().map(ToString::to_string).collect();
        let more = if self.count > lines.len() { ", ..." } else { "" };
        let (rows, of) =
            if self.count == 1 { ("1 row", "line") } else { (&*format!("{} rows", self.count), "lines") };
        (self.count > 0)
            .then(|| format!("{rows} without coordinates left out: {of} {}{more}", lines.join(", ")))
    }
}
