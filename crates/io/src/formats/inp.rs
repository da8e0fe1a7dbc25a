//! Input files of Abaqus (`.inp`), which other programs read too: nodes, elements in sets by region, and sides by marker, as sets of
//! their nodes and as surfaces of elements. Nodes are numbered as their points, from 1.
//!
//! A side between two cells is one of the first of them alone ([`Elements::owners`]): a surface has one direction. Sides of shells
//! are their edges, which programs call differently, so these have sets of nodes alone.
//!
//! Types of elements that Abaqus, CalculiX and meshio know: triangles of the plane are `CPS3` (plane stress), with six nodes `CPE6` (plane
//! strain, because meshio does not know `CPS6`), those with heights shells. [`Mesh::element`] says another one.

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
    let usual = match (elements.dimension, elements.has_heights, elements.second_order) {
        (3, ..) => "C3D4",
        (_, false, false) => "CPS3",
        (_, false, true) => "CPE6",
        (_, true, false) => "S3",
        (_, true, true) => "STRI65",
    };
    let kind = mesh.element.unwrap_or(usual);
    let mut number = 0;
    for (group, name) in elements.cells.iter().zip(&names.cells) {
        writeln!(out, "*ELEMENT, TYPE={kind}, ELSET={name}")?;
        for row in group.rows() {
            number += 1;
            write!(out, "{number}")?;
            row.iter().try_for_each(|node| write!(out, ", {}", node + 1))?;
            writeln!(out)?;
        }
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
