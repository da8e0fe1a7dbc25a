//! Layers of GeoPackage as shapes with attributes.

use rusqlite::types::ValueRef;
use rusqlite::{Connection, OptionalExtension, Row};

use super::database::{Database, MOST_IN_MEMORY, failed};
use crate::error::listed;
use crate::features::numbered;
use crate::formats::shapes::Shapes;
use crate::formats::wkb;
use crate::{Crs, Error, ReadOptions, Source, Value, guard};

fn wrong(what: impl std::fmt::Display) -> Error {
    Error::content(format!("GeoPackage: {what}"))
}

/// A table of features.
struct Layer {
    table: String,
    /// The column of the geometries.
    geometry: String,
    system: i64,
    /// The columns with what they are declared to be, but for the one that counts the rows.
    columns: Vec<Column>,
}

struct Column {
    name: String,
    is_bool: bool,
}

/// Reads all layers, in their order.
pub(crate) fn read(source: Box<dyn Source>, options: &ReadOptions) -> Result<Shapes, Error> {
    guard::decode("GeoPackage", || {
        let mut database = Database::open(source, MOST_IN_MEMORY)?;
        let layers = layers(&database.connection)?;
        let mut shapes = Shapes::new(options.attributes);
        let tag = match &layers[..] {
            [] => return Err(wrong("it has no layer of features")),
            [_] => None,
            several => {
                let names = several.iter().map(|layer| layer.table.as_str());
                let (tag, count) = (tag(several), names.len());
                shapes.remarks.push(format!(
                    "{count} layers were read as one, which the attribute {tag} names: {}",
                    listed(names)
                ));
                Some(tag)
            }
        };
        for layer in &layers {
            let system = system(&database.connection, layer.system).map_err(failed)?;
            if let (Some(ours), Some(theirs)) = (&shapes.crs, &system)
                && !ours.agrees(theirs)
            {
                let table = &layer.table;
                return Err(wrong(format!(
                    "the coordinates of layer {table} are {theirs}, those before it {ours}"
                )));
            }
            shapes.crs = shapes.crs.or(system);
            layer.read(&mut database, tag.as_deref(), &mut shapes)?;
        }
        Ok(shapes)
    })
}

/// The name of the attribute that tells the layer: one that no column has.
fn tag(layers: &[Layer]) -> String {
    const NAME: &str = "layer";
    let is_taken =
        |name: &str| layers.iter().flat_map(|layer| &layer.columns).any(|column| column.name == name);
    if is_taken(NAME) { numbered(NAME, is_taken) } else { NAME.to_owned() }
}

/// The layers of features, in the order of their registration.
fn layers(connection: &Connection) -> Result<Vec<Layer>, Error> {
    const KNOWN: &str = "SELECT count(*) FROM sqlite_schema WHERE name = 'gpkg_geometry_columns'";
    const ALL: &str = "SELECT table_name, column_name, srs_id FROM gpkg_geometry_columns";
    let known: i64 = connection.query_row(KNOWN, [], |row| row.get(0)).map_err(failed)?;
    if known == 0 {
        return Err(wrong("it is a database of SQLite without layers of features"));
    }
    let mut all = connection.prepare(ALL).map_err(failed)?;
    let mut rows = all.query([]).map_err(failed)?;
    let mut layers = Vec::new();
    while let Some(row) = rows.next().map_err(failed)? {
        let [table, geometry] = [0, 1].map(|at| row.get_ref(at).map(text));
        let (table, geometry) = (table.map_err(failed)?, geometry.map_err(failed)?);
        let system = row.get(2).unwrap_or_default();
        let columns = columns(connection, &table).map_err(failed)?;
        layers.push(Layer { table, geometry, system, columns });
    }
    Ok(layers)
}

/// A value as a text, whatever it is.
fn text(value: ValueRef) -> String {
    match value {
        ValueRef::Text(bytes) | ValueRef::Blob(bytes) => String::from_utf8_lossy(bytes).into_owned(),
        ValueRef::Integer(number) => number.to_string(),
        ValueRef::Real(number) => number.to_string(),
        ValueRef::Null => String::new(),
    }
}

/// The columns of a table but for its key, which counts the rows.
fn columns(connection: &Connection, table: &str) -> rusqlite::Result<Vec<Column>> {
    let mut all = connection.prepare("SELECT name, type, pk FROM pragma_table_info(?)")?;
    let mut rows = all.query([table])?;
    let mut columns = Vec::new();
    while let Some(row) = rows.next()? {
        let kind = text(row.get_ref(1)?).to_ascii_uppercase();
        let is_key = row.get_ref(2)? != ValueRef::Integer(0) && kind == "INTEGER";
        if !is_key {
            columns.push(Column { name: text(row.get_ref(0)?), is_bool: kind == "BOOLEAN" });
        }
    }
    Ok(columns)
}

