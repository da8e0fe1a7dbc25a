//! Layers of features as databases and their like hold them: a geometry each, and values in typed columns. Whatever is written to such
//! formats is a [`Layer`], and each of the formats writes any layer.

mod layers;

use std::io::Write;

use super::{flatgeobuf, geopackage};
use crate::{ColumnType, Crs, Error, Format, Table, Value};

pub(crate) use layers::{Answered, Cells, Edged, Graphs, LinesOf, Points, Triangles};

/// A column of a layer.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Column {
    pub(crate) name: String,
    pub(crate) kind: ColumnType,
}

impl Column {
    fn new(name: &str, kind: ColumnType) -> Self {
        Self { name: name.to_owned(), kind }
    }
}

/// Appends the columns of a table, under the names that they have beside those of ours.
fn beside(mut ours: Vec<Column>, table: Option<&Table>) -> Vec<Column> {
    if let Some(table) = table {
        let names = table.names_beside(&ours.iter().map(|column| column.name.as_str()).collect::<Vec<_>>());
        ours.extend(names.into_iter().zip(table.types()).map(|(name, kind)| Column { name, kind }));
    }
    ours
}

/// The values of a row in a table whose columns are beside so many of ours.
fn cells(table: Option<&Table>, row: Option<usize>, ours: usize) -> impl Iterator<Item = (usize, Value<'_>)> {
    let cells = table.zip(row).into_iter().flat_map(|(table, row)| table.row(row));
    cells.map(move |(column, cell)| (ours + column, Value::of(cell)))
}

/// The number of a system in the EPSG registry, where it says all of the system: of one with heights the number is that of a part, and
/// the definition tells more, if there is one.
pub(super) fn number(crs: &Crs) -> Option<u32> {
    const DEGREES: u32 = 4326;
    let number = if crs.is_plain_degrees() { Some(DEGREES) } else { crs.epsg };
    number.filter(|_| crs.vertical.is_none() || crs.wkt.is_none())
}

/// The kind of a geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Kind {
    #[default]
    Point,
    Line,
    Polygon,
}

/// The geometry of a feature: points, lines or polygons, none or one or many.
#[derive(Debug, Default)]
pub(crate) struct Geometry {
    pub(crate) kind: Kind,
    /// The positions of all parts; rings end where they begin. The third number is nothing in layers of the plane.
    pub(crate) positions: Vec<[f64; 3]>,
    /// Where each line or ring ends among the positions.
    pub(crate) ends: Vec<usize>,
    /// Where each polygon ends among the rings.
    pub(crate) polygons: Vec<usize>,
}

impl Geometry {
    /// Begins another geometry in the same memory.
    pub(crate) fn clear(&mut self, kind: Kind) {
        self.kind = kind;
        self.positions.clear();
        self.ends.clear();
        self.polygons.clear();
    }

    /// Ends a line or ring with the positions so far.
    fn end_line(&mut self) {
        self.ends.push(self.positions.len());
    }

    /// Ends a ring: its first position comes again.
    fn end_ring(&mut self) {
        let start = self.ends.last().copied().unwrap_or(0);
        self.positions.extend(self.positions.get(start).copied());
        self.end_line();
    }

    /// Ends a polygon with the rings so far.
    fn end_polygon(&mut self) {
        self.polygons.push(self.ends.len());
    }

    /// How many points, lines or polygons there are.
    pub(crate) fn count(&self) -> usize {
        match self.kind {
            Kind::Point => self.positions.len(),
            Kind::Line => self.ends.len(),
            Kind::Polygon => self.polygons.len(),
        }
    }

    /// The positions of a line or ring.
    pub(crate) fn line(&self, i: usize) -> &[[f64; 3]] {
        &self.positions[start(&self.ends, i)..self.ends[i]]
    }

    /// The rings of a polygon.
    pub(crate) fn rings(&self, i: usize) -> impl ExactSizeIterator<Item = &[[f64; 3]]> {
        (start(&self.polygons, i)..self.polygons[i]).map(|ring| self.line(ring))
    }
}

/// Where a part begins, by the ends of all.
fn start(ends: &[usize], i: usize) -> usize {
    i.checked_sub(1).map_or(0, |before| ends[before])
}

/// The form of all geometries of a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Form {
    pub(crate) kind: Kind,
    /// Several of them may be one geometry, and so each is written as several.
    pub(crate) is_multiple: bool,
}

impl Form {
    /// The form in which a geometry is written: that of its layer, or its own.
    pub(crate) fn of(geometry: &Geometry, layer: Option<Self>) -> Self {
        layer.unwrap_or(Self { kind: geometry.kind, is_multiple: geometry.count() > 1 })
    }

    /// The number that well-known binary and its relatives have for it.
    pub(crate) fn number(self) -> u8 {
        let kind = match self.kind {
            Kind::Point => 1,
            Kind::Line => 2,
            Kind::Polygon => 3,
        };
        if self.is_multiple { kind + 3 } else { kind }
    }
}

/// Takes a feature: its geometry, and the values that it has, each with its column.
pub(crate) type Take<'a> =
    &'a mut dyn FnMut(&Geometry, &mut dyn Iterator<Item = (usize, Value)>) -> Result<(), Error>;

/// Features to be written.
pub(crate) trait Layer {
    /// Its name.
    fn name(&self) -> &'static str;

    /// The columns of all features.
    fn columns(&self) -> Vec<Column>;

    /// The form of all geometries; `None` if there are several.
    fn form(&self) -> Option<Form>;

    /// Whether positions have a third number.
    fn is_high(&self) -> bool;

    /// The system of coordinates.
    fn crs(&self) -> Option<&Crs>;

    /// How many features there are.
    fn count(&self) -> usize;

    /// Gives all features, in their order.
    fn each(&self, take: Take) -> Result<(), Error>;
}

/// Writes a layer in a format of layers.
pub(crate) fn write(out: &mut dyn Write, format: Format, layer: &impl Layer) -> Result<(), Error> {
    match format {
        Format::GeoPackage => geopackage::write(out, &[layer]),
        _ => flatgeobuf::write(out, layer),
    }
}
