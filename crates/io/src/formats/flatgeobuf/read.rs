//! Features of FlatGeobuf as shapes with attributes.

use std::io::{self, BufRead, Read};

use super::tables::{BROKEN, Buffer, Table};
use super::{MAGIC, column, crs, feature, geometry, header, kind};
use crate::formats::shapes::Shapes;
use crate::{Crs, Error, ReadOptions, Source, Value};

fn wrong(what: impl std::fmt::Display) -> Error {
    Error::content(format!("FlatGeobuf: {what}"))
}

/// The header of a file.
struct Header {
    /// The kind of all geometries, 0 if each tells its own.
    geometry: u8,
    columns: Vec<Column>,
    /// How many features there are, 0 if that is not known.
    count: u64,
    /// The length of the index.
    index: u64,
    crs: Option<Crs>,
}

struct Column {
    name: String,
    kind: u8,
}

/// Reads all features, in their order.
pub(crate) fn read(mut source: Box<dyn Source>, options: &ReadOptions) -> Result<Shapes, Error> {
    let mut bytes = Vec::new();
    take(&mut source, 8, &mut bytes)?;
    if !bytes.starts_with(&MAGIC) {
        return Err(wrong("it does not begin as files of version 3 do"));
    }
    if !buffer(&mut source, &mut bytes)? {
        return Err(Error::Truncated("before its header".to_owned()));
    }
    let header = Header::read(&bytes)?;
    if io::copy(&mut (&mut source).take(header.index), &mut io::sink())? < header.index {
        return Err(Error::Truncated("inside of its index".to_owned()));
    }
    let mut shapes = Shapes::new(options.attributes);
    header.columns.iter().for_each(|column| shapes.attribute(&column.name, Value::Null));
    let mut number = 0;
    while buffer(&mut source, &mut bytes)? {
        if number == header.count && header.count > 0 {
            return Err(wrong(format!("more follows than the {number} features that it counts")));
        }
        header.feature(&bytes, &mut shapes).map_err(|what| wrong(format!("feature {number}: {what}")))?;
        number += 1;
    }
    if number < header.count {
        return Err(Error::Truncated(format!("after {number} of {} features", header.count)));
    }
    shapes.crs = header.crs;
    Ok(shapes)
}

/// Reads so many bytes, in memory as they come.
fn take(source: &mut impl BufRead, count: u64, bytes: &mut Vec<u8>) -> Result<(), Error> {
    bytes.clear();
    if (source.take(count).read_to_end(bytes)? as u64) < count {
        return Err(Error::Truncated("inside of its header or of a feature".to_owned()));
    }
    Ok(())
}

/// Reads a buffer with its length before it; false at the end of the file.
fn buffer(source: &mut impl BufRead, bytes: &mut Vec<u8>) -> Result<bool, Error> {
    if source.fill_buf()?.is_empty() {
        return Ok(false);
    }
    take(source, 4, bytes)?;
    let count = bytes.iter().rev().fold(0, |count, &byte| count << 8 | u64::from(byte));
    take(source, count, bytes)?;
    Ok(true)
}

impl Header {
    fn read(bytes: &[u8]) -> Result<Self, Error> {
        let in_header = |what: &str| wrong(format!("the header: {what}"));
        let table = Buffer::root(bytes).map_err(in_header)?;
        let (count, index) = size(table)?;
        let geometry = table.byte(header::GEOMETRY).map_err(in_header)?;
        let columns = columns(table, header::COLUMNS).map_err(in_header)?;
        Ok(Self { geometry, columns, count, index, crs: system(table).map_err(in_header)? })
    }

    /// Takes the attributes and the geometry of a feature.
    fn feature(&self, bytes: &[u8], shapes: &mut Shapes) -> Result<(), String> {
        let table = Buffer::root(bytes)?;
        shapes.feature();
        let own = columns(table, feature::COLUMNS)?;
        let columns = if own.is_empty() { &self.columns } else { &own };
        properties(columns, table.vector(feature::PROPERTIES, 1)?, shapes)?;
        if let Some(geometry) = table.table(feature::GEOMETRY)? {
            Geometries { shapes, room: bytes.len() }.take(geometry, self.geometry, DEEPEST)?;
        }
        Ok(())
    }
}

