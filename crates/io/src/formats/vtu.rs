//! VTK unstructured grids, as ParaView opens them: XML with the arrays appended in binary.

use std::io::{self, Write};

use crate::Shape;

/// VTK's numbers for a triangle and for a tetrahedron.
const KINDS: [(usize, u8); 2] = [(3, 5), (4, 10)];

pub(crate) fn write(out: &mut dyn Write, shape: &impl Shape) -> io::Result<()> {
    write_cells(out, shape, shape.triangles())
}

/// Writes cells of N corners.
pub(crate) fn write_cells<const N: usize>(
    out: &mut dyn Write,
    shape: &impl Shape,
    simplices: impl Iterator<Item = [usize; N]>,
) -> io::Result<()> {
    let simplices: Vec<[usize; N]> = simplices.collect();
    let (points, cells) = (shape.positions().count(), simplices.len());
    let kind = KINDS.into_iter().find(|kind| kind.0 == N).map_or(0, |kind| kind.1);
    let sizes =
        [24 * points, 8 * points * usize::from(shape.heights().is_some()), 8 * N * cells, 8 * cells, cells];
    // Each array is preceded by its length in eight bytes.
    let offsets: Vec<usize> =
        sizes.iter().scan(0, |offset, size| Some(std::mem::replace(offset, *offset + size + 8))).collect();
    writeln!(
        out,
        r#"<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid><Piece NumberOfPoints="{points}" NumberOfCells="{cells}">
<Points><DataArray type="Float64" NumberOfComponents="3" format="appended" offset="{}"/></Points>"#,
        offsets[0]
    )?;
    if shape.heights().is_some() {
        let array = r#"<DataArray type="Float64" Name="height" format="appended""#;
        writeln!(out, r#"<PointData Scalars="height">{array} offset="{}"/></PointData>"#, offsets[1])?;
    }
    writeln!(
        out,
        r#"<Cells><DataArray type="Int64" Name="connectivity" format="appended" offset="{}"/>
<DataArray type="Int64" Name="offsets" format="appended" offset="{}"/>
<DataArray type="UInt8" Name="types" format="appended" offset="{}"/></Cells>
</Piece></UnstructuredGrid>"#,
        offsets[2], offsets[3], offsets[4]
    )?;
    write!(out, "<AppendedData encoding=\"raw\">\n_")?;
    let length = |out: &mut dyn Write, k: usize| out.write_all(&(sizes[k] as u64).to_le_bytes());
    length(out, 0)?;
    for x in shape.positions().flatten() {
        out.write_all(&x.to_le_bytes())?;
    }
    length(out, 1)?;
    for z in shape.heights().unwrap_or_default() {
        out.write_all(&z.to_le_bytes())?;
    }
    length(out, 2)?;
    for index in simplices.iter().flatten() {
        out.write_all(&(*index as i64).to_le_bytes())?;
    }
    length(out, 3)?;
    for end in 1..=cells {
        out.write_all(&((N * end) as i64).to_le_bytes())?;
    }
    length(out, 4)?;
    for _ in 0..cells {
        out.write_all(&[kind])?;
    }
    writeln!(out, "\n</AppendedData>\n</VTKFile>")
}
