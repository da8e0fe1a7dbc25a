//! Compressions of TIFF files, and which of them are read.

use std::io::Read;

use ruzstd::decoding::StreamingDecoder;

use crate::Error;

pub(super) const NONE: u16 = 1;
pub(super) const ZSTD: u16 = 50_000;

/// Compressions that the `tiff` crate decodes, and Zstandard, which is decoded here.
const READ: [u16; 6] = [NONE, 5, 8, 32_946, 32_773, ZSTD];

/// Refuses compressions that are not read.
pub(super) fn check(number: u16) -> Result<(), Error> {
    if READ.contains(&number) { Ok(()) } else { Err(Error::Compression(name(number))) }
}

/// The name of a compression that is not read.
fn name(number: u16) -> String {
    let name = match number {
        2..=4 => "CCITT",
        6 | 7 => "JPEG",
        33_003 | 33_005 | 34_712 => "JPEG 2000",
        34_887 => "LERC",
        34_892 => "lossy JPEG",
        34_925 => "LZMA",
        50_001 => "WebP",
        50_002 | 52_546 => "JPEG XL",
        _ => return format!("number {number}"),
    };
    name.to_owned()
}

/// The content of a frame of Zstandard, which has so many bytes (RFC 8878). Windows are 128 MiB at most.
pub(super) fn unzstd(bytes: &[u8], length: u64) -> Result<Vec<u8>, Error> {
    let failed = |error: String| Error::content(format!("TIFF: Zstandard: {error}"));
    let decoder = StreamingDecoder::new(bytes).map_err(|error| failed(error.to_string()))?;
    let mut content = Vec::new();
    decoder.take(length).read_to_end(&mut content).map_err(|error| failed(error.to_string()))?;
    if (content.len() as u64) < length {
        return Err(Error::Truncated("inside a part of the raster".to_owned()));
    }
    Ok(content)
}
