//! Meshes of Medit (`.mesh`), as text: FreeFEM, MMG, Gmsh and meshio read them. Regions and markers are references, whole numbers; there are
//! no names. Points that no cell uses are left out; the others are numbered from 1 in their order.
//!
//! Source: the documentation of libMeshb, the reference reader of the format.

use std::io::{self, Write};

use delone::Triangulation;

use super::lines::{Line, Lines};
use super::listed::Listed;
use crate::elements::{Elements, Group};
use crate::error::excerpt;
use crate::names::together;
use crate::{Error, Mesh, Remark, Source};

/// The name of the format in messages.
pub(crate) const NAME: &str = "MESH";

/// The list of quadrilaterals.
const QUADRILATERALS: &str = "Quadrilaterals";

/// Lists of simplices by the number of their corners.
const LISTS: [(&str, usize); 3] = [("Edges", 2), ("Triangles", 3), ("Tetrahedra", 4)];

/// Lists that a reader may do without, and how many numbers an entry has.
const PASSED: [(&str, usize); 5] =
    [("Corners", 1), ("Ridges", 1), ("RequiredVertices", 1), ("RequiredEdges", 1), ("RequiredTriangles", 1)];

pub(crate) fn write<T: Triangulation>(out: &mut dyn Write, mesh: &Mesh<T>) -> io::Result<Remark> {
    let elements = Elements::of(mesh);
    let (used, number_of) = elements.dense();
    let dimension = if elements.has_heights { 3 } else { elements.dimension };
    writeln!(out, "MeshVersionFormatted 2\nDimension {dimension}\nVertices\n{}", used.len())?;
    for &node in &used {
        elements.positions[node][..dimension].iter().try_for_each(|x| write!(out, "{x:?} "))?;
        let marker = mesh.point_markers.and_then(|markers| markers.get(node)).copied();
        writeln!(out, "{}", marker.and_then(|marker| i32::try_from(marker).ok()).unwrap_or_default())?;
    }
    let mut list = |groups: &[Group], corners: usize, name: &str| {
        let rows = |group: &Group| group.rows().filter(|row| row.len() == corners).count();
        let count: usize = groups.iter().map(rows).sum();
        if count == 0 {
            return Ok(());
        }
        writeln!(out, "{name}\n{count}")?;
        for group in groups {
            for nodes in group.rows().filter(|row| row.len() == corners) {
                nodes.iter().try_for_each(|&node| write!(out, "{} ", number_of[node] + 1))?;
                writeln!(out, "{}", group.reference())?;
            }
        }
        Ok::<(), io::Error>(())
    };
    let name_of = |corners: usize| LISTS.iter().find(|list| list.1 == corners).map_or("", |list| list.0);
    let dimension = elements.dimension;
    list(&elements.sides, dimension, name_of(dimension))?;
    list(&elements.cells, dimension + 1, name_of(dimension + 1))?;
    if dimension == 2 {
        list(&elements.cells, 4, QUADRILATERALS)?;
    }
    writeln!(out, "End")?;
    Ok(together([elements.renumbered()]))
}

/// Words of a file, one after another, with the lines that they are on.
struct Words {
    lines: Lines,
    of_line: std::vec::IntoIter<String>,
    line: usize,
}

impl Words {
    fn next(&mut self) -> Result<Option<String>, Error> {
        loop {
            if let Some(word) = self.of_line.next() {
                return Ok(Some(word));
            }
            let Some(line) = self.lines.next()? else { return Ok(None) };
            self.line = line.number;
            let words: Vec<String> = line.text.split_whitespace().map(str::to_owned).collect();
            self.of_line = words.into_iter();
        }
    }

    fn number<N: std::str::FromStr>(&mut self, meaning: &str) -> Result<N, Error> {
        let word = self.next()?.ok_or_else(|| Error::Truncated(format!("where {meaning} is expected")))?;
        Line { text: &word, number: self.line }.number(Some(&word), meaning)
    }

    fn error(&self, what: String) -> Error {
        Error::Line { line: self.line, what }
    }
}

/// Reads a mesh.
pub(crate) fn read(source: Box<dyn Source>) -> Result<Listed, Error> {
    let mut words = Words { lines: Lines::new(source), of_line: Vec::new().into_iter(), line: 0 };
    if words.next()?.as_deref() != Some("MeshVersionFormatted") {
        return Err(Error::content("MESH: it does not begin with MeshVersionFormatted"));
    }
    let _: u32 = words.number("the version")?;
    let mut found = Listed::default();
    let mut dimension = 0;
    let mut has_vertices = false;
    while let Some(word) = words.next()? {
        match &word[..] {
            "End" => break,
            "Dimension" => {
                dimension = words.number("the dimension")?;
                if dimension != 2 && dimension != 3 {
                    return Err(words.error("the dimension is 2 or 3".to_owned()));
                }
                found.has_heights = dimension == 3;
            }
            "Vertices" => {
                if dimension == 0 {
                    return Err(
                        words.error("the dimension is said after the vertices, or not at all".to_owned())
                    );
                }
                has_vertices = true;
                for _ in 0..words.number::<usize>("the number of vertices")? {
                    let mut position = [0.0; 3];
                    for (slot, axis) in position.iter_mut().zip(["x", "y", "z"]).take(dimension) {
                        *slot = words.number(axis)?;
                    }
                    let _: i64 = words.number("a reference")?;
                    found.points.push(position);
                }
            }
            name => {
                if let Some(&(_, corners)) = LISTS.iter().find(|list| list.0 == name) {
                    elements(&mut words, corners, &mut found)?;
                } else if name == QUADRILATERALS {
                    for _ in 0..words.number::<usize>("the number of elements")? {
                        let (corners, reference) = element(&mut words, 4, &found)?;
                        found.push_quad(NAME, corners, reference)?;
                    }
                } else if let Some(&(_, width)) = PASSED.iter().find(|list| list.0 == name) {
                    for _ in 0..words.number::<usize>("the number of entries")?.saturating_mul(width) {
                        let _: i64 = words.number("an entry")?;
                    }
                } else {
                    return Err(words.error(format!("{:?} is no list that is read", excerpt(name))));
                }
            }
        }
    }
    if has_vertices { Ok(found) } else { Err(Error::content("MESH: it has no Vertices")) }
}

/// Reads a list of simplices.
fn elements(words: &mut Words, count: usize, found: &mut Listed) -> Result<(), Error> {
    for _ in 0..words.number::<usize>("the number of elements")? {
        let (corners, reference) = element(words, count, found)?;
        found.push(NAME, &corners[..count], reference)?;
    }
    Ok(())
}

/// Reads the corners of an element, which count vertices from 1, and its reference.
fn element(words: &mut Words, count: usize, found: &Listed) -> Result<([u64; 4], i64), Error> {
    let mut corners = [0; 4];
    for slot in &mut corners[..count] {
        let number: u64 = words.number("a corner")?;
        *slot = match number.checked_sub(1) {
            Some(index) if index < found.points.len() as u64 => index,
            _ => return Err(words.error(format!("there is no vertex {number}"))),
        };
    }
    Ok((corners, words.number("a reference")?))
}
