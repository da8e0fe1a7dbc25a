//! Meshes of SMS (`.2dm`), which QGIS and models of water read: triangles with numbers of materials, nodes with heights, and the sides of
//! each marker as strings of nodes. Nodes are numbered from 1 without gaps, because some readers want that.
//!
//! A string follows the sides in their order along a line; it is called by the name of its marker, or else by the number.
//!
//! Source: "2D Mesh Files *.2dm" in the documentation of SMS.

use std::io::{self, Write};

use delone::Triangulation;

use crate::elements::{Elements, Permitted};
use crate::names::{Rule, together, told};
use crate::strings::strings;
use crate::{Mesh, Remark};

/// No line of a string may have more nodes.
const NODES_IN_LINE: usize = 10;

/// The places of the nodes of a triangle of second order, which go around it.
const AROUND: [usize; 6] = [0, 3, 1, 4, 2, 5];

pub(crate) fn write<T: Triangulation<Point = [f64; 2]>>(
    out: &mut dyn Write,
    mesh: &Mesh<T>,
) -> io::Result<Remark> {
    let elements = Elements::of(mesh);
    let Permitted { sides, changed, .. } = elements.names(Rule::WORD);
    let (used, number_of) = elements.dense();
    let node = |node: usize| number_of[node] + 1;
    writeln!(out, "MESH2D\nNUM_MATERIALS_PER_ELEM 1")?;
    let mut number = 0;
    for group in &elements.cells {
        for nodes in group.rows() {
            number += 1;
            let (card, order) = match nodes.len() {
                3 => ("E3T", &[0, 1, 2][..]),
                4 => ("E4Q", &[0, 1, 2, 3][..]),
                _ => ("E6T", &AROUND[..]),
            };
            write!(out, "{card} {number}")?;
            order.iter().try_for_each(|&k| write!(out, " {}", node(nodes[k])))?;
            writeln!(out, " {}", group.tag)?;
        }
    }
    for (number, &node) in used.iter().enumerate() {
        let [x, y, z] = elements.positions[node];
        writeln!(out, "ND {} {x:?} {y:?} {z:?}", number + 1)?;
    }
    for (group, name) in elements.sides.iter().zip(&sides) {
        // What has no name is called by the number of its marker.
        let number = group.reference().to_string();
        let name = if group.is_named() { name } else { &number };
        for string in strings(group.rows()) {
            for (part, nodes) in string.chunks(NODES_IN_LINE).enumerate() {
                let is_last = (part + 1) * NODES_IN_LINE >= string.len();
                write!(out, "NS")?;
                for (k, &index) in nodes.iter().enumerate() {
                    let sign = if is_last && k + 1 == nodes.len() { "-" } else { "" };
                    write!(out, " {sign}{}", node(index))?;
                }
                if is_last { writeln!(out, " {name}")? } else { writeln!(out)? }
            }
        }
    }
    Ok(together([elements.retagged_cells(), elements.renumbered_sides(), told(&changed)]))
}
