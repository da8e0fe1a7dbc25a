//! Well-known binary of geometries, plain or with the number of their system (EWKB), one after another; or the same in
//! hexadecimal digits, as databases print it. Read by the `wkb` crate.

use std::io::{self, Read, Write};

use geo_traits::{
    CoordTrait, Dimensions, GeometryCollectionTrait as _, GeometryTrait as _, GeometryType, LineStringTrait,
    MultiLineStringTrait as _, MultiPointTrait as _, MultiPolygonTrait as _, PointTrait, PolygonTrait,
};
use wkb::reader::Wkb;

use super::shapes::Shapes;
use crate::guard::decode;
use crate::{Cloud, Crs, Error, Graph, Shape, Source};

/// Reads the positions of all geometries, in their order.
pub(crate) fn read_points(source: Box<dyn Source>) -> Result<Cloud, Error> {
    let (shapes, crs) = read(source)?;
    Ok(Cloud { crs, ..shapes.cloud() })
}

/// Reads all geometries with the segments of their lines and rings.
pub(crate) fn read_graph(source: Box<dyn Source>) -> Result<Graph, Error> {
    let (shapes, crs) = read(source)?;
    let mut graph = shapes.graph()?;
    graph.cloud.crs = crs;
    Ok(graph)
}

/// Reads the rings of all polygons.
pub(crate) fn read_rings(source: Box<dyn Source>) -> Result<Vec<Vec<[f64; 2]>>, Error> {
    Ok(read(source)?.0.rings())
}

fn read(mut source: Box<dyn Source>) -> Result<(Shapes, Option<Crs>), Error> {
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes)?;
    let bytes = match digits(&bytes)? {
        Some(decoded) => decoded,
        None => bytes,
    };
    let mut shapes = Shapes::default();
    let mut crs: Option<Crs> = None;
    let mut at = 0;
    while at < bytes.len() {
        let wrong = |what: String| Error::content(format!("WKB: the geometry at byte {at}: {what}"));
        let rest = &bytes[at..];
        let system = system(rest);
        let size = decode("WKB", || {
            let geometry = Wkb::try_new(rest).map_err(|error| wrong(error.to_string()))?;
            collect(&geometry, &mut shapes);
            Ok(geometry.buf().len())
        })?;
        if let (Some(before), Some(now)) = (&crs, &system)
            && before != now
        {
            return Err(wrong(format!("its coordinates are {now}, those before it {before}")));
        }
        crs = crs.or(system);
        at += size.max(1);
    }
    Ok((shapes, crs))
}

/// The bytes that a text of hexadecimal digits stands for, geometries on lines of their own or not; `None` if it is binary.
fn digits(text: &[u8]) -> Result<Option<Vec<u8>>, Error> {
    // Binary begins with the order of bytes, 0 or 1.
    if !text
        .first()
        .is_some_and(|byte| byte.is_ascii_hexdigit() || byte.is_ascii_whitespace() || *byte == b'\\')
    {
        return Ok(None);
    }
    let mut bytes = Vec::with_capacity(text.len() / 2);
    for (i, line) in text.split(|&byte| byte == b'\n').enumerate() {
        let wrong = |what: &str| Error::Line { line: i + 1, what: what.to_owned() };
        let line = line.trim_ascii();
        let line = line.strip_prefix(b"\\x").unwrap_or(line);
        let (pairs, rest) = line.as_chunks::<2>();
        for pair in pairs {
            let pair = str::from_utf8(pair).ok().and_then(|pair| u8::from_str_radix(pair, 16).ok());
            bytes.push(pair.ok_or_else(|| wrong("it is neither well-known binary nor hexadecimal digits"))?);
        }
        if !rest.is_empty() {
            return Err(wrong("an odd number of hexadecimal digits"));
        }
    }
    Ok(Some(bytes))
}

/// In the kind of a geometry, whether the number of its system follows.
const WITH_SYSTEM: u32 = 1 << 29;

/// The system of a geometry, if it has one.
fn system(geometry: &[u8]) -> Option<Crs> {
    let number = |at: usize| {
        let bytes = geometry.get(at..at + 4)?.try_into().ok()?;
        Some(if geometry[0] == 0 { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) })
    };
    let number = if number(1)? & WITH_SYSTEM == 0 { None } else { number(5) };
    number.filter(|&number| number > 0).map(Crs::of_epsg)
}

