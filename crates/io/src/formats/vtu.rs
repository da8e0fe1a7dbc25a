//! VTK unstructured grids, as ParaView opens them: XML with the arrays appended in binary.

mod polyhedra;

pub(crate) use polyhedra::write_polyhedra;

use std::io::{self, Write};

use delone::{Coordinates, Triangulation};

use crate::middles::Middles;
use crate::xml::escaped;
use crate::{ColumnType, Mesh, Remark, Shape, Table};

/// VTK's numbers for a triangle, for a tetrahedron, and for a triangle of second order, by their nodes.
const KINDS: [(usize, u8); 3] = [(3, 5), (4, 10), (6, 22)];

/// VTK's numbers for a line, and for one of second order, by their nodes.
const LINES: [(usize, u8); 2] = [(2, 3), (3, 21)];

/// The largest number of columns of attributes: each is an array of all cells.
const MOST_COLUMNS: usize = 256;

/// VTK's number for a quadrilateral.
const QUADRILATERAL: u8 = 9;

/// The arrays of cells that are ours.
const OURS: [&str; 2] = ["region", "marker"];

pub(crate) fn write(out: &mut dyn Write, shape: &impl Shape) -> io::Result<Remark> {
    let (points, cells) = (shape.positions().count(), shape.triangles().count());
    let attributes = Attributes::of(shape.table(), &OURS, || shape.rows().collect());
    let grid = Grid {
        points,
        heights: shape.heights(),
        cells,
        width: 3,
        attributes: &attributes,
        widths: None,
        lines: None,
    };
    grid.write(out, shape.positions(), shape.triangles(), shape.region_values())?;
    Ok(attributes.remark())
}

/// Writes a mesh of simplices; the middles of edges after the points, if triangles have them as nodes. Where markers or names of boundaries
/// are known, the sides follow as lines, with an array of markers that is 0 for triangles.
pub(crate) fn write_mesh<T: Triangulation>(out: &mut dyn Write, mesh: &Mesh<T>) -> io::Result<Remark> {
    let points = mesh.points.len();
    // Quadrilaterals have the attributes of the first of their triangles.
    let is_cell: Vec<bool> = mesh
        .simplices()
        .map(|s| mesh.partner(s).is_none_or(|partner| mesh.triangulation.index(s) < partner))
        .collect();
    let cells = is_cell.iter().filter(|&&is_cell| is_cell).count();
    let attributes = Attributes::of(mesh.features.map(|features| features.table), &OURS, || {
        mesh.feature_rows().zip(&is_cell).filter(|row| *row.1).map(|row| row.0).collect()
    });
    let middles = mesh.second_order.then(|| Middles::of(mesh));
    let lines = has_lines(mesh).then(|| Lines::of(mesh, middles.as_ref()));
    let width = Mesh::<T>::WIDTH;
    let grid = Grid {
        points,
        heights: mesh.heights,
        cells,
        width,
        attributes: &attributes,
        widths: None,
        lines: lines.as_ref(),
    };
    if let Some(middles) = middles {
        let positions: Vec<[f64; 3]> = mesh.positions().collect();
        let positions = middles.points(&positions);
        let heights = mesh.heights.map(|heights| middles.values(1, heights));
        let grid = Grid { points: positions.len(), heights: heights.as_deref(), width: 6, ..grid };
        let rows = mesh.simplices().map(|s| mesh.nodes(s, Some(&middles)));
        grid.write(out, positions.into_iter(), rows, mesh.region_values())?;
    } else if mesh.partners.is_some() {
        let rows: Vec<Vec<usize>> = mesh.cells().map(|cell| cell.1).collect();
        let widths: Vec<usize> = rows.iter().map(Vec::len).collect();
        let regions = mesh.region_values();
        let regions =
            regions.map(|values| values.zip(&is_cell).filter(|value| *value.1).map(|value| value.0));
        let grid = Grid { widths: Some(&widths), ..grid };
        grid.write(out, mesh.positions(), rows, regions)?;
    } else {
        grid.write(out, mesh.positions(), mesh.rows(), mesh.region_values())?;
    }
    Ok(attributes.remark())
}

