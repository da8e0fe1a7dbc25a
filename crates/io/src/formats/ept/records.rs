//! Nodes that are records as the schema says, one after the other, perhaps compressed by Zstandard.

use std::io::{self, Read, Seek, SeekFrom};

use ruzstd::decoding::StreamingDecoder;

use super::about::{About, DataType, wrong};
use crate::formats::las::{Attributes, Dimension, Kept, Wanted, find};
use crate::input::{Bounded, most_inflated};
use crate::{Error, LasFlag, ReadOptions, Returns, Source};

/// The fields that filters and coordinates are taken from, and what else is wanted.
pub(super) struct Fields<'a> {
    wanted: Wanted<'a>,
    place: [Dimension; 3],
    class: Option<Dimension>,
    returns: [Option<Dimension>; 2],
    flags: [Option<Dimension>; 4],
}

impl<'a> Fields<'a> {
    /// The fields of a schema; what a filter asks for has to be there.
    pub(super) fn of(about: &About, options: &'a ReadOptions) -> Result<Self, Error> {
        let (all, filter) = (&about.dimensions, &options.las);
        let asked = |name: &str, is_asked: bool| match find(all, name) {
            Ok(own) => Ok(Some(own)),
            Err(error) if is_asked => Err(error),
            Err(_) => Ok(None),
        };
        let of_returns = filter.returns != Returns::All;
        let flag = |flag: LasFlag, name| asked(name, filter.skip.contains(&flag));
        Ok(Self {
            wanted: Wanted::of(options, all)?,
            place: [find(all, "X")?, find(all, "Y")?, find(all, "Z")?],
            class: asked("Classification", !filter.classes.is_empty())?,
            returns: [asked("ReturnNumber", of_returns)?, asked("NumberOfReturns", of_returns)?],
            flags: [
                flag(LasFlag::Synthetic, "Synthetic")?,
                flag(LasFlag::KeyPoint, "KeyPoint")?,
                flag(LasFlag::Withheld, "Withheld")?,
                flag(LasFlag::Overlap, "Overlap")?,
            ],
        })
    }

    fn attributes(&self, record: &[u8]) -> Attributes {
        let byte =
            |own: &Option<Dimension>| own.as_ref().and_then(|own| own.number(record)).unwrap_or(0.0) as u8;
        Attributes {
            class: byte(&self.class),
            returns: [byte(&self.returns[0]), byte(&self.returns[1])],
            flags: std::array::from_fn(|k| byte(&self.flags[k]) != 0),
        }
    }
}

/// Reads the points of a node.
pub(super) fn read(
    mut source: Box<dyn Source>,
    count: u64,
    about: &About,
    fields: &Fields,
) -> Result<Kept, Error> {
    let packed = source.seek(SeekFrom::End(0))?;
    source.rewind()?;
    let expected = count.checked_mul(about.record as u64).ok_or_else(|| wrong("it has too many points"))?;
    let mut bytes = Vec::new();
    if about.data == DataType::Zstandard {
        let decoder = StreamingDecoder::new(source).map_err(|error| wrong(format!("Zstandard: {error}")))?;
        // One byte more tells that there is more.
        let content = Bounded::to(most_inflated(packed), decoder);
        content.take(expected.saturating_add(1)).read_to_end(&mut bytes).map_err(|error| {
            match error.kind() {
                io::ErrorKind::UnexpectedEof => {
                    Error::Truncated("inside of its compressed content".to_owned())
                }
                _ => error.into(),
            }
        })?;
    } else if packed == expected {
        source.read_to_end(&mut bytes)?;
    } else {
        return Err(wrong(format!("it has {packed} bytes, {count} points have {expected}")));
    }
    if bytes.len() as u64 != expected {
        return Err(wrong(format!("it has other than the {expected} bytes of {count} points")));
    }
    let mut kept = Kept::with_capacity(0, fields.wanted.options);
    for record in bytes.chunks_exact(about.record) {
        let place = [0, 1, 2].map(|k: usize| fields.place[k].number(record).unwrap_or(f64::NAN));
        kept.push(place, fields.attributes(record), record, &fields.wanted);
    }
    Ok(kept)
}
