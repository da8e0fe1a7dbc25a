//! LAS and LAZ point clouds: header and records by the `las` crate, compressed chunks by the `laz` crate (`chunks.rs`).
//!
//! Every length that the file claims is compared with the file before a decoder sees it, so memory stays within a
//! few times what is really there.

mod chunks;
mod system;

use std::io::{Read, Seek, SeekFrom};

use las::raw;
use las::{Builder, PointData, PointDataBuilder, Vlr};

use crate::chunks::Chunks;
use crate::guard;
use crate::{Cloud, Error, Source};

/// Points decoded at a time: bounded memory beside the result.
const CHUNK: u64 = 50_000;

/// More points than a byte can hold, however well they are compressed: a file that claims them lies.
const POINTS_A_BYTE: u64 = 4096;

/// Reads x, y and z of the points whose class is among `classes` (of all, if that is empty).
pub(crate) fn read(source: Box<dyn Source>, classes: &[u8]) -> Result<Cloud, Error> {
    read_in(source, classes, &mut Chunks::default())
}

/// Reads in chunks.
pub(crate) fn read_in(source: Box<dyn Source>, classes: &[u8], chunks: &mut Chunks) -> Result<Cloud, Error> {
    guard::decode("LAS", || Tile::open(source)?.read(classes, chunks))
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
    classes: &'a [u8],
    counts: [u64; 256],
}

impl Kept<'_> {
    fn take(&mut self, data: &PointData) {
        for (((x, y), z), class) in data.x().zip(data.y()).zip(data.z()).zip(data.classification()) {
            self.counts[usize::from(class)] += 1;
            if self.classes.is_empty() || self.classes.contains(&class) {
                self.cloud.push([x, y], z);
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
        let total = match header.large_file {
            Some(large) if header.number_of_point_records == 0 => large.number_of_point_records,
            _ => u64::from(header.number_of_point_records),
        };
        if let Some(extended) = extended {
            system::read_extended(&mut source, extended, length, &mut about)?;
        }
        let record = usize::from(header.point_data_record_length);
        Ok(Self { source, length, start, total, record, about })
    }

    fn read(mut self, classes: &[u8], takers: &mut Chunks) -> Result<Cloud, Error> {
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
            if classes.is_empty() && takers.is_whole() { self.total.min(claim) as usize } else { 0 };
        let mut kept = Kept { cloud: Cloud::with_capacity(capacity, true), classes, counts: [0; 256] };
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
        cloud.classes = (0..=255).zip(kept.counts).filter(|entry| entry.1 > 0).collect();
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
