//! Layers as FlatGeobuf, without an index.

use std::io::Write;

use super::tables::{Builder, Fields, OFFSET};
use super::{MAGIC, column, crs, feature, geometry, header, kind};
use crate::formats::vector::{Column, Form, Geometry, Kind, Layer, number};
use crate::{ColumnType, Crs, Error, Value};

/// Writes a layer.
pub(in crate::formats) fn write(out: &mut dyn Write, layer: &impl Layer) -> Result<(), Error> {
    let (columns, form, is_high) = (layer.columns(), layer.form(), layer.is_high());
    let mut builder = Builder::default();
    out.write_all(&MAGIC)?;
    out.write_all(&[0])?;
    write_header(&mut builder, layer, &columns, form);
    out.write_all(builder.finish())?;
    let mut properties = Vec::new();
    layer.each(&mut |geometry, values| {
        properties.clear();
        for (place, value) in values {
            property(&mut properties, place, columns[place].kind, &value);
        }
        write_feature(&mut builder, geometry, form, is_high, &properties);
        Ok(out.write_all(builder.finish())?)
    })
}

fn write_header(builder: &mut Builder, layer: &impl Layer, columns: &[Column], form: Option<Form>) {
    builder.begin();
    let mut sizes = [0; header::CRS + 1];
    let fields = [
        (header::NAME, OFFSET),
        (header::GEOMETRY, 1),
        (header::HAS_HEIGHTS, 1),
        (header::COUNT, 8),
        (header::NODE_SIZE, 2),
    ];
    fields.into_iter().for_each(|(field, size)| sizes[field] = size);
    sizes[header::COLUMNS] = if columns.is_empty() { 0 } else { OFFSET };
    sizes[header::CRS] = if layer.crs().is_some() { OFFSET } else { 0 };
    let fields = builder.table(Builder::ROOT, &sizes);
    builder.put(fields.at(header::GEOMETRY), &[form.map_or(0, Form::number)]);
    builder.put(fields.at(header::HAS_HEIGHTS), &[layer.is_high().into()]);
    builder.put(fields.at(header::COUNT), &(layer.count() as u64).to_le_bytes());
    builder.text(fields.at(header::NAME), layer.name());
    if !columns.is_empty() {
        let places = builder.tables(fields.at(header::COLUMNS), columns.len());
        for (place, column) in places.zip(columns) {
            let fields = builder.table(place, &[OFFSET, 1]);
            builder.put(fields.at(column::KIND), &[kind_of(column.kind)]);
            builder.text(fields.at(column::NAME), &column.name);
        }
    }
    if let Some(crs) = layer.crs() {
        write_system(builder, &fields, crs);
    }
}

fn kind_of(column: ColumnType) -> u8 {
    match column {
        ColumnType::Bool => kind::BOOL,
        ColumnType::Integer => kind::LONG,
        ColumnType::Number => kind::DOUBLE,
        ColumnType::Text => kind::STRING,
    }
}

/// Writes the number of a system, its name and its definition.
fn write_system(builder: &mut Builder, header: &Fields, system: &Crs) {
    let code = number(system);
    let mut sizes = [0; crs::WKT + 1];
    if code.is_some() {
        sizes[crs::AUTHORITY] = OFFSET;
        sizes[crs::CODE] = 4;
    }
    sizes[crs::NAME] = if system.name.is_some() { OFFSET } else { 0 };
    sizes[crs::WKT] = if system.wkt.is_some() { OFFSET } else { 0 };
    let fields = builder.table(header.at(header::CRS), &sizes);
    if let Some(code) = code {
        builder.put(fields.at(crs::CODE), &code.to_le_bytes());
        builder.text(fields.at(crs::AUTHORITY), "EPSG");
    }
    let texts = [(crs::NAME, &system.name), (crs::WKT, &system.wkt)];
    for (field, text) in texts {
        text.iter().for_each(|text| builder.text(fields.at(field), text));
    }
}

