//! Errors of the library as failures of the command, with advice in its words.

use std::path::Path;

use delone_io::{Contents, Direction, Format};
use delone_terrain::Error;

use crate::message::Failure;
use crate::tiles;

/// The failure of work on a file, or on all points.
pub(super) fn failure(label: &Path, error: Error) -> Failure {
    let help = match error {
        Error::Points(error) => return Failure::points(label, &error),
        Error::Lines(error) => return Failure::graph(label, &error),
        Error::Levels(error) => return Failure::usage(error, "give another --interval"),
        Error::File(error) => return Failure::file(label, &error),
        Error::In { path, error } => return failure(&path, *error),
        Error::Store(error) => return tiles::failure(error),
        Error::NeedsMemory(_) => return Failure::usage(error, "leave --memory out"),
        Error::LargeRow { columns } => {
            let what = format!("{}: a row of {columns} cells does not fit into --memory", label.display());
            return Failure::new(what, "allow more memory, or choose a larger --cell");
        }
        Error::NoPoints => "give points with heights",
        Error::NoHeights => "give x, y and z, or name the columns with --columns x,y,z",
        Error::OneLine => "give points that span an area",
        Error::NotNorthUp => "turn it with gdalwarp first",
        Error::Systems { .. } => "transform one of them first: ogr2ogr, gdalwarp and pdal do so",
        Error::NoLine => {
            return Failure::new(said(label, &error), give("lines or polygons", Contents::Lines));
        }
        Error::NoPolygon => return Failure::new(said(label, &error), give("polygons", Contents::Polygons)),
        _ => "name a --cell, or leave out points that are far away",
    };
    Failure::new(said(label, &error), help)
}

/// The failure of a file of level polygons.
pub(super) fn failure_of_level(path: &Path, error: Error) -> Failure {
    match error {
        Error::NoPolygon => Failure::new(said(path, &error), "give polygons, or --breaklines for lines"),
        _ => failure(path, error),
    }
}

fn said(label: &Path, error: &Error) -> String {
    format!("{}: {error}", label.display())
}

/// Advice on a file to give instead.
fn give(what: &str, contents: Contents) -> String {
    format!("give {what} in one of {}", Format::with(&[contents], Direction::Read))
}
