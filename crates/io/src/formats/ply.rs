//! Stanford polygons: read by the `ply-rs-bw` crate, ascii and binary; written in binary.

use std::io::{self, BufRead, Write};

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{DefaultElement, ElementDef, Property, PropertyAccess, PropertyAccessResult};

use super::in_space;
use crate::{Cloud, Error, Shape, Source};

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
            _ => return PropertyAccessResult::Ignored,
        };
        PropertyAccessResult::Set
    }
}

fn broken(error: impl std::fmt::Display) -> Error {
    Error::content(format!("PLY: {error}"))
}

/// Elements parsed at a time: bounded memory beside the result.
const CHUNK: usize = 50_000;

/// Hands the elements of one name to `take`, chunk by chunk, and skips those before it.
fn elements<E: PropertyAccess>(
    source: impl BufRead,
    name: &str,
    mut take: impl FnMut(&ElementDef, Vec<E>) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut reader = Reader::new(source);
    let header = Parser::<DefaultElement>::new().read_header(&mut reader).map_err(broken)?;
    for element in header.elements.values() {
        let mut part = element.clone();
        let mut rest = element.count;
        while rest > 0 {
            part.count = rest.min(CHUNK);
            rest -= part.count;
            if element.name == name {
                let parser = Parser::<E>::new();
                take(element, parser.read_payload_for_element(&mut reader, &part, &header).map_err(broken)?)?;
            } else {
                let parser = Parser::<DefaultElement>::new();
                parser.read_payload_for_element(&mut reader, &part, &header).map_err(broken)?;
            }
        }
        if element.name == name {
            break;
        }
    }
    Ok(())
}

pub(crate) fn read_points(source: Box<dyn Source>) -> Result<Cloud, Error> {
    let mut cloud = None;
    elements::<Vertex>(source, "vertex", |element, vertices| {
        let has = |axis: &str| element.properties.contains_key(axis);
        if !has("x") || !has("y") {
            return Err(Error::content("PLY: the vertices have no properties x and y"));
        }
        let cloud = cloud.get_or_insert_with(|| Cloud::with_capacity(element.count, has("z")));
        vertices.iter().for_each(|&Vertex([x, y, z])| cloud.push([x, y], z));
        Ok(())
    })?;
    Ok(cloud.unwrap_or_default())
}

pub(crate) fn read_triangles(source: Box<dyn Source>) -> Result<Vec<[u64; 3]>, Error> {
    let mut triangles = Vec::new();
    elements::<Face>(source, "face", |_, faces| {
        for face in faces {
            let i = triangles.len();
            let corners: Result<[u64; 3], _> = face.0.try_into();
            triangles.push(corners.map_err(|list: Vec<u64>| {
                Error::content(format!("PLY: face {i} has {} corners, not 3", list.len()))
            })?);
        }
        Ok(())
    })?;
    Ok(triangles)
}

pub(crate) fn write(out: &mut dyn Write, shape: &impl Shape) -> io::Result<()> {
    let (points, faces) = (shape.positions().count(), shape.triangles().count());
    header(out, points, Some(faces))?;
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

pub(crate) fn write_points<const D: usize>(out: &mut dyn Write, points: &[[f64; D]]) -> io::Result<()> {
    header(out, points.len(), None)?;
    points.iter().try_for_each(|p| write_position(out, in_space(p)))
}

fn header(out: &mut dyn Write, points: usize, faces: Option<usize>) -> io::Result<()> {
    write!(out, "ply\nformat binary_little_endian 1.0\nelement vertex {points}\n")?;
    write!(out, "property double x\nproperty double y\nproperty double z\n")?;
    if let Some(faces) = faces {
        write!(out, "element face {faces}\nproperty list uchar uint vertex_indices\n")?;
    }
    writeln!(out, "end_header")
}

fn write_position(out: &mut dyn Write, position: [f64; 3]) -> io::Result<()> {
    position.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))
}
