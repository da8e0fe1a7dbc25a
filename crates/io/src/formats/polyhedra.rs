//! Cells of space in all formats that hold them; here as rows of a table or an array.

use std::io::{self, Write};

use super::{json, npy, obj, ply, vtu};
use crate::polyhedra::Polyhedra;
use crate::{Contents, Direction, Error, Format, Remark, Value, picture};

/// Writes cells of space.
///
/// CSV and NPY have a row for each point, in the order of the input: in CSV `site`, `volume`, `area`, the centroid, `neighbors` if
/// [`Polyhedra::least`] is told, and the attributes of the point, in NPY the numbers alone. JSON has an object for each point, with the
/// corners and faces of its cell. VTU, PLY and OBJ have the cells that have faces: in VTU polyhedra, in PLY and OBJ polygons, those between
/// two cells once for each, so that every cell is a closed surface. SVG and PNG show all cells, or those that [`Polyhedra::cut`] leaves.
///
/// # Errors
/// [`Error::Unsupported`] for other formats, and those of the output.
pub fn write_polyhedra(out: &mut dyn Write, format: Format, cells: &Polyhedra) -> Result<Remark, Error> {
    match format {
        Format::Text => write_csv(out, cells)?,
        Format::Npy => {
            let numbers: Vec<[f64; 5]> = (0..cells.cells.len()).map(|site| cells.measures(site)).collect();
            npy::write_points(out, &numbers)?;
        }
        Format::Json => json::write(out, cells)?,
        Format::Vtu => return Ok(vtu::write_polyhedra(out, cells)?),
        Format::Ply => ply::write_polyhedra(out, cells)?,
        Format::Obj => obj::write_polyhedra(out, cells)?,
        Format::Svg | Format::Png => picture::write_solid(out, format, &cells.solid(), &cells.picture)?,
        _ => return Err(format.without(Contents::Polyhedra, Direction::Written)),
    }
    Ok(None)
}

/// Writes a table: what each cell measures, and the attributes of its site. What is no finite number is an empty field.
fn write_csv(out: &mut dyn Write, cells: &Polyhedra) -> io::Result<()> {
    const OURS: [&str; 7] = ["site", "volume", "area", "centroid_x", "centroid_y", "centroid_z", "neighbors"];
    let ours = if cells.least.is_some() { &OURS[..] } else { &OURS[..6] };
    let table = cells.features.map(|features| &features.table);
    let names = table.map(|table| table.names_beside(ours)).unwrap_or_default();
    let header: String = names.iter().map(|name| format!(",{}", Value::Text(name).field())).collect();
    writeln!(out, "{}{header}", ours.join(","))?;
    for site in 0..cells.cells.len() {
        write!(out, "{site}")?;
        for number in cells.measures(site) {
            if number.is_finite() {
                write!(out, ",{number:?}")?;
            } else {
                write!(out, ",")?;
            }
        }
        cells.neighbors(site).iter().try_for_each(|count| write!(out, ",{count}"))?;
        let fields = table.map(|table| table.fields(cells.row(site))).unwrap_or_default();
        fields.iter().try_for_each(|field| write!(out, ",{field}"))?;
        writeln!(out)?;
    }
    Ok(())
}
