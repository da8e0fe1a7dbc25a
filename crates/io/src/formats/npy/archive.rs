//! Archives of arrays: what of the ZIP format (PKWARE's APPNOTE 6.3.10, section 4.3) `numpy.savez` and others that store
//! or deflate write, with the lengths of 64 bits too.

use std::io::{self, Read, Seek, SeekFrom};

use flate2::Crc;
use flate2::bufread::DeflateDecoder;

use crate::Error;
use crate::input::{Bounded, most_inflated};

/// The last record and the longest comment after it.
const LONGEST_END: u64 = 22 + 0xffff;

/// A file in the archive, as its directory describes it.
pub(super) struct Entry {
    pub(super) name: String,
    flags: u16,
    method: u16,
    checksum: u32,
    packed: u64,
    size: u64,
    at: u64,
}

/// The directory, which is at the end.
pub(super) fn entries(source: &mut (impl Read + Seek)) -> Result<Vec<Entry>, Error> {
    let length = source.seek(SeekFrom::End(0))?;
    let start = length.saturating_sub(LONGEST_END);
    let tail = bytes(source, start, length - start)?;
    let end =
        tail.windows(4).rposition(|four| four == b"PK\x05\x06").ok_or_else(|| broken("no directory"))?;
    let record = &tail[end..];
    // Its last field is the length of the comment, which may be of any length.
    two(record, 20)?;
    let (mut size, mut at) = (u64::from(four(record, 12)?), u64::from(four(record, 16)?));
    if four(record, 16)? == u32::MAX || four(record, 12)? == u32::MAX {
        // Too far for 32 bits: the record before points to one of 64.
        let locator = tail.get(end.saturating_sub(20)..end).unwrap_or_default();
        let long = bytes(source, eight(locator, 8)?, 56)?;
        if !locator.starts_with(b"PK\x06\x07") || !long.starts_with(b"PK\x06\x06") {
            return Err(broken("no directory"));
        }
        (size, at) = (eight(&long, 40)?, eight(&long, 48)?);
    }
    if at.checked_add(size).is_none_or(|end| end > length) {
        return Err(Error::Truncated("inside the archive's directory".to_owned()));
    }
    let directory = bytes(source, at, size)?;
    let mut rest = &directory[..];
    let mut found = Vec::new();
    while rest.starts_with(b"PK\x01\x02") {
        let lengths = [two(rest, 28)?, two(rest, 30)?, two(rest, 32)?].map(usize::from);
        let extra = 46 + lengths[0];
        let next = extra + lengths[1] + lengths[2];
        let (Some(name), Some(fields)) = (rest.get(46..extra), rest.get(extra..extra + lengths[1])) else {
            return Err(Error::Truncated("inside the archive's directory".to_owned()));
        };
        let mut longer = Longer(long_lengths(fields)?);
        found.push(Entry {
            name: String::from_utf8_lossy(name).into_owned(),
            flags: two(rest, 8)?,
            method: two(rest, 10)?,
            checksum: four(rest, 16)?,
            size: longer.number(four(rest, 24)?)?,
            packed: longer.number(four(rest, 20)?)?,
            at: longer.number(four(rest, 42)?)?,
        });
        rest = rest.get(next..).unwrap_or_default();
    }
    Ok(found)
}

impl Entry {
    /// The content, whose length and checksum are those of the directory.
    pub(super) fn read(&self, source: &mut (impl Read + Seek)) -> Result<Vec<u8>, Error> {
        let local = bytes(source, self.at, 30)?;
        if !local.starts_with(b"PK\x03\x04") {
            return Err(broken("a file is not where the directory says"));
        }
        let before = 30 + u64::from(two(&local, 26)?) + u64::from(two(&local, 28)?);
        let packed = bytes(source, self.at.saturating_add(before), self.packed)?;
        let content = match self.method {
            _ if self.flags & 1 == 1 => return Err(broken("it is encrypted")),
            0 => packed,
            8 => {
                let mut content = Vec::new();
                let inflated = DeflateDecoder::new(&packed[..]).take(self.size);
                Bounded::to(most_inflated(self.packed), inflated).read_to_end(&mut content).map_err(
                    |error| {
                        let is_memory = error.kind() == io::ErrorKind::OutOfMemory;
                        match error.into() {
                            Error::Io(_) if !is_memory => broken("a file is not deflated as it should be"),
                            other => other,
                        }
                    },
                )?;
                content
            }
            method => return Err(broken(&format!("compression of method {method} is not read here"))),
        };
        let mut crc = Crc::new();
        crc.update(&content);
        if content.len() as u64 != self.size || crc.sum() != self.checksum {
            return Err(broken("the checksum of a file is wrong"));
        }
        Ok(content)
    }
}

/// The field of 64-bit lengths (APPNOTE 4.5.3) among the extra fields of an entry.
fn long_lengths(mut fields: &[u8]) -> Result<&[u8], Error> {
    while fields.len() >= 4 {
        let (kind, length) = (two(fields, 0)?, usize::from(two(fields, 2)?));
        let content = fields.get(4..4 + length).unwrap_or_default();
        if kind == 1 {
            return Ok(content);
        }
        fields = fields.get(4 + length..).unwrap_or_default();
    }
    Ok(&[])
}

/// Holds, one after the other, the numbers for which 32 bits are too few.
struct Longer<'a>(&'a [u8]);

