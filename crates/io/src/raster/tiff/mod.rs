//! GeoTIFF: a raster with its place and its system of coordinates (OGC 19-008r4; TIFF 6.0 and BigTIFF).
//!
//! Written here, tile by tile as rows come, with overviews; read with the `tiff` crate, behind the fence.

mod cells;
mod compression;
mod directory;
mod halves;
mod meaning;
mod page;
mod part;
mod place;
mod read;
mod tile;
mod write;

pub(crate) use read::read;
pub(super) use read::read_place;
pub(super) use write::Writer;

/// The tags that say what a file has, by number.
mod tag {
    pub(super) const KIND: u16 = 254;
    pub(super) const WIDTH: u16 = 256;
    pub(super) const LENGTH: u16 = 257;
    pub(super) const BITS: u16 = 258;
    pub(super) const COMPRESSION: u16 = 259;
    pub(super) const MEANING: u16 = 262;
    pub(super) const STRIPS: u16 = 273;
    pub(super) const SAMPLES: u16 = 277;
    pub(super) const STRIP_ROWS: u16 = 278;
    pub(super) const STRIP_SIZES: u16 = 279;
    pub(super) const PLANES: u16 = 284;
    pub(super) const PREDICTOR: u16 = 317;
    pub(super) const TILE_WIDTH: u16 = 322;
    pub(super) const TILE_LENGTH: u16 = 323;
    pub(super) const TILES: u16 = 324;
    pub(super) const TILE_SIZES: u16 = 325;
    pub(super) const SAMPLE_FORMAT: u16 = 339;
    pub(super) const SCALE: u16 = 33_550;
    pub(super) const TIE: u16 = 33_922;
    pub(super) const TRANSFORM: u16 = 34_264;
    pub(super) const KEYS: u16 = 34_735;
    pub(super) const DOUBLES: u16 = 34_736;
    pub(super) const TEXTS: u16 = 34_737;
    pub(super) const ABOUT: u16 = 42_112;
    pub(super) const NO_DATA: u16 = 42_113;

    /// Kinds of images in a directory: a smaller copy of another, or its mask.
    pub(super) const REDUCED: u32 = 1;
    pub(super) const MASK: u32 = 4;
}
