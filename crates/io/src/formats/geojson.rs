//! GeoJSON, one document or many: points are read by the `geojson` crate, triangles written as polygons.

use std::io::{self, Read, Write};

use delone::{Ring, Triangulation};
use geojson::{GeoJson, Geometry, GeometryValue};

use crate::{Cloud, Crs, Diagram, Error, Mesh, Shape, Source};

/// Reads the positions of all geometries, in their order; the last of a ring, which is the first again, is left out.
/// Several documents may follow each other, as in text sequences and lines of GeoJSON.
pub(crate) fn read(source: Box<dyn Source>) -> Result<Cloud, Error> {
    let documents = parse(source)?;
    let mut found = Found::default();
    let all = documents.iter().flat_map(geometries);
    all.for_each(|geometry| found.collect(geometry));
    let positions = found.positions;
    let high = positions.iter().filter(|p| p.len() > 2).count();
    let with_heights = high > 0 && high == positions.len();
    let mut cloud = Cloud::with_capacity(positions.len(), with_heights);
    for (i, position) in positions.into_iter().enumerate() {
        let &[x, y, ..] = position else {
            return Err(Error::content(format!("GeoJSON: position {i} has fewer than two numbers")));
        };
        cloud.push([x, y], position.get(2).copied().unwrap_or_default());
    }
    if high > 0 && !with_heights {
        cloud.remarks.push("heights are left out: not all positions have them".to_owned());
    }
    if found.shapes > 0 {
        cloud
            .remarks
            .push(format!("the corners of {} lines and polygons were taken as points", found.shapes));
    }
    cloud.crs = documents.iter().find_map(system);
    Ok(cloud)
}

/// All documents of a file.
fn parse(mut source: Box<dyn Source>) -> Result<Vec<GeoJson>, Error> {
    const MARK: &[u8] = b"\xef\xbb\xbf";
    if source.fill_buf()?.starts_with(MARK) {
        source.consume(MARK.len());
    }
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

/// The member that names a system.
fn write_system(out: &mut dyn Write, crs: Option<&Crs>) -> io::Result<()> {
    match crs.and_then(Crs::urn) {
        Some(name) => write!(out, r#""crs":{{"type":"name","properties":{{"name":"{name}"}}}},"#),
        None => Ok(()),
    }
}

fn geometries(content: &GeoJson) -> Vec<&Geometry> {
    match content {
        GeoJson::Geometry(geometry) => vec![geometry],
        GeoJson::Feature(feature) => feature.geometry.iter().collect(),
        GeoJson::FeatureCollection(collection) => {
            collection.features.iter().filter_map(|feature| feature.geometry.as_ref()).collect()
        }
    }
}

/// Positions, and how many lines and polygons they are the corners of.
#[derive(Default)]
struct Found<'a> {
    positions: Vec<&'a [f64]>,
    shapes: usize,
}

impl<'a> Found<'a> {
    fn collect(&mut self, geometry: &'a Geometry) {
        match &geometry.value {
            GeometryValue::Point { coordinates } => self.positions.push(coordinates.as_slice()),
            GeometryValue::MultiPoint { coordinates } => self.line(coordinates),
            GeometryValue::LineString { coordinates } => {
                self.shapes += 1;
                self.line(coordinates);
            }
            GeometryValue::MultiLineString { coordinates } => {
                self.shapes += coordinates.len();
                coordinates.iter().for_each(|line| self.line(line));
            }
            GeometryValue::Polygon { coordinates } => self.polygon(coordinates),
            GeometryValue::MultiPolygon { coordinates } => {
                coordinates.iter().for_each(|polygon| self.polygon(polygon));
            }
            GeometryValue::GeometryCollection { geometries } => {
                geometries.iter().for_each(|g| self.collect(g));
            }
        }
    }

    fn line(&mut self, positions: &'a [geojson::Position]) {
        self.positions.extend(positions.iter().map(|p| p.as_slice()));
    }

    fn polygon(&mut self, rings: &'a [Vec<geojson::Position>]) {
        self.shapes += 1;
        for ring in rings {
            match ring.split_last() {
                Some((last, rest)) if rest.first() == Some(last) => self.line(rest),
                _ => self.line(ring),
            }
        }
    }
}

/// Reads the rings of all Polygon and MultiPolygon geometries.
pub(crate) fn read_rings(source: Box<dyn Source>) -> Result<Vec<Vec<[f64; 2]>>, Error> {
    let documents = parse(source)?;
    let mut rings = Vec::new();
    for geometry in documents.iter().flat_map(geometries) {
        match &geometry.value {
            GeometryValue::Polygon { coordinates } => rings.extend(coordinates),
            GeometryValue::MultiPolygon { coordinates } => rings.extend(coordinates.iter().flatten()),
            _ => {}
        }
    }
    let corner = |position: &geojson::Position| match position.as_slice() {
        &[x, y, ..] => Ok([x, y]),
        _ => Err(Error::content("GeoJSON: a position has fewer than two numbers")),
    };
    rings.into_iter().map(|ring| ring.iter().map(corner).collect()).collect()
}

/// Writes a feature for each site, with its index and the area of its cell; without geometry where the cell is
/// empty.
pub(crate) fn write_cells(
    out: &mut dyn Write,
    diagram: &Diagram<impl Triangulation<Point = [f64; 2]>>,
) -> io::Result<()> {
    write!(out, "{{\"type\":\"FeatureCollection\",")?;
    write_system(out, diagram.crs)?;
    write!(out, "\"features\":[")?;
    for (i, v) in diagram.triangulation.vertices().enumerate() {
        let (separator, site, area) = (if i == 0 { "" } else { "," }, v.index(), diagram.cells.area(v));
        // Beyond the range it is infinite, which JSON has no number for.
        let area = if area.is_finite() { format!("{area:?}") } else { "null".to_owned() };
        write!(
            out,
            "{separator}\n{{\"type\":\"Feature\",\"properties\":{{\"site\":{site},\"area\":{area}}},"
        )?;
        let polygons = diagram.polygons(v);
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

/// Writes a feature for each triangle, with the indices of its corners.
pub(crate) fn write(
    out: &mut dyn Write,
    mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>,
) -> io::Result<()> {
    write!(out, "{{\"type\":\"FeatureCollection\",")?;
    write_system(out, mesh.crs)?;
    write!(out, "\"features\":[")?;
    let positions: Vec<_> = mesh.positions().collect();
    for (i, triangle) in mesh.triangles().enumerate() {
        let separator = if i == 0 { "" } else { "," };
        write!(out, "{separator}\n{{\"type\":\"Feature\",\"properties\":{{\"vertices\":{triangle:?}}},")?;
        write!(out, "\"geometry\":{{\"type\":\"Polygon\",\"coordinates\":[[")?;
        for (k, corner) in [0, 1, 2, 0].into_iter().enumerate() {
            let [x, y, z] = positions[triangle[corner]];
            let separator = if k == 0 { "" } else { "," };
            match mesh.heights {
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
