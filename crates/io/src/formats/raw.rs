//! Raw little-endian f64, point after point: the dimension must be told.

use std::io::{self, Write};

use crate::chunks::Chunks;
use crate::{Cloud, Error, Source};

pub(crate) fn read(source: Box<dyn Source>, dimension: usize) -> Result<Cloud, Error> {
    read_in(source, dimension, &mut Chunks::default())
}

/// Reads in chunks.
pub(crate) fn read_in(
    mut source: Box<dyn Source>,
    dimension: usize,
    chunks: &mut Chunks,
) -> Result<Cloud, Error> {
    let mut cloud = Cloud::with_capacity(0, dimension == 3);
    let mut before = 0;
    let mut record = vec![0; 8 * dimension.max(2)];
    loop {
        let mut filled = 0;
        while filled < record.len() {
            match source.read(&mut record[filled..])? {
                0 if filled == 0 => return Ok(cloud),
                0 => {
                    let at = before + cloud.xy.len();
                    return Err(Error::Truncated(format!("inside point {at} of {dimension} numbers each")));
                }
                count => filled += count,
            }
        }
        let mut numbers = [0.0; 3];
        for (number, bytes) in numbers.iter_mut().zip(record.as_chunks().0) {
            *number = f64::from_le_bytes(*bytes);
        }
        cloud.push([numbers[0], numbers[1]], numbers[2]);
        before += chunks.offer(&mut cloud)?;
    }
}

pub(crate) fn write<const D: usize>(out: &mut dyn Write, points: &[[f64; D]]) -> io::Result<()> {
    points.as_flattened().iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))
}
