//! Meshes of Gmsh (`.msh`), as text: version 4.1 is written; its reader is in `read.rs`.
//!
//! A group of elements is an entity and a physical group, with the same tag. Nodes are numbered as their points, from 1.

mod groups;
mod read;

use std::io::{self, Write};

use delone::Triangulation;

use crate::elements::{Elements, Group};
use crate::names::{Rule, told};
use crate::{Mesh, Remark};

pub(crate) use read::{count_quads, has_lines, read_graph, read_groups, read_points, read_simplices};

/// Gmsh's number for a quadrilateral.
const QUADRILATERAL: u8 = 3;

/// Gmsh's numbers for elements, by dimension and order: lines, triangles, tetrahedra.
const KINDS: [[u8; 2]; 4] = [[15, 15], [1, 8], [2, 9], [4, 11]];

/// Writes the cells of a mesh by region, and its sides by marker.
pub(crate) fn write<T: Triangulation>(out: &mut dyn Write, mesh: &Mesh<T>) -> io::Result<Remark> {
    let elements = Elements::of(mesh);
    let names = elements.names(Rule::TEXT);
    let sides = elements.sides.iter().map(|group| (elements.dimension - 1, group));
    let groups: Vec<(usize, &Group)> =
        sides.chain(elements.cells.iter().map(|group| (elements.dimension, group))).collect();
    writeln!(out, "$MeshFormat\n4.1 0 8\n$EndMeshFormat")?;
    writeln!(out, "$PhysicalNames\n{}", groups.len())?;
    for ((dimension, group), name) in groups.iter().zip(names.sides.iter().chain(&names.cells)) {
        writeln!(out, "{dimension} {} \"{name}\"", group.tag)?;
    }
    writeln!(out, "$EndPhysicalNames")?;
    write_entities(out, &elements, &groups)?;
    write_nodes(out, &elements, &groups)?;
    write_elements(out, &elements, &groups)?;
    Ok(told(&names.changed))
}

/// Entities: `points curves surfaces volumes`, then `tag box groups group boundaries` each.
fn write_entities(out: &mut dyn Write, elements: &Elements, groups: &[(usize, &Group)]) -> io::Result<()> {
    let count = |dimension: usize| groups.iter().filter(|group| group.0 == dimension).count();
    writeln!(out, "$Entities\n0 {} {} {}", count(1), count(2), count(3))?;
    for (_, group) in groups {
        let (mut least, mut most) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for &node in group.rows().flatten() {
            for (k, x) in elements.positions[node].into_iter().enumerate() {
                (least[k], most[k]) = (least[k].min(x), most[k].max(x));
            }
        }
        write!(out, "{}", group.tag)?;
        least.iter().chain(&most).try_for_each(|x| write!(out, " {x:?}"))?;
        writeln!(out, " 1 {} 0", group.tag)?;
    }
    writeln!(out, "$EndEntities")
}

/// Nodes, each with the first entity that has it: a block for each entity.
fn write_nodes(out: &mut dyn Write, elements: &Elements, groups: &[(usize, &Group)]) -> io::Result<()> {
    let mut waits = elements.is_used();
    let bounds = [waits.iter().position(|&used| used), waits.iter().rposition(|&used| used)];
    let [least, most] = bounds.map(|node| node.map_or(0, |node| node + 1));
    let count = waits.iter().filter(|&&used| used).count();
    writeln!(out, "$Nodes\n{} {count} {least} {most}", groups.len())?;
    for (dimension, group) in groups {
        let mut nodes = group.nodes();
        nodes.retain(|&node| std::mem::take(&mut waits[node]));
        writeln!(out, "{dimension} {} 0 {}", group.tag, nodes.len())?;
        nodes.iter().try_for_each(|node| writeln!(out, "{}", node + 1))?;
        for [x, y, z] in nodes.iter().map(|&node| elements.positions[node]) {
            writeln!(out, "{x:?} {y:?} {z:?}")?;
        }
    }
    writeln!(out, "$EndNodes")
}

/// Elements, numbered from 1: a block for each entity.
fn write_elements(out: &mut dyn Write, elements: &Elements, groups: &[(usize, &Group)]) -> io::Result<()> {
    let count: usize = groups.iter().map(|(_, group)| group.rows().len()).sum();
    let blocks: usize = groups.iter().map(|group| group.1.widths().len()).sum();
    writeln!(out, "$Elements\n{blocks} {count} {} {count}", count.min(1))?;
    let mut number = 0;
    for (dimension, group) in groups {
        for nodes in group.widths() {
            let kind = match (*dimension, nodes) {
                (2, 4) => QUADRILATERAL,
                _ => KINDS[*dimension][usize::from(elements.second_order)],
            };
            let rows = || group.rows().filter(|row| row.len() == nodes);
            writeln!(out, "{dimension} {} {kind} {}", group.tag, rows().count())?;
            for row in rows() {
                number += 1;
                write!(out, "{number}")?;
                row.iter().try_for_each(|node| write!(out, " {}", node + 1))?;
                writeln!(out)?;
            }
        }
    }
    writeln!(out, "$EndElements")
}
