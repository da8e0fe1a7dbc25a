//! GeoJSON: points are read by the `geojson` crate, triangles written as polygons.

use std::io::{self, Write};

use delone::Ring;
use geojson::{GeoJson, Geometry, GeometryValue};

use crate::{Cloud, Diagram, Error, Shape, Source, Surface};

/// Reads the positions of all Point and MultiPoint geometries, in their order.
pub(crate) fn read(source: Box<dyn Source>) -> Result<Cloud, Error> {
    let content = parse(source)?;
    let mut positions = Vec::new();
    geometries(&content).into_iter().for_each(|geometry| collect(geometry, &mut positions));
    let with_heights = !positions.is_empty() && positions.iter().all(|p| p.len() > 2);
    let mut cloud = Cloud::with_capacity(positions.len(), with_heights);
    for (i, position) in positions.into_iter().enumerate() {
        let &[x, y, ..] = position else {
            return Err(Error::content(format!("GeoJSON: position {i} has fewer than two numbers")));
        };
        cloud.push([x, y], position.get(2).copied().unwrap_or_default());
    }
    Ok(cloud)
}

fn parse(source: Box<dyn Source>) -> Result<GeoJson, Error> {
    GeoJson::from_reader(source).map_err(|error| Error::content(format!("GeoJSON: {error}")))
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

/// Reads the rings of all Polygon and MultiPolygon geometries.
pub(crate) fn read_rings(source: Box<dyn Source>) -> Result<Vec<Vec<[f64; 2]>>, Error> {
    let content = parse(source)?;
    let mut rings = Vec::new();
    for geometry in geometries(&content) {
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
pub(crate) fn write_cells(out: &mut dyn Write, diagram: &Diagram) -> io::Result<()> {
    write!(out, "{{\"type\":\"FeatureCollection\",\"features\":[")?;
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

fn collect<'a>(geometry: &'a Geometry, positions: &mut Vec<&'a [f64]>) {
    match &geometry.value {
        GeometryValue::Point { coordinates } => positions.push(coordinates.as_slice()),
        GeometryValue::MultiPoint { coordinates } => {
            positions.extend(coordinates.iter().map(|p| p.as_slice()));
        }
        GeometryValue::GeometryCollection { geometries } => {
            geometries.iter().for_each(|g| collect(g, positions));
        }
        _ => {}
    }
}

/// Writes a feature for each triangle, with the indices of its corners.
pub(crate) fn write(out: &mut dyn Write, surface: &Surface) -> io::Result<()> {
    write!(out, "{{\"type\":\"FeatureCollection\",\"features\":[")?;
    let positions: Vec<_> = surface.positions().collect();
    for (i, triangle) in surface.triangles().enumerate() {
        let separator = if i == 0 { "" } else { "," };
        write!(out, "{separator}\n{{\"type\":\"Feature\",\"properties\":{{\"vertices\":{triangle:?}}},")?;
        write!(out, "\"geometry\":{{\"type\":\"Polygon\",\"coordinates\":[[")?;
        for (k, corner) in [0, 1, 2, 0].into_iter().enumerate() {
            let [x, y, z] = positions[triangle[corner]];
            let separator = if k == 0 { "" } else { "," };
            match surface.heights {
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
