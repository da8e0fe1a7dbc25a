//! Cells as well-known text, as a table of CSV with a column of it, and as well-known binary: the rings of GeoJSON, bit for bit.
//!
//! A cell is a POLYGON, or a MULTIPOLYGON if the region cuts it to pieces. Every tile has its place in the file, as an empty
//! polygon where nothing is left of it.

use std::io::{self, Write};

use delone::Ring;

use super::wkb::{self, COLLECTION, MULTIPOLYGON, POLYGON};
use super::wkt::Geometries;
use crate::Value;
use crate::diagram::Tiles;

/// Writes the cells as text, one a line or in one collection.
pub(crate) fn write_wkt(out: &mut dyn Write, diagram: &impl Tiles, in_collection: bool) -> io::Result<()> {
    let mut geometries = Geometries::new(out, in_collection, false);
    for tile in diagram.tiles() {
        let polygons = diagram.polygons(tile);
        write_text(geometries.begin(kind(&polygons))?, &polygons)?;
    }
    geometries.end()
}

/// Writes a table with a header: what each cell is of, its area, empty if that is beyond the range of numbers, the attributes of its
/// site, and its geometry in the column `wkt`, by which readers know it.
pub(crate) fn write_csv(out: &mut dyn Write, diagram: &impl Tiles) -> io::Result<()> {
    let names = diagram.table().map(|table| table.names_beside(&[diagram.property(), "area", "wkt"]));
    let header: String =
        names.iter().flatten().map(|name| format!("{},", Value::Text(name).field())).collect();
    writeln!(out, "{},area,{header}wkt", diagram.property())?;
    for tile in diagram.tiles() {
        let area = diagram.area(tile);
        let area = if area.is_finite() { format!("{area:?}") } else { String::new() };
        let polygons = diagram.polygons(tile);
        write!(out, "{},{area},", diagram.title(tile))?;
        if let Some(table) = diagram.table() {
            let fields = table.fields(diagram.row(tile));
            fields.iter().try_for_each(|field| write!(out, "{field},"))?;
        }
        // In quotes, because positions are apart by commas.
        write!(out, "\"{} ", kind(&polygons))?;
        write_text(out, &polygons)?;
        writeln!(out, "\"")?;
    }
    Ok(())
}

/// Writes a collection of the cells, with the number of the system of coordinates.
pub(crate) fn write_wkb(out: &mut dyn Write, diagram: &impl Tiles) -> io::Result<()> {
    wkb::begin(out, COLLECTION, diagram.crs().and_then(|crs| crs.epsg))?;
    wkb::write_count(out, diagram.tiles().count())?;
    for tile in diagram.tiles() {
        match &diagram.polygons(tile)[..] {
            [] => write_binary(out, &[])?,
            [polygon] => write_binary(out, polygon)?,
            polygons => {
                wkb::begin(out, MULTIPOLYGON, None)?;
                wkb::write_count(out, polygons.len())?;
                polygons.iter().try_for_each(|polygon| write_binary(out, polygon))?;
            }
        }
    }
    Ok(())
}

fn kind(polygons: &[Vec<Ring>]) -> &'static str {
    if polygons.len() > 1 { "MULTIPOLYGON" } else { "POLYGON" }
}

/// The positions of a ring, the first again in the end.
fn closed<'a>(ring: &Ring<'a>) -> impl Iterator<Item = [f64; 2]> + Clone + use<'a> {
    ring.points().chain(ring.points().take(1))
}

/// Writes what follows the kind of a geometry.
fn write_text(out: &mut dyn Write, polygons: &[Vec<Ring>]) -> io::Result<()> {
    match polygons {
        [] => write!(out, "EMPTY"),
        [polygon] => write_polygon(out, polygon),
        _ => write_list(out, polygons, |out, polygon| write_polygon(out, polygon)),
    }
}

fn write_polygon(out: &mut dyn Write, polygon: &[Ring]) -> io::Result<()> {
    write_list(out, polygon, |out, ring| {
        write_list(out, closed(ring), |out, [x, y]| write!(out, "{x:?} {y:?}"))
    })
}

/// Writes a list in brackets.
fn write_list<T>(
    out: &mut dyn Write,
    items: impl IntoIterator<Item = T>,
    write: impl Fn(&mut dyn Write, T) -> io::Result<()>,
) -> io::Result<()> {
    write!(out, "(")?;
    for (i, item) in items.into_iter().enumerate() {
        write!(out, "{}", if i == 0 { "" } else { ", " })?;
        write(out, item)?;
    }
    write!(out, ")")
}

fn write_binary(out: &mut dyn Write, polygon: &[Ring]) -> io::Result<()> {
    wkb::begin(out, POLYGON, None)?;
    wkb::write_count(out, polygon.len())?;
    for ring in polygon {
        wkb::write_count(out, closed(ring).count())?;
        closed(ring).flatten().try_for_each(|x| out.write_all(&x.to_le_bytes()))?;
    }
    Ok(())
}
