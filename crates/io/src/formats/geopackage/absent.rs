//! What is said where SQLite is not compiled in.

use std::io::Write;

use crate::formats::vector::Layer;
use crate::{Cloud, Error, Format, Graph, ReadOptions, Rings, Source};

const LEFT_OUT: Error = Error::LeftOut { format: Format::GeoPackage, feature: "geopackage" };

pub(crate) fn read_points(_: Box<dyn Source>, _: &ReadOptions) -> Result<Cloud, Error> {
    Err(LEFT_OUT)
}

pub(crate) fn read_graph(_: Box<dyn Source>, _: &ReadOptions) -> Result<Graph, Error> {
    Err(LEFT_OUT)
}

pub(crate) fn read_rings(_: Box<dyn Source>) -> Result<Rings, Error> {
    Err(LEFT_OUT)
}

pub(crate) fn write(_: &mut dyn Write, _: &impl Layer) -> Result<(), Error> {
    Err(LEFT_OUT)
}
