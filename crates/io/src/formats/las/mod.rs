//! LAS and LAZ point clouds: header and records by the `las` crate, compressed chunks by the `laz` crate (`chunks.rs`).
//!
//! Every length that the file claims is compared with the file before a decoder sees it, so memory stays within a
//! few times what is really there.

mod chunks;
mod copc;
mod cubes;
mod dimensions;
mod filter;
mod kept;
mod system;

use std::io::{Read, Seek, SeekFrom};

use las::raw;
use las::{Builder, PointData, PointDataBuilder, Vlr};

use crate::chunks::Chunks;
use crate::guard;
use crate::{Cloud, Crs, Error, ReadOptions, Source};
pub(crate) use cubes::{Cubes, Key};
pub(crate) use dimensions::{Dimension, Kind, find};
pub(crate) use filter::Attributes;
pub use filter::{LasFilter, LasFlag, Returns};
pub(crate) use kept::{Kept, Wanted};

/// Points decoded at a time: bounded memory beside the result.
const CHUNK: u64 = 50_000;

/// More points than a byte can hold, however well they are compressed: a file that claims them lies.
const POINTS_A_BYTE: u64 = 4096;

/// Reads x, y and z of the points that the filter takes.
pub(crate) fn read(source: Box<dyn Source>, options: &ReadOptions) -> Result<Cloud, Error> {
    read_in(source, options, &mut Chunks::default())
}

/// Reads in chunks.
pub(crate) fn read_in(
    source: Box<dyn Source>,
    options: &ReadOptions,
    chunks: &mut Chunks,
) -> Result<Cloud, Error> {
    guard::decode("LAS", || {
        let tile = Tile::open(source)?;
        let (crs, wanted) = (tile.crs(), Wanted::of(options, &tile.dimensions)?);
        Ok(tile.read(&wanted, chunks)?.finish(crs, options))
    })
}

fn broken(error: impl std::fmt::Display) -> Error {
    Error::content(format!("LAS: {error}"))
}

/// A file whose header was read and found to fit the file.
pub(crate) struct Tile {
    source: Box<dyn Source>,
    /// Bytes of the file.
    length: u64,
    /// Where the point records begin.
    start: u64,
    pub(crate) total: u64,
    record: usize,
    about: Builder,
    /// The dimensions of records besides coordinates.
    pub(crate) dimensions: Vec<Dimension>,
}

impl Tile {
    pub(crate) fn open(mut source: Box<dyn Source>) -> Result<Self, Error> {
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
        let dimensions = dimensions::of_records(about.point_format, record, &about.vlrs);
        Ok(Self { source, length, start, total, record, about, dimensions })
    }

    /// The system of coordinates that the file names.
    pub(crate) fn crs(&self) -> Option<Crs> {
        system::find(&self.about.vlrs)
    }

    /// Reads the points that are wanted.
    pub(crate) fn read(mut self, wanted: &Wanted, takers: &mut Chunks) -> Result<Kept, Error> {
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
            if wanted.filter.is_plain() && takers.is_whole() { self.total.min(claim) as usize } else { 0 };
        let mut kept = Kept::with_capacity(capacity, wanted.options);
        let extra = self.dimensions.iter().filter(|own| own.is_extra);
        kept.cloud.dimensions = extra.map(|own| (own.name.clone(), own.describe())).collect();
        self.source.seek(SeekFrom::Start(self.start))?;
        if self.about.point_format.is_compressed {
            chunks::read(&mut self, wanted, &mut kept, takers)?;
        } else {
            let mut data = self.buffer();
            let mut seen = 0;
            while seen < self.total {
                let count = CHUNK.min(self.total - seen);
                self.source.read_exact(data.resize_for(count as usize))?;
                kept.take(&data, wanted);
                takers.offer(&mut kept.cloud)?;
                seen += count;
            }
        }
        Ok(kept)
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
