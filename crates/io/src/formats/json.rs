//! Cells of space as JSON: an array with an object for each point, one a line. What is no finite number is null.

use std::io::{self, Write};

use super::geojson::Properties;
use crate::polyhedra::{Beyond, Polyhedra};

/// The names that attributes of sites do not take.
const OURS: [&str; 8] = ["site", "position", "volume", "area", "centroid", "vertices", "faces", "neighbors"];

/// A number, if JSON has it.
fn number(x: f64) -> String {
    if x.is_finite() { format!("{x:?}") } else { "null".to_owned() }
}

fn place(p: [f64; 3]) -> String {
    format!("[{}]", p.map(number).join(","))
}

pub(crate) fn write(out: &mut dyn Write, cells: &Polyhedra) -> io::Result<()> {
    let ours = if cells.least.is_some() { &OURS[..] } else { &OURS[..7] };
    let properties = cells.features.map(|features| Properties::beside(&features.table, ours));
    write!(out, "[")?;
    for (site, cell) in cells.cells.iter().enumerate() {
        let [volume, area] = [cell.volume, cell.area].map(number);
        let [position, centroid] =
            [Some(cells.sites[site]), cell.centroid].map(|p| p.map_or_else(|| "null".to_owned(), place));
        write!(out, "{}\n{{\"site\":{site},\"position\":{position}", if site == 0 { "" } else { "," })?;
        write!(out, ",\"volume\":{volume},\"area\":{area},\"centroid\":{centroid}")?;
        cells.neighbors(site).iter().try_for_each(|count| write!(out, ",\"neighbors\":{count}"))?;
        write!(out, ",\"vertices\":[")?;
        let corners = cells.corners(site);
        for (i, &corner) in corners.iter().enumerate() {
            write!(out, "{}{}", if i == 0 { "" } else { "," }, place(cells.vertices[corner as usize]))?;
        }
        write!(out, "],\"faces\":[")?;
        for (i, (face, ring)) in cells.faces(site).enumerate() {
            let own = |corner: &u32| corners.binary_search(corner).unwrap_or_default().to_string();
            let ring: Vec<String> = ring.iter().map(own).collect();
            write!(out, "{}{{\"corners\":[{}]", if i == 0 { "" } else { "," }, ring.join(","))?;
            match face.beyond {
                Beyond::Wall(wall) => write!(out, ",\"neighbor\":null,\"wall\":{wall}")?,
                Beyond::Site(other) => write!(out, ",\"neighbor\":{other}")?,
                Beyond::Copy(other, [a, b, c]) => {
                    write!(out, ",\"neighbor\":{other},\"offset\":[{a},{b},{c}]")?;
                }
            }
            write!(out, ",\"area\":{}}}", number(face.area))?;
        }
        write!(out, "]")?;
        if let Some(properties) = &properties {
            properties.write(out, cells.row(site))?;
        }
        write!(out, "}}")?;
    }
    writeln!(out, "\n]")
}