/// The system of a number in the file: by its number in the registry, or its definition.
fn system(connection: &Connection, number: i64) -> rusqlite::Result<Option<Crs>> {
    const ALL: &str = "SELECT organization, organization_coordsys_id, definition FROM gpkg_spatial_ref_sys WHERE srs_id = ?";
    /// Of files that have definitions in version 2 too: these alone tell some systems.
    const SECOND: &str = "SELECT definition_12_063 FROM gpkg_spatial_ref_sys WHERE srs_id = ?";
    let own = |row: &Row| Ok((text(row.get_ref(0)?), row.get_ref(1)?.as_i64().ok(), text(row.get_ref(2)?)));
    let Some((authority, code, definition)) = connection.query_row(ALL, [number], own).optional()? else {
        return Ok(None);
    };
    let code = code.and_then(|code| u32::try_from(code).ok());
    let code = code.filter(|&code| code > 0 && authority.eq_ignore_ascii_case("EPSG"));
    let second = || connection.query_row(SECOND, [number], |row| Ok(text(row.get_ref(0)?))).ok();
    let of_text = Crs::of_wkt(&definition).or_else(|| Crs::of_wkt(&second()?));
    // What GDAL calls so is none.
    let is_one = |crs: &Crs| number > 0 && crs.name.as_deref() != Some("Undefined SRS");
    Ok(Crs::of_both(code, of_text.filter(is_one)))
}

impl Layer {
    /// Takes all features of the layer.
    fn read(&self, database: &mut Database, tag: Option<&str>, shapes: &mut Shapes) -> Result<(), Error> {
        let others: Vec<&Column> =
            self.columns.iter().filter(|column| !column.name.eq_ignore_ascii_case(&self.geometry)).collect();
        others.iter().for_each(|column| shapes.attribute(&column.name, Value::Null));
        let names = std::iter::once(&self.geometry).chain(others.iter().map(|column| &column.name));
        let names: Vec<String> = names.map(|name| quoted(name)).collect();
        let query = format!("SELECT {} FROM {}", names.join(","), quoted(&self.table));
        let mut all = database.connection.prepare(&query).map_err(failed)?;
        let mut rows = all.query([]).map_err(failed)?;
        let mut number = 0_usize;
        while let Some(row) = rows.next().map_err(failed)? {
            shapes.feature();
            if let Some(tag) = tag {
                shapes.attribute(tag, Value::Text(&self.table));
            }
            let mut size = 1;
            for (at, column) in others.iter().enumerate() {
                let value = row.get_ref(at + 1).map_err(failed)?;
                size += length(value);
                shapes.attribute(&column.name, column.value(value));
            }
            let value = row.get_ref(0).map_err(failed)?;
            size += length(value);
            database.most = database.most.checked_sub(size as u64).ok_or(Error::Expands)?;
            let in_layer = |what: String| wrong(format!("row {number} of layer {}: {what}", self.table));
            match value {
                ValueRef::Null => {}
                ValueRef::Blob(bytes) => geometry(bytes, shapes).map_err(in_layer)?,
                _ => return Err(in_layer("its geometry is none".to_owned())),
            }
            number += 1;
        }
        Ok(())
    }
}

impl Column {
    fn value<'a>(&self, value: ValueRef<'a>) -> Value<'a> {
        match value {
            ValueRef::Null => Value::Null,
            ValueRef::Integer(number @ 0..=1) if self.is_bool => Value::Bool(number == 1),
            ValueRef::Integer(number) => Value::Integer(number),
            ValueRef::Real(number) => Value::Number(number),
            ValueRef::Text(bytes) => match str::from_utf8(bytes) {
                Ok(text) => Value::Text(text),
                Err(_) => Value::Owned(String::from_utf8_lossy(bytes).into_owned()),
            },
            ValueRef::Blob(bytes) => Value::of_bytes(bytes),
        }
    }
}

/// The bytes of a value.
fn length(value: ValueRef) -> usize {
    match value {
        ValueRef::Text(bytes) | ValueRef::Blob(bytes) => bytes.len(),
        ValueRef::Null => 0,
        ValueRef::Integer(_) | ValueRef::Real(_) => 8,
    }
}

/// A name as SQL has it.
pub(super) fn quoted(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}

/// Takes a geometry: a head with flags and perhaps a box, then well-known binary.
fn geometry(bytes: &[u8], shapes: &mut Shapes) -> Result<(), String> {
    const MAGIC: &[u8] = b"GP";
    /// The version, the flags, and the number of the system.
    const HEAD: usize = MAGIC.len() + 1 + 1 + 4;
    /// The bytes of a box of each kind.
    const BOXES: [usize; 5] = [0, 32, 48, 48, 64];
    const EXTENDED: u8 = 1 << 5;
    let head = bytes.get(..HEAD).filter(|head| head.starts_with(MAGIC));
    let flags = head.ok_or("its geometry does not begin as those of GeoPackage do")?[3];
    if flags & EXTENDED != 0 {
        return Err("its geometry is of a kind that is an extension".to_owned());
    }
    let size = BOXES.get(usize::from(flags >> 1 & 7)).ok_or("its geometry has a box of no kind")?;
    let rest = bytes.get(HEAD + size..).ok_or("its geometry ends inside of its box")?;
    wkb::read_binary(rest, shapes)
}
