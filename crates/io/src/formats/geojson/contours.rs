//! Contours as features: a line string for each line, a polygon or several for each band.

use std::io::{self, Write};

use super::write_system;
use crate::ContourMap;

pub(crate) fn write_contours(out: &mut dyn Write, map: &ContourMap<'_>) -> io::Result<()> {
    write!(out, "{{\"type\":\"FeatureCollection\",")?;
    write_system(out, map.crs)?;
    write!(out, "\"features\":[")?;
    let mut separator = "\n";
    let mut begin = |out: &mut dyn Write, properties: String, kind: &str| {
        write!(
            out,
            "{separator}{{\"type\":\"Feature\",\"properties\":{{{properties}}},\"geometry\":{{\"type\":\"{kind}\",\"coordinates\":"
        )?;
        separator = ",\n";
        io::Result::Ok(())
    };
    for line in map.lines {
        begin(out, format!("\"elevation\":{:?}", line.level), "LineString")?;
        positions(out, &line.points, line.is_closed)?;
        write!(out, "}}}}")?;
    }
    for band in map.bands {
        let bound = |z: f64| if z.is_finite() { format!("{z:?}") } else { "null".to_owned() };
        let properties = format!("\"lower\":{},\"upper\":{}", bound(band.lower), bound(band.upper));
        begin(out, properties, "MultiPolygon")?;
        for (i, polygon) in band.polygons.iter().enumerate() {
            write!(out, "{}", if i == 0 { "[[" } else { ",[" })?;
            for (k, ring) in polygon.iter().enumerate() {
                write!(out, "{}", if k == 0 { "" } else { "," })?;
                positions(out, ring, true)?;
            }
            write!(out, "]")?;
        }
        write!(out, "]}}}}")?;
    }
    writeln!(out, "\n]}}")
}

/// Positions of a line, the first again at the end of a closed one.
fn positions(out: &mut dyn Write, points: &[[f64; 2]], is_closed: bool) -> io::Result<()> {
    let again = points.first().filter(|_| is_closed);
    for (i, [x, y]) in points.iter().chain(again).enumerate() {
        write!(out, "{}[{x:?},{y:?}]", if i == 0 { "[" } else { "," })?;
    }
    write!(out, "]")
}
