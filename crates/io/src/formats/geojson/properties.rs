//! Attributes of the input as properties of features.

use std::io::{self, Write};

use crate::Table;
use crate::features::is_infinite;

/// Of more columns, those alone are written that have a value: of a file whose every feature has attributes of its own.
const MOST_NULLS: usize = 256;

/// The columns of a table, under the names that they have beside properties of ours.
pub(crate) struct Properties<'a> {
    table: &'a Table,
    names: Vec<String>,
}

impl<'a> Properties<'a> {
    pub(crate) fn beside(table: &'a Table, ours: &[&str]) -> Self {
        let names = table.names_beside(ours).into_iter();
        Self { table, names: names.map(|name| serde_json::Value::from(name).to_string()).collect() }
    }

    /// Writes the members of a row after others: null where there is no value, and for the infinities, which parsers of JSON refuse.
    pub(crate) fn write(&self, out: &mut dyn Write, row: Option<usize>) -> io::Result<()> {
        let cells = row.into_iter().flat_map(|row| self.table.row(row));
        let mut cells = cells.filter(|cell| !is_infinite(cell.1));
        if self.names.len() > MOST_NULLS {
            return cells.try_for_each(|(column, cell)| write!(out, ",{}:{cell}", self.names[column]));
        }
        let mut values = vec!["null"; self.names.len()];
        cells.for_each(|(column, cell)| values[column] = cell);
        self.names.iter().zip(values).try_for_each(|(name, value)| write!(out, ",{name}:{value}"))
    }
}
