//! Atoms in rows of text, whose columns are named before: what LAMMPS and extended XYZ have in common.

use super::lines::Line;
use crate::Error;
use crate::cell::UnitCell;
use crate::error::excerpt;
use crate::{Cloud, Features, ReadOptions, Table, Value};

/// The kind of a column.
#[derive(Clone, Copy)]
enum Role {
    /// A coordinate.
    Axis(usize),
    /// An attribute, by its place in the table.
    Attribute(usize),
    /// An attribute that is T or F.
    Logical(usize),
}

/// Atoms being read.
pub(super) struct Atoms {
    cloud: Cloud,
    table: Table,
    /// Attributes are kept, not their names alone.
    keeps: bool,
    roles: Vec<Role>,
}

impl Atoms {
    pub(super) fn new(options: &ReadOptions) -> Self {
        let cloud = Cloud::with_capacity(0, true);
        Self { cloud, table: Table::default(), keeps: options.attributes, roles: Vec::new() }
    }

    /// The next column is a coordinate.
    pub(super) fn axis(&mut self, axis: usize) {
        self.roles.push(Role::Axis(axis));
    }

    /// The next column is an attribute. Of equal names the second has its number from 1.
    pub(super) fn attribute(&mut self, name: &str, is_logical: bool) {
        let is_taken = self.table.names().iter().any(|known| known == name);
        let own = if is_taken { format!("field_{}", self.roles.len() + 1) } else { name.to_owned() };
        let place = self.table.column(&own);
        self.roles.push(if is_logical { Role::Logical(place) } else { Role::Attribute(place) });
    }

    /// Takes a row; `place` makes a point of its coordinates.
    pub(super) fn row(&mut self, line: &Line, place: impl Fn([f64; 3]) -> [f64; 3]) -> Result<(), Error> {
        let count = line.text.split_whitespace().count();
        if count != self.roles.len() {
            return Err(line.error(format!("{count} fields where there are {} columns", self.roles.len())));
        }
        if self.keeps {
            self.table.begin();
        }
        let mut point = [0.0; 3];
        for (word, &role) in line.text.split_whitespace().zip(&self.roles) {
            match role {
                Role::Axis(axis) => point[axis] = line.number(Some(word), ["x", "y", "z"][axis])?,
                Role::Attribute(column) if self.keeps => self.table.put(column, Value::of_field(word)),
                Role::Logical(column) if self.keeps => {
                    let is_true = match word {
                        "T" | "True" | "true" | "TRUE" => true,
                        "F" | "False" | "false" | "FALSE" => false,
                        _ => return Err(line.error(format!("{:?} is neither T nor F", excerpt(word)))),
                    };
                    self.table.put(column, Value::Bool(is_true));
                }
                Role::Attribute(_) | Role::Logical(_) => {}
            }
        }
        let [x, y, z] = place(point);
        self.cloud.push([x, y], z);
        Ok(())
    }

    /// The points of all rows, with their box; `frames` that follow are told.
    pub(super) fn end(self, cell: Option<UnitCell>, frames: usize) -> Cloud {
        let Self { mut cloud, mut table, .. } = self;
        table.unify();
        cloud.features = Features::of_points(table);
        cloud.remarks.extend(cell.map(|cell| cell.to_string()));
        cloud.cell = cell;
        if frames > 0 {
            let what = if frames == 1 { "one more is left out" } else { "more are left out" };
            let count = if frames == 1 { String::new() } else { format!("{frames} ") };
            cloud.losses.push(format!("the first frame is read, {count}{what}"));
        }
        cloud
    }
}
