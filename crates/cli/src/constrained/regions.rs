//! Polygons of the input as regions: which polygon has a triangle, and the sizes that attributes ask for.

use std::collections::BTreeSet;

use delone::{Constrained2, Domains2, Membership2, Overlaps2, PolygonRegion2};
use delone_io::{Graph, Table, Value};
use serde_json::{Value as Json, json};

use crate::args::OverlapsName;
use crate::message::Failure;

/// How polygons claim the places inside of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Claims {
    pub(crate) overlaps: Overlaps2,
    /// The attribute that is the longest edge in a polygon.
    pub(crate) lengths: Option<String>,
    /// The attribute that is the largest triangle in a polygon.
    pub(crate) areas: Option<String>,
}

impl Claims {
    pub(crate) fn of(overlaps: Option<OverlapsName>) -> Self {
        let overlaps = match overlaps {
            Some(OverlapsName::First) => Overlaps2::First,
            Some(OverlapsName::Smallest) => Overlaps2::Smallest,
            Some(OverlapsName::Combined) => Overlaps2::Combined,
            Some(OverlapsName::Last) | None => Overlaps2::Last,
        };
        Self { overlaps, ..Self::default() }
    }
}

/// The regions that polygons are.
#[derive(Clone, Debug, Default)]
pub(crate) struct Regions {
    /// How many polygons there are.
    pub(crate) polygons: usize,
    /// The first region that several polygons make.
    first_combined: usize,
    /// The rows of the polygons of each such region.
    combined: Vec<Vec<usize>>,
}

impl Regions {
    /// Gives each part the polygon that has it, by the row of its attributes; the value of a polygon is the number of its feature in the
    /// input, from 1. Seeds of regions go first, and polygons without rows are none.
    pub(super) fn claim(
        c: &Constrained2,
        graph: &Graph,
        inside: &mut Domains2,
        claims: &Claims,
        membership: Membership2<'_>,
    ) -> Result<Self, Failure> {
        let mut rows = vec![None; graph.segments.len()];
        for ring in &graph.rings {
            rows[ring.segments.clone()].fill(graph.row_of(ring));
        }
        let table = &graph.cloud.features.table;
        let [lengths, areas] = [&claims.lengths, &claims.areas].map(|name| match name {
            Some(name) => column(name, table).map(Some),
            None => Ok(None),
        });
        let (lengths, areas) = (lengths?, areas?);
        let distinct: BTreeSet<usize> = rows.iter().flatten().copied().collect();
        let Some(last) = distinct.last().filter(|_| graph.regions.is_empty()) else {
            return Ok(Self::default());
        };
        let of_row = |row: usize| {
            let size = |column: Option<usize>| match column.filter(|_| distinct.contains(&row)) {
                Some(column) => size_of(table, row, column),
                None => Ok(None),
            };
            let region = PolygonRegion2::new((row + 1) as f64);
            Ok(region.max_edge(size(lengths)?).max_area(size(areas)?))
        };
        let regions: Vec<PolygonRegion2> = (0..=*last).map(of_row).collect::<Result<_, Failure>>()?;
        let polygon = |segment: delone::SegmentId| rows.get(segment.index()).copied().flatten();
        let combined = c.claim_polygons_as(inside, polygon, &regions, claims.overlaps, membership);
        Ok(Self { polygons: distinct.len(), first_combined: regions.len(), combined })
    }

    /// The row of the attributes of a region: of several polygons, of the last.
    pub(crate) fn row(&self, region: usize) -> usize {
        let combined = region.checked_sub(self.first_combined).and_then(|number| self.combined.get(number));
        combined.and_then(|rows| rows.last().copied()).unwrap_or(region)
    }

    /// For each region of several polygons its number, and those of the polygons; nothing if there is none.
    pub(super) fn report(&self) -> Option<Json> {
        let of = |(number, rows): (usize, &Vec<usize>)| {
            let polygons: Vec<usize> = rows.iter().map(|row| row + 1).collect();
            json!({ "region": self.first_combined + number + 1, "polygons": polygons })
        };
        (!self.combined.is_empty()).then(|| self.combined.iter().enumerate().map(of).collect())
    }

    /// How many regions are made of several polygons.
    pub(super) fn combined(&self) -> usize {
        self.combined.len()
    }
}

/// The place of a column of attributes.
fn column(name: &str, table: &Table) -> Result<usize, Failure> {
    let help = || match table.names() {
        [] => "features of GeoJSON, GeoPackage, FlatGeobuf and shapefiles have attributes".to_owned(),
        names => format!("there are {}", names.join(", ")),
    };
    let place = table.names().iter().position(|other| other == name);
    place.ok_or_else(|| Failure::usage(format!("no feature has the attribute {name:?}"), help()))
}

/// A size that is an attribute of a feature, if it has one.
fn size_of(table: &Table, row: usize, column: usize) -> Result<Option<f64>, Failure> {
    let number = match table.value(row, column) {
        Value::Null => return Ok(None),
        Value::Integer(value) => Some(value as f64),
        Value::Number(value) => Some(value),
        value => value.text().and_then(|text| text.trim().parse().ok()),
    };
    let refused = || {
        let name = &table.names()[column];
        Failure::new(
            format!("the attribute {name:?} of feature {} is no size: sizes are positive numbers", row + 1),
            "leave the attribute of features without a size of their own empty",
        )
    };
    number.filter(|size: &f64| *size > 0.0).map(Some).ok_or_else(refused)
}
