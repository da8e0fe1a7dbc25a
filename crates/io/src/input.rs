//! Input as it comes: compressed or not.

use std::io::{self, BufRead, BufReader, Cursor, Read, Seek, SeekFrom};

use flate2::bufread::MultiGzDecoder;

use crate::{Error, Format, Source};

/// The content of a source, which is decompressed if it begins as gzip does. Formats that are read from front to back
/// are decompressed on the way, the others first.
pub fn decompressed(mut source: Box<dyn Source>, format: Format) -> Result<Box<dyn Source>, Error> {
    const MAGIC: &[u8] = &[0x1f, 0x8b];
    if format == Format::Raw || !source.fill_buf()?.starts_with(MAGIC) {
        return Ok(source);
    }
    let mut inside = BufReader::with_capacity(1 << 16, Stream(MultiGzDecoder::new(source)));
    match format {
        Format::Las | Format::Npy | Format::Npz | Format::E57 | Format::Tiff => {
            let mut bytes = Vec::new();
            inside.read_to_end(&mut bytes)?;
            Ok(Box::new(Cursor::new(bytes)))
        }
        _ => Ok(Box::new(inside)),
    }
}

/// A decompressed stream, which goes forwards only.
struct Stream(MultiGzDecoder<Box<dyn Source>>);

impl Read for Stream {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.0.read(buffer)
    }
}

impl Seek for Stream {
    fn seek(&mut self, _: SeekFrom) -> io::Result<u64> {
        Err(io::Error::new(io::ErrorKind::NotSeekable, "compressed files are read from front to back"))
    }
}