fn collect(geometry: &Wkb, shapes: &mut Shapes) {
    match geometry.as_type() {
        GeometryType::Point(point) => dot(point, shapes),
        GeometryType::MultiPoint(points) => points.points().for_each(|point| dot(&point, shapes)),
        GeometryType::LineString(line) => chain(line, shapes),
        GeometryType::MultiLineString(lines) => lines.line_strings().for_each(|line| chain(&line, shapes)),
        GeometryType::Polygon(polygon) => area(polygon, shapes),
        GeometryType::MultiPolygon(polygons) => {
            polygons.polygons().for_each(|polygon| area(&polygon, shapes));
        }
        GeometryType::GeometryCollection(all) => all.geometries().for_each(|one| collect(one, shapes)),
        // Kinds that the format does not have.
        _ => {}
    }
}

fn dot(point: &impl PointTrait<T = f64>, shapes: &mut Shapes) {
    // A point without coordinates is an empty one.
    if let Some(at) = point.coord() {
        position(&at, shapes);
    }
}

fn position(at: &impl CoordTrait<T = f64>, shapes: &mut Shapes) {
    let high = matches!(at.dim(), Dimensions::Xyz | Dimensions::Xyzm);
    let z = if high { at.nth(2) } else { None };
    let numbers = [at.x(), at.y(), z.unwrap_or_default()];
    shapes.position(if z.is_some() { &numbers } else { &numbers[..2] });
}

fn chain(line: &impl LineStringTrait<T = f64>, shapes: &mut Shapes) {
    let start = shapes.len();
    line.coords().for_each(|at| position(&at, shapes));
    shapes.line(start);
}

fn area(polygon: &impl PolygonTrait<T = f64>, shapes: &mut Shapes) {
    shapes.polygon();
    for ring in polygon.exterior().into_iter().chain(polygon.interiors()) {
        let start = shapes.len();
        ring.coords().for_each(|at| position(&at, shapes));
        shapes.ring(start, false);
    }
}

/// Kinds of geometries, and what is added where they have heights.
const POLYGON: u32 = 3;
const MULTIPOINT: u32 = 4;
const COLLECTION: u32 = 7;
const POINT: u32 = 1;
const WITH_HEIGHTS: u32 = 1 << 31;

/// The first bytes of a geometry, little endian.
fn begin(out: &mut dyn Write, kind: u32, crs: Option<u32>) -> io::Result<()> {
    out.write_all(&[1])?;
    out.write_all(&(kind | crs.map_or(0, |_| WITH_SYSTEM)).to_le_bytes())?;
    crs.map_or(Ok(()), |number| out.write_all(&number.to_le_bytes()))
}

/// Writes a collection of triangles.
pub(crate) fn write(out: &mut dyn Write, shape: &impl Shape) -> io::Result<()> {
    let positions: Vec<_> = shape.positions().collect();
    let (width, high) = if shape.heights().is_some() { (3, WITH_HEIGHTS) } else { (2, 0) };
    begin(out, COLLECTION | high, shape.crs().and_then(|crs| crs.epsg))?;
    out.write_all(&(shape.triangles().count() as u32).to_le_bytes())?;
    for triangle in shape.triangles() {
        begin(out, POLYGON | high, None)?;
        // One ring of four positions.
        out.write_all(&[1_u32, 4].map(u32::to_le_bytes).concat())?;
        for corner in [0, 1, 2, 0] {
            let position = &positions[triangle[corner]][..width];
            position.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))?;
        }
    }
    Ok(())
}

pub(crate) fn write_points<const D: usize>(out: &mut dyn Write, points: &[[f64; D]]) -> io::Result<()> {
    let high = if D == 3 { WITH_HEIGHTS } else { 0 };
    begin(out, MULTIPOINT | high, None)?;
    out.write_all(&(points.len() as u32).to_le_bytes())?;
    for p in points {
        begin(out, POINT | high, None)?;
        p.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))?;
    }
    Ok(())
}