/// Whether the sides of a mesh are told apart: in the plane, if there are markers or names of boundaries.
fn has_lines<T: Triangulation>(mesh: &Mesh<T>) -> bool {
    let has_markers = mesh.constraints.is_some_and(|constraints| constraints.markers.is_some());
    let has_names = mesh.names.is_some_and(|names| !names.boundaries().is_empty());
    T::Point::COUNT == 2 && mesh.simplex_count() > 0 && (has_markers || has_names)
}

/// The sides as cells.
struct Lines {
    /// The nodes of a line: its ends, and perhaps its middle.
    width: usize,
    nodes: Vec<usize>,
    markers: Vec<i64>,
}

impl Lines {
    fn of<T: Triangulation>(mesh: &Mesh<T>, middles: Option<&Middles>) -> Self {
        let mut found =
            Self { width: 2 + usize::from(middles.is_some()), nodes: Vec::new(), markers: Vec::new() };
        for (ends, marker) in mesh.sides() {
            found
                .nodes
                .extend(ends.iter().map(|v| v.index()).chain(middles.map(|middles| middles.of_edge(ends))));
            found.markers.push(marker);
        }
        found
    }
}

/// The attributes of cells that are numbers, and which others there are.
#[derive(Default)]
struct Attributes<'a> {
    table: Option<&'a Table>,
    /// The row of each cell.
    rows: Vec<Option<usize>>,
    /// Columns, and the names of their arrays.
    columns: Vec<(usize, String)>,
    left_out: Vec<&'a str>,
}

impl<'a> Attributes<'a> {
    /// The columns of a table, beside arrays of our own.
    fn of(table: Option<&'a Table>, ours: &[&str], rows: impl FnOnce() -> Vec<Option<usize>>) -> Self {
        let Some(table) = table.filter(|table| !table.names().is_empty()) else { return Self::default() };
        let mut found = Self { table: Some(table), rows: rows(), ..Self::default() };
        let names = table.names_beside(ours);
        for (column, (name, kind)) in names.into_iter().zip(table.types()).enumerate() {
            let is_number = matches!(kind, ColumnType::Integer | ColumnType::Number);
            if is_number && found.columns.len() < MOST_COLUMNS && table.numbers(column).is_some() {
                found.columns.push((column, name));
            } else {
                found.left_out.push(&table.names()[column]);
            }
        }
        found
    }

    /// The values of a column by cell.
    fn values(&self, column: usize) -> impl Iterator<Item = f64> {
        let numbers = self.table.and_then(|table| table.numbers(column)).unwrap_or_default();
        self.rows.iter().map(move |row| row.and_then(|row| numbers.get(row).copied()).unwrap_or(f64::NAN))
    }

    fn remark(&self) -> Remark {
        const MOST_NAMES: usize = 9;
        let mut names = self.left_out.clone();
        if names.len() > MOST_NAMES {
            names.truncate(MOST_NAMES);
            names.push("...");
        }
        (!names.is_empty()).then(|| {
            format!("arrays have numbers alone: these attributes are left out: {}", names.join(", "))
        })
    }
}

/// A grid: points, a value for each, and cells of `width` corners, perhaps in regions, with attributes.
#[derive(Clone, Copy)]
struct Grid<'a> {
    points: usize,
    heights: Option<&'a [f64]>,
    cells: usize,
    width: usize,
    attributes: &'a Attributes<'a>,
    /// How many corners each cell has, where they differ: in the plane, three or four.
    widths: Option<&'a [usize]>,
    /// Lines after the cells.
    lines: Option<&'a Lines>,
}