/// Appends the number of a column and its value; a value that is not of the type of its column is left out.
fn property(properties: &mut Vec<u8>, place: usize, column: ColumnType, value: &Value) {
    let start = properties.len();
    // Columns have numbers of 16 bits.
    let Ok(place) = u16::try_from(place) else { return };
    properties.extend(place.to_le_bytes());
    match (column, value) {
        (ColumnType::Bool, Value::Bool(is_so)) => properties.push(u8::from(*is_so)),
        (ColumnType::Integer, Value::Integer(number)) => properties.extend(number.to_le_bytes()),
        (ColumnType::Number, Value::Number(number)) => properties.extend(number.to_le_bytes()),
        (ColumnType::Number, Value::Integer(number)) => properties.extend((*number as f64).to_le_bytes()),
        (ColumnType::Text, value) => match value.text() {
            Some(text) => {
                properties.extend((text.len() as u32).to_le_bytes());
                properties.extend(text.as_bytes());
            }
            None => properties.truncate(start),
        },
        _ => properties.truncate(start),
    }
}

fn write_feature(
    builder: &mut Builder,
    geometry: &Geometry,
    form: Option<Form>,
    is_high: bool,
    properties: &[u8],
) {
    builder.begin();
    let sizes =
        [if geometry.count() == 0 { 0 } else { OFFSET }, if properties.is_empty() { 0 } else { OFFSET }];
    let fields = builder.table(Builder::ROOT, &sizes);
    if geometry.count() > 0 {
        write_geometry(builder, fields.at(feature::GEOMETRY), geometry, Form::of(geometry, form), is_high);
    }
    if !properties.is_empty() {
        builder.vector(fields.at(feature::PROPERTIES), properties.len(), 1);
        builder.push(properties);
    }
}

fn write_geometry(builder: &mut Builder, from: usize, geometry: &Geometry, form: Form, is_high: bool) {
    let kind = form.number();
    match form.kind {
        Kind::Point => write_positions(builder, from, kind, &geometry.positions, &[], is_high),
        Kind::Line => write_positions(builder, from, kind, &geometry.positions, &geometry.ends, is_high),
        Kind::Polygon if form.is_multiple => {
            let mut sizes = [0; geometry::PARTS + 1];
            sizes[geometry::KIND] = 1;
            sizes[geometry::PARTS] = OFFSET;
            let fields = builder.table(from, &sizes);
            builder.put(fields.at(geometry::KIND), &[kind]);
            let parts = builder.tables(fields.at(geometry::PARTS), geometry.count());
            for (i, place) in parts.enumerate() {
                write_polygon(builder, place, geometry, i, is_high);
            }
        }
        Kind::Polygon => write_polygon(builder, from, geometry, 0, is_high),
    }
}

fn write_polygon(builder: &mut Builder, from: usize, geometry: &Geometry, i: usize, is_high: bool) {
    let kind = Form { kind: Kind::Polygon, is_multiple: false }.number();
    let mut positions = Vec::new();
    let mut ends = Vec::new();
    for ring in geometry.rings(i) {
        positions.extend_from_slice(ring);
        ends.push(positions.len());
    }
    write_positions(builder, from, kind, &positions, &ends, is_high);
}

/// Writes positions, and where their parts end if there are several.
fn write_positions(
    builder: &mut Builder,
    from: usize,
    kind: u8,
    positions: &[[f64; 3]],
    ends: &[usize],
    is_high: bool,
) {
    let mut sizes = [0; geometry::KIND + 1];
    sizes[geometry::ENDS] = if ends.len() > 1 { OFFSET } else { 0 };
    sizes[geometry::XY] = OFFSET;
    sizes[geometry::Z] = if is_high { OFFSET } else { 0 };
    sizes[geometry::KIND] = 1;
    let fields = builder.table(from, &sizes);
    builder.put(fields.at(geometry::KIND), &[kind]);
    if ends.len() > 1 {
        builder.vector(fields.at(geometry::ENDS), ends.len(), 4);
        ends.iter().for_each(|&end| builder.push(&(end as u32).to_le_bytes()));
    }
    builder.vector(fields.at(geometry::XY), 2 * positions.len(), 8);
    positions.iter().flat_map(|p| &p[..2]).for_each(|x| builder.push(&x.to_le_bytes()));
    if is_high {
        builder.vector(fields.at(geometry::Z), positions.len(), 8);
        positions.iter().for_each(|p| builder.push(&p[2].to_le_bytes()));
    }
}
