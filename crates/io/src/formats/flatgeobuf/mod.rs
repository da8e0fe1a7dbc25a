//! FlatGeobuf: a header, perhaps an index, and then features, each a buffer of FlatBuffers. Read from front to back, a feature at a time;
//! the index is passed over. None is written: it would stand before the features and in their order along a curve, so that all would have
//! to be kept until the last is known.
//!
//! Source: <https://flatgeobuf.org/#specification>, version 3. Read and written by hand: the crate for it depends on geozero, geo-traits and one version of
//! flatbuffers.

mod read;
mod tables;
mod write;

pub(crate) use read::read;
pub(super) use write::write;

/// How files begin: the version after the name is the one that counts, the last byte is that of a patch.
const MAGIC: [u8; 7] = *b"fgb\x03fgb";

/// The fields of the tables.
mod header {
    pub(super) const NAME: usize = 0;
    pub(super) const GEOMETRY: usize = 2;
    pub(super) const HAS_HEIGHTS: usize = 3;
    pub(super) const COLUMNS: usize = 7;
    pub(super) const COUNT: usize = 8;
    pub(super) const NODE_SIZE: usize = 9;
    pub(super) const CRS: usize = 10;
}

mod column {
    pub(super) const NAME: usize = 0;
    pub(super) const KIND: usize = 1;
}

mod crs {
    pub(super) const AUTHORITY: usize = 0;
    pub(super) const CODE: usize = 1;
    pub(super) const NAME: usize = 2;
    pub(super) const WKT: usize = 4;
}

mod feature {
    pub(super) const GEOMETRY: usize = 0;
    pub(super) const PROPERTIES: usize = 1;
    pub(super) const COLUMNS: usize = 2;
}

mod geometry {
    pub(super) const ENDS: usize = 0;
    pub(super) const XY: usize = 1;
    pub(super) const Z: usize = 2;
    pub(super) const KIND: usize = 6;
    pub(super) const PARTS: usize = 7;
}

/// The types of columns.
mod kind {
    pub(super) const BYTE: u8 = 0;
    pub(super) const UBYTE: u8 = 1;
    pub(super) const BOOL: u8 = 2;
    pub(super) const SHORT: u8 = 3;
    pub(super) const USHORT: u8 = 4;
    pub(super) const INT: u8 = 5;
    pub(super) const UINT: u8 = 6;
    pub(super) const LONG: u8 = 7;
    pub(super) const ULONG: u8 = 8;
    pub(super) const FLOAT: u8 = 9;
    pub(super) const DOUBLE: u8 = 10;
    pub(super) const STRING: u8 = 11;
    pub(super) const JSON: u8 = 12;
    pub(super) const DATE_TIME: u8 = 13;
    pub(super) const BINARY: u8 = 14;
}

#[cfg(test)]
mod tests;
