//! Stanford polygons: read by the `ply-rs-bw` crate, ascii and binary; written in binary.

use std::io::{self, BufRead, Write};

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{DefaultElement, Header, Property, PropertyAccess, PropertyAccessResult};

use crate::{Cloud, Error, Source, Surface};

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

/// Reads the elements of one name into `E`, and those before it into nothing.
fn elements<E: PropertyAccess>(source: impl BufRead, name: &str) -> Result<(Header, Vec<E>), Error> {
    let mut reader = Reader::new(source);
    let skipper = Parser::<DefaultElement>::new();
    let header = skipper.read_header(&mut reader).map_err(broken)?;
    let mut found = Vec::new();
    for element in header.elements.values() {
        if element.name == name {
            found =
                Parser::<E>::new().read_payload_for_element(&mut reader, element, &header).map_err(broken)?;
            break;
        }
        skipper.read_payload_for_element(&mut reader, element, &header).map_err(broken)?;
    }
    Ok((header, found))
}

pub(crate) fn read_points(source: Box<dyn Source>) -> Result<Cloud, Error> {
    let (header, vertices) = elements::<Vertex>(source, "vertex")?;
    let has = |axis: &str| {
        header.elements.get("vertex").is_some_and(|element| element.properties.contains_key(axis))
    };
    if !has("x") || !has("y") {
        return Err(Error::content("PLY: there is no element vertex with properties x and y"));
    }
    let mut cloud = Cloud::with_capacity(vertices.len(), has("z"));
    vertices.iter().for_each(|&Vertex([x, y, z])| cloud.push([x, y], z));
    Ok(cloud)
}

pub(crate) fn read_triangles(source: Box<dyn Source>) -> Result<Vec<[u64; 3]>, Error> {
    let (_, faces) = elements::<Face>(source, "face")?;
    let triangle = |(i, face): (usize, Face)| {
        let corners: Result<[u64; 3], _> = face.0.try_into();
        corners.map_err(|list: Vec<u64>| {
            Error::content(format!("PLY: face {i} has {} corners, not 3", list.len()))
        })
    };
    faces.into_iter().enumerate().map(triangle).collect()
}

pub(crate) fn write(out: &mut dyn Write, surface: &Surface) -> io::Result<()> {
    let (points, faces) = (surface.triangulation.points().len(), surface.triangles().count());
    header(out, points, Some(faces))?;
    for position in surface.positions() {
        write_position(out, position)?;
    }
    for triangle in surface.triangles() {
        out.write_all(&[3])?;
        for corner in triangle {
            out.write_all(&(corner as u32).to_le_bytes())?;
        }
    }
    Ok(())
}

pub(crate) fn write_points(out: &mut dyn Write, points: &[[f64; 2]]) -> io::Result<()> {
    header(out, points.len(), None)?;
    points.iter().try_for_each(|&[x, y]| write_position(out, [x, y, 0.0]))
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
