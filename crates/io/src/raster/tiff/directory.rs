//! Directories of TIFF files as bytes: what they say of an image, and where its tiles are.

/// Types of numbers in tags.
const TEXT: u16 = 2;
pub(super) const SHORT: u16 = 3;
pub(super) const LONG: u16 = 4;
const DOUBLE: u16 = 12;
const LONG8: u16 = 16;

/// An entry of a directory.
#[derive(Clone, Debug)]
pub(super) struct Tag {
    number: u16,
    kind: u16,
    count: u64,
    bytes: Vec<u8>,
}

impl Tag {
    pub(super) fn shorts(number: u16, values: &[u16]) -> Self {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        Self { number, kind: SHORT, count: values.len() as u64, bytes }
    }

    pub(super) fn long(number: u16, value: u32) -> Self {
        Self { number, kind: LONG, count: 1, bytes: value.to_le_bytes().to_vec() }
    }

    pub(super) fn doubles(number: u16, values: &[f64]) -> Self {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        Self { number, kind: DOUBLE, count: values.len() as u64, bytes }
    }

    pub(super) fn text(number: u16, text: &str) -> Self {
        let bytes = [text.as_bytes(), &[0]].concat();
        Self { number, kind: TEXT, count: bytes.len() as u64, bytes }
    }

    /// Places in the file, or numbers of bytes.
    pub(super) fn places(number: u16, values: impl Iterator<Item = u64>, is_big: bool) -> Self {
        let mut bytes = Vec::new();
        let mut count = 0;
        for value in values {
            bytes.extend_from_slice(&value.to_le_bytes()[..if is_big { 8 } else { 4 }]);
            count += 1;
        }
        Self { number, kind: if is_big { LONG8 } else { LONG }, count, bytes }
    }
}

/// Bytes of places and of values that stand in an entry.
fn inline(is_big: bool) -> usize {
    if is_big { 8 } else { 4 }
}

/// The first bytes of a file, which is little-endian, with a directory right after them.
pub(super) fn header(is_big: bool) -> &'static [u8] {
    if is_big { b"II\x2b\0\x08\0\0\0\x10\0\0\0\0\0\0\0" } else { b"II\x2a\0\x08\0\0\0" }
}

/// The bytes of the entries of a directory, with their number before and the place of the next directory after.
fn entries_length(count: usize, is_big: bool) -> usize {
    if is_big { 8 + 20 * count + 8 } else { 2 + 12 * count + 4 }
}

/// A directory at an even place: entries, then the values that do not fit into them, at even places too. `next` says whether another one
/// follows right after it.
pub(super) fn directory(mut tags: Vec<Tag>, start: u64, next: bool, is_big: bool) -> Vec<u8> {
    tags.sort_by_key(|tag| tag.number);
    let inline = inline(is_big);
    let after = start + entries_length(tags.len(), is_big) as u64;
    let count = (tags.len() as u64).to_le_bytes();
    let mut entries = count[..if is_big { 8 } else { 2 }].to_vec();
    let mut values: Vec<u8> = Vec::new();
    for tag in &tags {
        entries.extend(tag.number.to_le_bytes());
        entries.extend(tag.kind.to_le_bytes());
        entries.extend_from_slice(&tag.count.to_le_bytes()[..inline]);
        let mut field = [0; 8];
        if tag.bytes.len() <= inline {
            field[..tag.bytes.len()].copy_from_slice(&tag.bytes);
        } else {
            field = (after + values.len() as u64).to_le_bytes();
            values.extend_from_slice(&tag.bytes);
            values.resize(values.len().next_multiple_of(2), 0);
        }
        entries.extend_from_slice(&field[..inline]);
    }
    let next = if next { after + values.len() as u64 } else { 0 };
    entries.extend_from_slice(&next.to_le_bytes()[..inline]);
    entries.extend(values);
    entries
}