impl Grid<'_> {
    fn write(
        &self,
        out: &mut dyn Write,
        positions: impl Iterator<Item = [f64; 3]>,
        corners: impl IntoIterator<Item: IntoIterator<Item = usize>>,
        regions: Option<impl Iterator<Item = f64>>,
    ) -> io::Result<()> {
        let Self { points, heights, cells, width, attributes, widths, lines } = *self;
        let line_count = lines.map_or(0, |lines| lines.markers.len());
        let all = cells + line_count;
        let kind = KINDS.into_iter().find(|kind| kind.0 == width).map_or(0, |kind| kind.1);
        let corner_count = widths.map_or(width * cells, |widths| widths.iter().sum());
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
            place(8 * (corner_count + lines.map_or(0, |lines| lines.nodes.len()))),
            place(8 * all),
            place(all),
            regions.as_ref().map_or(0, |_| place(8 * all)),
            lines.map_or(0, |_| place(8 * all)),
        ];
        writeln!(
            out,
            r#"<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid><Piece NumberOfPoints="{points}" NumberOfCells="{all}">
<Points><DataArray type="Float64" NumberOfComponents="3" format="appended" offset="{}"/></Points>"#,
            offsets[0]
        )?;
        if heights.is_some() {
            let array = r#"<DataArray type="Float64" Name="height" format="appended""#;
            writeln!(out, r#"<PointData Scalars="height">{array} offset="{}"/></PointData>"#, offsets[1])?;
        }
        if regions.is_some() || lines.is_some() || !attributes.columns.is_empty() {
            write!(out, "<CellData{}>", if regions.is_some() { r#" Scalars="region""# } else { "" })?;
            let named = |name: &str, offset: usize| {
                let name = escaped(name);
                format!(r#"<DataArray type="Float64" Name="{name}" format="appended" offset="{offset}"/>"#)
            };
            if regions.is_some() {
                write!(out, "{}", named("region", offsets[5]))?;
            }
            if lines.is_some() {
                let array = r#"<DataArray type="Int64" Name="marker" format="appended""#;
                write!(out, r#"{array} offset="{}"/>"#, offsets[6])?;
            }
            for (_, name) in &attributes.columns {
                write!(out, "{}", named(name, place(8 * all)))?;
            }
            writeln!(out, "</CellData>")?;
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
        let nodes = lines.map_or(&[][..], |lines| &lines.nodes);
        let corners = corners.into_iter().flatten().chain(nodes.iter().copied());
        array(out, corner_count + nodes.len(), corners.map(|index| (index as i64).to_le_bytes()))?;
        let line_width = lines.map_or(0, |lines| lines.width);
        let width_of = |cell: usize| widths.map_or(width, |widths| widths[cell]);
        let ends = (0..cells).scan(0, |end, cell| {
            *end += width_of(cell);
            Some(*end)
        });
        let ends = ends.chain((1..=line_count).map(|end| corner_count + line_width * end));
        array(out, all, ends.map(|end| (end as i64).to_le_bytes()))?;
        let kind_of_lines = LINES.into_iter().find(|kind| kind.0 == line_width).map_or(0, |kind| kind.1);
        let kind_of = |cell: usize| match widths {
            Some(widths) if widths[cell] == 4 => QUADRILATERAL,
            _ => kind,
        };
        let kinds = (0..cells).map(kind_of).chain(std::iter::repeat_n(kind_of_lines, line_count));
        array(out, all, kinds.map(|kind| [kind]))?;
        if let Some(regions) = regions {
            let of_lines = std::iter::repeat_n(0.0, line_count);
            array(out, all, regions.chain(of_lines).map(f64::to_le_bytes))?;
        }
        if let Some(Lines { markers, .. }) = lines {
            let of_cells = std::iter::repeat_n(0, cells);
            array(out, all, of_cells.chain(markers.iter().copied()).map(i64::to_le_bytes))?;
        }
        for &(column, _) in &attributes.columns {
            let of_lines = std::iter::repeat_n(f64::NAN, line_count);
            array(out, all, attributes.values(column).chain(of_lines).map(f64::to_le_bytes))?;
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
