//! The files of a raster: written in bands of rows, and named with all outputs of the command.

use std::ops::Range;
use std::path::PathBuf;

use delone::surface::Grid;
use delone_io::{Crs, Format};
use delone_terrain::{Product, Sheets};

use crate::files;
use crate::message::{Failure, warn};
use crate::progress::Phase;

/// Writes all rasters and hillshades, whole or not at all; says how many cells have a value.
pub(super) fn write(
    outputs: &[(PathBuf, Format)],
    (grid, crs, product): (&Grid, Option<&Crs>, &Product),
    bands: &[Range<usize>],
    quiet: bool,
    mut values: impl FnMut(Range<usize>) -> Result<Vec<f64>, Failure>,
) -> Result<u64, Failure> {
    let mut sheets = Sheets::new(*grid, crs.cloned(), product);
    for (path, format) in outputs {
        let added = sheets.add(files::create(path)?, *format, files::scratch(path));
        added.map_err(|error| files::cannot_write(path, error))?;
    }
    let failed = |(number, error): delone_terrain::Fault| files::cannot_write(&outputs[number].0, error);
    let phase = Phase::count(quiet, "rows", grid.rows() as u64);
    for rows in bands {
        sheets.write_rows(&values(rows.clone())?).map_err(failed)?;
        rows.clone().for_each(|_| phase.advance());
    }
    let (known, hidden) = (sheets.known(), sheets.hidden());
    let done = sheets.finish().map_err(failed)?;
    for (output, (path, format)) in done.into_iter().zip(outputs) {
        files::finish(output).map_err(|error| files::cannot_write(path, error))?;
        files::write_sides(path, *format, grid, crs, quiet)?;
    }
    if let Some((count, number)) = hidden {
        let what = format!("{count} cells have the height {number}, which stands for no data");
        warn(quiet, format_args!("{what}: name another with --nodata"));
    }
    Ok(known)
}
