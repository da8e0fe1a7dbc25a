//! GeoJSON, one document or many, or bare coordinates: read by the `geojson` crate; triangles are written as polygons.

use std::io::{self, Read, Write};

use delone::{Ring, Triangulation};
use geojson::feature::Id;
use geojson::{Feature, GeoJson, Geometry, GeometryValue, Position};

pub(crate) use self::properties::Properties;
use super::shapes::{Purpose, Shapes};
use crate::diagram::Tiles;
use crate::{Crs, Error, Mesh, ReadOptions, Shape, Source, Value};

mod contours;
mod coordinates;
mod properties;

pub(crate) use contours::write_contours;

/// Reads all geometries, in their order. Several documents may follow each other, as in text sequences and lines of GeoJSON.
pub(crate) fn read(
    mut source: Box<dyn Source>,
    options: &ReadOptions,
    purpose: Purpose,
) -> Result<Shapes, Error> {
    if is_bare(&mut source)? {
        return coordinates::read(source, purpose == Purpose::Points);
    }
    let documents = parse(source)?;
    let mut shapes = Shapes::new(options.attributes);
    documents.iter().try_for_each(|document| collect_document(document, &mut shapes))?;
    shapes.crs = documents.iter().find_map(system);
    Ok(shapes)
}

/// Whether a file begins as an array does, not as a document.
fn is_bare(source: &mut Box<dyn Source>) -> Result<bool, Error> {
    skip_mark(source)?;
    let first = source.fill_buf()?.iter().find(|byte| !byte.is_ascii_whitespace());
    Ok(first == Some(&b'['))
}

/// Passes over the sign that some programs begin UTF-8 with.
fn skip_mark(source: &mut Box<dyn Source>) -> Result<(), Error> {
    const MARK: &[u8] = b"\xef\xbb\xbf";
    if source.fill_buf()?.starts_with(MARK) {
        source.consume(MARK.len());
    }
    Ok(())
}

/// All documents of a file.
fn parse(source: Box<dyn Source>) -> Result<Vec<GeoJson>, Error> {
    let documents = serde_json::Deserializer::from_reader(Sequence(source)).into_iter();
    let documents: Result<Vec<GeoJson>, _> = documents.collect();
    let documents = documents.map_err(|error| Error::content(format!("GeoJSON: {error}")))?;
    if documents.is_empty() { Err(Error::content("GeoJSON: the file is empty")) } else { Ok(documents) }
}

/// A text sequence (RFC 8142) without the signs that begin its records.
struct Sequence(Box<dyn Source>);

impl Read for Sequence {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        const RECORD: u8 = 0x1e;
        let count = self.0.read(buffer)?;
        buffer[..count].iter_mut().filter(|byte| **byte == RECORD).for_each(|byte| *byte = b' ');
        Ok(count)
    }
}

/// The system that a document names, as it was usual before RFC 7946 and still is.
fn system(document: &GeoJson) -> Option<Crs> {
    let members = match document {
        GeoJson::Geometry(geometry) => &geometry.foreign_members,
        GeoJson::Feature(feature) => &feature.foreign_members,
        GeoJson::FeatureCollection(collection) => &collection.foreign_members,
    };
    Crs::of_name(members.as_ref()?.get("crs")?.get("properties")?.get("name")?.as_str()?)
}