impl Longer<'_> {
    fn number(&mut self, short: u32) -> Result<u64, Error> {
        if short != u32::MAX {
            return Ok(u64::from(short));
        }
        let long = eight(self.0, 0)?;
        self.0 = &self.0[8..];
        Ok(long)
    }
}

/// `length` bytes from a place on; missing ones take no memory.
fn bytes(source: &mut (impl Read + Seek), at: u64, length: u64) -> Result<Vec<u8>, Error> {
    source.seek(SeekFrom::Start(at))?;
    let mut found = Vec::new();
    let read = source.by_ref().take(length).read_to_end(&mut found)?;
    if read as u64 == length { Ok(found) } else { Err(Error::Truncated("inside the archive".to_owned())) }
}

fn field<const N: usize>(record: &[u8], at: usize) -> Result<[u8; N], Error> {
    let found = record.get(at..).and_then(<[u8]>::first_chunk);
    found.copied().ok_or_else(|| Error::Truncated("inside the archive's directory".to_owned()))
}

fn two(record: &[u8], at: usize) -> Result<u16, Error> {
    field(record, at).map(u16::from_le_bytes)
}

fn four(record: &[u8], at: usize) -> Result<u32, Error> {
    field(record, at).map(u32::from_le_bytes)
}

fn eight(record: &[u8], at: usize) -> Result<u64, Error> {
    field(record, at).map(u64::from_le_bytes)
}

fn broken(why: &str) -> Error {
    Error::content(format!("no NumPy archive: {why}"))
}

#[cfg(test)]
mod tests {
    use std::io::{Cursor, Write};

    use flate2::write::DeflateEncoder;
    use flate2::{Compression, Crc};

    use super::entries;

    const TEXT: &[u8] = b"what is in the archive, what is in the archive";

    /// An archive of one file; with all lengths in 64 bits, as zip programs write them for streams, or without.
    fn archive(method: u16, is_long: bool) -> Vec<u8> {
        let packed = if method == 8 {
            let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
            encoder.write_all(TEXT).and_then(|()| encoder.finish()).expect("memory")
        } else {
            TEXT.to_vec()
        };
        let mut crc = Crc::new();
        crc.update(TEXT);
        let (size, length) = (TEXT.len() as u64, packed.len() as u64);
        let short = |number: u64| if is_long { u32::MAX } else { number as u32 }.to_le_bytes();
        let fields = [[1, 0, 24, 0].to_vec(), [size, length, 0].map(u64::to_le_bytes).concat()].concat();
        let extra = if is_long { &fields[..] } else { &[] };
        let mut file = b"PK\x03\x04\x2d\0\0\0".to_vec();
        file.extend([&method.to_le_bytes()[..], &[0; 4], &crc.sum().to_le_bytes(), &[0; 8]].concat());
        file.extend([&[1, 0, 3, 0][..], b"a", b"xyz", &packed].concat());
        let at = file.len() as u64;
        file.extend(b"PK\x01\x02\x2d\0\x2d\0\0\0");
        file.extend([&method.to_le_bytes()[..], &[0; 4], &crc.sum().to_le_bytes()].concat());
        file.extend([short(length), short(size)].concat());
        file.extend([&[1, 0, extra.len() as u8, 0][..], &[0; 10], &short(0), b"a", extra].concat());
        let end = file.len() as u64;
        if is_long {
            file.extend(b"PK\x06\x06");
            file.extend([0; 36]);
            file.extend([end - at, at].map(u64::to_le_bytes).concat());
            file.extend([&b"PK\x06\x07\0\0\0\0"[..], &end.to_le_bytes(), &[1, 0, 0, 0]].concat());
        }
        file.extend([&b"PK\x05\x06\0\0\0\0\x01\0\x01\0"[..], &short(end - at), &short(at), &[0; 2]].concat());
        file
    }

    fn content(archive: &[u8]) -> Result<Vec<u8>, String> {
        let mut source = Cursor::new(archive);
        let read = entries(&mut source).and_then(|found| match &found[..] {
            [entry] => entry.read(&mut source),
            _ => Err(super::broken("not one file")),
        });
        read.map_err(|error| error.to_string())
    }

    #[test]
    fn stored_and_deflated_files_are_read() {
        for method in [0, 8] {
            for is_long in [false, true] {
                let mut archive = archive(method, is_long);
                assert_eq!(content(&archive).as_deref(), Ok(TEXT));
                archive.extend(b"a comment");
                assert_eq!(content(&archive).as_deref(), Ok(TEXT));
            }
        }
        assert!(content(&archive(14, false)).is_err_and(|error| error.contains("method 14")));
    }

    /// Whatever is cut off or changed: never anything but the content or an error.
    #[test]
    fn broken_archives_are_refused() {
        for method in [0, 8] {
            for is_long in [false, true] {
                let whole = archive(method, is_long);
                for end in 0..whole.len() {
                    assert!(content(&whole[..end]).is_err(), "{end}");
                }
                for at in 0..whole.len() {
                    for byte in [0, 1, 0x7f, 0xff, !whole[at]] {
                        let mut changed = whole.clone();
                        changed[at] = byte;
                        assert!(content(&changed).map_or(true, |found| found == TEXT), "{at} {byte}");
                    }
                }
            }
        }
    }
}
