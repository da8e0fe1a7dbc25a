//! Meshes of SU2 (`.su2`): cells, points, and sides by marker, which are called by names. There are no regions.
//!
//! Points are numbered from 0 without gaps, in the order of their indices. Sides between cells are markers too, which SU2 takes where its
//! configuration calls them `MARKER_INTERNAL`.
//!
//! Source: "Mesh File" in the documentation of SU2, version 7.

use std::io::{self, Write};

use delone::Triangulation;

use super::lines::{Line, Lines};
use super::listed::Listed;
use crate::elements::Elements;
use crate::error::excerpt;
use crate::names::{Rule, together, told};
use crate::{Error, Mesh, Remark, Source};

/// The name of the format in messages.
pub(crate) const NAME: &str = "SU2";

/// The number of a quadrilateral.
const QUADRILATERAL: u32 = 9;

/// Numbers of lines, triangles and tetrahedra, by their corners.
const KINDS: [(usize, u32); 3] = [(2, 3), (3, 5), (4, 10)];

pub(crate) fn write<T: Triangulation>(out: &mut dyn Write, mesh: &Mesh<T>) -> io::Result<Remark> {
    let elements = Elements::of(mesh);
    let names = elements.names(Rule::WORD);
    let (used, number_of) = elements.dense();
    let dimension = elements.dimension;
    let kind = |corners: usize| match (dimension, corners) {
        (2, 4) => QUADRILATERAL,
        _ => KINDS.iter().find(|kind| kind.0 == corners).map_or(0, |kind| kind.1),
    };
    let row = |out: &mut dyn Write, nodes: &[usize]| {
        write!(out, "{}", kind(nodes.len()))?;
        nodes.iter().try_for_each(|&node| write!(out, " {}", number_of[node]))
    };
    writeln!(out, "NDIME= {dimension}\nNELEM= {}", elements.cell_count())?;
    for (number, nodes) in elements.cells.iter().flat_map(|group| group.rows()).enumerate() {
        row(out, nodes)?;
        writeln!(out, " {number}")?;
    }
    writeln!(out, "NPOIN= {}", used.len())?;
    for (number, &node) in used.iter().enumerate() {
        elements.positions[node][..dimension].iter().try_for_each(|x| write!(out, "{x:?} "))?;
        writeln!(out, "{number}")?;
    }
    writeln!(out, "NMARK= {}", elements.sides.len())?;
    for (group, name) in elements.sides.iter().zip(&names.sides) {
        // A marker without a name is called by its number, which meshio keeps.
        let number = group.reference().to_string();
        let name = if group.is_named() { name } else { &number };
        writeln!(out, "MARKER_TAG= {name}\nMARKER_ELEMS= {}", group.rows().len())?;
        for nodes in group.rows() {
            row(out, nodes)?;
            writeln!(out)?;
        }
    }
    let regions = elements.has_regions.then(|| "regions are left out".to_owned());
    Ok(together([regions, elements.without_heights(), elements.renumbered_sides(), told(&names.changed)]))
}