/// The member that names a system, or has its definition as a name, which GDAL understands.
pub(crate) fn write_system(out: &mut dyn Write, crs: Option<&Crs>) -> io::Result<()> {
    match crs.and_then(Crs::known_name) {
        Some(name) => {
            let name = serde_json::Value::from(name);
            write!(out, r#""crs":{{"type":"name","properties":{{"name":{name}}}}},"#)
        }
        None => Ok(()),
    }
}

fn collect_document(content: &GeoJson, shapes: &mut Shapes) -> Result<(), Error> {
    match content {
        GeoJson::Geometry(geometry) => {
            shapes.feature();
            collect(geometry, shapes)
        }
        GeoJson::Feature(feature) => collect_feature(feature, shapes),
        GeoJson::FeatureCollection(collection) => {
            collection.features.iter().try_for_each(|feature| collect_feature(feature, shapes))
        }
    }
}

/// Takes the properties and the geometry of a feature; its identifier is a property too.
fn collect_feature(feature: &Feature, shapes: &mut Shapes) -> Result<(), Error> {
    /// Names of the column of identifiers; the first that no property has.
    const IDENTIFIERS: [&str; 2] = ["id", "fid"];
    shapes.feature();
    let identifier = match &feature.id {
        Some(Id::String(text)) => Some(serde_json::Value::from(text.as_str())),
        Some(Id::Number(number)) => Some(serde_json::Value::Number(number.clone())),
        None => None,
    };
    let has = |name: &str| feature.properties.iter().any(|properties| properties.contains_key(name));
    if let (Some(identifier), Some(name)) = (identifier, IDENTIFIERS.into_iter().find(|name| !has(name))) {
        shapes.attribute(name, Value::Json(&identifier.to_string()));
    }
    for (name, value) in feature.properties.iter().flatten() {
        let json = value.to_string();
        shapes.attribute(name, if value.is_null() { Value::Null } else { Value::Json(&json) });
    }
    feature.geometry.iter().try_for_each(|geometry| collect(geometry, shapes))
}

fn collect(geometry: &Geometry, shapes: &mut Shapes) -> Result<(), Error> {
    match &geometry.value {
        GeometryValue::Point { coordinates } => position(coordinates, shapes),
        GeometryValue::MultiPoint { coordinates } => positions(coordinates, shapes).map(|_| ()),
        GeometryValue::LineString { coordinates } => line(coordinates, shapes),
        GeometryValue::MultiLineString { coordinates } => {
            coordinates.iter().try_for_each(|each| line(each, shapes))
        }
        GeometryValue::Polygon { coordinates } => polygon(coordinates, shapes),
        GeometryValue::MultiPolygon { coordinates } => {
            coordinates.iter().try_for_each(|each| polygon(each, shapes))
        }
        GeometryValue::GeometryCollection { geometries } => {
            geometries.iter().try_for_each(|each| collect(each, shapes))
        }
    }
}

fn position(position: &Position, shapes: &mut Shapes) -> Result<(), Error> {
    let at = shapes.len();
    let is_whole = shapes.position(position.as_slice());
    let wrong = || Error::content(format!("GeoJSON: position {at} has fewer than two numbers"));
    is_whole.then_some(()).ok_or_else(wrong)
}

/// Takes positions, and tells where they begin.
fn positions(all: &[Position], shapes: &mut Shapes) -> Result<usize, Error> {
    let start = shapes.len();
    all.iter().try_for_each(|each| position(each, shapes))?;
    Ok(start)
}

fn line(all: &[Position], shapes: &mut Shapes) -> Result<(), Error> {
    let start = positions(all, shapes)?;
    shapes.line(start);
    Ok(())
}

fn polygon(rings: &[Vec<Position>], shapes: &mut Shapes) -> Result<(), Error> {
    shapes.polygon();
    for ring in rings {
        let start = positions(ring, shapes)?;
        shapes.ring(start, false);
    }
    Ok(())
}

/// Writes a feature for each cell, with what it is of and its area; without geometry where the cell is empty.
pub(crate) fn write_cells(out: &mut dyn Write, diagram: &impl Tiles) -> io::Result<()> {
    write!(out, "{{\"type\":\"FeatureCollection\",")?;
    write_system(out, diagram.crs())?;
    write!(out, "\"features\":[")?;
    let properties = diagram.table().map(|table| Properties::beside(table, &[diagram.property(), "area"]));
    for (i, tile) in diagram.tiles().enumerate() {
        write!(out, "{}\n{{\"type\":\"Feature\",\"properties\":{{", if i == 0 { "" } else { "," })?;
        write!(out, "\"{}\":", diagram.property())?;
        diagram.write_value(out, tile)?;
        let area = diagram.area(tile);
        // Beyond the range it is infinite, which JSON has no number for.
        let area = if area.is_finite() { format!("{area:?}") } else { "null".to_owned() };
        write!(out, ",\"area\":{area}")?;
        if let Some(properties) = &properties {
            properties.write(out, diagram.row(tile))?;
        }
        write!(out, "}},")?;
        let polygons = diagram.polygons(tile);
        match &polygons[..] {
            [] => write!(out, "\"geometry\":null}}")?,
            [polygon] => {
                write!(out, "\"geometry\":{{\"type\":\"Polygon\",\"coordinates\":")?;
                write_polygon(out, polygon)?;
                write!(out, "}}}}")?;
            }
            polygons => {
                write!(out, "\"geometry\":{{\"type\":\"MultiPolygon\",\"coordinates\":[")?;
                for (k, polygon) in polygons.iter().enumerate() {
                    write!(out, "{}", if k == 0 { "" } else { "," })?;
                    write_polygon(out, polygon)?;
                }
                write!(out, "]}}}}")?;
            }
        }
    }
    writeln!(out, "\n]}}")
}

fn write_polygon(out: &mut dyn Write, rings: &[Ring]) -> io::Result<()> {
    for (k, ring) in rings.iter().enumerate() {
        write!(out, "{}", if k == 0 { "[[" } else { ",[" })?;
        for (i, [x, y]) in ring.points().chain(ring.points().take(1)).enumerate() {
            write!(out, "{}[{x:?},{y:?}]", if i == 0 { "" } else { "," })?;
        }
        write!(out, "]")?;
    }
    write!(out, "]")
}

/// Writes a feature for each triangle, with the indices of its corners, its region, and the attributes of the polygon that it is in.
pub(crate) fn write(
    out: &mut dyn Write,
    mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>,
) -> io::Result<()> {
    write_triangles(out, mesh, |out, region| match region {
        region if region.is_finite() => write!(out, ",\"region\":{region:?}"),
        _ => write!(out, ",\"region\":null"),
    })
}

/// Writes a feature for each triangle of polygons, with the indices of its corners, its polygon and the attributes of that.
pub(crate) fn write_polygons(out: &mut dyn Write, shape: &impl Shape) -> io::Result<()> {
    write_triangles(out, shape, |out, polygon| write!(out, ",\"polygon\":{polygon}"))
}

/// Writes a feature for each triangle, with the indices of its corners and what its value tells.
fn write_triangles(
    out: &mut dyn Write,
    shape: &impl Shape,
    property: impl Fn(&mut dyn Write, f64) -> io::Result<()>,
) -> io::Result<()> {
    write!(out, "{{\"type\":\"FeatureCollection\",")?;
    write_system(out, shape.crs())?;
    write!(out, "\"features\":[")?;
    let positions: Vec<_> = shape.positions().collect();
    let mut values = shape.region_values();
    let properties = shape.table().map(|table| Properties::beside(table, &["vertices", "region", "polygon"]));
    let mut rows = shape.rows();
    for (i, triangle) in shape.triangles().enumerate() {
        let separator = if i == 0 { "" } else { "," };
        write!(out, "{separator}\n{{\"type\":\"Feature\",\"properties\":{{\"vertices\":{triangle:?}")?;
        if let Some(value) = values.as_mut().and_then(Iterator::next) {
            property(out, value)?;
        }
        if let Some(properties) = &properties {
            properties.write(out, rows.next().flatten())?;
        }
        write!(out, "}},")?;
        write!(out, "\"geometry\":{{\"type\":\"Polygon\",\"coordinates\":[[")?;
        for (k, corner) in [0, 1, 2, 0].into_iter().enumerate() {
            let [x, y, z] = positions[triangle[corner]];
            let separator = if k == 0 { "" } else { "," };
            match shape.heights() {
                Some(_) => write!(out, "{separator}[{x:?},{y:?},{z:?}]")?,
                None => write!(out, "{separator}[{x:?},{y:?}]")?,
            }
        }
        write!(out, "]]}}}}")?;
    }
    writeln!(out, "\n]}}")
}

pub(crate) fn write_points<const D: usize>(out: &mut dyn Write, points: &[[f64; D]]) -> io::Result<()> {
    write!(out, "{{\"type\":\"MultiPoint\",\"coordinates\":[")?;
    for (i, p) in points.iter().enumerate() {
        write!(out, "{}\n[", if i == 0 { "" } else { "," })?;
        for (k, x) in p.iter().enumerate() {
            write!(out, "{}{x:?}", if k > 0 { "," } else { "" })?;
        }
        write!(out, "]")?;
    }
    writeln!(out, "\n]}}")
}
