//! Points that are kept, with what is wanted of each.

use las::PointData;

use super::dimensions::{self, Dimension};
use super::filter::{Attributes, LasFilter};
use crate::{Cloud, Crs, Error, Features, ReadOptions, Table};

/// The wanted part of the points of a file.
pub(crate) struct Wanted<'a> {
    pub(crate) options: &'a ReadOptions,
    pub(crate) filter: &'a LasFilter,
    /// The dimension that is taken as the height, where it is not z.
    height: Option<Dimension>,
    /// The dimensions that are attributes; none if their names alone are wanted.
    attributes: Vec<Dimension>,
}

impl<'a> Wanted<'a> {
    /// The wanted part by the options, of a file with these dimensions.
    pub(crate) fn of(options: &'a ReadOptions, all: &[Dimension]) -> Result<Self, Error> {
        let height = match &options.columns[..] {
            [] => None,
            [x, y, rest @ ..] if x.eq_ignore_ascii_case("x") && y.eq_ignore_ascii_case("y") => match rest {
                [] => None,
                [name] => Some(name).filter(|name| !name.eq_ignore_ascii_case("z")),
                _ => return Err(Error::content("LAS: columns are x, y and one for the height")),
            },
            _ => return Err(Error::content("LAS: the first columns are x and y")),
        };
        let names = names(options);
        let attributes = names.names().iter().map(|name| dimensions::find(all, name));
        let attributes = attributes.collect::<Result<Vec<_>, _>>()?;
        Ok(Self {
            options,
            filter: &options.las,
            height: height.map(|name| dimensions::find(all, name)).transpose()?,
            attributes: if options.attributes { attributes } else { Vec::new() },
        })
    }

    /// Whether more of records is asked than coordinates and what filters know.
    pub(super) fn is_more(&self) -> bool {
        self.height.is_some() || !self.attributes.is_empty()
    }
}

/// A table with the attributes that are asked for, without rows.
fn names(options: &ReadOptions) -> Table {
    let mut table = Table::default();
    options.dimensions.iter().for_each(|name| _ = table.column(name));
    table
}

/// The points that were kept so far, and how many there were of each class.
#[derive(Default)]
pub(crate) struct Kept {
    pub(crate) cloud: Cloud,
    pub(super) counts: Counts,
    table: Table,
}

/// How many points there were of each class, with each flag, and how many were left out because they are withheld, or have no height.
#[derive(Clone, Copy)]
pub(super) struct Counts {
    classes: [u64; 256],
    flags: [u64; 4],
    withheld: u64,
    no_height: u64,
    kept: u64,
}

impl Default for Counts {
    fn default() -> Self {
        Self { classes: [0; 256], flags: [0; 4], withheld: 0, no_height: 0, kept: 0 }
    }
}

impl Counts {
    fn add(&mut self, more: &Self) {
        self.classes.iter_mut().zip(more.classes).for_each(|(sum, count)| *sum += count);
        self.flags.iter_mut().zip(more.flags).for_each(|(sum, count)| *sum += count);
        self.withheld += more.withheld;
        self.no_height += more.no_height;
        self.kept += more.kept;
    }
}

impl Kept {
    /// Room for so many points.
    pub(crate) fn with_capacity(count: usize, options: &ReadOptions) -> Self {
        let cloud = Cloud::with_capacity(count, options.columns.len() != 2);
        Self { cloud, counts: Counts::default(), table: names(options) }
    }

    /// Takes records of a LAS file.
    pub(super) fn take(&mut self, data: &PointData, wanted: &Wanted) {
        let records = data.raw_bytes().chunks_exact(data.record_len());
        let places = data.x().zip(data.y()).zip(data.z());
        for ((((x, y), z), point), record) in places.zip(Attributes::of(data)).zip(records) {
            self.push([x, y, z], point, record, wanted);
        }
    }

    /// Takes a point, if it is wanted.
    #[inline]
    pub(crate) fn push(&mut self, [x, y, z]: [f64; 3], point: Attributes, record: &[u8], wanted: &Wanted) {
        const WITHHELD: usize = 2;
        if !wanted.filter.has([x, y]) {
            return;
        }
        self.counts.classes[usize::from(point.class)] += 1;
        self.counts.flags.iter_mut().zip(point.flags).for_each(|(sum, is_set)| *sum += u64::from(is_set));
        if !wanted.filter.takes(point, z) {
            return;
        }
        if point.flags[WITHHELD] && !wanted.filter.withheld {
            self.counts.withheld += 1;
            return;
        }
        let height = wanted.height.as_ref().map_or(Some(z), |own| own.number(record));
        let Some(height) = height else {
            self.counts.no_height += 1;
            return;
        };
        self.counts.kept += 1;
        self.cloud.push([x, y], height);
        if !wanted.attributes.is_empty() {
            self.table.begin();
            for (column, own) in wanted.attributes.iter().enumerate() {
                self.table.put(column, own.value(record));
            }
        }
    }

    /// Appends what was kept of another part.
    pub(crate) fn append(&mut self, part: Self) {
        self.cloud.append(part.cloud);
        self.counts.add(&part.counts);
        self.table.append(&part.table);
    }

    /// The points, with all that was counted.
    pub(crate) fn finish(self, crs: Option<Crs>, options: &ReadOptions) -> Cloud {
        let Self { mut cloud, counts, table } = self;
        cloud.crs = crs;
        cloud.classes = (0..=255).zip(counts.classes).filter(|entry| entry.1 > 0).collect();
        cloud.flags = counts.flags;
        cloud.features = Features::of_points(table);
        if counts.withheld > 0 {
            cloud.remarks.push(format!("{} points that are withheld are left out", counts.withheld));
        }
        if let (count @ 1.., Some(name)) = (counts.no_height, options.columns.last()) {
            cloud.losses.push(format!("{count} points without a value of {name} are left out"));
        }
        let all: u64 = counts.classes.iter().sum();
        if all > 0 && counts.kept == 0 {
            cloud.remarks.push(format!("none of its {all} points is taken"));
        }
        cloud
    }
}
