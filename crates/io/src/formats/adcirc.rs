//! Grids of ADCIRC (`.14`): nodes with depths, which are heights with the other sign, triangles, and the border as strings of nodes
//! in order. Nodes are numbered from 1 without gaps.
//!
//! Sides whose name begins with `open` or `ocean` are open boundaries, all others are land: mainland (type 0) on outer rings, islands
//! (type 1) around holes. Strings have the mesh on their left; rings end with their first node. An island that has an open side
//! is split as outer rings are.
//!
//! Source: "Grid and Boundary Information File" in the manual of ADCIRC, version 52.

use std::io::{self, Write};

use delone::Triangulation;

use crate::border::{Ring, rings};
use crate::elements::Elements;
use crate::names::{Rule, together, told};
use crate::{Mesh, Remark};

/// Beginnings of the names of open boundaries, in small letters.
const OPEN: [&str; 2] = ["open", "ocean"];

/// A string of nodes.
struct Boundary<'a> {
    nodes: Vec<usize>,
    name: &'a str,
    is_open: bool,
    /// A whole ring around a hole.
    is_island: bool,
}

pub(crate) fn write<T: Triangulation<Point = [f64; 2]>>(
    out: &mut dyn Write,
    mesh: &Mesh<T>,
) -> io::Result<Remark> {
    let elements = Elements::of(mesh);
    let names = elements.names(Rule::TEXT);
    let (used, number_of) = elements.dense();
    let node = |node: usize| number_of[node] + 1;
    writeln!(out, "{} triangles\n{} {}", elements.cell_count(), elements.cell_count(), used.len())?;
    for (number, &node) in used.iter().enumerate() {
        let [x, y, z] = elements.positions[node];
        // Zero stays without a sign.
        writeln!(out, "{} {x:?} {y:?} {:?}", number + 1, 0.0 - z)?;
    }
    for (number, nodes) in elements.cells.iter().flat_map(|group| group.rows()).enumerate() {
        writeln!(out, "{} 3 {} {} {}", number + 1, node(nodes[0]), node(nodes[1]), node(nodes[2]))?;
    }
    let is_open: Vec<bool> = elements
        .sides
        .iter()
        .map(|group| {
            OPEN.iter().any(|open| group.is_named() && group.name().to_lowercase().starts_with(open))
        })
        .collect();
    let mut groups: Vec<([usize; 2], usize)> = Vec::new();
    for (at, group) in elements.sides.iter().enumerate() {
        groups.extend(group.rows().map(|ends| ([ends[0].min(ends[1]), ends[0].max(ends[1])], at)));
    }
    groups.sort_unstable();
    let rings = rings(mesh);
    let on_border: usize = rings.iter().map(|ring| ring.nodes.len()).sum();
    let group_of = |from: usize, to: usize| {
        let ends = [from.min(to), from.max(to)];
        groups.binary_search_by_key(&ends, |entry| entry.0).map_or(0, |at| groups[at].1)
    };
    let (mut outer, mut islands) = (Vec::new(), Vec::new());
    for ring in &rings {
        let list = if ring.is_outer { &mut outer } else { &mut islands };
        split(ring, group_of, &is_open, &names.sides, list);
    }
    let all: Vec<Boundary> = outer.into_iter().chain(islands).collect();
    for (is_open, what, all_of) in [(true, "open", "open"), (false, "land", "flow")] {
        let some = || all.iter().filter(|boundary| boundary.is_open == is_open);
        writeln!(out, "{} = number of {all_of} boundaries", some().count())?;
        let count: usize = some().map(|boundary| boundary.nodes.len()).sum();
        writeln!(out, "{count} = number of nodes of {all_of} boundaries")?;
        for (number, boundary) in some().enumerate() {
            let kind = u8::from(boundary.is_island);
            let (count, name) = (boundary.nodes.len(), boundary.name);
            writeln!(out, "{count} {kind} = nodes and type of {what} boundary {} {name}", number + 1)?;
            boundary.nodes.iter().try_for_each(|&index| writeln!(out, "{}", node(index)))?;
        }
    }
    let inside = groups.len() - on_border.min(groups.len());
    let inside = (inside > 0)
        .then(|| format!("{inside} sides inside of the mesh are left out: it has the border alone"));
    let regions = elements.has_regions.then(|| "regions are left out".to_owned());
    let depths = (!elements.has_heights).then(|| "there are no heights: all depths are 0".to_owned());
    Ok(together([inside, regions, depths, told(&names.changed)]))
}

/// Splits a ring where its group changes; an island of land is one, whatever the groups of its sides are.
fn split<'a>(
    ring: &Ring,
    group_of: impl Fn(usize, usize) -> usize,
    is_open: &[bool],
    names: &'a [String],
    boundaries: &mut Vec<Boundary<'a>>,
) {
    let count = ring.nodes.len();
    let ends = |k: usize| (ring.nodes[k % count], ring.nodes[(k + 1) % count]);
    let groups: Vec<usize> = (0..count).map(|k| group_of(ends(k).0, ends(k).1)).collect();
    let is_land = groups.iter().all(|&group| !is_open[group]);
    let changes: Vec<usize> = (0..count).filter(|&k| groups[k] != groups[(k + count - 1) % count]).collect();
    if changes.is_empty() || is_land && !ring.is_outer {
        let nodes = ring.nodes.iter().chain(&ring.nodes[..1]).copied().collect();
        let is_open = is_open[groups[0]];
        boundaries.push(Boundary {
            nodes,
            name: &names[groups[0]],
            is_open,
            is_island: !ring.is_outer && !is_open,
        });
        return;
    }
    for (i, &start) in changes.iter().enumerate() {
        let end = changes.get(i + 1).copied().unwrap_or(changes[0] + count);
        let nodes = (start..=end).map(|k| ring.nodes[k % count]).collect();
        let group = groups[start];
        boundaries.push(Boundary { nodes, name: &names[group], is_open: is_open[group], is_island: false });
    }
}
