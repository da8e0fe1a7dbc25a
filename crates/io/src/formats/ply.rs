//! Stanford polygons: read by the `ply-rs-bw` crate, ascii and binary; written in binary, polygons and faces with regions in ascii.

use std::io::{self, BufRead, Write};

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{
    DefaultElement, ElementDef, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType,
};

use super::in_space;
use crate::error::excerpt;
use crate::polyhedra::{Beyond, Polyhedra};
use crate::{Cloud, Crs, Error, Shape, Source};

struct Vertex([f64; 3]);

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self([0.0; 3])
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        let Some(axis) = ["x", "y", "z"].iter().position(|&axis| axis == name) else {
            return PropertyAccessResult::Ignored;
        };
        self.0[axis] = match value {
            Property::Float(x) => x.into(),
            Property::Double(x) => x,
            Property::Int(x) => x.into(),
            Property::UInt(x) => x.into(),
            Property::Short(x) => x.into(),
            Property::UShort(x) => x.into(),
            Property::Char(x) => x.into(),
            Property::UChar(x) => x.into(),
            // Lists are refused by the header.
            _ => return PropertyAccessResult::Ignored,
        };
        PropertyAccessResult::Set
    }
}

struct Face(Vec<u64>);

impl PropertyAccess for Face {
    fn new() -> Self {
        Self(Vec::new())
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        if name != "vertex_indices" && name != "vertex_index" {
            return PropertyAccessResult::Ignored;
        }
        // A negative index becomes one that no file of points has.
        let index = |i: i64| u64::try_from(i).unwrap_or(u64::MAX);
        self.0 = match value {
            Property::ListInt(list) => list.into_iter().map(|i| index(i.into())).collect(),
            Property::ListUInt(list) => list.into_iter().map(u64::from).collect(),
            Property::ListShort(list) => list.into_iter().map(|i| index(i.into())).collect(),
            Property::ListUShort(list) => list.into_iter().map(u64::from).collect(),
            Property::ListUChar(list) => list.into_iter().map(u64::from).collect(),
            Property::ListChar(list) => list.into_iter().map(|i| index(i.into())).collect(),
            _ => return PropertyAccessResult::Ignored,
        };
        PropertyAccessResult::Set
    }
}

fn broken(error: impl std::fmt::Display) -> Error {
    let text = error.to_string();
    Error::content(format!("PLY: {}", text.lines().next().unwrap_or_default()))
}

/// Elements parsed at a time: bounded memory beside the result.
const CHUNK: usize = 50_000;

/// Hands the elements of one name to `take`, chunk by chunk, and skips those before it. `expect` judges their
/// definition. Returns the header.
fn elements<E: PropertyAccess>(
    source: impl BufRead,
    name: &str,
    expect: impl Fn(&ElementDef) -> Result<(), Error>,
    mut take: impl FnMut(&ElementDef, Vec<E>) -> Result<(), Error>,
) -> Result<Header, Error> {
    let mut reader = Reader::new(source);
    let header = Parser::<DefaultElement>::new().read_header(&mut reader).map_err(broken)?;
    for element in header.elements.values() {
        let wanted = element.name == name;
        if element.properties.is_empty() && element.count > 0 {
            return Err(broken(format!("the elements {:?} have no properties", excerpt(&element.name))));
        }
        if wanted {
            expect(element)?;
        }
        let mut part = element.clone();
        let mut rest = element.count;
        while rest > 0 {
            part.count = rest.min(CHUNK);
            rest -= part.count;
            if wanted {
                let parser = Parser::<E>::new();
                take(element, parser.read_payload_for_element(&mut reader, &part, &header).map_err(broken)?)?;
            } else {
                let parser = Parser::<DefaultElement>::new();
                parser.read_payload_for_element(&mut reader, &part, &header).map_err(broken)?;
            }
        }
        if wanted {
            break;
        }
    }
    Ok(header)
}

/// The coordinates must be single numbers.
fn has_coordinates(element: &ElementDef) -> Result<(), Error> {
    for axis in ["x", "y", "z"] {
        match element.properties.get(axis).map(|property| &property.data_type) {
            Some(PropertyType::List(..)) => return Err(broken(format!("{axis} is a list, not a number"))),
            None if axis != "z" => return Err(broken("the vertices have no properties x and y")),
            _ => {}
        }
    }
    Ok(())
}

pub(crate) fn read_points(source: Box<dyn Source>) -> Result<Cloud, Error> {
    let mut points = None;
    let header = elements::<Vertex>(source, "vertex", has_coordinates, |element, vertices| {
        let with_heights = element.properties.contains_key("z");
        let cloud =
            points.get_or_insert_with(|| Cloud::with_capacity(element.count.min(CHUNK), with_heights));
        vertices.iter().for_each(|&Vertex([x, y, z])| cloud.push([x, y], z));
        Ok(())
    })?;
    if !header.elements.is_empty() && !header.elements.contains_key("vertex") {
        return Err(broken("it has no vertices"));
    }
    let mut cloud = points.unwrap_or_default();
    if let Some(vertex) = header.elements.get("vertex") {
        cloud.lose_values(vertex.properties.keys().map(String::as_str));
    }
    cloud.crs = header.comments.iter().find_map(|comment| Crs::of_name(comment.strip_prefix("crs ")?));
    Ok(cloud)
}

