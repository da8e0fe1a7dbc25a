//! The `.poly` files of Osmosis: polygons of longitude and latitude, which are cut out of maps. They share their extension with those of
//! Triangle, and begin with a name where these begin with a number.
//!
//! A name for all; then sections, each with a name, a position a line, and `END`; then `END`. A name with `!` before it is a hole.
//!
//! Source: <https://wiki.openstreetmap.org/wiki/Osmosis/Polygon_Filter_File_Format>.

use super::lines::Lines;
use super::shapes::Shapes;
use crate::{Crs, Error, Source};

/// Longitude and latitude of WGS 84, which all files have.
const EPSG: u32 = 4326;
const END: &str = "END";

/// Whether a file begins with a name and no number.
pub(super) fn is_one(source: &mut Box<dyn Source>) -> Result<bool, Error> {
    let start = source.fill_buf()?;
    let start = start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start).trim_ascii_start();
    Ok(start.first().is_some_and(|&first| first.is_ascii_alphabetic() || first == b'_' || first == b'"'))
}

/// Reads polygons.
pub(super) fn read(source: Box<dyn Source>) -> Result<Shapes, Error> {
    let mut lines = Lines::new(source);
    let mut shapes = Shapes::default();
    shapes.crs = Some(Crs::of_epsg(EPSG));
    let mut is_first = true;
    lines.next()?;
    loop {
        let Some(line) = lines.next()? else {
            return Err(Error::Truncated(format!("without the last {END}")));
        };
        if line.text.eq_ignore_ascii_case(END) {
            break;
        }
        if is_first || !line.text.starts_with('!') {
            shapes.polygon();
        }
        is_first = false;
        let start = shapes.len();
        loop {
            let Some(line) = lines.next()? else {
                return Err(Error::Truncated(format!("inside a polygon, without {END}")));
            };
            if line.text.eq_ignore_ascii_case(END) {
                break;
            }
            let mut words = line.text.split_whitespace();
            let position =
                [line.number(words.next(), "the longitude")?, line.number(words.next(), "the latitude")?];
            shapes.position(&position);
        }
        shapes.ring(start, true);
    }
    Ok(shapes)
}
