//! Groups of Gmsh's meshes: which physical group each curve and each surface is in, by the first number of each, their names, and
//! what else a file has.
//!
//! Source: "MSH file format" in the reference manual of Gmsh, versions 2.2 and 4.1.

use std::collections::HashMap;

use super::read::Reader;
use crate::error::listed;
use crate::{Error, Names};

/// What a file says beside its nodes and elements.
#[derive(Default)]
pub(super) struct Groups {
    /// The dimension, the number and the name of each physical group.
    names: Vec<(usize, i64, String)>,
    /// The physical groups of curves and of surfaces, by the tags of these; version 2 has them in its elements.
    of_entities: [HashMap<i64, i64>; 2],
    /// Curves, and surfaces, that are in several.
    several: [usize; 2],
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
            let line = reader.whole_line_of("names", i, count)?;
            let (dimension, rest) =
                line.text.trim_start().split_once(char::is_whitespace).unwrap_or_default();
            let (number, name) = rest.trim_start().split_once(char::is_whitespace).unwrap_or_default();
            let dimension = line.number(Some(dimension), "the dimension of the group")?;
            let number = line.number(Some(number), "the number of the group")?;
            let name = name.trim();
            let name = name.strip_prefix('"').and_then(|name| name.strip_suffix('"')).unwrap_or(name);
            self.names.push((dimension, number, name.to_owned()));
        }
        reader.end("PhysicalNames")
    }

    /// The numbers of points, curves, surfaces and volumes; then points with a position, and curves and surfaces with a box, before
    /// the number of their groups and these.
    fn read_entities(&mut self, reader: &mut Reader) -> Result<(), Error> {
        let line = reader.line("in $Entities")?;
        let mut words = line.text.split_whitespace();
        let points: usize = line.number(words.next(), "the number of points")?;
        let curves: usize = line.number(words.next(), "the number of curves")?;
        // Short files end here.
        let surfaces: usize =
            words.next().map_or(Ok(0), |word| line.number(Some(word), "the number of surfaces"))?;
        for i in 0..points {
            reader.line_of("points of $Entities", i, points)?;
        }
        for (k, (what, count)) in [("curve", curves), ("surface", surfaces)].into_iter().enumerate() {
            for i in 0..count {
                /// A box has six numbers, which follow the tag.
                const AFTER_BOX: usize = 6;
                let line = reader.line_of(&format!("{what}s of $Entities"), i, count)?;
                let mut words = line.text.split_whitespace();
                let tag = line.number(words.next(), &format!("the tag of the {what}"))?;
                let groups: usize = line.number(words.nth(AFTER_BOX), "the number of its groups")?;
                if groups > 0 {
                    // It is negative where the entity is turned in its group.
                    let group: i64 = line.number(words.next(), "a group")?;
                    self.of_entities[k].insert(tag, group.saturating_abs());
                    self.several[k] += usize::from(groups > 1);
                }
            }
        }
        reader.pass("Entities")
    }

    /// The group of the elements of a curve (dimension 1) or of a surface; 0 if it is in none.
    pub(super) fn of(&self, dimension: usize, tag: i64) -> i64 {
        let of_entities = dimension.checked_sub(1).and_then(|k| self.of_entities.get(k));
        of_entities.and_then(|groups| groups.get(&tag)).copied().unwrap_or_default()
    }

    /// The names of the groups of curves, which are boundaries, and of surfaces, which are regions.
    pub(super) fn names(&self) -> Result<Names, Error> {
        let mut names = Names::default();
        for (dimension, number, name) in &self.names {
            match dimension {
                1 => names.name_boundary(*number, name)?,
                2 => names.name_region(*number as f64, name)?,
                _ => {}
            }
        }
        Ok(names)
    }

    /// Parts that are not passed on, to readers that take the names of curves and surfaces or none.
    pub(super) fn losses(&self, takes_names: bool) -> Vec<String> {
        let mut losses = Vec::new();
        let mut tell = |what: &str, names: &[String]| {
            if !names.is_empty() {
                losses.push(format!("{what} are left out: {}", listed(names.iter().map(String::as_str))));
            }
        };
        let is_lost = |name: &&(usize, i64, String)| !(takes_names && (1..=2).contains(&name.0));
        let lost = self.names.iter().filter(is_lost);
        let names: Vec<String> = lost.map(|(_, number, name)| format!("{number} {name:?}")).collect();
        tell("names of physical groups", &names);
        tell("sections", &self.sections);
        for (what, several) in
            ["curves", "surfaces"].into_iter().zip(self.several).filter(|entry| entry.1 > 0)
        {
            losses.push(format!("{several} {what} are in several physical groups: the first is taken"));
        }
        losses
    }
}
