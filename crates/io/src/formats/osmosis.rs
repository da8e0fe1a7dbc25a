//! The `.poly` files of Osmosis: polygons of longitude and latitude, which are cut out of maps. They share their extension with those of
//! Triangle, and begin with a name where these begin with a number.
//!
//! A name for all; then sections, each with a name, a position a line, and `END`; then `END`. A name with `!` before it is a hole, in
//! whichever of the polygons, which need not be the one before it.
//!
//! Source: <https://wiki.openstreetmap.org/wiki/Osmosis/Polygon_Filter_File_Format>.

use super::lines::Lines;
use super::shapes::Shapes;
use crate::rings::{Ring, polygons};
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
    let mut sections: Vec<(Vec<[f64; 2]>, bool)> = Vec::new();
    lines.next()?;
    loop {
        let Some(line) = lines.next()? else {
            return Err(Error::Truncated(format!("without the last {END}")));
        };
        if line.text.eq_ignore_ascii_case(END) {
            break;
        }
        let is_hole = line.text.starts_with('!');
        let mut positions = Vec::new();
        loop {
            let Some(line) = lines.next()? else {
                return Err(Error::Truncated(format!("inside a polygon, without {END}")));
            };
            if line.text.eq_ignore_ascii_case(END) {
                break;
            }
            let mut words = line.text.split_whitespace();
            positions.push([
                line.number(words.next(), "the longitude")?,
                line.number(words.next(), "the latitude")?,
            ]);
        }
        sections.push((positions, is_hole));
    }
    let rings: Vec<Ring> = sections.iter().map(|section| Ring::of(section.0.clone())).collect();
    let mut alone = 0;
    for polygon in polygons(&rings, |section| sections[section].1) {
        if sections[polygon[0]].1 {
            alone += 1;
            continue;
        }
        shapes.polygon();
        for section in polygon {
            let start = shapes.len();
            for position in &sections[section].0 {
                shapes.position(position);
            }
            shapes.ring(start, true);
        }
    }
    if alone > 0 {
        shapes.losses.push(format!("{alone} holes are left out: no polygon is around them"));
    }
    Ok(shapes)
}
