//! GeoJSON: points are read by the `geojson` crate, triangles written as polygons.

use std::io::{self, Write};

use geojson::{GeoJson, Geometry, GeometryValue};

use crate::{Cloud, Error, Source, Surface};

/// Reads the positions of all Point and MultiPoint geometries, in their order.
pub(crate) fn read(source: Box<dyn Source>) -> Result<Cloud, Error> {
    let content =
        GeoJson::from_reader(source).map_err(|error| Error::content(format!("GeoJSON: {error}")))?;
    let mut positions = Vec::new();
    match &content {
        GeoJson::Geometry(geometry) => collect(geometry, &mut positions),
        GeoJson::Feature(feature) => feature.geometry.iter().for_each(|g| collect(g, &mut positions)),
        GeoJson::FeatureCollection(collection) => {
            let geometries = collection.features.iter().filter_map(|feature| feature.geometry.as_ref());
            geometries.for_each(|g| collect(g, &mut positions));
        }
    }
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

pub(crate) fn write_points(out: &mut dyn Write, points: &[[f64; 2]]) -> io::Result<()> {
    write!(out, "{{\"type\":\"MultiPoint\",\"coordinates\":[")?;
    for (i, [x, y]) in points.iter().enumerate() {
        let separator = if i == 0 { "" } else { "," };
        write!(out, "{separator}\n[{x:?},{y:?}]")?;
    }
    writeln!(out, "\n]}}")
}
