//! VTK unstructured grids, as ParaView opens them: XML with the arrays appended in binary.

use std::io::{self, Write};

use delone::Triangulation;

use crate::middles::Middles;
use crate::{Mesh, Shape};

/// VTK's numbers for a triangle, for a tetrahedron, and for a triangle of second order, by their nodes.
const KINDS: [(usize, u8); 3] = [(3, 5), (4, 10), (6, 22)];

pub(crate) fn write(out: &mut dyn Write, shape: &impl Shape) -> io::Result<()> {
    let (points, cells) = (shape.positions().count(), shape.triangles().count());
    let grid = Grid { points, heights: shape.heights(), cells, width: 3 };
    grid.write(out, shape.positions(), shape.triangles(), shape.region_values())
}

/// Writes a mesh of simplices; the middles of edges after the points, if triangles have them as nodes.
pub(crate) fn write_mesh<T: Triangulation>(out: &mut dyn Write, mesh: &Mesh<T>) -> io::Result<()> {
    let (points, cells) = (mesh.points.len(), mesh.simplex_count());
    let grid = Grid { points, heights: mesh.heights, cells, width: Mesh::<T>::WIDTH };
    if !mesh.second_order {
        return grid.write(out, mesh.positions(), mesh.rows(), mesh.region_values());
    }
    let middles = Middles::of(mesh);
    let positions: Vec<[f64; 3]> = mesh.positions().collect();
    let positions = middles.points(&positions);
    let heights = mesh.heights.map(|heights| middles.values(1, heights));
    let grid = Grid { points: positions.len(), heights: heights.as_deref(), cells, width: 6 };
    let rows = mesh.simplices().map(|s| mesh.nodes(s, Some(&middles)));
    grid.write(out, positions.into_iter(), rows, mesh.region_values())
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