pub(crate) fn read_triangles(source: Box<dyn Source>) -> Result<Vec<[u64; 3]>, Error> {
    let mut triangles = Vec::new();
    elements::<Face>(
        source,
        "face",
        |_| Ok(()),
        |_, faces| {
            for face in faces {
                let i = triangles.len();
                let corners: Result<[u64; 3], _> = face.0.try_into();
                triangles.push(corners.map_err(|list: Vec<u64>| {
                    Error::content(format!("PLY: face {i} has {} corners, not 3", list.len()))
                })?);
            }
            Ok(())
        },
    )?;
    Ok(triangles)
}

pub(crate) fn write(out: &mut dyn Write, shape: &impl Shape) -> io::Result<()> {
    let (points, faces) = (shape.positions().count(), shape.triangles().count());
    if let Some(regions) = shape.region_values() {
        return write_with_regions(out, shape, regions);
    }
    header(out, points, Some(faces), shape.crs())?;
    for position in shape.positions() {
        write_position(out, position)?;
    }
    for triangle in shape.triangles() {
        out.write_all(&[3])?;
        for corner in triangle {
            out.write_all(&(corner as u32).to_le_bytes())?;
        }
    }
    Ok(())
}

/// Writes triangles with a region each. As text: meshio takes it that in binary files all lists of corners come first, and then a value
/// for each face, so it fails where the value of a face follows its list, as the format has it.
fn write_with_regions(
    out: &mut dyn Write,
    shape: &impl Shape,
    regions: impl Iterator<Item = f64>,
) -> io::Result<()> {
    vertex_header(out, "ascii", shape.positions().count(), shape.crs())?;
    writeln!(out, "element face {}\nproperty list uchar uint vertex_indices", shape.triangles().count())?;
    writeln!(out, "property double region\nend_header")?;
    for [x, y, z] in shape.positions() {
        writeln!(out, "{x:?} {y:?} {z:?}")?;
    }
    for ([a, b, c], region) in shape.triangles().zip(regions) {
        writeln!(out, "3 {a} {b} {c} {region:?}")?;
    }
    Ok(())
}

/// Writes the faces of cells with the site of each, and the site beyond: -1 for a wall. As text: readers of binary files take it that all
/// faces have as many corners as the first.
pub(crate) fn write_polyhedra(out: &mut dyn Write, cells: &Polyhedra) -> io::Result<()> {
    let most = cells.present().flat_map(|site| cells.faces(site)).map(|face| face.1.len()).max();
    let kind = if most.unwrap_or(0) > usize::from(u8::MAX) { "uint" } else { "uchar" };
    vertex_header(out, "ascii", cells.vertices.len(), cells.crs)?;
    writeln!(out, "element face {}\nproperty list {kind} uint vertex_indices", cells.face_count())?;
    writeln!(out, "property int site\nproperty int neighbor\nend_header")?;
    for [x, y, z] in &cells.vertices {
        writeln!(out, "{x:?} {y:?} {z:?}")?;
    }
    for site in cells.present() {
        for (face, ring) in cells.faces(site) {
            write!(out, "{}", ring.len())?;
            ring.iter().try_for_each(|corner| write!(out, " {corner}"))?;
            match face.beyond {
                Beyond::Wall(_) => writeln!(out, " {site} -1")?,
                Beyond::Site(other) | Beyond::Copy(other, _) => writeln!(out, " {site} {other}")?,
            }
        }
    }
    Ok(())
}

pub(crate) fn write_points<const D: usize>(out: &mut dyn Write, points: &[[f64; D]]) -> io::Result<()> {
    header(out, points.len(), None, None)?;
    points.iter().try_for_each(|p| write_position(out, in_space(p)))
}

/// Of so many points and so many faces.
fn header(out: &mut dyn Write, points: usize, faces: Option<usize>, crs: Option<&Crs>) -> io::Result<()> {
    vertex_header(out, "binary_little_endian", points, crs)?;
    if let Some(count) = faces {
        write!(out, "element face {count}\nproperty list uchar uint vertex_indices\n")?;
    }
    writeln!(out, "end_header")
}

/// The header of so many points, open for more elements.
fn vertex_header(out: &mut dyn Write, encoding: &str, points: usize, crs: Option<&Crs>) -> io::Result<()> {
    write!(out, "ply\nformat {encoding} 1.0\n")?;
    if let Some(number) = crs.and_then(|crs| crs.epsg) {
        writeln!(out, "comment crs EPSG:{number}")?;
    }
    writeln!(out, "element vertex {points}")?;
    write!(out, "property double x\nproperty double y\nproperty double z\n")
}

fn write_position(out: &mut dyn Write, position: [f64; 3]) -> io::Result<()> {
    position.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))
}
