//! Shapefiles: geometries in `.shp`, and beside it their attributes in `.dbf`, how letters are meant in `.cpg`, the system in `.prj`. The
//! index `.shx` is not needed: records are read one after another.
//!
//! Source: "ESRI Shapefile Technical Description", 1998. Read by hand, a record at a time, so that memory stays in
//! proportion to the file.

mod table;

use std::io::Read;

use self::table::{Rows, State};
use super::poly::Beside;
use super::shapes::Shapes;
use crate::rings::{Ring, polygons};
use crate::{Error, ReadOptions, Source};

/// The extensions of what lies beside.
pub(crate) const SIDES: &[&str] = &["dbf", "cpg", "prj"];

fn wrong(what: impl std::fmt::Display) -> Error {
    Error::content(format!("Shapefile: {what}"))
}

/// Kinds of records; with heights they are ten further, with measures alone twenty.
const NOTHING: u32 = 0;
const POINT: u32 = 1;
const LINE: u32 = 3;
const POLYGON: u32 = 5;
const POINTS: u32 = 8;
const PATCHES: u32 = 31;

/// Reads all records, in their order.
pub(crate) fn read(
    mut source: Box<dyn Source>,
    options: &ReadOptions,
    mut beside: Option<Beside>,
) -> Result<Shapes, Error> {
    let mut shapes = Shapes::new(options.attributes);
    let mut open = |extension: &str| match &mut beside {
        Some(beside) => beside(extension).ok(),
        None => None,
    };
    let mut text = |extension: &str| {
        /// No such file is longer.
        const LONGEST: u64 = 1 << 16;
        let mut bytes = Vec::new();
        open(extension)?.take(LONGEST).read_to_end(&mut bytes).ok()?;
        Some(String::from_utf8_lossy(&bytes).into_owned())
    };
    shapes.crs = text("prj").as_deref().and_then(crate::crs::esri::read);
    let page = text("cpg");
    let mut rows = open("dbf").map(|table| Rows::open(table, page.as_deref())).transpose()?;
    if rows.is_none() {
        shapes.remarks.push("no .dbf file was found beside it, and so there are no attributes".to_owned());
    }
    rows.iter().for_each(|rows| rows.declare(&mut shapes));
    check_head(&mut source)?;
    let (mut content, mut deleted, mut patches, mut without) = (Vec::new(), 0_usize, 0_usize, 0_usize);
    let mut number = 0_usize;
    while record(&mut source, &mut content)? {
        number += 1;
        let state = rows.as_mut().map_or(Ok(State::There), Rows::next)?;
        if state == State::Deleted {
            deleted += 1;
            continue;
        }
        let in_record = |what: String| wrong(format!("record {number}: {what}"));
        let mut record = Record { rest: &content };
        let kind = record.count().map_err(|what| in_record(what.to_owned()))?;
        if kind == PATCHES {
            patches += 1;
            continue;
        }
        shapes.feature();
        match &rows {
            Some(rows) if state == State::There => rows.take(&mut shapes),
            _ => without += usize::from(rows.is_some()),
        }
        record.take(kind, &mut shapes).map_err(in_record)?;
    }
    let losses = [
        (patches, "multipatches are left out: make polygons of them"),
        (without, "records have no row in the .dbf file"),
    ];
    let told = losses.iter().filter(|loss| loss.0 > 0);
    shapes.losses.extend(told.map(|(count, what)| format!("{count} {what}")));
    if deleted > 0 {
        shapes.remarks.push(format!("{deleted} records are deleted in the .dbf file, and left out"));
    }
    rows.iter().for_each(|rows| shapes.losses.extend(rows.losses()));
    Ok(shapes)
}

/// Reads the head: a hundred bytes, of which the first and the version are the same in all files.
fn check_head(source: &mut Box<dyn Source>) -> Result<(), Error> {
    const CODE: [u8; 4] = 9994_u32.to_be_bytes();
    let mut head = Vec::new();
    source.take(100).read_to_end(&mut head)?;
    if !head.starts_with(&CODE) {
        return Err(wrong("it does not begin as a .shp file does"));
    }
    if head.len() < 100 { Err(Error::Truncated("inside of its head".to_owned())) } else { Ok(()) }
}

/// Reads a record; false at the end of the file.
fn record(source: &mut Box<dyn Source>, content: &mut Vec<u8>) -> Result<bool, Error> {
    let mut head = Vec::new();
    source.take(8).read_to_end(&mut head)?;
    let cut = || Error::Truncated("inside of a record".to_owned());
    if head.is_empty() {
        return Ok(false);
    }
    let words: [u8; 4] = head.get(4..8).and_then(|words| words.try_into().ok()).ok_or_else(cut)?;
    // Lengths are those of 16-bit words.
    let length = 2 * u64::from(u32::from_be_bytes(words));
    content.clear();
    let read = source.take(length).read_to_end(content)?;
    if (read as u64) < length { Err(cut()) } else { Ok(true) }
}

