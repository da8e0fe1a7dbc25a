//! Names of regions and boundaries: of options, of files, and of features.

use std::collections::{BTreeMap, BTreeSet};

use delone_io::{Graph, Names, Table, Value};

use super::names::{Content, Target};
use crate::args::MeshArgs;
use crate::constrained::features::rows_of_lines;
use crate::constrained::tell_names;
use crate::files;
use crate::message::{Failure, warn};

/// The attribute that is the name of a feature if no other one is asked for.
const NAME_COLUMN: &str = "name";

/// The first marker of named lines: 1 is that of the border without names.
const FIRST_MARKER: i64 = 2;

/// Numbers that a warning lists; more are counted.
const LISTED_NUMBERS: usize = 20;

/// The names of a mesh.
pub(super) struct Naming {
    /// All of them.
    pub(super) names: Names,
    /// Those that options and files say.
    said: Names,
    /// The region of each feature whose polygon has the name of one before it.
    joined: BTreeMap<usize, f64>,
}

impl Naming {
    /// Finds the names. Lines that have names get markers, if they have none.
    pub(super) fn of(args: &MeshArgs, graph: &mut Graph) -> Result<Self, Failure> {
        let mut said = Names::default();
        let refused = |error: delone_io::Error| Failure::usage(error.to_string(), error.help());
        for (marker, name) in &args.boundary {
            said.name_boundary(*marker, name).map_err(refused)?;
        }
        for (number, name) in &args.region {
            said.name_region(*number, name).map_err(refused)?;
        }
        said.complete(&graph.names).map_err(refused)?;
        let mut naming = Self { names: said.clone(), said, joined: BTreeMap::new() };
        let Some(column) = column(args.names.as_deref(), &graph.cloud.features.table)? else {
            return Ok(naming);
        };
        files::heed_naming(&graph.cloud.features.table.names()[column.place]);
        naming.name_polygons(graph, &column).map_err(refused)?;
        naming.name_lines(graph, &column).map_err(refused)?;
        Ok(naming)
    }

    /// Polygons of one name are one region, which has the number of the first of them.
    fn name_polygons(&mut self, graph: &Graph, column: &Column) -> Result<(), delone_io::Error> {
        let table = &graph.cloud.features.table;
        let rows: BTreeSet<usize> = graph.rings.iter().filter_map(|ring| graph.row_of(ring)).collect();
        if !graph.regions.is_empty() {
            return Ok(());
        }
        let mut first: BTreeMap<String, usize> = BTreeMap::new();
        for row in rows {
            let Some(name) = column.name(table, row) else { continue };
            let number = *first.entry(name.clone()).or_insert(row + 1) as f64;
            self.joined.insert(row + 1, number);
            if self.names.region(number).is_none() {
                self.names.name_region(number, &name)?;
            }
        }
        Ok(())
    }

    /// Each name of lines has a marker that nothing else has, in the order of the lines.
    fn name_lines(&mut self, graph: &mut Graph, column: &Column) -> Result<(), delone_io::Error> {
        let rows = rows_of_lines(graph);
        let table = &graph.cloud.features.table;
        let of_segments: Vec<Option<String>> = rows.into_iter().map(|row| column.name(table, row?)).collect();
        if of_segments.iter().all(Option::is_none) {
            return Ok(());
        }
        let markers = graph.markers.get_or_insert_with(|| vec![0; graph.segments.len()]);
        let named = self.names.boundaries().iter();
        let taken: BTreeSet<i64> =
            markers.iter().copied().chain(named.clone().map(|entry| entry.0)).collect();
        let mut of_names: BTreeMap<String, i64> =
            named.map(|(marker, name)| (name.clone(), *marker)).collect();
        let mut free = (FIRST_MARKER..).filter(|marker| !taken.contains(marker));
        for (marker, name) in markers.iter_mut().zip(of_segments).filter(|entry| *entry.0 == 0) {
            let Some(name) = name else { continue };
            if let Some(&known) = of_names.get(&name) {
                *marker = known;
            } else if let Some(new) = free.next() {
                self.names.name_boundary(new, &name)?;
                of_names.insert(name, new);
                *marker = new;
            }
        }
        Ok(())
    }

    /// The region of a triangle in a polygon whose own number is this.
    pub(super) fn region(&self, number: f64) -> f64 {
        self.joined.get(&(number as usize)).copied().unwrap_or(number)
    }

    /// Warns of names whose numbers nothing has.
    pub(super) fn check(&self, markers: &[i64], regions: &[f64], quiet: bool) {
        for (marker, name) in self.said.boundaries() {
            if !markers.contains(marker) {
                let there = listed(markers.iter().map(ToString::to_string));
                warn(quiet, format_args!("no boundary has the marker {marker} of {name:?}: {there}"));
            }
        }
        for (number, name) in self.said.regions() {
            if !regions.contains(number) {
                let there = listed(regions.iter().map(ToString::to_string));
                warn(quiet, format_args!("no region has the number {number} of {name:?}: {there}"));
            }
        }
    }

    /// Tells which outputs are without the names that options and files say.
    pub(super) fn tell(&self, targets: &[Target], quiet: bool) {
        for (path, content) in targets {
            if let Content::Mesh(format) = content {
                tell_names(&self.said, path, *format, quiet);
            }
        }
    }
}

/// The numbers that there are, in words.
fn listed(numbers: impl ExactSizeIterator<Item = String>) -> String {
    let more = numbers.len().saturating_sub(LISTED_NUMBERS);
    let first: Vec<String> = numbers.take(LISTED_NUMBERS).collect();
    match (first.is_empty(), more) {
        (true, _) => "there is none".to_owned(),
        (false, 0) => format!("there are {}", first.join(", ")),
        (false, more) => format!("there are {} and {more} more", first.join(", ")),
    }
}

/// The column of names.
struct Column {
    place: usize,
    /// Whether numbers are names too.
    any: bool,
}

impl Column {
    fn name(&self, table: &Table, row: usize) -> Option<String> {
        let value = table.value(row, self.place);
        let is_name = self.any || matches!(value, Value::Text(_) | Value::Owned(_));
        let name = value.text().filter(|_| is_name)?.trim().to_owned();
        (!name.is_empty()).then_some(name)
    }
}

/// Finds the column of names. One that is asked for must be there.
fn column(asked: Option<&str>, table: &Table) -> Result<Option<Column>, Failure> {
    let wanted = asked.unwrap_or(NAME_COLUMN);
    let names = table.names();
    let exact = names.iter().position(|name| name == wanted);
    let place = exact.or_else(|| names.iter().position(|name| name.eq_ignore_ascii_case(wanted)));
    if place.is_none() && asked.is_some() {
        let help = if names.is_empty() {
            "features of GeoJSON, GeoPackage, FlatGeobuf and shapefiles have attributes".to_owned()
        } else {
            format!("there are {}", names.join(", "))
        };
        return Err(Failure::usage(format!("no feature has the attribute {wanted:?}"), help));
    }
    Ok(place.map(|place| Column { place, any: asked.is_some() }))
}