/// Reads a mesh. A marker is called by its number, or gets the least one from 1 that is free.
pub(crate) fn read(source: Box<dyn Source>) -> Result<Listed, Error> {
    let mut lines = Lines::new(source);
    let mut found = Listed::default();
    let mut dimension = 0;
    let mut tags: Vec<(String, usize)> = Vec::new();
    let mut cells: Vec<(Vec<u64>, bool, usize)> = Vec::new();
    let mut has_points = false;
    while let Some(key) = next_key(&mut lines)? {
        let (name, value, number) = key;
        let line = Line { text: &value, number };
        let count = || line.number::<usize>(value.split_whitespace().next(), &name.to_lowercase());
        match &name[..] {
            "NDIME" => {
                dimension = count()?;
                if dimension != 2 && dimension != 3 {
                    return Err(line.error("NDIME is 2 or 3"));
                }
            }
            "NPOIN" if dimension == 0 => {
                return Err(line.error("NDIME is said after the points, or not at all"));
            }
            "NPOIN" => {
                has_points = true;
                found.has_heights = dimension == 3;
                for i in 0..count()? {
                    let line = content(&mut lines, "points", i)?;
                    let mut words = line.text.split_whitespace();
                    let mut position = [0.0; 3];
                    for (slot, axis) in position.iter_mut().zip(["x", "y", "z"]).take(dimension) {
                        *slot = line.number(words.next(), axis)?;
                    }
                    found.points.push(position);
                }
            }
            "NELEM" | "MARKER_ELEMS" => {
                let tag = if name == "NELEM" { 0 } else { tags.len() };
                for i in 0..count()? {
                    let line = content(&mut lines, "elements", i)?;
                    let mut words = line.text.split_whitespace();
                    let kind: u32 = line.number(words.next(), "the kind of the element")?;
                    let known = KINDS.iter().find(|known| known.1 == kind).map(|known| known.0);
                    let is_quad = kind == QUADRILATERAL && dimension == 2;
                    let Some(corners) = known.or(is_quad.then_some(4)) else {
                        return Err(line.error(format!(
                            "elements of kind {kind} are no lines, triangles, quadrilaterals of the plane or tetrahedra"
                        )));
                    };
                    let corner = |_| line.number(words.next(), "a corner");
                    cells.push(((0..corners).map(corner).collect::<Result<_, _>>()?, is_quad, tag));
                }
            }
            "MARKER_TAG" => tags.push((value.clone(), number)),
            "NMARK" | "SEND_RECV" | "NPERIODIC" => _ = count()?,
            "NZONE" if count()? == 1 => {}
            _ => return Err(line.error(format!("{:?} is no part that is read", excerpt(&name)))),
        }
    }
    if !has_points {
        return Err(Error::content("SU2: it has no NPOIN"));
    }
    let markers = numbers_of(&tags, &mut found)?;
    for (corners, is_quad, tag) in cells {
        let marker = tag.checked_sub(1).map_or(0, |at| markers[at]);
        match corners[..] {
            [a, b, c, d] if is_quad => found.push_quad(NAME, [a, b, c, d], marker)?,
            _ => found.push(NAME, &corners, marker)?,
        }
    }
    Ok(found)
}

/// The numbers of markers, and the names of those that have some.
fn numbers_of(tags: &[(String, usize)], found: &mut Listed) -> Result<Vec<i64>, Error> {
    let own = |tag: &String| tag.parse::<i64>().ok();
    let taken: Vec<i64> = tags.iter().filter_map(|tag| own(&tag.0)).collect();
    let mut free = (1..).filter(|number| !taken.contains(number));
    let mut numbers: Vec<i64> = Vec::new();
    for (tag, _) in tags {
        let known = found.names.boundaries().iter().find(|entry| entry.1 == *tag).map(|entry| entry.0);
        let number = own(tag).or(known).or_else(|| free.next()).unwrap_or_default();
        if own(tag).is_none() {
            found.names.name_boundary(number, tag)?;
        }
        numbers.push(number);
    }
    Ok(numbers)
}

/// A line without what follows a percent sign.
fn plain(text: &str) -> &str {
    text.split('%').next().unwrap_or_default().trim()
}

/// The next line that has a name and a value: these, and its number.
fn next_key(lines: &mut Lines) -> Result<Option<(String, String, usize)>, Error> {
    while let Some(line) = lines.next_whole()? {
        let text = plain(line.text);
        if text.is_empty() {
            continue;
        }
        let Some((name, value)) = text.split_once('=') else {
            return Err(line.error(format!("{:?} where a part begins", excerpt(text))));
        };
        return Ok(Some((name.trim().to_ascii_uppercase(), value.trim().to_owned(), line.number)));
    }
    Ok(None)
}

/// The next line of a part.
fn content<'a>(lines: &'a mut Lines, what: &str, i: usize) -> Result<Line<'a>, Error> {
    lines.next()?.ok_or_else(|| Error::Truncated(format!("after {i} {what}")))
}
