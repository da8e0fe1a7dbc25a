//! Archives of arrays as `numpy.savez` writes them: stored, with all lengths in 64 bits (APPNOTE 6.3.10, sections 4.3 and 4.5.3).

use std::io::{self, Write};

use flate2::Crc;

/// The 32-bit field that says that 64 bits follow.
const LONG: [u8; 4] = [0xff; 4];
/// The version that knows 64 bits, no flags, stored, and the first day there is.
const ABOUT: [u8; 10] = [45, 0, 0, 0, 0, 0, 0, 0, 0x21, 0];

/// Writes files one after another, and a directory of them.
pub(super) struct Archive<'a> {
    out: &'a mut dyn Write,
    at: u64,
    directory: Vec<u8>,
    count: u64,
}

impl<'a> Archive<'a> {
    pub(super) fn new(out: &'a mut dyn Write) -> Self {
        Self { out, at: 0, directory: Vec::new(), count: 0 }
    }

    /// Adds a file.
    pub(super) fn add(&mut self, name: &str, content: &[u8]) -> io::Result<()> {
        let mut crc = Crc::new();
        crc.update(content);
        let (checksum, length) = (crc.sum().to_le_bytes(), (content.len() as u64).to_le_bytes());
        let name_length = (name.len() as u16).to_le_bytes();
        let local = [
            b"PK\x03\x04",
            &ABOUT[..],
            &checksum,
            &LONG,
            &LONG,
            &name_length,
            &[20, 0],
            name.as_bytes(),
            &[1, 0, 16, 0],
            &length,
            &length,
        ]
        .concat();
        self.directory.extend([b"PK\x01\x02", &[45, 0][..], &ABOUT, &checksum, &LONG, &LONG].concat());
        // No comment, first disk, no attributes.
        self.directory.extend([&name_length[..], &[28, 0], &[0; 10], &LONG, name.as_bytes()].concat());
        self.directory.extend([&[1, 0, 24, 0][..], &length, &length, &self.at.to_le_bytes()].concat());
        self.out.write_all(&local)?;
        self.out.write_all(content)?;
        self.at += (local.len() + content.len()) as u64;
        self.count += 1;
        Ok(())
    }

    /// Writes the directory, in 64 bits and then where these are.
    pub(super) fn finish(self) -> io::Result<()> {
        let (count, size) = (self.count.to_le_bytes(), (self.directory.len() as u64).to_le_bytes());
        let end = self.at + self.directory.len() as u64;
        self.out.write_all(&self.directory)?;
        let long = [
            b"PK\x06\x06",
            &44_u64.to_le_bytes()[..],
            &[45, 0, 45, 0],
            &[0; 8],
            &count,
            &count,
            &size,
            &self.at.to_le_bytes(),
        ]
        .concat();
        self.out.write_all(&long)?;
        self.out.write_all(&[b"PK\x06\x07", &[0; 4][..], &end.to_le_bytes(), &[1, 0, 0, 0]].concat())?;
        let short = (self.count as u16).to_le_bytes();
        self.out.write_all(&[b"PK\x05\x06", &[0; 4][..], &short, &short, &LONG, &LONG, &[0, 0]].concat())
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::Archive;
    use crate::formats::npy::archive::entries;

    #[test]
    fn what_is_written_is_read() {
        let mut bytes = Vec::new();
        let mut archive = Archive::new(&mut bytes);
        let files: [(&str, &[u8]); 3] = [("a.npy", b"some bytes"), ("empty", b""), ("b", &[7; 1000])];
        files.iter().for_each(|(name, content)| archive.add(name, content).expect("memory"));
        archive.finish().expect("memory");
        let mut source = Cursor::new(bytes);
        let found = entries(&mut source).expect("an archive");
        assert_eq!(found.len(), files.len());
        for (entry, (name, content)) in found.iter().zip(files) {
            assert_eq!((entry.name.as_str(), &entry.read(&mut source).expect("a file")[..]), (name, content));
        }
    }
}
