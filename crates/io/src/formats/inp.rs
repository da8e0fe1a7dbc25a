//! Input files of Abaqus (`.inp`), which other programs read too: nodes, elements in sets by region, and sides by marker, as sets of
//! their nodes and as surfaces of elements. Nodes are numbered as their points, from 1.
//!
//! A side between two cells is one of the first of them alone ([`Elements::owners`]): a surface has one direction. Sides of shells
//! are their edges, which programs call differently, so these have sets of nodes alone.
//!
//! Types of elements that Abaqus, CalculiX and meshio know: triangles of the plane are `CPS3` (plane stress), with six nodes `CPE6` (plane
//! strain, because meshio does not know `CPS6`), those with heights shells. [`Mesh::element`] says another one. Quadrilaterals are `CPS4` or `S4`.

use std::io::{self, Write};

use delone::Triangulation;

use crate::elements::{Elements, Owner};
use crate::names::{Rule, told};
use crate::{Mesh, Remark};

/// No line of a set may have more numbers.
const IN_LINE: usize = 16;

pub(crate) fn write<T: Triangulation>(out: &mut dyn Write, mesh: &Mesh<T>) -> io::Result<Remark> {
    let elements = Elements::of(mesh);
    let names = elements.names(Rule::WORD);
    let is_flat = elements.dimension == 2 && !elements.has_heights;
    writeln!(out, "*HEADING\n{} elements\n*NODE", elements.cell_count())?;
    let is_used = elements.is_used();
    for (i, [x, y, z]) in elements.positions.iter().enumerate().filter(|&(i, _)| is_used[i]) {
        write!(out, "{}, {x:?}, {y:?}", i + 1)?;
        if is_flat { writeln!(out)? } else { writeln!(out, ", {z:?}")? }
    }
    let usual = |nodes: usize| match (elements.dimension, elements.has_heights, nodes) {
        (3, ..) => "C3D4",
        (_, false, 3) => "CPS3",
        (_, false, 4) => "CPS4",
        (_, false, _) => "CPE6",
        (_, true, 3) => "S3",
        (_, true, 4) => "S4",
        (_, true, _) => "STRI65",
    };
    let mut first = 1;
    for (group, name) in elements.cells.iter().zip(&names.cells) {
        for nodes in group.widths() {
            let kind = mesh.element.filter(|_| nodes != 4).unwrap_or(usual(nodes));
            writeln!(out, "*ELEMENT, TYPE={kind}, ELSET={name}")?;
            for (k, row) in group.rows().enumerate().filter(|(_, row)| row.len() == nodes) {
                write!(out, "{}", first + k)?;
                row.iter().try_for_each(|node| write!(out, ", {}", node + 1))?;
                writeln!(out)?;
            }
        }
        first += group.rows().len();
    }
    for (group, name) in elements.sides.iter().zip(&names.sides) {
        writeln!(out, "*NSET, NSET={name}")?;
        for part in group.nodes().chunks(IN_LINE) {
            write!(out, "{}", part[0] + 1)?;
            part[1..].iter().try_for_each(|node| write!(out, ", {}", node + 1))?;
            writeln!(out)?;
        }
    }
    let with_surfaces = elements.sides.iter().zip(&names.sides).filter(|_| !elements.has_heights);
    for (group, name) in with_surfaces {
        writeln!(out, "*SURFACE, TYPE=ELEMENT, NAME={name}")?;
        elements.owners(group).try_for_each(|Owner { cell, side }| writeln!(out, "{cell}, S{side}"))?;
    }
    Ok(told(&names.changed))
}
