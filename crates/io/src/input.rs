//! Input as it comes: compressed or not. Compressed content is bounded: a small file may not fill the memory.

use std::io::{self, BufRead, BufReader, Cursor, Read, Seek, SeekFrom};
use std::sync::atomic::{AtomicBool, Ordering};

use flate2::bufread::MultiGzDecoder;

use crate::{Error, Format, Source};

/// Content may be so many times as long as its compressed form. Deflate makes 1,032 of 1 at most (zlib's technical details), of zeros alone;
/// real points 2 to 20.
const EXPANSION: u64 = 1000;
/// Content of so many bytes is read however well it is compressed: 64 MiB fit everywhere.
const HARMLESS: u64 = 1 << 26;

/// Whether content may be of any length.
static IS_TRUSTED: AtomicBool = AtomicBool::new(false);

/// Compressed content of this process may be any number of times as long as its file, or (by default) 1,000 times and 64 MiB at least. For
/// programs that limit their memory themselves.
pub fn trust_compressed(is_trusted: bool) {
    IS_TRUSTED.store(is_trusted, Ordering::Relaxed);
}

/// The largest number of bytes that `packed` bytes may inflate to.
pub(crate) fn most_inflated(packed: u64) -> u64 {
    let is_trusted = IS_TRUSTED.load(Ordering::Relaxed);
    if is_trusted { u64::MAX } else { packed.saturating_mul(EXPANSION).max(HARMLESS) }
}

/// Content that ends with an error where it is too long.
pub(crate) struct Bounded<R> {
    content: R,
    left: u64,
}

impl<R> Bounded<R> {
    pub(crate) fn to(left: u64, content: R) -> Self {
        Self { content, left }
    }
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.content.read(buffer)?;
        self.left = self.left.checked_sub(read as u64).ok_or_else(|| io::Error::other(Error::Expands))?;
        Ok(read)
    }
}

/// The content of a source, which is decompressed if it begins as gzip does. Formats that are read from front to back
/// are decompressed on the way, the others first.
pub fn decompressed(mut source: Box<dyn Source>, format: Format) -> Result<Box<dyn Source>, Error> {
    const MAGIC: &[u8] = &[0x1f, 0x8b];
    if format == Format::Raw || !source.fill_buf()?.starts_with(MAGIC) {
        return Ok(source);
    }
    let packed = source.seek(SeekFrom::End(0))?;
    source.rewind()?;
    let mut inside = BufReader::with_capacity(
        1 << 16,
        Stream(Bounded::to(most_inflated(packed), MultiGzDecoder::new(source))),
    );
    match format {
        Format::Las | Format::Npy | Format::Npz | Format::E57 | Format::Tiff | Format::GeoPackage => {
            let mut bytes = Vec::new();
            inside.read_to_end(&mut bytes)?;
            Ok(Box::new(Cursor::new(bytes)))
        }
        _ => Ok(Box::new(inside)),
    }
}

/// A decompressed stream, which goes forwards only.
struct Stream(Bounded<MultiGzDecoder<Box<dyn Source>>>);

impl Read for Stream {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let ended = || io::Error::other(Error::Truncated("inside of its compressed content".to_owned()));
        self.0
            .read(buffer)
            .map_err(|error| if error.kind() == io::ErrorKind::UnexpectedEof { ended() } else { error })
    }
}

impl Seek for Stream {
    fn seek(&mut self, _: SeekFrom) -> io::Result<u64> {
        Err(io::Error::new(io::ErrorKind::NotSeekable, "compressed files are read from front to back"))
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Cursor, Read};

    use super::{Bounded, EXPANSION, HARMLESS, decompressed, most_inflated};
    use crate::{Error, Format};

    /// A file of 66 kB that holds 64 MiB of zeros is read, one of 128 MiB is an error that is told.
    #[test]
    fn content_is_bounded() {
        let packed = |length: u64| {
            let zeros = std::io::repeat(0).take(length);
            let mut bytes = Vec::new();
            flate2::read::GzEncoder::new(zeros, flate2::Compression::best())
                .read_to_end(&mut bytes)
                .expect("memory");
            bytes
        };
        let read = |bytes: Vec<u8>| {
            let mut source = decompressed(Box::new(Cursor::new(bytes)), Format::Text)?;
            Ok(std::io::copy(&mut source, &mut std::io::sink())?)
        };
        assert_eq!(read(packed(HARMLESS)).map_err(|error: Error| error.to_string()), Ok(HARMLESS));
        assert!(matches!(read(packed(2 * HARMLESS)), Err(Error::Expands)));
        let mut cut = packed(HARMLESS);
        cut.truncate(30_000);
        assert!(matches!(read(cut), Err(Error::Truncated(_))));
        let most = most_inflated(100_000);
        assert_eq!(most, 100_000 * EXPANSION);
        let zeros = |length: u64| std::io::repeat(0).take(length);
        let count = |length: u64| std::io::copy(&mut Bounded::to(most, zeros(length)), &mut std::io::sink());
        assert_eq!((count(most).ok(), count(most + 1).is_err()), (Some(most), true));
    }
}
