//! The fields of a table that are no coordinates: attributes of its points and shapes.

use super::columns::Columns;
use crate::{Features, ReadOptions, Table, Value};

/// The attributes of the rows that were read.
#[derive(Default)]
pub(super) struct Kept {
    /// They are kept, not their names alone.
    keeps: bool,
    /// The third coordinate is one of them.
    with_heights: bool,
    table: Table,
    /// The place of each column of the file in the table, where it has one.
    places: Vec<Option<usize>>,
    /// The row of each point.
    rows: Vec<u32>,
}

impl Kept {
    /// Of rows whose columns are not known yet. Of attributes that are kept in the plane heights are one, under their own name.
    pub(super) fn new(options: &ReadOptions) -> Self {
        let keeps = options.attributes;
        Self { keeps, with_heights: keeps && options.dimension == 2, ..Self::default() }
    }

    /// Names the columns that are neither coordinates nor geometries: as the header does, or by their numbers from 1.
    pub(super) fn name(&mut self, names: &[String], named: bool, columns: &Columns) {
        let is_read = |k: usize| match columns {
            Columns::Numbers(numbers) if self.with_heights => numbers.iter().take(2).any(|&read| read == k),
            Columns::Numbers(numbers) => numbers.contains(&k),
            Columns::Geometry(column) => *column == k,
        };
        for (k, name) in names.iter().enumerate() {
            let by_number = format!("field_{}", k + 1);
            let is_new = named && !name.is_empty() && !self.table.names().contains(name);
            // A separator at the end of the line begins no column.
            let is_column = !is_read(k) && (k + 1 < names.len() || !name.is_empty());
            let own = if is_new { name } else { &by_number };
            self.places.push(is_column.then(|| self.table.column(own)));
        }
    }

    /// Every row has a field before those that have names.
    pub(super) fn shift(&mut self) {
        self.places.insert(0, None);
    }

    /// Begins a row.
    pub(super) fn begin(&mut self) {
        if self.keeps {
            self.table.begin();
        }
    }

    /// Takes a field of the row.
    pub(super) fn take(&mut self, column: usize, field: &str) {
        if let Some(&Some(place)) = self.places.get(column).filter(|_| self.keeps) {
            self.table.put(place, Value::of_field(field));
        }
    }

    /// The row is left out, and says nothing of its columns.
    pub(super) fn take_back(&mut self) {
        if self.keeps {
            self.table.take_back();
        }
    }

    /// The row has so many points.
    pub(super) fn points(&mut self, count: usize) {
        if let Some(row) = self.table.len().checked_sub(1) {
            self.rows.resize(self.rows.len() + count, row as u32);
        }
    }

    /// The attributes of all points.
    pub(super) fn features(mut self) -> Features {
        self.table.unify();
        let mut features = Features::new(self.table, self.rows);
        features.has_heights = self.with_heights;
        features
    }
}
