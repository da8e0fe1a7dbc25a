//! LAS and LAZ point clouds: header and records by the `las` crate, compressed chunks by the `laz` crate (`chunks.rs`).
//!
//! Every length that the file claims is compared with the file before a decoder sees it, so memory stays within a
//! few times what is really there.

mod chunks;
mod filter;
mod system;

use std::io::{Read, Seek, SeekFrom};

use las::raw;
use las::{Builder, PointData, PointDataBuilder, Vlr};

use crate::chunks::Chunks;
use crate::guard;
use crate::{Cloud, Error, Source};
use filter::Attributes;
pub use filter::{LasFilter, LasFlag, Returns};

/// Points decoded at a time: bounded memory beside the result.
const CHUNK: u64 = 50_000;

/// More points than a byte can hold, however well they are compressed: a file that claims them lies.
const POINTS_A_BYTE: u64 = 4096;

/// Reads x, y and z of the points that the filter takes.
pub(crate) fn read(source: Box<dyn Source>, filter: &LasFilter) -> Result<Cloud, Error> {
    read_in(source, filter, &mut Chunks::default())
}

/// Reads in chunks.
pub(crate) fn read_in(
    source: Box<dyn Source>,
    filter: &LasFilter,
    chunks: &mut Chunks,
) -> Result<Cloud, Error> {
    guard::decode("LAS", || Tile::open(source)?.read(filter, chunks))
}

fn broken(error: impl std::fmt::Display) -> Error {
    Error::content(format!("LAS: {error}"))
}

/// A file whose header was read and found to fit the file.
struct Tile {
    source: Box<dyn Source>,
    /// Bytes of the file.
    length: u64,
    /// Where the point records begin.
    start: u64,
    total: u64,
    record: usize,
    about: Builder,
}

/// The points that were kept so far, and how many there were of each class.
struct Kept<'a> {
    cloud: Cloud,
    filter: &'a LasFilter,
    counts: Counts,
}

/// How many points there were of each class, with each flag, and how many were left out because they are withheld.
#[derive(Clone, Copy)]
struct Counts {
    classes: [u64; 256],
    flags: [u64; 4],
    withheld: u64,
}

impl Counts {
    const NONE: Self = Self { classes: [0; 256], flags: [0; 4], withheld: 0 };

    fn add(&mut self, more: &Self) {
        self.classes.iter_mut().zip(more.classes).for_each(|(sum, count)| *sum += count);
        self.flags.iter_mut().zip(more.flags).for_each(|(sum, count)| *sum += count);
        self.withheld += more.withheld;
    }
}

impl Kept<'_> {
    fn take(&mut self, data: &PointData) {
        const WITHHELD: usize = 2;
        for (((x, y), z), point) in data.x().zip(data.y()).zip(data.z()).zip(Attributes::of(data)) {
            self.counts.classes[usize::from(point.class)] += 1;
            self.counts.flags.iter_mut().zip(point.flags).for_each(|(sum, is_set)| *sum += u64::from(is_set));
            if self.filter.takes(point, z) {
                if point.flags[WITHHELD] && !self.filter.withheld {
                    self.counts.withheld += 1;
                } else {
                    self.cloud.push([x, y], z);
                }
            }
        }
    }
}

impl Tile {
    fn open(mut source: Box<dyn Source>) -> Result<Self, Error> {
        let length = source.seek(SeekFrom::End(0))?;
        source.rewind()?;
        let header = raw::Header::read_from(&mut source).map_err(early("inside the header"))?;
        let (first_record, start) = (u64::from(header.header_size), u64::from(header.offset_to_point_data));
        if start > length {
            return Err(Error::Truncated(format!(
                "at byte {length}, before the points, which begin at byte {start}"
            )));
        }
        let (records, extended) = (header.number_of_variable_length_records, header.evlr);
        let mut about = Builder::new(header.clone()).map_err(broken)?;
        source.seek(SeekFrom::Start(first_record))?;
        let mut position = first_record;
        for i in 0..records {
            let record =
                raw::Vlr::read_from(&mut source, false).map(Vlr::new).map_err(early("inside its records"))?;
            position += record.len(false) as u64;
            if position > start {
                return Err(broken(format!("record {i} of {records} reaches into the points")));
            }
            about.vlrs.push(record);
        }
        // What the larger field counts holds; a writer that left it empty has used the smaller one.
        let legacy = u64::from(header.number_of_point_records);
        let total = match header.large_file.map(|large| large.number_of_point_records) {
            Some(count) if count > 0 => count,
            _ => legacy,
        };
        if let Some(extended) = extended {
            system::read_extended(&mut source, extended, length, &mut about)?;
        }
        let record = usize::from(header.point_data_record_length);
        Ok(Self { source, length, start, total, record, about })
    }

    fn read(mut self, filter: &LasFilter, takers: &mut Chunks) -> Result<Cloud, Error> {
        let bytes = self.length - self.start;
        let (fits, claim) = if self.about.point_format.is_compressed {
            (bytes.saturating_mul(POINTS_A_BYTE), bytes)
        } else {
            (bytes / self.record as u64, self.total)
        };
        if self.total > fits {
            return Err(Error::Truncated(format!("after {fits} of {} points", self.total)));
        }
        let capacity =
            if filter.is_plain() && takers.is_whole() { self.total.min(claim) as usize } else { 0 };
        let mut kept = Kept { cloud: Cloud::with_capacity(capacity, true), filter, counts: Counts::NONE };
        self.source.seek(SeekFrom::Start(self.start))?;
        if self.about.point_format.is_compressed {
            chunks::read(&mut self, &mut kept, takers)?;
        } else {
            let mut data = self.buffer();
            let mut seen = 0;
            while seen < self.total {
                let count = CHUNK.min(self.total - seen);
                self.source.read_exact(data.resize_for(count as usize))?;
                kept.take(&data);
                takers.offer(&mut kept.cloud)?;
                seen += count;
            }
        }
        let mut cloud = kept.cloud;
        cloud.crs = system::find(&self.about.vlrs);
        let counts = kept.counts;
        cloud.classes = (0..=255).zip(counts.classes).filter(|entry| entry.1 > 0).collect();
        cloud.flags = counts.flags;
        if counts.withheld > 0 {
            cloud.remarks.push(format!("{} points that are withheld are left out", counts.withheld));
        }
        Ok(cloud)
    }

    /// Room for records, and how to read their fields.
    fn buffer(&self) -> PointData {
        PointDataBuilder::new()
            .with_format(self.about.point_format)
            .with_transforms(self.about.transforms)
            .build()
    }
}

/// An end of the file where there should be more.
fn early(place: &'static str) -> impl Fn(las::Error) -> Error {
    move |error| match error {
        las::Error::Io(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            Error::Truncated(place.to_owned())
        }
        other => broken(other),
    }
}

/// The names of LAS classes (ASPRS LAS 1.4 R15, table 17), without blanks.
pub const LAS_CLASSES: &[(&str, u8)] = &[
    ("never-classified", 0),
    ("unclassified", 1),
    ("ground", 2),
    ("low-vegetation", 3),
    ("medium-vegetation", 4),
    ("high-vegetation", 5),
    ("building", 6),
    ("low-noise", 7),
    ("water", 9),
    ("rail", 10),
    ("road", 11),
    ("wire-guard", 13),
    ("wire-conductor", 14),
    ("transmission-tower", 15),
    ("bridge", 17),
    ("high-noise", 18),
];
