//! LAS and LAZ point clouds, by the `las` crate, in chunks.

use las::{PointDataBuilder, Reader};

use crate::{Cloud, Error, Source};

/// Points decoded at a time: bounded memory beside the result.
const CHUNK: u64 = 100_000;

/// Reads x, y and z of the points whose class is among `classes` (of all, if that is empty).
pub(crate) fn read(source: Box<dyn Source>, classes: &[u8]) -> Result<Cloud, Error> {
    let mut reader = Reader::new(source).map_err(broken)?;
    let total = reader.header().number_of_points();
    let capacity = if classes.is_empty() { total as usize } else { 0 };
    let mut cloud = Cloud::with_capacity(capacity, true);
    let mut chunk = PointDataBuilder::new().for_header(reader.header()).build();
    let mut seen = 0;
    while seen < total {
        let count = reader.fill_points(CHUNK.min(total - seen), &mut chunk).map_err(broken)?;
        if count == 0 {
            return Err(Error::Truncated(format!("after {seen} of {total} points")));
        }
        seen += count;
        for (((x, y), z), class) in chunk.x().zip(chunk.y()).zip(chunk.z()).zip(chunk.classification()) {
            if classes.is_empty() || classes.contains(&class) {
                cloud.push([x, y], z);
            }
        }
    }
    Ok(cloud)
}

fn broken(error: impl std::fmt::Display) -> Error {
    Error::content(format!("LAS: {error}"))
}
