//! Groups of Gmsh's meshes: which physical group each curve is in, by the first number of each, and what else a file has.
//!
//! Source: "MSH file format" in the reference manual of Gmsh, versions 2.2 and 4.1.

use std::collections::HashMap;

use super::read::Reader;
use crate::Error;
use crate::error::{excerpt, listed};

/// What a file says beside its nodes and elements.
#[derive(Default)]
pub(super) struct Groups {
    /// `number "name"` of each physical group.
    names: Vec<String>,
    /// The physical groups of curves, by the tags of these; version 2 has them in its elements.
    of_curves: HashMap<i64, i64>,
    /// Curves that are in several.
    several: usize,
    /// Other sections.
    sections: Vec<String>,
}

impl Groups {
    /// Reads a section that is neither of nodes nor of elements.
    pub(super) fn read(&mut self, section: String, reader: &mut Reader) -> Result<(), Error> {
        match &section[..] {
            "PhysicalNames" => self.read_names(reader),
            "Entities" => self.read_entities(reader),
            _ => {
                reader.pass(&section)?;
                if section != "Comments" && !self.sections.contains(&section) {
                    self.sections.push(section);
                }
                Ok(())
            }
        }
    }

    /// The count, and `dimension number "name"` of each.
    fn read_names(&mut self, reader: &mut Reader) -> Result<(), Error> {
        let line = reader.line("in $PhysicalNames")?;
        let count: usize = line.number(line.text.split_whitespace().next(), "the number of names")?;
        for i in 0..count {
            let line = reader.line_of("names", i, count)?;
            let (_, name) = line.text.split_once(char::is_whitespace).unwrap_or_default();
            self.names.push(excerpt(name.trim()).to_owned());
        }
        reader.end("PhysicalNames")
    }

    /// The numbers of points, curves, surfaces and volumes; then points with a position, and curves with a box, before the number of their
    /// groups and these.
    fn read_entities(&mut self, reader: &mut Reader) -> Result<(), Error> {
        let line = reader.line("in $Entities")?;
        let mut words = line.text.split_whitespace();
        let points: usize = line.number(words.next(), "the number of points")?;
        let curves: usize = line.number(words.next(), "the number of curves")?;
        for i in 0..points {
            reader.line_of("points of $Entities", i, points)?;
        }
        for i in 0..curves {
            /// A box has six numbers, which follow the tag of the curve.
            const AFTER_BOX: usize = 6;
            let line = reader.line_of("curves of $Entities", i, curves)?;
            let mut words = line.text.split_whitespace();
            let tag = line.number(words.next(), "the tag of the curve")?;
            let count: usize = line.number(words.nth(AFTER_BOX), "the number of its groups")?;
            if count > 0 {
                // It is negative where the curve is turned in its group.
                let group: i64 = line.number(words.next(), "a group")?;
                self.of_curves.insert(tag, group.saturating_abs());
                self.several += usize::from(count > 1);
            }
        }
        reader.pass("Entities")
    }

    /// The group of the elements of a curve; 0 if it is in none.
    pub(super) fn of_curve(&self, tag: i64) -> i64 {
        self.of_curves.get(&tag).copied().unwrap_or_default()
    }

    /// Parts that are not passed on.
    pub(super) fn losses(&self) -> Vec<String> {
        let mut losses = Vec::new();
        let mut tell = |what: &str, names: &[String]| {
            if !names.is_empty() {
                losses.push(format!("{what} are left out: {}", listed(names.iter().map(String::as_str))));
            }
        };
        tell("names of physical groups", &self.names);
        tell("sections", &self.sections);
        if self.several > 0 {
            losses
                .push(format!("{} curves are in several physical groups: the first is taken", self.several));
        }
        losses
    }
}
