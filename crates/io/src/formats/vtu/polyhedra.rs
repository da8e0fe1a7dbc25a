//! Cells of space as VTK's polyhedra, which have their faces in arrays of their own.

use std::io::{self, Write};

use super::{Attributes, array};
use crate::Remark;
use crate::polyhedra::Polyhedra;
use crate::xml::escaped;

/// VTK's number for a polyhedron.
const POLYHEDRON: u8 = 42;

/// The arrays of cells that are ours.
const OURS: [&str; 4] = ["site", "volume", "area", "neighbors"];

pub(crate) fn write_polyhedra(out: &mut dyn Write, cells: &Polyhedra) -> io::Result<Remark> {
    // By the number of their corners, then by site: as meshio sorts them, which takes no heed of their arrays.
    let mut sites: Vec<(usize, usize)> =
        cells.present().map(|site| (cells.corners(site).len(), site)).collect();
    sites.sort_unstable();
    let present = || sites.iter().map(|&(_, site)| site);
    let table = cells.features.map(|features| &features.table);
    let ours = if cells.least.is_some() { &OURS[..] } else { &OURS[..3] };
    let attributes = Attributes::of(table, ours, || present().map(|site| cells.row(site)).collect());
    let count = sites.len();
    // The length of the list of faces of a cell: their number, and each with its number of corners.
    let list = |site| 1 + cells.faces(site).map(|(_, ring)| 1 + ring.len()).sum::<usize>();
    let all_corners: usize = sites.iter().map(|entry| entry.0).sum();
    let all_lists = count + cells.face_count() + cells.corner_count();
    // Each array is preceded by its length in eight bytes.
    let mut end = 0;
    let mut begin = |size: usize| {
        let start = end;
        end += size + 8;
        start
    };
    let points = cells.vertices.len();
    let starts = [24 * points, 8 * all_corners, 8 * count, count, 8 * all_lists, 8 * count].map(&mut begin);
    write!(
        out,
        r#"<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid><Piece NumberOfPoints="{points}" NumberOfCells="{count}">
<Points><DataArray type="Float64" NumberOfComponents="3" format="appended" offset="{}"/></Points>
<CellData>"#,
        starts[0]
    )?;
    let names = ours.iter().copied().chain(attributes.columns.iter().map(|column| column.1.as_str()));
    for (k, name) in names.enumerate() {
        let (kind, name, start) = (if k == 0 { "Int64" } else { "Float64" }, escaped(name), begin(8 * count));
        write!(out, r#"<DataArray type="{kind}" Name="{name}" format="appended" offset="{start}"/>"#)?;
    }
    write!(out, "</CellData>\n<Cells>")?;
    let arrays = ["connectivity", "offsets", "types", "faces", "faceoffsets"];
    for (name, start) in arrays.iter().zip(&starts[1..]) {
        let kind = if *name == "types" { "UInt8" } else { "Int64" };
        write!(out, r#"<DataArray type="{kind}" Name="{name}" format="appended" offset="{start}"/>"#)?;
    }
    write!(out, "</Cells>\n</Piece></UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_")?;
    let whole = |number: usize| (number as i64).to_le_bytes();
    array(out, 3 * points, cells.vertices.iter().flatten().map(|x| x.to_le_bytes()))?;
    let connectivity = present().flat_map(|site| cells.corners(site));
    array(out, all_corners, connectivity.map(|corner| whole(corner as usize)))?;
    array(out, count, ends(sites.iter().map(|entry| entry.0)))?;
    array(out, count, (0..count).map(|_| [POLYHEDRON]))?;
    let faces = present().flat_map(|site| {
        let faces = cells.faces(site);
        let rings = faces.clone().flat_map(|(_, ring)| {
            std::iter::once(ring.len()).chain(ring.iter().map(|&corner| corner as usize))
        });
        std::iter::once(faces.len()).chain(rings)
    });
    array(out, all_lists, faces.map(whole))?;
    array(out, count, ends(present().map(list)))?;
    array(out, count, present().map(whole))?;
    array(out, count, present().map(|site| cells.cells[site].volume.to_le_bytes()))?;
    array(out, count, present().map(|site| cells.cells[site].area.to_le_bytes()))?;
    if cells.least.is_some() {
        let numbers = present().map(|site| cells.neighbors(site).unwrap_or_default() as f64);
        array(out, count, numbers.map(f64::to_le_bytes))?;
    }
    for &(column, _) in &attributes.columns {
        array(out, count, attributes.values(column).map(f64::to_le_bytes))?;
    }
    writeln!(out, "\n</AppendedData>\n</VTKFile>")?;
    let lone = cells.rows_without_cells();
    let lone = (lone > 0).then(|| format!("the attributes of points without a cell are left out: {lone}"));
    let remarks: Vec<String> = attributes.remark().into_iter().chain(lone).collect();
    Ok((!remarks.is_empty()).then(|| remarks.join("; ")))
}

/// The ends of parts that have such sizes.
fn ends(sizes: impl Iterator<Item = usize>) -> impl Iterator<Item = [u8; 8]> {
    sizes.scan(0, |end, size| {
        *end += size;
        Some((*end as i64).to_le_bytes())
    })
}