/// How many features there are, and the length of the index: nodes of 40 bytes, level over level.
fn size(table: Table) -> Result<(u64, u64), Error> {
    const NODE: u64 = 40;
    /// Entries of a node of the index, unless the header says otherwise.
    const DEFAULT_NODE_SIZE: u16 = 16;
    let numbers = || Ok((table.long(header::COUNT)?, table.short(header::NODE_SIZE)?));
    let (count, node) = numbers().map_err(|what: &str| wrong(format!("the header: {what}")))?;
    let node = u64::from(node.unwrap_or(DEFAULT_NODE_SIZE));
    if count == 0 || node == 0 {
        return Ok((count, 0));
    }
    if node < 2 {
        return Err(wrong("the nodes of its index have one entry each, and no end"));
    }
    let (mut level, mut nodes) = (count, count);
    while level > 1 {
        level = level.div_ceil(node);
        nodes = nodes.checked_add(level).ok_or_else(|| wrong(format!("{count} features fit no file")))?;
    }
    // One feature has a node above its own.
    nodes += u64::from(count == 1);
    let length = nodes.checked_mul(NODE).ok_or_else(|| wrong(format!("{count} features fit no file")))?;
    Ok((count, length))
}

fn columns(table: Table, field: usize) -> Result<Vec<Column>, &'static str> {
    let read = |table: Result<Table, &'static str>| {
        let table = table?;
        let name = table.text(column::NAME)?.unwrap_or_default();
        Ok(Column { name, kind: table.byte(column::KIND)? })
    };
    table.tables(field)?.map(read).collect()
}

/// The system by its number, its definition or its name.
fn system(table: Table) -> Result<Option<Crs>, &'static str> {
    let Some(table) = table.table(header::CRS)? else { return Ok(None) };
    let authority = table.text(crs::AUTHORITY)?.unwrap_or_default();
    let code = u32::try_from(table.int(crs::CODE)?).ok();
    let is_ours = authority.is_empty() || authority.eq_ignore_ascii_case("EPSG");
    let code = code.filter(|&code| code > 0 && is_ours);
    let of_text = table.text(crs::WKT)?.as_deref().and_then(Crs::of_wkt);
    let of_name = |name: String| Crs { name: Some(name), ..Crs::default() };
    Ok(match Crs::of_both(code, of_text) {
        Some(crs) => Some(crs),
        None => table.text(crs::NAME)?.filter(|name| !name.is_empty()).map(of_name),
    })
}

/// The first bytes of what is left.
fn first<const N: usize>(rest: &mut &[u8]) -> Result<[u8; N], &'static str> {
    let (bytes, more) = rest.split_first_chunk().ok_or("its properties end inside of a value")?;
    *rest = more;
    Ok(*bytes)
}

/// Takes properties: the number of a column and its value, again and again.
fn properties(columns: &[Column], mut rest: &[u8], shapes: &mut Shapes) -> Result<(), String> {
    while !rest.is_empty() {
        let number = usize::from(u16::from_le_bytes(first(&mut rest)?));
        let column = columns
            .get(number)
            .ok_or_else(|| format!("it has a value in column {number} of {}", columns.len()))?;
        shapes.attribute(&column.name, value(column.kind, &mut rest)?);
    }
    Ok(())
}

fn value<'a>(kind: u8, rest: &mut &'a [u8]) -> Result<Value<'a>, String> {
    Ok(match kind {
        kind::BYTE => Value::Integer(i8::from_le_bytes(first(rest)?).into()),
        kind::UBYTE => Value::Integer(u8::from_le_bytes(first(rest)?).into()),
        kind::BOOL => Value::Bool(first::<1>(rest)? != [0]),
        kind::SHORT => Value::Integer(i16::from_le_bytes(first(rest)?).into()),
        kind::USHORT => Value::Integer(u16::from_le_bytes(first(rest)?).into()),
        kind::INT => Value::Integer(i32::from_le_bytes(first(rest)?).into()),
        kind::UINT => Value::Integer(u32::from_le_bytes(first(rest)?).into()),
        kind::LONG => Value::Integer(i64::from_le_bytes(first(rest)?)),
        kind::ULONG => Value::of_whole(u64::from_le_bytes(first(rest)?)),
        kind::FLOAT => Value::Number(f32::from_le_bytes(first(rest)?).into()),
        kind::DOUBLE => Value::Number(f64::from_le_bytes(first(rest)?)),
        kind::STRING | kind::JSON | kind::DATE_TIME | kind::BINARY => {
            let length = u32::from_le_bytes(first(rest)?) as usize;
            let (bytes, more) = rest.split_at_checked(length).ok_or("its properties end inside of a text")?;
            *rest = more;
            match (kind, str::from_utf8(bytes)) {
                (kind::BINARY, _) => Value::of_bytes(bytes),
                (kind::JSON, Ok(text)) => Value::of_json(text),
                (_, Ok(text)) => Value::Text(text),
                (_, Err(_)) => Value::Owned(String::from_utf8_lossy(bytes).into_owned()),
            }
        }
        _ => return Err(format!("a column is of type {kind}, which is none")),
    })
}

/// Collections may be in each other so deep.
const DEEPEST: u32 = 32;