/// The rest of a record.
struct Record<'a> {
    rest: &'a [u8],
}

impl<'a> Record<'a> {
    fn skip(&mut self, size: usize) -> Result<&'a [u8], &'static str> {
        let (bytes, rest) = self.rest.split_at_checked(size).ok_or("it ends inside of its geometry")?;
        self.rest = rest;
        Ok(bytes)
    }

    fn count(&mut self) -> Result<u32, &'static str> {
        Ok(u32::from_le_bytes(self.skip(4)?.try_into().unwrap_or_default()))
    }

    /// `count` items of a size.
    fn items<const N: usize>(&mut self, count: u32) -> Result<&'a [[u8; N]], &'static str> {
        let size = (count as usize).checked_mul(N).ok_or("it ends inside of its geometry")?;
        Ok(self.skip(size)?.as_chunks().0)
    }

    /// Takes the geometry of a kind.
    fn take(&mut self, kind: u32, shapes: &mut Shapes) -> Result<(), String> {
        /// The bytes of a box, and of the range of heights.
        const BOX: usize = 32;
        const RANGE: usize = 16;
        let (base, is_high) = (kind % 10, kind / 10 == 1);
        if kind > 28 || ![NOTHING, POINT, LINE, POLYGON, POINTS].contains(&base) || (base == 0 && kind > 0) {
            return Err(format!("its kind is {kind}, which is none"));
        }
        if base == NOTHING {
            return Ok(());
        }
        if base == POINT {
            let xy = self.items::<16>(1)?;
            let z = if is_high { self.items::<8>(1)? } else { &[] };
            positions(xy, z, shapes);
            return Ok(());
        }
        self.skip(BOX)?;
        let parts = if base == POINTS { 0 } else { self.count()? };
        let count = self.count()?;
        let starts = self.items::<4>(parts)?;
        let xy = self.items::<16>(count)?;
        let z = if is_high {
            self.skip(RANGE)?;
            self.items::<8>(count)?
        } else {
            &[]
        };
        if base == POINTS {
            positions(xy, z, shapes);
            return Ok(());
        }
        let starts: Vec<usize> = starts.iter().map(|&at| u32::from_le_bytes(at) as usize).collect();
        let ends = starts.iter().skip(1).copied().chain([xy.len()]);
        let ranges: Vec<_> = starts.iter().copied().zip(ends).map(|(start, end)| start..end).collect();
        let is_whole = ranges.first().is_none_or(|first| first.start == 0);
        if !is_whole || ranges.iter().any(|range| range.start > range.end || range.end > xy.len()) {
            return Err("its parts begin elsewhere than one after another".to_owned());
        }
        let height = |range: std::ops::Range<usize>| if z.is_empty() { z } else { &z[range] };
        if base == LINE {
            for range in ranges {
                let start = shapes.len();
                positions(&xy[range.clone()], height(range), shapes);
                shapes.line(start);
            }
            return Ok(());
        }
        let rings: Vec<Ring> =
            ranges.iter().map(|range| Ring::of(xy[range.clone()].iter().map(place).collect())).collect();
        // Outer rings are clockwise. Some programs write every ring in one direction.
        for polygon in polygons(&rings, |ring| rings[ring].is_counter_clockwise()) {
            shapes.polygon();
            for ring in polygon {
                let (start, range) = (shapes.len(), ranges[ring].clone());
                positions(&xy[range.clone()], height(range), shapes);
                shapes.ring(start, true);
            }
        }
        Ok(())
    }
}

fn number(bytes: &[u8]) -> f64 {
    bytes.try_into().map_or(f64::NAN, f64::from_le_bytes)
}

/// The coordinates of a position.
fn place(xy: &[u8; 16]) -> [f64; 2] {
    let (x, y) = xy.split_at(8);
    [number(x), number(y)]
}

/// Takes positions, with heights where there are any.
fn positions(xy: &[[u8; 16]], z: &[[u8; 8]], shapes: &mut Shapes) {
    for (i, xy) in xy.iter().enumerate() {
        let [x, y] = place(xy);
        match z.get(i) {
            Some(z) => shapes.position(&[x, y, number(z)]),
            None => shapes.position(&[x, y]),
        };
    }
}

#[cfg(test)]
mod tests;
