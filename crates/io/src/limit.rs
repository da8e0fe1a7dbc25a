//! How much a process may write.

use std::io::{self, Seek, SeekFrom, Write};
use std::sync::atomic::{AtomicU64, Ordering};

use crate::Error;

/// Bytes that may still be written.
static LEFT: AtomicU64 = AtomicU64::new(u64::MAX);

/// All outputs of this process that begin from now on together have so many bytes at most, temporary files of their work included. More is
/// [`Error::TooMuchOutput`].
pub fn limit_output(bytes: u64) {
    LEFT.store(bytes, Ordering::Relaxed);
}

/// A writer whose bytes are counted.
#[derive(Debug)]
pub(crate) struct Counted<W>(pub(crate) W);

impl<W: Write> Write for Counted<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count =
            |left: u64| if left == u64::MAX { Some(left) } else { left.checked_sub(bytes.len() as u64) };
        LEFT.fetch_update(Ordering::Relaxed, Ordering::Relaxed, count)
            .map_err(|_| io::Error::other(Error::TooMuchOutput))?;
        self.0.write_all(bytes)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

impl<W: Seek> Seek for Counted<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.0.seek(to)
    }
}
