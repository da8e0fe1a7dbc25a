//! LAS and LAZ point clouds to arrays: the module behind `delone/laz`.
//!
//! A file is read by an instance of its own, that is thrown away after: what a hostile file can do is to end it in a trap, which is an
//! error like others for JavaScript, and its memory goes with it. JavaScript asks for room, writes the file, says which classes it wants,
//! calls `read`, and copies what it finds. There is no `unsafe` but the attribute that exports a name.

mod chunks;
mod header;

use std::cell::RefCell;
use std::io::Cursor;

use laz::laszip::CompressorType;
use laz::record::{LayeredPointRecordDecompressor, RecordDecompressor, SequentialPointRecordDecompressor};
use laz::{DecompressionSelection, LazVlr};

use header::Header;

/// A fault of a file; `js/laz.js` has the words, by the same numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// It is of another kind.
    NoLas = 1,
    /// It ends too early.
    Truncated = 2,
    /// It says what cannot be.
    Damaged = 3,
    /// A kind of points that is not known.
    Unsupported = 4,
}

/// The points of the classes that are wanted.
#[derive(Debug, Default)]
pub struct Cloud {
    /// x and y by turns.
    pub coords: Vec<f64>,
    pub heights: Vec<f64>,
    pub classes: Vec<u8>,
}

/// Reads a file; `wants` says of a class, and of points that are withheld or not, whether they are wanted.
///
/// # Errors
/// A [`Fault`] says what is wrong with it.
pub fn read_file(file: &[u8], wants: impl Fn(u8, bool) -> bool) -> Result<Cloud, Fault> {
    let header = Header::read(file)?;
    let mut cloud = Cloud::default();
    let mut take = |point: &[u8]| {
        let (class, withheld) =
            if header.wide { (point[16], point[15] & 4) } else { (point[15] & 0x1f, point[15] & 0x80) };
        if wants(class, withheld != 0) {
            let at = |axis: usize| {
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| point[4 * axis + k]);
                f64::from(i32::from_le_bytes([a, b, c, d])) * header.scale[axis] + header.offset[axis]
            };
            cloud.coords.extend([at(0), at(1)]);
            cloud.heights.push(at(2));
            cloud.classes.push(class);
        }
    };
    let Some(laszip) = &header.laszip else {
        // That they all fit was seen with the header.
        let points = file[header.start..].chunks_exact(header.record);
        points.take(header.total as usize).for_each(take);
        return Ok(cloud);
    };
    let kind = laszip.first_chunk().map_or(0, |&kind| u16::from_le_bytes(kind));
    let kind = match kind {
        1 => CompressorType::PointWise,
        2 => CompressorType::PointWiseChunked,
        3 => CompressorType::LayeredChunked,
        _ => return Err(Fault::Unsupported),
    };
    let vlr = LazVlr::from_buffer(laszip).map_err(|_| Fault::Damaged)?;
    if vlr.items_size() != header.record as u64 {
        return Err(Fault::Damaged);
    }
    let mut rest = header.total;
    let mut point = vec![0; header.record];
    for chunk in chunks::chunks(file, &header, &vlr, kind)? {
        let bytes = Cursor::new(chunk.bytes);
        let mut decoder: Box<dyn RecordDecompressor<Cursor<&[u8]>>> = match kind {
            CompressorType::LayeredChunked => Box::new(LayeredPointRecordDecompressor::new(bytes)),
            _ => Box::new(SequentialPointRecordDecompressor::new(bytes)),
        };
        decoder.set_fields_from(vlr.items()).map_err(|_| Fault::Damaged)?;
        decoder.set_selection(
            DecompressionSelection::base().decompress_z().decompress_classification().decompress_flags(),
        );
        let count = chunk.points.min(rest);
        for _ in 0..count {
            decoder.decompress_next(&mut point).map_err(|_| Fault::Truncated)?;
            take(&point);
        }
        rest -= count;
    }
    if rest > 0 { Err(Fault::Truncated) } else { Ok(cloud) }
}

/// The file, the wanted classes, and what was read.
#[derive(Default)]
struct Tray {
    file: Vec<u8>,
    wanted: Vec<u8>,
    /// Whether points that are withheld are wanted too.
    withheld: bool,
    cloud: Cloud,
}

thread_local! {
    static TRAY: RefCell<Tray> = RefCell::default();
}

/// Exports functions by their names.
macro_rules! export {
    ($($(#[$meta:meta])* fn $name:ident($($arg:ident: $kind:ty),*) -> $out:ty $body:block)*) => {$(
        $(#[$meta])*
        #[expect(unsafe_code, reason = "an exported name; there is one such crate in a module")]
        #[unsafe(no_mangle)]
        pub extern "C" fn $name($($arg: $kind),*) -> $out $body
    )*};
}

export! {
    /// Room for a file of so many bytes; null if there is none.
    fn room(length: usize) -> *mut u8 {
        TRAY.with_borrow_mut(|tray| {
            if tray.file.try_reserve_exact(length).is_err() {
                return std::ptr::null_mut();
            }
            tray.file.resize(length, 0);
            tray.file.as_mut_ptr()
        })
    }

    /// Wants a class; all, if none is named.
    fn want(class: u32) -> () {
        TRAY.with_borrow_mut(|tray| tray.wanted.push(class as u8));
    }

    /// Wants points that are withheld, too.
    fn want_withheld() -> () {
        TRAY.with_borrow_mut(|tray| tray.withheld = true);
    }

    /// Reads the file: 0, or the number of a fault.
    fn read() -> u32 {
        TRAY.with_borrow_mut(|tray| {
            let (wanted, withheld) = (&tray.wanted, tray.withheld);
            let wants = |class: u8, is_withheld: bool| {
                (wanted.is_empty() || wanted.contains(&class)) && (withheld || !is_withheld)
            };
            match read_file(&tray.file, wants) {
                Ok(cloud) => tray.cloud = cloud,
                Err(fault) => return fault as u32,
            }
            0
        })
    }

    /// How many points were read.
    fn count() -> usize {
        TRAY.with_borrow(|tray| tray.cloud.classes.len())
    }

    /// Where coordinates are.
    fn coords() -> *const f64 {
        TRAY.with_borrow(|tray| tray.cloud.coords.as_ptr())
    }

    /// Where heights are.
    fn heights() -> *const f64 {
        TRAY.with_borrow(|tray| tray.cloud.heights.as_ptr())
    }

    /// Where classes are.
    fn classes() -> *const u8 {
        TRAY.with_borrow(|tray| tray.cloud.classes.as_ptr())
    }
}
