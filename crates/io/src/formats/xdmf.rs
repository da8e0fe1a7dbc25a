//! XDMF (`.xdmf`), with all numbers inside of the XML: one grid of cells with an array of regions.
//!
//! Readers differ in what follows: meshio takes files of one grid alone, and dolfinx takes no grid that mixes lines and triangles. So there
//! is one grid of one kind, which all of them read, and sides are left out. It is called `mesh`, as dolfinx expects.
//!
//! Source: "XDMF Model and Format", version 3.

use std::io::{self, Write};

use delone::Triangulation;

use crate::elements::Elements;
use crate::names::together;
use crate::{Mesh, Remark};

pub(crate) fn write<T: Triangulation>(out: &mut dyn Write, mesh: &Mesh<T>) -> io::Result<Remark> {
    let elements = Elements::of(mesh);
    let (used, number_of) = elements.dense();
    let (kind, width) = match (elements.dimension, elements.second_order) {
        (3, _) => ("Tetrahedron", 4),
        (_, false) => ("Triangle", 3),
        (_, true) => ("Triangle_6", 6),
    };
    let is_flat = elements.dimension == 2 && !elements.has_heights;
    let (geometry, dimension) = if is_flat { ("XY", 2) } else { ("XYZ", 3) };
    let cells = elements.cell_count();
    let item = |columns: usize, rows: usize, kind: &str| {
        format!(
            "<DataItem DataType=\"{kind}\" Precision=\"8\" Dimensions=\"{rows} {columns}\" Format=\"XML\">"
        )
    };
    writeln!(
        out,
        "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain><Grid Name=\"mesh\" GridType=\"Uniform\">\n\
         <Geometry GeometryType=\"{geometry}\">{}",
        item(dimension, used.len(), "Float")
    )?;
    for &node in &used {
        let position = &elements.positions[node][..dimension];
        position.iter().try_for_each(|x| write!(out, "{x:?} "))?;
        writeln!(out)?;
    }
    writeln!(
        out,
        "</DataItem></Geometry>\n<Topology TopologyType=\"{kind}\" NumberOfElements=\"{cells}\" NodesPerElement=\"{width}\">{}",
        item(width, cells, "Int")
    )?;
    for nodes in elements.cells.iter().flat_map(|group| group.rows()) {
        nodes.iter().try_for_each(|&node| write!(out, "{} ", number_of[node]))?;
        writeln!(out)?;
    }
    writeln!(out, "</DataItem></Topology>")?;
    if elements.has_regions {
        writeln!(
            out,
            "<Attribute Name=\"region\" AttributeType=\"Scalar\" Center=\"Cell\"><DataItem DataType=\"Float\" Precision=\"8\" \
             Dimensions=\"{cells}\" Format=\"XML\">"
        )?;
        for group in &elements.cells {
            group.rows().try_for_each(|_| writeln!(out, "{:?}", group.number()))?;
        }
        writeln!(out, "</DataItem></Attribute>")?;
    }
    writeln!(out, "</Grid></Domain></Xdmf>")?;
    let has_markers = mesh.constraints.is_some_and(|constraints| constraints.markers.is_some());
    Ok(together([
        has_markers.then(|| "markers of sides are left out: readers take one kind of cells".to_owned())
    ]))
}