/// Kinds of geometries.
const POINT: u8 = 1;
const LINE: u8 = 2;
const POLYGON: u8 = 3;
const POINTS: u8 = 4;
const LINES: u8 = 5;
const POLYGONS: u8 = 6;
const COLLECTION: u8 = 7;
const ARC: u8 = 8;
const SURFACE: u8 = 15;
const TIN: u8 = 16;
const TRIANGLE: u8 = 17;

/// Takes geometries of a feature.
struct Geometries<'a> {
    shapes: &'a mut Shapes,
    /// How many bytes of the feature are left for geometries: parts that lead to one place again and again are no more than it holds.
    room: usize,
}

impl Geometries<'_> {
    /// Takes a geometry, of its own kind if none is given.
    fn take(&mut self, table: Table, kind: u8, depth: u32) -> Result<(), String> {
        let kind = if kind == 0 { table.byte(geometry::KIND)? } else { kind };
        let xy = table.vector(geometry::XY, 8)?;
        let ends = table.vector(geometry::ENDS, 4)?;
        // A table has eight bytes at least.
        let size = xy.len() + ends.len() + 8;
        self.room = self.room.checked_sub(size).ok_or("its geometries are more than it has bytes for")?;
        let positions = Positions::of(xy, table.vector(geometry::Z, 8)?)?;
        match kind {
            POINT | POINTS => self.positions(positions, 0..positions.len()),
            LINE | LINES => {
                for line in ranges(ends, positions.len()) {
                    let start = self.shapes.len();
                    self.positions(positions, line?);
                    self.shapes.line(start);
                }
            }
            POLYGON | TRIANGLE => {
                self.shapes.polygon();
                for ring in ranges(ends, positions.len()) {
                    let start = self.shapes.len();
                    self.positions(positions, ring?);
                    self.shapes.ring(start, false);
                }
            }
            POLYGONS | COLLECTION | SURFACE | TIN if depth > 0 => {
                let inside = match kind {
                    COLLECTION => 0,
                    TIN => TRIANGLE,
                    _ => POLYGON,
                };
                for part in table.tables(geometry::PARTS)? {
                    self.take(part?, inside, depth - 1)?;
                }
            }
            POLYGONS | COLLECTION | SURFACE | TIN => {
                return Err(format!("more than {DEEPEST} collections in each other"));
            }
            ARC..SURFACE => {
                return Err("it has arcs: make lines of them with ogr2ogr -nlt CONVERT_TO_LINEAR".to_owned());
            }
            _ => return Err(format!("its geometry is of kind {kind}, which is none")),
        }
        Ok(())
    }

    /// Takes positions; one without numbers is an empty point.
    fn positions(&mut self, positions: Positions, range: std::ops::Range<usize>) {
        for i in range {
            let (numbers, count) = positions.get(i);
            let numbers = &numbers[..count];
            if !numbers.iter().all(|number| number.is_nan()) {
                self.shapes.position(numbers);
            }
        }
    }
}

/// Positions of a geometry.
#[derive(Clone, Copy)]
struct Positions<'a> {
    xy: &'a [[u8; 16]],
    /// Nothing, or a height for each.
    z: &'a [[u8; 8]],
}

impl<'a> Positions<'a> {
    fn of(xy: &'a [u8], z: &'a [u8]) -> Result<Self, &'static str> {
        let ((xy, rest), (z, _)) = (xy.as_chunks(), z.as_chunks());
        if !rest.is_empty() {
            return Err("a position has one number alone");
        }
        if !z.is_empty() && z.len() != xy.len() {
            return Err("it has other than a height for each position");
        }
        Ok(Self { xy, z })
    }

    fn len(&self) -> usize {
        self.xy.len()
    }

    /// The numbers of a position, and how many there are.
    fn get(&self, i: usize) -> ([f64; 3], usize) {
        let number = |bytes: &[u8]| bytes.try_into().map_or(f64::NAN, f64::from_le_bytes);
        let (x, y) = self.xy[i].split_at(8);
        let z = self.z.get(i);
        ([number(x), number(y), z.map_or(0.0, |z| number(z))], if z.is_some() { 3 } else { 2 })
    }
}

/// The parts of positions, by where each ends; all of them where nothing is said.
fn ranges(ends: &[u8], count: usize) -> impl Iterator<Item = Result<std::ops::Range<usize>, &'static str>> {
    let all = (ends.is_empty() && count > 0).then_some(Ok(0..count));
    let mut start = 0;
    let ends = ends.as_chunks().0.iter().map(move |&end| {
        let end = u32::from_le_bytes(end) as usize;
        if end < start || end > count {
            return Err(BROKEN);
        }
        let range = start..end;
        start = end;
        Ok(range)
    });
    all.into_iter().chain(ends)
}
