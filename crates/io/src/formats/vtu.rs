//! VTK unstructured grids, as ParaView opens them: XML with the arrays appended in binary.

use std::io::{self, Write};

use crate::Shape;

/// VTK's numbers for a triangle and for a tetrahedron.
const KINDS: [(usize, u8); 2] = [(3, 5), (4, 10)];

pub(crate) fn write(out: &mut dyn Write, shape: &impl Shape) -> io::Result<()> {
    let (points, cells) = (shape.positions().count(), shape.triangles().count());
    let grid = Grid { points, heights: shape.heights(), cells, width: 3 };
    grid.write(out, shape.positions(), shape.triangles(), shape.region_values())
}

/// What a file holds: so many points, a value for each, and so many cells of so many corners, perhaps in regions.
pub(crate) struct Grid<'a> {
    pub(crate) points: usize,
    pub(crate) heights: Option<&'a [f64]>,
    pub(crate) cells: usize,
    pub(crate) width: usize,
}

impl Grid<'_> {
    pub(crate) fn write(
        &self,
        out: &mut dyn Write,
        positions: impl Iterator<Item = [f64; 3]>,
        corners: impl Iterator<Item: IntoIterator<Item = usize>>,
        regions: Option<impl Iterator<Item = f64>>,
    ) -> io::Result<()> {
        let Self { points, heights, cells, width } = *self;
        let kind = KINDS.into_iter().find(|kind| kind.0 == width).map_or(0, |kind| kind.1);
        // Each array is preceded by its length in eight bytes.
        let mut end = 0;
        let mut place = |size: usize| {
            let start = end;
            end += size + 8;
            start
        };
        let offsets = [
            place(24 * points),
            heights.map_or(0, |heights| place(8 * heights.len())),
            place(8 * width * cells),
            place(8 * cells),
            place(cells),
            regions.as_ref().map_or(0, |_| place(8 * cells)),
        ];
        writeln!(
            out,
            r#"<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid><Piece NumberOfPoints="{points}" NumberOfCells="{cells}">
<Points><DataArray type="Float64" NumberOfComponents="3" format="appended" offset="{}"/></Points>"#,
            offsets[0]
        )?;
        if heights.is_some() {
            let array = r#"<DataArray type="Float64" Name="height" format="appended""#;
            writeln!(out, r#"<PointData Scalars="height">{array} offset="{}"/></PointData>"#, offsets[1])?;
        }
        if regions.is_some() {
            let array = r#"<DataArray type="Float64" Name="region" format="appended""#;
            writeln!(out, r#"<CellData Scalars="region">{array} offset="{}"/></CellData>"#, offsets[5])?;
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
        array(out, 3 * points, positions.flatten().map(f64::to_le_bytes))?;
        if let Some(heights) = heights {
            array(out, heights.len(), heights.iter().map(|z| z.to_le_bytes()))?;
        }
        array(out, width * cells, corners.flatten().map(|index| (index as i64).to_le_bytes()))?;
        array(out, cells, (1..=cells).map(|end| ((width * end) as i64).to_le_bytes()))?;
        array(out, cells, (0..cells).map(|_| [kind]))?;
        if let Some(regions) = regions {
            array(out, cells, regions.map(f64::to_le_bytes))?;
        }
        writeln!(out, "\n</AppendedData>\n</VTKFile>")
    }
}

/// Writes an array of so many values, its length first.
fn array<const B: usize>(
    out: &mut dyn Write,
    count: usize,
    mut values: impl Iterator<Item = [u8; B]>,
) -> io::Result<()> {
    out.write_all(&((B * count) as u64).to_le_bytes())?;
    values.try_for_each(|bytes| out.write_all(&bytes))
}
