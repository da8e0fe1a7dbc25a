//! Errors where SQLite is not compiled in.

use std::io::Write;

use crate::formats::shapes::Shapes;
use crate::formats::vector::Layer;
use crate::{Error, Format, ReadOptions, Source};

const LEFT_OUT: Error = Error::LeftOut { format: Format::GeoPackage, feature: "geopackage" };

pub(crate) fn read(_: Box<dyn Source>, _: &ReadOptions) -> Result<Shapes, Error> {
    Err(LEFT_OUT)
}

pub(crate) fn write(_: &mut dyn Write, _: &[&dyn Layer]) -> Result<(), Error> {
    Err(LEFT_OUT)
}
